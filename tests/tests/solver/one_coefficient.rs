//! mu_s = mu_d: a slide has no jumps. A rod between floor and wall is turned down by the hand; once it slides, both contacts
//! stay at the edge of their cones and the rod goes a short way in every frame.

use stiction_core::{Evolution, Fixed};
use stiction_tests::run::Run;
use stiction_tests::{Number, Setup, close};

const MU: f64 = 0.5;
/// Half the rod (m).
const HALF: f64 = 0.15;
/// k_h (N/m)
const STIFFNESS: f64 = 500.0;
/// Of a tenth of a radian.
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
