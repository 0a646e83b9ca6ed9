//! The load on a sliding foot, against statics written out: wherever the foot is now, the moment is that about the foot at which an edge of
//! the dynamic cone bears the load.

use super::*;
use crate::fixtures::bench::{Bench, HandAt, Plain, derivative, second_derivative};
use crate::fixtures::{Random, sampled};
use crate::moment::Sliding;
use crate::real::Fixed;

const FRICTIONS: [f64; 6] = [0.0, 0.1, 0.7, 3.0, 10.0, 50.0];

/// A body at some pose under some pull.
struct Case {
    bench: Bench,
    hand: HandAt,
    theta: f64,
    foot: f64,
    sign: f64,
    /// cos(lambda)
    cos: f64,
}

fn cases() -> impl Iterator<Item = Case> {
    let all = (0..240).map(|seed| {
        let mut random = Random(seed);
        let mu = FRICTIONS[seed as usize % FRICTIONS.len()];
        Case {
            bench: Bench::random(&mut random, [mu + 0.1, mu, 0.01]),
            hand: HandAt {
                place: random.vector() * 2.0,
                angle: 3.0 * random.next(),
            },
            theta: 3.0 * random.next(),
            foot: random.next(),
            sign: random.next().signum(),
            cos: 1.0 / libm::hypot(1.0, mu),
        }
    });
    sampled(all, 7)
}

impl Case {
    fn slides<R: Plain>(&self, theta: f64, foot: f64) -> Moment<R, Sliding<R>> {
        let scene = self.bench.scene::<R>().expect("a sound scene");
        let load = self
            .bench
            .pivot::<R>(theta, foot)
            .load(&scene, &self.bench.grip(&self.hand));
        let surface = scene.surface(0);
        load.sliding(&scene, &surface, &surface.sliding(R::of(self.sign)))
    }

    fn moment(&self, theta: f64) -> f64 {
        self.cos * self.bench.sliding_moment(&self.hand, theta, self.sign)
    }
}

/// M(theta) times cos(lambda), at many angles, computed from the body at another angle and with its foot elsewhere.
#[test]
fn moment_is_that_about_the_foot_of_the_slide() {
    for case in cases() {
        let moment = case.slides::<f64>(case.theta, case.foot);
        for i in -8..=8 {
            let turn = 0.4 * f64::from(i);
            let (sin, cos) = libm::sincos(turn);
            let Vec2 { x, y } = moment.hold;
            let first = moment.couple - moment.stiffness * turn + cos * y - sin * x;
            let found = moment
                .harmonic
                .falls(moment.harmonic.moment(first), sin, (cos, sin));
            let should = case.moment(case.theta + turn);
            assert!((found - should).abs() < 1e-12, "{i}: {found} {should}");
            let turned = case.slides::<f64>(case.theta + turn, -case.foot);
            assert!((turned.now() - should).abs() < 1e-12, "{i}");
        }
    }
}

/// The derivatives of M, and bounds of them that are no looser than a few times the bounded values.
#[test]
fn derivatives_are_those_of_the_moment() {
    for case in cases() {
        let moment = case.slides::<f64>(case.theta, case.foot);
        let falls = |theta: f64| -derivative(|theta| case.moment(theta), theta);
        let stiffens = |theta: f64| -second_derivative(|theta| case.moment(theta), theta);
        let size = moment.curvature_bound() + moment.stiffness;
        let off = moment.stability() - falls(case.theta);
        assert!(off.abs() < 1e-8 * size, "{off}");
        let off = moment.harmonic.stiffening(moment.hold.y) - stiffens(case.theta);
        assert!(off.abs() < 1e-5 * size, "{off}");
        let angles = || (0..128).map(|i| f64::from(i) / 128.0 * core::f64::consts::TAU);
        let most = angles().map(|a| stiffens(a).abs()).fold(0.0, f64::max);
        let bound = moment.curvature_bound();
        assert!(
            most <= bound * 1.001 && bound <= 2.5 * most,
            "{most} {bound}"
        );
        for turn in [0.0, 0.3, -1.1, 2.5] {
            let (sin, cos) = libm::sincos(turn);
            let Vec2 { x, y } = moment.hold;
            let slope = moment
                .harmonic
                .slope(moment.stiffness + cos * x + sin * y, (cos, sin));
            assert!((slope - falls(case.theta + turn)).abs() < 1e-8 * size);
            let second = moment.harmonic.second(cos * y - sin * x, (cos, sin));
            let should = stiffens(case.theta + turn);
            assert!((second - should).abs() < 1e-5 * size, "{second} {should}");
        }
    }
}

