//! The separation of the body from an obstacle, and the normals of the body's sides.

use super::*;
use crate::fixtures::Random;

/// Points of a shape, turned and shifted.
fn placed(points: &[[f64; 2]], [x, y, angle]: [f64; 3]) -> List<Vec2<f64>> {
    let (sin, cos) = angle.sin_cos();
    let place = |&[a, b]: &[f64; 2]| Vec2::new(x + cos * a - sin * b, y + sin * a + cos * b);
    points.iter().map(place).collect()
}

/// The largest gap between two shapes along many directions: the axes find no less, as the best direction is one of them wherever the
/// shapes overlap.
fn by_many_directions(a: &[Vec2<f64>], b: &[Vec2<f64>]) -> f64 {
    const DIRECTIONS: u32 = if cfg!(miri) { 360 } else { 36_000 };
    let gaps = (0..DIRECTIONS).map(|k| {
        let (sin, cos) = (core::f64::consts::TAU * f64::from(k) / f64::from(DIRECTIONS)).sin_cos();
        let along = |p: &Vec2<f64>| p.dot(Vec2::new(cos, sin));
        let low = b.iter().map(along).fold(f64::INFINITY, f64::min);
        low - a.iter().map(along).fold(f64::NEG_INFINITY, f64::max)
    });
    gaps.fold(f64::NEG_INFINITY, f64::max)
}

const SHAPES: [&[[f64; 2]]; 4] = [
    &[[0.1, 0.0]],
    &[[-0.5, 0.1], [0.5, -0.1]],
    &[[-0.4, -0.3], [0.4, -0.3], [0.0, 0.6]],
    &[[-0.5, -0.3], [0.5, -0.3], [0.5, 0.3], [-0.5, 0.3]],
];

/// The separation of overlapping shapes is how far they must be moved apart; separate shapes have a gap that is no larger than their
/// distance.
#[test]
fn separation_is_the_depth_of_shapes_that_overlap() {
    let mut random = Random(3);
    for (body, obstacle) in SHAPES.iter().flat_map(|a| SHAPES.map(|b| (*a, b))) {
        let mut overlaps = 0;
        for _ in 0..if cfg!(miri) { 2 } else { 20 } {
            let pose = [0.0; 3].map(|_| 0.4 * random.next());
            let away = [pose[0], pose[1] + 9.0, pose[2]];
            let mut setup = Setup::of(&[shape(obstacle)]);
            (setup.body, setup.start) = (body.to_vec(), away);
            let mut scene: Among<f64> = setup.scene().expect("apart");
            let size = scene.units.length_to_si(1.0);
            scene.start.position = scene.units.point_from_si([pose[0], pose[1]]);
            let found = size * Placed::at(&scene.start).separation(&scene, 0);
            let there = placed(body, pose);
            let exact = by_many_directions(&there, &placed(obstacle, [0.0; 3]));
            let points = body.len() + obstacle.len() == 2;
            if points {
                // There is no axis: they do not touch.
                assert!(found > 1e9);
            } else if exact < 0.0 {
                overlaps += 1;
                assert!((found - exact).abs() < 1e-3, "{found} {exact}");
            } else {
                assert!(-1e-9 <= found && found < exact + 1e-3, "{found} {exact}");
            }
        }
        let solid = |a: &[[f64; 2]]| a.len() > 2;
        assert!(overlaps > 0 || cfg!(miri) || !(solid(body) && solid(obstacle)));
    }
}

/// A rod collinear with a wall, or next to its end: only the directions at their ends have a gap there.
#[test]
fn rod_and_wall_have_axes_at_their_ends() {
    let from_wall = |body: &[[f64; 2]], start: [f64; 3]| {
        let mut setup = Setup::of(&[shape(&[[0.0, 0.0], [1.0, 0.0]])]);
        (setup.body, setup.start) = (body.to_vec(), start);
        let scene: Among<f64> = setup.scene().expect("apart");
        Placed::at(&scene.start).separation(&scene, 0)
    };
    for turn in [0.0, core::f64::consts::PI] {
        for x in [1.75, -0.75] {
            let found = from_wall(SHAPES[1], [x, 0.0, turn + 0.2_f64.atan()]);
            // The rod is 1.02 long, and so the largest gap is along the wall.
            assert!(found > 0.2, "{found}");
        }
        let found = from_wall(&[[-0.5, 0.0], [0.5, 0.0]], [1.75, 0.0, turn]);
        assert!((found - 0.25).abs() < 1e-12, "{found}");
    }
    for x in [1.25, -0.25] {
        assert_eq!(from_wall(&[[0.0, 0.0]], [x, 0.0, 0.0]), 0.25);
    }
}
