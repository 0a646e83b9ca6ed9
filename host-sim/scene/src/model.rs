//! The model of the solver that a scene needs: from a scene file to the capacity for vertices, surfaces and obstacles, whether
//! there is friction and weight, and the reasons. Parts that the model lacks are not in the binary.

use std::fmt;

use crate::obstacle::ObstacleInfo;
use crate::written::WrittenScene;

/// The V, S and M of a `Solver<R, V, S, M>`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneModel {
    /// V: capacity for vertices.
    pub vertices: usize,
    /// S: capacity for surfaces.
    pub surfaces: usize,
    /// Sticking and slipping.
    pub friction: bool,
    /// The body's weight.
    pub weight: bool,
    /// Obstacles with corners; if there are none, the model contains no code for them.
    pub obstacles: ObstacleRoom,
}

impl SceneModel {
    /// Capacity for most scenes that arrive over the wire; for obstacles only with the feature `obstacles` of a board.
    pub const BOARD: Self = Self {
        vertices: 8,
        surfaces: 4,
        friction: true,
        weight: true,
        obstacles: ObstacleRoom {
            count: 4,
            corners: 16,
        },
    };
}

/// Capacity for obstacles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ObstacleRoom {
    /// O: the number of obstacles.
    pub count: usize,
    /// C: the number of corners of all obstacles together.
    pub corners: usize,
}

impl ObstacleRoom {
    /// The capacity for these obstacles.
    pub fn of(obstacles: &[ObstacleInfo]) -> Self {
        Self {
            count: obstacles.len(),
            corners: obstacles.iter().map(|o| o.vertices.len()).sum(),
        }
    }

    /// The larger capacity of the two.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self {
            count: self.count.max(other.count),
            corners: self.corners.max(other.corners),
        }
    }

    /// Whether there is no capacity.
    pub const fn is_empty(self) -> bool {
        self.count == 0
    }
}

impl SceneModel {
    /// The smallest model in which a scene runs.
    pub fn smallest(scene: &WrittenScene) -> Self {
        Self {
            vertices: scene.vertices.len(),
            surfaces: scene.surfaces.len(),
            friction: rough(scene).next().is_some(),
            weight: scene.weight > 0.0,
            obstacles: ObstacleRoom::of(&scene.obstacles),
        }
    }

    /// Every part of the solver: friction, weight, capacity for at least 4 vertices and 2 surfaces; obstacles unchanged.
    #[must_use]
    pub fn full(self) -> Self {
        self.with(Self {
            vertices: 4,
            surfaces: 2,
            friction: true,
            weight: true,
            obstacles: ObstacleRoom::default(),
        })
    }

    /// The parts and capacities that either of two models has.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self {
            vertices: self.vertices.max(other.vertices),
            surfaces: self.surfaces.max(other.surfaces),
            friction: self.friction || other.friction,
            weight: self.weight || other.weight,
            obstacles: self.obstacles.with(other.obstacles),
        }
    }

    /// The name of M in `stiction-core`; with obstacles, that of the M inside it.
    pub const fn name(self) -> &'static str {
        match (self.friction, self.weight) {
            (true, true) => "Full",
            (true, false) => "Weightless",
            (false, true) => "Frictionless",
            (false, false) => "Bare",
        }
    }

    /// The reasons for each part of a scene's smallest model: V, S, friction, weight, and O and C if there are obstacles.
    pub fn reasons(scene: &WrittenScene) -> Vec<String> {
        let model = Self::smallest(scene);
        let ObstacleRoom { count, corners } = model.obstacles;
        let obstacles = (count > 0).then(|| {
            format!("O = {count}, C = {corners}: obstacles whose sides end, and corners that touch the body")
        });
        let parts = [
            format!("V = {}: {}", model.vertices, vertices(model.vertices)),
            format!("S = {}: {}", model.surfaces, surfaces(model)),
            friction(scene),
            if model.weight {
                format!("weight: {} N", scene.weight)
            } else {
                "no weight: it is 0".to_owned()
            },
        ];
        parts.into_iter().chain(obstacles).collect()
    }
}

impl fmt::Display for SceneModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (vertices, surfaces, name) = (self.vertices, self.surfaces, self.name());
        write!(f, "V = {vertices}, S = {surfaces}, ")?;
        if !self.obstacles.is_empty() {
            let ObstacleRoom { count, corners } = self.obstacles;
            write!(f, "O = {count}, C = {corners}, ")?;
        }
        f.write_str(name)
    }
}

/// Names and mu_s of surfaces and obstacles with friction.
fn rough(scene: &WrittenScene) -> impl Iterator<Item = (&str, f64)> {
    let surfaces = (scene.surfaces.iter()).map(|s| (s.name.as_str(), s.friction_static));
    let obstacles = (scene.obstacles.iter()).map(|o| (o.name.as_str(), o.friction_static));
    surfaces.chain(obstacles).filter(|(_, mu)| *mu > 0.0)
}

fn vertices(count: usize) -> &'static str {
    match count {
        1 => "the body is a point, it has no edge that could lie on a surface",
        2 => "the body is a rod, which can lie on a surface",
        _ => "the body is a polygon, an edge of which can lie on a surface",
    }
}

