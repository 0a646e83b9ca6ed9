//! A scene with its parameters and a hand's path, decoded from bytes.

use crate::draw::Draw;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use stiction_core::Evolution;
use stiction_tests::Setup;

/// The largest number of frames.
const FRAMES: usize = 400;

/// The case that is run.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) setup: Setup,
    pub(crate) evolution: Evolution,
    /// Whether its steps are also repeated within budgets.
    pub(crate) is_cut: bool,
    /// x, y (m), phi (rad) of the hand at the start, and whether it holds the body.
    pub(crate) home: ([f64; 3], bool),
    moves: Vec<Move>,
}

/// A straight leg of the hand, in equal frames.
#[derive(Clone, Copy, Debug)]
struct Move {
    to: [f64; 3],
    held: bool,
    frames: u8,
}

impl Case {
    /// `None` if there are too few bytes for a case.
    pub(crate) fn read(mut draw: Draw<'_>) -> Option<Self> {
        let evolution = draw.one_of([Evolution::Path, Evolution::Frame]);
        let (memory, is_cut) = dials(&mut draw);
        let mut setup = scene(&mut draw);
        if draw.is_empty() {
            return None;
        }
        let ([x, y], theta, l) = (setup.grip(), setup.start[2], setup.size());
        for surface in &mut setup.surfaces {
            surface.memory = memory.map(|length| length * l);
        }
        let home = [x, y, theta];
        // A body that is not quite on a surface is first set onto it, and grasped only then.
        let home = match draw.one_of([0, 0, 1, 2]) {
            _ if setup.holding_point.is_none() => (home, false),
            0 => (home, true),
            1 => (moved(&mut draw, home, l), true),
            _ => (home, false),
        };
        let (mut moves, mut from) = (Vec::new(), home.0);
        while !draw.is_empty() && moves.len() < FRAMES {
            let next = Move::read(&mut draw, from, l);
            if next.to.iter().all(|x| x.is_finite()) {
                from = next.to;
            }
            moves.push(next);
        }
        Some(Self {
            setup,
            evolution,
            is_cut,
            home,
            moves,
        })
    }

    /// The hand of every frame after the first, and whether it holds the body.
    pub(crate) fn hands(&self) -> impl Iterator<Item = ([f64; 3], bool)> + '_ {
        let mut from = self.home.0;
        let legs = self.moves.iter().flat_map(move |leg| {
            let begin = from;
            if leg.to.iter().all(|x| x.is_finite()) {
                from = leg.to;
            }
            (1..=leg.frames).map(move |i| (leg.at(begin, i), leg.held))
        });
        legs.take(FRAMES)
    }
}

impl Case {
    /// The case as a scene file, a recorded path and options.
    pub(crate) fn as_files(&self) -> (String, String, String) {
        let setup = &self.setup;
        let mut scene = format!(
            "[body]\nvertices = {:?}\nstart = {:?}\nweight = {:?}\n\n[grasp]\nreach = {:?}\n",
            setup.vertices, setup.start, setup.weight, setup.reach
        );
        if let Some(point) = setup.holding_point {
            scene += &format!("point = {point:?}\n");
        }
        scene += &format!(
            "\n[spring]\ntranslation = {:?}\nrotation = {:?}\n",
            setup.stiffness_translation, setup.stiffness_rotation
        );
        for s in &setup.surfaces {
            scene += &format!(
                "\n[[surface]]\nnormal = {:?}\noffset = {:?}\nstatic = {:?}\ndynamic = {:?}\n",
                s.normal, s.offset, s.friction_static, s.friction_dynamic
            );
            if let Some(memory) = s.memory {
                scene += &format!("memory = {memory:?}\n");
            }
        }
        let mut hand = "t,x,y,phi,held\n".to_owned();
        let hands = std::iter::once(self.home).chain(self.hands());
        for (i, ([x, y, phi], held)) in hands.enumerate() {
            let (t, held) = (i as f64 / 1000.0, u8::from(held));
            hand += &format!("{t:?},{x:?},{y:?},{phi:?},{held}\n");
        }
        let evolution = self.evolution.name();
        let options = format!("--evolution {evolution}");
        (scene, hand, options)
    }
}

impl Move {
    fn read(draw: &mut Draw<'_>, from: [f64; 3], l: f64) -> Self {
        let kind = draw.byte();
        let frames = 1 + (kind & 15);
        let held = kind >> 4 != 15;
        let to = match kind >> 4 {
            0..=12 => moved(draw, from, l),
            13 => {
                let far = draw.power(0.0, 4.0);
                moved(draw, from, far * l)
            }
            14 => [f64::NAN, from[1], from[2]],
            _ => from,
        };
        Self { to, held, frames }
    }

