//! The first point at which functions fall to zero, against dense sampling.

use super::*;
use crate::fixtures::{Random, number, sampled};
use crate::real::Fixed;

/// c + a x + b sin(w x + s) and its derivative.
struct Wave {
    level: f64,
    along: f64,
    size: f64,
    rate: f64,
    phase: f64,
}

impl Wave {
    fn random(random: &mut Random) -> Self {
        Self {
            level: random.next().abs(),
            along: random.next(),
            size: random.next(),
            rate: 4.0 * random.next(),
            phase: 3.0 * random.next(),
        }
    }
    fn at(&self, x: f64) -> (f64, f64) {
        let (sin, cos) = libm::sincos(self.rate * x + self.phase);
        (
            self.level + self.along * x + self.size * (sin - libm::sin(self.phase)),
            self.along + self.size * self.rate * cos,
        )
    }
}

const END: f64 = 2.0;
const LONGEST: f64 = 0.125;

fn found<R: Real>(waves: &[Wave; 2]) -> (Found<R>, u32)
where
    R::Si: From<f32> + Into<f64>,
{
    let mut looks = 0;
    let found = first_fall((number(END), number(LONGEST)), MOST_FALLS, |x: R| {
        looks += 1;
        let x: f64 = x.to_si(R::Si::ONE).into();
        [0, 1].map(|i| {
            let (value, slope) = waves[i].at(x);
            Some(Level {
                value: number::<R>(value),
                slope: number(slope),
                rounding: R::EPSILON * R::from_int(8),
            })
        })
    });
    (found, looks)
}

fn first<R: Real>()
where
    R::Si: From<f32> + Into<f64>,
{
    let (mut zeros, mut most) = (0, 0);
    for seed in sampled(0..3000, 97) {
        let mut random = Random(seed);
        let waves = [Wave::random(&mut random), Wave::random(&mut random)];
        let (found, looks) = found::<R>(&waves);
        most = most.max(looks);
        const STEPS: i32 = 4000;
        let places = (1..=STEPS).map(|k| END * f64::from(k) / f64::from(STEPS));
        let should = places
            .flat_map(|x| [(x, 0), (x, 1)])
            .find(|&(x, i)| waves[i].at(x).0 < -1e-5);
        match (found, should) {
            (Found::Zero { x, which }, Some((should, _))) => {
                let x: f64 = x.to_si(R::Si::ONE).into();
                assert!(x <= should, "{seed}: {x} {should}");
                assert!(waves[which].at(x).0.abs() < 1e-5, "{seed}");
                zeros += 1;
            }
            (Found::Zero { x, which }, None) => {
                let x: f64 = x.to_si(R::Si::ONE).into();
                assert!(waves[which].at(x).0 < 2e-6, "{seed}");
            }
            (Found::Nothing { .. }, None) => {}
            other => panic!("{seed}: {other:?}"),
        }
    }
    assert!(cfg!(miri) || zeros > 1000, "{zeros}");
    assert!(most <= 40, "{most}");
}

#[test]
fn first_fall_is_found_in_f64() {
    first::<f64>();
}

#[test]
fn first_fall_is_found_in_f32() {
    first::<f32>();
}

#[test]
fn first_fall_is_found_in_fixed_point() {
    first::<Fixed>();
}

/// A function that is zero everywhere has a fall at some point of the piece, and none if zero is within its rounding.
#[test]
fn what_is_zero_everywhere_has_a_place() {
    let zero = |rounding| Level {
        value: 0.0_f32,
        slope: 0.0,
        rounding,
    };
    let found = first_fall((1.125, 1.125), MOST_FALLS, |_| [Some(zero(0.0))]);
    let Found::Zero { x, which: 0 } = found else {
        panic!("{found:?}");
    };
    assert!((0.0..=1.125).contains(&x), "{x}");
    let found = first_fall((1.125, 1.125), MOST_FALLS, |_| [Some(zero(f32::EPSILON))]);
    assert!(matches!(found, Found::Nothing { x: 1.125 }), "{found:?}");
}
