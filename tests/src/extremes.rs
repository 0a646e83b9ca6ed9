//! Scenes that take one parameter each to its extremes (STATICS 16), and how far every number type copes: for every
//! value, whether the scene is refused, whether every frame whose status is ok is lawful, and whether a frame's status
//! reports a limitation.

use crate::laws::{judge, worst};
use crate::number::Number;
use crate::run::Run;
use crate::scenes;
use crate::setup::Setup;
use stiction_core::{Evolution, Status};

/// One parameter and the values it takes.
pub struct Sweep {
    /// What is varied, with its unit.
    pub name: &'static str,
    /// Its values, in ascending order.
    pub values: &'static [f64],
    /// The scene of a value and the hand's path through it.
    pub scene: fn(f64) -> (Setup, Vec<[f64; 3]>),
}

/// How a number type handles a value.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The scene is refused with a clear error.
    Refused(String),
    /// Every frame is lawful and none reports less; slips may be too many to be resolved individually.
    Holds {
        /// The worst residual in units of its bound.
        severity: f64,
    },
    /// Some frames report a limitation in their status; all others are lawful.
    Says(Status),
    /// A frame whose status is ok is not lawful, or a number is not finite.
    Broken(String),
}

/// All sweeps.
pub const SWEEPS: &[Sweep] = &[
    Sweep {
        name: "mu_s of the floor (mu_d = 0.6 mu_s)",
        values: &[0.0, 1e-6, 1e-4, 0.01, 0.1, 1.0, 10.0, 100.0, 1e3],
        scene: |mu| exercise(block().floor([mu, 0.6 * mu])),
    },
    Sweep {
        name: "k_theta / (k_h L²)",
        values: &[
            0.0, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6,
        ],
        scene: |stiffness| {
            let setup = block().floor([0.5, 0.3]);
            let rotation = stiffness * setup.size() * setup.size();
            exercise(setup.springs(1.0, rotation))
        },
    },
    Sweep {
        name: "body size L (m)",
        values: &[
            1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6,
        ],
        scene: |length| {
            let setup = Setup::block(0.8 * length, 0.6 * length)
                .held_at([0.0, 0.3 * length])
                .springs(500.0, 100.0 * length * length)
                .weighing(10.0 * length);
            exercise(setup.floor([0.5, 0.3]).wall(1.2 * length, [0.4, 0.3]))
        },
    },
    Sweep {
        name: "k_h (N/m)",
        values: &[1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9],
        scene: |stiffness| {
            exercise(
                block()
                    .springs(stiffness, 0.3 * stiffness)
                    .floor([0.5, 0.3]),
            )
        },
    },
    Sweep {
        name: "weight / (k_h L)",
        values: &[0.0, 1e-6, 1e-3, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4],
        scene: |weight| exercise(block().weighing(weight).floor([0.5, 0.3])),
    },
    Sweep {
        name: "displacement of the hand in one frame (L)",
        values: &[0.1, 1.0, 10.0, 100.0, 1e3, 1e4],
        scene: |way| {
            let setup = block().floor([0.5, 0.3]);
            let offsets = [
                [way, -0.1, 0.0],
                [0.0; 3],
                [0.0, -way, 0.3],
                [0.0; 3],
                [-way, way, 0.0],
            ];
            from_grip(setup, &offsets, 1)
        },
    },
    Sweep {
        name: "scene away from the origin (L)",
        values: &[0.0, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6],
        scene: |away| {
            let setup = block()
                .at([away, away, 0.0])
                .surface([0.0, 1.0], away, [0.5, 0.3]);
            exercise(setup)
        },
    },
    Sweep {
        name: "angle between two floors (rad)",
        values: &[1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 1.0],
        scene: |angle| {
            let (sin, cos) = (angle / 2.0).sin_cos();
            let setup = block()
                .at([0.0, 0.6, 0.0])
                .surface([sin, cos], 0.0, [0.5, 0.3])
                .surface([-sin, cos], 0.0, [0.5, 0.3]);
            exercise(setup)
        },
    },
    Sweep {
        name: "angle between floor and ceiling (rad)",
        values: &[0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1],
        scene: |angle| {
            let (sin, cos) = angle.sin_cos();
            let setup = Setup::rod(1.0)
                .at([0.0, 0.05, 0.0])
                .held_at([0.4, 0.0])
                .springs(1.0, 0.1)
                .floor([0.5, 0.3])
                .surface([sin, -cos], -0.6 * cos, [0.5, 0.3]);
            let offsets = [
                [0.0, 0.3, 1.2],
                [0.2, 0.3, 1.2],
                [-0.3, 0.1, 0.6],
                [0.0, 0.1, 0.0],
                [0.1, 0.2, -0.9],
            ];
            from_grip(setup, &offsets, 40)
        },
    },
    Sweep {
        name: "height of a triangle (L)",
        values: &[1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.5],
        scene: |height| {
            let setup = Setup::new(&[[-0.5, 0.0], [0.5, 0.0], [0.1, height]]);
            exercise(
                setup
                    .held_at([0.1, height / 2.0])
                    .floor([0.5, 0.3])
                    .wall(0.8, [0.4, 0.3]),
            )
        },
    },
    Sweep {
        name: "vertices of a regular polygon",
        values: &[1.0, 2.0, 3.0, 4.0, 8.0, 16.0, 32.0, 64.0],
        scene: |count| {
            let vertex = |i: u8| {
                let (y, x) = (std::f64::consts::TAU * f64::from(i) / count).sin_cos();
                [0.5 * x, 0.5 * y]
            };
            let vertices: Vec<_> = (0..count as u8).map(vertex).collect();
            let setup = Setup::new(&vertices)
                .at([0.0, 0.5, 0.0])
                .held_at([0.1, 0.1]);
            exercise(setup.floor([0.5, 0.3]).wall(0.9, [0.4, 0.3]))
        },
    },
    Sweep {
        name: "normal force left before a drag, N / (k_h L)",
        values: &[0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01],
        scene: |normal| {
            let setup = block().floor([0.5, 0.3]);
            from_grip(
                setup,
                &[[0.0, -0.1, 0.0], [0.0, -normal, 0.0], [0.3, -normal, 0.0]],
                20,
            )
        },
    },
    Sweep {
        name: "holding point from the contact (L)",
        values: &[0.0, 1e-9, 1e-6, 1e-3, 0.1, 1.0, 10.0, 100.0],
        scene: |lever| {
            let setup = Setup::triangle().held_at([0.0, lever]).floor([0.5, 0.3]);
            from_grip(
                setup,
                &[
                    [0.0, -0.1, 0.0],
                    [0.0, -0.1, 0.5],
                    [0.4, -0.1, 0.0],
                    [0.0, 0.5, 0.0],
                ],
                40,
            )
        },
    },
];

