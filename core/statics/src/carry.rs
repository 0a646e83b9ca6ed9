//! The body under other parameters, in another scene or number type: it stays where it is, the hand holds it at the same point, its
//! contacts stick at first, and it comes to rest again. World frame, SI units.

use crate::output::Output;
use crate::real::Real;
use crate::solver::{Solver, State};
use stiction_core::{
    Angle, CarryError, Description, Evolution, Hand, Hold, Present, SiFloat, Status, reach_again,
};

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

impl<R: Real<Si: SiFloat>, const V: usize, const S: usize, const C: usize> Solver<R, V, S, C> {
    /// The body of `present` in the scene of `description`, or with its parameters: it stays at its pose, is held at the point at which it
    /// is held, its contacts stick at first, and it comes to rest. `solver_of` makes the solver of a description; it is called with this
    /// one, changed in start, holding point and reach. F is the float of the pose: it may come from another number type. A holding point in
    /// `description` counts if the hand has not held the body yet.
    ///
    /// # Errors
    /// [`CarryError::Scene`] with the error of `solver_of`, for example if the body would be inside a surface;
    /// [`CarryError::Unsettled`] if the body or the pull on it is out of range; [`CarryError::OutOfReach`] if the hand cannot hold the body
    /// there.
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
        let solver = solver_of(&there).map_err(CarryError::Scene)?;
        let (mut state, output) = if present.held && present.hold == Hold::Taken {
            // A hand that pulls with no force takes hold again, and jumps to where it is.
            there.reach = reach_again(there.vertices, there.reach);
            let again = solver_of(&there).map_err(CarryError::Scene)?;
            let again = again.with_evolution(Evolution::Frame);
            let (mut state, taken) = again.start(narrowed(&present.idle()));
            if !taken.held {
                return Err(CarryError::OutOfReach);
            }
            let output = again.step(&mut state, narrowed(&present.hand));
            (state, output)
        } else {
            solver.start(narrowed(&present.hand))
        };
        if matches!(output.status, Status::Saturated | Status::HeldLast) {
            return Err(CarryError::Unsettled(output.status));
        }
        if present.held && !output.held {
            return Err(CarryError::OutOfReach);
        }
        state.keep_hold(present.hold);
        Ok(Carried {
            solver,
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
