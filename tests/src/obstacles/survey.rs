//! A survey of random scenes: which frames break a law, which statuses occur, and which steps are slow, panic or never end. Each share
//! of the scenes runs in its own process, which exits if a step never ends; its parent continues with the next scene.

use super::guard::caught;
use super::laws::{Laws, STAYS};
use super::rooms::room;
use super::run::{Run, touches};
use super::worlds::{World, world};
use crate::number::Number;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::{self, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};
use stiction_core::Evolution;
use stiction_judge::{Finding, Frame, Status, Touch};

/// A step that takes longer is reported.
const LONG: Duration = Duration::from_secs(1);
/// A step that takes longer is considered endless.
const ENDLESS: Duration = Duration::from_secs(10);
/// The exit code of a process in which a step never ended.
pub const NEVER_ENDS: i32 = 3;

/// The kind of random scenes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Ordinary use among obstacles.
    Worlds,
    /// Jumps in closed rooms.
    Rooms,
}

impl Kind {
    /// The scene with this number, for a number type.
    pub fn scene<R: Number>(self, number: u64) -> World {
        match self {
            Self::Worlds => world(number),
            Self::Rooms => room(number, R::FARTHEST),
        }
    }
}

/// The results of a scene.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Frames that were examined.
    pub frames: usize,
    /// The frames that break laws.
    pub unlawful: Vec<(usize, Vec<Finding>)>,
    /// Frames by status, except `ok`.
    pub statuses: BTreeMap<&'static str, usize>,
    /// Frames by state and kinds of contact.
    pub states: BTreeMap<String, usize>,
    /// Frames whose step was slow, and the seconds that it took.
    pub long: Vec<(usize, f64)>,
    /// Largest work of a step.
    pub work: u32,
}

/// `edge VC`: state, vertices on sides (V), corners on sides of the body (C), vertices on half-planes (H).
pub fn kind(frame: &Frame) -> String {
    let letter = |touch: Touch| match touch {
        Touch::Surface { .. } => 'H',
        Touch::Side { .. } => 'V',
        Touch::Corner { .. } => 'C',
    };
    let letters: String = touches(frame).into_iter().map(letter).collect();
    format!("{} {letters}", frame.state.name())
}

/// A scene of a kind in an evolution.
type Look = fn((Kind, u64), Evolution, &AtomicU64) -> Report;

/// The solvers among obstacles are compiled with this crate, as those of [`crate::run::COMPILED`].
pub static COMPILED: [Look; 3] = [look::<f64>, look::<f32>, look::<stiction_core::Fixed>];

/// Runs a scene; `now` receives the index of the current frame.
pub fn look<R: Number>(
    (scenes, number): (Kind, u64),
    evolution: Evolution,
    now: &AtomicU64,
) -> Report {
    let world = scenes.scene::<R>(number);
    let laws = Laws::new::<R>(&world.among);
    let hands = world.hands();
    let mut report = Report::default();
    now.store(0, Ordering::Relaxed);
    let mut run = Run::<R>::start(&world.among, evolution, hands[0]);
    for (i, &hand) in hands.iter().enumerate() {
        let begun = Instant::now();
        if i > 0 {
            now.store(i as u64, Ordering::Relaxed);
            run.step(hand);
        }
        let took = begun.elapsed();
        if took > LONG {
            report.long.push((i, took.as_secs_f64()));
        }
        let frame = &run.frame;
        report.frames += 1;
        report.work = report.work.max(run.output.work);
        if frame.status != Status::Ok {
            *report.statuses.entry(frame.status.name()).or_default() += 1;
        }
        *report.states.entry(kind(frame)).or_default() += 1;
        let broken = laws.broken_in(world.room.as_deref(), frame);
        let has_left = broken.iter().any(|finding| finding.law == STAYS);
        if !broken.is_empty() {
            report.unlawful.push((i, broken));
        }
        if has_left {
            break;
        }
    }
    report
}

/// Examines scenes `from`, `from + step` .. below `count` and reports on standard output, one line per item: `begin
/// SCENE`, then the findings, then `end SCENE FRAMES WORK`.
pub fn part<R: Number>(scenes: Kind, (from, step, count): (u64, u64, u64), evolution: Evolution) {
    static NUMBER: AtomicU64 = AtomicU64::new(u64::MAX);
    static NOW: AtomicU64 = AtomicU64::new(0);
    std::panic::set_hook(Box::new(|_| {}));
    std::thread::spawn(|| watch(&NUMBER, &NOW));
    let mut number = from;
    while number < count {
        say(&format!("begin {number}\n"));
        NOW.store(0, Ordering::Relaxed);
        NUMBER.store(number, Ordering::Relaxed);
        let found = caught(|| look::<R>((scenes, number), evolution, &NOW));
        NUMBER.store(u64::MAX, Ordering::Relaxed);
        match found {
            Ok(report) => say(&lines(number, &report)),
            Err(words) => {
                let (frame, words) = (NOW.load(Ordering::Relaxed), words.replace('\n', " "));
                say(&format!(
                    "panic {number} {frame} {words}\nend {number} 0 0\n"
                ));
            }
        }
        number += step;
    }
}

/// Exits the process if a step does not end.
fn watch(number: &AtomicU64, now: &AtomicU64) {
    let place = || (number.load(Ordering::Relaxed), now.load(Ordering::Relaxed));
    let (mut last, mut since) = (place(), Instant::now());
    loop {
        std::thread::sleep(Duration::from_millis(100));
        if place() != last {
            (last, since) = (place(), Instant::now());
        } else if last.0 != u64::MAX && since.elapsed() > ENDLESS {
            say(&format!("endless {} {}\n", last.0, last.1));
            std::process::exit(NEVER_ENDS);
        }
    }
}

fn say(lines: &str) {
    let mut out = io::stdout().lock();
    // If the reader has closed the pipe, there is nobody to report to.
    let _ = out.write_all(lines.as_bytes());
    let _ = out.flush();
}

fn lines(number: u64, report: &Report) -> String {
    let mut text = String::new();
    for (frame, findings) in &report.unlawful {
        for f in findings {
            let (amount, residual, law) = (f.severity(), f.residual, f.law);
            let _ = writeln!(
                text,
                "unlawful {number} {frame} {amount:.2e} {residual:.2e} {law}"
            );
        }
    }
    for (status, count) in &report.statuses {
        let _ = writeln!(text, "status {number} {count} {status}");
    }
    for (state, count) in &report.states {
        let _ = writeln!(text, "state {number} {count} {state}");
    }
    for (frame, seconds) in &report.long {
        let _ = writeln!(text, "long {number} {frame} {seconds:.2}");
    }
    let _ = writeln!(text, "end {number} {} {}", report.frames, report.work);
    text
}
