//! Without friction a vertex glides: its foot is where the tangential forces balance, and its moment has a second harmonic
//! in the angle (STATICS 3). The tests use known answers, found here by slow bisections, and the laws in random scenes.

use stiction_core::{Event, Evolution, Fixed, StateKind, Status};
use stiction_tests::laws::{assert_lawful, worst};
use stiction_tests::random::scenarios;
use stiction_tests::run::polyline;
use stiction_tests::setup::VERTICES;
use stiction_tests::{Number, Run, RunOf, Setup, change, close, judge, test_each, times};

test_each!(
    cases::foot_is_below_the_hand,
    cases::glide_folds_by_its_second_harmonic,
    cases::foot_that_could_stick_turns_back_with_a_stop_and_a_slide,
    cases::foot_stops_before_it_goes_back,
    cases::no_frame_of_any_random_scene_without_friction_violates_a_law,
);

/// From the contact to the grip (m); k_h is 1.
const LEVER: f64 = 0.3;

/// A point tool held above its tip.
fn lifted(rotation: f64) -> Setup {
    Setup::point()
        .at([0.0, 0.05, 0.0])
        .held_at([0.0, LEVER])
        .springs(1.0, rotation)
}

/// That tool on a smooth floor.
fn tool(rotation: f64) -> Setup {
    lifted(rotation).floor([0.0, 0.0])
}

/// k (phi - theta) - N (lever x n) for a hand at a height, with N = -n·(p - lever).
fn moment(rotation: f64, [_, height, phi]: [f64; 3], theta: f64) -> f64 {
    let normal = LEVER * theta.cos() - height;
    rotation * (phi - theta) + normal * LEVER * theta.sin()
}

mod cases {
    use super::*;

