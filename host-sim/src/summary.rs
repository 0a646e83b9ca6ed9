//! The summary of a run: time in each state, slips, the largest force, the worst residual of the balance, what limited
//! the answers, and the time that the solver took.

use std::collections::BTreeMap;
use std::fmt;
use std::time::Duration;

use stiction_core::{Evolution, StateKind, Status};

use crate::record::{Frame, Run};

/// What is gathered over the frames of a run.
#[derive(Clone, Debug)]
pub struct Summary {
    title: String,
    balance: Balance,
    frames: u64,
    span: Option<(f64, f64)>,
    seconds: [f64; StateKind::ALL.len()],
    slips: u64,
    longest_slip: f64,
    largest_force: f64,
    imbalance: Imbalance,
    limited: BTreeMap<Status, u64>,
    solver_time: Duration,
}

impl Summary {
    /// Of a run whose frames are still to come.
    pub fn new(run: &Run) -> Self {
        let evolution = match run.evolution {
            Evolution::Path => "path",
            Evolution::Frame => "frame",
        };
        Self {
            title: format!("{} ({}, {evolution})", run.title, run.number.name()),
            balance: Balance::new(run),
            frames: 0,
            span: None,
            seconds: [0.0; StateKind::ALL.len()],
            slips: 0,
            longest_slip: 0.0,
            largest_force: 0.0,
            imbalance: Imbalance::default(),
            limited: BTreeMap::new(),
            solver_time: Duration::ZERO,
        }
    }

    /// Adds a frame; the time since the frame before counts for its state.
    pub fn add(&mut self, frame: &Frame) {
        self.frames += 1;
        let (first, last) = self.span.unwrap_or((frame.t, frame.t));
        self.span = Some((first, frame.t));
        if let Some(k) = StateKind::ALL
            .iter()
            .position(|state| *state == frame.state)
        {
            self.seconds[k] += frame.t - last;
        }
        self.slips += u64::from(frame.slips);
        self.longest_slip = self.longest_slip.max(frame.longest_slip);
        if frame.status != Status::Ok {
            *self.limited.entry(frame.status).or_default() += 1;
        }
        let (largest, imbalance) = self.balance.of(frame);
        self.largest_force = self.largest_force.max(largest);
        self.imbalance.force = self.imbalance.force.max(imbalance.force);
        self.imbalance.moment = self.imbalance.moment.max(imbalance.moment);
    }

    /// Sets the time that all steps of the solver took together.
    pub fn set_solver_time(&mut self, time: Duration) {
        self.solver_time = time;
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (first, last) = self.span.unwrap_or_default();
        let duration = last - first;
        writeln!(f, "{}", self.title)?;
        writeln!(
            f,
            "  {:<18}{:>10}   over {duration:.3} s",
            "frames", self.frames
        )?;
        for (state, seconds) in StateKind::ALL.iter().zip(self.seconds) {
            if seconds > 0.0 {
                let percent = 100.0 * seconds / duration;
                writeln!(
                    f,
                    "  {:<18}{seconds:>10.3} s {percent:>6.1} %",
                    state.name()
                )?;
            }
        }
        writeln!(
            f,
            "  {:<18}{:>10}   longest {:.3} mm",
            "slips",
            self.slips,
            1e3 * self.longest_slip
        )?;
        writeln!(f, "  {:<18}{:>10.4} N", "largest force", self.largest_force)?;
        let force = self.imbalance.force / self.largest_force.max(f64::MIN_POSITIVE);
        let moment =
            self.imbalance.moment / (self.largest_force * self.balance.size).max(f64::MIN_POSITIVE);
        writeln!(
            f,
            "  {:<18}{force:>10.1e}   forces, of the largest force",
            "worst residual"
        )?;
        writeln!(
            f,
            "  {:<18}{moment:>10.1e}   moments, of that force times the body size",
            ""
        )?;
        let limited: u64 = self.limited.values().sum();
        let kinds: Vec<String> = (self.limited.iter())
            .map(|(status, count)| format!("{} {count}", status.name()))
            .collect();
        writeln!(
            f,
            "  {:<18}{limited:>10}   {}",
            "frames not ok",
            kinds.join(", ")
        )?;
        let nanoseconds = self.solver_time.as_secs_f64() * 1e9 / self.frames.max(1) as f64;
        writeln!(
            f,
            "  {:<18}{nanoseconds:>10.0} ns per frame, measured around the solver's steps",
            "mean time"
        )
    }
}

