//! Several obstacles form one world: which sides are one line, which corners are covered; however the world is turned or mirrored.

use super::*;
use crate::Frictionless;

/// A side or a corner: its obstacle, its index there.
type Of = (usize, usize);

/// The sides that are one, with the length of the whole; the corners that are covered.
type Expected<'a> = (&'a [(&'a [Of], f64)], &'a [Of]);

/// The world mirrored at the y axis, or not, then turned and shifted.
fn moved(setup: &Setup, mirrored: bool, turn: f64) -> Setup {
    let (sin, cos) = turn.sin_cos();
    let turned = |[x, y]: [f64; 2]| {
        let x = if mirrored { -x } else { x };
        [cos * x - sin * y, sin * x + cos * y]
    };
    let mut other = setup.clone();
    // As far as fixed point permits.
    let shift = if turn == 0.0 { [0.0; 2] } else { [0.3, -0.7] };
    let place = |at: [f64; 2]| [turned(at)[0] + shift[0], turned(at)[1] + shift[1]];
    for shape in &mut other.shapes {
        for v in &mut shape.vertices {
            *v = place(*v);
        }
        if mirrored {
            shape.vertices.reverse();
        }
    }
    for (normal, offset) in &mut other.planes {
        *normal = turned(*normal);
        *offset += (normal[0] * shift[0] + normal[1] * shift[1]) / normal[0].hypot(normal[1]);
    }
    let [x, y] = place([setup.start[0], setup.start[1]]);
    other.start = [x, y, 0.0];
    other
}

fn check<R: Real<Si: SiFloat>>(setup: &Setup, expected: Expected<'_>) {
    check_model::<R, WithObstacles<6, 24>>(setup, expected);
}

fn check_model<R: Real<Si: SiFloat>, M: Model>(setup: &Setup, (lines, covered): Expected<'_>) {
    let number = |x: R| x.to_si(R::Si::ONE).widen();
    for (mirrored, turn) in [false, true]
        .into_iter()
        .flat_map(|mirrored| [0.0, 0.3, 1.1, 2.0, -2.6].map(|turn| (mirrored, turn)))
    {
        let scene: Scene<R, 4, 2, M> = moved(setup, mirrored, turn).scene().expect("sound");
        let corners = scene.corners();
        let count = |obstacle: usize| setup.shapes[obstacle].vertices.len();
        let first = |obstacle: usize| (0..obstacle).map(count).sum::<usize>();
        let corner_index = |(obstacle, k): Of| {
            let k = if mirrored { count(obstacle) - 1 - k } else { k };
            first(obstacle) + k
        };
        let side_index = |(obstacle, k): Of| {
            let n = count(obstacle);
            let k = if mirrored { (2 * n - 2 - k) % n } else { k };
            first(obstacle) + k
        };
        let all = || (0..setup.shapes.len()).flat_map(|o| (0..count(o)).map(move |k| (o, k)));
        for of in all() {
            let is = corners[corner_index(of)].covered;
            assert_eq!(
                is,
                covered.contains(&of),
                "corner {of:?}, {mirrored} {turn}"
            );
            let alone = [of];
            let members = lines.iter().find(|(sides, _)| sides.contains(&of));
            let members = members.map_or(&alone[..], |(sides, _)| sides);
            let first = members.iter().map(|&side| side_index(side)).min();
            let index = u8::try_from(setup.planes.len() + first.expect("one")).expect("few");
            let side = &corners[side_index(of)];
            assert_eq!(side.line, index, "side {of:?}, {mirrored} {turn}");
        }
        for (sides, length) in lines {
            for &of in *sides {
                let side = &corners[side_index(of)];
                let of_first = &corners[side_index(sides[0])];
                assert_eq!((side.side, side.reach), (of_first.side, of_first.reach));
                let found = number(side.reach[1]) - number(side.reach[0]);
                assert!((found - length).abs() < 2e-6, "{found} {length}");
            }
        }
    }
}

#[track_caller]
fn united(shapes: &[Shape], expected: Expected<'_>) {
    let setup = Setup::of(shapes);
    in_all_numbers!(check, &setup, expected);
}

const UNIT: [f64; 2] = [1.0, 1.0];

/// Bottoms and tops are united; of the corners between them those of the first remain.
#[test]
fn boxes_side_by_side_are_one() {
    let lines: [(&[Of], f64); 2] = [(&[(0, 0), (1, 0)], 2.0), (&[(0, 2), (1, 2)], 2.0)];
    united(
        &[block([0.0, 0.0], UNIT), block([1.0, 0.0], UNIT)],
        (&lines, &[(1, 0), (1, 3)]),
    );
    united(
        &[block([1.0, 0.0], UNIT), block([0.0, 0.0], UNIT)],
        (&lines, &[(1, 1), (1, 2)]),
    );
    // Overlapping, each has two corners in or on the other one.
    let lines: [(&[Of], f64); 2] = [(&[(0, 0), (1, 0)], 1.75), (&[(0, 2), (1, 2)], 1.75)];
    united(
        &[block([0.0, 0.0], UNIT), block([0.75, 0.0], UNIT)],
        (&lines, &[(0, 1), (0, 2), (1, 0), (1, 3)]),
    );
}

/// The outer ones are united through the inner one, whatever their order.
#[test]
fn three_in_a_row_are_one() {
    let lines: [(&[Of], f64); 2] = [
        (&[(0, 0), (1, 0), (2, 0)], 3.0),
        (&[(0, 2), (1, 2), (2, 2)], 3.0),
    ];
    let at = |x: f64| block([x, 0.0], UNIT);
    let inner: [Of; 4] = [(2, 0), (2, 1), (2, 2), (2, 3)];
    united(&[at(0.0), at(2.0), at(1.0)], (&lines, &inner));
    let row: [Of; 4] = [(1, 0), (1, 3), (2, 0), (2, 3)];
    united(&[at(0.0), at(1.0), at(2.0)], (&lines, &row));
    let last: [Of; 4] = [(1, 1), (1, 2), (2, 0), (2, 3)];
    united(&[at(1.0), at(0.0), at(2.0)], (&lines, &last));
}

/// 1e-9 body sizes, or a touch, is no step and no gap; more is one.
#[test]
fn near_is_what_the_number_type_does_not_tell_apart() {
    fn steps<R: Real<Si: SiFloat>>() {
        let exact = R::EPSILON.to_si(R::Si::ONE).widen() < 1e-9;
        let (little, more) = if exact {
            (0.5e-9, 2e-9)
        } else {
            (0.5e-6, 1.5e-5)
        };
        let beside =
            |x: f64, y: f64| Setup::of(&[block([0.0, 0.0], UNIT), block([1.0 + x, y], UNIT)]);
        let lines: [(&[Of], f64); 2] = [(&[(0, 0), (1, 0)], 2.0), (&[(0, 2), (1, 2)], 2.0)];
        let one: Expected<'_> = (&lines, &[(1, 0), (1, 3)]);
        for off in [-little, little] {
            check::<R>(&beside(0.0, off), one);
            check::<R>(&beside(off, 0.0), one);
        }
        check::<R>(&beside(0.0, more), (&[], &[(0, 2), (1, 0)]));
        check::<R>(&beside(0.0, -more), (&[], &[(0, 1), (1, 3)]));
        check::<R>(&beside(more, 0.0), (&[], &[]));
        // One on top of the other, not quite flush.
        let upon = |x: f64| Setup::of(&[block([0.0, 0.0], UNIT), block([x, 1.0], UNIT)]);
        check::<R>(&upon(more), (&[], &[(0, 2), (1, 0)]));
        let lines: [(&[Of], f64); 2] = [(&[(0, 1), (1, 1)], 2.0), (&[(0, 3), (1, 3)], 2.0)];
        check::<R>(&upon(little), (&lines, &[(1, 0), (1, 1)]));
    }
    in_all_numbers!(steps);
}

#[test]
fn pieces_of_an_angle_are_one() {
    let lines: [(&[Of], f64); 1] = [(&[(0, 3), (1, 3)], 2.0)];
    let [foot, upright] = [block([0.0, 0.0], [2.0, 1.0]), block([0.0, 1.0], UNIT)];
    united(&[foot, upright], (&lines, &[(1, 0), (1, 1)]));
}

/// Lines of sides at an angle to each other are not united, nor are those that face each other.
#[test]
fn sides_that_turn_or_face_away_are_not_one() {
    let roof = shape(&[[1.0, 0.0], [2.0, 0.5], [2.0, 1.0], [1.0, 1.0 + 1e-4]]);
    united(&[block([0.0, 0.0], UNIT), roof], (&[], &[(1, 0), (0, 2)]));
    let below = block([1.0, -1.0], UNIT);
    // Between their sides less than a half-plane is free.
    united(&[block([0.0, 0.0], UNIT), below], (&[], &[(0, 1), (1, 3)]));
    // A wall on a box: its upper side is a part of the box's, its lower one is inside the box.
    let lines: [(&[Of], f64); 1] = [(&[(0, 2), (1, 1)], 1.0)];
    let wall = shape(&[[0.25, 1.0], [0.75, 1.0]]);
    united(
        &[block([0.0, 0.0], UNIT), wall],
        (&lines, &[(1, 0), (1, 1)]),
    );
    // Two collinear walls, united on both of their sides; two that cross.
    let wall = |from: [f64; 2], to: [f64; 2]| shape(&[from, to]);
    let lines: [(&[Of], f64); 2] = [(&[(0, 0), (1, 0)], 2.0), (&[(0, 1), (1, 1)], 2.0)];
    let straight = wall([0.0, 0.0], [1.0, 0.0]);
    united(
        &[straight.clone(), wall([1.0, 0.0], [2.0, 0.0])],
        (&lines, &[(1, 0)]),
    );
    united(&[straight, wall([0.5, -1.0], [0.5, 1.0])], (&[], &[]));
}

#[test]
fn friction_parts_sides() {
    let with = |mu: [f64; 2], memory: Option<f64>| {
        let mut second = block([1.0, 0.0], UNIT);
        (second.mu, second.memory) = (mu, memory);
        [block([0.0, 0.0], UNIT), second]
    };
    let lines: [(&[Of], f64); 2] = [(&[(0, 0), (1, 0)], 2.0), (&[(0, 2), (1, 2)], 2.0)];
    let covered: [Of; 2] = [(1, 0), (1, 3)];
    united(&with([0.5, 0.3], Some(1.0 / 4096.0)), (&lines, &covered));
    united(&with([0.5, 0.3], Some(1.0 / 1024.0)), (&[], &covered));
    united(&with([0.5, 0.4], None), (&[], &covered));
    united(&with([0.6, 0.3], None), (&[], &covered));
    // Parameters that a model does not have separate nothing.
    let mut smooth = with([0.0; 2], Some(0.1));
    smooth[0].mu = [0.0; 2];
    type Smooth = WithObstacles<6, 24, Frictionless>;
    check_model::<f32, Smooth>(&Setup::of(&smooth), (&lines, &covered));
}

#[test]
fn half_planes_cover_corners() {
    let on = |height: f64| {
        let mut setup = Setup::of(&[block([0.0, height], UNIT), shape(&[[3.0, 0.5]])]);
        setup.planes = vec![([0.0, 2.0], 0.0), ([-1.0, 0.0], -4.0)];
        setup
    };
    let feet: [Of; 2] = [(0, 0), (0, 1)];
    for height in [0.0, -0.5, 1e-10] {
        let setup = on(height);
        in_all_numbers!(check, &setup, (&[], &feet));
    }
    in_all_numbers!(check, &on(1.5e-5), (&[], &[]));
    let setup = on(-1.0);
    in_all_numbers!(check, &setup, (&[], &[(0, 0), (0, 1), (0, 2), (0, 3)]));
}

#[test]
fn pins_are_covered() {
    let with = |pin: [f64; 2]| [block([0.0, 0.0], UNIT), shape(&[pin])];
    for pin in [[0.5, 0.5], [0.5, 1.0], [1.0, 0.25], [1.0, 1.0]] {
        united(&with(pin), (&[], &[(1, 0)]));
    }
    for pin in [[0.5, 1.0 + 1.5e-5], [-1.5e-5, 0.25]] {
        united(&with(pin), (&[], &[]));
    }
    // The first corner at a point remains.
    let [corner, pin] = with([1.0, 1.0]);
    united(&[pin.clone(), corner], (&[], &[(1, 2)]));
    united(&[pin.clone(), pin], (&[], &[(1, 0)]));
}

/// A thin tip ends at its corner, although the lines of its sides extend a hundred times farther.
#[test]
fn nothing_is_covered_beyond_a_tip() {
    let tip = shape(&[[0.0, 0.0], [-2.0, 0.005], [-2.0, -0.005]]);
    united(&[tip.clone(), shape(&[[2e-5, 0.0]])], (&[], &[]));
    united(&[tip, shape(&[[1e-10, 0.0]])], (&[], &[(1, 0)]));
}

/// A short side's direction is rounded; that of the line is the long one's.
#[test]
fn line_has_the_direction_of_its_longest_side() {
    fn check_tilt<R: Real<Si: SiFloat>>() {
        let chip = block([-1.0 / 4096.0, 0.0], [1.0 / 4096.0, 1.0]);
        let table = block([0.0, 0.0], [3.0, 1.0]);
        let lines: [(&[Of], f64); 2] = [
            (&[(0, 0), (1, 0)], 3.0 + 1.0 / 4096.0),
            (&[(0, 2), (1, 2)], 3.0 + 1.0 / 4096.0),
        ];
        let setup = Setup::of(&[chip, table.clone()]);
        check::<R>(&setup, (&lines, &[(1, 0), (1, 3)]));
        let both: Among<R> = moved(&setup, false, 0.3).scene().expect("sound");
        let alone: Among<R> = moved(&Setup::of(&[table]), false, 0.3)
            .scene()
            .expect("sound");
        for side in [0, 2] {
            assert_eq!(both.corners()[side].side, alone.corners()[side].side);
        }
    }
    in_all_numbers!(check_tilt);
}
