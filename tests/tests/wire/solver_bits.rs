//! A solver at the other end of the wire returns the same bits as a local one.

use crate::{Either, decoded, encoded};
use stiction_core::{
    Angle, Description, Event, Evolution, Fixed, Hand, Real, Scene, Solver, StateKind,
    SurfaceDescription,
};
use stiction_wire::{Command, EventSet, Forces, Frame, List, Pose, Report};

const FRAMES: u32 = if cfg!(miri) { 300 } else { 3000 };

fn scene<R: Real<Si = f32>>() -> Scene<R, 4, 1> {
    Scene::new(&Description {
        vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
        start: [0.0, 0.06, 0.5],
        weight: 1.0,
        holding_point: Some([0.0, 0.02]),
        reach: 0.02,
        stiffness_translation: 500.0,
        stiffness_rotation: 0.5,
        surfaces: &[SurfaceDescription {
            normal: [0.0, 1.0],
            offset: 0.0,
            friction_static: 0.5,
            friction_dynamic: 0.3,
            memory: None,
        }],
    })
    .expect("a scene")
}

/// Over the floor, down to it, along it, turning slowly, letting go from time to time.
fn hand(frame: u32) -> Hand<f32> {
    let t = frame as f32 / 1000.0;
    let hand = Hand::new(
        0.1 * (1.3 * t).sin(),
        0.05 + 0.02 * (5.0 * t).cos(),
        0.5 + 2.0 * t,
    );
    let hand = Hand {
        depth: 0.3 * t,
        ..hand
    };
    if frame % 700 > 650 {
        hand.released()
    } else {
        hand
    }
}

/// The sample after it has passed the line.
fn through(sample: Hand<f32>, number: u32) -> Hand<f32> {
    let frame = Frame {
        sequence: number as u8,
        time: number,
        message: Command::Hand(sample),
    };
    decoded(&encoded(&frame), true, |received| match received {
        Ok(Either::Command(Frame {
            message: Command::Hand(hand),
            ..
        })) => hand,
        _ => panic!("no hand"),
    })
}

fn poses_carry_the_bits<R: Real<Si = f32>>(evolution: Evolution) {
    let solver = Solver::new(scene::<R>(), evolution);
    // Each hand is computed only once: the sines of the standard library may differ between two calls.
    let first = hand(0);
    let (mut there, _) = solver.start(through(first, 0));
    let (mut here, _) = solver.start(first);
    let (mut angle, mut states) = (
        Angle {
            turns: 0,
            rest: 0.0,
        },
        Vec::new(),
    );
    for number in 1..=FRAMES {
        let next = hand(number);
        let output = solver.step(&mut there, through(next, number));
        let message = Report::Pose(Pose::new(
            &output,
            EventSet::of(output.events()),
            number as u8,
        ));
        let pose = Frame {
            sequence: number as u8,
            time: 1000 * number,
            message,
        };
        let expected = solver.step(&mut here, next);
        decoded(&encoded(&pose), false, |received| {
            let Ok(Either::Report(Frame {
                message: Report::Pose(pose),
                ..
            })) = received
            else {
                panic!("no pose");
            };
            let bits = |numbers: [f32; 4]| numbers.map(f32::to_bits);
            let [x, y] = pose.position;
            let [ex, ey] = expected.position;
            let rest = expected.angle.rest;
            assert_eq!(
                bits([x, y, pose.rest, pose.depth]),
                bits([ex, ey, rest, expected.depth])
            );
            angle = pose.angle(angle);
            assert_eq!(angle.turns, expected.angle.turns);
            assert_eq!(
                (pose.state, pose.status, pose.held),
                (expected.state, expected.status, expected.held)
            );
            assert!(
                Event::ALL
                    .iter()
                    .all(|e| pose.events.contains(*e) == expected.events().contains(e))
            );
            assert_eq!(pose.sample, number as u8);
        });
        forces_carry_the_bits(&solver, &there);
        if !states.contains(&output.state) {
            states.push(output.state);
        }
    }
    assert!(
        cfg!(miri) || states.contains(&StateKind::SingleVertex) && states.len() >= 2,
        "{states:?}"
    );
}

fn forces_carry_the_bits<R: Real<Si = f32>>(
    solver: &Solver<R, 4, 1>,
    state: &stiction_core::State<R>,
) {
    let (wrench, contacts) = (solver.wrench(state), solver.contacts(state));
    let forces = Forces {
        wrench,
        feedback: wrench.feedback(),
        turns: 0,
        contacts: List::from(&contacts[..]),
    };
    let frame = Frame {
        sequence: 0,
        time: 0,
        message: Report::Forces(forces),
    };
    decoded(&encoded(&frame), false, |received| {
        let Ok(Either::Report(Frame {
            message: Report::Forces(arrived),
            ..
        })) = received
        else {
            panic!("no forces");
        };
        assert_eq!(arrived, forces);
        assert_eq!(arrived.contacts.len(), contacts.len());
    });
}

#[test]
fn poses_carry_the_bits_of_f32() {
    poses_carry_the_bits::<f32>(Evolution::Path);
    poses_carry_the_bits::<f32>(Evolution::Frame);
}

#[test]
fn poses_carry_the_bits_of_fixed() {
    poses_carry_the_bits::<Fixed>(Evolution::Path);
    poses_carry_the_bits::<Fixed>(Evolution::Frame);
}
