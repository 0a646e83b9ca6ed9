//! The solver driven by a hand, for a program with threads, sockets and files, and for a page without them: computes records
//! from a scene and samples of the hand, and answers from a client's messages.
//!
//! ```text
//! samples ─ session ─ frames                                   (a whole path)
//!
//! messages ─ inbound ─ orders ─ live ─ pair ─ feed ─ outbound ─ messages (tick by tick)
//!                       │        │      └ body: the solver; the f64 path reference
//!                       │        └ guide, holder: the hand; replay: a path of it
//!                       └ change: another setting, another run
//! ```
//!
//! The messages are specified in `host-sim/VIEW.md`. `stiction view` adds boards, recordings and clients; the static page uses
//! this package alone.

pub mod body;
pub mod change;
pub mod counts;
pub mod drawing;
pub mod echo;
pub mod feed;
pub mod free;
pub mod guide;
pub mod holder;
pub mod inbound;
pub mod input;
pub mod live;
pub mod meter;
pub mod number;
pub mod orders;
pub mod outbound;
pub mod own;
pub mod pair;
pub mod record;
pub mod replay;
pub mod scenes;
pub mod script;
pub mod session;
pub mod simulate;
pub mod stage;
pub mod step_times;
pub mod thumbnail;
pub mod trace;
