//! The contacts with their forces and the hand's wrench, for the haptic device. SI units, world frame.

use crate::contact::MAX_CONTACTS;
use crate::real::Real;
use core::ops::Deref;
use heapless::Vec;

/// One contact: a vertex of the body on a surface or on the side of an obstacle, or the corner of an obstacle on a side of the body. SI
/// units, world frame; forces are those on the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<F> {
    /// What touches what.
    pub touch: Touch,
    /// The unit normal n towards the body; for a corner it turns with the body.
    pub direction: [F; 2],
    /// Where they touch (m).
    pub point: [F; 2],
    /// Reaction N >= 0 along n (N); 0 while the body is not held.
    pub normal: F,
    /// Friction T along the tangent t = (n_y, -n_x), which is +x on a floor (N); |T| <= mu_s N, unless the status reports that the pose is
    /// out of balance. Of contacts in one line, where only the sum counts, in proportion to N (E20).
    pub friction: F,
    /// 0 if it sticks, 1 or -1 if it slides along t or against it with the hand, |T| = mu_d N.
    pub sliding: i8,
}

/// What touches what: indices count from 0, in the lists of the description.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Touch {
    /// A vertex of the body on a half-plane.
    Surface {
        /// Index of the vertex.
        vertex: usize,
        /// Index of the surface.
        surface: usize,
    },
    /// A vertex of the body on a side of an obstacle. Collinear sides of several obstacles with equal friction are one, named after the
    /// first.
    Side {
        /// Index of the vertex.
        vertex: usize,
        /// Index of the obstacle.
        obstacle: usize,
        /// Index of its side, from the corner of this index to the next.
        side: usize,
    },
    /// A corner of an obstacle on a side of the body.
    Corner {
        /// Index of the obstacle.
        obstacle: usize,
        /// Index of its corner.
        corner: usize,
        /// Index of the body's side, from the vertex of this index to the next.
        body_side: usize,
    },
}

impl Touch {
    /// The vertex of the body, if it is a vertex that touches.
    pub const fn vertex(self) -> Option<usize> {
        match self {
            Self::Surface { vertex, .. } | Self::Side { vertex, .. } => Some(vertex),
            Self::Corner { .. } => None,
        }
    }

    /// The half-plane, if it is one that is touched.
    pub const fn surface(self) -> Option<usize> {
        match self {
            Self::Surface { surface, .. } => Some(surface),
            Self::Side { .. } | Self::Corner { .. } => None,
        }
    }

    /// The obstacle, if it is one that is touched.
    pub const fn obstacle(self) -> Option<usize> {
        match self {
            Self::Surface { .. } => None,
            Self::Side { obstacle, .. } | Self::Corner { obstacle, .. } => Some(obstacle),
        }
    }

    /// The obstacle and its corner, if it is a corner that touches.
    pub const fn corner(self) -> Option<[usize; 2]> {
        match self {
            Self::Corner {
                obstacle, corner, ..
            } => Some([obstacle, corner]),
            Self::Surface { .. } | Self::Side { .. } => None,
        }
    }
}

/// Force and moment of the hand on the body, world frame.
///
/// ```
/// # use stiction_core::{Description, Scene, SurfaceDescription};
/// use stiction_core::{Evolution, Hand, Solver};
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
/// // The hand moves 10 mm below the holding point and 3 mm beyond it along +x. That is less than
/// // mu_s · 10 mm, so the box sticks.
/// let solver = Solver::new(scene, Evolution::Path);
/// let (mut state, _) = solver.start(Hand::new(0.0, 0.04, 0.0));
/// solver.step(&mut state, Hand::new(0.003, 0.04, 0.0));
///
/// let wrench = solver.wrench(&state);
/// let is = |value: f32, expected: f32| (value - expected).abs() < 1e-3;
/// assert!(is(wrench.force[0], 1.5) && is(wrench.force[1], -5.0), "along and down");
/// let [x, y] = wrench.feedback().force;
/// assert!(is(x, -1.5) && is(y, 5.0), "the hand is pulled back and pushed up");
///
/// let contacts = solver.contacts(&state);
/// assert_eq!(contacts.len(), 2, "an edge");
/// let normal: f32 = contacts.iter().map(|c| c.normal).sum();
/// let friction: f32 = contacts.iter().map(|c| c.friction).sum();
/// assert!(is(normal, 5.0), "the floor bears the push");
/// assert!(is(friction, -1.5), "friction on the box acts along -t = -x");
/// # // The wrench and the contacts are in balance, in moment too: about the left vertex.
/// # let [fx, fy] = wrench.force;
/// # let at = [0.05, 0.05]; // the holding point relative to it
/// # assert!(is(at[0] * fy - at[1] * fx + wrench.moment + 0.1 * contacts[1].normal, 0.0));
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench<F> {
    /// Force F at the holding point (N).
    pub force: [F; 2],
    /// Moment M about the holding point (N·m), counter-clockwise positive.
    pub moment: F,
}

impl<F: Real> Wrench<F> {
    /// The wrench that a haptic device outputs to the hand: the opposite of the one on the body.
    #[must_use]
    pub fn feedback(&self) -> Self {
        let [x, y] = self.force;
        Self {
            force: [-x, -y],
            moment: -self.moment,
        }
    }
}

/// The contacts of a state, in an order that is fixed as long as the state lasts, at most [`MAX_CONTACTS`]. The list can be read like a
/// slice; [`Wrench`] has an example.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contacts<F> {
    list: Vec<Contact<F>, MAX_CONTACTS>,
}

impl<F> FromIterator<Contact<F>> for Contacts<F> {
    /// The first [`MAX_CONTACTS`].
    fn from_iter<I: IntoIterator<Item = Contact<F>>>(contacts: I) -> Self {
        let mut all = Self { list: Vec::new() };
        contacts
            .into_iter()
            .take(MAX_CONTACTS)
            .for_each(|contact| all.add(contact));
        all
    }
}

impl<F> Contacts<F> {
    pub(crate) fn add(&mut self, contact: Contact<F>) {
        // A state never has more contacts than there is room for.
        let _ = self.list.push(contact);
    }
}

impl<F> Deref for Contacts<F> {
    type Target = [Contact<F>];
    fn deref(&self) -> &[Contact<F>] {
        &self.list
    }
}
