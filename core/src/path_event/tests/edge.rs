//! An edge sticks and slides according to N = N_1 + N_2: everything is linear.

use super::*;
use crate::fixtures;
use crate::geometry::Angle;
use crate::scene::{Description, Scene, SurfaceDescription};

const MU_S: f64 = 0.5;
const MU_D: f64 = 0.3;
const MEMORY: f64 = 0.04;
/// N*
const THRESHOLD: f64 = MEMORY / (MU_S - MU_D);

/// A rod that lies on a floor, held in the middle.
fn rod() -> Scene<f64, 2, 1> {
    let floor = SurfaceDescription {
        normal: [0.0, 1.0],
        offset: 0.0,
        friction_static: MU_S,
        friction_dynamic: MU_D,
        memory: Some(MEMORY),
    };
    let scene = Scene::new(&Description {
        vertices: &[[-0.5, 0.0], [0.5, 0.0]],
        start: [0.0; 3],
        weight: 0.0,
        holding_point: Some([0.0, 0.0]),
        reach: 0.0,
        stiffness_translation: 1.0,
        stiffness_rotation: 1.0,
        surfaces: &[floor],
        obstacles: &[],
    });
    scene.expect("a sound scene")
}

/// Vertex 0 at a foot.
fn edge(foot: f64, regime: Regime<f64>) -> ContactState<f64> {
    let mut state = ContactState::Edge(Edge::new(
        crate::pivot::Pivot {
            foot,
            ..fixtures::pivot(0.0)
        },
        Pair {
            vertex: 1,
            surface: 0,
        },
    ));
    state.set_regime(regime);
    state
}

/// Pulls along by x and presses by y if the middle of the rod is at 0.
fn hand(x: f64, y: f64) -> Grip<f64> {
    Grip {
        holding_point: Vec2::ZERO,
        hand: Vec2::new(x, -y),
        angle: Angle::default(),
    }
}

fn foot(state: &ContactState<f64>) -> f64 {
    state.anchor().expect("an edge").foot
}

/// A slip leads to a lag of mu_d N; it sticks there if N >= N*, including equality, and otherwise slides on.
#[test]
fn slip_of_an_edge_ends_as_it_is_pressed() {
    let scene = rod();
    for sign in [1.0, -1.0] {
        for (normal, sticks) in [
            (THRESHOLD * (1.0 - 1e-12), false),
            (THRESHOLD, true),
            (THRESHOLD * (1.0 + 1e-12), true),
            (0.5 * THRESHOLD, false),
            (4.0 * THRESHOLD, true),
        ] {
            let mut state = edge(-0.5, STICTION);
            let lag = MU_S * normal;
            let (mut at, to) = (hand(sign * lag, normal), hand(sign, normal));
            let mut log = Log::default();
            let trigger = Trigger::Slide(sign);
            happens(&scene, (&mut at, &to), &mut state, trigger, &mut log);
            let should = -0.5 + sign * (MU_S - MU_D) * normal;
            assert!((foot(&state) - should).abs() < 1e-12);
            let regime = Regime::after_slip(sticks, sign);
            assert_eq!((state.regime(), log.slips), (regime, 1), "{normal}");
        }
    }
}

/// Without stiction it breaks away at mu_d N and lags by that until N rises to N*; there it sticks, with stiction.
#[test]
fn edge_slides_until_it_is_pressed() {
    let scene = rod();
    for sign in [1.0, -1.0] {
        let light = 0.5 * THRESHOLD;
        let mut state = edge(-0.5, Regime::LOOSE);
        let from = hand(0.0, light);
        let to = hand(sign, light);
        let moved = state.advance(&scene, &from, &to);
        assert_eq!(moved.trigger, Trigger::Slide(sign));
        assert!((moved.part - MU_D * light).abs() < 1e-12, "{moved:?}");
        let mut at = from.lerp(&to, moved.part);
        let mut log = Log::default();
        happens(&scene, (&mut at, &to), &mut state, moved.trigger, &mut log);
        assert_eq!((state.regime(), foot(&state)), (Regime::Slide(sign), -0.5));
        assert!(log.slips == 0 && log.events.iter().eq(&[Event::Slide]));
        // On with the hand, which presses harder and harder.
        let to = hand(sign, 2.0 * THRESHOLD);
        let moved = state.advance(&scene, &at, &to);
        assert_eq!(moved.trigger, Trigger::Pressed);
        let mut there = at.lerp(&to, moved.part);
        assert!((-there.hand.y - THRESHOLD).abs() < 1e-12);
        let lag = there.hand.x - (foot(&state) + 0.5);
        assert!((lag - sign * MU_D * THRESHOLD).abs() < 1e-12, "{lag}");
        let (place, mut log) = (foot(&state), Log::default());
        happens(
            &scene,
            (&mut there, &to),
            &mut state,
            moved.trigger,
            &mut log,
        );
        assert_eq!((state.regime(), foot(&state)), (STICTION, place));
        assert!(log.events.iter().eq(&[Event::Stop]));
    }
}

/// A certified frame of a slide equals that of the search: back and forth, below N* and beyond.
#[test]
fn certified_edge_slides_as_the_searched_one() {
    let scene = rod();
    let mut seen = [0; 3];
    for seed in sampled(0..400, 29) {
        let mut random = Random(seed);
        let normal = THRESHOLD * (0.1 + 0.85 * random.next().abs());
        let sign = random.next().signum();
        let (along, press) = (0.1 * random.next(), 0.4 * THRESHOLD * random.next());
        let from = hand(sign * MU_D * normal, normal);
        let to = hand(from.hand.x + along, normal + press);
        let begin = edge(-0.5, Regime::Slide(sign));
        let (mut followed, mut searched) = (begin.clone(), begin.clone());
        let follows = followed.follow(&scene, (&from, &to), &mut Work::within(0));
        let moved = searched.advance(&scene, &from, &to);
        // The lag follows mu_d N.
        let advance = sign * along - MU_D * press;
        if advance < 0.0 {
            assert!(!follows && followed == begin);
            assert_eq!((moved.trigger, moved.part), (Trigger::Halts, 0.0));
            assert_eq!(foot(&searched), -0.5);
            seen[0] += 1;
        } else if normal + press > THRESHOLD {
            assert!(!follows && followed == begin);
            assert_eq!(moved.trigger, Trigger::Pressed);
            let part = (THRESHOLD - normal) / press;
            assert!((moved.part - part).abs() < 1e-9);
            seen[1] += 1;
        } else {
            let lifts = normal + press <= 0.0;
            assert_eq!(follows, !lifts, "{seed}");
            if follows {
                assert_eq!(moved.trigger, Trigger::Balanced);
                let should = -0.5 + sign * advance;
                for state in [followed, searched] {
                    assert!((foot(&state) - should).abs() < 1e-12, "{seed}");
                    assert_eq!(state.regime(), Regime::Slide(sign));
                }
                seen[2] += 1;
            }
        }
    }
    assert!(
        cfg!(miri) || seen.iter().all(|count| *count > 10),
        "{seen:?}"
    );
}
