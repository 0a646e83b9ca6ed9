//! What `stiction view` is to its page, for a page that no server serves: the solver in real time, and the messages of
//! `host-sim/VIEW.md` in and out. It runs in a worker, which calls [`Page::turn`] when a tick is due.

use std::path::Path;

use serde_json::json;
use stiction_core::Evolution;
use stiction_live::body::Setting;
use stiction_live::feed::{Shown, Told};
use stiction_live::hear::{self, Message, Said};
use stiction_live::live::{Live, PERIOD};
use stiction_live::number::Number;
use stiction_live::own;
use stiction_live::say::{self, Source};
use stiction_live::scenes;
use stiction_live::simulate;
use stiction_live::stage::Stage;
use stiction_scene::SceneFile;
use wasm_bindgen::prelude::*;
use web_time::{Duration, Instant};

/// The scene of the beginning.
const SCENE: &str = "box-flat";
/// The number of the only client.
const CLIENT: u32 = 1;
/// Frames a second, unless the page asks for others.
const RATE: f64 = 60.0;
/// A tick may be so late: messages of the page stand between two of them, and a browser tells the time to 0.1 ms.
const ALLOWED: Duration = Duration::from_millis(2);
/// Ticks are made for so long, before the page is heard again.
const LONGEST_TURN: Duration = Duration::from_millis(8);

/// The solver behind a page.
#[wasm_bindgen]
pub struct Page {
    live: Live,
    shown: Shown,
    told: Told,
    /// Answers that wait until what they are about is shown.
    answers: Vec<String>,
    /// The next tick, and the next frame message.
    due: Instant,
    frame_due: Instant,
    /// Between two frame messages.
    period: Duration,
}

