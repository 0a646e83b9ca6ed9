//! A smaller model is the same solver with parts left out: if a scene does not need them, the model returns the same bits as the full one;
//! on a single surface without friction, where contacts glide instead of sliding, the answers agree to within the number type's error. If a
//! scene needs the missing parts, it is refused. Every model takes time to compile, so f32 stands for all number types where the parts
//! are concerned: they are left out of code that knows no number type.

use stiction_core::{
    Bare, Evolution, Fixed, Frictionless, Full, Model, Parameter, Scene, Solver, Weightless,
};
use stiction_tests::laws::assert_lawful;
use stiction_tests::run::{planar, polyline};
use stiction_tests::setup::VERTICES;
use stiction_tests::{Number, Run, RunOf, Setup, close};

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

/// Runs a hand path in a model with its own capacity and, along the exact path in f64, in the full one: every frame obeys
/// the laws and has the state and the pose of the full model.
fn near_full<R: Number, const V: usize, const S: usize, const C: usize>(
    setup: &Setup,
    evolution: Evolution,
) {
    let begin = keyframes(setup)[0];
    let mut small = RunOf::<R, V, S, M>::start(setup, evolution, begin);
    let mut full = Run::<f64>::start(setup, Evolution::Path, begin);
    // The stiffness of the grip is at least a tenth of k_h L², and the coordinates are of order 1.
    let bound = 64.0 * R::ROUNDING;
    for hand in polyline(&keyframes(setup), 50) {
        let frame = small.step(hand);
        assert_lawful::<R>(setup, std::slice::from_ref(frame));
        let exact = full.step(hand);
        assert_eq!(frame.state, exact.state, "{} {frame:?} {exact:?}", R::NAME);
        for (given, exact) in frame.pose.iter().zip(exact.pose) {
            close(R::NAME, *given, exact, bound);
        }
    }
}

/// Runs a hand path in a model with its own capacity and in the full one, frame by frame.
fn same_as_full<R: Number, const V: usize, const S: usize, const C: usize>(
    setup: &Setup,
    evolution: Evolution,
) {
    let keyframes = keyframes(setup);
    let small: Scene<R, V, S, C> = setup.scene_of().expect("the scene fits the model");
    let full = setup.scene::<R>().expect("the scene is sound");
    let (small, full) = (Solver::new(small, evolution), Solver::new(full, evolution));
    let hands = polyline(&keyframes, 50).into_iter().map(planar::<R>);
    let mut runs = None;
    for hand in hands {
        let mut outputs = match &mut runs {
            None => {
                let ((s, first), (f, second)) = (small.start(hand), full.start(hand));
                runs = Some((s, f));
                (first, second)
            }
            Some((s, f)) => (small.step(s, hand), full.step(f, hand)),
        };
        // The larger model has more cases to check.
        outputs.1.work = outputs.0.work;
        assert_eq!(outputs.0, outputs.1, "{} {evolution:?}: {setup:?}", R::NAME);
        if let Some((s, f)) = &runs {
            assert_eq!(small.wrench(s), full.wrench(f));
            assert_eq!(small.contacts(s), full.contacts(f));
        }
    }
}

const ROUGH: [f64; 2] = [0.5, 0.3];
const SMOOTH: [f64; 2] = [0.0, 0.0];

/// A block between two surfaces without friction.
fn model_without_friction<R: Number>(evolution: Evolution) {
    let block = block().weighing(0.2).floor(SMOOTH).wall(0.9, SMOOTH);
    same_as_full::<R, 4, 2, Frictionless>(&block, evolution);
}

/// With friction or with a second surface, a smaller model takes the same steps.
fn every_model_that_slides(evolution: Evolution) {
    let (tool, block) = (tool(), block());
    let (rough, smooth) = (ROUGH, SMOOTH);
    same_as_full::<f32, 1, 1, Weightless>(&tool.clone().floor(rough), evolution);
    same_as_full::<f32, 1, 2, Bare>(&tool.clone().floor(smooth).wall(0.6, smooth), evolution);
    same_as_full::<f32, 1, 2, Full>(&tool.weighing(0.1).floor(rough).wall(0.6, rough), evolution);
    same_as_full::<f32, 4, 1, Full>(&block.clone().weighing(0.2).floor(rough), evolution);
    same_as_full::<f32, 4, 2, Weightless>(&block.floor(rough).wall(0.9, rough), evolution);
}

/// On a single surface without friction, contacts glide: the answers are the same if the balance is unique, reached in
/// other steps.
fn every_model_that_glides(evolution: Evolution) {
    let (tool, block) = (tool(), block());
    near_full::<f32, 1, 1, Frictionless>(&tool.weighing(0.1).floor(SMOOTH), evolution);
    near_full::<f32, 4, 1, Bare>(&block.floor(SMOOTH), evolution);
}

/// A point without weight, and a block with weight.
fn models_that_glide<R: Number>(evolution: Evolution) {
    near_full::<R, 1, 1, Bare>(&tool().floor(SMOOTH), evolution);
    let block = block().weighing(0.2).floor(SMOOTH);
    near_full::<R, VERTICES, 1, Frictionless>(&block, evolution);
}

#[test]
fn smaller_model_that_slides_gives_the_same_bits() {
    for evolution in Evolution::ALL {
        every_model_that_slides(evolution);
        model_without_friction::<f64>(evolution);
        model_without_friction::<f32>(evolution);
        model_without_friction::<Fixed>(evolution);
    }
}

#[test]
fn smaller_model_that_glides_gives_the_answers_of_the_full_one() {
    for evolution in Evolution::ALL {
        every_model_that_glides(evolution);
        models_that_glide::<f64>(evolution);
        models_that_glide::<f32>(evolution);
        models_that_glide::<Fixed>(evolution);
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
