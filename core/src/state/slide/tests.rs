//! A vertex that slides with the hand, against many small steps of statics written out: it is in balance throughout, on the edge of its
//! cone, and passes nothing that ends a slide.

use super::*;
use crate::fixtures::bench::{Bench, HandAt, Plain};
use crate::fixtures::{Random, sampled};
use crate::real::Fixed;
use crate::search::Looks;

mod frames;

/// A slide with a displacement and a turn of the hand to come.
struct Case {
    bench: Bench,
    hand: HandAt,
    way: (Vec2<f64>, f64),
    theta: f64,
    foot: f64,
    sign: f64,
}

fn case(seed: u64) -> Option<Case> {
    let mut random = Random(seed);
    let mu = [0.0, 0.1, 0.3, 1.0, 5.0][seed as usize % 5];
    let drop = 0.2 + random.next().abs();
    let memory = libm::exp2(-5.0 + 5.0 * random.next());
    let bench = Bench::random(&mut random, [mu + drop, mu, memory]);
    // Often nearly flat.
    let lean = random.next();
    let theta = bench.planes[0].0 + 1.25 + 1.24 * libm::cbrt(lean);
    let foot = 0.5 * random.next();
    let sign = random.next().signum();
    let normal = memory / drop * random.next().abs();
    let hand = bench.holding(theta, foot, [normal, -sign * mu * normal]);
    let size = libm::exp2(-4.0 + 4.0 * random.next());
    let mut case = Case {
        hand,
        way: (random.vector() * size, random.next() * size),
        theta,
        foot,
        sign,
        bench,
    };
    let is_lawful = normal > 1e-3
        && case.bench.least_gap(theta, foot) > 1e-3
        && case.bench.sliding_stability(&hand, theta, sign) > 0.05;
    // Mostly onward, not back.
    if is_lawful && !seed.is_multiple_of(4) && sign * (case.at(1e-4, theta).foot - foot) < 0.0 {
        case.way = (-case.way.0, -case.way.1);
    }
    is_lawful.then_some(case)
}

/// The position of a slide at a fraction of the path, and the margins that are left.
#[derive(Clone, Copy, Debug)]
struct At {
    theta: f64,
    foot: f64,
    stability: f64,
    normal: f64,
    /// The margin to N*.
    loose: f64,
    gap: f64,
}

impl Case {
    fn hand(&self, part: f64) -> HandAt {
        self.hand.on(self.way, part)
    }

    fn at(&self, part: f64, near: f64) -> At {
        let hand = self.hand(part);
        let (theta, foot) = self.bench.slides(&hand, near, self.sign);
        let [normal, _] = self.bench.reaction(&hand, theta, foot);
        let [mu_s, mu_d, memory] = self.bench.friction;
        At {
            theta,
            foot,
            stability: self.bench.sliding_stability(&hand, theta, self.sign),
            normal,
            loose: memory / (mu_s - mu_d) - normal,
            gap: self.bench.least_gap(theta, foot),
        }
    }

    /// By small steps to a fraction of the path: nothing ends the slide earlier by more than `off`. Returns the last position; `None` if
    /// the balance is so close to a fold that small steps cannot resolve it.
    #[track_caller]
    fn lasts(&self, part: f64, off: f64) -> Option<At> {
        let steps = if cfg!(miri) { 8 } else { 32 };
        let mut last = self.at(0.0, self.theta);
        for i in 1..=steps {
            let at = self.at(part * f64::from(i) / f64::from(steps), last.theta);
            if at.stability < 0.02 || (at.theta - last.theta).abs() > 0.3 {
                return None;
            }
            let left = at.normal.min(at.loose).min(at.gap);
            assert!(left > -off, "{i}: {at:?}");
            let advance = self.sign * (at.foot - last.foot);
            assert!(advance > -off, "{i}: {at:?} after {last:?}");
            last = at;
        }
        Some(last)
    }

