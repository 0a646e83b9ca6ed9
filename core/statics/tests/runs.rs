//! Whole runs with known answers: closed forms of stick, slip, slide, fold, edge and pair; nothing creeps; pieces give the bits of the
//! whole.

use stiction_core::{Description, Event, Fixed, Hand, Real, StateKind, Status, SurfaceDescription};
use stiction_statics::{Output, Solver, State};

type F64 = Solver<f64, 4, 3, 0>;

/// The floor, a vertical wall on the right at x, a vertical wall on the left at x = 0.
fn floor(mu: [f64; 2]) -> SurfaceDescription<f64> {
    side([0.0, 1.0], 0.0, mu)
}
fn side(normal: [f64; 2], offset: f64, [fixed, sliding]: [f64; 2]) -> SurfaceDescription<f64> {
    SurfaceDescription {
        normal,
        offset,
        friction_static: fixed,
        friction_dynamic: sliding,
        memory: Some(0.0),
    }
}

/// The triangle (0, 0), (.5, 2), (-.5, 2), held at (0, 1).
const TRIANGLE: [[f64; 2]; 3] = [[0.0, 0.0], [0.5, 2.0], [-0.5, 2.0]];
/// A block, its origin at the middle of its bottom side.
fn block(width: f64, height: f64) -> [[f64; 2]; 4] {
    let half = width / 2.0;
    [[-half, 0.0], [half, 0.0], [half, height], [-half, height]]
}

struct Scene<'a> {
    vertices: &'a [[f64; 2]],
    held: [f64; 2],
    springs: [f64; 2],
    weight: f64,
    start: [f64; 3],
    surfaces: &'a [SurfaceDescription<f64>],
}

struct Run {
    solver: F64,
    state: State<f64>,
    output: Output<f64>,
    hand: [f64; 3],
}

impl Run {
    fn new(scene: &Scene<'_>, hand: [f64; 3]) -> Self {
        let solver = F64::new(&Description {
            vertices: scene.vertices,
            start: scene.start,
            weight: scene.weight,
            holding_point: Some(scene.held),
            reach: 0.0,
            stiffness_translation: scene.springs[0],
            stiffness_rotation: scene.springs[1],
            surfaces: scene.surfaces,
            obstacles: &[],
        })
        .expect("a scene");
        let (state, output) = solver.start(planar(hand));
        Self {
            solver,
            state,
            output,
            hand,
        }
    }
    fn to(&mut self, hand: [f64; 3]) -> &Output<f64> {
        self.output = self.solver.step(&mut self.state, planar(hand));
        self.hand = hand;
        &self.output
    }
    /// In so many frames; the slips on the way.
    fn lead(&mut self, hand: [f64; 3], frames: u32) -> u32 {
        let from = self.hand;
        let mut slips = 0;
        for k in 1..=frames {
            let part = f64::from(k) / f64::from(frames);
            let at = [0, 1, 2].map(|i| from[i] + (hand[i] - from[i]) * part);
            slips += self.to(at).slips;
        }
        slips
    }
    /// N and T of a contact.
    fn reaction(&self, contact: usize) -> [f64; 2] {
        let contacts = self.solver.contacts(&self.state);
        [contacts[contact].normal, contacts[contact].friction]
    }
    fn angle(&self) -> f64 {
        self.output.angle.radians()
    }
}
fn planar([x, y, phi]: [f64; 3]) -> Hand<f64> {
    Hand::new(x, y, phi)
}
#[track_caller]
fn near(is: f64, should: f64) {
    assert!((is - should).abs() <= 1e-9, "{is} and not {should}");
}

