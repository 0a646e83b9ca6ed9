//! What the solver is told, and what it makes of it: a change of the setting, another run, or what concerns the hand and the
//! time alone. What is refused changes nothing.

use std::path::Path as FilePath;
use std::sync::Arc;
use std::time::Instant;

use serde_json::Number as JsonNumber;
use stiction_core::Evolution;
use stiction_scene::{HandPath, SceneFile};
use tokio::sync::mpsc::Sender;

use super::change::{Change, Reply, Run};
use super::engine::Engine;
use super::guide::{Guide, HandPose};
use super::hear::{Message, Parameters, Path};
use super::holder::Source;
use super::recording::Recording;
use super::replay::Way;
use super::resume::resumed;
use super::stage::{Stage, reread};
use crate::body::{Setting, without_obstacles};
use crate::number::Number;
use crate::scenes;

/// Steps that wait at most.
const MOST_STEPS: u32 = 100_000;

/// What the solver is told.
#[derive(Debug)]
pub(super) enum Order {
    /// A client is there.
    Joined,
    /// It is gone.
    Left(u32),
    /// What it says, and where the answer goes.
    Message {
        client: u32,
        id: Option<i64>,
        message: Message,
        answers: Sender<String>,
    },
    /// A sample from elsewhere.
    Hand(Source, HandPose),
    /// A path, and its name.
    Upload(String, Arc<HandPath>),
    /// A recording that was made before the program was started.
    Earlier(Box<Recording>),
}

impl Engine {
    /// Does as it is told.
    pub(super) fn obey(&mut self, order: Order, now: Instant) {
        match order {
            Order::Joined => {
                self.clients += 1;
                self.changed = true;
            }
            Order::Left(client) => {
                self.clients = self.clients.saturating_sub(1);
                self.holder.leave(Source::Client(client));
                self.changed = true;
            }
            Order::Hand(source, pose) => {
                // Nobody is there to be told that somebody else holds it.
                let _ = self.hand(source, pose, None, now);
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
            } => {
                let reply = Reply { id, answers };
                match &mut self.board {
                    Some(board) if board.is_busy() && message.is_of_body() => {
                        board.keep(client, message, reply);
                    }
                    _ => self.take(client, message, reply, now),
                }
            }
        }
    }

    /// Does what a client says, and answers.
    pub(super) fn take(&mut self, client: u32, message: Message, reply: Reply, now: Instant) {
        match self.carry_out(client, message, now) {
            Ok(Some(change)) => self.change(change, reply),
            Ok(None) => self.answers.push((reply, Ok(()))),
            Err(problem) => self.answers.push((reply, Err(problem))),
        }
    }

    /// Does what can be done at once; a change of the body is given back.
    fn carry_out(
        &mut self,
        client: u32,
        message: Message,
        now: Instant,
    ) -> Result<Option<Change>, String> {
        match message {
            Message::Hand { pose, held, sent } => {
                let pose = HandPose {
                    pose: pose.map(|value| value + 0.0),
                    depth: 0.0,
                    held,
                };
                self.hand(Source::Client(client), pose, sent, now)?;
            }
            Message::LetGo {} => {
                self.changed |= self.holder.leave(Source::Client(client));
            }
            Message::Scene { name } => return self.scene(&name).map(Some),
            Message::Set { parameters } => return Ok(Some(self.set(&parameters))),
            Message::Number { value } => return self.number(value).map(Some),
            Message::Evolution { value } => return Ok(Some(self.evolution(value))),
            Message::Pause { value } => {
                self.paused = value;
                self.steps = 0;
                self.changed = true;
            }
            Message::Step { ticks } => self.step(ticks)?,
            Message::Speed { value } => {
                self.speed = value;
                self.changed = true;
            }
            Message::Reset {} => return Ok(Some(self.anew())),
            Message::Record { value: true } => return self.record().map(Some),
            Message::Record { value: false } => self.close_recording(now),
            Message::Replay { what: None } => self.live(),
            Message::Replay { what: Some(what) } => return self.replay(what).map(Some),
            Message::Seek { seconds } => self.seek(seconds)?,
            Message::Rate { .. } => {}
        }
        Ok(None)
    }

