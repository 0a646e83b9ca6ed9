//! How a frame is evolved: certified where nothing happens; else event by event along the path of the hand (STATICS 7), or in one
//! jump.

use super::{Solver, State};
use crate::event::Status;
use crate::geometry::{Angle, Vec2};
use crate::grip::Grip;
use crate::log::Log;
use crate::model::Model;
use crate::path_event::happens;
use crate::real::Real;
use crate::settle::{rests, settle};
use crate::verb::Trigger;

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
/// #         memory: None,
/// #     }],
/// # })?;
/// // A box, flat on the floor, mu = 0.5 / 0.3, is pressed 10 mm down and dragged by 0.1 m in a
/// // single frame. It breaks away at a lag of 0.5 · 10 mm, then every (0.5 - 0.3) · 10 mm; where
/// // the hand jumps, it slips the rest of the way at once.
/// let drag = |evolution| {
///     let solver = Solver::new(scene.clone(), evolution);
///     let (mut state, _) = solver.start(Hand::new(0.0, 0.04, 0.0));
///     solver.step(&mut state, Hand::new(0.1, 0.04, 0.0)).slips
/// };
/// assert_eq!(drag(Evolution::Path), 48);
/// assert_eq!(drag(Evolution::Frame), 2);
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Evolution {
    /// Exact events along the straight path of the hand: the result does not depend on the frame rate.
    #[default]
    Path,
    /// From the first event of a frame the hand jumps to its new pose (as in the paper, but for that event). What else happens,
    /// happens at the end of the frame, so that number and length of slips depend on the frame rate.
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

/// So many events of a frame are told apart in frame evolution: the first one happens where the hand reaches it.
const FRAME_EVENTS: u8 = 1;

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
        if (state.contact).follow(&self.scene, (&state.grip, &to)) {
            rests(&state.contact, log);
            state.grip = to;
            state.unrest = Status::Ok;
            return true;
        }
        if !state.contact.can_be_held(&self.scene, &to) {
            return false;
        } else if matches!(state.unrest, Status::Ok | Status::Jammed) {
            self.along_path(state, &to, log);
        } else {
            // A path begins in balance: out of it there is only a jump.
            settle(&self.scene, &to, &mut state.contact, log);
        }
        state.grip = to;
        self.rest(state, log);
        true
    }

    /// How the body rests at the end of a frame.
    pub(super) fn rest(&self, state: &mut State<R>, log: &mut Log<R>) {
        if state.contact.is_jammed(&self.scene, &state.grip) {
            log.limit(Status::Jammed);
        }
        state.unrest = log.unrest();
    }

    /// Event by event along the straight path of the hand (STATICS 7); after the last one that counts the hand jumps.
    fn along_path(&self, state: &mut State<R>, to: &Grip<R>, log: &mut Log<R>) {
        let events = match self.evolution {
            Evolution::Path => self.event_limit,
            Evolution::Frame => FRAME_EVENTS,
        };
        for event in 0..events {
            if log.unrest() != Status::Ok {
                // Out of balance there is no path, only a jump.
                return settle(&self.scene, to, &mut state.contact, log);
            }
            if event > 0 && state.contact.follow(&self.scene, (&state.grip, to)) {
                return rests(&state.contact, log);
            }
            let moved = state.contact.advance(&self.scene, &state.grip, to);
            if moved.trigger == Trigger::Balanced && !moved.unsure {
                return rests(&state.contact, log);
            }
            state.grip = state.grip.lerp(to, moved.part);
            // Up to where a search gave up nothing has happened: on from there.
            if !moved.unsure {
                let path = (&mut state.grip, to);
                happens(&self.scene, path, &mut state.contact, moved.trigger, log);
            }
        }
        if self.evolution == Evolution::Path {
            log.limit(Status::EventLimit);
        }
        settle(&self.scene, to, &mut state.contact, log);
    }
}
