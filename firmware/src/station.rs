//! The program of a board, free of hardware: from the bytes that arrived to commands and samples, a step, a force that is demanded of the
//! servo loop, and reports. All of it happens in turns, one after each tick; a board provides the line and a clock ([`Link`]), the servo
//! loop with its device ([`Servo`]) and its description ([`Setup`]).
//!
//! ```text
//! Servo::tick(now) -- measures the hand, outputs a force -----+
//!        ^    |                                               |
//!        |    | sample   +------------------- turn(link, servo) -------------------+
//! demand |    +--------> | intake.rs --> Controller --> report.rs: pose, forces,   |
//!        |               |   ^  counts overtaken |      events, health             |
//!        +---------------|---|-------------------+                 |               |
//!                        |   | samples                             v               |
//!          link.take --> | Decoder -- commands --> command.rs --> outbox.rs        | --> link.send
//!                        |                         refusal.rs                      |
//!                        +---------------------------------------------------------+
//! knob.rs: other numbers for its knob, with which it restarts
//! setup.rs: the description of the board; the modes for which it has the time and the line
//! watch.rs: its health, for a log that is written in another context
//! ```
//!
//! The work of a turn is bounded, whatever arrives over the line: a limited number of bytes, one command, one step. If ticks interrupt
//! turns, a turn that takes longer than a tick leaves the force to the servo loop, and the next turn begins with the next tick. The force
//! reaches the device before it is reported. In the safe state the device is off.

mod command;
mod intake;
mod knob;
mod outbox;
mod refusal;
mod report;
mod setup;
mod watch;

pub use crate::station_of;
pub use outbox::Link;
pub use setup::{BoardNumber, SLOWEST_TICK, SceneType, Setup};
pub use watch::{Log, News, Seen, Watch};

use crate::device::{Actuators, Begun, Controller, LockServo, Refusal, Sample, Servo, Source};
use crate::safety::Flags;
use command::Next;
use intake::Intake;
use knob::Restart;
use outbox::Outbox;
use report::Reported;
use stiction_core::{Real, Wrench};
use stiction_wire::{
    Command, Decoder, Fault, Frame, Health, KnobNumbers, Mode, Reply, Report, Stepping,
    frame_bytes, scene_bytes,
};

/// The program of a board: R, V, S and C are those of its scene, N the bytes of the longest frame that it accepts.
#[derive(Debug)]
pub struct Station<R: Real, const V: usize, const S: usize, const C: usize, const N: usize> {
    decoder: Decoder<N>,
    desk: Desk<R, V, S, C>,
}

/// Everything except the decoder, in whose buffer commands are while they are carried out.
#[derive(Debug)]
struct Desk<R: Real, const V: usize, const S: usize, const C: usize> {
    setup: &'static Setup,
    longest_frame: usize,
    controller: Controller<R, V, S, C>,
    mode: Mode,
    bytes_per_turn: u32,
    intake: Intake,
    /// Samples of the line that were passed to the control loop.
    stepped: u16,
    reported: Reported,
    outbox: Outbox,
    /// At the end of the last turn.
    flags: Flags,
    /// No force until everything is reset.
    latched: bool,
    /// The longest turn (ns).
    worst_tick: u32,
    /// Numbers of the knob that were accepted.
    restart: Option<Restart>,
}

impl<R, const V: usize, const S: usize, const C: usize, const N: usize> Station<R, V, S, C, N>
where
    R: Real<Si = f32>,
{
    /// As after power-up.
    ///
    /// # Errors
    /// [`Refusal`] of the setup's scene or limits. A mode for which the board has no time or no line is not detected here.
    pub fn new(setup: &'static Setup) -> Result<Self, Refusal> {
        const {
            let longest = scene_bytes([V, S, C, C]);
            assert!(N >= frame_bytes(longest), "no room for a scene");
        };
        let mode = setup.mode;
        Ok(Self {
            decoder: Decoder::new(),
            desk: Desk {
                setup,
                longest_frame: N,
                controller: Controller::new(&setup.scene, &setup.settings(&mode))?,
                mode,
                bytes_per_turn: setup.bytes_per_turn(&mode),
                intake: Intake::new(&mode),
                stepped: 0,
                reported: Reported::new(),
                outbox: Outbox::new(),
                flags: Flags::default(),
                latched: false,
                worst_tick: 0,
                restart: None,
            },
        })
    }

    /// One turn, after a tick of the servo loop: its demand is output to the device immediately. Returns what the device was given: force
    /// (N) and moment (N·m), world frame.
    pub fn turn<D: Source + Actuators>(
        &mut self,
        link: &mut impl Link,
        servo: &mut impl LockServo<D>,
    ) -> Wrench<f32> {
        let begun = link.now_ns();
        let Begun { now_us, sample } = servo.lock(Servo::begin);
        self.listen::<D>(now_us, link);
        let force = self.desk.step(now_us, sample, link, servo);
        if D::HAS_NUMBERS {
            self.desk.stop_for_restart(now_us, link, servo);
        }
        self.desk.tell_health(self.decoder.faults(), now_us, link);
        let took = link.now_ns().wrapping_sub(begun);
        self.desk.worst_tick = self.desk.worst_tick.max(took);
        force
    }

    /// A tick, at a time (µs, wrapping) of the board's clock, and its turn, which no other tick interrupts. Returns what the device was
    /// given, like [`Self::turn`].
    pub fn tick<D: Source + Actuators>(
        &mut self,
        now_us: u32,
        link: &mut impl Link,
        servo: &mut Servo<D>,
    ) -> Wrench<f32> {
        servo.tick(now_us);
        self.turn(link, servo)
    }

    /// Takes bytes until there is enough for one turn.
    fn listen<D: Source>(&mut self, now_us: u32, link: &mut impl Link) {
        for _ in 0..self.desk.bytes_per_turn {
            let Some(byte) = link.take() else { return };
            let Some(received) = self.decoder.push(byte) else {
                continue;
            };
            match self.desk.receive::<D>(received, now_us, link) {
                Next::More => {}
                Next::Enough => return,
                Next::Anew => {
                    self.decoder = Decoder::new();
                    return;
                }
            }
        }
    }

    /// The present mode of the board; its timer follows the tick rate.
    pub fn mode(&self) -> &Mode {
        &self.desk.mode
    }

    /// Why the force had its value at the end of the last turn.
    pub fn flags(&self) -> &Flags {
        &self.desk.flags
    }

    /// The numbers of a knob that the board is to store now, and then to restart; its device is off.
    pub fn restarts_with(&self) -> Option<&KnobNumbers> {
        self.desk.restart.as_ref().and_then(Restart::due)
    }

    /// The counts.
    pub fn health(&self) -> Health {
        self.desk.health(self.decoder.faults())
    }
}

