//! Two contacts that slide with the hand, against statics written out.

use super::*;
use crate::contact::Regime;
use crate::fixtures::bench::HandAt;
use crate::fixtures::{Random, sampled};
use crate::verb::Trigger;
use crate::work::Work;
use ladder::{Case, Ladder};

mod ladder;
mod rules;

/// A slide of two contacts, in balance, and the displacement of the hand.
struct Sliding {
    ladder: Ladder,
    case: Case,
    hand: HandAt,
    way: (Vec2<f64>, f64),
    normals: [f64; 2],
    direction: f64,
}

impl Sliding {
    fn random(seed: u64) -> Option<Self> {
        Self::with_memory(seed, None)
    }

    /// One that soon sticks: a slip that began immediately would be nearly as long as the memory length.
    fn nearly_pressed(seed: u64) -> Option<Self> {
        let sliding = Self::random(seed)?;
        let (length, _) = sliding.length(sliding.ladder.theta);
        Self::with_memory(seed, Some(length * sliding.ladder.memory / 0.98))
    }

    fn with_memory(seed: u64, memory: Option<f64>) -> Option<Self> {
        let mut random = Random(seed);
        let mut ladder = Ladder::random(&mut random)?;
        let any = libm::exp2(-6.0 + 4.0 * random.next());
        ladder.memory = memory.unwrap_or(any);
        let most = if seed.is_multiple_of(2) { 3.0 } else { 0.3 };
        let normals = [0.02, 0.02].map(|least| least + most * random.next().abs());
        Self::of(ladder, normals, &mut random)
    }

    fn of(ladder: Ladder, normals: [f64; 2], random: &mut Random) -> Option<Self> {
        let size = libm::exp2(-3.0 + 3.0 * random.next());
        let hand = ladder.holding(normals, ladder.mu_d);
        let case = ladder.case(&hand)?;
        let direction = ladder.direction(&case);
        let mut sliding = Self {
            way: (random.vector() * size, random.next() * size),
            ladder,
            case,
            hand,
            normals,
            direction,
        };
        // Mostly onward, not back.
        if sliding.drive() < 0.0 && random.next() > -0.6 {
            let (way, turn) = sliding.way;
            sliding.way = (-way, -turn);
        }
        Some(sliding)
    }

    fn slides(&self) -> Slides<f64> {
        let (case, (hand, turn)) = (&self.case, self.way);
        let contacts = (&case.state.pivot, case.state.other);
        let trammel = Trammel::in_sense(&case.scene, contacts, &case.grip, self.direction);
        Slides::new(trammel, &Displacement { hand, turn })
    }

    /// The fraction of the path that is done when the body has turned to an angle: (E6) is linear in it.
    fn part(&self, theta: f64) -> f64 {
        let drive = |part: f64| self.ladder.balance(&self.hand.on(self.way, part), theta).1;
        drive(0.0) / (drive(0.0) - drive(1.0))
    }

    /// How strongly the hand drives the motion on.
    fn drive(&self) -> f64 {
        let hand = self.hand.on(self.way, 1.0);
        self.ladder.balance(&hand, self.ladder.theta).1
    }

    fn stability(&self) -> f64 {
        self.ladder.stability(&self.hand, self.ladder.theta)
    }

    /// The longest displacement of a slip that would begin at an angle, per memory length; N_1, N_2 there.
    fn length(&self, theta: f64) -> (f64, [f64; 2]) {
        let hand = self.hand.on(self.way, self.part(theta));
        let (normals, _) = self.ladder.balance(&hand, theta);
        let [a, b] = self.ladder.lengths(normals, &hand, theta);
        (a.max(b) / self.ladder.memory, normals)
    }
}

/// On the path tau is where (E6) holds, and the N_i are those that bear the load, both to the digits.
#[test]
fn slide_is_in_balance_all_along() {
    let mut count = 0;
    for seed in sampled(0..400, 97) {
        let Some(sliding) = Sliding::random(seed) else {
            continue;
        };
        let slides = sliding.slides();
        let ladder = &sliding.ladder;
        let per_load = slides.trammel.per_load;
        for i in 0..=10 {
            let x = 0.02 * f64::from(i);
            let at = slides.at(x);
            let theta = ladder.theta + slides.trammel.sense.curve.at(x).turn;
            let gone = at.gone();
            let (part, tau) = (gone / slides.unit, sliding.part(theta));
            if tau.is_nan() || tau.abs() > 3.0 {
                break;
            }
            assert!(
                (part - tau).abs() < 1e-8 * (1.0 + tau.abs()),
                "{seed} {i}: {part} {tau}"
            );
            let hand = sliding.hand.on(sliding.way, tau);
            let (normals, left) = ladder.balance(&hand, theta);
            assert!(left.abs() < 1e-9, "{seed} {i}: {left}");
            let per = at.drive.value * at.scale.value * per_load;
            for (k, normal) in normals.into_iter().enumerate() {
                let edge = libm::hypot(1.0, ladder.mu_d[k]);
                let found = at.balanced().normals[k].value / (per * edge);
                let off = found - normal;
                assert!(off.abs() < 1e-8 * (1.0 + normal.abs()), "{seed} {i}: {off}");
            }
            count += 1;
        }
    }
    assert!(cfg!(miri) || count > 1000, "{count}");
}

