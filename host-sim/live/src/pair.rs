//! The chosen solver and the f64 path reference, driven by the same hand: poses, counters, slips, and the deviation between the
//! two.

use std::sync::Arc;

use serde::Serialize;
use stiction_core::{Hand, Present};
use stiction_judge::insertion::Meter;
use web_time::Instant;

use crate::body::{Body, Setting};
use crate::counts::Counts;
use crate::meter;
use crate::record::Frame;
use crate::step_times::StepTimes;

/// Number of newest slips that are shown.
const SLIPS: usize = 32;

/// The place where a slip ended.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct SlipMark {
    /// Number of slips, including this one.
    pub n: u64,
    /// Time (s).
    pub t: f64,
    /// Contact point (m).
    pub point: [f64; 2],
    /// The unit normal there.
    pub direction: [f64; 2],
    /// Longest slip of the tick (m).
    pub length: f64,
}

/// The comparison of the solver with the reference.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Comparison {
    /// Pose of the reference: x, y (m), theta (rad).
    pub pose: [f64; 3],
    /// Name of its contact state.
    pub state: &'static str,
    /// Present deviation of the body's origin (m) and of the angle (rad).
    pub error: [f64; 2],
    /// Largest deviations since the comparison began.
    pub worst: [f64; 2],
    /// Ticks in which the states differed.
    pub differ: u64,
    /// Ticks since the comparison began.
    pub since: u64,
}

fn meter_of(setting: &Setting) -> Option<Arc<Meter>> {
    meter::of_scene(&setting.scene).map(Arc::new)
}

/// Two bodies driven by one hand.
pub struct Pair {
    /// Scene, number type and evolution.
    pub setting: Setting,
    body: Box<dyn Body>,
    reference: Box<dyn Body>,
    /// The last record, shared with its viewers.
    pub frame: Arc<Frame>,
    /// The comparison of the two.
    pub comparison: Comparison,
    /// The counters so far.
    pub counts: Counts,
    /// The newest slips.
    pub slips: Arc<[SlipMark]>,
    /// Whitney's meter, if the scene has a peg and a hole.
    pub meter: Option<Arc<Meter>>,
    /// Point of the contact with the largest N, and its normal.
    foot: [[f64; 2]; 2],
}

impl Pair {
    /// Starts both.
    ///
    /// # Errors
    /// The scene cannot be used in this number type.
    pub fn start(setting: &Setting, t: f64, hand: &Hand<f64>) -> Result<Self, String> {
        let body = setting.start(hand)?;
        let reference = setting.reference().start(hand)?;
        let mut pair = Self {
            setting: setting.clone(),
            frame: Arc::new(body.frame(t)),
            body,
            reference,
            comparison: Comparison::default(),
            counts: Counts::default(),
            slips: Arc::default(),
            meter: meter_of(setting),
            foot: [[0.0; 2]; 2],
        };
        pair.counts.add(None, &Arc::clone(&pair.frame));
        pair.look(false);
        Ok(pair)
    }

    /// Moves the hand to a pose; both follow.
    pub fn step(&mut self, t: f64, hand: &Hand<f64>, times: &mut StepTimes) {
        let begun = Instant::now();
        self.body.step(hand);
        times.add(begun.elapsed());
        self.reference.step(hand);
        self.counts.ticks += 1;
        self.show(self.body.frame(t));
        self.look(true);
    }

    /// Takes a board's answer to the sample `hand`: the body is the board's, and the reference follows the same hand.
    pub fn answered(&mut self, frame: Frame, body: Box<dyn Body>, hand: &Hand<f64>) {
        self.reference.step(hand);
        self.body = body;
        self.counts.ticks += 1;
        self.show(frame);
        self.look(true);
    }

    /// Takes another setting of a board, which itself reports where the body is. The comparison restarts from there.
    ///
    /// # Errors
    /// The reference cannot follow: it and the comparison remain unchanged.
    pub fn changed(&mut self, setting: &Setting) -> Result<(), String> {
        self.setting = setting.clone();
        self.meter = meter_of(setting);
        let reference = setting.reference().carry(&self.body.present());
        self.reference = reference
            .map_err(|why| format!("the board has changed, the reference has not: {why}"))?;
        self.comparison = Comparison::default();
        self.look(false);
        Ok(())
    }

    /// Changes parameters, number type or evolution. The comparison restarts, with both bodies at the pose of the solver's
    /// body.
    ///
    /// # Errors
    /// A refused change has no effect.
    pub fn change(&mut self, setting: &Setting) -> Result<(), String> {
        let present = self.body.present();
        let body = setting.carry(&present)?;
        let reference = setting.reference().carry(&present)?;
        self.setting = setting.clone();
        self.meter = meter_of(setting);
        self.body = body;
        self.reference = reference;
        self.show(self.body.frame(self.frame.t));
        self.comparison = Comparison::default();
        self.look(false);
        Ok(())
    }

    /// Returns the present pose and hold of the body.
    pub fn present(&self) -> Present<f64> {
        self.body.present()
    }

    /// Returns a copy of everything.
    pub fn snapshot(&self) -> Self {
        Self {
            setting: self.setting.clone(),
            body: self.body.copy(),
            reference: self.reference.copy(),
            frame: Arc::clone(&self.frame),
            slips: Arc::clone(&self.slips),
            meter: self.meter.clone(),
            ..*self
        }
    }

    fn show(&mut self, frame: Frame) {
        self.counts.add(Some(self.frame.state), &frame);
        let contacts = frame.contacts.iter();
        if let Some(loaded) = contacts.max_by(|a, b| a.normal.total_cmp(&b.normal)) {
            self.foot = [loaded.point, loaded.direction];
        }
        if frame.slips > 0 {
            let mark = SlipMark {
                n: self.counts.slips,
                t: frame.t,
                point: self.foot[0],
                direction: self.foot[1],
                length: frame.longest_slip,
            };
            let beyond = (self.slips.len() + 1).saturating_sub(SLIPS);
            let shown = self.slips.iter().skip(beyond).copied();
            self.slips = shown.chain([mark]).collect();
        }
        self.frame = Arc::new(frame);
    }

    /// Updates the comparison; `counted`: after a tick.
    fn look(&mut self, counted: bool) {
        let reference = self.reference.frame(self.frame.t);
        let ([x, y, theta], [rx, ry, r_theta]) = (self.frame.pose, reference.pose);
        let error = [(x - rx).hypot(y - ry), (theta - r_theta).abs()];
        let last = self.comparison;
        let differs = counted && reference.state != self.frame.state;
        self.comparison = Comparison {
            pose: reference.pose,
            state: reference.state.name(),
            error,
            worst: [0, 1].map(|i| last.worst[i].max(error[i])),
            differ: last.differ + u64::from(differs),
            since: last.since + u64::from(counted),
        };
    }
}
