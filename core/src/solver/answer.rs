//! The answer of a step: pose, contacts and wrench in SI units, from the state at rest.

use super::{Solver, State};
use crate::coupling::Stance;
use crate::geometry::Angle;
use crate::model::Model;
use crate::output::{Contact, Log, MAX_CONTACTS, Output, Wrench};
use crate::real::Real;
use heapless::Vec;

impl<R: Real, const V: usize, const S: usize, M: Model> Solver<R, V, S, M> {
    pub(super) fn output(&self, state: &State<R>, log: Log<R>) -> Output<R::Si> {
        let units = self.scene.units;
        let placed = state.contact.placed(&self.scene);
        let pose = placed.pose();
        let stance = Stance::new(&self.scene, placed, &state.grip);
        let wrench = if state.held {
            Wrench {
                force: units.force_to_si(stance.spring),
                moment: units.to_moment(stance.couple.to_si()),
            }
        } else {
            Wrench::default()
        };
        let angle = pose.orientation.angle();
        let mut output = Output {
            hand: state.hand,
            held: state.held,
            position: units.point_to_si(pose.position),
            angle: Angle {
                turns: angle.turns,
                rest: angle.rest.to_si(),
            },
            depth: state.hand.depth,
            state: state.contact.kind(),
            wrench,
            slips: log.slips,
            longest_slip: units.to_length(log.longest_slip.to_si()),
            status: log.final_status(),
            transitions: log.transitions,
            contacts: Vec::new(),
            events: log.events,
        };
        self.add_contacts(state, &stance, &mut output.contacts);
        output
    }

    fn add_contacts(
        &self,
        state: &State<R>,
        stance: &Stance<R>,
        contacts: &mut Vec<Contact<R::Si>, MAX_CONTACTS>,
    ) {
        let units = self.scene.units;
        let reactions = if state.held {
            state.contact.reactions(&self.scene, stance)
        } else {
            Vec::new()
        };
        for (i, pair) in state.contact.contacts().iter().enumerate() {
            let [normal, friction] = reactions.get(i).copied().unwrap_or_default();
            let at = stance.placed.point + stance.placed.arm(&self.scene, pair.vertex);
            // There are never more contacts than there is room for.
            let _ = contacts.push(Contact {
                vertex: usize::from(pair.vertex),
                surface: usize::from(pair.surface),
                point: units.point_to_si(at),
                normal: units.to_force(normal.to_si()),
                friction: units.to_force(friction.to_si()),
            });
        }
    }
}
