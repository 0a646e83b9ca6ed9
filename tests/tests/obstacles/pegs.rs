//! Pegs put into a hole with a clearance of a thousandth: how an insertion ends by frame does not depend on the number type. Along the path
//! some end in a snap out of a clamped balance, which is not the same in all digits.

use stiction_core::{Evolution, Fixed};
use stiction_tests::obstacles::pegs::Insertion;

/// Insertions of random starts.
const COUNT: u64 = 100;

#[test]
fn insertions_end_alike_in_every_number_type() {
    for number in 0..COUNT {
        let insertion = Insertion::of(number);
        let end = insertion.end::<f64>(Evolution::Frame);
        let words = format!("peg {number}: {end:?}");
        assert_eq!(insertion.end::<f32>(Evolution::Frame), end, "{words}");
        assert_eq!(insertion.end::<Fixed>(Evolution::Frame), end, "{words}");
    }
}
