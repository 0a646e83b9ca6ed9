//! Messages to a client: hello, the state, frames, answers. JSON, as specified in `host-sim/VIEW.md`.

mod frame;
mod state;

use serde::Serialize;
use serde_json::json;

use crate::scenes::Offer;

pub use frame::News;
pub use state::{By, Downloadable, Replayed, Status, state};

/// Version of the protocol.
const VERSION: u32 = 1;

/// Statistics of a board.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Fares {
    /// Whether it is connected.
    pub connected: bool,
    /// Answers per second.
    pub rate: f64,
    /// Time from a sample to its answer (s), median of the last ones.
    pub latency: Option<f64>,
    /// Samples overtaken by a newer one.
    pub late: u64,
    /// Samples without an answer.
    pub lost: u64,
    /// Ticks that the board made too late.
    pub missed: u64,
    /// Garbled frames, in both directions.
    pub faults: u64,
    /// Longest step of its solver (s).
    #[serde(skip)]
    pub worst_step: Option<f64>,
}

impl Fares {
    /// The statistics without a board.
    pub const NONE: Self = Self {
        connected: false,
        rate: 0.0,
        latency: None,
        late: 0,
        lost: 0,
        missed: 0,
        faults: 0,
        worst_step: None,
    };
}

/// What runs the solver.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Runner<'a> {
    /// The program or the page itself.
    Core,
    /// A board.
    Board {
        /// Name that it reports.
        name: &'a str,
        /// Its number type.
        number: &'a str,
        /// Where it is connected.
        r#where: &'a str,
        /// Whether it is emulated on this computer.
        emulated: bool,
    },
}

/// Returns the first message to a client.
pub fn hello(client: u32, scenes: &[Offer], source: &Runner<'_>) -> String {
    let names: Vec<_> = scenes.iter().map(|scene| &scene.name).collect();
    let stories: Vec<_> = scenes.iter().map(|scene| &scene.story).collect();
    json!({
        "type": "hello",
        "version": VERSION,
        "you": client,
        "program": concat!("stiction ", env!("CARGO_PKG_VERSION")),
        "scenes": names,
        "stories": stories,
        "source": source,
    })
    .to_string()
}

/// Returns the answer to a message; none if nobody waits for one.
pub fn answer(id: Option<i64>, result: Result<(), String>) -> Option<String> {
    match (result, id) {
        (Ok(()), id) => id.map(done),
        (Err(problem), id) => Some(error(id, &problem)),
    }
}

/// Returns the answer to a message that succeeded.
pub fn done(id: i64) -> String {
    json!({"type": "done", "id": id}).to_string()
}

/// Returns the answer to one that failed.
pub fn error(id: Option<i64>, problem: &str) -> String {
    match id {
        Some(id) => json!({"type": "error", "id": id, "message": problem}),
        None => json!({"type": "error", "message": problem}),
    }
    .to_string()
}

/// Cannot fail: whatever is serialised here has only text keys.
fn text(message: &impl Serialize) -> String {
    serde_json::to_string(message).unwrap_or_default()
}
