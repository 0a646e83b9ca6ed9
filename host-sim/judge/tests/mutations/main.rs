//! True traces of the solver before the judge, and the same with a fault in them.

mod scenes;
mod truth;

use std::collections::BTreeMap;
use stiction_judge::{Judge, Evolution};
use truth::*;

#[test]
fn survey() {
    let count: usize = std::env::var("COUNT").map_or(10, |c| c.parse().unwrap());
    let mut all = scenes::bundled();
    all.extend(scenes::random(count));
    all.extend(scenes::among(count as u64));
    let only = std::env::var("ONLY").unwrap_or_default();
    all.retain(|s| s.0.contains(&only));
    let mut worst: BTreeMap<(String, &'static str), (f64, u64, String)> = BTreeMap::new();
    let mut frames = 0;
    for (name, text) in &all {
        for number in Number::ALL {
            for evolution in EVOLUTIONS {
                let truth = match std::panic::catch_unwind(|| truth(name, text, number, evolution)) { Ok(t) => t, Err(_) => { println!("refused {name}"); continue } };
                let mut judge = Judge::new(truth.scene.clone(), number.bounds(), evolution);
                for (i, frame) in truth.frames.iter().enumerate() {
                    frames += 1;
                    for f in judge.next(frame.clone()) {
                        let e = worst.entry((format!("{number:?}"), f.law)).or_default();
                        if !f.holds() { e.1 += 1; }
                        if f.severity() > e.0 { e.0 = f.severity(); e.2 = format!("{name} {evolution:?} {i}"); }
                        if !f.holds() && e.1 <= 3 { println!("{number:?} {}: {name} {evolution:?} frame {i}: {f:?}\n   {:?}\n   {:?}", f.law, truth.frames.get(i.wrapping_sub(1)), frame); }
                    }
                }
            }
        }
    }
    println!("{frames} frames");
    for (k, w) in worst { println!("{:7} {:45} {:10.2e} {:6} {}", k.0, k.1, w.0, w.1, w.2); }
}

#[test]
#[ignore]
fn dump() {
    use std::fmt::Write as _;
    let count: usize = std::env::var("COUNT").map_or(10, |c| c.parse().unwrap());
    let dir = std::env::var("DUMP").unwrap();
    let mut all = scenes::bundled();
    all.extend(scenes::random(count));
    all.extend(scenes::among(count as u64));
    for (name, text) in &all {
        std::fs::write(format!("{dir}/{name}.toml"), text).unwrap();
        for number in Number::ALL {
            for evolution in EVOLUTIONS {
                let Ok(truth) = std::panic::catch_unwind(|| truth(name, text, number, evolution)) else { continue };
                let mut out = String::new();
                for f in &truth.frames {
                    let _ = write!(out, "{} {} {}", f.t.to_bits(), f.held, f.depth.to_bits());
                    for x in f.hand.iter().chain(&f.pose).chain(&f.wrench) { let _ = write!(out, " {}", x.to_bits()); }
                    let _ = write!(out, " {:?} {:?} {} {} {}", f.state, f.status, f.slips, f.events.len(), f.contacts.len());
                    for e in &f.events { let _ = write!(out, " {e:?}"); }
                    for c in &f.contacts {
                        let t = match c.touch { stiction_judge::Touch::Surface { vertex, surface } => [0, vertex, surface, 0], stiction_judge::Touch::Side { vertex, obstacle, side } => [1, vertex, obstacle, side], stiction_judge::Touch::Corner { obstacle, corner, body_side } => [2, obstacle, corner, body_side] };
                        let _ = write!(out, " {} {} {} {}", t[0], t[1], t[2], t[3]);
                        let d = c.direction.unwrap_or([f64::NAN; 2]);
                        for x in [c.point[0], c.point[1], d[0], d[1], c.normal, c.friction] { let _ = write!(out, " {}", x.to_bits()); }
                        let _ = write!(out, " {}", c.sliding.unwrap_or(9));
                    }
                    out.push('\n');
                }
                std::fs::write(format!("{dir}/{name}.{number:?}.{evolution:?}.txt"), out).unwrap();
            }
        }
    }
}
