//! The program of a board, free of hardware: bytes that came in, commands and samples out of them, a step, a safe force for
//! the hand, and reports. All of it happens in the tick; a board gives the time, a line ([`Link`]) and what it is
//! ([`Setup`]).
//!
//! ```text
//!             +------------------------- tick(now, link) -> force ------------------------+
//! link.take --> Decoder -- samples --> intake.rs --> Controller --> forces, flags         |
//!             |     |  the tracker's plane, who is overtaken |                            |
//!             |     +---- commands --> command.rs            +--> report.rs: pose, forces,
//!             |                        | refusal.rs               events, health          |
//!             |                        v                                |                 |
//! link.send <-------------------- outbox.rs <---------------------------+                 |
//!             +---------------------------------------------------------------------------+
//! setup.rs: what the board is; the modes that it has the time and the line for
//! watch.rs: its health, for a log that is written elsewhere
//! ```
//!
//! The work of a tick is bounded, whatever comes over the line: so many bytes, one command, one step.

mod command;
mod intake;
mod outbox;
mod refusal;
mod report;
mod setup;
mod watch;

pub use outbox::Link;
pub use setup::{SceneType, Setup};
pub use watch::{Seen, Watch};

use crate::device::{Controller, Refusal, Sample};
use crate::safety::Flags;
use command::Next;
use intake::Intake;
use outbox::Outbox;
use report::Told;
use stiction_core::frame::{
    Command, Decoder, Fault, Frame, Health, Mode, Reply, Report, Stepping, frame_bytes, scene_bytes,
};
use stiction_core::{Model, Real, Wrench};

/// The program of a board: R, V, S and M are those of its scene, N the bytes of the longest frame that it takes.
#[derive(Debug)]
pub struct Station<R: Real, const V: usize, const S: usize, M: Model, const N: usize> {
    decoder: Decoder<N>,
    desk: Desk<R, V, S, M>,
}

/// All but the decoder, in whose buffer commands lie while they are carried out.
#[derive(Debug)]
struct Desk<R: Real, const V: usize, const S: usize, M: Model> {
    setup: &'static Setup,
    longest_frame: usize,
    controller: Controller<R, V, S, M>,
    mode: Mode,
    bytes_per_tick: u32,
    intake: Intake,
    /// Samples that went to the control loop.
    stepped: u16,
    told: Told,
    outbox: Outbox,
    /// Of the last tick.
    flags: Flags,
    /// No force until everything is reset.
    latched: bool,
    /// The longest tick (ns).
    worst_tick: u32,
}

impl<R, const V: usize, const S: usize, M, const N: usize> Station<R, V, S, M, N>
where
    R: Real<Si = f32>,
    M: Model,
{
    /// As after power-up.
    ///
    /// # Errors
    /// [`Refusal`] of the setup's scene or limits. A mode that the board has no time or no line for is not found here.
    pub fn new(setup: &'static Setup) -> Result<Self, Refusal> {
        const { assert!(N >= frame_bytes(scene_bytes(V, S)), "no room for a scene") };
        let mode = setup.mode;
        Ok(Self {
            decoder: Decoder::new(),
            desk: Desk {
                setup,
                longest_frame: N,
                controller: Controller::new(&setup.scene, &setup.settings(&mode))?,
                mode,
                bytes_per_tick: setup.bytes_per_tick(&mode),
                intake: Intake::new(&mode),
                stepped: 0,
                told: Told::new(),
                outbox: Outbox::new(),
                flags: Flags::default(),
                latched: false,
                worst_tick: 0,
            },
        })
    }

    /// One tick, at a time (µs, wrapping) of the board's clock. The force (N) and moment (N·m) for the hand, world frame.
    pub fn tick(&mut self, now_us: u32, link: &mut impl Link) -> Wrench<f32> {
        let begun = link.now_ns();
        self.listen(now_us, link);
        let force = self.desk.step(now_us, link);
        self.desk.tell_health(self.decoder.faults(), now_us, link);
        let took = link.now_ns().wrapping_sub(begun);
        self.desk.worst_tick = self.desk.worst_tick.max(took);
        force
    }

    /// Takes bytes until there is enough for one tick.
    fn listen(&mut self, now_us: u32, link: &mut impl Link) {
        for _ in 0..self.desk.bytes_per_tick {
            let Some(byte) = link.take() else { return };
            let Some(received) = self.decoder.push(byte) else {
                continue;
            };
            match self.desk.receive(received, now_us, link) {
                Next::More => {}
                Next::Enough => return,
                Next::Anew => {
                    self.decoder = Decoder::new();
                    return;
                }
            }
        }
    }

    /// The actuators did not give the force of the last tick: there is none from now on, until everything is reset.
    pub fn fault(&mut self) {
        self.desk.latched = true;
    }

    /// How the board works now; its timer follows the tick rate.
    pub fn mode(&self) -> &Mode {
        &self.desk.mode
    }

    /// Why the force of the last tick is what it is.
    pub fn flags(&self) -> &Flags {
        &self.desk.flags
    }

    /// What has been counted.
    pub fn health(&self) -> Health {
        self.desk.health(self.decoder.faults())
    }
}

impl<R: Real<Si = f32>, const V: usize, const S: usize, M: Model> Desk<R, V, S, M> {
    /// A frame came, or something that is none.
    fn receive(
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
            Command::Hand(hand) => self.intake.hand(*hand, frame.sequence),
            Command::Tracker(sample) => self.intake.tracker(sample, frame.sequence),
            _ => return self.command(&frame, now_us, link),
        }
        match self.mode.stepping {
            Stepping::Timed => Next::More,
            Stepping::PerSample => Next::Enough,
        }
    }

    /// An undamaged frame that is no command is answered; of a damaged one nobody knows what it was.
    fn refuse(&mut self, fault: &Fault, now_us: u32, link: &mut impl Link) -> Next {
        if let Some(frame) = fault.frame {
            self.intake.follow(frame.sequence);
        }
        match Reply::to_fault(fault) {
            Some(reply) => {
                self.outbox.send(now_us, Report::Reply(reply), link);
                Next::Enough
            }
            None => Next::More,
        }
    }

    /// The sample that waits through the solver, the force through the safety, and both to the client.
    fn step(&mut self, now_us: u32, link: &mut impl Link) -> Wrench<f32> {
        let arrived = self.intake.take();
        let sample = arrived.map(|arrived| {
            self.stepped = self.stepped.wrapping_add(1);
            self.told.follows(arrived.sequence);
            Sample {
                hand: arrived.hand,
                number: self.stepped,
                received_us: now_us,
            }
        });
        let begun = link.now_ns();
        let mut tick = self.controller.tick(now_us, sample.as_ref());
        let took = link.now_ns().wrapping_sub(begun);
        self.controller.measured(took);
        if self.latched {
            self.controller.actuator_fault(&mut tick);
        }
        self.flags = tick.flags;
        if let Some(output) = &tick.output {
            self.happened(output, now_us, link);
        }
        if sample.is_some() || self.mode.stepping == Stepping::Timed {
            self.tell_step(&tick, now_us, link);
        }
        tick.force
    }
}
