//! A path resampled to a rate begins and ends with its own first and last samples.

use stiction_core::Hand;
use stiction_scene::{HandPath, Sample};

fn sample(t: f64) -> Sample {
    Sample {
        t,
        hand: Hand::new(t, -t, 0.0),
    }
}

#[test]
fn samples_that_are_next_to_no_time_apart_are_two_frames() {
    let samples = vec![sample(0.0), sample(1e-52)];
    let path = HandPath::new(samples.clone());
    assert_eq!(path.frames(Some(8.0)).collect::<Vec<_>>(), samples);
}

#[test]
fn both_ends_are_frames_however_near_to_a_step_of_the_rate() {
    for off in [-1e-7, -1e-9, 0.0, 5e-9, 1e-7] {
        let (begin, end) = (0.25, 1.25 + off);
        let path = HandPath::new(vec![sample(begin), sample(0.7), sample(end)]);
        let frames: Vec<_> = path.frames(Some(4.0)).collect();
        assert_eq!(frames.len(), 5, "{off}");
        assert_eq!(frames.first(), Some(&sample(begin)), "{off}");
        assert_eq!(frames.last(), Some(&sample(end)), "{off}");
        assert_eq!(path.sample(4, 4.0), Some(sample(end)), "{off}");
    }
}
