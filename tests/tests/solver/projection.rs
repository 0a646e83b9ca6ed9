//! From a tracker with six degrees of freedom to the planar hand: the position is projected onto the plane, the
//! rotation becomes its twist about the plane's normal, unwrapped over the path, and the depth is passed through.

use proptest::prelude::*;
use std::f64::consts::TAU;
use stiction_core::{Axis, Projection, TrackerSample};
use stiction_tests::random::same_every_run;
use stiction_tests::{Number, close};

type Quaternion = [f64; 4];

fn sample<R: Number>(position: [f64; 3], orientation: Quaternion) -> TrackerSample<R::Si> {
    TrackerSample {
        position: position.map(R::si),
        orientation: orientation.map(R::si),
        held: true,
    }
}

fn about([x, y, z]: [f64; 3], angle: f64) -> Quaternion {
    let (sin, cos) = (angle / 2.0).sin_cos();
    [x * sin, y * sin, z * sin, cos]
}

/// a b: b first, then a.
fn product(a: Quaternion, b: Quaternion) -> Quaternion {
    let ([ax, ay, az, aw], [bx, by, bz, bw]) = (a, b);
    [
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    ]
}

fn axis(index: usize, negative: bool) -> Axis {
    Axis { index, negative }
}

fn direction(axis: Axis) -> [f64; 3] {
    let mut unit = [0.0; 3];
    unit[axis.index] = if axis.negative { -1.0 } else { 1.0 };
    unit
}

fn cross([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> [f64; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// All 24 planes.
fn planes() -> impl Iterator<Item = [Axis; 2]> {
    let axes = || {
        [0, 1, 2]
            .into_iter()
            .flat_map(|i| [axis(i, false), axis(i, true)])
    };
    axes()
        .flat_map(move |a| axes().map(move |b| [a, b]))
        .filter(|[a, b]| a.index != b.index)
}

fn xy<R: Number>() -> Projection<R::Si> {
    Projection::new([axis(0, false), axis(1, false)]).expect("two different axes")
}

fn every_plane<R: Number>(position: [f64; 3], angle: f64, tilt: f64) {
    for [a, b] in planes() {
        let (x, y) = (direction(a), direction(b));
        let normal = cross(x, y);
        let tilted = product(about(x, tilt), about(normal, angle));
        let mut projection = Projection::new([a, b]).expect("two different axes");
        let hand = projection
            .planar(&sample::<R>(position, tilted))
            .expect("a finite sample");
        R::near("x", R::wide(hand.position[0]), dot(position, x));
        R::near("y", R::wide(hand.position[1]), dot(position, y));
        R::near("depth", R::wide(hand.depth), dot(position, normal));
        R::near("phi", R::wide_angle(hand.angle), angle);
    }
}

proptest! {
    #![proptest_config(same_every_run(200))]

    #[test]
    fn every_plane_sees_its_own_rotation(p in [-2.0..2.0f64, -2.0..2.0, -2.0..2.0], angle in -3.1..3.1f64, tilt in -2.5..2.5f64) {
        every_plane::<f64>(p, angle, tilt);
        every_plane::<f32>(p, angle, tilt);
    }
}

fn unwraps<R: Number>() {
    for rate in [0.5, -0.5] {
        let mut projection = xy::<R>();
        for i in 0..2000 {
            let angle = rate * f64::from(i);
            // A quaternion and its opposite are the same rotation; trackers jump between the two.
            let sign = if i % 3 == 0 { -1.0 } else { 1.0 };
            let turned = about([0.0, 0.0, 1.0], angle.rem_euclid(TAU)).map(|q| sign * q);
            let hand = projection
                .planar(&sample::<R>([0.0; 3], turned))
                .expect("a finite sample");
            close("phi", R::wide_angle(hand.angle), angle, R::ANALYTIC * 10.0);
        }
    }
}

#[test]
fn rotation_is_unwrapped_over_many_turns() {
    unwraps::<f64>();
    unwraps::<f32>();
}

#[test]
fn sample_that_is_no_pose_is_refused_and_forgotten() {
    let good = sample::<f64>([1.0, 2.0, 3.0], about([0.0, 0.0, 1.0], 1.0));
    let mut projection = xy::<f64>();
    projection.planar(&good);
    let before = projection;
    for bad in [f64::NAN, f64::INFINITY] {
        for k in 0..3 {
            let mut sample = good;
            sample.position[k] = bad;
            assert_eq!(projection.planar(&sample), None);
        }
        for k in 0..4 {
            let mut sample = good;
            sample.orientation[k] = bad;
            assert_eq!(projection.planar(&sample), None);
        }
    }
    let zero = TrackerSample {
        orientation: [0.0; 4],
        ..good
    };
    assert_eq!(projection.planar(&zero), None);
    assert_eq!(projection, before);
}

#[test]
fn undefined_twist_keeps_the_last_angle() {
    let mut projection = xy::<f64>();
    let turned = sample::<f64>([0.0; 3], about([0.0, 0.0, 1.0], 1.0));
    let last = projection.planar(&turned).expect("a finite sample").angle;
    let overturned = sample::<f64>([0.0; 3], [1.0, 0.0, 0.0, 0.0]);
    assert_eq!(
        projection
            .planar(&overturned)
            .expect("a finite sample")
            .angle,
        last
    );
}

#[test]
fn length_of_the_quaternion_does_not_matter() {
    let unit = about([0.0, 0.0, 1.0], 1.0);
    for size in [1e-3, 1e3] {
        let hand = xy::<f64>().planar(&sample::<f64>([0.0; 3], unit.map(|q| q * size)));
        close(
            "phi",
            hand.expect("a finite sample").angle.radians(),
            1.0,
            1e-9,
        );
    }
}

#[test]
fn plane_needs_two_different_axes() {
    for [a, b] in [[0, 0], [2, 2], [0, 3], [3, 1]] {
        assert_eq!(
            Projection::<f64>::new([axis(a, false), axis(b, true)]),
            None
        );
    }
}

/// In every plane, whatever the twist and the length of the quaternion.
fn says_where_it_is_tilted<R: Number>() {
    for ([a, b], size) in planes().flat_map(|plane| [1e-15, 1.0, 1e15].map(|size| (plane, size))) {
        let normal = cross(direction(a), direction(b));
        for degrees in [0.0, 90.0, 169.9, 170.1, 179.0, 180.0, 189.9, 190.1_f64] {
            let swing = about(direction(a), degrees.to_radians());
            let turned = product(swing, about(normal, 0.7)).map(|q| q * size);
            let mut projection = Projection::new([a, b]).expect("two different axes");
            let hand = projection.planar(&sample::<R>([0.0; 3], turned));
            let tilted = hand.expect("a finite sample").tilted;
            assert_eq!(
                tilted,
                (170.0..190.0).contains(&degrees),
                "{degrees} {size}"
            );
        }
    }
}

#[test]
fn sample_far_out_of_the_plane_is_tilted() {
    says_where_it_is_tilted::<f64>();
    says_where_it_is_tilted::<f32>();
}
