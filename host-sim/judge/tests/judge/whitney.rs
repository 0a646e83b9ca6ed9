//! The meter against known results for a peg in a hole: the exact balance of OBSTACLES 11, the wedging table, the parallelogram.

use proptest::prelude::*;
use stiction_judge::insertion::{
    Diagram, Insertion, Meter, Reaction, Springs, Verdict, deepest_wedge, least_friction,
};

use crate::peg_and_hole::among;

type Vec2 = [f64; 2];

const RADIUS: f64 = 0.01;
const PEG: [Vec2; 4] = [[-RADIUS, 0.0], [RADIUS, 0.0], [RADIUS, 0.1], [-RADIUS, 0.1]];

/// A plate with a through hole around x = 0, its top at y = 0.
fn plate(width: f64) -> [Vec<Vec2>; 2] {
    let half = 0.5 * width;
    [
        vec![[-0.04, -0.2], [-half, -0.2], [-half, 0.0], [-0.04, 0.0]],
        vec![[half, -0.2], [0.04, -0.2], [0.04, 0.0], [half, 0.0]],
    ]
}

fn meter(width: f64, friction: f64) -> Meter {
    let plate = plate(width);
    let obstacles = [&plate[0], &plate[1]].map(|wall| (wall, friction));
    Meter::find(&among(&PEG, [0.0; 3], &obstacles)).expect("a peg in a hole")
}

/// Corner of the mouth at `left` on the peg's left side.
fn at_mouth(theta: f64, half: f64, [normal, friction]: Vec2) -> Reaction {
    Reaction {
        point: [-half, 0.0],
        direction: [theta.cos(), theta.sin()],
        normal,
        friction,
    }
}

/// The right end of the tip on the right wall.
fn at_tip(pose: [f64; 3], [normal, friction]: Vec2) -> Reaction {
    let (sin, cos) = pose[2].sin_cos();
    Reaction {
        point: [pose[0] + RADIUS * cos, pose[1] + RADIUS * sin],
        direction: [-1.0, 0.0],
        normal,
        friction,
    }
}

/// F_z along the hole's axis.
fn along_the_hole(theta: f64, insertion: &Insertion) -> f64 {
    theta.cos() * insertion.fz - theta.sin() * insertion.fx
}

fn near(value: f64, expected: f64, relative: f64) {
    assert!(
        (value - expected).abs() <= relative * expected.abs(),
        "{value} instead of {expected}"
    );
}

/// The springs of the case: the hand at x = -0.0014 and tilted by 0.01.
fn springs(hand_y: f64, pose: [f64; 3]) -> Springs {
    let (sin, cos) = pose[2].sin_cos();
    let (k, k_t, grip) = (5000.0, 30.0, 0.04);
    let holding = [pose[0] - grip * sin, pose[1] + grip * cos];
    let hand = [-0.0014, hand_y];
    Springs {
        translation: k,
        rotation: k_t,
        hand,
        wrench: [
            k * (hand[0] - holding[0]),
            k * (hand[1] - holding[1]),
            k_t * (0.01 - pose[2]),
        ],
    }
}

#[test]
fn the_exact_two_point_force_is_along_the_hole_and_the_meters_along_the_peg() {
    let pose = [
        5.0505727549476264e-05,
        -0.009942832238099393,
        0.010057154788573396,
    ];
    let meter = meter(0.0201, 0.1);
    let contacts = [
        at_mouth(pose[2], 0.01005, [20.480653386152184, -2.0480653386152183]),
        at_tip(pose, [15.21788867217324, 1.521788867217324]),
    ];
    let found = meter.read(pose, &contacts).expect("in the hole");
    near(found.depth, 9.842262e-3, 1e-7);
    near(along_the_hole(pose[2], &found), 3.775724, 1e-7);
    near(found.fz, 3.722823, 1e-6);
    assert_eq!(found.verdict, Verdict::TwoPoint);
    // The hand's force and moment, about the middle of the tip, balance the walls.
    let springs = springs(0.0293, pose);
    let [fx, fy, moment] = springs.wrench;
    let (sin, cos) = pose[2].sin_cos();
    near(cos * fx + sin * fy, found.fx, 1e-8);
    near(sin * fx - cos * fy, found.fz, 1e-8);
    near(moment - 0.04 * found.fx, found.m, 1e-8);
    let small = meter.small_angles(found.depth, pose, &springs);
    // The formula uses t_0 instead of sin t_0.
    near(small.two_points.expect("both press"), 3.515731, 2e-5);
}

