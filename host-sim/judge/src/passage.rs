//! From one frame to the next among obstacles: contacts change only if an event is reported, or if a slide passes an end of a side;
//! and no side is passed through, if the path between the frames is known.
//!
//! **The path.** If nothing happens, a body in the air moves straight in holding point and angle, as the hand does. A body that
//! sticks on a single contact turns about it. All other paths cannot be derived from two frames and are not judged, with one
//! exception: a single contact whose reaction stays within dynamic friction along the whole path of the hand is not left at all,
//! whatever slips are reported.
//!
//! A vertex passes through a side if its gap to the side closes between the side's ends; a corner does if its gap to a side of the
//! body closes. The amount is the smaller of its greatest depth and of its distance from the end where it entered.

use stiction_core::{Event, Touch};

use crate::finding::{Finding, law};
use crate::frame::{Contact, Frame};
use crate::model::Model;
use crate::obstacles::{OVERLAP, placed};
use crate::onset::Way;
use crate::pin::follow;
use crate::scene::Scene;
use crate::shape::{ends, gap_of_segments, outward, separation};
use crate::slip::{Step, static_excess};
use crate::vector::{Vec2, add, between, distance, dot, scaled, sub, turned};

/// Points on a path at which the pose is evaluated.
const PLACES: u32 = 64;
/// Halvings when locating the point at which a gap closes.
const HALVINGS: u32 = 40;

pub(crate) fn findings(step: &Step<'_>) -> Vec<Finding> {
    let usable = step.last.is_usable() && step.next.is_usable() && !step.next.is_taken();
    if step.model.scene.obstacles.is_empty() || !usable {
        return Vec::new();
    }
    let changes = changes(step).map(|holds| Finding::whether(law::PASSED_ON, holds));
    let through = through(step).map(|depth| {
        let scale = [step.last, step.next].map(|f| step.model.length_scale(f, step.bounds));
        Finding::new(law::PASSES, depth / scale[0].max(scale[1]), step.bounds.gap)
    });
    let let_go = let_go(step).map(|let_go| Finding::whether(law::HOLDS, !let_go));
    changes.into_iter().chain(through).chain(let_go).collect()
}

/// The longest path of a vertex (m).
fn motion(model: &Model, from: [f64; 3], to: [f64; 3]) -> f64 {
    let ways = placed(model, from).into_iter().zip(placed(model, to));
    ways.map(|(a, b)| distance(a, b)).fold(0.0, f64::max)
        + model.size * ((to[2] - from[2]).abs() - 1.0).max(0.0)
}

/// Whether, without an event, every lost contact with an obstacle was replaced by a current one, and every new contact replaced an old one.
fn changes(step: &Step<'_>) -> Option<bool> {
    let (model, last, next) = (step.model, step.last, step.next);
    if !next.events.is_empty() || !(last.meets_obstacles() || next.meets_obstacles()) {
        return None;
    }
    let changed = |of: &Frame, other: &Frame| -> Vec<Contact> {
        let new = |contact: &&Contact| other.contact(contact.touch).is_none();
        of.contacts.iter().filter(new).copied().collect()
    };
    let (lost, gained) = (changed(last, next), changed(next, last));
    if lost.is_empty() && gained.is_empty() {
        return Some(true);
    }
    let tells = [last, next].map(|frame| frame.contacts.is_empty() || frame.tells_slides());
    if tells == [true; 2] && !last.slides() && !next.slides() {
        return Some(false);
    }
    let scale = model
        .length_scale(last, step.bounds)
        .max(model.length_scale(next, step.bounds));
    let near = motion(model, last.pose, next.pose)
        + 2.0 * (OVERLAP * model.size + step.bounds.gap * scale);
    let passed = |a: &Contact, b: &Contact| {
        let places = [
            model.foot(last.pose, a.touch),
            model.foot(next.pose, b.touch),
        ];
        distance(places[0], places[1]) <= near && are_neighbours(model, [a.touch, b.touch], near)
    };
    let comes = |b: &Contact| last.contacts.iter().any(|a| passed(a, b));
    let goes = |a: &Contact| next.contacts.iter().any(|b| passed(a, b));
    Some(lost.iter().all(goes) && gained.iter().all(comes))
}

