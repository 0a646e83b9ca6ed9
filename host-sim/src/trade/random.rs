//! Random scenes as scene files, the same ones in every run: convex bodies of 2 to 6 vertices within 0.1 m, an ordinary grip, 1
//! to 3 surfaces with static friction up to 1.5 and dynamic friction of 0.3 to 0.9 of it, and a hand that moves in four straight
//! lines of a second each. SI units, world frame.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::fmt::Write as _;
use std::ops::Range;

/// The largest size of a body (m).
const SIZE: f64 = 0.1;
/// k_h (N/m)
const STIFFNESS: f64 = 500.0;
/// Straight lines of the hand, a second each.
pub(super) const LEGS: usize = 4;

/// SplitMix64 (Steele, Lea, Flood 2014).
#[derive(Clone, Debug)]
pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(super) fn within(&mut self, range: Range<f64>) -> f64 {
        let part = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        range.start + (range.end - range.start) * part
    }

    fn one_of(&mut self, range: Range<u64>) -> u64 {
        range.start + self.bits() % (range.end - range.start)
    }
}

pub(super) fn scene(random: &mut Random) -> String {
    let vertices = body(random);
    let theta = random.within(-3.0..3.0);
    let place = |[x, y]: [f64; 2]| {
        let (sin, cos) = theta.sin_cos();
        [cos * x - sin * y, sin * x + cos * y]
    };
    let grip = [0.0; 2].map(|_: f64| SIZE * random.within(-0.2..0.2));
    let rotation = STIFFNESS * SIZE * SIZE * 10_f64.powf(random.within(-2.0..0.5));
    let weight = match random.one_of(0..2) {
        0 => 0.0,
        _ => STIFFNESS * SIZE * random.within(0.0..0.3),
    };
    let mut text = format!(
        "[body]\nvertices = {vertices:?}\nstart = [0.0, 0.0, {theta:?}]\nweight = {weight:?}\n\
         [grasp]\npoint = {grip:?}\n[spring]\ntranslation = {STIFFNESS:?}\nrotation = {rotation:?}\n"
    );
    let corners: Vec<_> = vertices.into_iter().map(place).collect();
    let count = random.one_of(1..4) as usize;
    for facing in [FRAC_PI_2, 0.0, 2.0 * FRAC_PI_2].into_iter().take(count) {
        surface(&mut text, random, facing, &corners);
    }
    hand(&mut text, random, place(grip), theta);
    text
}

/// Corners on an ellipse, so that every polygon is strictly convex.
fn body(random: &mut Random) -> Vec<[f64; 2]> {
    let (count, ratio) = (random.one_of(2..7), random.within(0.3..1.0));
    let corner = |i| {
        let angle = TAU * (i as f64 + random.within(-0.35..0.35)) / count as f64;
        let (sin, cos) = angle.sin_cos();
        [0.5 * SIZE * cos, 0.5 * SIZE * ratio * sin]
    };
    (0..count).map(corner).collect()
}

/// A surface that faces the body, rotated slightly; one in four touches it at the start.
fn surface(text: &mut String, random: &mut Random, facing: f64, corners: &[[f64; 2]]) {
    let (sin, cos) = (facing + random.within(-0.4..0.4)).sin_cos();
    let heights = corners.iter().map(|[x, y]| cos * x + sin * y);
    let clearance = match random.one_of(0..4) {
        0 => 0.0,
        _ => SIZE * random.within(0.0..0.6),
    };
    let offset = heights.fold(f64::INFINITY, f64::min) - clearance;
    let friction = random.within(0.0..1.5);
    let dynamic = friction * random.within(0.3..0.9);
    // Writing to a string does not fail.
    let _ = write!(
        text,
        "[[surface]]\nnormal = [{cos:?}, {sin:?}]\noffset = {offset:?}\nstatic = {friction:?}\ndynamic = {dynamic:?}\n"
    );
}

/// Straight lines that reach up to 1.2 body sizes and 1.5 rad away from the grip.
fn hand(text: &mut String, random: &mut Random, [x, y]: [f64; 2], theta: f64) {
    let _ = write!(text, "[hand]\nkeyframes = [[0.0, {x:?}, {y:?}, {theta:?}]");
    for second in 1..=LEGS {
        let [dx, dy] = [0.0; 2].map(|_: f64| 1.2 * SIZE * random.within(-1.0..1.0));
        let phi = theta + random.within(-1.5..1.5);
        let _ = write!(text, ", [{second}.0, {:?}, {:?}, {phi:?}]", x + dx, y + dy);
    }
    text.push_str("]\n");
}
