//! A board in a thread of this test: the frames of FRAME.md over a socket, and the solver behind them.

use std::fs;
use std::io::{ErrorKind, Read, Write};
use std::net::TcpListener;
use std::os::unix::net::UnixListener;
use std::path::{Path, PathBuf};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use stiction_core::{Hand, Real, Scene, SceneError, Solver, State, SurfaceDescription};
use stiction_wire::{
    Command, Decoder, EventSet, Events, Forces, Frame, Health, List, Mode, Pong, Pose, Reason,
    Reference, Reply, Report, SceneCommand, Subject, Text, frame_bytes, scene_bytes, wire_bytes,
};

use super::made::{OF_VERSION_1, info};

pub(crate) const VERTICES: usize = 16;
pub(crate) const SURFACES: usize = 8;
pub(crate) const LONGEST: usize = frame_bytes(scene_bytes([VERTICES, SURFACES, 0, 0]));
pub(crate) const FASTEST: u16 = 5000;

#[derive(Clone, Debug, Default)]
pub(crate) struct Tricks {
    /// The lowest bit of this part of the answer to this sample (from 0).
    pub(crate) flip: Option<(u64, Part)>,
    pub(crate) lost: Vec<u64>,
    pub(crate) forceless: Vec<u64>,
    /// Garbage stands before every report.
    pub(crate) garbage: bool,
    /// After so many samples it takes no more and sends no more.
    pub(crate) silent_after: Option<u64>,
    /// After so many samples it goes away, the first time.
    pub(crate) leaves_after: Option<u64>,
    pub(crate) is_of_version_1: bool,
    pub(crate) echo: bool,
    /// Bytes that its line transfers in a second.
    pub(crate) line_rate: Option<f32>,
    /// It does so many pieces of work in a second: the budget of a step follows from its tick.
    pub(crate) work_rate: Option<u32>,
    /// After so many samples it answers none, and says other things as fast as the line takes them.
    pub(crate) floods_after: Option<u64>,
    /// It measures the hand itself.
    pub(crate) measures: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    PoseX,
    Theta,
    Wrench,
    Friction,
    Sliding,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Seen {
    /// Hands that came.
    pub(crate) samples: u64,
    pub(crate) mode: Mode,
}

/// A line in both directions; reading gives up after a while.
pub(crate) trait Connection: Read + Write + Send {}
impl<T: Read + Write + Send> Connection for T {}

const BREATH: Duration = Duration::from_millis(5);

/// A board behind a unix socket, for so many sessions.
pub(crate) fn behind_socket<R: Real<Si = f32>>(
    place: &Path,
    sessions: usize,
    tricks: Tricks,
) -> JoinHandle<Seen> {
    let place: PathBuf = place.to_owned();
    let mut listener = Some(UnixListener::bind(&place).expect("a socket"));
    thread::spawn(move || {
        let mut board = FakeBoard::<R>::new(tricks);
        for session in 0..sessions {
            if session > 0 {
                // It was pulled out: nothing is there for a while.
                drop(listener.take());
                fs::remove_file(&place).expect("the socket");
                thread::sleep(Duration::from_millis(300));
                listener = Some(UnixListener::bind(&place).expect("a socket"));
            }
            let (line, _) = listener
                .as_ref()
                .expect("there")
                .accept()
                .expect("a client");
            line.set_read_timeout(Some(BREATH)).expect("a time");
            board.serve(Box::new(line));
        }
        board.seen
    })
}

/// A board behind a tcp port; its address.
pub(crate) fn behind_tcp<R: Real<Si = f32>>(tricks: Tricks) -> (String, JoinHandle<Seen>) {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = listener.local_addr().expect("bound").to_string();
    let board = thread::spawn(move || {
        let mut board = FakeBoard::<R>::new(tricks);
        let (line, _) = listener.accept().expect("a client");
        line.set_read_timeout(Some(BREATH)).expect("a time");
        line.set_nodelay(true).expect("an option");
        board.serve(Box::new(line));
        board.seen
    });
    (address, board)
}

/// A board on a line that is there already.
pub(crate) fn on<R: Real<Si = f32>>(
    line: impl Connection + 'static,
    tricks: Tricks,
) -> JoinHandle<Seen> {
    thread::spawn(move || {
        let mut board = FakeBoard::<R>::new(tricks);
        board.serve(Box::new(line));
        board.seen
    })
}

struct FakeBoard<R: Real> {
    tricks: Tricks,
    seen: Seen,
    scene: Option<Scene<R, VERTICES, SURFACES>>,
    state: Option<State<R>>,
    sequence: u8,
    begun: Instant,
    last_health: Instant,
    out: Vec<u8>,
    left: bool,
}

impl<R: Real<Si = f32>> FakeBoard<R> {
    fn new(tricks: Tricks) -> Self {
        let now = Instant::now();
        let mode = Mode {
            health_every: 50,
            ..Mode::default()
        };
        Self {
            tricks,
            seen: Seen { samples: 0, mode },
            scene: None,
            state: None,
            sequence: 0,
            begun: now,
            last_health: now,
            out: Vec::new(),
            left: false,
        }
    }