#[wasm_bindgen]
impl Page {
    /// With its first scene, whose first tick is due now.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Result<Self, JsError> {
        let source = scenes::find(Path::new(SCENE)).ok_or_else(|| JsError::new(SCENE))?;
        let number = Number::F32;
        let scene = SceneFile::parse(source, number.limit()).and_then(Stage::new);
        let stage = scene.map_err(|error| JsError::new(&error.to_string()))?;
        let setting = Setting {
            scene: stage.scene.clone(),
            number,
            evolution: Evolution::Path,
        };
        let mut live = Live::new(stage, &setting).map_err(|problem| JsError::new(&problem))?;
        live.clients = 1;
        let (shown, now) = (Shown::default(), Instant::now());
        Ok(Self {
            told: Told::new(&shown),
            live,
            shown,
            answers: Vec::new(),
            due: now,
            frame_due: now,
            period: Duration::from_secs_f64(1.0 / RATE),
        })
    }

    /// The message that comes first.
    pub fn hello(&self) -> String {
        say::hello(CLIENT, &self.live.scene_names(true), &Source::Core)
    }

    /// A message that only the whole solver can do: a scene with obstacles, where this is built without them. Another page is to do
    /// it, after [`Page::handed_over`].
    #[wasm_bindgen(js_name = isBeyond)]
    pub fn is_beyond(&self, text: &str) -> bool {
        let Ok(Message::Scene { name }) = hear::read(text).message else {
            return false;
        };
        let scene = scenes::ALL.iter().find(|(known, _)| *known == name);
        scene.is_some_and(scenes::has_obstacles) && !simulate::OBSTACLES
    }

    /// The messages that bring another page to where this one is, but for the scene.
    #[wasm_bindgen(js_name = handedOver)]
    pub fn handed_over(&self) -> Vec<String> {
        let setting = &self.live.pair.setting;
        let messages = [
            json!({"type": "number", "value": setting.number.name()}),
            json!({"type": "evolution", "value": setting.evolution.name()}),
            json!({"type": "pause", "value": self.live.paused}),
            json!({"type": "speed", "value": self.live.speed}),
            json!({"type": "rate", "value": 1.0 / self.period.as_secs_f64()}),
        ];
        messages.iter().map(ToString::to_string).collect()
    }

    /// The scenes of the page's own, name and text of each; another page is to have them, after [`Page::handed_over`].
    #[wasm_bindgen(js_name = handedScenes)]
    pub fn handed_scenes(&self) -> Vec<String> {
        let own = self.live.own.iter().map(|own| own.scene.source());
        let pairs = own.flat_map(|source| {
            let name = source.file().to_string_lossy().into_owned();
            [name, source.text().to_owned()]
        });
        pairs.collect()
    }

    /// The message that shows the scene that is shown.
    #[wasm_bindgen(js_name = handedShown)]
    pub fn handed_shown(&self) -> String {
        json!({"type": "scene", "name": self.live.stage.scene.title}).to_string()
    }

    /// Shows the scene of a text, under a name of the page; its title.
    ///
    /// Throws where it is no scene: the message names the key and the line.
    #[wasm_bindgen(js_name = putScene)]
    pub fn put_scene(&mut self, name: &str, text: &str) -> Result<String, JsError> {
        let stage = own::parse(name, text.into(), self.live.pair.setting.number.limit());
        self.show(stage.map_err(|error| error.to_string()))
    }

    /// Shows the scene that is shown with changes (JSON), under a name of the page; its title.
    ///
    /// Throws where they do not make a scene.
    #[wasm_bindgen(js_name = putEdit)]
    pub fn put_edit(&mut self, name: &str, json: &str) -> Result<String, JsError> {
        let limit = self.live.pair.setting.number.limit();
        let stage = own::edited(&self.live.stage, name, json.as_bytes(), limit);
        self.show(stage)
    }

    /// The scene that is shown, as a file that can be run.
    #[wasm_bindgen(js_name = sceneFile)]
    pub fn scene_file(&self) -> String {
        own::text(&self.live.stage, &self.live.pair.setting.scene)
    }

    /// Does what the page says.
    pub fn take(&mut self, text: &str) {
        let Said { id, message } = hear::read(text);
        let now = Instant::now();
        let result = match message {
            Ok(Message::Rate { value }) => {
                self.period = Duration::from_secs_f64(1.0 / value);
                self.frame_due = now;
                Ok(())
            }
            Ok(message) => self.live.take(CLIENT, message, now),
            Err(problem) => Err(problem),
        };
        self.answers.extend(say::answer(id, result));
    }

    /// Makes the ticks that are due, and gives the messages for the page.
    pub fn turn(&mut self) -> Vec<String> {
        let begun = Instant::now();
        let mut now = begun;
        while self.due <= now && now.duration_since(begun) < LONGEST_TURN {
            self.due = self.live.late(self.due, now, ALLOWED);
            self.live.changed |= self.live.holder.expire(now);
            self.live.pass(&mut |live| {
                live.advance();
                true
            });
            self.due += PERIOD;
            now = Instant::now();
        }
        self.publish();
        let mut messages = std::mem::take(&mut self.answers);
        let with_frame = now >= self.frame_due;
        if with_frame {
            self.frame_due = (self.frame_due + self.period).max(now);
        }
        let (state, news) = self.told.look(&self.shown, with_frame);
        messages.extend(state.map(|state| state.to_string()));
        messages.extend(news.map(|news| news.message(CLIENT, 0)));
        messages
    }

    /// Until the next tick is due (ms).
    #[wasm_bindgen(js_name = untilDue)]
    pub fn until_due(&self) -> f64 {
        let wait = self.due.saturating_duration_since(Instant::now());
        wait.as_secs_f64() * 1e3
    }

    fn show(&mut self, stage: Result<Stage, String>) -> Result<String, JsError> {
        let shown = stage.and_then(|stage| {
            let title = stage.scene.title.clone();
            self.live.apply(self.live.own_scene(stage))?;
            Ok(title)
        });
        shown.map_err(|problem| JsError::new(&problem))
    }

    fn publish(&mut self) {
        if self.live.changed {
            let status = self.live.status();
            self.live.tell(&status);
        }
        if !self.live.pending.is_shown() {
            let latest = self.live.latest(None);
            self.shown.show(&mut self.live.pending, latest);
        }
    }
}
