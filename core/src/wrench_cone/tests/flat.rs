//! Cones that are almost flat, in every number type: three edges of them bear a load to the rounding, although the components are hardly
//! known, and no load of which more remains; components beyond all numbers are not reported as small ones.

use super::*;
use crate::fixtures::number;
use crate::list::gather;
use crate::real::Fixed;
use crate::thresholds::Thresholds;

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

/// What counts as small, as in the solver: a few times the rounding and the touch.
fn little<R: Real>() -> R {
    R::EPSILON * R::from_int(64) + R::TOUCH
}

/// The residual of a load after components along edges.
fn remainder<R: Real>(
    load: Wrench2<R>,
    parts: impl Iterator<Item = (Wrench2<R>, R)>,
) -> Wrench2<R> {
    parts.fold(load, |remainder, (edge, part)| Wrench2 {
        force: remainder.force + edge.force * part,
        moment: remainder.moment + edge.moment * part,
    })
}

/// Two contacts up to a distance apart, on surfaces at any angles.
fn two_contacts<R: Real>(random: &mut Random, distance: f64) -> WrenchCone<R>
where
    R::Si: From<f32>,
{
    let mut cone = WrenchCone::default();
    cone.add(&contact(Vec2::ZERO, 3.0 * random.next()));
    let lever = random.vector() * distance;
    cone.add(&contact(lever, 3.0 * random.next()));
    cone
}

