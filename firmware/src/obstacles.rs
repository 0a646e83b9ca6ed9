//! Obstacles as they were given, stored so that they can be changed.

use heapless::Vec;
use stiction_core::{Description, ObstacleDescription, SceneError, SurfaceDescription};
use stiction_wire::{ObstacleRow, Parameters, SceneCommand};

/// Obstacles as they were given, with room for C corners.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StoredObstacles<const C: usize> {
    corners: Vec<[f32; 2], C>,
    rows: Vec<ObstacleRow, C>,
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

impl<const C: usize> StoredObstacles<C> {
    /// Stores obstacles; `None` if there is no room for them.
    pub(crate) fn new(obstacles: &[ObstacleDescription<'_, f32>]) -> Option<Self> {
        let mut stored = Self {
            corners: Vec::new(),
            rows: Vec::new(),
        };
        for obstacle in obstacles {
            stored.corners.extend_from_slice(obstacle.vertices).ok()?;
            stored.rows.push(ObstacleRow::of(obstacle)).ok()?;
        }
        Some(stored)
    }

    /// Passes the stored obstacles to a function.
    pub(crate) fn with_given<T>(
        &self,
        look: impl FnOnce(&[ObstacleDescription<'_, f32>]) -> T,
    ) -> T {
        let mut rest = self.corners.as_slice();
        let mut obstacles: Vec<_, C> = Vec::new();
        for row in &self.rows {
            // The number of corners is the sum over the rows, and there is one row for each obstacle.
            let (vertices, after) = rest.split_at_checked(row.corners).unwrap_or((rest, &[]));
            rest = after;
            let _ = obstacles.push(row.described(vertices));
        }
        look(&obstacles)
    }

    /// Passes a scene that arrived over the wire to a function.
    ///
    /// # Errors
    /// There is no room for its vertices, surfaces or obstacles.
    pub(crate) fn with_received<T>(
        scene: &SceneCommand<'_>,
        vertices: &mut [[f32; 2]],
        surfaces: &mut [SurfaceDescription<f32>],
        take: impl FnOnce(&Description<'_, f32>) -> T,
    ) -> Result<T, SceneError<f32>> {
        let mut corners = [[0.0; 2]; C];
        let mut obstacles = [NO_OBSTACLE; C];
        let description = scene.description([vertices, &mut corners], surfaces, &mut obstacles)?;
        Ok(take(&description))
    }

    /// Friction and memory length of every obstacle.
    pub(crate) fn set_friction(&mut self, new: &Parameters) {
        for row in &mut self.rows {
            row.friction_static = new.friction_static;
            row.friction_dynamic = new.friction_dynamic;
            row.memory = new.memory;
        }
    }

    /// mu_s, mu_d and memory length of the first obstacle.
    pub(crate) fn first_friction(&self) -> Option<([f32; 2], Option<f32>)> {
        let first = self.rows.first()?;
        let coefficients = [first.friction_static, first.friction_dynamic];
        Some((coefficients, first.memory))
    }
}
