//! A bar on a pin, in closed form (the slip of a vertex with body and world exchanged): a corner of an obstacle on a side of the body,
//! whose normal turns with it. The pin is at the origin; the lower side of the bar rests on it.

use std::collections::BTreeSet;

use stiction_judge::{Contact, Event, Frame, Scene, State, Touch, law};

use stiction_tests::change;

use crate::write::{frame, laws, only, scene};

const K: f64 = 500.0;
const K_THETA: f64 = 8.0;
/// Distances of the holding point (m): across the bar from its lower side, and along the bar from its middle.
const ACROSS: f64 = 0.04;
const ALONG: f64 = 0.02;
const NONE: BTreeSet<&str> = BTreeSet::new();

fn on_pin([mu_s, mu_d]: [f64; 2]) -> Scene {
    scene(&format!(
        "[body]\nvertices = [[-0.2, -0.03], [0.2, -0.03], [0.2, 0.03], [-0.2, 0.03]]\nstart = [0.0, 0.03, 0.0]\n\
         [grasp]\npoint = [0.02, 0.01]\n[spring]\ntranslation = 500.0\nrotation = 8.0\n[friction]\nstatic = {mu_s:?}\n\
         dynamic = {mu_d:?}\n[[obstacle]]\nname = \"pin\"\nvertices = [[0.0, 0.0]]\n"
    ))
}

/// The hand in the body frame's directions.
fn seen([x, y, _]: [f64; 3], theta: f64) -> [f64; 2] {
    let (sin, cos) = theta.sin_cos();
    [cos * x + sin * y, cos * y - sin * x]
}

/// Distance of the holding point from the pin, along the side, at which the moments balance at an angle.
fn balanced(hand: [f64; 3], theta: f64) -> f64 {
    let [x, y] = seen(hand, theta);
    (ACROSS * x - K_THETA / K * (hand[2] - theta)) / y
}

/// N and T at an angle, with the holding point at `lever` along the side from the pin.
fn reaction(hand: [f64; 3], theta: f64, lever: f64) -> [f64; 2] {
    let [x, y] = seen(hand, theta);
    [K * (ACROSS - y), -K * (x - lever)]
}

fn lying(hand: [f64; 3], theta: f64, lever: f64, sliding: i8) -> Frame {
    let (sin, cos) = theta.sin_cos();
    let [x, y] = [ALONG - lever, -0.03];
    let grip = [cos * lever - sin * ACROSS, sin * lever + cos * ACROSS];
    let [normal, friction] = reaction(hand, theta, lever);
    Frame {
        state: State::SingleVertex,
        contacts: vec![Contact {
            touch: Touch::Corner {
                obstacle: 0,
                corner: 0,
                body_side: 0,
            },
            direction: Some([-sin, cos]),
            point: [0.0, 0.0],
            normal,
            friction,
            sliding: Some(sliding),
        }],
        wrench: [
            K * (hand[0] - grip[0]),
            K * (hand[1] - grip[1]),
            K_THETA * (hand[2] - theta),
        ],
        ..frame(0.0, hand, [sin * y - cos * x, -sin * x - cos * y, theta])
    }
}

/// The angle at which the moments balance while the pin sticks.
fn stuck(hand: [f64; 3], lever: f64) -> f64 {
    change(hand[2] - 0.5, hand[2] + 0.5, |theta| {
        balanced(hand, theta) > lever
    })
}

/// The hand turns and moves along: the bar turns about the pin, which sticks to it except for `creep` (m) per frame.
fn turning(creep: f64) -> Vec<Frame> {
    let at = |i: u32| {
        let part = f64::from(i) / 20.0;
        let hand = [0.002 * part, 0.02, 0.05 + 0.02 * part];
        let lever = balanced([0.0, 0.02, 0.05], 0.03) + creep * f64::from(i);
        lying(hand, stuck(hand, lever), lever, 0)
    };
    (0..20).map(at).collect()
}

