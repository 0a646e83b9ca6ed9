//! A corner of an obstacle on a side of the body, event by event: where it leaves the side, and where it slides without a stable balance.

use super::among::{Run, Setting, box_of, post, table};
use crate::event::{Event, StateKind, Status};
use crate::fixtures::Random;
use crate::real::{Fixed, Real};
use crate::solver::Evolution;

/// A box over a post that ends below its bottom side, held near that side; the hand is where the box touches.
fn over_post(stiffness: f64, friction: f64) -> Setting {
    Setting {
        body: box_of([0.75, 0.5]),
        start: [0.0, 1.0, 0.0],
        weight: 0.0,
        held_at: [0.0, -0.1875],
        stiffness,
        obstacles: [post(0.125)].into(),
        friction: [friction; 2],
    }
}

/// The box is pressed onto the post, drawn aside and lifted obliquely within one frame. A reaction that falls to zero leaves only the
/// rounding of the load: the body goes on with the hand.
fn lifts_at_once<R: Real>()
where
    R::Si: From<f32> + Into<f64>,
{
    let mut random = Random(1);
    for _ in 0..100 {
        let setting = over_post(0.25, 0.25);
        let mut run = Run::<R>::start(&setting, Evolution::Path, [0.0, 0.5, 0.0]);
        let [aside, turn] = [random.next() / 8.0, random.next() / 4.0];
        run.step([0.0, 0.1875, turn]);
        run.step([aside / 8.0, -0.0625, turn]);
        run.step([aside, -0.0625, turn]);
        assert_eq!(run.output.state, StateKind::SingleVertex);
        run.step([aside * 4.0, 0.5, turn + random.next() / 8.0]);
        assert_eq!(run.output.state, StateKind::NonContact);
        assert_eq!(run.output.status, Status::Ok);
        let lifts = run.output.events().iter().filter(|&&e| e == Event::Lift);
        assert_eq!(lifts.count(), 1, "{:?}", run.output.events());
    }
}

#[test]
fn reaction_that_falls_to_zero_ends_a_contact_once() {
    lifts_at_once::<f64>();
    lifts_at_once::<f32>();
    lifts_at_once::<Fixed>();
}

/// If pressed so deep that a slide has no stable balance (E17), the corner slips at the edge of the cone, in the direction of the load.
fn topples_in_a_slip<R: Real>()
where
    R::Si: From<f32> + Into<f64>,
{
    for side in [-1.0, 1.0] {
        let setting = over_post(0.125, 0.25);
        let mut run = Run::<R>::start(&setting, Evolution::Path, [0.125, 0.5, 0.0]);
        run.step([0.125, -0.4375, 0.0]);
        assert_eq!(run.output.events(), [Event::Touch]);
        run.step([0.125 + side * 0.25, -0.4375, 0.0]);
        assert_eq!(run.output.status, Status::Ok);
        let [x, ..] = run.pose();
        assert!((x - 0.125) * side > 0.1, "{:?}", run.output);
        assert!(run.is_outside(1e-4));
    }
}

#[test]
fn corner_whose_slide_is_not_stable_slips() {
    topples_in_a_slip::<f64>();
    topples_in_a_slip::<f32>();
    topples_in_a_slip::<Fixed>();
}

/// A box of some weight on a table, pushed against an overhanging wall without friction, turned and pulled about: contacts that let go do
/// so once, however little the load exceeds what they bear, and a contact that is left alone without a stable slide slips off.
fn lets_go_at_once<R: Real>(stiffness: f64)
where
    R::Si: From<f32> + Into<f64>,
{
    let mut random = Random(7);
    for _ in 0..100 {
        let wall = [[0.5, -2.0], [1.5, -2.0], [1.5, 2.0], [0.75, 2.0]];
        let setting = Setting {
            body: box_of([0.75, 0.5]),
            start: [-0.5, 1.0, 0.0],
            weight: 0.1875,
            held_at: [random.next() / 4.0, random.next() / 8.0],
            stiffness,
            obstacles: [table([-2.0, 0.5]), wall.into()].into(),
            friction: [0.0; 2],
        };
        let mut from = [-0.5, 1.0, 0.0];
        let mut run = Run::<R>::start(&setting, Evolution::Path, from);
        for _ in 0..4 {
            let [x, y, phi] = [(); 3].map(|()| random.next());
            let to = [0.5 + x / 4.0, y / 2.0, phi * 2.0];
            for i in 1..=8 {
                let part = f64::from(i) / 8.0;
                run.step([0, 1, 2].map(|k: usize| from[k] + (to[k] - from[k]) * part));
                assert_ne!(run.output.status, Status::EventLimit, "{:?}", run.output);
            }
            from = to;
        }
    }
}

#[test]
fn contacts_let_go_once() {
    for stiffness in [0.0625, 0.015_625] {
        lets_go_at_once::<f64>(stiffness);
        lets_go_at_once::<f32>(stiffness);
        lets_go_at_once::<Fixed>(stiffness);
    }
}