    fn at(&self, from: [f64; 3], i: u8) -> [f64; 3] {
        let part = f64::from(i) / f64::from(self.frames);
        std::array::from_fn(|k| from[k] + (self.to[k] - from[k]) * part)
    }
}

fn moved(draw: &mut Draw<'_>, [x, y, phi]: [f64; 3], l: f64) -> [f64; 3] {
    let far = if draw.flag() { l } else { 0.1 * l };
    let [dx, dy] = [draw.place(), draw.place()];
    let turn = if draw.flag() { draw.angle() } else { 0.0 };
    [x + far * dx, y + far * dy, phi + turn]
}

/// Memory length of all surfaces, in body sizes, mostly the solver's default; and whether steps are also cut by budgets.
fn dials(draw: &mut Draw<'_>) -> (Option<f64>, bool) {
    match draw.byte() {
        0..200 => (None, false),
        200..225 => (Some(draw.power(-6.0, -2.0)), true),
        // Inputs from before this option existed have another byte here.
        _ => (None, draw.byte() < u8::MAX),
    }
}

fn scene(draw: &mut Draw<'_>) -> Setup {
    let size = draw.one_of([1.0, 0.1, 10.0, 0.01]);
    let vertices = body(draw)
        .map(|[x, y]| [size * x, size * y])
        .collect::<Vec<_>>();
    let body = Setup::new(&vertices);
    let (l, k) = (body.size(), draw.one_of([1.0, 500.0, 10.0, 1e4]));
    let theta = draw.angle();
    let mut setup = body.at([0.0, 0.0, theta]);
    let rotation = if draw.byte() >= 240 {
        0.0
    } else {
        k * l * l * draw.power(-3.0, 1.0)
    };
    setup = setup.springs(k, rotation);
    let weight = if draw.flag() {
        k * l * draw.part()
    } else {
        0.0
    };
    setup = setup.weighing(weight);
    setup.reach = 10.0 * l;
    setup.holding_point = (draw.byte() < 224).then(|| [draw.place(), draw.place()].map(|x| x * l));
    let corners: Vec<_> = vertices
        .iter()
        .map(|&v| setup.world(setup.start, v))
        .collect();
    for i in 0..draw.one_of([1, 2, 3, 1, 2, 4, 1, 0]) {
        let turn = if draw.flag() {
            draw.angle()
        } else {
            f64::from(i) * FRAC_PI_2
        };
        let (sin, cos) = (FRAC_PI_2 + turn).sin_cos();
        let heights = corners.iter().map(|c| cos * c[0] + sin * c[1]);
        let clearance = if draw.flag() { l * draw.part() } else { 0.0 };
        let offset = heights.fold(f64::INFINITY, f64::min) - clearance;
        setup = setup.surface([cos, sin], offset, friction(draw));
    }
    setup
}

/// mu_s and mu_d.
pub(crate) fn friction(draw: &mut Draw<'_>) -> [f64; 2] {
    let stick = match draw.byte() {
        0..192 => 0.1 + 1.4 * draw.part(),
        192..232 => draw.power(-3.0, 1.5),
        _ => 0.0,
    };
    let ratio = draw.one_of([0.6, 0.3, 0.9, 0.99, 1.0, 0.0]);
    [stick, ratio * stick]
}

/// Vertices within a unit circle, counter-clockwise.
fn body(draw: &mut Draw<'_>) -> impl Iterator<Item = [f64; 2]> + use<> {
    let kind = draw.byte() % 8;
    let (ratio, count) = match kind {
        0 => (1.0, 1),
        1 => (1.0, 2),
        2 | 3 => (0.05 + draw.part(), 4),
        4 => (0.05 + draw.part(), 3),
        5 => (1.0, 3 + draw.byte() % 10),
        _ => (0.05 + draw.part(), 2 + draw.byte() % 7),
    };
    let is_free = kind > 5;
    let begin = if kind == 3 { PI / 4.0 } else { 0.0 };
    let jitter: Vec<f64> = (0..count)
        .map(|_| if is_free { 0.4 * draw.place() } else { 0.0 })
        .collect();
    let corner = move |(i, jitter): (usize, f64)| {
        let angle = begin + TAU * (i as f64 + jitter) / f64::from(count);
        [0.5 * angle.cos(), 0.5 * ratio * angle.sin()]
    };
    jitter.into_iter().enumerate().map(corner)
}
