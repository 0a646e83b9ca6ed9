//! Random obstacles, and what touches them.

use super::Random;
use stiction_core::{ObstacleDescription, Parameter, Touch};

impl Random {
    /// What a refusal of an obstacle is about.
    pub(super) fn parameter(&mut self) -> Parameter {
        let (obstacle, index) = (self.below(256), self.below(256));
        self.one(&[
            Parameter::ObstacleCount,
            Parameter::CornerCount,
            Parameter::Corners(obstacle),
            Parameter::Corner {
                obstacle,
                corner: index,
            },
            Parameter::Side {
                obstacle,
                side: index,
            },
            Parameter::ObstacleFrictionStatic(obstacle),
            Parameter::ObstacleFrictionDynamic(obstacle),
            Parameter::ObstacleMemory(obstacle),
            Parameter::Overlap(obstacle),
        ])
    }
    pub(super) fn touch(&mut self) -> Touch {
        let (on_body, obstacle, index) = (self.below(128), self.below(255), self.below(256));
        self.one(&[
            Touch::Surface {
                vertex: on_body,
                surface: index,
            },
            Touch::Side {
                vertex: on_body,
                obstacle,
                side: index,
            },
            Touch::Corner {
                obstacle,
                corner: index,
                body_side: on_body,
            },
        ])
    }
}

/// Some obstacles, with a limit on the total number of corners.
pub(super) fn obstacles(
    random: &mut Random,
    longest: usize,
) -> Vec<ObstacleDescription<'static, f32>> {
    let mut left = random.below(longest + 1);
    let mut obstacles = Vec::new();
    for _ in 0..random.below(longest + 1) {
        let corners = random.below(left.min(9) + 1);
        left -= corners;
        let vertices: Vec<[f32; 2]> = (0..corners).map(|_| random.floats()).collect();
        obstacles.push(ObstacleDescription {
            // They live as long as the tests run.
            vertices: vertices.leak(),
            friction_static: random.float(),
            friction_dynamic: random.float(),
            memory: random.option(),
        });
    }
    obstacles
}