#[test]
fn bar_that_turns_about_a_pin_is_lawful() {
    assert_eq!(laws(&on_pin([0.9, 0.9]), turning(0.0)), NONE);
}

/// Far below what a single frame reveals, and in balance.
#[test]
fn corner_that_creeps_along_a_body_is_found() {
    for creep in [-2e-7, 2e-7] {
        let broken = laws(&on_pin([0.9, 0.9]), turning(creep));
        assert_eq!(broken, only(law::STICKS));
    }
}

#[test]
fn direction_that_stays_behind_is_found() {
    let mut frames = turning(0.0);
    frames[8].contacts[0].direction = frames[7].contacts[0].direction;
    let broken = laws(&on_pin([0.9, 0.9]), frames);
    assert_eq!(broken, only(law::DIRECTION));
}

const FROZEN: [f64; 3] = [0.004, 0.02, 0.1];
const DYNAMIC: f64 = 0.1;

/// The drive of the bar, in the direction in which T opposes it.
fn driven(theta: f64) -> f64 {
    let [normal, friction] = reaction(FROZEN, theta, balanced(FROZEN, theta));
    friction.abs() - DYNAMIC * normal
}

/// A slip under a hand at rest, from one angle to another, with the static friction that gives way at the first.
fn slip(from: f64, to: f64) -> BTreeSet<&'static str> {
    let [normal, friction] = reaction(FROZEN, from, balanced(FROZEN, from));
    let [before, after] = [from, to].map(|theta| lying(FROZEN, theta, balanced(FROZEN, theta), 0));
    let after = Frame {
        slips: 1,
        events: vec![Event::Slip],
        ..after
    };
    laws(
        &on_pin([friction.abs() / normal, DYNAMIC]),
        vec![before, after],
    )
}

/// The start and the end of a slip.
fn ends() -> [f64; 2] {
    let begin = 0.06;
    let step = (1..4000).map(|i| 1e-4 * f64::from(i));
    let way = |sign: f64| {
        let places = step.clone().map(move |by| begin + sign * by);
        places.take_while(|&theta| balanced(FROZEN, theta).abs() < 0.15)
    };
    let end = [1.0, -1.0].map(|sign| way(sign).find(|&theta| driven(theta) <= 0.0));
    let end = end.into_iter().flatten().next().expect("an end");
    [begin, change(begin, end, |theta| driven(theta) > 0.0)]
}

#[test]
fn slip_of_a_corner_ends_at_dynamic_friction() {
    let [begin, end] = ends();
    assert!(driven(begin) > 0.5, "{}", driven(begin));
    assert_eq!(slip(begin, end), NONE);
    for part in [0.99, 1.01] {
        let broken = slip(begin, begin + part * (end - begin));
        assert!(broken.contains(law::SLIP_ENDS), "{broken:?}");
    }
}

/// A bar that slides on the pin with the hand.
fn sliding() -> Vec<Frame> {
    let mu = DYNAMIC;
    let at = |i: u32| {
        let hand = [0.02 + 0.001 * f64::from(i), 0.02, 0.0];
        // It moves along t, with friction against it.
        let excess = |theta: f64| {
            let [normal, friction] = reaction(hand, theta, balanced(hand, theta));
            friction + mu * normal
        };
        let theta = change(-0.3, 0.3, |theta| excess(theta) > 0.0);
        lying(hand, theta, balanced(hand, theta), 1)
    };
    (0..10).map(at).collect()
}

#[test]
fn slide_of_a_corner_goes_forward_at_dynamic_friction() {
    let scene = on_pin([DYNAMIC; 2]);
    assert_eq!(laws(&scene, sliding()), NONE);
    let mut back = sliding();
    back.reverse();
    assert_eq!(laws(&scene, back), only(law::FORWARD));
    let mut wrong = sliding();
    wrong[4].contacts[0].sliding = Some(-1);
    assert!(laws(&scene, wrong).contains(law::SLIDES));
}
