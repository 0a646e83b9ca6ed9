//! The obstacles of a scene on the wire (FRAME 4.9): a list of them, each with the number of its corners, followed by the corners of all.

use crate::fault::FaultKind;
use crate::fields::{Fields, Sink, require};
use crate::list::{Item, List};
use crate::scene::{HEAD_BYTES, SceneCommand, copied, scene_bytes};
use core::fmt;
use stiction_core::{Description, ObstacleDescription, Parameter, SceneError};

/// The bytes that this many obstacles with this many corners together add to the payload of the same scene without them, [`scene_bytes`].
pub const fn obstacle_bytes(obstacles: usize, corners: usize) -> usize {
    let rows = obstacles.saturating_mul(<Row as Item>::BYTES);
    let corners = corners.saturating_mul(<[f32; 2] as Item>::BYTES);
    rows.saturating_add(corners).saturating_add(COUNTS)
}

/// Bytes of the numbers of obstacles and of corners.
const COUNTS: usize = 2;

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

/// The obstacles in a message; at most 255, with at most 255 corners together. A received list points into the receiver's buffer.
#[derive(Clone, Copy)]
pub struct ObstacleList<'a> {
    items: Items<'a>,
}

#[derive(Clone, Copy)]
enum Items<'a> {
    Given(&'a [ObstacleDescription<'a, f32>]),
    Received {
        rows: List<'a, Row>,
        corners: List<'a, [f32; 2]>,
    },
}

/// An obstacle without its corners, of which it has `corners`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Row {
    corners: u8,
    friction_static: f32,
    friction_dynamic: f32,
    memory: Option<f32>,
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

    pub(crate) fn write(&self, sink: &mut impl Sink) {
        self.scene.write_head(sink);
        sink.count(self.obstacles.len());
        sink.count(self.obstacles.corner_count());
        self.scene.write_lists(sink);
        self.obstacles.write(sink);
    }

    /// Reads the payload of scene-among (FRAME 4.9); fails if its length does not match its counts.
    pub(crate) fn read(fields: &Fields<'a>) -> Result<Self, FaultKind> {
        fields.at_least(HEAD_BYTES.saturating_add(COUNTS))?;
        let mut lists = *fields;
        let mut head = Fields::new(lists.bytes(HEAD_BYTES));
        let listed = head.take().map(usize::from);
        let [vertices, surfaces] = listed;
        let [obstacles, corners] = lists.take().map(usize::from);
        let bytes = scene_bytes(vertices, surfaces);
        fields.exactly(bytes.saturating_add(obstacle_bytes(obstacles, corners)))?;
        let scene = SceneCommand::take_head(&mut head)?;
        Ok(Self {
            scene: scene.take_lists(&mut lists, listed)?,
            obstacles: ObstacleList::take(&mut lists, [obstacles, corners])?,
        })
    }
}

impl<'a> ObstacleList<'a> {
    /// The number of obstacles.
    pub const fn len(&self) -> usize {
        match self.items {
            Items::Given(given) => given.len(),
            Items::Received { rows, .. } => rows.len(),
        }
    }

    /// Returns whether there are no obstacles.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of corners of all of them.
    pub fn corner_count(&self) -> usize {
        match self.items {
            Items::Given(given) => {
                let counts = given.iter().map(|obstacle| obstacle.vertices.len());
                counts.fold(0, usize::saturating_add)
            }
            Items::Received { corners, .. } => corners.len(),
        }
    }