/// Two contacts close together: sums of three of their edges are borne on these edges and distributed.
fn flat_cones_bear<R: Real>()
where
    R::Si: From<f32>,
{
    let little = little();
    let mut count = 0;
    for seed in sampled(0..600, 97) {
        let mut random = Random(seed);
        let cone = two_contacts::<R>(&mut random, 1.0 / 256.0);
        let edges = [0, 1, 2].map(|i: usize| cone.edges[i].wrench);
        let volume = edges[0].dot(edges[1].cross(edges[2])).abs();
        if volume <= R::in_plane() || volume > R::sharp() {
            continue;
        }
        let load = edges.iter().fold(
            Wrench2 {
                force: Vec2::ZERO,
                moment: R::ZERO,
            },
            |load, edge| {
                let part: R = number(0.7 + 0.2 * random.next());
                Wrench2 {
                    force: load.force - edge.force * part,
                    moment: load.moment - edge.moment * part,
                }
            },
        );
        // Even flatter ones are refined by the residual only.
        let is_refined = volume > R::in_plane() * R::from_int(64);
        assert!(
            !is_refined || cone.bears_on([0, 1, 2], load, little),
            "{seed}"
        );
        let left = cone.left(load, little);
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

/// If edges that are not flat are reported to bear a load, they bear it to fractions of its rounding, even if it is small.
fn sharp_cones_bear_to_parts_of_a_rounding<R: Real>()
where
    R::Si: From<f32>,
{
    let little = little();
    let mut count = 0;
    for seed in sampled(0..4000, 97) {
        let mut random = Random(seed);
        let cone = two_contacts::<R>(&mut random, 1.0 / 64.0);
        let load = Wrench2 {
            force: Vec2::new(number(random.next() * 1e-3), number(random.next() * 1e-3)),
            moment: number(random.next() * 1e-5),
        };
        for edges in cone.triples() {
            let Some(solution) = cone.bearing(edges, load, little) else {
                continue;
            };
            let edge = |k: usize| cone.edges[k].wrench;
            let remainder = remainder(load, solution.iter().map(|&(k, part)| (edge(k), part)));
            // Three components, each to 2^8 roundings.
            let bound = R::EPSILON * R::from_int(64) * R::from_int(12);
            assert!(
                remainder.size() <= bound,
                "{seed}: {solution:?} {remainder:?}"
            );
            count += 1;
        }
    }
    assert!(cfg!(miri) || count > 300, "{count}");
}

#[test]
fn sharp_cones_bear_small_loads() {
    sharp_cones_bear_to_parts_of_a_rounding::<f64>();
    sharp_cones_bear_to_parts_of_a_rounding::<f32>();
    sharp_cones_bear_to_parts_of_a_rounding::<Fixed>();
}

/// If a flat cone is reported to bear a load, it does, whatever the load: with components that press and leave a small residual.
fn flat_cones_bear_nothing_else<R: Real>()
where
    R::Si: From<f32>,
{
    let little = little();
    let mut found = [0; 2];
    for seed in sampled(0..4000, 97) {
        let mut random = Random(seed);
        let mut cone = WrenchCone::<R>::default();
        let angle = 3.0 * random.next();
        cone.add(&contact(Vec2::ZERO, angle));
        let lever = random.vector() * (1.0 / 4096.0);
        cone.add(&contact(lever, angle + 0.5 * random.next()));
        let load = Wrench2 {
            force: Vec2::new(number(random.next()), number(random.next())),
            moment: number(random.next() * 1e-3),
        };
        for edges in cone.triples() {
            let edge = |k: usize| cone.edges[k].wrench;
            let volume = edge(edges[0]).dot(edge(edges[1]).cross(edge(edges[2])));
            if volume.abs() > R::sharp() {
                continue;
            }
            let solution = cone.bearing(edges, load, little);
            found[usize::from(solution.is_some())] += 1;
            let Some(solution) = solution else { continue };
            let remainder = remainder(load, solution.iter().map(|&(k, part)| (edge(k), part)));
            assert!(
                solution.iter().all(|&(_, part)| part >= R::ZERO),
                "{seed}: {solution:?}"
            );
            // Plus the rounding residual of the components.
            let sum = solution.iter().fold(R::ZERO, |sum, &(_, part)| sum + part);
            assert!(
                remainder.size() <= little + R::rounding(sum) * R::from_int(4),
                "{seed}: {solution:?} {remainder:?}"
            );
        }
    }
    assert!(
        cfg!(miri) || found.iter().all(|count| *count > 30),
        "{found:?}"
    );
}

#[test]
fn flat_cones_bear_no_more_than_they_can() {
    flat_cones_bear_nothing_else::<f64>();
    flat_cones_bear_nothing_else::<f32>();
    flat_cones_bear_nothing_else::<Fixed>();
}

/// Two contacts close together, one against the other, with a load, in `f64` and in fixed point, and what is reported there.
struct Clamp {
    exact: WrenchCone<f64>,
    load: Wrench2<f64>,
    /// The reported reaction of each contact.
    sums: Vec<f64, MAX_CONTACTS>,
    /// The residual of the load.
    left: f64,
}

fn clamp(seed: u64) -> Clamp {
    let mut random = Random(seed);
    let angle = 3.0 * random.next();
    let opposite = angle + core::f64::consts::PI + 0.3 * random.next();
    let lever = random.vector() * (1.0 / 16.0);
    let (mut exact, mut cone) = (WrenchCone::<f64>::default(), WrenchCone::<Fixed>::default());
    for (lever, angle) in [(Vec2::ZERO, angle), (lever, opposite)] {
        exact.add(&contact(lever, angle));
        cone.add(&contact(lever, angle));
    }
    // A large one is borne by reactions whose difference is as large.
    let size = if seed.is_multiple_of(2) { 2.0 } else { 12.0 };
    let [x, y, moment] = [size, size, 8.0].map(|most| (most * random.next()) as f32);
    let load = Wrench2 {
        force: Vec2::new(number(x.into()), number(y.into())),
        moment: number(moment.into()),
    };
    let parts = cone.share(load, little());
    let edges = cone.edges.iter().map(|edge| edge.wrench);
    let remainder = remainder(load, edges.zip(parts.iter().flatten().copied()));
    Clamp {
        exact,
        load: wrench(x.into(), y.into(), moment.into()),
        sums: gather(
            parts
                .iter()
                .map(|[plus, minus]| f64::from((*plus + *minus).to_si(1.0))),
        ),
        left: remainder.size().to_si(1.0).into(),
    }
}

/// Loads that a clamp bears in `f64`: in fixed point the reported reactions balance the load, or the reaction of at least one contact is
/// about as large as the numbers permit. If some components that bear the load are not large, they balance it; if all are, no contact is
/// reported to bear more than where it takes most of the load, nor, as far as the numbers permit, less than where it takes least.
#[test]
fn parts_beyond_the_numbers_are_told_at_the_rail() {
    let balance = 2.0 * f64::from(little::<Fixed>().to_si(1.0));
    let mut found = [0; 3];
    for seed in sampled(0..4000, 97) {
        let clamp = clamp(seed);
        let triples = clamp.exact.triples();
        let solutions: Vec<_, 4> = triples
            .filter_map(|edges| clamp.exact.bearing(edges, clamp.load, LITTLE))
            .collect();
        let largest =
            |solution: &[(usize, f64); 3]| solution.iter().fold(0.0, |a: f64, (_, b)| a.max(*b));
        // Beyond 4096 the cone is flat to the rounding.
        if solutions.is_empty() || solutions.iter().any(|solution| largest(solution) > 4096.0) {
            continue;
        }
        let at_rail = clamp.sums.iter().any(|sum| *sum > 127.0);
        let balances = clamp.left <= balance;
        assert!(
            balances || at_rail,
            "{seed}: {:?} {}",
            clamp.sums,
            clamp.left
        );
        let is_small = solutions.iter().any(|solution| largest(solution) < 15.0);
        assert!(
            balances || !is_small,
            "{seed}: {:?} {}",
            clamp.sums,
            clamp.left
        );
        for (contact, sum) in clamp.sums.iter().enumerate() {
            let of_contact = solutions.iter().map(|solution| {
                let parts = solution.iter().filter(|(edge, _)| edge / 2 == contact);
                parts.map(|(_, part)| part).sum::<f64>()
            });
            let (least, most) = of_contact.fold((f64::INFINITY, 0.0_f64), |(least, most), sum| {
                (least.min(sum), most.max(sum))
            });
            assert!(
                *sum < 1.1 * most + 0.01 && *sum > 0.9 * least.min(127.0) - 0.01,
                "{seed}: {contact} {:?} {least} {most}",
                clamp.sums
            );
        }
        found[if is_small { 2 } else { usize::from(balances) }] += 1;
    }
    assert!(
        cfg!(miri) || found.iter().all(|count| *count > 100),
        "{found:?}"
    );
}

/// If a clamp is far from bearing a load, the residual of the reported reactions is no larger than the load itself.
#[test]
fn what_is_told_leaves_less_than_the_load() {
    let mut count = 0;
    for seed in sampled(0..4000, 97) {
        let clamp = clamp(seed);
        let size = clamp.load.size();
        if clamp.exact.left(clamp.load, LITTLE) < size / 16.0 {
            continue;
        }
        assert!(
            clamp.left < size + 1e-5,
            "{seed}: {} {size} {:?}",
            clamp.left,
            clamp.sums
        );
        count += 1;
    }
    assert!(cfg!(miri) || count > 100, "{count}");
}
