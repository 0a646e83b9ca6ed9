//! Executes the orders to the solver: a change of the setting, another run, or an order that concerns only the hand and the time.
//! A refused order changes nothing.

use std::sync::Arc;
use std::time::Instant;

use stiction_live::change::{Change, NewRun};
use stiction_live::guide::HandPose;
use stiction_live::holder::Source;
use stiction_live::inbound::{Message, Path};
use stiction_live::orders::missing;
use stiction_live::replay::Way;
use stiction_live::stage::{Stage, reread};
use stiction_scene::HandPath;
use tokio::sync::mpsc::Sender;

use super::change::{Reply, Wanted};
use super::engine::Engine;
use super::recording::LiveRecording;
use super::resume::resumed;
use stiction_live::body::{Setting, without_obstacles};

#[derive(Debug)]
pub(super) enum Order {
    /// A client has connected.
    Joined,
    /// It has disconnected.
    Left(u32),
    /// A client's message, and the recipient of the answer.
    Message {
        client: u32,
        id: Option<i64>,
        message: Message,
        answers: Sender<String>,
    },
    /// A hand sample from another source.
    Hand(Source, HandPose),
    /// A path, and its name.
    Upload(String, Arc<HandPath>),
    /// A recording that was made before the program was started.
    Earlier(Box<LiveRecording>),
    /// An edited scene to show.
    Scene(Box<Stage>, Reply),
    /// Why the present content of the scene's file cannot be shown; none if it can.
    SceneProblem(Option<String>),
}

/// An order that may concern the body: it then waits while a change of the body is in progress.
#[derive(Debug)]
pub(super) enum DeferrableOrder {
    Message(u32, Message),
    Scene(Box<Stage>),
}

impl DeferrableOrder {
    const fn is_of_body(&self) -> bool {
        match self {
            Self::Message(_, message) => message.is_of_body(),
            Self::Scene(_) => true,
        }
    }
}

impl Engine {
    pub(super) fn obey(&mut self, order: Order, now: Instant) {
        match order {
            Order::Joined => {
                self.live.clients += 1;
                self.live.changed = true;
            }
            Order::Left(client) => {
                self.live.left(client);
            }
            Order::Hand(source, pose) => {
                // There is no recipient for the message that somebody else holds it.
                let _ = self.live.hand(source, pose, None, now);
            }
            Order::Upload(name, path) => {
                self.upload = Some((name, Way::Path(path)));
            }
            Order::Earlier(recording) => self.offer(*recording),
            Order::Message {
                client,
                id,
                message,
                answers,
            } => self.receive(
                DeferrableOrder::Message(client, message),
                Reply::Client { id, answers },
                now,
            ),
            Order::Scene(stage, reply) => self.receive(DeferrableOrder::Scene(stage), reply, now),
            Order::SceneProblem(problem) => {
                self.live.changed |= self.live.scene_problem != problem;
                self.live.scene_problem = problem;
            }
        }
    }

    /// Executes a request, or keeps it until the board has answered.
    fn receive(&mut self, request: DeferrableOrder, reply: Reply, now: Instant) {
        match &mut self.board {
            Some(board) if board.is_busy() && request.is_of_body() => board.keep(request, reply),
            _ => self.take(request, reply, now),
        }
    }

    /// Executes a request, and answers it.
    pub(super) fn take(&mut self, request: DeferrableOrder, reply: Reply, now: Instant) {
        let result = match request {
            DeferrableOrder::Message(client, message) => self.carry_out(client, message, now),
            DeferrableOrder::Scene(stage) => self.own_scene(*stage).map(Some),
        };
        match result {
            Ok(Some(change)) => self.change(change, reply),
            Ok(None) => self.answers.push((reply, Ok(()))),
            Err(problem) => self.answers.push((reply, Err(problem))),
        }
    }

    fn own_scene(&self, stage: Stage) -> Result<Wanted, String> {
        let change = self.live.own_scene(stage);
        self.may_have(&change)?;
        Ok(change.into())
    }

