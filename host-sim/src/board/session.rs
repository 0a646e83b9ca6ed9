//! A session with a board: hello, and commands that are repeated until they are answered (FRAME 7).

use std::collections::VecDeque;
use std::sync::mpsc::{self, Receiver, Sender};
use std::time::{Duration, Instant};

use stiction_wire::{Command, FaultKind, Health, KnobInfo, Reason};

use super::address::Address;
use super::error::BoardError;
use super::line::Line;
use super::link::{News, Open};
use super::message::{About, Answer, Received, Said};
use super::refusal::explain;
use crate::stop;
use stiction_live::record::Names;

/// A command without an answer is repeated after this time.
const AGAIN: Duration = Duration::from_millis(100);
/// Maximum number of samples that wait while a command does: half a minute of the tracker, 4 s of the fastest hand.
const MOST_ASIDE: usize = 4096;
/// Maximum number of frames that are stored while a command waits for its answer: more than a board sends in the 0.1 s until its
/// second try, at 5000 steps per second of three frames each.
const MOST_RECEIVED: usize = 4096;

/// The messages from the threads of links and tracker to this one.
#[derive(Debug)]
pub(super) struct Inbox {
    pub(super) sender: Sender<News>,
    receiver: Receiver<News>,
    /// Messages that were set aside.
    aside: VecDeque<News>,
    /// Samples for which there was no room.
    pub(super) dropped: u64,
    links: u32,
}

impl Inbox {
    pub(super) fn new() -> Self {
        let (sender, receiver) = mpsc::channel();
        Self {
            sender,
            receiver,
            aside: VecDeque::new(),
            dropped: 0,
            links: 0,
        }
    }

    /// Returns the next message, those set aside first; nothing if none arrives until then.
    pub(super) fn next(&mut self, until: Instant) -> Option<News> {
        self.aside.pop_front().or_else(|| self.receive(until))
    }

    /// Sets messages aside, for [`Self::next`]. A sample for which there is no room is dropped; the senders bound the number of
    /// other messages.
    pub(super) fn keep(&mut self, news: impl IntoIterator<Item = News>) {
        for news in news {
            match news {
                News::Sample(_) if self.aside.len() >= MOST_ASIDE => self.dropped += 1,
                news => self.aside.push_back(news),
            }
        }
    }

    fn receive(&self, until: Instant) -> Option<News> {
        let left = until.saturating_duration_since(Instant::now());
        self.receiver.recv_timeout(left).ok()
    }
}

/// A line with a board at its other end.
#[derive(Debug)]
pub(super) struct Session {
    pub(super) line: Line,
    pub(super) health: Option<Health>,
    /// The sample of the last pose.
    pub(super) last_sample: Option<u8>,
    /// What arrived while a command waited for its answer.
    pub(super) before_answer: VecDeque<Received>,
    /// What arrived with the answer, after it.
    pub(super) after_answer: VecDeque<Received>,
    pub(super) address: String,
    /// The time that the board may be silent.
    pub(super) timeout: Duration,
}

impl Session {
    /// Opens the line and sends hello. `begun`: zero of the client's clock.
    pub(super) fn begin(
        address: &mut Address,
        inbox: &mut Inbox,
        timeout: Duration,
        begun: Instant,
    ) -> Result<(Self, About), BoardError> {
        let name = address.to_string();
        let gone = |problem| BoardError::Gone {
            address: name.clone(),
            problem,
        };
        inbox.links += 1;
        let link = address.open()?;
        let open = Open::new(link, inbox.links, inbox.sender.clone())
            .map_err(|error| gone(error.to_string()))?;
        let mut line = Line::new(open, begun);
        line.wake().map_err(gone)?;
        let mut session = Self {
            line,
            health: None,
            last_sample: None,
            before_answer: VecDeque::new(),
            after_answer: VecDeque::new(),
            address: name,
            timeout,
        };
        let about = session.greet(inbox)?;
        Ok((session, about))
    }

    /// Sends hello; returns the board's description of itself.
    pub(super) fn greet(&mut self, inbox: &mut Inbox) -> Result<About, BoardError> {
        self.ask(inbox, Command::Hello, |said, _| match said {
            Said::About(about) => Some(about.clone()),
            _ => None,
        })
    }

    /// Sends a command that is answered by a reply. Returns the reply if it is a refusal.
    pub(super) fn order(
        &mut self,
        inbox: &mut Inbox,
        command: Command<'_>,
    ) -> Result<Option<Answer>, BoardError> {
        let answer = self.ask(inbox, command, |said, sent| match said {
            Said::Answer(answer) if sent.contains(&answer.command.sequence) => Some(answer.clone()),
            _ => None,
        })?;
        Ok((answer.reason != Reason::Done).then_some(answer))
    }

