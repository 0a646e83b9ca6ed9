//! A body that goes on under other parameters, in another number type or evolution: it stays where it is, contacts stick at
//! first, and it settles anew under the hand that holds it at the same point. From a [`Present`] to a solver and its state.
//!
//! A device does the same for itself (`device/change.rs` of the firmware), all in its own f32. Here a body goes from one number
//! type to another one: what is computed in between is f64.

use stiction_core::{
    Angle, Description, Event, Evolution, Hand, Output, Real, SiFloat, Solver, State, Status,
    Wrench, narrow_hand,
};
use stiction_scene::{HostModel, HostSolver, Indices, WrittenScene};

/// How far the place of a hold is off by rounding, in parts of the body size.
const ROUNDING: f64 = 1e-4;

const OUT_OF_REACH: &str = "the hand would lose its hold, allowed: what keeps it within reach";

/// How the hand came to hold the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// Not yet.
    Never,
    /// At the scene's holding point.
    Given,
    /// Where it was at that moment.
    Taken,
}

impl Hold {
    /// After a step with these events, that left the body `held`.
    pub fn after(self, events: &[Event], held: bool) -> Self {
        match self {
            _ if events.contains(&Event::Grasp) => Self::Taken,
            Self::Never if held => Self::Given,
            hold => hold,
        }
    }
}

/// Where a body and its hand are, SI units.
#[derive(Clone, Copy, Debug)]
pub struct Present {
    /// Position of the body's origin (m).
    pub position: [f64; 2],
    /// Its orientation.
    pub angle: Angle<f64>,
    /// The hand holds it.
    pub held: bool,
    /// How it came to.
    pub hold: Hold,
    /// The hand, turned back by the body's whole turns.
    pub hand: Hand<f64>,
    /// Of the hand on the body.
    pub wrench: Wrench<f64>,
    /// k_h (N/m), k_theta (N·m/rad) of that wrench.
    pub stiffness: [f64; 2],
}

impl Present {
    /// The hand where it would pull at nothing, as it was at the moment of the grasp.
    pub fn idle(&self) -> Hand<f64> {
        let Wrench { force, moment } = self.wrench;
        let ([x, y], [fx, fy]) = (self.hand.position, force);
        let [k_h, k_theta] = self.stiffness;
        // Without a spring that turns, the angle at which it would rest is the present one.
        let turn = if k_theta > 0.0 { moment / k_theta } else { 0.0 };
        Hand {
            position: [x - fx / k_h, y - fy / k_h],
            angle: self.hand.angle.plus(-turn),
            ..self.hand
        }
    }
}

/// The reach with which a point is taken again that was within `reach` (m): its rounding must not put it outside.
pub fn within_reach(scene: &WrittenScene, reach: f64) -> f64 {
    let coordinates = scene.vertices.iter().flatten();
    reach + ROUNDING * coordinates.fold(0.0, |size: f64, x| size.max(x.abs()))
}

/// A solver with the state that goes on, and the answer of the settling; its turns are those since `Present::angle.turns`.
pub(super) struct Carried<R: Real, M: HostModel> {
    pub(super) solver: HostSolver<R, M>,
    pub(super) indices: Option<Indices>,
    pub(super) state: State<R>,
    pub(super) output: Output<R::Si>,
}

/// The body of `present` in a scene.
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

/// A written scene, and its description with changes.
type Described<'a, 'b, F> = (&'a WrittenScene, &'a Description<'b, F>);

fn solver<R: Real<Si: SiFloat>, M: HostModel>(
    (written, description): Described<'_, '_, R::Si>,
    evolution: Evolution,
) -> Result<(HostSolver<R, M>, Option<Indices>), String> {
    let built = M::build(written, description);
    let (scene, indices) = built.map_err(|error| error.to_string())?;
    Ok((Solver::new(scene, evolution), indices))
}

/// A holding point is for the first hold only. The state goes on in the solver that made it: the length unit of a point depends
/// on its holding point.
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

/// A hold that was taken on the way goes on: a hand that pulls at nothing takes it again, and jumps to where it is.
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
    //! A point has no size of its own: the length unit of its scene depends on where it is held. To be carried to the same
    //! scene must not change what lengths and forces are counted in.

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

    /// Pressed onto the floor, pulled along it and turned.
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

    /// Positions in levers, forces in those of before.
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
