//! The axes along which body and obstacle may be separated, the gaps along them, and the axis of the largest gap.

use super::super::Placed;
use super::{corners, ends, line_of, sides, together};
use crate::bounded::Sloped;
use crate::contact::{MAX_CONTACTS, Pair};
use crate::geometry::Vec2;
use crate::list::gather;
use crate::motion::Instant;
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::world::World;
use core::ops::Range;
use heapless::Vec;

/// A direction in which body and obstacle may be separated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Separation {
    /// The normal of this side of the obstacle.
    Side(u8),
    /// The normal of this side of the body.
    BodySide(u8),
    /// The direction in which a thin wall ends at this corner.
    End(u8),
    /// The direction in which a rod ends at this vertex.
    BodyEnd(u8),
}

/// All axes between the body and an obstacle.
pub(super) fn axes<R: Real, W: World<R>>(
    scene: &W,
    obstacle: usize,
) -> impl Iterator<Item = Separation> + use<R, W> {
    let own = corners(scene, obstacle);
    let body = scene.vertex_indices();
    (sides(own.clone()).map(Separation::Side))
        .chain(sides(body.clone()).map(Separation::BodySide))
        .chain(ends(own).map(Separation::End))
        .chain(ends(body).map(Separation::BodyEnd))
}

/// The features of the other shape that may be nearest along an axis: the vertices of the body, or the corners of the obstacle.
pub(super) fn features<R: Real, W: World<R>>(
    scene: &W,
    (obstacle, axis): (usize, Separation),
) -> Range<u8> {
    match axis {
        Separation::Side(_) | Separation::End(_) => scene.vertex_indices(),
        Separation::BodySide(_) | Separation::BodyEnd(_) => corners(scene, obstacle),
    }
}

/// Those whose gap may change because they are in no contact that lasts.
pub(super) fn moving<R: Real, W: World<R>>(
    scene: &W,
    (obstacle, axis): (usize, Separation),
    lasting: &[Pair],
) -> impl Iterator<Item = u8> {
    let line = match axis {
        Separation::Side(side) => line_of(scene, side),
        Separation::BodySide(_) | Separation::End(_) | Separation::BodyEnd(_) => 0,
    };
    features(scene, (obstacle, axis)).filter(move |&feature| {
        let pair = match axis {
            Separation::Side(_) => Pair {
                vertex: feature,
                surface: line,
            },
            Separation::BodySide(side) => Pair::of_corner(feature, side),
            Separation::End(_) | Separation::BodyEnd(_) => return true,
        };
        !lasts(scene, pair, lasting)
    })
}

/// Returns whether a contact is one of those that last, or a corner at the same place as one of these.
pub(super) fn lasts<R: Real, W: World<R>>(scene: &W, pair: Pair, lasting: &[Pair]) -> bool {
    let is_there = |other: &Pair| {
        other.is_corner()
            && other.body_side() == pair.body_side()
            && is_at(scene, other.surface, pair.surface)
    };
    lasting.contains(&pair) || pair.is_corner() && lasting.iter().any(is_there)
}

/// Returns whether two corners coincide.
pub(super) fn is_at<R: Real, W: World<R>>(scene: &W, corner: u8, other: u8) -> bool {
    let place = |corner: u8| scene.corner(corner).map(|corner| corner.place);
    place(corner)
        .zip(place(other))
        .is_some_and(|(a, b)| (a - b).length_bound() <= together())
}

/// The direction of an axis, from the obstacle to the body.
pub(super) fn direction<R: Real, W: World<R>>(
    scene: &W,
    placed: &Placed<R>,
    axis: Separation,
) -> Vec2<R> {
    let outward = |side: u8| {
        let normal = scene.body_normal(side);
        placed.orientation.rotation().apply(normal)
    };
    match axis {
        Separation::Side(side) => scene.surface(side).normal,
        Separation::End(corner) => scene.surface(corner).tangent,
        Separation::BodySide(side) => -outward(side),
        Separation::BodyEnd(vertex) => -outward(vertex).turned(),
    }
}

