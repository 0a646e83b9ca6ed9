//! The laws of a single frame among obstacles, from geometry and statics alone: they use no code of the solver and remember nothing.
//!
//! Tolerances are those of the laws among half-planes: the number type's bounds for gaps and balance, each at least 64 roundings
//! of the farthest coordinate. Corners add one length, [`SNAP`].

use super::rooms::beyond as beyond_cell;
use super::run::{Contact, Frame};
use super::scene::Among;
use super::shape::{Point, dot, length, placed, separation, sub};
use crate::number::Number;
use stiction_core::Status;

mod line;
mod statics;

/// Every number is finite, and there are as many touches as contacts.
pub const FINITE: &str = "every number is finite";
/// The body overlaps no obstacle and no half-plane.
pub const OUTSIDE: &str = "the body is outside";
/// The body is in the closed room that it was in.
pub const STAYS: &str = "the body stays in its room";
/// A contact is on the line of its side.
pub const ON_LINE: &str = "a contact is on its line";
/// A contact lies between the ends of its side.
pub const ON_SIDE: &str = "a contact is on its side";
/// Each shape lies on its own side of the line of contact.
pub const SUPPORTS: &str = "the normal of a contact supports";
/// `direction` and `point` are those that follow from the pose.
pub const PLACE: &str = "a contact is where it says";
/// The pair of features exists: a pin has no sides, nor has a point.
pub const PAIR: &str = "a contact is a pair of features";
/// No contact is listed twice.
pub const ONCE: &str = "a contact is there once";
/// The state is named after the number of contacts.
pub const NAME: &str = "the state is named after its contacts";
/// N >= 0
pub const PUSH: &str = "obstacles do not pull";
/// |T| <= mu_s N
pub const CONE: &str = "friction is in its cone";
/// F = k_h (p_h - G), M = k_theta (phi - theta)
pub const WRENCH: &str = "the wrench is that of the springs";
/// The forces of hand, weight and reactions sum to zero.
pub const FORCES: &str = "forces balance";
/// The moments of hand, weight and reactions sum to zero.
pub const MOMENTS: &str = "moments balance";

/// Shorter lengths count as zero, in body sizes: two sides that overlap by less make one contact; two sides whose ends are nearer than
/// this are flat on each other. So a contact may lie past the end of its side, and a neighbour behind the line of contact, by this much.
pub const SNAP: f64 = 1.0 / 524_288.0;
/// Accumulated rounding error of a length, in roundings of a coordinate, as among half-planes.
const CARRIED: f64 = 64.0;
/// The judge expects no more contacts than the solver lists.
const LISTED: usize = stiction_core::MAX_CONTACTS;

/// A law that a frame breaks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The law's name.
    pub law: &'static str,
    /// The violation relative to the tolerance: more than 1.
    pub amount: f64,
    /// The violation in body sizes, rad, or fractions of the largest force of the frame.
    pub residual: f64,
}

/// Judges frames of one scene.
#[derive(Clone, Debug)]
pub struct Laws {
    among: Among,
    /// L (m)
    size: f64,
    /// The farthest coordinate of the surroundings (m).
    farthest: f64,
    residual: f64,
    gap: f64,
    rounding: f64,
}

/// The tolerances of lengths in a frame (m).
#[derive(Clone, Copy, Debug)]
struct Lengths {
    gap: f64,
    side: f64,
}

impl Laws {
    /// Laws for the scene as the number type rounds it.
    pub fn new<R: Number>(among: &Among) -> Self {
        let among = among.rounded::<R>();
        let corners = among.obstacles.iter().flat_map(|o| &o.vertices);
        let offsets = among.setup.surfaces.iter().map(|s| {
            let [x, y] = s.normal;
            (s.offset / x.hypot(y)).abs()
        });
        let coordinates = corners.flatten().map(|x| x.abs()).chain(offsets);
        Self {
            size: among.setup.size(),
            farthest: coordinates.fold(0.0, f64::max),
            residual: R::RESIDUAL,
            gap: R::GAP,
            rounding: R::ROUNDING,
            among,
        }
    }

    /// The laws that a frame breaks. If the status says that the pose is out of balance, or no hand holds the body, forces are not judged.
    pub fn broken(&self, frame: &Frame) -> Vec<Finding> {
        let mut findings = Findings::default();
        if !is_finite(frame) || frame.unequal {
            findings.add(FINITE, 1.0, 0.0);
            return findings.0;
        }
        let body = placed(&self.among.setup.vertices, frame.pose);
        self.names(frame, &mut findings);
        self.geometry(frame, &body, &mut findings);
        if frame.held && !excuses_balance(frame.status) {
            self.statics(frame, &body, &mut findings);
        }
        findings.0
    }

