//! The moments about the ends of an edge, the ends of its sides, and what follows, derived from the balance itself.

extern crate std;

use super::*;
use crate::contact::Regime;
use crate::fixtures::Random;
use crate::geometry::{Angle, Orientation};
use crate::grip::Grip;
use crate::model::WithObstacles;
use crate::real::Fixed;
use crate::scene::{Description, ObstacleDescription, Scene};
use crate::verb::Moved;

type Among = Scene<f64, 4, 1, WithObstacles<2, 8>>;

/// A box 0.8 wide and 0.6 high, so that its size is 1, and a table that spans an interval, or two posts; mu_s = 0.5, mu_d = 0.25.
fn scene(obstacles: &[&[[f64; 2]]], weight: f64) -> Among {
    let list: std::vec::Vec<_> = obstacles
        .iter()
        .map(|vertices| ObstacleDescription {
            vertices,
            friction_static: 0.5,
            friction_dynamic: 0.25,
            memory: None,
        })
        .collect();
    let description = Description {
        vertices: &[[-0.4, -0.3], [0.4, -0.3], [0.4, 0.3], [-0.4, 0.3]],
        start: [0.0, 3.0, 0.0],
        weight,
        holding_point: Some([0.0, 0.0]),
        reach: 0.0,
        stiffness_translation: 1.0,
        stiffness_rotation: 0.5,
        surfaces: &[],
        obstacles: &list,
    };
    Scene::new(&description).expect("a sound scene")
}

fn table([from, to]: [f64; 2]) -> [[f64; 2]; 4] {
    [[from, -1.0], [to, -1.0], [to, 0.0], [from, 0.0]]
}

/// The body upright with its middle at x, on two contacts; both orders of the contacts.
fn edges(scene: &Among, x: f64, contacts: [Pair; 2]) -> [Edge<f64>; 2] {
    let pose = crate::geometry::Pose {
        position: Vec2::new(x, 0.3),
        orientation: Orientation::new(Angle::default()),
    };
    let [a, b] = contacts;
    [(a, b), (b, a)].map(|(a, b)| Edge::new(Pivot::at(scene, &pose, a), b))
}

fn v(vertex: u8, side: u8) -> Pair {
    let surface = side;
    Pair { vertex, surface }
}

fn c(corner: u8) -> Pair {
    Pair::of_corner(corner, 0)
}

/// Tables and the contacts on which the box lies with its middle at 0.
type Lies = (std::vec::Vec<[[f64; 2]; 4]>, [Pair; 2]);

fn lies() -> [Lies; 5] {
    [
        ([table([-2.0, 2.0])].into(), [v(0, 2), v(1, 2)]),
        ([table([-2.0, 0.2])].into(), [v(0, 2), c(2)]),
        ([table([-0.1, 2.0])].into(), [c(3), v(1, 2)]),
        ([table([-0.3, 0.2])].into(), [c(3), c(2)]),
        (
            [table([-2.0, -0.2]), table([0.1, 0.3])].into(),
            [v(0, 2), c(6)],
        ),
    ]
}

fn grip(random: &mut Random) -> Grip<f64> {
    Grip {
        holding_point: random.vector() * 0.3,
        hand: Vec2::new(0.3 * random.next(), -0.2 + 0.4 * random.next()),
        angle: Angle::from_radians(0.1 * random.next()),
    }
}

/// M_1 and M_2 of a body at a position, written out.
fn balance(scene: &Among, x: f64, ends: [f64; 2], grip: &Grip<f64>) -> [f64; 2] {
    let held = Vec2::new(x, 0.3) + grip.holding_point;
    let force = grip.hand - held;
    let couple = 0.5 * grip.angle.radians();
    ends.map(|end| {
        let from = Vec2::new(end, 0.0);
        couple + (held - from).cross(force) + (Vec2::new(x, 0.3) - from).cross(scene.weight())
    })
}

