//! Random slips: where one ends, nothing is left but the rounding, however its sizes compare; and what hardly presses has none.

use super::*;
use crate::fixtures::Random;

impl Random {
    /// From 2^-6 to 4 or so, of either sign.
    fn size(&mut self) -> f64 {
        let size = libm::exp2(3.0 * self.next() - 1.0);
        if self.next() < 0.0 { -size } else { size }
    }
    fn slip(&mut self) -> Case {
        let normal = self.size().abs();
        let sign = if self.next() < 0.0 { -1.0 } else { 1.0 };
        // Beyond (E3) by up to a half, as after sticking.
        let beyond = libm::exp2(7.0 * self.next() - 8.0);
        Case {
            stiffness: libm::exp2(6.0 * self.next() - 4.0),
            lever: Vec2::new(self.next(), self.next()),
            weight: 0.0,
            force: Vec2::new(sign * (MU_D * normal + beyond), -normal),
            lack: 0.0,
            sign,
        }
    }
}

/// At the end of a short slip the moment is balanced and the drive used up, to within some roundings.
#[test]
fn short_slip_ends_in_balance() {
    const EPSILON: f64 = <f64 as Real>::EPSILON;
    let mut count = 0;
    for seed in 0..20_000 {
        let case = Random(seed).slip();
        let Ok(slip) = case.find() else { continue };
        let (force, moment) = case.load(slip.slide * case.sign, slip.turn);
        // A rounding of the slide is so much of them.
        let [_, _, _, decay] = beginning(&case);
        let size = 1.0 + case.force.reach() + case.stiffness + decay;
        let [left, excess] = [moment, case.excess(force)].map(|x| x.abs() / size);
        assert!(
            left < 8.0 * EPSILON && excess < 8.0 * EPSILON,
            "{seed}: {left} {excess} {case:?}"
        );
        count += 1;
    }
    assert!(count > 1000, "{count}");
}

/// What presses by no more than the rounding of its force may just as well be lifted: no slip of it is certain.
#[test]
fn slip_without_pressure_is_not_certain() {
    const ROUNDING: f64 = 4.0 * <f64 as Real>::EPSILON;
    for (press, is_certain) in [(0.25, false), (0.5, false), (64.0, true)] {
        let case = Case {
            stiffness: 1.0,
            lever: Vec2::new(0.0, 0.5),
            weight: 0.0,
            force: Vec2::new(press * ROUNDING, -press * ROUNDING),
            lack: 0.0,
            sign: 1.0,
        };
        assert_eq!(
            case.find().is_ok(),
            is_certain,
            "{press}: {:?}",
            case.find()
        );
    }
}
