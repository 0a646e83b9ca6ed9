//! The memory of friction of one vertex and of an edge at the events on the hand's path, around N* = D_c / (mu_s - mu_d).

use super::*;
use crate::fixtures::bench::{Bench, HandAt, Plain};
use crate::fixtures::{Random, sampled};
use crate::geometry::Vec2;
use crate::real::Fixed;
use crate::state::{Edge, SingleVertex};

mod edge;

/// The consequence of a trigger, up to where the body rests.
fn happens<R: Real>(
    scene: &impl World<R>,
    (at, to): (&mut Grip<R>, &Grip<R>),
    state: &mut ContactState<R>,
    trigger: Trigger<R>,
    log: &mut Log<R>,
) {
    let mut settling = super::happens(scene, (at, to), state, trigger, (&mut Work::within(0), log));
    while !settling.go_on(scene, at, state, log).1 {}
}

const STICTION: Regime<f64> = Regime::Stick { stiction: true };

/// A vertex that bears (N, T), as fractions of N* and of mu_d N or mu_s N, and the destination of the hand.
struct Case {
    bench: Bench,
    hand: HandAt,
    way: (Vec2<f64>, f64),
    theta: f64,
    foot: f64,
    sign: f64,
}

impl Case {
    /// N as a fraction of N*, T as a fraction of mu N.
    fn random(seed: u64, part: f64, friction: impl Fn(&Bench) -> f64) -> Option<Self> {
        let mut random = Random(seed);
        let mu = 0.2 + 0.5 * random.next().abs();
        let drop = 0.1 + 0.3 * random.next().abs();
        let memory = drop * (0.1 + 0.2 * random.next().abs());
        let bench = Bench::random(&mut random, [mu + drop, mu, memory]);
        let theta = bench.planes[0].0 + 1.25 + random.next();
        let (foot, sign) = (0.3 * random.next(), random.next().signum());
        let normal = part * memory / drop;
        let hand = bench.holding(theta, foot, [normal, -sign * friction(&bench) * normal]);
        let case = Self {
            hand,
            way: (random.vector() * 0.2, 0.2 * random.next()),
            theta,
            foot,
            sign,
            bench,
        };
        let is_stable = case.bench.sliding_stability(&hand, theta, sign) > 0.1
            && case.bench.sticking_stability(&hand, theta, foot) > 0.1;
        (is_stable && case.bench.least_gap(theta, foot) > 0.01).then_some(case)
    }

    fn threshold(&self) -> f64 {
        let [mu_s, mu_d, memory] = self.bench.friction;
        memory / (mu_s - mu_d)
    }

    fn grips<R: Plain>(&self) -> [Grip<R>; 2] {
        [0.0, 1.0].map(|part| self.bench.grip(&self.hand.on(self.way, part)))
    }

    fn state<R: Plain>(&self, regime: Regime<R>) -> ContactState<R> {
        let vertex = SingleVertex::new(self.bench.pivot(self.theta, self.foot));
        let mut state = ContactState::SingleVertex(vertex);
        state.set_regime(regime);
        state
    }

    /// By small steps, hand frozen and the moment balanced: it is driven all the way to a point, and nothing blocks it.
    fn slips_to(&self, theta: f64, foot: f64) -> bool {
        let mut near = self.theta;
        let mut steps = (1..=20).map(|i| self.foot + (foot - self.foot) * f64::from(i) / 20.0);
        let is_driven = steps.all(|at| {
            let last = near;
            near = self.bench.sticks(&self.hand, last, at);
            let [n, t] = self.bench.reaction(&self.hand, near, at);
            let excess = -self.sign * t - self.bench.friction[1] * n;
            let stable = self.bench.sticking_stability(&self.hand, near, at) > 0.05;
            stable && excess > -1e-9 && self.bench.least_gap(near, at) > 0.01
        });
        let is_far = self.sign * (foot - self.foot) > 1e-3;
        is_driven && is_far && (near - theta).abs() < 1e-9
    }

    /// The foot moves on with the hand as it begins to slide.
    fn is_driven(&self) -> bool {
        let hand = self.hand.on(self.way, 1e-4);
        let (_, foot) = self.bench.slides(&hand, self.theta, self.sign);
        self.sign * (foot - self.foot) > 1e-6
    }
}

