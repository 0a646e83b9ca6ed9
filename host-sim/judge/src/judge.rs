//! Frame after frame: the memory of previous frames, and the laws that depend on it.

use stiction_core::{Event, Evolution, Status, Touch};

use crate::events::{self, Events};
use crate::finding::{Bounds, Finding, law};
use crate::frame::{Contact, Frame};
use crate::hold;
use crate::model::{Grip, Model};
use crate::obstacles::Unreported;
use crate::passage;
use crate::scene::Scene;
use crate::slide;
use crate::slip::{self, Step};
use crate::status;
use crate::still;
use crate::vector::{Vec2, distance, dot, length, sub};

/// Judges the frames of one trace, in their order.
#[derive(Clone, Debug)]
pub struct Judge {
    model: Model,
    bounds: Bounds,
    evolution: Evolution,
    last: Option<Frame>,
    /// Whether the last frame left the body out of balance and reported it.
    unbalanced: bool,
    hold: Hold,
    anchors: Vec<Anchor>,
    unreported: Unreported,
}

/// A contact, and the position that it must not leave, or must not fall behind.
#[derive(Clone, Copy, Debug)]
struct Anchor {
    touch: Touch,
    sliding: Option<i8>,
    /// The position at which it stopped (m), as given by [`Model::mark`]; for a sliding contact, the farthest one.
    place: Vec2,
}

#[derive(Clone, Copy, Debug, Default)]
struct Hold {
    grip: Option<Grip>,
    was_held: bool,
}

impl Judge {
    /// A judge for a trace whose first frame is still to come.
    pub fn new(scene: Scene, bounds: Bounds, evolution: Evolution) -> Self {
        Self {
            model: Model::new(scene),
            bounds,
            evolution,
            last: None,
            unbalanced: false,
            hold: Hold::default(),
            anchors: Vec::new(),
            unreported: Unreported::default(),
        }
    }

    /// The tolerances.
    pub const fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// The laws of a single frame, for a body that is held at the scene's holding point for the first time, or not at all. A body that stays
    /// may have been out of balance before: its balance is not judged.
    pub fn alone(&self, frame: &Frame) -> Vec<Finding> {
        if let Some(unknown) = still::unknown(&self.model, frame) {
            return vec![unknown];
        }
        let grip = (self.model.scene.holding_point).map(|point| Grip { point, offset: 0.0 });
        let grip = grip.filter(|_| frame.held);
        self.still(frame, grip.as_ref(), leaves_unbalanced(frame, true))
    }

    /// Every law on the next frame.
    pub fn next(&mut self, frame: Frame) -> Vec<Finding> {
        let finite = still::finite(&frame);
        if !finite.holds() {
            // Neither it nor its consequences can be judged; the previous frame remains the last one.
            return vec![finite];
        }
        if let Some(unknown) = still::unknown(&self.model, &frame) {
            return vec![finite, unknown];
        }
        let reported = self.take_hold(&frame);
        let grip = self.hold.grip;
        let unbalanced = leaves_unbalanced(&frame, self.unbalanced);
        let mut findings = self.still(&frame, grip.as_ref(), unbalanced);
        findings.push(reported);
        findings.extend(self.rests(&frame));
        findings.extend(self.last.as_ref().map(|last| later(last, &frame)));
        let reported = status::reported(self.last.as_ref(), &frame);
        findings.push(Finding::whether(law::STATUS, reported));
        if let Some(last) = &self.last {
            let events = Events {
                model: &self.model,
                last,
                next: &frame,
            };
            findings.extend(events.findings(&self.bounds, self.evolution, grip.as_ref()));
        }
        findings.extend(self.keeps(&frame));
        if let (Some(last), Some(grip)) = (&self.last, &grip) {
            let step = Step {
                model: &self.model,
                bounds: &self.bounds,
                evolution: self.evolution,
                grip,
                last,
                next: &frame,
            };
            // A slip begins in balance.
            if !self.unbalanced {
                findings.extend(slip::findings(&step));
            }
            findings.extend(
                status::of_balance(&step).map(|holds| Finding::whether(law::STATUS, holds)),
            );
            findings.extend(events::snaps(&step).map(|holds| Finding::whether(law::SNAPS, holds)));
            findings.extend(slide::findings(&step));
            findings.extend(hold::findings(&step));
            findings.extend(passage::findings(&step));
        }
        let frames = (self.last.as_ref(), &frame);
        findings.extend(self.unreported.next(&self.model, &self.bounds, frames));
        self.unbalanced = unbalanced;
        self.last = Some(frame);
        findings
    }