fn surfaces(model: SceneModel) -> &'static str {
    match (model.vertices, model.surfaces) {
        (_, 0 | 1) if !model.obstacles.is_empty() => "the body can also touch obstacles",
        (_, 0) => "there is nothing to touch",
        (_, 1) => "there is no second surface, so no two-vertex, corner and locked state",
        (1, _) => "the point can touch two surfaces, in a corner",
        _ => "the body can touch two surfaces, in the two-vertex, corner and locked states",
    }
}

fn friction(scene: &WrittenScene) -> String {
    let rough: Vec<String> = rough(scene)
        .map(|(name, mu)| format!("{name:?} has mu_s = {mu}"))
        .collect();
    if rough.is_empty() {
        return "no friction: mu = 0 everywhere, so nothing ever sticks".to_owned();
    }
    format!("friction: {}", rough.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;
    use std::path::Path;

    fn bundled(name: &str) -> WrittenScene {
        let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
        let file = scenes.join(name).with_extension("toml");
        WrittenScene::read(&file, f64::MAX).expect("a bundled scene")
    }

    /// A scene with these vertices, weight and mu_s of each surface.
    fn scene(vertices: &str, weight: f64, friction: &[f64]) -> WrittenScene {
        let surface = |(i, mu): (usize, &f64)| {
            format!(
                "[[surface]]\nname = \"s{i}\"\nnormal = [0.0, 1.0]\noffset = -{i}.0\nstatic = {mu:?}\ndynamic = 0.0\n"
            )
        };
        let surfaces: String = friction.iter().enumerate().map(surface).collect();
        let text = format!(
            "[body]\nvertices = {vertices}\nstart = [0.0, 1.0, 0.0]\nweight = {weight:?}\n\
             [spring]\ntranslation = 1.0\nrotation = 1.0\n{surfaces}"
        );
        WrittenScene::parse(Source::new("made.toml", text), f64::MAX).expect("a sound scene")
    }

    #[test]
    fn smallest_model_of_bundled_scenes() {
        for (name, expected) in [
            ("vertex-stick-slip", "V = 4, S = 1, Weightless"),
            ("box-flat", "V = 4, S = 1, Weightless"),
            ("corner-stick-slip", "V = 4, S = 2, Weightless"),
            ("ladder", "V = 2, S = 2, Weightless"),
            ("snap", "V = 3, S = 1, Weightless"),
            ("point-stick-slip", "V = 1, S = 1, Weightless"),
            ("point-frictionless", "V = 1, S = 1, Bare"),
            ("rod-on-floor", "V = 2, S = 1, Full"),
            ("slide", "V = 4, S = 1, Weightless"),
            ("burst", "V = 4, S = 1, Weightless"),
        ] {
            let model = SceneModel::smallest(&bundled(name));
            assert_eq!(model.to_string(), expected, "{name}");
        }
    }

    #[test]
    fn one_rough_surface_needs_friction() {
        let point = "[[0.0, 0.0]]";
        let smooth = SceneModel::smallest(&scene(point, 0.5, &[0.0, 0.0]));
        assert_eq!(smooth.to_string(), "V = 1, S = 2, Frictionless");
        let rough = scene(point, 0.5, &[0.0, 0.25]);
        let model = SceneModel::smallest(&rough);
        assert_eq!(model.to_string(), "V = 1, S = 2, Full");
        let reasons = SceneModel::reasons(&rough);
        assert_eq!(reasons[2], "friction: \"s1\" has mu_s = 0.25");
        assert_eq!(reasons[3..], ["weight: 0.5 N"]);
    }

    #[test]
    fn obstacles_are_in_the_model_of_a_scene_with_some() {
        for (name, expected) in [
            ("table-edge", "V = 4, S = 0, O = 1, C = 4, Full"),
            ("hook", "V = 4, S = 0, O = 2, C = 8, Full"),
        ] {
            let scene = bundled(name);
            assert_eq!(SceneModel::smallest(&scene).to_string(), expected, "{name}");
            let reasons = SceneModel::reasons(&scene).join("\n");
            assert!(reasons.contains("corners that touch"), "{reasons}");
        }
    }

    #[test]
    fn what_is_left_out_is_named() {
        let reasons = SceneModel::reasons(&scene("[[0.0, 0.0]]", 0.0, &[0.0])).join("\n");
        for part in [
            "no edge",
            "no two-vertex, corner and locked",
            "no friction",
            "no weight",
        ] {
            assert!(reasons.contains(part), "{part}: {reasons}");
        }
    }

    #[test]
    fn full_model_has_room_for_the_scene() {
        let small = SceneModel::smallest(&scene("[[0.0, 0.0]]", 0.0, &[0.0]));
        assert_eq!(small.full().to_string(), "V = 4, S = 2, Full");
        let large = SceneModel {
            vertices: 7,
            surfaces: 3,
            friction: false,
            weight: false,
            obstacles: ObstacleRoom::default(),
        };
        assert_eq!(large.full().to_string(), "V = 7, S = 3, Full");
    }
}
