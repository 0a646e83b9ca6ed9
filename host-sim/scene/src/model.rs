//! The model of the solver that a scene needs: from a scene file to the room for vertices and surfaces, whether there is
//! friction and weight, and why. What the model lacks is not in the binary.

use std::fmt;

use crate::surface::SurfaceInfo;
use crate::written::WrittenScene;

/// The V, S and M of a `Solver<R, V, S, M>`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneModel {
    /// V: room for so many vertices.
    pub vertices: usize,
    /// S: room for so many surfaces.
    pub surfaces: usize,
    /// Sticking and slipping.
    pub friction: bool,
    /// The body's weight.
    pub weight: bool,
}

impl SceneModel {
    /// The smallest model in which a scene runs.
    pub fn smallest(scene: &WrittenScene) -> Self {
        Self {
            vertices: scene.vertices.len(),
            surfaces: scene.surfaces.len(),
            friction: scene.surfaces.iter().any(is_rough),
            weight: scene.weight > 0.0,
        }
    }

    /// Every part of the solver: friction, weight, room for at least 4 vertices and 2 surfaces.
    #[must_use]
    pub fn full(self) -> Self {
        self.with(Self {
            vertices: 4,
            surfaces: 2,
            friction: true,
            weight: true,
        })
    }

    /// What either of two models has.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self {
            vertices: self.vertices.max(other.vertices),
            surfaces: self.surfaces.max(other.surfaces),
            friction: self.friction || other.friction,
            weight: self.weight || other.weight,
        }
    }

    /// The name of M in `stiction-core`.
    pub const fn name(self) -> &'static str {
        match (self.friction, self.weight) {
            (true, true) => "Full",
            (true, false) => "Weightless",
            (false, true) => "Frictionless",
            (false, false) => "Bare",
        }
    }

    /// Why the smallest model of a scene has what it has, part by part: V, S, friction, weight.
    pub fn reasons(scene: &WrittenScene) -> [String; 4] {
        let model = Self::smallest(scene);
        [
            format!("V = {}: {}", model.vertices, vertices(model.vertices)),
            format!("S = {}: {}", model.surfaces, surfaces(model)),
            friction(scene),
            if model.weight {
                format!("weight: {} N", scene.weight)
            } else {
                "no weight: it is 0".to_owned()
            },
        ]
    }
}

impl fmt::Display for SceneModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (vertices, surfaces, name) = (self.vertices, self.surfaces, self.name());
        write!(f, "V = {vertices}, S = {surfaces}, {name}")
    }
}

fn is_rough(surface: &SurfaceInfo) -> bool {
    surface.friction_static > 0.0
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
        (_, 0) => "there is nothing to touch",
        (_, 1) => "there is no second surface, so no two-vertex, corner and locked state",
        (1, _) => "the point can touch two surfaces, in a corner",
        _ => "the body can touch two surfaces, in the two-vertex, corner and locked states",
    }
}

fn friction(scene: &WrittenScene) -> String {
    let rough = scene.surfaces.iter().filter(|surface| is_rough(surface));
    let rough: Vec<String> = rough
        .map(|surface| format!("{:?} has mu_s = {}", surface.name, surface.friction_static))
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

    /// A scene of these vertices, weight and mu_s of each surface.
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
        let [.., friction, weight] = SceneModel::reasons(&rough);
        assert_eq!(friction, "friction: \"s1\" has mu_s = 0.25");
        assert_eq!(weight, "weight: 0.5 N");
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
        };
        assert_eq!(large.full().to_string(), "V = 7, S = 3, Full");
    }
}
