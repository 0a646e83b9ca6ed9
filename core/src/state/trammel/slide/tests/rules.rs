//! The behaviour of two contacts that begin to slide, that go on sliding as one of them closes, that end a slip.

use super::*;

/// The consequence of a yield without stiction: none if a contact would pull or the slide move back, a slip over the fold, stiction if a
/// slip would be as long as the memory length, otherwise a slide.
#[test]
fn what_begins_follows_from_statics() {
    let mut seen = [0; 4];
    for seed in sampled(0..1200, 97) {
        let Some(mut sliding) = Sliding::random(seed) else {
            continue;
        };
        if seed % 5 == 0 {
            let [n1, n2] = sliding.normals;
            let pulled = if seed % 2 == 0 { [-n1, n2] } else { [n1, -n2] };
            let Some(with) = Sliding::of(sliding.ladder, pulled, &mut Random(seed)) else {
                continue;
            };
            sliding = with;
        }
        let begins = sliding.slides().begins();
        let presses = sliding.normals.iter().all(|n| *n > 0.0);
        let (drive, stability) = (sliding.drive(), sliding.stability());
        let (length, _) = sliding.length(sliding.ladder.theta);
        if drive.abs() < 1e-6 || stability.abs() < 1e-6 || (length - 1.0).abs() < 1e-6 {
            continue;
        }
        let (which, should) = if !presses || drive < 0.0 {
            (0, None)
        } else if stability < 0.0 {
            (1, Some(SlideEnding::Folds))
        } else if length > 1.0 {
            (2, Some(SlideEnding::Pressed))
        } else {
            (3, Some(SlideEnding::Arrives))
        };
        assert_eq!(begins, should, "{seed}: {length} {drive} {stability}");
        seen[which] += 1;
    }
    assert!(
        cfg!(miri) || seen.iter().all(|count| *count > 2),
        "{seen:?}"
    );
}

/// After a contact has just closed: whether the slide goes on and presses it on, from the balances slightly later.
#[test]
fn rates_are_those_of_the_balances() {
    const STEP: f64 = 1e-5;
    let mut seen = [0; 4];
    for seed in sampled(0..1200, 97) {
        let mut random = Random(seed);
        let Some(ladder) = Ladder::random(&mut random) else {
            continue;
        };
        let normals = [0.02 + 0.3 * random.next().abs(), 0.0];
        let Some(sliding) = Sliding::of(ladder, normals, &mut random) else {
            continue;
        };
        let (ladder, stability) = (&sliding.ladder, sliding.stability());
        if stability.abs() < 1e-3 {
            continue;
        }
        let Some((advances, [_, presses])) = sliding.slides().rates() else {
            assert!(stability < 0.0, "{seed}");
            continue;
        };
        assert!(stability > 0.0, "{seed}");
        // The turn per tau of the hand.
        let turn = sliding.drive() / stability * ladder.sense;
        let normal = |part: f64| {
            let hand = sliding.hand.on(sliding.way, part);
            ladder.balance(&hand, ladder.theta + turn * part).0[1]
        };
        let rate = (normal(STEP) - normal(-STEP)) / (2.0 * STEP);
        if turn.abs() < 1e-6 || rate.abs() < 1e-6 {
            continue;
        }
        assert_eq!(advances > 0.0, turn * ladder.sense > 0.0, "{seed}");
        assert_eq!(presses > 0.0, rate > 0.0, "{seed}: {presses} {rate}");
        seen[usize::from(advances > 0.0) * 2 + usize::from(presses > 0.0)] += 1;
        // Only then do both go on together.
        let mut state = sliding.case.state.clone();
        let to = ladder.grip(&sliding.hand.on(sliding.way, 1.0));
        let sign = (ladder.speeds(ladder.theta)[0] * ladder.sense).signum();
        state.slide_on(
            &sliding.case.scene,
            (&sliding.case.grip, &to),
            (sign, &mut Work::within(0)),
        );
        let should = if advances > 0.0 && presses > 0.0 {
            Regime::Slide(sliding.direction)
        } else {
            Regime::LOOSE
        };
        assert_eq!(state.regime, should, "{seed}");
    }
    assert!(
        cfg!(miri) || seen.iter().all(|count| *count > 2),
        "{seen:?}"
    );
}

/// A slip from the static cones has the predicted length, to first order: with a memory length slightly shorter than that the contacts
/// stick with stiction, with a longer one they slide on.
#[test]
fn slip_is_as_long_as_it_is_said_to_be() {
    let mut count = 0;
    for seed in sampled(0..800, 97) {
        let mut random = Random(seed);
        let Some(mut ladder) = Ladder::random(&mut random) else {
            continue;
        };
        ladder.drop = [5e-5, 5e-5 * random.next().abs()];
        let normals = [0.02, 0.02].map(|least| least + 0.3 * random.next().abs());
        let mu_s = [0, 1].map(|i| ladder.mu_d[i] + ladder.drop[i]);
        // Beyond the edge by a negligible amount.
        let hand = ladder.holding(normals, mu_s.map(|mu| mu * (1.0 + 1e-9)));
        let sliding = ladder.holding(normals, ladder.mu_d);
        if ladder.stability(&sliding, ladder.theta) < 0.05 {
            continue;
        }
        let slip = |memory: f64| {
            ladder
                .clone()
                .with_memory(memory)
                .case(&hand)
                .map(|mut case| {
                    let moved = case.state.slip_to_the_end(&case.scene, &case.grip);
                    (moved, case)
                })
        };
        let Some((moved, case)) = slip(0.02) else {
            continue;
        };
        if moved.trigger != Trigger::Stopped || moved.unbalanced {
            continue;
        }
        let end = case.state.pivot.orientation.angle().radians();
        let ways = [0, 1].map(|i| (ladder.feet(end)[i] - ladder.feet(ladder.theta)[i]).abs());
        let longest = ways[0].max(ways[1]);
        if longest < 1e-5 {
            continue;
        }
        let should = ladder.lengths(normals, &sliding, ladder.theta);
        for i in 0..2 {
            assert!(
                (ways[i] - should[i]).abs() < 0.02 * should[i],
                "{seed}: {ways:?} {should:?}"
            );
        }
        for (times, stiction) in [(0.95, true), (1.05, false)] {
            let (_, case) = slip(times * longest).expect("the same scene");
            let direction = ladder.direction(&case);
            let regime = Regime::after_slip(stiction, direction);
            assert_eq!(case.state.regime, regime, "{seed} {times}");
            let on = Sliding {
                ladder: ladder.clone().with_memory(times * longest),
                case,
                hand: sliding,
                way: (Vec2::ZERO, 1.0),
                normals,
                direction,
            };
            let on = Sliding {
                case: on.ladder.case(&sliding).expect("the same scene"),
                ..on
            };
            let slides = on.slides();
            let at = slides.start;
            let is_pressed = slides.is_pressed(&at, &at.begin());
            assert_eq!(is_pressed, stiction, "{seed} {times}");
        }
        count += 1;
    }
    assert!(cfg!(miri) || count > 100, "{count}");
}
