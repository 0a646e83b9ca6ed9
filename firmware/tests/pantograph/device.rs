//! The device as a whole: counts in, duties out.

use super::geometry;
use super::motors::motor;
use crate::with;
use stiction_core::Wrench;
use stiction_firmware::device::{Actuators, Source};
use stiction_firmware::pantograph::{Counters, Fault, Geometry, NoForce, NoMotors, Pantograph};

struct Counts(Option<[u16; 3]>);

impl Counters for Counts {
    fn counts(&mut self) -> Option<[u16; 3]> {
        self.0
    }
    fn held(&mut self) -> bool {
        true
    }
}

#[test]
fn the_whole_device_measures_and_pushes() {
    let g = geometry();
    let ((a, left), (_, right), (_, handle)) = (motor(), motor(), motor());
    let mut device = Pantograph::new(&g, Counts(Some([7; 3])), (left, right, handle)).unwrap();
    let push = Wrench {
        force: [0.0, 1.0],
        moment: 0.0,
    };
    // Not before it has been measured.
    assert_eq!(device.give(&push), Err(NoForce::Mechanism(Fault::NotRead)));
    let sample = device.sample(123).unwrap();
    assert_eq!(sample.received_us, 123);
    device.give(&push).unwrap();
    assert!(*a.duty.borrow() > 0);
    let unknown = with(push, |push| push.force[0] = f32::NAN);
    assert_eq!(
        device.give(&unknown),
        Err(NoForce::Mechanism(Fault::NotFinite))
    );
    assert_eq!(*a.duty.borrow(), 0);

    let stretched = Geometry { base: 0.5, ..g };
    let mut device = Pantograph::new(&stretched, Counts(Some([0; 3])), NoMotors).unwrap();
    assert!(device.sample(0).is_none());
    assert_eq!(device.configuration().unwrap_err(), Fault::Unreachable);
    assert_eq!(
        device.give(&push),
        Err(NoForce::Mechanism(Fault::Unreachable))
    );
}

#[test]
fn without_a_home_position_there_is_never_a_sample() {
    let mut shown = None;
    struct Shown<'a>(&'a mut Option<[u16; 3]>);
    impl Counters for Shown<'_> {
        fn counts(&mut self) -> Option<[u16; 3]> {
            // Only the first time they cannot be read.
            self.0.replace([0; 3])
        }
        fn held(&mut self) -> bool {
            true
        }
    }
    let mut device = Pantograph::new(&geometry(), Shown(&mut shown), NoMotors).unwrap();
    for i in 0..100 {
        assert!(device.sample(i * 1_000).is_none());
        assert_eq!(device.configuration().unwrap_err(), Fault::NotRead);
    }
}
