//! The message of a frame: the newest record, and a strip of the forces since the one before.

use std::sync::Arc;

use serde::Serialize;
use serde_json::Number as JsonNumber;

use super::{Fares, text};
use crate::counts::Counts;
use crate::feed::{Latest, Shown};
use crate::free::Springs;
use crate::meter;
use crate::pair::{Comparison, SlipMark};
use crate::record::Frame;
use crate::trace::Record;

/// Largest number of ticks in a strip.
const STRIP: usize = 64;

#[derive(Serialize)]
struct FrameMessage<'a> {
    r#type: &'static str,
    tick: u64,
    skipped: u64,
    frame: Record<'a>,
    holding: Option<[f64; 2]>,
    ghost: Option<[f64; 3]>,
    /// F_z by the formulas for small angles, while a peg is in its hole.
    #[serde(skip_serializing_if = "Option::is_none")]
    small_angles: Option<Formulas>,
    echo: Option<&'a JsonNumber>,
    reference: &'a Comparison,
    counts: &'a Counts,
    slips: &'a [SlipMark],
    strip: Vec<Vec<f64>>,
    step: StepTime,
    board: Option<Fares>,
    position: Option<f64>,
}

/// F_z (N) of one-point and of two-point contact.
#[derive(Serialize)]
struct Formulas {
    one_point: Option<f64>,
    two_points: Option<f64>,
}

impl Formulas {
    fn of(latest: &Latest) -> Option<Self> {
        let (meter, frame, scene) = (latest.meter.as_deref()?, &latest.frame, &latest.scene);
        let depth = meter::read(meter, frame)?.depth;
        let springs = [scene.stiffness_translation, scene.stiffness_rotation];
        let small = meter::small_angles(meter, depth, frame, springs);
        Some(Self {
            one_point: small.one_point,
            two_points: small.two_points,
        })
    }
}

#[derive(Serialize)]
struct StepTime {
    /// None from a board, which reports only the worst one.
    median: Option<f64>,
    worst: Option<f64>,
}

impl StepTime {
    fn of(latest: &Latest) -> Self {
        let [median, worst] = match (latest.step, latest.board) {
            (Some(times), _) => times.map(|time| Some(time.into())),
            (None, board) => [None, board.and_then(|board| board.worst_step)],
        };
        Self { median, worst }
    }
}

/// The newest record with the records before it, for one client.
#[derive(Debug)]
pub struct News {
    latest: Latest,
    since: Vec<Arc<Frame>>,
}

impl News {
    /// Returns the records since `next`, and advances `next` to the number of the next one to come.
    pub fn since(shown: &Shown, next: &mut u64) -> Option<Self> {
        let latest = shown.latest.clone()?;
        let (records, now) = shown.since(*next);
        *next = now;
        let count = records.len();
        let every = count.div_ceil(STRIP).max(1);
        // The last one is always included.
        let from = (count + every - 1) % every;
        let since = records.skip(from).step_by(every).cloned().collect();
        Some(Self { latest, since })
    }

    /// Returns the message for a client that lost `skipped` frames.
    pub fn message(&self, client: u32, skipped: u64) -> String {
        let latest = &self.latest;
        let scene = &latest.scene;
        let (meter, single) = (latest.meter.as_deref(), latest.number.is_single());
        let springs = Springs::of(scene, &latest.frame);
        let echo = latest.echo.as_ref().filter(|(to, _)| *to == client);
        let strip = self
            .since
            .iter()
            .map(|frame| strip(frame, [scene.surfaces.len(), scene.obstacles.len()]));
        text(&FrameMessage {
            r#type: "frame",
            tick: latest.tick,
            skipped,
            frame: Record::new(&latest.frame, scene, meter, single),
            holding: springs.holding,
            ghost: springs.ghost,
            small_angles: Formulas::of(latest),
            echo: echo.map(|(_, sent)| sent),
            reference: &latest.reference,
            counts: &latest.counts,
            slips: &latest.slips,
            strip: strip.collect(),
            step: StepTime::of(latest),
            board: latest.board,
            position: latest.position,
        })
    }
}

/// Returns t, and N and T of every surface and every obstacle.
fn strip(frame: &Frame, [surfaces, obstacles]: [usize; 2]) -> Vec<f64> {
    let mut row = vec![0.0; 1 + 2 * (surfaces + obstacles)];
    row[0] = frame.t;
    for contact in &frame.contacts {
        let of_obstacle = contact.touch.obstacle().map(|k| surfaces + k);
        let Some(solid) = contact.touch.surface().or(of_obstacle) else {
            continue;
        };
        let place = 1 + 2 * solid;
        if let Some([normal, friction]) = row.get_mut(place..place + 2) {
            *normal += contact.normal;
            *friction += contact.friction;
        }
    }
    row
}
