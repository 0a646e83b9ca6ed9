//! Bodies in a seam, where one obstacle stands on another (STATICS 12.7): whole runs, in every number type.

extern crate std;

use super::among::{Run, Setting, table};
use crate::event::{StateKind, Status};
use crate::real::{Fixed, Real};
use crate::solver::Evolution;
use std::vec;

/// A wedge whose tip slides along one of two sides into the seam, wherever on the table the wall stands, is in both contacts there.
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
                    floor: false,
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
