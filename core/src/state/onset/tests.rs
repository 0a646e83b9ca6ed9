//! What begins where a contact bears nothing yet, against the balances of statics written out slightly later on the hand's path.

use super::*;
use crate::fixtures::bench::{Bench, HandAt};
use crate::fixtures::{Random, sampled};

const STEP: f64 = 1e-5;

/// A vertex on its surface without a reaction, and the displacement of the hand.
struct Case {
    bench: Bench,
    hand: HandAt,
    way: (Vec2<f64>, f64),
    theta: f64,
    foot: f64,
}

fn cases() -> impl Iterator<Item = (u64, Case)> {
    sampled(0..2000, 97).map(|seed| {
        let mut random = Random(seed);
        let mu = [0.0, 0.2, 0.6, 3.0][seed as usize % 4];
        let bench = Bench::random(&mut random, [mu + 0.2, mu, 0.01]);
        let (theta, foot) = (3.0 * random.next(), random.next());
        let case = Case {
            hand: bench.holding(theta, foot, [0.0; 2]),
            way: (random.vector(), random.next()),
            bench,
            theta,
            foot,
        };
        (seed, case)
    })
}

impl Case {
    fn hand(&self, part: f64) -> HandAt {
        self.hand.on(self.way, part)
    }

    fn grips(&self) -> [Grip<f64>; 2] {
        [0.0, 1.0].map(|part| self.bench.grip(&self.hand(part)))
    }

    fn vertex(&self) -> SingleVertex<f64> {
        SingleVertex::new(self.bench.pivot(self.theta, self.foot))
    }

    fn stick(&self, part: f64) -> f64 {
        (self.bench).sticks(&self.hand(part), self.theta, self.foot)
    }

    fn slide(&self, part: f64, sign: f64) -> (f64, f64) {
        self.bench.slides(&self.hand(part), self.theta, sign)
    }

    fn sticking_stability(&self) -> f64 {
        (self.bench).sticking_stability(&self.hand, self.theta, self.foot)
    }

    fn sliding_stability(&self, sign: f64) -> f64 {
        (self.bench).sliding_stability(&self.hand, self.theta, sign)
    }

    /// The rates of turn and foot in a slide.
    fn sliding_rates(&self, sign: f64) -> [f64; 2] {
        let (before, after) = (self.slide(-STEP, sign), self.slide(STEP, sign));
        [after.0 - before.0, after.1 - before.1].map(|way| way / (2.0 * STEP))
    }
}

/// Rates of a sticking foot and of a sliding one; `None` if the balance is not stable.
#[test]
fn rates_are_those_of_the_balances() {
    let mut seen = [0; 4];
    for (seed, case) in cases() {
        let scene = case.bench.scene::<f64>().expect("a sound scene");
        let [at, to] = case.grips();
        let displacement = at.displacement_to(&to);
        let vertex = case.vertex();
        let (load, surface) = (vertex.pivot.load(&scene, &at), scene.surface(0));
        let rates = SingleVertex::pinned_rates(&load, &displacement);
        let stability = case.sticking_stability();
        if stability.abs() > 0.02 {
            assert_eq!(rates.is_some(), stability > 0.0, "{seed}");
            seen[usize::from(rates.is_some())] += 1;
        }
        if let Some(rates) = rates
            && stability > 0.02
        {
            let turn = (case.stick(STEP) - case.stick(-STEP)) / (2.0 * STEP);
            let close = (rates.turn - turn).abs() < 1e-5 * (1.0 + turn * turn) / stability;
            assert!(close && rates.foot == 0.0, "{seed}: {} {turn}", rates.turn);
        }
        for sign in [1.0, -1.0] {
            let rates = vertex.sliding_rates(&scene, (&load, &surface), &displacement, sign);
            let stability = case.sliding_stability(sign);
            if stability.abs() < 0.02 {
                continue;
            }
            assert_eq!(rates.is_some(), stability > 0.0, "{seed}");
            seen[2 + usize::from(rates.is_some())] += 1;
            let Some(rates) = rates else { continue };
            let [turn, foot] = case.sliding_rates(sign);
            let bound = 1e-5 * (1.0 + turn * turn) * (1.0 + case.bench.friction[1]) / stability;
            assert!(
                (rates.turn - turn).abs() < bound,
                "{seed}: {} {turn}",
                rates.turn
            );
            assert!(
                (rates.foot - foot).abs() < bound,
                "{seed}: {} {foot}",
                rates.foot
            );
            let recedes = vertex.recedes(&scene, (&at, &to), sign);
            if foot.abs() > 1e-3 {
                assert_eq!(recedes, sign * foot < 0.0, "{seed}");
            }
        }
    }
    assert!(
        cfg!(miri) || seen[1..].iter().all(|count| *count > 20),
        "{seen:?}"
    );
}