/// Without stiction the vertex begins to slide, without a jump; with it, it slips to mu_d N, where it sticks if N >= N*, and otherwise
/// slides on.
fn yields_with_and_without_stiction<R: Plain>(digits: f64) -> [usize; 3] {
    let mut seen = [0; 3];
    for seed in sampled(0..400, 97) {
        let part = 0.5 + 1.5 * Random(seed).next().abs();
        for stiction in [false, true] {
            let mu = |bench: &Bench| bench.friction[usize::from(!stiction)];
            // A contact that presses harder has stiction.
            let part = if stiction { part } else { part.min(0.9) };
            let Some(case) = Case::random(seed, part, mu) else {
                continue;
            };
            if !case.is_driven() {
                continue;
            }
            let scene = case.bench.scene::<R>().expect("a sound scene");
            let mut state = case.state::<R>(Regime::Stick { stiction });
            let begin = state.clone();
            let [mut at, to] = case.grips::<R>();
            let mut log = Log::default();
            let sign = R::of(case.sign);
            let trigger = Trigger::Slide(sign);
            happens(&scene, (&mut at, &to), &mut state, trigger, &mut log);
            if !stiction {
                assert_eq!(state.regime(), Regime::Slide(sign), "{seed}");
                assert_eq!(state.anchor(), begin.anchor(), "{seed}");
                assert!(log.slips == 0 && log.events.iter().eq(&[Event::Slide]));
                seen[0] += 1;
                continue;
            }
            let (theta, foot) = case.bench.slides(&case.hand, case.theta, case.sign);
            let [normal, _] = case.bench.reaction(&case.hand, theta, foot);
            let left = normal / case.threshold() - 1.0;
            let Ok(pivot) = state.anchor() else { continue };
            if left.abs() < 1e-3 || normal < 0.01 || !case.slips_to(theta, foot) {
                continue;
            }
            assert_eq!(log.slips, 1, "{seed}");
            let off = (pivot.foot.plain() - foot).abs();
            assert!(off < digits, "{seed}: {off}");
            let regime = Regime::after_slip(left > 0.0, sign);
            assert_eq!(state.regime(), regime, "{seed}: {left}");
            let slides = log.events.contains(&Event::Slide);
            assert_eq!(slides, left < 0.0, "{seed}");
            seen[1 + usize::from(left > 0.0)] += 1;
        }
    }
    seen
}

#[test]
fn yields_with_and_without_stiction_in_every_number_type() {
    for seen in [
        yields_with_and_without_stiction::<f64>(1e-9),
        yields_with_and_without_stiction::<f32>(1e-4),
        yields_with_and_without_stiction::<Fixed>(1e-4),
    ] {
        let is_seen = seen.iter().all(|count| *count > 10);
        assert!(cfg!(miri) || is_seen, "{seen:?}");
    }
}

/// At the edge of its cone, with a hand that moves back, it neither slides nor slips.
#[test]
fn hand_that_goes_back_begins_no_slide() {
    const STEP: f64 = 1e-4;
    let mut count = 0;
    for seed in sampled(0..400, 97) {
        let Some(case) = Case::random(seed, 0.5, |bench| bench.friction[1]) else {
            continue;
        };
        let scene = case.bench.scene::<f64>().expect("a sound scene");
        let hand = case.hand.on(case.way, STEP);
        let (_, foot) = case.bench.slides(&hand, case.theta, case.sign);
        let theta = case.bench.sticks(&hand, case.theta, case.foot);
        let [n, t] = case.bench.reaction(&hand, theta, case.foot);
        let within = case.bench.friction[1] * n + case.sign * t;
        if case.sign * (foot - case.foot) > -0.01 * STEP || within < 0.01 * STEP {
            continue;
        }
        let mut state = case.state::<f64>(Regime::LOOSE);
        let [mut at, to] = case.grips::<f64>();
        let mut log = Log::default();
        let trigger = Trigger::Slide(case.sign);
        happens(&scene, (&mut at, &to), &mut state, trigger, &mut log);
        assert_eq!((state.regime(), log.slips), (Regime::LOOSE, 0), "{seed}");
        assert!(log.events.is_empty(), "{seed}: {:?}", log.events);
        count += 1;
    }
    assert!(cfg!(miri) || count > 20, "{count}");
}

