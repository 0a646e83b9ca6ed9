//! The content of a frame about obstacles.

use super::{Said, Value, float, floats};
use stiction_core::{ObstacleDescription, Parameter, Touch};
use stiction_wire::{CommandAmong, ContactAmong, ReportAmong, SceneAmong};

const NO_OBSTACLE: ObstacleDescription<'static, f32> = ObstacleDescription {
    vertices: &[],
    friction_static: 0.0,
    friction_dynamic: 0.0,
    memory: None,
};

impl Said {
    pub(super) fn command_among(&mut self, command: &CommandAmong<'_>) {
        match command {
            CommandAmong::Common(command) => self.command(command),
            CommandAmong::SceneAmong(scene) => self.scene_among(scene),
        }
    }

    pub(super) fn report_among(&mut self, report: &ReportAmong<'_>) {
        match report {
            ReportAmong::Common(report) => self.report(report),
            ReportAmong::Room(room) => {
                self.int("obstacles", room.obstacles)
                    .int("corners", room.corners);
            }
            ReportAmong::ForcesAmong(f) => {
                let contacts = f.contacts.iter().map(contact_among);
                self.forces([f.wrench, f.feedback], f.turns, contacts);
            }
        }
    }

    fn scene_among(&mut self, among: &SceneAmong<'_>) {
        self.scene(&among.scene);
        let count = among.obstacles.len();
        let mut corners = vec![[0.0; 2]; among.obstacles.corner_count()];
        let mut places = vec![NO_OBSTACLE; count];
        let obstacles = among.obstacles.descriptions(&mut corners, &mut places);
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

fn contact_among(c: ContactAmong) -> Value {
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
pub(super) fn subject_among(parameter: Parameter) -> (i64, [usize; 2]) {
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
