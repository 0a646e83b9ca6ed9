//! A scene on the wire (FRAME 4.4): one frame, as large as the capacities of the board require.

use crate::fault::FaultKind;
use crate::field::{Field, Fields, Sink};
use crate::list::List;
use crate::obstacles::{ObstacleList, obstacle_bytes};
use stiction_core::{Description, ObstacleDescription, Parameter, SceneError, SurfaceDescription};

/// Bytes before the vertices.
const HEAD_BYTES: usize = 41;

/// The bytes of the payload of a scene with these numbers of vertices, surfaces, obstacles, and corners of all obstacles.
pub const fn scene_bytes([vertices, surfaces, obstacles, corners]: [usize; 4]) -> usize {
    let vertices = vertices.saturating_mul(<[f32; 2]>::BYTES);
    let surfaces = surfaces.saturating_mul(SurfaceDescription::<f32>::BYTES);
    let of_body = vertices.saturating_add(HEAD_BYTES);
    of_body
        .saturating_add(surfaces)
        .saturating_add(obstacle_bytes(obstacles, corners))
}

/// A scene in SI units; the fields are those of [`Description`].
///
/// ```
/// use stiction_core::{Description, ObstacleDescription, Scene, SurfaceDescription};
/// use stiction_wire::SceneCommand;
///
/// let floor = SurfaceDescription { normal: [0.0, 1.0], offset: -0.5, friction_static: 0.5, friction_dynamic: 0.3, memory: None };
/// let table = ObstacleDescription {
///     vertices: &[[-0.5, -0.1], [0.0, -0.1], [0.0, 0.0], [-0.5, 0.0]],
///     friction_static: 0.5,
///     friction_dynamic: 0.3,
///     memory: None,
/// };
/// let (surfaces, obstacles) = ([floor], [table]);
/// let sent = SceneCommand::from(&Description {
///     vertices: &[[-0.05, -0.03], [0.05, -0.03], [0.0, 0.03]],
///     start: [-0.05, 0.03, 0.0],
///     weight: 1.0,
///     holding_point: None,
///     reach: 0.01,
///     stiffness_translation: 500.0,
///     stiffness_rotation: 0.5,
///     surfaces: &surfaces,
///     obstacles: &obstacles,
/// });
///
/// // On the board, with room for 4 vertices, 1 surface, and 2 obstacles with 8 corners together:
/// let (mut vertices, mut corners) = ([[0.0; 2]; 4], [[0.0; 2]; 8]);
/// let (mut surfaces, mut obstacles) = ([floor], [ObstacleDescription { vertices: &[], ..table }; 2]);
/// let received = sent.description([&mut vertices, &mut corners], &mut surfaces, &mut obstacles)?;
/// let scene: Scene<f32, 4, 1, 8> = Scene::new(&received)?;
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
    /// The obstacles.
    pub obstacles: ObstacleList<'a>,
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
            obstacles: ObstacleList::from(d.obstacles),
        }
    }
}

impl<'a> SceneCommand<'a> {
    /// As a description, with its lists copied into the given slices, those of the corners being the second one of points. Its numbers are
    /// not checked: [`Scene::new`](stiction_core::Scene::new) does that.
    ///
    /// # Errors
    /// More vertices, surfaces, obstacles or corners than the slices hold.
    pub fn description<'b>(
        &self,
        [vertices, corners]: [&'b mut [[f32; 2]]; 2],
        surfaces: &'b mut [SurfaceDescription<f32>],
        obstacles: &'b mut [ObstacleDescription<'b, f32>],
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
            obstacles: self.obstacles.descriptions(corners, obstacles)?,
        })
    }

    pub(crate) fn write(&self, sink: &mut impl Sink) {
        [self.vertices.len(), self.surfaces.len()].put(sink);
        [self.obstacles.len(), self.obstacles.corner_count()].put(sink);
        self.holding_point.is_some().put(sink);
        self.start.put(sink);
        self.weight.put(sink);
        self.holding_point.unwrap_or_default().put(sink);
        self.reach.put(sink);
        [self.stiffness_translation, self.stiffness_rotation].put(sink);
        self.vertices.write(sink);
        self.surfaces.write(sink);
        self.obstacles.write(sink);
    }

    /// Reads the payload of scene (FRAME 4.4); fails if its length does not match its counts.
    pub(crate) fn read(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        fields.at_least(HEAD_BYTES)?;
        let whole = *fields;
        let counts: [usize; 4] = fields.get()?;
        whole.exactly(scene_bytes(counts))?;
        let [vertices, surfaces, obstacles, corners] = counts;
        let has_holding_point: bool = fields.get()?;
        let (start, weight) = (fields.get()?, fields.get()?);
        let holding_point = fields.get()?;
        Ok(Self {
            start,
            weight,
            holding_point: has_holding_point.then_some(holding_point),
            reach: fields.get()?,
            stiffness_translation: fields.get()?,
            stiffness_rotation: fields.get()?,
            vertices: List::take(fields, vertices)?,
            surfaces: List::take(fields, surfaces)?,
            obstacles: ObstacleList::take(fields, [obstacles, corners])?,
        })
    }
}
