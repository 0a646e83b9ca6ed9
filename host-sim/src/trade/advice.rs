//! The recommendation in words: for a chip and an error, the setting that reaches it at the least cost. The reference is
//! excluded: its error is zero by definition. So is any memory length other than the default: it is another law of the scene.

use super::front::error;
use super::measure::Row;
use super::place::Place;
use super::setting::Memory;
use super::table::figure;

/// Errors that 99 % of all frames may have, from any to fine (µm).
const LEVELS: [f64; 6] = [f64::INFINITY, 1e4, 1e3, 100.0, 10.0, 1.0];

/// The cheapest row, per second of motion, among those with a sufficiently small error.
fn cheapest(place: Place, rows: &[Row], allowed: f64) -> Option<&Row> {
    let per_second = |row: &Row| place.cost(&row.cost).map(|cost| cost * row.rate);
    rows.iter()
        .filter(|row| !row.is_reference() && row.setting.memory == Memory::DEFAULT)
        .filter(|row| error(row) <= allowed)
        .filter_map(|row| Some((row, per_second(row)?)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(row, _)| row)
}

/// Sentences, one place after the other, from rows over all scenes.
pub(super) fn advice(rows: &[Row], machine: &str) -> Vec<String> {
    let mut sentences = Vec::new();
    for place in Place::of(rows) {
        let name = match place {
            Place::Host => format!("this computer ({machine})"),
            Place::Chip(_) => place.name().to_owned(),
        };
        let mut levels = LEVELS.into_iter().peekable();
        while let Some(coarse) = levels.next() {
            let Some(choice) = cheapest(place, rows, coarse) else {
                sentences.push(format!("On {name}, no setting stays {}.", asked(coarse)));
                break;
            };
            let mut fine = coarse;
            while let Some(&finer) = levels.peek()
                && cheapest(place, rows, finer) == Some(choice)
            {
                fine = finer;
                levels.next();
            }
            let (asked, choice) = (asked(fine), sentence(place, choice));
            sentences.push(format!("On {name}, {asked}, take {choice}."));
        }
    }
    sentences
}

fn asked(allowed: f64) -> String {
    let allowed = match allowed {
        f64::INFINITY => return "at the least cost".to_owned(),
        1000.0.. => format!("{} mm", allowed / 1000.0),
        _ => format!("{allowed} µm"),
    };
    format!("within {allowed} for 99 % of all frames")
}

/// The setting, its error, its cost.
fn sentence(place: Place, row: &Row) -> String {
    let setting = &row.setting;
    let (unit, cost) = (place.unit(), place.cost(&row.cost).unwrap_or_default());
    let worst = place.worst(&row.cost);
    let worst = worst.map_or(String::new(), |worst| format!(", {worst} in the worst"));
    format!(
        "{}, {} at {} Hz: {} µm, {cost:.0} {unit} per frame{worst}",
        setting.number.name(),
        setting.evolution.name(),
        row.rate,
        figure(error(row)),
    )
}