/// The peg touches one wall of the hole.
const AT_ONE_POINT: [f64; 3] = [
    9.89508674685311e-06,
    -0.0039814820311927495,
    0.014768415728413909,
];

#[test]
fn with_one_point_the_ratio_along_the_peg_is_that_of_the_friction() {
    let pose = AT_ONE_POINT;
    let meter = meter(0.0201, 0.1);
    let contact = at_mouth(pose[2], 0.01005, [4.102405410589903, -0.41024054105899027]);
    let found = meter.read(pose, &[contact]).expect("in the hole");
    near(found.depth, 3.833803e-3, 1e-6);
    near(found.fx / found.fz, -10.0, 1e-12);
    near(found.fz, 0.4102405, 1e-6);
    near(along_the_hole(pose[2], &found), 0.470780, 1e-6);
    assert_eq!(found.verdict, Verdict::OnePoint);
    let small = meter.small_angles(found.depth, pose, &springs(0.03592, pose));
    near(small.one_point.expect("it touches"), 0.407740, 2e-5);
}

#[test]
fn half_the_friction_at_the_same_place_is_jammed() {
    let pose = AT_ONE_POINT;
    let meter = meter(0.0201, 0.1);
    let found = |friction: f64| {
        let contact = at_mouth(pose[2], 0.01005, [4.0, -4.0 * friction]);
        meter.read(pose, &[contact]).expect("in the hole")
    };
    assert_eq!(found(0.05).verdict, Verdict::Jammed);
    // Pulled out: no load pushes it in.
    let drawn = found(-0.05);
    assert_eq!((drawn.verdict, drawn.margin), (Verdict::OnePoint, None));
    // Friction above the dynamic one.
    assert_eq!(found(0.12).verdict, Verdict::OnePoint);
}

#[test]
fn what_stands_on_the_bottom_is_not_jammed() {
    let meter = meter(0.0201, 0.1);
    let pose = [-5e-5, -0.1, 0.0];
    let wall = Reaction {
        point: [-0.01005, -0.05],
        direction: [1.0, 0.0],
        normal: 1.0,
        friction: -0.01,
    };
    let bottom = Reaction {
        point: [0.0, -0.1],
        direction: [0.0, 1.0],
        normal: 5.0,
        friction: 0.0,
    };
    let read = |contacts: &[Reaction]| meter.read(pose, contacts).expect("in the hole");
    assert_eq!(read(&[wall]).verdict, Verdict::Jammed);
    let stands = read(&[wall, bottom]);
    assert_eq!((stands.verdict, stands.margin), (Verdict::OnePoint, None));
    near(stands.fz, 0.01, 1e-12);
    assert_eq!(read(&[bottom]).verdict, Verdict::Free);
}

#[test]
fn only_a_peg_in_its_hole_has_a_reading() {
    let meter = meter(0.0201, 0.1);
    assert_eq!(
        meter
            .read([0.0, -0.01, 0.0], &[])
            .map(|found| found.verdict),
        Some(Verdict::Free)
    );
    assert_eq!(meter.read([0.0, 1e-6, 0.0], &[]), None);
    // Only the lower end of a tilted tip is below the mouth.
    assert_eq!(meter.read([0.0, -1e-5, 0.01], &[]), None);
    // Next to the plate, and through it.
    assert_eq!(meter.read([0.1, -0.01, 0.0], &[]), None);
    assert_eq!(meter.read([0.0, -0.31, 0.0], &[]), None);
}

