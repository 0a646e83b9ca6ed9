use stiction_core::{Evolution, Fixed};
use stiction_tests::obstacles::survey::{Kind, look};
fn one<R: stiction_tests::Number>(from: u64, to: u64) {
    for evolution in Evolution::ALL {
        for number in from..to {
            let report = look::<R>((Kind::Worlds, number), evolution);
            let counts: Vec<_> = report
                .statuses
                .iter()
                .filter(|(n, _)| **n != "jammed")
                .collect();
            if !report.unlawful.is_empty() || !counts.is_empty() {
                println!(
                    "{} {} {number}: {} unlawful {:?} {:?}",
                    R::NAME,
                    evolution.name(),
                    report.unlawful.len(),
                    counts,
                    report.unlawful.first()
                );
            }
        }
    }
}
fn main() {
    let a: Vec<u64> = std::env::args()
        .skip(1)
        .map(|a| a.parse().unwrap())
        .collect();
    one::<f64>(a[0], a[1]);
    one::<f32>(a[0], a[1]);
    one::<Fixed>(a[0], a[1]);
}
