//! What a recorded path looks like from the scene: where, how large, how fast, and how it turns.

use stiction_core::Hand;

use super::placement::Placement;
use super::{HandPath, Sample};
use crate::outline;
use crate::written::WrittenScene;

/// The size (m) of a body that is a point: as wide as the hand that holds it.
const HAND_BREADTH: f64 = 0.1;
/// So many samples on average see a turn of a hand that is sampled densely enough to be followed, or more.
pub(super) const STEPS_IN_A_TURN: usize = 4;

/// Changes of the angle from sample to sample.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Turning {
    /// The sum of the changes that are no jumps (rad), and the difference of the largest angle and the least one.
    pub(super) way: f64,
    pub(super) span: f64,
    pub(super) jumps: usize,
    /// The first jump: the times before and after it (s), and its size.
    pub(super) first: Option<(f64, f64, f64)>,
}

impl Turning {
    /// Jumps are changes by more than half a turn.
    pub(super) fn of(samples: &[Sample], half: f64) -> Self {
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
pub(super) struct Seen {
    /// The samples with a pose.
    pub(super) samples: Vec<Sample>,
    pub(super) is_spatial: bool,
    /// The hand that holds the body at its start, with the angle of the body.
    pub(super) home: [f64; 3],
    /// The largest distance of two vertices.
    pub(super) size: f64,
    /// The least distance from the place where the body is held at its start.
    pub(super) nearest: f64,
    /// The extent along x, y and the depth.
    pub(super) spans: [f64; 3],
    /// The length of the path without lost samples.
    pub(super) way: f64,
    pub(super) seconds: f64,
    /// Half of the steps from sample to sample are shorter (s).
    pub(super) step: f64,
    /// When the longest step begins, and how long it is (s).
    pub(super) gap: Option<(f64, f64)>,
}

impl Seen {
    pub(super) fn new(scene: &WrittenScene, path: &HandPath) -> Self {
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
        let pairs = samples.iter().zip(samples.iter().skip(1));
        let steps = pairs.map(|(from, to)| (from.t, to.t - from.t));
        let gap = { steps.clone() }.max_by(|(_, a), (_, b)| a.total_cmp(b));
        let mut steps: Vec<f64> = steps.map(|(_, step)| step).collect();
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
            gap,
            samples,
        }
    }

    /// Whether there are so many samples that steps from one to the next mean something: of a few, each is a keyframe.
    pub(super) fn is_dense(&self) -> bool {
        self.samples.len() > 2 * STEPS_IN_A_TURN
    }

    /// The extent of the path in the plane.
    pub(super) fn extent(&self) -> f64 {
        self.spans[0].hypot(self.spans[1])
    }

    /// The least distance from the body's start (m) if the path is scaled by another factor.
    pub(super) fn nearest_scaled(&self, factor: f64, placement: &Placement) -> f64 {
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

    /// Whether the path begins where the body is held at its start, within a body size.
    pub(super) fn is_in_place(&self) -> bool {
        self.samples.first().is_some_and(|sample| {
            let [x, y] = sample.hand.position;
            (x - self.home[0]).hypot(y - self.home[1]) <= self.size
        })
    }
}

pub(super) fn pose(hand: &Hand<f64>) -> [f64; 3] {
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
    match outline::size(&scene.vertices) {
        0.0 => HAND_BREADTH,
        size => size,
    }
}
