//! 5: one step: hand -> contacts -> state -> transition -> output.

use crate::coupling::{Grip, Pivot};
use crate::detect::Placed;
use crate::geometry::{Angle, Vec2};
use crate::hand::Hand;
use crate::model::{Full, Model};
use crate::output::{Event, Log, Output, Status};
use crate::real::Real;
use crate::scene::{Scene, World};
use crate::state::{ContactState, Free, Terms, Trigger};
use crate::transition::{rests, settle};

mod answer;

/// How a frame is evolved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Evolution {
    /// Exact events along the straight way of the hand: the result does not depend on the frame rate.
    #[default]
    Path,
    /// The hand jumps to its new pose (the paper's way): cheapest.
    Frame,
}

/// The solver of one scene. It holds no state of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Solver<R: Real, const V: usize, const S: usize, M: Model = Full> {
    scene: Scene<R, V, S, M>,
    evolution: Evolution,
}

/// The state of a run: plain data. A copy of it is a snapshot; assigned back, the run repeats bit for bit.
#[derive(Clone, Debug, PartialEq)]
pub struct State<R: Real> {
    contact: ContactState<R>,
    grip: Grip<R>,
    /// phi - theta at which the rotational spring rests.
    rest_offset: Angle<R>,
    held: bool,
    /// The hand has taken hold before.
    was_held: bool,
    hand: Hand<R::Si>,
}

/// A hand that is turned farther than this (rad) from the body that it holds is out of range.
const MAX_TURN: i32 = 100_000;
/// Events of one frame before the rest of it is taken as one jump of the hand.
const MAX_EVENTS_ON_PATH: u32 = 128;
/// Events in a slide without jumps are located to this many halvings of the rest of the frame.
const FINEST_HALF: u32 = 24;
/// This many slips fit into a frame before a limit is reported.
const UNLIMITED_SLIPS: u32 = 100;

impl<R: Real> State<R> {
    /// The last good sample of the hand: the one that the state belongs to.
    pub fn hand(&self) -> &Hand<R::Si> {
        &self.hand
    }
}

impl<R: Real, const V: usize, const S: usize, M: Model> Solver<R, V, S, M> {
    /// A solver for a scene.
    pub const fn new(scene: Scene<R, V, S, M>, evolution: Evolution) -> Self {
        Self { scene, evolution }
    }

    /// Less accurate and faster: angles of balance are found to within `radians`, the ends of slips to within that part
    /// of the body size, in every frame anew: nothing adds up. From 0 (the default: as far as the digits of the number
    /// type go) to 0.01; what is beyond is taken as the nearer end, what is not a number as 0. Contacts are not touched by
    /// it: feet stick and surfaces are met to the last digit.
    #[must_use]
    pub fn with_tolerance(mut self, radians: R::Si) -> Self {
        let given = R::from_si(R::Si::ZERO.max(radians), R::Si::ONE);
        self.scene.tolerance = given.min(R::ONE / R::from_int(100));
        self
    }

    /// The first record: the equilibrium reached from the start pose with the hand at its first pose. A hand that is not
    /// finite or out of range is taken as absent: the body stays at its start until a good one takes hold.
    pub fn start(&self, hand: Hand<R::Si>) -> (State<R>, Output<R::Si>) {
        let mut log = Log::default();
        let mut state = self.placed_at_start();
        match self.non_dimensional(&hand) {
            Err(status) => log.limit(status),
            Ok((position, angle)) => {
                state.hand = hand;
                if hand.held {
                    self.take_hold(&mut state, (position, angle), &mut log);
                }
            }
        }
        let output = self.output(&state, log);
        (state, output)
    }

    /// One frame: the hand goes to its new pose and the body follows.
    pub fn step(&self, state: &mut State<R>, hand: Hand<R::Si>) -> Output<R::Si> {
        let mut log = Log::default();
        match self.non_dimensional(&hand) {
            Err(status) => log.limit(status),
            Ok(target) => {
                self.switch(state, &hand, target, &mut log);
                if self.follow(state, target, &mut log) {
                    state.hand = hand;
                } else {
                    log.limit(Status::Saturated);
                }
            }
        }
        self.output(state, log)
    }

