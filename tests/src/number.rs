//! The number types under test, and the bounds that hold for each of them.

use crate::counted::Counted;
use crate::expect::close;
use stiction_core::{Angle, CordicFixed, Fixed, LibmSingle, MicromathSingle, Real};

/// A number type with its bounds. All bounds are relative to the characteristic size of the bounded quantity.
pub trait Number: Real {
    /// Its name in messages.
    const NAME: &'static str;
    /// Largest error against a closed-form answer.
    const ANALYTIC: f64;
    /// Largest unbalanced force / largest force, and moment / (largest force · L).
    const RESIDUAL: f64;
    /// Largest gap of a contact and largest penetration / L.
    const GAP: f64;
    /// Half the spacing of numbers near 1: the error of one rounding.
    const ROUNDING: f64;

    /// The farthest coordinate (L) and the largest load (k_h L).
    const FARTHEST: f64;

    /// From f64 to the float that the type accepts for SI values.
    fn si(x: f64) -> Self::Si;
    /// From the float in which the type returns SI values.
    fn wide(x: Self::Si) -> f64;

    /// An unwrapped angle (rad), without rounding it to the narrow float.
    fn wide_angle(angle: Angle<Self::Si>) -> f64 {
        f64::from(angle.turns) * std::f64::consts::TAU + Self::wide(angle.rest)
    }
    /// Asserts a closed-form answer, to within the error of the type; says what, both values and the distance.
    #[track_caller]
    fn near(what: &str, got: f64, want: f64) {
        close(what, got, want, Self::ANALYTIC);
    }
    /// `x` rounded to the narrow float.
    fn rounded(x: f64) -> f64 {
        Self::wide(Self::si(x))
    }
}

impl Number for f64 {
    const NAME: &'static str = "f64";
    const ANALYTIC: f64 = 1e-9;
    const RESIDUAL: f64 = 1e-9;
    const GAP: f64 = 1e-9;
    const ROUNDING: f64 = f64::EPSILON / 2.0;
    const FARTHEST: f64 = 1e12;

    fn si(x: f64) -> f64 {
        x
    }
    fn wide(x: f64) -> f64 {
        x
    }
}

impl Number for Counted {
    const NAME: &'static str = "counted f64";
    const ANALYTIC: f64 = f64::ANALYTIC;
    const RESIDUAL: f64 = f64::RESIDUAL;
    const GAP: f64 = f64::GAP;
    const ROUNDING: f64 = f64::ROUNDING;
    const FARTHEST: f64 = f64::FARTHEST;

    fn si(x: f64) -> f64 {
        x
    }
    fn wide(x: f64) -> f64 {
        x
    }
}

/// A type whose interface is f32: its name, its bounds and the farthest coordinate.
macro_rules! narrow {
    ($number:ty, $name:literal, error: $error:expr, gap: $gap:literal, farthest: $farthest:literal) => {
        impl Number for $number {
            const NAME: &'static str = $name;
            const ANALYTIC: f64 = $error;
            const RESIDUAL: f64 = $error;
            const GAP: f64 = $gap;
            const ROUNDING: f64 = f32::EPSILON as f64 / 2.0;
            const FARTHEST: f64 = $farthest;

            fn si(x: f64) -> f32 {
                x as f32
            }
            fn wide(x: f32) -> f64 {
                f64::from(x)
            }
        }
    };
}

narrow!(f32, "f32", error: 1e-4, gap: 1e-5, farthest: 1e6);
narrow!(Fixed, "fixed", error: 1e-4, gap: 1e-5, farthest: 8.0);
narrow!(LibmSingle, "f32 with libm", error: 1e-4, gap: 1e-5, farthest: 1e6);
narrow!(CordicFixed, "fixed with cordic", error: 1e-3, gap: 1e-5, farthest: 8.0);
// Sine and cosine are off by 1.1e-3 each, and so a vertex by 1.6e-3 L; with soft springs, these errors are larger than
// the small forces.
narrow!(MicromathSingle, "f32 with micromath", error: f64::INFINITY, gap: 2e-3, farthest: 1e6);
