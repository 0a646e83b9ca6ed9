//! Short slips that are certified (STATICS 12.8): throughout, both contacts press and the load drives them, and they end in balance, where
//! a search ends.

use super::slides::begun;
use super::*;

/// How strongly the hand drives two contacts at a pose, and both reactions: (N_1, N_2, delta) of [w_1 w_2 -sum v_i w_ti] = -w (STATICS 5),
/// by Cramer's rule.
fn driven_by(
    case: &Case<f64>,
    grip: &Grip<f64>,
    pose: &Pose<f64>,
    velocities: [f64; 2],
) -> [f64; 3] {
    let (force, moment) = wrench(case, grip, pose);
    let at = |point: Vec2<f64>, force: Vec2<f64>| [force.x, force.y, point.cross(force)];
    let places = case.kinds.map(|kind| contact(kind, pose));
    let [w1, w2] = from_fn(|i| {
        let (point, normal, ..) = places[i];
        let friction = tangent(normal) * (velocities[i].signum() * MU_D[i]);
        at(point, normal - friction)
    });
    let [d1, d2] = from_fn(|i| at(places[i].0, tangent(places[i].1) * -velocities[i]));
    let drag: [f64; 3] = from_fn(|k| d1[k] + d2[k]);
    let load = [-force.x, -force.y, -moment];
    let det = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1])
            + c[0] * (a[1] * b[2] - a[2] * b[1])
    };
    let all = det(w1, w2, drag);
    [
        det(load, w2, drag) / all,
        det(w1, load, drag) / all,
        det(w1, w2, load) / all,
    ]
}

#[test]
fn certified_slips_press_on_their_way_and_end_in_balance() {
    let mut counts = [[0; 2]; 4];
    for (corners, count) in KINDS.into_iter().zip(&mut counts) {
        let ways = |seed: u64| (0..6).map(move |k| (seed, 0.3f64.powi(k)));
        for begin in sampled((0..3000).flat_map(ways), 97) {
            let seed = begin.0;
            let Some((case, state, [_, hand])) = begun::<f64>(begin, corners) else {
                continue;
            };
            let grip = Grip { hand, ..case.grip };
            let contacts = (&state.pivot, state.other);
            let driven = Trammel::driven(&case.scene, contacts, &grip, Demand::Pressed);
            let Some(trammel) = driven else {
                continue;
            };
            let sense = trammel.direction();
            let Some(slip) = certified_slip(&case.scene, contacts, &grip, sense) else {
                count[0] += 1;
                continue;
            };
            let course = Course::of(&case.scene, contacts, &grip, &trammel);
            let (pivot, _, ending) = course.slip(trammel.falls(), (0.0, Demand::Pressed));
            if let Ending::Off { .. } = ending {
                // That it stays on both sides is tested separately.
                continue;
            }
            count[1] += 1;
            let near = pivot.placed(&case.scene);
            let end = slip.pivot.placed(&case.scene);
            assert_eq!(ending, Ending::Stopped, "{seed} {corners:?}");
            assert!(near.is_near(&end, 1e-11), "{seed} {corners:?}");
            let turn = (slip.pivot.orientation.angle()).minus(state.pivot.orientation.angle());
            let [s, w] = course.twist;
            let x = s * (slip.pivot.foot - state.pivot.foot) + w * turn;
            assert!(turn.abs() <= slip.turn_bound, "{seed} {corners:?}");
            for k in 0..=64 {
                let spot = course.spot(x * f64::from(k) / 64.0);
                let velocities = course.frame(&spot).velocities.map(|v| v.value);
                let pose = pose_of(&case, &spot.pivot);
                let [n1, n2, drive] = driven_by(&case, &grip, &pose, velocities);
                let sizes = [n1, n2, drive + 1e-9];
                assert!(sizes.iter().all(|&size| size > 0.0), "{seed} {k} {sizes:?}");
                if k == 64 {
                    assert!(drive.abs() < 1e-11, "{seed} {drive:e}");
                }
            }
        }
    }
    assert!(
        cfg!(miri) || counts.iter().all(|[_, certified]| *certified > 100),
        "{counts:?}"
    );
}
