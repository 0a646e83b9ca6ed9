//! The first obstacle that a motion reaches, and the contact there.

use super::super::Placed;
use super::axes::{
    Beside, Separation, direction, faces, gap_along, is_at, is_flat_on, lies_over, moving, off,
    opening_along, stays_open, widest,
};
use super::tally::{Sizes, Tally};
use super::watched::Watch;
use super::{corners, line_of};
use crate::bounded::Sloped;
use crate::contact::{Pair, Pairs};
use crate::falls::{Level, MOST_FALLS, first_fall};
use crate::geometry::Vec2;
use crate::motion::Instant;
use crate::real::Real;
use crate::search::Found;
use crate::thresholds::Thresholds;
use crate::world::World;
use heapless::Vec;

/// Where a motion reaches an obstacle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reached<R> {
    pub(crate) x: R,
    pub(crate) contact: Pair,
    /// The search ended here: nothing is reached up to this point.
    pub(crate) unsure: bool,
}

/// The features that a motion may reach.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Among {
    /// Obstacles only: the half-planes are examined elsewhere.
    Obstacles,
    /// Half-planes as well.
    All,
}

/// What is known about a motion before it begins.
#[derive(Clone, Copy)]
pub(crate) struct Known<'a> {
    /// The contacts that last.
    pub(crate) lasting: &'a [Pair],
    /// Those that have just opened.
    pub(crate) left: &'a [Pair],
    /// Axes along which the body was last separated from obstacles.
    pub(crate) watch: Watch,
}

impl<'a> Known<'a> {
    /// With contacts that last, and nothing else known.
    pub(crate) fn of(lasting: &'a [Pair]) -> Self {
        Self {
            lasting,
            left: &[],
            watch: Watch::NONE,
        }
    }
}

/// On a piece of a motion in which the body turns by no more than this (rad), a gap lies above its chord or above its tangents.
fn longest_turn<R: Real>() -> R {
    R::HALF.halved().halved()
}

/// At most this many axes are watched one after the other on a piece of a motion.
const MOST_AXES: usize = 12;

/// The displacement on a piece is at most two to this power times its width; otherwise the point is found less accurately.
const MOST_DOUBLINGS: usize = 24;

/// This many pieces of a motion are examined before the search gives up.
const MOST_PIECES: usize = 400;

/// The reached contact is looked for within a touch, and then repeatedly within this many times the distance: with few digits one point of
/// a motion may be far from the next.
const WIDENINGS: i32 = 4;
const WIDENING: i32 = 8;

/// The largest gap at which the reached contact is looked for (L).
fn farthest_look<R: Real>() -> R {
    (1..WIDENINGS).fold(R::TOUCH, |near, _| near * R::from_int(WIDENING))
}

/// A point of a motion, and the body there.
type Place<R> = (R, Instant<R>);

/// Obstacles that a body touches, and on which side.
type Nearby<R> = Vec<(usize, Vec2<R>), 8>;

/// What happens to an obstacle on a piece of a motion.
enum Closing<R> {
    Nothing,
    /// It is touched at the end without being reached, with the body on this side.
    Near(Vec2<R>),
    /// It is reached: where, and in which contact; no contact if the watched axis changes too often.
    At(Place<R>, Option<Pair>),
}

