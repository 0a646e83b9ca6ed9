//! The cases of `cases/obstacles.json`: scene, path of the hand, and values known to 15 digits and more from the balance of their
//! contacts.
//!
//! The reference knows a place where something touches to 1e-12 body sizes, and a force at the edge of its cone to 1e-12 of what the
//! spring bears when drawn by a body size, which is some ten times what it bears here. Reached: 2e-12 in poses, 3e-11 in forces, where
//! a slip begins at such a place; 1e-14 where nothing slips.

use serde_json::{Value, json};
use stiction_tests::close;
use stiction_tests::reference::{ContactForce, Obstacle, Reference, Scene, Surface, Touch};

/// Parts in which the hand goes from frame to frame.
const SUBSTEPS: usize = 20;
/// Largest error of a pose in body sizes and rad.
const POSE: f64 = 5e-12;
/// Largest error of a force, in the largest force of its frame.
const FORCE: f64 = 1e-10;
/// Cases that are run; the one besides has to be refused by who reads it.
const RUN: usize = 15;

/// A scene with the names of what is in it.
pub(crate) struct Named {
    pub(crate) scene: Scene,
    surfaces: Vec<String>,
    obstacles: Vec<String>,
}

fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list of numbers");
    list.iter().map(|x| x.as_f64().expect("a number")).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

pub(crate) fn text(value: &Value) -> &str {
    value.as_str().expect("a text")
}

fn points(value: &Value) -> Vec<[f64; 2]> {
    let list = value.as_array().expect("a list of points").iter();
    list.map(|point| [number(&point[0]), number(&point[1])])
        .collect()
}

/// The largest vertex distance, of a point 1 m.
fn size(vertices: &[[f64; 2]]) -> f64 {
    let apart = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let most = vertices
        .iter()
        .flat_map(|a| vertices.iter().map(move |b| apart(a, b)))
        .fold(0.0, f64::max);
    if most > 0.0 { most } else { 1.0 }
}

pub(crate) fn named(geometry: &Value) -> Named {
    let vertices = points(&geometry["verts"]);
    let memory = size(&vertices) / 4096.0;
    let each = |kind: &str| geometry[kind].as_object().expect("a table by name").clone();
    let surface = |of: &Value| Surface {
        normal: [number(&of[0][0]), number(&of[0][1])],
        offset: number(&of[1]),
        mu_s: number(&of[2][0]),
        mu_d: number(&of[2][1]),
        memory,
    };
    let obstacle = |of: &Value| Obstacle {
        vertices: points(&of[0]),
        mu_s: number(&of[1][0]),
        mu_d: number(&of[1][1]),
        memory,
    };
    Named {
        scene: Scene {
            holding_point: [number(&geometry["g"][0]), number(&geometry["g"][1])],
            k_h: number(&geometry["kh"]),
            k_theta: number(&geometry["kth"]),
            weight: number(&geometry["W"]),
            surfaces: each("surfaces").values().map(surface).collect(),
            obstacles: each("obstacles").values().map(obstacle).collect(),
            vertices,
        },
        surfaces: each("surfaces").keys().cloned().collect(),
        obstacles: each("obstacles").keys().cloned().collect(),
    }
}

impl Named {
    /// A contact as the cases call it.
    fn name(&self, touch: Touch) -> Value {
        match touch {
            Touch::Surface { vertex, surface } => {
                json!({"vertex": vertex, "surface": self.surfaces[surface]})
            }
            Touch::Side {
                vertex,
                obstacle,
                side,
            } => json!({"vertex": vertex, "obstacle": self.obstacles[obstacle], "side": side}),
            Touch::Corner {
                obstacle,
                corner,
                body_side,
            } => {
                json!({"corner": corner, "obstacle": self.obstacles[obstacle], "body_side": body_side})
            }
        }
    }

    /// Force of the hand along y, N.
    fn pull_up(&self, pose: [f64; 3], hand: [f64; 3]) -> f64 {
        let (sin, cos) = pose[2].sin_cos();
        let [x, y] = self.scene.holding_point;
        self.scene.k_h * (hand[1] - pose[1] - sin * x - cos * y)
    }
}

