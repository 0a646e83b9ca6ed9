//! Random messages of every type, the same in every run.

mod obstacles;

use self::obstacles::obstacles;
use crate::Either;
use stiction_core::{
    Angle, Axis, Contact, Event, Evolution, Hand, ObstacleDescription, Parameter, StateKind,
    Status, SurfaceDescription, TrackerSample, Wrench,
};
use stiction_wire::FaultKind;
use stiction_wire::{
    Command, Drive, EventSet, Events, Faults, Forces, Frame, Health, Info, KnobInfo, KnobNumber,
    KnobNumbers, KnobSource, List, Mode, NumberType, ObstacleList, Parameters, Pong, Pose, Reason,
    Reference, Reply, Report, Reset, SceneCommand, Stepping, Subject, Text,
};

/// Random numbers (splitmix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    pub(crate) fn below(&mut self, limit: usize) -> usize {
        (self.bits() % limit as u64) as usize
    }
    pub(crate) fn byte(&mut self) -> u8 {
        self.bits() as u8
    }
    pub(crate) fn flag(&mut self) -> bool {
        self.bits() & 1 == 1
    }
    fn half(&mut self) -> u16 {
        self.bits() as u16
    }
    fn word(&mut self) -> u32 {
        self.bits() as u32
    }
    /// Of every kind: whole, small, large, arbitrary bits, not finite. A NaN is the quiet one, because other programs
    /// change the bits of others.
    pub(crate) fn float(&mut self) -> f32 {
        let any = match self.below(6) {
            0 => self.below(3) as f32 - 1.0,
            1 => -0.0,
            2 => f32::INFINITY,
            3 => f32::from_bits(self.word()),
            _ => self.word() as i32 as f32 / (1u32 << 28) as f32,
        };
        if any.is_nan() { f32::NAN } else { any }
    }
    fn floats<const N: usize>(&mut self) -> [f32; N] {
        std::array::from_fn(|_| self.float())
    }
    fn option(&mut self) -> Option<f32> {
        self.flag().then(|| self.float())
    }
    fn one<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }
    fn reference(&mut self) -> Reference {
        Reference {
            code: self.byte(),
            sequence: self.byte(),
        }
    }
    fn mode(&mut self) -> Mode {
        let index = self.below(3);
        let other = (index + 1 + self.below(2)) % 3;
        let plane = [index, other].map(|index| Axis {
            index,
            negative: self.flag(),
        });
        Mode {
            evolution: self.one(&[Evolution::Path, Evolution::Frame]),
            stepping: self.one(&Stepping::ALL),
            plane,
            events: self.flag(),
            tick_rate: self.half(),
            pose_every: self.half(),
            forces_every: self.half(),
            health_every: self.half(),
        }
    }
    fn knob(&mut self) -> KnobNumbers {
        KnobNumbers {
            origin: self.floats(),
            radius: self.float(),
            counts_per_turn: self.word(),
            encoder_reversed: self.flag(),
            torque_constant: self.float(),
            full_current: self.float(),
            torque_limit: self.float(),
            motor_reversed: self.flag(),
            damping: self.float(),
        }
    }
    fn subject(&mut self) -> Subject {
        let (i, j) = (self.below(256), self.below(256));
        let of_obstacles = Subject::Scene(self.parameter());
        let of_knob = Subject::Knob(self.one(&KnobNumber::ALL));
        self.one(&[
            of_obstacles,
            Subject::Command,
            Subject::TickRate,
            Subject::LineRate,
            of_knob,
            Subject::Scene(Parameter::VertexCount),
            Subject::Scene(Parameter::Vertex(i)),
            Subject::Scene(Parameter::Start),
            Subject::Scene(Parameter::Weight),
            Subject::Scene(Parameter::HoldingPoint),
            Subject::Scene(Parameter::Reach),
            Subject::Scene(Parameter::StiffnessTranslation),
            Subject::Scene(Parameter::StiffnessRotation),
            Subject::Scene(Parameter::SurfaceCount),
            Subject::Scene(Parameter::Normal(i)),
            Subject::Scene(Parameter::Offset(i)),
            Subject::Scene(Parameter::FrictionStatic(i)),
            Subject::Scene(Parameter::FrictionDynamic(i)),
            Subject::Scene(Parameter::Memory(i)),
            Subject::Scene(Parameter::Penetration {
                surface: i,
                vertex: j,
            }),
        ])
    }
}

/// The storage that the lists of a message borrow from.
#[derive(Default)]
pub(crate) struct Store {
    vertices: Vec<[f32; 2]>,
    surfaces: Vec<SurfaceDescription<f32>>,
    obstacles: Vec<ObstacleDescription<'static, f32>>,
    contacts: Vec<Contact<f32>>,
    events: Vec<Event>,
    text: String,
}

impl Store {
    pub(crate) fn fill(random: &mut Random, longest: usize) -> Self {
        let mut count = || random.below(longest + 1);
        let [v, s, c, e, t] = [
            count(),
            count(),
            count().min(8),
            count().min(16),
            count().min(200),
        ];
        Self {
            vertices: (0..v).map(|_| random.floats()).collect(),
            surfaces: (0..s).map(|_| surface(random)).collect(),
            obstacles: obstacles(random, longest),
            contacts: (0..c).map(|_| contact(random)).collect(),
            events: (0..e).map(|_| random.one(&Event::ALL)).collect(),
            text: (0..t)
                .map(|_| char::from(b' ' + random.below(95) as u8))
                .collect(),
        }
    }

