//! One vertex on the floor: stick, slip with rotation, frictionless sliding.

use stiction_core::{Evolution, StateKind};
use stiction_tests::{Number, Run, Setup, close, test_each};

test_each!(
    cases::stick_balances_at_every_stiffness_ratio,
    cases::slip_turns_the_body,
    cases::frictionless_vertex_follows_the_hand,
    cases::slip_ends_at_the_first_root_on_its_way,
);

mod cases {
    use super::*;

    /// Case 3: kappa, theta, N, T.
    const STICK: [[f64; 4]; 5] = [
        [0.5, 0.413_829_085_628, 0.115_587_793_94, 0.197_881_868_616],
        [
            0.99,
            0.470_458_503_603,
            0.091_360_544_493_8,
            0.146_704_974_967,
        ],
        [
            1.01,
            0.472_184_565_128,
            0.090_576_801_970_5,
            0.145_167_107_839,
        ],
        [
            5.0,
            0.586_224_831_198,
            0.033_035_109_652_9,
            0.046_779_875_559_9,
        ],
        [
            50.0,
            0.636_765_743_008,
            0.004_023_042_923_79,
            0.005_401_861_382_36,
        ],
    ];

    pub(super) fn stick_balances_at_every_stiffness_ratio<R: Number>(evolution: Evolution) {
        for [kappa, theta, normal, friction] in STICK {
            let setup = Setup::triangle()
                .held_at([0.0, 1.0])
                .springs(1.0, 1.0 / kappa)
                .standing(0, [0.0, 0.0], 0.3)
                .floor([50.0, 40.0]);
            let frame = Run::<R>::start(&setup, evolution, [-0.6, 0.8, 0.3]).frame;
            assert_eq!(frame.state, StateKind::SingleVertex);
            R::near("theta", frame.pose[2], theta);
            R::near("N", frame.normal(), normal);
            R::near("T", frame.friction(), friction);
        }
    }

    struct Slip {
        friction: [f64; 2],
        rotation: f64,
        height: f64,
        trigger: f64,
        theta_before: f64,
        slip: f64,
        theta_after: f64,
    }

    /// Case 5.
    const SLIPS: [Slip; 3] = [
        Slip {
            friction: [0.6, 0.3],
            rotation: 0.5,
            height: 0.6,
            trigger: 0.665_709_348_072,
            theta_before: -0.534_471_960_851,
            slip: 0.158_969_736_777,
            theta_after: -0.426_407_124_356,
        },
        Slip {
            friction: [0.4, 0.1],
            rotation: 5.0,
            height: 0.9,
            trigger: 0.048_146_810_078_8,
            theta_before: -0.008_160_218_401_16,
            slip: 0.036_106_251_048_7,
            theta_after: -0.002_040_768_683_41,
        },
        Slip {
            friction: [1.5, 0.5],
            rotation: 0.05,
            height: 0.3,
            trigger: 1.002_754_204_33,
            theta_before: -1.221_701_091_26,
            slip: 0.040_468_811_310_5,
            theta_after: -1.208_599_322_15,
        },
    ];

    pub(super) fn slip_turns_the_body<R: Number>(evolution: Evolution) {
        for case in SLIPS {
            let setup = Setup::triangle()
                .held_at([0.0, 1.0])
                .springs(1.0, case.rotation)
                .at([0.0, 0.5, 0.0])
                .floor(case.friction);
            let mut run = Run::<R>::start(&setup, evolution, [0.0, 1.5, 0.0]);
            run.lead([0.0, case.height, 0.0], 10);
            let start = run.onset([case.trigger + 0.01, case.height, 0.0], |f| f.slips > 0);
            R::near("trigger", start.hand[0], case.trigger);
            R::near("theta before", start.before.pose[2], case.theta_before);
            R::near("slip", run.frame.pose[0], case.slip);
            R::near("theta after", run.frame.pose[2], case.theta_after);
            assert_eq!(run.frame.slips, 1);
        }
    }

    /// Case 9.
    pub(super) fn frictionless_vertex_follows_the_hand<R: Number>(evolution: Evolution) {
        let setup = Setup::triangle()
            .held_at([0.0, 1.0])
            .springs(1.0, 0.5)
            .floor([0.0, 0.0]);
        let (sin, cos) = 0.3f64.sin_cos();
        let mut run = Run::<R>::start(&setup.at([sin, 1.5 - cos, 0.3]), evolution, [0.0, 1.5, 0.3]);
        run.lead([0.0, 0.5, 0.3], 100);
        run.lead([0.7, 0.5, 0.5], 100);
        R::near("theta", run.frame.pose[2], 0.789_770_235_333);
        R::near("x", run.frame.pose[0], 1.410_191_534_88);
        R::near("N", run.frame.normal(), 0.204_008_511_155);
    }

    /// k_h 500, k_theta 0.5, D 0.06, mu_d 0.3, the hand 0.02 above the floor, phi 1.2: from an angle psi the vertex slips
    /// to the nearest root of (E3) on its path. The three roots towards -t are 0.6245604219, 1.3359609255 (where slips
    /// only start) and 2.3854158970. Columns: psi at the start, psi at the end, N at the end.
    const ENDS: [[f64; 3]; 3] = [
        [0.4, 0.540_336_797_9, 5.432_745_109],
        [1.0, 0.624_560_421_9, 7.542_222_045],
        [2.6, 2.385_415_897_0, 10.584_355_77],
    ];

    pub(super) fn slip_ends_at_the_first_root_on_its_way<R: Number>(evolution: Evolution) {
        let (k_h, k_theta, d, h, phi) = (500.0, 0.5, 0.06, 0.02, 1.2);
        let l = k_theta / (k_h * d);
        let ahead = |psi: f64| (h * psi.cos() + l * (phi - psi)) / psi.sin();
        for [from, to, normal] in ENDS {
            let setup = Setup::point()
                .held_at([d, 0.0])
                .springs(k_h, k_theta)
                .at([0.0, 0.0, from])
                .floor([0.35, 0.3]);
            let frame = Run::<R>::start(&setup, evolution, [ahead(from), h, phi]).frame;
            assert_eq!(frame.slips, 1, "from {from}");
            R::near("psi", frame.pose[2], to);
            close("s", frame.pose[0], ahead(from) - ahead(to), R::ANALYTIC * d);
            close("N", frame.normal(), normal, R::ANALYTIC * k_h * d);
        }
        close("s - a", -ahead(0.540_336_797_9), -0.054_711_775_4, 1e-10);
    }
}
