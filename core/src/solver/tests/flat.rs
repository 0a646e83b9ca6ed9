//! Bodies that lie flat on obstacles (STATICS 12.5): whole runs, in every number type.

extern crate std;

use super::among::{Run, Setting, box_of, post, table};
use crate::contact::Pair;
use crate::event::{StateKind, Status};
use crate::real::{Fixed, Real};
use crate::solver::Evolution;
use std::vec;

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
