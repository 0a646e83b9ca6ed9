//! The recommendation in words: for a chip and an error, the setting that reaches it at the least cost.

use super::front::{Place, error};
use super::measure::Row;
use super::table::figure;

/// Errors (µm) that are asked for, from any to fine.
const ERRORS: [f64; 6] = [f64::INFINITY, 1e4, 1e3, 100.0, 10.0, 1.0];

/// The cheapest row, per second of motion, among those whose error is small enough.
pub(super) fn cheapest(place: Place, rows: &[Row], allowed: f64) -> Option<&Row> {
    let per_second = |row: &Row| place.cost(&row.cost).map(|cost| cost * row.rate);
    rows.iter()
        .filter(|row| error(row) <= allowed)
        .filter_map(|row| Some((row, per_second(row)?)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(row, _)| row)
}

/// Sentences, a place after the other. Rows over all scenes.
pub(super) fn advice(rows: &[Row], machine: &str) -> Vec<String> {
    let mut sentences = Vec::new();
    for place in Place::of(rows) {
        let name = match place {
            Place::Host => format!("this computer ({machine})"),
            Place::Chip(_) => place.name().to_owned(),
        };
        let mut errors = ERRORS.into_iter().peekable();
        while let Some(coarse) = errors.next() {
            let choice = cheapest(place, rows, coarse);
            let mut fine = coarse;
            while let Some(&finer) = errors.peek()
                && cheapest(place, rows, finer) == choice
            {
                fine = finer;
                errors.next();
            }
            sentences.push(sentence(place, &name, fine, choice));
        }
    }
    sentences
}

fn sentence(place: Place, name: &str, allowed: f64, choice: Option<&Row>) -> String {
    let allowed = match allowed {
        f64::INFINITY => "at the least cost of all".to_owned(),
        1000.0.. => format!("for 99 % of the frames within {} mm", allowed / 1000.0),
        _ => format!("for 99 % of the frames within {allowed} µm"),
    };
    let Some(row) = choice else {
        return format!("On {name}, {allowed}, there is no setting.");
    };
    let setting = &row.setting;
    let cost = place.cost(&row.cost).unwrap_or_default();
    format!(
        "On {name}, {allowed}, take {}, {}, {} at {} Hz: {} µm, {} mrad, {} {} per frame.",
        setting.number.name(),
        setting.evolution_name(),
        setting.dial.name,
        row.rate,
        figure(row.accuracy.position.most),
        figure(row.accuracy.angle.most),
        figure(cost),
        place.unit(),
    )
}
