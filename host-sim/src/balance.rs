//! The balance of forces and moments on the body, recomputed from recorded frames: the hand's spring, the reactions of the
//! contacts and the weight (N, N·m, world frame), and the remainders of their sums.

// Those of libm have the same bits on every machine.
use libm::{hypot, sincos};
use stiction_judge::{centroid, size};
use stiction_scene::WrittenScene;

use stiction_live::record::Frame;

/// The imbalance of forces (N) and moments (N·m).
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Imbalance {
    pub(crate) force: f64,
    pub(crate) moment: f64,
}

/// The worst imbalance of a run, and its largest force.
#[derive(Clone, Debug)]
pub(crate) struct Residual {
    scene: WrittenScene,
    centroid: [f64; 2],
    /// Largest distance between two vertices (m), 1 for a point.
    size: f64,
    largest_force: f64,
    worst: Imbalance,
}

impl Residual {
    pub(crate) fn new(scene: &WrittenScene) -> Self {
        Self {
            scene: scene.clone(),
            centroid: centroid(&scene.vertices),
            size: size(&scene.vertices),
            largest_force: 0.0,
            worst: Imbalance::default(),
        }
    }

    pub(crate) fn add(&mut self, frame: &Frame) {
        let (largest, Imbalance { force, moment }) = self.of(frame);
        self.largest_force = self.largest_force.max(largest);
        self.worst.force = self.worst.force.max(force);
        self.worst.moment = self.worst.moment.max(moment);
    }

    /// The largest force of the run (N).
    pub(crate) fn largest_force(&self) -> f64 {
        self.largest_force
    }

    /// Force imbalance relative to the largest force, moment imbalance relative to that force times the body size. For a lightly
    /// loaded body, the reference is the force at which its spring yields by a thousandth of its size.
    pub(crate) fn relative(&self) -> Imbalance {
        let least = 1e-3 * self.scene.stiffness_translation * self.size;
        let force = self.largest_force.max(least);
        Imbalance {
            force: self.worst.force / force,
            moment: self.worst.moment / (force * self.size),
        }
    }

    /// The largest force (N) of a frame, and the remainders of the sums: nothing if no hand holds the body.
    fn of(&self, frame: &Frame) -> (f64, Imbalance) {
        let [fx, fy, mut moment] = frame.wrench;
        let grip = frame.holding_point(self.scene.stiffness_translation);
        let mut sum = [fx, fy];
        let mut largest = hypot(fx, fy);
        let mut add = |force: [f64; 2], point: [f64; 2]| {
            sum = [sum[0] + force[0], sum[1] + force[1]];
            moment += cross([point[0] - grip[0], point[1] - grip[1]], force);
            largest = largest.max(hypot(force[0], force[1]));
        };
        for contact in &frame.contacts {
            let [nx, ny] = contact.direction;
            let (normal, friction) = (contact.normal, contact.friction);
            add(
                [normal * nx + friction * ny, normal * ny - friction * nx],
                contact.point,
            );
        }
        let ([x, y, theta], [cx, cy]) = (frame.pose, self.centroid);
        let (sin, cos) = sincos(theta);
        add(
            [0.0, -self.scene.weight],
            [x + cos * cx - sin * cy, y + sin * cx + cos * cy],
        );
        if !frame.held {
            return (largest, Imbalance::default());
        }
        let force = hypot(sum[0], sum[1]);
        (
            largest,
            Imbalance {
                force,
                moment: moment.abs(),
            },
        )
    }
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
