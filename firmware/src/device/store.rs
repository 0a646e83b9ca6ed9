//! The scene as it is given, stored so that it can be changed: the input of [`stiction_core::Scene`].

use heapless::Vec;
use stiction_core::{Description, SurfaceDescription};

use crate::model::BoardModel;

/// A scene as it is given, SI units.
#[derive(Debug)]
pub(super) struct Described<'d, 'o, M: BoardModel> {
    pub(super) description: &'d Description<'d, f32>,
    pub(super) obstacles: M::Surroundings<'o>,
}

impl<M: BoardModel> Clone for Described<'_, '_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: BoardModel> Copy for Described<'_, '_, M> {}

/// A scene with room for V vertices and S surfaces, SI units.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Store<const V: usize, const S: usize, M: BoardModel> {
    vertices: Vec<[f32; 2], V>,
    pub(super) surfaces: Vec<SurfaceDescription<f32>, S>,
    pub(super) start: [f32; 3],
    pub(super) weight: f32,
    pub(super) holding_point: Option<[f32; 2]>,
    pub(super) reach: f32,
    pub(super) stiffness_translation: f32,
    pub(super) stiffness_rotation: f32,
    pub(super) obstacles: M::Stored,
}

impl<const V: usize, const S: usize, M: BoardModel> Store<V, S, M> {
    /// Stores a scene; `None` if it has more than there is room for.
    pub(super) fn new(given: Described<'_, '_, M>) -> Option<Self> {
        let d = given.description;
        Some(Self {
            vertices: Vec::from_slice(d.vertices).ok()?,
            surfaces: Vec::from_slice(d.surfaces).ok()?,
            start: d.start,
            weight: d.weight,
            holding_point: d.holding_point,
            reach: d.reach,
            stiffness_translation: d.stiffness_translation,
            stiffness_rotation: d.stiffness_rotation,
            obstacles: M::keep(given.obstacles)?,
        })
    }

    /// Passes the stored scene, in its original form, to a function.
    pub(super) fn with_given<T>(&self, look: impl FnOnce(Described<'_, '_, M>) -> T) -> T {
        let description = &self.description();
        M::with_stored(&self.obstacles, |obstacles| {
            look(Described {
                description,
                obstacles,
            })
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
