//! The slow reference on a random scene: as frames that the laws can judge, and compared with a run of the solver.

use super::laws::Laws;
use super::run::{Contact, Frame, Run};
use super::scene::Among;
use super::shape::{outward, placed, sub};
use super::worlds::world;
use crate::number::Number;
use crate::reference::{ContactForce, Reference, Touch};
use stiction_core::{Evolution, Status};

/// The number of substeps per frame for the hand of the reference.
const SUBSTEPS: usize = 20;
/// Poses that differ by more than this are different, in body sizes and rad.
const SAME: f64 = 1e-3;

/// How well a run of the solver and one of the reference agree.
#[derive(Clone, Debug, Default)]
pub struct Comparison {
    /// Frames that were compared: all those before the reference gives up.
    pub frames: usize,
    /// Frames with the same contacts.
    pub contacts: usize,
    /// Frames with any contact, and those of them with the same contacts.
    pub touching: [usize; 2],
    /// Frames with the same contacts and the same pose.
    pub poses: usize,
    /// The first frame with different contacts, and both lists.
    pub first_other: Option<(usize, [Vec<Touch>; 2])>,
    /// The first frame in which the reference breaks a law of f64, with the law and the amount.
    pub unlawful: Option<(usize, &'static str, f64)>,
    /// The frame at which the reference reports that it has no answer.
    pub gave_up: Option<usize>,
}

/// The answer of the reference, as a frame.
pub fn frame_of(among: &Among, body: &Reference, hand: [f64; 3]) -> Frame {
    let setup = &among.setup;
    let pose = body.pose();
    let grip = setup.world(pose, setup.holding_point.unwrap_or_default());
    let force = sub([hand[0], hand[1]], grip).map(|x| setup.stiffness_translation * x);
    let shape = placed(&setup.vertices, pose);
    let contact = |c: &ContactForce| {
        let (point, direction) = match c.touch {
            Touch::Surface { vertex, surface } => {
                let [x, y] = setup.surfaces[surface].normal;
                (shape[vertex], [x, y].map(|n| n / x.hypot(y)))
            }
            Touch::Side {
                vertex,
                obstacle,
                side,
            } => {
                let normal = outward(&among.obstacles[obstacle].vertices, side);
                (shape[vertex], normal)
            }
            Touch::Corner {
                obstacle,
                corner,
                body_side,
            } => {
                let point = among.obstacles[obstacle].vertices[corner];
                (point, outward(&shape, body_side).map(|x| -x))
            }
        };
        Contact {
            touch: c.touch,
            point,
            direction,
            normal: c.normal,
            friction: c.friction,
            sliding: c.slides,
        }
    };
    Frame {
        hand,
        held: true,
        pose,
        state: body.state(),
        contacts: body.contacts().iter().map(contact).collect(),
        unequal: false,
        wrench: [
            force[0],
            force[1],
            setup.stiffness_rotation * (hand[2] - pose[2]),
        ],
        slips: body.slips(),
        events: Vec::new(),
        status: Status::Ok,
        work: 0,
    }
}

/// Runs a scene with both.
pub fn compare<R: Number>(number: u64, evolution: Evolution) -> Comparison {
    let world = world(number);
    let among = &world.among;
    let laws = Laws::new::<f64>(among);
    let size = among.setup.size();
    let hands = world.hands();
    let mut body = Reference::new(among.reference(), among.setup.start, hands[0]);
    let mut run = Run::<R>::start(among, evolution, hands[0]);
    let mut sum = Comparison::default();
    for (i, &hand) in hands.iter().enumerate() {
        if i > 0 {
            body.step(hand, SUBSTEPS);
            run.step(hand);
        }
        if body.ambiguous() || body.skipped() {
            sum.gave_up = Some(i);
            break;
        }
        let frame = frame_of(among, &body, hand);
        if sum.unlawful.is_none() {
            let broken = laws.broken(&frame);
            sum.unlawful = broken.first().map(|f| (i, f.law, f.amount));
        }
        let touches = [&run.frame, &frame].map(Frame::touches);
        let same = touches[0] == touches[1];
        let [x, y, turn] = [0, 1, 2].map(|k| (run.frame.pose[k] - frame.pose[k]).abs());
        let near = (x.max(y) / size).max(turn) <= SAME;
        sum.frames += 1;
        sum.contacts += usize::from(same);
        sum.poses += usize::from(same && near);
        if !touches[1].is_empty() {
            sum.touching[0] += 1;
            sum.touching[1] += usize::from(same);
        }
        if !same && sum.first_other.is_none() {
            sum.first_other = Some((i, touches));
        }
    }
    sum
}
