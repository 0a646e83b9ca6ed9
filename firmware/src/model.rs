//! The model of a board's solver: its room for obstacles, and what stores obstacles as they were given.

use core::fmt::Debug;
use heapless::Vec;
use stiction_core::{
    Description, Model, ObstacleDescription, Parts, SceneError, SurfaceDescription, WithObstacles,
};
use stiction_wire::{Parameters, SceneCommand};

/// The model of a board's solver.
pub trait BoardModel: Model {
    /// The maximum number of obstacles.
    const OBSTACLES: usize;
    /// The maximum number of their corners together.
    const CORNERS: usize;
    /// The obstacles of a scene, stored with all that they refer to.
    type Stored: StoreObstacles;
}

impl<const FRICTION: bool, const WEIGHT: bool> BoardModel for Parts<FRICTION, WEIGHT> {
    const OBSTACLES: usize = 0;
    const CORNERS: usize = 0;
    type Stored = StoredObstacles<0, 0>;
}

impl<const O: usize, const C: usize, M: Model> BoardModel for WithObstacles<O, C, M> {
    const OBSTACLES: usize = O;
    const CORNERS: usize = C;
    type Stored = StoredObstacles<O, C>;
}

/// A store of obstacles.
pub trait StoreObstacles: Clone + Debug + PartialEq {
    /// Stores obstacles; `None` if there is no room for them.
    fn new(obstacles: &[ObstacleDescription<'_, f32>]) -> Option<Self>;

    /// Passes the stored obstacles to a function.
    fn with_given<T>(&self, look: impl FnOnce(&[ObstacleDescription<'_, f32>]) -> T) -> T;

    /// Passes a scene that arrived over the wire to a function.
    ///
    /// # Errors
    /// There is no room for its vertices, surfaces or obstacles.
    fn with_received<T>(
        scene: &SceneCommand<'_>,
        vertices: &mut [[f32; 2]],
        surfaces: &mut [SurfaceDescription<f32>],
        take: impl FnOnce(&Description<'_, f32>) -> T,
    ) -> Result<T, SceneError<f32>>;

    /// Friction and memory length of every obstacle.
    fn set_friction(&mut self, new: &Parameters);

    /// mu_s, mu_d and memory length of the first obstacle.
    fn first_friction(&self) -> Option<([f32; 2], Option<f32>)>;
}

/// Obstacles as they were given, with room for O of them and C corners.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredObstacles<const O: usize, const C: usize> {
    corners: Vec<[f32; 2], C>,
    rows: Vec<Row, O>,
}

/// An obstacle without its corners, of which it has `corners`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Row {
    corners: usize,
    friction_static: f32,
    friction_dynamic: f32,
    memory: Option<f32>,
}

/// A place for a surface that is to be received.
pub(crate) const NOWHERE: SurfaceDescription<f32> = SurfaceDescription {
    normal: [0.0, 1.0],
    offset: 0.0,
    friction_static: 0.0,
    friction_dynamic: 0.0,
    memory: None,
};

const NO_OBSTACLE: ObstacleDescription<'static, f32> = ObstacleDescription {
    vertices: &[],
    friction_static: 0.0,
    friction_dynamic: 0.0,
    memory: None,
};

impl<const O: usize, const C: usize> StoreObstacles for StoredObstacles<O, C> {
    fn new(obstacles: &[ObstacleDescription<'_, f32>]) -> Option<Self> {
        let mut stored = Self {
            corners: Vec::new(),
            rows: Vec::new(),
        };
        for obstacle in obstacles {
            stored.corners.extend_from_slice(obstacle.vertices).ok()?;
            let row = Row {
                corners: obstacle.vertices.len(),
                friction_static: obstacle.friction_static,
                friction_dynamic: obstacle.friction_dynamic,
                memory: obstacle.memory,
            };
            stored.rows.push(row).ok()?;
        }
        Some(stored)
    }

    fn with_given<T>(&self, look: impl FnOnce(&[ObstacleDescription<'_, f32>]) -> T) -> T {
        let mut rest = self.corners.as_slice();
        let mut obstacles: Vec<_, O> = Vec::new();
        for row in &self.rows {
            // The number of corners is the sum over the rows, and there is one row for each obstacle.
            let (vertices, after) = rest.split_at_checked(row.corners).unwrap_or((rest, &[]));
            rest = after;
            let _ = obstacles.push(ObstacleDescription {
                vertices,
                friction_static: row.friction_static,
                friction_dynamic: row.friction_dynamic,
                memory: row.memory,
            });
        }
        look(&obstacles)
    }

    fn with_received<T>(
        scene: &SceneCommand<'_>,
        vertices: &mut [[f32; 2]],
        surfaces: &mut [SurfaceDescription<f32>],
        take: impl FnOnce(&Description<'_, f32>) -> T,
    ) -> Result<T, SceneError<f32>> {
        let mut corners = [[0.0; 2]; C];
        let mut obstacles = [NO_OBSTACLE; O];
        let description = scene.description([vertices, &mut corners], surfaces, &mut obstacles)?;
        Ok(take(&description))
    }

    fn set_friction(&mut self, new: &Parameters) {
        for row in &mut self.rows {
            row.friction_static = new.friction_static;
            row.friction_dynamic = new.friction_dynamic;
            row.memory = new.memory;
        }
    }

    fn first_friction(&self) -> Option<([f32; 2], Option<f32>)> {
        let first = self.rows.first()?;
        let coefficients = [first.friction_static, first.friction_dynamic];
        Some((coefficients, first.memory))
    }
}
