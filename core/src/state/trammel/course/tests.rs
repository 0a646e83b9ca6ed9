//! Two contacts among obstacles, each a vertex on a side or a corner on a side of the body, against geometry and statics written out.

use super::*;
use crate::fixtures::{Random, sampled};
use crate::geometry::{Angle, Orientation, Pose};
use crate::model::{Full, WithObstacles};
use crate::real::Fixed;
use crate::scene::{Description, ObstacleDescription, Scene};
use crate::state::TwoVertex;
use crate::state::trammel::{Demand, Ending};
use crate::verb::Trigger;
use core::array::from_fn;

mod closed;
mod short;
mod slides;

type Room<R> = Scene<R, 3, 1, WithObstacles<2, 4, Full>>;

const VERTICES: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.4, 0.3]];
const MU_D: [f64; 2] = [0.3, 0.2];

/// A number type and numbers of f64 in it, all their digits.
trait Digits: Real {
    fn si(x: f64) -> Self::Si;
    fn number(x: f64) -> Self {
        Self::from_si(Self::si(x), Self::Si::ONE)
    }
}

impl Digits for f64 {
    fn si(x: f64) -> f64 {
        x
    }
}

impl Digits for f32 {
    fn si(x: f64) -> f32 {
        x as f32
    }
}

impl Digits for Fixed {
    fn si(x: f64) -> f32 {
        x as f32
    }
}

/// A contact written out: the point of the body, and the corner if it is one.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// A vertex, the normal of its wall and a point of it.
    Vertex(usize, Vec2<f64>, Vec2<f64>),
    /// A side of the body, a pin.
    Corner(usize, Vec2<f64>),
}

struct Case<R: Real> {
    scene: Room<R>,
    state: TwoVertex<R>,
    grip: Grip<R>,
    kinds: [Kind; 2],
    seed: u64,
}

fn normal_of(side: usize) -> Vec2<f64> {
    let [a, b] = [side, (side + 1) % 3].map(|i| Vec2::new(VERTICES[i][0], VERTICES[i][1]));
    let along = b - a;
    (-along.turned()).over(along.length())
}

/// A triangle on which two contacts press, each on a wall or a pin; `corners`: which of them are pins.
fn case<R: Digits>(seed: u64, corners: [bool; 2]) -> Case<R> {
    let mut random = Random(seed);
    let mut next = || random.next();
    let si = R::si;
    let number = R::number;
    let pose = Pose {
        position: Vec2::new(next(), next()),
        orientation: Orientation::new(Angle::from_radians(3.0 * next())),
    };
    let rotation = pose.orientation.rotation();
    let at = |v: Vec2<f64>| pose.position + rotation.apply(v);
    let mut walls = [[[0.0; 2]; 2]; 2];
    let kinds: [Kind; 2] = from_fn(|i| {
        let part = 0.5 + 0.4 * next();
        let [a, b] = [[0.0, 0.0], [1.0, 0.0]].map(|[x, y]| Vec2::new(x, y));
        let c = Vec2::new(0.4, 0.3);
        if corners[i] {
            let (side, from, to) = [(2, c, a), (1, b, c)][i];
            let place = at(from.lerp(to, part));
            walls[i] = [[place.x, place.y]; 2];
            return Kind::Corner(side, place);
        }
        let (vertex, place, [before, after]) = [(0, a, [2, 0]), (1, b, [0, 1])][i];
        let mixed = normal_of(before) * part + normal_of(after) * (1.0 - part);
        let normal = -rotation.apply(mixed.over(mixed.length()));
        let [from, to] = [-3.0, 3.0].map(|x| at(place) + normal.turned() * x);
        walls[i] = [[from.x, from.y], [to.x, to.y]];
        // Outwards is to the right of the direction from corner to corner.
        Kind::Vertex(vertex, -(to - from).turned().over(6.0), at(place))
    });
    let walls = walls.map(|wall| wall.map(|p| p.map(si)));
    let obstacles: [ObstacleDescription<'_, R::Si>; 2] = from_fn(|i| ObstacleDescription {
        vertices: &walls[i][..if corners[i] { 1 } else { 2 }],
        friction_static: si(MU_D[i] + 0.2),
        friction_dynamic: si(MU_D[i]),
        memory: None,
    });
    let p = pose.position;
    let scene = Room::<R>::new(&Description {
        vertices: &VERTICES.map(|v| v.map(si)),
        start: [p.x, p.y, pose.orientation.angle().radians()].map(si),
        weight: si(0.3 * next().abs()),
        holding_point: None,
        reach: si(0.0),
        stiffness_translation: si(1.0),
        stiffness_rotation: si(next().abs()),
        surfaces: &[],
        obstacles: &obstacles,
    });
    let scene = scene.expect("a sound scene");
    let second = if corners[0] { 1 } else { 2 };
    let [first, other] = [0, second].map(|index| scene.surface_indices().end + index);
    let [first, other] = [(first, 0), (other, 1)].map(|(surface, i)| match kinds[i] {
        Kind::Vertex(vertex, ..) => Pair {
            vertex: vertex as u8,
            surface,
        },
        Kind::Corner(side, _) => Pair::of_corner(surface, side as u8),
    });
    let pose = Pose {
        position: Vec2::new(number(p.x), number(p.y)),
        orientation: Orientation::new(Angle {
            turns: 0,
            rest: number(pose.orientation.angle().rest),
        }),
    };
    let pivot = Pivot::at(&scene, &pose, first);
    let state = TwoVertex::new(crate::verb::seat_sliding(&scene, pivot, other), other);
    let mut vector = |by: f64| Vec2::new(number(by * next()), number(by * next()));
    let grip = Grip {
        holding_point: vector(0.5),
        hand: pose.position + vector(1.0),
        angle: Angle {
            turns: 0,
            rest: number(3.0 * next()),
        },
    };
    Case {
        scene,
        state,
        grip,
        kinds,
        seed,
    }
}

