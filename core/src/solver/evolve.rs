//! The evolution of a frame: certified if nothing happens; otherwise event by event along the path of the hand (STATICS 7), or in one jump.

use super::{Evolution, Solver, State};
use crate::event::Status;
use crate::geometry::{Angle, Vec2};
use crate::grip::Grip;
use crate::log::Log;
use crate::model::Model;
use crate::path_event::happens;
use crate::real::Real;
use crate::settle::{Settling, rests};
use crate::state::ContactState;
use crate::verb::Trigger;
use crate::work::Work;

/// The stage of following the hand.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Stage<R> {
    /// In balance on the path of the hand.
    OnPath,
    /// At an event on it.
    AtEvent(Trigger<R>),
    /// Coming to rest there, the hand frozen.
    Settling(Settling<R>),
    /// At rest at the end of the path.
    Arrived,
}

/// What remains of the hand's path.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Errand<R> {
    stage: Stage<R>,
    /// The fraction of the hand's displacement that is left, 0 to 1; 0 if nothing is left to do.
    left: R,
}

/// How the hand was followed since the body last caught up with it. Separate from the errand, so that the state stays small.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Course {
    /// The number of pieces so far, each to an event or to where a search gave up.
    pieces: u8,
    /// An event has happened.
    had_event: bool,
    /// The hand has jumped to the end of its path: the body settles there.
    has_jumped: bool,
    /// The next piece covers the fraction 4^-k of the remainder: if the evaluations do not suffice for a path, they do for a shorter one.
    quarters: u8,
    /// The status that limited it.
    limited: Status,
}

impl Course {
    pub(super) const NEW: Self = Self {
        pieces: 0,
        had_event: false,
        has_jumped: false,
        quarters: 0,
        limited: Status::Ok,
    };
}

impl<R: Real> Errand<R> {
    /// Nothing is left to do.
    pub(super) const NONE: Self = Self {
        stage: Stage::OnPath,
        left: R::ZERO,
    };

    /// The fraction of the hand's displacement that is left, 0 to 1; 0 if nothing is left to do.
    pub(super) fn left(&self) -> R {
        self.left
    }

    fn is_done(&self) -> bool {
        self.left == R::ZERO
    }
}

/// After this many pieces the hand jumps: a body that passes from event to event without end comes to rest, and one that cannot keep up
/// with the hand catches up with it.
const MAX_PIECES: u8 = 128;
/// On pieces shorter than 4^-8 of the displacement the searches make no progress.
const MAX_QUARTERS: u8 = 8;

impl<R: Real, const V: usize, const S: usize, M: Model> Solver<R, V, S, M> {
    /// The hand moves to `target` and the body with it, if held, as far as the work suffices; `again`: it was already on its way there.
    /// Returns false, with nothing moved, if the target is out of range.
    pub(super) fn go_to(
        &self,
        state: &mut State<R>,
        ((hand, angle), again): ((Vec2<R>, Angle<R>), bool),
        (work, log): (&mut Work, &mut Log<R>),
    ) -> bool {
        if !state.held {
            return true;
        }
        let to = Grip {
            holding_point: state.grip.holding_point,
            hand,
            angle: angle.offset_from(state.rest_offset),
        };
        let mut tried = false;
        if again && !state.errand.is_done() {
            log.limit(state.course.limited);
        } else {
            Self::turn_to_a_new_place(state);
            tried = matches!(state.errand.stage, Stage::OnPath);
            if state.errand.is_done() && to == state.grip {
                log.limit(state.unrest);
                return true;
            }
            if tried && (state.contact).follow(&self.scene, (&state.grip, &to), work) {
                rests(&state.contact, log);
                (state.grip, state.unrest) = (to, Status::Ok);
                (state.errand, state.course) = (Errand::NONE, Course::NEW);
                return true;
            }
            if !state.contact.can_be_held(&self.scene, &to) {
                return false;
            }
            (state.errand.left, state.course.has_jumped) = (R::ONE, false);
        }
        state.course.limited = Status::Ok;
        self.follow_hand(state, (&to, tried), (work, log));
        true
    }

