//! The slow reference against cases of obstacles with known answers.
mod stress;

use serde_json::Value;
use stiction_tests::reference::{Obstacle, Reference, Scene, Surface, Touch};

const SUBSTEPS: usize = 20;

fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect()
}

fn points(value: &Value) -> Vec<[f64; 2]> {
    value
        .as_array()
        .unwrap()
        .iter()
        .map(|p| {
            let p = numbers(p);
            [p[0], p[1]]
        })
        .collect()
}

fn scene(geometry: &Value) -> (Scene, Vec<String>, Vec<String>) {
    let g = numbers(&geometry["g"]);
    let mut scene = Scene {
        vertices: points(&geometry["verts"]),
        holding_point: [g[0], g[1]],
        k_h: geometry["kh"].as_f64().unwrap(),
        k_theta: geometry["kth"].as_f64().unwrap(),
        weight: geometry["W"].as_f64().unwrap(),
        surfaces: vec![],
        obstacles: vec![],
    };
    let size = 0.0;
    let _ = size;
    let mut l: f64 = 0.0;
    for a in &scene.vertices {
        for b in &scene.vertices {
            l = l.max((a[0] - b[0]).hypot(a[1] - b[1]));
        }
    }
    if l == 0.0 {
        l = 1.0;
    }
    let (mut names, mut surfaces) = (vec![], vec![]);
    for (name, of) in geometry["obstacles"].as_object().unwrap() {
        let mu = numbers(&of[1]);
        scene.obstacles.push(Obstacle {
            vertices: points(&of[0]),
            mu_s: mu[0],
            mu_d: mu[1],
            memory: l / 4096.0,
        });
        names.push(name.clone());
    }
    for (name, of) in geometry["surfaces"].as_object().unwrap() {
        let n = numbers(&of[0]);
        let mu = numbers(&of[2]);
        scene.surfaces.push(Surface {
            normal: [n[0], n[1]],
            offset: of[1].as_f64().unwrap(),
            mu_s: mu[0],
            mu_d: mu[1],
            memory: l / 4096.0,
        });
        surfaces.push(name.clone());
    }
    (scene, names, surfaces)
}

#[test]
fn cases() {
    let cases: Value = serde_json::from_str(include_str!("../../cases/obstacles.json")).unwrap();
    let only = std::env::var("CASE").unwrap_or_default();
    for case in cases.as_array().unwrap() {
        let name = case["name"].as_str().unwrap();
        if !name.contains(&only) {
            continue;
        }
        if case["geometry"].is_null() {
            continue;
        }
        let (scene, names, surfaces) = scene(&case["geometry"]);
        let text = case["scene"].as_str().unwrap();
        let start = text.lines().find(|l| l.starts_with("start = ")).unwrap();
        let start = numbers(&serde_json::from_str(&start[8..]).unwrap());
        let hands: Vec<[f64; 3]> = case["hand"]
            .as_array()
            .unwrap()
            .iter()
            .map(|h| {
                let h = numbers(h);
                [h[1], h[2], h[3]]
            })
            .collect();
        let began = std::time::Instant::now();
        let mut r = Reference::new(scene, [start[0], start[1], start[2]], hands[0]);
        println!("== {name}");
        let mut slips = 0;
        let mut last = String::new();
        for (k, &hand) in hands.iter().enumerate() {
            if k > 0 {
                r.step(hand, SUBSTEPS);
            }
            slips += r.slips();
            let of = |touch: Touch| match touch {
                Touch::Surface { vertex, surface } => {
                    serde_json::json!({"vertex": vertex, "surface": surfaces[surface]})
                }
                Touch::Side {
                    vertex,
                    obstacle,
                    side,
                } => {
                    serde_json::json!({"vertex": vertex, "obstacle": names[obstacle], "side": side})
                }
                Touch::Corner {
                    obstacle,
                    corner,
                    body_side,
                } => {
                    serde_json::json!({"corner": corner, "obstacle": names[obstacle], "body_side": body_side})
                }
            };
            let contacts = r.contacts();
            let say = format!(
                "{:?} {} {}",
                contacts
                    .iter()
                    .map(|c| (c.touch, c.slides))
                    .collect::<Vec<_>>(),
                r.stiction(),
                r.ambiguous()
            );
            if say != last || r.slips() > 0 {
                println!(
                    "   {k} {:?} {say} slips {} events {}",
                    r.pose(),
                    r.slips(),
                    r.events()
                );
                last = say;
            }
            for check in case["checks"].as_array().unwrap() {
                if check[0].as_u64().unwrap() as usize != k {
                    continue;
                }
                let what = check[1].as_str().unwrap();
                let scale = check[3].as_f64().unwrap();
                let want = &check[2];
                let pose = r.pose();
                let got = match what {
                    "x" => pose[0],
                    "y" => pose[1],
                    "theta" => pose[2],
                    "state" => {
                        if want.as_str() != Some(r.state()) {
                            println!("  BAD {k} state {} want {want}", r.state());
                        }
                        continue;
                    }
                    "contacts" => {
                        let got: Vec<Value> = contacts.iter().map(|c| of(c.touch)).collect();
                        let same = got.len() == want.as_array().unwrap().len()
                            && want.as_array().unwrap().iter().all(|w| got.contains(w));
                        if !same {
                            println!("  BAD {k} contacts {got:?} want {want}");
                        }
                        continue;
                    }
                    "normal" | "friction" => {
                        let Some(c) = contacts.iter().find(|c| of(c.touch) == want[0]) else {
                            println!("  BAD {k} no {}", want[0]);
                            continue;
                        };
                        if what == "normal" {
                            c.normal
                        } else {
                            c.friction
                        }
                    }
                    "Tsum" => contacts.iter().map(|c| c.friction).sum(),
                    "slips" => slips as f64,
                    _ => {
                        println!("  ? {what}");
                        continue;
                    }
                };
                let want = want.as_f64().unwrap_or_else(|| want[1].as_f64().unwrap());
                let error = (got - want).abs() / scale;
                println!(
                    "  {} {k} {what} {got} {want} {error:.1e}",
                    if error > 1e-8 { "BAD" } else { "ok" }
                );
            }
        }
        println!("   {:?}", began.elapsed());
    }
}
