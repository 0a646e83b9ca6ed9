//! If no motion is consistent, the body stays out of balance, and every frame reports it (R32).

use stiction_core::{Evolution, Solver, Status};
use stiction_tests::laws::{judge, worst};
use stiction_tests::run::planar;
use stiction_tests::{Frame, Number, Run, Setup, test_each};

test_each! {
    cases::imbalance_is_reported_until_the_hand_moves,
    cases::frame_after_an_imbalance_is_a_jump,
    cases::slot_without_friction_bears_nothing_along_it,
    cases::straight_across_a_slot_the_weight_is_borne,
    cases::two_floors_at_one_height_are_the_one_with_more_friction,
}

mod cases {
    use super::*;

    #[track_caller]
    fn lawful_or_said<R: Number>(setup: &Setup, frame: &Frame) {
        let finding = worst(judge::<R>(setup, frame));
        assert!(finding.holds(), "{}: {finding:?}: {frame:?}", R::NAME);
    }

    /// A heavy point on a smooth slope is held straight below itself along the slope: the pull turns it in neither
    /// direction. In a number type that finds no direction of turning, the point stays out of balance, and the status
    /// reports it as long as the hand rests there.
    pub(super) fn imbalance_is_reported_until_the_hand_moves<R: Number>(evolution: Evolution) {
        let slope = 15f64.to_radians();
        let (sin, cos) = slope.sin_cos();
        let setup = Setup::new(&[[0.05, 0.0]])
            .held_at([0.0, 0.0])
            .springs(500.0, 0.0)
            .weighing(148.4375)
            .surface([-sin, cos], 0.0, [0.0, 0.0])
            .at([0.0, 0.0, slope]);
        let rest = [0.0, 0.0, slope];
        let mut run = Run::<R>::start(&setup, evolution, rest);
        lawful_or_said::<R>(&setup, &run.frame);
        let first = run.frame.status;
        println!("{first:?}");
        run.step([f64::NAN, 0.0, slope]);
        assert_eq!(run.frame.status, Status::HeldLast);
        for _ in 0..3 {
            lawful_or_said::<R>(&setup, run.step(rest));
            assert_eq!(run.frame.status, first);
        }
        // A hand slightly to the side ends the ambiguity.
        lawful_or_said::<R>(&setup, run.step([0.0, 0.01, slope]));
        assert_eq!(run.frame.status, Status::Ok);
    }

    /// A heavy rod on two smooth slopes that both descend in the same direction. Out of balance, there is no path along which
    /// the rod could be followed: the next frame is a jump, whatever the evolution.
    pub(super) fn frame_after_an_imbalance_is_a_jump<R: Number>(evolution: Evolution) {
        let (up, tilt) = (
            [7.5f64.to_radians(), 30f64.to_radians()],
            22.5f64.to_radians(),
        );
        let normal = |angle: f64| [angle.sin(), angle.cos()];
        let setup = Setup::new(&[[0.05, 0.0], [-0.05, 0.0]])
            .held_at([0.0, 0.05])
            .springs(10_000.0, 0.0)
            .weighing(281.25)
            .surface(normal(up[0]), -0.025, [0.0, 0.0])
            .surface(normal(up[1]), -0.039_667_667_014_559_76, [0.0, 0.0])
            .at([0.0, 0.0, tilt]);
        let [x, y] = setup.grip();
        let mut run = Run::<R>::start(&setup, evolution, [x, y, tilt]);
        let jumps = Solver::new(setup.scene::<R>().expect("a sound scene"), Evolution::Frame);
        let mut unbalanced = 0;
        for i in 1..=100 {
            let part = f64::from(i) / 100.0;
            let hand = [x + 0.0313 * part, y - 0.0677 * part, tilt];
            let (before, mut twin) = (run.frame.status, run.state.clone());
            run.step(hand);
            lawful_or_said::<R>(&setup, &run.frame);
            if before > Status::EventLimit {
                let output = jumps.step(&mut twin, planar::<R>(hand));
                assert_eq!(run.frame, Frame::new(&jumps, &twin, &output), "{i}");
                unbalanced += 1;
            }
        }
        assert!(unbalanced > 0, "{}", R::NAME);
    }

    /// A point between a floor and two ceilings at the same height: without friction, the hand moves it along.
    pub(super) fn slot_without_friction_bears_nothing_along_it<R: Number>(evolution: Evolution) {
        let setup = Setup::point()
            .held_at([0.1, 0.0])
            .springs(10.0, 0.0)
            .floor([0.0, 0.0])
            .surface([0.0, -1.0], 0.0, [0.0, 0.0])
            .surface([0.0, -1.0], 0.0, [0.0, 0.0]);
        let mut run = Run::<R>::start(&setup, evolution, [0.1, 0.0, 0.0]);
        for frame in run.lead([0.3, 0.01, 0.0], 4) {
            lawful_or_said::<R>(&setup, &frame);
            assert!(frame.status <= Status::EventLimit, "{frame:?}");
            let [fx, _, _] = frame.wrench;
            assert!(fx.abs() <= 1e3 * R::ROUNDING, "{}: {fx} N", R::NAME);
        }
    }

    /// Which floor bears what is not determined, but together they bear what the one with more friction bears alone.
    pub(super) fn two_floors_at_one_height_are_the_one_with_more_friction<R: Number>(
        evolution: Evolution,
    ) {
        let (rough, smooth) = ([0.5, 0.3], [0.2, 0.2]);
        let on = |floors: &[[f64; 2]]| {
            let block = Setup::block(0.1, 0.06).springs(500.0, 1.0).weighing(1.0);
            let setup = (floors.iter()).fold(block, |setup, &friction| setup.floor(friction));
            let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.0, 0.0]);
            let ways = [[0.0, -0.01, 0.0], [0.02, -0.01, 0.1], [-0.02, 0.01, 0.0]];
            let frames = ways.map(|hand| run.lead(hand, 9));
            frames.map(|frames| {
                frames
                    .into_iter()
                    .map(|f| (f.pose, f.wrench, f.events, f.status))
            })
        };
        let one = on(&[rough]).map(Vec::from_iter);
        for floors in [[rough, smooth], [smooth, rough], [rough, rough]] {
            assert_eq!(on(&floors).map(Vec::from_iter), one, "{floors:?}");
        }
    }

    /// A rhombus that stands on one tip and touches the ceiling with the other: the floor bears its weight.
    pub(super) fn straight_across_a_slot_the_weight_is_borne<R: Number>(evolution: Evolution) {
        let setup = Setup::new(&[[0.05, 0.0], [0.0, 0.03], [-0.05, 0.0], [0.0, -0.03]])
            .springs(1.0, 1e-3)
            .weighing(0.002)
            .floor([0.0, 0.0])
            .surface([0.0, -1.0], -0.06, [0.0, 0.0])
            .at([0.0, 0.03, 0.0]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.03, 0.0]);
        assert_eq!(run.frame.status, Status::Ok);
        lawful_or_said::<R>(&setup, &run.frame);
        for hand in [[0.01, 0.03, 0.0], [0.01, 0.03, 0.2], [0.02, 0.02, -0.1]] {
            for frame in run.lead(hand, 4) {
                lawful_or_said::<R>(&setup, &frame);
            }
        }
    }
}
