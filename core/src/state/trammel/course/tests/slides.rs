//! Slides of two contacts with the hand: in balance wherever they end, in every number type, and the same in one call or in many.

use super::*;
use crate::contact::Regime;

/// After a slip has ended in balance the contacts slide on with the hand by a displacement, in a number of calls.
fn slide<R: Digits>(
    case: &Case<R>,
    state: &TwoVertex<R>,
    hand: [Vec2<R>; 2],
    goes: usize,
) -> (TwoVertex<R>, Grip<R>, Trigger<R>) {
    let mut state = state.clone();
    let [from, to] = hand.map(|hand| Grip { hand, ..case.grip });
    let mut at = from;
    for go in 1..=goes {
        let target = if go == goes {
            to
        } else {
            from.lerp(&to, R::number(go as f64 / goes as f64))
        };
        for _ in 0..1000 {
            let moved = state.advance(&case.scene, &at, &target);
            at = at.lerp(&target, moved.part);
            match moved.trigger {
                Trigger::GoesOn => {}
                Trigger::Balanced => break,
                trigger => return (state, at, trigger),
            }
        }
        at = target;
    }
    (state, at, Trigger::Balanced)
}

/// The case of a slide, its state and the two positions of the hand.
pub(super) type Begun<R> = (Case<R>, TwoVertex<R>, [Vec2<R>; 2]);

/// One slide for each of many slips that end in balance.
pub(super) fn begun<R: Digits>((seed, way): (u64, f64), corners: [bool; 2]) -> Option<Begun<R>> {
    let case = case::<R>(seed, corners);
    let mut state = case.state.clone();
    let contacts = (&case.state.pivot, case.state.other);
    let trammel = Trammel::driven(&case.scene, contacts, &case.grip, Demand::Pressed)?;
    let sense = trammel.direction();
    let moved = state.slip_to_the_end(&case.scene, &case.grip);
    if moved.trigger != Trigger::Stopped || moved.unbalanced {
        return None;
    }
    state.regime = Regime::Slide(sense);
    let mut random = Random(seed + 17);
    let mut by = || R::number(way * random.next() * 0.05);
    let by = Vec2::new(by(), by());
    let hand = case.grip.hand;
    Some((case, state, [hand, hand + by]))
}

/// The residual of the balance of a slide at a grip, in units of the load; asserts that it presses.
fn off_balance<R: Real>(case: &Case<R>, state: &TwoVertex<R>, grip: &Grip<R>, sense: R) -> f64
where
    R::Si: Into<f64>,
{
    let contacts = (&state.pivot, state.other);
    let trammel = Trammel::in_sense(&case.scene, contacts, grip, sense);
    let load = state.pivot.load(&case.scene, grip);
    let [[n1, f1], [n2, f2]] = trammel.reactions();
    let rotation = state.pivot.orientation.rotation();
    let [first, second] =
        [state.pivot.contact, state.other].map(|pair| case.scene.face(pair, rotation));
    let [r1, r2] = [(first, n1, f1), (second, n2, f2)]
        .map(|(surface, n, f)| surface.normal * n + surface.tangent * f);
    let arm = state
        .pivot
        .placed(&case.scene)
        .arm_to(&case.scene, state.other);
    let force = load.force + r1 + r2;
    let moment = load.moment() + arm.cross(r2);
    let size = R::ONE + n1.abs() + n2.abs() + load.force.length_bound();
    let left = (force.length() + moment.abs()) / size;
    left.to_si(R::Si::ONE).into()
}

/// Wherever a slide ends on its own, both reactions, on the edges of their dynamic cones, balance the load.
#[track_caller]
fn balances<R: Digits>(tolerance: f64)
where
    R::Si: Into<f64>,
{
    let mut counts = [[0; 2]; 4];
    for (corners, count) in KINDS.into_iter().zip(&mut counts) {
        let ways = |seed| [(seed, 1.0), (seed, -1.0)];
        for begin in sampled((0..4000).flat_map(ways), 97) {
            let seed = begin.0;
            let Some((case, state, hand)) = begun::<R>(begin, corners) else {
                continue;
            };
            let sense = state.regime.slide().expect("a slide");
            let (end, at, trigger) = slide(&case, &state, hand, 1);
            let arrives = trigger == Trigger::Balanced;
            count[usize::from(arrives)] += 1;
            if arrives && end.pivot != state.pivot {
                let left = off_balance(&case, &end, &at, sense);
                assert!(left < tolerance, "{seed} {corners:?} {left:e}");
            }
        }
    }
    assert!(
        cfg!(miri) || counts.iter().all(|[_, arrive]| *arrive > 20),
        "{counts:?}"
    );
}

#[test]
fn slides_are_in_balance_to_rounding_in_double() {
    balances::<f64>(1e-13);
}

#[test]
fn slides_are_in_balance_to_rounding_in_single() {
    balances::<f32>(4e-5);
}

#[test]
fn slides_are_in_balance_to_rounding_in_fixed_point() {
    balances::<Fixed>(4e-5);
}

/// Path evolution does not depend on the frames: a slide in one call ends as one in fifty.
#[test]
fn slide_in_one_go_ends_as_in_fifty() {
    let mut counts = [0; 4];
    for (corners, count) in KINDS.into_iter().zip(&mut counts) {
        let ways = |seed| [(seed, 1.0), (seed, -1.0)];
        for begin in sampled((0..4000).flat_map(ways), 97) {
            let seed = begin.0;
            let Some((case, state, hand)) = begun::<f64>(begin, corners) else {
                continue;
            };
            let [one, many] = [1, 50].map(|goes| slide(&case, &state, hand, goes));
            if one.2 != Trigger::Balanced || many.2 != Trigger::Balanced {
                continue;
            }
            let near = one.0.pivot.placed(&case.scene);
            let many = many.0.pivot.placed(&case.scene);
            assert!(near.is_near(&many, 1e-11), "{seed} {corners:?}");
            *count += 1;
        }
    }
    assert!(
        cfg!(miri) || counts.iter().all(|&count| count > 10),
        "{counts:?}"
    );
}
