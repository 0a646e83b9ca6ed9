//! The pantograph obeys its mechanics: the power of the torques is that of the wrench, and where the
//! mechanism can output no force it outputs none.

mod device;
mod example;
mod kinematics;
mod motors;

use stiction_firmware::pantograph::{Encoder, Geometry, HandleMount};

fn geometry() -> Geometry {
    let encoder = |counts_per_turn, reversed, offset| Encoder {
        counts_per_turn,
        reversed,
        offset,
    };
    Geometry {
        origin: [0.0, -0.1],
        base: 0.05,
        proximal: [0.06, 0.06],
        distal: [0.09, 0.09],
        encoders: [
            encoder(40_000, false, 2.4),
            encoder(40_000, true, 0.7),
            encoder(4_096, false, 0.0),
        ],
        handle: HandleMount::Base,
        least_sine: 0.05,
    }
}
