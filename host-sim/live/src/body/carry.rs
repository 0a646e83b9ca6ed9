//! A body that continues under other parameters, in another number type or evolution: it stays where it is, contacts stick at
//! first, and it settles again under the hand, which holds it at the same point. Computes a solver and its state from a
//! [`Present`].
//!
//! A device does the same for itself (`device/change.rs` of the firmware), entirely in its own f32. Here a body can move from
//! one number type to another; intermediate results are f64.

use stiction_core::{
    Angle, Description, Event, Evolution, Hand, Output, Real, SiFloat, Solver, State, Status,
    Wrench, narrow_hand,
};
use stiction_scene::{HostModel, HostSolver, Indices, WrittenScene};

/// Rounding error of the holding point, relative to the size of the body.
const ROUNDING: f64 = 1e-4;

const OUT_OF_REACH: &str = "the hand would lose its hold, allowed: what keeps it within reach";

/// How the hand came to hold the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// It has not held it yet.
    Never,
    /// At the scene's holding point.
    Given,
    /// Where the hand was when it grasped.
    Taken,
}

impl Hold {
    /// Returns the hold after a step with these events that left the body `held`.
    pub fn after(self, events: &[Event], held: bool) -> Self {
        match self {
            _ if events.contains(&Event::Grasp) => Self::Taken,
            Self::Never if held => Self::Given,
            hold => hold,
        }
    }
}

/// Pose of a body and its hand, SI units.
#[derive(Clone, Copy, Debug)]
pub struct Present {
    /// Position of the body's origin (m).
    pub position: [f64; 2],
    /// Orientation of the body.
    pub angle: Angle<f64>,
    /// Whether the hand holds it.
    pub held: bool,
    /// How the hand came to hold it.
    pub hold: Hold,
    /// The hand, rotated back by the body's whole turns.
    pub hand: Hand<f64>,
    /// Wrench of the hand on the body.
    pub wrench: Wrench<f64>,
    /// k_h (N/m), k_theta (N·m/rad) of that wrench.
    pub stiffness: [f64; 2],
}

impl Present {
    /// Returns the hand at the pose where it exerts no force, as at the moment of the grasp.
    pub fn idle(&self) -> Hand<f64> {
        let Wrench { force, moment } = self.wrench;
        let ([x, y], [fx, fy]) = (self.hand.position, force);
        let [k_h, k_theta] = self.stiffness;
        // Without a rotational spring, the angle without a moment is the present one.
        let turn = if k_theta > 0.0 { moment / k_theta } else { 0.0 };
        Hand {
            position: [x - fx / k_h, y - fy / k_h],
            angle: self.hand.angle.plus(-turn),
            ..self.hand
        }
    }
}

/// Returns the reach for grasping a point again that was within `reach` (m): rounding must not put it outside.
pub fn within_reach(scene: &WrittenScene, reach: f64) -> f64 {
    let coordinates = scene.vertices.iter().flatten();
    reach + ROUNDING * coordinates.fold(0.0, |size: f64, x| size.max(x.abs()))
}

/// A solver with the state that continues, and the answer of settling. Its turns count from `Present::angle.turns`.
pub(super) struct Carried<R: Real, M: HostModel> {
    pub(super) solver: HostSolver<R, M>,
    pub(super) indices: Option<Indices>,
    pub(super) state: State<R>,
    pub(super) output: Output<R::Si>,
}

/// Returns the body of `present` in a scene.
///
/// # Errors
/// Why it cannot be there, and what is allowed.
pub(super) fn carried<R: Real<Si: SiFloat>, M: HostModel>(
    scene: &WrittenScene,
    evolution: Evolution,
    present: &Present,
) -> Result<Carried<R, M>, String> {
    scene.described(|description| {
        let carried = settled((scene, description), evolution, present)?;
        let output = &carried.output;
        if matches!(output.status, Status::Saturated | Status::HeldLast) {
            return Err(format!(
                "the body does not settle: {}, allowed: what the number type carries",
                output.status.name()
            ));
        }
        if present.held && !output.held {
            return Err(OUT_OF_REACH.to_owned());
        }
        Ok(carried)
    })
}

/// A scene as written, and its description with changes.
type Described<'a, 'b, F> = (&'a WrittenScene, &'a Description<'b, F>);

fn solver<R: Real<Si: SiFloat>, M: HostModel>(
    (written, description): Described<'_, '_, R::Si>,
    evolution: Evolution,
) -> Result<(HostSolver<R, M>, Option<Indices>), String> {
    let built = M::build(written, description);
    let (scene, indices) = built.map_err(|error| error.to_string())?;
    Ok((Solver::new(scene, evolution), indices))
}

/// Settles the body. The holding point applies only to the first hold. The state continues in the solver that made it: the length
/// unit of a point depends on its holding point.
fn settled<R: Real<Si: SiFloat>, M: HostModel>(
    (written, description): Described<'_, '_, R::Si>,
    evolution: Evolution,
    present: &Present,
) -> Result<Carried<R, M>, String> {
    let narrow = R::Si::narrow;
    let [x, y] = present.position.map(narrow);
    let mut there = Description {
        start: [x, y, narrow(present.angle.rest)],
        ..*description
    };
    let is_given = present.held && present.hold == Hold::Given;
    if present.hold != Hold::Never && !is_given {
        there.holding_point = None;
    }
    let (solver, indices) = solver((written, &there), evolution)?;
    let (state, output) = if present.held && present.hold == Hold::Taken {
        taken_on::<R, M>((written, there), present)?
    } else {
        solver.start(narrow_hand(&present.hand))
    };
    Ok(Carried {
        solver,
        indices,
        state,
        output,
    })
}

/// Continues a hold that began during the run: a hand that exerts no force grasps the body again and jumps to its present pose.
fn taken_on<R: Real<Si: SiFloat>, M: HostModel>(
    (written, mut there): (&WrittenScene, Description<'_, R::Si>),
    present: &Present,
) -> Result<(State<R>, Output<R::Si>), String> {
    there.reach = R::Si::narrow(within_reach(written, there.reach.widen()));
    let (solver, _) = solver::<R, M>((written, &there), Evolution::Frame)?;
    let (mut state, taken) = solver.start(narrow_hand(&present.idle()));
    if !taken.held {
        return Err(OUT_OF_REACH.to_owned());
    }
    let output = solver.step(&mut state, narrow_hand(&present.hand));
    Ok((state, output))
}

#[cfg(test)]
mod tests {
    //! A point has no size of its own: the length unit of its scene depends on where it is held. Transferring it to the same
    //! scene must not change the units of length and force.

    use std::sync::Arc;

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
