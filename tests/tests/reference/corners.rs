//! A point, whose answers are known in closed form, past the corners of obstacles: onto the next side, off into the air, over a seam,
//! into a hollow, around a thin wall.

use stiction_tests::close;
use stiction_tests::reference::{Obstacle, Reference, Scene, Touch};

const K_H: f64 = 100.0;
const SUBSTEPS: usize = 20;
/// Larger than the position error after a touch, 1e-12 m.
const PLACE: f64 = 1e-10;

fn obstacle(vertices: &[[f64; 2]], mu: f64) -> Obstacle {
    Obstacle {
        vertices: vertices.to_vec(),
        mu_s: mu,
        mu_d: mu,
        memory: 0.001,
    }
}

/// A point held at itself.
fn point(start: [f64; 2], obstacles: Vec<Obstacle>) -> Reference {
    let scene = Scene {
        vertices: vec![[0.0, 0.0]],
        holding_point: [0.0, 0.0],
        k_h: K_H,
        k_theta: 1.0,
        weight: 0.0,
        surfaces: Vec::new(),
        obstacles,
    };
    let start = [start[0], start[1], 0.0];
    Reference::new(scene, start, start)
}

fn goes(point: &mut Reference, to: [f64; 2]) -> [f64; 2] {
    point.step([to[0], to[1], 0.0], SUBSTEPS);
    [point.pose()[0], point.pose()[1]]
}

fn at(got: [f64; 2], want: [f64; 2]) {
    close("x", got[0], want[0], PLACE);
    close("y", got[1], want[1], PLACE);
}

/// The position of a point that slides along `way` (1 or -1) on the line through `on` with a normal, for a hand at `hand`.
fn slid(hand: [f64; 2], on: [f64; 2], normal: [f64; 2], slide: f64) -> [f64; 2] {
    let tangent = [normal[1], -normal[0]];
    let along = |way: [f64; 2]| way[0] * (hand[0] - on[0]) + way[1] * (hand[1] - on[1]);
    let place = along(tangent) + slide * along(normal);
    [0, 1].map(|k| on[k] + place * tangent[k])
}

#[test]
fn a_point_slides_round_a_blunt_corner() {
    let (mu, slope) = (0.3, 0.4_f64);
    let normal = [slope.sin(), slope.cos()];
    let roof = [
        [-1.0, -1.0],
        [2.0 * slope.cos(), -2.0 * slope.sin() - 1.0],
        [2.0 * slope.cos(), -2.0 * slope.sin()],
        [0.0, 0.0],
        [-1.0, 0.0],
    ];
    let mut tool = point([-0.5, 0.1], vec![obstacle(&roof, mu)]);
    goes(&mut tool, [-0.5, -0.05]);
    at(goes(&mut tool, [-0.1, -0.05]), [-0.1 - mu * 0.05, 0.0]);
    assert_eq!(tool.contacts()[0].slides, 1);
    let hand = [0.2, -0.2];
    at(goes(&mut tool, hand), slid(hand, [0.0, 0.0], normal, mu));
    assert_eq!(
        tool.contacts()[0].touch,
        Touch::Side {
            vertex: 0,
            obstacle: 0,
            side: 2
        }
    );
    assert_eq!(
        (tool.contacts()[0].slides, tool.state()),
        (1, "single-vertex")
    );
}

#[test]
fn a_point_falls_off_a_sharp_corner_to_the_hand() {
    let table = [[-1.0, -0.5], [0.0, -0.5], [0.0, 0.0], [-1.0, 0.0]];
    let mut tool = point([-0.2, 0.1], vec![obstacle(&table, 0.3)]);
    goes(&mut tool, [-0.2, -0.05]);
    at(goes(&mut tool, [0.014, -0.05]), [-0.001, 0.0]);
    at(goes(&mut tool, [0.016, -0.05]), [0.016, -0.05]);
    assert_eq!(tool.state(), "non-contact");
    // It returns from the side.
    at(goes(&mut tool, [-0.01, -0.05]), [0.0, -0.05]);
}

#[test]
fn a_point_does_not_notice_a_seam() {
    let left = [[-1.0, -0.5], [0.0, -0.5], [0.0, 0.0], [-1.0, 0.0]];
    for from in [0.0, -0.25] {
        let right = [[from, -0.5], [1.0, -0.5], [1.0, 0.0], [from, 0.0]];
        for pieces in [[left, right], [right, left]] {
            let obstacles = pieces.map(|piece| obstacle(&piece, 0.3)).to_vec();
            let mut tool = point([-0.5, 0.1], obstacles);
            goes(&mut tool, [-0.5, -0.05]);
            at(goes(&mut tool, [0.5, -0.05]), [0.5 - 0.3 * 0.05, 0.0]);
            // It sticks, then slides; nothing else happens.
            assert_eq!((tool.events(), tool.slips()), (1, 0));
            at(goes(&mut tool, [-0.5, -0.05]), [-0.5 + 0.3 * 0.05, 0.0]);
        }
    }
}