/// A vertex that has just touched sticks if slightly later its reaction lies within the dynamic cone, otherwise it slides against its
/// friction, provided that this follows the hand.
#[test]
fn touch_sticks_or_slides_as_its_reaction_grows() {
    let mut seen = [0; 3];
    for (seed, case) in cases() {
        let scene = case.bench.scene::<f64>().expect("a sound scene");
        let [at, to] = case.grips();
        let mut vertex = case.vertex();
        vertex.begin(&scene, (&at, &to));
        if case.sticking_stability() < 0.02 {
            continue;
        }
        let [n, t] = case
            .bench
            .reaction(&case.hand(STEP), case.stick(STEP), case.foot)
            .map(|force| force / STEP);
        let within = case.bench.friction[1] * n - t.abs();
        let sign = -t.signum();
        if within.abs() < 1e-3 * (1.0 + n.abs() + t.abs()) || case.sliding_stability(sign) < 0.02 {
            continue;
        }
        let [_, foot] = case.sliding_rates(sign);
        let (which, should) = if within > 0.0 {
            (0, Regime::LOOSE)
        } else if sign * foot > 0.0 {
            (1, Regime::Slide(sign))
        } else {
            (2, Regime::LOOSE)
        };
        if foot.abs() > 1e-3 {
            assert_eq!(vertex.regime, should, "{seed}: {n} {t} {foot}");
            seen[which] += 1;
        }
    }
    assert!(
        cfg!(miri) || seen[..2].iter().all(|count| *count > 100),
        "{seen:?}"
    );
}

/// It leaves its surface if the body that follows the hand alone does.
#[test]
fn vertex_leaves_with_the_free_body() {
    let mut seen = [0; 2];
    for (seed, case) in cases() {
        let scene = case.bench.scene::<f64>().expect("a sound scene");
        let [at, to] = case.grips();
        let leaves = case.vertex().leaves(&scene, (&at, &to));
        let pose_gap = |part: f64| case.bench.free(&case.hand(part), case.theta);
        if case.bench.free_stability(case.theta) < 0.02 {
            continue;
        }
        let gap = (pose_gap(STEP) - pose_gap(-STEP)) / (2.0 * STEP);
        assert!(pose_gap(0.0).abs() < 1e-9, "{seed}");
        if gap.abs() > 1e-4 {
            assert_eq!(leaves, gap > 0.0, "{seed}: {gap}");
            seen[usize::from(leaves)] += 1;
        }
    }
    assert!(
        cfg!(miri) || seen.iter().all(|count| *count > 100),
        "{seen:?}"
    );
}

/// Another contact opens if its gap grows as the vertex slides on.
#[test]
fn contact_opens_as_its_gap_grows() {
    let mut seen = [0; 2];
    for (seed, case) in cases() {
        let scene = case.bench.scene::<f64>().expect("a sound scene");
        let [at, to] = case.grips();
        for sign in [1.0, -1.0] {
            if case.sliding_stability(sign) < 0.02 {
                continue;
            }
            for (vertex, surface) in [(1, 0), (1, 1), (2, 1)] {
                let pair = Pair { vertex, surface };
                let opens = case.vertex().opens(&scene, (&at, &to), (pair, sign));
                let gap = |part: f64| {
                    let (theta, foot) = case.slide(part, sign);
                    let pair = (usize::from(vertex), usize::from(surface));
                    case.bench.gap(theta, foot, pair)
                };
                let rate = (gap(STEP) - gap(-STEP)) / (2.0 * STEP);
                if rate.abs() > 1e-3 {
                    assert_eq!(opens, rate > 0.0, "{seed} {pair:?}: {rate}");
                    seen[usize::from(opens)] += 1;
                }
            }
        }
    }
    assert!(
        cfg!(miri) || seen.iter().all(|count| *count > 100),
        "{seen:?}"
    );
}
