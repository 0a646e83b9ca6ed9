//! A row of the table: a point that is run as in `stiction run`, and the results that a study needs. SI units, every number with
//! the fewest digits that read back to the same value.

use stiction_core::{StateKind, Status};
use stiction_scene::InputError;
use toml::Value;

use super::plan::{GridPoint, Plan};
use crate::balance::Imbalance;
use crate::summary::Summary;
use stiction_live::input::open_path;
use stiction_live::record::Run;

pub(super) fn header(plan: &Plan, time: bool) -> Vec<String> {
    let mut names = vec!["index".to_owned(), "scene".to_owned()];
    names.extend(plan.axes.iter().map(|axis| axis.key.name().to_owned()));
    names.extend(["status", "frames", "seconds", "slips", "longest_slip"].map(str::to_owned));
    names.extend(StateKind::ALL.map(|state| format!("share_{}", state.name())));
    names.extend(
        [
            "largest_force",
            "largest_moment",
            "residual_force",
            "residual_moment",
        ]
        .map(str::to_owned),
    );
    names.extend(limiting().map(|status| format!("frames_{}", status.name())));
    names.extend(["x", "y", "theta"].map(str::to_owned));
    names.extend(time.then(|| "solver_seconds".to_owned()));
    names
}

pub(super) struct SweepRow {
    pub(super) cells: Vec<String>,
    /// Its scene is refused, as reported by `status`; there are no results.
    pub(super) is_refused: bool,
}

pub(super) fn row(plan: &Plan, point: &GridPoint<'_>, time: bool) -> SweepRow {
    let results = results(plan, point, time);
    let is_refused = results.is_err();
    let mut cells = varied(point);
    match results {
        Ok(results) => {
            cells.push("ok".to_owned());
            cells.extend(results);
        }
        Err(error) => {
            cells.push(error.problem().to_owned());
            cells.resize(header(plan, time).len(), String::new());
        }
    }
    // A row is one line.
    for cell in &mut cells {
        *cell = cell.replace(char::is_control, " ");
    }
    SweepRow { cells, is_refused }
}

/// The columns before `status`.
pub(super) fn varied(point: &GridPoint<'_>) -> Vec<String> {
    let mut row = vec![point.index.to_string(), point.scene.name.clone()];
    row.extend(point.values.iter().map(cell));
    row
}

/// The columns after `status`.
fn results(plan: &Plan, point: &GridPoint<'_>, time: bool) -> Result<Vec<String>, InputError> {
    let (scene, settings) = point.scene_file(plan)?;
    let given = settings.rate.map(|rate| ("run.rate", rate));
    let (path, rate) = open_path(&scene, settings.hand.as_deref(), given)?;
    let mut summary = Summary::new(&Run::of(&scene, settings.number, settings.evolution));
    let (mut largest_moment, mut pose) = (0.0_f64, [0.0; 3]);
    let spent = settings.simulate(&scene, path.frames(rate), |frame| {
        summary.add(&frame);
        largest_moment = largest_moment.max(frame.wrench[2].abs());
        pose = frame.pose;
        Ok::<_, InputError>(())
    })?;
    let digits = |value: f64| match settings.number.is_single() {
        true => format!("{:?}", value as f32),
        false => format!("{value:?}"),
    };
    let seconds = summary.duration();
    let Imbalance { force, moment } = summary.residual.relative();
    let mut row = vec![
        summary.frames.to_string(),
        format!("{seconds:?}"),
        summary.slips.to_string(),
        digits(summary.longest_slip),
    ];
    // A single frame takes no time.
    let share = |spent: f64| if seconds > 0.0 { spent / seconds } else { 0.0 };
    row.extend(summary.seconds.map(|spent| format!("{:?}", share(spent))));
    row.push(format!("{:?}", summary.residual.largest_force()));
    row.push(digits(largest_moment));
    row.extend([force, moment].map(|residual| format!("{residual:?}")));
    let count = |status| summary.limited.get(&status).copied().unwrap_or(0);
    row.extend(limiting().map(|status| count(status).to_string()));
    row.extend(pose.map(digits));
    row.extend(time.then(|| format!("{:?}", spent.as_secs_f64())));
    Ok(row)
}

/// The statuses of frames that were limited.
fn limiting() -> impl Iterator<Item = Status> {
    Status::ALL
        .into_iter()
        .filter(|status| *status != Status::Ok)
}

fn cell(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Float(number) => format!("{number:?}"),
        other => other.to_string(),
    }
}

/// A row as a line of CSV.
pub(super) fn line(cells: &[String]) -> std::io::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(cells)?;
    writer.into_inner().map_err(|error| error.into_error())
}
