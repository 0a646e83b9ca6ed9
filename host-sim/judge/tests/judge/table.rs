//! A box with weight on a table that ends, in closed form: two contacts on one line, of which the outer one is the box's vertex before
//! the table's edge and the table's corner beyond it. Also features that do not touch: points and boxes next to thin walls and pins.

use std::collections::BTreeSet;

use stiction_judge::{Contact, Event, Frame, Scene, State, Touch, law};

use crate::write::{corner, frame, laws as laws_of, only, scene, side};

const K: f64 = 500.0;
const WEIGHT: f64 = 3.0;
const MU: f64 = 0.3;
/// How far the hand is below the holding point (m).
const DOWN: f64 = 0.004;
const NONE: BTreeSet<&str> = BTreeSet::new();

const LEFT: Touch = side(0, 0, 2);
const RIGHT: Touch = side(1, 0, 2);
const EDGE: Touch = corner(0, 2, 0);

fn table() -> Scene {
    scene(
        "[body]\nrectangle = [0.1, 0.06]\nstart = [-0.1, 0.03, 0.0]\nweight = 3.0\n[grasp]\npoint = [0.0, 0.0]\n\
         [spring]\ntranslation = 500.0\nrotation = 2.0\n[friction]\nstatic = 0.3\ndynamic = 0.3\n[[obstacle]]\nname = \"table\"\n\
         vertices = [[-0.5, -0.1], [0.0, -0.1], [0.0, 0.0], [-0.5, 0.0]]\n",
    )
}

/// The box at `x`, flat, pressed and pulled by `pull` (N) along x; it slides along t if the pull equals the friction.
fn flat(x: f64, pull: f64) -> Frame {
    let [first, second] = [x - 0.05, (x + 0.05).min(0.0)];
    let normal = WEIGHT + K * DOWN;
    // Moments about the left end: the load acts at the middle, the pull 30 mm above the table.
    let about_first = normal * (x - first) + 0.03 * pull;
    let right = about_first / (second - first);
    let slides = pull >= MU * normal * (1.0 - 1e-12);
    let contact = |touch, x: f64, share: f64| Contact {
        touch,
        direction: Some([0.0, 1.0]),
        point: [x, 0.0],
        normal: share,
        friction: -pull * share / normal,
        sliding: Some(i8::from(slides)),
    };
    let outer = if x + 0.05 > 0.0 { EDGE } else { RIGHT };
    Frame {
        state: State::Edge,
        contacts: vec![
            contact(LEFT, first, normal - right),
            contact(outer, second, right),
        ],
        wrench: [pull, -K * DOWN, 0.0],
        ..frame(0.0, [x + pull / K, 0.03 - DOWN, 0.0], [x, 0.03, 0.0])
    }
}

/// The box pushed over the edge: the outer contact changes from vertex to corner, and nothing else happens.
fn pushed() -> Vec<Frame> {
    let slides = (0..12).map(|i| flat(-0.055 + 0.001 * f64::from(i), MU * (WEIGHT + K * DOWN)));
    let rests = flat(-0.055, 1.0);
    let mut frames: Vec<_> = std::iter::once(rests).chain(slides).collect();
    frames[1].events = vec![Event::Slide];
    frames
}

fn laws(frames: Vec<Frame>) -> BTreeSet<&'static str> {
    laws_of(&table(), frames)
}

/// The last frame in which the vertex is the outer end, and the first in which the corner is.
const BEFORE: usize = 6;
const BEYOND: usize = 7;

#[test]
fn box_that_is_pushed_over_an_edge_is_lawful() {
    let frames = pushed();
    assert_eq!(frames[BEFORE].contacts[1].touch, RIGHT);
    assert_eq!(frames[BEYOND].contacts[1].touch, EDGE);
    assert_eq!(laws(frames), NONE);
}

/// A table in two pieces is one, and each name of its side is valid.
#[test]
fn edge_of_a_table_in_two_pieces_is_lawful() {
    let mut scene = table();
    let mut second = scene.obstacles[0].clone();
    second.name = "outer".to_owned();
    scene.obstacles[0].vertices = vec![[-0.5, -0.1], [-0.3, -0.1], [-0.3, 0.0], [-0.5, 0.0]];
    second.vertices = vec![[-0.3, -0.1], [0.0, -0.1], [0.0, 0.0], [-0.3, 0.0]];
    scene.obstacles.push(second);
    let mut frames = pushed();
    for contact in frames.iter_mut().flat_map(|frame| &mut frame.contacts) {
        if let Touch::Corner { obstacle, .. } = &mut contact.touch {
            *obstacle = 1;
        }
    }
    assert_eq!(laws_of(&scene, frames), NONE);
}

#[test]
fn vertex_beyond_the_edge_is_found() {
    let mut frames = pushed();
    // Where the vertex would be if the table continued, with the forces that balance there.
    let x = frames[BEYOND + 2].pose[0];
    let normal = WEIGHT + K * DOWN;
    let right = (normal * 0.05 + 0.03 * MU * normal) / 0.1;
    let contacts = &mut frames[BEYOND + 2].contacts;
    for (contact, share) in contacts.iter_mut().zip([normal - right, right]) {
        (contact.normal, contact.friction) = (share, -MU * share);
    }
    contacts[1].touch = RIGHT;
    contacts[1].point = [x + 0.05, 0.0];
    let broken = laws(frames);
    assert!(broken.contains(law::ON_SIDE), "{broken:?}");
    assert!(!broken.contains(law::MOMENTS), "{broken:?}");
}