/// A block of L = 1 m with k_h = 1 N/m, held above its middle.
fn block() -> Setup {
    Setup::block(0.8, 0.6).held_at([0.0, 0.4]).springs(1.0, 0.3)
}

/// Pressed down, dragged, turned, dragged back, lifted and set down again.
fn exercise(setup: Setup) -> (Setup, Vec<[f64; 3]>) {
    let l = setup.size();
    let offsets = [
        [0.0, -0.1, 0.0],
        [0.5, -0.1, 0.0],
        [0.5, -0.1, 0.4],
        [-0.2, -0.15, 0.5],
        [-0.2, 0.4, 0.1],
        [0.3, -0.1, -0.3],
        [1.0, 0.1, 0.2],
    ];
    from_grip(setup, &offsets.map(|[x, y, turn]| [x * l, y * l, turn]), 30)
}

/// The hand grasps the body where it stands and moves by each of the offsets from there, in the given number of frames each.
fn from_grip(setup: Setup, offsets: &[[f64; 3]], frames: usize) -> (Setup, Vec<[f64; 3]>) {
    let scenario = scenes::from_grip(setup, offsets);
    let hands = scenario.hands(frames);
    (scenario.setup, hands)
}

/// Runs the scene of a value in a number type.
pub fn outcome<R: Number>(sweep: &Sweep, value: f64, evolution: Evolution) -> Outcome {
    let (setup, hands) = (sweep.scene)(value);
    if let Err(error) = setup.scene::<R>() {
        return Outcome::Refused(error.to_string());
    }
    let mut run = Run::<R>::start(&setup, evolution, hands[0]);
    let (mut severity, mut status) = (0.0f64, run.frame.status);
    for (i, &hand) in hands.iter().enumerate() {
        if i > 0 {
            run.step(hand);
        }
        let frame = &run.frame;
        status = status.max(frame.status);
        let findings = judge::<R>(&setup, frame).into_iter();
        // An event limit means a shorter memory of slips, not a wrong balance.
        let claimed = frame.status <= Status::EventLimit;
        let finding = worst(findings.filter(|f| claimed || f.law == crate::laws::FINITE));
        if finding.severity() > 1.0 {
            return Outcome::Broken(format!(
                "frame {i}: {} off by {:.1e}: {frame:?}",
                finding.law, finding.residual
            ));
        }
        severity = severity.max(finding.severity());
    }
    if status <= Status::EventLimit {
        Outcome::Holds { severity }
    } else {
        Outcome::Says(status)
    }
}
