//! A scene on the wire, without obstacles or among them (FRAME 4.4, 4.9): one frame, as large as the capacities of the board require.

use crate::fault::FaultKind;
use crate::field::{Field, Fields, Sink};
use crate::list::List;
use crate::obstacles::{ObstacleList, obstacle_bytes};
use stiction_core::{Description, ObstacleDescription, Parameter, SceneError, SurfaceDescription};

/// Bytes before the vertices.
const HEAD_BYTES: usize = 39;

/// The bytes of the payload of a scene with these numbers of vertices and surfaces.
pub const fn scene_bytes(vertices: usize, surfaces: usize) -> usize {
    let vertices = vertices.saturating_mul(<[f32; 2]>::BYTES);
    let surfaces = surfaces.saturating_mul(SurfaceDescription::<f32>::BYTES);
    vertices.saturating_add(surfaces).saturating_add(HEAD_BYTES)
}

/// A scene in SI units; the fields are those of [`Description`].
///
/// ```
/// use stiction_core::{Description, Scene, SurfaceDescription};
/// use stiction_wire::SceneCommand;
///
/// let floor = SurfaceDescription { normal: [0.0, 1.0], offset: 0.0, friction_static: 0.5, friction_dynamic: 0.3, memory: None };
/// let described = Description {
///     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.0, 0.03]],
///     start: [0.0, 0.03, 0.0],
///     weight: 0.0,
///     holding_point: None,
///     reach: 0.01,
///     stiffness_translation: 500.0,
///     stiffness_rotation: 0.5,
///     surfaces: &[floor],
/// };
/// let sent = SceneCommand::from(&described);
///
/// // On the board, with room for 4 vertices and 2 surfaces:
/// let (mut vertices, mut surfaces) = ([[0.0; 2]; 4], [floor; 2]);
/// let received = sent.description(&mut vertices, &mut surfaces)?;
/// let scene: Scene<f32, 4, 2> = Scene::new(&received)?;
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneCommand<'a> {
    /// Vertices (m), body frame, counter-clockwise; at most 255.
    pub vertices: List<'a, [f32; 2]>,
    /// Start pose: x, y (m), theta (rad).
    pub start: [f32; 3],
    /// Weight (N).
    pub weight: f32,
    /// The initial holding point (m), body frame.
    pub holding_point: Option<[f32; 2]>,
    /// How far outside the polygon a hand may be and still take hold (m).
    pub reach: f32,
    /// Translational stiffness k_h (N/m).
    pub stiffness_translation: f32,
    /// Rotational stiffness k_theta (N·m/rad).
    pub stiffness_rotation: f32,
    /// The surfaces; at most 255.
    pub surfaces: List<'a, SurfaceDescription<f32>>,
}

/// A scene among obstacles in SI units.
///
/// ```
/// use stiction_core::{Description, ObstacleDescription, Scene, WithObstacles};
/// use stiction_wire::SceneAmong;
///
/// let table = ObstacleDescription {
///     vertices: &[[-0.5, -0.1], [0.0, -0.1], [0.0, 0.0], [-0.5, 0.0]],
///     friction_static: 0.5,
///     friction_dynamic: 0.3,
///     memory: None,
/// };
/// let described = Description {
///     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.0, 0.03]],
///     start: [-0.05, 0.03, 0.0],
///     weight: 1.0,
///     holding_point: None,
///     reach: 0.01,
///     stiffness_translation: 500.0,
///     stiffness_rotation: 0.5,
///     surfaces: &[],
/// };
/// let obstacles = [table];
/// let sent = SceneAmong::new(&described, &obstacles);
///
/// // On the board, with room for 4 vertices, 2 obstacles and 8 corners:
/// let (mut vertices, mut corners) = ([[0.0; 2]; 4], [[0.0; 2]; 8]);
/// let mut places = [ObstacleDescription { vertices: &[], ..table }; 2];
/// let received = sent.scene.description(&mut vertices, &mut [])?;
/// let obstacles = sent.obstacles.descriptions(&mut corners, &mut places)?;
/// let scene: Scene<f32, 4, 0, WithObstacles<2, 8>> = Scene::among(&received, obstacles)?;
/// # Ok::<(), stiction_core::SceneError<f32>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneAmong<'a> {
    /// Everything except the obstacles.
    pub scene: SceneCommand<'a>,
    /// The obstacles.
    pub obstacles: ObstacleList<'a>,
}

