//! The program of a board and its parts on this machine, against their requirements: FRAME.md, statics, mechanics.

mod bench;
mod bits;
mod count;
mod device;
mod knob;
mod line;
mod pantograph;
mod passive;
mod ring;
mod safety;
mod station;

use stiction_core::Wrench;
use stiction_wire::Parameters;

/// The parameters of the box.
const SAME: Parameters = Parameters {
    stiffness_translation: 500.0,
    stiffness_rotation: 0.5,
    friction_static: 0.5,
    friction_dynamic: 0.3,
    memory: None,
};

/// A value with some of it changed.
fn with<T>(mut value: T, change: impl FnOnce(&mut T)) -> T {
    change(&mut value);
    value
}

/// The size of a force (N).
fn size(wrench: &Wrench<f32>) -> f32 {
    let [x, y] = wrench.force;
    x.hypot(y)
}

/// By how much the force differs (N).
fn change(a: &Wrench<f32>, b: &Wrench<f32>) -> f32 {
    let ([ax, ay], [bx, by]) = (a.force, b.force);
    (bx - ax).hypot(by - ay)
}
