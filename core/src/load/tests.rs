//! Force, lever and couple count together: for what a number type represents, and in the magnitudes from which roundings are computed.

use super::*;
use crate::fixtures::{Random, loads, unloaded};

mod sliding;

/// The pull on the lever and the couple together, each with either sign, up to what the number type represents; also the square of the
/// lever alone, which is the moment of a foot that slides to below the holding point.
#[test]
fn load_is_representable_together_with_the_couple() {
    let most = <f64 as Real>::LOAD;
    for (pull, couple) in loads() {
        let hold = Load {
            couple: couple * most,
            hold: Vec2::new(0.0, pull * most),
            ..unloaded()
        };
        let lever = Load {
            lever: Vec2::new(0.0, libm::sqrt(pull.abs() * most)),
            hold: Vec2::ZERO,
            ..hold
        };
        let fits = pull.abs() + couple.abs() <= 1.0;
        assert_eq!(hold.is_representable(), fits, "{pull} {couple}");
        for load in [hold, lever] {
            assert_eq!(load.is_representable_sliding(), fits, "{pull} {couple}");
        }
    }
}

/// No point within one body size of the holding point moves farther than the hand moves and turns; the bound is larger by an eighth at
/// most.
#[test]
fn sizes_are_those_of_all_parts_together() {
    let mut random = Random(9);
    for _ in 0..1000 {
        let (hand, lever, force) = (random.vector(), random.vector(), random.vector());
        let (turn, couple) = (random.next(), random.next());
        let size = Displacement { hand, turn }.size();
        let all = hand.length() + turn.abs();
        assert!(size >= all && size <= 1.125 * all, "{size} {all}");
        let load = Load {
            force,
            lever,
            couple,
            ..unloaded()
        };
        let (size, all) = (load.size(), force.length() + lever.length() + couple.abs());
        assert!(size >= all && size <= 1.125 * all, "{size} {all}");
    }
}