const KINDS: [[bool; 2]; 4] = [[false, false], [false, true], [true, false], [true, true]];

/// All cases that are driven, of many of all kinds.
fn driven<R: Digits>(
    demand: Demand,
    count: u64,
    mut look: impl FnMut(&Case<R>, &Trammel<R>),
) -> [usize; 4] {
    KINDS.map(|corners| {
        let mut found = 0;
        for seed in sampled(0..count, 97) {
            let case = case::<R>(seed, corners);
            let contacts = (&case.state.pivot, case.state.other);
            if let Some(trammel) = Trammel::driven(&case.scene, contacts, &case.grip, demand) {
                look(&case, &trammel);
                found += 1;
            }
        }
        found
    })
}

fn course<'a, R: Real>(case: &'a Case<R>, trammel: &Trammel<R>) -> Course<'a, R, Room<R>> {
    let contacts = (&case.state.pivot, case.state.other);
    Course::of(&case.scene, contacts, &case.grip, trammel)
}

/// A contact at a pose: its point, its normal, the gap, and the position of the body's material there in the body frame.
fn contact(kind: Kind, pose: &Pose<f64>) -> (Vec2<f64>, Vec2<f64>, f64, Vec2<f64>) {
    let rotation = pose.orientation.rotation();
    match kind {
        Kind::Vertex(vertex, normal, on) => {
            let v = Vec2::new(VERTICES[vertex][0], VERTICES[vertex][1]);
            let point = pose.position + rotation.apply(v);
            (point, normal, normal.dot(point - on), v)
        }
        Kind::Corner(side, place) => {
            let outward = normal_of(side);
            let normal = -rotation.apply(outward);
            let v = Vec2::new(VERTICES[side][0], VERTICES[side][1]);
            let at = rotation.undo(place - pose.position);
            (place, normal, outward.dot(at - v), at)
        }
    }
}

fn tangent(normal: Vec2<f64>) -> Vec2<f64> {
    Vec2::new(normal.y, -normal.x)
}

/// Force and moment of hand and weight about the origin.
fn wrench(case: &Case<f64>, grip: &Grip<f64>, pose: &Pose<f64>) -> (Vec2<f64>, f64) {
    let rotation = pose.orientation.rotation();
    let held = pose.position + rotation.apply(grip.holding_point);
    let centre = pose.position + rotation.apply(case.scene.centroid());
    let (pull, weight) = (grip.hand - held, case.scene.weight());
    let couple = case.scene.stiffness() * grip.angle.minus(pose.orientation.angle());
    let moment = couple + held.cross(pull) + centre.cross(weight);
    (pull + weight, moment)
}

/// The residual of a load after two reactions on the edges of the dynamic cones, against velocities with given signs: N_1, N_2 from the
/// forces, and the moment that is left.
fn left(case: &Case<f64>, grip: &Grip<f64>, pose: &Pose<f64>, signs: [f64; 2]) -> ([f64; 2], f64) {
    let (force, moment) = wrench(case, grip, pose);
    let [(c1, f1), (c2, f2)] = from_fn(|i| {
        let (point, normal, ..) = contact(case.kinds[i], pose);
        (point, normal - tangent(normal) * (signs[i] * MU_D[i]))
    });
    let spread = f1.cross(f2);
    let [n1, n2] = [-force.cross(f2) / spread, force.cross(f1) / spread];
    let rest = moment + c1.cross(f1) * n1 + c2.cross(f2) * n2;
    ([n1, n2], rest * spread)
}

fn pose_of(case: &Case<f64>, pivot: &Pivot<f64>) -> Pose<f64> {
    pivot.placed(&case.scene).pose()
}

