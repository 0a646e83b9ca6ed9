//! A scene among obstacles in f64, from which the scenes of any number type and of the reference are built, and the
//! scene file.

use super::shape::{Point, dot, length, placed, separation};
use crate::laws::scene;
use crate::number::Number;
use crate::reference::{self, Touch};
use crate::setup::Setup;
use std::fmt::Write;
use stiction_core::{
    Description, ObstacleDescription, SceneError, SurfaceDescription, WithObstacles,
};

/// Capacity for vertices of the body.
pub const VERTICES: usize = 8;
/// Capacity for half-planes.
pub const SURFACES: usize = 4;
/// Capacity for obstacles.
pub const OBSTACLES: usize = 12;
/// Capacity for their corners.
pub const CORNERS: usize = 48;

/// The model of these scenes.
pub type Model = WithObstacles<OBSTACLES, CORNERS>;
/// The scene of a number type.
pub type Scene<R> = stiction_core::Scene<R, VERTICES, SURFACES, Model>;

/// An obstacle, SI units, world frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Its corners (m), counter-clockwise: two for a thin wall, one for a pin.
    pub vertices: Vec<Point>,
    /// mu_s and mu_d.
    pub friction: [f64; 2],
}

/// A scene with obstacles; the half-planes are those of the setup.
#[derive(Clone, Debug, PartialEq)]
pub struct Among {
    /// Body, hand, half-planes.
    pub setup: Setup,
    /// The obstacles.
    pub obstacles: Vec<Obstacle>,
}

/// The largest coordinate of a corner (m) in a number type that represents up to `farthest` body sizes, for a body of `size`: the solver
/// bounds the length of a vector by its larger coordinate plus half the other.
pub fn farthest_corner(farthest: f64, size: f64) -> f64 {
    farthest * size / 1.5
}

impl Among {
    /// mu_s and mu_d of a contact.
    pub fn friction(&self, touch: Touch) -> [f64; 2] {
        match touch {
            Touch::Surface { surface, .. } => {
                let surface = &self.setup.surfaces[surface];
                [surface.friction_static, surface.friction_dynamic]
            }
            Touch::Side { obstacle, .. } | Touch::Corner { obstacle, .. } => {
                self.obstacles[obstacle].friction
            }
        }
    }

    /// The scene of a number type.
    ///
    /// # Errors
    /// The scene is refused by the solver.
    pub fn scene<R: Number>(&self) -> Result<Scene<R>, SceneError<R::Si>> {
        self.described::<R, _>(|description| Scene::new(description))
    }

