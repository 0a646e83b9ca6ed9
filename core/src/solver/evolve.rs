//! How a frame is evolved: certified where nothing happens; else event by event along the path of the hand (STATICS 7), or in one
//! jump.

use super::{Solver, State};
use crate::event::Status;
use crate::geometry::{Angle, Vec2};
use crate::grip::Grip;
use crate::log::Log;
use crate::model::Model;
use crate::real::Real;
use crate::scene::Scene;
use crate::settle::{rests, settle};
use crate::state::ContactState;
use crate::verb::{Terms, Trigger};
use crate::world::World;

/// How a frame is evolved (STATICS 7).
///
/// ```
/// # use stiction_core::{Description, Scene, SurfaceDescription};
/// use stiction_core::{Evolution, Hand, Solver};
///
/// # let scene: Scene<f32, 4, 1> = Scene::new(&Description {
/// #     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
/// #     start: [0.0, 0.03, 0.0],
/// #     weight: 0.0,
/// #     holding_point: Some([0.0, 0.02]),
/// #     reach: 0.0,
/// #     stiffness_translation: 500.0,
/// #     stiffness_rotation: 0.5,
/// #     surfaces: &[SurfaceDescription {
/// #         normal: [0.0, 1.0],
/// #         offset: 0.0,
/// #         friction_static: 0.5,
/// #         friction_dynamic: 0.3,
/// #     }],
/// # })?;
/// // A box, flat on the floor, mu = 0.5 / 0.3, is pressed 10 mm down and dragged by 0.1 m in a
/// // single frame. It breaks away at a lag of 0.5 · 10 mm, then every (0.5 - 0.3) · 10 mm.
/// let drag = |evolution| {
///     let solver = Solver::new(scene.clone(), evolution);
///     let (mut state, _) = solver.start(Hand::new(0.0, 0.04, 0.0));
///     solver.step(&mut state, Hand::new(0.1, 0.04, 0.0)).slips
/// };
/// assert_eq!(drag(Evolution::Path), 48);
/// assert_eq!(drag(Evolution::Frame), 1);
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Evolution {
    /// Exact events along the straight path of the hand: the result does not depend on the frame rate.
    #[default]
    Path,
    /// The hand jumps to its new pose (as in the paper): cheapest. What happens, happens at the end of a frame, so that number and
    /// length of slips depend on the frame rate.
    Frame,
}

impl Evolution {
    /// Both evolutions.
    pub const ALL: [Self; 2] = [Self::Path, Self::Frame];

    /// The name on a command line: `path` or `frame`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Path => "path",
            Self::Frame => "frame",
        }
    }
}

/// A slide without jumps goes in strides of the hand of at most 1/16 of the body size, or rad, but in at most so many.
const MOST_STRIDES: i32 = 32;
/// This many slips fit into a frame before a limit is reported.
const UNLIMITED_SLIPS: u32 = 100;

