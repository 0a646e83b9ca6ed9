//! The state is small enough for a microcontroller and for one snapshot per frame. Between two steps it keeps what is needed to go on: the body,
//! the hand, the word under way with the motions that are struck off, a motion and the bracket of its search; not the windows of the
//! search, which are evaluated again.

use stiction_core::{Fixed, State};

/// Bytes in a number type of four.
const MOST: usize = 512;

#[test]
fn state_fits_into_its_bytes() {
    let sizes = [
        ("f32", size_of::<State<f32>>(), MOST),
        ("Fixed", size_of::<State<Fixed>>(), MOST),
        ("f64", size_of::<State<f64>>(), 2 * MOST),
    ];
    for (number, size, most) in sizes {
        println!("State<{number}>: {size} bytes");
        assert!(size <= most, "{number}: {size} bytes");
    }
}
