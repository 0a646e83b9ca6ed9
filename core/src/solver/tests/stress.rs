//! temporary
extern crate std;
use super::among::{Run, Setting, box_of, post, table};
use crate::event::{StateKind, Status};
use crate::fixtures::Random;
use crate::real::{Fixed, Real};
use crate::solver::Evolution;
use std::collections::BTreeMap;
use std::format;
use std::string::{String, ToString};
use std::vec;
use std::vec::Vec;

fn run<R: Real>(name: &str, tol: f64)
where
    R::Si: From<f32> + Into<f64>,
{
    let mut tally: BTreeMap<String, usize> = BTreeMap::new();
    let mut shown = 0;
    let only: Option<u64> = std::env::var("SEED").ok().and_then(|s| s.parse().ok());
    for seed in 0..400u64 {
        if only.is_some_and(|o| o != seed) {
            continue;
        }
        let mut random = Random(seed * 7919 + 13);
        let mut q = |n: f64| (random.next() * n).round() / n;
        let width = 1.0 + 0.5 * q(16.0);
        let layout = seed % 6;
        let a = 0.4375 * q(16.0);
        let obstacles = match layout {
            0 => vec![table([-4.0, a])],
            1 => vec![table([a, 4.0])],
            2 => vec![table([-0.25 + 0.25 * q(8.0), 0.75 + 0.25 * q(8.0)])],
            3 => vec![post(-0.375), post(0.375 + 0.125 * q(4.0))],
            4 => vec![table([-4.0, -0.25]), table([0.25, 4.0])],
            _ => vec![table([-4.0, -0.5]), post(0.0), table([0.5, 1.0])],
        };
        let mu = [0.25, 0.5, 0.75][(seed / 6 % 3) as usize];
        let setting = Setting {
            body: box_of([width, 0.25]),
            start: [0.0, 0.5, 0.0],
            weight: 0.125 + 0.125 * q(4.0),
            held_at: [0.25 * q(8.0), 0.0625 * q(4.0)],
            stiffness: [0.25, 1.0, 4.0][(seed % 3) as usize],
            obstacles,
            floor: false,
            friction: [mu, if seed % 2 == 0 { mu } else { mu / 2.0 }],
        };
        let evolution = Evolution::ALL[(seed / 2 % 2) as usize];
        let begin = [setting.held_at[0], 0.5 + setting.held_at[1], 0.0];
        let mut r = Run::<R>::start(&setting, evolution, begin);
        let mut last = begin;
        'run: for leg in 0..6 {
            let next = [
                0.75 * q(32.0),
                if leg % 3 == 2 {
                    0.25
                } else {
                    -0.125 + 0.25 * q(16.0)
                },
                0.0625 * q(8.0),
            ];
            for k in 1..=16 {
                let f = f64::from(k) / 16.0;
                let before = (r.output.state, r.pose(), r.contacts());
                let hand = [0, 1, 2].map(|i| last[i] + (next[i] - last[i]) * f);
                r.step(hand);
                let kind = |k: StateKind| format!("{k:?}");
                let left = r.unbalanced();
                let mut bad = String::new();
                let flat = r.output.state == StateKind::Edge;
                if !r.is_outside(tol) {
                    bad += "inside ";
                }
                if r.output.status == Status::Ok || r.output.status == Status::Jammed {
                    if left.iter().any(|l| l.abs() > tol * 10.0) {
                        bad += "unbalanced ";
                    }
                } else {
                    bad += &format!("{:?} ", r.output.status);
                }
                let reactions = r.reactions();
                if flat
                    && reactions
                        .iter()
                        .any(|c| c[1] < -tol || c[2].abs() > mu * c[1] + tol * 10.0)
                {
                    bad += "cone ";
                }
                let key = format!(
                    "{:?} {} -> {} {}",
                    r.setting.floor,
                    kind(before.0),
                    kind(r.output.state),
                    bad
                );
                *tally.entry(key).or_default() += 1;
                if only.is_some() {
                    std::eprintln!(
                        "{leg} {k} {:?} {:?} {:?} {:?} {:?} {:?} {bad}",
                        r.output.state,
                        r.output.status,
                        r.pose(),
                        r.contacts(),
                        r.reactions(),
                        r.output.events
                    );
                }
                if !bad.is_empty() && (before.0 == StateKind::Edge || flat) && shown < 12 {
                    shown += 1;
                    std::eprintln!(
                        "{name} seed {seed} leg {leg} {k} {evolution:?} {bad}: {before:?} -> {:?} {:?} {:?} {:?} left {left:?} events {:?}",
                        r.output.state,
                        r.pose(),
                        r.contacts(),
                        reactions,
                        r.output.events
                    );
                }
                if !bad.is_empty() {
                    break 'run;
                }
            }
            last = next;
        }
    }
    for (k, v) in tally {
        std::eprintln!("{name} {v:6} {k}");
    }
}

#[test]
fn stress_f64() {
    run::<f64>("f64", 1e-9);
}
#[test]
fn stress_f32() {
    run::<f32>("f32", 1e-5);
}
#[test]
fn stress_fixed() {
    run::<Fixed>("fixed", 2e-5);
}
