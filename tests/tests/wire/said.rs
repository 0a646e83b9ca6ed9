//! The content of a frame, with the field names of FRAME.md.

mod obstacles;

use self::obstacles::{contact, of_obstacle};
use crate::Either;
use serde_json::{Map, Value as Json};
use std::collections::BTreeMap;
use stiction_core::{Event, Evolution, Parameter, StateKind, Status, SurfaceDescription, Wrench};
use stiction_wire::{
    Command, Events, Info, KnobNumber, KnobNumbers, KnobSource, List, Mode, Pose, Reason, Report,
    SceneCommand, Subject,
};

/// The value of a field. Floats are compared by their bits.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Int(i64),
    Float(u32),
    List(Vec<Value>),
    Text(String),
}

/// Fields by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Said(pub(crate) BTreeMap<String, Value>);

const TEXTS: [&str; 3] = ["type", "allowed", "name"];

impl Said {
    pub(crate) fn of(frame: &Either<'_>) -> Self {
        let mut said = Self::default();
        let (name, sequence, time) = match frame {
            Either::Command(f) => (f.message.name(), f.sequence, f.time),
            Either::Report(f) => (f.message.name(), f.sequence, f.time),
        };
        said.text("type", name)
            .int("sequence", sequence)
            .int("time", time);
        match frame {
            Either::Command(f) => said.command(&f.message),
            Either::Report(f) => said.report(&f.message),
        }
        said
    }

    /// From lines `field = value`.
    pub(crate) fn parse(lines: &str) -> Self {
        let pairs = lines.lines().map(|line| {
            let (name, value) = line.split_once(" = ").expect("field = value");
            (name.to_owned(), parse(value))
        });
        Self(pairs.collect())
    }

    pub(crate) fn from_json(json: &Map<String, Json>) -> Self {
        let text = |name: &str, value: &Json| match value {
            Json::String(text) if TEXTS.contains(&name) => Value::Text(text.clone()),
            value => number(value),
        };
        Self(
            json.iter()
                .map(|(name, value)| (name.clone(), text(name, value)))
                .collect(),
        )
    }

    pub(crate) fn to_json(&self) -> Json {
        let pairs = self
            .0
            .iter()
            .map(|(name, value)| (name.clone(), json(value)));
        Json::Object(pairs.collect())
    }

    fn put(&mut self, name: impl Into<String>, value: Value) -> &mut Self {
        let twice = self.0.insert(name.into(), value);
        assert!(twice.is_none(), "every field once");
        self
    }
    fn int(&mut self, name: &str, value: impl Into<i64>) -> &mut Self {
        self.put(name, Value::Int(value.into()))
    }
    fn float(&mut self, name: &str, value: f32) -> &mut Self {
        self.put(name, float(value))
    }
    fn floats(&mut self, names: &str, values: &[f32]) -> &mut Self {
        assert_eq!(names.split(' ').count(), values.len());
        for (name, &value) in names.split(' ').zip(values) {
            self.float(name, value);
        }
        self
    }
    /// A flag and a number, which is 0 if the flag is not set.
    fn option(&mut self, name: &str, value: Option<f32>) -> &mut Self {
        self.int(&format!("has_{name}"), value.is_some())
            .float(name, value.unwrap_or_default())
    }
    fn text(&mut self, name: &str, value: &str) -> &mut Self {
        self.put(name, Value::Text(value.to_owned()))
    }
    fn list(&mut self, count: &str, item: &str, values: impl Iterator<Item = Value>) -> &mut Self {
        let mut length = 0;
        for value in values {
            self.put(format!("{item}_{length}"), value);
            length += 1;
        }
        self.int(count, length)
    }

    fn command(&mut self, command: &Command<'_>) {
        match command {
            Command::Hand(hand) => {
                let ([x, y], phi) = (hand.position, hand.angle.rest);
                self.floats("x y phi depth", &[x, y, phi, hand.depth]);
                self.int("turns", hand.angle.turns).int("held", hand.held);
            }
            Command::Tracker(sample) => {
                self.floats("x y z", &sample.position);
                self.floats("qx qy qz qw", &sample.orientation);
                self.int("held", sample.held);
            }
            Command::Parameters(p) => {
                self.float("k_h", p.stiffness_translation);
                self.float("k_theta", p.stiffness_rotation);
                self.float("mu_s", p.friction_static);
                self.float("mu_d", p.friction_dynamic);
                self.option("memory", p.memory);
            }
            Command::Scene(scene) => self.scene(scene),
            Command::Mode(mode) => self.mode(mode),
            Command::Hello | Command::Ping | Command::AskKnob => {}
            Command::Reset(what) => {
                self.int("what", i64::from(what.name() == "everything"));
            }
            Command::Knob(numbers) => self.knob(numbers),
        }
    }

    fn knob(&mut self, numbers: &KnobNumbers) {
        self.floats("origin_x origin_y", &numbers.origin)
            .float("radius", numbers.radius)
            .int("counts_per_turn", numbers.counts_per_turn)
            .int("encoder_reversed", numbers.encoder_reversed)
            .float("torque_constant", numbers.torque_constant)
            .float("full_current", numbers.full_current)
            .float("torque_limit", numbers.torque_limit)
            .int("motor_reversed", numbers.motor_reversed)
            .float("damping", numbers.damping);
    }

