//! Bodies that lie flat on obstacles (STATICS 12.5): whole runs, in every number type.

extern crate std;

use super::among::{Run, Setting, box_of, post, table};
use crate::contact::Pair;
use crate::event::{StateKind, Status};
use crate::fixtures::Random;
use crate::real::{Fixed, Real};
use crate::solver::Evolution;
use std::vec;
use std::vec::Vec;

/// The indices of the obstacles' corners and sides begin here, after one half-plane.
const FIRST: u8 = 1;

fn vertex(vertex: u8, side: u8) -> Pair {
    let surface = FIRST + side;
    Pair { vertex, surface }
}

fn corner(corner: u8) -> Pair {
    Pair::of_corner(FIRST + corner, 0)
}

/// A box 1 m wide, half as high, held at its middle.
fn setting() -> Setting {
    Setting {
        body: box_of([1.0, 0.5]),
        start: [0.0, 0.25, 0.0],
        weight: 0.0,
        held_at: [0.0, 0.0],
        stiffness: 1.0,
        obstacles: vec![table([-4.0, 0.25])],
        floor: false,
        friction: [0.5, 0.25],
    }
}

fn same(is: f64, should: f64, tolerance: f64) {
    assert!((is - should).abs() <= tolerance, "{is} {should}");
}

/// A body that is turned down about one contact lands on the other one, and the loads are then the same as on the floor where it is borne
/// at its vertices.
#[test]
fn body_that_is_turned_down_lands_on_both_ends() {
    fn lands<R: Real>(tolerance: f64)
    where
        R::Si: From<f32> + Into<f64>,
    {
        let tables = [
            (
                vec![table([-4.0, 0.25])],
                [vertex(0, 2), corner(2)],
                [-0.5, 0.25],
            ),
            (
                vec![table([-0.25, 4.0])],
                [corner(3), vertex(1, 2)],
                [-0.25, 0.5],
            ),
            (
                vec![table([-4.0, 4.0])],
                [vertex(0, 2), vertex(1, 2)],
                [-0.5, 0.5],
            ),
            (
                vec![table([-0.25, 0.125])],
                [corner(3), corner(2)],
                [-0.25, 0.125],
            ),
            (
                vec![post(-0.25), post(0.375)],
                [corner(2), corner(5)],
                [-0.25, 0.375],
            ),
            (
                vec![table([-4.0, -0.25]), post(0.25)],
                [vertex(0, 2), corner(6)],
                [-0.5, 0.25],
            ),
        ];
        for evolution in Evolution::ALL {
            for (obstacles, ends, places) in &tables {
                for side in [1.0, -1.0] {
                    let setting = Setting {
                        obstacles: obstacles.clone(),
                        start: [0.0, 0.75, side * 0.25],
                        ..setting()
                    };
                    let above = [0.0, 0.75, side * 0.25];
                    let low = [0.0, 0.125, side * 0.25];
                    let flat = [0.0, 0.125, 0.0];
                    let mut run = Run::<R>::start(&setting, evolution, above);
                    run.go([above, low], 16);
                    assert_eq!(
                        run.output.state,
                        StateKind::SingleVertex,
                        "{places:?} {side}"
                    );
                    run.go([low, flat], 16);
                    assert_eq!(run.output.state, StateKind::Edge, "{places:?} {side}");
                    assert_eq!(run.output.status, Status::Ok);
                    let mut contacts = run.contacts();
                    contacts.sort_by_key(|pair| pair != &ends[0]);
                    assert_eq!(contacts, ends, "{side}");
                    let [x, y, theta] = run.pose();
                    same(y, 0.25, tolerance);
                    same(theta, 0.0, tolerance);
                    let list = run.reactions();
                    // About the middle, above which the hand is: the residual of the couple and the friction.
                    let normal: f64 = list.iter().map(|c| c[1]).sum();
                    same(normal, 0.125, tolerance);
                    for left in run.unbalanced() {
                        same(left, 0.0, tolerance);
                    }
                    for (reaction, place) in list.iter().zip(places) {
                        let goes = ends
                            .iter()
                            .zip(places)
                            .any(|(end, at)| at == place && !end.is_corner());
                        let place = if goes { place + x } else { *place };
                        same(reaction[0], place, tolerance);
                    }
                    assert!(run.is_outside(tolerance));
                }
            }
        }
    }
    lands::<f64>(1e-9);
    lands::<f32>(4e-6);
    lands::<Fixed>(8e-6);
}