/// The side of an obstacle on which the body is, as a direction from the obstacle, from a contact that lasts or has just opened. A wall has
/// no inside in common with a rod or a point, so the gaps do not determine it.
pub(super) fn side_of<R: Real, W: World<R>>(
    scene: &W,
    placed: &Placed<R>,
    obstacle: usize,
    pair: Pair,
) -> Option<Vec2<R>> {
    let own = corners(scene, obstacle);
    let mut lines = own.clone().map(|corner| line_of(scene, corner));
    let surface = scene.face(pair, placed.orientation.rotation());
    if own.contains(&pair.surface) || !pair.is_corner() && lines.any(|line| line == pair.surface) {
        return Some(surface.normal);
    }
    // If the body is between the side of another obstacle and this obstacle, which leaves the end of that side in front of it, the body is
    // on that side.
    let along = placed
        .way_from_end(scene, pair)
        .filter(|_| !pair.is_corner())?;
    let point = placed.point + placed.arm_to(scene, pair);
    let beyond = |corner: u8| scene.corner(corner).map(|corner| corner.place - point);
    let is_here = (own.clone().filter_map(beyond)).any(|at| at.length_bound() <= placed.here());
    let mut ahead = own.filter_map(beyond);
    let is_between = is_here && ahead.any(|at| surface.normal.dot(at) > R::MICRO);
    is_between.then_some(along)
}

/// Returns whether an axis does not face away from where the body is.
pub(super) fn faces<R: Real>(direction: Vec2<R>, side: Vec2<R>) -> bool {
    direction.dot(side) >= -R::in_plane()
}

/// The side of an obstacle on which a body is that touches it along several axes.
#[derive(Clone, Copy)]
pub(super) struct Beside<'a, R> {
    /// The contacts that have just opened there.
    pub(super) left: &'a [Pair],
    /// The direction, from the obstacle, of the axis along which the body was last separated from it.
    pub(super) last: Option<Vec2<R>>,
    /// Gaps up to this are closed: a touch, and the distance by which a search may have gone beyond it.
    pub(super) near: R,
}

impl<R: Real> Beside<'_, R> {
    /// The side is not known.
    pub(super) const UNKNOWN: Self = Self {
        left: &[],
        last: None,
        near: R::TOUCH,
    };
}

/// An axis at a point of a motion: the distance of each feature of the other shape along it is level + d·x, where x is its position
/// relative to an origin in the frame of that shape.
struct Ruler<R> {
    level: R,
    direction: Vec2<R>,
    origin: Vec2<R>,
    /// The velocity along the axis of features at the origin.
    rate: R,
    /// The rate at which they turn relative to it.
    turn: R,
}

impl<R: Real> Ruler<R> {
    /// The ruler of an axis for the body at a point of a motion: gaps are positive where body and obstacle are separated (L).
    fn of<W: World<R>>(scene: &W, body: &Instant<R>, axis: Separation) -> Self {
        let placed = &body.placed;
        // To vertices.
        let from_obstacle = |normal: Vec2<R>, level: R| Self {
            level,
            direction: placed.orientation.rotation().undo(normal),
            origin: placed.body_point,
            rate: normal.dot(body.velocity),
            turn: body.turn,
        };
        // To corners.
        let from_body = |outward: Vec2<R>, vertex: u8| {
            let direction = placed.orientation.rotation().apply(outward);
            Self {
                level: -outward.dot(scene.vertex(vertex) - placed.body_point),
                direction,
                origin: placed.point,
                rate: -direction.dot(body.velocity),
                turn: -body.turn,
            }
        };
        match axis {
            Separation::Side(side) => {
                let line = line_of(scene, side);
                let surface = scene.surface(line);
                let level = if placed.on == Some(line) {
                    R::ZERO
                } else {
                    surface.normal.dot(placed.point) - surface.offset
                };
                from_obstacle(surface.normal, level)
            }
            Separation::End(corner) => {
                let away = scene.surface(corner).tangent;
                let place = scene.corner(corner).map_or(Vec2::ZERO, |c| c.place);
                from_obstacle(away, away.dot(placed.point - place))
            }
            Separation::BodySide(side) => from_body(scene.body_normal(side), side),
            Separation::BodyEnd(vertex) => from_body(-scene.body_normal(vertex).turned(), vertex),
        }
    }

