//! The report of a run about a peg and its hole: depth, force, position of the two-point contact, number of jammed and wedged
//! frames.

use std::fmt;

use stiction_judge::insertion::{Insertion, Meter, Verdict};

use stiction_live::meter;
use stiction_live::record::Frame;

/// For a run whose scene has a meter.
#[derive(Clone, Debug)]
pub(super) struct Insertions {
    meter: Meter,
    frames: u64,
    /// l (m)
    deepest: f64,
    /// F_z (N), l (m) and t (s).
    largest: Option<(f64, f64, f64)>,
    /// l (m) and t (s) of the first frame with both walls.
    two_points: Option<(f64, f64)>,
    jammed: u64,
    wedged: u64,
    /// Margin, l (m) and t (s).
    least: Option<(f64, f64, f64)>,
}

impl Insertions {
    pub(super) fn new(meter: Meter) -> Self {
        Self {
            meter,
            frames: 0,
            deepest: 0.0,
            largest: None,
            two_points: None,
            jammed: 0,
            wedged: 0,
            least: None,
        }
    }

    pub(super) fn add(&mut self, frame: &Frame) {
        if let Some(found) = meter::read(&self.meter, frame) {
            self.reading(&found, frame);
        }
    }

    fn reading(&mut self, found: &Insertion, frame: &Frame) {
        let (l, t) = (found.depth, frame.t);
        self.frames += 1;
        self.deepest = self.deepest.max(l);
        if found.fz > self.largest.map_or(0.0, |(fz, ..)| fz) {
            self.largest = Some((found.fz, l, t));
        }
        if found.walls == 2 {
            self.two_points.get_or_insert((l, t));
        }
        self.jammed += u64::from(found.verdict == Verdict::Jammed);
        self.wedged += u64::from(found.verdict == Verdict::Wedged);
        if let Some(margin) = found.margin
            && self.least.is_none_or(|(least, ..)| margin < least)
        {
            self.least = Some((margin, l, t));
        }
    }
}

impl fmt::Display for Insertions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mm = |metres: f64| 1e3 * metres;
        let clearance = self.meter.clearance();
        if self.frames == 0 {
            return writeln!(
                f,
                "  {:<18}{:>10}   the peg is never in its hole",
                "insertion", "none"
            );
        }
        writeln!(
            f,
            "  {:<18}{:>10.3} mm, clearance {clearance:.1e} of the hole's width",
            "deepest insertion",
            mm(self.deepest)
        )?;
        if let Some((fz, l, t)) = self.largest {
            writeln!(
                f,
                "  {:<18}{fz:>10.4} N   at {:.3} mm, t = {t} s",
                "largest F_z",
                mm(l)
            )?;
        }
        match self.two_points {
            Some((l, t)) => writeln!(
                f,
                "  {:<18}{:>10.3} mm, t = {t} s",
                "first two points",
                mm(l)
            )?,
            None => writeln!(f, "  {:<18}{:>10}", "first two points", "none")?,
        }
        let (jammed, wedged) = (self.jammed, self.wedged);
        writeln!(
            f,
            "  {:<18}{jammed:>10}   wedged {wedged}, of {} in the hole",
            "frames jammed", self.frames
        )?;
        if let Some((margin, l, t)) = self.least {
            writeln!(
                f,
                "  {:<18}{margin:>10.3}   at {:.3} mm, t = {t} s",
                "least margin",
                mm(l)
            )?;
        }
        Ok(())
    }
}