    fn scene(&self, random: &mut Random) -> SceneCommand<'_> {
        SceneCommand {
            vertices: List::from(self.vertices.as_slice()),
            start: random.floats(),
            weight: random.float(),
            holding_point: random.flag().then(|| random.floats()),
            reach: random.float(),
            stiffness_translation: random.float(),
            stiffness_rotation: random.float(),
            surfaces: List::from(self.surfaces.as_slice()),
            obstacles: ObstacleList::from(self.obstacles.as_slice()),
        }
    }

    /// Of every type; half the commands are scenes.
    pub(crate) fn frame(&self, random: &mut Random) -> Either<'_> {
        let (sequence, time) = (random.byte(), random.word());
        if random.flag() {
            let message = match random.flag() {
                true => Command::Scene(self.scene(random)),
                false => self.command(random),
            };
            return Either::Command(Frame {
                sequence,
                time,
                message,
            });
        }
        Either::Report(Frame {
            sequence,
            time,
            message: self.report(random),
        })
    }

    fn reply(&self, random: &mut Random) -> Reply<'_> {
        Reply {
            command: random.reference(),
            reason: random.one(&Reason::ALL),
            subject: random.subject(),
            value: random.float(),
            limit: random.float(),
            allowed: Text::new(&self.text),
        }
    }

    fn command(&self, random: &mut Random) -> Command<'_> {
        match random.below(10) {
            0 => Command::Hand(Hand {
                position: random.floats(),
                angle: Angle {
                    turns: random.word() as i32,
                    rest: random.float(),
                },
                depth: random.float(),
                held: random.flag(),
                tilted: false,
            }),
            1 => Command::Tracker(TrackerSample {
                position: random.floats(),
                orientation: random.floats(),
                held: random.flag(),
            }),
            2 => Command::Parameters(Parameters {
                stiffness_translation: random.float(),
                stiffness_rotation: random.float(),
                friction_static: random.float(),
                friction_dynamic: random.float(),
                memory: random.option(),
            }),
            3 => Command::Scene(self.scene(random)),
            4 => Command::Mode(random.mode()),
            5 => Command::Hello,
            6 => Command::Ping,
            7 => Command::Knob(random.knob()),
            8 => Command::AskKnob,
            _ => Command::Reset(random.one(&Reset::ALL)),
        }
    }

    fn report(&self, random: &mut Random) -> Report<'_> {
        match random.below(8) {
            0 => Report::Pose(pose(random)),
            1 => Report::Forces(Forces {
                wrench: wrench(random.floats()),
                feedback: wrench(random.floats()),
                turns: random.word() as i32,
                contacts: List::from(self.contacts.as_slice()),
            }),
            2 => Report::Events(Events {
                slips: random.word(),
                longest_slip: random.float(),
                list: List::from(self.events.as_slice()),
            }),
            3 => Report::Reply(self.reply(random)),
            4 => Report::Info(Info {
                version: [random.byte(), random.byte(), random.byte()],
                number: random.one(&NumberType::ALL),
                vertices: random.byte(),
                surfaces: random.byte(),
                corners: random.byte(),
                actuators: random.flag(),
                longest_frame: random.half(),
                fastest_tick: random.half(),
                budget: random.word(),
                stiffest: random.floats(),
                stiffness: random.floats(),
                friction_now: random.floats(),
                memory_now: random.option(),
                mode: random.mode(),
                name: Text::new(&self.text),
            }),
            5 => Report::Health(health(random)),
            6 => Report::KnobInfo(KnobInfo {
                source: random.one(&KnobSource::ALL),
                numbers: random.knob(),
            }),
            _ => Report::Pong(Pong {
                sequence: random.byte(),
                time: random.word(),
            }),
        }
    }
}

pub(crate) fn pose(random: &mut Random) -> Pose {
    let mut events = EventSet::default();
    for event in Event::ALL {
        if random.flag() {
            events.insert(event);
        }
    }
    Pose {
        position: random.floats(),
        rest: random.float(),
        turns: random.byte() & 7,
        depth: random.float(),
        state: random.one(&StateKind::ALL),
        status: random.one(&Status::ALL),
        held: random.flag(),
        force_off: random.flag(),
        events,
        sample: random.byte(),
    }
}

fn health(random: &mut Random) -> Health {
    let mut faults = Faults::new();
    for kind in FaultKind::ALL {
        (0..random.below(5)).for_each(|_| faults.count(kind));
    }
    Health {
        drive: random.one(&Drive::ALL),
        ticks: random.word(),
        missed_ticks: random.word(),
        samples: random.word(),
        late_samples: random.word(),
        lost_frames: random.word(),
        unsent: random.word(),
        worst_step: random.word(),
        worst_tick: random.word(),
        faults,
    }
}

fn surface(random: &mut Random) -> SurfaceDescription<f32> {
    SurfaceDescription {
        normal: random.floats(),
        offset: random.float(),
        friction_static: random.float(),
        friction_dynamic: random.float(),
        memory: random.option(),
    }
}

fn wrench([x, y, moment]: [f32; 3]) -> Wrench<f32> {
    Wrench {
        force: [x, y],
        moment,
    }
}

fn contact(random: &mut Random) -> Contact<f32> {
    Contact {
        touch: random.touch(),
        direction: random.floats(),
        point: random.floats(),
        normal: random.float(),
        friction: random.float(),
        sliding: random.one(&[0, 1, -1]),
    }
}