    /// Redirects the hand to a new pose. A body that settles does so first; from an event or the end of a path the body, which is in
    /// balance there, goes straight on.
    fn turn_to_a_new_place(state: &mut State<R>) {
        match state.errand.stage {
            Stage::OnPath | Stage::Settling(_) => {}
            Stage::AtEvent(_) => state.errand.stage = Stage::OnPath,
            Stage::Arrived => {
                state.unrest = Log::<R>::unrest_of(state.course.limited);
                (state.errand, state.course) = (Errand::NONE, Course::NEW);
            }
        }
    }

    /// Brings the body to rest at a hand that takes hold of it.
    pub(super) fn settle(&self, state: &mut State<R>, (work, log): (&mut Work, &mut Log<R>)) {
        let to = state.grip;
        state.errand = Errand {
            stage: Stage::Settling(Settling::after_jump(&state.contact)),
            left: R::ONE,
        };
        state.course = Course {
            has_jumped: true,
            ..Course::NEW
        };
        self.follow_hand(state, (&to, false), (work, log));
    }

    /// Follows the hand piece by piece to the end of its path, or until the remaining work is less than the next piece may take. Each piece
    /// is a call of its own (`inline(never)`): the stack holds the data of one. `tried`: a certified frame to there has failed.
    fn follow_hand(
        &self,
        state: &mut State<R>,
        (to, mut tried): (&Grip<R>, bool),
        (work, log): (&mut Work, &mut Log<R>),
    ) {
        // At least one piece, so that the body makes progress.
        let mut is_first = true;
        loop {
            let most = self.most_of_piece(state, tried);
            if !is_first && !work.allows(most) {
                break;
            }
            work.begin(most);
            is_first = false;
            let stage = core::mem::replace(&mut state.errand.stage, Stage::OnPath);
            match stage {
                Stage::Arrived => {
                    work.spend(state.contact.rest_work());
                    if (state.contact).is_jammed(&self.scene, &state.grip, work) {
                        log.limit(Status::Jammed);
                    }
                    state.unrest = log.unrest();
                    (state.errand, state.course) = (Errand::NONE, Course::NEW);
                    return;
                }
                Stage::OnPath => self.along_path(state, (to, tried), (work, log)),
                Stage::AtEvent(trigger) => {
                    work.spend(state.contact.event_work(&trigger));
                    work.spend(state.contact.passing_work(&self.scene, &trigger));
                    let path = (&mut state.grip, to);
                    let contact = &mut state.contact;
                    let settling = happens(&self.scene, path, contact, trigger, (work, log));
                    if settling.is_over() {
                        self.settle_on(state, to, settling, (work, log));
                    } else {
                        state.errand.stage = Stage::Settling(settling);
                    }
                }
                Stage::Settling(settling) => self.settle_on(state, to, settling, (work, log)),
            }
            tried = false;
        }
        state.errand.left = state.errand.left.max(R::EPSILON);
        let is_settled = state.errand.stage == Stage::Arrived;
        state.course.limited = if is_settled {
            log.final_status()
        } else {
            log.status
        };
        log.limit(Status::Behind);
    }

    /// The next verb of a body that settles. After it rests the same piece goes on, as it may be out of balance.
    #[inline(never)]
    fn settle_on(
        &self,
        state: &mut State<R>,
        to: &Grip<R>,
        mut settling: Settling<R>,
        (work, log): (&mut Work, &mut Log<R>),
    ) {
        let (grip, contact) = (&state.grip, &mut state.contact);
        let (units, rests) = settling.go_on(&self.scene, grip, contact, log);
        work.spend(units);
        if !rests {
            state.errand.stage = Stage::Settling(settling);
        } else if state.course.has_jumped {
            state.errand.stage = Stage::Arrived;
        } else if log.unrest() != Status::Ok {
            // Out of balance there is no path, only a jump.
            Self::jump(state, to, log);
        }
    }

