//! Consecutive slips in a frame, of a vertex or an edge: how many lead from the old position to the new one. Each begins where
//! static friction gives way and ends at the first position where |T| = mu_d N, with the hand frozen (STATICS 3.2, 4).

use super::vertex::PLACES;
use super::{Step, drive, static_excess};
use stiction_core::{Evolution, StateKind as State};

use crate::frame::Contact;
use crate::model::borne;
use crate::onset::Way;
use crate::pin::{Foot, Spot, follow};
use crate::touch::Face;
use crate::vector::between;

/// The path from the old position of a contact (0) to the new one (1).
struct Chain<'a> {
    step: &'a Step<'a>,
    foot: Foot<'a>,
    /// Both positions of the contact of a vertex.
    spots: [Spot; 2],
    face: Face,
    sign: f64,
}

/// The current end of a chain: position, fraction of the hand's path, angle.
#[derive(Clone, Copy)]
struct Link {
    place: f64,
    part: f64,
    turn: f64,
}

/// The number of slips; `None` if they do not lead there.
pub(super) fn count(step: &Step<'_>, contact: &Contact) -> Option<u32> {
    let before = step.last.contact(contact.touch)?;
    let chain = Chain {
        step,
        foot: step.foot(contact.touch),
        spots: [step.spot(step.last, before), step.spot(step.next, contact)],
        face: step.one_friction(step.next)?,
        sign: step.direction(contact)?,
    };
    let mut link = Link {
        place: 0.0,
        part: 0.0,
        turn: step.last.pose[2],
    };
    for count in 0..=step.next.slips.saturating_add(1) {
        let jumps = count > 0 && step.evolution == Evolution::Frame;
        match chain.begins(link, jumps)? {
            Some(begin) if link.place < 1.0 => link = chain.ends(begin)?,
            Some(_) => return None,
            None => return (link.place >= 1.0).then_some(count),
        }
    }
    None
}

impl Chain<'_> {
    /// The reaction at a position with the hand at a fraction of its path, and the angle, continued from a link.
    fn reaction(&self, from: Link, place: f64, part: f64) -> Option<((f64, f64), f64)> {
        let step = self.step;
        if step.next.state == State::Edge {
            let pose = between(step.last.pose, step.next.pose, place);
            let load = step.model.load(pose, step.hand(part), step.grip);
            return Some((borne(load.force, self.face.normal), pose[2]));
        }
        let pin = |u: f64| {
            let at = |from: f64, to: f64| from + (to - from) * u;
            let spot = self.spots[0].towards(self.spots[1], at(from.place, place));
            self.foot.pinned(spot, step.hand(at(from.part, part)))
        };
        let turn = follow(pin, from.turn, 1.0)?;
        Some((pin(1.0).reaction(turn), turn))
    }

    fn begins(&self, link: Link, jumps: bool) -> Option<Option<Link>> {
        let part = |u: f64| link.part + (1.0 - link.part) * u;
        let excess = |u: f64| {
            let (reaction, _) = self.reaction(link, link.place, part(u))?;
            Some(static_excess(reaction, self.face.friction_static))
        };
        let (excess, allowed) = (Way(&excess), self.step.allowed(false));
        let first = if jumps { 1.0 } else { 0.0 };
        if excess.reaches(-allowed, first).is_err() {
            return Some(None);
        }
        // A marginal slip has happened if the contact has not reached its new position yet, and has not happened if it has.
        if link.place >= 1.0 && excess.reaches(allowed, first).is_err() {
            return Some(None);
        }
        let found = excess
            .reaches(0.0, first)
            .or_else(|_| excess.reaches(-allowed, first));
        let part = part(found.ok()?);
        let (_, turn) = self.reaction(link, link.place, part)?;
        Some(Some(Link { part, turn, ..link }))
    }

    fn ends(&self, begin: Link) -> Option<Link> {
        let along = |from: Link, place: f64| {
            let (reaction, turn) = self.reaction(from, place, begin.part)?;
            let driven = drive(reaction, self.face.friction_dynamic, self.sign);
            Some((
                driven,
                Link {
                    place,
                    turn,
                    ..begin
                },
            ))
        };
        let allowed = self.step.allowed(false);
        let mut last = begin;
        for i in 1..=PLACES {
            let place = begin.place + (1.0 - begin.place) * f64::from(i) / f64::from(PLACES);
            let (driven, next) = along(last, place)?;
            if driven.abs() <= allowed && i == PLACES {
                return Some(next);
            }
            if driven <= 0.0 {
                let driven = |place: f64| along(last, place).map(|(driven, _)| driven);
                let end = Way(&driven).zero((last.place, next.place));
                return along(last, end).map(|(_, link)| link);
            }
            last = next;
        }
        None
    }
}
