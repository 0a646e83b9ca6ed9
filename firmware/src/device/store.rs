//! The scene as it is given, stored so that it can be changed: the input of [`stiction_core::Scene`].

use heapless::Vec;
use stiction_core::{Description, Real, SurfaceDescription};

use super::controller::Pose;
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

    /// The height of the body's centroid (m). That is computed here, as no other turn needs it.
    pub(super) fn height(&self, body: &Pose) -> f32 {
        let ([x, y], (sin, cos)) = (centroid(&self.vertices), Real::sin_cos(body.angle.rest));
        let [_, above] = body.position;
        above + sin * x + cos * y
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

/// The centroid of a convex polygon (m); of a rod or a point, its middle.
fn centroid(vertices: &[[f32; 2]]) -> [f32; 2] {
    let Some(&[x0, y0]) = vertices.first() else {
        return [0.0; 2];
    };
    let (mut area, mut sum, mut way) = (0.0, [0.0; 2], [0.0; 2]);
    for (&[ax, ay], &[bx, by]) in vertices.iter().zip(vertices.iter().skip(1)) {
        let [[ax, ay], [bx, by]] = [[ax - x0, ay - y0], [bx - x0, by - y0]];
        let twice = ax * by - ay * bx;
        area += twice;
        let [x, y] = sum;
        sum = [x + twice * (ax + bx), y + twice * (ay + by)];
        way = [bx, by];
    }
    let ([x, y], [rx, ry]) = (sum, way);
    match area > 0.0 {
        true => [x0 + x / (3.0 * area), y0 + y / (3.0 * area)],
        false => [x0 + rx / 2.0, y0 + ry / 2.0],
    }
}
