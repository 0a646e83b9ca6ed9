//! What becomes of the body where it is told to: it goes on under another setting, or another run begins. A board is asked
//! first, and what it answers decides.

use tokio::sync::mpsc::Sender;

use super::engine::Engine;
use super::guide::{Guide, HandPose};
use super::pair::Pair;
use super::recording::Recording;
use super::replay::{Replay, Way};
use super::say;
use super::stage::{Stage, reread};
use crate::body::Setting;
use crate::recording::Maker;

/// A change of the body.
#[derive(Debug)]
pub(super) enum Change {
    /// Another setting of the same scene: the body stays where it is and settles.
    Setting(Setting),
    /// Another run.
    Run(Box<Run>),
}

/// A run from the start of a scene.
#[derive(Debug)]
pub(super) struct Run {
    pub(super) stage: Stage,
    pub(super) setting: Setting,
    /// A path that the hand follows, and its name.
    pub(super) path: Option<(String, Way)>,
    /// A recording, which begins with the run, and where the live hand is that goes on.
    pub(super) recording: Option<(Recording, HandPose)>,
}

impl Change {
    /// A run with a live hand.
    pub(super) fn run(stage: Stage, setting: Setting) -> Self {
        Self::Run(Box::new(Run {
            stage,
            setting,
            path: None,
            recording: None,
        }))
    }

    /// What the body is under from then on.
    pub(super) const fn setting(&self) -> &Setting {
        match self {
            Self::Setting(setting) => setting,
            Self::Run(run) => &run.setting,
        }
    }

    /// Another run begins.
    pub(super) const fn is_run(&self) -> bool {
        matches!(self, Self::Run(_))
    }
}

/// Whoever waits for an answer.
#[derive(Debug)]
pub(super) struct Reply {
    pub(super) id: Option<i64>,
    pub(super) answers: Sender<String>,
}

impl Reply {
    /// Tells it.
    pub(super) fn send(&self, result: Result<(), String>) {
        let answer = match (result, self.id) {
            (Ok(()), None) => return,
            (Ok(()), Some(id)) => say::done(id),
            (Err(problem), id) => say::error(id, &problem),
        };
        // A client that does not read loses answers.
        let _ = self.answers.try_send(answer);
    }
}

impl Engine {
    /// Changes the body, or asks the board to.
    pub(super) fn change(&mut self, change: Change, reply: Reply) {
        match &mut self.board {
            Some(board) => board.ask(change, reply),
            None => {
                let result = self.apply(change);
                self.answers.push((reply, result));
            }
        }
    }

    /// # Errors
    /// The scene cannot be used, or the body cannot settle in it.
    pub(super) fn apply(&mut self, change: Change) -> Result<(), String> {
        match change {
            Change::Setting(setting) => self.go_on(&setting),
            Change::Run(run) => self.begin(*run),
        }
    }

    fn go_on(&mut self, setting: &Setting) -> Result<(), String> {
        let recorded;
        let setting = match &self.recording {
            // From now on the scene is the one that a reader of the file gets.
            Some(_) => {
                recorded = reread(setting)?;
                &recorded
            }
            None => setting,
        };
        let result = match self.board {
            // It has changed already, and its next answer shows what became of the body.
            Some(_) => self.pair.changed(setting),
            None => {
                self.pair.change(setting)?;
                self.pending.record(&self.pair.frame);
                Ok(())
            }
        };
        if let Some(recording) = &mut self.recording {
            recording.change(setting);
        }
        if let Some(replay) = &mut self.replay {
            replay.forget();
        }
        self.changed = true;
        result
    }

    fn begin(&mut self, run: Run) -> Result<(), String> {
        let Run {
            stage,
            setting,
            path,
            recording,
        } = run;
        let (pair, replay) = match path {
            Some((name, way)) => {
                let (replay, pair) = Replay::begin(name, way, &setting)?;
                (pair, Some(replay))
            }
            None => (Pair::start(&setting, 0.0, &stage.home)?, None),
        };
        let home = HandPose::of(&stage.home);
        let (recording, guide) = match recording {
            Some((mut recording, now)) => {
                recording.open(&self.shelf, &self.maker())?;
                recording.add(home, &pair.frame);
                self.tell(format!("recording to {}\n", recording.place().display()));
                let mut guide = match self.replay {
                    Some(_) => Guide::at(now),
                    None => self.guide.clone(),
                };
                guide.leave_for(home);
                (Some(recording), guide)
            }
            None => (None, Guide::at(home)),
        };
        self.end_recording();
        if recording.is_none() {
            self.stage = stage;
        }
        (self.pair, self.replay, self.guide) = (pair, replay, guide);
        self.recording = recording;
        self.begin_run(home);
        if self.recording.is_some() {
            self.wait_for_hold();
        }
        Ok(())
    }

    /// Who makes recordings.
    fn maker(&self) -> Maker {
        let board = self
            .board
            .as_ref()
            .map(|board| board.identity().maker.clone());
        board.unwrap_or_else(Maker::this_program)
    }
}
