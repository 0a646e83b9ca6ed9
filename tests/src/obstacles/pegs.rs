//! Pegs that are inserted into a hole from random starts, and the outcome of each insertion.

use super::{Among, Obstacle, Run};
use crate::draw::Draw;
use crate::number::Number;
use crate::run::polyline;
use crate::setup::Setup;
use stiction_core::Evolution;
use stiction_judge::Frame;
use stiction_judge::insertion::{Meter, Reaction, Verdict};

/// Frames of an insertion.
pub const FRAMES: usize = 400;
/// The clearance, relative to the hole's width.
pub const CLEARANCE: f64 = 1e-3;
/// The peg's width and height (m), and the depth of the bevelled hole below its mouth.
const PEG: [f64; 2] = [0.02, 0.07];
const DEEP: f64 = 0.047;
/// Height and width of the bevel (m).
const BEVEL: f64 = 0.003;

/// An insertion: a peg above a hole, and the hand's path.
#[derive(Clone, Debug)]
pub struct Insertion {
    /// The scene.
    pub among: Among,
    /// Its meter.
    pub meter: Meter,
    /// x, y (m), phi (rad) of the hand where it begins, and where it ends after a straight way.
    pub ends: [[f64; 3]; 2],
}

/// The outcome of an insertion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// The peg is at the bottom.
    In,
    /// The peg is in the hole, in a condition that the meter names.
    Stopped(Verdict),
    /// The peg is not in the hole.
    Outside,
}

impl End {
    /// A description.
    pub fn name(self) -> &'static str {
        match self {
            Self::In => "in",
            Self::Stopped(verdict) => verdict.name(),
            Self::Outside => "outside",
        }
    }
}

impl Insertion {
    /// The insertion with this number: the hand starts up to 2.5 mm off the hole's axis and 50 mrad askew, mu_s is 0.05 to 0.6,
    /// and the springs vary over a wide range; the hand goes straight down until the unloaded peg would be 2 mm below the bottom.
    pub fn of(number: u64) -> Self {
        let draw = &mut Draw::new(0x9E60_0000 + number);
        let [x, phi] = [draw.between(-0.0025, 0.0025), draw.between(-0.05, 0.05)];
        let mu = draw.power(-1.3, -0.2);
        let friction = [mu, mu * draw.one(&[1.0, 0.9, 0.7])];
        let [k_h, grip] = [draw.power(2.5, 4.0), draw.between(-0.03, 0.03)];
        let k_theta = k_h * draw.power(-4.0, -2.5);
        let half = 0.5 * PEG[0] / (1.0 - CLEARANCE);
        let wall = |side: f64| {
            let corners = [
                [0.05, -0.05],
                [0.05, 0.0],
                [half + BEVEL, 0.0],
                [half, -BEVEL],
                [half, -0.05],
            ];
            let mut corners = corners.map(|[x, y]| [side * x, y]).to_vec();
            if side < 0.0 {
                corners.reverse();
            }
            corners
        };
        let bottom = vec![
            [-0.05, -0.065],
            [0.05, -0.065],
            [0.05, -0.05],
            [-0.05, -0.05],
        ];
        let obstacle = |vertices| Obstacle { vertices, friction };
        let obstacles = [wall(-1.0), wall(1.0), bottom].map(obstacle).to_vec();
        // Body frame: the origin in the middle of the tip.
        let setup = Setup::block(PEG[0], PEG[1])
            .at([x, 0.002, phi])
            .held_at([0.0, 0.5 * PEG[1] + grip])
            .springs(k_h, k_theta);
        let [x, y] = setup.grip();
        let down = BEVEL + DEEP + 0.004;
        let among = Among { setup, obstacles };
        Self {
            meter: meter(&among),
            among,
            ends: [[x, y, phi], [x, y - down, phi]],
        }
    }

    /// x, y (m), phi (rad) of the hand in each of so many equal frames, and before the first.
    pub fn hands(&self, frames: usize) -> Vec<[f64; 3]> {
        polyline(&self.ends, frames)
    }

    /// The slips of an insertion in so many frames, along the path.
    pub fn slips<R: Number>(&self, frames: usize) -> u32 {
        let hands = self.hands(frames);
        let mut run = Run::<R>::start(&self.among, Evolution::Path, hands[0]);
        hands[1..].iter().map(|&hand| run.step(hand).slips).sum()
    }

    /// The outcome in a number type.
    pub fn end<R: Number>(&self, evolution: Evolution) -> End {
        let hands = self.hands(FRAMES);
        let mut run = Run::<R>::start(&self.among, evolution, hands[0]);
        for &hand in &hands[1..] {
            run.step(hand);
        }
        self.judged(&run.frame)
    }

    /// The outcome according to this frame.
    pub fn judged(&self, frame: &Frame) -> End {
        let contacts: Vec<Reaction> = (frame.contacts.iter())
            .map(|contact| Reaction {
                point: contact.point,
                direction: contact.direction.expect("the direction of a contact"),
                normal: contact.normal,
                friction: contact.friction,
            })
            .collect();
        match self.meter.read(frame.pose, &contacts) {
            // Within a thousandth of the peg's height, because a leaning peg stands on one end of its tip.
            Some(found) if found.depth >= DEEP - 1e-3 * PEG[1] => End::In,
            Some(found) => End::Stopped(found.verdict),
            None => End::Outside,
        }
    }
}

fn meter(among: &Among) -> Meter {
    Meter::find(&among.judged::<f64>()).unwrap_or_else(|| panic!("no peg and hole: {among:?}"))
}
