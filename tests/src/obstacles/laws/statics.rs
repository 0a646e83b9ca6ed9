//! The balance of a frame: springs, weight and reactions, friction within its cone. World frame, N, N·m about the holding point.

use super::super::run::{Contact, Frame};
use super::super::shape::{Point, centroid, cross, length, sub, tangent};
use super::{CARRIED, CONE, FORCES, Findings, LISTED, Laws, MOMENTS, PUSH, WRENCH};

impl Laws {
    pub(super) fn statics(&self, frame: &Frame, body: &[Point], findings: &mut Findings) {
        let setup = &self.among.setup;
        let grip = setup.world(frame.pose, setup.holding_point.unwrap_or_default());
        let [hx, hy, phi] = frame.hand;
        let spring = sub([hx, hy], grip).map(|x| setup.stiffness_translation * x);
        let couple = setup.stiffness_rotation * (phi - frame.pose[2]);
        let weight = [0.0, -setup.weight];
        let lever = sub(centroid(body), grip);
        let mut force = [spring[0], spring[1] + weight[1]];
        let mut moment = couple + cross(lever, weight);
        let scale = self.scale(frame, grip, (spring, couple));
        for contact in &frame.contacts {
            let reaction = reaction(contact);
            force = [0, 1].map(|k| force[k] + reaction[k]);
            moment += cross(sub(contact.point, grip), reaction);
            let Some(_) = self.line(body, contact.touch) else {
                continue;
            };
            let excess =
                contact.friction.abs() - self.among.friction(contact.touch)[0] * contact.normal;
            findings.add(PUSH, -contact.normal / scale.force, self.residual);
            findings.add(CONE, excess / scale.force, self.residual);
        }
        if frame.contacts.len() < LISTED {
            findings.add(FORCES, length(force) / scale.force, self.residual);
            let off = moment.abs() / self.size / scale.moment;
            findings.add(MOMENTS, off, self.residual);
        }
        let [fx, fy, m] = frame.wrench;
        let off = length(sub([fx, fy], spring)) / scale.force;
        findings.add(WRENCH, off, self.residual);
        let off = (m - couple).abs() / self.size / scale.moment;
        findings.add(WRENCH, off, self.residual);
    }

    /// The scale of the residuals (N): the largest force, and, for moments divided by L, the larger of that force and the couple;
    /// neither is smaller than the effect of rounding the coordinates.
    fn scale(&self, frame: &Frame, grip: Point, (spring, couple): (Point, f64)) -> Scale {
        let setup = &self.among.setup;
        let reactions = frame.contacts.iter().map(|c| c.normal.hypot(c.friction));
        let largest = reactions.fold(length(spring).max(setup.weight), f64::max);
        let carried = CARRIED * self.rounding / self.residual;
        let turns = frame.pose[2].abs().max(frame.hand[2].abs()).max(1.0);
        let [hx, hy, _] = frame.hand;
        let extent = self.reach(frame).max(hx.abs()).max(hy.abs());
        let floor = carried * setup.stiffness_translation * extent;
        let force = largest.max(floor).max(f64::MIN_POSITIVE);
        let levers = frame.contacts.iter().map(|c| length(sub(c.point, grip)));
        let lever = levers.fold(0.0, f64::max) / self.size;
        // The position of a contact is rounded like any coordinate, and its force acts there.
        let moment = (couple.abs() / self.size)
            .max(carried * setup.stiffness_rotation * turns / self.size)
            .max(floor * lever)
            .max(carried * largest * extent / self.size);
        Scale {
            force,
            moment: force.max(moment),
        }
    }
}

/// The forces that residuals are relative to (N).
struct Scale {
    force: f64,
    moment: f64,
}

/// N n + T t
fn reaction(contact: &Contact) -> Point {
    let along = tangent(contact.direction);
    [0, 1].map(|k| contact.normal * contact.direction[k] + contact.friction * along[k])
}