impl Sliding {
    /// By small steps to an angle: tau grows to a fraction of the path, and nothing ends the slide earlier by more than a rounding.
    #[track_caller]
    fn lasts(&self, turn: f64, part: f64, seed: u64) {
        let ladder = &self.ladder;
        let begin = ladder.speeds(ladder.theta);
        let was_loose = self.length(ladder.theta).0 < 1.0;
        let steps = if cfg!(miri) { 4 } else { 16 };
        let mut last = 0.0;
        for i in 1..=steps {
            let theta = ladder.theta + turn * f64::from(i) / f64::from(steps);
            let tau = self.part(theta);
            assert!(tau > last - 1e-8 && tau <= part + 1e-7, "{seed} {i}: {tau}");
            last = tau;
            let (length, normals) = self.length(theta);
            let pressed = normals.into_iter().fold(f64::INFINITY, f64::min);
            assert!(pressed > -1e-8, "{seed} {i}: {pressed}");
            assert!(!was_loose || length < 1.0 + 1e-5, "{seed} {i}: {length}");
            assert!(ladder.least_gap(theta) > -1e-8, "{seed} {i}");
            let mut on = ladder.speeds(theta).into_iter().zip(begin);
            assert!(on.all(|(v, v0)| v * v0.signum() > -1e-7), "{seed} {i}");
        }
        assert!((last - part).abs() < 1e-7, "{seed}: {last} {part}");
    }

    /// The margin that is left of what ended it.
    #[track_caller]
    fn left(&self, ending: &SlideEnding<f64>, turn: f64) -> f64 {
        let ladder = &self.ladder;
        let end = ladder.theta + turn;
        let (length, normals) = self.length(end);
        match *ending {
            SlideEnding::Arrives | SlideEnding::Window => 0.0,
            SlideEnding::Halts => {
                let [v1, v2] = ladder.speeds(end).map(f64::abs);
                v1.min(v2)
            }
            SlideEnding::Folds => {
                let hand = self.hand.on(self.way, self.part(end));
                // A double root: half of the digits.
                ladder.stability(&hand, end) * 1e-4
            }
            SlideEnding::Pressed => (length - 1.0) * 1e-2,
            SlideEnding::Opens { lasts, sliding } => {
                let begin = ladder.speeds(ladder.theta)[lasts];
                assert_eq!(sliding, (begin * ladder.sense).signum());
                normals[1 - lasts]
            }
            SlideEnding::Touches(_) => ladder.least_gap(end),
            SlideEnding::Off { .. } => panic!("planes have no ends"),
        }
    }
}

/// A run passes neither an opening nor a halt, a fold, a touch, or a position where the hand would have to move back; its end has the
/// reported cause.
#[test]
fn run_lasts_to_its_first_ending() {
    let mut seen = [0; 5];
    for seed in sampled(0..1200, 97) {
        let Some(sliding) = Sliding::random(seed) else {
            continue;
        };
        let ladder = &sliding.ladder;
        let slides = sliding.slides();
        let (run, part, ending) = slides.run(&sliding.case.scene, &sliding.case.state.contacts());
        assert!(!run.unsure, "{seed}");
        let goes_on = sliding.drive() > 0.0 && sliding.stability() > 0.0;
        if run.turn == 0.0 && part == 0.0 {
            let is_pressed = sliding.length(ladder.theta).0 > 1.0 - 1e-6;
            assert!(!goes_on || is_pressed, "{seed}: {ending:?}");
            seen[0] += 1;
            continue;
        }
        assert!(
            goes_on && run.turn * ladder.sense > 0.0,
            "{seed} {ending:?}"
        );
        let feet = [ladder.theta, ladder.theta + run.turn].map(|at| ladder.feet(at)[0]);
        let off = feet[1] - feet[0] - run.slide;
        assert!(off.abs() < 1e-9, "{seed}: {off}");
        sliding.lasts(run.turn, part, seed);
        let left = sliding.left(&ending, run.turn);
        assert!(left.abs() < 1e-7, "{seed}: {ending:?} {left}");
        let which = match ending {
            SlideEnding::Arrives => 1,
            SlideEnding::Window => 2,
            SlideEnding::Pressed => 3,
            _ => 4,
        };
        seen[which] += 1;
    }
    assert!(
        cfg!(miri) || seen.iter().all(|count| *count > 2),
        "{seen:?}"
    );
}

