//! What looks wrong about a recorded path over a scene, and the keys of `[hand]` that mend it: a plane, a unit or an origin that is not the
//! scene's, an angle in degrees, or one that is wrapped to a turn. Nothing here refuses a path.

use std::f64::consts::{PI, TAU};
use std::mem::discriminant;
use std::path::Path;

use stiction_core::{Axis, Projection};

use super::placement::{AngleUnit, Placement};
use super::seen::{STEPS_IN_A_TURN, Seen, Turning, pose};
use super::{HandPath, Sample};
use crate::scene_file::SceneFile;
use crate::source::InputError;

/// A hand that is farther than this (body sizes) from the body's start in every sample holds nothing.
const FAR: f64 = 5.0;
/// No path of a hand is longer (m) than a person with outstretched arms is wide, twice; or, around a large body, than these body sizes.
const WIDEST: (f64, f64) = (4.0, 40.0);
/// No tracked hand is farther away (m) than a large hall is long; or, with a large body, than these body sizes.
const FARTHEST: (f64, f64) = (30.0, 150.0);
/// A hand that throws a ball reaches some 40 m/s for an instant; none moves this fast on average (m/s).
const FASTEST: f64 = 10.0;
/// Nobody turns an object by more than a turn, and by a turn in each second on average (rad/s).
const FASTEST_TURN: f64 = TAU;
/// The depth changes more than one of the coordinates by this factor if the plane is another one.
const DEEPER: f64 = 4.0;
/// A time between two samples (s) that no tracker takes: a time in milliseconds that is read in seconds is longer.
const SLOWEST: f64 = 0.9;
/// A time between two samples that is more than so many of the usual ones is a gap: samples are missing, not late.
const LONG_GAP: f64 = 10.0;

/// A key of `[hand]` and its value that mends a path.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mend {
    Plane([Axis; 2]),
    Scale(f64),
    Degrees,
    Unwrap,
    Origin([f64; 3]),
    /// The times of the file itself.
    Times,
}

impl Mend {
    const fn apply(self, placement: &mut Placement) {
        match self {
            Self::Plane(axes) => placement.axes = axes,
            Self::Scale(scale) => placement.scale = scale,
            Self::Degrees => placement.angle = AngleUnit::Degrees,
            Self::Unwrap => placement.unwrap = true,
            Self::Origin(origin) => placement.origin = origin,
            Self::Times => {}
        }
    }
}

/// Doubts about a path that was read from a file: sentences, each with the key that mends it. Empty if it looks like the hand of the scene.
pub fn doubts(scene: &SceneFile, path: &HandPath) -> Vec<String> {
    let seen = Seen::new(scene, path);
    let found = seen.all(&scene.hand.placement).into_iter();
    found.map(|(_, text)| text).collect()
}

/// The placement with which a recorded path lies over a scene, and the lines of `[hand]` that it takes: it mends all doubts, and the path begins
/// where the body is held at its start. A path that begins within a body size of it stays where it is.
///
/// # Errors
/// As for [`HandPath::read`].
pub fn fitted(scene: &SceneFile, file: &Path) -> Result<(Placement, Vec<String>), InputError> {
    let (mut placement, mut mended) = (scene.hand.placement, Vec::new());
    // One doubt may hide another one: each is mended once at most, and the path read again.
    loop {
        let path = HandPath::read(file, &placement)?;
        let found = Seen::new(scene, &path).all(&placement);
        let mends = found.into_iter().map(|(mend, _)| mend);
        let is_next = |mend: &Mend| {
            let is_other = !matches!(mend, Mend::Origin(_) | Mend::Times);
            is_other && !mended.contains(&discriminant(mend))
        };
        let Some(mend) = { mends }.find(is_next) else {
            break;
        };
        mended.push(discriminant(&mend));
        mend.apply(&mut placement);
    }
    let path = HandPath::read(file, &placement)?;
    let seen = Seen::new(scene, &path);
    if !seen.is_in_place() {
        Mend::Origin(seen.origin(&placement)).apply(&mut placement);
    }
    let keys = keys(&placement, &scene.hand.placement);
    Ok((placement, keys))
}