    /// A sample of the hand.
    fn hand(
        &mut self,
        source: Source,
        pose: HandPose,
        sent: Option<JsonNumber>,
        now: Instant,
    ) -> Result<(), String> {
        if self.replay.is_some() {
            return Err("the hand follows a path, allowed: a sample while it is live".to_owned());
        }
        let before = self.holder.source();
        let since = self.holder.sample(source, now)?;
        self.guide.lead(pose, since);
        self.echoes.say(source.client().zip(sent));
        self.changed |= before != Some(source);
        Ok(())
    }

    fn scene(&self, name: &str) -> Result<Change, String> {
        let own = self.own.as_ref().filter(|own| own.scene.title == name);
        let number = self.pair.setting.number;
        let stage = match (own, scenes::find(FilePath::new(name))) {
            (Some(own), _) => own.clone(),
            (None, Some(source)) => {
                let scene = SceneFile::parse(source, number.limit());
                let stage = scene.and_then(Stage::new);
                stage.map_err(|error| error.to_string())?
            }
            (None, None) => {
                return Err(format!("no scene {name:?}, allowed: {}", scenes::names()));
            }
        };
        if self.board.is_some() {
            without_obstacles(&stage.scene).map_err(|error| error.to_string())?;
        }
        let setting = Setting {
            scene: Arc::clone(&stage.scene),
            ..self.pair.setting.clone()
        };
        Ok(Change::run(stage, setting))
    }

    /// Body and hand as at the beginning; a path from its beginning. A recording may have begun elsewhere.
    pub(super) fn anew(&self) -> Change {
        let mut setting = self.pair.setting.clone();
        let (written, of_stage) = (
            &mut Arc::make_mut(&mut setting.scene).written,
            &self.stage.scene,
        );
        (written.start, written.holding_point) = (of_stage.start, of_stage.holding_point);
        written.reach = of_stage.reach;
        Change::Run(Box::new(Run {
            stage: self.stage.clone(),
            setting,
            path: self
                .replay
                .as_ref()
                .map(|replay| (replay.what.clone(), replay.way.clone())),
            recording: None,
        }))
    }

    fn number(&self, number: Number) -> Result<Change, String> {
        let setting = self.pair.setting.clone();
        if self.board.is_some() && number != setting.number {
            return Err(format!(
                "`value` is {}, allowed on this board: {}",
                number.name(),
                setting.number.name()
            ));
        }
        Ok(Change::Setting(Setting { number, ..setting }))
    }

    fn evolution(&self, evolution: Evolution) -> Change {
        Change::Setting(Setting {
            evolution,
            ..self.pair.setting.clone()
        })
    }

    fn step(&mut self, ticks: u32) -> Result<(), String> {
        if !self.paused {
            return Err("it is not paused, allowed: a step while paused".to_owned());
        }
        self.steps = self.steps.saturating_add(ticks).min(MOST_STEPS);
        Ok(())
    }

    fn set(&self, parameters: &Parameters) -> Change {
        let mut setting = self.pair.setting.clone();
        let scene = Arc::make_mut(&mut setting.scene);
        let written = &mut scene.written;
        let put = |place: &mut f64, value: Option<f64>| *place = value.unwrap_or(*place);
        put(
            &mut written.stiffness_translation,
            parameters.stiffness_translation,
        );
        put(
            &mut written.stiffness_rotation,
            parameters.stiffness_rotation,
        );
        for surface in &mut written.surfaces {
            put(&mut surface.friction_static, parameters.friction_static);
            put(&mut surface.friction_dynamic, parameters.friction_dynamic);
            surface.memory = parameters.memory.unwrap_or(surface.memory);
        }
        for obstacle in &mut written.obstacles {
            put(&mut obstacle.friction_static, parameters.friction_static);
            put(&mut obstacle.friction_dynamic, parameters.friction_dynamic);
            obstacle.memory = parameters.memory.unwrap_or(obstacle.memory);
        }
        Change::Setting(setting)
    }

