//! The state is small enough for a microcontroller and for one snapshot per frame.

use stiction_core::{Fixed, State};

#[test]
fn state_fits_into_256_bytes() {
    let sizes = [
        ("f32", size_of::<State<f32>>()),
        ("f64", size_of::<State<f64>>()),
        ("Fixed", size_of::<State<Fixed>>()),
    ];
    for (number, size) in sizes {
        println!("State<{number}>: {size} bytes");
        assert!(size <= 256, "{number}: {size} bytes");
    }
}
