//! Where obstacles meet: nothing passes between them, however thin it is, and a rod leans over the place as over one obstacle.

use stiction_core::{Evolution, Status};
use stiction_tests::obstacles::Run;
use stiction_tests::obstacles::laws::Laws;
use stiction_tests::obstacles::scene::{Among, Obstacle};
use stiction_tests::run::polyline;
use stiction_tests::{Number, Setup, test_each};

test_each!(
    cases::nothing_slides_between_a_block_and_its_ground,
    cases::rod_turns_about_the_place_where_two_walls_meet,
    cases::box_turns_next_to_the_place_where_two_walls_meet,
);

/// A box between two x and two y; upside down if `up` is -1.
fn block([left, right]: [f64; 2], [low, high]: [f64; 2], up: f64, mu: f64) -> Obstacle {
    let [low, high] = if up > 0.0 { [low, high] } else { [-high, -low] };
    Obstacle {
        vertices: vec![[left, low], [right, low], [right, high], [left, high]],
        friction: [mu, mu],
    }
}

mod cases {
    use super::*;

    /// On ground at y = 0 or below a ceiling there, a rod or a point that is pressed by N slides against a block that stands on it, or hangs
    /// from it, from x = 0 on: on the middle of the ground, over its end, from its end, or on a half-plane. It lags by mu N / k_h and stops at
    /// the block.
    pub(super) fn nothing_slides_between_a_block_and_its_ground<R: Number>(evolution: Evolution) {
        const N: f64 = 0.2;
        let grounds = [Some(2.0), Some(0.25), Some(0.0), None];
        let ways = [(1.0, 0.0), (1.0, 0.3), (-1.0, 0.0), (-1.0, 0.3)];
        for (up, mu) in ways {
            for (ground, long) in grounds.into_iter().flat_map(|g| [(g, 0.0), (g, 1.0)]) {
                let body = if long > 0.0 {
                    Setup::rod(long)
                } else {
                    Setup::point()
                };
                let start = -0.5 - long;
                let mut setup = body.held_at([long / 2.0, 0.0]).springs(1.0, 0.5);
                setup = setup.at([start, 0.0, 0.0]);
                let mut obstacles = vec![block([0.0, 0.5], [0.0, 0.4], up, mu)];
                match ground {
                    Some(end) => obstacles.push(block([-3.0, end], [-0.2, 0.0], up, mu)),
                    None => setup = setup.surface([0.0, up], 0.0, [mu, mu]),
                }
                let scene = Among { setup, obstacles };
                let what = format!("{} up {up} mu {mu} {ground:?} {long}", R::NAME);
                let laws = Laws::new::<R>(&scene);
                let mut run = Run::<R>::start(&scene, evolution, [start + long / 2.0, 0.0, 0.0]);
                for k in 0..=40 {
                    let hand = start + 0.0313 * f64::from(k);
                    let frame = run.step([hand + long / 2.0, -up * N, 0.0]);
                    assert_eq!(frame.status, Status::Ok, "{what}: {frame:?}");
                    let broken = laws.broken(frame);
                    assert!(broken.is_empty(), "{what}: {broken:?} {frame:?}");
                    let [x, y, theta] = frame.pose;
                    R::near(&what, x, (hand - mu * N).clamp(start, -long));
                    R::near(&what, y, 0.0);
                    R::near(&what, theta, 0.0);
                }
            }
        }
    }

    /// A rod comes to stand on the floor, flat on a wall that slopes down to it, and juts out over the upper end of the wall. Pushed down there, its
    /// lower end slides away from the wall and it turns about that end. Another wall that slopes away from there changes nothing, whichever of
    /// the two is described first.
    pub(super) fn rod_turns_about_the_place_where_two_walls_meet<R: Number>(evolution: Evolution) {
        let wall = |from: [f64; 2], to: [f64; 2]| Obstacle {
            vertices: vec![from, to],
            friction: [0.1, 0.1],
        };
        let slope = wall([0.6, -0.8], [0.0, 0.0]);
        let theta = 0.8_f64.atan2(-0.6);
        let follow = |obstacles: Vec<Obstacle>| {
            let setup = Setup::rod(1.0).held_at([0.5, 0.0]).springs(1.0, 0.1);
            let setup = setup.surface([0.0, 1.0], -0.4, [0.1, 0.1]);
            let setup = setup.at([0.34, -0.37, theta]);
            let scene = Among { setup, obstacles };
            let laws = Laws::new::<R>(&scene);
            let [above, on] = [[0.04, 0.03, theta], [0.0, 0.0, theta - 0.4]];
            let hands = polyline(&[above, on, [-0.08, -0.4, theta - 0.4]], 40);
            let mut run = Run::<R>::start(&scene, evolution, above);
            let poses = hands.into_iter().map(|hand| {
                let frame = run.step(hand);
                assert_eq!(frame.status, Status::Ok, "{frame:?}");
                let broken = laws.broken(frame);
                assert!(broken.is_empty(), "{broken:?} {frame:?}");
                frame.pose
            });
            poses.collect::<Vec<_>>()
        };
        let alone = follow(vec![slope.clone()]);
        let turns = |pose: &[f64; 3]| pose[2] > theta + 0.05;
        assert!(alone.last().is_some_and(turns), "{alone:?}");
        for end in [[-1.0, -0.1], [-0.5, -0.8], [0.2, -0.8], [-1.0, 0.5]] {
            let other = wall([0.0, 0.0], end);
            for both in [[slope.clone(), other.clone()], [other, slope.clone()]] {
                let what = format!("{} {:?}", R::NAME, both[1].vertices);
                for (pose, expected) in follow(both.to_vec()).iter().zip(&alone) {
                    for k in 0..3 {
                        R::near(&what, pose[k], expected[k]);
                    }
                }
            }
        }
    }

    /// Without friction a box stands with a vertex in the hollow of two walls. A hand that goes away from one of them in one step takes it along
    /// the other, and turns it next to the place where they meet: it comes to where a hundred steps lead it.
    pub(super) fn box_turns_next_to_the_place_where_two_walls_meet<R: Number>(
        evolution: Evolution,
    ) {
        let wall = |from: [f64; 2], to: [f64; 2]| Obstacle {
            vertices: vec![from, to],
            friction: [0.0, 0.0],
        };
        let theta = std::f64::consts::FRAC_PI_4;
        let setup = Setup::block(1.0, 0.6).springs(1.0, 0.2);
        let setup = setup.held_at([0.0, 0.3]).standing(0, [0.0, 0.0], theta);
        let [x, y] = setup.grip();
        let obstacles = vec![wall([0.0, 0.0], [-1.0, 0.5]), wall([1.0, 0.5], [0.0, 0.0])];
        let scene = Among { setup, obstacles };
        let laws = Laws::new::<R>(&scene);
        for turn in [0.05, -0.05] {
            let away = [x + 0.3, y, theta + turn];
            let ends = [100, 1].map(|count| {
                let mut run = Run::<R>::start(&scene, evolution, [x, y, theta]);
                for hand in polyline(&[[x, y - 0.2, theta], away], count) {
                    let frame = run.step(hand);
                    assert_eq!(frame.status, Status::Ok, "{turn}: {frame:?}");
                    let broken = laws.broken(frame);
                    assert!(broken.is_empty(), "{turn}: {broken:?} {frame:?}");
                }
                run.frame.pose
            });
            let [slowly, at_once] = ends;
            for k in 0..3 {
                R::near(&format!("{} {turn}", R::NAME), at_once[k], slowly[k]);
            }
        }
    }
}
