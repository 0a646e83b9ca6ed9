//! The tracker of the paper as a source of samples (FRAME 9): a thread requests record after record, and maps each to the plane
//! of the scene.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::mpsc::Sender;
use std::thread;
use std::time::{Duration, Instant};

use clap::{Args, ValueEnum};
use stiction_core::TrackerSample;
use stiction_scene::{LivePlacement, Placement, Sample};
use stiction_wire::{LOGITECH_REQUEST, LogitechDecoder, LogitechRecord};

use super::error::BoardError;
use super::link::{Link, News, reason};

const BAUD: u32 = 19_200;
/// A record that was requested and did not arrive is requested again: at 19200 baud it takes 9 ms.
const AGAIN: Duration = Duration::from_millis(100);

/// Where a tracker is, and what holds.
#[derive(Args, Clone, Debug)]
pub struct TrackerArgs {
    /// Samples from a Logitech 3-D tracker on this serial port (or unix socket) instead of a path; Ctrl-C ends it
    #[arg(long, value_name = "/dev/tty...", conflicts_with_all = ["hand", "rate"])]
    tracker: Option<PathBuf>,
    /// The tracker's button that holds the object
    #[arg(long, value_enum, default_value_t = HoldButton::Left, requires = "tracker")]
    hold: HoldButton,
}

/// A button of the tracker.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum HoldButton {
    /// The left one.
    Left,
    /// The middle one.
    Middle,
    /// The right one.
    Right,
    /// None: the object is always held.
    Always,
}

impl HoldButton {
    fn held(self, record: &LogitechRecord) -> bool {
        let bits = match self {
            Self::Right => 1,
            Self::Middle => 2,
            Self::Left => 4,
            Self::Always => return true,
        };
        record.buttons & bits != 0
    }
}

impl TrackerArgs {
    pub(super) const fn is_wanted(&self) -> bool {
        self.tracker.is_some()
    }

    /// Begins to read the tracker, if one is requested; it may be silent for `timeout`.
    pub(super) fn start(
        &self,
        placement: &Placement,
        timeout: Duration,
        news: Sender<News>,
    ) -> Result<(), BoardError> {
        let Some(place) = self.tracker.clone() else {
            return Ok(());
        };
        let link = Link::port_or_socket(&place, BAUD);
        let link = link.map_err(|error| no_tracker(&place, &reason(&error)))?;
        let Some(placement) = placement.live() else {
            return Err(no_tracker(
                &place,
                "the plane's axes are not two different ones",
            ));
        };
        let mut reader = Reader {
            link,
            decoder: LogitechDecoder::new(),
            timeout,
        };
        let mut placed = Placed {
            placement,
            hold: self.hold,
            begun: None,
        };
        thread::spawn(move || {
            loop {
                let last = match reader.record() {
                    Ok(record) => News::Sample(placed.sample(&record, Instant::now())),
                    Err(error) => News::NoTracker(no_tracker(&place, &reason(&error))),
                };
                let ended = matches!(last, News::NoTracker(_));
                // Nobody listens any more when the stream is over.
                if news.send(last).is_err() || ended {
                    return;
                }
            }
        });
        Ok(())
    }
}

fn no_tracker(place: &Path, problem: &str) -> BoardError {
    BoardError::Tracker {
        place: place.to_owned(),
        problem: problem.to_owned(),
    }
}

struct Reader {
    link: Link,
    decoder: LogitechDecoder,
    timeout: Duration,
}

impl Reader {
    fn record(&mut self) -> io::Result<LogitechRecord> {
        let begun = Instant::now();
        while begun.elapsed() < self.timeout {
            self.link.write_all(&LOGITECH_REQUEST)?;
            if let Some(record) = self.answer()? {
                return Ok(record);
            }
        }
        Err(io::Error::other(format!(
            "no record within {} s, allowed: a Logitech 3-D mouse or head tracker",
            self.timeout.as_secs_f64()
        )))
    }

    fn answer(&mut self) -> io::Result<Option<LogitechRecord>> {
        let asked = Instant::now();
        let mut bytes = [0; 64];
        while asked.elapsed() < AGAIN {
            let count = self.link.read(&mut bytes)?;
            let records = bytes[..count].iter();
            // If several arrived together, the last one is the newest.
            if let Some(record) = records.filter_map(|&byte| self.decoder.push(byte)).last() {
                return Ok(Some(record));
            }
        }
        Ok(None)
    }
}

struct Placed {
    placement: LivePlacement,
    hold: HoldButton,
    begun: Option<Instant>,
}

impl Placed {
    fn sample(&mut self, record: &LogitechRecord, now: Instant) -> Sample {
        let begun = *self.begun.get_or_insert(now);
        let sample = record.sample(0).map(|sample| TrackerSample {
            position: sample.position.map(f64::from),
            orientation: sample.orientation.map(f64::from),
            held: self.hold.held(record),
        });
        Sample {
            t: now.duration_since(begun).as_secs_f64(),
            hand: self.placement.hand(sample.as_ref()),
        }
    }
}
