//! The side of a thin wall on which a rod or a point is; neither has an inside in common with the wall.

extern crate std;

use super::super::Placed;
use super::*;
use crate::contact::{Pair, Pairs};
use crate::geometry::{Angle, Orientation, Vec2};
use crate::model::WithObstacles;
use crate::motion::Instant;
use crate::scene::{Description, ObstacleDescription, Scene, SurfaceDescription};
use std::vec::Vec;

type Scenery = Scene<f64, 4, 1, WithObstacles<4, 16>>;

/// A body among obstacles of the same friction.
fn scene(body: &[[f64; 2]], obstacles: &[&[[f64; 2]]]) -> Scenery {
    scene_on(body, &[], obstacles)
}

/// A body on half-planes among obstacles of the same friction.
fn scene_on(
    body: &[[f64; 2]],
    surfaces: &[SurfaceDescription<f64>],
    obstacles: &[&[[f64; 2]]],
) -> Scenery {
    let list: Vec<_> = obstacles
        .iter()
        .map(|vertices| ObstacleDescription {
            vertices,
            friction_static: 0.5,
            friction_dynamic: 0.25,
            memory: None,
        })
        .collect();
    let description = Description {
        vertices: body,
        start: [0.3, 3.0, 0.0],
        weight: 0.0,
        holding_point: Some([0.0, 0.0]),
        reach: 0.0,
        stiffness_translation: 1.0,
        stiffness_rotation: 1.0,
        surfaces,
        obstacles: &list,
    };
    Scene::new(&description).expect("a sound scene")
}

const ROD: [[f64; 2]; 2] = [[0.0, 0.0], [1.0, 0.0]];
const POINT: [[f64; 2]; 1] = [[0.0, 0.0]];
/// From the origin to the right: the normal of its side 1 is up.
const WALL: [[f64; 2]; 2] = [[0.0, 0.0], [2.0, 0.0]];

fn placed(x: f64, y: f64, angle: f64) -> Placed<f64> {
    Placed {
        point: Vec2::new(x, y),
        body_point: Vec2::ZERO,
        orientation: Orientation::new(Angle::from_radians(angle)),
        on: None,
    }
}

fn v(vertex: u8, surface: u8) -> Pair {
    Pair { vertex, surface }
}

/// The body moves and turns at constant rates from a given pose.
fn course(from: Placed<f64>, velocity: Vec2<f64>, turn: f64) -> impl Fn(f64) -> Instant<f64> {
    move |x| Instant {
        placed: Placed {
            point: from.point + velocity * x,
            orientation: from.orientation.plus(turn * x),
            ..from
        },
        velocity,
        turn,
    }
}

fn reached(
    scene: &Scenery,
    known: Known<'_>,
    course: impl Fn(f64) -> Instant<f64>,
) -> Option<(f64, Pair)> {
    let (found, _) = first_reached(scene, (known, Among::Obstacles), 1.0, (&course, 1));
    found.map(|reached| {
        assert!(!reached.unsure);
        (reached.x, reached.contact)
    })
}

/// A rod that lies flat on a thin wall turns about one of its ends away from the wall only, even at the end of the wall.
#[test]
fn rod_on_a_thin_wall_stays_on_its_side() {
    let scene = scene(&ROD, &[&WALL]);
    for x in [0.0, 0.5, 1.0] {
        let flat = placed(x, 0.0, 0.0);
        for (side, away) in [(1, 1.0), (0, -1.0)] {
            let lasting = [v(0, side)];
            let turns = |turn: f64| {
                let course = course(flat, Vec2::ZERO, turn);
                reached(&scene, Known::of(&lasting), course)
            };
            assert_eq!(turns(away), None, "{x} {side}");
            assert_eq!(turns(-away), Some((0.0, v(1, side))), "{x} {side}");
        }
    }
}

