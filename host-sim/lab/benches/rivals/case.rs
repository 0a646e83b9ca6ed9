//! The scenes of the comparison: from the name of a bundled scene file to the numbers that every engine gets.

use std::path::Path;

use stiction_live::number::Number;
use stiction_live::scenes;
use stiction_scene::{Motion, Sample, SceneFile};

/// x, y (m), angle (rad), of the body or of the hand, world frame.
pub(crate) type Pose = [f64; 3];

/// A scene and the path of the hand through it.
#[derive(Clone)]
pub(crate) struct Case {
    /// Its name in the table.
    pub(crate) name: &'static str,
    /// Body, springs and surfaces, SI units.
    pub(crate) scene: SceneFile,
    /// Frames per second (Hz).
    pub(crate) rate: f64,
    /// The hand until the body is pressed down: the first leg of the path.
    pub(crate) press: Vec<Sample>,
    /// The hand from there to the end of the path, where it stops.
    pub(crate) drag: Vec<Sample>,
}

impl Case {
    pub(crate) fn new(name: &'static str, file: &str) -> Self {
        let source = scenes::find(Path::new(file)).expect("the scene is bundled");
        let scene =
            SceneFile::parse(source, Number::F32.limit()).expect("a bundled scene is sound");
        let Some(Motion::Keyframes(path)) = scene.hand.motion.clone() else {
            panic!("{file}: the hand of a bundled scene moves by keyframes");
        };
        let rate = scene.hand.rate.expect("keyframes have a rate");
        let legs: Vec<_> = path.frames(None).collect();
        let pressed = legs[1].t + 0.5 / rate;
        let (press, drag): (Vec<_>, Vec<_>) = path
            .frames(Some(rate))
            .partition(|sample| sample.t < pressed);
        Self {
            name,
            scene,
            rate,
            press,
            drag,
        }
    }

    /// This case with the static coefficient for both.
    pub(crate) fn with_one_coefficient(&self) -> Self {
        let mut case = self.clone();
        for surface in &mut case.scene.written.surfaces {
            surface.friction_dynamic = surface.friction_static;
        }
        case
    }

    pub(crate) fn friction(&self) -> String {
        let surface = &self.scene.surfaces[0];
        let (stick, slip) = (surface.friction_static, surface.friction_dynamic);
        if stick > slip {
            format!("{stick} / {slip}")
        } else {
            format!("{stick}")
        }
    }

    /// The hand when the body first appears.
    pub(crate) fn first(&self) -> &Sample {
        &self.press[0]
    }

    /// The hand when it stops.
    pub(crate) fn last(&self) -> &Sample {
        self.drag.last().expect("the path has more than one leg")
    }

    /// The holding point, body frame (m).
    pub(crate) fn holding_point(&self) -> [f64; 2] {
        (self.scene.holding_point).expect("the scenes of the comparison start held")
    }

    /// Vertex and surface of all pairs that are closer to each other than `gap` (m).
    pub(crate) fn touching(&self, pose: Pose, gap: f64) -> Vec<(usize, usize)> {
        let mut pairs = Vec::new();
        for (v, &vertex) in self.scene.vertices.iter().enumerate() {
            let [x, y] = place(pose, vertex);
            for (s, surface) in self.scene.surfaces.iter().enumerate() {
                let [nx, ny] = surface.normal;
                if nx * x + ny * y - surface.offset < gap {
                    pairs.push((v, s));
                }
            }
        }
        pairs
    }

    /// The largest distance between two vertices (m).
    pub(crate) fn size(&self) -> f64 {
        let vertices = &self.scene.vertices;
        let apart = |a: &[f64; 2]| {
            vertices
                .iter()
                .map(|b| (a[0] - b[0]).hypot(a[1] - b[1]))
                .fold(0.0, f64::max)
        };
        vertices.iter().map(apart).fold(0.0, f64::max)
    }

    /// The largest distance of a vertex in one pose from the same vertex in the other (m).
    pub(crate) fn distance(&self, a: Pose, b: Pose) -> f64 {
        let apart = |&vertex: &[f64; 2]| {
            let (p, q) = (place(a, vertex), place(b, vertex));
            (p[0] - q[0]).hypot(p[1] - q[1])
        };
        self.scene.vertices.iter().map(apart).fold(0.0, f64::max)
    }

    /// How far the foot, the vertex closest to the first surface, moves along it between two poses (m).
    pub(crate) fn foot_moves(&self, from: Pose, to: Pose) -> f64 {
        let [nx, ny] = self.scene.surfaces[0].normal;
        let height = |&vertex: &[f64; 2]| {
            let [x, y] = place(from, vertex);
            nx * x + ny * y
        };
        let vertices = self.scene.vertices.iter();
        let foot = vertices.min_by(|a, b| height(a).total_cmp(&height(b)));
        let foot = *foot.expect("a body has vertices");
        let (p, q) = (place(from, foot), place(to, foot));
        ny * (q[0] - p[0]) - nx * (q[1] - p[1])
    }
}

pub(crate) fn hand_pose(sample: &Sample) -> Pose {
    let [x, y] = sample.hand.position;
    [x, y, sample.hand.angle.radians()]
}

fn place([x, y, theta]: Pose, [vx, vy]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = theta.sin_cos();
    [x + cos * vx - sin * vy, y + sin * vx + cos * vy]
}
