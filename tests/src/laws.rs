//! The laws on the frames of the tests: scenes, frames and the number types' bounds are passed to the judge, which knows
//! nothing of the solver.

use crate::number::Number;
use crate::run::Frame;
use crate::setup::Setup;
use stiction_core::{Contact, Evolution, SurfaceDescription};
pub use stiction_judge::{Bounds, Finding, law};
use stiction_judge::{Judge, Scene, Surface};

/// The law that every frame obeys, whatever its status.
pub const FINITE: &str = law::FINITE;

/// The finding that is largest relative to its bound.
pub fn worst(findings: impl IntoIterator<Item = Finding>) -> Finding {
    let none = Finding {
        law: "none",
        residual: 0.0,
        bound: 1.0,
    };
    let graver = |a: Finding, b: Finding| if b.severity() > a.severity() { b } else { a };
    findings.into_iter().fold(none, graver)
}

/// Asserts the laws of single frames, for a body that is held throughout.
#[track_caller]
pub fn assert_lawful<R: Number>(setup: &Setup, frames: &[Frame]) {
    for (i, frame) in frames.iter().enumerate() {
        assert_holds::<R>(worst(judge::<R>(setup, frame)), (i, frame));
    }
}

/// Asserts every law on a whole run: those of each frame, and those that depend on the frames before it.
#[track_caller]
pub fn assert_lawful_run<R: Number>(setup: &Setup, evolution: Evolution, frames: &[Frame]) {
    let mut judge = judge_of::<R>(setup, evolution);
    for (i, frame) in frames.iter().enumerate() {
        let findings = judge.next(judged(i, frame));
        assert_holds::<R>(worst(findings), (i, frame));
    }
}

#[track_caller]
fn assert_holds<R: Number>(finding: Finding, (i, frame): (usize, &Frame)) {
    let Finding {
        law,
        residual,
        bound,
    } = finding;
    assert!(
        finding.holds(),
        "{} frame {i}: {law} off by {residual:.2e}, allowed {bound:.0e}: {frame:?}",
        R::NAME
    );
}

/// The laws of a single frame, for a body that is held throughout.
pub fn judge<R: Number>(setup: &Setup, frame: &Frame) -> Vec<Finding> {
    let mut findings = judge_of::<R>(setup, Evolution::Path).alone(&judged(0, frame));
    findings.push(Finding {
        law: FINITE,
        residual: f64::from(!frame.longest_slip.is_finite()),
        bound: f64::MIN_POSITIVE,
    });
    findings
}

/// A judge with the scene as the number type rounds it, and that type's bounds.
pub fn judge_of<R: Number>(setup: &Setup, evolution: Evolution) -> Judge {
    judge_within::<R>(setup, evolution, bounds::<R>())
}

/// The bounds of a number type.
pub const fn bounds<R: Number>() -> Bounds {
    Bounds {
        residual: R::RESIDUAL,
        gap: R::GAP,
        far: true,
        slip: R::RESIDUAL,
        exact: 2.0 * R::GAP,
        rounding: R::ROUNDING,
    }
}

/// A judge with the scene as the number type rounds it.
pub fn judge_within<R: Number>(setup: &Setup, evolution: Evolution, bounds: Bounds) -> Judge {
    Judge::new(scene::<R>(setup), bounds, evolution)
}

/// The scene of the judge, as the number type rounds it.
pub fn scene<R: Number>(setup: &Setup) -> Scene {
    let setup = setup.rounded::<R>();
    let surface = |(i, s): (usize, &SurfaceDescription<f64>)| {
        let [x, y] = s.normal;
        Surface {
            name: i.to_string(),
            normal: s.normal.map(|n| n / x.hypot(y)),
            offset: s.offset,
            friction_static: s.friction_static,
            friction_dynamic: s.friction_dynamic,
            memory: s.memory,
        }
    };
    let surfaces = setup.surfaces.iter().enumerate().map(surface).collect();
    Scene {
        vertices: setup.vertices,
        start: setup.start,
        weight: setup.weight,
        holding_point: setup.holding_point,
        stiffness_translation: setup.stiffness_translation,
        stiffness_rotation: setup.stiffness_rotation,
        surfaces,
        obstacles: Vec::new(),
    }
}

/// Frame `i` in the judge's format, one second after the frame before it.
pub fn judged(i: usize, frame: &Frame) -> stiction_judge::Frame {
    let contact = |c: &Contact<f64>| stiction_judge::Contact {
        touch: c.touch,
        point: c.point,
        direction: None,
        normal: c.normal,
        friction: c.friction,
        sliding: Some(c.sliding),
    };
    stiction_judge::Frame {
        t: i as f64,
        hand: frame.hand,
        held: frame.held,
        pose: frame.pose,
        depth: frame.depth,
        state: frame.state,
        contacts: frame.contacts.iter().map(contact).collect(),
        complete: true,
        wrench: frame.wrench,
        slips: frame.slips,
        events: frame.events.clone(),
        status: frame.status,
        behind: None,
    }
}
