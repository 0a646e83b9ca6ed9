//! What becomes of the body where it is told to: it goes on under another setting, or another run begins. A board is asked
//! first, and what it answers decides.

use tokio::sync::mpsc::Sender;

use super::body::Setting;
use super::engine::Engine;
use super::guide::{Guide, HandPose};
use super::pair::Pair;
use super::recording::Recording;
use super::replay::{Replay, Way};
use super::say;
use super::stage::Stage;

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
    /// A recording, which begins with the run.
    pub(super) recording: Option<Recording>,
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
        let result = match self.board {
            // It has changed already, and its next answer shows what became of the body.
            Some(_) => self.pair.changed(setting),
            None => {
                self.pair.change(setting)?;
                self.pending.record(&self.pair.frame);
                Ok(())
            }
        };
        self.end_recording();
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
        self.end_recording();
        self.guide = Guide::at(HandPose::of(&stage.home));
        (self.stage, self.pair, self.replay) = (stage, pair, replay);
        self.recording = recording;
        self.begin_run();
        Ok(())
    }
}
