//! Slips, from the previous frame and the hand's straight path: where they begin and where they end (STATICS 3.2, 4, 5, 7).
//!
//! In a frame with a single slip and nothing else, the contacts stick at their old positions until static friction gives
//! way; there the hand is frozen, the contacts move to their new positions and stick for the rest of the frame. So the old
//! positions and the hand's path give the fraction tau of the path at which the slip begins, and the new positions give the
//! balance at tau, in which |T| = mu_d N must hold. Nothing of this is taken from the solver.
//!
//! **Tolerance.** Positions are known to the rounding of the trace, forces therefore to that of coordinate × stiffness, and
//! tau to within the range tau_- <= tau <= tau_+ in which the old contacts come that close to the limit of static friction
//! and go that far beyond it. A slip is lawful if its end is valid for some tau in that range. If the limit is met steeply,
//! as is usual, the range is a point; if it is met at a grazing angle, the uncertainty of tau is not held against the trace.

use stiction_core::{Event, Evolution, StateKind as State, Touch};

use crate::finding::{Bounds, Finding, law};
use crate::frame::{Contact, Frame};
use crate::model::{Grip, Model, borne};
use crate::onset::Way;
use crate::pin::{Foot, Spot, follow};
use crate::slide::has_stiction;
use crate::touch::Face;
use crate::vector::{between, dot, sub};
use vertex::Slide;

mod chain;
mod pair;
mod vertex;

/// A solver that lists no more events than this may have omitted later ones.
pub(crate) const EVENTS: usize = 16;

/// The friction at which a slip begins.
pub(crate) type Onset = fn(&Face) -> f64;

/// A frame and the previous one.
#[derive(Clone, Copy)]
pub(crate) struct Step<'a> {
    pub(crate) model: &'a Model,
    pub(crate) bounds: &'a Bounds,
    pub(crate) evolution: Evolution,
    pub(crate) grip: &'a Grip,
    pub(crate) last: &'a Frame,
    pub(crate) next: &'a Frame,
}

/// The laws of slips on a frame; none if they do not apply.
pub(crate) fn findings(step: &Step<'_>) -> Vec<Finding> {
    if step.is_single() {
        return step.single(|_| true);
    }
    if step.goes_on() {
        return step.single(|finding| finding.law == law::SLIP_BEGINS);
    }
    let counted = step
        .counted()
        .map(|holds| Finding::whether(law::SLIPS, holds));
    step.last_of_several().into_iter().chain(counted).collect()
}

impl<'a> Step<'a> {
    /// Whether the frame has a single slip of contacts that existed before and still exist, and nothing else.
    fn is_single(&self) -> bool {
        let (last, next) = (self.last, self.next);
        next.events == [Event::Slip] && !next.slides() && self.slips_once(last)
    }

    /// Whether the contacts did not stick at the end of the slip, but slid on with the hand.
    fn goes_on(&self) -> bool {
        let is_slip = matches!(
            self.next.events.as_slice(),
            [Event::Slip] | [Event::Slip, Event::Slide]
        );
        is_slip && self.next.slides() && self.slips_once(self.last)
    }

    /// Whether contacts that stuck before and still exist slip exactly once.
    fn slips_once(&self, last: &Frame) -> bool {
        self.next.slips == 1 && self.slips_alone(last)
    }

    /// Whether the number of slips, if nothing else happens, is the number that leads from the old positions to the new ones.
    fn counted(&self) -> Option<bool> {
        let next = self.next;
        if next.events != [Event::Slip] || next.slides() || !self.slips_alone(self.last) {
            return None;
        }
        if !matches!(next.state, State::SingleVertex | State::Edge) {
            // If one slip explains the displacement, there are not several.
            let one = self.single(|_| true);
            let is_one = !one.is_empty() && one.iter().all(Finding::holds);
            return (self.evolution == Evolution::Path && is_one).then_some(next.slips == 1);
        }
        let count = chain::count(self, next.contacts.first()?)?;
        Some(count == next.slips)
    }

    /// Whether all contacts stuck before and still exist.
    fn slips_alone(&self, last: &Frame) -> bool {
        let next = self.next;
        next.is_followed()
            && next.complete
            && last.held
            && next.held
            && !last.slides()
            && next.has_contacts_of(last)
            && (next.contacts.iter()).all(|contact| self.face(contact.touch).jumps())
    }

    /// Line and friction of a contact of the next frame.
    fn face(&self, touch: Touch) -> Face {
        self.model.face(self.next.pose, touch)
    }