    fn value(&self, place: Vec2<R>) -> R {
        self.level + self.direction.dot(place - self.origin)
    }

    fn off(&self, place: Vec2<R>) -> Sloped<R> {
        let from = place - self.origin;
        Sloped {
            value: self.level + self.direction.dot(from),
            slope: self.rate + self.direction.dot(from.turned()) * self.turn,
        }
    }
}

/// The position of a feature along an axis, in the frame of its shape.
fn place_of<R: Real, W: World<R>>(scene: &W, axis: Separation, feature: u8) -> Vec2<R> {
    match axis {
        Separation::Side(_) | Separation::End(_) => scene.vertex(feature),
        Separation::BodySide(_) | Separation::BodyEnd(_) => {
            (scene.corner(feature)).map_or(Vec2::ZERO, |corner| corner.place)
        }
    }
}

/// The distance of a feature along an axis.
pub(super) fn off<R: Real, W: World<R>>(
    scene: &W,
    body: &Instant<R>,
    axis: Separation,
    feature: u8,
) -> Sloped<R> {
    Ruler::of(scene, body, axis).off(place_of(scene, axis, feature))
}

/// Body and obstacle touch along this axis in two contacts: then they are separated, and other features in that line lie in it only by
/// rounding.
pub(super) fn is_flat_on<R: Real, W: World<R>>(
    scene: &W,
    placed: &Placed<R>,
    (obstacle, axis): (usize, Separation),
    lasting: &[Pair],
) -> bool {
    let own = corners(scene, obstacle);
    let is_along = |pair: &Pair| match axis {
        Separation::Side(side) => !pair.is_corner() && pair.surface == line_of(scene, side),
        Separation::BodySide(side) => {
            pair.is_corner() && pair.body_side() == side && own.contains(&pair.surface)
        }
        Separation::End(_) | Separation::BodyEnd(_) => false,
    };
    lasting.len() > 1
        && lasting.iter().filter(|pair| is_along(pair)).any(|&pair| {
            let mut others = lasting.iter().filter(|&&other| other != pair);
            others.any(|&other| placed.lie_in_line(scene, [pair, other]))
        })
}

/// The side of the body that lies in the line of two contacts.
pub(super) fn flat_side<R: Real, W: World<R>>(
    scene: &W,
    placed: &Placed<R>,
    lasting: &[Pair],
) -> Option<u8> {
    let (&first, others) = lasting.split_first()?;
    let mut others = others.iter().copied();
    let other = others.find(|&other| placed.lie_in_line(scene, [first, other]))?;
    if let Some(corner) = [first, other].into_iter().find(|pair| pair.is_corner()) {
        return Some(corner.body_side());
    }
    let rotation = placed.orientation.rotation();
    let normal = rotation.undo(scene.face(first, rotation).normal);
    let against = |side: u8| normal.dot(scene.body_normal(side));
    let [one, two] = [first, other].map(|pair| pair.vertex);
    Some(if against(one) < against(two) {
        one
    } else {
        two
    })
}

