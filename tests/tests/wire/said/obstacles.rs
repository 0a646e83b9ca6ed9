//! Obstacles, and what touches them, as the content of a frame.

use super::{Said, Value, float, floats};
use stiction_core::{Contact, ObstacleDescription, Parameter, Touch};
use stiction_wire::ObstacleList;

const NO_OBSTACLE: ObstacleDescription<'static, f32> = ObstacleDescription {
    vertices: &[],
    friction_static: 0.0,
    friction_dynamic: 0.0,
    memory: None,
};

impl Said {
    pub(super) fn obstacles(&mut self, list: &ObstacleList<'_>) {
        let mut corners = vec![[0.0; 2]; list.corner_count()];
        let mut places = vec![NO_OBSTACLE; list.len()];
        let obstacles = list.descriptions(&mut corners, &mut places);
        let obstacles = obstacles.expect("there is room");
        let row = |o: &ObstacleDescription<'_, f32>| {
            let [mu_s, mu_d] = [o.friction_static, o.friction_dynamic].map(float);
            let has_memory = Value::Int(o.memory.is_some().into());
            let memory = float(o.memory.unwrap_or_default());
            let corners = Value::Int(o.vertices.len() as i64);
            Value::List(vec![corners, mu_s, mu_d, has_memory, memory])
        };
        self.list("obstacles", "obstacle", obstacles.iter().map(row));
        let corners = obstacles.iter().flat_map(|o| o.vertices);
        self.list("corners", "corner", corners.map(|at| floats(at)));
    }
}

pub(super) fn contact(c: Contact<f32>) -> Value {
    let touch = match c.touch {
        Touch::Surface { vertex, surface } => [vertex, 255, surface],
        Touch::Side {
            vertex,
            obstacle,
            side,
        } => [vertex, obstacle, side],
        Touch::Corner {
            obstacle,
            corner,
            body_side,
        } => [128 + body_side, obstacle, corner],
    };
    let ([n_x, n_y], [x, y]) = (c.direction, c.point);
    let indices = touch.map(|i| Value::Int(i as i64));
    let numbers = [n_x, n_y, x, y, c.normal, c.friction].map(float);
    let sliding = [Value::Int(c.sliding.into())];
    Value::List(indices.into_iter().chain(numbers).chain(sliding).collect())
}

/// The code and the indices of a refusal about an obstacle.
pub(super) fn of_obstacle(parameter: Parameter) -> (i64, [usize; 2]) {
    match parameter {
        Parameter::ObstacleCount => (16, [0; 2]),
        Parameter::CornerCount => (17, [0; 2]),
        Parameter::Corners(i) => (18, [i, 0]),
        Parameter::Corner { obstacle, corner } => (19, [obstacle, corner]),
        Parameter::Side { obstacle, side } => (20, [obstacle, side]),
        Parameter::ObstacleFrictionStatic(i) => (21, [i, 0]),
        Parameter::ObstacleFrictionDynamic(i) => (22, [i, 0]),
        Parameter::ObstacleMemory(i) => (23, [i, 0]),
        Parameter::Overlap(i) => (24, [i, 0]),
        other => panic!("{other}"),
    }
}
