//! `[hand]`: keyframes or a recorded path, its rate and its placement in the scene.

use std::path::{Path, PathBuf};

use crate::check::Check;
use crate::document::{Hand, Numbers};
use crate::hand_path::{AngleUnit, HandPath, Placed, Placement, Row, RowPose, parse_plane};
use crate::source::InputError;

/// The source of the hand's motion.
#[derive(Clone, Debug)]
pub enum Motion {
    /// Straight lines between poses in the scene file.
    Keyframes(HandPath),
    /// A recorded path in a separate file.
    Recorded(PathBuf),
}

/// `[hand]`, checked.
#[derive(Clone, Debug)]
pub struct HandSection {
    /// Frames per second (Hz) > 0.
    pub rate: Option<f64>,
    /// The motion; `None` if it has to be provided separately.
    pub motion: Option<Motion>,
    /// How a motion is placed in the scene.
    pub placement: Placement,
}

impl HandSection {
    /// Checks the section; a path is relative to the scene file.
    pub(super) fn new(check: Check<'_>, hand: &Hand) -> Result<Self, InputError> {
        let rate = hand
            .rate
            .as_ref()
            .map(|rate| check.positive("hand.rate", rate));
        let placement = placement(check, hand)?;
        Ok(Self {
            rate: rate.transpose()?,
            motion: motion(check, hand, &placement)?,
            placement,
        })
    }
}

fn motion(
    check: Check<'_>,
    hand: &Hand,
    placement: &Placement,
) -> Result<Option<Motion>, InputError> {
    match (&hand.keyframes, &hand.path) {
        (Some(_), Some(path)) => Err(check.source().error_at(
            path.span().start,
            "`hand.path` is given in addition to `hand.keyframes`, allowed: one of the two",
        )),
        (None, None) => Ok(None),
        (None, Some(path)) if path.get_ref().is_empty() => {
            Err(check.error("hand.path", path, "the name of a file"))
        }
        (None, Some(path)) => {
            let folder = check.source().file().parent().unwrap_or(Path::new(""));
            Ok(Some(Motion::Recorded(folder.join(path.get_ref()))))
        }
        (Some(list), None) => {
            let rows = keyframes(check, list.get_ref())?;
            if rows.is_empty() {
                return Err(check.error("hand.keyframes", list, "at least one keyframe"));
            }
            let error = |line, problem: &str| check.source().error_in_line(line, problem);
            let mut placed = Placed::new(placement).map_err(|p| check.source().error(p))?;
            for row in &rows {
                placed.add(row).map_err(|p| error(row.line, &p))?;
            }
            Ok(Some(Motion::Keyframes(HandPath::new(placed.samples))))
        }
    }
}

fn keyframes(check: Check<'_>, list: &[Numbers]) -> Result<Vec<Row>, InputError> {
    let mut rows: Vec<Row> = Vec::with_capacity(list.len());
    let (mut line, mut offset) = (1, 0);
    for (i, given) in list.iter().enumerate() {
        let key = format!("hand.keyframes[{i}]");
        let start = given.span().start;
        line += check.source().text()[offset..start].matches('\n').count();
        offset = start;
        let row = keyframe(check, &key, given, line)?;
        if rows.last().is_some_and(|last| row.t <= last.t) {
            return Err(check.error(
                &key,
                given,
                "a time later than that of the previous keyframe",
            ));
        }
        rows.push(row);
    }
    Ok(rows)
}

fn keyframe(check: Check<'_>, key: &str, given: &Numbers, line: usize) -> Result<Row, InputError> {
    let ([t, pose @ ..], held) = if given.get_ref().len() == 5 {
        let [t, x, y, phi, held] = check.numbers(key, given, "t, x, y, phi and held")?;
        if held != 0.0 && held != 1.0 {
            return Err(check.error(key, given, "0 or 1 for held"));
        }
        ([t, x, y, phi], held == 1.0)
    } else {
        (
            check.numbers(key, given, "t, x, y and phi, or 5 with held")?,
            true,
        )
    };
    Ok(Row {
        line,
        t,
        pose: RowPose::Planar(pose),
        unit: None,
        held,
    })
}

fn placement(check: Check<'_>, hand: &Hand) -> Result<Placement, InputError> {
    let mut placement = Placement {
        limit: check.limit(),
        ..Placement::default()
    };
    if let Some(plane) = &hand.plane {
        placement.axes = parse_plane(plane.get_ref()).ok_or_else(|| {
            let allowed = "two different axes of x, y and z, each with an optional minus, as \"xy\" or \"-xz\"";
            check.error("hand.plane", plane, allowed)
        })?;
    }
    if let Some(scale) = &hand.scale {
        placement.scale = check.positive("hand.scale", scale)?;
    }
    if let Some(origin) = &hand.origin {
        placement.origin = check.numbers("hand.origin", origin, "x, y and phi")?;
    }
    if let Some(angle) = &hand.angle {
        let unit = AngleUnit::ALL
            .iter()
            .find(|(name, _)| name == angle.get_ref());
        let (_, unit) =
            unit.ok_or_else(|| check.error("hand.angle", angle, "\"radians\" or \"degrees\""))?;
        placement.angle = *unit;
    }
    placement.unwrap = hand.unwrap.as_ref().is_some_and(|unwrap| *unwrap.get_ref());
    Ok(placement)
}