#[test]
fn the_wedging_table() {
    let table = [
        (0.1, 0.001, 0.0893364987),
        (0.2, 0.001, 0.1947332535),
        (0.2, 0.005, 0.1721220497),
        (0.3, 0.01, 0.2613599051),
        (0.5, 0.01, 0.4744733923),
    ];
    for (friction, clearance, expected) in table {
        near(
            deepest_wedge(friction, clearance).expect("it wedges"),
            expected,
            1e-9,
        );
    }
}

/// The verdict on a peg in two-point contact at l = `part` D_h, c = 0.001.
fn two_points(friction: f64, part: f64) -> Verdict {
    let width = 2.0 * RADIUS / 0.999;
    let alpha = part.atan();
    let theta = (0.999 * alpha.cos()).acos() - alpha;
    let (sin, cos) = theta.sin_cos();
    // The right end of the tip on the right wall, l deep.
    let pose = [
        0.5 * width - RADIUS * cos,
        -part * width - RADIUS * sin,
        theta,
    ];
    let contacts = [
        at_mouth(theta, 0.5 * width, [1.0, 0.0]),
        at_tip(pose, [1.0, 0.0]),
    ];
    let found = meter(width, friction).read(pose, &contacts);
    found.expect("in the hole").verdict
}

#[test]
fn a_peg_is_wedged_below_the_root_of_four_clearances_and_above_that_of_two() {
    let (clearance, friction) = (0.001, 0.06);
    assert!(friction < 2.0 * f64::sqrt(clearance));
    let deepest = deepest_wedge(friction, clearance).expect("it wedges");
    near(deepest, 0.04, 2e-3);
    assert_eq!(two_points(friction, 0.999 * deepest), Verdict::Wedged);
    assert_ne!(two_points(friction, 1.001 * deepest), Verdict::Wedged);
    let least = least_friction(clearance);
    near(least, f64::sqrt(2.0 * clearance), 1e-3);
    assert!(deepest_wedge(1.000001 * least, clearance).is_some());
    assert_eq!(deepest_wedge(0.999999 * least, clearance), None);
}

/// The reaction at one contact of an upright peg that slides in: on the peg's side +1 (x) or -1, at this height above the tip.
fn slides_in(friction: f64, side: f64, height: f64) -> Reaction {
    Reaction {
        point: [side * RADIUS, height],
        direction: [-side, 0.0],
        normal: 1.0,
        // Upwards on the body.
        friction: side * friction,
    }
}

