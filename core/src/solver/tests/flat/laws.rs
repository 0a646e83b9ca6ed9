//! Flat bodies on random paths: the laws that hold in every frame.

use super::*;
use crate::fixtures::sampled;

/// Boxes above tables, posts and gaps, moved about: wherever a body lies flat its contacts are closed and on their sides, their reactions
/// balance the load and are in the cones, and it is in no obstacle.
#[test]
fn flat_bodies_obey_the_laws() {
    fn lawful<R: Real>(tolerance: f64)
    where
        R::Si: From<f32> + Into<f64>,
    {
        let mut count = 0;
        for seed in sampled(0..300_u64, 97) {
            let mut random = Random(seed * 7919 + 13);
            let mut grid = |n: f64| (random.next() * n).round() / n;
            let obstacles = match seed % 6 {
                0 => vec![table([-4.0, 0.4375 * grid(16.0)])],
                1 => vec![table([0.4375 * grid(16.0), 4.0])],
                2 => vec![table([-0.25 + 0.25 * grid(8.0), 0.75 + 0.25 * grid(8.0)])],
                3 => vec![post(-0.375), post(0.375 + 0.125 * grid(4.0))],
                4 => vec![table([-4.0, -0.25]), table([0.25, 4.0])],
                _ => vec![table([-4.0, -0.5]), post(0.0), table([0.5, 1.0])],
            };
            let mu = [0.25, 0.5, 0.75][(seed / 6 % 3) as usize];
            let setting = Setting {
                body: box_of([1.0 + 0.5 * grid(16.0), 0.25]),
                start: [0.0, 0.5, 0.0],
                weight: 0.125 + 0.125 * grid(4.0),
                held_at: [0.25 * grid(8.0), 0.0625 * grid(4.0)],
                stiffness: [0.25, 1.0, 4.0][(seed % 3) as usize],
                obstacles,
                friction: [mu, if seed % 2 == 0 { mu } else { mu / 2.0 }],
                ..setting()
            };
            let evolution = Evolution::ALL[(seed / 2 % 2) as usize];
            let mut last = [setting.held_at[0], 0.5 + setting.held_at[1], 0.0];
            let mut run = Run::<R>::start(&setting, evolution, last);
            for leg in 0..6 {
                let y = if leg % 3 == 2 {
                    0.25
                } else {
                    -0.125 + 0.25 * grid(16.0)
                };
                let next = [0.75 * grid(32.0), y, 0.0625 * grid(8.0)];
                for k in 1..=16 {
                    let part = f64::from(k) / 16.0;
                    run.step([0, 1, 2].map(|i| last[i] + (next[i] - last[i]) * part));
                    if run.output.state != StateKind::Edge || run.output.status != Status::Ok {
                        continue;
                    }
                    assert!(run.is_outside(tolerance), "{seed} {leg} {k}");
                    for left in run.unbalanced() {
                        same(left, 0.0, 10.0 * tolerance);
                    }
                    for [_, normal, friction] in run.reactions() {
                        let beyond = friction.abs() - mu * normal;
                        assert!(beyond <= 10.0 * tolerance, "{seed} {leg} {k} {beyond}");
                    }
                    count += 1;
                }
                last = next;
            }
        }
        assert!(cfg!(miri) || count > 5000, "{count}");
    }
    lawful::<f64>(1e-9);
    lawful::<f32>(1e-5);
    lawful::<Fixed>(2e-5);
}
