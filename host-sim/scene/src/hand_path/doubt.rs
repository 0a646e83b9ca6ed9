//! What looks wrong about a recorded path over a scene, and the keys of `[hand]` that mend it: a plane, a unit or an origin that is not the
//! scene's, an angle in degrees, or one that is wrapped to a turn. Nothing here refuses a path.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use stiction_core::{Axis, Hand, Projection};

use super::placement::{AngleUnit, Placement};
use super::{HandPath, Sample};
use crate::scene_file::SceneFile;
use crate::source::InputError;
use crate::written::WrittenScene;

/// The size (m) of a body that is a point: as wide as the hand that holds it.
const HAND_BREADTH: f64 = 0.1;
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
/// An angle that is wrapped jumps once a turn, so seldom in a path that is sampled densely enough to be followed: at most once in so many samples.
const STEPS_IN_A_TURN: usize = 4;
/// The depth changes more than one of the coordinates by this factor if the plane is another one.
const DEEPER: f64 = 4.0;
/// A time between two samples (s) that no tracker takes: a time in milliseconds that is read in seconds is longer.
const SLOWEST: f64 = 0.9;

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

/// The placement with which a recorded path lies over a scene: it mends all doubts, and the first pose is where the body is held at its start.
///
/// # Errors
/// As for [`HandPath::read`].
pub fn fitted(scene: &SceneFile, file: &Path) -> Result<(Placement, String), InputError> {
    let mut placement = scene.hand.placement;
    // One doubt may hide another one: each is mended once at most, and the path read again.
    for _ in 0..4 {
        let path = HandPath::read(file, &placement)?;
        let found = Seen::new(scene, &path).all(&placement);
        let mends = found.into_iter().map(|(mend, _)| mend);
        let is_next = |mend: &Mend| !matches!(mend, Mend::Origin(_) | Mend::Times);
        let Some(mend) = { mends }.find(is_next) else {
            break;
        };
        mend.apply(&mut placement);
    }
    let path = HandPath::read(file, &placement)?;
    let seen = Seen::new(scene, &path);
    Mend::Origin(seen.origin(&placement)).apply(&mut placement);
    let keys = keys(&placement, &scene.hand.placement).join("\n");
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
    lines.push(format!("origin = {:?}", placement.origin));
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

/// Changes of the angle from sample to sample.
#[derive(Clone, Copy, Debug, Default)]
struct Turning {
    /// The sum of the changes that are no jumps (rad), and the difference of the largest angle and the least one.
    way: f64,
    span: f64,
    jumps: usize,
    /// The first jump: the times before and after it (s), and its size.
    first: Option<(f64, f64, f64)>,
}

impl Turning {
    /// Jumps are changes by more than half a turn.
    fn of(samples: &[Sample], half: f64) -> Self {
        let mut all = Self::default();
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for sample in samples {
            let phi = sample.hand.angle.radians();
            (least, most) = (least.min(phi), most.max(phi));
        }
        all.span = (most - least).max(0.0);
        for (from, to) in samples.iter().zip(samples.iter().skip(1)) {
            let change = to.hand.angle.minus(from.hand.angle);
            if change.abs() <= half {
                all.way += change.abs();
                continue;
            }
            all.jumps += 1;
            all.first.get_or_insert((from.t, to.t, change));
        }
        all
    }
}

/// What a path looks like from the scene. Lengths in m.
struct Seen {
    /// The samples with a pose.
    samples: Vec<Sample>,
    is_spatial: bool,
    /// The hand that holds the body at its start, with the angle of the body.
    home: [f64; 3],
    /// The largest distance of two vertices.
    size: f64,
    /// The least distance from the place where the body is held at its start.
    nearest: f64,
    /// The extent along x, y and the depth.
    spans: [f64; 3],
    /// The length of the path without lost samples.
    way: f64,
    seconds: f64,
    /// Half of the steps from sample to sample are shorter (s).
    step: f64,
}

impl Seen {
    fn new(scene: &WrittenScene, path: &HandPath) -> Self {
        let finite = path.samples.iter().filter(|sample| sample.hand.is_finite());
        let samples: Vec<Sample> = finite.copied().collect();
        let home = home(scene);
        let place = |sample: &Sample| {
            let [x, y] = sample.hand.position;
            [x, y, sample.hand.depth]
        };
        let (mut least, mut most) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let (mut nearest, mut way) = (f64::INFINITY, 0.0);
        let mut before: Option<[f64; 3]> = None;
        for at in samples.iter().map(place) {
            nearest = nearest.min((at[0] - home[0]).hypot(at[1] - home[1]));
            for axis in 0..3 {
                least[axis] = least[axis].min(at[axis]);
                most[axis] = most[axis].max(at[axis]);
            }
            way += before.map_or(0.0, |from| (at[0] - from[0]).hypot(at[1] - from[1]));
            before = Some(at);
        }
        let mut steps: Vec<f64> = (samples.iter().zip(samples.iter().skip(1)))
            .map(|(from, to)| to.t - from.t)
            .collect();
        steps.sort_by(f64::total_cmp);
        Self {
            is_spatial: path.is_spatial,
            home,
            size: size(scene),
            nearest,
            spans: [0, 1, 2].map(|axis| (most[axis] - least[axis]).max(0.0)),
            way,
            seconds: path.seconds(),
            step: steps.get(steps.len() / 2).copied().unwrap_or(0.0),
            samples,
        }
    }

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
        let all = [self.times(), plane, scale, degrees, jumps, origin];
        all.into_iter().flatten().collect()
    }

    /// Whether there are so many samples that steps from one to the next mean something: of a few, each is a keyframe.
    fn is_dense(&self) -> bool {
        self.samples.len() > 2 * STEPS_IN_A_TURN
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

    /// The extent of the path in the plane.
    fn extent(&self) -> f64 {
        self.spans[0].hypot(self.spans[1])
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

    /// The least distance from the body's start (m) if the path is scaled by another factor.
    fn nearest_scaled(&self, factor: f64, placement: &Placement) -> f64 {
        let distance = |sample: &Sample| {
            let away = [0, 1].map(|axis| {
                let (at, origin) = (sample.hand.position[axis], placement.origin[axis]);
                (at - origin) * factor + origin - self.home[axis]
            });
            away[0].hypot(away[1])
        };
        self.samples
            .iter()
            .map(distance)
            .fold(f64::INFINITY, f64::min)
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
                "the hand is never nearer than {:.3} m, {:.0} body sizes, to where the body is held at its start: `hand.origin = {origin:?}` begins there, and so does --fit",
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

fn pose(hand: &Hand<f64>) -> [f64; 3] {
    let [x, y] = hand.position;
    [x, y, hand.angle.radians()]
}

/// Where the body is held at its start (m), at its centre if nothing else is said, and its angle (rad).
fn home(scene: &WrittenScene) -> [f64; 3] {
    let [x, y, theta] = scene.start;
    let count = scene.vertices.len().max(1) as f64;
    let centre = [0, 1].map(|axis| scene.vertices.iter().map(|v| v[axis]).sum::<f64>() / count);
    let [gx, gy] = scene.holding_point.unwrap_or(centre);
    let (sin, cos) = theta.sin_cos();
    [x + cos * gx - sin * gy, y + sin * gx + cos * gy, theta]
}

fn size(scene: &WrittenScene) -> f64 {
    let distances = scene.vertices.iter().flat_map(|a| {
        let distance = move |b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        scene.vertices.iter().map(distance)
    });
    match distances.fold(0.0, f64::max) {
        0.0 => HAND_BREADTH,
        size => size,
    }
}
