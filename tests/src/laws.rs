//! An independent judge: whether a frame obeys the laws, in f64, from nothing but the scene and the printed frame.
//! It knows no history: a wrong branch in balance passes here and fails in the analytic tests.

use crate::number::Number;
use crate::run::Frame;
use crate::setup::Setup;
use std::collections::BTreeSet;
use stiction_core::{Contact, StateKind, Status};

/// The law that every frame obeys, whatever its status.
pub const FINITE: &str = "every number is finite";

/// How far a frame is from one law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The law.
    pub law: &'static str,
    /// Relative residual; 0 if the law holds exactly.
    pub residual: f64,
    /// The residual up to which it holds.
    pub bound: f64,
}

impl Finding {
    /// The residual in units of its bound; infinite where it is not a number.
    pub fn severity(&self) -> f64 {
        let severity = self.residual / self.bound;
        if severity.is_nan() {
            f64::INFINITY
        } else {
            severity
        }
    }
    /// The law holds.
    pub fn holds(&self) -> bool {
        self.severity() <= 1.0
    }
}

/// The finding that is worst in units of its bound.
pub fn worst(findings: impl IntoIterator<Item = Finding>) -> Finding {
    let none = Finding {
        law: "none",
        residual: 0.0,
        bound: 1.0,
    };
    let graver = |a: Finding, b: Finding| if b.severity() > a.severity() { b } else { a };
    findings.into_iter().fold(none, graver)
}

/// Asserts every law on every frame of a run.
#[track_caller]
pub fn assert_lawful<R: Number>(setup: &Setup, frames: &[Frame]) {
    for (i, frame) in frames.iter().enumerate() {
        let Finding {
            law,
            residual,
            bound,
        } = worst(judge::<R>(setup, frame));
        assert!(
            residual <= bound,
            "{} frame {i}: {law} off by {residual:.2e}, allowed {bound:.0e}: {frame:?}",
            R::NAME
        );
    }
}

/// Every law on one frame. Forces are relative to the largest force in the frame, moments to that force × L, lengths
/// to L, none finer than the printed pose can carry (64 roundings of coordinate × stiffness).
pub fn judge<R: Number>(setup: &Setup, frame: &Frame) -> Vec<Finding> {
    let setup = setup.rounded::<R>();
    let mut findings = vec![finite(frame), name(frame)];
    findings.extend(geometry::<R>(&setup, frame));
    if frame.status == Status::Ambiguous {
        // No motion is consistent: the body stays, out of balance, and says so (STATICS 9, rule 8).
    } else if frame.held && setup.holding_point.is_some() {
        findings.extend(statics::<R>(&setup, frame));
    } else {
        let size = frame.wrench.iter().fold(0.0, |sum, w| sum + w.abs());
        findings.push(law("a hand that does not hold gives no wrench", size, 0.0));
    }
    findings
}

/// Between two frames in which nothing happens a contact that sticks stays where it is (mu_s > mu_d).
pub fn creep<R: Number>(setup: &Setup, last: &Frame, next: &Frame) -> Finding {
    let quiet = next.events.is_empty() && next.status == Status::Ok;
    let sticks = |c: &&Contact<f64>| {
        let surface = setup.surfaces[c.surface];
        quiet && surface.friction_static > surface.friction_dynamic
    };
    let moved = next.contacts.iter().filter(sticks).flat_map(|c| {
        let same = last
            .contacts
            .iter()
            .filter(|b| (b.vertex, b.surface) == (c.vertex, c.surface));
        same.map(|b| distance(b.point, c.point))
    });
    let farthest = moved.fold(0.0, f64::max);
    law(
        "a contact that sticks stays",
        farthest / extent(setup, next),
        2.0 * R::GAP,
    )
}

fn law(law: &'static str, residual: f64, bound: f64) -> Finding {
    Finding {
        law,
        residual,
        bound: bound.max(f64::MIN_POSITIVE),
    }
}

fn finite(frame: &Frame) -> Finding {
    let contact = |c: &Contact<f64>| [c.point[0], c.point[1], c.normal, c.friction];
    let scalars = [frame.depth, frame.longest_slip];
    let mut numbers = frame
        .hand
        .into_iter()
        .chain(frame.pose)
        .chain(frame.wrench)
        .chain(scalars);
    let all =
        numbers.all(f64::is_finite) && frame.contacts.iter().flat_map(contact).all(f64::is_finite);
    law(FINITE, f64::from(!all), 0.0)
}

fn name(frame: &Frame) -> Finding {
    let vertices: BTreeSet<_> = frame.contacts.iter().map(|c| c.vertex).collect();
    let surfaces: BTreeSet<_> = frame.contacts.iter().map(|c| c.surface).collect();
    let expected = match (frame.contacts.len(), vertices.len(), surfaces.len()) {
        (0, ..) => StateKind::NonContact,
        (1, ..) => StateKind::SingleVertex,
        (2, 1, _) => StateKind::Corner,
        (2, _, 1) => StateKind::Edge,
        (2, ..) => StateKind::TwoVertex,
        _ => StateKind::Locked,
    };
    law(
        "the state is named after its contacts",
        f64::from(frame.state != expected),
        0.0,
    )
}

