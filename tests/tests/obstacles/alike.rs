//! Runs that have to end alike: in a mirror, and with the hand's path cut into more or fewer frames.

use stiction_core::{Evolution, Fixed};
use stiction_judge::{Frame, Status};
use stiction_tests::obstacles::Run;
use stiction_tests::obstacles::mirrored;
use stiction_tests::obstacles::worlds::{World, world};
use stiction_tests::{Number, times};

fn number_of_scenes() -> u64 {
    times(200, 1000)
}

/// How far two poses are apart, by the body's size (rad).
fn apart(world: &World, one: [f64; 3], other: [f64; 3]) -> f64 {
    let way = |k: usize| (one[k] - other[k]).abs();
    (way(0).max(way(1)) / world.among.setup.size()).max(way(2))
}

/// A number type's bound of distances, of the body's size: a hundred times that of a gap.
fn bound<R: Number>() -> f64 {
    100.0 * R::GAP
}

/// The frames of a run along hands.
fn frames<R: Number>(world: &World, hands: &[[f64; 3]]) -> Vec<Frame> {
    let mut run = Run::<R>::start(&world.among, Evolution::Path, hands[0]);
    let first = run.frame.clone();
    let others = hands[1..].iter().map(|&hand| run.step(hand).clone());
    [first].into_iter().chain(others).collect()
}

/// Where two runs differ first, in the pose that a mirror or nothing makes of the second one, and whether all frames of both are `ok`.
fn difference<R: Number>(
    world: &World,
    [ones, others]: [&[Frame]; 2],
    seen: fn([f64; 3]) -> [f64; 3],
) -> Option<(usize, bool)> {
    let is_apart =
        |(one, other): (&Frame, &Frame)| apart(world, one.pose, seen(other.pose)) > bound::<R>();
    let first = ones.iter().zip(others).position(is_apart)?;
    let mut all = ones.iter().chain(others);
    Some((first, all.all(|frame| frame.status == Status::Ok)))
}

/// No more scenes than this part of them differ from their mirror image: in f64 none, in the others where rounding decides which of two
/// contacts opens, or whether one slips.
fn mirror_images_are_alike<R: Number>(most: f64) {
    let mut differ = Vec::new();
    for number in 0..number_of_scenes() {
        let world = world(number);
        let image = world.mirrored();
        let ones = frames::<R>(&world, &world.hands());
        let others = frames::<R>(&image, &image.hands());
        let difference = difference::<R>(&world, [&ones, &others], mirrored::pose);
        differ.extend(difference.map(|(frame, is_ok)| (number, frame, is_ok)));
    }
    let count = differ.len() as f64;
    let allowed = most * number_of_scenes() as f64;
    assert!(count <= allowed, "{} of {allowed}: {differ:?}", R::NAME);
}

#[test]
fn mirror_images_of_scenes_are_alike() {
    mirror_images_are_alike::<f64>(0.0);
    mirror_images_are_alike::<f32>(0.02);
    mirror_images_are_alike::<Fixed>(0.02);
}

/// A step of up to several body sizes ends where a hundred short ones do, unless a status says that it could not be followed: a step has
/// at most 128 slips.
#[test]
fn long_steps_end_where_short_ones_do() {
    let mut odd = Vec::new();
    for number in 0..number_of_scenes() {
        let world = world(number);
        let (ends, corners): (Vec<_>, Vec<_>) = world.keyframes.iter().copied().unzip();
        let long = frames::<f64>(&world, &corners);
        let short = frames::<f64>(&world, &world.hands());
        let at_ends: Vec<Frame> = ends.iter().map(|&frame| short[frame].clone()).collect();
        let difference = difference::<f64>(&world, [&long, &at_ends], |pose| pose);
        odd.extend(
            difference
                .filter(|&(_, is_ok)| is_ok)
                .map(|(frame, _)| (number, frame)),
        );
    }
    assert!(odd.is_empty(), "{odd:?}");
}
