//! The counterpart of `stiction view` for a page without a server: the solver in real time, and the messages of
//! `host-sim/VIEW.md` in and out. It runs in a worker, which calls [`Page::turn`] when a tick is due.

use std::path::Path;

use stiction_core::Evolution;
use stiction_live::body::Setting;
use stiction_live::feed::{Cursor, Shown};
use stiction_live::inbound::{self, Incoming, Message};
use stiction_live::live::{Live, PERIOD};
use stiction_live::number::Number;
use stiction_live::outbound::{self, Runner};
use stiction_live::own;
use stiction_live::scenes;
use stiction_live::stage::Stage;
use stiction_scene::SceneFile;
use wasm_bindgen::prelude::*;
use web_time::{Duration, Instant};

const SCENE: &str = "drag";
const CLIENT: u32 = 1;
/// Frames per second, unless the page requests another rate.
const RATE: f64 = 60.0;
/// The allowed delay of a tick: messages of the page are handled between two ticks, and the browser's clock has a
/// resolution of 0.1 ms.
const ALLOWED: Duration = Duration::from_millis(2);
/// The longest time for ticks before messages of the page are handled again.
const LONGEST_TURN: Duration = Duration::from_millis(8);

/// The solver behind a page.
#[wasm_bindgen]
pub struct Page {
    live: Live,
    shown: Shown,
    cursor: Cursor,
    /// Answers that wait until their result is shown.
    answers: Vec<String>,
    /// The times of the next tick and of the next frame message.
    due: Instant,
    frame_due: Instant,
    /// The time between two frame messages.
    period: Duration,
}

#[wasm_bindgen]
impl Page {
    /// A page with its first scene, whose first tick is due now.
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
            cursor: Cursor::new(&shown),
            live,
            shown,
            answers: Vec::new(),
            due: now,
            frame_due: now,
            period: Duration::from_secs_f64(1.0 / RATE),
        })
    }

    /// The first message.
    pub fn hello(&self) -> String {
        outbound::hello(CLIENT, &self.live.offers(true), &Runner::Core)
    }

    /// Shows the scene of a text, under a name given by the page. Returns its title.
    ///
    /// Throws if the text is no scene: the message names the key and the line.
    #[wasm_bindgen(js_name = putScene)]
    pub fn put_scene(&mut self, name: &str, text: &str) -> Result<String, JsError> {
        let stage = own::parse(name, text.into(), self.live.pair.setting.number.limit());
        self.show(stage.map_err(|error| error.to_string()))
    }

    /// Changes the present scene (JSON), under a name given by the page. Returns its title.
    ///
    /// Throws if the result is no scene.
    #[wasm_bindgen(js_name = putEdit)]
    pub fn put_edit(&mut self, name: &str, json: &str) -> Result<String, JsError> {
        let limit = self.live.pair.setting.number.limit();
        let stage = own::edited(&self.live.stage, name, json.as_bytes(), limit);
        self.show(stage)
    }

    /// The present scene, as a file that can be run.
    #[wasm_bindgen(js_name = sceneFile)]
    pub fn scene_file(&self) -> String {
        own::text(&self.live.stage, &self.live.pair.setting.scene)
    }

    /// Handles a message of the page.
    pub fn take(&mut self, text: &str) {
        let Incoming { id, message } = inbound::read(text);
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
        self.answers.extend(outbound::answer(id, result));
    }

    /// Executes the ticks that are due, and returns the messages for the page.
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
        let (state, news) = self.cursor.look(&self.shown, with_frame);
        messages.extend(state.map(|state| state.to_string()));
        messages.extend(news.map(|news| news.message(CLIENT, 0)));
        messages
    }

    /// The time until the next tick is due (ms).
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
            let status = self.live.status(true);
            self.live.tell(&status);
        }
        if !self.live.pending.is_shown() {
            let latest = self.live.latest(None);
            self.shown.show(&mut self.live.pending, latest);
        }
    }
}
