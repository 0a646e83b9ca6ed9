//! How a frame is evolved, as the user of a solver chooses.

/// How a frame is evolved (R40).
///
/// ```
/// # use stiction_core::{Description, Scene, SurfaceDescription};
/// use stiction_core::{Evolution, Hand, Solver};
///
/// # let scene: Scene<f32, 4, 1> = Scene::new(&Description {
/// #     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
/// #     start: [0.0, 0.03, 0.0],
/// #     weight: 0.0,
/// #     holding_point: Some([0.0, 0.02]),
/// #     reach: 0.0,
/// #     stiffness_translation: 500.0,
/// #     stiffness_rotation: 0.5,
/// #     surfaces: &[SurfaceDescription {
/// #         normal: [0.0, 1.0],
/// #         offset: 0.0,
/// #         friction_static: 0.5,
/// #         friction_dynamic: 0.3,
/// #         memory: None,
/// #     }],
/// #     obstacles: &[],
/// # })?;
/// // A box, flat on the floor, mu = 0.5 / 0.3, is pressed 10 mm down and dragged by 0.1 m in a
/// // single frame. It breaks away at a lag of 0.5 · 10 mm, then every (0.5 - 0.3) · 10 mm; where
/// // the hand jumps, it slips the rest of the distance in one slip.
/// let drag = |evolution| {
///     let solver = Solver::new(scene.clone(), evolution);
///     let (mut state, _) = solver.start(Hand::new(0.0, 0.04, 0.0));
///     solver.step(&mut state, Hand::new(0.1, 0.04, 0.0)).slips
/// };
/// assert_eq!(drag(Evolution::Path), 48);
/// assert_eq!(drag(Evolution::Frame), 2);
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Evolution {
    /// Exact events along the straight path of the hand: the result does not depend on the frame rate.
    #[default]
    Path,
    /// From the first event of a frame the hand jumps to its new pose (as in the paper, except for that event). Everything else happens at
    /// the end of the frame, so that number and length of slips depend on the frame rate.
    Frame,
}

impl Evolution {
    /// Both evolutions.
    pub const ALL: [Self; 2] = [Self::Path, Self::Frame];

    /// The name on a command line: `path` or `frame`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Path => "path",
            Self::Frame => "frame",
        }
    }
}
