//! Whether a trace obeys the laws of statics and friction, from nothing but the scene and the trace, ours or another program's.
//! It shares no code with the solver and takes nothing from it but what is printed. Everything in f64, SI units, world frame.
//!
//! ```text
//! scene.toml ── scene ─────────────────┐
//! trace.jsonl ─ trace ─ frame by frame ┴───────┬ still (geometry, balance) ────────────┐
//! trace.csv                                     ├ judge (hold, rest, stick)             ├ findings ─ survey
//!                                               └ slip ─ onset, pin, brace (STATICS 3-5)┘
//! ```
//!
//! [`law`] has the name and the statement of every law, [`Bounds`] what is allowed. STATICS is `core/STATICS.md`.
//!
//! What a frame that is not `ok` promises is what it is judged by: `event-limit` is in balance all the same; `ambiguous` is out of
//! balance, and nothing moves; `saturated` and `held-last` repeat the pose of the frame before. `iteration-limit` promises no
//! balance, but is judged as if it did: what a search left undone is to be seen.
//!
//! # What is not judged
//!
//! * Where a frame goes between two balances: a wrong branch of the angle in balance passes, but for a single slip of a vertex,
//!   which must continue the branch of the frame before.
//! * When a contact should have given way, opened or come to be: that a contact is in its cone, and no vertex inside a
//!   surface, is all that is asked.
//! * Where slips of contacts with mu_s = mu_d are: they slide continuously, and nothing marks their ends.
//! * Of a frame with a single slip and nothing else: a slip of more than two contacts, one that is no longer than rounding, and
//!   of two vertices on two surfaces, whether its end is the first one on the way, and whether both press there.
//! * Of a frame with more slips, or slips among other events: all but the last one; that one too where the state is not a
//!   vertex or an edge, where it is not the last event, or where a contact opened before it (the slip may then end out of
//!   balance, and the body turns after it); and which way it went.
//! * A body that no hand holds has no balance: it is asked to stay.
//! * Rows of CSV that say that there were more than four contacts: springs, geometry and the contacts that are there.

mod bearing;
mod brace;
mod error;
mod finding;
mod frame;
mod hold;
mod judge;
mod model;
mod onset;
mod pin;
mod scene;
mod slide;
mod slip;
mod still;
mod survey;
mod trace;
mod vector;

pub use error::InputError;
pub use finding::{Bounds, Finding, law};
pub use frame::{Contact, Event, Evolution, Frame, State, Status};
pub use judge::Judge;
pub use scene::{Scene, Surface, centroid, size};
pub use survey::{LawSurvey, Survey, Violation};
pub use trace::Trace;
