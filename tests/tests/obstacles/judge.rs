//! Tests of the judge of frames: it accepts the frames of the slow reference, and notices every fault introduced into them.

use stiction_tests::budget;
use stiction_tests::obstacles::compare::frame_of;
use stiction_tests::obstacles::laws::{
    CONE, FINITE, FORCES, Finding, Laws, MOMENTS, NAME, ON_LINE, ON_SIDE, ONCE, OUTSIDE, PAIR,
    PLACE, PUSH, SUPPORTS, WRENCH,
};
use stiction_tests::obstacles::worlds::{World, world};
use stiction_tests::obstacles::{Frame, cases};
use stiction_tests::reference::{Reference, Touch};

const SCENES: u64 = budget(25, 2) as u64;
const SUBSTEPS: usize = 20;

/// The frames of the reference in a random scene, until it gives up.
fn frames(world: &World) -> Vec<Frame> {
    let among = &world.among;
    let hands = world.hands();
    let mut body = Reference::new(among.reference(), among.setup.start, hands[0]);
    let mut frames = vec![frame_of(among, &body, hands[0])];
    for &hand in &hands[1..] {
        body.step(hand, SUBSTEPS);
        if body.ambiguous() || body.skipped() {
            break;
        }
        frames.push(frame_of(among, &body, hand));
    }
    frames
}

#[test]
fn frames_of_the_reference_are_lawful() {
    for number in 0..SCENES {
        let world = world(number);
        let laws = Laws::new::<f64>(&world.among);
        for (i, frame) in frames(&world).iter().enumerate() {
            let broken = laws.broken(frame);
            assert!(broken.is_empty(), "scene {number} frame {i}: {broken:?}");
        }
    }
}

/// A box on a table's edge, with its lower left vertex on the table and the table's corner under its lower side.
fn on_an_edge() -> (Laws, Frame) {
    let mut all = cases::all().into_iter();
    let case = all.find(|case| case.name.starts_with("box on a table"));
    let case = case.expect("the case of a box on a table");
    let body = Reference::new(
        case.among.reference(),
        case.among.setup.start,
        case.hands[0],
    );
    let frame = frame_of(&case.among, &body, case.hands[0]);
    (Laws::new::<f64>(&case.among), frame)
}

#[test]
fn what_is_wrong_is_noticed() {
    let (laws, right) = on_an_edge();
    assert_eq!(laws.broken(&right), []);
    let notices = |law: &str, wrong: fn(&mut Frame)| {
        let mut frame = right.clone();
        wrong(&mut frame);
        let broken: Vec<Finding> = laws.broken(&frame);
        assert!(broken.iter().any(|f| f.law == law), "{law}: {broken:?}");
    };
    notices(FINITE, |frame| frame.contacts[0].normal = f64::NAN);
    notices(OUTSIDE, |frame| frame.pose[1] -= 1e-8);
    notices(ON_LINE, |frame| frame.pose[1] += 1e-8);
    notices(ON_SIDE, |frame| frame.pose[0] += 0.1);
    notices(SUPPORTS, |frame| frame.pose[2] += 0.01);
    notices(PLACE, |frame| frame.contacts[0].direction = [1e-6, 1.0]);
    notices(PLACE, |frame| frame.contacts[0].point[0] += 1e-6);
    notices(ONCE, |frame| {
        frame.contacts[1].touch = frame.contacts[0].touch
    });
    notices(NAME, |frame| frame.state = "locked");
    notices(PUSH, |frame| frame.contacts[0].normal = -1e-6);
    notices(CONE, |frame| {
        frame.contacts[0].friction = frame.contacts[0].normal
    });
    notices(WRENCH, |frame| frame.wrench[2] += 1e-6);
    notices(FORCES, |frame| frame.contacts[0].normal += 1e-6);
    notices(MOMENTS, |frame| {
        frame.contacts[0].normal += 1e-6;
        frame.contacts[1].normal -= 1e-6;
    });
    notices(PAIR, |frame| {
        frame.contacts[1].touch = Touch::Corner {
            obstacle: 1,
            corner: 0,
            body_side: 0,
        }
    });
}