    fn still(&self, frame: &Frame, grip: Option<&Grip>, unbalanced: bool) -> Vec<Finding> {
        let mut findings = vec![still::finite(frame)];
        findings.extend(still::names(&self.model, &self.bounds, frame));
        findings.extend(still::geometry(&self.model, &self.bounds, frame));
        match grip {
            _ if unbalanced => {}
            Some(grip) => {
                findings.extend(still::statics(&self.model, &self.bounds, grip, frame));
                findings.extend(slide::alone(&self.model, &self.bounds, grip, frame));
            }
            None => findings.push(still::idle(frame)),
        }
        findings
    }

    /// Tracks the grip: initially the scene's holding point, if given; otherwise the hand's position at the grasp, in the
    /// pose of the previous frame.
    fn take_hold(&mut self, frame: &Frame) -> Finding {
        let grasps = frame.events.contains(&Event::Grasp);
        let was_held = self.hold.grip.is_some();
        let mut reported = match (was_held, frame.held) {
            (true, false) => frame.events.contains(&Event::Release) && !grasps,
            (true, true) => !grasps,
            (false, false) => !grasps,
            (false, true) => true,
        };
        if !frame.held {
            self.hold.grip = None;
        } else if !was_held {
            let given = self.model.scene.holding_point;
            let grip = match given {
                Some(point) if !self.hold.was_held && !grasps => Grip { point, offset: 0.0 },
                _ => {
                    reported = grasps;
                    self.taken(frame)
                }
            };
            self.hold = Hold {
                grip: Some(grip),
                was_held: true,
            };
        }
        Finding::whether(law::HOLD, reported)
    }

    /// The grip of a hand that grasps the body where it is. At the start, a vertex close to a surface is first set onto
    /// it; the springs then show by how much.
    fn taken(&self, frame: &Frame) -> Grip {
        let Some(last) = &self.last else {
            let grip = Grip::taken(self.model.scene.start, frame.hand);
            let [fx, fy, moment] = frame.wrench;
            let stiffness = self.model.scene.stiffness_translation;
            let holding = [
                frame.hand[0] - fx / stiffness,
                frame.hand[1] - fy / stiffness,
            ];
            let reported = Grip {
                point: Grip::taken(frame.pose, [holding[0], holding[1], 0.0]).point,
                offset: match self.model.scene.stiffness_rotation {
                    0.0 => grip.offset,
                    stiffness => frame.hand[2] - frame.pose[2] - moment / stiffness,
                },
            };
            let shift = distance(reported.point, grip.point)
                .max(self.model.size * (reported.offset - grip.offset).abs());
            let near = shift <= 4.0 * START * self.model.size;
            return if near && !frame.contacts.is_empty() {
                reported
            } else {
                grip
            };
        };
        Grip::taken(last.pose, frame.hand)
    }

    /// A body that nothing moves stays where it was.
    fn rests(&self, frame: &Frame) -> Option<Finding> {
        let stays = match frame.status {
            Status::Saturated | Status::HeldLast => true,
            Status::Ambiguous | Status::Jammed => frame.events.is_empty(),
            Status::Ok
            | Status::EventLimit
            | Status::IterationLimit
            | Status::Behind
            | Status::Twist => false,
        };
        let before = match &self.last {
            Some(last) if stays || !frame.held => last.pose,
            // A vertex close to a surface at the start is set onto it.
            None if !frame.held && frame.contacts.is_empty() => self.model.scene.start,
            _ => return None,
        };
        let moved = match frame.contacts.first() {
            // A jammed body is free to turn about its corner.
            Some(corner) if frame.status == Status::Jammed && frame.is_in_corner() => {
                let [was, is] =
                    [before, frame.pose].map(|pose| self.model.foot(pose, corner.touch));
                distance(was, is)
            }
            _ => distance([before[0], before[1]], [frame.pose[0], frame.pose[1]])
                .max(self.model.size * (frame.pose[2] - before[2]).abs()),
        };
        let scale = self.model.length_scale(frame, &self.bounds);
        Some(Finding::new(law::RESTS, moved / scale, self.bounds.gap))
    }

