//! Text as a recorded hand path: either it is refused with a message that names the file, or its samples start at a
//! finite pose, their times increase, and resampling keeps both ends.

use crate::scene_file::is_clear;
use stiction_scene::{HandPath, Placement, Source};

/// The first byte chooses the format and a rate; the others are the file.
///
/// # Panics
/// If a property is violated.
pub fn hand_path(bytes: &[u8]) {
    let Some((&kind, rest)) = bytes.split_first() else {
        return;
    };
    let Ok(text) = std::str::from_utf8(rest) else {
        return;
    };
    let name = ["path.csv", "path.tum", "path.txt", "path.none"][usize::from(kind & 3)];
    let path = match HandPath::parse(&Source::new(name, text), &Placement::default()) {
        Err(error) => return is_clear(&error),
        Ok(path) => path,
    };
    let samples: Vec<_> = path.frames(None).collect();
    assert!(samples.is_sorted_by(|a, b| a.t < b.t), "times increase");
    let (Some(first), Some(last)) = (samples.first(), samples.last()) else {
        panic!("a path has no samples");
    };
    assert!(first.hand.is_finite() && samples.iter().all(|s| s.t.is_finite()));
    let rate = f64::from(1 << (kind >> 4));
    let count = path.frame_count(Some(rate));
    if count > HandPath::LARGEST_COUNT {
        return;
    }
    let resampled: Vec<_> = path.frames(Some(rate)).take(1000).collect();
    assert_eq!(resampled.first(), Some(first), "both ends are frames");
    assert!(resampled.is_sorted_by(|a, b| a.t < b.t), "times increase");
    if resampled.len() == count {
        assert_eq!(
            resampled.last().map(|s| s.t),
            Some(last.t),
            "both ends are frames"
        );
    }
}