/// Whether two pairs belong to the same or neighbouring vertices and sides, of the body and of its surroundings.
fn are_neighbours(model: &Model, pairs: [Touch; 2], near: f64) -> bool {
    let of_body = |touch| match touch {
        Touch::Surface { vertex, .. } | Touch::Side { vertex, .. } => {
            [model.scene.vertices[vertex]; 2]
        }
        Touch::Corner { body_side, .. } => ends(&model.scene.vertices, body_side),
    };
    let of_obstacle = |touch| -> Option<[Vec2; 2]> {
        let shape = |obstacle: usize| &model.scene.obstacles[obstacle].vertices;
        match touch {
            Touch::Surface { .. } => None,
            // Including the sides that form one line with it.
            Touch::Side { obstacle, side, .. } => {
                let normal = outward(shape(obstacle), side);
                let foot = scaled(normal, dot(normal, shape(obstacle)[side]));
                let along = |place: f64| add(foot, scaled([normal[1], -normal[0]], place));
                Some(model.sides.run(obstacle, side).map(along))
            }
            Touch::Corner {
                obstacle, corner, ..
            } => Some([shape(obstacle)[corner]; 2]),
        }
    };
    let [a, b] = pairs.map(of_body);
    let around = match pairs.map(of_obstacle) {
        [Some(a), Some(b)] => gap_of_segments(a, b) <= near,
        // Between a half-plane and an obstacle that stands on it, only positions count; there is no passage between half-planes.
        [None, None] => false,
        _ => true,
    };
    gap_of_segments(a, b) <= near && around
}

/// How far the body passes through a side (m), if its path is known.
fn through(step: &Step<'_>) -> Option<f64> {
    let (model, last, next) = (step.model, step.last, step.next);
    match (last.contacts.as_slice(), next.contacts.as_slice()) {
        ([], []) if next.events.is_empty() => {
            let way = Straight::new(step, last.pose, next.pose);
            Some(way.through(&|part| way.at(part)))
        }
        ([contact], [same]) if next.events.is_empty() && sticks(last) && sticks(next) => {
            let touch = contact.touch;
            if same.touch != touch {
                return None;
            }
            let spot = model.spot(last.pose, touch);
            let way = Straight::new(step, last.pose, next.pose);
            Some(way.through(&|part| {
                let turn = last.pose[2] + part * (next.pose[2] - last.pose[2]);
                let [x, y] = sub(spot.at, turned(spot.held, turn));
                [x, y, turn]
            }))
        }
        _ => None,
    }
}

fn sticks(frame: &Frame) -> bool {
    (frame.contacts.iter()).all(|contact| contact.sliding == Some(0))
}

/// Whether a single sticking contact with an obstacle was left, although dynamic friction holds it along the whole path of the hand
/// and nothing else happened.
fn let_go(step: &Step<'_>) -> Option<bool> {
    let (model, last, next) = (step.model, step.last, step.next);
    let [contact] = last.contacts.as_slice() else {
        return None;
    };
    let touch = contact.touch;
    let alone = |event: &Event| {
        matches!(
            event,
            Event::Lift | Event::Slip | Event::Slide | Event::Stop
        )
    };
    if touch.obstacle().is_none() || !sticks(last) || !next.events.iter().all(alone) {
        return None;
    }
    if next.contact(touch).is_some() {
        return Some(false);
    }
    let foot = step.foot(touch);
    let spot = model.spot(last.pose, touch);
    let pin = |part| foot.pinned(spot, between(last.hand, next.hand, part));
    let mu = model.face(last.pose, touch).friction_dynamic;
    let excess = |part| {
        let turn = follow(pin, last.pose[2], part)?;
        Some(static_excess(pin(part).reaction(turn), mu))
    };
    let excess = Way(&excess);
    let holds = excess.at(1.0).is_finite() && excess.reaches(-step.allowed(false), 0.0).is_err();
    Some(holds)
}