/// The first obstacle or half-plane that a motion from 0 to `end` reaches, except for contacts that last, and the work of finding it, in
/// units of work. `at`: the body at a point of the motion, which costs `place` units.
pub(crate) fn first_reached<R: Real, W: World<R>>(
    scene: &W,
    (known, among): (Known<'_>, Among),
    end: R,
    (at, place): (&dyn Fn(R) -> Instant<R>, u32),
) -> (Option<Reached<R>>, u32) {
    let tally = Tally::of_search(Sizes::of(scene), place);
    let at = |x: R| {
        tally.place();
        at(x)
    };
    (
        first_in_pieces(scene, (known, among), end, (&at, &tally)),
        tally.units(),
    )
}

/// The first obstacle or half-plane that a motion from 0 to `end` reaches, except for contacts that last, found piece by piece. `at`: the
/// body at a point of the motion.
fn first_in_pieces<R: Real, W: World<R>>(
    scene: &W,
    (known, among): (Known<'_>, Among),
    end: R,
    (at, tally): (&dyn Fn(R) -> Instant<R>, &Tally),
) -> Option<Reached<R>> {
    let Known {
        lasting,
        left,
        watch,
    } = known;
    let start = at(R::ZERO);
    let (mut x, mut here) = (R::ZERO, start);
    let mut step = end;
    // The obstacles that the body touches there, and on which side.
    let mut near: Nearby<R> = Nearby::new();
    for piece in 0..MOST_PIECES {
        // If it touched an obstacle, the side would not be known any more.
        if piece > 0 && near.is_empty() && tally.is_enough() {
            break;
        }
        let mut to = end.min(x + step);
        let mut there = at(to);
        for _ in 0..64 {
            let turn = (there.placed.orientation.angle()).minus(here.placed.orientation.angle());
            let shift = (there.placed.point - here.placed.point).length_bound();
            if turn.abs() * R::ONE.max(shift) <= longest_turn() {
                break;
            }
            to = x + (to - x).halved();
            there = at(to);
        }
        step = (to - x).doubled();
        let mut first = None;
        if among == Among::All {
            let surfaces = scene.surface_indices();
            let pairs = surfaces.flat_map(|surface| {
                (scene.vertex_indices()).map(move |vertex| Pair { vertex, surface })
            });
            for pair in pairs.filter(|pair| !lasting.contains(pair)) {
                let gap = |body: &Instant<R>| body.gap(scene, pair);
                if let Some(end) = falls([(x, here), (to, there)], (at, tally), gap) {
                    (to, there) = end;
                    first = Some((end.0, Some(pair)));
                }
            }
        }
        let way = (there.placed.point - here.placed.point)
            .length_bound()
            .doubled();
        let reach = here.placed.radius(scene, None) * (R::ONE + longest_turn()) + way;
        let mut now_near: Nearby<R> = Nearby::new();
        for (obstacle, round) in scene.rounds().iter().enumerate() {
            tally.spend(1);
            let is_over =
                || start.turn == R::ZERO && lies_over(scene, &start.placed, obstacle, lasting);
            if here.placed.apart(round) > reach || is_over() {
                continue;
            }
            let piece = [(x, here), (to, there)];
            if is_apart(scene, (obstacle, watch), piece, (lasting, tally)) {
                continue;
            }
            let before = (&start.placed, lasting);
            let last = near.iter().find(|(index, _)| *index == obstacle);
            let beside = Beside {
                left: if x == R::ZERO { left } else { &[] },
                last: last.map(|&(_, last)| last),
                near: near_at(&here.placed),
            };
            match closes(scene, obstacle, (before, beside), piece, (at, tally)) {
                Closing::Nothing => {}
                Closing::Near(side) => {
                    // If there are more than fit, the side is not known for the rest.
                    let _ = now_near.push((obstacle, side));
                }
                Closing::At(end, contact) => {
                    (to, there) = end;
                    first = Some((to, contact));
                }
            }
        }
        near = now_near;
        if let Some((x, contact)) = first {
            return Some(Reached {
                x,
                contact: contact.unwrap_or_default(),
                // Nothing is reached yet, but the watched axis changes too often there.
                unsure: contact.is_none(),
            });
        }
        (x, here) = (to, there);
        if x >= end {
            return None;
        }
    }
    Some(Reached {
        x,
        contact: Pair::default(),
        unsure: true,
    })
}

/// Where a gap closes on a piece of a motion.
fn falls<R: Real>(
    [from, to]: [Place<R>; 2],
    (at, tally): (&dyn Fn(R) -> Instant<R>, &Tally),
    gap: impl Fn(&Instant<R>) -> Sloped<R>,
) -> Option<Place<R>> {
    let width = to.0 - from.0;
    // A point is found to within a rounding of the displacement there, however fast the body moves.
    let way = (to.1.placed.point - from.1.placed.point).length_bound();
    let (mut end, mut unit) = (width, R::ONE);
    for _ in 0..MOST_DOUBLINGS {
        if end.doubled() <= way {
            (end, unit) = (end.doubled(), unit.doubled());
        }
    }
    let found = first_fall((end, end), MOST_FALLS, |x| {
        tally.look();
        let body = if x == R::ZERO {
            from.1
        } else if x == end {
            to.1
        } else {
            at(from.0 + x / unit)
        };
        let gap = gap(&body);
        let gap = Sloped {
            slope: gap.slope / unit,
            ..gap
        };
        [Some(Level::new(gap, body.placed.rounding()))]
    });
    match found {
        Found::Nothing { .. } => None,
        Found::Zero { x, .. } | Found::Unsure { x, .. } => {
            let x = from.0 + x / unit;
            Some((x, at(x)))
        }
    }
}

/// Gaps up to this are closed: a touch, or the rounding of a position this far from the origin.
fn near_at<R: Real>(placed: &Placed<R>) -> R {
    R::TOUCH.max(placed.rounding())
}

/// Returns whether the watched axis of an obstacle separates the body from it on a whole piece of a motion, and by more than a touch at the
/// end.
fn is_apart<R: Real, W: World<R>>(
    scene: &W,
    (obstacle, watch): (usize, Watch),
    [from, to]: [Place<R>; 2],
    (lasting, tally): (&[Pair], &Tally),
) -> bool {
    let Some(axis) = watch.axis_of(scene, obstacle) else {
        return false;
    };
    tally.spend(Sizes::of_one(scene, obstacle).axis());
    let ends = [&from.1, &to.1];
    stays_open(scene, ends, (obstacle, axis), (lasting, to.0 - from.0))
        && gap_along(scene, &to.1, (obstacle, axis), lasting) > near_at(&to.1.placed)
}

/// Where an obstacle is reached on a piece of a motion.
fn closes<R: Real, W: World<R>>(
    scene: &W,
    obstacle: usize,
    ((before, lasting), mut beside): ((&Placed<R>, &[Pair]), Beside<'_, R>),
    [mut from, to]: [Place<R>; 2],
    (at, tally): (&dyn Fn(R) -> Instant<R>, &Tally),
) -> Closing<R> {
    let sizes = Sizes::of_one(scene, obstacle);
    // Not reached along an axis.
    let after = |body: &Instant<R>, axis| {
        if gap_along(scene, body, (obstacle, axis), lasting) <= near_at(&body.placed) {
            Closing::Near(direction(scene, &body.placed, axis))
        } else {
            Closing::Nothing
        }
    };
    for _ in 0..MOST_AXES {
        tally.spend(sizes.axes());
        let (Some(axis), _) = widest(scene, &from.1, obstacle, (lasting, beside)) else {
            return Closing::Nothing;
        };
        if is_flat_on(scene, &from.1.placed, (obstacle, axis), lasting) {
            return Closing::Nothing;
        }
        tally.spend(sizes.axis());
        let ends = [&from.1, &to.1];
        if stays_open(scene, ends, (obstacle, axis), (lasting, to.0 - from.0)) {
            return after(&to.1, axis);
        }
        let mut end = to;
        let mut found = false;
        for feature in moving(scene, (obstacle, axis), lasting) {
            let gap = |body: &Instant<R>| off(scene, body, axis, feature);
            if let Some(first) = falls([from, end], (at, tally), gap) {
                end = first;
                found = true;
            }
        }
        if !found {
            return after(&to.1, axis);
        }
        let side = direction(scene, &end.1.placed, axis);
        beside = Beside {
            left: if end.0 > R::ZERO { &[] } else { beside.left },
            last: Some(side),
            near: near_at(&end.1.placed)
                - gap_along(scene, &end.1, (obstacle, axis), lasting).min(R::ZERO),
        };
        tally.spend(sizes.axes());
        let (_, gap) = widest(scene, &end.1, obstacle, (lasting, beside));
        if gap < -farthest_look::<R>() {
            let gap = |place: &Place<R>| {
                tally.spend(sizes.axes());
                widest(scene, &place.1, obstacle, (lasting, beside)).1
            };
            return Closing::At(before_leap([from, end], at, gap), None);
        }
        let touched = |tally| {
            let places = (before, &end.1);
            touched(scene, (lasting, beside), obstacle, (places, tally))
        };
        if gap <= beside.near
            && let Some(contact) = touched(tally)
        {
            return Closing::At(end, Some(contact));
        }
        // Separated along another axis, or in touch where it already is.
        from = end;
    }
    Closing::At(from, None)
}

/// The last point before one at which the body has leapt into an obstacle: to the digits of the number type the motion has no point in
/// between.
fn before_leap<R: Real>(
    [mut from, mut to]: [Place<R>; 2],
    at: &dyn Fn(R) -> Instant<R>,
    gap: impl Fn(&Place<R>) -> R,
) -> Place<R> {
    for _ in 0..MOST_DOUBLINGS {
        let x = from.0 + (to.0 - from.0).halved();
        if x <= from.0 || x >= to.0 {
            break;
        }
        let place = (x, at(x));
        if gap(&place) < -R::TOUCH {
            to = place;
        } else {
            from = place;
        }
    }
    from
}

/// The contact with an obstacle that a motion has reached: of the contacts that close there, the one whose gap was the largest before, and
/// of those whose gaps were already closed, the one whose gap closes most slowly. If the obstacle's own corner is covered, it is one of
/// another obstacle.
fn touched<R: Real, W: World<R>>(
    scene: &W,
    (lasting, beside): (&[Pair], Beside<'_, R>),
    obstacle: usize,
    ((before, body), tally): ((&Placed<R>, &Instant<R>), &Tally),
) -> Option<Pair> {
    let now = &body.placed;
    let own = corners(scene, obstacle);
    let is_own = |pair: Pair| {
        let is_side = |corner: u8| !pair.is_corner() && line_of(scene, corner) == pair.surface;
        // If a corner of the obstacle is covered, the corner that covers it touches instead.
        let is_in_place = |corner: u8| pair.is_corner() && is_at(scene, corner, pair.surface);
        own.contains(&pair.surface)
            || own
                .clone()
                .any(|corner| is_side(corner) || is_in_place(corner))
    };
    // If a body lies flat on a side, its vertex moves with the whole side.
    let closing = |pair: Pair| {
        let axis = if pair.is_corner() {
            Separation::BodySide(pair.body_side())
        } else {
            Separation::Side(pair.surface)
        };
        let gap = gap_along(scene, body, (obstacle, axis), lasting);
        opening_along(scene, body, (obstacle, axis), (lasting, gap))
    };
    let is_new = |pair: Pair| {
        // An overlap this short goes on as its other end.
        let closed = before.gap(scene, pair) > R::TOUCH;
        let is_taken = |&other: &Pair| {
            let is_here = now.are_at_one_place(scene, [other, pair]);
            let replaces = closed && is_here && scene.obstacle_of(other) == scene.obstacle_of(pair);
            !replaces && now.are_one(scene, [other, pair])
        };
        !lasting.contains(&pair) && !lasting.iter().any(is_taken)
    };
    let mut near = beside.near;
    for _ in 0..WIDENINGS {
        tally.spend(now.work_of_touching(scene, near));
        let mut list = Pairs::new();
        now.touching_obstacles(scene, near, &mut list);
        let mut latest: Option<((bool, R, R, R), Pair)> = None;
        for pair in list.iter().copied().filter(|&pair| is_new(pair)) {
            let normal = scene.face(pair, now.orientation.rotation()).normal;
            let is_beside = is_own(pair) && beside.last.is_none_or(|side| faces(normal, side));
            let gap = before.gap(scene, pair).max(R::met_before());
            let slope = body.gap(scene, pair).slope;
            let order = (is_beside, gap, closing(pair), slope);
            if latest.is_none_or(|(most, _)| order > most) {
                latest = Some((order, pair));
            }
        }
        if let Some((_, pair)) = latest {
            return Some(pair);
        }
        near = near * R::from_int(WIDENING);
    }
    None
}
