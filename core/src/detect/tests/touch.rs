//! The first touch on a motion, against small steps.

use super::*;

/// A shift and a turn together, hand frozen: the first of all vertices to reach a surface, and where.
#[test]
fn first_touch_is_the_first() {
    const STEPS: i32 = if cfg!(miri) { 100 } else { 4000 };
    let mut touched = 0;
    for (planes, pose) in poses() {
        let scene = scene::<f64>(|x| x, planes);
        let at = placed::<f64>(|x| x, pose);
        let all = || (0..5).flat_map(|v| (0..3).map(move |s| (v, s)));
        if all().any(|pair| gap(&scene, &at, pair) < 1e-3) {
            continue;
        }
        for (shift, turn) in [
            (Vec2::new(0.4, -1.5), 0.7),
            (Vec2::new(-2.0, 0.5), -1.2),
            (Vec2::new(0.0, 0.0), 2.0),
            (Vec2::new(0.3, -0.9), 0.0),
        ] {
            let (curve, mut extent) = BalanceCurve::<f64, Pinned>::turning(turn);
            let moving = Moving {
                curve: &curve,
                path: &PointPath::straight(shift),
                lasting: &[],
                left: &[],
            };
            let found = at.first_touch(&scene, &mut extent, &moving);
            let then = |part: f64| Placed {
                point: at.point + shift * part,
                orientation: at.orientation.plus(turn * part),
                ..at
            };
            let first = (0..=STEPS)
                .map(|i| f64::from(i) / f64::from(STEPS))
                .find_map(|part| {
                    let mut closed = all().filter(|&pair| gap(&scene, &then(part), pair) <= 0.0);
                    closed.next().map(|pair| (part, pair))
                });
            assert_eq!(
                found.is_some(),
                first.is_some(),
                "{pose:?} {shift:?} {turn}"
            );
            let (Some(pair), Some((part, _))) = (found, first) else {
                assert_eq!(extent.end.part(), 1.0);
                continue;
            };
            let end = extent.end.part();
            assert!(
                end <= part + 1e-9 && end >= part - 1.01 / f64::from(STEPS),
                "{end} {part}"
            );
            let off = gap(&scene, &then(end), (pair.vertex, pair.surface));
            assert!(off.abs() < 1e-12 * (1.0 + shift.length() + 1e3), "{off}");
            touched += 1;
        }
    }
    assert!(cfg!(miri) || touched > 20, "{touched}");
}

/// A body that turns many times on its path passes no surface, neither in fixed point nor in double precision.
#[test]
fn first_touch_on_many_turns_is_the_first() {
    const STEPS: i32 = if cfg!(miri) { 200 } else { 20_000 };
    let number = |x: f64| Fixed::from_si(x as f32, 1.0);
    let vec = |v: Vec2<f64>| Vec2::new(number(v.x), number(v.y));
    let mut touched = 0;
    for (planes, pose) in poses().filter(|(planes, _)| planes[0].1 > -10.0) {
        let (exact, scene) = (
            scene::<f64>(|x| x, planes),
            scene::<Fixed>(|x| x as f32, planes),
        );
        let all = || (0..5).flat_map(|v| (0..3).map(move |s| (v, s)));
        let begin = placed::<f64>(|x| x, pose);
        if all().any(|pair| gap(&exact, &begin, pair) < 1e-3) {
            continue;
        }
        let at = placed::<Fixed>(|x| x as f32, pose);
        for (shift, turn) in [
            (Vec2::new(0.4, -1.5), 11.0),
            (Vec2::new(-2.0, 0.5), -34.0),
            (Vec2::new(0.0, 0.0), 60.0),
            (Vec2::new(0.03, -0.09), -120.0),
        ] {
            let (curve, mut extent) = BalanceCurve::<Fixed, Pinned>::turning(number(turn));
            let moving = Moving {
                curve: &curve,
                path: &PointPath::straight(vec(shift)),
                lasting: &[],
                left: &[],
            };
            let found = at.first_touch(&scene, &mut extent, &moving);
            let end = f64::from(extent.end.part().to_si(1.0));
            assert!(found.is_some() || end == 1.0, "{end}");
            for i in 0..=STEPS {
                let part = end * f64::from(i) / f64::from(STEPS);
                let then = Placed {
                    point: begin.point + shift * part,
                    orientation: begin.orientation.plus(turn * part),
                    ..begin
                };
                for pair in all() {
                    let gap = gap(&exact, &then, pair);
                    assert!(
                        gap > -1e-4,
                        "{pose:?} {shift:?} {turn} {part} {pair:?} {gap}"
                    );
                }
            }
            touched += usize::from(found.is_some());
        }
    }
    assert!(cfg!(miri) || touched > 20, "{touched}");
}