#[test]
fn a_block_on_the_floor_slips_forty_eight_times() {
    let scene = Scene {
        vertices: &block(2.0, 1.0),
        held: [0.0, 0.5],
        springs: [1.0, 1.0],
        weight: 0.0,
        start: [0.0, 0.3, 0.0],
        surfaces: &[floor([0.5, 0.3])],
    };
    let mut run = Run::new(&scene, [0.0, 0.8, 0.0]);
    run.lead([0.0, 0.3, 0.0], 10);
    assert_eq!(run.output.state, StateKind::Edge);
    assert_eq!(run.to([0.1 - 1e-6, 0.3, 0.0]).slips, 0);
    assert_eq!(run.to([0.1 + 1e-6, 0.3, 0.0]).slips, 1);
    near(run.output.position[0], 0.04);
    near(run.output.longest_slip, 0.04);
    assert_eq!(run.lead([2.0, 0.3, 0.0], 100), 47);
    near(run.output.position[0], 1.92);
}

#[test]
fn a_weighted_block_slips_eight_times_to_the_left() {
    let scene = Scene {
        vertices: &block(2.0, 1.0),
        held: [0.0, 0.5],
        springs: [200.0, 5.0],
        weight: 3.0,
        start: [0.0, 0.3, 0.0],
        surfaces: &[floor([0.8, 0.35])],
    };
    let mut run = Run::new(&scene, [0.0, 0.8, 0.0]);
    run.lead([0.0, 0.49, 0.0], 10);
    assert_eq!(run.lead([-0.1, 0.49, 0.0], 10), 8);
    near(run.output.position[0], -0.09);
}

#[test]
fn a_pinned_triangle_turns_to_its_balance() {
    let cases = [
        (0.5, 0.413829085628, 0.11558779394, 0.197881868616),
        (0.99, 0.470458503603, 0.0913605444938, 0.146704974967),
        (5.0, 0.586224831198, 0.0330351096529, 0.0467798755599),
        (50.0, 0.636765743008, 0.00402304292379, 0.00540186138236),
    ];
    for (kappa, theta, normal, friction) in cases {
        let scene = Scene {
            vertices: &TRIANGLE,
            held: [0.0, 1.0],
            springs: [1.0, 1.0 / kappa],
            weight: 0.0,
            start: [0.0, 0.0, 0.3],
            surfaces: &[floor([50.0, 50.0])],
        };
        let run = Run::new(&scene, [-0.6, 0.8, 0.3]);
        near(run.angle(), theta);
        let [n, t] = run.reaction(0);
        near(n, normal);
        near(t, friction);
    }
}

#[test]
fn a_pinned_triangle_snaps_where_its_balance_folds() {
    let cases = [
        (1.2, 0.1, 1.23164469549, -0.0776394146139, -1.19302715562),
        (1.05, 0.02, 0.681264770302, -0.01031157213, -0.622724540491),
    ];
    for (kappa, phi, theta, fold, jump) in cases {
        let scene = Scene {
            vertices: &TRIANGLE,
            held: [0.0, 1.0],
            springs: [1.0, 1.0 / kappa],
            weight: 0.0,
            start: [0.0, 0.0, theta],
            surfaces: &[floor([0.95, 0.95])],
        };
        let mut run = Run::new(&scene, [0.0, -1.0, phi]);
        near(run.angle(), theta);
        run.lead([0.0, -1.0, fold + 1e-9], 7);
        assert!(run.angle() > 0.0 && run.output.events().is_empty());
        let output = run.to([0.0, -1.0, fold - 1e-9]);
        assert!(output.events().contains(&Event::Snap));
        assert!((run.angle() - jump).abs() < 1e-8, "{}", run.angle());
    }
}

