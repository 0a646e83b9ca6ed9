//! Random slips: where one ends, only the rounding is left, whatever the ratio of its magnitudes; a vertex that hardly presses has none.

use super::*;
use crate::fixtures::{self, Random, sampled};

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
    for seed in sampled(0..20_000, 499) {
        let case = Random(seed).slip();
        let Ok(slip) = case.find() else { continue };
        let (force, moment) = case.load(slip.slide * case.sign, slip.turn);
        // The effect on them of a rounding of the slide.
        let [_, _, _, decay] = beginning(&case);
        let size = 1.0 + case.force.length_bound() + case.stiffness + decay;
        let [left, excess] = [moment, case.excess(force)].map(|x| x.abs() / size);
        assert!(
            left < 8.0 * EPSILON && excess < 8.0 * EPSILON,
            "{seed}: {left} {excess} {case:?}"
        );
        count += 1;
    }
    assert!(cfg!(miri) || count > 1000, "{count}");
}

/// A vertex that presses by no more than the rounding of its force may just as well be lifted: no slip of it is certain.
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

/// A vertex that is held at itself and pulled exactly to (E3) slides by nothing, and otherwise by what it is pulled beyond that; one that
/// is out of balance by more than 2^-19, or not driven, has no slip worth mentioning.
#[test]
fn slip_begins_at_the_balance() {
    let scene = fixtures::scene::<2, 1>(&[[0.0, 0.0], [1.0, 0.0]], &[0.0]);
    let pivot = fixtures::pivot(0.0);
    let surface = pivot.surface(&scene);
    let micro = <f64 as Real>::MICRO;
    for sign in [1.0, -1.0] {
        let drive = (surface.friction).drive(surface.normal, surface.tangent * sign);
        // Perpendicular to the drive.
        let balanced = Vec2::new(drive.y * sign, -drive.x * sign);
        for (more, turn, slips) in [
            (0.0, 0.0, true),
            (-1e-6, 0.0, false),
            (1e-6, 0.0, true),
            (1e-6, micro, true),
            (1e-6, 1.5 * micro, false),
        ] {
            let grip = Grip {
                holding_point: Vec2::ZERO,
                hand: balanced + Vec2::new(sign * more, 0.0),
                angle: Angle::from_radians(turn),
            };
            let load = pivot.load(&scene, &grip);
            let found = ShortSlip::find(&scene, (&pivot, &load), &grip, sign);
            let about = found.map_or_else(|about| about, |slip| Some(slip.slide * sign));
            assert_eq!(about.is_some(), slips, "{sign} {more} {turn}");
            let off = about.map_or(0.0, |about| about - more);
            assert!(off.abs() < 1e-15, "{sign} {more} {turn}: {off}");
        }
    }
}
