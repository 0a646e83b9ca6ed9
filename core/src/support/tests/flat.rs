//! Cones that are almost flat, in every number type: three edges of them bear a load to the rounding, though their parts are hardly
//! known; parts beyond all numbers are not told as small ones.

use super::*;
use crate::fixtures::number;
use crate::real::Fixed;

/// A contact at a lever on a surface of an angle, with mu = 1/2.
fn contact<R: Real>(lever: Vec2<f64>, angle: f64) -> Bearing<R>
where
    R::Si: From<f32>,
{
    let (sin, cos) = libm::sincos(angle);
    let size = libm::hypot(1.0, 0.5);
    let vector = |x, y| Vec2::new(number(x), number(y));
    let (along, across) = (number::<R>(1.0 / size), number::<R>(0.5 / size));
    Bearing {
        lever: vector(lever.x, lever.y),
        normal: vector(-sin, cos),
        tangent: vector(cos, sin),
        edges: [(along, across), (along, -across)],
    }
}

/// Two contacts close together: what three edges of theirs add up to is borne on these and shared out.
fn flat_cones_bear<R: Real>()
where
    R::Si: From<f32>,
{
    // As in the solver: some times the rounding and what closes.
    let little = R::EPSILON * R::from_int(64) + R::TOUCH;
    let mut count = 0;
    for seed in sampled(0..600, 97) {
        let mut random = Random(seed);
        let mut support = Support::<R>::default();
        support.add(&contact(Vec2::ZERO, 3.0 * random.next()));
        let lever = random.vector() * (1.0 / 256.0);
        support.add(&contact(lever, 3.0 * random.next()));
        let edges = [0, 1, 2].map(|i: usize| support.edges[i].screw);
        let volume = edges[0].dot(edges[1].cross(edges[2])).abs();
        if volume <= Support::<R>::tolerance() || volume > Support::<R>::sharp() {
            continue;
        }
        let load = edges.iter().fold(
            Screw {
                force: Vec2::ZERO,
                moment: R::ZERO,
            },
            |load, edge| {
                let part: R = number(0.7 + 0.2 * random.next());
                Screw {
                    force: load.force - edge.force * part,
                    moment: load.moment - edge.moment * part,
                }
            },
        );
        // Even flatter ones are refined by what is left alone.
        let is_refined = volume > Support::<R>::tolerance() * R::from_int(64);
        assert!(
            !is_refined || support.bears_on([0, 1, 2], load, little),
            "{seed}"
        );
        let left = support.left(load, little);
        assert!(left <= R::EPSILON * R::from_int(16), "{seed}: {left:?}");
        count += 1;
    }
    assert!(cfg!(miri) || count > 30, "{count}");
}

#[test]
fn flat_cones_bear_to_the_rounding() {
    flat_cones_bear::<f64>();
    flat_cones_bear::<f32>();
    flat_cones_bear::<Fixed>();
}

/// Two contacts close together, one against the other, with loads that they bear in `f64`: in fixed point what is told balances the
/// load, or the reaction of one contact at least is about as large as numbers are.
#[test]
fn parts_beyond_the_numbers_are_told_at_the_rail() {
    let little = <Fixed as Real>::EPSILON * Fixed::from_int(64) + <Fixed as Real>::TOUCH;
    let mut found = [0; 2];
    for seed in sampled(0..2000, 97) {
        let mut random = Random(seed);
        let angle = 3.0 * random.next();
        let opposite = angle + core::f64::consts::PI + 0.3 * random.next();
        let lever = random.vector() * (1.0 / 16.0);
        let (mut exact, mut support) = (Support::<f64>::default(), Support::<Fixed>::default());
        for (lever, angle) in [(Vec2::ZERO, angle), (lever, opposite)] {
            exact.add(&contact(lever, angle));
            support.add(&contact(lever, angle));
        }
        let [x, y, moment] = [2.0, 2.0, 8.0].map(|most| (most * random.next()) as f32);
        let as_f64 = screw(x.into(), y.into(), moment.into());
        if exact.bearers(as_f64, LITTLE).is_none() {
            continue;
        }
        let parts = exact.share(as_f64, LITTLE);
        let largest = parts.iter().flatten().fold(0.0, |a: f64, b| a.max(*b));
        // Beyond this the cone is flat to the rounding.
        if largest > 4096.0 {
            continue;
        }
        let load = Screw {
            force: Vec2::new(number(x.into()), number(y.into())),
            moment: number(moment.into()),
        };
        let told = support.share(load, little);
        let edges = support.edges.iter().map(|edge| edge.screw);
        let rest = edges
            .zip(told.iter().flatten())
            .fold(load, |rest, (edge, &part)| Screw {
                force: rest.force + edge.force * part,
                moment: rest.moment + edge.moment * part,
            });
        let mut reactions = told.iter().map(|[plus, minus]| *plus + *minus);
        let at_rail = reactions.any(|sum| sum > Fixed::from_int(127));
        let balances = rest.size() <= little.doubled();
        assert!(balances || at_rail, "{seed}: {told:?} {rest:?}");
        found[usize::from(balances)] += 1;
    }
    assert!(
        cfg!(miri) || found.iter().all(|count| *count > 100),
        "{found:?}"
    );
}
