//! The body under other parameters, in another scene or number type: it stays where it is, the hand holds it at the same point, its
//! contacts stick at first, and it comes to rest again. World frame, SI units.

use crate::event::Status;
use crate::evolution::Evolution;
use crate::forces::Wrench;
use crate::geometry::Angle;
use crate::hand::Hand;
use crate::hold::Hold;
use crate::output::Output;
use crate::real::Real;
use crate::scene::Description;
use crate::si::SiFloat;
use crate::solver::{Solver, State};
use core::fmt;

/// A body and the hand on it. SI units, world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Present<F> {
    /// Position of the body's origin (m).
    pub position: [F; 2],
    /// Orientation of the body, with all its turns.
    pub angle: Angle<F>,
    /// The hand holds it.
    pub held: bool,
    /// How the hand came to hold it.
    pub hold: Hold,
    /// The holding point of its scene (m, body frame).
    pub holding_point: Option<[F; 2]>,
    /// The last usable sample of the hand, turned back by the whole turns of the body.
    pub hand: Hand<F>,
    /// The wrench of the hand on the body (N, N·m about the holding point).
    pub wrench: Wrench<F>,
    /// k_h (N/m) and k_theta (N·m/rad) of that wrench.
    pub stiffness: [F; 2],
}

impl<F: SiFloat> Present<F> {
    /// The hand where its springs are at rest, as at the moment in which it took hold.
    pub fn idle(&self) -> Hand<F> {
        let Wrench { force, moment } = self.wrench;
        let ([x, y], [fx, fy]) = (self.hand.position, force);
        let [k_h, k_theta] = self.stiffness;
        // Without a rotational spring, the angle at which it would rest is the present one.
        let turn = if k_theta > F::ZERO {
            moment / k_theta
        } else {
            F::ZERO
        };
        Hand {
            position: [x - fx / k_h, y - fy / k_h],
            angle: self.hand.angle.plus(-turn),
            ..self.hand
        }
    }
}

/// The reach (m) of a scene whose body, of these vertices (m, body frame), is taken hold of again at a point that was within `reach` (m):
/// rounding must not put it outside. It is longer by 1e-4 of the largest coordinate, a thousand times the rounding of an f32.
pub fn reach_again<F: SiFloat>(vertices: &[[F; 2]], reach: F) -> F {
    let coordinates = vertices.iter().flatten();
    let size = coordinates.fold(F::ZERO, |size, x| size.max(x.abs()));
    reach + F::narrow(1e-4) * size
}

/// A body that was carried on.
#[derive(Clone, Debug, PartialEq)]
pub struct Carried<R: Real, const V: usize, const S: usize, const C: usize> {
    /// The solver in which the state goes on. No other one fits: the length unit of a point depends on where it is held.
    pub solver: Solver<R, V, S, C>,
    /// Its turns count from the whole turns of [`Present::angle`].
    pub state: State<R>,
    /// The answer of coming to rest.
    pub output: Output<R::Si>,
}

/// Why a body cannot be carried on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CarryError<E> {
    /// The scene cannot be used, or the body cannot be there in it.
    Scene(E),
    /// The body or the pull on it is out of range.
    Unsettled(Status),
    /// The hand would lose its hold: the point would be out of reach.
    OutOfReach,
}

impl<E: fmt::Display> fmt::Display for CarryError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Unsettled(status) => {
                write!(f, "the body cannot settle where it is: {}", status.name())
            }
            Self::OutOfReach => f.write_str("the hand's hold on the body would be out of reach"),
        }
    }
}

impl<E: fmt::Debug + fmt::Display> core::error::Error for CarryError<E> {}