    /// p_h / L and phi of a sample, or why it cannot be used.
    fn non_dimensional(&self, hand: &Hand<R::Si>) -> Result<(Vec2<R>, Angle<R>), Status> {
        let position: Vec2<R> = self.scene.units.point_from_si(hand.position);
        let (turns, rest) = hand.angle.rest.turns();
        // False for what is not a number, too; a remainder of more than a turn is of more turns than can be counted.
        let is_usable = position.x.abs() <= R::RANGE
            && position.y.abs() <= R::RANGE
            && rest.abs() <= R::Si::TAU
            && hand.depth.is_finite();
        if !is_usable {
            return Err(if hand.is_finite() {
                Status::Saturated
            } else {
                Status::HeldLast
            });
        }
        let angle = Angle {
            turns: hand.angle.turns.saturating_add(turns),
            rest: R::from_si(rest, R::Si::ONE),
        };
        Ok((position, angle))
    }

    /// The body at its start pose, seated on the surfaces that it touches.
    fn placed_at_start(&self) -> State<R> {
        let pose = self.scene.start;
        let placed = Placed::at(&pose);
        let touching = placed.touching(&self.scene, Scene::<R, V, S, M>::start_tolerance());
        let contact = match touching.split_first() {
            None => ContactState::Free(Free { pose }),
            Some((&first, others)) => {
                let pivot = Pivot::at(&self.scene, &pose, first);
                ContactState::seated(&self.scene, pivot, others)
            }
        };
        State {
            contact,
            grip: Grip::default(),
            rest_offset: Angle::default(),
            held: false,
            was_held: false,
            hand: Hand::default(),
        }
    }

    /// Grasp and release by the hold switch.
    fn switch(
        &self,
        state: &mut State<R>,
        hand: &Hand<R::Si>,
        target: (Vec2<R>, Angle<R>),
        log: &mut Log<R>,
    ) {
        if state.held && !hand.held {
            state.held = false;
            log.event(Event::Release);
        } else if !state.held && hand.held {
            self.take_hold(state, target, log);
        }
    }

    /// Takes hold where the hand is, if within reach; the first time at the scene's holding point, if it gives one.
    fn take_hold(
        &self,
        state: &mut State<R>,
        (position, angle): (Vec2<R>, Angle<R>),
        log: &mut Log<R>,
    ) {
        let pose = state.contact.pose(&self.scene);
        let (holding_point, rest_offset) = match self.scene.holding_point {
            Some(given) if !state.was_held => (given, Angle::default()),
            _ => {
                let at = pose.orientation.rotation().undo(position - pose.position);
                if self.scene.body.distance(at) > self.scene.reach {
                    return;
                }
                log.event(Event::Grasp);
                (at, angle.offset_from(pose.orientation.angle()))
            }
        };
        let grip = Grip {
            holding_point,
            hand: position,
            angle: angle.offset_from(rest_offset),
        };
        if !self.carries(&state.contact, &grip) {
            log.limit(Status::Saturated);
            return;
        }
        state.held = true;
        state.was_held = true;
        state.rest_offset = rest_offset;
        state.grip = grip;
        settle(&self.scene, &state.grip, &mut state.contact, None, log);
    }

    /// The number type carries the springs between a body and a hand: the pull, the turn, and the moment of both.
    fn carries(&self, contact: &ContactState<R>, grip: &Grip<R>) -> bool {
        let placed = contact.placed(&self.scene);
        let pull = (grip.hand - placed.point).reach();
        let lever = (grip.holding_point - placed.body_point).reach();
        // The balance of a contact that glides is one in the square of its lever.
        let pull = if self.glides() { pull.max(lever) } else { pull };
        let turn = grip.angle.minus(placed.orientation.angle()).abs();
        pull <= R::RANGE
            && turn <= R::from_int(MAX_TURN).min(R::HUGE.halved())
            && lever * pull + self.scene.stiffness() * turn <= R::LOAD
    }

    /// The hand goes to `target` and the body with it, if it holds it. False, and nothing has moved, where it is out of
    /// range.
    fn follow(
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
        for event in 0..MAX_EVENTS_ON_PATH {
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
    const fn glides(&self) -> bool {
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