/// The moments about the ends, on a slide with the hand, are those of the body in its new position.
#[test]
fn moments_are_those_on_the_way() {
    for (tables, contacts) in lies() {
        let lists: std::vec::Vec<&[[f64; 2]]> = tables.iter().map(|t| &t[..]).collect();
        let scene = scene(&lists, 0.7);
        for seed in 0..20 {
            let mut random = Random(seed);
            let (from, to) = (grip(&mut random), grip(&mut random));
            let to = Grip {
                holding_point: from.holding_point,
                ..to
            };
            let shift = 0.1 * random.next();
            for (order, edge) in edges(&scene, 0.0, contacts).into_iter().enumerate() {
                let load = edge.pivot.load(&scene, &from);
                let displacement = from.displacement_to(&to);
                let relative = Displacement {
                    hand: displacement.hand - Vec2::new(shift, 0.0),
                    ..displacement
                };
                let moments = edge.moments(&scene, (&load, &relative), shift);
                for part in [0.0, 0.3, 1.0] {
                    let way = shift * part;
                    let place = |pair: Pair| {
                        let at = load.placed.point + load.placed.arm_to(&scene, pair);
                        at.x + if pair.is_corner() { 0.0 } else { way }
                    };
                    let mut ends = contacts.map(place);
                    if order == 1 {
                        ends.reverse();
                    }
                    let should = balance(&scene, way, ends, &from.lerp(&to, part));
                    for (moment, should) in moments.iter().zip(should) {
                        let (p, q) = moment.square;
                        let is = moment.start + moment.along * part + p * q * part * part;
                        assert!((is - should).abs() < 1e-14, "{contacts:?} {part}");
                    }
                }
            }
        }
    }
}

/// A slide with the hand ends where the balance says that an end lifts, or where a side ends; the order of the contacts does not matter.
/// Found by small steps.
#[test]
fn slide_ends_where_the_balance_says() {
    const STEPS: i32 = 20_000;
    let (mut tips, mut ends, mut whole) = (0, 0, 0);
    for (tables, contacts) in lies() {
        let lists: std::vec::Vec<&[[f64; 2]]> = tables.iter().map(|t| &t[..]).collect();
        let scene = scene(&lists, 0.1);
        for seed in 0..60 {
            let mut random = Random(seed);
            let sign = if seed % 2 == 0 { 1.0 } else { -1.0 };
            let depth = 0.3 + 0.2 * random.next();
            let holding_point = Vec2::new(0.2 * random.next(), 0.1 * random.next());
            // In balance: the hand leads by mu_d N.
            let height = 0.3 + holding_point.y - depth;
            let normal = depth + 0.1;
            let from = Grip {
                holding_point,
                hand: Vec2::new(holding_point.x + sign * 0.25 * normal, height),
                angle: Angle::from_radians(0.1 * random.next()),
            };
            let to = Grip {
                hand: from.hand + Vec2::new(sign * 0.8, 0.3 * random.next()),
                angle: Angle::from_radians(0.1 * random.next()),
                ..from
            };
            let way = |part: f64| {
                let hand = from.lerp(&to, part).hand;
                let normal = 0.1 + 0.3 + holding_point.y - hand.y;
                hand.x - holding_point.x - sign * 0.25 * normal
            };
            let outcomes = edges(&scene, 0.0, contacts).map(|edge| {
                let placed = edge.pivot.placed(&scene);
                let at = edge.contacts().map_places(&scene, &placed);
                let mut after = edge.clone();
                after.regime = Regime::Slide(sign);
                let moved = after.advance(&scene, &from, &to);
                (edge, at, after, moved)
            });
            for (edge, at, after, moved) in outcomes {
                let rates = edge.rates();
                let state = |part: f64| {
                    let x = way(part);
                    let places = [at[0] + rates[0] * x, at[1] + rates[1] * x];
                    let [m1, m2] = balance(&scene, x, places, &from.lerp(&to, part));
                    let span = places[1] - places[0];
                    [m2 / span, -m1 / span, span.abs()]
                };
                let begin = state(0.0);
                if begin[0] < 1e-3 || begin[1] < 1e-3 {
                    continue;
                }
                // The first event.
                let happens = |part: f64| {
                    let [n1, n2, span] = state(part);
                    let off = edge.contacts().iter().any(|&pair| {
                        let [low, high] = scene.reach(pair);
                        let foot = edge.pivot.placed(&scene).foot(&scene, pair) + way(part);
                        foot < low - 1e-9 || foot > high + 1e-9
                    });
                    n1 < 0.0 || n2 < 0.0 || span < 1e-5 || off
                };
                let first = (1..=STEPS)
                    .map(|i| f64::from(i) / f64::from(STEPS))
                    .find(|&part| happens(part));
                let is_edge_event = |moved: &Moved<f64>| {
                    matches!(moved.trigger, Trigger::Keep { .. } | Trigger::Off { .. })
                };
                if matches!(
                    moved.trigger,
                    Trigger::Touch(_) | Trigger::Pressed | Trigger::Halts
                ) {
                    assert!(first.is_none_or(|first| first >= moved.part - 1e-3));
                    continue;
                }
                match first {
                    None => {
                        assert_eq!(moved.trigger, Trigger::Balanced, "{contacts:?} {seed}");
                        whole += 1;
                    }
                    Some(first) => {
                        assert!(
                            is_edge_event(&moved),
                            "{contacts:?} {seed} {moved:?} {first}"
                        );
                        let off = first - moved.part;
                        assert!(
                            off > -1e-4 && off < 1e-4,
                            "{contacts:?} {seed} {first} {moved:?}"
                        );
                        if let Trigger::Keep {
                            contacts: [lasts, _],
                            sliding,
                        } = moved.trigger
                        {
                            assert_eq!(sliding, Some(sign));
                            let [.., span] = state(moved.part);
                            let lifts = state(moved.part)[1 - lasts];
                            assert!(lifts.abs() < 1e-9 || span < 1e-5, "{lifts}");
                            tips += 1;
                        } else {
                            ends += 1;
                        }
                    }
                }
                // The foot has moved as far as the balance says.
                let foot = after.pivot.foot - edge.pivot.foot;
                assert!((foot - way(moved.part)).abs() < 1e-12);
            }
        }
    }
    assert!(
        tips > 40 && ends > 20 && whole > 20,
        "{tips} {ends} {whole}"
    );
}

