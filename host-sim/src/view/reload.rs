//! Follows the scene's file while somebody edits it: reads it repeatedly, and shows it again when its content has changed. If it
//! cannot be shown, clients and terminal receive the reason, and the previous scene continues.

use std::path::PathBuf;
use std::sync::mpsc::SyncSender;
use std::thread;
use std::time::Duration;

use stiction_live::body::without_obstacles;
use stiction_live::number::Number;
use stiction_live::stage::Stage;
use stiction_scene::{InputError, SceneFile, Source};
use tokio::sync::mpsc::{Sender, channel};

use super::change::Reply;
use super::orders::Order;

/// Interval of the readings of the file. Its content counts when it is the same twice: an editor may be writing it.
const EVERY: Duration = Duration::from_millis(400);

/// The content of the file, or why it cannot be read.
type Content = Result<Vec<u8>, String>;

pub(super) struct Watch {
    pub(super) file: PathBuf,
    pub(super) number: Number,
    pub(super) has_board: bool,
    pub(super) orders: Sender<Order>,
    /// Messages for the terminal.
    pub(super) notes: SyncSender<String>,
}

pub(super) fn begin(watch: Watch) {
    thread::spawn(move || watch.go());
}

impl Watch {
    /// Runs until the program ends.
    fn go(self) {
        let mut shown = stiction_scene::text::read(&self.file);
        let mut last = shown.clone();
        loop {
            thread::sleep(EVERY);
            let content = stiction_scene::text::read(&self.file);
            let is_whole = content == last;
            last = content;
            if !is_whole || last == shown {
                continue;
            }
            shown = last.clone();
            let problem = self.show(&last).err();
            if let Some(problem) = &problem {
                // A terminal that does not keep up loses lines.
                let _ = self.notes.try_send(format!("{problem}\n"));
            }
            if self
                .orders
                .blocking_send(Order::SceneProblem(problem))
                .is_err()
            {
                return;
            }
        }
    }

    /// Requests that a content is shown.
    fn show(&self, content: &Content) -> Result<(), String> {
        let stage = self.stage(content).map_err(|error| error.to_string())?;
        let (reply, mut result) = channel(1);
        let order = Order::Scene(Box::new(stage), Reply::Direct(reply));
        let ends = || "the program ends".to_owned();
        self.orders.blocking_send(order).map_err(|_| ends())?;
        result.blocking_recv().ok_or_else(ends)?
    }

    fn stage(&self, content: &Content) -> Result<Stage, InputError> {
        let bytes = content.clone();
        let bytes = bytes.map_err(|problem| InputError::of_file(&self.file, problem))?;
        let source = Source::of_bytes(&self.file, bytes)?;
        let scene = SceneFile::parse(source, self.number.limit())?;
        match self.has_board {
            true => without_obstacles(&scene)?,
            false => scene.scene::<f64>().map(drop)?,
        }
        Stage::new(scene)
    }
}
