//! The pantograph obeys its mechanics: the power of the torques is that of the wrench, symmetry is preserved, and where
//! the mechanism can output no force it outputs none.

mod device;
mod example;
mod kinematics;
mod motors;

use stiction_firmware::pantograph::{Encoder, Geometry, HandleMount};

fn geometry() -> Geometry {
    let encoder = Encoder {
        counts_per_turn: 40_000,
        reversed: false,
        offset: 0.0,
    };
    Geometry {
        origin: [0.0, -0.1],
        base: 0.05,
        proximal: [0.06, 0.06],
        distal: [0.09, 0.09],
        encoders: [
            Encoder {
                offset: 2.4,
                ..encoder
            },
            Encoder {
                offset: 0.7,
                reversed: true,
                ..encoder
            },
            Encoder {
                counts_per_turn: 4_096,
                ..encoder
            },
        ],
        handle: HandleMount::Base,
        least_sine: 0.05,
    }
}