    /// As descriptions, copied into the given slices. The numbers are not checked: [`Scene::among`](stiction_core::Scene::among) does that.
    ///
    /// # Errors
    /// More obstacles or corners than the slices hold.
    pub fn descriptions<'b, 'c>(
        &self,
        corners: &'c mut [[f32; 2]],
        obstacles: &'b mut [ObstacleDescription<'c, f32>],
    ) -> Result<&'b [ObstacleDescription<'c, f32>], SceneError<f32>> {
        let too_many = || SceneError {
            parameter: Parameter::ObstacleCount,
            value: u16::try_from(self.len()).map_or(f32::INFINITY, f32::from),
            allowed: "at most the capacity of the board",
        };
        let places = obstacles.get_mut(..self.len()).ok_or_else(too_many)?;
        let corner_count = (self.corner_count(), Parameter::CornerCount);
        let mut rest = copied(self.corners(), corner_count, corners)?;
        for (place, row) in places.iter_mut().zip(self.rows()) {
            // The number of corners is the sum over the rows.
            let (vertices, after) = rest
                .split_at_checked(usize::from(row.corners))
                .unwrap_or((rest, &[]));
            rest = after;
            *place = ObstacleDescription {
                vertices,
                friction_static: row.friction_static,
                friction_dynamic: row.friction_dynamic,
                memory: row.memory,
            };
        }
        Ok(places)
    }

    fn rows(&self) -> impl Iterator<Item = Row> + use<'a> {
        let (given, received) = match self.items {
            Items::Given(given) => (given, None),
            Items::Received { rows, .. } => (&[][..], Some(rows)),
        };
        let given = given.iter().map(Row::of);
        given.chain(received.into_iter().flat_map(|rows| rows.iter()))
    }

    fn corners(&self) -> impl Iterator<Item = [f32; 2]> + use<'a> {
        let (given, received) = match self.items {
            Items::Given(given) => (given, None),
            Items::Received { corners, .. } => (&[][..], Some(corners)),
        };
        let given = given.iter().flat_map(|obstacle| obstacle.vertices).copied();
        given.chain(received.into_iter().flat_map(|corners| corners.iter()))
    }

    fn write(&self, sink: &mut impl Sink) {
        self.rows().for_each(|row| row.put(sink));
        self.corners().for_each(|corner| corner.put(sink));
    }

    /// The next obstacles and corners of a payload, in these numbers; fails if it is too short.
    fn take(fields: &mut Fields<'a>, [rows, corners]: [usize; 2]) -> Result<Self, FaultKind> {
        let rows: List<'a, Row> = List::take(fields, rows)?;
        let counts = rows.iter().map(|row| usize::from(row.corners));
        let counted = counts.fold(0, usize::saturating_add);
        require(counted == corners, FaultKind::Value)?;
        let corners = List::take(fields, corners)?;
        Ok(Self {
            items: Items::Received { rows, corners },
        })
    }
}

impl Row {
    fn of(obstacle: &ObstacleDescription<'_, f32>) -> Self {
        Self {
            // If there are more, the corners of all are more than can be sent, too.
            corners: u8::try_from(obstacle.vertices.len()).unwrap_or(u8::MAX),
            friction_static: obstacle.friction_static,
            friction_dynamic: obstacle.friction_dynamic,
            memory: obstacle.memory,
        }
    }
}

impl Item for Row {
    const BYTES: usize = 14;
    fn put(&self, sink: &mut impl Sink) {
        sink.byte(self.corners);
        sink.f32s(&[self.friction_static, self.friction_dynamic]);
        sink.option(self.memory);
    }
    fn get(fields: &mut Fields<'_>) -> Self {
        let corners = fields.u8();
        let [friction_static, friction_dynamic] = fields.f32s();
        Self {
            corners,
            friction_static,
            friction_dynamic,
            memory: fields.option().unwrap_or(None),
        }
    }
    fn valid(bytes: &[u8]) -> bool {
        bytes.get(9).is_some_and(|&flag| flag <= 1)
    }
}

impl<'a> From<&'a [ObstacleDescription<'a, f32>]> for ObstacleList<'a> {
    fn from(obstacles: &'a [ObstacleDescription<'a, f32>]) -> Self {
        Self {
            items: Items::Given(obstacles),
        }
    }
}

impl PartialEq for ObstacleList<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.rows().eq(other.rows()) && self.corners().eq(other.corners())
    }
}

impl fmt::Debug for ObstacleList<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let corners = self.corners();
        f.debug_list()
            .entries(self.rows())
            .entries(corners)
            .finish()
    }
}