    /// What is made of the description in a number type.
    pub fn described<R: Number, T>(&self, take: impl FnOnce(&Description<'_, R::Si>) -> T) -> T {
        let all = |points: &[Point]| points.iter().map(|p| p.map(R::si)).collect::<Vec<_>>();
        let corners: Vec<_> = self.obstacles.iter().map(|o| all(&o.vertices)).collect();
        let obstacle = |(o, vertices): (&Obstacle, _)| {
            let [friction_static, friction_dynamic] = o.friction.map(R::si);
            ObstacleDescription {
                vertices,
                friction_static,
                friction_dynamic,
                memory: None,
            }
        };
        let corners = corners.iter().map(Vec::as_slice);
        let obstacles: Vec<_> = self.obstacles.iter().zip(corners).map(obstacle).collect();
        (self.setup).described::<R, _>(|description| {
            take(&Description {
                obstacles: &obstacles,
                ..*description
            })
        })
    }

    /// The scene of the judge, as the number type rounds it.
    pub fn judged<R: Number>(&self) -> stiction_judge::Scene {
        let Self { setup, obstacles } = self.rounded::<R>();
        let obstacle = |(i, o): (usize, Obstacle)| stiction_judge::Obstacle {
            name: i.to_string(),
            vertices: o.vertices,
            friction_static: o.friction[0],
            friction_dynamic: o.friction[1],
            memory: None,
        };
        stiction_judge::Scene {
            obstacles: obstacles.into_iter().enumerate().map(obstacle).collect(),
            ..scene::<R>(&setup)
        }
    }

    /// The depth of the body in any obstacle or half-plane at a pose (m); negative if it is clear of all.
    pub fn depth(&self, pose: [f64; 3]) -> f64 {
        let body = placed(&self.setup.vertices, pose);
        let obstacles = self
            .obstacles
            .iter()
            .map(|o| -separation(&body, &o.vertices));
        let surfaces = self.setup.surfaces.iter().map(|s| {
            let long = length(s.normal);
            let gaps = body.iter().map(|&p| dot(s.normal, p) / long);
            s.offset / long - gaps.fold(f64::INFINITY, f64::min)
        });
        obstacles.chain(surfaces).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The scene with no obstacle farther out than the number type can represent: each coordinate is clamped, so that a box along the
    /// axes remains a box.
    #[must_use]
    pub fn within<R: Number>(&self) -> Self {
        let farthest = farthest_corner(R::FARTHEST, self.setup.size());
        let mut cut = self.clone();
        for at in cut.obstacles.iter_mut().flat_map(|o| &mut o.vertices) {
            *at = at.map(|x| x.clamp(-farthest, farthest));
        }
        cut
    }

    /// The scene with every number rounded to type `R`.
    #[must_use]
    pub fn rounded<R: Number>(&self) -> Self {
        let obstacle = |o: &Obstacle| Obstacle {
            vertices: o.vertices.iter().map(|p| p.map(R::rounded)).collect(),
            friction: o.friction.map(R::rounded),
        };
        Self {
            setup: self.setup.rounded::<R>(),
            obstacles: self.obstacles.iter().map(obstacle).collect(),
        }
    }

    /// The scene of the slow reference.
    pub fn reference(&self) -> reference::Scene {
        let setup = &self.setup;
        let default = setup.size() / 4096.0;
        let surface = |s: &SurfaceDescription<f64>| {
            let [x, y] = s.normal;
            let long = x.hypot(y);
            reference::Surface {
                normal: [x / long, y / long],
                offset: s.offset,
                mu_s: s.friction_static,
                mu_d: s.friction_dynamic,
                memory: s.memory.unwrap_or(default),
            }
        };
        let obstacle = |o: &Obstacle| reference::Obstacle {
            vertices: o.vertices.clone(),
            mu_s: o.friction[0],
            mu_d: o.friction[1],
            memory: default,
        };
        reference::Scene {
            vertices: setup.vertices.clone(),
            holding_point: setup.holding_point.unwrap_or_default(),
            k_h: setup.stiffness_translation,
            k_theta: setup.stiffness_rotation,
            weight: setup.weight,
            surfaces: setup.surfaces.iter().map(surface).collect(),
            obstacles: self.obstacles.iter().map(obstacle).collect(),
        }
    }

    /// As a scene file, with the keyframes of the hand: t (s), x, y (m), phi (rad).
    pub fn toml(&self, keyframes: &[[f64; 4]], rate: f64) -> String {
        let setup = &self.setup;
        let mut text = format!(
            "[body]\nvertices = {:?}\nstart = {:?}\nweight = {:?}\n\n[grasp]\npoint = {:?}\n\n\
             [spring]\ntranslation = {:?}\nrotation = {:?}\n\n[friction]\nstatic = 0.0\ndynamic = 0.0\n",
            setup.vertices,
            setup.start,
            setup.weight,
            setup.holding_point.unwrap_or_default(),
            setup.stiffness_translation,
            setup.stiffness_rotation,
        );
        for (i, s) in setup.surfaces.iter().enumerate() {
            let (mu_s, mu_d) = (s.friction_static, s.friction_dynamic);
            let (normal, offset) = (s.normal, s.offset);
            let _ = write!(
                text,
                "\n[[surface]]\nname = \"s{i}\"\nnormal = {normal:?}\noffset = {offset:?}\nstatic = {mu_s:?}\ndynamic = {mu_d:?}\n"
            );
        }
        for (i, o) in self.obstacles.iter().enumerate() {
            let ([mu_s, mu_d], corners) = (o.friction, &o.vertices);
            let _ = write!(
                text,
                "\n[[obstacle]]\nname = \"o{i}\"\nvertices = {corners:?}\nstatic = {mu_s:?}\ndynamic = {mu_d:?}\n"
            );
        }
        let _ = write!(text, "\n[hand]\nrate = {rate:?}\nkeyframes = [\n");
        for keyframe in keyframes {
            let _ = writeln!(text, "  {keyframe:?},");
        }
        text + "]\n"
    }
}
