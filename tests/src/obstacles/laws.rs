//! The laws of a single frame among obstacles, by geometry and statics alone: no code of the solver, nothing remembered.
//!
//! Tolerances are those of the laws among half-planes: the number type's bounds for gaps and balance, none of them finer than 64
//! roundings of the farthest coordinate. Corners add one length, [`SNAP`].

use super::rooms::beyond as beyond_cell;
use super::run::{Contact, Frame};
use super::scene::Among;
use super::shape::{
    Point, centroid, cross, dot, ends, length, neighbours, outward, placed, separation, sub,
    tangent,
};
use crate::number::Number;
use crate::reference::Touch;
use stiction_core::Status;

/// Every number is finite, and there are as many touches as contacts.
pub const FINITE: &str = "every number is finite";
/// The body overlaps no obstacle and no half-plane.
pub const OUTSIDE: &str = "the body is outside";
/// The body is in the closed room that it was in.
pub const STAYS: &str = "the body stays in its room";
/// A contact is on the line of its side.
pub const ON_LINE: &str = "a contact is on its line";
/// A contact is between the ends of its side.
pub const ON_SIDE: &str = "a contact is on its side";
/// Both shapes are on their sides of the line of contact.
pub const SUPPORTS: &str = "the normal of a contact supports";
/// `direction` and `point` are those of the pose.
pub const PLACE: &str = "a contact is where it says";
/// No contact is there twice.
pub const ONCE: &str = "a contact is there once";
/// The state is named after the number of contacts.
pub const NAME: &str = "the state is named after its contacts";
/// N >= 0
pub const PUSH: &str = "obstacles do not pull";
/// |T| <= mu_s N
pub const CONE: &str = "friction is in its cone";
/// F = k_h (p_h - G), M = k_theta (phi - theta)
pub const WRENCH: &str = "the wrench is that of the springs";
/// Hand, weight and reactions add up to no force.
pub const FORCES: &str = "forces balance";
/// Hand, weight and reactions add up to no moment.
pub const MOMENTS: &str = "moments balance";

/// What is shorter counts as nothing, in body sizes: an overlap of two sides below it is one contact, two sides whose ends are
/// nearer than it are flat on each other. So a contact may be beside its side, and a neighbour behind the line of contact, by so much.
pub const SNAP: f64 = 1.0 / 524_288.0;
/// Roundings of a coordinate that a length carries, as among half-planes.
const CARRIED: f64 = 64.0;
/// A judge of frames asks for no more contacts than the solver lists.
const LISTED: usize = stiction_core::MAX_CONTACTS;

/// A law that a frame breaks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// Which.
    pub law: &'static str,
    /// By how much, in units of what is allowed: more than 1.
    pub amount: f64,
    /// The same in body sizes, rad, or parts of the largest force of the frame.
    pub residual: f64,
}

/// Judges frames of one scene.
#[derive(Clone, Debug)]
pub struct Laws {
    among: Among,
    /// L (m)
    size: f64,
    /// The farthest coordinate of what is around (m).
    farthest: f64,
    residual: f64,
    gap: f64,
    rounding: f64,
}

/// The lengths that are allowed in a frame (m).
#[derive(Clone, Copy, Debug)]
struct Lengths {
    gap: f64,
    side: f64,
}

/// Line and ends of a contact in a pose.
struct Line {
    point: Point,
    normal: Point,
    /// From the contact's line to its point, along the normal (m).
    gap: f64,
    /// How far the point is beyond the nearer end of its side (m).
    beyond: f64,
    /// The deepest neighbour behind the line (m).
    behind: f64,
}

impl Laws {
    /// For the scene as the number type takes it in.
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

    /// The laws that a frame breaks. Where the status says that the pose is out of balance nothing is asked of forces.
    pub fn broken(&self, frame: &Frame) -> Vec<Finding> {
        let mut findings = Findings::default();
        if !is_finite(frame) || frame.unequal {
            findings.add(FINITE, 1.0, 0.0);
            return findings.0;
        }
        let body = placed(&self.among.setup.vertices, frame.pose);
        self.names(frame, &mut findings);
        self.geometry(frame, &body, &mut findings);
        if !excuses_balance(frame.status) {
            self.statics(frame, &body, &mut findings);
        }
        findings.0
    }

    /// What a frame breaks whose body is in a closed room.
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

