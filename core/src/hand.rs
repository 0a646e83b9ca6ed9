//! 1: from a tracker's sample to the planar hand pose: the position is projected onto the plane of the scene, the rotation is its twist
//! about the plane's normal, unwrapped; the depth passes through.

use crate::geometry::Angle;
use crate::real::Real;

/// One sample of the planar hand. Switching it off and on again releases the body and grasps it again:
///
/// ```
/// # use stiction_core::{Description, Scene, SurfaceDescription};
/// use stiction_core::{Event, Evolution, Hand, Solver};
///
/// # let scene: Scene<f32, 4, 1> = Scene::new(&Description {
/// #     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
/// #     start: [0.0, 0.03, 0.0],
/// #     weight: 0.0,
/// #     holding_point: Some([0.0, 0.02]),
/// #     reach: 0.0,
/// #     stiffness_translation: 500.0,
/// #     stiffness_rotation: 0.5,
/// #     surfaces: &[SurfaceDescription {
/// #         normal: [0.0, 1.0],
/// #         offset: 0.0,
/// #         friction_static: 0.5,
/// #         friction_dynamic: 0.3,
/// #         memory: None,
/// #     }],
/// #     obstacles: &[],
/// # })?;
/// let solver = Solver::new(scene, Evolution::Path);
/// let lifted = Hand::new(0.0, 0.15, 0.0);
/// let (mut state, _) = solver.start(lifted);
///
/// // When released it stays where it is: there is no gravity here, and nothing moves by itself.
/// let output = solver.step(&mut state, lifted.released());
/// assert_eq!((output.held, output.events()), (false, &[Event::Release][..]));
/// let left_at = output.position;
///
/// // A hand outside of it does not take hold; the reach of this scene is 0.
/// assert!(!solver.step(&mut state, Hand::new(0.2, 0.15, 1.0)).held);
///
/// // One within it does, at that point and angle: the springs are at rest, the body stays.
/// let output = solver.step(&mut state, Hand::new(0.02, 0.13, 1.0));
/// assert_eq!((output.held, output.events()), (true, &[Event::Grasp][..]));
/// assert!((output.position[1] - left_at[1]).abs() < 1e-6);
/// assert!(solver.wrench(&state).force.iter().all(|f| f.abs() < 1e-3));
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Hand<F> {
    /// Position p_h (m), world frame. At most [`Real::RANGE`] body sizes from the origin, otherwise the hand is not followed.
    pub position: [F; 2],
    /// Orientation phi, unwrapped, counter-clockwise positive.
    pub angle: Angle<F>,
    /// Depth coordinate (m), across the plane; passes through to the output.
    pub depth: F,
    /// The hold switch: if it is on, the hand holds the body, or takes hold as soon as it is within reach. It is ignored for a hand that is
    /// not finite or out of range.
    pub held: bool,
    /// The hand comes from a tracker's sample that was tilted so far out of the plane that `angle` is hardly known
    /// ([`Projection::planar`]). It is followed, and the status reports it: [`Status::Twist`](crate::Status::Twist).
    pub tilted: bool,
}

impl<F: Real> Hand<F> {
    /// A hand that holds, at (x, y) (m) and phi (rad, unwrapped), depth 0.
    pub fn new(x: F, y: F, phi: F) -> Self {
        Self {
            position: [x, y],
            angle: Angle::from_radians(phi),
            depth: F::ZERO,
            held: true,
            tilted: false,
        }
    }
    /// This hand with its switch off.
    #[must_use]
    pub fn released(self) -> Self {
        Self {
            held: false,
            ..self
        }
    }
    /// A hand at the same place, turned by whole turns; their number saturates.
    #[must_use]
    pub fn turned(self, turns: i32) -> Self {
        let mut hand = self;
        hand.angle.turns = hand.angle.turns.saturating_add(turns);
        hand
    }
    /// False if a component is infinite or NaN.
    pub fn is_finite(&self) -> bool {
        let [x, y] = self.position;
        x.is_finite() && y.is_finite() && self.angle.is_finite() && self.depth.is_finite()
    }
}

/// One sample of a tracker with six degrees of freedom, in the tracker's frame, which is right-handed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackerSample<F> {
    /// Position (m).
    pub position: [F; 3],
    /// Orientation as a quaternion (x, y, z, w): rotates the frame of the hand into that of the tracker. Its length and sign do not matter,
    /// but it must not be 0.
    pub orientation: [F; 4],
    /// The hold switch.
    pub held: bool,
}

/// An axis of the tracker's frame with a direction; +x by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Axis {
    /// 0, 1 or 2: x, y or z.
    pub index: usize,
    /// True for the direction against the axis.
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
///
/// ```
/// use stiction_core::{Axis, Projection, TrackerSample};
///
/// // A tracker whose z points up and whose x points right: the scene's plane is x and z, its
/// // depth is measured along -y, towards the viewer.
/// let right = Axis { index: 0, negative: false };
/// let up = Axis { index: 2, negative: false };
/// let mut projection = Projection::<f32>::new([right, up]).expect("two different axes");
///
/// // The handle is rotated by a quarter turn about -y: counter-clockwise for the viewer.
/// let half = core::f32::consts::FRAC_PI_4;
/// let sample = TrackerSample {
///     position: [0.10, 0.02, 0.30],
///     orientation: [0.0, -half.sin(), 0.0, half.cos()],
///     held: true,
/// };
/// let hand = projection.planar(&sample).expect("a finite sample");
/// assert_eq!((hand.position, hand.depth), ([0.10, 0.30], -0.02));
/// assert!((hand.angle.radians() - core::f32::consts::FRAC_PI_2).abs() < 1e-6);
///
/// let lost = TrackerSample { position: [f32::NAN; 3], ..sample };
/// assert_eq!(projection.planar(&lost), None);
/// ```
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

    /// The third axis, completing a right-handed frame: the normal of the plane, along which the depth is measured.
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

    /// The planar hand pose of a sample: the position on the two axes, the twist of the orientation about their normal, the position along
    /// that normal as depth. The angle continues from the last sample by less than half a turn. If the sample is not finite or its
    /// quaternion is zero, returns `None` and stores nothing.
    ///
    /// The orientation is the twist followed by a swing about an axis in the plane. Beyond a swing of 170 degrees the hand is
    /// [`tilted`](Hand::tilted): there the error of the twist is more than 11 times that of the tracker. Where the twist is undefined (a
    /// swing of half a turn) the last angle stays.
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
            tilted: is_tilted([along, w], sample.orientation),
        })
    }
}

/// True if the swing of a quaternion is more than 170 degrees. `twist`: its component along the plane's normal, and w.
fn is_tilted<F: Real>(twist: [F; 2], quaternion: [F; 4]) -> bool {
    let largest = quaternion
        .iter()
        .fold(F::ZERO, |largest, q| largest.max(q.abs()));
    // Then no square is beyond the range of the numbers.
    let square = |parts: &[F]| {
        let parts = parts.iter().map(|&q| q / largest);
        parts.fold(F::ZERO, |sum, q| sum + q * q)
    };
    // The square of the cosine of half the swing: cos(85 degrees)² = (1 - cos(10 degrees)) / 2.
    let (_, cos) = (F::TAU / F::from_int(36)).sin_cos();
    square(&twist) < (F::ONE - cos).halved() * square(&quaternion)
}