/// A point in the corner between two thin walls, on one of them, reaches the side of the other one that it faces.
#[test]
fn point_between_thin_walls_stays_between() {
    let scene = scene(&POINT, &[&WALL, &[[0.0, 0.0], [1.0, 2.0]]]);
    let there = placed(0.0, 0.0, 0.0);
    let lasting = [v(0, 1)];
    let goes = |x: f64, y: f64| {
        let course = course(there, Vec2::new(x, y), 0.0);
        reached(&scene, Known::of(&lasting), course)
    };
    assert_eq!(goes(1.0, 0.0), None);
    assert_eq!(goes(-1.0, 0.0), Some((0.0, v(0, 2))));
}

/// A point that has just left a thin wall is on that side of it, whatever the rounding, and comes back to it.
#[test]
fn point_that_has_left_a_thin_wall_stays_on_its_side() {
    let scene = scene(&POINT, &[&WALL]);
    for off in [-1e-16, 0.0, 1e-16, 1e-12] {
        for (side, up) in [(1, 1.0), (0, -1.0)] {
            let left = [v(0, side)];
            let goes = |x: f64, y: f64| {
                let known = Known {
                    lasting: &[],
                    left: &left,
                    watch: Watch::NONE,
                };
                let course = course(placed(1.0, off, 0.0), Vec2::new(x, y), 0.0);
                reached(&scene, known, course)
            };
            assert_eq!(goes(0.1, up), None, "{off} {side}");
            let (x, pair) = goes(0.1, -up).expect("it comes back");
            assert!(x <= 2e-12 && pair == v(0, side), "{x} {pair:?}");
        }
    }
}

/// Where three walls meet, a point touches only the two that bound its region; a rod in the corner of two boxes touches only sides that
/// face it.
#[test]
fn contacts_at_one_place_bound_one_free_place() {
    let walls = scene(
        &POINT,
        &[&WALL, &[[0.0, 0.0], [1.0, 2.0]], &[[0.0, 0.0], [-1.0, 2.0]]],
    );
    let there = placed(0.0, 0.0, 0.0);
    let beside = [[v(0, 1), v(0, 2)], [v(0, 3), v(0, 4)]];
    for pair in [v(0, 0), v(0, 1), v(0, 2), v(0, 3), v(0, 4), v(0, 5)] {
        for other in [v(0, 0), v(0, 1), v(0, 2), v(0, 3), v(0, 4), v(0, 5)] {
            let both = |list: &[Pair; 2]| list.contains(&pair) && list.contains(&other);
            let may_be = pair != other && beside.iter().any(both);
            assert_eq!(
                there.are_one(&walls, [pair, other]),
                !may_be,
                "{pair:?} {other:?}"
            );
        }
    }
    let left: [[f64; 2]; 4] = [[-1.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-1.0, 0.0]];
    let boxed = scene(&ROD, &[&WALL, &left]);
    // Flat on the top of the box, with one of its ends at the edge of the box: this does not touch the other side of the box.
    let flat = placed(0.0, 0.0, core::f64::consts::PI);
    assert!(flat.are_one(&boxed, [v(1, 4), v(0, 3)]));
    assert!(!flat.are_one(&boxed, [v(1, 4), v(0, 4)]));
}

/// Where two boxes meet side to side, a point touches neither of these two sides.
#[test]
fn nothing_touches_between_sides_that_lie_on_each_other() {
    let left: [[f64; 2]; 4] = [[-1.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-1.0, 0.5]];
    let right: [[f64; 2]; 4] = [[0.0, -1.0], [1.0, -1.0], [1.0, 0.5], [0.0, 0.0]];
    let boxed = scene(&POINT, &[&left, &right]);
    let mut list = Pairs::new();
    placed(0.0, 0.0, 0.0).touching_obstacles(&boxed, 1e-10, &mut list);
    assert_eq!(list, [v(0, 2), v(0, 6)]);
}

/// A body that lies flat on a box to within a touch at either end, over a short overlap, still has two contacts.
#[test]
fn what_touches_flat_has_two_contacts() {
    let box_of: [[f64; 2]; 4] = [[0.0, -1.0], [1.0, -1.0], [1.0, 0.0], [0.0, 0.0]];
    let boxed = scene(&ROD, &[&box_of]);
    let tilted = placed(-0.8, -9e-6, 1e-5);
    assert!(!tilted.are_one(&boxed, [Pair::of_corner(3, 0), v(1, 2)]));
}

