//! A body that is carried over to another scene keeps its pose, its hold and its wrench.

use stiction_core::{
    Angle, CarryError, Description, Evolution, Hand, Hold, Output, Present, Real, Scene,
    SceneError, SiFloat, Solver, Status, SurfaceDescription, Wrench, reach_again,
};
use stiction_tests::station::{self, FLOOR};

/// The box, which is held where it was taken, whatever is near.
const BOX: Description<'_, f32> = Description {
    reach: 0.0,
    ..station::BOX
};

fn solver_of<R: Real>(
    description: &Description<'_, R::Si>,
) -> Result<Solver<R, 4, 1>, SceneError<R::Si>> {
    Ok(Solver::new(Scene::new(description)?, Evolution::Path))
}

/// The box after its hand moved along, pressing it down: it has slipped.
fn dragged(hands: &[Hand<f32>]) -> Present<f32> {
    let solver = solver_of::<f32>(&BOX).expect("a sound scene");
    let (mut state, mut output) = solver.start(Hand::new(0.0, 0.04, 0.0));
    for &hand in hands {
        output = solver.step(&mut state, hand);
    }
    Present {
        position: output.position,
        angle: output.angle,
        held: output.held,
        hold: state.hold(),
        holding_point: BOX.holding_point,
        hand: state.hand().turned(-output.angle.turns),
        wrench: solver.wrench(&state),
        stiffness: [500.0, 0.5],
    }
}

const ALONG: Hand<f32> = Hand {
    position: [0.02, 0.04],
    angle: Angle {
        turns: 0,
        rest: 0.0,
    },
    depth: 0.0,
    held: true,
    tilted: false,
};

fn carried<R: Real<Si: SiFloat>>(
    present: &Present<f32>,
    description: &Description<'_, R::Si>,
) -> (Wrench<R::Si>, Hold, Output<R::Si>) {
    let carried = Solver::carry(present, description, solver_of::<R>).expect("it fits");
    let wrench = carried.solver.wrench(&carried.state);
    (wrench, carried.state.hold(), carried.output)
}

/// Where a hand may take hold again grows by far more than rounding, and by far less than the body.
#[test]
fn reach_grows_by_little() {
    for reach in [0.0, 0.01] {
        let more = reach_again(BOX.vertices, reach) - reach;
        assert!((1e-6..1e-5).contains(&more), "{reach}: {more}");
    }
}

#[test]
fn a_held_body_keeps_pose_hold_and_wrench() {
    let given = dragged(&[ALONG]);
    // Let go, and taken hold of nearer to its end.
    let aside = Hand::new(0.04, 0.05, 0.1);
    let taken = dragged(&[ALONG, aside.released(), aside, Hand::new(0.041, 0.045, 0.1)]);
    assert_eq!((given.hold, taken.hold), (Hold::Given, Hold::Taken));
    for present in [given, taken] {
        assert!(present.wrench.force[1] < -2.0, "{present:?}");
        let (wrench, hold, output) = carried::<f32>(&present, &BOX);
        assert!(output.held && hold == present.hold);
        for k in 0..2 {
            assert!(
                (output.position[k] - present.position[k]).abs() < 1e-6,
                "{output:?} {present:?} {wrench:?}"
            );
            assert!((wrench.force[k] - present.wrench.force[k]).abs() < 2e-3);
        }
    }
}

/// The point at which the hand holds the body is its own, not that of the new scene.
#[test]
fn another_holding_point_does_not_move_the_hand() {
    let present = dragged(&[ALONG]);
    let moved = Description {
        holding_point: Some([0.03, 0.0]),
        ..BOX
    };
    let (wrench, hold, _) = carried::<f32>(&present, &moved);
    assert_eq!((wrench, hold), {
        let (wrench, hold, _) = carried::<f32>(&present, &BOX);
        (wrench, hold)
    });
    // Let go, it has no holding point any more.
    let released = dragged(&[ALONG, ALONG.released()]);
    let (_, hold, output) = carried::<f32>(&released, &moved);
    assert!(hold == Hold::Given && !output.held);
}

#[test]
fn a_body_that_does_not_fit_is_refused() {
    let present = dragged(&[ALONG]);
    let higher = SurfaceDescription {
        offset: 0.01,
        ..FLOOR
    };
    let refused = Description {
        surfaces: &[higher],
        ..BOX
    };
    let error = Solver::carry(&present, &refused, solver_of::<f32>);
    assert!(matches!(error, Err(CarryError::Scene(_))), "{error:?}");
    let far = Present {
        hand: Hand::new(1e9, 0.04, 0.0),
        ..present
    };
    let error = Solver::carry(&far, &BOX, solver_of::<f32>).expect_err("out of range");
    assert_eq!(error, CarryError::Unsettled(Status::Saturated));
}

#[test]
fn hold_follows_from_the_answers() {
    let solver = solver_of::<f32>(&BOX).expect("a sound scene");
    let (mut state, output) = solver.start(ALONG.released());
    let mut hold = Hold::Never.after(output.events(), output.held);
    for hand in [ALONG, ALONG.released(), Hand::new(0.0, 0.03, 0.0)] {
        assert_eq!(hold, state.hold());
        let output = solver.step(&mut state, hand);
        hold = hold.after(output.events(), output.held);
    }
    assert_eq!((hold, state.hold()), (Hold::Taken, Hold::Taken));
}