#[test]
fn a_triangle_slips_once() {
    let cases = [
        (
            [0.6, 0.3],
            0.5,
            0.6,
            0.665709348072,
            0.158969736777,
            -0.426407124356,
        ),
        (
            [0.4, 0.1],
            5.0,
            0.9,
            0.0481468100788,
            0.0361062510487,
            -0.00204076868341,
        ),
        (
            [1.5, 0.5],
            0.05,
            0.3,
            1.00275420433,
            0.0404688113105,
            -1.20859932215,
        ),
    ];
    for (mu, stiffness, h, trigger, slip, theta) in cases {
        let scene = Scene {
            vertices: &TRIANGLE,
            held: [0.0, 1.0],
            springs: [1.0, stiffness],
            weight: 0.0,
            start: [0.0, 0.5, 0.0],
            surfaces: &[floor(mu)],
        };
        let mut run = Run::new(&scene, [0.0, 1.5, 0.0]);
        run.lead([0.0, h, 0.0], 5);
        assert_eq!(run.lead([trigger - 1e-9, h, 0.0], 5), 0);
        assert_eq!(run.to([trigger + 1e-9, h, 0.0]).slips, 1);
        assert!((run.output.longest_slip - slip).abs() < 1e-8);
        assert!((run.angle() - theta).abs() < 1e-8);
    }
}

#[test]
fn a_low_block_slides_and_a_high_one_tips() {
    let run = |mu: f64, x: f64| {
        let mut run = Run::new(
            &Scene {
                vertices: &block(1.0, 1.6),
                held: [0.0, 0.8],
                springs: [1.0, 1.0],
                weight: 0.0,
                start: [0.0, 0.0, 0.0],
                surfaces: &[floor([mu, 0.4])],
            },
            [0.0, 0.6, 0.0],
        );
        run.lead([x, 0.6, 0.0], 3);
        run
    };
    let slid = run(0.6, 0.13);
    assert_eq!(slid.output.state, StateKind::Edge);
    near(slid.output.position[0], 0.04);
    let tipped = run(0.65, 0.1251);
    assert_eq!(tipped.output.state, StateKind::SingleVertex);
    near(tipped.angle(), -4.79774505504e-05);
}

#[test]
fn a_wall_locks_a_block_and_lets_it_go() {
    let scene = Scene {
        vertices: &block(2.0, 1.0),
        held: [0.0, 0.5],
        springs: [1.0, 1.0],
        weight: 0.0,
        start: [0.0, 0.0, 0.0],
        surfaces: &[floor([0.5, 0.3]), side([-1.0, 0.0], -1.5, [0.5, 0.3])],
    };
    let mut run = Run::new(&scene, [0.0, 0.3, 0.0]);
    run.lead([1.5, 0.3, 0.0], 20);
    near(run.output.position[0], 0.5);
    assert_eq!(run.output.state, StateKind::Locked);
    assert_eq!(run.lead([0.4 + 1e-9, 0.3, 0.0], 5), 0);
    assert_eq!(run.to([0.4 - 1e-8, 0.3, 0.0]).slips, 1);
    near(run.output.position[0], 0.46);
}

#[test]
fn a_vertex_without_friction_glides() {
    let scene = Scene {
        vertices: &TRIANGLE,
        held: [0.0, 1.0],
        springs: [1.0, 0.5],
        weight: 0.0,
        start: [0.0, 0.5, 0.3],
        surfaces: &[floor([0.0, 0.0])],
    };
    let mut run = Run::new(&scene, [0.0, 1.5, 0.3]);
    run.to([0.0, 0.5, 0.3]);
    run.lead([0.7, 0.5, 0.5], 9);
    near(run.angle(), 0.789770235333);
    near(run.output.position[0], 1.41019153488);
    let [n, _] = run.reaction(0);
    near(n, 0.204008511155);
}