/// Conchoids, limaçons and the trammel: both gaps stay closed, and the rates are the derivatives of the poses, also to second order.
#[test]
fn contacts_stay_and_rates_are_derivatives() {
    let counts = driven::<f64>(Demand::AtTheEnd, 400, |case, trammel| {
        let course = course(case, trammel);
        let longest = course.longest();
        for k in 0..=8 {
            let x = longest * f64::from(k) / 8.0;
            let spot = course.spot(x);
            let pose = pose_of(case, &spot.pivot);
            for kind in case.kinds {
                let (_, _, gap, _) = contact(kind, &pose);
                assert!(gap.abs() < 1e-13, "{} {x} {gap}", case.seed);
            }
            let h = 1e-5 * longest;
            let [before, after] = [-h, h].map(|h| course.spot(x + h));
            let frame = course.frame(&spot);
            let [fb, fa] = [&before, &after].map(|spot| course.frame(spot));
            let per = |after: f64, before: f64| (after - before) / (2.0 * h);
            let turn = (after.pivot.orientation.angle()).minus(before.pivot.orientation.angle());
            let mut pairs = [(spot.turn.value, turn / (2.0 * h)); 16];
            let foot = per(after.pivot.foot, before.pivot.foot);
            pairs[1] = (spot.slide.value, foot);
            let mut i = 2;
            let mut add = |is: Sloped<f64>, after: Sloped<f64>, before: Sloped<f64>| {
                pairs[i] = (is.slope, per(after.value, before.value));
                i += 1;
            };
            add(spot.slide, after.slide, before.slide);
            add(spot.turn, after.turn, before.turn);
            add(frame.arm.x, fa.arm.x, fb.arm.x);
            add(frame.arm.y, fa.arm.y, fb.arm.y);
            for k in 0..2 {
                add(frame.velocities[k], fa.velocities[k], fb.velocities[k]);
                let [is, a, b] = [&frame, &fa, &fb].map(|f| f.reactions[k].x);
                add(is, a, b);
                let [is, a, b] = [&frame, &fa, &fb].map(|f| f.reactions[k].y);
                add(is, a, b);
            }
            let hand = (Vec2::new(0.3, -0.4), 0.1);
            let [is, a, b] = [&spot, &after, &before].map(|spot| course.terms(spot, hand));
            for k in 0..2 {
                let of = |(place, loads): &(Kinematics<Sloped<f64>>, [Wrench<Sloped<f64>>; 2])| {
                    (place.imbalance(loads[k]), place.normals(loads[k])[1])
                };
                let [is, a, b] = [&is, &a, &b].map(of);
                add(is.0, a.0, b.0);
                add(is.1, a.1, b.1);
            }
            for (i, (is, should)) in pairs.into_iter().enumerate() {
                let size = 1.0 + is.abs();
                let off = (is - should).abs();
                assert!(
                    off < 1e-4 / longest * size,
                    "{} {x} {i} {is} {should}",
                    case.seed
                );
            }
        }
    });
    assert!(
        cfg!(miri) || counts.iter().all(|&count| count > 100),
        "{counts:?}"
    );
}

/// A slip ends at the first point at which the statics written out say so, and not before.
#[test]
fn slip_ends_at_the_first_of_balance_and_opening() {
    let mut stopped = 0;
    let counts = driven::<f64>(Demand::Pressed, 2500, |case, trammel| {
        let course = course(case, trammel);
        let falls = trammel.falls();
        let (pivot, _, ending) = course.slip(falls, (0.0, Demand::Pressed));
        let signs = course.signs;
        let end = course.spot(0.0);
        let sense = {
            let (_, rest) = left(case, &case.grip, &pose_of(case, &end.pivot), signs);
            rest.signum()
        };
        let length = |pivot: &Pivot<f64>| {
            let turn = (pivot.orientation.angle()).minus(case.state.pivot.orientation.angle());
            let [s, w] = course.twist;
            s * (pivot.foot - case.state.pivot.foot) + w * turn
        };
        let x = length(&pivot);
        if ending == Ending::Stopped {
            stopped += 1;
            let (_, rest) = left(case, &case.grip, &pose_of(case, &pivot), signs);
            assert!(rest.abs() < 1e-12, "{} {rest}", case.seed);
        }
        for k in 1..200 {
            let spot = course.spot(x * f64::from(k) / 200.0);
            let (_, rest) = left(case, &case.grip, &pose_of(case, &spot.pivot), signs);
            assert!(rest * sense > -1e-12, "{} {k} {rest} {ending:?}", case.seed);
            let frame = course.frame(&spot);
            for (v, sign) in frame.velocities.iter().zip(signs) {
                assert!(v.value * sign > -1e-12, "{} {k}", case.seed);
            }
        }
    });
    assert!(
        cfg!(miri) || counts.iter().all(|&count| count > 100),
        "{counts:?}"
    );
    assert!(cfg!(miri) || stopped > 100, "{stopped}");
}

