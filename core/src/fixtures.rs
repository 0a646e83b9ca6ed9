//! Shared by the tests of single functions: random numbers, loads about as large as what is representable, a pivot without a load, bodies
//! among planes, statics written out, and counters of searches.

use crate::contact::Pair;
use crate::detect::Placed;
use crate::geometry::{Angle, Orientation, Vec2};
use crate::load::Load;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::scene::{Description, Scene, SurfaceDescription};

pub(crate) mod bench;

/// Random numbers from a seed, the same in every run.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// The next number, in [-1, 1).
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
    /// A vector of two such numbers.
    pub(crate) fn vector(&mut self) -> Vec2<f64> {
        Vec2::new(self.next(), self.next())
    }
}

/// A number in a number type, to the digits of f32.
pub(crate) fn number<R: Real>(x: f64) -> R
where
    R::Si: From<f32>,
{
    R::from_si(R::Si::from(x as f32), R::Si::ONE)
}

/// All cases, or, in the slow interpreter, one in `of`.
pub(crate) fn sampled<I: Iterator>(all: I, of: usize) -> impl Iterator<Item = I::Item> {
    all.step_by(if cfg!(miri) { of } else { 1 })
}

/// A pull and a couple, as fractions of what a number type represents of both together: below it and above, each with either sign.
pub(crate) fn loads() -> impl Iterator<Item = (f64, f64)> {
    let sizes = [
        (0.4, 0.5),
        (0.9, 0.0),
        (0.0, 0.99),
        (0.7, 0.7),
        (1.1, 0.0),
        (0.0, 1.1),
    ];
    let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let all = move |(load, couple)| signs.map(|(x, y)| (load * x, couple * y));
    sizes.into_iter().flat_map(all)
}

/// A body about a point at the origin, with the springs of a hand that does not pull.
pub(crate) fn unloaded() -> Load<f64> {
    Load {
        placed: Placed {
            point: Vec2::ZERO,
            body_point: Vec2::ZERO,
            orientation: Orientation::new(Angle::default()),
            on: None,
        },
        lever: Vec2::ZERO,
        centroid: Vec2::ZERO,
        spring: Vec2::ZERO,
        turn: 0.0,
        couple: 0.0,
        hold: Vec2::ZERO,
        force: Vec2::ZERO,
        stiffness: 1.0,
    }
}

/// A body without weight on planes through the origin, with normals at some angles (rad) from the upright one; mu_s = 0.5,
/// mu_d = 0.3.
pub(crate) fn scene<const V: usize, const S: usize>(
    vertices: &[[f64; 2]],
    angles: &[f64; S],
) -> Scene<f64, V, S> {
    sprung(vertices, angles, 1.0)
}

/// A body on planes through the origin at these angles (rad), in a grip of this k_theta / (k_h L²).
pub(crate) fn sprung<const V: usize, const S: usize>(
    vertices: &[[f64; 2]],
    angles: &[f64; S],
    stiffness: f64,
) -> Scene<f64, V, S> {
    let surfaces = angles.map(|angle| {
        let (sin, cos) = libm::sincos(angle);
        SurfaceDescription {
            normal: [-sin, cos],
            offset: 0.0,
            friction_static: 0.5,
            friction_dynamic: 0.3,
            memory: None,
        }
    });
    // Far out along the mean of the normals it is inside no surface.
    let out = angles.map(libm::sincos);
    let out = out.iter().fold([0.0, 0.0], |[x, y], (sin, cos)| {
        [x - 9.0 * sin, y + 9.0 * cos]
    });
    let scene = Scene::new(&Description {
        vertices,
        start: [out[0], out[1], 0.0],
        weight: 0.0,
        holding_point: Some([0.0, 0.0]),
        reach: 0.0,
        stiffness_translation: 1.0,
        stiffness_rotation: stiffness,
        surfaces: &surfaces,
        obstacles: &[],
    });
    scene.expect("a sound scene")
}

/// Vertex 0 on the first surface at the foot 0, turned.
pub(crate) fn pivot(turn: f64) -> Pivot<f64> {
    Pivot {
        contact: Pair::default(),
        foot: 0.0,
        orientation: Orientation::new(Angle::from_radians(turn)),
    }
}

/// Counts the searches of a test. They can be made to give up after fewer steps than they have.
pub(crate) mod searches {
    extern crate std;

    use core::cell::Cell;

    #[derive(Clone, Copy, Debug, Default)]
    pub(crate) struct Counts {
        pub(crate) searches: usize,
        pub(crate) steps: usize,
        /// Searches that gave up.
        pub(crate) unsure: usize,
    }

    std::thread_local! {
        static MOST: Cell<usize> = const { Cell::new(usize::MAX) };
        static COUNTS: Cell<Counts> = const { Cell::new(Counts { searches: 0, steps: 0, unsure: 0 }) };
    }

    fn count(change: impl FnOnce(&mut Counts)) {
        let mut counts = COUNTS.get();
        change(&mut counts);
        COUNTS.set(counts);
    }

    /// The remaining steps of a search.
    pub(crate) struct Steps {
        left: usize,
    }

    /// Begins a search.
    pub(crate) fn begin() -> Steps {
        count(|c| c.searches += 1);
        Steps { left: MOST.get() }
    }

    impl Steps {
        pub(crate) fn goes_on(&mut self) -> bool {
            let goes_on = self.left > 0;
            if goes_on {
                self.left -= 1;
                count(|c| c.steps += 1);
            }
            goes_on
        }
        pub(crate) fn gives_up(&self) {
            count(|c| c.unsure += 1);
        }
    }

    /// Runs with searches that give up after the given number of steps.
    pub(crate) fn giving_up<T>(after: usize, run: impl FnOnce() -> T) -> (T, Counts) {
        COUNTS.set(Counts::default());
        MOST.set(after);
        let done = run();
        MOST.set(usize::MAX);
        (done, COUNTS.get())
    }

    /// Runs and counts.
    pub(crate) fn counted<T>(run: impl FnOnce() -> T) -> (T, Counts) {
        giving_up(usize::MAX, run)
    }
}