trait Places {
    fn map_places(&self, scene: &Among, placed: &crate::detect::Placed<f64>) -> [f64; 2];
}

impl Places for crate::contact::Pairs {
    fn map_places(&self, scene: &Among, placed: &crate::detect::Placed<f64>) -> [f64; 2] {
        [0, 1].map(|i| (placed.point + placed.arm_to(scene, self[i])).x)
    }
}

/// A parabola falls to zero at its smallest root, in fixed point as well, however large its terms.
#[test]
fn parabola_falls_at_its_first_root() {
    let mut count = 0;
    for seed in 0..2000 {
        let mut random = Random(seed);
        let (start, along) = (random.next().abs(), 2.0 * random.next());
        let square = (2.0 * random.next(), random.next());
        let value = |x: f64| start + along * x + square.0 * square.1 * x * x;
        let bent = Bent {
            start,
            along,
            square,
            rounding: 1e-15,
        };
        let found = bent.first_zero();
        let until = found.unwrap_or(50.0);
        for i in 0..100 {
            let x = until * f64::from(i) / 100.0;
            assert!(value(x) > -1e-12, "{bent:?} {x}");
        }
        if let Some(x) = found {
            assert!(value(x).abs() < 1e-9 * (1.0 + x * x), "{bent:?} {x}");
            count += 1;
        }
        let number = |x: f64| crate::fixtures::number::<Fixed>(x);
        for times in [1.0, 16.0] {
            let fixed = Bent {
                start: number(start * times),
                along: number(along * times),
                square: (number(square.0 * times), number(square.1)),
                rounding: number(1e-6),
            };
            let zero = fixed.first_zero().map(|x| x.to_si(1.0));
            // If it only just reaches zero the digits decide.
            let discriminant = along * along - 4.0 * start * square.0 * square.1;
            if discriminant.abs() > 1e-3 && start > 1e-3 && until < 20.0 {
                let zero = f64::from(zero.expect("a zero"));
                assert!(
                    (zero - until).abs() < 1e-3 * (1.0 + until),
                    "{bent:?} {zero} {until}"
                );
            }
        }
    }
    assert!(count > 500, "{count}");
}
