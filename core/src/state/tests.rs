//! A body whose contacts touch to within a tolerance is seated on them: by a turn if that is enough, so that the foot stays; otherwise by
//! the least displacement that closes the gaps.

use super::*;
use crate::fixtures::{self, pivot};
use crate::geometry::{Angle, Orientation};
use crate::model::Model;
use crate::scene::{Description, Scene, SurfaceDescription};

mod absent;
mod among;
mod attempts;
mod ends;
mod unsure;

pub(in crate::state) type Room = Scene<f64, 4, 4>;

/// A block of 0.8 x 0.6, vertex 0 at the origin, among a floor and planes through given points, with normals at given angles (rad) from the
/// floor's.
pub(in crate::state) fn scene(planes: &[(f64, [f64; 2])]) -> Room {
    let surface = |angle: f64, [x, y]: [f64; 2]| {
        let (sin, cos) = libm::sincos(angle);
        SurfaceDescription {
            normal: [-sin, cos],
            offset: cos * y - sin * x,
            friction_static: 0.5,
            friction_dynamic: 0.3,
            memory: None,
        }
    };
    let mut surfaces = [surface(0.0, [0.0; 2]); 4];
    for (place, &(angle, point)) in surfaces[1..].iter_mut().zip(planes) {
        *place = surface(angle, point);
    }
    // It starts where it is inside no surface.
    let description = Description {
        vertices: &[[0.0, 0.0], [0.8, 0.0], [0.8, 0.6], [0.0, 0.6]],
        start: [0.0; 3],
        weight: 0.0,
        holding_point: None,
        reach: 0.0,
        stiffness_translation: 1.0,
        stiffness_rotation: 1.0,
        surfaces: &surfaces[..=planes.len()],
        obstacles: &[],
    };
    let places = [0.0, -100.0, 100.0]
        .into_iter()
        .flat_map(|x| [1e-6, 1.0, 100.0].map(|y| [x, y, 0.0]));
    let mut found = places.map(|start| {
        Scene::new(&Description {
            start,
            ..description
        })
    });
    found.find_map(Result::ok).expect("a sound scene")
}

/// A body on a floor with a coefficient of friction (static; half of it dynamic).
fn on_floor<const V: usize, M: Model>(
    vertices: &[[f64; 2]],
    (weight, stiffness): (f64, f64),
    mu: f64,
) -> Scene<f64, V, 1, M> {
    let floor = SurfaceDescription {
        normal: [0.0, 1.0],
        offset: 0.0,
        friction_static: mu,
        friction_dynamic: mu / 2.0,
        memory: None,
    };
    let scene = Scene::new(&Description {
        vertices,
        start: [0.0, 2.0, 0.0],
        weight,
        holding_point: Some([0.5, 0.0]),
        reach: 0.0,
        stiffness_translation: 1.0,
        stiffness_rotation: stiffness,
        surfaces: &[floor],
        obstacles: &[],
    });
    scene.expect("a sound scene")
}

pub(in crate::state) fn pair(vertex: u8, surface: u8) -> Pair {
    Pair { vertex, surface }
}

#[track_caller]
fn closed(scene: &Room, pivot: &Pivot<f64>, others: &[Pair]) {
    for &other in others {
        let gap = pivot.placed(scene).gap(scene, other);
        assert!(
            gap.abs() <= 2.0 * <f64 as Real>::EPSILON,
            "{other:?}: {gap}"
        );
    }
}

fn turn(pivot: &Pivot<f64>) -> f64 {
    pivot.orientation.angle().radians()
}

const OFF: f64 = 3e-6;

#[test]
fn turn_alone_seats_an_edge_and_two_vertices() {
    let wall = scene(&[(core::f64::consts::FRAC_PI_2, [0.8, 0.0])]);
    for (begin, other) in [
        (OFF, pair(1, 0)),
        (-OFF, pair(1, 0)),
        (OFF, pair(2, 1)),
        (-OFF, pair(2, 1)),
    ] {
        let seated = seat(&wall, pivot(begin), &[other]);
        closed(&wall, &seated, &[other]);
        assert_eq!(seated.foot, 0.0);
        assert!(turn(&seated).abs() < 1e-9, "{}", turn(&seated));
        // A body that is seated does not move by a bit.
        assert_eq!(seat(&wall, seated, &[other]), seated);
    }
}

/// A wall through the vertex itself, upright or leaning, which no turn brings closer.
#[test]
fn shift_seats_a_vertex_in_a_corner() {
    for angle in [0.02, 0.3, 1.0, 1.6, 2.5, 3.1] {
        let off = OFF / libm::sin(angle);
        let corner = scene(&[(angle, [off, 0.0])]);
        let seated = seat(&corner, pivot(0.2), &[pair(0, 1)]);
        closed(&corner, &seated, &[pair(0, 1)]);
        assert!((seated.foot - off).abs() < 1e-9 && turn(&seated) == 0.2);
    }
    // If two surfaces are parallel to within 1/64, no shift along one brings it to the other.
    let wedge = scene(&[(0.01, [OFF / libm::sin(0.01), 0.0])]);
    assert_eq!(seat(&wedge, pivot(0.2), &[pair(0, 1)]), pivot(0.2));
    // Nor does a turn about a vertex exactly above which the other one meets a ceiling; a shift along it does not either.
    let ceiling = scene(&[(core::f64::consts::PI, [0.0, 0.6 + OFF])]);
    let upright = pivot(0.0);
    assert_eq!(seat(&ceiling, upright, &[pair(3, 1)]), upright);
}

/// Flat on the floor and against a wall: with the smallest slide and turn.
#[test]
fn slide_and_turn_seat_a_locked_body() {
    let wall = scene(&[(core::f64::consts::FRAC_PI_2, [0.8 + OFF, 0.0])]);
    let others = [pair(1, 0), pair(1, 1), pair(2, 1)];
    for begin in [0.0, OFF, -2.0 * OFF] {
        let seated = seat(&wall, pivot(begin), &others);
        closed(&wall, &seated, &others);
        assert!((seated.foot - OFF).abs() < 1e-9 && turn(&seated).abs() < 1e-9);
    }
}

/// A lever of 1/64 of the body or less is too short to turn by.
#[test]
fn short_lever_does_not_seat() {
    for (lever, is_seated) in [
        (1.0 / 128.0, false),
        (1.0 / 64.0, false),
        (1.0 / 32.0, true),
    ] {
        // The third vertex makes the body as large as 1.
        let vertices = [[0.0, 0.0], [5.0 * lever, 5.0 * OFF], [3.0, 4.0]];
        let scene = fixtures::scene::<3, 1>(&vertices, &[0.0]);
        assert_eq!(scene.vertex(1).x, lever);
        let upright = pivot(0.0);
        let seated = seat(&scene, upright, &[pair(1, 0)]);
        if is_seated {
            let gap = seated.placed(&scene).gap(&scene, pair(1, 0));
            assert!(gap.abs() <= 2.0 * <f64 as Real>::EPSILON);
        } else {
            assert_eq!(seated, upright);
        }
    }
}
