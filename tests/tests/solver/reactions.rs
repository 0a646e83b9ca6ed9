//! How a load is shared among contacts that fix the pose: in balance, in every number type, and without a side that is preferred.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};
use stiction_core::{Evolution, StateKind};
use stiction_tests::laws::assert_lawful_run;
use stiction_tests::run::{polyline, run};
use stiction_tests::{Number, Run, Setup, test_each};

test_each!(
    cases::wedge_bears_alike_on_both_sides,
    cases::narrow_edge_that_friction_overturns_tips,
    cases::corner_bears_over_a_long_lever,
    cases::walls_of_little_friction_bear_what_they_are_pressed_by,
);

mod cases {
    use super::*;

    /// The lower end of an upright rod is pressed down into a wedge with friction: many shares of the load bear it.
    pub(super) fn wedge_bears_alike_on_both_sides<R: Number>(evolution: Evolution) {
        let wall = FRAC_1_SQRT_2;
        let setup = Setup::rod(0.1)
            .at([0.0, 0.0, FRAC_PI_2])
            .held_at([0.1, 0.0])
            .springs(500.0, 5.0)
            .surface([wall, wall], 0.0, [0.6, 0.4])
            .surface([-wall, wall], 0.0, [0.6, 0.4]);
        let hands = polyline(&[[0.0, 0.1, FRAC_PI_2], [0.0, 0.05, FRAC_PI_2]], 50);
        for frame in run::<R>(&setup, evolution, &hands).iter().skip(1) {
            let [one, other] = frame.contacts.as_slice() else {
                panic!("{frame:?}");
            };
            assert!(one.normal > 0.0);
            let force = 500.0 * 0.05;
            for (a, b) in [(one.normal, other.normal), (one.friction, -other.friction)] {
                assert!((a - b).abs() < R::RESIDUAL * force, "{frame:?}");
            }
        }
    }

    /// The end of a rod in a corner of floor and wall, held up to three times its length away: moments are many times the forces.
    pub(super) fn corner_bears_over_a_long_lever<R: Number>(evolution: Evolution) {
        for (lever, mu) in [(1.5, 0.2), (2.0, 1.3), (3.0, 0.6)] {
            let setup = Setup::rod(0.1)
                .standing(0, [0.0, 0.0], 2.2)
                .held_at([0.1 * lever, 0.05])
                .springs(500.0, 5.0)
                .surface([0.0, 1.0], 0.0, [mu, mu])
                .surface([-1.0, 0.0], 0.0, [mu, mu]);
            let [x, y] = setup.world(setup.start, [0.1 * lever, 0.05]);
            let keyframes = [[0.0, 0.0], [0.4, -0.3], [0.2, -0.5], [0.6, -0.1]];
            let keyframes = keyframes.map(|[dx, dy]| [x + dx, y + dy, 2.2]);
            let frames = run::<R>(&setup, evolution, &polyline(&keyframes, 40));
            assert_lawful_run::<R>(&setup, evolution, &frames);
            let pressed = frames.iter().filter(|f| f.contacts.len() > 1);
            assert!(pressed.count() > 20);
        }
    }

    /// A point between a floor and a ceiling that meet at it, of friction 1/1000: what holds it across is a thousandth of their pressure.
    pub(super) fn walls_of_little_friction_bear_what_they_are_pressed_by<R: Number>(
        evolution: Evolution,
    ) {
        let setup = Setup::point()
            .held_at([0.4, 0.4])
            .springs(500.0, 500.0)
            .surface([0.0, 1.0], 0.0, [1e-3, 1e-3])
            .surface([0.0, -1.0], 0.0, [1e-3, 1e-3]);
        let keyframes = [[0.4, 0.4, 0.0], [0.43, 0.41, 0.0], [0.37, 0.38, 0.0]];
        let frames = run::<R>(&setup, evolution, &polyline(&keyframes, 40));
        assert_lawful_run::<R>(&setup, evolution, &frames);
        let still = frames.iter().filter(|f| f.state == StateKind::Corner);
        assert!(still.count() > 50);
    }

    /// A narrow body on the floor, held high and drawn along by more than its friction bears: a slide at mu_d N would need a pull at its rear
    /// end, of mu_d h/b - 1 times half the load, as the height h of the hand over half its width b exceeds 1/mu_d. So it tips, however small the load.
    pub(super) fn narrow_edge_that_friction_overturns_tips<R: Number>(evolution: Evolution) {
        let setup = Setup::new(&[[-0.037, 0.0], [0.037, 0.0], [0.0, 1.0]])
            .held_at([0.0, 1.0 / 3.0])
            .springs(1.0, 1e-3)
            .surface([0.0, 1.0], 0.0, [0.15, 0.14]);
        for load in [1e-1, 1e-2, 1e-3, 1.7e-4] {
            let run = Run::<R>::start(&setup, evolution, [load, 1.0 / 3.0 - load, 0.0]);
            assert_eq!(
                run.frame.state,
                StateKind::SingleVertex,
                "{load}: {:?}",
                run.frame
            );
        }
    }
}
