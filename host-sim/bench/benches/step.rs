//! Mean time of one frame: the box 0.10 m × 0.06 m (k_h 500, k_theta 0.5, holding point (0, 0.02), mu 0.5 / 0.3), pressed
//! 10 mm deep and dragged by 0.1 m at 0.02 m/s, 1 kHz; on a vertex, flat, and on a vertex against a wall.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use stiction_core::{Description, Evolution, Hand, Real, Scene, Solver, SurfaceDescription};

const FRAMES: u16 = 5_000;
const VERTICES: [[f64; 2]; 4] = [[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]];
const HOLDING_POINT: [f64; 2] = [0.0, 0.02];
const DEPTH: f64 = 0.01;
const DRAG: f64 = 0.1;

#[derive(Clone, Copy)]
struct Setting {
    name: &'static str,
    tilt: f64,
    wall: bool,
}

const SETTINGS: [Setting; 3] = [
    Setting {
        name: "vertex",
        tilt: std::f64::consts::FRAC_PI_6,
        wall: false,
    },
    Setting {
        name: "flat",
        tilt: 0.0,
        wall: false,
    },
    Setting {
        name: "ladder",
        tilt: std::f64::consts::FRAC_PI_6,
        wall: true,
    },
];

/// A float of the solver's interface, converted from the f64 of the setting.
trait Narrow: Real<Si = Self> {
    const NAME: &'static str;
    fn narrow(x: f64) -> Self;
}

impl Narrow for f64 {
    const NAME: &'static str = "f64";
    fn narrow(x: f64) -> f64 {
        x
    }
}

impl Narrow for f32 {
    const NAME: &'static str = "f32";
    fn narrow(x: f64) -> f32 {
        x as f32
    }
}

fn turned([x, y]: [f64; 2], theta: f64) -> [f64; 2] {
    let (sin, cos) = theta.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// The half-plane normal·p >= offset with the friction of the bench.
fn half_plane<F: Narrow>(normal: [f64; 2], offset: f64) -> SurfaceDescription<F> {
    SurfaceDescription {
        normal: normal.map(F::narrow),
        offset: F::narrow(offset),
        friction_static: F::narrow(0.5),
        friction_dynamic: F::narrow(0.3),
        memory: None,
    }
}

/// The scene, with vertex 0 on the floor at the origin, and the hand's path.
fn scene<F: Narrow>(setting: Setting) -> (Scene<F, 4, 2>, Vec<Hand<F>>) {
    let Setting { tilt, wall, .. } = setting;
    let corners = VERTICES.map(|v| turned(v, tilt));
    let [x0, y0] = corners[0].map(|x| -x);
    let rightmost = corners.iter().map(|c| x0 + c[0]).fold(f64::MIN, f64::max);
    let floor = half_plane([0.0, 1.0], 0.0);
    let surfaces = [floor, half_plane([-1.0, 0.0], -rightmost)];
    let scene = Scene::new(&Description {
        vertices: &VERTICES.map(|v| v.map(F::narrow)),
        start: [x0, y0, tilt].map(F::narrow),
        weight: F::ZERO,
        holding_point: Some(HOLDING_POINT.map(F::narrow)),
        reach: F::ZERO,
        stiffness_translation: F::narrow(500.0),
        stiffness_rotation: F::narrow(0.5),
        surfaces: if wall { &surfaces } else { &surfaces[..1] },
    })
    .expect("the scene of the bench is sound");
    let [gx, gy] = turned(HOLDING_POINT, tilt);
    let hand = |i| {
        let along = DRAG * f64::from(i) / f64::from(FRAMES);
        Hand::new(
            F::narrow(x0 + gx + along),
            F::narrow(y0 + gy - DEPTH),
            F::narrow(tilt),
        )
    };
    (scene, (0..=FRAMES).map(hand).collect())
}

fn bench_one<F: Narrow>(criterion: &mut Criterion, setting: Setting, evolution: Evolution) {
    let (scene, path) = scene::<F>(setting);
    let solver = Solver::<F, 4, 2>::new(scene, evolution);
    let (pressed, _) = solver.start(path[0]);
    let (mut state, mut frame) = (pressed.clone(), 0);
    let mut group = criterion.benchmark_group(setting.name);
    group.throughput(Throughput::Elements(1));
    group
        .measurement_time(Duration::from_secs(3))
        .warm_up_time(Duration::from_secs(1));
    group.bench_function(
        BenchmarkId::new(F::NAME, format!("{evolution:?}")),
        |bencher| {
            bencher.iter(|| {
                frame += 1;
                if frame == path.len() {
                    (state, frame) = (pressed.clone(), 1);
                }
                solver.step(&mut state, path[frame])
            });
        },
    );
    group.finish();
}

fn steps(criterion: &mut Criterion) {
    for setting in SETTINGS {
        for evolution in [Evolution::Path, Evolution::Frame] {
            bench_one::<f32>(criterion, setting, evolution);
            bench_one::<f64>(criterion, setting, evolution);
        }
    }
}

criterion_group!(benches, steps);
criterion_main!(benches);
