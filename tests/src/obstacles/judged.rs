//! A run of the solver, compared with the known values of a case.

use super::cases::{Answer, Case, Check};
use super::run::Run;
use crate::number::Number;
use stiction_core::Evolution;
use stiction_judge::{Contact, Frame, Status};

/// The bound in f64 for cases with closed formulas, relative to the scale of a check.
const CLOSED: f64 = 1e-9;

/// How a case deviates from what is known, in a number type and an evolution: the first deviation in words.
///
/// # Errors
/// A value, a status other than `ok`, a pose or force that is not that of the half-plane, or a scene that is not refused.
pub fn is_right<R: Number>(case: &Case, evolution: Evolution) -> Result<(), String> {
    if case.refused {
        let scene = case.among.scene::<R>();
        return scene.map_or(Ok(()), |_| Err("it is not refused".to_owned()));
    }
    let bound = bound::<R>(case);
    let mut run = Run::<R>::start(&case.among, evolution, case.hands[0]);
    let twin = case.twin.as_ref();
    let mut twin = twin.map(|twin| Run::<R>::start(twin, evolution, case.hands[0]));
    let mut slips = run.frame.slips;
    for (i, &hand) in case.hands.iter().enumerate() {
        if i > 0 {
            slips += run.step(hand).slips;
        }
        if run.frame.status != Status::Ok {
            return Err(format!("frame {i}: {}", run.frame.status.name()));
        }
        if let Some(twin) = &mut twin {
            if i > 0 {
                twin.step(hand);
            }
            let [pose, force] = apart(case, &run.frame, &twin.frame);
            if pose > bound || force > bound || run.frame.slips != twin.frame.slips {
                return Err(format!(
                    "frame {i}: off the half-plane by {pose:.1e} and {force:.1e}: {:?}",
                    run.frame
                ));
            }
        }
        let answer = answer(&run.frame, slips);
        for check in case.checks.iter().filter(|check| check.frame == i) {
            within(check, &answer, bound)?;
        }
    }
    Ok(())
}

/// A known value to within a bound, relative to its scale.
///
/// # Errors
/// By how much the answer is off.
pub fn within(check: &Check, answer: &Answer, bound: f64) -> Result<(), String> {
    let (frame, value, error) = (check.frame, &check.value, check.error(answer));
    if error <= bound {
        return Ok(());
    }
    Err(format!(
        "frame {frame}: {value:?} off by {error:.1e}, allowed {bound:.0e}: {answer:?}"
    ))
}

/// The answer that a frame gives, with the slips so far.
pub fn answer(frame: &Frame, slips: u32) -> Answer {
    let contact = |c: &Contact| (c.touch, [c.normal, c.friction]);
    Answer {
        pose: frame.pose,
        contacts: frame.contacts.iter().map(contact).collect(),
        pull: frame.wrench[1],
        slips,
        state: frame.state.name(),
    }
}

/// The bound of a number type, relative to the scale of a check.
fn bound<R: Number>(case: &Case) -> f64 {
    let exact = R::ROUNDING <= f64::ROUNDING;
    match case.tolerance {
        [wide, _] if exact && case.closed => wide.min(CLOSED),
        [wide, _] if exact => wide,
        [_, narrow] => narrow,
    }
}

/// How far a frame is from that of the twin: in pose and in forces of the hand, relative to their scales.
fn apart(case: &Case, one: &Frame, other: &Frame) -> [f64; 2] {
    let size = case.among.setup.size();
    let [x, y, theta] = [0, 1, 2].map(|k| (one.pose[k] - other.pose[k]).abs());
    let force = |f: [f64; 3]| f[0].hypot(f[1]).max(f[2].abs() / size);
    let off = force([0, 1, 2].map(|k| one.wrench[k] - other.wrench[k]));
    let unit = case.among.setup.stiffness_translation * size;
    let least = force(other.wrench).max(1e-3 * unit);
    [(x.max(y) / size).max(theta), off / least]
}
