//! Named scenes with few events, at least one for every state and every exit from it.

use crate::random::Scenario;
use crate::setup::Setup;
use std::f64::consts::{FRAC_PI_4, FRAC_PI_6, PI, SQRT_2};

const FRICTION: [f64; 2] = [0.5, 0.3];

/// All of them: name and scene.
pub fn all() -> Vec<(&'static str, Scenario)> {
    vec![
        ("box on a vertex", box_on_a_vertex()),
        ("box flat", box_flat()),
        ("box as a ladder", box_as_a_ladder()),
        ("block against a wall", block_against_a_wall()),
        ("block dropped into a corner", block_dropped_into_a_corner()),
        ("block in a wide corner", block_in_a_wide_corner()),
        ("block lifted straight", block_lifted_straight()),
        ("block lifted obliquely", block_lifted_obliquely()),
        ("block tips", block_tips()),
        ("block set down tilted", block_set_down_tilted()),
        (
            "block slid flush against a slanted wall",
            block_slid_flush(),
        ),
        ("strut buckles", strut_buckles()),
        ("strut buckles in a groove", strut_buckles_in_a_groove()),
        ("pendulum folds", pendulum_folds()),
        ("strut falls on its edge", strut_falls_on_its_edge()),
        (
            "rod slides between floor and wall",
            rod_between_floor_and_wall(0.9),
        ),
        (
            "rod lies down between floor and wall",
            rod_between_floor_and_wall(-3.0),
        ),
        ("rod buckles between smooth walls", rod_buckles()),
        ("rod taken off floor and wall", rod_taken_off()),
        ("rod dropped between floor and wall", rod_dropped()),
        ("point in a corner", point_in_a_corner()),
        ("tip slides along", tip_slides()),
        ("frictionless tip", frictionless_tip()),
    ]
}

fn scenario(setup: Setup, keyframes: &[[f64; 3]]) -> Scenario {
    Scenario {
        setup,
        keyframes: keyframes.to_vec(),
    }
}

/// The hand grasps the body where it stands and moves by each of the offsets from there.
pub(crate) fn from_grip(setup: Setup, offsets: &[[f64; 3]]) -> Scenario {
    let ([x, y], theta) = (setup.grip(), setup.start[2]);
    let hand = |[dx, dy, turn]: &[f64; 3]| [x + dx, y + dy, theta + turn];
    let keyframes: Vec<_> = std::iter::once(&[0.0; 3])
        .chain(offsets)
        .map(hand)
        .collect();
    scenario(setup, &keyframes)
}

/// The box of the benchmarks, tilted by 30 degrees, pressed 10 mm deep and dragged by 0.1 m.
pub fn box_on_a_vertex() -> Scenario {
    let setup = Setup::bench_box()
        .standing(0, [0.0, 0.0], FRAC_PI_6)
        .floor(FRICTION);
    from_grip(setup, &[[0.0, -0.01, 0.0], [0.1, -0.01, 0.0]])
}

/// The box of the benchmarks flat on the floor.
pub fn box_flat() -> Scenario {
    let setup = Setup::bench_box()
        .standing(0, [0.0, 0.0], 0.0)
        .floor(FRICTION);
    from_grip(setup, &[[0.0, -0.01, 0.0], [0.1, -0.01, 0.0]])
}

/// The box of the benchmarks, tilted by 30 degrees, with one vertex on the floor and one on a wall; it is pressed into both and
/// dragged up along the wall.
pub fn box_as_a_ladder() -> Scenario {
    let setup = Setup::bench_box()
        .standing(0, [0.0, 0.0], FRAC_PI_6)
        .floor(FRICTION);
    let [x, _] = setup.world(setup.start, [0.05, -0.03]);
    from_grip(
        setup.wall(x, FRICTION),
        &[
            [0.0, -0.01, 0.0],
            [0.01, -0.01, 0.0],
            [0.01, -0.01, 0.6],
            [0.01, 0.05, 0.6],
        ],
    )
}

fn block() -> Setup {
    Setup::block(2.0, 1.0).held_at([0.0, 0.5]).floor(FRICTION)
}

fn block_against_a_wall() -> Scenario {
    from_grip(
        block().at([0.0, 0.3, 0.0]).wall(1.487, [0.4, 0.2]),
        &[
            [0.0, -0.5, 0.0],
            [1.513, -0.5, 0.0],
            [-0.227, -0.5, 0.0],
            [0.813, -0.513, 0.0],
            [0.813, 0.5, 0.0],
        ],
    )
}