/// Returns whether a body that lies flat on two contacts lies over this obstacle as well, and touches it in their line: if it slides on
/// along that line, it does not reach the obstacle.
pub(super) fn lies_over<R: Real, W: World<R>>(
    scene: &W,
    placed: &Placed<R>,
    obstacle: usize,
    lasting: &[Pair],
) -> bool {
    flat_side(scene, placed, lasting).is_some_and(|side| {
        let body = Instant::at_rest(*placed);
        let gap = gap_along(scene, &body, (obstacle, Separation::BodySide(side)), &[]);
        gap.abs() <= R::TOUCH.doubled() && placed.separation(scene, obstacle) <= R::TOUCH.doubled()
    })
}

/// The least gap along an axis, except for contacts that last.
pub(super) fn gap_along<R: Real, W: World<R>>(
    scene: &W,
    body: &Instant<R>,
    (obstacle, axis): (usize, Separation),
    lasting: &[Pair],
) -> R {
    if is_flat_on(scene, &body.placed, (obstacle, axis), lasting) {
        return R::HUGE;
    }
    let ruler = Ruler::of(scene, body, axis);
    moving(scene, (obstacle, axis), lasting).fold(R::HUGE, |least, feature| {
        least.min(ruler.value(place_of(scene, axis, feature)))
    })
}

/// The least gap of an obstacle along an axis of the features that move, less the most by which a gap may change if its feature moves by the
/// given fraction of its distance from the placed point, or of a body size if that is more; `flat`: two of the contacts that last are collinear.
pub(super) fn gap_less<R: Real, W: World<R>>(
    scene: &W,
    placed: &Placed<R>,
    (obstacle, axis): (usize, Separation),
    ((lasting, flat), by): ((&[Pair], bool), R),
) -> R {
    let is_along = |pair: &Pair| match axis {
        Separation::Side(side) => !pair.is_corner() && pair.surface == line_of(scene, side),
        Separation::BodySide(side) => pair.is_corner() && pair.body_side() == side,
        Separation::End(_) | Separation::BodyEnd(_) => false,
    };
    // Most axes have no such contact.
    let any = lasting.iter().any(is_along);
    if any && flat && is_flat_on(scene, placed, (obstacle, axis), lasting) {
        return R::HUGE;
    }
    let ruler = Ruler::of(scene, &Instant::at_rest(*placed), axis);
    let of_corners = matches!(axis, Separation::BodySide(_) | Separation::BodyEnd(_));
    let mut least = R::HUGE;
    let mut look = |feature| {
        let from = place_of(scene, axis, feature) - ruler.origin;
        let mut far = R::ONE;
        if of_corners {
            far = far.max(from.x.abs() + from.y.abs());
        }
        least = least.min(ruler.level + ruler.direction.dot(from) - by * far);
    };
    if any {
        moving(scene, (obstacle, axis), lasting).for_each(&mut look);
    } else {
        features(scene, (obstacle, axis)).for_each(&mut look);
    }
    least
}

/// How far the body may move and turn until the least gap along an axis closes, except for contacts that last: along a side of the body,
/// which turns with it, the gap of a corner far from the placed point closes faster.
pub(super) fn room_along<R: Real, W: World<R>>(
    scene: &W,
    body: &Instant<R>,
    (obstacle, axis): (usize, Separation),
    lasting: &[Pair],
) -> R {
    if is_flat_on(scene, &body.placed, (obstacle, axis), lasting) {
        return R::HUGE;
    }
    let ruler = Ruler::of(scene, body, axis);
    moving(scene, (obstacle, axis), lasting).fold(R::HUGE, |least, feature| {
        let place = place_of(scene, axis, feature);
        let gap = ruler.value(place);
        let far = match axis {
            Separation::BodySide(_) | Separation::BodyEnd(_) => {
                (place - ruler.origin).length_bound()
            }
            Separation::Side(_) | Separation::End(_) => R::ONE,
        };
        least.min(if gap > R::ZERO && far > R::ONE {
            gap / far
        } else {
            gap
        })
    })
}

