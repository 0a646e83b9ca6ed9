//! A scene and a hand, their mirror image, the same hand at other rates.

use stiction_tests::obstacles::{Among, Obstacle};
use stiction_tests::run::polyline;

/// A scene and the hand's poses through it.
#[derive(Clone, Debug)]
pub struct Case {
    /// The scene.
    pub among: Among,
    /// x, y (m), phi (rad) of the hand, frame by frame; at least one.
    pub hands: Vec<[f64; 3]>,
    /// The hand as straight lines, if it is known: t (s), x, y (m), phi (rad).
    pub keyframes: Vec<[f64; 4]>,
    /// A scene in which the body moves the same, because its obstacles are one half-plane.
    pub twin: Option<Among>,
    /// The scene with tops exactly level that differ by less than a touch: what a solver may take for one floor, the judge may, too.
    pub level: Option<Among>,
}

impl Case {
    /// A case whose hand is known frame by frame.
    pub fn new(among: Among, hands: Vec<[f64; 3]>) -> Self {
        Self {
            among,
            hands,
            keyframes: Vec::new(),
            twin: None,
            level: None,
        }
    }

    /// A case whose hand moves along straight lines, at a rate (Hz).
    pub fn along(among: Among, keyframes: Vec<[f64; 4]>, rate: f64) -> Self {
        let hands = resampled(&keyframes, rate);
        Self {
            keyframes,
            ..Self::new(among, hands)
        }
    }

    /// The case at another rate (Hz).
    pub fn at(&self, rate: f64) -> Self {
        Self {
            hands: resampled(&self.keyframes, rate),
            ..self.clone()
        }
    }

    /// Every frame cut into equal parts.
    pub fn cut(&self, parts: usize) -> Self {
        Self {
            hands: polyline(&self.hands, parts),
            ..self.clone()
        }
    }

    /// Left and right exchanged.
    pub fn mirrored(&self) -> Self {
        Self {
            among: flipped(&self.among),
            hands: self.hands.iter().map(|&hand| flip(hand)).collect(),
            keyframes: Vec::new(),
            twin: self.twin.as_ref().map(flipped),
            level: self.level.as_ref().map(flipped),
        }
    }

    /// How far two poses are apart: positions in L, angles in rad.
    pub fn apart(&self, a: [f64; 3], b: [f64; 3]) -> f64 {
        let way = (a[0] - b[0]).hypot(a[1] - b[1]) / self.among.setup.size();
        let turn = (a[2] - b[2]).abs();
        if way.is_nan() || turn.is_nan() {
            return f64::INFINITY;
        }
        way.max(turn)
    }
}

/// The mirror image of a pose.
pub(crate) fn flip([x, y, angle]: [f64; 3]) -> [f64; 3] {
    [-x, y, -angle]
}

fn flipped(among: &Among) -> Among {
    let point = |[x, y]: [f64; 2]| [-x, y];
    let points = |all: &[[f64; 2]]| all.iter().rev().map(|&p| point(p)).collect();
    let mut setup = among.setup.clone();
    setup.vertices = points(&setup.vertices);
    setup.start = flip(setup.start);
    setup.holding_point = setup.holding_point.map(point);
    for surface in &mut setup.surfaces {
        surface.normal = point(surface.normal);
    }
    let obstacle = |o: &Obstacle| Obstacle {
        vertices: points(&o.vertices),
        friction: o.friction,
    };
    Among {
        setup,
        obstacles: among.obstacles.iter().map(obstacle).collect(),
    }
}

/// One pose every 1/rate from the first keyframe on, and the last keyframe.
fn resampled(keyframes: &[[f64; 4]], rate: f64) -> Vec<[f64; 3]> {
    let (Some(first), Some(last)) = (keyframes.first(), keyframes.last()) else {
        return Vec::new();
    };
    // A millionth of a frame counts as rounding.
    let count = ((last[0] - first[0]) * rate - 1e-6).ceil().max(1.0) as usize;
    let pose = |k: usize| {
        let t = first[0] + k as f64 / rate;
        let after = keyframes.iter().position(|keyframe| keyframe[0] > t);
        let Some(after) = after.filter(|&after| after > 0 && k < count) else {
            return [last[1], last[2], last[3]];
        };
        let (from, to) = (keyframes[after - 1], keyframes[after]);
        let part = (t - from[0]) / (to[0] - from[0]);
        [1, 2, 3].map(|k| from[k] + (to[k] - from[k]) * part)
    };
    (0..=count).map(pose).collect()
}