/// Floor and wall are reached at the same instant.
fn block_dropped_into_a_corner() -> Scenario {
    from_grip(
        block().at([0.0, 0.3, 0.0]).wall(1.3, [0.4, 0.2]),
        &[
            [0.6, -0.6, 0.0],
            [0.6, -0.6, 0.3],
            [0.6, -0.6, -0.3],
            [-0.3, 0.6, 0.0],
        ],
    )
}

/// The wall leans back by 0.3 rad, so that the block can turn about the vertex in the corner.
fn block_in_a_wide_corner() -> Scenario {
    let (sin, cos) = 0.3f64.sin_cos();
    let setup = block().surface([-cos, sin], -cos, [0.4, 0.2]);
    from_grip(
        setup,
        &[
            [0.3, -0.2, 0.0],
            [0.3, -0.2, -1.5],
            [0.3, -0.2, 0.2],
            [-0.5, 0.4, 0.2],
        ],
    )
}

fn block_lifted_straight() -> Scenario {
    from_grip(block().weighing(0.3), &[[0.0, -0.2, 0.0], [0.0, 0.6, 0.0]])
}

fn block_lifted_obliquely() -> Scenario {
    from_grip(block(), &[[0.0, -0.2, 0.0], [0.4, 0.2, 0.0]])
}

fn block_tips() -> Scenario {
    let setup = Setup::block(1.0, 1.6).held_at([0.0, 0.8]).floor([0.9, 0.4]);
    from_grip(
        setup,
        &[
            [0.0, -0.2, 0.0],
            [0.16, -0.2, 0.0],
            [-0.16, -0.2, 0.0],
            [0.0, -0.2, -1.9],
        ],
    )
}

fn block_set_down_tilted() -> Scenario {
    from_grip(
        block().at([0.0, 1.0, 0.4]),
        &[
            [0.0, -1.1, 0.0],
            [0.0, -1.1, -0.5],
            [0.3, -1.0, -0.5],
            [0.3, -0.2, 0.3],
        ],
    )
}

/// On a smooth floor, held straight above its lowest corner, the block slides without turning and meets the wall, which
/// is parallel to its side, with two corners simultaneously.
fn block_slid_flush() -> Scenario {
    let (sin, cos) = FRAC_PI_6.sin_cos();
    let above = [-0.5 + 0.6 * sin, 0.6 * cos];
    let setup = Setup::block(1.0, 1.0)
        .held_at(above)
        .standing(0, [0.0, 0.0], FRAC_PI_6)
        .floor([0.0, 0.0])
        .surface([-cos, -sin], -(1.0 + 0.5 * cos), [0.5, 0.3]);
    from_grip(setup, &[[0.0, -0.13, 0.0], [0.83, -0.13, 0.0]])
}

/// The triangle on its tip, pulled down by a hand below the floor; kappa is that of the fold.
pub fn strut(kappa: f64, theta: f64) -> Setup {
    Setup::triangle()
        .held_at([0.0, 1.0])
        .springs(1.0, 1.0 / kappa)
        .standing(0, [0.0, 0.0], theta)
        .floor([0.95, 0.5])
}

fn strut_buckles() -> Scenario {
    scenario(
        strut(1.2, 1.23),
        &[[0.0, -1.0, 0.1], [0.0, -1.0, -0.12], [0.0, -1.0, 0.1]],
    )
}

/// The strut's tip in a groove of two surfaces at 20 degrees.
fn strut_buckles_in_a_groove() -> Scenario {
    let (sin, cos) = 0.35f64.sin_cos();
    let groove = Setup {
        surfaces: Vec::new(),
        ..strut(1.2, 0.9)
    };
    let setup = groove
        .surface([sin, cos], 0.0, [0.95, 0.5])
        .surface([-sin, cos], 0.0, [0.95, 0.5]);
    scenario(
        setup,
        &[[0.0, -1.0, 0.05], [0.0, -1.0, -0.12], [0.0, -1.0, 0.1]],
    )
}

/// A block held at its bottom, its weight above the hand.
fn pendulum_folds() -> Scenario {
    let setup = Setup::block(2.0, 1.0)
        .springs(1.0, 0.25)
        .weighing(1.0)
        .at([0.0, 9.0, 0.0])
        .floor(FRICTION);
    from_grip(
        setup,
        &[[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0, -8.0, -1.0]],
    )
}

fn strut_falls_on_its_edge() -> Scenario {
    scenario(
        strut(2.0, 1.19),
        &[[0.0, -1.0, -0.665], [0.0, -1.0, -0.7], [0.0, 1.5, 0.0]],
    )
}