/// In every number type to its digits: large and small friction lose none.
fn moment_has_its_digits<R: Plain>() {
    let mut worst = 0.0_f64;
    for case in cases() {
        let moment = case.slides::<R>(case.theta, case.foot);
        let size = 4.0 + case.hand.place.length() + case.hand.angle.abs();
        let off = moment.now().plain() - case.moment(case.theta);
        worst = worst.max(off.abs() / (size * R::EPSILON.plain()));
    }
    assert!(worst < 32.0, "{worst}");
}

#[test]
fn moment_has_its_digits_in_every_number_type() {
    moment_has_its_digits::<f64>();
    moment_has_its_digits::<f32>();
    moment_has_its_digits::<Fixed>();
}

/// The foot moves to where (t + s mu n)·F = 0, that is t·(p_h - A + W) - s mu N, whatever the number type.
fn foot_is_where_the_edge_bears<R: Plain>() {
    for case in cases() {
        let scene = case.bench.scene::<R>().expect("a sound scene");
        let grip = case.bench.grip::<R>(&case.hand);
        let mut pivot = case.bench.pivot::<R>(case.theta, case.foot);
        let edge = pivot.surface(&scene).sliding(R::of(case.sign));
        pivot.slide(&scene, &grip, &edge);
        let [normal, tangent] = case.bench.axes();
        let (force, _) = case.bench.load(&case.hand, case.theta, 0.0);
        let level = -normal.dot(force);
        let should = tangent.dot(force) - case.sign * case.bench.friction[1] * level;
        let unit = R::EPSILON.plain() * 64.0 / case.cos;
        let off = pivot.foot.plain() - should;
        assert!(off.abs() < unit * (4.0 + level.abs()), "{off} for {should}");
        let found = case.bench.sliding_foot(&case.hand, case.theta, case.sign);
        assert!((found - should).abs() < 1e-12 * (1.0 + should.abs()));
    }
}

#[test]
fn foot_is_where_the_edge_bears_in_every_number_type() {
    foot_is_where_the_edge_bears::<f64>();
    foot_is_where_the_edge_bears::<f32>();
    foot_is_where_the_edge_bears::<Fixed>();
}

/// While the hand moves and the body turns the foot moves by a margin; the drive is the component that presses and turns, the foot follows
/// the rest.
#[test]
fn foot_moves_with_hand_and_turn() {
    let mut random = Random(3);
    for case in cases() {
        let (bench, sign) = (&case.bench, case.sign);
        let scene = bench.scene::<f64>().expect("a sound scene");
        let surface = scene.surface(0);
        let edge = surface.sliding(sign);
        let load = bench
            .pivot::<f64>(case.theta, case.foot)
            .load(&scene, &bench.grip(&case.hand));
        let (way, turn) = (random.vector(), random.next());
        let displacement = Displacement { hand: way, turn };
        let margin = load.foot(&edge, &displacement);
        let begin = bench.sliding_foot(&case.hand, case.theta, sign);
        let drive = load.sliding_drive((&surface, &edge), &displacement);
        for (part, angle) in [(0.0, 0.0), (1.0, 0.0), (0.3, 0.7), (0.0, -2.0), (2.0, 1.4)] {
            let hand = case.hand.on((way, turn), part);
            let moved = bench.sliding_foot(&hand, case.theta + angle, sign) - begin;
            let (sin, cos) = libm::sincos(angle);
            let Vec2 { x, y } = margin.turning;
            let found = margin.start + margin.along * part - x * (1.0 - cos) + y * sin;
            assert!((found - moved * case.cos).abs() < 1e-12, "{found} {moved}");
            // The moment grows by tau (k dphi + Im(e^{-iϑ} zp)), all times cos(lambda).
            let with = bench.sliding_moment(&hand, case.theta + angle, sign);
            let without = bench.sliding_moment(&case.hand, case.theta + angle, sign);
            let grows = drive.couple + cos * drive.hold.y - sin * drive.hold.x;
            assert!(((with - without) * case.cos - part * grows).abs() < 1e-12);
        }
    }
}

/// A hand that only presses, without tangential motion, moves the foot by the friction alone.
#[test]
fn foot_gives_way_to_a_press_by_mu() {
    for mu in FRICTIONS {
        let friction = crate::friction::Coulomb::<f64>::from_coefficients(mu + 1.0, mu, 0.01);
        let surface = Surface {
            friction,
            ..Surface::NOWHERE
        };
        for sign in [1.0, -1.0] {
            let edge = surface.sliding(sign);
            let press = Displacement {
                hand: Vec2::new(0.0, -1.0),
                turn: 0.0,
            };
            let along = unloaded().foot(&edge, &press).along / edge.cos;
            assert!((along + sign * mu).abs() < 1e-12 * (1.0 + mu), "{along}");
            let pressing = press.pressing(&surface, &edge).hand;
            let should = Vec2::new(sign * mu, -1.0) * edge.cos;
            assert!((pressing - should).length() < 1e-12);
        }
    }
}