    /// The body stays where it is, and so does the hand, which is live from then on.
    fn record(&self) -> Result<Change, String> {
        let mut now = match &self.replay {
            Some(_) => self.shown_hand(),
            None => self.guide.now(),
        };
        // The file of a planar hand has no depth.
        now.depth = 0.0;
        let setting = &self.pair.setting;
        let (scene, first) = resumed(&setting.scene, &self.pair.present(), now);
        let setting = reread(&Setting {
            scene: Arc::new(scene),
            ..setting.clone()
        })?;
        let stage = Stage {
            scene: Arc::clone(&setting.scene),
            home: first.hand(),
            ..self.stage.clone()
        };
        let recording = Recording::new(setting.clone(), stage.clone(), self.board.is_some());
        Ok(Change::Run(Box::new(Run {
            stage,
            setting,
            path: None,
            recording: Some((recording, now)),
        })))
    }

    /// The hand as the newest frame has it.
    fn shown_hand(&self) -> HandPose {
        let frame = &self.pair.frame;
        HandPose {
            pose: frame.hand.map(|value| value + 0.0),
            depth: frame.depth,
            held: frame.held,
        }
    }

    fn replay(&mut self, what: Path) -> Result<Change, String> {
        let missing =
            |what, allowed| Err(format!("there is no {what} to replay, allowed: {allowed}"));
        let (mut stage, mut setting) = (self.stage.clone(), self.pair.setting.clone());
        let path = match what {
            Path::Scene => match &self.stage.path {
                Some(path) => ("scene".to_owned(), Way::Path(Arc::clone(path))),
                None => return missing("path in the scene", "in a scene with one"),
            },
            Path::Upload => match &self.upload {
                Some(upload) => upload.clone(),
                None => return missing("uploaded path", "after an upload"),
            },
            Path::Recording => {
                self.end_recording();
                let Some(recorded) = &self.recorded else {
                    return missing("recording", "after one was made");
                };
                stage = recorded.stage.clone();
                setting = recorded.setting.clone();
                ("recording".to_owned(), Way::Recorded(Arc::clone(recorded)))
            }
        };
        path.1.check()?;
        Ok(Change::Run(Box::new(Run {
            stage,
            setting,
            path: Some(path),
            recording: None,
        })))
    }

    /// The path that was sent.
    pub(super) fn upload(&mut self) -> Result<Change, String> {
        self.replay(Path::Upload)
    }

    /// The hand is live again, and stays where it is.
    fn live(&mut self) {
        if self.replay.take().is_some() {
            self.guide = Guide::at(self.shown_hand());
            self.changed = true;
            self.pending.touch();
        }
    }

    fn seek(&mut self, seconds: f64) -> Result<(), String> {
        let Some(replay) = &mut self.replay else {
            return Err("there is no replay, allowed: a seek while replaying".to_owned());
        };
        if self.board.is_some() {
            return Err("a board cannot be set back, allowed: a reset".to_owned());
        }
        replay.seek(seconds, &mut self.pair)?;
        self.begin_run(HandPose::of(&self.stage.home));
        Ok(())
    }
}

/// The bundled scenes that can be shown: a board takes no obstacles.
fn shown(has_board: bool) -> impl Iterator<Item = &'static (&'static str, &'static str)> {
    let taken = scenes::ALL.iter();
    taken.filter(move |scene| !has_board || !scenes::has_obstacles(scene))
}

/// The names of the scenes that can be shown.
pub(super) fn scene_names(own: Option<&Stage>, has_board: bool) -> Vec<String> {
    let own = own.map(|own| own.scene.title.clone());
    let bundled = shown(has_board).map(|(name, _)| (*name).to_owned());
    own.into_iter().chain(bundled).collect()
}
