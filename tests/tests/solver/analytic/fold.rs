//! The fold of the single-vertex angle u + kappa sin u = delta, and where the body snaps to.
//!
//! The fold is a double root: an error e of delta moves the angle just before it by sqrt(2 e / (kappa |sin u|)), so this
//! one angle is bounded by 1e-6 in f64 and 5e-3 in f32. The hand's position at the fold, the angle at which the body
//! lands and its final angle are simple roots.

use std::f64::consts::PI;
use stiction_core::{Event, Evolution, StateKind};
use stiction_tests::scenes::strut;
use stiction_tests::{Number, Run, Setup, close, test_each};

test_each!(
    cases::buckling_folds_and_lands,
    cases::soft_grip_does_not_fold,
    cases::snap_is_stopped_by_an_edge,
    cases::fold_of_keplers_equation,
);

mod cases {
    use super::*;

    /// The bound of an angle just before its fold.
    fn double_root<R: Number>() -> f64 {
        if R::ROUNDING < 1e-10 { 1e-6 } else { 5e-3 }
    }

    fn hand(phi: f64) -> [f64; 3] {
        [0.0, -1.0, phi]
    }

    fn snapped(frame: &stiction_tests::Frame) -> bool {
        frame.saw(Event::Snap)
    }

    struct Buckling {
        kappa: f64,
        phi: [f64; 2],
        start: f64,
        fold_phi: f64,
        fold_theta: f64,
        lands: f64,
        end: f64,
    }

    /// Case 4.
    const BUCKLING: [Buckling; 3] = [
        Buckling {
            kappa: 1.2,
            phi: [0.1, -0.12],
            start: 1.231_644_695_49,
            fold_phi: -0.077_639_414_613_9,
            fold_theta: 0.585_685_543_457,
            lands: -1.193_027_155_62,
            end: -1.263_948_533_89,
        },
        Buckling {
            kappa: 1.05,
            phi: [0.02, -0.1],
            start: 0.681_264_770_302,
            fold_phi: -0.010_311_572_13,
            fold_theta: 0.309_844_639_742,
            lands: -0.622_724_540_491,
            end: -0.960_379_796_755,
        },
        Buckling {
            kappa: 1.01,
            phi: [0.01, -0.05],
            start: 0.442_293_784_955,
            fold_phi: -0.000_938_595_221_161,
            fold_theta: 0.140_835_873_566,
            lands: -0.281_952_245_009,
            end: -0.702_888_437_947,
        },
    ];

    pub(super) fn buckling_folds_and_lands<R: Number>(evolution: Evolution) {
        for case in BUCKLING {
            let [from, to] = case.phi.map(hand);
            let mut run = Run::<R>::start(&strut(case.kappa, case.start), evolution, from);
            R::near("start", run.frame.pose[2], case.start);
            let fold = run.onset(to, snapped);
            R::near("fold: phi", fold.hand[2], case.fold_phi);
            close(
                "fold: theta",
                fold.before.pose[2],
                case.fold_theta,
                double_root::<R>(),
            );
            R::near("lands", run.frame.pose[2], case.lands);
            let later = run.lead(to, 10);
            assert!(!later.iter().any(snapped));
            assert_eq!(run.frame.state, StateKind::SingleVertex);
            R::near("end", run.frame.pose[2], case.end);
        }
    }

    /// Case 4, kappa < 1.
    pub(super) fn soft_grip_does_not_fold<R: Number>(evolution: Evolution) {
        for [kappa, end] in [[0.95, -0.531_420_642_467], [0.999, -0.671_678_296_14]] {
            let mut run = Run::<R>::start(&strut(kappa, 0.5), evolution, hand(0.05));
            let frames = run.lead(hand(-0.05), 100);
            assert!(!frames.iter().any(snapped), "kappa {kappa}");
            R::near("end", run.frame.pose[2], end);
        }
    }

    /// Case 4b.
    pub(super) fn snap_is_stopped_by_an_edge<R: Number>(evolution: Evolution) {
        let mut run = Run::<R>::start(&strut(2.0, 1.19), evolution, hand(-0.665));
        let fold = run.onset(hand(-0.7), snapped);
        R::near("fold: phi", fold.hand[2], -0.684_853_256_372);
        run.lead(hand(-0.7), 10);
        assert_eq!(run.frame.state, StateKind::Edge);
        R::near("end", run.frame.pose[2], -1.325_817_663_67);
    }

    /// kappa, u and delta at the fold, and u where the body lands.
    const KEPLER: [[f64; 4]; 4] = [
        [1.05, 2.831_748_013_8, 3.151_904_225_7, 3.764_317_194_1],
        [1.5, 2.300_523_983_0, 3.418_557_971_8, 4.893_912_630_5],
        [2.0, 2.094_395_102_4, 3.826_445_910_0, 5.387_598_242_9],
        [5.0, 1.772_154_247_6, 6.671_133_733_2, 6.347_880_979_4],
    ];

    /// A point that hangs from the floor's height, pulled down by a hand twice as deep: u = theta - pi, delta = phi - pi,
    /// kappa = 2 / k_theta, and N > 0 during the whole turn.
    pub(super) fn fold_of_keplers_equation<R: Number>(evolution: Evolution) {
        let hand = |delta: f64| [0.0, -2.0, PI + delta];
        for [kappa, u, delta, lands] in KEPLER {
            let setup = Setup::point()
                .held_at([0.0, 1.0])
                .springs(1.0, 2.0 / kappa)
                .at([0.0, 0.0, PI])
                .floor([1.0, 0.5]);
            let mut run = Run::<R>::start(&setup, evolution, hand(0.0));
            let fold = run.onset(hand(delta + 0.01), snapped);
            R::near("fold: delta", fold.hand[2] - PI, delta);
            close("fold: u", fold.before.pose[2] - PI, u, double_root::<R>());
            R::near("lands", run.frame.pose[2] - PI, lands);
        }
    }
}
