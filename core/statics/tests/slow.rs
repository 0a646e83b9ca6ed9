//! Hands that move by little more than the rounding of their number type.

use stiction_core::{Description, Fixed, Hand, Real, StateKind, SurfaceDescription};
use stiction_statics::{Solver, State};

/// A ladder without stiction against the wall x = 0, its foot on the floor; `turns` the hand slowly and looks whether it slides on.
fn a_ladder_slides_on<R: Real>(si: impl Fn(f64) -> R::Si) {
    let (sin, cos) = 1.0_f64.sin_cos();
    let surfaces = [[0.0, 1.0], [-1.0, 0.0]].map(|normal| SurfaceDescription {
        normal: normal.map(&si),
        offset: si(0.0),
        friction_static: si(0.2),
        friction_dynamic: si(0.2),
        memory: None,
    });
    let vertices = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.1]].map(|v| v.map(&si));
    let solver = Solver::<R, 3, 2, 0>::new(&Description {
        vertices: &vertices,
        start: [-2.0 * cos, 0.0, 1.0].map(&si),
        weight: si(0.0),
        holding_point: Some([1.0, 0.0].map(&si)),
        reach: si(0.0),
        stiffness_translation: si(1.0),
        stiffness_rotation: si(4.0),
        surfaces: &surfaces,
    })
    .expect("a scene");
    let hand = |phi: f64| Hand::new(si(-cos), si(sin - 2.0), si(phi));
    let (mut state, _) = solver.start(hand(1.905));
    for k in 0..200 {
        solver.step(&mut state, hand(1.905 - 0.006 * f64::from(k)));
    }
    let slides = |state: &State<R>| {
        let contacts = solver.contacts(state);
        contacts.iter().filter(|c| c.sliding != 0).count()
    };
    let last = 1.905 - 0.006 * 199.0;
    assert_eq!(slides(&state), 2);
    for k in 1..50 {
        let output = solver.step(&mut state, hand(last - 4e-7 * f64::from(k)));
        assert_eq!(output.state, StateKind::TwoVertex);
        assert_eq!(slides(&state), 2, "in step {k}");
    }
}

#[test]
fn a_pair_slides_on_however_slowly_the_hand_moves() {
    a_ladder_slides_on::<f64>(|x| x);
    a_ladder_slides_on::<f32>(|x| x as f32);
    a_ladder_slides_on::<Fixed>(|x| x as f32);
}
