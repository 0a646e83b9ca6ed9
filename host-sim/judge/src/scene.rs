//! The part of a scene file that a judge needs: body, springs, surfaces, obstacles, the initial holding point. SI units. `stiction-scene`
//! reads the file and checks its numbers; the hand's path is left to the program that runs the scene.

use stiction_scene::{InputError, Source, WrittenScene};
pub use stiction_scene::{ObstacleInfo as Obstacle, SurfaceInfo as Surface};

use crate::touch::Face;
use crate::vector::{Vec2, add, turned};

/// A scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Vertices of the body (m), body frame, counter-clockwise; 1: a point, 2: a rod.
    pub vertices: Vec<[f64; 2]>,
    /// The pose of the body before the first record: x, y (m), theta (rad) of the body frame in the world.
    pub start: [f64; 3],
    /// W (N), at the centroid, along world -y.
    pub weight: f64,
    /// The initial holding point g (m), body frame; `None`: taken from the hand at the grasp.
    pub holding_point: Option<[f64; 2]>,
    /// k_h (N/m)
    pub stiffness_translation: f64,
    /// k_theta (N·m/rad)
    pub stiffness_rotation: f64,
    /// The surfaces.
    pub surfaces: Vec<Surface>,
    /// The obstacles.
    pub obstacles: Vec<Obstacle>,
}

/// The properties of a surface that a contact needs.
pub(crate) const fn face(surface: &Surface) -> Face {
    Face {
        normal: surface.normal,
        friction_static: surface.friction_static,
        friction_dynamic: surface.friction_dynamic,
        memory: surface.memory,
    }
}

impl Scene {
    /// Reads a scene from text.
    ///
    /// # Errors
    /// The text is not TOML, or a key is unknown, missing, of the wrong type or out of range; only where the body starts is not checked.
    pub fn parse(source: Source) -> Result<Self, InputError> {
        let written = WrittenScene::parse(source, f64::MAX)?;
        written.check_numbers()?;
        Ok(Self::from(&written))
    }

    /// The position of a point of the body frame in the world, for a pose of the body.
    pub(crate) fn place(pose: [f64; 3], point: Vec2) -> Vec2 {
        add([pose[0], pose[1]], turned(point, pose[2]))
    }
}

impl From<&WrittenScene> for Scene {
    fn from(written: &WrittenScene) -> Self {
        Self {
            vertices: written.vertices.clone(),
            start: written.start,
            weight: written.weight,
            holding_point: written.holding_point,
            stiffness_translation: written.stiffness_translation,
            stiffness_rotation: written.stiffness_rotation,
            surfaces: written.surfaces.clone(),
            obstacles: written.obstacles.clone(),
        }
    }
}
