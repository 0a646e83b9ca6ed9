//! A smaller model is the same solver with parts left out: where a scene does without them, it gives the same bits as the
//! full one; where it does not, the scene is refused.

use stiction_core::{
    Bare, Evolution, Fixed, Frictionless, Full, Model, Parameter, Scene, Solver, Weightless,
};
use stiction_tests::run::{planar, polyline};
use stiction_tests::{EVOLUTIONS, Number, Setup};

/// Runs a hand path in a model of its own capacity and in the full one, frame by frame.
fn same_as_full<R: Number, const V: usize, const S: usize, M: Model>(
    setup: &Setup,
    evolution: Evolution,
) {
    let ([x, y], theta) = (setup.grip(), setup.start[2]);
    let l = setup.size();
    let keyframes = [
        [0.0, 0.0, 0.0],
        [0.1, -0.2, 0.1],
        [1.2, -0.2, 0.7],
        [0.1, -0.1, -0.9],
        [0.0, 0.8, 0.0],
        [-0.4, -0.3, 0.2],
    ]
    .map(|[dx, dy, turn]| [x + dx * l, y + dy * l, theta + turn]);
    let small: Scene<R, V, S, M> = setup.scene_of().expect("the scene fits the model");
    let full = setup.scene::<R>().expect("the scene is sound");
    let (small, full) = (Solver::new(small, evolution), Solver::new(full, evolution));
    let hands = polyline(&keyframes, 50).into_iter().map(planar::<R>);
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

fn every_model<R: Number>(evolution: Evolution) {
    let tool = || Setup::point().held_at([0.0, 0.3]).springs(1.0, 0.2);
    let block = || Setup::block(0.8, 0.6).held_at([0.1, 0.4]).springs(1.0, 0.3);
    let (rough, smooth) = ([0.5, 0.3], [0.0, 0.0]);
    same_as_full::<R, 1, 1, Bare>(&tool().floor(smooth), evolution);
    same_as_full::<R, 1, 1, Frictionless>(&tool().weighing(0.1).floor(smooth), evolution);
    same_as_full::<R, 1, 1, Weightless>(&tool().floor(rough), evolution);
    same_as_full::<R, 1, 2, Bare>(&tool().floor(smooth).wall(0.6, smooth), evolution);
    same_as_full::<R, 1, 2, Full>(
        &tool().weighing(0.1).floor(rough).wall(0.6, rough),
        evolution,
    );
    same_as_full::<R, 4, 1, Bare>(&block().floor(smooth), evolution);
    same_as_full::<R, 4, 1, Full>(&block().weighing(0.2).floor(rough), evolution);
    same_as_full::<R, 4, 2, Weightless>(&block().floor(rough).wall(0.9, rough), evolution);
    same_as_full::<R, 4, 2, Frictionless>(
        &block().weighing(0.2).floor(smooth).wall(0.9, smooth),
        evolution,
    );
}

#[test]
fn smaller_model_gives_the_same_bits() {
    for evolution in EVOLUTIONS {
        every_model::<f64>(evolution);
        every_model::<f32>(evolution);
        every_model::<Fixed>(evolution);
    }
}

#[test]
fn what_a_model_lacks_is_refused() {
    let block = Setup::block(0.8, 0.6);
    let rough = block.clone().floor([0.5, 0.3]);
    let error = rough
        .scene_of::<f32, 4, 1, Frictionless>()
        .expect_err("friction");
    assert_eq!(error.parameter, Parameter::FrictionStatic(0));
    assert!(
        error.to_string().contains("0 in a model without friction"),
        "{error}"
    );
    let heavy = block.clone().weighing(2.0).floor([0.5, 0.3]);
    let error = heavy
        .scene_of::<f32, 4, 1, Weightless>()
        .expect_err("weight");
    assert_eq!(error.parameter, Parameter::Weight);
    assert!(
        error.to_string().contains("0 in a model without weight"),
        "{error}"
    );
    let error = rough.scene_of::<f32, 3, 1, Full>().expect_err("vertices");
    assert_eq!(error.parameter, Parameter::VertexCount);
    let error = rough
        .floor([0.5, 0.3])
        .scene_of::<f32, 4, 1, Full>()
        .expect_err("surfaces");
    assert_eq!(error.parameter, Parameter::SurfaceCount);
}
