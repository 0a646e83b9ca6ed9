//! Which motion begins where a contact bears nothing, and where a foot stands still at first.

use std::f64::consts::FRAC_PI_2;
use stiction_core::{Evolution, StateKind, Status};
use stiction_tests::laws::assert_lawful;
use stiction_tests::{Number, Run, Setup, change, test_each};

test_each!(
    cases::load_that_vanishes_where_the_body_would_go_in_begins_a_slide,
    cases::upright_rod_between_floor_and_ceiling_is_lawful,
);

mod cases {
    use super::*;

    /// A foot sticks, and its load vanishes along the hand's path. Without it the body, soft in its angle, would turn its foot into the
    /// floor: the foot slides on, and its load grows again from zero.
    pub(super) fn load_that_vanishes_where_the_body_would_go_in_begins_a_slide<R: Number>(
        evolution: Evolution,
    ) {
        // Of the holding point, from the foot (m); of the springs; of the hand.
        const ARM: [f64; 2] = [0.3, 1.0];
        const TURNING: f64 = 0.1;
        const MU: f64 = 0.8;
        let hand = |p: f64| [ARM[0] + 4.7 * p, ARM[1] - 0.2 * p, 0.0];
        let setup = Setup::point()
            .held_at(ARM)
            .springs(1.0, TURNING)
            .floor([MU, MU]);
        let mut run = Run::<R>::start(&setup, evolution, hand(-0.005));
        assert!(run.frame.normal() > 0.004, "{:?}", run.frame);
        for k in -9..=40 {
            let p = 0.0005 * f64::from(k);
            let at = hand(p);
            let frame = run.step(at);
            assert_eq!(
                (frame.status, frame.state),
                (Status::Ok, StateKind::SingleVertex)
            );
            assert_lawful::<R>(&setup, std::slice::from_ref(frame));
            let lever = |theta: f64| {
                let (sin, cos) = theta.sin_cos();
                [-cos * ARM[0] + sin * ARM[1], -sin * ARM[0] - cos * ARM[1]]
            };
            // On the edge of the cone, where the hand is above y = -lever_y by N.
            let normal = |theta: f64| -lever(theta)[1] - at[1];
            let moment = |theta: f64| {
                let [x, y] = lever(theta);
                normal(theta) * (x + MU * y) - TURNING * theta
            };
            let expected = if p <= 0.0 {
                0.0
            } else {
                let theta = change(-0.2, 0.2, |theta| moment(theta) < 0.0);
                at[0] - MU * normal(theta) + lever(theta)[0]
            };
            R::near("foot", frame.pose[0], expected);
        }
    }

    /// The ceiling leans: if the foot moves the upper end does not, at first.
    pub(super) fn upright_rod_between_floor_and_ceiling_is_lawful<R: Number>(evolution: Evolution) {
        let (sin, cos) = 0.5_f64.sin_cos();
        for mu in [0.1, 0.3] {
            let setup = Setup::rod(2.0)
                .held_at([1.0, 0.0])
                .springs(1.0, 1.0)
                .at([0.0, 0.0, FRAC_PI_2])
                .floor([mu, mu])
                .surface([-sin, -cos], -2.0 * cos, [mu, mu]);
            let [x, y, phi] = [0.3, 1.0, FRAC_PI_2 - 0.3];
            for (way, turn) in [(-0.2, -0.4), (-0.2, 0.4), (0.2, -0.4), (0.2, 0.4)] {
                let mut run = Run::<R>::start(&setup, evolution, [x, y, phi]);
                for frame in run.lead([x + way, y, phi + turn], 40) {
                    assert_eq!(frame.status, Status::Ok, "{way} {turn} {frame:?}");
                    assert_lawful::<R>(&setup, std::slice::from_ref(&frame));
                }
            }
        }
    }
}
