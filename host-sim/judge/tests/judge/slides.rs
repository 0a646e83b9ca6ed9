//! Contacts that slide with the hand, in closed form: a tool with a point, a box on its edge, a rod between floor and wall. Lawful
//! traces are accepted, and every fault is found under the name of its law.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;

use stiction_judge::{Contact, Event, Frame, Scene, State, law};

use crate::drag::{SCENE, pressed};
use crate::write::{self, frame, on, only};

const K: f64 = 500.0;
const DYNAMIC: f64 = 0.3;

/// N* = k_h D_c / (mu_s - mu_d) is 25 N: the load on the tool 50 mm below the floor.
const TOOL: &str = "[body]\nvertices = [[0.0, 0.0]]\nstart = [0.0, 0.01, 0.0]\n[grasp]\npoint = [0.0, 0.0]\n\
    [spring]\ntranslation = 500.0\nrotation = 0.5\n[friction]\nstatic = 0.5\ndynamic = 0.3\nmemory = 0.01\n\
    [[surface]]\nname = \"floor\"\nnormal = [0.0, 1.0]\noffset = 0.0\n";

/// The tool on the floor at `x`, the hand below it.
fn standing(hand: [f64; 2], x: f64, sliding: Option<i8>) -> Frame {
    let wrench = [K * (hand[0] - x), K * hand[1], 0.0];
    let mut frame = write::standing([hand[0], hand[1], 0.1], [x, 0.1], wrench);
    frame.contacts[0].sliding = sliding;
    frame
}

/// The tool slides along `sign`·t: its foot is at t·p_h - s mu_d N / k_h.
fn sliding(hand: [f64; 2], sign: i8) -> Frame {
    let x = hand[0] + f64::from(sign) * DYNAMIC * hand[1];
    standing(hand, x, Some(sign))
}

fn free(hand: [f64; 2]) -> Frame {
    let place = [hand[0], hand[1], 0.1];
    frame(0.0, place, place)
}

fn with(events: &[Event], frame: Frame) -> Frame {
    let slips = events.iter().filter(|event| **event == Event::Slip).count();
    Frame {
        events: events.to_vec(),
        slips: u32::try_from(slips).expect("few"),
        ..frame
    }
}

/// The tool touches obliquely and slides, turns back, slides back, is pressed until it sticks, slips and lifts.
fn tour() -> Vec<Frame> {
    vec![
        free([0.0, 0.01]),
        with(&[Event::Touch, Event::Slide], sliding([0.02, -0.005], 1)),
        sliding([0.03, -0.005], 1),
        sliding([0.04, -0.01], 1),
        with(&[Event::Stop], standing([0.039, -0.01], 0.037, Some(0))),
        standing([0.035, -0.01], 0.037, Some(0)),
        with(&[Event::Slide], sliding([0.03, -0.01], -1)),
        sliding([0.02, -0.01], -1),
        // N reaches N* when the hand is at (-0.004, -0.05).
        with(&[Event::Stop], standing([-0.01, -0.06], 0.011, Some(0))),
        with(&[Event::Slip], standing([-0.02, -0.06], -0.001, Some(0))),
        standing([-0.008, -0.02], -0.001, Some(0)),
        // Pressed with less than N*, it slips when its lead is 10 mm, and slides on.
        with(&[Event::Slip, Event::Slide], sliding([-0.04, -0.02], -1)),
        with(&[Event::Lift], free([-0.04, 0.01])),
    ]
}

/// Frames in the tour: where it slides, turns back, and slips and slides on.
const SLIDES: usize = 2;
const TURNS: usize = 4;
const SLIPS_ON: usize = 11;

fn laws(scene: &str, frames: Vec<Frame>) -> BTreeSet<&'static str> {
    write::laws(&write::scene(scene), frames)
}

fn after(place: usize, fault: impl FnOnce(&mut Frame)) -> BTreeSet<&'static str> {
    let mut frames = tour();
    fault(&mut frames[place]);
    laws(TOOL, frames)
}

#[test]
fn tool_that_slides_sticks_and_slips_is_lawful() {
    assert_eq!(laws(TOOL, tour()), BTreeSet::new());
}

#[test]
fn slide_beside_its_friction_is_found() {
    for off in [-1e-6, 1e-6] {
        let mut frames = tour();
        let hand = frames[SLIDES].hand;
        let x = frames[SLIDES].pose[0] + off;
        frames[SLIDES] = standing([hand[0], hand[1]], x, Some(1));
        assert_eq!(laws(TOOL, frames), only(law::SLIDES));
    }
    // With the sign reversed: against the motion.
    let turned = after(SLIDES, |frame| frame.contacts[0].sliding = Some(-1));
    assert!(turned.contains(law::SLIDES), "{turned:?}");
}

#[test]
fn slide_that_goes_back_is_found() {
    let mut frames = tour();
    frames.truncate(TURNS);
    frames.push(sliding([0.039, -0.01], 1));
    assert_eq!(laws(TOOL, frames), only(law::FORWARD));
    // Far below the bound per frame, but never forward.
    let mut frames = tour();
    frames.truncate(TURNS);
    frames.extend((0..40).map(|i| sliding([0.04 - 1e-7 * f64::from(i), -0.01], 1)));
    assert_eq!(laws(TOOL, frames), only(law::FORWARD));
}

