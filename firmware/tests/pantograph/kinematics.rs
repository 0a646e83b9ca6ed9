//! Joint angles to the hand, a wrench to torques, counts to joint angles.

use super::geometry;
use crate::with;
use core::f32::consts::{PI, TAU};
use stiction_core::{Angle, Wrench};
use stiction_firmware::pantograph::{
    Fault, Geometry, GeometryParameter, HandleMount, Joints, Kinematics,
};
use stiction_tests::pantograph::{reference, transposed};
use stiction_tests::station::noise::Random;

const MOUNTS: [HandleMount; 3] = [
    HandleMount::Base,
    HandleMount::LeftLink,
    HandleMount::RightLink,
];

/// Not symmetric, so that nothing cancels.
fn crooked(handle: HandleMount) -> Geometry {
    Geometry {
        origin: [0.02, -0.05],
        base: 0.04,
        proximal: [0.055, 0.065],
        distal: [0.095, 0.085],
        handle,
        ..geometry()
    }
}

fn angles(q: [f32; 3]) -> [Angle<f32>; 3] {
    q.map(Angle::from_radians)
}

/// Joint angles all over the workspace.
fn workspace() -> impl Iterator<Item = [f32; 3]> {
    (0..40).flat_map(|i| {
        (0..40).map(move |j| {
            let (a, b) = (i as f32 / 39.0, j as f32 / 39.0);
            [1.4 + 1.5 * a, 0.2 + 1.5 * b, 20.0 * (a - b)]
        })
    })
}

#[test]
fn the_hand_is_where_the_links_meet() {
    for mount in MOUNTS {
        let g = crooked(mount);
        let kinematics = Kinematics::new(&g).unwrap();
        let mut seen = 0;
        for q in workspace() {
            let Ok(found) = kinematics.solve(&angles(q)) else {
                continue;
            };
            seen += 1;
            let [x, y, phi] = reference(&g, q.map(f64::from));
            let [fx, fy] = found.position.map(f64::from);
            assert!((fx - x).hypot(fy - y) < 1e-6, "{q:?}: {found:?}");
            let turned = f64::from(found.handle.radians()) - phi;
            assert!(turned.abs() < 1e-5, "{q:?}: {found:?}");
        }
        assert!(seen > 1_500, "{seen}");
    }
}

#[test]
fn the_power_of_the_torques_is_that_of_the_wrench() {
    let wrench = Wrench {
        force: [1.7, -2.9],
        moment: 0.083,
    };
    for mount in MOUNTS {
        let g = crooked(mount);
        let kinematics = Kinematics::new(&g).unwrap();
        for q in workspace() {
            let Ok(found) = kinematics.solve(&angles(q)) else {
                continue;
            };
            let torques = found.torques(&wrench).unwrap();
            let powers = transposed(&g, q.map(f64::from), &wrench);
            for (torque, power) in torques.into_iter().zip(powers) {
                // Near the least sine the Jacobian magnifies the rounding of the angles twentyfold.
                let most = 1e-4 * (0.01 + power.abs());
                assert!(
                    (f64::from(torque) - power).abs() < most,
                    "{q:?} {torque} {power}"
                );
            }
        }
    }
}

