//! Scenes among obstacles with corners: convex polygons, thin walls, pins. A scene and its runs in any number type, the cases with
//! known answers, the judge on single frames, random scenes, closed rooms, and pegs in holes. SI units, world frame, unless stated
//! otherwise.

pub mod answers;
pub mod cases;
pub mod floors;
pub mod guard;
pub mod judged;
pub mod laws;
pub mod mirrored;
pub mod pegs;
pub mod rooms;
pub mod run;
pub mod scene;
pub mod shape;
pub mod survey;
pub mod worlds;

pub use run::Run;
pub use scene::{Among, Obstacle};