    /// Until the client goes, or the board does.
    fn serve(&mut self, mut line: Box<dyn Connection>) {
        let mut decoder = Decoder::<LONGEST>::new();
        let mut bytes = [0; 1024];
        loop {
            let count = match line.read(&mut bytes) {
                Ok(0) => return,
                Ok(count) => count,
                Err(error)
                    if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) =>
                {
                    0
                }
                Err(_) => return,
            };
            if self.tricks.echo {
                let _ = line.write_all(&bytes[..count]);
                continue;
            }
            for &byte in &bytes[..count] {
                if let Some(received) = decoder.push::<Command<'_>>(byte) {
                    let frame = received.expect("an undamaged frame");
                    self.obey(frame);
                    if self.leaves() {
                        return;
                    }
                }
            }
            self.tell_health();
            if self.floods() {
                (0..100).for_each(|sequence| {
                    self.say(self.now(), Report::Pong(Pong { sequence, time: 0 }));
                });
            }
            let out = std::mem::take(&mut self.out);
            let silent = self
                .tricks
                .silent_after
                .is_some_and(|n| self.seen.samples >= n);
            if !silent && line.write_all(&out).is_err() {
                return;
            }
        }
    }

    fn floods(&self) -> bool {
        let after = self.tricks.floods_after;
        after.is_some_and(|n| self.seen.samples >= n)
    }

    fn leaves(&mut self) -> bool {
        let leaves = self.tricks.leaves_after == Some(self.seen.samples) && !self.left;
        self.left |= leaves;
        leaves
    }

    fn tell_health(&mut self) {
        if self.floods() {
            return;
        }
        let period = Duration::from_millis(self.seen.mode.health_every.into());
        if self.last_health.elapsed() >= period && !period.is_zero() {
            self.last_health = Instant::now();
            let health = Health {
                ticks: self.begun.elapsed().as_millis() as u32,
                samples: self.seen.samples as u32,
                ..Health::default()
            };
            self.say(self.now(), Report::Health(health));
        }
    }

    fn now(&self) -> u32 {
        self.begun.elapsed().as_micros() as u32
    }

    fn say(&mut self, time: u32, message: Report<'_>) {
        let frame = Frame {
            sequence: self.sequence,
            time,
            message,
        };
        self.sequence = self.sequence.wrapping_add(1);
        let mut wire = [0; wire_bytes(1000)];
        let wire = frame.encode(&mut wire).expect("there is room");
        if self.tricks.garbage {
            self.out.extend([7, 1, 2, 0, 3, 9, 9, 0]);
        }
        match self.tricks.is_of_version_1 {
            false => self.out.extend(wire),
            true => self.out.extend(OF_VERSION_1),
        }
    }

    fn obey(&mut self, frame: Frame<Command<'_>>) {
        let (now, to) = (self.now(), frame.reference());
        match frame.message {
            Command::Hand(_) if self.tricks.measures => {
                let mut reply = Reply::refused(to, Reason::Unsupported);
                reply.allowed = Text::new("no samples");
                self.say(now, Report::Reply(reply));
            }
            Command::Hand(hand) => self.step(hand, frame.sequence),
            Command::Hello => self.say(now, Report::Info(info::<R>(self.seen.mode, self.budget()))),
            Command::Ping => {
                let (sequence, time) = (frame.sequence, frame.time);
                self.say(now, Report::Pong(Pong { sequence, time }));
            }
            Command::Scene(scene) => {
                let reply = match self.build(&scene) {
                    Ok(()) => Reply::done(to),
                    Err(error) => Reply::refused_scene(to, &error),
                };
                self.say(now, Report::Reply(reply));
            }
            Command::Mode(mode) => {
                let reply = self.work(mode, to);
                self.say(now, Report::Reply(reply));
            }
            other => panic!("{other:?}"),
        }
    }

    fn budget(&self) -> u32 {
        let rate = u32::from(self.seen.mode.tick_rate).max(1);
        self.tricks.work_rate.map_or(u32::MAX, |units| units / rate)
    }

    fn build(&mut self, scene: &SceneCommand<'_>) -> Result<(), SceneError<f32>> {
        let nothing = SurfaceDescription {
            normal: [0.0; 2],
            offset: 0.0,
            friction_static: 0.0,
            friction_dynamic: 0.0,
            memory: None,
        };
        let (mut vertices, mut surfaces) = ([[0.0; 2]; VERTICES], [nothing; SURFACES]);
        let description = scene.description([&mut vertices, &mut []], &mut surfaces, &mut [])?;
        self.scene = Some(Scene::new(&description)?);
        self.state = None;
        Ok(())
    }

    fn work(&mut self, mode: Mode, to: Reference) -> Reply<'static> {
        let refused = |subject, value: f32, limit: f32, allowed| Reply {
            command: to,
            reason: Reason::Unsupported,
            subject,
            value,
            limit,
            allowed: Text::new(allowed),
        };
        if mode.tick_rate > FASTEST {
            let (value, limit) = (f32::from(mode.tick_rate), f32::from(FASTEST));
            return refused(Subject::TickRate, value, limit, "1 to 5000");
        }
        let load = 100.0 * f32::from(mode.tick_rate) / f32::from(mode.pose_every.max(1));
        match self.tricks.line_rate {
            Some(limit) if load > limit => refused(Subject::LineRate, load, limit, "less"),
            _ => {
                self.seen.mode = mode;
                Reply::done(to)
            }
        }
    }

    /// A step with every sample, as the client asks for, or as a tick that is never too late would make it.
    fn step(&mut self, hand: Hand<f32>, sample: u8) {
        let index = self.seen.samples;
        self.seen.samples += 1;
        let mode = self.seen.mode;
        let scene = self.scene.clone().expect("a scene");
        let solver = Solver::new(scene, mode.evolution).with_budget(self.budget());
        let output = match &mut self.state {
            Some(state) => solver.step(state, hand),
            None => {
                let (state, output) = solver.start(hand);
                self.state = Some(state);
                output
            }
        };
        if self.tricks.lost.contains(&index) || self.floods() {
            return;
        }
        let flip = |part, value: &mut f32| {
            if self.tricks.flip == Some((index, part)) {
                *value = f32::from_bits(value.to_bits() ^ 1);
            }
        };
        let mut pose = Pose::new(&output, EventSet::of(output.events()), sample);
        flip(Part::PoseX, &mut pose.position[0]);
        flip(Part::Theta, &mut pose.rest);
        let state = self.state.as_ref().expect("a state");
        let (mut wrench, mut contacts) = (solver.wrench(state), solver.contacts(state).to_vec());
        flip(Part::Wrench, &mut wrench.moment);
        if let Some(contact) = contacts.last_mut() {
            flip(Part::Friction, &mut contact.friction);
            if self.tricks.flip == Some((index, Part::Sliding)) {
                contact.sliding = i8::from(contact.sliding == 0);
            }
        }
        // A millisecond a step, whatever the clock says: parts of a step are known by their time.
        let time = 1000 * (index as u32 + 1);
        self.say(time, Report::Pose(pose));
        if !output.events().is_empty() && mode.events {
            let events = Events {
                slips: output.slips,
                longest_slip: output.longest_slip,
                list: List::from(output.events()),
            };
            self.say(time, Report::Events(events));
        }
        if mode.forces_every > 0 && !self.tricks.forceless.contains(&index) {
            let forces = Forces {
                wrench,
                feedback: wrench.feedback(),
                turns: output.angle.turns,
                contacts: List::from(&contacts[..]),
            };
            self.say(time, Report::Forces(forces));
        }
    }
}
