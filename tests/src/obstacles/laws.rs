//! The laws of a single frame among obstacles: those of the judge, and that of a closed room.

use super::rooms::beyond;
use super::scene::Among;
use super::shape::{Point, placed};
use crate::laws::bounds;
use crate::number::Number;
use stiction_judge::{Evolution, Finding, Frame, Judge};

/// The body is in the closed room that it was in.
pub const STAYS: &str = "the body stays in its room";

/// Judges frames of one scene, each alone.
#[derive(Clone, Debug)]
pub struct Laws {
    judge: Judge,
    vertices: Vec<Point>,
    /// How far the body may protrude from its room (m).
    gap: f64,
}

impl Laws {
    /// Laws for a scene in a number type. The scene is not rounded to it, so that sides in one plane stay there; the bounds are far above
    /// such a rounding.
    pub fn new<R: Number>(among: &Among) -> Self {
        let scene = among.judged::<f64>();
        let corners = scene.obstacles.iter().flat_map(|o| &o.vertices).flatten();
        let farthest = corners.fold(among.setup.size(), |most, x| most.max(x.abs()));
        Self {
            vertices: scene.vertices.clone(),
            gap: R::GAP * farthest,
            judge: Judge::new(scene, bounds::<R>(), Evolution::Path),
        }
    }

    /// The laws that a frame breaks.
    pub fn broken(&self, frame: &Frame) -> Vec<Finding> {
        let findings = self.judge.alone(frame).into_iter();
        findings.filter(|finding| !finding.holds()).collect()
    }

    /// The laws that a frame breaks if its body is in a closed room.
    pub fn broken_in(&self, room: Option<&[Point]>, frame: &Frame) -> Vec<Finding> {
        let mut findings = self.broken(frame);
        let stays = room.map(|cell| Finding {
            law: STAYS,
            residual: beyond(cell, &placed(&self.vertices, frame.pose)),
            bound: self.gap,
        });
        findings.extend(stays.filter(|finding| !finding.holds()));
        findings
    }
}
