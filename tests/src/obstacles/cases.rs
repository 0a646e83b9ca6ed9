//! The cases of `cases/obstacles.json`: scene, path of the hand, and values known to 15 digits or more from the balance of the
//! contacts. Lengths in m, angles in rad, forces in N.

use super::scene::{Among, Obstacle};
use crate::setup::Setup;
use serde_json::Value;
use stiction_core::SurfaceDescription;
use stiction_judge::Touch;

/// Cases whose values follow from closed formulas, without solving an equation numerically.
const CLOSED: [&str; 5] = [
    "box pushed over the edge, flat, static = dynamic",
    "plank on two posts",
    "point dragged off the edge of a table",
    "frame jump through a thin wall",
    "around a plate, near it, not at it",
];

/// A scene, a path and the known values of some frames.
#[derive(Clone, Debug)]
pub struct Case {
    /// What the case is about.
    pub name: String,
    /// The scene.
    pub among: Among,
    /// The hand, frame by frame: x, y, phi.
    pub hands: Vec<[f64; 3]>,
    /// The known values.
    pub checks: Vec<Check>,
    /// The values follow from closed formulas.
    pub closed: bool,
    /// Tolerance in f64, and that of f32 and fixed point, relative to the scale of a check.
    pub tolerance: [f64; 2],
    /// The scene with a half-plane, friction \[mu_s, mu_d\], in place of its obstacle.
    pub twin: Option<Among>,
    /// The scene has to be refused.
    pub refused: bool,
}

/// One known value.
#[derive(Clone, Debug)]
pub struct Check {
    /// Index of the frame.
    pub frame: usize,
    /// The value.
    pub value: Known,
    /// What an error is relative to: the body's size, 1 rad, or the largest force of the frame.
    pub scale: f64,
}

/// The quantity that is known.
#[derive(Clone, Debug, PartialEq)]
pub enum Known {
    /// x, y or theta, selected by index.
    Pose(usize, f64),
    /// N of a contact.
    Normal(Touch, f64),
    /// T of a contact.
    Friction(Touch, f64),
    /// The sum of all T.
    Frictions(f64),
    /// The force of the hand on the body along y.
    Pull(f64),
    /// The number of slips up to this frame.
    Slips(u32),
    /// The name of the state.
    State(String),
    /// All contacts, in order.
    Contacts(Vec<Touch>),
}

/// What a check is compared with: the answer of the solver or of the reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// x, y, theta.
    pub pose: [f64; 3],
    /// Contacts with N and T.
    pub contacts: Vec<(Touch, [f64; 2])>,
    /// The force of the hand on the body along y.
    pub pull: f64,
    /// Slips since the first frame.
    pub slips: u32,
    /// The name of the state.
    pub state: &'static str,
}

impl Known {
    /// Whether it is a component of the pose.
    pub fn is_pose(&self) -> bool {
        matches!(self, Self::Pose(..))
    }
    /// Whether it is a force.
    pub fn is_force(&self) -> bool {
        matches!(
            self,
            Self::Normal(..) | Self::Friction(..) | Self::Frictions(_) | Self::Pull(_)
        )
    }
}

impl Check {
    /// The error of an answer, relative to the scale of the check; infinite if names differ or a contact is missing.
    pub fn error(&self, answer: &Answer) -> f64 {
        let same = |same: bool| if same { 0.0 } else { f64::INFINITY };
        let of = |touch: &Touch, k: usize| {
            let found = answer.contacts.iter().find(|c| c.0 == *touch);
            found.map_or(f64::INFINITY, |c| c.1[k])
        };
        let off = |got: f64, want: f64| {
            let off = (got - want).abs() / self.scale;
            if off.is_nan() { f64::INFINITY } else { off }
        };
        match &self.value {
            Known::Pose(k, want) => off(answer.pose[*k], *want),
            Known::Normal(touch, want) => off(of(touch, 0), *want),
            Known::Friction(touch, want) => off(of(touch, 1), *want),
            Known::Frictions(want) => off(answer.contacts.iter().map(|c| c.1[1]).sum(), *want),
            Known::Pull(want) => off(answer.pull, *want),
            Known::Slips(want) => same(answer.slips == *want),
            Known::State(want) => same(answer.state == want),
            Known::Contacts(want) => {
                let mut touches: Vec<Touch> = answer.contacts.iter().map(|c| c.0).collect();
                touches.sort();
                same(touches == *want)
            }
        }
    }
}

/// All cases.
///
/// # Panics
/// If the file is not as expected.
pub fn all() -> Vec<Case> {
    let text = include_str!("../../cases/obstacles.json");
    let cases: Vec<Value> = serde_json::from_str(text).expect("the cases");
    cases.iter().map(read).collect()
}

