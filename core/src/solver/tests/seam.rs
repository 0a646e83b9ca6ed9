//! Bodies where one obstacle stands on another or thin walls meet (STATICS 12.7), in every number type.

extern crate std;

use super::among::{Run, Setting, table};
use crate::contact::Pair;
use crate::event::{StateKind, Status};
use crate::pivot::Pivot;
use crate::real::{Fixed, Real};
use crate::solver::Evolution;
use crate::state::ContactState;
use crate::verb::{Relax, Trigger};
use std::vec;
use std::vec::Vec;

/// A wedge whose tip slides along one of two sides into the seam has both contacts there, wherever on the table the wall stands.
#[test]
fn tip_that_slides_into_a_seam_is_in_both_contacts() {
    fn comes<R: Real>(tolerance: f64)
    where
        R::Si: From<f32> + Into<f64>,
    {
        for evolution in Evolution::ALL {
            for (wall, is_down_first) in [-2.0, 1.0]
                .into_iter()
                .flat_map(|x| [(x, false), (x, true)])
            {
                let setting = Setting {
                    body: vec![[-0.5, 0.0], [0.5, -0.5], [0.0, 0.5]],
                    start: [wall - 1.0, 1.0, 0.0],
                    weight: 0.0,
                    held_at: [0.0, 0.0],
                    stiffness: 8.0,
                    obstacles: vec![
                        table([-4.0, 4.0]),
                        vec![
                            [wall, 0.0],
                            [wall + 0.5, 0.0],
                            [wall + 0.5, 2.0],
                            [wall, 2.0],
                        ],
                    ],
                    friction: [0.25, 0.125],
                };
                let (left, right) = (wall - 1.0, wall - 0.25);
                let (above, below) = (1.0, 0.25);
                let between = if is_down_first {
                    [left, below, 0.0]
                } else {
                    [right, above, 0.0]
                };
                let [from, to] = [[left, above, 0.0], [right, below, 0.0]];
                let mut run = Run::<R>::start(&setting, evolution, from);
                for ends in [[from, between], [between, to]] {
                    run.go(ends, 8);
                    assert_eq!(run.output.status, Status::Ok, "{wall} {is_down_first}");
                }
                assert_eq!(
                    run.output.state,
                    StateKind::Corner,
                    "{wall} {is_down_first}"
                );
                assert!(run.is_outside(tolerance));
                let left = run.unbalanced();
                assert!(left.iter().all(|left| left.abs() <= tolerance), "{left:?}");
            }
        }
    }
    comes::<f64>(1e-9);
    comes::<f32>(4e-6);
    comes::<Fixed>(8e-6);
}

/// A rod over thin walls.
fn rod(start: [f64; 3], obstacles: Vec<Vec<[f64; 2]>>) -> Setting {
    Setting {
        body: vec![[-0.5, 0.0], [0.5, 0.0]],
        start,
        weight: 0.0,
        held_at: [0.0, 0.0],
        stiffness: 8.0,
        obstacles,
        friction: [0.25, 0.125],
    }
}

/// A rod that lies flat on a thin wall, and is turned about the wall's end, does not pass through it.
#[test]
fn rod_on_a_thin_wall_is_not_turned_through_it() {
    fn stays<R: Real>()
    where
        R::Si: From<f32> + Into<f64>,
    {
        let setting = rod([0.0; 3], vec![vec![[0.0, 0.0], [4.0, 0.0]]]);
        let end = Pair::of_corner(1, 0);
        let tip = Pair {
            vertex: 1,
            surface: 2,
        };
        for (turn, touches) in [(-0.25, true), (0.25, false)] {
            let run = Run::<R>::start(&setting, Evolution::Path, [0.0, 0.0, turn]);
            let scene = setting.scene::<R>();
            let flat = Run::<R>::start(&setting, Evolution::Path, [0.0; 3]);
            let pivot = Pivot::at(&scene, &flat.state.contact.pose(&scene), end);
            let mut contact = ContactState::seated(&scene, pivot, &[]);
            let moved = contact.relax(&scene, &run.state.grip, Relax::default());
            assert_eq!(moved.trigger == Trigger::Touch(tip), touches, "{moved:?}");
        }
    }
    stays::<f64>();
    stays::<f32>();
    stays::<Fixed>();
}

/// A rod that slides along a thin wall is not caught by the far side of the next wall, which bends away.
#[test]
fn rod_slides_over_the_ridge_of_two_thin_walls() {
    fn slides<R: Real>(tolerance: f64)
    where
        R::Si: From<f32> + Into<f64>,
    {
        for (evolution, order) in Evolution::ALL
            .into_iter()
            .flat_map(|e| (0..8).map(move |k| (e, k)))
        {
            let mut walls = vec![vec![[-4.0, 0.0], [0.0, 0.0]], vec![[0.0, 0.0], [4.0, -0.5]]];
            for (k, wall) in walls.iter_mut().enumerate() {
                wall.rotate_left(order >> k & 1);
            }
            walls.rotate_left(order >> 2);
            let setting = rod([-1.0, 0.0, 0.0], walls);
            let hands = [[-1.0, -0.125, 0.0], [0.25, -0.125, 0.0]];
            let mut run = Run::<R>::start(&setting, evolution, hands[0]);
            run.go(hands, 40);
            assert_eq!(run.output.status, Status::Ok);
            let is_over = run.pose()[0] > 0.125;
            assert!(is_over, "{order} {:?} {:?}", run.pose(), run.contacts());
            assert!(run.is_outside(tolerance));
            let left = run.unbalanced();
            assert!(left.iter().all(|left| left.abs() <= tolerance), "{left:?}");
        }
    }
    slides::<f64>(1e-9);
    slides::<f32>(4e-6);
    slides::<Fixed>(8e-6);
}
