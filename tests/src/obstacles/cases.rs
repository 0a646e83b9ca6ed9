//! The cases of `cases/obstacles.json`: scene, path of the hand, and values known to 15 digits or more from the balance of the
//! contacts. Lengths in m, angles in rad, forces in N.

use super::scene::{Among, Obstacle};
use crate::setup::Setup;
use serde_json::Value;
use stiction_core::SurfaceDescription;
use stiction_judge::{Scene, Source, Surface, Touch};

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
    /// The scene, as in its file.
    pub scene: Scene,
    /// The scene for the solver.
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
    let scene = Source::new("scene.toml", text(&case["scene"]));
    let scene = Scene::parse(scene).expect("a sound scene");
    let among = among(&scene);
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
            .map(|c| check(c, &scene))
            .collect(),
        closed: CLOSED.contains(&name),
        tolerance: ["f64", "f32"].map(|key| number(&case["tolerance"][key])),
        twin,
        refused: case["fails"].is_string(),
        among,
        scene,
    }
}

fn among(scene: &Scene) -> Among {
    let surface = |s: &Surface| SurfaceDescription {
        normal: s.normal,
        offset: s.offset,
        friction_static: s.friction_static,
        friction_dynamic: s.friction_dynamic,
        memory: None,
    };
    let obstacle = |o: &stiction_judge::Obstacle| Obstacle {
        vertices: o.vertices.clone(),
        friction: [o.friction_static, o.friction_dynamic],
    };
    let setup = Setup::new(&scene.vertices)
        .at(scene.start)
        .held_at(scene.holding_point.expect("a holding point"))
        .springs(scene.stiffness_translation, scene.stiffness_rotation)
        .weighing(scene.weight);
    Among {
        setup: Setup {
            surfaces: scene.surfaces.iter().map(surface).collect(),
            ..setup
        },
        obstacles: scene.obstacles.iter().map(obstacle).collect(),
    }
}

fn check(check: &Value, scene: &Scene) -> Check {
    let want = &check[2];
    let touch = |of: &Value| touch(of, scene);
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

fn touch(of: &Value, scene: &Scene) -> Touch {
    if of["surface"].is_string() {
        let mut names = scene.surfaces.iter().map(|surface| &surface.name);
        return Touch::Surface {
            vertex: index(&of["vertex"]),
            surface: names
                .position(|name| name == text(&of["surface"]))
                .expect("its name"),
        };
    }
    let mut names = scene.obstacles.iter().map(|obstacle| &obstacle.name);
    let obstacle = names
        .position(|name| name == text(&of["obstacle"]))
        .expect("its name");
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
