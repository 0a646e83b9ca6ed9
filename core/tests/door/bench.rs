//! A solver of any number type with all values in f64.
use stiction_core::{
    Contact, Description, Event, Evolution, Fixed, Hand, Output, Real, Scene, SceneError, SiFloat,
    Solver, State, SurfaceDescription,
};

pub(crate) type Of<R> = Solver<R, 8, 4, 0>;

/// A number type with the accuracy of a closed form.
pub(crate) trait Number: Real<Si: SiFloat> {
    const NEAR: f64;
    fn si(x: f64) -> Self::Si {
        Self::Si::narrow(x)
    }
}
impl Number for f64 {
    const NEAR: f64 = 1e-9;
}
impl Number for f32 {
    const NEAR: f64 = 1e-4;
}
impl Number for Fixed {
    const NEAR: f64 = 1e-4;
}

/// Instantiates a test for every number type.
macro_rules! in_every_number_type {
    ($($module:ident::$case:ident),* $(,)?) => {$(
        #[test]
        fn $case() {
            $module::$case::<f64>();
            $module::$case::<f32>();
            $module::$case::<stiction_core::Fixed>();
        }
    )*};
}

pub(crate) use in_every_number_type;

/// A scene in f64.
#[derive(Clone, Debug, Default)]
pub(crate) struct Setup {
    pub(crate) vertices: Vec<[f64; 2]>,
    pub(crate) held: Option<[f64; 2]>,
    pub(crate) reach: f64,
    /// k_h, k_theta
    pub(crate) springs: [f64; 2],
    pub(crate) weight: f64,
    pub(crate) start: [f64; 3],
    pub(crate) surfaces: Vec<SurfaceDescription<f64>>,
}

/// A side with mu_s, mu_d, and no memory length.
pub(crate) fn side(
    normal: [f64; 2],
    offset: f64,
    [fixed, sliding]: [f64; 2],
) -> SurfaceDescription<f64> {
    SurfaceDescription {
        normal,
        offset,
        friction_static: fixed,
        friction_dynamic: sliding,
        memory: Some(0.0),
    }
}
/// A block on the floor y = 0, its origin at the middle of its bottom side, held at a height.
pub(crate) fn block([width, height]: [f64; 2], held: f64, mu: [f64; 2]) -> Setup {
    let half = width / 2.0;
    Setup {
        vertices: vec![[-half, 0.0], [half, 0.0], [half, height], [-half, height]],
        held: Some([0.0, held]),
        springs: [1.0, 1.0],
        surfaces: vec![side([0.0, 1.0], 0.0, mu)],
        ..Setup::default()
    }
}

/// A solver that follows the hand's path.
pub(crate) fn solver_of<R: Number>(
    description: &Description<'_, R::Si>,
) -> Result<Of<R>, SceneError<R::Si>> {
    Ok(Solver::new(Scene::new(description)?, Evolution::Path))
}

