//! How the hand's motion is placed in the scene: the plane onto which six degrees of freedom are projected, the scale,
//! and the origin.

use stiction_core::{Angle, Axis, Hand, Projection, TrackerSample};

use super::recorded::{Row, RowPose};
use super::{HandPath, Sample, turned};

/// Plane, scale and origin of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The axes of a 6-DOF path that become x and y of the scene.
    pub axes: [Axis; 2],
    /// Factor > 0 on positions, including the depth.
    pub scale: f64,
    /// Added after scaling: x, y (m), phi (rad).
    pub origin: [f64; 3],
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
    pub(crate) samples: Vec<Sample>,
}

impl Placed {
    pub(crate) fn new(placement: &Placement) -> Result<Self, &'static str> {
        let live = placement.live();
        Ok(Self {
            live: live.ok_or("the plane's axes are not two different ones")?,
            samples: Vec::new(),
        })
    }

    /// Adds the sample of a row.
    pub(crate) fn add(&mut self, row: &Row) -> Result<(), String> {
        let LivePlacement {
            placement,
            projection,
        } = &mut self.live;
        let recorded = match row.pose {
            RowPose::Planar([x, y, phi]) => Hand::new(x, y, phi),
            RowPose::Spatial(sample) if sample.orientation == [0.0; 4] => {
                return Err("the quaternion is 0, allowed: any other".to_owned());
            }
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
            return Err("the first pose is not finite, allowed: finite numbers".to_owned());
        }
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