/// By how much forces (N) and moments (N·m) miss balance.
#[derive(Clone, Copy, Debug, Default)]
struct Imbalance {
    force: f64,
    moment: f64,
}

/// Balance of forces and moments on the body, recomputed from a frame.
#[derive(Clone, Debug)]
struct Balance {
    stiffness_translation: f64,
    weight: f64,
    centroid: [f64; 2],
    /// Largest distance of two vertices (m), 1 for a point.
    size: f64,
    normals: Vec<[f64; 2]>,
}

impl Balance {
    fn new(run: &Run) -> Self {
        let mut size = 0.0_f64;
        for a in &run.body {
            for b in &run.body {
                size = size.max((a[0] - b[0]).hypot(a[1] - b[1]));
            }
        }
        Self {
            stiffness_translation: run.stiffness_translation,
            weight: run.weight,
            centroid: centroid(&run.body),
            size: if size > 0.0 { size } else { 1.0 },
            normals: run.surfaces.iter().map(|surface| surface.normal).collect(),
        }
    }

    /// The largest force (N) of a frame, and what is left of the sums: nothing where no hand holds the body.
    fn of(&self, frame: &Frame) -> (f64, Imbalance) {
        let [fx, fy, mut moment] = frame.wrench;
        // The holding point: the spring's force is k_h times the way from it to the hand.
        let grip = [
            frame.hand[0] - fx / self.stiffness_translation,
            frame.hand[1] - fy / self.stiffness_translation,
        ];
        let mut sum = [fx, fy];
        let mut largest = fx.hypot(fy);
        let mut add = |force: [f64; 2], point: [f64; 2]| {
            sum = [sum[0] + force[0], sum[1] + force[1]];
            moment += cross([point[0] - grip[0], point[1] - grip[1]], force);
            largest = largest.max(force[0].hypot(force[1]));
        };
        for contact in &frame.contacts {
            let [nx, ny] = self
                .normals
                .get(contact.surface)
                .copied()
                .unwrap_or_default();
            let (normal, friction) = (contact.normal, contact.friction);
            add(
                [normal * nx + friction * ny, normal * ny - friction * nx],
                contact.point,
            );
        }
        let ([x, y, theta], [cx, cy]) = (frame.pose, self.centroid);
        let (sin, cos) = theta.sin_cos();
        add(
            [0.0, -self.weight],
            [x + cos * cx - sin * cy, y + sin * cx + cos * cy],
        );
        if !frame.held {
            return (largest, Imbalance::default());
        }
        let force = sum[0].hypot(sum[1]);
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

/// The centroid of the polygon's area; the mean of the vertices of a point or a rod.
fn centroid(vertices: &[[f64; 2]]) -> [f64; 2] {
    let count = vertices.len();
    let first = vertices.first().copied().unwrap_or_default();
    if count < 3 {
        let last = vertices.last().copied().unwrap_or_default();
        return [
            f64::midpoint(first[0], last[0]),
            f64::midpoint(first[1], last[1]),
        ];
    }
    let from_first = |v: [f64; 2]| [v[0] - first[0], v[1] - first[1]];
    let (mut area, mut sum) = (0.0, [0.0; 2]);
    for pair in vertices.windows(2) {
        let (a, b) = (from_first(pair[0]), from_first(pair[1]));
        let twice = cross(a, b);
        area += twice;
        sum = [
            sum[0] + twice * (a[0] + b[0]),
            sum[1] + twice * (a[1] + b[1]),
        ];
    }
    [
        first[0] + sum[0] / (3.0 * area),
        first[1] + sum[1] / (3.0 * area),
    ]
}
