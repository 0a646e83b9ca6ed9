//! The loads that contacts bear together, against the definition: a load is borne if reactions within the friction cones balance it, which
//! is decided here by a slow descent.

use super::*;
use crate::fixtures::{Random, sampled};
use crate::thresholds::Thresholds;

mod bounds;
mod flat;

/// The permitted residual of a load of size one.
const LITTLE: f64 = 1e-12;

impl Random {
    fn wrench(&mut self) -> Wrench2<f64> {
        Wrench2 {
            force: self.vector(),
            moment: self.next(),
        }
    }
}

/// Contacts at levers on surfaces of an angle, with a coefficient of friction.
fn cone(contacts: &[(Vec2<f64>, f64, f64)]) -> (WrenchCone<f64>, Vec<Wrench2<f64>, MAX_EDGES>) {
    let mut cone = WrenchCone::default();
    let mut edges = Vec::new();
    for &(lever, angle, mu) in contacts {
        let (sin, cos) = libm::sincos(angle);
        let (normal, tangent) = (Vec2::new(-sin, cos), Vec2::new(cos, sin));
        let size = libm::hypot(1.0, mu);
        cone.add(&Bearing {
            lever,
            normal,
            tangent,
            edges: [(1.0 / size, mu / size), (1.0 / size, -mu / size)],
        });
        for sign in [1.0, -1.0] {
            let force = (normal + tangent * (mu * sign)) * (1.0 / size);
            let moment = lever.x * force.y - lever.y * force.x;
            edges.push(Wrench2 { force, moment }).expect("room");
        }
    }
    (cone, edges)
}

/// The distance of a load from the loads that the edges bear: the least residual of components along them, by descent over one component
/// after the other. `None` if that is too slow.
fn outside(edges: &[Wrench2<f64>], load: Wrench2<f64>) -> Option<f64> {
    let mut parts = [0.0_f64; MAX_EDGES];
    let mut remainder = load.scaled(-1.0);
    for _ in 0..20_000 {
        let mut moved = 0.0_f64;
        for (part, edge) in parts.iter_mut().zip(edges) {
            let step = (remainder.dot(*edge) / edge.dot(*edge)).max(-*part);
            *part += step;
            moved = moved.max(step.abs());
            remainder = sum(remainder, *edge, [1.0, -step]);
        }
        if moved < 1e-12 {
            return Some(remainder.size());
        }
    }
    None
}

/// A linear combination of two loads.
fn sum(a: Wrench2<f64>, b: Wrench2<f64>, [n, m]: [f64; 2]) -> Wrench2<f64> {
    Wrench2 {
        force: a.force * n + b.force * m,
        moment: a.moment * n + b.moment * m,
    }
}

fn contacts(random: &mut Random, smooth: bool) -> Vec<(Vec2<f64>, f64, f64), 4> {
    let count = if random.next() > 0.0 { 2 } else { 3 };
    let mut list = Vec::new();
    for i in 0..count {
        let lever = if i == 0 { Vec2::ZERO } else { random.vector() };
        let mu = if smooth {
            0.0
        } else {
            0.5 + 0.4 * random.next()
        };
        list.push((lever, 3.0 * random.next(), mu)).expect("room");
    }
    list
}

/// The path of a load that begins at one that is borne: it yields where it leaves the cone.
#[test]
fn load_yields_where_no_reactions_balance_it() {
    let mut found = [0; 2];
    for seed in sampled(0..400, 97) {
        let mut random = Random(seed);
        let smooth = seed % 4 == 0;
        let (cone, edges) = cone(&contacts(&mut random, smooth));
        // Borne by a component along every edge, or, for contacts without friction, along each normal.
        let mut from = Wrench2 {
            force: Vec2::ZERO,
            moment: 0.0,
        };
        for edge in &edges {
            from = sum(from, *edge, [1.0, -0.2 - random.next().abs()]);
        }
        let to = random.wrench().scaled(3.0);
        let axes =
            [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)].map(|(x, y, moment)| Wrench2 {
                force: Vec2::new(x, y),
                moment,
            });
        let mut both = axes.iter().flat_map(|axis| [*axis, axis.scaled(-1.0)]);
        if both.all(|load| cone.jams(load, LITTLE)) {
            // Every load is borne.
            assert!(cone.jams(to, LITTLE));
            continue;
        }
        let rounding = 1e-9;
        assert_eq!(cone.first_yield(from, from, rounding), None, "{seed}");
        let on_way = |part: f64| outside(&edges, sum(from, to, [1.0 - part, part]));
        let Some(part) = cone.first_yield(from, to, rounding) else {
            assert!(outside(&edges, to).is_none_or(|off| off < 1e-6), "{seed}");
            found[0] += 1;
            continue;
        };
        found[1] += 1;
        assert!((0.0..=1.0).contains(&part), "{seed}: {part}");
        let is_planar = smooth && edges.len() < 6;
        let (before, after) = (on_way((part - 1e-4).max(0.0)), on_way(part + 1e-3));
        assert!(
            is_planar || before.is_none_or(|off| off < 1e-6),
            "{seed} {part} {before:?}"
        );
        assert!(
            after.is_none_or(|off| off > 1e-7),
            "{seed} {part} {after:?}"
        );
        assert!(
            !cone.jams(to, LITTLE) && cone.left(to, LITTLE) > 1e-9,
            "{seed}"
        );
    }
    assert!(
        cfg!(miri) || found.iter().all(|count| *count > 20),
        "{found:?}"
    );
}

