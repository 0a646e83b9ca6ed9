//! Capacities leave parts of the solver out of the binary; they change no bit of an answer.

use stiction_core::{Evolution, Parameter, Scene, Solver};
use stiction_tests::expect::times;
use stiction_tests::random::{Scenario, scenarios};
use stiction_tests::run::{planar, polyline};
use stiction_tests::{Number, Setup, test_each};

test_each!(
    cases::every_capacity_gives_the_same_bits,
    cases::room_for_one_surface_gives_the_same_bits,
);

fn tool() -> Setup {
    Setup::point().held_at([0.0, 0.3]).springs(1.0, 0.2)
}

fn block() -> Setup {
    Setup::block(0.8, 0.6).held_at([0.1, 0.4]).springs(1.0, 0.3)
}

/// Down, along, back, off and down again.
fn keyframes(setup: &Setup) -> [[f64; 3]; 6] {
    let ([x, y], theta) = (setup.grip(), setup.start[2]);
    let l = setup.size();
    [
        [0.0, 0.0, 0.0],
        [0.1, -0.2, 0.1],
        [1.2, -0.2, 0.7],
        [0.1, -0.1, -0.9],
        [0.0, 0.8, 0.0],
        [-0.4, -0.3, 0.2],
    ]
    .map(|[dx, dy, turn]| [x + dx * l, y + dy * l, theta + turn])
}

/// Runs a hand path in a model with its own capacity and in the full one, frame by frame.
fn same_as_full<R: Number, const V: usize, const S: usize, const C: usize>(
    setup: &Setup,
    keyframes: &[[f64; 3]],
    evolution: Evolution,
) {
    let small: Scene<R, V, S, C> = setup.scene_of().expect("the scene fits the model");
    let full = setup.scene::<R>().expect("the scene is sound");
    let (small, full) = (Solver::new(small, evolution), Solver::new(full, evolution));
    let hands = polyline(keyframes, 50).into_iter().map(planar::<R>);
    let mut runs = None;
    for hand in hands {
        let outputs = match &mut runs {
            None => {
                let ((s, first), (f, second)) = (small.start(hand), full.start(hand));
                runs = Some((s, f));
                (first, second)
            }
            Some((s, f)) => (small.step(s, hand), full.step(f, hand)),
        };
        assert_eq!(outputs.0, outputs.1, "{} {evolution:?}: {setup:?}", R::NAME);
        if let Some((s, f)) = &runs {
            assert_eq!(small.wrench(s), full.wrench(f));
            assert_eq!(small.contacts(s), full.contacts(f));
        }
    }
}

const ROUGH: [f64; 2] = [0.5, 0.3];
const SMOOTH: [f64; 2] = [0.0, 0.0];

mod cases {
    use super::*;

    /// Bodies of one vertex and of four, on one surface and on two, with friction and without, with weight and without.
    pub(super) fn every_capacity_gives_the_same_bits<R: Number>(evolution: Evolution) {
        for friction in [ROUGH, SMOOTH] {
            for weight in [0.0, 0.2] {
                let (tool, block) = (tool().weighing(weight), block().weighing(weight));
                let [tool, block] = [tool, block].map(|body| body.floor(friction));
                let [of_tool, of_block] = [&tool, &block].map(keyframes);
                same_as_full::<R, 1, 1, 0>(&tool, &of_tool, evolution);
                same_as_full::<R, 4, 1, 0>(&block, &of_block, evolution);
                same_as_full::<R, 4, 1, 16>(&block, &of_block, evolution);
                let [tool, block] = [tool.wall(0.6, friction), block.wall(0.9, friction)];
                same_as_full::<R, 1, 2, 0>(&tool, &of_tool, evolution);
                same_as_full::<R, 4, 2, 16>(&block, &of_block, evolution);
            }
        }
    }

    /// Random bodies on the first of their surfaces, a third of them without a stiffness of the angle.
    pub(super) fn room_for_one_surface_gives_the_same_bits<R: Number>(evolution: Evolution) {
        for (k, Scenario { setup, keyframes }) in scenarios(times(60, 2000), 6).enumerate() {
            let mut setup = setup;
            setup.surfaces.truncate(1);
            if k % 3 == 0 {
                setup.stiffness_rotation = 0.0;
            }
            if setup.vertices.len() == 1 {
                same_as_full::<R, 1, 1, 0>(&setup, &keyframes, evolution);
            } else {
                same_as_full::<R, 6, 1, 0>(&setup, &keyframes, evolution);
            }
        }
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let block = Setup::block(0.8, 0.6);
    let rough = block.clone().floor([0.5, 0.3]);
    let error = rough.scene_of::<f32, 3, 1, 0>().expect_err("vertices");
    assert_eq!(error.parameter, Parameter::VertexCount);
    let error = rough
        .floor([0.5, 0.3])
        .scene_of::<f32, 4, 1, 0>()
        .expect_err("surfaces");
    assert_eq!(error.parameter, Parameter::SurfaceCount);
}
