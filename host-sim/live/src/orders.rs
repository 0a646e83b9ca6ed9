//! Handles a client's messages: a change of the setting, another run, or an action on hand and time only. A refused message has
//! no effect.

use std::path::Path as FilePath;
use std::sync::Arc;

use serde_json::Number as JsonNumber;
use stiction_core::Evolution;
use stiction_scene::{HandPath, SceneFile};
use web_time::Instant;

use crate::body::Setting;
use crate::change::{Change, NewRun};
use crate::guide::{Guide, HandPose};
use crate::holder::Source;
use crate::inbound::{Message, Parameters, Path};
use crate::live::Live;
use crate::number::Number;
use crate::replay::Way;
use crate::scenes;
use crate::stage::Stage;

/// Largest number of steps that wait.
const MOST_STEPS: u32 = 100_000;

impl Live {
    /// Handles a message from a client.
    ///
    /// # Errors
    /// It cannot be done.
    pub fn take(&mut self, client: u32, message: Message, now: Instant) -> Result<(), String> {
        match self.carry_out(client, message, now)? {
            Some(change) => self.apply(change),
            None => Ok(()),
        }
    }

    /// Does what can be done immediately; returns a change of the body. Recordings and uploads are not supported here.
    ///
    /// # Errors
    /// It cannot be done.
    pub fn carry_out(
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
            Message::Number { value } => return Ok(Some(self.number(value))),
            Message::Evolution { value } => return Ok(Some(self.evolution(value))),
            Message::Pause { value } => {
                self.paused = value;
                self.steps = 0;
                self.changed = true;
            }
            Message::Step { ticks } => self.add_steps(ticks)?,
            Message::Speed { value } => {
                self.speed = value;
                self.changed = true;
            }
            Message::Reset { parameters } => return Ok(Some(self.anew(parameters))),
            Message::Defaults {} => return Ok(Some(self.defaults())),
            Message::Replay {
                demonstration: true,
                what,
            } => return self.demonstration(client, what).map(Some),
            Message::Replay { what: None, .. } => self.release(),
            Message::Replay {
                what: Some(Path::Scene),
                ..
            } => return self.scene_path(Way::Path).map(Some),
            Message::Seek { seconds } => self.seek(seconds)?,
            Message::Rate { .. } => {}
            Message::Record { .. } | Message::Replay { .. } => {
                return Err(
                    "there are no recordings and no uploads without the program, allowed: stiction view".to_owned(),
                );
            }
        }
        Ok(None)
    }

    /// Takes a sample of the hand.
    ///
    /// # Errors
    /// Somebody else holds the hand, or it follows a path.
    pub fn hand(
        &mut self,
        source: Source,
        pose: HandPose,
        sent: Option<JsonNumber>,
        now: Instant,
    ) -> Result<(), String> {
        match &self.replay {
            Some(replay) if replay.is_demonstration() => self.release(),
            Some(_) => {
                let problem = "the hand follows a path, allowed: a sample while it is live";
                return Err(problem.to_owned());
            }
            None => {}
        }
        let before = self.holder.source();
        let since = self.holder.sample(source, now)?;
        self.guide.lead(pose, since);
        self.echoes.say(source.client().zip(sent));
        self.changed |= before != Some(source);
        Ok(())
    }

    fn scene(&self, name: &str) -> Result<Change, String> {
        let own = self.own.iter().find(|own| own.scene.title == name);
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
        let setting = self.setting_of(&stage);
        Ok(Change::run(stage, setting))
    }

    /// Starts a client's own scene from its beginning; it can be shown again later.
    pub fn own_scene(&self, stage: Stage) -> Change {
        Change::Run(Box::new(NewRun {
            setting: self.setting_of(&stage),
            stage,
            path: None,
            is_new: true,
        }))
    }

    fn setting_of(&self, stage: &Stage) -> Setting {
        Setting {
            scene: Arc::clone(&stage.scene),
            ..self.pair.setting.clone()
        }
    }

    /// Returns body and hand to their start, with the file's parameters if `parameters` is set; a path restarts from its
    /// beginning. A recording may have begun elsewhere.
    pub fn anew(&self, parameters: bool) -> Change {
        let mut setting = self.pair.setting.clone();
        match parameters {
            true => setting.scene = Arc::clone(&self.stage.scene),
            false => Arc::make_mut(&mut setting.scene)
                .written
                .begin_as(&self.stage.scene),
        }
        Change::Run(Box::new(NewRun {
            stage: self.stage.clone(),
            setting,
            path: self
                .replay
                .as_ref()
                .map(|replay| (replay.what.clone(), replay.way.clone())),
            is_new: false,
        }))
    }

    fn defaults(&self) -> Change {
        let mut setting = self.pair.setting.clone();
        let mut scene = SceneFile::clone(&self.stage.scene);
        scene.written.begin_as(&setting.scene);
        setting.scene = Arc::new(scene);
        Change::Setting(setting)
    }

    fn number(&self, number: Number) -> Change {
        Change::Setting(Setting {
            number,
            ..self.pair.setting.clone()
        })
    }

    fn evolution(&self, evolution: Evolution) -> Change {
        Change::Setting(Setting {
            evolution,
            ..self.pair.setting.clone()
        })
    }

    fn add_steps(&mut self, ticks: u32) -> Result<(), String> {
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
        put(&mut written.weight, parameters.weight);
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

    /// Repeats the scene's path until somebody takes the hand. It takes the hand from nobody but the requesting client.
    fn demonstration(&mut self, client: u32, what: Option<Path>) -> Result<Change, String> {
        if what != Some(Path::Scene) {
            return Err("a demonstration of another path, allowed: \"scene\"".to_owned());
        }
        self.holder.may_lead(Source::Client(client))?;
        let change = self.scene_path(Way::Demonstration)?;
        self.holder.leave(Source::Client(client));
        Ok(change)
    }

    fn scene_path(&self, way: fn(Arc<HandPath>) -> Way) -> Result<Change, String> {
        match &self.stage.path {
            Some(path) => self.path("scene".to_owned(), way(Arc::clone(path))),
            None => Err(missing("path in the scene", "in a scene with one")),
        }
    }

    /// Makes the hand follow a path in the present scene.
    ///
    /// # Errors
    /// The path is too long.
    pub fn path(&self, name: String, way: Way) -> Result<Change, String> {
        way.check()?;
        Ok(Change::Run(Box::new(NewRun {
            stage: self.stage.clone(),
            setting: self.pair.setting.clone(),
            path: Some((name, way)),
            is_new: false,
        })))
    }

    /// Makes the hand live again; it stays where it is.
    pub fn release(&mut self) {
        if self.replay.take().is_some() {
            self.guide = Guide::at(self.shown_hand());
            self.changed = true;
            self.pending.touch();
        }
    }

    /// Jumps to a time (s) of the path.
    ///
    /// # Errors
    /// There is no path.
    pub fn seek(&mut self, seconds: f64) -> Result<(), String> {
        let Some(replay) = &mut self.replay else {
            return Err("there is no replay, allowed: a seek while replaying".to_owned());
        };
        replay.seek(seconds, &mut self.pair)?;
        self.begin_run(HandPose::of(&self.stage.home));
        Ok(())
    }
}

/// Returns the error message if there is no such path to replay.
pub fn missing(what: &str, allowed: &str) -> String {
    format!("there is no {what} to replay, allowed: {allowed}")
}
