//! Changes of the body on request: it continues under another setting, or another run begins, perhaps with a recording. A board
//! is asked first, and its answer decides.

use stiction_live::change::{Change, NewRun};
use stiction_live::guide::{Guide, HandPose};
use stiction_live::outbound;
use tokio::sync::mpsc::Sender;

use super::engine::Engine;
use super::recording::LiveRecording;
use crate::recording::Maker;
use stiction_live::body::Setting;
use stiction_live::stage::reread;

#[derive(Debug)]
pub(super) struct Wanted {
    pub(super) change: Change,
    /// A recording, which begins with the run, and the pose of the live hand that continues.
    pub(super) recording: Option<Box<(LiveRecording, HandPose)>>,
}

impl From<Change> for Wanted {
    fn from(change: Change) -> Self {
        Self {
            change,
            recording: None,
        }
    }
}

#[derive(Debug)]
pub(super) enum Reply {
    /// A client of the socket.
    Client {
        id: Option<i64>,
        answers: Sender<String>,
    },
    /// A part of this program.
    Direct(Sender<Result<(), String>>),
}

impl Reply {
    pub(super) fn send(&self, result: Result<(), String>) {
        match self {
            Self::Client { id, answers } => {
                if let Some(answer) = outbound::answer(*id, result) {
                    // A client that does not read loses answers.
                    let _ = answers.try_send(answer);
                }
            }
            // A recipient that has gone meanwhile needs no answer.
            Self::Direct(answers) => {
                let _ = answers.try_send(result);
            }
        }
    }
}

impl Engine {
    /// Changes the body, or requests the change from the board.
    pub(super) fn change(&mut self, wanted: Wanted, reply: Reply) {
        match &mut self.board {
            Some(board) => board.ask(wanted, reply),
            None => {
                let result = self.apply(wanted);
                self.answers.push((reply, result));
            }
        }
    }

    pub(super) fn apply(&mut self, wanted: Wanted) -> Result<(), String> {
        match wanted.change {
            Change::Setting(setting) => self.go_on(&setting),
            Change::Run(run) => self.begin(*run, wanted.recording),
        }
    }

    fn go_on(&mut self, setting: &Setting) -> Result<(), String> {
        let recorded;
        let setting = match &self.recording {
            // From now on, the scene is the one that a reader of the file obtains.
            Some(_) => {
                recorded = reread(setting)?;
                &recorded
            }
            None => setting,
        };
        let result = match self.board {
            // The board has changed already, and its next answer shows the new state of the body.
            Some(_) => {
                let result = self.live.pair.changed(setting);
                self.live.has_changed();
                result
            }
            None => {
                self.live.go_on(setting)?;
                Ok(())
            }
        };
        if let Some(recording) = &mut self.recording {
            recording.change(setting);
        }
        result
    }

    fn begin(
        &mut self,
        run: NewRun,
        recording: Option<Box<(LiveRecording, HandPose)>>,
    ) -> Result<(), String> {
        let home = HandPose::of(&run.stage.home);
        let ready = run.ready()?;
        let begun = match recording {
            Some(begins) => {
                let (mut recording, now) = *begins;
                recording.open(&self.surroundings.archive, &self.maker())?;
                recording.add(home, &ready.pair.frame);
                self.tell(format!("recording to {}\n", recording.place().display()));
                let mut guide = match self.live.replay {
                    Some(_) => Guide::at(now),
                    None => self.live.guide.clone(),
                };
                guide.leave_for(home);
                Some((recording, guide, self.live.stage.clone()))
            }
            None => None,
        };
        self.end_recording();
        self.begin_run(ready);
        if let Some((recording, guide, stage)) = begun {
            // A reset returns to the beginning of the scene, not of the recording.
            (self.live.guide, self.live.stage) = (guide, stage);
            self.recording = Some(recording);
            self.wait_for_hold();
        }
        Ok(())
    }

    fn maker(&self) -> Maker {
        let board = self
            .board
            .as_ref()
            .map(|board| board.identity().maker.clone());
        board.unwrap_or_else(Maker::this_program)
    }
}
