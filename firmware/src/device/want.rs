//! The force that the solver demands of the servo loop: that of the springs; of a weight that was lifted with less, only what the hand has
//! paid for.

use super::controller::Controller;
use crate::safety::{Held, Wanted};
use stiction_core::{Hand, Real, Wrench};

impl<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize> Controller<R, V, S, C> {
    /// Demands the force of the present state. `before`: the hand at the end of the last turn, unless it is the same.
    pub(super) fn want(&mut self, before: Option<Hand<f32>>) {
        let run = &self.run;
        let wrench = run.state.as_ref().map(|s| run.solver.wrench(s));
        let wrench = wrench.unwrap_or_default().feedback();
        let limits = &self.settings.limits;
        let wanted = limits.sized(&wrench, run.store.stiffness());
        let is_free = self.run.store.weight == 0.0;
        let part = match is_free || !wanted.is_limited() && self.debt.is_none() {
            true => 1.0,
            false => self.paid(&wanted, before),
        };
        self.demand.wanted = if part < 1.0 {
            wanted.reduced(part)
        } else {
            wanted
        };
    }

    /// The part of the wanted force for which the hand has paid, 0 to 1.
    #[inline(never)]
    fn paid(&mut self, wanted: &Wanted, before: Option<Hand<f32>>) -> f32 {
        let (run, limits) = (&self.run, &self.settings.limits);
        let stiffness = run.store.stiffness();
        let [k_h, k_theta] = stiffness;
        let now = run.state.as_ref().map(|state| *state.hand());
        let given = before.zip(now).map_or(0.0, |(before, now)| {
            let ([x, y], [from_x, from_y]) = (now.position, before.position);
            let [dx, dy, turn] = [x - from_x, y - from_y, now.angle.minus(before.angle)];
            let work = |given: &Wrench<f32>| {
                let [fx, fy] = given.force;
                fx * dx + fy * dy + given.moment * turn
            };
            let mut sprung = k_h * (dx * dx + dy * dy);
            if limits.moment > 0.0 {
                sprung += k_theta * turn * turn;
            }
            let [former, given] = [&self.former, &self.given].map(work);
            // Until the end of a turn its predecessor's force is output, for which the damping takes no more than springs differ by.
            given + Real::max(former - given - sprung, 0.0) - sprung / 2.0
        });
        let height = run.state.as_ref().map_or(0.0, |state| {
            let [_, y] = run.solver.centroid(state);
            y
        });
        let held = Held {
            springs: limits.springs(wanted.size, stiffness),
            weight: run.store.weight * height,
        };
        self.debt.part(held, given, wanted.is_limited())
    }
}
