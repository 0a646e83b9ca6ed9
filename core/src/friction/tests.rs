//! The cones at their edges: which contacts hold, slide and open, and at which load stiction begins.

use super::*;
use crate::fixtures::number;
use crate::real::Fixed;

const MEMORY: f64 = 1.0 / 4096.0;

/// A cone that is a line, and one that is a half-plane: cosine and sine are 1 and 0 to the last bit.
fn extremes() -> [Coulomb<f64>; 2] {
    [0.0, 1e300].map(|mu| Coulomb::from_coefficients(mu, mu, MEMORY))
}

#[test]
fn within_is_by_more_than_the_slack() {
    let [smooth, rough] = extremes();
    for stiction in [true, false] {
        for slack in [0.0_f64, 0.25] {
            assert!(rough.is_within((slack.next_up(), 0.0), stiction, slack));
            assert!(!rough.is_within((slack, 0.0), stiction, slack));
            assert!(!rough.is_within((-1.0, 0.0), stiction, slack));
            let on_both_edges = smooth.is_within((1.0, 0.0), stiction, slack);
            assert!(!on_both_edges);
        }
    }
    let half = Coulomb::<f64>::from_coefficients(0.5, 0.25, MEMORY);
    for (stiction, mu) in [(true, 0.5), (false, 0.25)] {
        for sign in [1.0, -1.0] {
            assert!(half.is_within((1.0, sign * (mu - 0.01)), stiction, 0.0));
            assert!(!half.is_within((1.0, sign * (mu + 0.01)), stiction, 0.0));
        }
    }
}

#[test]
fn verdict_is_to_within_the_rounding() {
    let [smooth, rough] = extremes();
    let rounding = 0.125_f64;
    let more = rounding.next_up();
    for stiction in [true, false] {
        let judge = |normal: f64| smooth.judge((normal, 0.0), stiction, rounding);
        assert_eq!(judge(-rounding), Verdict::Sticks);
        assert_eq!(judge(-more), Verdict::Opens);
        for sign in [1.0, -1.0] {
            let judged = |friction: f64| smooth.judge((0.0, sign * friction), stiction, rounding);
            assert_eq!(judged(rounding), Verdict::Sticks);
            assert_eq!(judged(more), Verdict::Slides(-sign));
            // Against friction in one direction it slides in the other.
            let driven = |friction: f64| smooth.is_driven(0.0, -sign * friction, sign, rounding);
            assert!(!driven(rounding) && driven(more) && !driven(-more));
        }
        let held = rough.judge((1.0, 1e3), stiction, rounding);
        assert_eq!(held, Verdict::Sticks);
    }
}

/// N* = D_c / (mu_s - mu_d), including this value; none if the coefficients are equal.
fn stiction_begins_at_the_threshold<R: Real>()
where
    R::Si: From<f32>,
{
    let si = |x: f64| R::Si::from(x as f32);
    for (mu_s, mu_d, memory) in [
        (0.5, 0.25, MEMORY),
        (0.5, 0.25, 1.0 / 64.0),
        (2.0, 0.0, MEMORY),
        (8.0, 7.0, 0.125),
    ] {
        let friction = Coulomb::<R>::from_coefficients(si(mu_s), si(mu_d), si(memory));
        let threshold = friction.threshold();
        let off = threshold - number::<R>(memory / (mu_s - mu_d));
        assert!(off.abs() <= R::EPSILON.doubled(), "{threshold:?}");
        assert!(friction.is_pressed(threshold));
        assert!(friction.is_pressed(threshold.doubled()));
        assert!(!friction.is_pressed(threshold - R::EPSILON.doubled()));
        assert!(!friction.is_pressed(R::ZERO) && !friction.is_pressed(-threshold.doubled()));
        assert_eq!(friction.memory(), number(memory));
        assert_eq!(friction.drop(), number(mu_s - mu_d));
        let normal = Margin {
            start: number(0.1),
            along: number(-0.2),
            turning: Vec2::new(number(0.3), number(0.4)),
            rounding: R::EPSILON,
        };
        let loosens = friction.loosens(normal).expect("a threshold");
        assert_eq!(loosens.start, threshold - normal.start);
        assert_eq!(
            (loosens.along, loosens.turning),
            (-normal.along, -normal.turning)
        );
        assert_eq!(loosens.rounding, normal.rounding);
    }
    for mu in [0.0, 0.4, 50.0] {
        let friction = Coulomb::<R>::from_coefficients(si(mu), si(mu), si(MEMORY));
        assert!(!friction.is_pressed(R::ONE) && !friction.is_pressed(R::HUGE));
        assert!(friction.threshold() >= R::HUGE);
        assert!(
            friction
                .loosens(Margin {
                    start: R::ONE,
                    along: -R::ONE,
                    turning: Vec2::ZERO,
                    rounding: R::EPSILON,
                })
                .is_none()
        );
    }
    // A memory length of zero becomes the shortest one.
    let shortest = Coulomb::<R>::from_coefficients(si(0.5), si(0.25), si(0.0));
    assert_eq!(shortest.memory(), R::MICRO);
}

#[test]
fn stiction_begins_at_the_threshold_in_every_number_type() {
    stiction_begins_at_the_threshold::<f64>();
    stiction_begins_at_the_threshold::<f32>();
    stiction_begins_at_the_threshold::<Fixed>();
}
