//! The chosen solver with the f64 path reference beside it, on the same hand: poses, counts, slips, and how far the two are
//! apart.

use std::sync::Arc;
use std::time::Instant;

use serde::Serialize;
use stiction_core::Hand;
use stiction_insertion::Meter;

use super::counts::Counts;
use super::mirror::Mirror;
use super::step_times::StepTimes;
use crate::body::{Body, Present, Setting};
use crate::meter;
use crate::record::Frame;

/// The newest slips that are kept.
const SLIPS: usize = 32;

/// Where a slip ended.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct SlipMark {
    /// How many there were, with this one.
    pub(super) n: u64,
    pub(super) t: f64,
    /// The foot (m).
    pub(super) point: [f64; 2],
    /// The unit normal there, in a scene with obstacles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) direction: Option<[f64; 2]>,
    /// The longest slip of the tick (m).
    pub(super) length: f64,
}

/// The reference beside the solver.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(super) struct Comparison {
    pub(super) pose: [f64; 3],
    pub(super) state: &'static str,
    /// Now: of the body's origin (m), of the angle (rad).
    pub(super) error: [f64; 2],
    /// The worst since then.
    pub(super) worst: [f64; 2],
    /// Ticks in another state.
    pub(super) differ: u64,
    /// Ticks.
    pub(super) since: u64,
}

fn meter_of(setting: &Setting) -> Option<Arc<Meter>> {
    meter::of_scene(&setting.scene).map(Arc::new)
}

/// Two bodies in one hand.
pub(super) struct Pair {
    pub(super) setting: Setting,
    body: Box<dyn Body>,
    reference: Box<dyn Body>,
    /// The last record; shared with those that show it.
    pub(super) frame: Arc<Frame>,
    pub(super) comparison: Comparison,
    pub(super) counts: Counts,
    pub(super) slips: Arc<[SlipMark]>,
    /// Whitney's meter, where the scene has a peg and a hole.
    pub(super) meter: Option<Arc<Meter>>,
    /// Where the contact with the largest N is, and where it faces.
    foot: ([f64; 2], Option<[f64; 2]>),
}

impl Pair {
    /// Both at the start.
    ///
    /// # Errors
    /// The scene cannot be used in this number type.
    pub(super) fn start(setting: &Setting, t: f64, hand: &Hand<f64>) -> Result<Self, String> {
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
            foot: ([0.0; 2], None),
        };
        pair.counts.add(None, &Arc::clone(&pair.frame));
        pair.look(false);
        Ok(pair)
    }

    /// The hand goes to a pose, and both follow.
    pub(super) fn step(&mut self, t: f64, hand: &Hand<f64>, times: &mut StepTimes) {
        let begun = Instant::now();
        self.body.step(hand);
        times.add(begun.elapsed());
        self.reference.step(hand);
        self.counts.ticks += 1;
        self.show(self.body.frame(t));
        self.look(true);
    }

    /// A board's answer to a sample: the body is where the board says, and the reference follows the same hand.
    pub(super) fn answered(&mut self, frame: Frame) {
        let mirror = Mirror::of(&frame, self.body.present(), &self.setting);
        self.reference.step(&mirror.hand);
        self.body = Box::new(mirror);
        self.counts.ticks += 1;
        self.show(frame);
        self.look(true);
    }

    /// A board works under another setting: it says itself where the body is. The comparison begins anew from there.
    ///
    /// # Errors
    /// The reference cannot follow: it and the comparison go on as they were.
    pub(super) fn changed(&mut self, setting: &Setting) -> Result<(), String> {
        self.setting = setting.clone();
        self.meter = meter_of(setting);
        let reference = setting.reference().carry(&self.body.present());
        self.reference = reference.map_err(|why| {
            format!("the board has changed, the reference beside it has not: {why}")
        })?;
        self.comparison = Comparison::default();
        self.look(false);
        Ok(())
    }

    /// Other parameters, another number type or evolution. The comparison begins anew, with both bodies where this one is.
    ///
    /// # Errors
    /// What is refused changes nothing.
    pub(super) fn change(&mut self, setting: &Setting) -> Result<(), String> {
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

    /// Where the body is.
    pub(super) fn present(&self) -> Present {
        self.body.present()
    }

    /// A copy of all of it.
    pub(super) fn snapshot(&self) -> Self {
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

    /// Takes over what the body says.
    fn show(&mut self, frame: Frame) {
        self.counts.add(Some(self.frame.state), &frame);
        let contacts = frame.contacts.iter();
        if let Some(loaded) = contacts.max_by(|a, b| a.normal.total_cmp(&b.normal)) {
            self.foot = (loaded.point, loaded.direction);
        }
        if frame.slips > 0 {
            let mark = SlipMark {
                n: self.counts.slips,
                t: frame.t,
                point: self.foot.0,
                direction: self.foot.1,
                length: frame.longest_slip,
            };
            let beyond = (self.slips.len() + 1).saturating_sub(SLIPS);
            let kept = self.slips.iter().skip(beyond).copied();
            self.slips = kept.chain([mark]).collect();
        }
        self.frame = Arc::new(frame);
    }

    /// How far the two are apart; `counted`: after a tick.
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