    fn state<R: Plain>(&self) -> SingleVertex<R> {
        let pivot = self.bench.pivot(self.theta, self.foot);
        SingleVertex {
            regime: Regime::Slide(R::of(self.sign)),
            ..SingleVertex::new(pivot)
        }
    }

    /// From the beginning to a fraction of the path.
    fn grips<R: Plain>(&self, part: f64) -> [Grip<R>; 2] {
        [0.0, part].map(|part| self.bench.grip(&self.hand(part)))
    }
}

/// The error of the state relative to a position.
fn off<R: Plain>(state: &SingleVertex<R>, at: &At) -> f64 {
    let turn = state.pivot.orientation.angle().radians().plain() - at.theta;
    turn.abs() + (state.pivot.foot.plain() - at.foot).abs()
}

/// The same position, on the edge of the cone, and at its end the cause of the end.
fn slide_lasts_to_its_first_event<R: Plain>(digits: f64) -> [usize; 6] {
    let mut seen = [0; 6];
    for seed in sampled(0..1000, 97) {
        let Some(case) = case(seed) else { continue };
        let scene = case.bench.scene::<R>().expect("a sound scene");
        let mut state = case.state::<R>();
        let [from, to] = case.grips(1.0);
        let moved = state.advance_sliding(&scene, (&from, &to), R::of(case.sign));
        if moved.unsure {
            // It is not granted this many evaluations at a time.
            assert!(moved.work >= u32::from(Looks::MOST), "{seed}");
            continue;
        }
        let part = moved.part.plain();
        let lasted = case.lasts(part, digits);
        let theta = state.pivot.orientation.angle().radians().plain();
        if let Trigger::Fold(_) = moved.trigger {
            let hand = case.hand(part);
            let left = case.bench.sliding_stability(&hand, theta, case.sign);
            let moment = case.bench.sliding_moment(&hand, theta, case.sign);
            let size = 1.0 + hand.place.length();
            assert!(
                left.abs() < 8.0 * libm::sqrt(digits) * size,
                "{seed}: {left}"
            );
            assert!(moment.abs() < 8.0 * digits * size, "{seed}: {moment}");
            seen[4] += 1;
            continue;
        }
        let Some(at) = lasted else { continue };
        let near = off(&state, &at) * at.stability.min(1.0);
        assert!(near < digits, "{seed}: {moved:?} {near} of {at:?}");
        let left = match moved.trigger {
            Trigger::Balanced => {
                assert_eq!(moved.part, R::ONE);
                seen[0] += 1;
                continue;
            }
            Trigger::Clear => (1, at.normal),
            Trigger::Pressed => (2, at.loose),
            Trigger::Touch(pair) => {
                let pair = (usize::from(pair.vertex), usize::from(pair.surface));
                (3, case.bench.gap(at.theta, at.foot, pair))
            }
            Trigger::Halts => {
                const STEP: f64 = 1e-4;
                let foot = |part: f64| case.at(part, at.theta).foot;
                let advance = case.sign * (foot(part + STEP) - foot(part - STEP)) / (2.0 * STEP);
                (
                    5,
                    if part == 0.0 {
                        advance.max(0.0)
                    } else {
                        advance
                    },
                )
            }
            other => panic!("{seed}: {other:?}"),
        };
        let (which, left) = left;
        let bound = if which == 5 {
            libm::sqrt(digits)
        } else {
            digits
        };
        assert!(left.abs() < bound, "{seed}: {moved:?} {left}");
        seen[which] += 1;
    }
    seen
}

#[test]
fn slide_lasts_to_its_first_event_in_every_number_type() {
    let all = |seen: [usize; 6]| {
        let is_seen = seen.iter().all(|count| *count > 2);
        assert!(cfg!(miri) || is_seen, "{seen:?}");
    };
    all(slide_lasts_to_its_first_event::<f64>(1e-9));
    all(slide_lasts_to_its_first_event::<f32>(1e-4));
    all(slide_lasts_to_its_first_event::<Fixed>(1e-4));
}
