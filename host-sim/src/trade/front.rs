//! The settings that no other one beats in both cost and error, and their picture: error against the cost of a frame, and against
//! the cost of a second of motion.

use super::measure::Row;
use super::place::Place;
use crate::plot::fronts::{Fronts, Panel, Point};
use crate::plot::style::number_color;
use stiction_core::Evolution;
use stiction_live::number::Number;

/// The position error (µm) below which settings are equally good.
pub(super) const FLOOR: f64 = 1e-3;

/// The floor of a picture (µm): the decade below that of the least error in it that is distinguished from 0.
fn floor(rows: &[Row]) -> f64 {
    let errors = rows.iter().map(error).filter(|error| *error > 0.0);
    let least = errors.fold(f64::INFINITY, f64::min);
    if least.is_finite() {
        FLOOR.max(10_f64.powf(least.log10().floor() - 1.0))
    } else {
        FLOOR
    }
}

/// The error of a front: the bound (µm) that 99 % of all frames satisfy.
pub(super) fn error(row: &Row) -> f64 {
    row.accuracy.position.p99
}

/// Selects from pairs (cost, error) those of which no other one has less of one and not more of the other.
pub(super) fn best(points: &[(f64, f64)]) -> Vec<bool> {
    let beats = |a: &(f64, f64), b: &(f64, f64)| a.0 <= b.0 && a.1 <= b.1 && a != b;
    let unbeaten = |b| !points.iter().any(|a| beats(a, b));
    points.iter().map(unbeaten).collect()
}

/// The picture for a place: all settings with a cost there, except the reference.
pub(super) fn picture(place: Place, rows: &[Row], machine: &str) -> Fronts {
    let counted = |row: &&Row| !row.is_reference() && place.cost(&row.cost).is_some();
    let rows: Vec<Row> = rows.iter().filter(counted).copied().collect();
    let numbers = Number::ALL
        .into_iter()
        .filter(|number| rows.iter().any(|row| row.setting.number == *number));
    let unit = place.unit();
    let where_ = match place {
        Place::Host => machine.to_owned(),
        Place::Chip(_) => format!("{}, emulated", place.name()),
    };
    let (per_second, scale) = match place {
        Place::Host => ("µs".to_owned(), 1e-3),
        Place::Chip(_) => (unit.to_owned(), 1.0),
    };
    Fronts {
        title: format!("Error and cost of every setting: {where_}"),
        colors: numbers
            .map(|number| (number_color(number), number.name()))
            .collect(),
        marks: Evolution::ALL.map(Evolution::name),
        error: "position error, 99 % of all frames [µm]".to_owned(),
        floor: floor(&rows),
        panels: vec![
            panel(place, &rows, format!("{unit} per frame, mean"), |_| 1.0),
            panel(
                place,
                &rows,
                format!("{per_second} per second of motion"),
                |row| scale * row.rate,
            ),
        ],
    }
}

fn panel(place: Place, rows: &[Row], label: String, factor: impl Fn(&Row) -> f64) -> Panel {
    let counted: Vec<_> = (rows.iter())
        .filter_map(|row| Some((row, place.cost(&row.cost)? * factor(row))))
        .collect();
    let places: Vec<_> = (counted.iter())
        .map(|(row, cost)| (*cost, error(row).max(FLOOR)))
        .collect();
    let points = counted
        .iter()
        .zip(best(&places))
        .map(|((row, cost), best)| Point {
            x: *cost,
            y: error(row),
            color: number_color(row.setting.number),
            filled: row.setting.evolution == Evolution::Path,
            label: format!("{} Hz, {}", row.rate, row.setting.memory.name),
            best,
        });
    Panel {
        label,
        points: points.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_front_holds_what_nothing_beats() {
        let points = [(1.0, 5.0), (2.0, 5.0), (2.0, 3.0), (3.0, 4.0), (9.0, 1.0)];
        assert_eq!(best(&points), [true, false, true, false, true]);
        assert_eq!(best(&[(1.0, 1.0), (1.0, 1.0)]), [true, true]);
    }
}