/// A contact that sticks loosely, or slides, gains stiction where N has risen to N*, neither earlier nor later; the stick continues
/// unchanged.
#[test]
fn stiction_is_gained_at_the_threshold() {
    let mut seen = [0; 2];
    for seed in sampled(0..2000, 97) {
        let slides = seed % 2 == 0;
        let part = |bench: &Bench| if slides { bench.friction[1] } else { 0.0 };
        let Some(case) = Case::random(seed, 0.95, part) else {
            continue;
        };
        let scene = case.bench.scene::<f64>().expect("a sound scene");
        let [from, to] = case.grips::<f64>();
        let regime = if slides {
            Regime::Slide(case.sign)
        } else {
            Regime::LOOSE
        };
        let mut state = case.state(regime);
        let moved = state.advance(&scene, &from, &to);
        if moved.trigger != Trigger::Pressed {
            continue;
        }
        let mut at = from.lerp(&to, moved.part);
        let hand = case.hand.on(case.way, moved.part);
        let Ok(pivot) = state.anchor().copied() else {
            panic!("{seed}: a vertex");
        };
        let theta = pivot.orientation.angle().radians();
        let [normal, _] = case.bench.reaction(&hand, theta, pivot.foot);
        assert!((normal - case.threshold()).abs() < 1e-9, "{seed}: {normal}");
        let mut log = Log::default();
        happens(&scene, (&mut at, &to), &mut state, moved.trigger, &mut log);
        assert_eq!((state.regime(), state.anchor()), (STICTION, Ok(&pivot)));
        let stops = log.events.contains(&Event::Stop);
        assert!(stops == slides && log.slips == 0, "{seed}");
        seen[usize::from(slides)] += 1;
    }
    assert!(
        cfg!(miri) || seen.iter().all(|count| *count > 20),
        "{seen:?}"
    );
}

/// A certified frame of a stick that ends at N >= N* gains stiction, one that ends below does not; N that falls through N* changes
/// nothing.
#[test]
fn certified_stick_gains_stiction_and_keeps_it() {
    let mut seen = [0; 4];
    for seed in sampled(0..3000, 97) {
        let part = 1.0 + 0.02 * Random(seed).next();
        let Some(mut case) = Case::random(seed, part, |_| 0.0) else {
            continue;
        };
        case.way = (case.way.0 * 0.1, case.way.1 * 0.1);
        let scene = case.bench.scene::<f64>().expect("a sound scene");
        let [from, to] = case.grips::<f64>();
        let hand = case.hand.on(case.way, 1.0);
        let theta = case.bench.sticks(&hand, case.theta, case.foot);
        let [normal, _] = case.bench.reaction(&hand, theta, case.foot);
        let is_pressed = normal >= case.threshold();
        for stiction in [true, false] {
            if !stiction && part >= 1.0 {
                continue;
            }
            let mut state = case.state(Regime::Stick { stiction });
            if !state.follow(&scene, (&from, &to), &mut Work::within(0)) {
                continue;
            }
            let regime = Regime::Stick {
                stiction: stiction || is_pressed,
            };
            assert_eq!(state.regime(), regime, "{seed}: {normal}");
            seen[usize::from(stiction) * 2 + usize::from(is_pressed)] += 1;
        }
    }
    assert!(
        cfg!(miri) || seen.iter().all(|count| *count > 20),
        "{seen:?}"
    );
}

/// At N* itself, and above it, a contact that rests has stiction; just below it, it keeps its state. Without a drop of the friction there
/// is no stiction, however hard it is pressed.
#[test]
fn stiction_of_what_rests_is_renewed_at_the_threshold() {
    for (part, gains) in [
        (1.0 - 1e-9, false),
        (1.0 + 1e-9, true),
        (5.0, true),
        (0.1, false),
    ] {
        for seed in sampled(0..100, 29) {
            let Some(case) = Case::random(seed, part, |_| 0.0) else {
                continue;
            };
            let [at, _] = case.grips::<f64>();
            let scene = case.bench.scene::<f64>().expect("a sound scene");
            let even = Bench {
                friction: [0.4, 0.4, 1e-3],
                ..case.bench.clone()
            };
            let even = even.scene::<f64>().expect("a sound scene");
            for stiction in [true, false] {
                let mut state = case.state(Regime::Stick { stiction });
                state.renew(&scene, &at);
                let regime = Regime::Stick {
                    stiction: stiction || gains,
                };
                assert_eq!(state.regime(), regime, "{seed} {part}");
            }
            let mut state = case.state::<f64>(Regime::LOOSE);
            state.renew(&even, &at);
            assert_eq!(state.regime(), Regime::LOOSE, "{seed} {part}");
        }
    }
}

/// A contact that comes to a halt sticks loosely, where it is.
#[test]
fn halt_leaves_no_stiction() {
    let mut count = 0;
    for seed in sampled(0..200, 29) {
        let Some(case) = Case::random(seed, 0.5, |bench| bench.friction[1]) else {
            continue;
        };
        let scene = case.bench.scene::<f64>().expect("a sound scene");
        let [mut at, to] = case.grips::<f64>();
        let mut state = case.state(Regime::Slide(case.sign));
        let before = state.clone();
        let mut log = Log::default();
        happens(&scene, (&mut at, &to), &mut state, Trigger::Halts, &mut log);
        assert_eq!(state.regime(), Regime::LOOSE);
        assert_eq!(state.anchor(), before.anchor());
        assert!(log.slips == 0 && log.events.iter().eq(&[Event::Stop]));
        count += 1;
    }
    assert!(cfg!(miri) || count > 20, "{count}");
}