    /// Contacts stay where they stopped, as long as nothing happens that could move them; and sliding contacts move forward.
    fn keeps(&mut self, frame: &Frame) -> Vec<Finding> {
        let moves = |event: &Event| !matches!(event, Event::Grasp | Event::Release);
        let is_quiet = !frame.events.iter().any(moves);
        let scale = self.model.reach(frame);
        // A foot that moves is placed from where the hand holds.
        let hold =
            (self.hold.grip).map_or([0.0; 2], |grip| self.model.holding_point(frame.pose, &grip));
        let from_hold = hold.iter().fold(scale, |most, x| most.max(x.abs()));
        let [mut strayed, mut receded]: [Option<f64>; 2] = [None; 2];
        let mut anchors = Vec::with_capacity(frame.contacts.len());
        for contact in &frame.contacts {
            let mut anchor = Anchor {
                touch: contact.touch,
                sliding: contact.sliding,
                place: self.model.mark(frame.pose, contact),
            };
            let known = (self.anchors.iter())
                .find(|known| known.touch == anchor.touch && known.sliding == anchor.sliding);
            if let (Some(known), true) = (known, is_quiet && self.grips(frame, contact)) {
                let way = sub(anchor.place, known.place);
                match contact.sliding {
                    Some(sign @ (-1 | 1)) if frame.events.is_empty() => {
                        let along = dot(way, self.model.along(contact.touch));
                        let back = -f64::from(sign) * along;
                        receded = Some(receded.unwrap_or(0.0).max(back));
                        if back > 0.0 {
                            anchor.place = known.place;
                        }
                    }
                    Some(-1 | 1) => {}
                    _ => {
                        strayed = Some(strayed.unwrap_or(0.0).max(length(way)));
                        anchor.place = known.place;
                    }
                }
            }
            anchors.push(anchor);
        }
        self.anchors = anchors;
        let allowed = self.bounds.exact;
        let finding = |law, way: Option<f64>, scale: f64| {
            way.map(|way| Finding::new(law, way / scale, allowed))
        };
        let strayed = finding(law::STICKS, strayed, scale);
        let receded = finding(law::FORWARD, receded, from_hold);
        strayed.into_iter().chain(receded).collect()
    }

    /// Whether a sticking contact has to stay, or a sliding one to move in one direction. It does not without friction, nor
    /// without force, since the body may turn out of the way; nor in an older trace, in which it slides without reporting it.
    fn grips(&self, frame: &Frame, contact: &Contact) -> bool {
        let face = self.model.face(frame.pose, contact.touch);
        if contact.sliding.is_none() {
            return face.jumps();
        }
        let idle = |frame: &Frame| {
            let known = frame.contact(contact.touch).zip(self.hold.grip);
            known.is_some_and(|(contact, grip)| {
                slide::is_idle(&self.model, &self.bounds, &grip, frame, contact)
            })
        };
        face.friction_static > 0.0 && !idle(frame) && !self.last.as_ref().is_some_and(idle)
    }
}

/// A vertex this close to a surface, relative to the body size, touches it from the start.
const START: f64 = 1e-5;

fn later(last: &Frame, frame: &Frame) -> Finding {
    Finding::whether(law::TIME, frame.t > last.t)
}

/// Whether the body is out of balance and reports it (STATICS 9, rule 8), or has followed an unreported part of the hand's path; or stays
/// as it was `before`.
fn leaves_unbalanced(frame: &Frame, before: bool) -> bool {
    match frame.status {
        Status::Ambiguous | Status::Jammed | Status::Behind => true,
        Status::Saturated | Status::HeldLast => before,
        Status::Ok | Status::EventLimit | Status::IterationLimit | Status::Twist => false,
    }
}
