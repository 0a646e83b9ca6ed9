//! mu_s = mu_d: a slide has no jumps. A rod between floor and wall is turned down by the hand; once it slides, both contacts
//! stay at the edge of their cones and the rod moves by a small distance in every frame.

use stiction_core::{Evolution, Fixed};
use stiction_tests::run::Run;
use stiction_tests::{Number, Setup, close};

const MU: f64 = 0.5;
/// Half the rod (m).
const HALF: f64 = 0.15;
/// k_h (N/m)
const STIFFNESS: f64 = 500.0;
/// Frames for a tenth of a radian.
const FRAMES: usize = 500;

/// The hand, 2 cm below the middle of the rod at -angle, as it turns the rod towards the floor.
fn hand(angle: f64) -> [f64; 3] {
    [HALF * angle.cos(), HALF * angle.sin() - 0.02, -angle]
}

fn slides_without_jumps<R: Number>() {
    let setup = Setup::new(&[[-HALF, 0.0], [HALF, 0.0]])
        .held_at([0.0, 0.0])
        .springs(STIFFNESS, 1.0)
        .standing(1, [2.0 * HALF * 1f64.cos(), 0.0], -1.0)
        .floor([MU, MU])
        .surface([1.0, 0.0], 0.0, [MU, MU]);
    let mut run = Run::<R>::start(&setup, Evolution::Path, hand(1.0));
    let mut slides = false;
    for pair in [1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2].windows(2) {
        let mut last = run.frame.pose[0];
        for frame in run.lead(hand(pair[1]), FRAMES) {
            let way = (frame.pose[0] - last).abs();
            last = frame.pose[0];
            assert!(
                way < 2.0 * HALF / FRAMES as f64,
                "{} {way} {frame:?}",
                R::NAME
            );
            slides |= way > 0.0;
            if slides {
                for contact in &frame.contacts {
                    let most = -MU * contact.normal;
                    close(
                        R::NAME,
                        contact.friction,
                        most,
                        R::ANALYTIC * STIFFNESS * HALF,
                    );
                }
                assert_eq!(frame.contacts.len(), 2, "{} {frame:?}", R::NAME);
            }
        }
    }
    assert!(slides);
}

#[test]
fn ladder_slides_without_jumps() {
    slides_without_jumps::<f64>();
    slides_without_jumps::<f32>();
    slides_without_jumps::<Fixed>();
}

/// Final position of the foot of a rod whose grip, 1 m to the side, swings from below to above the level of the foot within a
/// number of frames. The load on the floor stays the same; in the middle of the swing, the pull along the floor is greater
/// than at its ends.
fn foot_of_a_swing<R: Number>(stiffness: f64, frames: usize) -> f64 {
    let swing = std::f64::consts::FRAC_PI_6;
    let setup = Setup::rod(1.0)
        .held_at([0.0, -1.0])
        .standing(0, [0.0; 2], std::f64::consts::FRAC_PI_2 - swing)
        .springs(1.0, stiffness)
        .floor([MU, MU]);
    let hand = |part: f64| {
        let angle = std::f64::consts::FRAC_PI_2 + (2.0 * part - 1.0) * swing;
        [swing.cos() - 0.96 * MU, part - 1.5, angle]
    };
    let mut run = Run::<R>::start(&setup, Evolution::Path, hand(0.0));
    run.lead(hand(1.0), frames);
    let [foot] = run.frame.contacts[..] else {
        panic!("one foot: {:?}", run.frame);
    };
    foot.point[0]
}

/// A foot ends at the same position after few frames as after many.
fn ends_alike<R: Number>(end: impl Fn(usize) -> f64, way: f64, few: &[usize]) {
    for &frames in few {
        let same = end(frames);
        // Slips below 2^-19 are not resolved.
        assert!(
            (same - way).abs() < 1e-5,
            "{} {frames}: {same} {way}",
            R::NAME
        );
    }
}

fn slides_in_mid_frame<R: Number>() {
    for stiffness in [10.0, 1000.0] {
        let foot = |frames| foot_of_a_swing::<R>(stiffness, frames);
        let way = foot(1000);
        assert!(way < -0.05, "{way}");
        ends_alike::<R>(foot, way, &[1, 2, 3, 10, 100]);
    }
}

/// A slide that begins and ends within one frame is as long as one over many frames.
#[test]
fn slide_in_mid_frame_is_not_left_out() {
    slides_in_mid_frame::<f64>();
    slides_in_mid_frame::<f32>();
}

/// Final position of a tip that is held 0.3 m away from it and pressed down, while the hand moves 0.5 m along the floor and turns three
/// times: the pull along the floor grows and falls with every turn, and the tip moves whenever the pull exceeds all earlier values.
fn tip_after_turns<R: Number>(frames: usize) -> f64 {
    let setup = Setup::point()
        .held_at([0.3, 0.0])
        .springs(1.0, 1000.0)
        .floor([MU, MU]);
    let mut run = Run::<R>::start(&setup, Evolution::Path, [0.3, -1.0, 0.0]);
    run.lead([0.8, -1.0, 3.0 * std::f64::consts::TAU], frames);
    run.frame.contacts[0].point[0]
}

fn slides_again_and_again<R: Number>() {
    let way = tip_after_turns::<R>(10_000);
    assert!(way > 0.2, "{way}");
    ends_alike::<R>(tip_after_turns::<R>, way, &[1, 2, 3, 4, 5, 7, 10, 30, 100]);
}

/// Slides that begin and end several times within one frame end as they do over many frames.
#[test]
fn slides_that_alternate_in_mid_frame_are_not_left_out() {
    slides_again_and_again::<f64>();
    slides_again_and_again::<f32>();
}
