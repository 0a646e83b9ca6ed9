//! Changes of the body: it continues under another setting, or another run begins.

use crate::body::Setting;
use crate::guide::{Guide, HandPose};
use crate::live::Live;
use crate::pair::Pair;
use crate::replay::{Replay, Way};
use crate::stage::Stage;

/// A change of the body.
#[derive(Debug)]
pub enum Change {
    /// Another setting of the same scene: the body stays where it is and settles.
    Setting(Setting),
    /// Another run.
    Run(Box<NewRun>),
}

/// A run from the start of a scene.
#[derive(Debug)]
pub struct NewRun {
    /// The scene.
    pub stage: Stage,
    /// The setting of the body.
    pub setting: Setting,
    /// The path that the hand follows, and its name.
    pub path: Option<(String, Way)>,
    /// Whether to add the scene to those that can be shown.
    pub is_new: bool,
}

/// A run that is ready to begin.
pub struct Ready {
    stage: Stage,
    /// The body and the reference, at their start.
    pub pair: Pair,
    replay: Option<Replay>,
    is_new: bool,
}

impl Change {
    /// Returns a run with a live hand.
    pub fn run(stage: Stage, setting: Setting) -> Self {
        Self::Run(Box::new(NewRun {
            stage,
            setting,
            path: None,
            is_new: false,
        }))
    }

    /// Returns the setting after the change.
    pub const fn setting(&self) -> &Setting {
        match self {
            Self::Setting(setting) => setting,
            Self::Run(run) => &run.setting,
        }
    }

    /// Returns whether another run begins.
    pub const fn is_run(&self) -> bool {
        matches!(self, Self::Run(_))
    }
}

impl NewRun {
    /// Prepares the run, with the body at its start.
    ///
    /// # Errors
    /// The scene cannot be used.
    pub fn ready(self) -> Result<Ready, String> {
        let (pair, replay) = match self.path {
            Some((name, way)) => {
                let (replay, pair) = Replay::begin(name, way, &self.setting)?;
                (pair, Some(replay))
            }
            None => (Pair::start(&self.setting, 0.0, &self.stage.home)?, None),
        };
        Ok(Ready {
            stage: self.stage,
            pair,
            replay,
            is_new: self.is_new,
        })
    }
}

impl Live {
    /// Changes the body.
    ///
    /// # Errors
    /// The scene cannot be used, or the body cannot settle in it.
    pub fn apply(&mut self, change: Change) -> Result<(), String> {
        match change {
            Change::Setting(setting) => self.go_on(&setting),
            Change::Run(run) => {
                self.begin(run.ready()?);
                Ok(())
            }
        }
    }

    /// Continues with the body under another setting.
    ///
    /// # Errors
    /// It cannot settle there. A refused change has no effect.
    pub fn go_on(&mut self, setting: &Setting) -> Result<(), String> {
        self.pair.change(setting)?;
        self.pending.record(&self.pair.frame);
        self.has_changed();
        Ok(())
    }

    /// Notes that the body has another setting.
    pub fn has_changed(&mut self) {
        if let Some(replay) = &mut self.replay {
            replay.forget();
        }
        self.changed = true;
    }

    /// Begins another run.
    pub fn begin(&mut self, ready: Ready) {
        let home = HandPose::of(&ready.stage.home);
        if ready.is_new {
            self.keep(ready.stage.clone());
        }
        (self.stage, self.pair, self.replay) = (ready.stage, ready.pair, ready.replay);
        self.guide = Guide::at(home);
        self.begin_run(home);
    }
}