fn read(case: &Value) -> Case {
    let scene = text(&case["scene"]);
    let geometry = &case["geometry"];
    let (among, names) = if geometry.is_null() {
        (bare(scene), [Vec::new(), Vec::new()])
    } else {
        among(geometry, scene)
    };
    let hand = |row: &Value| [1, 2, 3].map(|k| number(&row[k]));
    let twin = case["same_as"].is_string().then(|| {
        let mut twin = among.clone();
        let [mu_s, mu_d] = among.obstacles[0].friction;
        twin.obstacles.clear();
        twin.setup = twin.setup.floor([mu_s, mu_d]);
        twin
    });
    let name = text(&case["name"]);
    Case {
        name: name.to_owned(),
        hands: list(&case["hand"]).iter().map(hand).collect(),
        checks: list(&case["checks"])
            .iter()
            .map(|c| check(c, &names))
            .collect(),
        closed: CLOSED.contains(&name),
        tolerance: ["f64", "f32"].map(|key| number(&case["tolerance"][key])),
        twin,
        refused: case["fails"].is_string(),
        among,
    }
}

/// The scene, and the names of its half-planes and obstacles.
fn among(geometry: &Value, scene: &str) -> (Among, [Vec<String>; 2]) {
    let each = |kind: &str| geometry[kind].as_object().expect("a table by name").clone();
    let pair = |of: &Value| [0, 1].map(|k| number(&of[k]));
    let surface = |of: &Value| {
        let [friction_static, friction_dynamic] = pair(&of[2]);
        SurfaceDescription {
            normal: pair(&of[0]),
            offset: number(&of[1]),
            friction_static,
            friction_dynamic,
            memory: None,
        }
    };
    let obstacle = |of: &Value| Obstacle {
        vertices: list(&of[0]).iter().map(pair).collect(),
        friction: pair(&of[1]),
    };
    let vertices: Vec<_> = list(&geometry["verts"]).iter().map(pair).collect();
    let start = line(scene, "start").remove(0);
    let setup = Setup {
        surfaces: each("surfaces").values().map(surface).collect(),
        ..Setup::new(&vertices)
            .at([0, 1, 2].map(|k| number(&start[k])))
            .held_at(pair(&geometry["g"]))
            .springs(number(&geometry["kh"]), number(&geometry["kth"]))
            .weighing(number(&geometry["W"]))
    };
    let obstacles = each("obstacles").values().map(obstacle).collect();
    let names = ["surfaces", "obstacles"].map(|kind| each(kind).keys().cloned().collect());
    (Among { setup, obstacles }, names)
}

/// Body and obstacle of a scene file; a refused scene needs nothing else.
fn bare(scene: &str) -> Among {
    let points = |value: &Value| -> Vec<[f64; 2]> {
        let point = |p: &Value| [0, 1].map(|k| number(&p[k]));
        list(value).iter().map(point).collect()
    };
    let shapes = line(scene, "vertices");
    let start = line(scene, "start").remove(0);
    Among {
        setup: Setup::new(&points(&shapes[0]))
            .at([0, 1, 2].map(|k| number(&start[k])))
            .springs(500.0, 0.5),
        obstacles: vec![Obstacle {
            vertices: points(&shapes[1]),
            friction: [0.5, 0.3],
        }],
    }
}

/// The values of a key in the lines of a scene file.
fn line(scene: &str, key: &str) -> Vec<Value> {
    let value = |line: &str| {
        let value = line.strip_prefix(key)?.trim_start().strip_prefix('=')?;
        Some(serde_json::from_str(value.trim()).expect("a list"))
    };
    scene.lines().filter_map(value).collect()
}

fn check(check: &Value, names: &[Vec<String>; 2]) -> Check {
    let want = &check[2];
    let touch = |of: &Value| touch(of, names);
    let value = match text(&check[1]) {
        "x" => Known::Pose(0, number(want)),
        "y" => Known::Pose(1, number(want)),
        "theta" => Known::Pose(2, number(want)),
        "normal" => Known::Normal(touch(&want[0]), number(&want[1])),
        "friction" => Known::Friction(touch(&want[0]), number(&want[1])),
        "Tsum" => Known::Frictions(number(want)),
        "wrench_y" => Known::Pull(number(want)),
        "slips" => Known::Slips(index(want) as u32),
        "state" => Known::State(text(want).to_owned()),
        "contacts" => {
            let mut touches: Vec<Touch> = list(want).iter().map(touch).collect();
            touches.sort();
            Known::Contacts(touches)
        }
        other => panic!("{other}: no such value"),
    };
    Check {
        frame: index(&check[0]),
        value,
        scale: number(&check[3]),
    }
}

fn touch(of: &Value, [surfaces, obstacles]: &[Vec<String>; 2]) -> Touch {
    let find = |names: &[String], name: &Value| {
        let place = names.iter().position(|n| n == text(name));
        place.expect("the name of something")
    };
    if of["surface"].is_string() {
        return Touch::Surface {
            vertex: index(&of["vertex"]),
            surface: find(surfaces, &of["surface"]),
        };
    }
    let obstacle = find(obstacles, &of["obstacle"]);
    if of["corner"].is_null() {
        return Touch::Side {
            vertex: index(&of["vertex"]),
            obstacle,
            side: index(&of["side"]),
        };
    }
    Touch::Corner {
        obstacle,
        corner: index(&of["corner"]),
        body_side: index(&of["body_side"]),
    }
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn index(value: &Value) -> usize {
    number(value) as usize
}

fn text(value: &Value) -> &str {
    value.as_str().expect("a text")
}
