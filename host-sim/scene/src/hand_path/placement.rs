//! How the hand's motion is placed in the scene: the plane onto which six degrees of freedom are projected, the scale,
//! and the origin.

use std::f64::consts::TAU;

use stiction_core::{Angle, Axis, Hand, Projection, TrackerSample};

use super::recorded::{Row, RowPose};
use super::{HandPath, Sample, turned};

/// The unit of a planar hand's angle in keyframes and recorded paths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AngleUnit {
    /// rad
    #[default]
    Radians,
    /// 180 of them are pi rad.
    Degrees,
}

impl AngleUnit {
    /// The units and their names in scene files.
    pub(crate) const ALL: [(&'static str, Self); 2] =
        [("radians", Self::Radians), ("degrees", Self::Degrees)];

    const fn radians(self, angle: f64) -> f64 {
        match self {
            Self::Radians => angle,
            Self::Degrees => angle.to_radians(),
        }
    }
}

/// Plane, scale, origin, and what the angle is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The axes of a 6-DOF path that become x and y of the scene.
    pub axes: [Axis; 2],
    /// Factor > 0 on positions, including the depth.
    pub scale: f64,
    /// Added after scaling: x, y (m), phi (rad).
    pub origin: [f64; 3],
    /// The unit of phi, where the header of a file does not state it.
    pub angle: AngleUnit,
    /// Whether phi continues from one record to the next by less than half a turn: for angles that are wrapped to a turn.
    pub unwrap: bool,
    /// The largest magnitude of a coordinate in the scene (m).
    pub limit: f64,
}

impl Default for Placement {
    fn default() -> Self {
        let axis = |index| Axis {
            index,
            negative: false,
        };
        Self {
            axes: [axis(0), axis(1)],
            scale: 1.0,
            origin: [0.0; 3],
            angle: AngleUnit::Radians,
            unwrap: false,
            limit: f64::MAX,
        }
    }
}

impl Placement {
    /// For samples that are placed as they arrive.
    pub fn live(&self) -> Option<LivePlacement> {
        Some(LivePlacement {
            placement: *self,
            projection: Projection::new(self.axes)?,
        })
    }

    fn placed(&self, hand: &Hand<f64>) -> Hand<f64> {
        let ([x, y], [x0, y0, phi0]) = (hand.position, self.origin);
        Hand {
            position: [x * self.scale + x0, y * self.scale + y0],
            angle: turned(hand.angle, phi0),
            depth: hand.depth * self.scale,
            held: hand.held,
            tilted: hand.tilted,
        }
    }

    fn fits(&self, hand: &Hand<f64>) -> bool {
        let [x, y] = hand.position;
        [x, y, hand.depth]
            .iter()
            .all(|value| value.abs() <= self.limit)
            && hand.angle.radians().abs() <= HandPath::LARGEST_ANGLE
    }
}

pub(crate) struct Placed {
    live: LivePlacement,
    /// The last angle of a planar record (rad).
    phi: Option<f64>,
    pub(crate) samples: Vec<Sample>,
    /// The number of samples without a pose.
    pub(crate) lost: usize,
}

impl Placed {
    pub(crate) fn new(placement: &Placement) -> Result<Self, &'static str> {
        let live = placement.live();
        Ok(Self {
            live: live.ok_or("the plane's axes are not two different ones")?,
            phi: None,
            samples: Vec::new(),
            lost: 0,
        })
    }

    /// Adds the sample of a row.
    pub(crate) fn add(&mut self, row: &Row) -> Result<(), String> {
        let LivePlacement {
            placement,
            projection,
        } = &mut self.live;
        let recorded = match row.pose {
            RowPose::Planar([x, y, phi]) => {
                let phi = row.unit.unwrap_or(placement.angle).radians(phi);
                let phi = match self.phi.filter(|_| placement.unwrap) {
                    Some(before) => unwrapped(before, phi),
                    None => phi,
                };
                if phi.is_finite() {
                    self.phi = Some(phi);
                }
                Hand::new(x, y, phi)
            }
            // Without a rotation, it is lost.
            RowPose::Spatial(sample) => projection.planar(&sample).unwrap_or(NOWHERE),
        };
        let hand = Hand {
            held: row.held,
            ..placement.placed(&recorded)
        };
        if recorded.is_finite() && !placement.fits(&hand) {
            return Err(format!(
                "the pose is out of range, allowed: up to {:.2e} m and {:e} rad after scaling",
                placement.limit,
                HandPath::LARGEST_ANGLE
            ));
        }
        if self.samples.is_empty() && !recorded.is_finite() {
            let problem = "the first pose is lost: it has no value, one that is not finite, or the quaternion 0; allowed: a pose, so delete the records before the first one";
            return Err(problem.to_owned());
        }
        self.lost += usize::from(!recorded.is_finite());
        self.samples.push(Sample { t: row.t, hand });
        Ok(())
    }
}

/// Places samples of a tracker as they arrive; the angle is unwrapped from one to the next.
#[derive(Clone, Debug)]
pub struct LivePlacement {
    placement: Placement,
    projection: Projection<f64>,
}

impl LivePlacement {
    /// The hand of a sample; not finite if there is no sample, or if it is out of range.
    pub fn hand(&mut self, sample: Option<&TrackerSample<f64>>) -> Hand<f64> {
        let recorded = sample.and_then(|sample| self.projection.planar(sample));
        match recorded.map(|hand| self.placement.placed(&hand)) {
            Some(hand) if self.placement.fits(&hand) => hand,
            _ => NOWHERE,
        }
    }
}

/// An angle by whole turns nearest to the one before it (rad).
fn unwrapped(before: f64, angle: f64) -> f64 {
    let turns = ((before - angle) / TAU).round();
    angle + TAU * turns
}

/// The hand of a record that cannot be projected.
const NOWHERE: Hand<f64> = Hand {
    position: [f64::NAN; 2],
    angle: Angle {
        turns: 0,
        rest: f64::NAN,
    },
    depth: f64::NAN,
    held: true,
    tilted: false,
};

/// Two different axes, each with an optional minus: "xy", "-xz", "x-y".
pub(crate) fn parse_plane(text: &str) -> Option<[Axis; 2]> {
    let mut letters = text.chars();
    let mut axis = || {
        let (negative, letter) = match letters.next()? {
            '-' => (true, letters.next()?),
            letter => (false, letter),
        };
        let index = "xyz".find(letter)?;
        Some(Axis { index, negative })
    };
    let axes = [axis()?, axis()?];
    (letters.next().is_none() && Projection::<f64>::new(axes).is_some()).then_some(axes)
}
