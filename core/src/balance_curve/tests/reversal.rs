//! Where a foot turns back: the first zero of its velocity, against dense samples.

use super::*;

/// How fast a displacement grows along the curve with x, given that tau itself grows.
fn advance<H: SecondHarmonic<f64>>(
    curve: &BalanceCurve<f64, H>,
    foot: &Margin<f64>,
    x: f64,
) -> f64 {
    let p = curve.at(x);
    let (sin, cos) = libm::sincos(p.turn);
    let part_slope = (p.h_slope * p.d - p.h * p.d_slope) / (p.d * p.d);
    let Vec2 { x: u, y: v } = foot.turning;
    foot.along * part_slope + curve.rate * (v * cos - u * sin)
}

/// The number of feet that go on, turn back immediately and turn back later.
fn foot_turns_back_first_there<H: SecondHarmonic<f64>>() -> [usize; 3] {
    let mut seen = [0; 3];
    for seed in sampled(1..=600, 97) {
        let mut random = Random(seed);
        let curve = random.curve::<H>();
        let foot = Margin {
            start: 0.0,
            ..random.margin()
        };
        if curve.at(0.0).h_slope <= 0.0 {
            continue;
        }
        // A foot that moves back by the slack per unit of tau still goes on.
        let slack = if seed % 3 == 0 { 0.1 } else { 0.0 };
        let slackened = Margin {
            along: foot.along + slack,
            ..foot
        };
        let whole = curve.extent();
        let mut extent = whole;
        let stops = curve.stop_at_reversal(&foot, slack, &mut extent);
        assert!(!extent.unsure && extent.end.x <= whole.end.x, "{seed}");
        let size = slackened.along.abs() + curve.rate.abs() * foot.turning.length();
        let velocity = |x: f64| advance(&curve, &slackened, x) / size;
        let end = extent.end.x;
        let before = (0..400).map(|i| end * f64::from(i) / 400.0);
        if stops && end == 0.0 {
            assert!(velocity(0.0) < 1e-9, "{seed}: {}", velocity(0.0));
            seen[1] += 1;
            continue;
        }
        assert!(
            before.clone().all(|x| velocity(x) > -1e-9),
            "{seed}: {end} of {}",
            whole.end.x
        );
        if stops {
            assert!(!extent.folds, "{seed}");
            // Near a fold tau hardly grows: x has all its digits but tau has few left.
            let p = curve.at(end);
            let zero = velocity(end) * p.d * p.d / (curve.whole() + 1.0);
            assert!(zero.abs() < 1e-9, "{seed}: {zero}");
            seen[2] += 1;
        } else {
            assert_eq!((end, extent.folds), (whole.end.x, whole.folds), "{seed}");
            seen[0] += 1;
        }
    }
    seen
}

#[test]
fn foot_that_sticks_or_slides_turns_back_first_there() {
    for seen in [
        foot_turns_back_first_there::<Pinned>(),
        foot_turns_back_first_there::<Sliding<f64>>(),
    ] {
        assert!(
            cfg!(miri) || seen.iter().all(|count| *count > 20),
            "{seen:?}"
        );
    }
}

/// Without a turn the foot moves with the hand or back, on the whole path; one that rests to within the slack goes on.
#[test]
fn straight_foot_goes_one_way() {
    let curve = BalanceCurve::<f64>::straight();
    for (along, slack, stops) in [
        (1.0, 0.0, false),
        (0.0, 1e-3, false),
        (-1e-3, 0.0, true),
        (-1e-3, 2e-3, false),
        (-3e-3, 2e-3, true),
        (-1.0, 0.0, true),
    ] {
        let foot = Margin {
            start: 0.0,
            along,
            turning: Vec2::ZERO,
            rounding: 1e-15,
        };
        let mut extent = curve.extent_to(1.0);
        let stopped = curve.stop_at_reversal(&foot, slack, &mut extent);
        assert_eq!(stopped, stops, "{along} {slack}");
        assert_eq!(extent.end.x, if stops { 0.0 } else { 1.0 });
    }
}

/// A search that gives up earlier reports it, at a point up to which the foot goes on.
#[test]
fn reversal_that_gives_up_says_so() {
    let curve = turning(0.9, 30.0);
    let whole = curve.extent();
    // It swings back and forth as the body turns.
    let foot = Margin {
        start: 0.0,
        along: 0.1,
        turning: Vec2::new(0.0, 1.0),
        rounding: 1e-15,
    };
    let mut sure = whole;
    assert!(curve.stop_at_reversal(&foot, 0.0, &mut sure) && !sure.unsure);
    let mut seen = [0; 2];
    for most in 1..60 {
        let mut extent = whole;
        let stop = || curve.stop_at_reversal(&foot, 0.0, &mut extent);
        let (stops, counts) = searches::giving_up(most, stop);
        assert!(stops);
        assert_eq!(extent.unsure, counts.unsure > 0, "{most}");
        assert!(extent.end.x <= sure.end.x * (1.0 + 1e-9), "{most}");
        seen[usize::from(extent.unsure)] += 1;
    }
    assert!(seen.iter().all(|count| *count > 0), "{seen:?}");
}