    fn scene(&mut self, scene: &SceneCommand<'_>) {
        self.floats("start_x start_y start_theta", &scene.start);
        self.int("has_point", scene.holding_point.is_some());
        self.floats("point_x point_y", &scene.holding_point.unwrap_or_default());
        self.float("weight", scene.weight)
            .float("reach", scene.reach);
        self.float("k_h", scene.stiffness_translation);
        self.float("k_theta", scene.stiffness_rotation);
        let surface = |s: SurfaceDescription<f32>| {
            let [x, y] = s.normal;
            let numbers = [x, y, s.offset, s.friction_static, s.friction_dynamic].map(float);
            let memory = [
                Value::Int(s.memory.is_some().into()),
                float(s.memory.unwrap_or_default()),
            ];
            Value::List(numbers.into_iter().chain(memory).collect())
        };
        self.list(
            "vertices",
            "vertex",
            scene.vertices.iter().map(|v| floats(&v)),
        );
        self.list("surfaces", "surface", scene.surfaces.iter().map(surface));
        self.obstacles(&scene.obstacles);
    }

    fn mode(&mut self, mode: &Mode) {
        self.int("evolution", i64::from(mode.evolution == Evolution::Frame));
        self.int("stepping", i64::from(mode.stepping.name() == "per-sample"));
        for (name, axis) in ["axis_x", "axis_y"].iter().zip(mode.plane) {
            self.int(name, axis.index as i64 + if axis.negative { 4 } else { 0 });
        }
        self.int("events", mode.events)
            .int("tick_rate", mode.tick_rate);
        self.int("pose_every", mode.pose_every)
            .int("forces_every", mode.forces_every);
        self.int("health_every", mode.health_every);
    }

    fn report(&mut self, report: &Report<'_>) {
        match report {
            Report::Pose(pose) => self.pose(pose),
            Report::Forces(f) => {
                let contacts = f.contacts.iter().map(contact);
                self.forces([f.wrench, f.feedback], f.turns, contacts);
            }
            Report::Events(events) => self.events(events),
            Report::Reply(reply) => {
                let reason = Reason::ALL.iter().position(|r| *r == reply.reason);
                let (subject, [index, index2]) = subject(reply.subject);
                self.int("command", reply.command.code)
                    .int("command_sequence", reply.command.sequence);
                self.int("reason", reason.expect("one of all") as i64)
                    .int("subject", subject);
                self.int("index", index as i64).int("index2", index2 as i64);
                self.float("value", reply.value).float("limit", reply.limit);
                self.text("allowed", &reply.allowed.to_string());
            }
            Report::Info(info) => self.info(info),
            Report::Health(h) => {
                self.int(
                    "drive",
                    ["on", "silent", "latched"]
                        .iter()
                        .position(|d| *d == h.drive.name())
                        .expect("one") as i64,
                );
                self.int("ticks", h.ticks)
                    .int("missed_ticks", h.missed_ticks)
                    .int("samples", h.samples);
                self.int("late_samples", h.late_samples)
                    .int("lost_frames", h.lost_frames)
                    .int("unsent", h.unsent);
                self.int("worst_step", h.worst_step)
                    .int("worst_tick", h.worst_tick);
                for kind in stiction_wire::FaultKind::ALL {
                    self.int(&kind.name().replace('-', "_"), h.faults.of(kind));
                }
            }
            Report::Pong(pong) => {
                self.int("ping_sequence", pong.sequence)
                    .int("ping_time", pong.time);
            }
            Report::KnobInfo(info) => {
                let source = match info.source {
                    KnobSource::CompiledIn => 0,
                    KnobSource::Stored => 1,
                    KnobSource::Unusable => 2,
                };
                self.int("source", source).knob(&info.numbers);
            }
        }
    }

    fn pose(&mut self, pose: &Pose) {
        let [x, y] = pose.position;
        self.floats("x y theta depth", &[x, y, pose.rest, pose.depth]);
        let state = StateKind::ALL.iter().position(|s| *s == pose.state);
        self.int("state", state.expect("one of all") as i64)
            .int("status", status(pose.status));
        self.int("held", pose.held)
            .int("force_off", pose.force_off)
            .int("turns", pose.turns);
        let bits = (0..Event::ALL.len()).filter(|&bit| pose.events.contains(Event::ALL[bit]));
        self.int("events", bits.map(|bit| 1 << bit).sum::<i64>())
            .int("sample", pose.sample);
    }

    fn forces(
        &mut self,
        [wrench, feedback]: [Wrench<f32>; 2],
        turns: i32,
        contacts: impl Iterator<Item = Value>,
    ) {
        for (names, wrench) in [
            ("wrench_x wrench_y wrench_m", wrench),
            ("hand_x hand_y hand_m", feedback),
        ] {
            let [x, y] = wrench.force;
            self.floats(names, &[x, y, wrench.moment]);
        }
        self.int("turns", turns)
            .list("contacts", "contact", contacts);
    }

