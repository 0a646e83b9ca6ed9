//! The first frame of a run in which two solvers differ, in one line, and a whole run in words.

use crate::case::Case;
use crate::lawful::{Lawful, verdict};
use crate::subject::Solver;
use std::fmt;
use stiction_judge::{Contact, Frame, Touch};

/// Where a run first differs.
#[derive(Clone, Debug)]
pub struct Difference {
    /// The seed of the run.
    pub seed: u64,
    /// The index of the frame.
    pub frame: usize,
    /// How far the poses are apart (L, rad).
    apart: f64,
    /// The hand in the frame before and in this one (L, rad, from its first pose).
    hands: [[f64; 3]; 2],
    answers: [String; 2],
    verdicts: [String; 2],
}

impl Difference {
    pub(crate) fn new(
        case: &Case,
        (seed, frame): (u64, usize),
        runs: [(Solver, &[Frame]); 2],
    ) -> Self {
        let l = case.among.setup.size();
        let start = case.hands[0];
        let hand = |i: usize| {
            let [x, y, phi] = [0, 1, 2].map(|k| case.hands[i][k] - start[k]);
            [x / l, y / l, phi]
        };
        let verdict = |(solver, frames): (Solver, &[Frame])| {
            let mut lawful = Lawful::new(case, solver);
            let findings = frames[..=frame].iter().map(|frame| lawful.next(frame));
            verdict(&findings.last().unwrap_or_default())
        };
        Self {
            seed,
            frame,
            apart: case.apart(runs[0].1[frame].pose, runs[1].1[frame].pose),
            hands: [hand(frame.saturating_sub(1)), hand(frame)],
            answers: runs.map(|(_, frames)| described(&frames[frame])),
            verdicts: runs.map(verdict),
        }
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([a, b], [x, y]) = (&self.answers, &self.verdicts);
        let pose = |[x, y, phi]: [f64; 3]| format!("{x:.6} {y:.6} {phi:.6}");
        let [from, to] = self.hands.map(pose);
        let (frame, seed, apart) = (self.frame, self.seed, self.apart);
        write!(
            f,
            "frame {frame:5} seed {seed:5} apart {apart:.1e} | {a} [{x}] | {b} [{y}] | hand {from} -> {to}"
        )
    }
}

/// `edge v0/s1+ v3/s1+ slips 2 ok slide,slip`
pub(crate) fn described(frame: &Frame) -> String {
    let contact = |c: &Contact| {
        let sign = match c.sliding {
            Some(1) => "+",
            Some(-1) => "-",
            _ => "",
        };
        format!("{}{sign}", touch(c.touch))
    };
    let contacts: Vec<_> = frame.contacts.iter().map(contact).collect();
    let events: Vec<_> = frame.events.iter().map(|event| event.name()).collect();
    format!(
        "{} {} slips {} {} {}",
        frame.state.name(),
        contacts.join(" "),
        frame.slips,
        frame.status.name(),
        events.join(",")
    )
}

/// Vertex on surface, vertex on side of obstacle, corner of obstacle on side of the body.
fn touch(touch: Touch) -> String {
    match touch {
        Touch::Surface { vertex, surface } => format!("v{vertex}/s{surface}"),
        Touch::Side {
            vertex,
            obstacle,
            side,
        } => format!("v{vertex}/o{obstacle}.{side}"),
        Touch::Corner {
            obstacle,
            corner,
            body_side,
        } => format!("o{obstacle}:{corner}/b{body_side}"),
    }
}

/// Prints frames of one run of each solver, with what each breaks.
pub(crate) fn show(case: &Case, solvers: &[Solver], frames: std::ops::Range<usize>) {
    let start = case.hands[0];
    println!(
        "{}",
        case.among
            .toml(&[[0.0, start[0], start[1], start[2]]], 1000.0)
    );
    let mut runs = Vec::new();
    for &solver in solvers {
        match solver.run(case) {
            Ok(run) => runs.push((solver, Lawful::new(case, solver), run)),
            Err(words) => println!("{}: {words}", solver.name),
        }
    }
    for i in 0..case.hands.len().min(frames.end) {
        let lines = runs.iter_mut().map(|(solver, lawful, run)| {
            let (frame, broken) = (&run[i], lawful.next(&run[i]));
            let [x, y, theta] = frame.pose;
            let forces = frame
                .contacts
                .iter()
                .map(|c| format!("{:.6} {:.6}", c.normal, c.friction));
            let forces: Vec<_> = forces.collect();
            format!(
                "  {:10} {x:+.12} {y:+.12} {theta:+.12} {} N, T {} [{}]",
                solver.name,
                described(frame),
                forces.join("; "),
                verdict(&broken)
            )
        });
        let lines: Vec<_> = lines.collect();
        if i >= frames.start {
            println!("frame {i} hand {:?}\n{}", case.hands[i], lines.join("\n"));
        }
    }
}