#[test]
fn contact_that_changes_elsewhere_than_at_an_end_is_found() {
    let mut frames = pushed();
    // The other end of the table, without an event.
    frames[BEYOND].contacts[1].touch = corner(0, 3, 0);
    let broken = laws(frames);
    assert!(broken.contains(law::PASSED_ON), "{broken:?}");
    // A sticking contact is not replaced.
    let mut frames = vec![flat(-0.0501, 1.0), flat(-0.0499, 1.0)];
    assert!(laws(frames.clone()).contains(law::PASSED_ON));
    frames[1].events = vec![Event::Slip];
    frames[1].slips = 1;
    assert!(!laws(frames).contains(law::PASSED_ON));
}

/// Touching features without a force are a contact, too: found in the second frame.
#[test]
fn end_that_is_left_out_is_found() {
    let bears_right = (WEIGHT + K * DOWN) * 0.05 / 0.03;
    let mut frames = vec![flat(-0.1, bears_right); 3];
    let scene = Scene {
        obstacles: table()
            .obstacles
            .into_iter()
            .map(|mut o| {
                (o.friction_static, o.friction_dynamic) = (3.0, 3.0);
                o
            })
            .collect(),
        ..table()
    };
    for frame in &mut frames {
        for contact in &mut frame.contacts {
            contact.sliding = Some(0);
        }
    }
    assert!(frames[0].contacts[0].normal.abs() < 1e-12);
    assert_eq!(laws_of(&scene, frames.clone()), NONE);
    for frame in &mut frames {
        frame.contacts.remove(0);
        frame.state = State::SingleVertex;
    }
    assert_eq!(laws_of(&scene, frames), only(law::REPORTED));
}

/// A point, and a thin wall through the origin, 0.2 m long.
fn wall() -> Scene {
    scene(
        "[body]\nvertices = [[0.0, 0.0]]\nstart = [0.0, 0.05, 0.0]\n[grasp]\npoint = [0.0, 0.0]\n\
         [spring]\ntranslation = 500.0\nrotation = 2.0\n[friction]\nstatic = 0.3\ndynamic = 0.3\n[[obstacle]]\nname = \"wall\"\n\
         vertices = [[-0.1, 0.0], [0.1, 0.0]]\n",
    )
}

fn free(hand: [f64; 2]) -> Frame {
    let [x, y] = hand;
    frame(0.0, [x, y, 0.0], [x, y, 0.0])
}

/// The point on the upper side, pressed down.
fn pressed(x: f64) -> Frame {
    Frame {
        state: State::SingleVertex,
        contacts: vec![Contact {
            touch: side(0, 0, 1),
            direction: Some([0.0, 1.0]),
            point: [x, 0.0],
            normal: 5.0,
            friction: -1.0,
            sliding: Some(0),
        }],
        wrench: [1.0, -5.0, 0.0],
        ..frame(0.0, [x + 0.002, -0.01, 0.0], [x, 0.0, 0.0])
    }
}

fn with(event: Event, frame: Frame) -> Frame {
    Frame {
        events: vec![event],
        ..frame
    }
}

#[test]
fn point_behind_a_thin_wall_is_found() {
    let scene = wall();
    let down = |x: f64| vec![free([x, 0.05]), free([x, -0.05])];
    assert_eq!(laws_of(&scene, down(0.05)), only(law::PASSES));
    assert_eq!(laws_of(&scene, down(0.11)), NONE);
    let touched = vec![free([0.0, 0.05]), with(Event::Touch, pressed(0.0))];
    assert_eq!(laws_of(&scene, touched), NONE);
    // Pressed from above, it is below the wall without having slid to an end.
    let through = vec![pressed(0.0), with(Event::Lift, free([0.002, -0.012]))];
    assert_eq!(laws_of(&scene, through), only(law::HOLDS));
    // On the lower side, the point would have to be pulled down.
    let mut below = vec![free([0.0, 0.05]), with(Event::Touch, pressed(0.0))];
    let contact = &mut below[1].contacts[0];
    contact.touch = side(0, 0, 0);
    contact.direction = Some([0.0, -1.0]);
    (contact.normal, contact.friction) = (-5.0, 1.0);
    let broken = laws_of(&scene, below);
    assert!(broken.contains(law::PUSH), "{broken:?}");
}

#[test]
fn body_that_jumps_over_a_pin_is_found() {
    let text = "[body]\nrectangle = [0.1, 0.06]\nstart = [0.2, 0.0, 0.0]\n[grasp]\npoint = [0.0, 0.0]\n\
        [spring]\ntranslation = 500.0\nrotation = 2.0\n[friction]\nstatic = 0.3\ndynamic = 0.3\n[[obstacle]]\nvertices = [[0.0, 0.0]]\n";
    let scene = scene(text);
    let jump = |y: f64| vec![free([0.2, y]), free([-0.2, y])];
    assert_eq!(laws_of(&scene, jump(0.0)), only(law::PASSES));
    assert_eq!(laws_of(&scene, jump(0.029)), only(law::PASSES));
    assert_eq!(laws_of(&scene, jump(0.031)), NONE);
    let inside = vec![free([0.01, 0.02])];
    assert_eq!(laws_of(&scene, inside), only(law::OUTSIDE));
}