    /// A long soft arm drags its tip along; then the hand goes down and a little back: at first the tip would go back, and on again as the arm
    /// turns. Friction opposes the motion, so that it stops before.
    pub(super) fn foot_stops_before_it_goes_back<R: Number>(evolution: Evolution) {
        let setup = Setup::new(&[[-0.5, 0.0]])
            .held_at([0.0, 0.0])
            .springs(1.0, 1e-3)
            .surface([0.0, 1.0], 0.0, [0.1, 0.06]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0; 3]);
        let mut frames = run.lead([-0.015_625, 0.007_812_5, 0.0], 4);
        frames.extend(run.lead([0.0625, -0.054_687_5, 0.0], 16));
        frames.extend(run.lead([0.056_25, -0.107_812_5, 0.0], 9));
        for pair in frames.windows(2).filter(|pair| pair[1].events.is_empty()) {
            if let ([before], [after]) = (&*pair[0].contacts, &*pair[1].contacts) {
                let way = after.point[0] - before.point[0];
                assert!(
                    f64::from(after.sliding) * way >= -R::ANALYTIC,
                    "{way}: {pair:?}"
                );
            }
        }
        assert!(frames.iter().any(|frame| frame.saw(Event::Stop)));
    }

    pub(super) fn foot_is_below_the_hand<R: Number>(evolution: Evolution) {
        const ROTATION: f64 = 0.2;
        let setup = tool(ROTATION);
        let keyframes = [
            [0.0, 0.35, 0.0],
            [0.02, 0.15, 0.1],
            [1.2, 0.1, 0.6],
            [-0.4, 0.2, -0.8],
        ];
        let mut run = RunOf::<R, 1, 1, 0>::start(&setup, evolution, keyframes[0]);
        for hand in polyline(&keyframes, 40) {
            let frame = run.step(hand);
            assert_lawful::<R>(&setup, std::slice::from_ref(frame));
            if frame.state == StateKind::NonContact {
                continue;
            }
            // k > N lever: one balance.
            let theta = change(-2.0, 2.0, |theta| moment(ROTATION, hand, theta) > 0.0);
            R::near("theta", frame.pose[2], theta);
            R::near("foot", frame.pose[0], hand[0] + LEVER * theta.sin());
            R::near("N", frame.normal(), LEVER * theta.cos() - hand[1]);
        }
        assert_eq!(run.frame.state, StateKind::SingleVertex);
        assert_eq!((run.frame.slips, run.frame.status), (0, Status::Ok));
    }

    /// Pressed down by a soft grip, the tool leans to one side; turned to the other side, it falls over.
    pub(super) fn glide_folds_by_its_second_harmonic<R: Number>(evolution: Evolution) {
        const ROTATION: f64 = 0.02;
        const HEIGHT: f64 = 0.2;
        // phi of the balance at theta, and its derivative with the second harmonic.
        let phi =
            |theta: f64| theta - (LEVER * theta.cos() - HEIGHT) * LEVER * theta.sin() / ROTATION;
        let slope = |theta: f64| {
            let second = LEVER * LEVER * (2.0 * theta).cos();
            1.0 - (second - HEIGHT * LEVER * theta.cos()) / ROTATION
        };
        let fold = change(-0.6, 0.0, |theta| slope(theta) > 0.0);
        let lands = change(0.3, 0.8, |theta| phi(theta) > phi(fold));
        let setup = tool(ROTATION);
        let begin = [0.0, 0.35, -0.3];
        let mut run = RunOf::<R, 1, 1, 0>::start(&setup, evolution, begin);
        run.lead([0.0, HEIGHT, -0.3], 20);
        let leans = change(-0.8, -0.3, |theta| phi(theta) > -0.3);
        R::near("leans", run.frame.pose[2], leans);
        let end = [0.1, HEIGHT, 0.3];
        let onset = run.onset(end, |frame| frame.saw(Event::Snap));
        R::near("phi", onset.hand[2], phi(fold));
        // A double root.
        close("fold", onset.before.pose[2], fold, R::ANALYTIC.sqrt());
        R::near("lands", run.frame.pose[2], lands);
        let foot = run.frame.hand[0] + LEVER * lands.sin();
        R::near("foot", run.frame.pose[0], foot);
        assert_eq!(run.frame.events, [Event::Snap]);
        assert_eq!(run.frame.state, StateKind::SingleVertex);
    }

    /// Without dynamic friction nothing holds a foot where it turns back. If static friction could, that is a stop and a slide.
    pub(super) fn foot_that_could_stick_turns_back_with_a_stop_and_a_slide<R: Number>(
        evolution: Evolution,
    ) {
        for (fixed, expected) in [(0.5, &[Event::Stop, Event::Slide][..]), (0.0, &[])] {
            // It would stick from N = 1 m · k_h / 0.5 on.
            let setup = lifted(0.2).floor([fixed, 0.0]).remembering(1.0);
            let mut run = RunOf::<R, 1, 1, 0>::start(&setup, evolution, [0.0, 0.35, 0.0]);
            run.lead([0.0, 0.15, 0.0], 3);
            run.lead([0.3, 0.15, 0.0], 10);
            for frame in run.lead([0.1, 0.15, 0.0], 10) {
                R::near("foot", frame.pose[0], frame.hand[0]);
                R::near("T", frame.friction(), 0.0);
                assert_eq!((frame.slips, frame.status), (0, Status::Ok));
                let is_first = frame.hand[0] > 0.27;
                assert_eq!(frame.events, if is_first { expected } else { &[] });
            }
        }
    }

    /// Random scenes of one surface without friction: the laws hold in every frame, and a motion is always found.
    pub(super) fn no_frame_of_any_random_scene_without_friction_violates_a_law<R: Number>(
        evolution: Evolution,
    ) {
        let mut odd = Vec::new();
        for (i, scenario) in scenarios(times(30, 1000), 4).enumerate() {
            let mut setup = scenario.setup.clone().smooth();
            setup.surfaces.truncate(1);
            let hands = scenario.hands(50);
            let mut run = RunOf::<R, VERTICES, 1, 0>::start(&setup, evolution, hands[0]);
            let fault = hands.iter().enumerate().find_map(|(k, &hand)| {
                let frame = run.step(hand);
                let gravest = worst(judge::<R>(&setup, frame));
                let holds = gravest.holds() && frame.status == Status::Ok && frame.slips == 0;
                (!holds).then(|| format!("frame {k}: {gravest:?} {frame:?}"))
            });
            odd.extend(fault.map(|fault| (i, fault)));
        }
        assert!(odd.is_empty(), "{} {evolution:?}: {odd:#?}", R::NAME);
    }
}

/// A point has no size, so the resolution of fixed point follows from its springs: the angle (rad) is accurate, and with it the
/// position of the tip, provided that the grip is no softer than the lever requires.
#[test]
fn fixed_point_carries_a_point_tool_with_a_short_lever() {
    for (lever, rotation, angle) in [(0.005, 0.01, 1e-4), (0.02, 0.5, 2e-5)] {
        let setup = Setup::point()
            .held_at([0.0, lever])
            .springs(500.0, rotation)
            .floor([0.0, 0.0]);
        let keyframes = [
            [0.0, lever + 0.001, 0.0],
            [0.01, lever - 0.003, 0.2],
            [-0.02, lever - 0.002, -0.3],
            [0.0, lever + 0.002, 0.0],
        ];
        let hands = polyline(&keyframes, 300);
        for evolution in Evolution::ALL {
            let mut exact = RunOf::<f64, 1, 1, 0>::start(&setup, evolution, hands[0]);
            let mut fixed = RunOf::<Fixed, 1, 1, 0>::start(&setup, evolution, hands[0]);
            for &hand in &hands {
                let (is, should) = (fixed.step(hand).pose, exact.step(hand).pose);
                let place = lever * angle + 2e-7;
                for (k, bound) in [place, place, angle].into_iter().enumerate() {
                    let apart = (is[k] - should[k]).abs();
                    assert!(apart <= bound, "{lever} m, {hand:?}: {is:?} {should:?}");
                }
            }
        }
    }
}
