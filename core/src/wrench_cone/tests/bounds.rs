//! At the bounds of the loads that are borne: the accuracy of a facet, the direction in which contacts without friction slide, the residual
//! of single contacts.

use super::*;

const ROUNDING: f64 = 1.0 / 1024.0;

/// Two contacts without friction on a floor bear no pull along it. Forces are distinguished if they exceed the rounding, and less
/// accurately in proportion as the contacts are close together, since the facet is less sharp.
#[test]
fn facet_is_known_as_exactly_as_its_edges_are_apart() {
    for (span, sharp) in [
        (2.0, 1.0),
        (1.0, 1.0),
        (0.125, 0.125),
        (1.0 / 64.0, 1.0 / 64.0),
    ] {
        let (cone, _) = cone(&[(Vec2::ZERO, 0.0, 0.0), (Vec2::new(span, 0.0), 0.0, 0.0)]);
        for (times, yields) in [
            (0.5, false),
            (1.0, false),
            (2.0, true),
            (-1.0, false),
            (-2.0, true),
        ] {
            let load = wrench(times * ROUNDING / sharp, -1.0, -0.5 * span);
            let found = cone.first_yield(load, load, ROUNDING);
            assert_eq!(found, yields.then_some(0.0), "{span} {times}");
        }
    }
}

/// If contacts without friction slide, the load moves the body: by the twist that leaves both on their surfaces, in the direction in which
/// the load does work.
#[test]
fn without_friction_contacts_slide_as_the_load_moves_them() {
    let mut count = 0;
    for seed in sampled(0..2000, 97) {
        let mut random = Random(seed);
        let contacts = contacts(&mut random, true);
        let (cone, edges) = cone(&contacts);
        let load = random.wrench();
        let yields = cone.yields(load, 1e-12, &|_| true);
        let Some(Yield::Slide { first, second }) = yields else {
            continue;
        };
        // Both edges of a contact without friction are its normal.
        let [a, b] = [first.0, second.0].map(|i| edges[2 * i]);
        let twist = a.cross(b);
        let sense = load.dot(twist).signum();
        if load.dot(twist).abs() < 1e-6 {
            continue;
        }
        for (contact, sign) in [first, second] {
            let (lever, angle, _) = contacts[contact];
            let (sin, cos) = libm::sincos(angle);
            let velocity = twist.force + lever.turned() * twist.moment;
            assert!(Vec2::new(-sin, cos).dot(velocity).abs() < 1e-12, "{seed}");
            let along = Vec2::new(cos, sin).dot(velocity) * sense;
            assert!(
                along * sign > 0.0 || along.abs() < 1e-9,
                "{seed}: {along} {sign}"
            );
        }
        count += 1;
    }
    assert!(cfg!(miri) || count > 100, "{count}");
}

/// The residual of a load after a single contact is its component across the contact, at any lever.
#[test]
fn single_contact_leaves_what_is_across() {
    for lever in [0.0, 0.5, 3.0] {
        let (cone, edges) = cone(&[(Vec2::new(lever, 0.0), 0.0, 0.0)]);
        for (along, across) in [(1.0, 0.1), (2.0, -0.3), (0.25, 0.0)] {
            let load = sum(edges[0], wrench(across, 0.0, 0.0), [-along, 1.0]);
            let left = cone.left(load, LITTLE);
            assert!(
                (left - f64::abs(across)).abs() < 1e-12,
                "{lever} {along} {left}"
            );
        }
    }
}

/// In a slot the loads that are borne are collinear, wherever along the slot the contacts are: a load that is off that line by the rounding
/// is borne, and so is a pull of that size.
#[test]
fn slot_bears_to_within_the_rounding() {
    for lever in [0.0, 3.0, -8.0] {
        let line = wrench(0.0, 1.0, lever);
        for angles in [[0.0, core::f64::consts::PI], [0.0, 0.0]] {
            let (cone, _) = cone(&angles.map(|angle| (Vec2::new(lever, 0.0), angle, 0.0)));
            let bears = |load| cone.first_yield(load, load, ROUNDING).is_none();
            for (off, is_borne) in [(0.75, true), (-0.75, true), (1.5, false), (-1.5, false)] {
                let load = sum(line, wrench(off * ROUNDING, 0.0, 0.0), [-1.0, 1.0]);
                assert_eq!(bears(load), is_borne, "{lever} {off}");
            }
            let pull = |times: f64| line.scaled(times * ROUNDING / line.size());
            assert!(bears(pull(0.75)), "{lever}");
            assert_eq!(bears(pull(1.5)), angles[0] != angles[1], "{lever}");
        }
    }
}

