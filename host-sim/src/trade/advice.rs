//! The recommendation in words: for a chip and an error, the setting that reaches it at the least cost. The reference is not
//! among them: its error is none by definition.

use super::front;
use super::measure::Row;
use super::place::Place;
use super::table::figure;

/// What is asked of 99 % of some frames.
struct Goal {
    /// Which frames.
    frames: &'static str,
    /// Their error (µm).
    error: fn(&Row) -> f64,
    /// Errors that are asked for, from any to fine (µm).
    levels: &'static [f64],
    /// What to say of errors that no setting reaches.
    unreached: &'static str,
}

const GOALS: [Goal; 2] = [
    Goal {
        frames: "all frames",
        error: |row| row.accuracy.position.most,
        levels: &[f64::INFINITY, 1e4, 1e3, 100.0, 10.0, 1.0],
        unreached: ": slips come earlier or later than those of the reference",
    },
    Goal {
        frames: "the frames in step",
        error: front::error,
        levels: &[1e3, 100.0, 10.0, 1.0],
        unreached: "",
    },
];

/// The cheapest row, per second of motion, among those whose error is small enough.
fn cheapest<'a>(place: Place, rows: &'a [Row], goal: &Goal, allowed: f64) -> Option<&'a Row> {
    let per_second = |row: &Row| place.cost(&row.cost).map(|cost| cost * row.rate);
    rows.iter()
        .filter(|row| !row.is_reference() && (goal.error)(row) <= allowed)
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
        for goal in &GOALS {
            let mut levels = goal.levels.iter().copied().peekable();
            while let Some(coarse) = levels.next() {
                let Some(choice) = cheapest(place, rows, goal, coarse) else {
                    let (asked, why) = (asked(goal, coarse), goal.unreached);
                    sentences.push(format!("On {name}, no setting stays {asked}{why}."));
                    break;
                };
                let mut fine = coarse;
                while let Some(&finer) = levels.peek()
                    && cheapest(place, rows, goal, finer) == Some(choice)
                {
                    fine = finer;
                    levels.next();
                }
                let (asked, choice) = (asked(goal, fine), sentence(place, goal, choice));
                sentences.push(format!("On {name}, {asked}, take {choice}."));
            }
        }
    }
    sentences
}

fn asked(goal: &Goal, allowed: f64) -> String {
    let allowed = match allowed {
        f64::INFINITY => return "at the least cost".to_owned(),
        1000.0.. => format!("{} mm", allowed / 1000.0),
        _ => format!("{allowed} µm"),
    };
    format!("within {allowed} for 99 % of {}", goal.frames)
}

/// The setting, its error, its cost.
fn sentence(place: Place, goal: &Goal, row: &Row) -> String {
    let setting = &row.setting;
    let (unit, cost) = (place.unit(), place.cost(&row.cost).unwrap_or_default());
    let worst = place.worst(&row.cost);
    let worst = worst.map_or(String::new(), |worst| format!(", {worst} in the worst"));
    format!(
        "{}, {}, {} at {} Hz: {} µm, {:.0} % of the frames in step, {cost:.0} {unit} per frame{worst}",
        setting.number.name(),
        setting.evolution.name(),
        setting.dial.name,
        row.rate,
        figure((goal.error)(row)),
        row.accuracy.percent(row.accuracy.in_step),
    )
}