/// Three thin walls meet at a point: one that a rod touches from below, one that continues above it, one that runs down. If the rod reaches
/// that point with its other end, the wall above is behind the one it touches.
#[test]
fn what_ends_behind_a_wall_is_not_touched_from_its_front() {
    let above = [[0.0, 0.0], [2.0, 1.0]];
    let below = [[0.0, 0.0], [0.0, -2.0]];
    let walls = scene(&ROD, &[&WALL, &above, &below]);
    // The sides of the walls that look down and to the right.
    let [front, behind, ahead] = [v(1, 0), v(0, 2), v(0, 5)];
    let flat = placed(0.0, 0.0, 0.0);
    for contact in [front, behind, ahead] {
        let [low, high] = walls.reach(contact);
        assert!(high > low && flat.gap(&walls, contact).abs() < 1e-12);
    }
    assert!(walls.face(front, flat.orientation.rotation()).normal.y < 0.0);
    assert!(walls.face(behind, flat.orientation.rotation()).normal.y < 0.0);
    assert!(walls.face(ahead, flat.orientation.rotation()).normal.x > 0.0);
    assert!(flat.are_one(&walls, [front, behind]));
    assert!(flat.are_one(&walls, [behind, front]));
    assert!(!flat.are_one(&walls, [front, ahead]));
    // The error of its end is as large as its uncertainty.
    let off = placed(-1e-8, 0.0, 0.0);
    assert!(off.are_one(&walls, [front, behind]));
    // Above the wall it is the other one that is behind.
    assert!(!flat.are_one(&walls, [v(1, 1), behind]));
    assert!(flat.are_one(&walls, [v(1, 1), ahead]));
}

/// An obstacle below the floor, with a corner on it: a body that stands on the floor there touches none of its sides. An obstacle that
/// reaches through the floor is touched above it.
#[test]
fn a_side_that_ends_at_the_floor_and_goes_on_below_it_is_not_touched() {
    let floor = SurfaceDescription {
        normal: [0.0, 1.0],
        offset: 0.0,
        friction_static: 0.5,
        friction_dynamic: 0.25,
        memory: None,
    };
    let touching = |obstacle: &[[f64; 2]]| {
        let on_floor = scene_on(&POINT, &[floor], &[obstacle]);
        let mut list = Pairs::new();
        placed(0.0, 0.0, 0.0).touching_obstacles(&on_floor, 1e-10, &mut list);
        list
    };
    let below = [[-1.0, -1.0], [1.0, -1.0], [0.0, 0.0]];
    assert_eq!(touching(&below), []);
    let through = [[1.0, -1.0], [2.0, 0.0], [1.0, 1.0]];
    let through = through.map(|[x, y]| [x - 1.0, y]);
    assert_eq!(touching(&through), [v(0, 3)]);
}

/// A box below the end of a wall, with its side collinear with the wall and its upper vertex at the corner there, turns about its top so
/// that the side leans over: the corner comes onto that side, while the vertex moves off the wall.
#[test]
fn a_side_that_leans_over_a_corner_is_touched_by_the_corner() {
    let wall = [[-1.0, 0.0], [0.0, 0.0], [0.0, 2.0], [-1.0, 2.0]];
    let body = [[0.0, -2.0], [4.0, -2.0], [4.0, 0.0], [0.0, 0.0]];
    let scene = scene(&body, &[&wall]);
    // Whatever the gap, as long as it is less than a touch.
    let offs = [-3e-11, 0.0, 3e-11];
    for [x, y] in offs.into_iter().flat_map(|x| offs.map(|y| [x, y])) {
        let about = Placed {
            body_point: Vec2::new(3.0, 0.0),
            ..placed(3.0 + x, y, 0.0)
        };
        let course = course(about, Vec2::ZERO, -0.1);
        let (at, pair) = reached(&scene, Known::of(&[]), course).expect("the corner");
        assert!(
            at < 1e-3 && pair == Pair::of_corner(1, 3),
            "{x} {y}: {at} {pair:?}"
        );
    }
}