impl<'a> SceneAmong<'a> {
    /// From the arguments of [`Scene::among`](stiction_core::Scene::among).
    pub fn new(
        description: &Description<'a, f32>,
        obstacles: &'a [ObstacleDescription<'a, f32>],
    ) -> Self {
        Self {
            scene: SceneCommand::from(description),
            obstacles: ObstacleList::from(obstacles),
        }
    }
}

impl<'a> From<&Description<'a, f32>> for SceneCommand<'a> {
    fn from(d: &Description<'a, f32>) -> Self {
        Self {
            vertices: List::from(d.vertices),
            start: d.start,
            weight: d.weight,
            holding_point: d.holding_point,
            reach: d.reach,
            stiffness_translation: d.stiffness_translation,
            stiffness_rotation: d.stiffness_rotation,
            surfaces: List::from(d.surfaces),
        }
    }
}

impl<'a> SceneCommand<'a> {
    /// As a description, with its lists copied into the given slices. Its numbers are not checked: [`Scene::new`](stiction_core::Scene::new) does
    /// that.
    ///
    /// # Errors
    /// More vertices or surfaces than the slices hold.
    pub fn description<'b>(
        &self,
        vertices: &'b mut [[f32; 2]],
        surfaces: &'b mut [SurfaceDescription<f32>],
    ) -> Result<Description<'b, f32>, SceneError<f32>> {
        Ok(Description {
            vertices: self.vertices.copied(Parameter::VertexCount, vertices)?,
            start: self.start,
            weight: self.weight,
            holding_point: self.holding_point,
            reach: self.reach,
            stiffness_translation: self.stiffness_translation,
            stiffness_rotation: self.stiffness_rotation,
            surfaces: self.surfaces.copied(Parameter::SurfaceCount, surfaces)?,
        })
    }

    /// Writes the payload of scene, or of scene-among.
    pub(crate) fn write(&self, obstacles: Option<&ObstacleList<'_>>, sink: &mut impl Sink) {
        [self.vertices.len(), self.surfaces.len()].put(sink);
        self.holding_point.is_some().put(sink);
        self.start.put(sink);
        self.weight.put(sink);
        self.holding_point.unwrap_or_default().put(sink);
        self.reach.put(sink);
        [self.stiffness_translation, self.stiffness_rotation].put(sink);
        if let Some(obstacles) = obstacles {
            [obstacles.len(), obstacles.corner_count()].put(sink);
        }
        self.vertices.write(sink);
        self.surfaces.write(sink);
        if let Some(obstacles) = obstacles {
            obstacles.write(sink);
        }
    }

    /// Reads the payload of scene (FRAME 4.4); fails if its length does not match its counts.
    pub(crate) fn read(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        let (scene, _) = Self::read_lists(fields, false)?;
        Ok(scene)
    }

    /// Reads the payload of scene-among (FRAME 4.9); fails if its length does not match its counts.
    pub(crate) fn read_among(
        fields: &mut Fields<'a>,
    ) -> Result<(Self, ObstacleList<'a>), FaultKind> {
        Self::read_lists(fields, true)
    }

    #[inline(always)]
    fn read_lists(
        fields: &mut Fields<'a>,
        among: bool,
    ) -> Result<(Self, ObstacleList<'a>), FaultKind> {
        let counts = if among { <[usize; 2]>::BYTES } else { 0 };
        fields.at_least(HEAD_BYTES.saturating_add(counts))?;
        let whole = *fields;
        let mut head = Fields::new(fields.bytes(HEAD_BYTES));
        let [vertices, surfaces]: [usize; 2] = head.get()?;
        let [obstacles, corners] = if among { fields.get()? } else { [0; 2] };
        let of_obstacles = if among {
            obstacle_bytes(obstacles, corners)
        } else {
            0
        };
        whole.exactly(scene_bytes(vertices, surfaces).saturating_add(of_obstacles))?;
        let has_holding_point: bool = head.get()?;
        let (start, weight) = (head.get()?, head.get()?);
        let holding_point = head.get()?;
        let scene = Self {
            start,
            weight,
            holding_point: has_holding_point.then_some(holding_point),
            reach: head.get()?,
            stiffness_translation: head.get()?,
            stiffness_rotation: head.get()?,
            vertices: List::take(fields, vertices)?,
            surfaces: List::take(fields, surfaces)?,
        };
        Ok((scene, ObstacleList::take(fields, [obstacles, corners])?))
    }
}