    /// The face that all contacts of a frame share, if their frictions are equal.
    pub(crate) fn one_friction(&self, frame: &Frame) -> Option<Face> {
        let of = |contact: &Contact| self.model.face(frame.pose, contact.touch);
        let first = of(frame.contacts.first()?);
        (frame.contacts.iter())
            .all(|contact| of(contact).rubs_as(&first))
            .then_some(first)
    }

    fn hand(&self, part: f64) -> [f64; 3] {
        between(self.last.hand, self.next.hand, part)
    }

    /// A force relative to the largest in both frames, with its bound.
    pub(crate) fn finding(&self, law: &'static str, force: f64, is_braced: bool) -> Finding {
        let Bounds { slip, rounding, .. } = *self.bounds;
        let scale = |frame| {
            let scale = self.model.scale(frame, self.grip, slip, rounding);
            if is_braced { scale.moment } else { scale.force }
        };
        Finding::new(law, force / scale(self.last).max(scale(self.next)), slip)
    }

    /// The findings on a slip that began at mu_s N. Otherwise on one that began at mu_d N, if the body may have had no
    /// stiction, as sliding contacts leave it (a trace does not report it), and no slide followed. On one surface, a slide
    /// normally does: a start at mu_d N is not accepted for a slip that goes on as a slide, nor for one of an edge.
    fn single(&self, counts: impl Fn(&Finding) -> bool) -> Vec<Finding> {
        let from = |onset: Onset| {
            let mut findings = match (self.next.state, self.next.contacts.as_slice()) {
                (State::SingleVertex, [contact]) => self.vertex(contact, onset),
                (State::Edge, [first, second]) => self.edge([first, second], onset),
                (State::TwoVertex, [first, second]) => self.two_vertex([first, second], onset),
                _ => Vec::new(),
            };
            findings.retain(&counts);
            findings
        };
        let findings = from(|face| face.friction_static);
        let holds = |findings: &[Finding]| findings.iter().all(Finding::holds);
        let may_lack = match self.next.state {
            State::TwoVertex => true,
            State::SingleVertex => !self.next.slides(),
            State::NonContact | State::Edge | State::Corner | State::Locked => false,
        };
        if !may_lack || !self.last.tells_slides() || has_stiction(self) || holds(&findings) {
            return findings;
        }
        let without = from(|face| face.friction_dynamic);
        if holds(&without) { without } else { findings }
    }

    /// The direction along t in which a contact has moved, if it moved farther than rounding.
    fn direction(&self, contact: &Contact) -> Option<f64> {
        let (model, touch) = (self.model, contact.touch);
        let before = model.mark(self.last.pose, self.last.contact(touch)?);
        let way = sub(model.mark(self.next.pose, contact), before);
        let along = dot(way, model.along(touch));
        (along.abs() > self.model.carried(self.next, self.bounds)).then(|| along.signum())
    }

    /// A vertex that turns in balance of moments (E1) while it sticks and while it slips.
    fn vertex(&self, contact: &Contact, onset: Onset) -> Vec<Finding> {
        let before = self.last.contact(contact.touch);
        let (Some(before), Some(sign)) = (before, self.direction(contact)) else {
            return Vec::new();
        };
        let slide = Slide {
            step: self,
            foot: self.foot(contact.touch),
            from: self.spot(self.last, before),
            to: self.spot(self.next, contact),
            sign,
            onset: onset(&self.face(contact.touch)),
            dynamic: self.face(contact.touch).friction_dynamic,
        };
        let (fixed, sliding) = (|part| slide.fixed(part), |part| slide.sliding(part));
        let (mut findings, tau) = self.ends(Way(&fixed), Way(&sliding), false);
        findings.extend(tau.map(|tau| {
            let undriven = slide.undriven(tau).unwrap_or(f64::INFINITY);
            self.finding(law::SLIP_FIRST, undriven.max(0.0), false)
        }));
        findings
    }

