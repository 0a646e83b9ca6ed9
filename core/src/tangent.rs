//! The tangent of a state: how the pose follows the hand while nothing happens, and the stiffness that the hand feels (E8).

use crate::geometry::Vec2;
use crate::motion::{Kind, Motion};
use crate::output::Tangent;
use crate::real::Real;
use crate::solver::{Solver, State};
use crate::state::{Body, Freedom, HandPose};
use crate::world::Statics;

/// C = d(pose)/d(hand): for each displacement of the hand by x, y and its angle what x, y of the holding point and the body's angle do.
/// Lengths / L.
pub(crate) type Compliance<R> = [[R; 3]; 3];

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The compliance, by columns: C_k = (g_p + g_u u'; theta_u u'), u' = -E_p/E_u. None where E_u does not hold the body, at a fold.
    #[inline(never)]
    pub(crate) fn compliance(&self, body: &Body<R>) -> Option<Compliance<R>> {
        let (one, zero) = (R::ONE, R::ZERO);
        let unit = |x, y, angle| HandPose {
            at: Vec2::new(x, y),
            angle,
        };
        let columns = [
            unit(one, zero, zero),
            unit(zero, one, zero),
            unit(zero, zero, one),
        ];
        let mut out = [[zero; 3]; 3];
        for (column, hand_p) in out.iter_mut().zip(columns) {
            let m = match self.freedom(body) {
                Freedom::Fixed => continue,
                Freedom::Free => Motion::new(Kind::Free, body, hand_p),
                Freedom::Turns => Motion::new(Kind::Pin, body, hand_p),
                Freedom::Slides => self.sliding(body, hand_p),
                Freedom::Together => self.sliding_pair(body, hand_p),
            };
            let i = self.placed_at_start(&m);
            if i.e_u >= R::ZERO {
                return None;
            }
            let rates = self.rates(&m, &i);
            *column = [rates.g.x, rates.g.y, rates.theta];
        }
        Some(out)
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Solver<R, V, S, C> {
    /// How the pose follows the hand while nothing happens, and the stiffness that the hand feels; none at a fold, where the body would
    /// snap. Of contacts that slide it holds in the direction of their slide.
    pub fn tangent(&self, state: &State<R>) -> Option<Tangent<R::Si>> {
        if !state.held {
            return None;
        }
        let columns = self.statics(state).compliance(&state.body)?;
        let [of_pose, of_wrench] = self.scene.units.of_tangent();
        let springs = [R::ONE, R::ONE, self.scene.world.stiffness.value];
        let at = |row: usize, column: usize| {
            let columns = columns.get(column);
            let moves = columns.and_then(|column| column.get(row));
            moves.copied().unwrap_or(R::ZERO)
        };
        let table = |units: [[R::Si; 3]; 3], entry: &dyn Fn(usize, usize) -> R| {
            let mut table = units;
            for (row, values) in table.iter_mut().enumerate() {
                for (column, value) in values.iter_mut().enumerate() {
                    *value = entry(row, column).to_si(*value);
                }
            }
            table
        };
        let felt = |row: usize, column: usize| {
            let rest = if row == column { R::ONE } else { R::ZERO };
            let spring = springs.get(row).copied().unwrap_or(R::ZERO);
            spring * (at(row, column) - rest)
        };
        Some(Tangent {
            compliance: table(of_pose, &at),
            stiffness: table(of_wrench, &felt),
        })
    }
}