    /// The farthest coordinate, or the way of a vertex as the body turns by its whole angle (m).
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
                findings.add(PLACE, 1.0, 0.0);
                continue;
            };
            findings.add(ON_LINE, line.gap.abs(), allowed.gap);
            findings.add(ON_SIDE, line.beyond, allowed.side);
            findings.add(SUPPORTS, line.behind, allowed.side);
            let moved = length(sub(contact.point, line.point));
            findings.add(PLACE, moved, allowed.side);
            let turned = length(sub(contact.direction, line.normal));
            // The direction is known as the body's angle is.
            let turns = frame.pose[2].abs().max(1.0);
            findings.add(PLACE, turned, self.gap.max(CARRIED * self.rounding) * turns);
        }
    }

    /// How deep the body is in anything (m); negative where it is clear.
    fn deepest(&self, body: &[Point]) -> f64 {
        let obstacles = self.among.obstacles.iter();
        let obstacles = obstacles.map(|o| match (body, o.vertices.as_slice()) {
            // They have no inside.
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

    /// `None` where there is no such contact.
    fn line(&self, body: &[Point], touch: Touch) -> Option<Line> {
        let behind = |normal: Point, point: Point, others: &[Point], sign: f64| {
            let depth = others.iter().map(|&p| -sign * dot(normal, sub(p, point)));
            depth.fold(f64::NEG_INFINITY, f64::max)
        };
        match touch {
            Touch::Surface { vertex, surface } => {
                let surface = self.among.setup.surfaces.get(surface)?;
                let point = *body.get(vertex)?;
                let long = length(surface.normal);
                let normal = surface.normal.map(|n| n / long);
                Some(Line {
                    point,
                    normal,
                    gap: dot(normal, point) - surface.offset / long,
                    beyond: f64::NEG_INFINITY,
                    behind: behind(normal, point, &neighbours(body, vertex), 1.0),
                })
            }
            Touch::Side {
                vertex,
                obstacle,
                side,
            } => {
                let shape = &self.among.obstacles.get(obstacle)?.vertices;
                let point = *body.get(vertex)?;
                let (normal, gap, _) = side_of(shape, side, point)?;
                Some(Line {
                    point,
                    normal,
                    gap,
                    beyond: self.past(obstacle, side, point),
                    behind: behind(normal, point, &neighbours(body, vertex), 1.0),
                })
            }
            Touch::Corner {
                obstacle,
                corner,
                body_side,
            } => {
                let shape = &self.among.obstacles.get(obstacle)?.vertices;
                let point = *shape.get(corner)?;
                let (normal, gap, beyond) = side_of(body, body_side, point)?;
                let normal = normal.map(|x| -x);
                Some(Line {
                    point,
                    normal,
                    gap,
                    beyond,
                    behind: behind(normal, point, &neighbours(shape, corner), -1.0),
                })
            }
        }
    }

    /// How far a point is beyond the end of a side, or of what makes one line with it: the first of several coplanar sides is told
    /// for all of them, if they meet and have the same friction.
    fn past(&self, obstacle: usize, side: usize, point: Point) -> f64 {
        let all = &self.among.obstacles;
        let normal = outward(&all[obstacle].vertices, side);
        let seam = 1e-6 * self.size;
        let is_coplanar = |[from, to]: &[Point; 2]| {
            let [a, b] = ends(&all[obstacle].vertices, side);
            let off = [from, to].map(|p| dot(normal, sub(*p, a)).abs());
            let along = dot(sub(*to, *from), sub(b, a));
            off[0].max(off[1]) <= seam && along > 0.0
        };
        let others = all.iter().filter(|o| o.friction == all[obstacle].friction);
        let sides = others.flat_map(|o| {
            let count = super::shape::sides(&o.vertices);
            (0..count).map(|side| ends(&o.vertices, side))
        });
        let coplanar = sides.filter(is_coplanar);
        let past = coplanar.map(|side| beyond(side, point));
        past.fold(f64::INFINITY, f64::min)
    }

    fn mu(&self, touch: Touch) -> f64 {
        match touch {
            Touch::Surface { surface, .. } => self.among.setup.surfaces[surface].friction_static,
            Touch::Side { obstacle, .. } | Touch::Corner { obstacle, .. } => {
                self.among.obstacles[obstacle].friction[0]
            }
        }
    }

    fn statics(&self, frame: &Frame, body: &[Point], findings: &mut Findings) {
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
            let excess = contact.friction.abs() - self.mu(contact.touch) * contact.normal;
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

    /// What residuals are relative to, N: the largest force, and of moments over L the larger of it and the couple; none finer than
    /// what a rounding of the coordinates makes.
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
        let moment = (couple.abs() / self.size)
            .max(carried * setup.stiffness_rotation * turns / self.size)
            .max(floor * lever);
        Scale {
            force,
            moment: force.max(moment),
        }
    }
}

/// Forces that residuals are relative to (N).
struct Scale {
    force: f64,
    moment: f64,
}

/// What is wrong, each law once with its largest amount.
#[derive(Default)]
struct Findings(Vec<Finding>);

impl Findings {
    fn add(&mut self, law: &'static str, residual: f64, allowed: f64) {
        // What is not a number is no less than the bound.
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

/// The pose of such a frame may be out of balance.
pub fn excuses_balance(status: Status) -> bool {
    !matches!(status, Status::Ok | Status::EventLimit | Status::Twist)
}

/// Normal and gap of a point over a side of a shape, and how far it is beyond the side's ends; `None` where there is no such side.
fn side_of(shape: &[Point], side: usize, point: Point) -> Option<(Point, f64, f64)> {
    if side >= super::shape::sides(shape) {
        return None;
    }
    let normal = outward(shape, side);
    let both = ends(shape, side);
    Some((
        normal,
        dot(normal, sub(point, both[0])),
        beyond(both, point),
    ))
}

/// How far a point is beyond the ends of a side, along it; negative between them.
fn beyond([from, to]: [Point; 2], point: Point) -> f64 {
    let along = sub(to, from);
    let long = length(along);
    let place = dot(along, sub(point, from)) / long;
    (-place).max(place - long)
}

/// N n + T t
fn reaction(contact: &Contact) -> Point {
    let along = tangent(contact.direction);
    [0, 1].map(|k| contact.normal * contact.direction[k] + contact.friction * along[k])
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
