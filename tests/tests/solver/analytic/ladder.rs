//! A rod between floor and wall: critical angle and load, jamming, the trammel slip.

use std::f64::consts::{FRAC_PI_4, PI};
use stiction_core::{Evolution, StateKind};
use stiction_tests::scenes::leaning_rod;
use stiction_tests::{Number, Run, Setup, change, test_each};

test_each!(
    cases::critical_angle,
    cases::critical_load,
    cases::jammed_rod_resists_every_wrench,
    cases::trammel_slip_ends_at_the_first_root,
);

mod cases {
    use super::*;

    /// A rod of length 2 that leans at `alpha` from the floor against a wall at x = 0, held at a fraction of its length
    /// from its foot. Slips are long (mu_d = mu_s / 2), so that the pose shows whether the rod sticks or slips.
    fn ladder(alpha: f64, held: f64, mu: f64) -> Setup {
        let friction = [mu, mu / 2.0];
        Setup::rod(2.0)
            .held_at([2.0 * held, 0.0])
            .standing(0, [2.0 * alpha.cos(), 0.0], PI - alpha)
            .floor(friction)
            .surface([1.0, 0.0], 0.0, friction)
    }

    /// Sticks under a load of 1 straight down, without moment.
    fn sticks<R: Number>(setup: &Setup, evolution: Evolution) -> bool {
        let [x, y] = setup.grip();
        let frame = Run::<R>::start(setup, evolution, [x, y - 1.0, setup.start[2]]).frame;
        let moved = (frame.pose[2] - setup.start[2]).abs();
        frame.state == StateKind::TwoVertex && moved < R::GAP
    }

    /// Case 7: mu, alpha.
    pub(super) fn critical_angle<R: Number>(evolution: Evolution) {
        for [mu, alpha] in [
            [0.5, 0.643_501_108_793],
            [0.3, 0.987_882_737_839],
            [0.8, 0.221_314_442_348],
        ] {
            let steepest = change(1.5, 0.1, |alpha| {
                sticks::<R>(&ladder(alpha, 0.5, mu), evolution)
            });
            R::near("critical angle", steepest, alpha);
        }
    }

    /// Case 7b.
    pub(super) fn critical_load<R: Number>(evolution: Evolution) {
        let highest = change(0.2, 0.95, |part| {
            sticks::<R>(&ladder(1.0, part, 0.4), evolution)
        });
        R::near("critical part", highest, 0.674_968_180_915);
    }

    /// Case 8: wrenches of size 1000, or as large as the number type represents, in all directions, evenly spread. Only
    /// a wrench whose free motion opens both gaps, which no friction can prevent, may move the rod.
    pub(super) fn jammed_rod_resists_every_wrench<R: Number>(evolution: Evolution) {
        let size = R::FARTHEST.min(1000.0);
        // Dynamic friction alone jams the rod, too: a rod that has not been pressed yet has no other.
        let setup = ladder(FRAC_PI_4, 0.5, 2.4).springs(1.0, size);
        let ([x, y], theta) = (setup.grip(), setup.start[2]);
        let mut stays = 0;
        for i in 0..2000 {
            let direction = f64::from(i) * 2.399_963;
            let turn = 2.0 * (f64::from(i) * 0.754_877_666).fract() - 1.0;
            let (fx, fy) = (size * direction.cos(), size * direction.sin());
            let mut run = Run::<R>::start(&setup, evolution, [x, y, theta]);
            let start = run.frame.clone();
            let frame = run.step([x + fx, y + fy, theta + turn]);
            if frame.state == StateKind::TwoVertex && frame.pose == start.pose {
                stays += 1;
                continue;
            }
            let foot_rises = fy + turn * x > 0.0;
            let head_leaves = fx - turn * y > 0.0;
            assert!(
                foot_rises && head_leaves,
                "wrench {fx} {fy} {turn}: {frame:?}"
            );
        }
        assert!(stays > 1000, "{stays} of 2000 stay");
    }

    /// Case 12: floor and a wall at x = 0 on the other side, under a load of 2 and a decreasing moment. At first the
    /// moment holds the rod off the wall.
    pub(super) fn trammel_slip_ends_at_the_first_root<R: Number>(evolution: Evolution) {
        let (sin, cos) = 1f64.sin_cos();
        let hand = |phi: f64| [-cos, sin - 2.0, phi];
        let mut run = Run::<R>::start(&leaning_rod(), evolution, hand(1.905_464_288_4));
        let trigger = run.onset(hand(0.9), |f| f.slips > 0);
        R::near("trigger", trigger.hand[2], 0.905_464_288_398);
        R::near("before", trigger.before.pose[2], 1.0);
        R::near("end", run.frame.pose[2], 0.761_291_830_571);
        assert_eq!(run.frame.state, StateKind::TwoVertex);
        assert_eq!(run.frame.slips, 1);
    }
}