/// A straight path of holding point and angle.
struct Straight<'a> {
    step: &'a Step<'a>,
    held: Vec2,
    /// The holding point and the angle at the start.
    from: [f64; 3],
    to: [f64; 3],
    /// The largest displacement of a vertex on the path, and its largest deviation from it if a weight turns the body (m).
    longest: f64,
    off: f64,
    /// The most negative gap that counts as closed (m).
    allowed: f64,
}

impl<'a> Straight<'a> {
    fn new(step: &'a Step<'a>, from: [f64; 3], to: [f64; 3]) -> Self {
        let held = step.grip.point;
        let holding = |pose: [f64; 3]| {
            let [x, y] = Scene::place(pose, held);
            [x, y, pose[2]]
        };
        let (from, to) = (holding(from), holding(to));
        let turn = (to[2] - from[2]).abs();
        let arms = step.model.scene.vertices.iter().map(|&v| distance(v, held));
        let arm = arms.fold(0.0, f64::max);
        let weighs = step.model.scene.weight > 0.0;
        Self {
            step,
            held,
            from,
            to,
            longest: distance([from[0], from[1]], [to[0], to[1]]) + arm * turn,
            off: if weighs { arm * turn } else { 0.0 },
            allowed: step.bounds.gap * step.model.length_scale(step.last, step.bounds),
        }
    }

    fn pose(&self, [x, y, turn]: [f64; 3]) -> [f64; 3] {
        let [x, y] = sub([x, y], turned(self.held, turn));
        [x, y, turn]
    }

    fn at(&self, part: f64) -> [f64; 3] {
        self.pose(between(self.from, self.to, part))
    }

    /// How far the body passes through a side (m) on a path that is no longer than this one.
    fn through(&self, way: &dyn Fn(f64) -> [f64; 3]) -> f64 {
        let model = self.step.model;
        let body = placed(model, way(0.0));
        let near = |&obstacle: &usize| {
            let shape = &model.scene.obstacles[obstacle].vertices;
            separation(&body, shape) <= self.longest + self.allowed
        };
        let obstacles = (0..model.scene.obstacles.len()).filter(near);
        let pairs = obstacles.flat_map(|obstacle| model.pairs_with(obstacle));
        pairs
            .map(|touch| self.entered(way, touch))
            .fold(0.0, f64::max)
    }

    /// How far the side of one pair is passed through (m).
    fn entered(&self, way: &dyn Fn(f64) -> [f64; 3], touch: Touch) -> f64 {
        let model = self.step.model;
        let gap = |part: f64| model.gap(way(part), touch) + self.allowed;
        let part = |i: u32| f64::from(i) / f64::from(PLACES);
        let mut before = gap(0.0);
        // What is entered between the ends of the side was no farther from it than the path is long.
        if before > self.longest + self.allowed {
            return 0.0;
        }
        // Distance from the ends where it entered.
        let mut inside: Option<f64> = None;
        let mut most = 0.0_f64;
        for i in 1..=PLACES {
            let after = gap(part(i));
            if after >= 0.0 {
                inside = None;
            } else if before >= 0.0 {
                let place = zero(&gap, part(i - 1), part(i));
                inside = Some(model.inside_ends(way(place), touch) - self.off - self.allowed);
            }
            if let Some(inside) = inside {
                most = most.max(inside.min(-after));
            }
            before = after;
        }
        most
    }
}

/// The point at which a gap closes that is open at one point and closed at another.
fn zero(gap: &dyn Fn(f64) -> f64, mut open: f64, mut closed: f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(open, closed);
        if gap(middle) >= 0.0 {
            open = middle;
        } else {
            closed = middle;
        }
    }
    open
}
