//! Random scenes under the laws: which frames break one, and which statuses occur.

use super::laws::{Laws, STAYS};
use super::rooms::room;
use super::run::{Run, touches};
use super::worlds::{World, world};
use crate::number::Number;
use std::collections::BTreeMap;
use stiction_core::Evolution;
use stiction_judge::{Finding, Frame, Status, Touch};

/// The kind of random scenes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Ordinary use among obstacles.
    Worlds,
    /// Jumps in closed rooms.
    Rooms,
}

impl Kind {
    /// The scene with this number, for a number type.
    pub fn scene<R: Number>(self, number: u64) -> World {
        match self {
            Self::Worlds => world(number),
            Self::Rooms => room(number, R::FARTHEST),
        }
    }
}

/// The results of a scene.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// The frames that break laws.
    pub unlawful: Vec<(usize, Vec<Finding>)>,
    /// Frames by status, except `ok`.
    pub statuses: BTreeMap<&'static str, usize>,
}

/// `edge VC`: state, vertices on sides (V), corners on sides of the body (C), vertices on half-planes (H).
pub fn kind(frame: &Frame) -> String {
    let letter = |touch: Touch| match touch {
        Touch::Surface { .. } => 'H',
        Touch::Side { .. } => 'V',
        Touch::Corner { .. } => 'C',
    };
    let letters: String = touches(frame).into_iter().map(letter).collect();
    format!("{} {letters}", frame.state.name())
}

/// A scene of a kind in an evolution.
type Look = fn((Kind, u64), Evolution) -> Report;

/// The solvers among obstacles are compiled with this crate, as those of [`crate::run::COMPILED`].
pub static COMPILED: [Look; 3] = [look::<f64>, look::<f32>, look::<stiction_core::Fixed>];

/// Runs a scene.
pub fn look<R: Number>((scenes, number): (Kind, u64), evolution: Evolution) -> Report {
    let world = scenes.scene::<R>(number);
    let laws = Laws::new::<R>(&world.among);
    let hands = world.hands();
    let mut report = Report::default();
    let mut run = Run::<R>::start(&world.among, evolution, hands[0]);
    for (i, &hand) in hands.iter().enumerate() {
        if i > 0 {
            run.step(hand);
        }
        let frame = &run.frame;
        if frame.status != Status::Ok {
            *report.statuses.entry(frame.status.name()).or_default() += 1;
        }
        let broken = laws.broken_in(world.room.as_deref(), frame);
        let has_left = broken.iter().any(|finding| finding.law == STAYS);
        if !broken.is_empty() {
            report.unlawful.push((i, broken));
        }
        if has_left {
            break;
        }
    }
    report
}
