//! A body that continues under other parameters, in another number type or evolution: [`Solver::carry`] for a scene file, with the
//! words of the page. Computes a solver and its state from a [`Present`].

use stiction_core::{
    CarryError, Description, Evolution, Model, Output, Present, Real, Scene, SiFloat, Solver, State,
};
use stiction_scene::{HostSolver, Indices, WrittenScene};

/// A solver with the state that continues, and the answer of settling. Its turns count from `Present::angle.turns`.
pub(super) struct Begun<R: Real, M: Model> {
    pub(super) solver: HostSolver<R, M>,
    pub(super) indices: Option<Indices>,
    pub(super) state: State<R>,
    pub(super) output: Output<R::Si>,
}

/// Returns the body of `present` in a scene.
pub(super) fn carried<R: Real<Si: SiFloat>, M: Model>(
    written: &WrittenScene,
    evolution: Evolution,
    present: &Present<f64>,
) -> Result<Begun<R, M>, String> {
    let solver_of = |description: &Description<'_, R::Si>| {
        let scene = Scene::new(description).map_err(|error| error.to_string())?;
        Ok(Solver::new(scene, evolution))
    };
    let (carried, indices) =
        written.described::<R, _>(|description| Solver::carry(present, description, solver_of));
    let carried = carried.map_err(|error| match error {
        CarryError::Scene(error) => error,
        CarryError::Unsettled(status) => format!(
            "the body does not settle: {}, allowed: what the number type carries",
            status.name()
        ),
        CarryError::OutOfReach => {
            "the hand would lose its hold, allowed: what keeps it within reach".to_owned()
        }
    })?;
    Ok(Begun {
        solver: carried.solver,
        indices,
        state: carried.state,
        output: carried.output,
    })
}

#[cfg(test)]
mod tests {
    //! A point has no size of its own: the length unit of its scene depends on where it is held. Transferring it to the same
    //! scene must not change the units of length and force.

    use std::sync::Arc;

    use stiction_core::{Angle, Hand, Hold};
    use stiction_scene::{SceneFile, Source};

    use super::*;
    use crate::body::{Body, Setting};
    use crate::number::Number;
    use crate::record::Frame;

    /// The lever (m): r² = 0.0016 + 0.4 / 500 m².
    const LEVER: f64 = 0.04;
    const POINT: &str = r#"
[body]
vertices = [[0.0, 0.0]]
start = [0.0, 0.0, 0.0]
[grasp]
point = [0.0, 0.04]
reach = 0.05
[spring]
translation = 500.0
rotation = 0.4
[friction]
static = 0.5
dynamic = 0.3
[[surface]]
normal = [0.0, 1.0]
offset = 0.0
"#;

    fn setting(number: Number) -> Setting {
        let source = Source::new("point.toml", POINT);
        let scene = SceneFile::parse(source, number.limit()).expect("a sound scene");
        Setting {
            scene: Arc::new(scene),
            number,
            evolution: Evolution::Path,
        }
    }

    /// Pressed onto the floor, pulled along it and rotated.
    fn pulled(setting: &Setting, hold: Hold) -> Box<dyn Body> {
        let mut hand = Hand::new(0.0, LEVER, 0.0);
        let mut body = setting.start(&hand).expect("a sound start");
        if hold == Hold::Taken {
            for held in [false, true] {
                hand.held = held;
                body.step(&hand);
            }
        }
        for part in (0..=100).map(|k| f64::from(k) / 100.0) {
            hand.position = [0.003 * part, LEVER - 0.01 * part];
            hand.angle = Angle::from_radians(0.1 * part);
            body.step(&hand);
        }
        assert_eq!(body.present().hold, hold);
        body
    }

    /// Positions relative to the lever, forces relative to those before.
    fn distance(before: &Frame, after: &Frame) -> f64 {
        let [fx, fy, _] = before.wrench;
        let force = fx.hypot(fy);
        assert!(before.held && after.held && force > 4.0, "{before:?}");
        let off = |a: [f64; 3], b: [f64; 3], units: [f64; 3]| {
            let parts = [0, 1, 2].map(|i| (a[i] - b[i]).abs() / units[i]);
            parts.into_iter().fold(0.0, f64::max)
        };
        let pose = off(before.pose, after.pose, [LEVER, LEVER, 1.0]);
        let moment = force * LEVER;
        pose.max(off(before.wrench, after.wrench, [force, force, moment]))
    }

    #[test]
    fn a_point_that_is_held_keeps_its_pose_and_its_wrench() {
        for number in Number::ALL {
            for hold in [Hold::Given, Hold::Taken] {
                let setting = setting(number);
                let body = pulled(&setting, hold);
                let carried = setting.carry(&body.present()).expect("the same scene");
                let (before, after) = (body.frame(0.0), carried.frame(0.0));
                let off = distance(&before, &after);
                assert!(
                    off < 1e-5,
                    "{number:?} {hold:?}: {off}: {before:?} {after:?}"
                );
            }
        }
    }
}