impl Setup {
    pub(crate) fn described<R: Number, T>(
        &self,
        take: impl FnOnce(&Description<'_, R::Si>) -> T,
    ) -> T {
        let point = |p: [f64; 2]| p.map(R::si);
        let vertices: Vec<_> = self.vertices.iter().map(|&v| point(v)).collect();
        let surfaces = self.surfaces.iter().map(|s| SurfaceDescription {
            normal: point(s.normal),
            offset: R::si(s.offset),
            friction_static: R::si(s.friction_static),
            friction_dynamic: R::si(s.friction_dynamic),
            memory: s.memory.map(R::si),
        });
        let surfaces: Vec<_> = surfaces.collect();
        take(&Description {
            vertices: &vertices,
            start: self.start.map(R::si),
            weight: R::si(self.weight),
            holding_point: self.held.map(point),
            reach: R::si(self.reach),
            stiffness_translation: R::si(self.springs[0]),
            stiffness_rotation: R::si(self.springs[1]),
            surfaces: &surfaces,
            obstacles: &[],
        })
    }
    pub(crate) fn solver<R: Number>(&self) -> Result<Of<R>, SceneError<R::Si>> {
        self.described::<R, _>(solver_of::<R>)
    }
    /// A point of the body frame in the world.
    pub(crate) fn world(&self, [x, y, theta]: [f64; 3], [a, b]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = theta.sin_cos();
        [x + cos * a - sin * b, y + sin * a + cos * b]
    }
}

/// A hand that holds, at x, y (m), phi (rad).
pub(crate) fn hand<R: Number>([x, y, phi]: [f64; 3]) -> Hand<R::Si> {
    Hand::new(R::si(x), R::si(y), R::si(phi))
}

pub(crate) struct Run<R: Number> {
    pub(crate) solver: Of<R>,
    pub(crate) state: State<R>,
    pub(crate) output: Output<R::Si>,
    at: [f64; 3],
}

impl<R: Number> Run<R> {
    pub(crate) fn new(setup: &Setup, evolution: Evolution, at: [f64; 3]) -> Self {
        Self::with(setup, evolution, hand::<R>(at))
    }
    pub(crate) fn with(setup: &Setup, evolution: Evolution, first: Hand<R::Si>) -> Self {
        let solver = setup.solver::<R>().expect("a scene");
        let solver = solver.with_evolution(evolution);
        let (state, output) = solver.start(first);
        let [x, y] = first.position.map(SiFloat::widen);
        Self {
            solver,
            state,
            output,
            at: [x, y, first.angle.radians().widen()],
        }
    }
    pub(crate) fn feed(&mut self, hand: Hand<R::Si>) -> &Output<R::Si> {
        self.output = self.solver.step(&mut self.state, hand);
        &self.output
    }
    pub(crate) fn to(&mut self, at: [f64; 3]) -> &Output<R::Si> {
        self.at = at;
        self.feed(hand::<R>(at))
    }
    /// In so many frames; the slips on the way.
    pub(crate) fn lead(&mut self, to: [f64; 3], frames: u32) -> u32 {
        let from = self.at;
        let mut slips = 0;
        for k in 1..=frames {
            let part = f64::from(k) / f64::from(frames);
            slips += self
                .to([0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * part))
                .slips;
        }
        slips
    }
    /// x, y (m), phi (rad) of the hand.
    pub(crate) fn at(&self) -> [f64; 3] {
        self.at
    }
    /// x, y (m), theta (rad) of the body.
    pub(crate) fn pose(&self) -> [f64; 3] {
        let [x, y] = self.output.position.map(SiFloat::widen);
        let turns = f64::from(self.output.angle.turns) * core::f64::consts::TAU;
        [x, y, turns + self.output.angle.rest.widen()]
    }
    /// Fx, Fy (N), M (N·m) of the hand on the body.
    pub(crate) fn wrench(&self) -> [f64; 3] {
        let wrench = self.solver.wrench(&self.state);
        let [x, y] = wrench.force.map(SiFloat::widen);
        [x, y, wrench.moment.widen()]
    }
    pub(crate) fn contacts(&self) -> Vec<Contact<R::Si>> {
        self.solver.contacts(&self.state).to_vec()
    }
    /// The sum of all N (N).
    pub(crate) fn normal(&self) -> f64 {
        self.contacts().iter().map(|c| c.normal.widen()).sum()
    }
    pub(crate) fn saw(&self, event: Event) -> bool {
        self.output.events().contains(&event)
    }
}

#[track_caller]
pub(crate) fn near<R: Number>(is: f64, should: f64) {
    assert!((is - should).abs() <= R::NEAR, "{is} and not {should}");
}
#[track_caller]
pub(crate) fn all_near<R: Number, const N: usize>(is: [f64; N], should: [f64; N]) {
    for (is, should) in is.into_iter().zip(should) {
        near::<R>(is, should);
    }
}