proptest! {
    #[test]
    fn the_corners_are_the_loads_of_one_point(friction in 0.05_f64..1.0, depth in 1e-3_f64..0.05) {
        let meter = meter(2.0 * RADIUS * (1.0 + 1e-9), friction);
        let lambda = meter.lambda(depth).expect("friction");
        let corners = Diagram { friction, lambda }.corners();
        let places = [(1.0, 0.0), (-1.0, depth), (-1.0, 0.0), (1.0, depth)];
        for (corner, (side, height)) in corners.into_iter().zip(places) {
            let contact = slides_in(friction, side, height - depth);
            let found = meter.read([0.0, -depth, 0.0], &[contact]).expect("in the hole");
            let load = found.load(RADIUS).expect("it is pressed in");
            prop_assert!((load[0] - corner[0]).abs() < 1e-9 / friction, "{load:?} {corner:?}");
            prop_assert!((load[1] - corner[1]).abs() < 1e-9 * (1.0 + lambda), "{load:?} {corner:?}");
        }
    }

    #[test]
    fn two_points_that_slide_in_are_on_a_line_and_less_friction_is_outside(
        friction in 0.05_f64..1.0, deeper in 0.01_f64..5.0, share in 0.01_f64..0.99, less in 0.1_f64..0.95,
    ) {
        // Deeper than the wedging depth.
        let depth = 2.0 * RADIUS * friction * (1.0 + deeper);
        let meter = meter(2.0 * RADIUS * (1.0 + 1e-9), friction);
        let load = |mu: f64| {
            let contact = |part: f64, side: f64, y: f64| {
                let contact = slides_in(mu, side, y);
                Reaction { normal: part, friction: part * contact.friction, ..contact }
            };
            let contacts = [contact(share, -1.0, 0.0), contact(1.0 - share, 1.0, -depth)];
            meter.read([0.0, -depth, 0.0], &contacts).expect("in the hole")
        };
        let (slides, sticks) = (load(friction), load(less * friction));
        prop_assert!(slides.margin.expect("pressed in").abs() < 1e-9 / friction);
        prop_assert_eq!(slides.verdict, Verdict::TwoPoint);
        prop_assert!(sticks.margin.expect("pressed in") < 0.0);
        prop_assert_eq!(sticks.verdict, Verdict::Jammed);
    }

    #[test]
    fn the_margin_is_the_distance_to_the_nearest_side(
        friction in 0.05_f64..1.0, lambda in 0.0_f64..20.0, across in -1.0_f64..1.0, up in -1.0_f64..1.0,
    ) {
        let diagram = Diagram { friction, lambda };
        let load = [across / friction, up * lambda - friction * (1.0 + lambda) * across / friction];
        let corners = diagram.corners();
        let to_side = |k: usize| {
            let ([x, y], [to_x, to_y]) = (corners[k], corners[(k + 1) % 4]);
            let way = [to_x - x, to_y - y];
            (way[0] * (load[1] - y) - way[1] * (load[0] - x)) / way[0].hypot(way[1])
        };
        // A parallelogram with lambda = 0 is a line.
        prop_assume!(lambda > 1e-3);
        for (k, distance) in diagram.distances(load).into_iter().enumerate() {
            prop_assert!((distance - to_side(k)).abs() < 1e-9 * (1.0 / friction + lambda), "side {k}");
        }
        prop_assert!(diagram.margin(load) >= -1e-9 / friction);
        for corner in corners {
            prop_assert!(diagram.margin(corner.map(|part| 1.01 * part)) < 0.0);
        }
    }

    #[test]
    fn a_world_that_is_turned_and_moved_has_the_same_reading(turn in -3.0_f64..3.0, x in -1.0_f64..1.0, y in -1.0_f64..1.0) {
        let (sin, cos) = f64::sin_cos(turn);
        let turned = |p: Vec2| [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1]];
        let moved = |p: Vec2| { let [a, b] = turned(p); [a + x, b + y] };
        let plate = plate(0.0201).map(|vertices| vertices.into_iter().map(moved).collect::<Vec<_>>());
        let obstacles = [&plate[0], &plate[1]].map(|wall| (wall, 0.1));
        let pose = [5.05e-5, -0.0099428, 0.01005715];
        let placed = |[px, py, theta]: [f64; 3]| { let [a, b] = moved([px, py]); [a, b, theta + turn] };
        let scene = among(&PEG, placed([0.0, 0.0, 0.0]), &obstacles);
        let there = Meter::find(&scene).expect("a peg in a hole");
        let contacts = [at_mouth(pose[2], 0.01005, [20.0, -2.0]), at_tip(pose, [15.0, 1.5])];
        let carried = contacts.map(|contact| Reaction {
            point: moved(contact.point),
            direction: turned(contact.direction),
            ..contact
        });
        let (here, there) = (
            meter(0.0201, 0.1).read(pose, &contacts).expect("in the hole"),
            there.read(placed(pose), &carried).expect("in the hole"),
        );
        prop_assert!((here.depth - there.depth).abs() < 1e-12);
        prop_assert!((here.fx - there.fx).abs() < 1e-9 && (here.fz - there.fz).abs() < 1e-9);
        prop_assert!((here.m - there.m).abs() < 1e-9);
        prop_assert_eq!(here.verdict, there.verdict);
    }
}