#[test]
fn a_ladder_slips_to_its_next_balance() {
    // Against the wall x = 0, its foot on the floor; a third vertex makes it a body.
    let (sin, cos) = 1.0_f64.sin_cos();
    let scene = Scene {
        vertices: &[[0.0, 0.0], [2.0, 0.0], [1.0, 0.1]],
        held: [1.0, 0.0],
        springs: [1.0, 4.0],
        weight: 0.0,
        start: [-2.0 * cos, 0.0, 1.0],
        surfaces: &[floor([0.4, 0.2]), side([-1.0, 0.0], 0.0, [0.4, 0.2])],
    };
    let mut run = Run::new(&scene, [-cos, sin - 2.0, 1.9054642884]);
    // At first the moment holds the rod off the wall.
    let trigger = 0.905464288398;
    assert_eq!(run.lead([-cos, sin - 2.0, trigger + 1e-9], 20), 0);
    assert_eq!(run.output.state, StateKind::TwoVertex);
    assert_eq!(run.to([-cos, sin - 2.0, trigger - 1e-9]).slips, 1);
    assert!((run.angle() - 0.761291830571).abs() < 1e-8);
}

/// A hand that wanders above and into a corner.
fn wander(k: u32) -> [f64; 3] {
    let t = f64::from(k) * 0.01;
    [
        0.9 * (1.3 * t).sin() + 0.4 * (3.1 * t).sin(),
        0.35 + 0.45 * (0.9 * t).cos() + 0.2 * (4.3 * t).sin(),
        0.6 * (0.7 * t).sin(),
    ]
}
fn corner() -> [SurfaceDescription<f64>; 2] {
    [floor([0.5, 0.3]), side([-1.0, 0.0], -1.0, [0.4, 0.2])]
}

/// A run in whole frames and in single pieces of work, and with hands that rest.
fn pieces_and_rest<R: Real>(si: impl Fn(f64) -> R::Si, wide: impl Fn(R::Si) -> f64) {
    let vertices = block(0.8, 0.5).map(|v| v.map(&si));
    let surfaces = corner().map(|s| SurfaceDescription {
        normal: s.normal.map(&si),
        offset: si(s.offset),
        friction_static: si(s.friction_static),
        friction_dynamic: si(s.friction_dynamic),
        memory: None,
    });
    let solver = Solver::<R, 4, 2, 0>::new(&Description {
        vertices: &vertices,
        start: [0.0, 0.9, 0.0].map(&si),
        weight: si(0.3),
        holding_point: Some([0.05, 0.2].map(&si)),
        reach: si(0.0),
        stiffness_translation: si(2.0),
        stiffness_rotation: si(0.1),
        surfaces: &surfaces,
        obstacles: &[],
    })
    .expect("a scene");
    let hand = |k: u32| {
        let [x, y, phi] = wander(k).map(&si);
        Hand::new(x, y, phi)
    };
    let (mut whole, _) = solver.start(hand(0));
    let (mut pieces, _) = solver.start(hand(0));
    let mut kinds = [false; 6];
    for k in 1..1200 {
        let all = solver.step(&mut whole, hand(k));
        let one = loop {
            let output = solver.step_until(&mut pieces, hand(k), || false);
            if output.status != Status::Behind {
                break output;
            }
        };
        assert_eq!(
            (all.position, all.angle, all.state),
            (one.position, one.angle, one.state)
        );
        assert!(
            all.status <= Status::EventLimit,
            "{:?} in frame {k}",
            all.status
        );
        let again = solver.step(&mut whole, hand(k));
        assert_eq!(
            (again.position, again.angle, again.slips),
            (all.position, all.angle, 0)
        );
        let kind = StateKind::ALL.iter().position(|kind| *kind == all.state);
        kinds[kind.unwrap_or(0)] = true;
        // Nothing penetrates.
        for c in solver.contacts(&whole).iter() {
            assert!(wide(c.normal) >= 0.0 && c.normal.is_finite());
        }
    }
    let seen = kinds.iter().filter(|&&seen| seen).count();
    assert!(seen >= 4, "{kinds:?}");
}

#[test]
fn pieces_give_the_bits_of_the_whole_and_a_hand_at_rest_moves_nothing() {
    pieces_and_rest::<f64>(|x| x, |x| x);
    pieces_and_rest::<f32>(|x| x as f32, f64::from);
    pieces_and_rest::<Fixed>(|x| x as f32, f64::from);
}

