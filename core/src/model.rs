//! Only what a scene requires: the type of a scene leaves the parts of the solver that it can do without out of the binary. `V = 1` (a
//! point tool) has no edges, `S = 1` has no state of two surfaces; a [`Model`] leaves out friction or weight.

use crate::obstacle::{NoObstacles, Obstacles, SomeObstacles};
use crate::real::Real;
use crate::scene::{Description, Scene, SceneError, check_obstacle_count};
use core::marker::PhantomData;

/// The parts of the solver that a scene may need in addition to its geometry: [`Full`], [`Weightless`], [`Frictionless`] or [`Bare`], the
/// last parameter of [`Scene`](crate::Scene) and [`Solver`](crate::Solver). Parts that the model leaves out are not in the binary; the same
/// holds for the capacities: a scene of one vertex has no edges, one of one surface no states of two.
///
/// ```
/// use stiction_core::{Bare, Description, Evolution, Hand, Parameter, Scene, Solver};
/// use stiction_core::{SurfaceDescription, Weightless};
///
/// // The tip of a tool on a smooth floor, held 0.1 m above it.
/// let smooth = SurfaceDescription {
///     normal: [0.0, 1.0],
///     offset: 0.0,
///     friction_static: 0.0,
///     friction_dynamic: 0.0,
///     memory: None,
/// };
/// let tip = Description {
///     vertices: &[[0.0, 0.0]],
///     start: [0.0, 0.0, 0.0],
///     weight: 0.0,
///     holding_point: Some([0.0, 0.1]),
///     reach: 0.0,
///     stiffness_translation: 500.0,
///     stiffness_rotation: 0.5,
///     surfaces: &[smooth],
///     obstacles: &[],
/// };
/// let solver = Solver::new(Scene::<f32, 1, 1, Bare>::new(&tip)?, Evolution::Path);
/// let (mut state, _) = solver.start(Hand::new(0.0, 0.09, 0.0));
/// let output = solver.step(&mut state, Hand::new(0.05, 0.09, 0.0));
/// let contact = solver.contacts(&state)[0];
/// assert!((output.position[0] - 0.05).abs() < 1e-5, "it glides along below the hand");
/// assert!((contact.normal - 5.0).abs() < 1e-3 && contact.friction.abs() < 1e-3);
///
/// // A model refuses parameters of parts that it does not have.
/// let rough = [SurfaceDescription { friction_static: 0.5, ..smooth }];
/// let rough = Description { surfaces: &rough, ..tip };
/// let error = Scene::<f32, 1, 1, Bare>::new(&rough).expect_err("no friction in this model");
/// assert_eq!(error.parameter, Parameter::FrictionStatic(0));
/// assert!(Scene::<f32, 1, 1, Weightless>::new(&rough).is_ok());
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
pub trait Model: Clone + core::fmt::Debug + PartialEq + sealed::Sealed + 'static {
    /// Friction: sticking and slipping. Without it every mu is 0, and on a single surface contacts glide (STATICS 3.6).
    const FRICTION: bool;
    /// The body's weight W. Without it W is 0.
    const WEIGHT: bool;
    /// What a scene stores for obstacles with corners, for a body of at most V vertices.
    #[doc(hidden)]
    type Obstacles<R: Real, const V: usize>: Obstacles<R>;
    /// Puts the obstacles of a description into a scene that has everything else.
    ///
    /// # Errors
    /// The first parameter of an obstacle that is not usable, or that there is no room for obstacles.
    #[doc(hidden)]
    fn surround<R: Real, const V: usize, const S: usize>(
        scene: &mut Scene<R, V, S, Self>,
        description: &Description<'_, R::Si>,
    ) -> Result<(), SceneError<R::Si>>;
}

/// A model with or without friction, with or without weight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts<const FRICTION: bool, const WEIGHT: bool>;

impl<const FRICTION: bool, const WEIGHT: bool> Model for Parts<FRICTION, WEIGHT> {
    const FRICTION: bool = FRICTION;
    const WEIGHT: bool = WEIGHT;
    type Obstacles<R: Real, const V: usize> = NoObstacles;
    fn surround<R: Real, const V: usize, const S: usize>(
        _: &mut Scene<R, V, S, Self>,
        description: &Description<'_, R::Si>,
    ) -> Result<(), SceneError<R::Si>> {
        check_obstacle_count(description.obstacles, 0)
    }
}

/// A model with obstacles that have corners: at most O of them, with at most C corners together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WithObstacles<const O: usize, const C: usize, M: Model = Full>(PhantomData<M>);

impl<const O: usize, const C: usize, M: Model> Model for WithObstacles<O, C, M> {
    const FRICTION: bool = M::FRICTION;
    const WEIGHT: bool = M::WEIGHT;
    type Obstacles<R: Real, const V: usize> = SomeObstacles<R, V, O, C>;
    fn surround<R: Real, const V: usize, const S: usize>(
        scene: &mut Scene<R, V, S, Self>,
        description: &Description<'_, R::Si>,
    ) -> Result<(), SceneError<R::Si>> {
        scene.surround(description)
    }
}

/// Everything: friction and weight.
pub type Full = Parts<true, true>;
/// Friction, no weight.
pub type Weightless = Parts<true, false>;
/// Weight, no friction.
pub type Frictionless = Parts<false, true>;
/// Neither friction nor weight.
pub type Bare = Parts<false, false>;

mod sealed {
    pub trait Sealed {}
    impl<const FRICTION: bool, const WEIGHT: bool> Sealed for super::Parts<FRICTION, WEIGHT> {}
    impl<const O: usize, const C: usize, M: super::Model> Sealed for super::WithObstacles<O, C, M> {}
}
