//! What the solver is told, and what it makes of it. What is refused changes nothing.

use std::path::Path as FilePath;
use std::sync::Arc;
use std::time::Instant;

use serde_json::Number as JsonNumber;
use tokio::sync::mpsc::Sender;

use super::body::Setting;
use super::engine::Engine;
use super::guide::{Guide, HandPose};
use super::hear::{Message, Parameters, Path};
use super::holder::Source;
use super::pair::Pair;
use super::recording::Recording;
use super::replay::{self, Replay, Way};
use super::say;
use super::stage::{Stage, reread};
use crate::hand_path::HandPath;
use crate::scene_file::SceneFile;
use crate::scenes;

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
            Order::Message {
                client,
                id,
                message,
                answers,
            } => {
                let answer = match (self.carry_out(client, message, now), id) {
                    (Ok(()), None) => return,
                    (Ok(()), Some(id)) => say::done(id),
                    (Err(problem), id) => say::error(id, &problem),
                };
                // A client that does not read loses answers.
                let _ = answers.try_send(answer);
            }
        }
    }

    fn carry_out(&mut self, client: u32, message: Message, now: Instant) -> Result<(), String> {
        match message {
            Message::Hand { pose, held, sent } => {
                let pose = HandPose {
                    pose: pose.map(|value| value + 0.0),
                    depth: 0.0,
                    held,
                };
                self.hand(Source::Client(client), pose, sent, now)
            }
            Message::LetGo {} => {
                self.changed |= self.holder.leave(Source::Client(client));
                Ok(())
            }
            Message::Scene { name } => self.scene(&name),
            Message::Set { parameters } => self.set(&parameters),
            Message::Number { value } => self.change(Setting {
                number: value.into(),
                ..self.pair.setting.clone()
            }),
            Message::Evolution { value } => self.change(Setting {
                evolution: value.into(),
                ..self.pair.setting.clone()
            }),
            Message::Pause { value } => {
                self.paused = value;
                self.steps = 0;
                self.changed = true;
                Ok(())
            }
            Message::Step { ticks } if self.paused => {
                self.steps = ticks;
                Ok(())
            }
            Message::Step { .. } => {
                Err("it is not paused, allowed: a step while paused".to_owned())
            }
            Message::Speed { value } => {
                self.speed = value;
                self.changed = true;
                Ok(())
            }
            Message::Reset {} => self.reset(),
            Message::Record { value: true } => self.record(),
            Message::Record { value: false } => {
                self.end_recording();
                Ok(())
            }
            Message::Replay { what } => self.replay(what),
            Message::Seek { seconds } => self.seek(seconds),
            Message::Rate { .. } => Ok(()),
        }
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
        self.echo = source.client().zip(sent);
        self.changed |= before != Some(source);
        Ok(())
    }

    fn scene(&mut self, name: &str) -> Result<(), String> {
        let own = self.own.as_ref().filter(|own| own.scene.title == name);
        let number = self.pair.setting.number;
        let stage = match (own, scenes::find(FilePath::new(name))) {
            (Some(own), _) => own.clone(),
            (None, Some(source)) => {
                let scene = SceneFile::parse(source, number);
                let stage = scene.and_then(Stage::new);
                stage.map_err(|error| error.to_string())?
            }
            (None, None) => {
                return Err(format!("no scene {name:?}, allowed: {}", scenes::names()));
            }
        };
        let setting = Setting {
            scene: Arc::clone(&stage.scene),
            ..self.pair.setting.clone()
        };
        self.show(stage, &setting)
    }

    /// Another stage, with the body at its start and the hand live.
    fn show(&mut self, stage: Stage, setting: &Setting) -> Result<(), String> {
        let pair = Pair::start(setting, 0.0, &stage.home)?;
        self.end_recording();
        self.replay = None;
        self.guide = Guide::at(HandPose::of(&stage.home));
        self.stage = stage;
        self.pair = pair;
        self.begin_run();
        Ok(())
    }

    fn set(&mut self, parameters: &Parameters) -> Result<(), String> {
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
        }
        self.change(setting)
    }

    /// Another setting of the same scene: the body stays where it is and settles.
    fn change(&mut self, setting: Setting) -> Result<(), String> {
        self.pair.change(&setting)?;
        self.end_recording();
        if let Some(replay) = &mut self.replay {
            replay.forget();
        }
        self.pending.record(&self.pair.frame);
        self.changed = true;
        Ok(())
    }

    fn record(&mut self) -> Result<(), String> {
        let mut setting = self.pair.setting.clone();
        // From now on the scene is the one that a reader of the file gets.
        let (scene, text) =
            reread(&setting.scene, setting.number).map_err(|error| error.to_string())?;
        setting.scene = Arc::new(SceneFile {
            // Where paths lie in it stays as it is.
            hand: setting.scene.hand.clone(),
            ..scene
        });
        let mut home = HandPose::of(&self.stage.home);
        home.depth = 0.0;
        let stage = Stage {
            home: home.hand(),
            ..self.stage.clone()
        };
        self.show(stage.clone(), &setting)?;
        let mut recording = Recording::new(text, setting, stage);
        recording.add(home);
        self.recording = Some(recording);
        Ok(())
    }

    fn replay(&mut self, what: Option<Path>) -> Result<(), String> {
        let missing = |what: &str| Err(format!("there is no {what} to replay"));
        let (name, way) = match what {
            None => return self.live(),
            Some(Path::Scene) => match &self.stage.path {
                Some(path) => ("scene".to_owned(), Way::Path(Arc::clone(path))),
                None => return missing("path in the scene"),
            },
            Some(Path::Upload) => match &self.upload {
                Some(upload) => upload.clone(),
                None => return missing("uploaded path"),
            },
            Some(Path::Recording) => {
                self.end_recording();
                let Some(recorded) = self.recorded.clone() else {
                    return missing("recording");
                };
                let way = Way::Recorded(Arc::clone(&recorded));
                let started = Replay::begin("recording".to_owned(), way, &recorded.setting)?;
                self.stage = recorded.stage.clone();
                return self.follow(started);
            }
        };
        if way.len() > replay::LONGEST {
            return Err(format!(
                "the path has {} ticks, allowed: {}",
                way.len(),
                replay::LONGEST
            ));
        }
        let started = Replay::begin(name, way, &self.pair.setting)?;
        self.follow(started)
    }

    /// Follows the path that was sent.
    pub(super) fn follow_upload(&mut self) -> Result<(), String> {
        self.replay(Some(Path::Upload))
    }

    fn follow(&mut self, (replay, pair): (Replay, Pair)) -> Result<(), String> {
        self.end_recording();
        self.replay = Some(replay);
        self.pair = pair;
        self.begin_run();
        Ok(())
    }

    /// The hand is live again, and stays where it is.
    fn live(&mut self) -> Result<(), String> {
        if self.replay.take().is_some() {
            let frame = &self.pair.frame;
            self.guide = Guide::at(HandPose {
                pose: frame.hand.map(|value| value + 0.0),
                depth: frame.depth,
                held: frame.held,
            });
            self.changed = true;
            self.pending.touch();
        }
        Ok(())
    }

    fn seek(&mut self, seconds: f64) -> Result<(), String> {
        let Some(replay) = &mut self.replay else {
            return Err("there is no replay, allowed: a seek while replaying".to_owned());
        };
        replay.seek(seconds, &mut self.pair)?;
        self.begin_run();
        Ok(())
    }
}

/// The names of the scenes that can be shown.
pub(super) fn scene_names(own: Option<&Stage>) -> Vec<String> {
    let own = own.map(|own| own.scene.title.clone());
    let bundled = scenes::ALL.iter().map(|(name, _)| (*name).to_owned());
    own.into_iter().chain(bundled).collect()
}