    fn events(&mut self, events: &Events<'_>) {
        let code = |event: Event| {
            Event::ALL
                .iter()
                .position(|e| *e == event)
                .expect("one of all")
        };
        let list: List<'_, Event> = events.list;
        self.int("slips", events.slips)
            .float("longest_slip", events.longest_slip);
        self.list(
            "events",
            "event",
            list.iter().map(|e| Value::Int(code(e) as i64)),
        );
    }

    fn info(&mut self, info: &Info<'_>) {
        for (name, part) in ["major", "minor", "patch"].iter().zip(info.version) {
            self.int(name, part);
        }
        self.int("number", i64::from(info.number.name() == "fixed"));
        self.int("vertices", info.vertices)
            .int("surfaces", info.surfaces)
            .int("corners", info.corners);
        self.int("actuators", info.actuators);
        self.int("longest_frame", info.longest_frame)
            .int("fastest_tick", info.fastest_tick)
            .int("budget", info.budget);
        self.floats("stiffest_k_h stiffest_k_theta", &info.stiffest);
        self.floats("k_h k_theta", &info.stiffness)
            .floats("mu_s mu_d", &info.friction_now);
        self.option("memory", info.memory_now);
        self.mode(&info.mode);
        self.text("name", &info.name.to_string());
    }
}

fn status(status: Status) -> i64 {
    let names = [
        "ok",
        "event-limit",
        "iteration-limit",
        "ambiguous",
        "saturated",
        "held-last",
        "jammed",
        "twist",
        "behind",
    ];
    names
        .iter()
        .position(|name| *name == status.name())
        .expect("one of all") as i64
}

fn subject(subject: Subject) -> (i64, [usize; 2]) {
    let parameter = match subject {
        Subject::Command => return (0, [0; 2]),
        Subject::TickRate => return (32, [0; 2]),
        Subject::LineRate => return (33, [0; 2]),
        Subject::Knob(number) => return (knob_number(number), [0; 2]),
        Subject::Scene(parameter) => parameter,
    };
    match parameter {
        Parameter::VertexCount => (1, [0; 2]),
        Parameter::Vertex(i) => (2, [i, 0]),
        Parameter::Start => (3, [0; 2]),
        Parameter::Weight => (4, [0; 2]),
        Parameter::HoldingPoint => (5, [0; 2]),
        Parameter::Reach => (6, [0; 2]),
        Parameter::StiffnessTranslation => (7, [0; 2]),
        Parameter::StiffnessRotation => (8, [0; 2]),
        Parameter::SurfaceCount => (9, [0; 2]),
        Parameter::Normal(i) => (10, [i, 0]),
        Parameter::Offset(i) => (11, [i, 0]),
        Parameter::FrictionStatic(i) => (12, [i, 0]),
        Parameter::FrictionDynamic(i) => (13, [i, 0]),
        Parameter::Penetration { surface, vertex } => (14, [surface, vertex]),
        Parameter::Memory(i) => (15, [i, 0]),
        other => of_obstacle(other),
    }
}

const fn knob_number(number: KnobNumber) -> i64 {
    match number {
        KnobNumber::Origin => 48,
        KnobNumber::Radius => 49,
        KnobNumber::CountsPerTurn => 50,
        KnobNumber::TorqueConstant => 51,
        KnobNumber::FullCurrent => 52,
        KnobNumber::TorqueLimit => 53,
        KnobNumber::Damping => 54,
    }
}

fn float(value: f32) -> Value {
    Value::Float(value.to_bits())
}

fn floats(values: &[f32]) -> Value {
    Value::List(values.iter().copied().map(float).collect())
}

fn parse(value: &str) -> Value {
    if let Some(text) = value.strip_prefix('"').and_then(|v| v.strip_suffix('"')) {
        return Value::Text(text.to_owned());
    }
    let one = |item: &str| match item.parse() {
        Ok(int) => Value::Int(int),
        Err(_) => float(item.parse().expect("a number")),
    };
    if value.contains(", ") {
        Value::List(value.split(", ").map(one).collect())
    } else {
        one(value)
    }
}

fn number(value: &Json) -> Value {
    match value {
        Json::Array(items) => Value::List(items.iter().map(number).collect()),
        Json::String(text) => float(text.parse().expect("nan or inf")),
        value => match value.as_i64() {
            Some(int) => Value::Int(int),
            None => float(value.as_f64().expect("a number") as f32),
        },
    }
}

fn json(value: &Value) -> Json {
    match value {
        Value::Int(int) => Json::from(*int),
        Value::Float(bits) => {
            let value = f32::from_bits(*bits);
            match serde_json::Number::from_f64(f64::from(value)) {
                Some(finite) => Json::Number(finite),
                None => Json::from(value.to_string()),
            }
        }
        Value::List(items) => Json::Array(items.iter().map(json).collect()),
        Value::Text(text) => Json::from(text.as_str()),
    }
}