#[test]
fn slide_that_is_pressed_beyond_its_threshold_is_found() {
    let pressed = |depth: f64| {
        let mut frames = tour();
        frames.truncate(TURNS);
        frames.push(sliding([0.08, -0.048], 1));
        frames.push(sliding([0.12, -depth], 1));
        laws(TOOL, frames)
    };
    assert_eq!(pressed(0.0499), BTreeSet::new());
    assert_eq!(pressed(0.0501), only(law::SLIDE_STOPS));
}

#[test]
fn slip_that_slides_on_begins_where_static_friction_gives_way() {
    let mut frames = tour();
    frames.truncate(SLIPS_ON);
    // A lead of 9 mm, although 10 mm are borne.
    frames.push(with(&[Event::Slip], sliding([-0.0105, -0.02], -1)));
    assert!(laws(TOOL, frames).contains(law::SLIP_BEGINS));
}

/// With mu_s = mu_d, contacts of an older trace slide without reporting it.
#[test]
fn equal_frictions_stick_too() {
    let equal = TOOL.replace("static = 0.5", "static = 0.3");
    let moved = |sliding: Option<i8>| {
        let frame = |x: f64| standing([0.035, -0.01], x, sliding);
        laws(&equal, vec![frame(0.037), frame(0.0371)])
    };
    assert_eq!(moved(Some(0)), only(law::STICKS));
    assert_eq!(moved(None), BTreeSet::new());
}

/// Nothing holds the angle of a rod that is held at its upper end: its foot swings out of the way without force.
#[test]
fn foot_without_force_goes_as_it_likes() {
    let scene = "[body]\nvertices = [[0.0, 0.0], [0.0, -1.0]]\nstart = [0.0, 1.0, 0.0]\n[grasp]\npoint = [0.0, 0.0]\n\
        [spring]\ntranslation = 500.0\nrotation = 0.0\n[friction]\nstatic = 0.5\ndynamic = 0.3\n\
        [[surface]]\nname = \"floor\"\nnormal = [0.0, 1.0]\noffset = 0.0\n";
    let swung = |height: f64, sliding: i8| {
        let theta = height.acos();
        let contact = Contact {
            touch: on(1, 0),
            direction: None,
            point: [theta.sin(), 0.0],
            normal: 0.0,
            friction: 0.0,
            sliding: Some(sliding),
        };
        Frame {
            state: State::SingleVertex,
            contacts: vec![contact],
            ..frame(0.0, [0.0, height, 0.0], [0.0, height, theta])
        }
    };
    let frames = [(0.9, 0), (0.8, 0), (0.7, 1), (0.8, 1), (0.6, -1)];
    let frames = frames.map(|(height, sliding)| swung(height, sliding));
    assert_eq!(laws(scene, frames.to_vec()), BTreeSet::new());
}

/// The box of the dragged trace, pressed with 6 N, slides on its edge.
fn box_slides(normal: f64, x: f64) -> Frame {
    let hand = [x + DYNAMIC * normal / K, 0.05 - (normal - 1.0) / K, 0.0];
    let mut frame = pressed(0.0, hand, x, [0.0, 0.05]);
    frame.contacts.iter_mut().for_each(|c| c.sliding = Some(1));
    frame
}

#[test]
fn edge_slides_with_both_vertices() {
    let scene = SCENE.replace("dynamic = 0.3\n", "dynamic = 0.3\nmemory = 0.0024\n");
    let slide = |change: &dyn Fn(&mut [Contact])| {
        let mut frames = vec![box_slides(5.0, 0.0), box_slides(5.5, 0.001)];
        change(&mut frames[1].contacts);
        laws(&scene, frames)
    };
    assert_eq!(slide(&|_| {}), BTreeSet::new());
    assert_eq!(slide(&|c| c[1].sliding = Some(0)), only(law::ONE_MOTION));
    let against = BTreeSet::from([law::ONE_MOTION, law::SLIDES]);
    assert_eq!(slide(&|c| c[1].sliding = Some(-1)), against);
    // N* is 6 N; the default, with D_c = L / 4096, is far less: in a slide of 5 N the box would have to stick before.
    let beyond = vec![box_slides(5.9, 0.0), box_slides(6.1, 0.001)];
    assert_eq!(laws(&scene, beyond.clone()), only(law::SLIDE_STOPS));
    assert_eq!(laws(SCENE, beyond), BTreeSet::new());
}