    /// Checks whether the board, if there is one, supports the scene of a change.
    fn may_have(&self, change: &Change) -> Result<(), String> {
        match self.board {
            Some(_) => {
                without_obstacles(&change.setting().scene).map_err(|error| error.to_string())
            }
            None => Ok(()),
        }
    }

    /// Executes what can be done immediately; returns a change of the body.
    fn carry_out(
        &mut self,
        client: u32,
        message: Message,
        now: Instant,
    ) -> Result<Option<Wanted>, String> {
        if let Message::Record { value } = message {
            if value {
                return self.record().map(Some);
            }
            self.close_recording(now);
            return Ok(None);
        }
        if let Message::Replay {
            what,
            demonstration,
        } = message
        {
            if demonstration && self.is_led {
                return Err(
                    "the hand comes from elsewhere, allowed: a demonstration without --hand, --osc-in and --opentrack-in".to_owned(),
                );
            }
            let change = match what {
                Some(Path::Upload) if !demonstration => Some(self.upload()?),
                Some(Path::Recording) if !demonstration => Some(self.replay_recording()?),
                Some(Path::Scene | Path::Upload | Path::Recording) | None => None,
            };
            if change.is_some() {
                return Ok(change.map(Wanted::from));
            }
        }
        if self.board.is_some() {
            self.may_board(&message)?;
        }
        let change = self.live.carry_out(client, message, now)?;
        if let Some(change) = &change {
            self.may_have(change)?;
        }
        Ok(change.map(Wanted::from))
    }

    /// Checks whether a board supports the message.
    fn may_board(&self, message: &Message) -> Result<(), String> {
        let number = self.live.pair.setting.number;
        if let Message::Number { value } = message
            && *value != number
        {
            return Err(format!(
                "`value` is {}, allowed on this board: {}",
                value.name(),
                number.name()
            ));
        }
        let has_replay = self.live.replay.is_some();
        let problem = if matches!(message, Message::Set { parameters } if parameters.weight.is_some())
        {
            "a board keeps the weight of its scene, allowed: the other parameters"
        } else if matches!(message, Message::Replay { demonstration, .. } if *demonstration) {
            "a board gives no demonstration, allowed: a replay"
        } else if has_replay && matches!(message, Message::Seek { .. }) {
            "a board cannot be set back, allowed: a reset"
        } else {
            return Ok(());
        };
        Err(problem.to_owned())
    }

    pub(super) fn upload(&mut self) -> Result<Change, String> {
        let (name, way) = self
            .upload
            .clone()
            .ok_or_else(|| missing("uploaded path", "after an upload"))?;
        self.live.path(name, way)
    }

    fn replay_recording(&mut self) -> Result<Change, String> {
        self.end_recording();
        let recorded = self
            .recorded
            .as_ref()
            .ok_or_else(|| missing("recording", "after one was made"))?;
        let way = Way::Recorded(Arc::clone(recorded) as _);
        way.check()?;
        Ok(Change::Run(Box::new(NewRun {
            stage: recorded.stage.clone(),
            setting: recorded.setting.clone(),
            path: Some(("recording".to_owned(), way)),
            is_new: false,
        })))
    }

    /// The body stays where it is, and so does the hand, which is live from then on.
    fn record(&self) -> Result<Wanted, String> {
        let mut now = match &self.live.replay {
            Some(_) => self.live.shown_hand(),
            None => self.live.guide.now(),
        };
        // The file of a planar hand has no depth.
        now.depth = 0.0;
        let setting = &self.live.pair.setting;
        let (scene, first) = resumed(&setting.scene, &self.live.pair.present(), now);
        let setting = reread(&Setting {
            scene: Arc::new(scene),
            ..setting.clone()
        })?;
        let stage = Stage {
            scene: Arc::clone(&setting.scene),
            home: first.hand(),
            ..self.live.stage.clone()
        };
        let recording = LiveRecording::new(setting.clone(), stage.clone(), self.board.is_some());
        Ok(Wanted {
            change: Change::run(stage, setting),
            recording: Some(Box::new((recording, now))),
        })
    }
}
