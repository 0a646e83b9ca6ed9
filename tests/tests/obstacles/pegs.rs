//! Pegs put into a hole with a clearance of a thousandth: how an insertion ends does not depend on the number type.

use stiction_core::{Evolution, Fixed};
use stiction_tests::obstacles::pegs::Insertion;

/// Insertions of random starts.
const COUNT: u64 = 100;

/// With mu_s > mu_d it depends on where a slide of two contacts becomes pressed and sticks, a matter of few digits. With equal coefficients
/// some end in a snap out of a clamped balance, which is not the same in all digits.
#[test]
fn insertions_end_alike_in_every_number_type() {
    let mut looked = 0;
    for number in 0..COUNT {
        let insertion = Insertion::of(number);
        let [mu_s, mu_d] = insertion.among.obstacles[0].friction;
        for evolution in Evolution::ALL {
            if evolution == Evolution::Path && mu_s <= mu_d {
                continue;
            }
            let end = insertion.end::<f64>(evolution);
            let words = format!("peg {number}, {}: {end:?}", evolution.name());
            assert_eq!(insertion.end::<f32>(evolution), end, "{words}");
            assert_eq!(insertion.end::<Fixed>(evolution), end, "{words}");
            looked += 1;
        }
    }
    assert!(looked > COUNT * 3 / 2, "{looked}");
}
