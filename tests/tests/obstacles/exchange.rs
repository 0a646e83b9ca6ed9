//! Body and world exchanged: a polygon that a hand turns against a fixed one, and the fixed one held and turned against the first. Let g
//! be the pose of the body, p_h and phi the hand, and q the holding point. The springs of the body g⁻¹, held at p_h by a hand at q with
//! the angle -phi, store the same energy. So as long as a hand only turns, vertices and corners change places and nothing else changes.
//! Two things are not compared: whether a contact at the edge of its cone has stopped, and what counts as a slip when a contact moves on
//! to the next pair.

use stiction_core::Evolution;
use stiction_judge::{Contact, Frame, Status, Touch};
use stiction_tests::draw::{Draw, polygon};
use stiction_tests::obstacles::shape::{Point, length, placed, separation, sub};
use stiction_tests::obstacles::{Among, Obstacle, Run};
use stiction_tests::{Number, Setup, test_each, times};

fn number_of_scenes() -> u64 {
    times(20, 300)
}
/// Frames of a turn in one direction.
const FRAMES: usize = 100;
/// Minimum distance of the shapes at the start (m); both have the size 1 m.
const CLEAR: f64 = 0.02;

/// A scene, the scene of the exchanged shapes, and the angles of the hand (rad).
struct Exchange {
    one: Among,
    other: Among,
    hand: Point,
    angles: Vec<f64>,
}

impl Exchange {
    fn random(number: u64) -> Self {
        let draw = &mut Draw::new(0xe8c4_a49e + number);
        let body = unit(draw);
        let start = [0.0, 0.0, draw.between(-3.0, 3.0)];
        let held = [draw.between(-0.4, 0.4), draw.between(-0.4, 0.4)];
        let [hand] = placed(&[held], start)[..] else {
            unreachable!("one point")
        };
        let corners = loop {
            let shape = unit(draw);
            let at = [0, 1].map(|k| hand[k] + draw.between(-0.8, 0.8));
            let corners = placed(&shape, [at[0], at[1], draw.between(-3.0, 3.0)]);
            if separation(&corners, &placed(&body, start)) >= CLEAR {
                break corners;
            }
        };
        let mu_s = draw.one(&[0.0, 0.1, 0.4, 0.9]);
        let friction = [mu_s, mu_s * draw.one(&[1.0, 1.0, 0.6])];
        let stiffness = draw.one(&[0.02, 0.1, 0.5]);
        let scene = |body: &[Point], start, held, obstacle| Among {
            setup: Setup::new(body)
                .at(start)
                .held_at(held)
                .springs(1.0, stiffness),
            obstacles: vec![Obstacle {
                vertices: obstacle,
                friction,
            }],
        };
        let turns = [draw.between(-4.0, 4.0), draw.between(-4.0, 4.0), 0.0];
        let mut angles = vec![start[2]];
        for turn in turns {
            let (from, to) = (angles[angles.len() - 1], start[2] + turn);
            angles.extend((1..=FRAMES).map(|i| from + (to - from) * i as f64 / FRAMES as f64));
        }
        Self {
            one: scene(&body, start, held, corners.clone()),
            other: scene(&corners, inverse(start), hand, body),
            hand,
            angles,
        }
    }
}

/// A polygon of size 1 m.
fn unit(draw: &mut Draw) -> Vec<Point> {
    let count = 3 + draw.below(4);
    let shape = polygon(draw, count, 1.0);
    let size = Setup::new(&shape).size();
    shape.iter().map(|p| p.map(|x| x / size)).collect()
}

/// The pose of the world in the frame of a body.
fn inverse([x, y, theta]: [f64; 3]) -> [f64; 3] {
    let [[x, y]] = placed(&[[-x, -y]], [0.0, 0.0, -theta])[..] else {
        unreachable!("one point")
    };
    [x, y, -theta]
}

/// The pair of touching features after the exchange of body and world.
fn exchanged(touch: Touch) -> Touch {
    match touch {
        Touch::Side { vertex, side, .. } => Touch::Corner {
            obstacle: 0,
            corner: vertex,
            body_side: side,
        },
        Touch::Corner {
            corner, body_side, ..
        } => Touch::Side {
            vertex: corner,
            obstacle: 0,
            side: body_side,
        },
        Touch::Surface { .. } => unreachable!("there are no half-planes"),
    }
}