impl<R: Real, const V: usize, const S: usize, M: Model> Solver<R, V, S, M> {
    /// The hand goes to `target` and the body with it, if it holds it. False, and nothing has moved, where it is out of
    /// range.
    pub(super) fn go_to(
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
            log.limit(state.unrest);
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
        } else if !self.can_represent(&state.contact, &to) {
            return false;
        } else {
            // A path begins in balance: out of it there is only a jump.
            match self.evolution {
                Evolution::Path if state.unrest == Status::Ok => self.along_path(state, &to, log),
                _ => self.by_jump(state, &to, log),
            }
        }
        state.grip = to;
        state.unrest = log.unrest();
        true
    }

    /// Event by event along the straight path of the hand (STATICS 7).
    fn along_path(&self, state: &mut State<R>, to: &Grip<R>, log: &mut Log<R>) {
        let mut idle = 0_i32;
        // What a tolerance would leave after events might begin other slips in the next frame.
        let terms = Terms {
            jumps: false,
            tolerance: R::ZERO,
        };
        for event in 0..self.event_limit {
            if log.unrest() != Status::Ok {
                // Out of balance there is no path on, only a jump.
                return self.by_jump(state, to, log);
            }
            let hands = (&state.grip, to);
            if event > 0 && state.contact.follow(&self.scene, hands, terms).is_some() {
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
            let begin = state.grip;
            state.grip = begin.lerp(to, moved.part);
            match moved.trigger {
                // Up to where a search gave up nothing has happened: on from there.
                _ if moved.unsure => {}
                Trigger::Undriven => {}
                trigger => self.happens(state, to, trigger, log),
            }
            let travel = begin.displacement_to(&state.grip).size();
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

    /// What an event leads to while the hand stays. Where a slip leads nowhere so, for want of a jump in the friction, the body slides
    /// on with the hand. A slip of two contacts may lead away all the same: they bear more loads than the one that drives them.
    fn happens(&self, state: &mut State<R>, to: &Grip<R>, trigger: Trigger<R>, log: &mut Log<R>) {
        let before = (state.contact.clone(), log.slips);
        settle(
            &self.scene,
            &state.grip,
            &mut state.contact,
            Some(trigger),
            log,
        );
        if matches!(trigger, Trigger::Slide(_)) && self.slides_continuously(&before.0) {
            let [from, at] = [&before.0, &state.contact].map(|contact| contact.placed(&self.scene));
            if at.is_near(&from, R::MICRO * R::from_int(16)) {
                (state.contact, log.slips) = before;
                self.slide_on(state, to, log);
            }
        }
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

    /// A slide without jumps follows the hand exactly as long as nothing else happens, in one stride or in many: in strides short
    /// enough that the balance next to the last one is found, and not one beyond. The hand goes on to where something else
    /// happens, which is found by halves to 2^-23 of the path, and jumps over it. All of it counts as one slip.
    fn slide_on(&self, state: &mut State<R>, to: &Grip<R>, log: &mut Log<R>) {
        let from = state.grip;
        let [sixteenth, least] = [16, MOST_STRIDES].map(|n| R::ONE / R::from_int(n));
        let distance = from.displacement_to(to).size();
        let mut stride = R::ONE;
        while distance * stride > sixteenth && stride > least {
            stride = stride.halved();
        }
        let (mut done, mut length) = (R::ZERO, R::ZERO);
        let mut strides = true;
        while done < R::ONE && stride >= R::MICRO * sixteenth {
            let half = stride.halved();
            let places = [half, stride, stride + half].map(|step| from.lerp(to, done + step));
            if let Some((contact, piece)) = self.slid(&state.contact, &places) {
                state.contact = contact;
                state.grip = places[1];
                done = done + stride;
                length = length + piece.longest_slip;
                log.transitions = log.transitions.union(piece.transitions);
            } else {
                strides = false;
            }
            if !strides {
                stride = half;
            }
        }
        if done > R::ZERO {
            log.slip(length);
        }
        if done < R::ONE {
            let at = from.lerp(to, done + stride.doubled());
            self.by_jump(state, &at, log);
            state.grip = at;
        }
    }

    /// A slip to the second of three places of the hand and nothing else. Where the pull falls again the body stays at its farthest
    /// place, which a slip to the end does not reach: it must end there through the first, too, and go on to the third. What can be
    /// lost on a short path, by its square, counts as no slip.
    fn slid(
        &self,
        contact: &ContactState<R>,
        [middle, at, beyond]: &[Grip<R>; 3],
    ) -> Option<(ContactState<R>, Log<R>)> {
        let (slid, log) = self.one_slip(contact, at)?;
        if middle.displacement_to(beyond).size() > R::MICRO * R::from_int(512) {
            let (half, _) = self.one_slip(contact, middle)?;
            let (same, _) = self.one_slip(&half, at)?;
            // What a slip ends in is found to this, in fixed point.
            let near = R::MICRO * R::from_int(16);
            let [there, same] = [&slid, &same].map(|contact| contact.placed(&self.scene));
            if !there.is_near(&same, near) {
                return None;
            }
            self.one_slip(&slid, beyond)?;
        }
        Some((slid, log))
    }

    /// A slip to the hand's place and nothing else.
    fn one_slip(
        &self,
        contact: &ContactState<R>,
        at: &Grip<R>,
    ) -> Option<(ContactState<R>, Log<R>)> {
        let (mut slid, mut log) = (contact.clone(), Log::default());
        settle(&self.scene, at, &mut slid, None, &mut log);
        let is_one_slip = log.is_one_slip() && slid.contacts() == contact.contacts();
        is_one_slip.then_some((slid, log))
    }

    /// Where events crowd at one place of the hand: a small jump on, longer each time. Slips that become too short to be
    /// distinguished so become a slide at mu_d, which is what continuous friction is anyway.
    fn nudge(&self, state: &mut State<R>, to: &Grip<R>, idle: i32, log: &mut Log<R>) {
        if log.slips >= UNLIMITED_SLIPS && !self.slides_continuously(&state.contact) {
            log.limit(Status::EventLimit);
        }
        let mut step = R::MICRO;
        for _ in 1..idle.min(40) {
            step = step * R::TWO;
        }
        let at = state.grip.toward(to, step);
        self.by_jump(state, &at, log);
        state.grip = at;
    }

    /// The hand jumps.
    fn by_jump(&self, state: &mut State<R>, to: &Grip<R>, log: &mut Log<R>) {
        settle(&self.scene, to, &mut state.contact, None, log);
    }
}