/// A whole slide, run after run: to the end of the hand's path or to the first event that ends it.
#[test]
fn slide_of_two_lasts_to_its_first_ending() {
    let mut seen = [0; 7];
    for seed in sampled(0..1200, 97) {
        let Some(sliding) = Sliding::random(seed) else {
            continue;
        };
        let mut state = sliding.case.state.clone();
        state.regime = Regime::Slide(sliding.direction);
        let ladder = &sliding.ladder;
        let to = ladder.grip(&sliding.hand.on(sliding.way, 1.0));
        let (mut at, mut part) = (sliding.case.grip, 0.0);
        let moved = loop {
            let moved = state.advance(&sliding.case.scene, &at, &to);
            part += (1.0 - part) * moved.part;
            at = at.lerp(&to, moved.part);
            // Nothing has ended it so far: towards a fold the runs become short.
            if !moved.unsure && moved.trigger != Trigger::GoesOn {
                break moved;
            }
        };
        let turn = state.pivot.orientation.angle().radians() - ladder.theta;
        let ending = match moved.trigger {
            Trigger::Balanced => SlideEnding::Arrives,
            Trigger::Halts => SlideEnding::Halts,
            Trigger::Fold(_) => SlideEnding::Folds,
            Trigger::Pressed => SlideEnding::Pressed,
            Trigger::Touch(pair) => SlideEnding::Touches(pair),
            Trigger::Keep {
                contacts: [lasts, _],
                sliding: Some(sliding),
            } => SlideEnding::Opens { lasts, sliding },
            other => panic!("{seed}: {other:?}"),
        };
        if part == 0.0 {
            assert!(turn.abs() < 1e-12, "{seed}: {turn}");
            seen[0] += 1;
            continue;
        }
        sliding.lasts(turn, part, seed);
        let left = sliding.left(&ending, turn);
        assert!(left.abs() < 1e-7, "{seed}: {ending:?} {left}");
        let which = match ending {
            SlideEnding::Arrives | SlideEnding::Window => 1,
            SlideEnding::Halts => 2,
            SlideEnding::Folds => 3,
            SlideEnding::Pressed => 4,
            SlideEnding::Opens { .. } => 5,
            SlideEnding::Touches(_) => 6,
            SlideEnding::Off { .. } => panic!("planes have no ends"),
        };
        seen[which] += 1;
    }
    assert!(
        cfg!(miri) || seen.iter().all(|count| *count > 2),
        "{seen:?}"
    );
}

/// A certified frame: nothing ends the slide before the end of the hand's path, and there it is in balance. Short displacements are
/// certified unless an event is near.
#[test]
fn certified_slide_is_all_that_happens() {
    let (mut certified, mut driven) = (0, 0);
    let near = sampled(0..2400, 97).filter_map(|seed| Some((seed, Sliding::nearly_pressed(seed)?)));
    let any = sampled(0..2400, 97).filter_map(|seed| Some((seed, Sliding::random(seed)?)));
    for (seed, mut sliding) in any.chain(near) {
        let part = libm::exp2(-f64::from((seed % 8) as u8));
        sliding.way = (sliding.way.0 * part, sliding.way.1 * part);
        let ladder = &sliding.ladder;
        let mut state = sliding.case.state.clone();
        state.regime = Regime::Slide(sliding.direction);
        let before = state.clone();
        let to = ladder.grip(&sliding.hand.on(sliding.way, 1.0));
        driven += usize::from(sliding.drive() > 0.0 && sliding.stability() > 0.0);
        if !state.follow(
            &sliding.case.scene,
            (&sliding.case.grip, &to),
            &mut Work::within(0),
        ) {
            assert!(state.pivot == before.pivot && state.regime == before.regime);
            continue;
        }
        let turn = state.pivot.orientation.angle().radians() - ladder.theta;
        sliding.lasts(turn, 1.0, seed);
        let end = ladder.theta + turn;
        let (_, left) = ladder.balance(&sliding.hand.on(sliding.way, 1.0), end);
        assert!(left.abs() < 1e-12, "{seed}: {left}");
        let foot = state.pivot.foot - before.pivot.foot;
        let off = ladder.feet(end)[0] - ladder.feet(ladder.theta)[0] - foot;
        assert!(off.abs() < 1e-12, "{seed}: {off}");
        certified += 1;
    }
    assert!(
        cfg!(miri) || certified * 4 > driven && certified > 100,
        "{certified} of {driven}"
    );
}
