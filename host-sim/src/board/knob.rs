//! `stiction knob`: the numbers of a board's knob, from the board as TOML, and from a TOML file to the board, which stores them and restarts.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use clap::Args;
use serde::Deserialize;
use stiction_firmware::knob::{KnobError, check};
use stiction_scene::{InputError, Source};
use stiction_wire::{Command, KnobInfo, KnobNumber, KnobNumbers, KnobSource, Subject};
use toml::Spanned;

use super::address::{Address, ConnectArgs, PLACE};
use super::emulate::Image;
use super::error::BoardError;
use super::message::Answer;
use super::refusal::{explain, unit};
use super::session::{Inbox, Session};
use crate::{report, stop};
use stiction_live::record::Names;

/// A board restarts within this time: its reply leaves in 50 ms, two sectors of flash take up to 0.8 s.
const RESTART: Duration = Duration::from_secs(2);
/// Interval at which it is asked meanwhile. The first time it has begun to restart.
const AGAIN: Duration = Duration::from_millis(200);

/// The arguments of `stiction knob`.
#[derive(Args, Clone, Debug)]
#[command(mut_group(PLACE, |group| group.required(true)))]
pub struct KnobArgs {
    /// File of the numbers that the board is to store (TOML); without it, those that the board has are printed as such a file
    numbers: Option<PathBuf>,
    /// Where the board is.
    #[command(flatten)]
    connect: ConnectArgs,
}

/// The file. Its keys are the names in FRAME 4.9.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct KnobDocument {
    origin: Spanned<[f64; 2]>,
    radius: Spanned<f64>,
    counts_per_turn: Spanned<u32>,
    encoder_reversed: bool,
    torque_constant: Spanned<f64>,
    full_current: Spanned<f64>,
    torque_limit: Spanned<f64>,
    motor_reversed: bool,
    damping: Spanned<f64>,
}

impl KnobDocument {
    fn numbers(&self) -> KnobNumbers {
        let single = |value: &Spanned<f64>| *value.get_ref() as f32;
        KnobNumbers {
            origin: self.origin.get_ref().map(|value| value as f32),
            radius: single(&self.radius),
            counts_per_turn: *self.counts_per_turn.get_ref(),
            encoder_reversed: self.encoder_reversed,
            torque_constant: single(&self.torque_constant),
            full_current: single(&self.full_current),
            torque_limit: single(&self.torque_limit),
            motor_reversed: self.motor_reversed,
            damping: single(&self.damping),
        }
    }

    /// Where a number is in the file.
    fn place(&self, number: KnobNumber) -> Range<usize> {
        match number {
            KnobNumber::Origin => self.origin.span(),
            KnobNumber::Radius => self.radius.span(),
            KnobNumber::CountsPerTurn => self.counts_per_turn.span(),
            KnobNumber::TorqueConstant => self.torque_constant.span(),
            KnobNumber::FullCurrent => self.full_current.span(),
            KnobNumber::TorqueLimit => self.torque_limit.span(),
            KnobNumber::Damping => self.damping.span(),
        }
    }
}

/// A file whose numbers a board with a suitable scene can use.
struct NumbersFile {
    source: Source,
    document: KnobDocument,
    numbers: KnobNumbers,
}

impl NumbersFile {
    fn read(file: &Path) -> Result<Self, InputError> {
        let source = Source::read(file)?;
        let document: KnobDocument = source.toml()?;
        let numbers = document.numbers();
        let read = Self {
            source,
            document,
            numbers,
        };
        match check(&numbers) {
            Ok(()) => Ok(read),
            Err(error) => Err(read.refused(&error)),
        }
    }

    fn refused(&self, error: &KnobError) -> InputError {
        self.problem(error.number, error.value, error.limit, error.allowed)
    }

    fn problem(&self, number: KnobNumber, value: f32, limit: f32, allowed: &str) -> InputError {
        let (key, unit) = (key(number), unit(Subject::Knob(number)));
        let mut problem = format!("`{key}` is {value:?}{unit}, allowed: {allowed}");
        if !limit.is_nan() {
            problem.push_str(&format!(", the limit: {limit:?}{unit}"));
        }
        let at = self.document.place(number).start;
        self.source.error_at(at, problem)
    }

    /// The board's refusal, at the number that it is about.
    fn explain(&self, refusal: &Answer) -> BoardError {
        match refusal.subject {
            Subject::Knob(number) => self
                .problem(number, refusal.value, refusal.limit, &refusal.allowed)
                .into(),
            Subject::Command | Subject::Scene(_) | Subject::TickRate | Subject::LineRate => {
                BoardError::Refused(explain("knob", refusal, &Names::default()))
            }
        }
    }
}

