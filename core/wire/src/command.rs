//! Messages to the board (FRAME 4).

use crate::fault::FaultKind;
use crate::field::{Field, Fields, Sink};
use crate::knob::KnobNumbers;
use crate::layout::{coded, layout};
use crate::message::Wire;
use crate::mode::Mode;
use crate::scene::SceneCommand;
use stiction_core::{Hand, TrackerSample};

/// A message to the board. Each one except the samples of the hand is answered: [`Command::Hello`] by
/// [`Report::Info`](crate::Report::Info), [`Command::Ping`] by [`Report::Pong`](crate::Report::Pong), [`Command::AskKnob`] by
/// [`Report::KnobInfo`](crate::Report::KnobInfo), the others by [`Report::Reply`](crate::Report::Reply).
///
/// ```
/// use stiction_core::Hand;
/// use stiction_wire::{Command, Decoder, Frame, frame_bytes};
///
/// let sample = Frame { sequence: 1, time: 0, message: Command::Hand(Hand::new(0.1, 0.2, 7.0)) };
/// let mut wire = [0; 64];
/// let wire = sample.encode(&mut wire).unwrap();
/// assert_eq!(wire.len(), 34);
///
/// let mut board = Decoder::<{ frame_bytes(64) }>::new();
/// let received = wire.iter().find_map(|&byte| board.push::<Command>(byte).map(|r| r.is_ok()));
/// assert_eq!(received, Some(true));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command<'a> {
    /// A sample of the planar hand (m, rad; world frame). One that is not finite is a lost sample.
    Hand(Hand<f32>),
    /// A sample of a tracker (m; its own frame), which the board projects onto the plane of its [`Mode`].
    Tracker(TrackerSample<f32>),
    /// The springs and the friction, the friction on every surface.
    Parameters(Parameters),
    /// A new scene. The body starts again.
    Scene(SceneCommand<'a>),
    /// The operating mode of the board.
    Mode(Mode),
    /// A client introduces itself and asks what the board is.
    Hello,
    /// Asks whether the board responds, and for its time.
    Ping,
    /// Back to the start.
    Reset(Reset),
    /// Other numbers of the board's knob: it stores them and restarts.
    Knob(KnobNumbers),
    /// Asks for the numbers of the board's knob.
    AskKnob,
}

/// The four parameters of the paper and the memory length; the friction is that of every surface. Finite, or the command is refused.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Parameters {
    /// Translational stiffness k_h (N/m) > 0.
    pub stiffness_translation: f32,
    /// Rotational stiffness k_theta (N·m/rad) >= 0.
    pub stiffness_rotation: f32,
    /// Static friction mu_s >= mu_d.
    pub friction_static: f32,
    /// Dynamic friction mu_d >= 0.
    pub friction_dynamic: f32,
    /// Memory length (m) >= 0, see [`SurfaceDescription::memory`](stiction_core::SurfaceDescription::memory); `None`: L / 4096.
    pub memory: Option<f32>,
}

layout! {
    Parameters {
        stiffness_translation: f32, stiffness_rotation: f32, friction_static: f32,
        friction_dynamic: f32, memory: Option<f32>
    }
}

coded! {
    /// What a reset restores.
    pub enum Reset {
        /// The body, to the start pose of its scene.
        Body = "body",
        /// Everything, as after power-up: scene, parameters, mode, counters.
        Everything = "everything",
    }
}

const HAND: u8 = 0x01;
const TRACKER: u8 = 0x02;
const PARAMETERS: u8 = 0x03;
const SCENE: u8 = 0x04;
const MODE: u8 = 0x05;
const HELLO: u8 = 0x06;
const PING: u8 = 0x07;
const RESET: u8 = 0x08;
const KNOB: u8 = 0x09;
const ASK_KNOB: u8 = 0x0a;

impl Command<'_> {
    /// The name of the message.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Hand(_) => "hand",
            Self::Tracker(_) => "tracker",
            Self::Parameters(_) => "parameters",
            Self::Scene(_) => "scene",
            Self::Mode(_) => "mode",
            Self::Hello => "hello",
            Self::Ping => "ping",
            Self::Reset(_) => "reset",
            Self::Knob(_) => "knob",
            Self::AskKnob => "ask-knob",
        }
    }
}

impl<'a> Wire<'a> for Command<'a> {
    fn code(&self) -> u8 {
        match self {
            Self::Hand(_) => HAND,
            Self::Tracker(_) => TRACKER,
            Self::Parameters(_) => PARAMETERS,
            Self::Scene(_) => SCENE,
            Self::Mode(_) => MODE,
            Self::Hello => HELLO,
            Self::Ping => PING,
            Self::Reset(_) => RESET,
            Self::Knob(_) => KNOB,
            Self::AskKnob => ASK_KNOB,
        }
    }

    fn write(&self, sink: &mut impl Sink) {
        match self {
            Self::Hand(hand) => hand.put(sink),
            Self::Tracker(sample) => sample.put(sink),
            Self::Parameters(parameters) => parameters.put(sink),
            Self::Scene(scene) => scene.write(sink),
            Self::Mode(mode) => mode.put(sink),
            Self::Hello | Self::Ping | Self::AskKnob => {}
            Self::Reset(reset) => reset.put(sink),
            Self::Knob(numbers) => numbers.put(sink),
        }
    }

    fn read(code: u8, mut fields: Fields<'a>) -> Result<Self, FaultKind> {
        match code {
            HAND => fields.only().map(Self::Hand),
            TRACKER => fields.only().map(Self::Tracker),
            PARAMETERS => fields.only().map(Self::Parameters),
            SCENE => SceneCommand::read(&mut fields).map(Self::Scene),
            MODE => fields.only().map(Self::Mode),
            HELLO => fields.exactly(0).map(|()| Self::Hello),
            PING => fields.exactly(0).map(|()| Self::Ping),
            RESET => fields.only().map(Self::Reset),
            KNOB => fields.only().map(Self::Knob),
            ASK_KNOB => fields.exactly(0).map(|()| Self::AskKnob),
            _ => Err(FaultKind::UnknownType),
        }
    }
}