/// On whole slips, piece by piece, no gap opens or closes, and slips that end in balance are in balance.
#[test]
fn whole_slips_end_in_balance_with_both_gaps_closed() {
    let mut balanced = [0; 4];
    for (corners, count) in KINDS.into_iter().zip(&mut balanced) {
        for seed in sampled(0..2500, 97) {
            let case = case::<f64>(seed, corners);
            let mut state = case.state.clone();
            let moved = state.slip_to_the_end(&case.scene, &case.grip);
            let pose = pose_of(&case, &state.pivot);
            for kind in case.kinds {
                let (_, _, gap, _) = contact(kind, &pose);
                assert!(gap.abs() < 1e-13, "{seed} {gap}");
            }
            if moved.trigger == Trigger::Stopped && !moved.unbalanced {
                let all = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
                // Between surfaces that clamp the body other reactions may hold it there.
                let rests = all.iter().any(|&signs| {
                    let (_, rest) = left(&case, &case.grip, &pose, signs);
                    rest.abs() < 1e-12
                });
                assert!(rests, "{seed} {corners:?}");
                *count += 1;
            }
        }
    }
    assert!(
        cfg!(miri) || balanced.iter().all(|&count| count > 30),
        "{balanced:?}"
    );
}

/// Between two points of a piece the body moves no farther than 2 sqrt(2) times the distance between them along the twist: a piece ends
/// before the motion turns back, and leads to no other branch.
fn is_one_branch<W: World<f64>>(course: &Course<'_, f64, W>, case: u64) {
    let longest = course.longest();
    let mut last = course.spot(0.0);
    for k in 1..=64 {
        let spot = course.spot(longest * f64::from(k) / 64.0);
        let turn = (spot.pivot.orientation.angle()).minus(last.pivot.orientation.angle());
        let way = turn.hypot(spot.pivot.foot - last.pivot.foot);
        let most = 8f64.sqrt() * longest / 64.0;
        assert!(way <= most, "{case} {k}: {way}, allowed {most}");
        last = spot;
    }
}

#[test]
fn a_piece_is_one_branch() {
    driven::<f64>(Demand::AtTheEnd, 400, |case, trammel| {
        is_one_branch(&course(case, trammel), case.seed);
    });
}

/// A rod stands in a slit, its end on one wall, its side at a pin close to that wall. While the end slides down the wall the rod hardly
/// turns; across the twist at the beginning lies the position with the end of the rod above the pin.
#[test]
fn a_piece_in_a_slit_is_one_branch() {
    let mut count = 0;
    for (k, width) in (1..=60_u64).map(|k| (k, 0.0002 * k as f64)) {
        let pin = [-width, 12.0 * width];
        let (wall, pin) = ([[0.0, 3.0], [0.0, -3.0]], [pin]);
        let obstacle = |vertices| ObstacleDescription {
            vertices,
            friction_static: 0.2,
            friction_dynamic: 0.1,
            memory: None,
        };
        let up = 12f64.atan2(-1.0);
        let description = Description {
            vertices: &[[0.0, 0.0], [1.0, 0.0]],
            start: [0.0, 0.0, up],
            weight: 0.0,
            holding_point: None,
            reach: 0.0,
            stiffness_translation: 1.0,
            stiffness_rotation: 1.0,
            surfaces: &[],
            obstacles: &[obstacle(&wall), obstacle(&pin)],
        };
        type Slit = Scene<f64, 2, 1, WithObstacles<2, 3, Full>>;
        let slit = Slit::new(&description);
        let slit = slit.expect("a sound scene");
        let first = slit.surface_indices().end;
        let (vertex, surface) = (0, first);
        let on_wall = Pair { vertex, surface };
        let at_pin = Pair::of_corner(first + 2, 1);
        let pose = Pose {
            position: Vec2::ZERO,
            orientation: Orientation::new(Angle::from_radians(up)),
        };
        let pivot = Pivot::at(&slit, &pose, on_wall);
        assert!(pivot.placed(&slit).gap(&slit, at_pin).abs() < 1e-12);
        let grip = Grip {
            holding_point: Vec2::new(0.5, 0.0),
            hand: Vec2::new(0.0, -1.0),
            angle: Angle::from_radians(up - 1.0),
        };
        let contacts = (&pivot, at_pin);
        let Some(trammel) = Trammel::driven(&slit, contacts, &grip, Demand::AtTheEnd) else {
            continue;
        };
        count += 1;
        let course = Course::of(&slit, contacts, &grip, &trammel);
        is_one_branch(&course, k);
    }
    assert!(count > 30, "{count}");
}