/// The default threshold, the thresholds for a `memory` of 0 or shorter than 2^-19 L, and for a surface with its own: 71 mN, 0.56 mN
/// and 71 N for a box without weight.
#[test]
fn thresholds_of_memory_lengths() {
    let light = SCENE.replace("weight = 1", "weight = 0");
    let zero = light.replace("dynamic = 0.3\n", "dynamic = 0.3\nmemory = 0\n");
    let own = zero.replace(
        "normal = [0.0, 2.0]\n",
        "normal = [0.0, 2.0]\nmemory = 0.0285\n",
    );
    let short = zero.replace("memory = 0\n", "memory = 1e-8\n");
    for (scene, threshold) in [
        (light, 0.071_17),
        (zero, 0.000_556_0),
        (short, 0.000_556_0),
        (own, 71.25),
    ] {
        let normal = |part: f64, x: f64| {
            let parsed = write::scene(&scene);
            let mut frame = box_slides(1.0 + part * threshold, x);
            // Without the weight of 1 N and its friction.
            lighten(&parsed, &mut frame, part * threshold);
            frame
        };
        let slide = |from: f64, to: f64| laws(&scene, vec![normal(from, 0.0), normal(to, 0.01)]);
        assert_eq!(slide(0.98, 0.999), BTreeSet::new(), "{threshold}");
        assert_eq!(slide(0.98, 1.01), only(law::SLIDE_STOPS), "{threshold}");
    }
}

/// Less than 2^-19 of L counts as that: 4.8e-7 m for the tool, whose springs have a radius of 32 mm, so that its L is 1/4 m.
#[test]
fn threshold_of_a_point_is_that_of_its_springs() {
    let pressed = |memory: f64| {
        let scene = TOOL.replace("memory = 0.01", &format!("memory = {memory}"));
        // N rises from less than N* to more.
        let depth = memory / 0.2;
        let frames = [0.9, 1.1].map(|part| sliding([part, -part * depth], 1));
        laws(&scene, frames.to_vec())
    };
    assert_eq!(pressed(5e-7), only(law::SLIDE_STOPS));
    assert_eq!(pressed(4e-7), BTreeSet::new());
}

/// A box without weight that slides under `normal`: each vertex bears its part.
fn lighten(scene: &Scene, frame: &mut Frame, normal: f64) {
    assert!(scene.weight == 0.0);
    let friction = -DYNAMIC * normal;
    frame.hand[0] = frame.pose[0] - friction / K;
    frame.wrench = [-friction, -normal, 0.0];
    // The holding point is 50 mm above the floor and centred.
    let shift = -0.05 * friction / 0.10;
    for (contact, side) in frame.contacts.iter_mut().zip([-1.0, 1.0]) {
        contact.normal = normal / 2.0 + side * shift;
        contact.friction = -DYNAMIC * contact.normal;
    }
}

/// A rod of length 2 that slides down between floor and wall (k_h = 1, k_theta = 4, mu_d = 0.2), at an angle, under a load of 2; the
/// hand's angle is the one that balances the moment.
fn leaning(theta: f64) -> Frame {
    let (sin, cos) = theta.sin_cos();
    let mu = 0.2;
    let hand = [-cos, sin - 2.0];
    let force = [hand[0] + cos, hand[1] - sin];
    let foot = -(force[1] + mu * force[0]) / (1.0 + mu * mu);
    let head = force[0] + mu * foot;
    let moment = -cos * foot + sin * mu * foot + cos * mu * head + sin * head;
    let contact = |vertex: usize, point: [f64; 2], normal: f64| Contact {
        touch: on(vertex, vertex),
        direction: None,
        point,
        normal,
        friction: mu * normal,
        sliding: Some(-1),
    };
    Frame {
        state: State::TwoVertex,
        contacts: vec![
            contact(0, [-2.0 * cos, 0.0], foot),
            contact(1, [0.0, 2.0 * sin], head),
        ],
        wrench: [force[0], force[1], -moment],
        ..frame(
            0.0,
            [hand[0], hand[1], theta - moment / 4.0],
            [-2.0 * cos, 0.0, theta],
        )
    }
}

#[test]
fn ladder_slides_as_its_one_motion_can() {
    let scene = "[body]\nvertices = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.1]]\nstart = [0.0, 0.0, 0.0]\n[grasp]\npoint = [1.0, 0.0]\n\
         [spring]\ntranslation = 1.0\nrotation = 4.0\n[friction]\nstatic = 0.4\ndynamic = 0.2\n\
         [[surface]]\nname = \"floor\"\nnormal = [0.0, 1.0]\noffset = 0.0\n\
         [[surface]]\nname = \"wall\"\nnormal = [-1.0, 0.0]\noffset = 0.0\n";
    let angles = |angles: [f64; 3]| laws(scene, angles.map(leaning).to_vec());
    assert_eq!(angles([FRAC_PI_2 - 0.5, 1.0, 0.9]), BTreeSet::new());
    assert_eq!(angles([1.0, 0.9, 0.901]), only(law::FORWARD));
    let signs = |signs: [i8; 2]| {
        let mut frames = [1.0, 0.9].map(leaning);
        for (contact, sign) in frames[1].contacts.iter_mut().zip(signs) {
            contact.sliding = Some(sign);
        }
        laws(scene, frames.to_vec())
    };
    assert_eq!(signs([-1, 0]), only(law::ONE_MOTION));
    assert!(signs([-1, 1]).contains(law::ONE_MOTION));
    let up = signs([1, 1]);
    assert!(
        up.contains(law::SLIDES) && !up.contains(law::ONE_MOTION),
        "{up:?}"
    );
}
