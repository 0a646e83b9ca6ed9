//! A board that a program follows: a separate thread receives samples and requests and returns frames and the board's health.
//! Neither side waits for the other.

use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender, TryRecvError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use stiction_core::Evolution;
use stiction_live::outbound::{Fares, Runner};
use stiction_scene::{Sample, SceneFile};

use super::address::{Address, ConnectArgs};
use super::audience::Audience;
use super::counts::Counts;
use super::error::BoardError;
use super::feed::Feed;
use super::link::News;
use super::maker;
use super::message::About;
use super::request::Request;
use super::setup::Setup;
use super::stream::Stream;
use crate::recording::Maker;
use crate::stop;
use stiction_live::number::Number;
use stiction_live::record::Frame;

/// Interval of the health reports.
const EVERY: Duration = Duration::from_millis(250);

/// A message from the board to the program that follows it.
#[derive(Debug)]
pub(crate) enum Word {
    Frame(Box<Frame>),
    Fares(Fares),
    /// The result of the oldest request that has not been answered yet.
    Answer(Result<(), String>),
    /// The board is connected again, and is at the start of its scene.
    Back,
    /// The board will not come back.
    End(String),
}

#[derive(Clone, Debug)]
pub(crate) struct Identity {
    pub(crate) name: String,
    pub(crate) number: Number,
    pub(crate) place: String,
    pub(crate) emulated: bool,
    /// Ticks per second.
    pub(crate) tick_rate: u16,
    pub(crate) maker: Maker,
}

impl Identity {
    /// The description for clients.
    pub(crate) fn source(&self) -> Runner<'_> {
        Runner::Board {
            name: &self.name,
            number: self.number.name(),
            r#where: &self.place,
            emulated: self.emulated,
        }
    }
}

#[derive(Debug)]
pub(crate) struct LiveBoard {
    news: Sender<News>,
    /// Bounded by the requests: a word for every sample on its way and for every request, and the health four times per second.
    words: Receiver<Word>,
    pub(crate) identity: Identity,
    thread: Option<JoinHandle<()>>,
}

impl LiveBoard {
    /// Connects and sends the scene.
    ///
    /// # Errors
    /// Fails if the board is missing, does not answer, or refuses the scene.
    pub(crate) fn connect(
        args: &ConnectArgs,
        scene: &Arc<SceneFile>,
        evolution: Evolution,
    ) -> Result<Self, BoardError> {
        let (sender, words) = mpsc::channel();
        let follower = Follower::new(sender);
        let setup = setup(scene, evolution);
        let (mut stream, session) = Stream::connect(args, setup, Feed::newest(), follower)?;
        let identity = identify(&stream.about, &stream.address);
        let news = stream.inbox.sender.clone();
        let thread = thread::spawn(move || {
            if let Err(error) = stream.run(session)
                && !stop::asked()
            {
                stream.audience.say(Word::End(error.to_string()));
            }
        });
        Ok(Self {
            news,
            words,
            identity,
            thread: Some(thread),
        })
    }

    /// Sends a sample of the hand. The end of a board is reported by [`Word::End`].
    pub(crate) fn send(&self, sample: Sample) {
        let _ = self.news.send(News::Sample(sample));
    }

    /// Sends another scene or evolution; `anew`: with the body at its start, otherwise where it is. [`Word::Answer`] reports the
    /// result.
    pub(crate) fn request(&self, scene: &Arc<SceneFile>, evolution: Evolution, anew: bool) {
        let setup = setup(scene, evolution);
        let _ = self.news.send(News::Request(Request { setup, anew }));
    }

    /// Returns the next message of the board, if there is one.
    pub(crate) fn next(&self) -> Option<Word> {
        match self.words.try_recv() {
            Ok(word) => Some(word),
            Err(TryRecvError::Disconnected) if !stop::asked() => {
                Some(Word::End("the board's thread broke".to_owned()))
            }
            Err(_) => None,
        }
    }
}

impl Drop for LiveBoard {
    /// An emulated board ends with its stream.
    fn drop(&mut self) {
        let _ = self.news.send(News::Enough);
        if let Some(thread) = self.thread.take() {
            // An error was reported when it occurred.
            let _ = thread.join();
        }
    }
}

fn setup(scene: &Arc<SceneFile>, evolution: Evolution) -> Setup {
    Setup {
        scene: Arc::clone(scene),
        evolution,
        tick: None,
        keep: false,
        per_sample: false,
    }
}

fn identify(about: &About, address: &Address) -> Identity {
    Identity {
        name: about.name.clone(),
        number: about.number.into(),
        place: match address {
            Address::Emulated(emulator) => emulator.board().emulator().to_owned(),
            Address::Port(..) | Address::Usb(..) | Address::Socket(_) | Address::Tcp(_) => {
                address.to_string()
            }
        },
        emulated: matches!(address, Address::Emulated(_)),
        tick_rate: about.mode.tick_rate,
        maker: maker(about),
    }
}

#[derive(Debug)]
struct Follower {
    words: Sender<Word>,
    connected: bool,
    /// Beginning of the interval of these latencies.
    since: Instant,
    latencies: Vec<Duration>,
}

impl Follower {
    fn new(words: Sender<Word>) -> Self {
        Self {
            words,
            connected: true,
            since: Instant::now(),
            latencies: Vec::new(),
        }
    }

    fn say(&self, word: Word) {
        // If nobody listens any more, the program is ending.
        let _ = self.words.send(word);
    }

    /// Latencies since the last report.
    fn fares(&mut self, counts: &Counts) -> Fares {
        let seconds = self.since.elapsed().as_secs_f64();
        let count = self.latencies.len();
        let latency = (count > 0).then(|| {
            let (_, median, _) = self.latencies.select_nth_unstable(count / 2);
            median.as_secs_f64()
        });
        let health = counts.health();
        let garbled = health.map_or(0, |health| u64::from(health.faults.total()));
        self.latencies.clear();
        self.since = Instant::now();
        Fares {
            connected: self.connected,
            rate: count as f64 / seconds,
            latency,
            late: counts.late(),
            lost: counts.lost(),
            missed: health.map_or(0, |health| health.missed_ticks.into()),
            faults: counts.faults + garbled,
            worst_step: health.map(|health| f64::from(health.worst_step) * 1e-9),
        }
    }
}

impl Audience for Follower {
    fn frame(
        &mut self,
        _sample: &Sample,
        answer: Option<Frame>,
        latency: Duration,
    ) -> Result<(), BoardError> {
        if let Some(frame) = answer {
            self.latencies.push(latency);
            self.say(Word::Frame(Box::new(frame)));
        }
        Ok(())
    }

    fn lost(&mut self, _sample: &Sample) -> Result<(), BoardError> {
        Ok(())
    }

    fn counts(&mut self, counts: &Counts) {
        if self.since.elapsed() >= EVERY {
            let fares = self.fares(counts);
            self.say(Word::Fares(fares));
        }
    }

    fn note(&mut self, text: &str) {
        crate::report::tell(text);
    }

    fn gone(&mut self) {
        self.connected = false;
        self.latencies.clear();
        self.say(Word::Fares(Fares::NONE));
    }

    fn back(&mut self) {
        self.connected = true;
        self.since = Instant::now();
        self.say(Word::Back);
    }

    fn answer(&mut self, result: Result<(), BoardError>) -> Result<(), BoardError> {
        let answer = result.as_ref().map_err(ToString::to_string);
        self.say(Word::Answer(answer.copied()));
        match result {
            Err(error) if error.may_pass() => Err(error),
            _ => Ok(()),
        }
    }
}