/// The lines of `[hand]` for a placement that differs from another one.
fn keys(placement: &Placement, before: &Placement) -> Vec<String> {
    let mut lines = Vec::new();
    if placement.axes != before.axes {
        lines.push(format!("plane = {:?}", plane(placement.axes)));
    }
    if placement.scale != before.scale {
        lines.push(format!("scale = {:?}", placement.scale));
    }
    if placement.angle != before.angle {
        lines.push("angle = \"degrees\"".to_owned());
    }
    if placement.unwrap != before.unwrap {
        lines.push("unwrap = true".to_owned());
    }
    if placement.origin != before.origin {
        lines.push(format!("origin = {:?}", placement.origin));
    }
    lines
}

/// The name of a plane, as `hand.plane` has it.
fn plane(axes: [Axis; 2]) -> String {
    let name = |axis: Axis| {
        let minus = if axis.negative { "-" } else { "" };
        let letter = ["x", "y", "z"].get(axis.index).copied();
        format!("{minus}{}", letter.unwrap_or_default())
    };
    axes.map(name).concat()
}

impl Seen {
    /// All doubts in the order in which they are to be mended.
    fn all(&self, placement: &Placement) -> Vec<(Mend, String)> {
        let plane = self.is_spatial.then(|| self.plane(placement)).flatten();
        let scale = self.scale(placement);
        let origin = match scale {
            None => self.far(placement),
            // Where the path is follows from its unit.
            Some(_) => None,
        };
        let angles = match self.is_spatial {
            true => [None, None],
            false => self.angles(placement),
        };
        let [degrees, jumps] = angles;
        let all = [
            self.times(),
            self.gap(),
            self.zeros(placement),
            plane,
            scale,
            degrees,
            jumps,
            origin,
        ];
        all.into_iter().flatten().collect()
    }

    fn times(&self) -> Option<(Mend, String)> {
        (self.is_dense() && self.step > SLOWEST).then(|| {
            let text = format!(
                "the samples are {:.3} s apart: if the times are in ms, the column is to be named `t [ms]`",
                self.step
            );
            (Mend::Times, text)
        })
    }

    fn gap(&self) -> Option<(Mend, String)> {
        let (since, seconds) = self.gap?;
        (self.is_dense() && seconds > LONG_GAP * self.step).then(|| {
            let text = format!(
                "no samples for {seconds:.3} s from t = {since} s: the hand moves straight on between them"
            );
            (Mend::Times, text)
        })
    }

    /// Samples of nothing but zeros, as some trackers write what they have lost: the hand jumps there.
    fn zeros(&self, placement: &Placement) -> Option<(Mend, String)> {
        let is_zero = |sample: &Sample| pose(&sample.hand) == placement.origin;
        let jump = |(from, to): (&Sample, &Sample)| {
            let [ax, ay] = from.hand.position;
            let [bx, by] = to.hand.position;
            (
                to.t,
                (bx - ax).hypot(by - ay),
                is_zero(to) && !is_zero(from),
            )
        };
        let pairs = self.samples.iter().zip(self.samples.iter().skip(1));
        let is_jump = |(_, way, is_lost): &(f64, f64, bool)| *is_lost && *way > self.size / 2.0;
        let mut jumps = pairs.map(jump).filter(is_jump);
        let (t, way, _) = jumps.next().filter(|_| self.is_dense())?;
        let more = match jumps.count() {
            0 => String::new(),
            1 => ", and once more".to_owned(),
            more => format!(", and {more} times more"),
        };
        let text = format!(
            "the hand jumps by {way:.3} m to x = y = phi = 0 at t = {t} s{more}: a lost sample is to be empty"
        );
        Some((Mend::Times, text))
    }

    fn plane(&self, placement: &Placement) -> Option<(Mend, String)> {
        let [x, y, depth] = self.spans;
        if depth <= DEEPER * x.min(y) || depth <= self.size / 2.0 {
            return None;
        }
        let [a, b] = placement.axes;
        let other = Axis {
            index: 3 - a.index - b.index,
            negative: false,
        };
        let axes = if y <= x { [a, other] } else { [other, b] };
        Projection::<f64>::new(axes)?;
        let text = format!(
            "the hand moves {depth:.3} m across the plane of the scene, but only {x:.3} m along its x and {y:.3} m along its y: another plane, as `hand.plane = {:?}`",
            plane(axes)
        );
        Some((Mend::Plane(axes), text))
    }