/// Returns whether the gap along an axis stays open between two points of a motion on which no second derivative changes its sign: it lies
/// above its chord, or above the tangents at both ends (STATICS 12.3).
pub(super) fn stays_open<R: Real, W: World<R>>(
    scene: &W,
    [from, to]: [&Instant<R>; 2],
    (obstacle, axis): (usize, Separation),
    (lasting, width): (&[Pair], R),
) -> bool {
    let [here, there] = [from, to].map(|body| Ruler::of(scene, body, axis));
    let rounding = from.placed.rounding().max(to.placed.rounding());
    moving(scene, (obstacle, axis), lasting).all(|feature| {
        let place = place_of(scene, axis, feature);
        let [a, b] = [here.off(place), there.off(place)];
        let is_flat_out = a.slope >= R::ZERO || b.slope <= R::ZERO;
        // Where the tangents are above zero at the opposite end.
        let is_steep_out =
            a.value + a.slope * width > rounding || b.value - b.slope * width > rounding;
        a.value > rounding && b.value > rounding && (is_flat_out || is_steep_out)
    })
}

/// How fast the gap along an axis opens where it is least, to within a touch, except for contacts that last.
pub(super) fn opening_along<R: Real, W: World<R>>(
    scene: &W,
    body: &Instant<R>,
    (obstacle, axis): (usize, Separation),
    (lasting, gap): (&[Pair], R),
) -> R {
    let ruler = Ruler::of(scene, body, axis);
    moving(scene, (obstacle, axis), lasting).fold(R::HUGE, |least, feature| {
        let off = ruler.off(place_of(scene, axis, feature));
        if off.value <= gap + R::TOUCH {
            least.min(off.slope)
        } else {
            least
        }
    })
}

/// The axis along which the body is farthest from an obstacle, and the gap along it; never one that faces away from the side on which a
/// contact that lasts places the body. If the body touches along several axes, as when it turns out of a flat contact, or as a point and a
/// wall do, which have no inside in common, the one that opens fastest on the body's side is taken.
pub(super) fn widest<R: Real, W: World<R>>(
    scene: &W,
    body: &Instant<R>,
    obstacle: usize,
    (lasting, beside): (&[Pair], Beside<'_, R>),
) -> (Option<Separation>, R) {
    let mut found = (None, R::LEAST);
    let mut opens = R::LEAST;
    if (corners(scene, obstacle).len(), scene.vertices().len()) == (1, 1) {
        // A point and a pin have no axis: they do not touch.
        return (None, R::HUGE);
    }
    // If one of the shapes has an inside, that determines the side: around an acute vertex the normal turns by more than a right angle.
    let is_flat = corners(scene, obstacle).len() <= 2 && scene.vertices().len() <= 2;
    let ways = |pairs: &[Pair]| -> Vec<Vec2<R>, MAX_CONTACTS> {
        let ways = pairs
            .iter()
            .filter_map(|&pair| side_of(scene, &body.placed, obstacle, pair));
        gather(ways)
    };
    let (of_lasting, of_left) = (ways(lasting), ways(beside.left));
    let all_face = |ways: &[Vec2<R>], way: Vec2<R>| ways.iter().all(|&side| faces(way, side));
    for axis in axes(scene, obstacle) {
        let way = direction(scene, &body.placed, axis);
        if !all_face(&of_lasting, way) {
            continue;
        }
        let gap = gap_along(scene, body, (obstacle, axis), lasting);
        let touches = gap.abs() <= beside.near;
        let is_beside = || beside.last.is_none_or(|last| faces(way, last));
        if touches && is_flat && !(all_face(&of_left, way) && is_beside()) {
            continue;
        }
        let rate = if touches {
            opening_along(scene, body, (obstacle, axis), (lasting, gap))
        } else {
            R::ZERO
        };
        let is_wider = if touches && found.1.abs() <= beside.near && rate != opens {
            rate > opens
        } else {
            gap > found.1
        };
        if is_wider {
            (found, opens) = ((Some(axis), gap), rate);
        }
    }
    found
}
