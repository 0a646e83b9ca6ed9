//! Fixtures of the integration tests: scenes in f64 that any number type can run, a driver that moves the hand and
//! collects frames as f64, an independent judge of the laws, and random scenes.

pub mod counted;
pub mod draw;
pub mod expect;
pub mod extremes;
pub mod haptic;
pub mod laws;
pub mod number;
pub mod obstacles;
pub mod pantograph;
pub mod random;
pub mod reference;
pub mod run;
pub mod scenes;
pub mod setup;
pub mod station;

pub use expect::{change, close, times};
pub use laws::judge;
pub use number::Number;
pub use random::Scenario;
pub use run::{Frame, Run, RunOf};
pub use setup::Setup;

/// Instantiates a test for every generic function `name::<R>(evolution)`: for every number type and both evolutions.
#[macro_export]
macro_rules! test_each {
    ($($module:ident::$case:ident),* $(,)?) => {$(
        #[test]
        fn $case() {
            for evolution in stiction_core::Evolution::ALL {
                println!("f64 {evolution:?}");
                $module::$case::<f64>(evolution);
                println!("f32 {evolution:?}");
                $module::$case::<f32>(evolution);
                println!("fixed {evolution:?}");
                $module::$case::<stiction_core::Fixed>(evolution);
            }
        }
    )*};
}

/// Instantiates tests `test: case` of generic functions `case::<R>(evolution)`: for the number types of boards and both evolutions.
#[macro_export]
macro_rules! test_on_boards {
    ($($test:ident: $case:ident),* $(,)?) => {$(
        #[test]
        fn $test() {
            for evolution in stiction_core::Evolution::ALL {
                $case::<f32>(evolution);
                $case::<stiction_core::Fixed>(evolution);
            }
        }
    )*};
}

/// The example in the README, as a test.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