    fn scale(&self, placement: &Placement) -> Option<(Mend, String)> {
        let beyond = |(metres, sizes): (f64, f64)| metres.max(sizes * self.size);
        let speed = if self.seconds > 0.0 {
            self.way / self.seconds
        } else {
            0.0
        };
        let what = if self.nearest > beyond(FARTHEST) {
            format!("is never nearer than {:.3e} m to the body", self.nearest)
        } else if self.extent() > beyond(WIDEST) {
            format!("moves over {:.3e} m", self.extent())
        } else if speed > FASTEST {
            format!("moves at {speed:.3e} m/s on average")
        } else {
            return None;
        };
        // The longest unit with which it is a hand.
        let fits = |unit: &&(f64, &str)| {
            let near = self.nearest_scaled(unit.0, placement) <= FAR * self.size;
            near && unit.0 * self.extent() <= beyond(WIDEST) && unit.0 * speed <= FASTEST
        };
        const UNITS: [(f64, &str); 2] = [(0.01, "centimetres"), (0.001, "millimetres")];
        let [_, finest] = &UNITS;
        let (unit, name) = UNITS.iter().find(fits).unwrap_or(finest);
        let scale = placement.scale * unit;
        let text = format!("the hand {what}: {name}, which need `hand.scale = {scale}`");
        Some((Mend::Scale(scale), text))
    }

    /// Degrees, and jumps by a turn.
    fn angles(&self, placement: &Placement) -> [Option<(Mend, String)>; 2] {
        let turning = Turning::of(&self.samples, PI);
        let degrees = match placement.angle {
            AngleUnit::Radians => self.degrees(&turning),
            AngleUnit::Degrees => None,
        };
        let is_seldom = self.is_dense() && turning.jumps * STEPS_IN_A_TURN <= self.samples.len();
        let unwrap = turning.first.filter(|_| is_seldom && !placement.unwrap);
        let unwrap = unwrap.map(|(from, to, change)| {
            let count = match turning.jumps {
                1 => String::new(),
                jumps => format!(", the first of {jumps} jumps"),
            };
            let text = format!(
                "phi jumps by {change:.3} rad between t = {from} s and {to} s{count}: an angle that is wrapped to a turn needs `hand.unwrap = true`"
            );
            (Mend::Unwrap, text)
        });
        [degrees, unwrap]
    }

    fn degrees(&self, turning: &Turning) -> Option<(Mend, String)> {
        let first = self.samples.first()?.hand.angle.radians();
        let is_apart = first.abs() > TAU && (first - self.home[2]).abs() > PI;
        let is_fast = turning.span > TAU && turning.way > FASTEST_TURN * self.seconds;
        let is_torn = self.is_dense() && turning.jumps * STEPS_IN_A_TURN > self.samples.len();
        let what = if is_fast || is_torn {
            format!(
                "turns over {:.1} turns, {:.1} turns in all, in {:.3} s",
                turning.span / TAU,
                turning.way / TAU,
                self.seconds
            )
        } else if is_apart {
            format!(
                "begins {:.1} turns from the angle of the body",
                (first - self.home[2]).abs() / TAU
            )
        } else {
            return None;
        };
        let text = format!("the hand {what}: degrees, which need `hand.angle = \"degrees\"`");
        Some((Mend::Degrees, text))
    }

    fn far(&self, placement: &Placement) -> Option<(Mend, String)> {
        (self.nearest > FAR * self.size).then(|| {
            let origin = self.origin(placement);
            let text = format!(
                "the hand is never nearer than {:.3} m, {:.0} body sizes, to where the body is held at its start: `hand.origin = {origin:?}` begins there, as does a path that is fitted (--fit, in Python fit=True)",
                self.nearest,
                self.nearest / self.size
            );
            (Mend::Origin(origin), text)
        })
    }

    /// The origin with which the first pose holds the body at its start.
    fn origin(&self, placement: &Placement) -> [f64; 3] {
        let first = self
            .samples
            .first()
            .map_or(self.home, |sample| pose(&sample.hand));
        std::array::from_fn(|i| {
            // A rounded number is easier to read, and a nanometre does not matter.
            let place = placement.origin[i] + self.home[i] - first[i];
            (place * 1e9).round() / 1e9
        })
    }
}