/// k_theta of [`rod_buckles`] (N·m/rad): m = 1.06, so that it folds at |u| = acos(1 / m) = 0.338.
pub const BUCKLING: f64 = SQRT_2 / 2.0 / 1.06;

/// A rod of length 2 with its ends on a smooth floor and a smooth wall, held in the middle by a hand at (-1/2, -1/2) that turns: the rod
/// buckles to the other side and back. At a turn of -pi/4 - beta it rests at -pi/4 - u with u - m sin u = beta, m = 1 / (sqrt 2 k_theta).
pub fn rod_buckles() -> Scenario {
    let u = 0.65_f64;
    let (sin, cos) = (FRAC_PI_4 + u).sin_cos();
    let setup = Setup::new(&[[-1.0, 0.0], [1.0, 0.0]])
        .at([cos, sin, -FRAC_PI_4 - u])
        .springs(1.0, BUCKLING)
        .floor([0.0, 0.0])
        .surface([1.0, 0.0], 0.0, [0.0, 0.0]);
    let hand = |beta: f64| [-0.5, -0.5, -FRAC_PI_4 - beta];
    let turns = [u - u.sin() * SQRT_2 / 2.0 / BUCKLING, -0.02, 0.02, 0.0];
    scenario(setup, &turns.map(hand))
}

/// A rod that leans by 1 rad between floor and wall.
pub fn leaning_rod() -> Setup {
    let friction = [0.4, 0.2];
    Setup::new(&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.1]])
        .held_at([1.0, 0.0])
        .springs(1.0, 4.0)
        .standing(0, [-2.0 * 1f64.cos(), 0.0], 1.0)
        .floor(friction)
        .wall(0.0, friction)
}

/// The leaning rod under a load, while the hand turns to `phi`.
fn rod_between_floor_and_wall(phi: f64) -> Scenario {
    let (sin, cos) = 1f64.sin_cos();
    let setup = leaning_rod();
    scenario(setup, &[[-cos, sin - 2.0, 1.905], [-cos, sin - 2.0, phi]])
}

fn rod_taken_off() -> Scenario {
    let friction = [1.2, 0.8];
    let setup = Setup::rod(2.0)
        .held_at([1.0, 0.0])
        .standing(0, [2.0 * FRAC_PI_4.cos(), 0.0], PI - FRAC_PI_4)
        .floor(friction)
        .surface([1.0, 0.0], 0.0, friction);
    from_grip(
        setup,
        &[
            [-0.2, -0.2, 0.0],
            [0.3, -0.3, 0.0],
            [-0.3, -0.3, 0.0],
            [-0.3, 0.4, 0.0],
            [0.4, 0.5, 0.0],
        ],
    )
}

/// Floor and wall are reached at the same instant.
fn rod_dropped() -> Scenario {
    let foot = [0.3 + 2.0 * FRAC_PI_4.cos(), 0.3];
    let setup = Setup::rod(2.0)
        .held_at([1.0, 0.0])
        .standing(0, foot, PI - FRAC_PI_4)
        .floor(FRICTION)
        .surface([1.0, 0.0], 0.0, FRICTION);
    from_grip(
        setup,
        &[[-0.6, -0.6, 0.0], [-0.6, -0.6, 0.5], [-0.6, -0.6, -0.5]],
    )
}

/// A point that is pressed into a corner of 90 degrees, and drawn out along either surface and straight away.
fn point_in_a_corner() -> Scenario {
    let setup = Setup::point().floor(FRICTION).wall(1.0, FRICTION);
    // It returns at another depth than it left, so that no slip ends where another surface begins.
    let (press, away) = ([1.203, -0.203, 0.0], [0.493, 0.507, 0.0]);
    let keyframes = [
        away,
        press,
        [0.487, -0.207, 0.0],
        press,
        [1.203, 0.509, 0.0],
        [1.223, -0.203, 0.0],
        away,
    ];
    scenario(setup.at(away), &keyframes)
}

fn tip_slides() -> Scenario {
    let setup = Setup::triangle()
        .held_at([0.0, 1.0])
        .springs(1.0, 0.5)
        .at([0.0, 0.5, 0.0]);
    from_grip(
        setup.floor([0.6, 0.3]),
        &[[0.0, -0.9, 0.0], [1.5, -0.9, 0.0], [1.5, 0.4, 0.0]],
    )
}

fn frictionless_tip() -> Scenario {
    let setup = Setup::triangle()
        .held_at([0.0, 1.0])
        .springs(1.0, 0.5)
        .at([0.0, 0.5, 0.3]);
    from_grip(
        setup.floor([0.0, 0.0]),
        &[[0.0, -1.0, 0.0], [0.7, -1.0, 0.2]],
    )
}
