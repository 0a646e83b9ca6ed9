//! The scene as it is given, stored so that it can be changed: the input of [`stiction_core::Scene`].

use heapless::Vec;
use stiction_core::{Description, SurfaceDescription};

use crate::obstacles::StoredObstacles;

/// A scene with room for V vertices and S surfaces, SI units.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Store<const V: usize, const S: usize, const C: usize> {
    vertices: Vec<[f32; 2], V>,
    pub(super) surfaces: Vec<SurfaceDescription<f32>, S>,
    pub(super) start: [f32; 3],
    pub(super) weight: f32,
    pub(super) holding_point: Option<[f32; 2]>,
    pub(super) reach: f32,
    pub(super) stiffness_translation: f32,
    pub(super) stiffness_rotation: f32,
    pub(super) obstacles: StoredObstacles<C>,
}

impl<const V: usize, const S: usize, const C: usize> Store<V, S, C> {
    /// Stores a scene; `None` if it has more than there is room for.
    pub(super) fn new(d: &Description<'_, f32>) -> Option<Self> {
        Some(Self {
            vertices: Vec::from_slice(d.vertices).ok()?,
            surfaces: Vec::from_slice(d.surfaces).ok()?,
            start: d.start,
            weight: d.weight,
            holding_point: d.holding_point,
            reach: d.reach,
            stiffness_translation: d.stiffness_translation,
            stiffness_rotation: d.stiffness_rotation,
            obstacles: StoredObstacles::<C>::new(d.obstacles)?,
        })
    }

    /// Passes the stored scene, in its original form, to a function.
    pub(super) fn with_given<T>(&self, look: impl FnOnce(&Description<'_, f32>) -> T) -> T {
        self.obstacles.with_given(|obstacles| {
            look(&Description {
                vertices: &self.vertices,
                start: self.start,
                weight: self.weight,
                holding_point: self.holding_point,
                reach: self.reach,
                stiffness_translation: self.stiffness_translation,
                stiffness_rotation: self.stiffness_rotation,
                surfaces: &self.surfaces,
                obstacles,
            })
        })
    }

    /// k_h (N/m) and k_theta (N·m/rad).
    pub(crate) fn stiffness(&self) -> [f32; 2] {
        [self.stiffness_translation, self.stiffness_rotation]
    }

    /// mu_s, mu_d and memory length of the first surface, or else of the first obstacle.
    pub(crate) fn first_friction(&self) -> Option<([f32; 2], Option<f32>)> {
        let of_surface = |s: &SurfaceDescription<f32>| {
            let coefficients = [s.friction_static, s.friction_dynamic];
            (coefficients, s.memory)
        };
        let first = self.surfaces.first().map(of_surface);
        first.or_else(|| self.obstacles.first_friction())
    }
}
