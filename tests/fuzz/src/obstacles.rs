//! Bytes as obstacles, a body among them and a hand's path, and the properties of every frame in every number type: geometry and
//! statics of the frame alone, and the same bits when it is repeated.

use crate::case::{Case, friction};
use crate::clamp;
use crate::draw::Draw;
use std::f64::consts::TAU;
use stiction_core::Fixed;
use stiction_judge::{Contact, Frame};
use stiction_tests::Number;
use stiction_tests::laws::law::{CONE, FORCES, MOMENTS, NAME, ON_SURFACE, ONCE, OUTSIDE, PUSH};
use stiction_tests::obstacles::laws::Laws;
use stiction_tests::obstacles::shape::{Point, dot, placed};
use stiction_tests::obstacles::{Among, Obstacle, Run};
use stiction_tests::run::planar;

/// # Panics
/// If a property is violated.
pub fn obstacles(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let pieces: Vec<_> = (0..1 + draw.byte() % 4)
        .map(|_| Piece::read(&mut draw))
        .collect();
    let Some(case) = Case::read(draw) else {
        return;
    };
    let obstacles = pieces.iter().map(|piece| piece.beside(&case)).collect();
    let mut setup = case.setup.clone();
    // The laws of single frames do not know where a hand has grasped the body.
    setup.holding_point.get_or_insert_default();
    let among = Among { setup, obstacles };
    follow::<f32>(&among, &case);
    follow::<Fixed>(&among, &case);
    follow::<f64>(&among, &case);
}

/// Closer obstacles count as touched at the start (L).
const STARTS_AT: f64 = 1e-5;
/// A body that starts close to several obstacles is placed onto one while it moves along another, at an angle of 6
/// degrees or more: it moves up to this many times as far.
const PUT: f64 = 10.0;

/// All frames of a case; none if its scene is refused.
fn follow<R: Number>(among: &Among, case: &Case) {
    let Ok(scene) = among.scene::<R>() else {
        return;
    };
    let laws = Laws::new::<R>(among);
    let near = STARTS_AT * among.setup.size();
    let starts_at_something = among.depth(among.setup.start) > -near;
    let put = if starts_at_something {
        PUT * STARTS_AT
    } else {
        0.0
    };
    let mut run = Run::<R>::of(scene, case.evolution, planar::<R>(case.home.0));
    let mut is_clamped = clamps::<R>(among, &run.frame);
    for (to, _) in case.hands() {
        let (before, last) = (run.state.clone(), run.frame.clone());
        let next = run.step(to).clone();
        run.state = before;
        assert_eq!(next, *run.step(to), "the same bits again");
        is_clamped = clamps::<R>(among, &next) || (is_clamped && next.contacts.len() > 1);
        let mut broken = laws.broken(&next);
        broken.retain(|finding| match finding.law {
            PUSH | CONE | FORCES | MOMENTS => !is_clamped,
            OUTSIDE | ON_SURFACE => finding.residual > put,
            // Known: tests/tests/obstacles/lawful.rs has scenes in which they are broken.
            NAME | ONCE => false,
            _ => true,
        });
        assert!(
            broken.is_empty(),
            "{}: {broken:?}\nbefore: {last:?}\nframe: {next:?}\ncase: {case:?}\namong: {among:?}",
            R::NAME
        );
    }
}

/// Whether reactions of a frame exceed what the number type computes exactly.
fn clamps<R: Number>(among: &Among, frame: &Frame) -> bool {
    let reaction = |c: &Contact| (c.normal, c.friction, among.friction(c.touch)[0]);
    clamp::clamps::<R>(&among.setup, frame.contacts.iter().map(reaction))
}

/// An obstacle, in body sizes, before it is placed.
struct Piece {
    corners: Vec<Point>,
    /// Its direction as seen from the body, and the minimum distance between the two.
    direction: Point,
    clearance: f64,
    /// Its position across that direction.
    across: f64,
    friction: [f64; 2],
}

impl Piece {
    fn read(draw: &mut Draw<'_>) -> Self {
        let count = draw.one_of([4, 4, 2, 1, 3, 4, 5, 2]);
        let (turn, size) = (draw.angle(), draw.one_of([1.0, 0.3, 3.0, 0.1]));
        let flat = draw.one_of([1.0, 0.3, 1.0, 0.05]);
        let corner = |i: u32| {
            let (sin, cos) = (TAU * (f64::from(i) + 0.5) / f64::from(count)).sin_cos();
            let (x, y) = (size * cos, size * flat * sin);
            let (sin, cos) = turn.sin_cos();
            [cos * x - sin * y, sin * x + cos * y]
        };
        let corners = (0..count).map(corner).collect();
        let (sin, cos) = draw.angle().sin_cos();
        let clearance = if draw.flag() { draw.part() } else { 0.0 };
        Self {
            corners,
            direction: [cos, sin],
            clearance,
            across: draw.place(),
            friction: friction(draw),
        }
    }

    /// The obstacle, placed next to the body at its start.
    fn beside(&self, case: &Case) -> Obstacle {
        let setup = &case.setup;
        let (l, toward) = (setup.size(), self.direction);
        let body = placed(&setup.vertices, setup.start);
        let along = |points: &[Point]| points.iter().map(|&p| dot(toward, p)).collect::<Vec<_>>();
        let farthest = along(&body).into_iter().fold(f64::NEG_INFINITY, f64::max);
        let nearest = along(&self.corners)
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        let far = farthest + l * (self.clearance - nearest);
        let place = |&[x, y]: &Point| {
            [
                l * x + far * toward[0] - l * self.across * toward[1],
                l * y + far * toward[1] + l * self.across * toward[0],
            ]
        };
        Obstacle {
            vertices: self.corners.iter().map(place).collect(),
            friction: self.friction,
        }
    }
}
