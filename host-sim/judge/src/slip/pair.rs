//! Slips of two contacts (STATICS 4, 5): on one line, where only the sums of both count, and off it.

use super::{Onset, Step, drive, static_excess};
use stiction_core::Touch;

use crate::brace::Brace;
use crate::finding::Finding;
use crate::frame::{Contact, Frame};
use crate::model::borne;
use crate::onset::Way;
use crate::vector::{Vec2, cross, dot, sub};

impl<'a> Step<'a> {
    /// An edge, whose frictions act along one line: the sums of both count (E4).
    pub(super) fn edge(&self, contacts: [&Contact; 2], onset: Onset) -> Vec<Finding> {
        let Some(sign) = self.direction(contacts[0]) else {
            return Vec::new();
        };
        let normal = self.face(contacts[0].touch).normal;
        let touches = contacts.map(|contact| contact.touch);
        let borne_by = |pose, part, of: Onset| {
            let load = self.model.load(pose, self.hand(part), self.grip);
            let mu = self.shared(pose, part, (touches, of));
            (borne(load.force, normal), mu)
        };
        let fixed = |part| {
            let (reaction, mu) = borne_by(self.last.pose, part, onset);
            Some(static_excess(reaction, mu))
        };
        let sliding = |part| {
            let (reaction, mu) = borne_by(self.next.pose, part, |face| face.friction_dynamic);
            Some(drive(reaction, mu, sign))
        };
        self.ends(Way(&fixed), Way(&sliding), false).0
    }

    /// The friction of an edge: if the two differ, their combined friction.
    fn shared(&self, pose: [f64; 3], part: f64, (touches, of): ([Touch; 2], Onset)) -> f64 {
        let faces = touches.map(|touch| self.model.face(pose, touch));
        if faces[0].rubs_as(&faces[1]) {
            return of(&faces[0]);
        }
        let [first, second] = touches.map(|touch| self.model.foot(pose, touch));
        let load = self.model.load(pose, self.hand(part), self.grip);
        let lever = sub(first, self.model.holding_point(pose, self.grip));
        let about_first = load.moment - cross(lever, load.force);
        let normal = -dot(load.force, faces[0].normal);
        let share = -about_first / dot(sub(second, first), faces[0].tangent()) / normal;
        of(&faces[0]) * (1.0 - share) + of(&faces[1]) * share
    }

    /// Two contacts off one line: the interval of (E5), and (E6).
    pub(super) fn two_vertex(&self, contacts: [&'a Contact; 2], onset: Onset) -> Vec<Finding> {
        if contacts
            .iter()
            .all(|contact| self.direction(contact).is_none())
        {
            return Vec::new();
        }
        let brace = |frame: &Frame| Brace {
            model: self.model,
            grip: self.grip,
            pose: frame.pose,
            contacts,
        };
        let (old, new) = (brace(self.last), brace(self.next));
        let holding = |frame: &Frame| self.model.holding_point(frame.pose, self.grip);
        let way: Vec2 = sub(holding(self.next), holding(self.last));
        let motion = (way, self.next.pose[2] - self.last.pose[2]);
        let fixed = |part| Some(old.excess(self.hand(part), onset));
        let sliding = |part| Some(new.drive(self.hand(part), motion));
        self.ends(Way(&fixed), Way(&sliding), true).0
    }
}