fn sorted(mut contacts: Vec<Contact>) -> Vec<Contact> {
    contacts.sort_by_key(|contact| contact.touch);
    contacts
}

/// The difference between a frame and that of the exchanged shapes: in m, rad and N.
fn difference(one: &Frame, other: &Frame) -> f64 {
    let [x, y, theta] = inverse(one.pose);
    let [ox, oy, otheta] = other.pose;
    let pose = length([x - ox, y - oy]).max((theta - otheta).abs());
    let contact = |(a, b): (&Contact, &Contact)| {
        let point = placed(&[a.point], inverse(one.pose))[0];
        let forces = length([a.normal - b.normal, a.friction - b.friction]);
        forces.max(length(sub(point, b.point)))
    };
    let contacts = one.contacts.iter().zip(&other.contacts);
    contacts.map(contact).fold(pose, f64::max)
}

/// Runs both scenes in a number type; returns how many frames had a contact, and how many of them slid or had slipped.
fn both<R: Number>(number: u64, evolution: Evolution, bound: f64) -> [usize; 2] {
    let scene = Exchange::random(number);
    let [mu_s, mu_d] = scene.one.obstacles[0].friction;
    if mu_s > mu_d && R::ROUNDING > f64::ROUNDING {
        // The start of a slip depends on all slips before it: with few digits, the runs soon differ.
        return [0; 2];
    }
    let [x, y] = scene.hand;
    let [hx, hy] = scene.one.setup.holding_point.expect("a holding point");
    let hands = scene
        .angles
        .iter()
        .map(|&angle| [[x, y, angle], [hx, hy, -angle]]);
    let mut hands = hands.collect::<Vec<_>>().into_iter();
    let [first, second] = hands.next().expect("a start");
    let mut one = Run::<R>::start(&scene.one, evolution, first);
    let mut other = Run::<R>::start(&scene.other, evolution, second);
    let mut counts = [0; 2];
    for (i, [first, second]) in hands.enumerate() {
        let (one, other) = (one.step(first), other.step(second));
        if one.status != Status::Ok || other.status != Status::Ok {
            break;
        }
        let mut mirrored = one.clone();
        for contact in &mut mirrored.contacts {
            contact.touch = exchanged(contact.touch);
        }
        mirrored.contacts = sorted(mirrored.contacts);
        let mut other = other.clone();
        other.contacts = sorted(other.contacts);
        let touches = |frame: &Frame| -> Vec<_> {
            let contacts = frame.contacts.iter();
            contacts.map(|c| c.touch).collect()
        };
        let off = difference(&mirrored, &other);
        let words = || format!("scene {number} frame {i}: {one:?}\n{other:?}");
        assert!(off < bound, "{off:e}: {}", words());
        assert_eq!(touches(&mirrored), touches(&other), "{}", words());
        assert_eq!(one.state, other.state, "{}", words());
        let slides = one.contacts.iter().any(|c| c.sliding != Some(0)) || one.slips > 0;
        counts[0] += usize::from(!one.contacts.is_empty());
        counts[1] += usize::from(slides);
    }
    counts
}

test_each!(cases::body_and_world_exchange);

mod cases {
    use super::*;

    /// Most of the scenes touch, and many slide.
    pub(super) fn body_and_world_exchange<R: Number>(evolution: Evolution) {
        let bound = if R::ROUNDING > f64::ROUNDING {
            1e-3
        } else {
            1e-9
        };
        let counts = (0..number_of_scenes()).map(|number| both::<R>(number, evolution, bound));
        let [touch, slide] = counts.fold([0; 2], |[a, b], [c, d]| [a + c, b + d]);
        let frames = 3 * FRAMES * number_of_scenes() as usize;
        assert!(touch > frames / 20, "{touch} of {frames} frames touch");
        assert!(slide > frames / 100, "{slide} of {frames} frames slide");
    }
}
