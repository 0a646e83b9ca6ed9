//! The slow reference on a random scene: as frames that the laws can judge, and compared with a run of the solver.

use super::laws::Laws;
use super::run::{Run, touches};
use super::shape::{Point, outward, placed};
use super::worlds::world;
use crate::number::Number;
use crate::reference::{ContactForce, Reference, Scene};
use stiction_core::Evolution;
use stiction_judge::{Contact, Frame, State, Status, Touch};

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

/// Point and normal of a contact of the reference.
fn place(scene: &Scene, pose: [f64; 3], touch: Touch) -> (Point, Point) {
    let body = placed(&scene.vertices, pose);
    match touch {
        Touch::Surface { vertex, surface } => (body[vertex], scene.surfaces[surface].normal),
        Touch::Side {
            vertex,
            obstacle,
            side,
        } => {
            let normal = outward(&scene.obstacles[obstacle].vertices, side);
            (body[vertex], normal)
        }
        Touch::Corner {
            obstacle,
            corner,
            body_side,
        } => {
            let point = scene.obstacles[obstacle].vertices[corner];
            (point, outward(&body, body_side).map(|x| -x))
        }
    }
}

/// The answer of the reference as a frame for the judge, without the names of its events.
pub fn frame_of(scene: &Scene, body: &Reference, (t, hand): (f64, [f64; 3])) -> Frame {
    let pose = body.pose();
    let grip = placed(&[scene.holding_point], pose)[0];
    let contact = |force: &ContactForce| {
        let (point, direction) = place(scene, pose, force.touch);
        Contact {
            touch: force.touch,
            point,
            direction: Some(direction),
            normal: force.normal,
            friction: force.friction,
            sliding: Some(force.slides),
        }
    };
    Frame {
        t,
        hand,
        held: true,
        pose,
        depth: 0.0,
        state: named(body.state()),
        contacts: body.contacts().iter().map(contact).collect(),
        complete: true,
        wrench: [
            scene.k_h * (hand[0] - grip[0]),
            scene.k_h * (hand[1] - grip[1]),
            scene.k_theta * (hand[2] - pose[2]),
        ],
        slips: body.slips(),
        events: Vec::new(),
        status: if body.ambiguous() {
            Status::Ambiguous
        } else if body.skipped() {
            Status::EventLimit
        } else {
            Status::Ok
        },
        behind: None,
    }
}

/// The state of this name.
fn named(name: &str) -> State {
    let state = State::ALL.into_iter().find(|state| state.name() == name);
    state.unwrap_or_else(|| panic!("the judge does not know {name:?}"))
}

/// Runs a scene with both.
pub fn compare<R: Number>(number: u64, evolution: Evolution) -> Comparison {
    let world = world(number);
    let among = &world.among;
    let laws = Laws::new::<f64>(among);
    let size = among.setup.size();
    let hands = world.hands();
    let scene = among.reference();
    let mut body = Reference::new(scene.clone(), among.setup.start, hands[0]);
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
        let frame = frame_of(&scene, &body, (0.0, hand));
        if sum.unlawful.is_none() {
            let broken = laws.broken(&frame);
            sum.unlawful = broken.first().map(|f| (i, f.law, f.severity()));
        }
        let touches = [&run.frame, &frame].map(touches);
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