    /// As [`Self::order`]; a refusal is an error.
    pub(super) fn demand(
        &mut self,
        inbox: &mut Inbox,
        command: Command<'_>,
        names: &Names,
    ) -> Result<(), BoardError> {
        match self.order(inbox, command)? {
            None => Ok(()),
            Some(refusal) => Err(BoardError::Refused(explain(
                command.name(),
                &refusal,
                names,
            ))),
        }
    }

    /// Asks for the numbers of the board's knob.
    pub(super) fn knob(&mut self, inbox: &mut Inbox) -> Result<KnobInfo, BoardError> {
        let command = Command::AskKnob;
        let answer = self.ask(inbox, command, |said, sent| match said {
            Said::Knob(info) => Some(Ok(*info)),
            Said::Answer(answer) if sent.contains(&answer.command.sequence) => {
                Some(Err(answer.clone()))
            }
            _ => None,
        })?;
        let refused = |refusal| explain(command.name(), &refusal, &Names::default());
        answer.map_err(|refusal| BoardError::Refused(refused(refusal)))
    }

    /// Sends a command until `pick` finds the answer to it; `pick` receives the numbers under which the command was sent.
    fn ask<T>(
        &mut self,
        inbox: &mut Inbox,
        command: Command<'_>,
        mut pick: impl FnMut(&Said, &[u8]) -> Option<T>,
    ) -> Result<T, BoardError> {
        let end = Instant::now() + self.timeout;
        let mut sent = Vec::new();
        self.before_answer.append(&mut self.after_answer);
        while Instant::now() < end {
            sent.push(self.send(command)?);
            let again = end.min(Instant::now() + AGAIN);
            while let Some(news) = inbox.receive(again) {
                let mut answer = None;
                for received in self.read(inbox, news)? {
                    self.note(&received.said);
                    if answer.is_some() {
                        self.after_answer.push_back(received);
                    } else {
                        answer = pick(&received.said, &sent);
                        self.before_answer.push_back(received);
                    }
                    let beyond = self.before_answer.len().saturating_sub(MOST_RECEIVED);
                    self.before_answer.drain(..beyond);
                }
                if let Some(answer) = answer {
                    return Ok(answer);
                }
                if self.line.faults().of(FaultKind::Version) > 0 {
                    return Err(BoardError::Version(self.address.clone()));
                }
                if Instant::now() >= again {
                    break;
                }
            }
            if stop::asked() {
                return Err(BoardError::Stopped);
            }
        }
        Err(self.silent(&format!("answer to {}", command.name())))
    }

    /// Waits for the next health report, at most `patience`.
    pub(super) fn wait_for_health(
        &mut self,
        inbox: &mut Inbox,
        patience: Duration,
    ) -> Result<Option<Health>, BoardError> {
        self.health = None;
        let until = Instant::now() + patience;
        // Other messages of the board do not extend the wait.
        while self.health.is_none()
            && Instant::now() < until
            && !stop::asked()
            && let Some(news) = inbox.receive(until)
        {
            for received in self.read(inbox, news)? {
                self.note(&received.said);
            }
        }
        Ok(self.health)
    }

    /// Decodes the frames of this line; other messages are set aside.
    pub(super) fn read(
        &mut self,
        inbox: &mut Inbox,
        news: News,
    ) -> Result<Vec<Received>, BoardError> {
        match news {
            News::Bytes(link, reading) if link == self.line.link() => {
                Ok(self.line.receive(reading.at, &reading.bytes))
            }
            News::Gone(link, problem) if link == self.line.link() => Err(self.gone(problem)),
            // From a previous line.
            News::Bytes(..) | News::Gone(..) => Ok(Vec::new()),
            News::Sample(_) | News::NoTracker(_) | News::Request(_) | News::Enough => {
                inbox.keep([news]);
                Ok(Vec::new())
            }
        }
    }

    /// Stores values that are needed later.
    pub(super) fn note(&mut self, said: &Said) {
        match said {
            Said::Health(health) => self.health = Some(*health),
            Said::Pose(pose) => self.last_sample = Some(pose.sample),
            Said::Forces(_)
            | Said::Events(_)
            | Said::Answer(_)
            | Said::About(_)
            | Said::Pong
            | Said::Knob(_) => {}
        }
    }

    pub(super) fn send(&mut self, command: Command<'_>) -> Result<u8, BoardError> {
        let sent = self.line.send(command);
        sent.map_err(|problem| self.gone(problem))
    }

    fn gone(&self, problem: String) -> BoardError {
        BoardError::Gone {
            address: self.address.clone(),
            problem,
        }
    }

    /// The error if the expected message did not arrive.
    pub(super) fn silent(&self, what: &str) -> BoardError {
        BoardError::Silent {
            address: self.address.clone(),
            what: what.to_owned(),
            seconds: self.timeout.as_secs_f64(),
            came: self.line.what_came(),
        }
    }
}