fn geometry<R: Number>(setup: &Setup, frame: &Frame) -> Vec<Finding> {
    let size = extent(setup, frame);
    let (mut penetration, mut off, mut apart) = (0.0f64, 0.0f64, 0.0f64);
    for i in 0..setup.surfaces.len() {
        for &v in &setup.vertices {
            penetration = penetration.max(-gap(setup, i, setup.world(frame.pose, v)));
        }
    }
    for c in &frame.contacts {
        let place = setup.world(frame.pose, setup.vertices[c.vertex]);
        off = off.max(gap(setup, c.surface, place).abs());
        apart = apart.max(distance(place, c.point));
    }
    vec![
        law("no vertex is inside a surface", penetration / size, R::GAP),
        law("a contact is on its surface", off / size, R::GAP),
        law("a contact is at its vertex", apart / size, R::GAP),
    ]
}

fn statics<R: Number>(setup: &Setup, frame: &Frame) -> Vec<Finding> {
    let (k_h, k_theta, l) = (
        setup.stiffness_translation,
        setup.stiffness_rotation,
        setup.size(),
    );
    let holding = setup.world(frame.pose, setup.holding_point.unwrap_or_default());
    let force = sub(frame.hand_position(), holding).map(|x| k_h * x);
    let moment = k_theta * (frame.hand[2] - frame.pose[2]);
    let weight = [0.0, -setup.weight];
    let centroid = setup.world(frame.pose, setup.centroid());
    let mut sum = add(force, weight);
    let mut turning = moment + cross(sub(centroid, holding), weight);
    let mut largest = length(force).max(setup.weight);
    let (mut outside, mut pulling) = (0.0f64, 0.0f64);
    for c in &frame.contacts {
        let n = unit(setup.surfaces[c.surface].normal);
        let reaction = add(
            n.map(|x| x * c.normal),
            [n[1] * c.friction, -n[0] * c.friction],
        );
        let place = setup.world(frame.pose, setup.vertices[c.vertex]);
        let mu = setup.surfaces[c.surface].friction_static;
        sum = add(sum, reaction);
        turning += cross(sub(place, holding), reaction);
        largest = largest.max(length(reaction));
        outside = outside.max((c.friction.abs() - mu * c.normal) / mu.hypot(1.0));
        pulling = pulling.max(-c.normal);
    }
    let farthest = frame
        .hand
        .iter()
        .chain(&frame.pose)
        .take(2)
        .chain(&frame.pose[..2])
        .chain(frame.contacts.iter().flat_map(|contact| &contact.point))
        .fold(l, |m, x| m.max(x.abs()));
    let turns = frame.pose[2].abs().max(frame.hand[2].abs()).max(1.0);
    let carried = 64.0 * R::ROUNDING / R::RESIDUAL;
    let f = largest.max(carried * k_h * farthest).max(f64::MIN_POSITIVE);
    let m = f.max(moment.abs() / l).max(carried * k_theta * turns / l);
    let reaction_scale = if frame.contacts.len() > 1 { m } else { f };
    let [fx, fy, told] = frame.wrench;
    let springs = (distance([fx, fy], force) / f).max((told - moment).abs() / (m * l));
    vec![
        law("forces balance", length(sum) / f, R::RESIDUAL),
        law("moments balance", turning.abs() / (m * l), R::RESIDUAL),
        law("the wrench is that of the springs", springs, R::RESIDUAL),
        law(
            "friction is in its cone",
            outside / reaction_scale,
            R::RESIDUAL,
        ),
        law(
            "surfaces do not pull",
            pulling / reaction_scale,
            R::RESIDUAL,
        ),
    ]
}

/// The length to which gaps are relative: L, or the farthest coordinate where that is larger.
fn extent(setup: &Setup, frame: &Frame) -> f64 {
    let l = setup.size();
    let offsets = setup.surfaces.iter().map(|s| s.offset);
    let far = frame.pose[..2]
        .iter()
        .copied()
        .chain(offsets)
        .fold(l, |m, x| m.max(x.abs()));
    far.max(l * frame.pose[2].abs())
}

/// n·place - b
fn gap(setup: &Setup, surface: usize, place: [f64; 2]) -> f64 {
    let surface = setup.surfaces[surface];
    let n = unit(surface.normal);
    n[0] * place[0] + n[1] * place[1] - surface.offset
}

impl Frame {
    /// x, y (m) of the hand.
    pub fn hand_position(&self) -> [f64; 2] {
        [self.hand[0], self.hand[1]]
    }
}

fn add(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}
fn sub(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}
fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
fn length(a: [f64; 2]) -> f64 {
    a[0].hypot(a[1])
}
fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    length(sub(a, b))
}
fn unit(a: [f64; 2]) -> [f64; 2] {
    a.map(|x| x / length(a))
}
