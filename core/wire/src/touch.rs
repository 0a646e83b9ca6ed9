//! What touches what, on the wire (FRAME 5.2).

use crate::fault::FaultKind;
use crate::field::{Field, Fields, Sink, require};
use stiction_core::Touch;

/// Stands for a half-plane in the place of an obstacle.
const HALF_PLANE: u8 = u8::MAX;
/// Marks a side of the body that a corner of an obstacle touches.
const BODY_SIDE: u8 = 0x80;

/// Vertex or side of the body; obstacle; which of its sides or corners, or which half-plane.
impl Field for Touch {
    const BYTES: usize = 3;
    fn put(&self, sink: &mut impl Sink) {
        let (mark, of_body, obstacle, index) = match *self {
            Self::Surface { vertex, surface } => (0, vertex, None, surface),
            Self::Side {
                vertex,
                obstacle,
                side,
            } => (0, vertex, Some(obstacle), side),
            Self::Corner {
                obstacle,
                corner,
                body_side,
            } => (BODY_SIDE, body_side, Some(obstacle), corner),
        };
        let of_body = u8::try_from(of_body).ok().filter(|&i| i < BODY_SIDE);
        let obstacle = match obstacle {
            Some(obstacle) => u8::try_from(obstacle).ok().filter(|&i| i < HALF_PLANE),
            None => Some(HALF_PLANE),
        };
        match (of_body, obstacle) {
            (Some(of_body), Some(obstacle)) => {
                sink.put(&[of_body | mark, obstacle]);
                index.put(sink);
            }
            (None, _) | (_, None) => sink.refuse(),
        }
    }
    fn get(fields: &mut Fields<'_>) -> Result<Self, FaultKind> {
        let [of_body, obstacle] = fields.take();
        let index: usize = fields.get()?;
        let (is_corner, of_body) = (of_body & BODY_SIDE != 0, usize::from(of_body & !BODY_SIDE));
        let is_half_plane = obstacle == HALF_PLANE;
        let obstacle = usize::from(obstacle);
        // A half-plane has no corner.
        require(!(is_corner && is_half_plane), FaultKind::Value)?;
        Ok(if is_half_plane {
            Self::Surface {
                vertex: of_body,
                surface: index,
            }
        } else if is_corner {
            Self::Corner {
                obstacle,
                corner: index,
                body_side: of_body,
            }
        } else {
            Self::Side {
                vertex: of_body,
                obstacle,
                side: index,
            }
        })
    }
}