    /// The most work that the next piece takes.
    fn most_of_piece(&self, state: &State<R>, tried: bool) -> u32 {
        let contact = &state.contact;
        match &state.errand.stage {
            Stage::OnPath if state.course.pieces > 0 && !tried => {
                let certified = (contact.most_of_certified())
                    .saturating_add(contact.most_of_certified_among(&self.scene));
                self.most_of_verb(contact).saturating_add(certified)
            }
            Stage::OnPath | Stage::Settling(_) => self.most_of_verb(contact),
            Stage::AtEvent(trigger) => (contact.most_of_event(trigger))
                .saturating_add(contact.most_of_event_among(&self.scene, trigger)),
            Stage::Arrived => contact.most_of_rest(),
        }
    }

    fn most_of_verb(&self, contact: &ContactState<R>) -> u32 {
        (contact.most_of_verb()).saturating_add(contact.most_of_verb_among(&self.scene))
    }

    /// Along the straight path of the hand to the next event (STATICS 7); after the last event permitted on it the hand jumps.
    #[inline(never)]
    fn along_path(
        &self,
        state: &mut State<R>,
        (to, tried): (&Grip<R>, bool),
        (work, log): (&mut Work, &mut Log<R>),
    ) {
        let Course {
            pieces,
            had_event,
            quarters,
            ..
        } = state.course;
        // In frame evolution, too, the first event happens where the hand reaches it (STATICS 7.2).
        let is_last_event = had_event && self.evolution == Evolution::Frame;
        let is_balanced = matches!(state.unrest, Status::Ok | Status::Jammed);
        if is_last_event || pieces >= MAX_PIECES || quarters > MAX_QUARTERS || !is_balanced {
            if pieces >= MAX_PIECES {
                log.limit(Status::EventLimit);
            } else if quarters > MAX_QUARTERS {
                log.limit(Status::IterationLimit);
            }
            return Self::jump(state, to, log);
        }
        let may_be_certified = pieces > 0 && !tried;
        if may_be_certified && (state.contact).follow(&self.scene, (&state.grip, to), work) {
            rests(&state.contact, log);
            (state.grip, state.errand.stage) = (*to, Stage::Arrived);
            return;
        }
        let piece = (0..quarters).fold(R::ONE, |piece, _| piece.halved().halved());
        let end = if quarters == 0 {
            *to
        } else {
            state.grip.lerp(to, piece)
        };
        work.spend(state.contact.verb_work());
        let moved = state.contact.advance(&self.scene, &state.grip, &end);
        work.spend(moved.work);
        let is_through = moved.trigger == Trigger::Balanced && !moved.unsure;
        let comes_to = if is_through {
            end
        } else {
            state.grip.lerp(&end, moved.part)
        };
        // Which contacts slide on after a contact closes is decided on a displacement (rule 11): the next one.
        let touches_at_end = matches!(moved.trigger, Trigger::Touch(_))
            && !moved.unsure
            && state.contact.regime().slide().is_some()
            && comes_to == *to;
        let arrives = is_through || touches_at_end;
        if arrives && quarters == 0 {
            rests(&state.contact, log);
            (state.grip, state.errand.stage) = (*to, Stage::Arrived);
            return;
        }
        state.course.quarters = if moved.unsure && moved.part == R::ZERO {
            quarters.saturating_add(1)
        } else {
            0
        };
        state.grip = comes_to;
        state.errand.left = state.errand.left * (R::ONE - piece * moved.part);
        if arrives || moved.trigger == Trigger::GoesOn {
            return;
        }
        state.course.pieces = pieces.saturating_add(1);
        // Nothing has happened up to where a search gave up: continue from there.
        if !moved.unsure {
            state.course.had_event = true;
            state.errand.stage = Stage::AtEvent(moved.trigger);
        }
    }

    /// The hand jumps to the end of its path, and the body settles there.
    fn jump(state: &mut State<R>, to: &Grip<R>, log: &mut Log<R>) {
        log.ambiguous = false;
        state.unrest = Status::Ok;
        state.grip = *to;
        state.course.has_jumped = true;
        state.errand.stage = Stage::Settling(Settling::after_jump(&state.contact));
    }
}
