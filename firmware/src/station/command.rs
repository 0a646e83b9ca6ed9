//! Commands (FRAME 4.3 to 4.7): carried out, or refused with the reason; a refused command changes nothing.

use super::intake::Intake;
use super::knob::{NO_KNOB, RESTARTS};
use super::refusal::Trouble;
use super::{Desk, Link, Reported};
use crate::device::{Controller, Placement};
use crate::obstacles::{NOWHERE, StoredObstacles};
use stiction_core::{Output, Real};
use stiction_wire::{
    Command, Frame, Mode, Parameters, Pong, Reason, Reply, Report, Reset, SceneCommand,
};

/// How to continue after a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Next {
    /// The next one.
    More,
    /// Nothing more in this turn.
    Enough,
    /// Nothing more in this turn, and the faults of the line are cleared.
    Anew,
}

/// After a lasting fault nothing is carried out.
pub(super) const STOPPED: Trouble = Trouble::whole(
    Reason::NotNow,
    "hello, ping, and reset of everything: the board is stopped by a fault",
);

impl<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize> Desk<R, V, S, C> {
    /// Handles a command that is not a sample.
    #[inline(never)]
    pub(super) fn command(
        &mut self,
        frame: &Frame<Command<'_>>,
        now_us: u32,
        link: &mut impl Link,
    ) -> Next {
        match frame.message {
            Command::Hello => {
                self.tell_info(self.longest_frame, now_us, link);
                return Next::Enough;
            }
            Command::Ping => {
                let pong = Pong {
                    sequence: frame.sequence,
                    time: frame.time,
                };
                self.say(now_us, Report::Pong(pong), link);
                return Next::Enough;
            }
            _ => {}
        }
        let command = frame.reference();
        let (reply, settled) = match self.obey(&frame.message) {
            Ok(settled) => (Reply::done(command), settled),
            Err(trouble) => (trouble.reply(command), None),
        };
        self.say(now_us, Report::Reply(reply), link);
        if let Some(output) = settled {
            self.happened(&output, now_us, link);
        }
        match frame.message {
            Command::Reset(Reset::Everything) => Next::Anew,
            _ => Next::Enough,
        }
    }

    /// Handles a sample on a board that measures the hand itself (FRAME 4.8): reported once to a client that sent
    /// hello.
    pub(super) fn refuse_sample(
        &mut self,
        frame: &Frame<Command<'_>>,
        now_us: u32,
        link: &mut impl Link,
    ) -> Next {
        if self.intake.refused {
            return Next::More;
        }
        let allowed = "no samples: the board measures the hand itself";
        let reply = Trouble::whole(Reason::Unsupported, allowed).reply(frame.reference());
        self.intake.refused = self.say(now_us, Report::Reply(reply), link);
        Next::Enough
    }

    /// Carries a command out. Returns what the body did with it, if there was one.
    fn obey(&mut self, command: &Command<'_>) -> Result<Option<Output<f32>>, Trouble> {
        if self.restart.is_some() {
            return Err(RESTARTS);
        }
        if self.latched && !matches!(command, Command::Reset(Reset::Everything)) {
            return Err(STOPPED);
        }
        match command {
            Command::Parameters(parameters) => return self.parameters(parameters),
            Command::Scene(scene) => self.scene(scene)?,
            Command::Mode(mode) => self.set_mode(mode)?,
            Command::Reset(Reset::Body) => {
                self.controller.reset();
                self.begin_anew();
            }
            Command::Reset(Reset::Everything) => self.power_up()?,
            Command::Knob(_) | Command::AskKnob => return Err(NO_KNOB),
            Command::Hand(_) | Command::Tracker(_) | Command::Hello | Command::Ping => {}
        }
        Ok(None)
    }

    // None is compiled into another: the stack is that of the one that is carried out.
    #[inline(never)]
    fn parameters(&mut self, new: &Parameters) -> Result<Option<Output<f32>>, Trouble> {
        let settled = self.controller.set_parameters(new);
        settled.map_err(|refusal| Trouble::of::<V, S, C>(&refusal))
    }

    #[inline(never)]
    fn scene(&mut self, scene: &SceneCommand<'_>) -> Result<(), Trouble> {
        let (mut vertices, mut surfaces) = ([[0.0; 2]; V], [NOWHERE; S]);
        let refused = |refusal| Trouble::of::<V, S, C>(&refusal);
        let controller = &mut self.controller;
        StoredObstacles::<C>::with_received(scene, &mut vertices, &mut surfaces, |description| {
            controller.set_scene(description, Placement::Start)
        })
        .map_err(|error| refused(error.into()))?
        .map_err(refused)?;
        self.begin_anew();
        Ok(())
    }

    #[inline(never)]
    fn set_mode(&mut self, mode: &Mode) -> Result<(), Trouble> {
        self.setup.check(mode)?;
        self.controller
            .set_settings(&self.setup.settings(mode))
            .map_err(|refusal| Trouble::of::<V, S, C>(&refusal))?;
        self.mode = *mode;
        self.bytes_per_turn = self.setup.bytes_per_turn(mode);
        self.intake.look_at(mode.plane);
        self.reported.count_anew();
        Ok(())
    }

    /// As after power-up, except the numbers of frames: they continue.
    #[inline(never)]
    fn power_up(&mut self) -> Result<(), Trouble> {
        let mode = self.setup.mode;
        let settings = self.setup.settings(&mode);
        match Controller::new(&self.setup.scene, &settings) {
            Ok(controller) => self.controller = controller,
            Err(refusal) => return Err(Trouble::of::<V, S, C>(&refusal)),
        }
        self.mode = mode;
        self.bytes_per_turn = self.setup.bytes_per_turn(&mode);
        self.intake = Intake::new(&mode);
        self.reported = Reported::new();
        self.outbox.unsent = 0;
        self.worst_tick = 0;
        self.latched = false;
        Ok(())
    }

    fn begin_anew(&mut self) {
        self.intake.begin_anew();
        self.reported.begin_anew();
    }
}