/// On a block that is wider than all its displacements a box behaves as on the floor.
#[test]
fn wide_block_is_a_floor() {
    for seed in 0..40 {
        let mut random = Random(seed);
        let mut number = || (random.next() * 64.0).round() / 64.0;
        let over = Setting {
            start: [0.0, 1.0, 0.0],
            held_at: [0.25 * number(), 0.125],
            weight: 0.25 + 0.25 * number(),
            friction: [0.5, if seed % 2 == 0 { 0.5 } else { 0.25 }],
            obstacles: vec![table([-16.0, 16.0])],
            ..setting()
        };
        let floor = Setting {
            obstacles: vec![],
            floor: true,
            ..over.clone()
        };
        let evolution = Evolution::ALL[seed as usize % 2];
        let begin = [over.held_at[0], 1.25, 0.0];
        let [mut block, mut plane] =
            [&over, &floor].map(|s| Run::<f64>::start(s, evolution, begin));
        let mut last = begin;
        for _ in 0..8 {
            let next = [2.0 * number(), 0.25 + 0.5 * number(), 0.5 * number()];
            block.go([last, next], 8);
            plane.go([last, next], 8);
            last = next;
            assert_eq!(block.output.state, plane.output.state, "{seed}");
            let pair = block.pose().into_iter().zip(plane.pose());
            for (is, should) in pair {
                same(is, should, 1e-9);
            }
            let pairs = block.reactions().into_iter().zip(plane.reactions());
            for (is, should) in pairs {
                for k in 0..3 {
                    same(is[k], should[k], 1e-8);
                }
            }
        }
    }
}

/// A box that is pushed over a block that is narrower than it ends first at its own vertices, then at the block's corners, and finally
/// tips; in the opposite direction it is the mirror image.
#[test]
fn box_is_pushed_over_a_narrow_block() {
    fn pushed<R: Real>(tolerance: f64)
    where
        R::Si: From<f32> + Into<f64>,
    {
        for evolution in Evolution::ALL {
            let runs = [1.0, -1.0].map(|side| {
                let setting = Setting {
                    start: [-0.25 * side, 0.25, 0.0],
                    weight: 0.25,
                    obstacles: vec![table([-0.375, 0.375])],
                    ..setting()
                };
                let at = |x: f64| [side * x, 0.125, 0.0];
                let mut run = Run::<R>::start(&setting, evolution, at(-0.25));
                let mut seen: Vec<Vec<Pair>> = vec![run.contacts()];
                let mut shares = vec![];
                for i in 0..=90 {
                    run.step(at(-0.25 + f64::from(i) / 128.0));
                    assert_eq!(run.output.status, Status::Ok, "{i}");
                    assert!(run.is_outside(tolerance));
                    for left in run.unbalanced() {
                        same(left, 0.0, tolerance);
                    }
                    let mut contacts = run.contacts();
                    contacts.sort_by_key(|pair| (pair.surface, pair.vertex));
                    if seen.last() != Some(&contacts) {
                        seen.push(contacts);
                    }
                    if run.output.state == StateKind::Edge {
                        shares.push(run.reactions());
                    }
                }
                (seen, shares)
            });
            let [right, left] = &runs;
            let mut ends = [
                vec![corner(3), vertex(1, 2)],
                vec![corner(2), corner(3)],
                vec![vertex(0, 2), corner(2)],
                vec![corner(2)],
            ];
            for list in &mut ends {
                list.sort_by_key(|pair| (pair.surface, pair.vertex));
            }
            let mut seen = right.0.clone();
            seen[0].sort_by_key(|pair| (pair.surface, pair.vertex));
            seen.dedup();
            assert_eq!(seen[..4], ends);
            for (one, other) in right.1.iter().zip(&left.1) {
                for (a, b) in one.iter().zip(other.iter().rev()) {
                    same(a[0], -b[0], tolerance);
                    same(a[1], b[1], tolerance);
                    same(a[2], -b[2], tolerance);
                }
            }
        }
    }
    pushed::<f64>(1e-9);
    pushed::<f32>(8e-6);
    pushed::<Fixed>(8e-6);
}
