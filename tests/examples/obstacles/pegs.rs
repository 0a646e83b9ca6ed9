//! Insertions of a peg from random starts: how many end in f32 and in fixed point as they do in f64.

use std::collections::BTreeMap;
use stiction_core::{Evolution, Fixed};
use stiction_tests::obstacles::pegs::Insertion;

/// Runs insertions 0 .. `count`.
pub(crate) fn pegs(count: u64, evolution: Evolution) {
    let mut ends: BTreeMap<_, u64> = BTreeMap::new();
    let mut same = [0_u64; 2];
    for number in 0..count {
        let insertion = Insertion::of(number);
        let exact = insertion.end::<f64>(evolution);
        let others = [
            insertion.end::<f32>(evolution),
            insertion.end::<Fixed>(evolution),
        ];
        *ends.entry(exact.name()).or_default() += 1;
        for (same, other) in same.iter_mut().zip(others) {
            *same += u64::from(other == exact);
        }
        if others.iter().any(|other| *other != exact) {
            let [f32, fixed] = others.map(|end| end.name());
            println!(
                "peg {number}: f64 {}, f32 {f32}, fixed {fixed}",
                exact.name()
            );
        }
    }
    let [f32, fixed] = same;
    let name = evolution.name();
    println!("{count} insertions, {name}: f64 {ends:?}; the same in f32 {f32}, in fixed {fixed}");
}
