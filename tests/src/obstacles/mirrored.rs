//! A scene and the hand's path seen in a mirror, x to -x: the answers are mirror images, too.

use super::scene::{Among, Obstacle};
use super::worlds::World;
use crate::setup::Setup;
use stiction_core::SurfaceDescription;

/// A place in the mirror.
fn place([x, y]: [f64; 2]) -> [f64; 2] {
    [-x, y]
}

/// A pose x, y (m), theta (rad) in the mirror.
pub fn pose([x, y, angle]: [f64; 3]) -> [f64; 3] {
    [-x, y, -angle]
}

/// Corners in the mirror, counter-clockwise again.
fn shape(corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
    corners.iter().rev().copied().map(place).collect()
}

impl World {
    /// This world in the mirror.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let Among { setup, obstacles } = &self.among;
        let surface = |surface: &SurfaceDescription<f64>| SurfaceDescription {
            normal: place(surface.normal),
            ..*surface
        };
        let obstacle = |obstacle: &Obstacle| Obstacle {
            vertices: shape(&obstacle.vertices),
            friction: obstacle.friction,
        };
        let setup = Setup {
            vertices: shape(&setup.vertices),
            start: pose(setup.start),
            holding_point: setup.holding_point.map(place),
            surfaces: setup.surfaces.iter().map(surface).collect(),
            ..setup.clone()
        };
        let keyframes = self.keyframes.iter();
        Self {
            among: Among {
                setup,
                obstacles: obstacles.iter().map(obstacle).collect(),
            },
            keyframes: keyframes
                .map(|&(frame, hand)| (frame, pose(hand)))
                .collect(),
            room: self.room.as_deref().map(shape),
        }
    }
}
