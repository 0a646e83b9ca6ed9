//! The queue between an interrupt and the program loses, duplicates and reorders nothing.

use std::thread;
use stiction_firmware::ring::Ring;

#[test]
fn bytes_come_out_as_they_went_in() {
    static RING: Ring<64> = Ring::new();
    const BYTES: usize = 1_000_000;
    let byte = |i: usize| (i.wrapping_mul(2_654_435_761) >> 13) as u8;
    let putter = thread::spawn(move || {
        for i in 0..BYTES {
            while !RING.put(byte(i)) {
                thread::yield_now();
            }
        }
    });
    for i in 0..BYTES {
        let taken = loop {
            match RING.take() {
                Some(taken) => break taken,
                None => thread::yield_now(),
            }
        };
        assert_eq!(taken, byte(i), "byte {i}");
    }
    putter.join().unwrap();
    assert!(RING.is_empty());
}

#[test]
fn what_has_no_room_is_refused_whole() {
    let ring = Ring::<8>::new();
    assert!(ring.put_all(&[1, 2, 3, 4, 5]));
    assert!(!ring.put_all(&[6, 7, 8, 9]));
    assert_eq!((ring.len(), ring.room()), (5, 3));
    assert!(ring.put_all(&[6, 7, 8]) && !ring.put(9));
    let all: Vec<_> = std::iter::from_fn(|| ring.take()).collect();
    assert_eq!(all, [1, 2, 3, 4, 5, 6, 7, 8]);
    assert_eq!(ring.take(), None);
}
