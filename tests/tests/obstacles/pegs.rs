//! Pegs inserted into a hole with a clearance of a thousandth: the outcome does not depend on the number type.

use stiction_core::{Evolution, Fixed};
use stiction_tests::obstacles::pegs::Insertion;

/// Insertions of random starts.
const COUNT: u64 = 100;

/// By frame, all outcomes agree. Along the path, one in a hundred may differ: whether a slide of two contacts becomes pressed and sticks
/// can depend on the last digits.
#[test]
fn insertions_end_alike_in_every_number_type() {
    let mut others = Vec::new();
    for number in 0..COUNT {
        let insertion = Insertion::of(number);
        for evolution in Evolution::ALL {
            let end = insertion.end::<f64>(evolution);
            let ends = [
                insertion.end::<f32>(evolution),
                insertion.end::<Fixed>(evolution),
            ];
            let words = format!("peg {number}, {}: {end:?}, {ends:?}", evolution.name());
            if evolution == Evolution::Frame {
                assert_eq!(ends, [end; 2], "{words}");
            } else if ends != [end; 2] {
                others.push(words);
            }
        }
    }
    assert!(others.len() as u64 <= COUNT / 100, "{others:#?}");
}
