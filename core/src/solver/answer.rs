//! The answer of a step in SI units: the pose and what happened in every step, the forces on request.

use super::{Solver, State};
use crate::forces::{Contact, Contacts, Wrench};
use crate::geometry::Angle;
use crate::load::Load;
use crate::log::Log;
use crate::model::Model;
use crate::output::Output;
use crate::real::Real;
use crate::work::Work;
use crate::world::World;

impl<R: Real, const V: usize, const S: usize, M: Model> Solver<R, V, S, M> {
    /// The answer of a step from the state and the log: pose in m and rad, world frame; the longest slip in m.
    pub(super) fn output(&self, state: &State<R>, (work, log): (Work, Log<R>)) -> Output<R::Si> {
        let pose = state.contact.pose(&self.scene);
        let angle = pose.orientation.angle();
        Output {
            held: state.held,
            position: self.scene.units.point_to_si(pose.position),
            angle: Angle {
                turns: angle.turns,
                rest: angle.rest.to_si(R::Si::ONE),
            },
            depth: state.hand.depth,
            state: state.contact.kind(),
            slips: log.slips,
            longest_slip: self.scene.units.length_to_si(log.longest_slip),
            status: log.final_status(),
            behind: state.errand.left().to_si(R::Si::ONE),
            work: work.done(),
            transitions: log.transitions,
            events: log.events,
        }
    }

    /// Force and moment of the hand's springs on the body in a state, world frame: F = k_h (p_h - G) (N) and M = k_theta (phi - theta)
    /// (N·m), Eqs. (3) and (4) of the paper. Zero while it is not held. A device outputs the opposite to the hand, [`Wrench::feedback`].
    pub fn wrench(&self, state: &State<R>) -> Wrench<R::Si> {
        if !state.held {
            return Wrench::default();
        }
        let (units, grip) = (self.scene.units, &state.grip);
        let (force, couple) = grip.springs(&self.scene, &state.contact.pose(&self.scene));
        Wrench {
            force: [force.x, force.y].map(|f| units.force_to_si(f)),
            moment: units.moment_to_si(couple),
        }
    }

    /// The contacts of a state with their reactions, which are zero while the body is not held. For a held body they balance the wrench and
    /// the weight, unless the status reports that the pose is out of balance. If several contacts bear more than balance determines, one
    /// distribution of the load is returned (STATICS 4, 5).
    pub fn contacts(&self, state: &State<R>) -> Contacts<R::Si> {
        let units = self.scene.units;
        let placed = state.contact.placed(&self.scene);
        let load = Load::new(&self.scene, placed, &state.grip);
        let (mut reactions, sliding) = (state.contact).reactions(&self.scene, &state.grip, &load);
        if !state.held {
            reactions.clear();
        }
        let mut contacts = Contacts::default();
        for (i, pair) in state.contact.contacts().iter().enumerate() {
            let [normal, friction] = reactions.get(i).copied().unwrap_or_default();
            let at = placed.point + placed.arm_to(&self.scene, *pair);
            let direction = (self.scene.face(*pair, placed.orientation.rotation())).normal;
            contacts.add(Contact {
                touch: self.scene.touch(*pair),
                direction: [direction.x, direction.y].map(|x| x.to_si(R::Si::ONE)),
                point: units.point_to_si(at),
                normal: units.force_to_si(normal),
                friction: units.force_to_si(friction),
                sliding: match sliding.get(i).copied().unwrap_or(R::ZERO) {
                    sign if !state.held || sign == R::ZERO => 0,
                    sign if sign < R::ZERO => -1,
                    _ => 1,
                },
            });
        }
        contacts
    }
}
