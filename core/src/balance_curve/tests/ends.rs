//! The end of a motion: without a turn in closed form; with as little work as its bounds permit; and the report of a search that gives up.

use super::*;
use crate::fixtures::number;
use crate::real::Fixed;

/// A turn by an angle ends at that angle to the bit, even if x has units of several radians.
fn turn_ends_at_its_angle<R: Real>()
where
    R::Si: From<f32>,
{
    for seed in sampled(0..400, 97) {
        let most = [0.5, 5.0, 60.0][seed as usize % 3];
        let angle = number::<R>(most * Random(seed).next()) / R::from_int(3);
        let (curve, extent) = BalanceCurve::<R, Pinned>::turning(angle);
        assert!(extent.end.turn == angle, "{angle:?}: {extent:?}");
        assert!((extent.end.part() - R::ONE).abs() <= R::EPSILON * R::from_int(4));
        let half = curve.at(extent.end.x.halved());
        assert!(
            (half.turn.doubled() - angle).abs()
                <= R::rounding(angle.abs().max(R::ONE)) * R::from_int(4)
        );
    }
}

#[test]
fn turns_end_at_their_angles() {
    turn_ends_at_its_angle::<f64>();
    turn_ends_at_its_angle::<f32>();
    turn_ends_at_its_angle::<Fixed>();
}

fn margin(start: f64, along: f64) -> Margin<f64> {
    Margin {
        start,
        along,
        turning: Vec2::ZERO,
        rounding: 1e-15,
    }
}

/// Without a turn tau = h x, and a margin is linear in it; one that does not fall is never used up.
#[test]
fn margin_is_linear_without_a_turn() {
    for h in [0.5, 1.0, 2.0] {
        let curve = BalanceCurve::<f64>::kinematic(0.0, Vec2::new(h, 0.0));
        for along in [-3.0, -1.5, -0.9, -0.6, -0.4, 0.0, 0.5] {
            let mut extent = curve.extent_to(1.0);
            let stops = curve.stop_at(&margin(1.0, along), &mut extent);
            assert_eq!(stops, 1.0 + along * h < 0.0, "{h} {along}");
            let end = if stops { -1.0 / along } else { h };
            assert!((extent.end.part() - end).abs() < 1e-15, "{h} {along}");
        }
        for start in [1e-3, 0.0, -1e-3] {
            let mut extent = curve.extent_to(1.0);
            assert!(!curve.stop_at(&margin(start, 0.0), &mut extent));
        }
    }
}

/// On an extent that a fold cuts to a tenth only that tenth counts: no search is needed.
#[test]
fn margin_that_lasts_to_the_fold_is_no_search() {
    let delta = 3.826_445_910_0;
    let curve = turning(2.0, 10.0 * delta);
    let mut extent = curve.extent();
    assert!(extent.folds && (extent.end.part() - 0.1).abs() < 1e-9);
    let (stops, counts) = searches::counted(|| curve.stop_at(&margin(1.0, -5.0), &mut extent));
    assert!(!stops && counts.searches == 0);
    let (stops, counts) = searches::counted(|| curve.stop_at(&margin(1.0, -20.0), &mut extent));
    assert!(stops && counts.searches == 1);
    assert!((extent.end.part() - 0.05).abs() < 1e-12);
}

/// A body that turns freely about a point next to the hand swings round at the first pull: almost the whole path lies between adjacent
/// turns. A margin that is used up on it ends the motion all the same.
#[test]
fn margin_is_used_up_between_neighbouring_turns() {
    for pull in (0..20).map(|i| libm::exp10(-f64::from(i))) {
        for angle in [0.3, 0.8, 1.2, -0.5] {
            let (sin, cos) = libm::sincos(angle);
            let moment = Moment {
                couple: 0.0,
                stiffness: 0.0,
                hold: Vec2::new(pull, 0.0),
                harmonic: Pinned,
            };
            let drive = Drive {
                couple: 0.0,
                hold: Vec2::new(cos, sin),
            };
            let curve = BalanceCurve::balanced(&moment, &drive);
            for (start, along, stops) in [(0.0, -0.1, true), (0.5, -0.7, true), (0.5, -0.3, false)]
            {
                let margin = margin(start, along);
                let mut extent = curve.extent();
                let shortened = curve.stop_at(&margin, &mut extent);
                let (until, ended) = curve.extent_until(Some(&margin));
                assert_eq!((shortened, ended), (stops, stops), "{pull} {angle} {along}");
                assert!(!extent.unsure && !until.unsure);
            }
        }
    }
}

/// If the search for the end gives up, the extent reports it, unless something ends it earlier; it lies somewhere before the end.
#[test]
fn extent_that_gives_up_says_so() {
    let curve = turning(0.9, 30.0);
    let whole = curve.extent();
    let turning_margin = Margin {
        turning: Vec2::new(0.5, -1.0),
        ..margin(1.0, -0.5)
    };
    let mut ended = whole;
    assert!(curve.stop_at(&turning_margin, &mut ended) && !ended.unsure);
    let mut seen = [0; 4];
    for most in 1..60 {
        let (extent, counts) = searches::giving_up(most, || curve.extent());
        assert_eq!(extent.unsure, counts.unsure > 0, "{most}");
        assert!(!extent.folds && extent.end.x <= whole.end.x);
        seen[usize::from(extent.unsure)] += 1;
        // A margin that is used up far before the end.
        let mut stopped = whole;
        let stop = || curve.stop_at(&turning_margin, &mut stopped);
        let (stops, counts) = searches::giving_up(most, stop);
        assert!(stops);
        assert_eq!(stopped.unsure, counts.unsure > 0, "{most}");
        assert!(stopped.end.x <= ended.end.x * (1.0 + 1e-9));
        seen[2 + usize::from(stopped.unsure)] += 1;
        // What happens before the end is certain, and the end of the extent is as uncertain as it was.
        let mut stopped = extent;
        if curve.stop_at(&turning_margin, &mut stopped) {
            assert!(!stopped.unsure, "{most}");
            assert!(
                (stopped.end.x - ended.end.x).abs() <= 1e-9 * ended.end.x,
                "{most}"
            );
        } else {
            assert_eq!(stopped.unsure, extent.unsure, "{most}");
        }
    }
    assert!(seen.iter().all(|count| *count > 0), "{seen:?}");
}
