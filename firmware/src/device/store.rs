//! The scene as it was given: what [`stiction_core::Scene`] was made of, kept so that it can be changed.

use heapless::Vec;
use stiction_core::{Description, SurfaceDescription};

/// A scene with room for V vertices and S surfaces, SI units.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Store<const V: usize, const S: usize> {
    vertices: Vec<[f32; 2], V>,
    pub(super) surfaces: Vec<SurfaceDescription<f32>, S>,
    pub(super) start: [f32; 3],
    pub(super) weight: f32,
    pub(super) holding_point: Option<[f32; 2]>,
    pub(super) reach: f32,
    pub(super) stiffness_translation: f32,
    pub(super) stiffness_rotation: f32,
}

impl<const V: usize, const S: usize> Store<V, S> {
    /// Keeps a description; `None` where it has more vertices or surfaces than there is room for.
    pub(super) fn new(description: &Description<'_, f32>) -> Option<Self> {
        let d = description;
        Some(Self {
            vertices: Vec::from_slice(d.vertices).ok()?,
            surfaces: Vec::from_slice(d.surfaces).ok()?,
            start: d.start,
            weight: d.weight,
            holding_point: d.holding_point,
            reach: d.reach,
            stiffness_translation: d.stiffness_translation,
            stiffness_rotation: d.stiffness_rotation,
        })
    }

    pub(super) fn description(&self) -> Description<'_, f32> {
        Description {
            vertices: &self.vertices,
            start: self.start,
            weight: self.weight,
            holding_point: self.holding_point,
            reach: self.reach,
            stiffness_translation: self.stiffness_translation,
            stiffness_rotation: self.stiffness_rotation,
            surfaces: &self.surfaces,
        }
    }
}