/// Every load that is borne is distributed without negative components and without a residual.
#[test]
fn shares_of_what_is_borne_add_up_to_it() {
    for seed in sampled(0..400, 97) {
        let mut random = Random(seed);
        let (cone, edges) = cone(&contacts(&mut random, false));
        let load = random.wrench();
        let off = outside(&edges, load);
        let is_borne = cone
            .bearers(load, LITTLE)
            .is_some_and(|bearers| cone.bears_on(bearers, load, LITTLE));
        assert!(
            off.is_none_or(|off| is_borne == (off < 1e-9)),
            "{seed} {off:?}"
        );
        let mut remainder = load;
        for (pair, edges) in cone.share(load, LITTLE).iter().zip(edges.chunks(2)) {
            for (part, edge) in pair.iter().zip(edges) {
                assert!(*part >= -1e-12, "{seed} {part}");
                remainder = sum(remainder, *edge, [1.0, *part]);
            }
        }
        let left = remainder.size();
        assert!((left - cone.left(load, LITTLE)).abs() < 1e-9, "{seed}");
        if is_borne {
            assert!(left < 1e-9, "{seed}: {left}");
        } else if let Some(off) = off {
            assert!(left > 0.99 * off, "{seed}: {left} {off}");
        }
    }
}

/// (E5): two contacts share a load according to the middle of the interval of the internal force along the line between them.
#[test]
fn two_contacts_share_by_the_middle_of_the_interval() {
    let mut count = 0;
    for seed in sampled(0..2000, 97) {
        let mut random = Random(seed);
        let contacts: Vec<_, 4> = contacts(&mut random, false).into_iter().take(2).collect();
        let (cone, edges) = cone(&contacts);
        let load = random.wrench();
        if cone.bearers(load, LITTLE).is_none() {
            continue;
        }
        let shares = cone.share(load, LITTLE);
        let forces: Vec<_, 2> = (shares.iter().zip(edges.chunks(2)))
            .map(|(part, edge)| edge[0].force * part[0] + edge[1].force * part[1])
            .collect();
        let solution = contacts[1].0 * (1.0 / contacts[1].0.length());
        // The components along the two edges fall to zero at the ends of the interval.
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for ((force, pair), sign) in forces.iter().zip(edges.chunks(2)).zip([1.0, -1.0]) {
            let (plus, minus) = (pair[0].force, pair[1].force);
            let per = 1.0 / plus.cross(minus);
            for (at, rate) in [
                (force.cross(minus) * per, solution.cross(minus) * per * sign),
                (plus.cross(*force) * per, plus.cross(solution) * per * sign),
            ] {
                let end = -at / rate;
                if rate > 0.0 {
                    low = low.max(end);
                } else {
                    high = high.min(end);
                }
            }
        }
        let largest = forces
            .iter()
            .map(|force| force.length())
            .fold(0.0, f64::max);
        // All of it is within the limit.
        if largest + high.max(-low) < f64::limit() {
            assert!(
                (low + high).abs() < 1e-9 * (high - low + 1.0),
                "{seed}: {low} {high}"
            );
            count += 1;
        }
    }
    assert!(cfg!(miri) || count > 30, "{count}");
}

fn wrench(x: f64, y: f64, moment: f64) -> Wrench2<f64> {
    Wrench2 {
        force: Vec2::new(x, y),
        moment,
    }
}

/// Two contacts without friction on one floor bear loads that press between them, and yield at one end or the other, where the body begins
/// to turn about the contact there.
#[test]
fn without_friction_an_edge_bears_what_presses_between_its_ends() {
    let (cone, _) = cone(&[(Vec2::ZERO, 0.0, 0.0), (Vec2::new(2.0, 0.0), 0.0, 0.0)]);
    for (from, to, part, contact) in [
        (-1.0, -3.0, 0.5, 1),
        (-0.5, 1.5, 0.25, 0),
        (-1.9, -2.1, 0.5, 1),
    ] {
        let [from, to] = [from, to].map(|moment| wrench(0.0, -1.0, moment));
        let found = cone.first_yield(from, to, 1e-9);
        assert!(
            found.is_some_and(|at| (at - part).abs() < 1e-12),
            "{found:?}"
        );
        let yields = cone.yields(to, 1e-9, &|_| true);
        assert_eq!(yields, Some(Yield::Pivot { contact }));
        assert_eq!(cone.first_yield(from, from, 1e-9), None);
    }
    // Along the floor they bear nothing.
    assert_eq!(
        cone.first_yield(wrench(1e-3, -1.0, -1.0), wrench(1e-3, -1.0, -1.0), 1e-9),
        Some(0.0)
    );
}

/// On opposite sides of a slot all reactions are collinear; on one side of it they span half of that line.
#[test]
fn without_friction_a_slot_bears_what_lies_across_it() {
    const ROUNDING: f64 = 1e-3;
    let half = core::f64::consts::PI;
    for (angles, down, up) in [([0.0, half], true, true), ([0.0, 0.0], true, false)] {
        let (cone, _) = cone(&angles.map(|angle| (Vec2::ZERO, angle, 0.0)));
        let bears = |load| cone.first_yield(load, load, ROUNDING).is_none();
        for size in [0.01, 1.0, 30.0] {
            assert_eq!(bears(wrench(0.0, -size, 0.0)), down);
            assert_eq!(bears(wrench(0.0, size, 0.0)), up);
            for off in [0.5 * ROUNDING, -0.5 * ROUNDING] {
                assert!(bears(wrench(off, -size, 0.0)) && bears(wrench(0.0, -size, off)));
            }
            for off in [2.0 * ROUNDING, -2.0 * ROUNDING, 1.0] {
                assert!(!bears(wrench(off, -size, 0.0)) && !bears(wrench(0.0, -size, off)));
            }
        }
    }
}
