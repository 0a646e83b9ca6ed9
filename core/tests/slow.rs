//! Pairs of contacts that slide: with a hand that moves by little more than the rounding of its number type, and where a foot turns back.

use std::f64::consts::PI;
use stiction_core::{
    Description, Evolution, Fixed, Hand, Real, Scene, Solver, State, StateKind, Status,
    SurfaceDescription,
};

/// A rod of length 2 that leans from the floor y = 0 against a wall through the origin, both without stiction, held at its middle by springs
/// of 1 N/m and `turning` N·m/rad.
fn rod<R: Real>(
    wall: [f64; 2],
    start: [f64; 3],
    turning: f64,
    si: impl Fn(f64) -> R::Si,
) -> Solver<R, 3, 2> {
    let surfaces = [[0.0, 1.0], wall].map(|normal| SurfaceDescription {
        normal: normal.map(&si),
        offset: si(0.0),
        friction_static: si(0.2),
        friction_dynamic: si(0.2),
        memory: None,
    });
    let scene = Scene::new(&Description {
        vertices: &[[0.0, 0.0], [2.0, 0.0], [1.0, 0.1]].map(|v| v.map(&si)),
        start: start.map(&si),
        weight: si(0.0),
        holding_point: Some([1.0, 0.0].map(&si)),
        reach: si(0.0),
        stiffness_translation: si(1.0),
        stiffness_rotation: si(turning),
        surfaces: &surfaces,
        obstacles: &[],
    });
    Solver::new(scene.expect("a scene"), Evolution::Path)
}

/// A ladder without stiction against the wall x = 0, its foot on the floor; `turns` the hand slowly and looks whether it slides on.
fn a_ladder_slides_on<R: Real>(si: impl Fn(f64) -> R::Si) {
    let (sin, cos) = 1.0_f64.sin_cos();
    let solver = rod::<R>([-1.0, 0.0], [-2.0 * cos, 0.0, 1.0], 4.0, &si);
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

/// A rod in a wedge of 60 degrees, pulled towards its apex and turned: its foot goes back where the rod stands upright on the wall. It slides
/// on with the new friction; before and after each foot slides as its friction says.
fn a_foot_turns_back<R: Real>(si: impl Fn(f64) -> R::Si, wide: impl Fn(R::Si) -> f64) {
    let (sin, cos) = (PI / 3.0).sin_cos();
    let wall = [-sin, -cos];
    let begin = [-2.0 * (PI * 2.0 / 3.0 - 0.3).sin() / sin, 0.0, 0.3];
    let solver = rod::<R>(wall, begin, 16.0, &si);
    let hand = |phi: f64| Hand::new(si(0.3), si(-0.5), si(phi));
    let (mut state, _) = solver.start(hand(0.3));
    let mut signs = Vec::new();
    for k in 0..400 {
        let output = solver.step(&mut state, hand(0.3 + 0.002 * f64::from(k)));
        assert_eq!(output.status, Status::Ok, "in step {k}");
        let all = solver.contacts(&state);
        let (mut force, pull) = ([0.0; 2], solver.wrench(&state).force);
        for (c, [x, y]) in all.iter().zip([[0.0, 1.0], wall]) {
            let (n, t) = (wide(c.normal), wide(c.friction));
            force = [force[0] + n * x + t * y, force[1] + n * y - t * x];
        }
        let rest = [0, 1].map(|i| force[i] + wide(pull[i]));
        assert!(rest[0].hypot(rest[1]) < 1e-4, "{rest:?} in step {k}");
        let now: Vec<i8> = all.iter().map(|c| c.sliding).collect();
        if signs.last() != Some(&now) {
            signs.push(now);
        }
    }
    // Pushed down, it comes back: the foot goes out, then in.
    assert_eq!(signs, [[1, -1], [0, 0], [-1, 1], [1, 1]]);
}

#[test]
fn a_pair_slides_on_where_a_foot_turns_back() {
    a_foot_turns_back::<f64>(|x| x, |x| x);
    a_foot_turns_back::<f32>(|x| x as f32, f64::from);
    a_foot_turns_back::<Fixed>(|x| x as f32, f64::from);
}
