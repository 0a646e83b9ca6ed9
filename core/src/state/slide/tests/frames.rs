//! Frames that are certified without a search.

use super::*;
use crate::work::Work;

/// A certified frame ends where the search ends, and nothing on its path ends a slide; a frame that is not certified has not moved.
fn certified_slide_is_the_searched_one<R: Plain>(digits: f64) {
    let mut seen = [0; 2];
    for seed in sampled(0..1000, 97) {
        let Some(case) = case(seed) else { continue };
        let scene = case.bench.scene::<R>().expect("a sound scene");
        let begin = case.state::<R>();
        let sign = R::of(case.sign);
        for part in [1.0, 0.125, 1.0 / 64.0] {
            let [from, to] = case.grips(part);
            let mut state = begin.clone();
            let follows = state.follow_sliding(&scene, (&from, &to), (sign, &mut Work::none()));
            seen[usize::from(follows)] += 1;
            if !follows {
                assert_eq!(state, begin, "{seed}");
                continue;
            }
            let at = case.lasts(part, digits).expect("a stable balance");
            let near = off(&state, &at) * at.stability.min(1.0);
            assert!(near < digits, "{seed}: {near}");
            let mut searched = begin.clone();
            let moved = searched.advance_sliding(&scene, (&from, &to), sign);
            // A foot that almost rests may halt.
            let rests = (at.foot - case.foot).abs() < digits;
            let halts = moved.trigger == Trigger::Halts && rests;
            let balanced = moved.trigger == Trigger::Balanced;
            assert!(balanced || halts, "{seed}: {moved:?}");
            let near = off(&searched, &at) * at.stability.min(1.0);
            assert!(near < digits, "{seed}: {near}");
            // (N, T) on the edge of the cone.
            let load = state.pivot.load(&scene, &to);
            let [n, t] = state.reactions(&scene, &load)[0].map(Plain::plain);
            let edge = t + case.sign * case.bench.friction[1] * n;
            assert!(n > 0.0 && edge.abs() < digits * (1.0 + n), "{seed} {n} {t}");
            // No vertex is closer than the stored room.
            assert!(at.gap > state.room.plain() - digits, "{seed} {at:?}");
        }
    }
    assert!(
        cfg!(miri) || seen.iter().all(|count| *count > 200),
        "{seen:?}"
    );
}

#[test]
fn certified_slide_is_the_searched_one_in_every_number_type() {
    certified_slide_is_the_searched_one::<f64>(1e-9);
    certified_slide_is_the_searched_one::<f32>(1e-4);
    certified_slide_is_the_searched_one::<Fixed>(1e-4);
}

/// Frame by frame on one path: the remaining room between two evaluations is never more than the actual room, and the end does not depend
/// on how the path was divided.
#[test]
fn slide_does_not_depend_on_the_frames() {
    const FRAMES: i32 = 32;
    let mut count = 0;
    for seed in sampled(0..1000, 97) {
        let Some(case) = case(seed) else { continue };
        let scene = case.bench.scene::<f64>().expect("a sound scene");
        let mut whole = case.state::<f64>();
        let [from, to] = case.grips(1.0);
        let moved = whole.advance_sliding(&scene, (&from, &to), case.sign);
        if moved.trigger != Trigger::Balanced {
            continue;
        }
        let mut state = case.state::<f64>();
        let grip = |i: i32| {
            case.bench
                .grip(&case.hand(f64::from(i) / f64::from(FRAMES)))
        };
        for i in 0..FRAMES {
            let (before, after) = (grip(i), grip(i + 1));
            let path = (&before, &after);
            if !state.follow_sliding(&scene, path, (case.sign, &mut Work::none())) {
                let moved = state.advance_sliding(&scene, path, case.sign);
                assert_eq!(moved.trigger, Trigger::Balanced, "{seed} {i}");
            }
            let theta = state.pivot.orientation.angle().radians();
            let gap = case.bench.least_gap(theta, state.pivot.foot);
            assert!(gap > state.room - 1e-12, "{seed} {i}");
        }
        let at = case.at(1.0, whole.pivot.orientation.angle().radians());
        assert!(off(&state, &at) < 1e-9 && off(&whole, &at) < 1e-9, "{seed}");
        count += 1;
    }
    assert!(cfg!(miri) || count > 50, "{count}");
}
