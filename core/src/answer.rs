//! The answers of the solver in SI units: the pose and what happened in every step, the forces on request.

use crate::forces::Wrench;
use crate::forces::{Contact, Contacts};
use crate::geometry::Angle;
use crate::log::Log;
use crate::output::Output;
use crate::real::Real;
use crate::solver::{Solver, State};

impl<R: Real, const V: usize, const S: usize, const C: usize> Solver<R, V, S, C> {
    pub(crate) fn output(&self, state: &State<R>, log: Log<R>) -> Output<R::Si> {
        let body = &state.body;
        let units = &self.scene.units;
        let origin = body.holding - body.rotation.apply(state.grip.point);
        let (turns, rest) = body.angle.turns();
        Output {
            held: state.held,
            position: units.place(origin),
            angle: Angle {
                turns: state.turns.saturating_add(turns),
                rest: rest.to_si(R::Si::ONE),
            },
            depth: state.hand.depth,
            state: self.statics(state).kind(&body.contacts),
            slips: log.slips,
            longest_slip: log.longest_slip.to_si(units.length),
            status: log.status,
            behind: state.errand.left.to_si(R::Si::ONE),
            work: log.work,
            events: log.events,
        }
    }

    /// Force F = k_h (h - G) (N) and moment M = k_theta (phi - theta) (N·m, about the holding point G) of the hand's springs on the body,
    /// world frame, without the weight; zero while it is not held. A device outputs the opposite to the hand, [`Wrench::feedback`].
    pub fn wrench(&self, state: &State<R>) -> Wrench<R::Si> {
        if !state.held {
            return Wrench::default();
        }
        let body = &state.body;
        let units = &self.scene.units;
        let force = body.hand.at - body.holding;
        let turn = body.hand.angle - body.angle;
        let moment = self.scene.world.stiffness.of(turn);
        Wrench {
            force: [force.x, force.y].map(|f| f.to_si(units.force)),
            moment: moment.to_si(units.moment),
        }
    }

    /// The centroid of the body (m), world frame, where its weight acts.
    pub fn centroid(&self, state: &State<R>) -> [R::Si; 2] {
        let body = &state.body;
        let lever = body.rotation.apply(state.grip.centroid);
        self.scene.units.place(body.holding + lever)
    }

    /// The contacts of a state with their reactions. For a held body they balance the wrench and the weight, unless the status reports that
    /// the pose is out of balance; where they bear more than balance determines, this is one distribution of the load (STATICS 9).
    pub fn contacts(&self, state: &State<R>) -> Contacts<R::Si> {
        let (body, units) = (&state.body, &self.scene.units);
        let statics = self.statics(state);
        let reactions = statics.reactions(body);
        let all = body.contacts.iter().zip(&reactions).enumerate();
        let contacts = all.map(|(i, (contact, &[n, t]))| {
            let frame = statics.frame(contact, body.rotation, body.holding);
            let [n, t, sliding] = if state.held {
                [n.max(R::ZERO), t, contact.sense.number()]
            } else {
                [R::ZERO; 3]
            };
            // The foot of the first contact is what the state remembers.
            let point = if i == 0 {
                statics.foot(contact, body.rotation, body.foot).c
            } else {
                body.holding + frame.r
            };
            Contact {
                touch: statics.touch_of(contact),
                point: units.place(point),
                direction: [frame.n.x, frame.n.y].map(|x| x.to_si(R::Si::ONE)),
                normal: n.to_si(units.force),
                friction: t.to_si(units.force),
                sliding: if sliding == R::ZERO {
                    0
                } else {
                    contact.sense.integer()
                },
            }
        });
        contacts.collect()
    }
}