/// Compares what the reference says in a frame with one value of a case.
fn check(named: &Named, body: &Reference, (hand, slips): ([f64; 3], u32), check: &Value) {
    let (what, want, scale) = (text(&check[1]), &check[2], number(&check[3]));
    let contacts = body.contacts();
    let of = |value: fn(&ContactForce) -> f64| {
        let contact = contacts.iter().find(|c| named.name(c.touch) == want[0]);
        (value(contact.expect("the contact")), number(&want[1]))
    };
    let pose = body.pose();
    let (got, want) = match what {
        "x" => (pose[0], number(want)),
        "y" => (pose[1], number(want)),
        "theta" => (pose[2], number(want)),
        "normal" => of(|contact| contact.normal),
        "friction" => of(|contact| contact.friction),
        "Tsum" => (contacts.iter().map(|c| c.friction).sum(), number(want)),
        "wrench_y" => (named.pull_up(pose, hand), number(want)),
        "slips" => (f64::from(slips), number(want)),
        "state" => return assert_eq!(body.state(), text(want)),
        "contacts" => {
            let names: Vec<Value> = contacts.iter().map(|c| named.name(c.touch)).collect();
            let wanted = want.as_array().expect("a list of contacts");
            assert_eq!(names.len(), wanted.len(), "{names:?} instead of {want}");
            assert!(
                wanted.iter().all(|one| names.contains(one)),
                "{names:?} instead of {want}"
            );
            return;
        }
        other => panic!("{other}: no such value"),
    };
    let bound = if matches!(what, "x" | "y" | "theta") {
        POSE
    } else {
        FORCE
    };
    close(&format!("{what} at {}", check[0]), got, want, bound * scale);
}

/// Poses, forces and contacts of a run, each frame given to `look`.
pub(crate) fn run(
    named: &Named,
    case: &Value,
    mut look: impl FnMut(u64, &Reference, ([f64; 3], u32)),
) {
    let scene = text(&case["scene"]).lines();
    let start = scene
        .filter_map(|line| line.strip_prefix("start = "))
        .map(|line| serde_json::from_str(line).expect("a pose"))
        .next();
    let pose = |value: &[f64]| [value[0], value[1], value[2]];
    let start = pose(&numbers(&start.expect("a start")));
    let hands = case["hand"].as_array().expect("a path of the hand");
    let hand = |row: &Value| pose(&numbers(row)[1..]);
    let mut body = Reference::new(named.scene.clone(), start, hand(&hands[0]));
    let mut slips = 0;
    for (frame, row) in (0..).zip(hands) {
        if frame > 0 {
            body.step(hand(row), SUBSTEPS);
            assert!(!body.ambiguous() && !body.skipped(), "frame {frame}");
            slips += body.slips();
        }
        look(frame, &body, (hand(row), slips));
    }
}

pub(crate) fn cases() -> Vec<Value> {
    let text = include_str!("../../cases/obstacles.json");
    let cases: Vec<Value> = serde_json::from_str(text).expect("the cases");
    let known = |case: &Value| !case["geometry"].is_null();
    cases.into_iter().filter(known).collect()
}

#[test]
fn every_case_has_its_known_answer() {
    let cases = cases();
    assert_eq!(cases.len(), RUN);
    for case in cases {
        println!("{}", case["name"]);
        let named = named(&case["geometry"]);
        let checks = case["checks"].as_array().expect("a list of values");
        run(&named, &case, |frame, body, now| {
            let due = checks.iter().filter(|c| c[0].as_u64() == Some(frame));
            due.for_each(|one| check(&named, body, now, one));
        });
    }
}

#[test]
fn a_block_as_large_as_a_floor_is_one() {
    let case = cases().into_iter().find(|case| case["same_as"].is_string());
    let case = case.expect("the case of a block");
    let block = named(&case["geometry"]);
    let friction = &block.scene.obstacles[0];
    let floor = Surface {
        normal: [0.0, 1.0],
        offset: 0.0,
        mu_s: friction.mu_s,
        mu_d: friction.mu_d,
        memory: friction.memory,
    };
    let mut plane = named(&case["geometry"]);
    plane.scene.obstacles.clear();
    plane.scene.surfaces.push(floor);
    let mut path = Vec::new();
    run(&plane, &case, |_, body, _| {
        path.push((body.pose(), body.slips()))
    });
    let mut path = path.into_iter();
    run(&block, &case, |frame, body, _| {
        let (pose, slips) = path.next().expect("as many frames");
        assert_eq!(body.slips(), slips, "frame {frame}");
        let same = body.pose().into_iter().zip(pose);
        same.for_each(|(got, want)| close("pose", got, want, POSE));
    });
}
