//! The turns downhill against slow searches: folds and balances; polishing and the range of representable values.

use super::*;
use crate::fixtures::{number, searches};
use crate::real::Fixed;

/// STATICS 11: where u + kappa sin u = delta lands beyond its fold.
#[test]
fn fold_lands_on_the_first_stable_balance() {
    for (kappa, fold, delta, lands) in [
        (1.05, 2.831_748_013_8, 3.151_904_225_7, 3.764_317_194_1),
        (1.5, 2.300_523_983_0, 3.418_557_971_8, 4.893_912_630_5),
        (2.0, 2.094_395_102_4, 3.826_445_910_0, 5.387_598_242_9),
        (5.0, 1.772_154_247_6, 6.671_133_733_2, 6.347_880_979_4_f64),
    ] {
        let moment = Moment {
            couple: delta - fold,
            stiffness: 1.0,
            hold: Vec2::new(kappa * libm::cos(fold), -kappa * libm::sin(fold)),
            harmonic: Pinned,
        };
        let found = moment.over_fold(1.0);
        assert!(found.snapped && !found.unsure);
        assert!(
            (fold + found.turn - lands).abs() < 1e-8,
            "kappa {kappa}: {found:?}"
        );
    }
}

/// A moment of a number type, out of balance by `now`.
fn moment<R: Real>(now: f64, stiffness: f64, (x, y): (f64, f64)) -> Moment<R, Pinned>
where
    R::Si: From<f32>,
{
    Moment {
        couple: number(now - y),
        stiffness: number(stiffness),
        hold: Vec2::new(number(x), number(y)),
        harmonic: Pinned,
    }
}

/// If the stability has no reciprocal in fixed point a balance is polished all the same, and the moment multiplied by the softness has one.
#[test]
fn soft_grip_is_polished() {
    for stiffness in [1.0, 0.1, 0.01, 0.007, 0.004, 0.001] {
        let soft = moment::<Fixed>(0.0, stiffness, (0.0, 0.0));
        let unit = <Fixed as Real>::EPSILON;
        let turned = Moment {
            couple: unit + unit,
            ..soft
        };
        let turn = turned.polish().to_si(1.0);
        let should = 2.0 * unit.to_si(1.0) / soft.stiffness.to_si(1.0);
        assert!(
            (turn - should).abs() <= 0.01 * should + 1e-7,
            "{turn} {should}"
        );
        let times = soft.softness();
        let firm = soft.times(times).stability().to_si(1.0) * <Fixed as Real>::HUGE.to_si(1.0);
        assert!(firm >= 15.0, "{stiffness}: {firm}");
        assert!(
            times == <Fixed as Real>::ONE || firm < 33.0,
            "{stiffness}: {firm}"
        );
    }
    let unstable = moment::<Fixed>(1e-6, 0.1, (-0.2, 0.0));
    assert_eq!(unstable.polish(), <Fixed as Real>::ZERO);
    assert_eq!(unstable.softness(), <Fixed as Real>::ONE);
}

/// From anywhere downhill to the first balance, by small steps; the springs' couple alone may outweigh the load over several turns.
#[test]
fn downhill_ends_at_the_first_balance() {
    const STEP: f64 = if cfg!(miri) { 1e-2 } else { 1e-4 };
    for (now, k, load) in [
        (0.5, 1.0, (0.25, 0.25)),
        (-0.5, 1.0, (-3.0, 0.25)),
        (30.0, 1.0, (2.0, -2.0)),
        (-30.0, 0.75, (2.0, 2.0)),
        (0.015_625, 0.125, (-3.0, 1.0)),
        (7.0, 0.25, (-0.0625, -0.125)),
        (0.015_625, 0.0, (1.0, 0.5)),
        (-2.0, 0.0, (-1.0, -2.0)),
    ] {
        let moment = moment::<f64>(now, k, load);
        let (x, y) = load;
        let at = |turn: f64| {
            let (sin, cos) = libm::sincos(turn);
            now - k * turn + y * (cos - 1.0) - x * sin
        };
        let found = moment.downhill();
        let direction = now.signum();
        let first = (0..10_000_000).map(|i| f64::from(i) * STEP * direction);
        let mut most = now.abs();
        let passed = first.into_iter().find(|&turn| {
            most = most.max(at(turn).abs());
            at(turn) * direction <= 0.0
        });
        let passed = passed.expect("a balance");
        let left = (passed - found.turn) * direction;
        assert!(
            (0.0..=STEP * 1.01).contains(&left),
            "{now} {k} {load:?}: {found:?} {passed}"
        );
        let balance = at(found.turn).abs();
        assert!(
            balance < 1e-12 * (1.0 + now.abs()),
            "{now} {k} {load:?} {balance} {found:?}"
        );
        assert!(!found.unsure);
        assert_eq!(
            found.snapped,
            most > now.abs() * (1.0 + 1e-6),
            "{now} {k} {load:?}"
        );
    }
}

/// A turn downhill that gives up ends where the moment still pulls on, and reports it.
#[test]
fn turn_that_gives_up_says_so() {
    for (now, k, load) in [(30.0, 1.0, (2.0, -2.0)), (-2.0, 0.0, (-1.0, -2.0))] {
        let moment = moment::<f64>(now, k, load);
        let whole = moment.downhill();
        let mut last = 0.0;
        for most in 1..40 {
            let (found, counts) = searches::giving_up(most, || moment.downhill());
            assert_eq!(found.unsure, counts.unsure > 0, "{most}");
            let turned = found.turn * now.signum();
            assert!(
                turned >= last && turned <= whole.turn.abs() * (1.0 + 1e-9),
                "{turned}"
            );
            last = turned;
            if !found.unsure {
                assert_eq!(found, whole);
            }
        }
        assert_eq!(last, whole.turn.abs());
    }
}

/// Before an angle at which the springs' couple outweighs the load there is no balance, so many turns need no more work than one.
#[test]
fn many_turns_are_no_more_work_than_one() {
    for k in [0.25, 1.0, 4.0] {
        for angle in [6.0, 60.0, 6000.0] {
            let moment = moment::<f64>(k * angle, k, (2.0 * k, 0.0));
            let (found, counts) = searches::counted(|| moment.downhill());
            // A search takes 3 to 9 steps to a simple zero; within the last turn there may be a near-zero before it.
            assert!(counts.steps <= 16, "{k} {angle}: {counts:?}");
            let (sin, _) = libm::sincos(found.turn);
            let left = angle - found.turn - 2.0 * sin;
            assert!(left.abs() < 1e-12 * angle, "{k} {angle}: {left}");
        }
    }
}

/// It snaps if the moment grew before it fell; one that keeps its size at first and then falls does not.
#[test]
fn moment_that_only_falls_does_not_snap() {
    for (y, snapped) in [(1.0, false), (-1.0, true)] {
        let level = moment::<f64>(0.5, 1.0, (-1.0, y));
        assert_eq!(level.stability(), 0.0);
        let found = level.downhill();
        assert_eq!(found.snapped, snapped, "{y}: {found:?}");
    }
}

/// Without a load there is no fold to leave behind: the result is the springs' balance.
#[test]
fn fold_without_a_load_is_the_balance_of_the_springs() {
    let moment = moment::<f64>(0.5, 2.0, (0.0, 0.0));
    let found = moment.over_fold(1.0);
    assert!(
        (found.turn - 0.25).abs() < 1e-15 && !found.unsure,
        "{found:?}"
    );
}
