//! The extremes of every parameter (STATICS 16): for any input, a number type returns finite numbers, and every frame
//! either obeys the laws or reports in its status that it does not.

use stiction_core::{Angle, Evolution, Fixed, Hand, StateKind, Status};
use stiction_tests::extremes::{Outcome, SWEEPS, outcome};
use stiction_tests::laws::{FINITE, assert_lawful, judge};
use stiction_tests::run::{planar, polyline, run};
use stiction_tests::{Number, Run, Setup, test_each, times};

test_each! {
    cases::no_sweep_breaks,
    cases::at_a_fold_each_side_is_lawful,
    cases::slip_that_ends_on_a_double_root,
    cases::million_turns_cost_no_digits,
    cases::denormal_parameters,
    cases::number_type_holds_what_users_need,
    cases::thin_body_hangs_by_its_centroid,
}

/// Lever times pull, plus the moment of the turn: up to 64 k_h L² in fixed point. The pull counts from the holding point.
#[test]
fn fixed_point_says_which_loads_it_does_not_carry() {
    const LEVER: f64 = 7.0;
    for (rotation, pull, turn) in [
        (0.0, 9.0, 0.0),
        (0.0, 9.3, 0.0),
        (8.0, 7.0, 1.8),
        (8.0, 7.0, 2.0),
        (8.0, 7.0, -2.0),
        (8.0, 0.0, 7.9),
        (8.0, 0.0, -8.1),
        (0.0, 0.0, 40.0),
    ] {
        let setup = Setup::rod(1.0)
            .held_at([LEVER, 0.0])
            .springs(1.0, rotation)
            .at([3.0, -2.0, 0.0]);
        for evolution in Evolution::ALL {
            let hand = [3.0 + LEVER + pull, -2.0, turn];
            let run = Run::<Fixed>::start(&setup, evolution, hand);
            let carried = LEVER * pull + rotation * turn.abs() <= 64.0;
            let saturated = run.frame.status == Status::Saturated;
            assert_eq!(
                saturated, !carried,
                "{rotation} {pull} {turn}: {:?}",
                run.frame
            );
            assert_eq!(run.frame.held, carried);
        }
    }
}

mod cases {
    use super::*;

    /// A thin wedge that is held at its blunt end, in free air: k_theta (phi - theta) = W r_x. However thin it is, its centroid
    /// is at (5/12, h/3).
    pub(super) fn thin_body_hangs_by_its_centroid<R: Number>(evolution: Evolution) {
        const W: f64 = 0.5;
        const K: f64 = 0.25;
        for thin in [50.0, 200.0, 500.0, 1000.0, 2000.0, 10_000.0] {
            let h = 1.0 / thin;
            let grip = [0.1, 0.0];
            let setup = Setup::new(&[[0.0, 0.0], [1.0, 0.0], [0.25, h]]);
            let setup = setup.held_at(grip).springs(1.0, K).weighing(W);
            let run = Run::<R>::start(&setup, evolution, [0.1, 0.0, 0.3]);
            let [_, _, theta] = run.frame.pose;
            let [x, y] = [5.0 / 12.0 - grip[0], h / 3.0 - grip[1]];
            let lever = x * theta.cos() - y * theta.sin();
            assert_eq!(run.frame.status, Status::Ok, "{thin}");
            let off = (K * (0.3 - theta) - W * lever).abs();
            assert!(off <= 1e-6, "{} 1 : {thin}: off by {off:e} N·m", R::NAME);
            let at = setup.world(run.frame.pose, [5.0 / 12.0, h / 3.0]);
            let centroid = run.solver.centroid(&run.state).map(R::wide);
            for (got, want) in centroid.into_iter().zip(at) {
                R::near("centroid", got, want);
            }
        }
    }

    pub(super) fn no_sweep_breaks<R: Number>(evolution: Evolution) {
        for sweep in SWEEPS {
            for &value in sweep.values {
                let outcome = outcome::<R>(sweep, value, evolution);
                println!("{} = {value:e}: {outcome:?}", sweep.name);
                assert!(!matches!(outcome, Outcome::Broken(_)));
            }
        }
    }

    /// The part of every sweep that users meet: there every number type keeps its error bound and reports no limitation.
    pub(super) fn number_type_holds_what_users_need<R: Number>(evolution: Evolution) {
        for (name, from, to) in [
            ("mu_s of the floor (mu_d = 0.6 mu_s)", 0.0, 1e3),
            ("k_theta / (k_h L²)", 0.0, 10.0),
            ("body size L (m)", 1e-6, 1e6),
            ("k_h (N/m)", 1e-6, 1e9),
            ("weight / (k_h L)", 0.0, 10.0),
            ("displacement of the hand in one frame (L)", 0.1, 1.0),
            ("scene away from the origin (L)", 0.0, 1.0),
            ("angle between two floors (rad)", 1e-7, 1.0),
            ("angle between floor and ceiling (rad)", 0.0, 0.1),
            ("height of a triangle (L)", 1e-4, 0.5),
            ("vertices of a regular polygon", 1.0, 64.0),
            ("normal force left before a drag, N / (k_h L)", 0.0, 0.01),
            ("holding point from the contact (L)", 0.0, 1.0),
        ] {
            let sweep = SWEEPS.iter().find(|sweep| sweep.name == name);
            let sweep = sweep.unwrap_or_else(|| panic!("no sweep of {name}"));
            for &value in sweep.values.iter().filter(|v| (from..=to).contains(*v)) {
                let outcome = outcome::<R>(sweep, value, evolution);
                assert!(
                    matches!(outcome, Outcome::Holds { .. }),
                    "{name} = {value:e}: {outcome:?}"
                );
            }
        }
    }

