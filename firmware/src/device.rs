//! The two loops of a device, free of hardware: the servo loop outputs a safe force at every tick; the solver computes a pose and the next
//! force from a sample of the hand, in turns, each after a tick. A turn may take longer than a tick.
//!
//! ```text
//! servo.rs       Servo::tick(now): the hand is measured, the force is output
//! controller.rs  Controller::turn(sample, servo) -> pose, force, flags
//! want.rs        the force that it demands: that of the springs, or less where the hand has not paid for a weight
//! change.rs      a new scene or new parameters in mid-contact: refused, or the body settles again where it is
//! refusal.rs     why something cannot be used
//! store.rs       the scene as it was given, stored for that
//! ports.rs       the interfaces of a board: Source of samples, Actuators
//! ```
//!
//! ```
//! use stiction_core::{Description, Evolution, Hand, SurfaceDescription};
//! use stiction_firmware::device::{Controller, FromLine, NoActuators, Sample, Servo, Settings};
//!
//! let description = Description {
//!     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
//!     start: [0.0, 0.03, 0.0],
//!     weight: 0.0,
//!     holding_point: Some([0.0, 0.02]),
//!     reach: 0.0,
//!     stiffness_translation: 500.0,
//!     stiffness_rotation: 0.5,
//!     surfaces: &[SurfaceDescription {
//!         normal: [0.0, 1.0],
//!         offset: 0.0,
//!         friction_static: 0.5,
//!         friction_dynamic: 0.3,
//!         memory: None,
//!     }],
//!     obstacles: &[],
//! };
//! let mut controller: Controller<f32, 4, 1> = Controller::new(&description, &Settings::default())?;
//! let mut servo = Servo::new((FromLine, NoActuators));
//! for i in 0..100u16 {
//!     let now_us = u32::from(i) * 1_000;
//!     let sample = Sample {
//!         hand: Hand::new(0.0, 0.045, 0.0), // 5 mm deep: 2.5 N
//!         number: i,
//!         received_us: now_us,
//!     };
//!     servo.tick(now_us);
//!     let turn = controller.turn(Some(&sample), &mut servo);
//!     assert!(turn.force.force[1] <= 0.1 * f32::from(i + 1) + 1e-5); // at first 100 N/s
//! }
//! servo.tick(120_000);
//! assert_eq!(servo.force().force, [0.0, 0.0]); // silence
//! # Ok::<(), stiction_firmware::device::Refusal>(())
//! ```

mod change;
mod controller;
mod ports;
mod refusal;
mod servo;
mod settings;
mod store;
mod want;

pub use change::Placement;
pub(crate) use controller::NO_HAND;
pub use controller::{Controller, Pose, Turn};
pub use ports::{Actuators, FromLine, NoActuators, Outage, Sample, Source};
pub use refusal::Refusal;
pub(crate) use servo::Begun;
pub use servo::{LockServo, Servo};
pub use settings::Settings;
pub use stiction_wire::Parameters;
