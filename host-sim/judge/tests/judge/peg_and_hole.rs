//! What counts as a peg and a hole, and what does not.

use stiction_judge::insertion::{MOST_CLEARANCE, Meter};
use stiction_judge::{Obstacle, Scene};

type Vec2 = [f64; 2];

const PEG: [Vec2; 4] = [[-0.01, 0.0], [0.01, 0.0], [0.01, 0.1], [-0.01, 0.1]];

fn block([left, right]: Vec2, [low, high]: Vec2) -> Vec<Vec2> {
    vec![[left, low], [right, low], [right, high], [left, high]]
}

/// A body among obstacles, each with its mu_d.
pub(crate) fn among(body: &[Vec2], start: [f64; 3], obstacles: &[(&Vec<Vec2>, f64)]) -> Scene {
    let obstacle = |&(vertices, friction): &(&Vec<Vec2>, f64)| Obstacle {
        name: String::new(),
        vertices: vertices.clone(),
        friction_static: friction,
        friction_dynamic: friction,
        memory: None,
    };
    Scene {
        vertices: body.to_vec(),
        start,
        weight: 0.0,
        holding_point: None,
        stiffness_translation: 1.0,
        stiffness_rotation: 1.0,
        surfaces: Vec::new(),
        obstacles: obstacles.iter().map(obstacle).collect(),
    }
}

fn find(body: &[Vec2], start: [f64; 3], obstacles: &[Vec<Vec2>]) -> Option<Meter> {
    let frictions = (0..).map(|k| 0.5 - 0.1 * f64::from(k));
    let obstacles: Vec<_> = obstacles.iter().zip(frictions).collect();
    Meter::find(&among(body, start, &obstacles))
}

fn hole() -> Vec<Vec<Vec2>> {
    vec![
        block([-0.1, -0.011], [-0.08, 0.0]),
        block([0.011, 0.1], [-0.05, -0.01]),
    ]
}

#[test]
fn the_mouth_is_where_the_walls_begin_to_face_each_other() {
    let meter = find(&PEG, [0.0, 0.1, 0.0], &hole()).expect("a hole");
    assert!((meter.width - 0.022).abs() < 1e-15 && (meter.radius - 0.01).abs() < 1e-15);
    assert!((meter.length - 0.04).abs() < 1e-15);
    assert_eq!(meter.friction, 0.4);
    assert!(meter.mouth[0].abs() < 1e-15 && (meter.mouth[1] + 0.01).abs() < 1e-15);
    assert_eq!(meter.inwards.map(f64::round), [0.0, -1.0]);
}

#[test]
fn a_through_hole_is_entered_from_where_the_body_is() {
    let meter = find(&PEG, [0.0, -0.3, 0.0], &hole()).expect("a hole");
    assert_eq!(meter.inwards.map(f64::round), [0.0, 1.0]);
    // Unless the hole has a bottom.
    let mut blind = hole();
    blind.push(block([-0.2, 0.2], [-0.1, -0.05]));
    let meter = find(&PEG, [0.0, -0.3, 0.0], &blind).expect("a hole");
    assert_eq!(meter.inwards.map(f64::round), [0.0, -1.0]);
    // A thin wall closes it, too.
    blind[2] = vec![[-0.05, -0.05], [0.05, -0.05]];
    let meter = find(&PEG, [0.0, -0.3, 0.0], &blind).expect("a hole");
    assert_eq!(meter.inwards.map(f64::round), [0.0, -1.0]);
    blind[2] = vec![[0.05, -0.05], [0.15, -0.05]];
    let meter = find(&PEG, [0.0, -0.3, 0.0], &blind).expect("a hole");
    assert_eq!(meter.inwards.map(f64::round), [0.0, 1.0]);
}

#[test]
fn of_two_equal_holes_the_nearer_one_is_meant() {
    let mut comb = hole();
    comb.push(block([0.122, 0.2], [-0.05, -0.01]));
    let near = |x: f64| find(&PEG, [x, 0.1, 0.0], &comb).expect("a hole").mouth[0];
    assert!(near(0.0).abs() < 1e-12);
    assert!((near(0.11) - 0.111).abs() < 1e-12);
}

#[test]
fn no_hole_is_too_wide_too_narrow_slanted_or_closed() {
    let with = |right: Vec<Vec2>| find(&PEG, [0.0, 0.1, 0.0], &[hole()[0].clone(), right]);
    // The short sides of the peg are 0.1 apart.
    let widest = 0.02 / (1.0 - MOST_CLEARANCE) - 0.011;
    assert!(with(block([0.999 * widest, 0.2], [-0.05, 0.0])).is_some());
    assert!(with(block([1.001 * widest, 0.05], [-0.05, 0.0])).is_none());
    assert!(with(block([0.0089, 0.05], [-0.05, 0.0])).is_none());
    assert!(
        with(vec![
            [0.011, -0.05],
            [0.1, -0.05],
            [0.1, 0.0],
            [0.0111, 0.0]
        ])
        .is_none()
    );
    assert!(with(block([0.011, 0.05], [0.0, 0.1])).is_none());
    let mut closed = hole();
    closed.push(block([-0.05, 0.05], [-0.02, 0.01]));
    closed.push(block([-0.05, 0.05], [-0.06, -0.04]));
    assert_eq!(find(&PEG, [0.0, 0.1, 0.0], &closed), None);
}

#[test]
fn a_body_without_parallel_sides_is_no_peg_nor_is_a_rod() {
    let wedge = [[-0.01, 0.0], [0.01, 0.0], [0.005, 0.1], [-0.005, 0.1]];
    assert_eq!(find(&wedge, [0.0, 0.1, 0.0], &hole()), None);
    assert_eq!(
        find(&[[0.0, 0.0], [0.0, 0.1]], [0.0, 0.1, 0.0], &hole()),
        None
    );
    assert_eq!(find(&[[0.0, 0.0]], [0.0, 0.1, 0.0], &hole()), None);
}
