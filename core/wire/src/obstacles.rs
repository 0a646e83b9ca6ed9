//! The obstacles of a scene on the wire (FRAME 4.4): a list of them, each with the number of its corners, followed by the corners of all.

use crate::fault::FaultKind;
use crate::field::{Field, Fields, Sink, require};
use crate::layout::layout;
use crate::list::{List, copied};
use core::fmt;
use stiction_core::{ObstacleDescription, Parameter, SceneError};

/// The bytes of this many obstacles with this many corners together.
pub(crate) const fn obstacle_bytes(obstacles: usize, corners: usize) -> usize {
    let rows = obstacles.saturating_mul(ObstacleRow::BYTES);
    rows.saturating_add(corners.saturating_mul(<[f32; 2]>::BYTES))
}

/// The obstacles in a message; at most 255, with at most 255 corners together. A received list points into the receiver's buffer.
#[derive(Clone, Copy)]
pub struct ObstacleList<'a> {
    source: Obstacles<'a>,
}

#[derive(Clone, Copy)]
enum Obstacles<'a> {
    Given(&'a [ObstacleDescription<'a, f32>]),
    Received {
        rows: List<'a, ObstacleRow>,
        corners: List<'a, [f32; 2]>,
    },
}

/// An obstacle without its corners, of which it has `corners`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObstacleRow {
    /// The number of corners.
    pub corners: usize,
    /// mu_s
    pub friction_static: f32,
    /// mu_d
    pub friction_dynamic: f32,
    /// D_c (m), if it is not the default.
    pub memory: Option<f32>,
}

layout! { ObstacleRow { corners: usize, friction_static: f32, friction_dynamic: f32, memory: Option<f32> } }

impl<'a> ObstacleList<'a> {
    /// The number of obstacles.
    pub const fn len(&self) -> usize {
        match self.source {
            Obstacles::Given(given) => given.len(),
            Obstacles::Received { rows, .. } => rows.len(),
        }
    }

    /// Returns whether there are no obstacles.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of corners of all of them.
    pub fn corner_count(&self) -> usize {
        let counts = self.rows().map(|row| row.corners);
        counts.fold(0, usize::saturating_add)
    }

    /// As descriptions, copied into the given slices. The numbers are not checked: [`Scene::new`](stiction_core::Scene::new) does
    /// that.
    ///
    /// # Errors
    /// More obstacles or corners than the slices hold.
    pub fn descriptions<'b, 'c>(
        &self,
        corners: &'c mut [[f32; 2]],
        obstacles: &'b mut [ObstacleDescription<'c, f32>],
    ) -> Result<&'b [ObstacleDescription<'c, f32>], SceneError<f32>> {
        let without_corners = self.rows().map(|row| row.described(&[]));
        let counted = Parameter::ObstacleCount;
        let places = copied(without_corners, self.len(), counted, obstacles)?;
        let counted = Parameter::CornerCount;
        let mut rest = &*copied(self.corners(), self.corner_count(), counted, corners)?;
        for (place, row) in places.iter_mut().zip(self.rows()) {
            // The number of corners is the sum over the rows.
            (place.vertices, rest) = rest.split_at_checked(row.corners).unwrap_or((rest, &[]));
        }
        Ok(places)
    }

    fn rows(&self) -> impl Iterator<Item = ObstacleRow> + use<'a> {
        let source = self.source;
        (0..self.len()).filter_map(move |i| match source {
            Obstacles::Given(given) => given.get(i).map(ObstacleRow::of),
            Obstacles::Received { rows, .. } => rows.get(i),
        })
    }

    fn corners(&self) -> impl Iterator<Item = [f32; 2]> + use<'a> {
        let (given, received) = match self.source {
            Obstacles::Given(given) => (given, None),
            Obstacles::Received { corners, .. } => (&[][..], Some(corners)),
        };
        let given = given.iter().flat_map(|obstacle| obstacle.vertices).copied();
        given.chain(received.into_iter().flat_map(|corners| corners.iter()))
    }

    pub(crate) fn write(&self, sink: &mut impl Sink) {
        self.rows().for_each(|row| row.put(sink));
        self.corners().for_each(|corner| corner.put(sink));
    }

    /// The next obstacles and corners of a payload, in these numbers; fails if the obstacles have another number of corners.
    pub(crate) fn take(
        fields: &mut Fields<'a>,
        [rows, corners]: [usize; 2],
    ) -> Result<Self, FaultKind> {
        let list = Self {
            source: Obstacles::Received {
                rows: List::take(fields, rows)?,
                corners: List::take(fields, corners)?,
            },
        };
        require(list.corner_count() == corners, FaultKind::Value)?;
        Ok(list)
    }
}

impl ObstacleRow {
    /// What is left of an obstacle without its corners.
    pub const fn of(obstacle: &ObstacleDescription<'_, f32>) -> Self {
        Self {
            corners: obstacle.vertices.len(),
            friction_static: obstacle.friction_static,
            friction_dynamic: obstacle.friction_dynamic,
            memory: obstacle.memory,
        }
    }
    /// The obstacle with these corners.
    pub const fn described<'a>(&self, vertices: &'a [[f32; 2]]) -> ObstacleDescription<'a, f32> {
        ObstacleDescription {
            vertices,
            friction_static: self.friction_static,
            friction_dynamic: self.friction_dynamic,
            memory: self.memory,
        }
    }
}

impl<'a> From<&'a [ObstacleDescription<'a, f32>]> for ObstacleList<'a> {
    fn from(obstacles: &'a [ObstacleDescription<'a, f32>]) -> Self {
        Self {
            source: Obstacles::Given(obstacles),
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