impl<R: Real<Si: SiFloat>, const V: usize, const S: usize, const C: usize> Solver<R, V, S, C> {
    /// The body of `present` in the scene of `description`, or with its parameters: it stays at its pose, is held at the point at which it
    /// is held, its contacts stick at first, and it comes to rest. `solver_of` makes the solver of a description; it is called with this
    /// one, changed in start, holding point and reach. F is the float of the pose: it may come from another number type.
    ///
    /// A holding point in `description` counts if the hand has not held the body yet.
    ///
    /// # Errors
    /// [`CarryError::Scene`] with the error of `solver_of`, for example if the body would be inside a surface; the other ones if the hand
    /// cannot hold the body there.
    ///
    /// ```
    /// # use stiction_core::{Description, SurfaceDescription};
    /// use stiction_core::{Evolution, Hand, Present, Scene, SceneError, Solver};
    ///
    /// # let floor = SurfaceDescription {
    /// #     normal: [0.0, 1.0], offset: 0.0, friction_static: 0.5, friction_dynamic: 0.3, memory: None,
    /// # };
    /// # let description = Description {
    /// #     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
    /// #     start: [0.0, 0.03, 0.0],
    /// #     weight: 0.0,
    /// #     holding_point: Some([0.0, 0.02]),
    /// #     reach: 0.0,
    /// #     stiffness_translation: 500.0,
    /// #     stiffness_rotation: 0.5,
    /// #     surfaces: &[floor],
    /// #     obstacles: &[],
    /// # };
    /// let solver_of = |scene: &Description<f32>| -> Result<_, SceneError<f32>> {
    ///     Ok(Solver::new(Scene::<f32, 4, 1>::new(scene)?, Evolution::Path))
    /// };
    /// // Pressed 10 mm down: 5 N.
    /// let solver = solver_of(&description)?;
    /// let (state, output) = solver.start(Hand::new(0.0, 0.04, 0.0));
    ///
    /// // Springs of twice the stiffness in mid-contact: 10 N, and the box is where it was.
    /// let present = Present {
    ///     position: output.position,
    ///     angle: output.angle,
    ///     held: output.held,
    ///     hold: state.hold(),
    ///     holding_point: description.holding_point,
    ///     hand: state.hand().turned(-output.angle.turns),
    ///     wrench: solver.wrench(&state),
    ///     stiffness: [description.stiffness_translation, description.stiffness_rotation],
    /// };
    /// let stiffer = Description { stiffness_translation: 1000.0, ..description };
    /// let carried = Solver::carry(&present, &stiffer, solver_of).expect("it fits");
    /// let [_, force] = carried.solver.wrench(&carried.state).force;
    /// assert!((force + 10.0).abs() < 1e-3);
    /// assert_eq!(carried.output.position, output.position);
    /// # Ok::<(), SceneError<f32>>(())
    /// ```
    #[inline(never)]
    pub fn carry<F: SiFloat, E>(
        present: &Present<F>,
        description: &Description<'_, R::Si>,
        mut solver_of: impl FnMut(&Description<'_, R::Si>) -> Result<Self, E>,
    ) -> Result<Carried<R, V, S, C>, CarryError<E>> {
        let si = |x: F| R::Si::narrow(x.widen());
        let [x, y] = present.position.map(si);
        let mut there = Description {
            start: [x, y, si(present.angle.rest)],
            ..*description
        };
        there.holding_point = match (present.hold, present.held) {
            (Hold::Never, _) => description.holding_point,
            (Hold::Given, true) => present.holding_point.map(|point| point.map(si)),
            (Hold::Given, false) | (Hold::Taken, _) => None,
        };
        let mut carried = if present.held && present.hold == Hold::Taken {
            // A hand that pulls with no force takes hold again, and jumps to where it is.
            let again = Description {
                reach: reach_again(there.vertices, there.reach),
                ..there
            };
            let again = solver_of(&again).map_err(CarryError::Scene)?;
            let again = again.with_evolution(Evolution::Frame);
            let (mut state, mut output) = again.start(narrowed(&present.idle()));
            if output.held {
                output = again.step(&mut state, narrowed(&present.hand));
            }
            (state, output)
        } else {
            let solver = solver_of(&there).map_err(CarryError::Scene)?;
            solver.start(narrowed(&present.hand))
        };
        let (state, output) = &mut carried;
        if matches!(output.status, Status::Saturated | Status::HeldLast) {
            return Err(CarryError::Unsettled(output.status));
        }
        if present.held && !output.held {
            return Err(CarryError::OutOfReach);
        }
        state.keep_hold(present.hold);
        let (state, output) = carried;
        Ok(Carried {
            solver: solver_of(&there).map_err(CarryError::Scene)?,
            state,
            output,
        })
    }
}

/// A hand in another float.
fn narrowed<F: SiFloat, G: SiFloat>(hand: &Hand<F>) -> Hand<G> {
    let narrow = |x: F| G::narrow(x.widen());
    Hand {
        position: hand.position.map(narrow),
        angle: Angle {
            turns: hand.angle.turns,
            rest: narrow(hand.angle.rest),
        },
        depth: narrow(hand.depth),
        held: hand.held,
        tilted: hand.tilted,
    }
}
