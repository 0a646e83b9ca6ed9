//! 1: from a tracker's sample to the planar hand pose: the position is projected onto the plane of the scene, the
//! rotation is its twist about the plane's normal, unwrapped; the depth passes through.

use crate::geometry::Angle;
use crate::real::Real;

/// One sample of the planar hand.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Hand<F> {
    /// Position p_h (m), world frame.
    pub position: [F; 2],
    /// Orientation phi, unwrapped, counter-clockwise positive.
    pub angle: Angle<F>,
    /// Depth coordinate (m); passes through to the output.
    pub depth: F,
    /// The hold switch.
    pub held: bool,
}

impl<F: Real> Hand<F> {
    /// A hand that holds, at (x, y) (m) and phi (rad).
    pub fn new(x: F, y: F, phi: F) -> Self {
        Self {
            position: [x, y],
            angle: Angle::from_radians(phi),
            depth: F::ZERO,
            held: true,
        }
    }
    /// The same hand with its switch off.
    #[must_use]
    pub fn released(self) -> Self {
        Self {
            held: false,
            ..self
        }
    }
    /// False where a component is infinite or NaN.
    pub fn is_finite(&self) -> bool {
        let [x, y] = self.position;
        x.is_finite() && y.is_finite() && self.angle.is_finite() && self.depth.is_finite()
    }
}

/// One sample of a tracker with six degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackerSample<F> {
    /// Position (m).
    pub position: [F; 3],
    /// Orientation as a unit quaternion (x, y, z, w); its length does not matter, but must not be 0.
    pub orientation: [F; 4],
    /// The hold switch.
    pub held: bool,
}

/// A world axis with its direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Axis {
    /// 0, 1 or 2: x, y or z.
    pub index: usize,
    /// Against the axis.
    pub negative: bool,
}

impl Axis {
    fn of<F: Real>(self, [x, y, z]: [F; 3]) -> F {
        let value = match self.index {
            0 => x,
            1 => y,
            _ => z,
        };
        if self.negative { -value } else { value }
    }
}

/// The plane of the scene in the tracker's space, and the memory that unwraps the angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection<F> {
    axes: [Axis; 2],
    last: Angle<F>,
}

impl<F: Real> Projection<F> {
    /// The plane in which `axes` become x and y of the scene. `None` unless they are two different axes of 0, 1, 2.
    pub fn new(axes: [Axis; 2]) -> Option<Self> {
        let [a, b] = axes;
        let valid = a.index < 3 && b.index < 3 && a.index != b.index;
        valid.then_some(Self {
            axes,
            last: Angle {
                turns: 0,
                rest: F::ZERO,
            },
        })
    }

    /// The third axis, completing a right-handed frame: the normal of the plane, along which the depth is counted.
    fn normal(&self) -> Axis {
        let [a, b] = self.axes;
        let forward = matches!((a.index, b.index), (0, 1) | (1, 2) | (2, 0));
        Axis {
            index: match (a.index, b.index) {
                (0, 1) | (1, 0) => 2,
                (0, 2) | (2, 0) => 1,
                _ => 0,
            },
            negative: (a.negative != b.negative) == forward,
        }
    }

    /// The planar hand pose of a sample. `None`, and nothing is remembered, where the sample is not finite or its
    /// quaternion is zero. Where the twist is undefined (half a turn about an axis in the plane) the last angle stays.
    pub fn planar(&mut self, sample: &TrackerSample<F>) -> Option<Hand<F>> {
        let [x, y, z, w] = sample.orientation;
        let finite = |values: &[F]| values.iter().all(|v| v.is_finite());
        let zero = [x, y, z, w].iter().all(|q| *q == F::ZERO);
        if !finite(&sample.position) || !finite(&sample.orientation) || zero {
            return None;
        }
        let along = self.normal().of([x, y, z]);
        if along != F::ZERO || w != F::ZERO {
            let twist = F::TWO * along.atan2(w);
            let (_, change) = (twist - self.last.rest).turns();
            self.last = self.last.plus(change);
        }
        let [a, b] = self.axes;
        Some(Hand {
            position: [a.of(sample.position), b.of(sample.position)],
            angle: self.last,
            depth: self.normal().of(sample.position),
            held: sample.held,
        })
    }
}
