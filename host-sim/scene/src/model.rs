//! The model of the solver that a scene needs: from a scene file to the capacities for vertices, surfaces and corners of obstacles, and the
//! reasons. What no scene of these capacities needs is not in the binary.

use std::fmt;

use crate::written::WrittenScene;

/// The V, S and C of a `Solver<R, V, S, C>`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneModel {
    /// V: capacity for vertices.
    pub vertices: usize,
    /// S: capacity for surfaces.
    pub surfaces: usize,
    /// C: capacity for the corners of all obstacles together; if there is none, the solver contains no code for obstacles.
    pub corners: usize,
}

impl SceneModel {
    /// Capacity for most scenes that arrive over the wire.
    pub const BOARD: Self = Self {
        vertices: 8,
        surfaces: 4,
        corners: 16,
    };

    /// The smallest model in which a scene runs.
    pub fn smallest(scene: &WrittenScene) -> Self {
        Self {
            vertices: scene.vertices.len(),
            surfaces: scene.surfaces.len(),
            corners: scene.obstacles.iter().map(|o| o.vertices.len()).sum(),
        }
    }

    /// Capacity for at least 4 vertices and 2 surfaces; that for corners unchanged.
    #[must_use]
    pub fn full(self) -> Self {
        self.with(Self {
            vertices: 4,
            surfaces: 2,
            corners: 0,
        })
    }

    /// The capacities that either of two models has.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self {
            vertices: self.vertices.max(other.vertices),
            surfaces: self.surfaces.max(other.surfaces),
            corners: self.corners.max(other.corners),
        }
    }

    /// The reasons for each capacity of a scene's smallest model: V, S, and C if there are obstacles.
    pub fn reasons(scene: &WrittenScene) -> Vec<String> {
        let model = Self::smallest(scene);
        let corners = model.corners;
        let obstacles = (corners > 0).then(|| {
            format!("C = {corners}: obstacles whose sides end, and corners that touch the body")
        });
        let parts = [
            format!("V = {}: {}", model.vertices, vertices(model.vertices)),
            format!("S = {}: {}", model.surfaces, surfaces(model)),
        ];
        parts.into_iter().chain(obstacles).collect()
    }
}

impl fmt::Display for SceneModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (vertices, surfaces) = (self.vertices, self.surfaces);
        write!(f, "V = {vertices}, S = {surfaces}")?;
        match self.corners {
            0 => Ok(()),
            corners => write!(f, ", C = {corners}"),
        }
    }
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
        (_, 0 | 1) if model.corners > 0 => "the body can also touch obstacles",
        (_, 0) => "there is nothing to touch",
        (_, 1) => "there is no second surface, so no two-vertex, corner and locked state",
        (1, _) => "the point can touch two surfaces, in a corner",
        _ => "the body can touch two surfaces, in the two-vertex, corner and locked states",
    }
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
            ("vertex-stick-slip", "V = 4, S = 1"),
            ("box-flat", "V = 4, S = 1"),
            ("corner-stick-slip", "V = 4, S = 2"),
            ("ladder", "V = 2, S = 2"),
            ("snap", "V = 3, S = 1"),
            ("point-stick-slip", "V = 1, S = 1"),
            ("point-frictionless", "V = 1, S = 1"),
            ("rod-on-floor", "V = 2, S = 1"),
            ("slide", "V = 4, S = 1"),
            ("burst", "V = 4, S = 1"),
        ] {
            let model = SceneModel::smallest(&bundled(name));
            assert_eq!(model.to_string(), expected, "{name}");
        }
    }

    #[test]
    fn obstacles_are_in_the_model_of_a_scene_with_some() {
        for (name, expected) in [
            ("table-edge", "V = 4, S = 0, C = 4"),
            ("hook", "V = 4, S = 0, C = 8"),
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
        for part in ["no edge", "no two-vertex, corner and locked"] {
            assert!(reasons.contains(part), "{part}: {reasons}");
        }
    }

    #[test]
    fn full_model_has_room_for_the_scene() {
        let small = SceneModel::smallest(&scene("[[0.0, 0.0]]", 0.0, &[0.0]));
        assert_eq!(small.full().to_string(), "V = 4, S = 2");
        let large = SceneModel {
            vertices: 7,
            surfaces: 3,
            corners: 0,
        };
        assert_eq!(large.full().to_string(), "V = 7, S = 3");
    }
}