    pub(crate) fn foot(&self, touch: Touch) -> Foot<'a> {
        Foot {
            model: self.model,
            grip: self.grip,
            facing: self.model.facing(touch),
            shortest: self.model.carried(self.next, self.bounds),
        }
    }

    fn spot(&self, frame: &Frame, contact: &Contact) -> Spot {
        Spot {
            held: self.model.held(frame.pose, contact.touch),
            at: contact.point,
        }
    }

    /// Start and end of a slip, and the fraction of the hand's path at which it happened. `fixed`: the amount by which
    /// static friction falls short at the old positions; `sliding`: the drive of the slip at the new ones (N).
    fn ends(
        &self,
        fixed: Way<'_>,
        sliding: Way<'_>,
        is_braced: bool,
    ) -> (Vec<Finding>, Option<f64>) {
        let allowed = self.allowed(is_braced);
        let on_the_way = fixed.reaches(-allowed, 0.0).map(|first| {
            let at_limit = fixed.reaches(0.0, first).unwrap_or(1.0);
            [
                first,
                at_limit,
                fixed.reaches(allowed, at_limit).unwrap_or(1.0),
            ]
        });
        let found = self.ends_in(on_the_way, sliding, is_braced);
        if self.evolution == Evolution::Path || found.0.iter().all(Finding::holds) {
            return found;
        }
        // After the first event of a frame the hand jumps, and the slip may happen at the end of that jump.
        let at_the_end = match fixed.at(1.0) {
            end if end >= -allowed => Ok([1.0; 3]),
            end => Err(end),
        };
        let last = self.ends_in(at_the_end, sliding, is_braced);
        if last.0.iter().all(Finding::holds) {
            last
        } else {
            found
        }
    }

    /// As above, if the slip begins within a window of three fractions of the hand's path, or given the largest shortfall of
    /// static friction.
    fn ends_in(
        &self,
        window: Result<[f64; 3], f64>,
        sliding: Way<'_>,
        is_braced: bool,
    ) -> (Vec<Finding>, Option<f64>) {
        let allowed = self.allowed(is_braced);
        let begins = |short: f64| self.finding(law::SLIP_BEGINS, short, is_braced);
        let [first, at_limit, last] = match window {
            Ok(window) => window,
            Err(highest) => return (vec![begins(-highest)], None),
        };
        let nearest = |a: f64, b: f64| {
            if sliding.at(a).abs() <= sliding.at(b).abs() {
                a
            } else {
                b
            }
        };
        let mut tau = at_limit;
        if sliding.at(tau).abs() > allowed {
            let changes = (sliding.at(first) > 0.0) != (sliding.at(last) > 0.0);
            tau = nearest(tau, nearest(first, last));
            if changes && sliding.at(first).is_finite() && sliding.at(last).is_finite() {
                tau = sliding.zero((first, last));
            }
        }
        let ends = self.finding(law::SLIP_ENDS, sliding.at(tau).abs(), is_braced);
        (vec![begins(0.0), ends], Some(tau))
    }

    /// The force (N) that the bound on slips allows.
    pub(crate) fn allowed(&self, is_braced: bool) -> f64 {
        let unit = self.finding(law::SLIP_ENDS, 1.0, is_braced);
        unit.bound / unit.residual
    }

    /// After other events the contacts are where the last slip left them, and stick from there on. A slip during which a
    /// contact opens may end out of balance, after which the body turns: such slips are excluded.
    fn last_of_several(&self) -> Option<Finding> {
        let (last, next) = (self.last, self.next);
        let contact = next.contacts.first()?;
        let face = self.one_friction(next)?;
        let is_last = next.events.last() == Some(&Event::Slip) && next.events.len() < EVENTS;
        let opens = |event: &Event| matches!(event, Event::Lift | Event::Tip);
        if !is_last || next.events.iter().any(opens) {
            return None;
        }
        if !next.is_followed() || !next.held || next.slides() || !face.jumps() {
            return None;
        }
        if !matches!(next.state, State::SingleVertex | State::Edge) {
            return None;
        }
        let foot = self.foot(contact.touch);
        let reaction = |back: f64| -> Option<(f64, f64)> {
            if next.state == State::Edge {
                let load = self.model.load(next.pose, self.hand(1.0 - back), self.grip);
                return Some(borne(load.force, face.normal));
            }
            let spot = self.spot(next, contact);
            let pin = |back: f64| foot.pinned(spot, self.hand(1.0 - back));
            Some(pin(back).reaction(follow(pin, next.pose[2], back)?))
        };
        // If the hand has just grasped, the slip happens at the end of its path.
        let left = [1.0, -1.0].map(|sign| {
            let excess = |back| Some(drive(reaction(back)?, face.friction_dynamic, sign));
            let end = Way(&excess).at(0.0);
            if !last.held {
                return end.abs();
            }
            let towards_zero = |back| excess(back).map(|excess| -end.signum() * excess);
            let found = Way(&towards_zero).reaches(-self.allowed(false), 0.0);
            found.map_or_else(|highest| -highest, |_| 0.0)
        });
        Some(self.finding(law::SLIP_LAST, left[0].min(left[1]), false))
    }
}

/// The amount (N) by which a reaction (N, T) lies outside a cone.
pub(crate) fn static_excess((normal, friction): (f64, f64), mu: f64) -> f64 {
    (friction.abs() - mu * normal) / mu.hypot(1.0)
}

/// The drive (N) of a contact that slides along `sign`·t: -sign T - mu_d N.
pub(crate) fn drive((normal, friction): (f64, f64), mu: f64, sign: f64) -> f64 {
    (-sign * friction - mu * normal) / mu.hypot(1.0)
}
