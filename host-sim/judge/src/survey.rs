//! The judge's findings over a whole trace: for every law, on how many frames it was checked, and the worst.

use std::collections::BTreeMap;

use crate::finding::Finding;

/// A law over a trace.
#[derive(Clone, Copy, Debug)]
pub struct LawSurvey {
    /// Frames on which the law applied.
    pub frames: u64,
    /// Frames that broke it.
    pub broken: u64,
    /// The worst finding, and its line.
    pub worst: (Finding, u64),
}

/// A frame that broke a law.
#[derive(Clone, Copy, Debug)]
pub struct Violation {
    /// Its line.
    pub line: u64,
    /// Its time (s).
    pub t: f64,
    /// The worst finding on it.
    pub finding: Finding,
}

/// All laws over a trace.
#[derive(Clone, Debug, Default)]
pub struct Survey {
    /// Frames judged.
    pub frames: u64,
    /// Frames that broke a law.
    pub unlawful: u64,
    /// The results by name of the law.
    pub laws: BTreeMap<&'static str, LawSurvey>,
    /// The worst frames, the worst first.
    pub worst: Vec<Violation>,
    keep: usize,
}

impl Survey {
    /// A survey of a trace that is still to come, which keeps this many of its worst frames.
    pub fn new(keep: usize) -> Self {
        Self {
            keep,
            ..Self::default()
        }
    }

    /// Adds the findings on the frame of a line, at time `t` (s).
    pub fn add(&mut self, line: u64, t: f64, findings: &[Finding]) {
        self.frames += 1;
        for finding in findings {
            let law = self.laws.entry(finding.law).or_insert(LawSurvey {
                frames: 0,
                broken: 0,
                worst: (*finding, line),
            });
            law.frames += 1;
            law.broken += u64::from(!finding.holds());
            if finding.severity() > law.worst.0.severity() {
                law.worst = (*finding, line);
            }
        }
        let gravest = (findings.iter()).max_by(|a, b| a.severity().total_cmp(&b.severity()));
        let Some(finding) = gravest.filter(|finding| !finding.holds()) else {
            return;
        };
        self.unlawful += 1;
        let place =
            (self.worst).partition_point(|known| known.finding.severity() >= finding.severity());
        if place < self.keep {
            self.worst.truncate(self.keep - 1);
            let finding = *finding;
            self.worst.insert(place, Violation { line, t, finding });
        }
    }

    /// Whether no frame broke a law.
    pub fn is_lawful(&self) -> bool {
        self.unlawful == 0
    }
}