#[test]
fn load_is_scaled_in_all_parts() {
    let load = wrench(1.0, -2.0, 3.0);
    for k in [-1.0, 0.25, 8.0] {
        assert_eq!(load.scaled(k), wrench(k, -2.0 * k, 3.0 * k));
        assert_eq!(load.over(k), load.scaled(1.0 / k));
    }
}

/// Components along edges that are almost coplanar are hardly known; even so they leave almost no residual of a load that they bear.
#[test]
fn blunt_edges_bear_to_the_rounding() {
    const LEAVES: f64 = 1e-14;
    let mut count = 0;
    for seed in sampled(0..400, 97) {
        let mut random = Random(seed);
        let lever = random.vector() * 1e-7;
        let mut angle = || 3.0 * random.next();
        let contacts = [(Vec2::ZERO, angle(), 0.5), (lever, angle(), 0.5)];
        let (cone, edges) = cone(&contacts);
        let volume = edges[0].dot(edges[1].cross(edges[2])).abs();
        if volume < 1e-9 {
            continue;
        }
        let mut load = wrench(0.0, 0.0, 0.0);
        for edge in &edges[..3] {
            load = sum(load, *edge, [1.0, -0.6 - 0.4 * random.next()]);
        }
        assert!(cone.bears_on([0, 1, 2], load, LEAVES), "{seed}: {volume}");
        assert!(cone.left(load, LEAVES) <= 2.0 * LEAVES, "{seed}: {volume}");
        count += 1;
    }
    assert!(cfg!(miri) || count > 100, "{count}");
}

/// Two contacts face each other across a line of length 1. The upper edges of their cones rise above it by a slope: each bears
/// half of a push of 1 against it by a normal force of 1 over the slope.
fn wedge_jams_beyond_the_limit<R: Real>()
where
    R::Si: From<f32>,
{
    let little = R::EPSILON * R::from_int(16);
    let mut found = [0; 2];
    for exponent in 0..11 {
        let slope = libm::ldexp(1.0, -exponent);
        let number = |value: f64| R::from_si(R::Si::from(value as f32), R::Si::ONE);
        let (sin, cos) = libm::sincos(libm::atan(0.5 * slope));
        let mut cone = WrenchCone::<R>::default();
        for side in [-1.0, 1.0] {
            cone.add(&Bearing {
                lever: Vec2::new(number(0.5 * side), R::ZERO),
                normal: Vec2::new(number(-side), R::ZERO),
                tangent: Vec2::new(R::ZERO, R::ONE),
                edges: [(number(cos), number(sin)), (number(cos), R::ZERO)],
            });
        }
        let load = Wrench2 {
            force: Vec2::new(R::ZERO, -R::ONE),
            moment: R::ZERO,
        };
        let normal = 1.0 / slope;
        let is_within = cone.bearers(load, little).is_some();
        assert_eq!(is_within, normal <= 64.0, "{normal}");
        assert!(cone.jams(load, little), "{normal}");
        assert_eq!(cone.exceeds_limit(load, little), !is_within, "{normal}");
        // Nothing holds it against a pull along the line.
        assert!(!cone.jams(load.scaled(-R::ONE), little), "{normal}");
        found[usize::from(is_within)] += 1;
    }
    assert!(found.iter().all(|count| *count > 3), "{found:?}");
}

#[test]
fn wedge_jams_beyond_the_limit_in_every_number_type() {
    wedge_jams_beyond_the_limit::<f64>();
    wedge_jams_beyond_the_limit::<f32>();
    wedge_jams_beyond_the_limit::<crate::real::Fixed>();
}
