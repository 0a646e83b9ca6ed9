//! How a frame is evolved: calm where nothing happens; else event by event along the way of the hand (STATICS 7), or in one
//! jump.

use super::{Evolution, Solver, State};
use crate::coupling::Grip;
use crate::geometry::{Angle, Vec2};
use crate::model::Model;
use crate::output::{Log, Status};
use crate::real::Real;
use crate::scene::{Scene, World};
use crate::state::{ContactState, Terms, Trigger};
use crate::transition::{rests, settle};

/// Events in a slide without jumps are located to this many halvings of the rest of the frame.
const FINEST_HALF: u32 = 24;
/// This many slips fit into a frame before a limit is reported.
const UNLIMITED_SLIPS: u32 = 100;

impl<R: Real, const V: usize, const S: usize, M: Model> Solver<R, V, S, M> {
    /// The hand goes to `target` and the body with it, if it holds it. False, and nothing has moved, where it is out of
    /// range.
    pub(super) fn follow(
        &self,
        state: &mut State<R>,
        (hand, angle): (Vec2<R>, Angle<R>),
        log: &mut Log<R>,
    ) -> bool {
        if !state.held {
            return true;
        }
        let to = Grip {
            holding_point: state.grip.holding_point,
            hand,
            angle: angle.offset_from(state.rest_offset),
        };
        if to == state.grip {
            return true;
        }
        let terms = Terms {
            jumps: self.evolution == Evolution::Frame,
            tolerance: self.scene.tolerance,
        };
        if let Some(trigger) = (state.contact).follow(&self.scene, (&state.grip, &to), terms) {
            if trigger == Trigger::Balanced {
                rests(&state.contact, log);
            } else {
                settle(&self.scene, &to, &mut state.contact, Some(trigger), log);
            }
        } else if !self.carries(&state.contact, &to) {
            return false;
        } else {
            match self.evolution {
                Evolution::Path => self.along_path(state, &to, log),
                Evolution::Frame => self.by_jump(state, &to, log),
            }
        }
        state.grip = to;
        true
    }

    /// Event by event along the straight way of the hand (STATICS 7).
    fn along_path(&self, state: &mut State<R>, to: &Grip<R>, log: &mut Log<R>) {
        let mut idle = 0_i32;
        // What a tolerance would leave after events might begin other slips in the next frame.
        let terms = Terms {
            jumps: false,
            tolerance: R::ZERO,
        };
        for event in 0..self.event_limit {
            let way = (&state.grip, to);
            if event > 0 && state.contact.follow(&self.scene, way, terms).is_some() {
                rests(&state.contact, log);
                return;
            }
            let moved = state.contact.advance(&self.scene, &state.grip, to);
            if moved.trigger == Trigger::Balanced && !moved.unsure {
                settle(
                    &self.scene,
                    to,
                    &mut state.contact,
                    Some(moved.trigger),
                    log,
                );
                return;
            }
            let travel = state.grip.way_to(to).size() * moved.part;
            state.grip = state.grip.lerp(to, moved.part);
            let slides = matches!(moved.trigger, Trigger::Slide(_));
            if slides && self.slides_continuously(&state.contact) {
                self.slide_on(state, to, log);
                continue;
            }
            if moved.trigger != Trigger::Undriven {
                settle(
                    &self.scene,
                    &state.grip,
                    &mut state.contact,
                    Some(moved.trigger),
                    log,
                );
            }
            idle = if travel <= R::MICRO {
                idle.saturating_add(1)
            } else {
                0
            };
            if idle > 1 {
                self.nudge(state, to, idle, log);
            }
        }
        log.limit(Status::EventLimit);
        self.by_jump(state, to, log);
    }

    /// Contacts glide.
    pub(super) const fn glides(&self) -> bool {
        <Scene<R, V, S, M> as World<R>>::GLIDES
    }

    /// Friction without a jump between sticking and sliding. On a single surface without friction nothing slides: it glides.
    fn slides_continuously(&self, state: &ContactState<R>) -> bool {
        if self.glides() {
            return false;
        }
        let contacts = state.contacts();
        contacts
            .iter()
            .all(|pair| self.scene.surface(pair.surface).friction.is_continuous())
    }

    /// A slide without jumps follows the hand exactly as long as nothing else happens, in one step or in many. The hand
    /// goes on to where something does, by halves.
    fn slide_on(&self, state: &mut State<R>, to: &Grip<R>, log: &mut Log<R>) {
        let mut part = R::ONE;
        for _ in 0..FINEST_HALF {
            let at = state.grip.lerp(to, part);
            let mut trial = (state.contact.clone(), Log::default());
            settle(&self.scene, &at, &mut trial.0, None, &mut trial.1);
            if trial.1.is_one_slip() && trial.0.contacts() == state.contact.contacts() {
                state.contact = trial.0;
                state.grip = at;
                log.merge(&trial.1);
                return;
            }
            part = part.halved();
        }
        let at = state.grip.lerp(to, part);
        self.by_jump(state, &at, log);
        state.grip = at;
    }

    /// Where events crowd at one place of the hand: a small jump on, longer each time. Slips that become too short to be
    /// told apart so become a slide at mu_d.
    fn nudge(&self, state: &mut State<R>, to: &Grip<R>, idle: i32, log: &mut Log<R>) {
        if log.slips >= UNLIMITED_SLIPS {
            log.limit(Status::EventLimit);
        }
        let way = state.grip.way_to(to).size();
        let mut step = R::MICRO;
        for _ in 1..idle.min(40) {
            step = step * R::TWO;
        }
        let part = if way > step { step / way } else { R::ONE };
        let at = state.grip.lerp(to, part);
        self.by_jump(state, &at, log);
        state.grip = at;
    }

    /// The hand jumps.
    fn by_jump(&self, state: &mut State<R>, to: &Grip<R>, log: &mut Log<R>) {
        settle(&self.scene, to, &mut state.contact, None, log);
    }
}