#[test]
fn a_hand_that_comes_back_leaves_no_creep() {
    let scene = Scene {
        vertices: &block(0.8, 0.5),
        held: [0.05, 0.2],
        springs: [2.0, 0.1],
        weight: 0.3,
        start: [0.0, 0.0, 0.0],
        surfaces: &[floor([0.5, 0.3])],
    };
    let mut run = Run::new(&scene, [0.0, 0.1, 0.0]);
    run.to([0.03, 0.1, 0.0]);
    let place = run.output.position;
    for _ in 0..1000 {
        run.to([0.03, 0.1, 0.01]);
        run.to([0.02, 0.09, 0.0]);
        run.to([0.03, 0.1, 0.0]);
    }
    assert_eq!(run.output.position, place);
}

#[test]
fn whole_turns_keep_their_digits() {
    let scene = Scene {
        vertices: &TRIANGLE,
        held: [0.0, 1.0],
        springs: [1.0, 1.0],
        weight: 0.0,
        start: [0.0, 5.0, 0.0],
        surfaces: &[floor([0.5, 0.3])],
    };
    let mut run = Run::new(&scene, [0.0, 6.0, 0.0]);
    for turn in 1..=50 {
        let hand = planar([0.0, 6.0, 0.1]).turned(turn);
        run.output = run.solver.step(&mut run.state, hand);
        assert_eq!(run.output.angle.turns, turn);
        near(run.output.angle.rest, 0.1);
    }
}

#[test]
fn a_hand_that_cannot_be_used_leaves_the_body() {
    let scene = Scene {
        vertices: &TRIANGLE,
        held: [0.0, 1.0],
        springs: [1.0, 1.0],
        weight: 0.0,
        start: [0.0, 0.5, 0.0],
        surfaces: &[floor([0.5, 0.3])],
    };
    let mut run = Run::new(&scene, [0.0, 1.4, 0.0]);
    let place = run.output.position;
    assert_eq!(run.to([f64::NAN, 1.0, 0.0]).status, Status::HeldLast);
    assert_eq!(run.to([1e15, 1.0, 0.0]).status, Status::Saturated);
    assert_eq!(run.output.position, place);
    assert_eq!(run.to([0.0, 1.4, 0.0]).status, Status::Ok);
}

/// By differences of steps, wherever nothing happens.
#[test]
fn the_tangent_is_that_of_small_steps() {
    let scene = Scene {
        vertices: &block(0.8, 0.5),
        held: [0.05, 0.2],
        springs: [2.0, 0.1],
        weight: 0.3,
        start: [0.0, 0.9, 0.0],
        surfaces: &corner(),
    };
    let mut run = Run::new(&scene, wander(0));
    let mut compared = 0;
    for k in 1..1200 {
        run.to(wander(k));
        let Some(tangent) = run.solver.tangent(&run.state) else {
            continue;
        };
        if k % 7 != 0 || !run.output.events().is_empty() {
            continue;
        }
        let step = 1e-6;
        for column in 0..3 {
            let stepped = |sign: f64| {
                let mut state = run.state.clone();
                let mut hand = run.hand;
                hand[column] += sign * step;
                let output = run.solver.step(&mut state, planar(hand));
                let wrench = run.solver.wrench(&state);
                let same = output.events().is_empty() && output.state == run.output.state;
                same.then_some((output.angle.radians(), wrench.feedback().force[1]))
            };
            if let (Some(after), Some(before)) = (stepped(1.0), stepped(-1.0)) {
                let turn = (after.0 - before.0) / (2.0 * step);
                let felt = (after.1 - before.1) / (2.0 * step);
                assert!(
                    (turn - tangent.compliance[2][column]).abs() < 1e-4,
                    "{k} {column}"
                );
                assert!(
                    (felt - tangent.stiffness[1][column]).abs() < 1e-4,
                    "{k} {column}"
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 150, "{compared}");
}