    /// u + kappa sin u = delta folds at u* = acos(-1/kappa): up to it, to within roundings of it and beyond it.
    pub(super) fn at_a_fold_each_side_is_lawful<R: Number>(evolution: Evolution) {
        for kappa in [1.0 + 1e-6, 1.0001, 1.01, 1.5, 5.0, 40.0_f64] {
            // A lever of 0.3 that is held down from the contact: |z| = 0.3 · 0.4.
            let setup = Setup::point()
                .held_at([0.3, 0.0])
                .springs(1.0, 0.12 / kappa)
                .floor([1e3, 1e3])
                .at([0.0, 0.0, -std::f64::consts::FRAC_PI_2]);
            let u = (-1.0 / kappa).acos();
            let fold = u + kappa * u.sin();
            let start = setup.start[2];
            let hand = |turn: f64| [0.0, -0.4, start + turn];
            let tiny = R::ROUNDING * (fold + 2.0);
            for off in [
                -1e-2,
                -1e-4,
                -4.0 * tiny,
                -tiny,
                0.0,
                tiny,
                4.0 * tiny,
                1e-4,
                1e-2,
            ] {
                let keyframes = [hand(0.0), hand(fold + off), hand(fold + 0.7), hand(0.0)];
                let mut frames = run::<R>(&setup, evolution, &polyline(&keyframes[..2], 100));
                let last = &keyframes[1..];
                let mut whole = Run::<R>::start(&setup, evolution, keyframes[0]);
                frames.extend(whole.lead(last[0], 1));
                frames.extend(whole.lead(last[1], 30));
                frames.extend(whole.lead(last[2], 30));
                // Close to the triple root at kappa = 1, a search may end at its limit of steps, and reports it.
                frames.retain(|frame| kappa > 1.001 || frame.status < Status::IterationLimit);
                assert_lawful::<R>(&setup, &frames);
            }
        }
    }

    /// As mu_d grows to the value at which two ends of a slip meet in a double root, the slip length drops
    /// discontinuously: on both sides of that value, to the last digit of mu_d, the slip ends in balance at mu_d N.
    pub(super) fn slip_that_ends_on_a_double_root<R: Number>(evolution: Evolution) {
        let slip = |mu_d: f64| {
            let setup = Setup::point()
                .held_at([0.0, 0.8])
                .springs(1.0, 0.226)
                .floor([1.25, mu_d])
                .at([0.0, 0.0, 0.64]);
            let ([x, y], theta) = (setup.grip(), setup.start[2]);
            let mut run = Run::<R>::start(&setup, evolution, [x, y, theta]);
            let mut frames = run.lead([x, y - 0.46, theta], 10);
            let onset = run.onset([x + 2.0, y - 0.46, theta], |frame| frame.slips > 0);
            frames.push(onset.before);
            frames.push(run.frame.clone());
            assert_lawful::<R>(&setup, &frames);
            assert_eq!(run.frame.state, StateKind::SingleVertex);
            run.frame.longest_slip
        };
        let (mut low, mut high) = (R::rounded(0.10), R::rounded(0.25));
        let (long, short) = (slip(low), slip(high));
        assert!(long > 1.2 && short < 0.8, "{long} {short}");
        loop {
            let middle = R::rounded((low + high) / 2.0);
            if middle <= low || middle >= high {
                break;
            }
            if slip(middle) > 1.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let leap = slip(low) - slip(high);
        assert!(leap > 0.3, "leaps by {leap} at mu_d {low}");
    }

    /// After a million turns in the air, five per frame (a tenth of them daily), the body lands exactly as if it had never turned, to the bit.
    pub(super) fn million_turns_cost_no_digits<R: Number>(evolution: Evolution) {
        let setup = Setup::block(0.8, 0.6)
            .held_at([0.0, 0.4])
            .springs(1.0, 0.3)
            .floor([0.5, 0.3])
            .at([0.0, 1.0, 0.3]);
        let [x, y] = setup.grip();
        let landed = |most: i32| {
            let hand = |turns: i32, y: f64| -> Hand<R::Si> {
                let hand = planar::<R>([x, y, 0.3]);
                let rest = hand.angle.rest;
                Hand {
                    angle: Angle { turns, rest },
                    ..hand
                }
            };
            let mut run = Run::<R>::start_with(&setup, evolution, hand(0, y));
            for turns in (0..=most).step_by(5) {
                run.feed(hand(turns, y));
            }
            for i in 0..100 {
                run.feed(hand(most, y - 0.012 * f64::from(i)));
                assert_eq!(run.frame.status, Status::Ok);
            }
            run.frame
        };
        let (once, often) = (landed(0), landed(times(100_000, 1_000_000)));
        assert_eq!(once.state, often.state);
        assert_eq!(once.contacts, often.contacts);
        assert_eq!(once.wrench, often.wrench);
    }

    /// Parameters below the normal numbers of f32 are treated as zero.
    pub(super) fn denormal_parameters<R: Number>(evolution: Evolution) {
        let tiny = 1e-40;
        let setup = Setup::block(0.8, 0.6)
            .held_at([tiny, 0.4])
            .springs(1.0, tiny)
            .weighing(tiny)
            .surface([tiny, 1.0], tiny, [tiny, tiny])
            .at([tiny, tiny, tiny]);
        let [x, y] = setup.grip();
        let keyframes = [
            [x, y, tiny],
            [x + tiny, y - 0.1, -tiny],
            [x + 0.3, y - 0.1, 0.2],
        ];
        let frames = run::<R>(&setup, evolution, &polyline(&keyframes, 30));
        for frame in &frames {
            let broken = judge::<R>(&setup, frame)
                .into_iter()
                .find(|f| !f.holds() && (frame.status <= Status::EventLimit || f.law == FINITE));
            assert_eq!(broken, None, "{frame:?}");
        }
    }
}
