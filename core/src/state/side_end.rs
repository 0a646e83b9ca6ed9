//! The end of a side of an obstacle or of the body (STATICS 12.4): the distance of a sliding contact from it, and where it ends a motion. A
//! contact is on its side until it is beyond the end by a touch, so that rounding does not pass it back and forth.

use super::segment::Segment;
use crate::balance_curve::Margin;
use crate::contact::Pair;
use crate::detect::Placed;
use crate::falls::Level;
use crate::geometry::Vec2;
use crate::moment::SecondHarmonic;
use crate::motion::Instant;
use crate::pivot::Pivot;
use crate::real::{Real, along};
use crate::thresholds::Thresholds;
use crate::verb::Trigger;
use crate::world::World;

/// The distance of a contact that slides along sign·t from the end of its side, and its rate of change.
pub(in crate::state) fn room_ahead<R: Real>(
    scene: &impl World<R>,
    body: &Instant<R>,
    (contact, sign): (Pair, R),
) -> Level<R> {
    let [low, high] = scene.reach(contact);
    let foot = body.foot(scene, contact);
    let room = if sign > R::ZERO {
        high - foot.value
    } else {
        foot.value - low
    };
    Level {
        value: room + R::TOUCH,
        slope: -along(sign, foot.slope),
        rounding: R::of_coordinates() * (R::ONE + foot.value.abs()),
    }
}

/// Ends a slip by `shift` along t where the contact leaves its side.
pub(in crate::state) fn stop_at_end<R: Real>(
    scene: &impl World<R>,
    segment: &mut Segment<R>,
    (pivot, shift): (&Pivot<R>, R),
) {
    let foot = Margin {
        start: R::ZERO,
        along: shift,
        turning: Vec2::ZERO,
        rounding: R::ZERO,
    };
    let placed = pivot.placed(scene);
    stop_at_end_of_slide(
        scene,
        segment,
        (&placed, pivot.contact),
        (&foot, R::ONE, shift.sign()),
    );
}

/// Ends a slide along sign·t where the contact leaves its side; `foot`: its displacement, times `per`.
pub(in crate::state) fn stop_at_end_of_slide<R: Real, H: SecondHarmonic<R>>(
    scene: &impl World<R>,
    segment: &mut Segment<R, H>,
    (placed, contact): (&Placed<R>, Pair),
    (foot, per, sign): (&Margin<R>, R, R),
) {
    let room = room_ahead(scene, &Instant::at_rest(*placed), (contact, sign));
    let ahead = Margin {
        start: room.value * per,
        rounding: room.rounding,
        ..foot.combine(-sign, *foot, R::ZERO)
    };
    segment.stop_at(&ahead, Trigger::Off { contact: 0, sign });
}
