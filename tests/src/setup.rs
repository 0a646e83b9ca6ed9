//! A scene in f64, built in one expression, from which the scene of any number type is made.

use crate::number::Number;
use stiction_core::{Description, Model, Scene, SceneError, SurfaceDescription};

/// Capacity for vertices in the tests' scenes.
pub const VERTICES: usize = 64;
/// Capacity for surfaces in the tests' scenes.
pub const SURFACES: usize = 4;

/// The parameters of a scene, SI units; see [`Description`].
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// Body frame (m), counter-clockwise.
    pub vertices: Vec<[f64; 2]>,
    /// x, y (m), theta (rad).
    pub start: [f64; 3],
    /// W (N)
    pub weight: f64,
    /// g (m), body frame.
    pub holding_point: Option<[f64; 2]>,
    /// How far outside the body a hand may grasp (m).
    pub reach: f64,
    /// k_h (N/m)
    pub stiffness_translation: f64,
    /// k_theta (N·m/rad)
    pub stiffness_rotation: f64,
    /// The half-planes.
    pub surfaces: Vec<SurfaceDescription<f64>>,
}

impl Setup {
    /// A weightless body at the origin in empty space, held at its origin, both stiffnesses 1.
    pub fn new(vertices: &[[f64; 2]]) -> Self {
        Self {
            vertices: vertices.to_vec(),
            start: [0.0; 3],
            weight: 0.0,
            holding_point: Some([0.0; 2]),
            reach: 0.0,
            stiffness_translation: 1.0,
            stiffness_rotation: 1.0,
            surfaces: Vec::new(),
        }
    }
    /// A block with its origin at the middle of its bottom side: vertices from bottom left, counter-clockwise.
    pub fn block(width: f64, height: f64) -> Self {
        let half = width / 2.0;
        Self::new(&[[-half, 0.0], [half, 0.0], [half, height], [-half, height]])
    }
    /// A triangle that stands on its tip, vertex 0 at the origin.
    pub fn triangle() -> Self {
        Self::new(&[[0.0, 0.0], [0.5, 2.0], [-0.5, 2.0]])
    }
    /// A rod along the body's x axis, vertex 0 at the origin.
    pub fn rod(length: f64) -> Self {
        Self::new(&[[0.0, 0.0], [length, 0.0]])
    }
    /// A single point: the only body that, once pinned, can touch nothing else.
    pub fn point() -> Self {
        Self::new(&[[0.0, 0.0]])
    }
    /// The box of the benchmarks: 0.10 m × 0.06 m around its origin, held 20 mm above it, k_h 500, k_theta 0.5.
    pub fn bench_box() -> Self {
        Self::new(&[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]])
            .held_at([0.0, 0.02])
            .springs(500.0, 0.5)
    }
    /// Start pose x, y (m), theta (rad).
    #[must_use]
    pub fn at(self, start: [f64; 3]) -> Self {
        Self { start, ..self }
    }
    /// Starts turned by `theta`, with a vertex at a given position.
    #[must_use]
    pub fn standing(self, vertex: usize, place: [f64; 2], theta: f64) -> Self {
        let [x, y] = turned(self.vertices[vertex], theta);
        self.at([place[0] - x, place[1] - y, theta])
    }
    /// Held at a point of the body frame (m).
    #[must_use]
    pub fn held_at(self, point: [f64; 2]) -> Self {
        Self {
            holding_point: Some(point),
            ..self
        }
    }
    /// With the weight W (N).
    #[must_use]
    pub fn weighing(self, weight: f64) -> Self {
        Self { weight, ..self }
    }
    /// With k_h (N/m) and k_theta (N·m/rad).
    #[must_use]
    pub fn springs(self, translation: f64, rotation: f64) -> Self {
        Self {
            stiffness_translation: translation,
            stiffness_rotation: rotation,
            ..self
        }
    }
    /// Adds a surface: free side normal·p >= offset, friction \[mu_s, mu_d\].
    #[must_use]
    pub fn surface(mut self, normal: [f64; 2], offset: f64, friction: [f64; 2]) -> Self {
        self.surfaces.push(SurfaceDescription {
            normal,
            offset,
            friction_static: friction[0],
            friction_dynamic: friction[1],
            memory: None,
        });
        self
    }
    /// A floor at y = 0, friction \[mu_s, mu_d\].
    #[must_use]
    pub fn floor(self, friction: [f64; 2]) -> Self {
        self.surface([0.0, 1.0], 0.0, friction)
    }
    /// A wall at `x` that faces -x, friction \[mu_s, mu_d\].
    #[must_use]
    pub fn wall(self, x: f64, friction: [f64; 2]) -> Self {
        self.surface([-1.0, 0.0], -x, friction)
    }

    /// With a memory length (m) on every surface.
    #[must_use]
    pub fn remembering(mut self, memory: f64) -> Self {
        for surface in &mut self.surfaces {
            surface.memory = Some(memory);
        }
        self
    }

    /// Without friction anywhere.
    #[must_use]
    pub fn smooth(mut self) -> Self {
        for surface in &mut self.surfaces {
            (surface.friction_static, surface.friction_dynamic) = (0.0, 0.0);
        }
        self
    }

    /// G at the start: the point at which the hand's position spring is at rest.
    pub fn grip(&self) -> [f64; 2] {
        self.world(self.start, self.holding_point.unwrap_or_default())
    }
    /// A point of the body frame in the world frame, for a body pose.
    pub fn world(&self, [x, y, theta]: [f64; 3], point: [f64; 2]) -> [f64; 2] {
        let [dx, dy] = turned(point, theta);
        [x + dx, y + dy]
    }
    /// L (m): the largest vertex distance; 1 for a point.
    pub fn size(&self) -> f64 {
        let distance = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let pairs = self
            .vertices
            .iter()
            .flat_map(|a| self.vertices.iter().map(move |b| distance(a, b)));
        let largest = pairs.fold(0.0, f64::max);
        if largest > 0.0 { largest } else { 1.0 }
    }
    /// The scene with every number rounded to type `R`.
    #[must_use]
    pub fn rounded<R: Number>(&self) -> Self {
        let pair = |p: [f64; 2]| p.map(R::rounded);
        Self {
            vertices: self.vertices.iter().map(|&v| pair(v)).collect(),
            start: self.start.map(R::rounded),
            weight: R::rounded(self.weight),
            holding_point: self.holding_point.map(pair),
            reach: R::rounded(self.reach),
            stiffness_translation: R::rounded(self.stiffness_translation),
            stiffness_rotation: R::rounded(self.stiffness_rotation),
            surfaces: self.surfaces.iter().map(rounded_surface::<R>).collect(),
        }
    }
    /// The scene of a number type, with capacity for any of the tests' scenes.
    ///
    /// # Errors
    /// The scene is refused by [`Scene::new`].
    pub fn scene<R: Number>(&self) -> Result<Scene<R, VERTICES, SURFACES>, SceneError<R::Si>> {
        self.scene_of()
    }
    /// The scene of a number type, capacity and model.
    ///
    /// # Errors
    /// The scene is refused by [`Scene::new`].
    pub fn scene_of<R: Number, const V: usize, const S: usize, M: Model>(
        &self,
    ) -> Result<Scene<R, V, S, M>, SceneError<R::Si>> {
        self.described::<R, _>(|description| Scene::new(description))
    }
    /// The description in the float of a number type.
    pub fn described<R: Number, T>(&self, take: impl FnOnce(&Description<'_, R::Si>) -> T) -> T {
        let pair = |p: [f64; 2]| p.map(R::si);
        let vertices: Vec<_> = self.vertices.iter().map(|&v| pair(v)).collect();
        let surface = |s: &SurfaceDescription<f64>| SurfaceDescription {
            normal: pair(s.normal),
            offset: R::si(s.offset),
            friction_static: R::si(s.friction_static),
            friction_dynamic: R::si(s.friction_dynamic),
            memory: s.memory.map(R::si),
        };
        let surfaces: Vec<_> = self.surfaces.iter().map(surface).collect();
        take(&Description {
            vertices: &vertices,
            start: self.start.map(R::si),
            weight: R::si(self.weight),
            holding_point: self.holding_point.map(pair),
            reach: R::si(self.reach),
            stiffness_translation: R::si(self.stiffness_translation),
            stiffness_rotation: R::si(self.stiffness_rotation),
            surfaces: &surfaces,
            obstacles: &[],
        })
    }
}

fn turned([x, y]: [f64; 2], theta: f64) -> [f64; 2] {
    let (sin, cos) = theta.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

fn rounded_surface<R: Number>(s: &SurfaceDescription<f64>) -> SurfaceDescription<f64> {
    SurfaceDescription {
        normal: s.normal.map(R::rounded),
        offset: R::rounded(s.offset),
        friction_static: R::rounded(s.friction_static),
        friction_dynamic: R::rounded(s.friction_dynamic),
        memory: s.memory.map(R::rounded),
    }
}