#[test]
fn where_no_force_can_be_given_it_is_said_and_nothing_is_nan() {
    let wide = with(geometry(), |geometry| geometry.base = 0.12);
    let kinematics = Kinematics::new(&wide).unwrap();
    let fault = |q: [f32; 3]| kinematics.solve(&angles(q)).unwrap_err();
    assert_eq!(fault([PI, 0.0, 0.0]), Fault::Unreachable);
    // Distal links of 0.09 m in line: elbows 0.18 m apart.
    assert_eq!(
        fault([(-0.5f32).acos(), 0.5f32.acos(), 0.0]),
        Fault::Singular
    );
    // Both elbows at the same point.
    assert_eq!(fault([0.0, PI, 0.0]), Fault::Singular);
    assert_eq!(fault([f32::NAN, 1.0, 0.0]), Fault::NotFinite);
    assert_eq!(fault([1.0, 1.0, f32::INFINITY]), Fault::NotFinite);

    let flat = with(wide, |geometry| geometry.least_sine = 0.01);
    let kinematics = Kinematics::new(&flat).unwrap();
    let (mut random, mut solved) = (Random(1), 0);
    for _ in 0..200_000 {
        let mut any = || random.bits() as f32 / (1u64 << 31) as f32 * TAU - TAU;
        let Ok(found) = kinematics.solve(&angles([any(), any(), any()])) else {
            continue;
        };
        solved += 1;
        let torques = found
            .torques(&Wrench {
                force: [5.0, 5.0],
                moment: 0.1,
            })
            .unwrap();
        // 7 N at a lever of 0.06 m, magnified a hundredfold at the most.
        assert!(torques.iter().all(|t| t.abs() < 100.0), "{torques:?}");
    }
    assert!(solved > 10_000, "{solved}");
}

#[test]
fn a_geometry_that_cannot_be_is_refused_by_name() {
    use GeometryParameter as P;
    let refused = |change: &dyn Fn(&mut Geometry)| {
        let error = Kinematics::new(&with(geometry(), change)).unwrap_err();
        (error.parameter, error.to_string())
    };
    let parameter = |change: &dyn Fn(&mut Geometry)| refused(change).0;
    for bad in [f32::NAN, f32::INFINITY, -1.0] {
        assert_eq!(parameter(&|g| g.base = bad), P::Base);
        assert_eq!(parameter(&|g| g.proximal[1] = bad), P::Proximal(1));
        assert_eq!(parameter(&|g| g.distal[0] = bad), P::Distal(0));
        assert_eq!(parameter(&|g| g.least_sine = bad), P::LeastSine);
    }
    assert_eq!(
        parameter(&|g| g.encoders[2].counts_per_turn = 0),
        P::CountsPerTurn(2)
    );
    assert_eq!(
        parameter(&|g| g.encoders[1].offset = f32::NAN),
        P::EncoderOffset(1)
    );
    assert_eq!(
        refused(&|g| g.base = -1.0).1,
        "distance of the base joints (m) is -1, allowed: 0 to 10"
    );
}

#[test]
fn counts_are_unwrapped_for_a_thousand_turns_and_back() {
    let g = geometry();
    let home = [65_000u16, 3, 12_345];
    let mut joints = Joints::new(&g, home);
    let turned = |joints: &mut Joints, counts: i32| {
        let [a, b, c] = home;
        let at = |home: u16, k: i32| home.wrapping_add((counts * k) as u16);
        joints.update([at(a, 1), at(b, 1), at(c, 1)]);
    };
    let most = 4_096 * 1_000;
    for counts in (0..=most).step_by(30_000).chain([most]) {
        turned(&mut joints, counts);
    }
    let [left, right, handle] = joints.angles();
    // The same counter bits, other turns: 40 000 counts for the arms, the right one in the opposite direction.
    assert_eq!((handle.turns, handle.rest), (1_000, 0.0));
    let way = most as f64 / 40_000.0 * std::f64::consts::TAU;
    let radians = |a: Angle<f32>| f64::from(a.turns) * std::f64::consts::TAU + f64::from(a.rest);
    assert!((radians(left) - 2.4 - way).abs() < 1e-6);
    assert!((radians(right) - 0.7 + way).abs() < 1e-6);
    for counts in (-most..=most).rev().step_by(32_767).chain([0]) {
        turned(&mut joints, counts);
    }
    for counts in (-most..0).step_by(32_767).chain([0]) {
        turned(&mut joints, counts);
    }
    let [left, right, handle] = joints.angles();
    assert_eq!([left, right, handle], angles([2.4, 0.7, 0.0]));
}