    /// The laws that a frame breaks if its body is in a closed room.
    pub fn broken_in(&self, room: Option<&[Point]>, frame: &Frame) -> Vec<Finding> {
        let mut findings = Findings(self.broken(frame));
        if let Some(cell) = room {
            let body = placed(&self.among.setup.vertices, frame.pose);
            findings.add(STAYS, beyond_cell(cell, &body), self.lengths(frame).gap);
        }
        findings.0
    }

    fn lengths(&self, frame: &Frame) -> Lengths {
        let reach = self.reach(frame);
        let gap = (self.gap * reach).max(CARRIED * self.rounding * reach);
        Lengths {
            gap,
            side: gap + SNAP * self.size,
        }
    }

    /// The farthest coordinate, or the arc that a vertex travels as the body turns by its whole angle (m).
    fn reach(&self, frame: &Frame) -> f64 {
        let [x, y, theta] = frame.pose;
        let own = self.size.max(self.size * theta.abs());
        own.max(x.abs()).max(y.abs()).max(self.farthest)
    }

    fn names(&self, frame: &Frame, findings: &mut Findings) {
        let touches = frame.touches();
        let is_named = match touches.len() {
            0 => frame.state == "non-contact",
            1 => frame.state == "single-vertex",
            2 => ["edge", "two-vertex", "corner"].contains(&frame.state),
            _ => frame.state == "locked",
        };
        findings.add(NAME, f64::from(!is_named), 0.0);
        let twice = touches.windows(2).any(|pair| pair[0] == pair[1]);
        findings.add(ONCE, f64::from(twice), 0.0);
    }

    fn geometry(&self, frame: &Frame, body: &[Point], findings: &mut Findings) {
        let allowed = self.lengths(frame);
        let deepest = self.deepest(body);
        findings.add(OUTSIDE, deepest, allowed.gap);
        for contact in &frame.contacts {
            let Some(line) = self.line(body, contact.touch) else {
                findings.add(PAIR, 1.0, 0.0);
                continue;
            };
            findings.add(ON_LINE, line.gap.abs(), allowed.gap);
            findings.add(ON_SIDE, line.beyond, allowed.side);
            findings.add(SUPPORTS, line.behind, allowed.side);
            let moved = length(sub(contact.point, line.point));
            findings.add(PLACE, moved, allowed.side);
            let turned = length(sub(contact.direction, line.normal));
            // The direction is as accurate as the body's angle.
            let turns = frame.pose[2].abs().max(1.0);
            findings.add(PLACE, turned, self.gap.max(CARRIED * self.rounding) * turns);
        }
    }

    /// The depth of the body in any obstacle or half-plane at a pose (m); negative if it is clear of all.
    pub fn depth(&self, pose: [f64; 3]) -> f64 {
        self.deepest(&placed(&self.among.setup.vertices, pose))
    }

    /// The same for vertices in the world frame.
    fn deepest(&self, body: &[Point]) -> f64 {
        let obstacles = self.among.obstacles.iter();
        let obstacles = obstacles.map(|o| match (body, o.vertices.as_slice()) {
            // Points have no inside.
            ([_], [_]) => f64::NEG_INFINITY,
            _ => -separation(body, &o.vertices),
        });
        let surfaces = self.among.setup.surfaces.iter().map(|s| {
            let long = length(s.normal);
            let gaps = body.iter().map(|&p| dot(s.normal, p) / long);
            s.offset / long - gaps.fold(f64::INFINITY, f64::min)
        });
        obstacles.chain(surfaces).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// The broken laws, each listed once with its largest amount.
#[derive(Default)]
struct Findings(Vec<Finding>);

impl Findings {
    fn add(&mut self, law: &'static str, residual: f64, allowed: f64) {
        // NaN fails this comparison and is recorded as well.
        if residual <= allowed {
            return;
        }
        let amount = if allowed > 0.0 {
            residual / allowed
        } else {
            f64::INFINITY
        };
        let finding = Finding {
            law,
            amount,
            residual,
        };
        match self.0.iter_mut().find(|f| f.law == law) {
            Some(known) if known.amount >= amount => {}
            Some(known) => *known = finding,
            None => self.0.push(finding),
        }
    }
}

/// Whether a frame with this status may be out of balance.
pub fn excuses_balance(status: Status) -> bool {
    !matches!(status, Status::Ok | Status::EventLimit | Status::Twist)
}

fn is_finite(frame: &Frame) -> bool {
    let numbers = frame.pose.iter().chain(&frame.hand).chain(&frame.wrench);
    let of_contact = |c: &Contact| {
        let [[x, y], [nx, ny]] = [c.point, c.direction];
        [x, y, nx, ny, c.normal, c.friction]
    };
    let contacts = frame.contacts.iter().flat_map(of_contact);
    numbers.copied().chain(contacts).all(f64::is_finite)
}
