//! The state is small enough for a microcontroller and for one snapshot per frame.

use stiction_core::State;

#[test]
fn state_fits_into_256_bytes() {
    let (single, double) = (size_of::<State<f32>>(), size_of::<State<f64>>());
    println!("State<f32>: {single} bytes, State<f64>: {double} bytes");
    assert!(single <= 256, "{single} bytes");
    assert!(double <= 512, "{double} bytes");
}
