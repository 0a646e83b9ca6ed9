//! A scene on the wire (FRAME 4.4): one frame, as large as the capacities of the board require.

use crate::fault::FaultKind;
use crate::fields::{Fields, Sink};
use crate::list::{Item, List};
use stiction_core::{Description, Parameter, SceneError, SurfaceDescription};

/// Bytes before the vertices.
pub(crate) const HEAD_BYTES: usize = 39;

/// The bytes of the payload of a scene with these numbers of vertices and surfaces.
pub const fn scene_bytes(vertices: usize, surfaces: usize) -> usize {
    let vertices = vertices.saturating_mul(<[f32; 2] as Item>::BYTES);
    let surfaces = surfaces.saturating_mul(<SurfaceDescription<f32> as Item>::BYTES);
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
        let vertex_count = (self.vertices.len(), Parameter::VertexCount);
        let surface_count = (self.surfaces.len(), Parameter::SurfaceCount);
        Ok(Description {
            vertices: copied(self.vertices.iter(), vertex_count, vertices)?,
            start: self.start,
            weight: self.weight,
            holding_point: self.holding_point,
            reach: self.reach,
            stiffness_translation: self.stiffness_translation,
            stiffness_rotation: self.stiffness_rotation,
            surfaces: copied(self.surfaces.iter(), surface_count, surfaces)?,
        })
    }

    pub(crate) fn write(&self, sink: &mut impl Sink) {
        self.write_head(sink);
        self.write_lists(sink);
    }

    /// Writes everything except the lists, with their lengths.
    pub(crate) fn write_head(&self, sink: &mut impl Sink) {
        sink.count(self.vertices.len());
        sink.count(self.surfaces.len());
        sink.byte(u8::from(self.holding_point.is_some()));
        sink.f32s(&self.start);
        sink.f32(self.weight);
        sink.f32s(&self.holding_point.unwrap_or_default());
        sink.f32s(&[
            self.reach,
            self.stiffness_translation,
            self.stiffness_rotation,
        ]);
    }

    pub(crate) fn write_lists(&self, sink: &mut impl Sink) {
        self.vertices.write(sink);
        self.surfaces.write(sink);
    }

    pub(crate) fn read(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        fields.at_least(HEAD_BYTES)?;
        let whole = *fields;
        let counts = fields.take().map(usize::from);
        let [vertices, surfaces] = counts;
        whole.exactly(scene_bytes(vertices, surfaces))?;
        Self::take_head(fields)?.take_lists(fields, counts)
    }

    /// Reads what follows the lengths of the lists, without the lists.
    #[inline(always)]
    pub(crate) fn take_head(fields: &mut Fields<'a>) -> Result<Self, FaultKind> {
        let given = fields.flag()?;
        let (start, weight) = (fields.f32s(), fields.f32());
        let holding_point = fields.f32s();
        let [reach, stiffness_translation, stiffness_rotation] = fields.f32s();
        Ok(Self {
            vertices: List::from(&[]),
            start,
            weight,
            holding_point: given.then_some(holding_point),
            reach,
            stiffness_translation,
            stiffness_rotation,
            surfaces: List::from(&[]),
        })
    }

    /// With these numbers of vertices and surfaces, which follow.
    #[inline(always)]
    pub(crate) fn take_lists(
        self,
        fields: &mut Fields<'a>,
        [vertices, surfaces]: [usize; 2],
    ) -> Result<Self, FaultKind> {
        Ok(Self {
            vertices: List::take(fields, vertices)?,
            surfaces: List::take(fields, surfaces)?,
            ..self
        })
    }
}

/// The items of a list, copied; fails if there are more than fit.
pub(crate) fn copied<T>(
    items: impl Iterator<Item = T>,
    (count, parameter): (usize, Parameter),
    places: &mut [T],
) -> Result<&[T], SceneError<f32>> {
    let Some(places) = places.get_mut(..count) else {
        return Err(SceneError {
            parameter,
            value: u16::try_from(count).map_or(f32::INFINITY, f32::from),
            allowed: "at most the capacity of the board",
        });
    };
    for (place, item) in places.iter_mut().zip(items) {
        *place = item;
    }
    Ok(places)
}

impl Item for [f32; 2] {
    const BYTES: usize = 8;
    fn put(&self, sink: &mut impl Sink) {
        sink.f32s(self);
    }
    fn get(fields: &mut Fields<'_>) -> Self {
        fields.f32s()
    }
}

impl Item for SurfaceDescription<f32> {
    const BYTES: usize = 25;
    fn put(&self, sink: &mut impl Sink) {
        sink.f32s(&self.normal);
        sink.f32s(&[self.offset, self.friction_static, self.friction_dynamic]);
        sink.option(self.memory);
    }
    fn get(fields: &mut Fields<'_>) -> Self {
        let normal = fields.f32s();
        let [offset, friction_static, friction_dynamic] = fields.f32s();
        Self {
            normal,
            offset,
            friction_static,
            friction_dynamic,
            memory: fields.option().unwrap_or(None),
        }
    }
    fn valid(bytes: &[u8]) -> bool {
        bytes.get(20).is_some_and(|&flag| flag <= 1)
    }
}