impl<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize> Desk<R, V, S, C> {
    /// Handles a frame that arrived, or something that is none.
    fn receive<D: Source>(
        &mut self,
        received: Result<Frame<Command<'_>>, Fault>,
        now_us: u32,
        link: &mut impl Link,
    ) -> Next {
        let frame = match received {
            Ok(frame) => frame,
            Err(fault) => return self.refuse(&fault, now_us, link),
        };
        if matches!(frame.message, Command::Hello) {
            self.intake.greet();
        }
        self.intake.follow(frame.sequence);
        match &frame.message {
            Command::Hand(_) | Command::Tracker(_) if D::MEASURES => {
                return self.refuse_sample(&frame, now_us, link);
            }
            Command::Knob(numbers) if D::HAS_NUMBERS => {
                return self.replace_knob(numbers, frame.reference(), now_us, link);
            }
            Command::AskKnob if D::HAS_NUMBERS => {
                return self.tell_knob(frame.reference(), now_us, link);
            }
            Command::Hand(hand) => self.intake.hand(*hand, frame.sequence),
            Command::Tracker(sample) => self.intake.tracker(sample, frame.sequence),
            _ => return self.command(&frame, now_us, link),
        }
        match self.mode.stepping {
            Stepping::Timed => Next::More,
            Stepping::PerSample => Next::Enough,
        }
    }

    /// An undamaged frame that is not a command is answered; what a damaged one was is unknown.
    fn refuse(&mut self, fault: &Fault, now_us: u32, link: &mut impl Link) -> Next {
        if let Some(frame) = fault.frame {
            self.intake.follow(frame.sequence);
        }
        match Reply::to_fault(fault) {
            Some(reply) => {
                self.say(now_us, Report::Reply(reply), link);
                Next::Enough
            }
            None => Next::More,
        }
    }

    /// Passes the sample of this turn through the solver, the force that it demands through the servo loop to the device, and both to the
    /// client.
    fn step<D: Source + Actuators>(
        &mut self,
        now_us: u32,
        measured: Option<Sample>,
        link: &mut impl Link,
        servo: &mut impl LockServo<D>,
    ) -> Wrench<f32> {
        let sample = if D::MEASURES {
            self.measured(measured)
        } else {
            self.arrived(now_us)
        };
        let begun = link.now_ns();
        let turn = self.controller.turn(sample.as_ref(), servo);
        let took = link.now_ns().wrapping_sub(begun);
        self.controller.measured(took);
        self.flags = turn.flags;
        self.latched = turn.latched;
        // A sample that arrived is in the pose, however old it is by now.
        self.reported.silent = turn.flags.silent && sample.is_none();
        if let Some(output) = &turn.output {
            self.happened(output, now_us, link);
        }
        if sample.is_some() || self.mode.stepping == Stepping::Timed {
            self.tell_step(&turn, now_us, link);
        }
        turn.force
    }

    fn arrived(&mut self, now_us: u32) -> Option<Sample> {
        let arrived = self.intake.take()?;
        self.stepped = self.stepped.wrapping_add(1);
        self.reported.follows(arrived.sequence);
        Some(Sample {
            hand: arrived.hand,
            number: self.stepped,
            received_us: now_us,
        })
    }

    fn measured(&mut self, sample: Option<Sample>) -> Option<Sample> {
        let sample = sample?;
        let [number, _] = sample.number.to_le_bytes();
        self.intake.measured();
        self.reported.follows(number);
        Some(sample)
    }
}