#[test]
fn a_point_is_held_in_the_hollow_of_a_hook() {
    let floor = [[-1.0, -0.5], [0.5, -0.5], [0.5, 0.0], [-1.0, 0.0]];
    let hook = [[0.0, -0.2], [0.2, -0.2], [0.2, 0.3], [0.0, 0.3]];
    let mut tool = point(
        [-0.5, 0.1],
        vec![obstacle(&floor, 0.3), obstacle(&hook, 0.2)],
    );
    goes(&mut tool, [-0.5, -0.05]);
    at(goes(&mut tool, [0.1, -0.05]), [0.0, 0.0]);
    assert_eq!(tool.state(), "corner");
    at(goes(&mut tool, [-0.3, -0.05]), [-0.3 + 0.3 * 0.05, 0.0]);
}

#[test]
fn a_point_goes_round_a_thin_wall_but_not_through_it() {
    let wall = [[-0.3, 0.0], [0.3, 0.0]];
    let above = |x: f64| [x, 0.1];
    let below = |x: f64| [x, -0.1];
    let mut tool = point(above(0.0), vec![obstacle(&wall, 5.0)]);
    at(goes(&mut tool, below(0.0)), [0.0, 0.0]);
    assert_eq!(tool.contacts()[0].normal, 0.1 * K_H);
    at(goes(&mut tool, above(0.0)), above(0.0));
    at(goes(&mut tool, above(0.4)), above(0.4));
    at(goes(&mut tool, below(0.4)), below(0.4));
    at(goes(&mut tool, below(0.0)), below(0.0));
    at(goes(&mut tool, above(0.0)), [0.0, 0.0]);
    assert_eq!(
        tool.contacts()[0].touch,
        Touch::Side {
            vertex: 0,
            obstacle: 0,
            side: 0
        }
    );
}

/// One end of a rod stands on a thin wall that ends below its middle: as it turns down, it comes to lie on the wall's end. It must not
/// pass through to the other side, which its end touches as well.
#[test]
fn a_rod_does_not_turn_through_the_end_of_a_wall() {
    let scene = Scene {
        vertices: vec![[-0.5, 0.0], [0.5, 0.0]],
        holding_point: [-0.35, 0.0],
        k_h: K_H,
        k_theta: 1.0,
        weight: 0.0,
        surfaces: Vec::new(),
        obstacles: vec![obstacle(&[[-1.0, 0.0], [0.0, 0.0]], 0.5)],
    };
    let (sin, cos) = 0.2_f64.sin_cos();
    let start = [0.5 * cos - 0.3, 0.5 * sin, 0.2];
    let held = [start[0] - 0.35 * cos, start[1] - 0.35 * sin, 0.2];
    let mut rod = Reference::new(scene, start, held);
    assert_eq!(rod.state(), "single-vertex");
    for i in 1..=20 {
        let part = f64::from(i) / 20.0;
        rod.step([held[0], held[1] - 0.1 * part, 0.2 - 0.4 * part], SUBSTEPS);
    }
    close("angle", rod.pose()[2], 0.0, PLACE);
    let touches: Vec<_> = rod.contacts().iter().map(|contact| contact.touch).collect();
    let end = Touch::Side {
        vertex: 0,
        obstacle: 0,
        side: 1,
    };
    let corner = Touch::Corner {
        obstacle: 0,
        corner: 1,
        body_side: 0,
    };
    assert_eq!(touches, [end, corner]);
}

/// Two thin walls that meet, seen from below one of them: where the point reaches their junction, the other wall continues above.
#[test]
fn a_point_below_a_bent_wall_does_not_touch_its_upper_side() {
    let across = [[0.0, 0.0], [2.0, 0.0]];
    let up = [[-0.4, 1.5], [0.0, 0.0]];
    for walls in [[across, up], [up, across]] {
        let walls = walls.map(|wall| obstacle(&wall, 0.3)).to_vec();
        let mut tool = point([0.5, -0.1], walls);
        goes(&mut tool, [0.5, 0.05]);
        // Friction holds it back.
        at(goes(&mut tool, [0.02, 0.05]), [0.02 + 0.3 * 0.05, 0.0]);
        // Past the end it is free.
        for k in 1..10 {
            goes(&mut tool, [0.02 - 0.022 * f64::from(k), 0.05]);
        }
        at(goes(&mut tool, [-0.2, 0.05]), [-0.2, 0.05]);
        assert_eq!(tool.state(), "non-contact");
    }
}
