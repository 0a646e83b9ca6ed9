//! Messages to the board (FRAME 4).

use crate::fault::FaultKind;
use crate::fields::{Fields, Sink};
use crate::message::Wire;
use crate::mode::Mode;
use crate::scene::SceneCommand;
use stiction_core::{Angle, Hand, TrackerSample};

/// A message to the board. Each one except the samples of the hand is answered: [`Command::Hello`] by
/// [`Report::Info`](crate::Report::Info), [`Command::Ping`] by [`Report::Pong`](crate::Report::Pong), the others by
/// [`Report::Reply`](crate::Report::Reply).
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

impl Parameters {
    fn write(&self, sink: &mut impl Sink) {
        sink.f32s(&[
            self.stiffness_translation,
            self.stiffness_rotation,
            self.friction_static,
            self.friction_dynamic,
        ]);
        sink.option(self.memory);
    }

    /// Reads the payload of parameters (FRAME 4.3); fails if its length is wrong or its flag is neither 0 nor 1.
    fn read(fields: &mut Fields<'_>) -> Result<Self, FaultKind> {
        fields.exactly(21)?;
        let [
            stiffness_translation,
            stiffness_rotation,
            friction_static,
            friction_dynamic,
        ] = fields.f32s();
        Ok(Self {
            stiffness_translation,
            stiffness_rotation,
            friction_static,
            friction_dynamic,
            memory: fields.option()?,
        })
    }
}

/// What a reset restores.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Reset {
    /// The body, to the start pose of its scene.
    #[default]
    Body,
    /// Everything, as after power-up: scene, parameters, mode, counters.
    Everything,
}

impl Reset {
    /// Both, in the order of their codes.
    pub const ALL: [Self; 2] = [Self::Body, Self::Everything];

    /// The name in a log.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Body => "body",
            Self::Everything => "everything",
        }
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
        }
    }

    /// Writes the payload of each command in the order of its table in FRAME 4.
    fn write(&self, sink: &mut impl Sink) {
        match self {
            Self::Hand(hand) => write_hand(hand, sink),
            Self::Tracker(sample) => {
                sink.f32s(&sample.position);
                sink.f32s(&sample.orientation);
                sink.byte(u8::from(sample.held));
            }
            Self::Parameters(parameters) => parameters.write(sink),
            Self::Scene(scene) => scene.write(sink),
            Self::Mode(mode) => mode.write(sink),
            Self::Hello | Self::Ping => {}
            Self::Reset(reset) => sink.code(&Reset::ALL, reset),
        }
    }

    /// Reads the payload of a type; fails if the type is unknown, the length is wrong, or a flag or code has no meaning.
    fn read(code: u8, mut fields: Fields<'a>) -> Result<Self, FaultKind> {
        match code {
            HAND => read_hand(&mut fields).map(Self::Hand),
            TRACKER => read_tracker(&mut fields).map(Self::Tracker),
            PARAMETERS => Parameters::read(&mut fields).map(Self::Parameters),
            SCENE => SceneCommand::read(&mut fields).map(Self::Scene),
            MODE => {
                fields.exactly(Mode::BYTES)?;
                Mode::read(&mut fields).map(Self::Mode)
            }
            HELLO => fields.exactly(0).map(|()| Self::Hello),
            PING => fields.exactly(0).map(|()| Self::Ping),
            RESET => {
                fields.exactly(1)?;
                fields.code(&Reset::ALL).map(Self::Reset)
            }
            _ => Err(FaultKind::UnknownType),
        }
    }
}

fn write_hand(hand: &Hand<f32>, sink: &mut impl Sink) {
    sink.f32s(&hand.position);
    sink.f32(hand.angle.rest);
    sink.i32(hand.angle.turns);
    sink.f32(hand.depth);
    sink.byte(u8::from(hand.held));
}

fn read_hand(fields: &mut Fields<'_>) -> Result<Hand<f32>, FaultKind> {
    fields.exactly(21)?;
    let [x, y, rest] = fields.f32s();
    let turns = fields.i32();
    Ok(Hand {
        position: [x, y],
        angle: Angle { turns, rest },
        depth: fields.f32(),
        held: fields.flag()?,
        tilted: false,
    })
}

fn read_tracker(fields: &mut Fields<'_>) -> Result<TrackerSample<f32>, FaultKind> {
    fields.exactly(29)?;
    Ok(TrackerSample {
        position: fields.f32s(),
        orientation: fields.f32s(),
        held: fields.flag()?,
    })
}