/// The key of a number in the file.
fn key(number: KnobNumber) -> String {
    number.name().replace('-', "_")
}

/// Prints the numbers of a board's knob; sends it other ones first, if there are any.
///
/// # Errors
/// The file cannot be used; the board is missing, refuses the numbers, or does not come back with them.
pub fn knob(args: &KnobArgs) -> Result<(), BoardError> {
    let file = args.numbers.as_deref().map(NumbersFile::read).transpose()?;
    stop::listen();
    if let Some(board) = args.connect.emulated().filter(|board| !board.has_knob()) {
        let problem = format!(
            "{} has no pins for a knob, allowed: --emulate pico",
            board.name()
        );
        return Err(BoardError::Refused(problem));
    }
    let (mut address, mut inbox) = (args.connect.address(Image::Knob)?, Inbox::new());
    let timeout = args.connect.timeout();
    let (mut session, about) = Session::begin(&mut address, &mut inbox, timeout, Instant::now())?;
    let info = match file {
        None => session.knob(&mut inbox)?,
        Some(file) => {
            let refusal = session.order(&mut inbox, Command::Knob(file.numbers))?;
            if let Some(refusal) = refusal {
                return Err(file.explain(&refusal));
            }
            drop(session);
            restarted(&mut address, &mut inbox, timeout, &file.numbers)?
        }
    };
    report::print(&text(&about.name, &info));
    Ok(())
}

/// Waits until the board is back with these numbers.
fn restarted(
    address: &mut Address,
    inbox: &mut Inbox,
    timeout: Duration,
    numbers: &KnobNumbers,
) -> Result<KnobInfo, BoardError> {
    let until = Instant::now() + RESTART + timeout;
    loop {
        thread::sleep(AGAIN);
        let begun = Session::begin(address, inbox, timeout, Instant::now());
        let came = begun.and_then(|(mut session, _)| session.knob(inbox));
        let is_over = Instant::now() >= until;
        match came {
            Ok(info) if info.source == KnobSource::Stored && info.numbers == *numbers => {
                return Ok(info);
            }
            Ok(info) if is_over => {
                let what = meaning(info.source);
                let problem = format!("the board took the numbers, but has others: {what}");
                return Err(BoardError::Refused(problem));
            }
            Err(error) if is_over || !error.may_pass() => return Err(error),
            Ok(_) | Err(_) => {}
        }
        if stop::asked() {
            return Err(BoardError::Stopped);
        }
    }
}

const fn meaning(source: KnobSource) -> &'static str {
    match source {
        KnobSource::CompiledIn => "compiled in, none are stored",
        KnobSource::Stored => "stored on the board",
        KnobSource::Unusable => {
            "compiled in; those that are stored are damaged, or not passive with the compiled-in scene: the motor is off until others are stored"
        }
    }
}

/// The numbers as a file.
fn text(board: &str, info: &KnobInfo) -> String {
    let KnobNumbers {
        origin: [x, y],
        radius,
        counts_per_turn,
        encoder_reversed,
        torque_constant,
        full_current,
        torque_limit,
        motor_reversed,
        damping,
    } = info.numbers;
    let rows = [
        (
            "origin",
            format!("[{x:?}, {y:?}]"),
            "m: the hand at power-up",
        ),
        ("radius", format!("{radius:?}"), "m"),
        (
            "counts_per_turn",
            counts_per_turn.to_string(),
            "of the encoder: four per line of its disc",
        ),
        (
            "encoder_reversed",
            encoder_reversed.to_string(),
            "true: it counts up when the knob turns clockwise",
        ),
        (
            "torque_constant",
            format!("{torque_constant:?}"),
            "N·m/A, of the motor at the knob",
        ),
        (
            "full_current",
            format!("{full_current:?}"),
            "A at full duty",
        ),
        ("torque_limit", format!("{torque_limit:?}"), "N·m"),
        (
            "motor_reversed",
            motor_reversed.to_string(),
            "true: a high level at the direction pin turns the knob clockwise",
        ),
        (
            "damping",
            format!("{damping:?}"),
            "N·m·s/rad, about the knob's axis",
        ),
    ];
    let rows = rows.map(|(key, value, what)| {
        let entry = format!("{key} = {value}");
        format!("{entry:<30} # {what}\n")
    });
    let source = meaning(info.source);
    format!("# The knob of {board}: {source}.\n{}", rows.concat())
}
