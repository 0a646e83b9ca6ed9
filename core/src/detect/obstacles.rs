//! Obstacles with corners (STATICS 12): how far the body is from them, which pairs touch, and the first one that a motion reaches. Body
//! and obstacle are apart by the largest gap along an axis: an outward normal of either, or the direction in which a thin wall or a
//! rod ends. On a motion one axis is watched for each obstacle, as long as its gap is positive.

use super::Placed;
use crate::bounded::Sloped;
use crate::contact::{Pair, Pairs};
use crate::falls::{Level, first_fall};
use crate::geometry::Vec2;
use crate::motion::Instant;
use crate::obstacle::{Corner, Round, corners_of};
use crate::real::Real;
use crate::search::Found;
use crate::thresholds::Thresholds;
use crate::world::World;
use core::ops::Range;
use heapless::Vec;

/// A direction in which body and obstacle may be apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Axis {
    /// The normal of this side of the obstacle.
    Side(u8),
    /// The normal of this side of the body.
    BodySide(u8),
    /// The direction in which a thin wall ends at this corner.
    End(u8),
    /// The direction in which a rod ends at this vertex.
    BodyEnd(u8),
}

/// Where a motion reaches an obstacle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reached<R> {
    pub(crate) x: R,
    pub(crate) contact: Pair,
    /// The search came no farther: up to there nothing is reached.
    pub(crate) unsure: bool,
}

/// On a piece of a motion on which the body turns by no more than this (rad), a gap lies above its chord or above its tangents.
fn longest_turn<R: Real>() -> R {
    R::HALF.halved().halved()
}

/// So many axes are watched one after the other on a piece of a motion.
const MOST_AXES: usize = 12;
/// The way of a piece is no more than two to this times its width, or it is found less well.
const MOST_DOUBLINGS: usize = 24;
/// So many pieces of a motion are looked at before it is taken for as long as that.
const MOST_PIECES: usize = 400;

/// Two contacts of one obstacle that are closer than this are one (L).
pub(crate) fn together<R: Real>() -> R {
    R::MICRO
}

/// The index of the first side in line with that of a corner.
fn line_of<R: Real>(scene: &impl World<R>, corner: u8) -> u8 {
    scene.corner(corner).map_or(corner, |corner| corner.line)
}

/// The indices of the corners of an obstacle, as surfaces.
fn corners<R: Real>(scene: &impl World<R>, obstacle: usize) -> Range<u8> {
    let first = scene.surface_indices().end;
    let own = corners_of(scene.firsts(), scene.corners().len(), obstacle);
    first.saturating_add(own.start)..first.saturating_add(own.end)
}

/// The next or previous one of a range, round and round.
fn beside(range: &Range<u8>, index: u8, next: bool) -> u8 {
    let last = range.end.saturating_sub(1);
    match (next, index) {
        (true, i) if i >= last => range.start,
        (true, i) => i.saturating_add(1),
        (false, i) if i <= range.start => last,
        (false, i) => i.saturating_sub(1),
    }
}

/// The sides of a shape of so many vertices: a point has none.
fn sides(vertices: Range<u8>) -> Range<u8> {
    if vertices.len() > 1 { vertices } else { 0..0 }
}

/// Both axes along which a segment ends; other shapes have none.
fn ends(vertices: Range<u8>) -> Range<u8> {
    if vertices.len() == 2 { vertices } else { 0..0 }
}

/// All axes between the body and an obstacle.
fn axes<R: Real, W: World<R>>(
    scene: &W,
    obstacle: usize,
) -> impl Iterator<Item = Axis> + use<R, W> {
    let own = corners(scene, obstacle);
    let body = scene.vertex_indices();
    (sides(own.clone()).map(Axis::Side))
        .chain(sides(body.clone()).map(Axis::BodySide))
        .chain(ends(own).map(Axis::End))
        .chain(ends(body).map(Axis::BodyEnd))
}

/// What of the other shape may be nearest along an axis: the vertices of the body, or the corners of the obstacle.
fn features<R: Real, W: World<R>>(scene: &W, (obstacle, axis): (usize, Axis)) -> Range<u8> {
    match axis {
        Axis::Side(_) | Axis::End(_) => scene.vertex_indices(),
        Axis::BodySide(_) | Axis::BodyEnd(_) => corners(scene, obstacle),
    }
}

/// The contact of a feature along an axis, if it is one.
fn contact<R: Real, W: World<R>>(scene: &W, axis: Axis, feature: u8) -> Option<Pair> {
    match axis {
        Axis::Side(side) => Some(Pair {
            vertex: feature,
            surface: line_of(scene, side),
        }),
        Axis::BodySide(side) => Some(Pair::of_corner(feature, side)),
        Axis::End(_) | Axis::BodyEnd(_) => None,
    }
}

/// A contact is one of those that last, or a corner at the place of one of these.
fn lasts<R: Real, W: World<R>>(scene: &W, pair: Pair, lasting: &[Pair]) -> bool {
    let place = |pair: Pair| scene.corner(pair.surface).map(|corner| corner.place);
    let is_at = |other: &Pair| {
        other.is_corner()
            && other.body_side() == pair.body_side()
            && place(*other)
                .zip(place(pair))
                .is_some_and(|(a, b)| (a - b).length_bound() <= together())
    };
    lasting.contains(&pair) || pair.is_corner() && lasting.iter().any(is_at)
}

/// The direction of an axis, from the obstacle to the body.
fn direction<R: Real, W: World<R>>(scene: &W, placed: &Placed<R>, axis: Axis) -> Vec2<R> {
    let outward = |side: u8| {
        let normal = scene.body_normal(side);
        placed.orientation.rotation().apply(normal)
    };
    match axis {
        Axis::Side(side) => scene.surface(side).normal,
        Axis::End(corner) => scene.surface(corner).tangent,
        Axis::BodySide(side) => -outward(side),
        Axis::BodyEnd(vertex) => -outward(vertex).turned(),
    }
}

/// A contact that lasts, or has just opened, says on which side of an obstacle the body is: in which direction from it. Of a wall and a
/// rod or a point, which have no inside together, the gaps do not tell.
fn side_of<R: Real, W: World<R>>(
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
    // Between the side of another obstacle and this one, which leaves its end in front of it, the body is on that side.
    let along = placed
        .way_from_end(scene, pair)
        .filter(|_| !pair.is_corner())?;
    let point = placed.point + placed.arm_to(scene, pair);
    let beyond = |corner: u8| scene.corner(corner).map(|corner| corner.place - point);
    let is_here = (own.clone().filter_map(beyond)).any(|at| at.length_bound() <= together());
    let mut ahead = own.filter_map(beyond);
    let is_between = is_here && ahead.any(|at| surface.normal.dot(at) > R::MICRO);
    is_between.then_some(along)
}

/// An axis does not face away from where the body is.
fn faces<R: Real>(direction: Vec2<R>, side: Vec2<R>) -> bool {
    direction.dot(side) >= -R::in_plane()
}

/// On which side of an obstacle a body is that touches it along several axes.
#[derive(Clone, Copy)]
struct Beside<'a, R> {
    /// The contacts that have just opened there.
    left: &'a [Pair],
    /// The direction from the obstacle of the axis along which it was apart last.
    last: Option<Vec2<R>>,
    /// Gaps up to this are closed: a touch, and what a search may have gone beyond it.
    near: R,
}

impl<R: Real> Beside<'_, R> {
    /// It is not known.
    const UNKNOWN: Self = Self {
        left: &[],
        last: None,
        near: R::TOUCH,
    };
}

/// A side that leaves a place at which its obstacle has a corner.
#[derive(Clone, Copy)]
struct Leaving<R> {
    direction: Vec2<R>,
    /// Its outward normal; of a thin wall, which has two, none.
    normal: Vec2<R>,
}

/// The sides of obstacles but two that leave a place.
fn leaving<R: Real, W: World<R>>(
    scene: &W,
    place: Vec2<R>,
    but: [u8; 2],
) -> impl Iterator<Item = Leaving<R>> + Clone + '_ {
    let first = scene.surface_indices().end;
    let others = (first..).zip(scene.corners()).filter(move |(_, corner)| {
        let is_here = (corner.place - place).length_bound() <= together();
        is_here && !but.contains(&corner.obstacle)
    });
    others.flat_map(move |(index, corner)| {
        let own = corners(scene, usize::from(corner.obstacle));
        let (has_sides, has_inside) = (own.len() > 1, own.len() > 2);
        let [after, before] = [index, beside(&own, index, false)].map(|side| scene.surface(side));
        let both = [
            (-after.tangent, after.normal),
            (before.tangent, before.normal),
        ];
        let both = both.map(|(direction, normal)| Leaving {
            direction,
            normal: if has_inside { normal } else { Vec2::ZERO },
        });
        both.into_iter().filter(move |_| has_sides)
    })
}

/// How far a feature is off along an axis.
fn off<R: Real, W: World<R>>(scene: &W, body: &Instant<R>, axis: Axis, feature: u8) -> Sloped<R> {
    if let Some(pair) = contact(scene, axis, feature) {
        return body.gap(scene, pair);
    }
    let place = |corner: u8| scene.corner(corner).map_or(Vec2::ZERO, |c| c.place);
    let placed = &body.placed;
    match axis {
        Axis::End(corner) => {
            let away = scene.surface(corner).tangent;
            let arm = placed.arm(scene, feature);
            Sloped {
                value: away.dot(placed.point + arm - place(corner)),
                slope: away.dot(body.velocity_at(arm)),
            }
        }
        Axis::BodyEnd(vertex) => {
            let outward = scene.body_normal(vertex);
            let away = -placed.orientation.rotation().apply(outward.turned());
            let arm = placed.arm(scene, vertex);
            let beyond = place(feature) - (placed.point + arm);
            Sloped {
                value: away.dot(beyond),
                slope: away.turned().dot(beyond) * body.turn - away.dot(body.velocity_at(arm)),
            }
        }
        Axis::Side(_) | Axis::BodySide(_) => Sloped {
            value: R::HUGE,
            slope: R::ZERO,
        },
    }
}

/// Body and obstacle touch along this axis in two contacts: then they are apart, and what else is in that line is so by rounding only.
fn is_flat_on<R: Real, W: World<R>>(
    scene: &W,
    placed: &Placed<R>,
    (obstacle, axis): (usize, Axis),
    lasting: &[Pair],
) -> bool {
    let own = corners(scene, obstacle);
    let is_along = |pair: &Pair| match axis {
        Axis::Side(side) => !pair.is_corner() && pair.surface == line_of(scene, side),
        Axis::BodySide(side) => {
            pair.is_corner() && pair.body_side() == side && own.contains(&pair.surface)
        }
        Axis::End(_) | Axis::BodyEnd(_) => false,
    };
    lasting.len() > 1
        && lasting.iter().filter(|pair| is_along(pair)).any(|&pair| {
            let mut others = lasting.iter().filter(|&&other| other != pair);
            others.any(|&other| scene.lie_in_line([pair, other], placed))
        })
}

/// The side of the body that lies in the line of two contacts.
fn flat_side<R: Real, W: World<R>>(scene: &W, placed: &Placed<R>, lasting: &[Pair]) -> Option<u8> {
    let (&first, others) = lasting.split_first()?;
    let mut others = others.iter().copied();
    let other = others.find(|&other| scene.lie_in_line([first, other], placed))?;
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

/// A body that lies flat on two contacts lies over this obstacle as well, and touches it in their line: sliding on in that line it does
/// not reach it.
fn lies_over<R: Real, W: World<R>>(
    scene: &W,
    placed: &Placed<R>,
    obstacle: usize,
    lasting: &[Pair],
) -> bool {
    flat_side(scene, placed, lasting).is_some_and(|side| {
        let body = Instant::at_rest(*placed);
        let gap = gap_along(scene, &body, (obstacle, Axis::BodySide(side)), &[]);
        gap.abs() <= R::TOUCH.doubled() && placed.separation(scene, obstacle) <= R::TOUCH.doubled()
    })
}

/// The least gap along an axis, but for contacts that last.
fn gap_along<R: Real, W: World<R>>(
    scene: &W,
    body: &Instant<R>,
    (obstacle, axis): (usize, Axis),
    lasting: &[Pair],
) -> R {
    if is_flat_on(scene, &body.placed, (obstacle, axis), lasting) {
        return R::HUGE;
    }
    let others = features(scene, (obstacle, axis)).filter(|&feature| {
        contact(scene, axis, feature).is_none_or(|pair| !lasts(scene, pair, lasting))
    });
    others.fold(R::HUGE, |least, feature| {
        least.min(off(scene, body, axis, feature).value)
    })
}

/// How far the body may go and turn until the least gap along an axis closes, but for contacts that last: along a side of the body, which
/// turns with it, the gap of a corner that is far from the placed point closes faster.
fn room_along<R: Real, W: World<R>>(
    scene: &W,
    body: &Instant<R>,
    (obstacle, axis): (usize, Axis),
    lasting: &[Pair],
) -> R {
    if is_flat_on(scene, &body.placed, (obstacle, axis), lasting) {
        return R::HUGE;
    }
    let others = features(scene, (obstacle, axis)).filter(|&feature| {
        contact(scene, axis, feature).is_none_or(|pair| !lasts(scene, pair, lasting))
    });
    others.fold(R::HUGE, |least, feature| {
        let gap = off(scene, body, axis, feature).value;
        let place = match axis {
            Axis::BodySide(_) | Axis::BodyEnd(_) => scene.corner(feature).map(|c| c.place),
            Axis::Side(_) | Axis::End(_) => None,
        };
        let far = place.map_or(R::ONE, |place| (place - body.placed.point).length_bound());
        least.min(if gap > R::ZERO && far > R::ONE {
            gap / far
        } else {
            gap
        })
    })
}

/// How fast the gap along an axis opens where it is the least, to what counts as a touch, but for contacts that last.
fn opening_along<R: Real, W: World<R>>(
    scene: &W,
    body: &Instant<R>,
    (obstacle, axis): (usize, Axis),
    (lasting, gap): (&[Pair], R),
) -> R {
    let others = features(scene, (obstacle, axis)).filter(|&feature| {
        contact(scene, axis, feature).is_none_or(|pair| !lasts(scene, pair, lasting))
    });
    others.fold(R::HUGE, |least, feature| {
        let off = off(scene, body, axis, feature);
        if off.value <= gap + R::TOUCH {
            least.min(off.slope)
        } else {
            least
        }
    })
}

/// The axis along which the body is farthest from an obstacle, and the gap along it: none that faces away from where a contact that lasts
/// has it. Of several along which it touches, as a body that turns out of a flat contact, or a point and a wall which have no inside
/// together, the one that opens fastest of those on the side where it is.
fn widest<R: Real, W: World<R>>(
    scene: &W,
    body: &Instant<R>,
    obstacle: usize,
    (lasting, beside): (&[Pair], Beside<'_, R>),
) -> (Option<Axis>, R) {
    let mut found = (None, R::LEAST);
    let mut opens = R::LEAST;
    if (corners(scene, obstacle).len(), scene.vertices().len()) == (1, 1) {
        // A point and a pin have no axis: they do not touch.
        return (None, R::HUGE);
    }
    let all_face = |pairs: &[Pair], way: Vec2<R>| {
        let mut sides = pairs
            .iter()
            .map(|&pair| side_of(scene, &body.placed, obstacle, pair));
        sides.all(|side| side.is_none_or(|side| faces(way, side)))
    };
    for axis in axes(scene, obstacle) {
        let way = direction(scene, &body.placed, axis);
        if !all_face(lasting, way) {
            continue;
        }
        let gap = gap_along(scene, body, (obstacle, axis), lasting);
        let touches = gap.abs() <= beside.near;
        let is_beside = || beside.last.is_none_or(|last| faces(way, last));
        if touches && !(all_face(beside.left, way) && is_beside()) {
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

impl<R: Real> Placed<R> {
    /// The rounding of a gap to an obstacle near the body.
    pub(super) fn rounding(&self) -> R {
        R::of_coordinates() * (R::TWO + self.point.length_bound())
    }

    /// No obstacle is reached, but by contacts that last, where the placed point goes no farther than this and the body turns about it by
    /// no more, together; less what counts as a touch and the rounding.
    pub(crate) fn room_among<W: World<R>>(&self, scene: &W, lasting: &[Pair]) -> R {
        let body = Instant::at_rest(*self);
        let radius = self.radius(scene, None);
        let mut least = R::HUGE;
        for (obstacle, round) in scene.rounds().iter().enumerate() {
            let apart = self.apart(round) - radius;
            if apart > R::ONE {
                least = least.min(apart);
                continue;
            }
            if lies_over(scene, self, obstacle, lasting) {
                continue;
            }
            let along = |axis| room_along(scene, &body, (obstacle, axis), lasting);
            // A point and a pin have no axis.
            let room = axes(scene, obstacle).map(along).reduce(R::max);
            let room = room.unwrap_or(R::HUGE);
            least = least.min(room - self.rounding().doubled() - R::TOUCH);
        }
        least
    }

    /// A lower bound of the distance of the point from a circle.
    fn apart(&self, round: &Round<R>) -> R {
        let between = self.point - round.center;
        between.x.abs().max(between.y.abs()) - round.radius
    }

    /// How far the body and an obstacle are apart, or minus how deep one is in the other.
    pub(crate) fn separation<W: World<R>>(&self, scene: &W, obstacle: usize) -> R {
        widest(
            scene,
            &Instant::at_rest(*self),
            obstacle,
            (&[], Beside::UNKNOWN),
        )
        .1
    }

    /// The body is deeper in an obstacle than this.
    pub(crate) fn is_in_obstacle<W: World<R>>(&self, scene: &W, depth: R) -> bool {
        (0..scene.firsts().len()).any(|obstacle| self.separation(scene, obstacle) < -depth)
    }

    /// How far a contact is beyond the end of its side; negative on it.
    pub(crate) fn beyond<W: World<R>>(&self, scene: &W, contact: Pair) -> R {
        let [low, high] = scene.reach(contact);
        let foot = self.foot(scene, contact);
        (low - foot).max(foot - high)
    }

    /// The sides next to a vertex or corner lead away from the side that it touches, or no deeper than this.
    fn supports<W: World<R>>(&self, scene: &W, contact: Pair, depth: R) -> bool {
        let normal = scene.face(contact, self.orientation.rotation()).normal;
        if contact.is_corner() {
            let Some(corner) = scene.corner(contact.surface) else {
                return false;
            };
            let own = corners(scene, usize::from(corner.obstacle));
            [true, false].into_iter().all(|next| {
                let other = scene.corner(beside(&own, contact.surface, next));
                other.is_none_or(|other| normal.dot(other.place - corner.place) <= depth)
            })
        } else {
            let arm = self.arm(scene, contact.vertex);
            let others = scene.neighbours(contact.vertex).into_iter();
            let mut others = others.map(|other| self.arm(scene, other));
            others.all(|other| normal.dot(other - arm) >= -depth)
        }
    }

    /// Where corners of several obstacles meet, the body is in front of the side that it touches there, and no other obstacle in between; and
    /// a side of the body has all of them behind.
    fn meets<W: World<R>>(&self, scene: &W, contact: Pair) -> bool {
        let own = scene.corner(contact.surface).map(|corner| corner.obstacle);
        let arm = self.arm_to(scene, contact);
        let point = self.point + arm;
        let surface = scene.face(contact, self.orientation.rotation());
        let leaving = own
            .into_iter()
            .flat_map(|own| leaving(scene, point, [own; 2]));
        if contact.is_corner() {
            return leaving
                .clone()
                .all(|side| surface.normal.dot(side.direction) <= R::MICRO);
        }
        // Of a rod it is not known on which side of it what lies flat on a side in between is.
        let flat = if scene.vertices().len() > 2 {
            R::MICRO
        } else {
            -R::MICRO
        };
        // Seen from a way along the side, nothing is in front of the body.
        let is_in_front = |along: Vec2<R>| {
            let angle = |side: Vec2<R>| surface.normal.dot(side).atan2(along.dot(side));
            let body = scene.neighbours(contact.vertex).into_iter();
            let body = body.filter(|&other| other != contact.vertex);
            let body = body.map(|other| angle(self.arm(scene, other) - arm));
            let nearest = body.reduce(R::min);
            leaving.clone().all(|side| {
                let rises = surface.normal.dot(side.direction);
                let is_ahead = rises > R::MICRO;
                // The side of another obstacle lies on this one.
                let is_shut = rises.abs() <= R::MICRO
                    && along.dot(side.direction) > R::ZERO
                    && surface.normal.dot(side.normal) < R::ZERO;
                let is_in_front = |nearest| angle(side.direction) > nearest + flat;
                !is_shut && (!is_ahead || nearest.is_none_or(is_in_front))
            })
        };
        // At an end of the side there is only the way back.
        let [low, high] = scene.reach(contact);
        let foot = self.foot(scene, contact);
        let (to_low, to_high) = (foot - low, high - foot);
        let least = together::<R>().min(to_low.max(to_high));
        let ways = [(to_high, surface.tangent), (to_low, -surface.tangent)];
        let mut ways = ways.into_iter().filter(|&(room, _)| room >= least);
        ways.any(|(_, along)| is_in_front(along))
    }

    /// All contacts with obstacles whose gap is below `tolerance`, in the order of obstacles, vertices first.
    pub(super) fn touching_obstacles<W: World<R>>(
        &self,
        scene: &W,
        tolerance: R,
        list: &mut Pairs,
    ) {
        let radius = self.radius(scene, None) + tolerance;
        for (obstacle, round) in scene.rounds().iter().enumerate() {
            if self.apart(round) > radius || self.separation(scene, obstacle) > tolerance {
                continue;
            }
            let own = corners(scene, obstacle);
            let vertices = sides(own.clone()).flat_map(|side| {
                let surface = line_of(scene, side);
                scene
                    .vertex_indices()
                    .map(move |vertex| Pair { vertex, surface })
            });
            let is_bare = |&corner: &u8| scene.corner(corner).is_some_and(|c| !c.covered);
            let corners = own.filter(is_bare).flat_map(|corner| {
                sides(scene.vertex_indices()).map(move |side| Pair::of_corner(corner, side))
            });
            let pairs = vertices.chain(corners).filter(|&pair| {
                self.gap(scene, pair).abs() <= tolerance
                    && self.beyond(scene, pair) <= tolerance
                    && self.supports(scene, pair, tolerance)
                    && self.meets(scene, pair)
            });
            for pair in pairs {
                if !list.contains(&pair) {
                    // More than there is room for is not counted.
                    let _ = list.push(pair);
                }
            }
        }
    }

    /// Where a contact is at the end of its side, the body that turns about it lies flat beyond that end and touches nothing more: there
    /// the normal begins to turn, with the body or with it no more (STATICS 12.4).
    pub(crate) fn tips<W: World<R>>(&self, scene: &W, contact: Pair) -> [Option<Tip>; 2] {
        let [low, high] = scene.reach(contact);
        let foot = self.foot(scene, contact);
        let (to_low, to_high) = (foot - low, high - foot);
        if to_low > together() && to_high > together() {
            return [None, None];
        }
        let surface = scene.face(contact, self.orientation.rotation());
        let is_high = to_high < to_low;
        let arm = self.arm_to(scene, contact);
        // Beyond the end, as a vertex and as a corner see it.
        let off = if is_high == contact.is_corner() {
            -surface.tangent
        } else {
            surface.tangent
        };
        if contact.is_corner() {
            let obstacle = scene.corner(contact.surface).map(|corner| corner.obstacle);
            let own = corners(scene, usize::from(obstacle.unwrap_or_default()));
            let side = contact.body_side();
            let [after, _] = scene.neighbours(side);
            let vertex = if is_high { side } else { after };
            [true, false].map(|ahead| {
                let other = beside(&own, contact.surface, ahead);
                let neighbour = Pair::of_corner(other, side);
                let line = if ahead { contact.surface } else { other };
                let surface = line_of(scene, line);
                let is_off = off.dot(self.arm_to(scene, neighbour) - arm) > R::ZERO;
                (own.len() > 1 && is_off).then_some(Tip {
                    neighbour,
                    next: Pair { vertex, surface },
                })
            })
        } else {
            let is_here = |corner: &Corner<R>| {
                let apart = corner.place - (self.point + arm);
                !corner.covered && apart.length_bound() <= together()
            };
            let first = scene.surface_indices().end;
            let mut here = (first..)
                .zip(scene.corners())
                .filter(|(_, corner)| is_here(corner));
            let corner = here.next().map(|(corner, _)| corner);
            let [after, before] = scene.neighbours(contact.vertex);
            [(after, contact.vertex), (before, before)].map(|(other, side)| {
                let neighbour = Pair {
                    vertex: other,
                    ..contact
                };
                let is_off = off.dot(self.arm_to(scene, neighbour) - arm) > R::ZERO;
                let next = Pair::of_corner(corner?, side);
                (other != contact.vertex && is_off).then_some(Tip { neighbour, next })
            })
        }
    }

    /// The contact that comes next where a body has turned to the end of what supports one.
    pub(crate) fn next_at_tip<W: World<R>>(&self, scene: &W, contact: Pair) -> Option<Pair> {
        let tips = self.tips(scene, contact).into_iter().flatten();
        let gap = |tip: &Tip| self.gap(scene, tip.neighbour);
        let next = tips.reduce(|least, tip| if gap(&tip) < gap(&least) { tip } else { least });
        next.map(|tip| tip.next)
    }

    /// The contact at the place of one that has left its side along sign·t whose normal comes next as the normal turns towards the slide.
    pub(crate) fn next_contact<W: World<R>>(
        &self,
        scene: &W,
        (left, sign): (Pair, R),
        contacts: &[Pair],
    ) -> Option<Pair> {
        let rotation = self.orientation.rotation();
        let surface = scene.face(left, rotation);
        let (normal, ahead) = (surface.normal, surface.tangent * sign);
        let turn = |pair: Pair| {
            let next = scene.face(pair, rotation).normal;
            next.dot(ahead).atan2(next.dot(normal))
        };
        // It has gone beyond the end by a touch.
        let near = together::<R>() + R::TOUCH;
        let mut list = Pairs::new();
        self.touching_obstacles(scene, near, &mut list);
        let mut found: Option<(R, Pair)> = None;
        for pair in list {
            let apart = self.arm_to(scene, pair) - self.arm_to(scene, left);
            let obstacle = |pair: Pair| scene.corner(pair.surface).map(|corner| corner.obstacle);
            let least = if obstacle(pair) == obstacle(left) {
                R::in_plane()
            } else {
                -R::in_plane()
            };
            let turn = turn(pair);
            let is_here = apart.length_bound() <= near && !contacts.contains(&pair);
            if is_here && turn > least && found.is_none_or(|(first, _)| turn < first) {
                found = Some((turn, pair));
            }
        }
        found.map(|(_, pair)| pair)
    }

    /// Where an edge that slides along sign·t ends once one of its contacts has left its side: at the farthest in line with what lasts
    /// that does not leave its side as well.
    pub(crate) fn next_end<W: World<R>>(
        &self,
        scene: &W,
        (left, sign): (Pair, R),
        lasting: &[Pair],
    ) -> Option<Pair> {
        let &kept = lasting.first()?;
        let tangent = scene.face(kept, self.orientation.rotation()).tangent;
        let along = |pair: Pair| tangent.dot(self.arm_to(scene, pair) - self.arm_to(scene, kept));
        let way = along(left).sign();
        let mut list = Pairs::new();
        self.touching_obstacles(scene, together(), &mut list);
        let is_end = |&pair: &Pair| {
            let [low, high] = scene.reach(pair);
            let foot = self.foot(scene, pair);
            let ahead = if sign < R::ZERO {
                foot - low
            } else {
                high - foot
            };
            let differs = pair != left && pair != kept;
            differs && ahead > together() && scene.lie_in_line([kept, pair], self)
        };
        let ends = list.iter().copied().filter(is_end);
        let mut found: Option<(R, Pair)> = None;
        for pair in ends {
            let far = along(pair) * way;
            if far > together() && found.is_none_or(|(farthest, _)| far > farthest) {
                found = Some((far, pair));
            }
        }
        found.map(|(_, pair)| pair)
    }

    /// Of two contacts with obstacles only one can be: of one obstacle, at one place or facing away from each other, as convex shapes touch
    /// in one line at most; of two obstacles, where their corners meet in a tip, or as sides that look to
    /// either side of a bent wall.
    pub(crate) fn are_one<W: World<R>>(&self, scene: &W, [a, b]: [Pair; 2]) -> bool {
        let obstacle = |pair: Pair| scene.corner(pair.surface).map(|corner| corner.obstacle);
        let (Some(of_a), Some(of_b)) = (obstacle(a), obstacle(b)) else {
            return false;
        };
        let [first, second] = [a, b].map(|pair| scene.face(pair, self.orientation.rotation()));
        let is_here = self.are_at_one_place(scene, [a, b]);
        if of_a == of_b {
            let apart = self.arm_to(scene, b) - self.arm_to(scene, a);
            // By the heights: the tilt of what touches flat, but for a touch at either end, is more over a short side.
            let is_off = |normal: Vec2<R>| normal.dot(apart).abs() > R::from_int(4) * R::MICRO;
            let faces_away = first.normal.dot(second.normal) <= R::ZERO;
            return is_here || faces_away || is_off(first.normal) || is_off(second.normal);
        }
        if !is_here || a.is_corner() || b.is_corner() {
            return is_here;
        }
        let (Some(along_a), Some(along_b)) =
            (self.way_from_end(scene, a), self.way_from_end(scene, b))
        else {
            return false;
        };
        // Sides that end at one place bound what is free there where each is in front of the other, and nothing else in between.
        let point = self.point + self.arm_to(scene, a);
        let is_between = |side: Vec2<R>| {
            let angle = |side: Vec2<R>| first.normal.dot(side).atan2(along_a.dot(side));
            first.normal.dot(side) > R::MICRO && angle(side) + R::MICRO < angle(along_b)
        };
        along_a.dot(second.normal) < -R::MICRO
            || along_b.dot(first.normal) < -R::MICRO
            || leaving(scene, point, [of_a, of_b]).any(|side| is_between(side.direction))
    }

    /// The direction in which the side of a contact goes on from its end, if it is there.
    fn way_from_end<W: World<R>>(&self, scene: &W, contact: Pair) -> Option<Vec2<R>> {
        let tangent = scene.face(contact, self.orientation.rotation()).tangent;
        let [low, high] = scene.reach(contact);
        let foot = self.foot(scene, contact);
        let along = if foot - low < high - foot {
            tangent
        } else {
            -tangent
        };
        (self.beyond(scene, contact) > -together::<R>()).then_some(along)
    }

    fn are_at_one_place<W: World<R>>(&self, scene: &W, [a, b]: [Pair; 2]) -> bool {
        let apart = self.arm_to(scene, a) - self.arm_to(scene, b);
        apart.length_bound() <= together()
    }

    /// Of contacts in one line the outermost two.
    pub(crate) fn outermost<W: World<R>>(&self, scene: &W, contacts: &Pairs) -> Pairs {
        let is_inner = |&pair: &Pair| {
            let tangent = scene.face(pair, self.orientation.rotation()).tangent;
            let arm = self.arm_to(scene, pair);
            let in_line = |&&other: &&Pair| other != pair && scene.lie_in_line([pair, other], self);
            let along = |other: &Pair| tangent.dot(self.arm_to(scene, *other) - arm);
            let others = || contacts.iter().filter(in_line).map(along);
            others().any(|x| x > R::ZERO) && others().any(|x| x < R::ZERO)
        };
        contacts
            .iter()
            .copied()
            .filter(|pair| !is_inner(pair))
            .collect()
    }
}

/// What a motion may reach.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Among {
    /// Obstacles alone: the half-planes are looked at elsewhere.
    Obstacles,
    /// Half-planes, too.
    All,
}

/// What is known of a motion before it begins.
#[derive(Clone, Copy)]
pub(crate) struct Known<'a> {
    /// The contacts that last.
    pub(crate) lasting: &'a [Pair],
    /// Those that have just opened.
    pub(crate) left: &'a [Pair],
}

impl<'a> Known<'a> {
    /// Of contacts that last.
    pub(crate) fn of(lasting: &'a [Pair]) -> Self {
        Self { lasting, left: &[] }
    }
}

/// A vertex and a corner at one place: what supports their contact, and what it becomes where that ends.
pub(crate) struct Tip {
    /// The contact that lies flat there and reaches no farther: of a neighbour of the vertex, or of the corner.
    pub(crate) neighbour: Pair,
    /// The contact at the same place whose normal comes next.
    pub(crate) next: Pair,
}

/// The first obstacle or half-plane that a motion from 0 to `end` reaches, but for contacts that last. `at`: the body at a place of the
/// motion.
pub(crate) fn first_reached<R: Real, W: World<R>>(
    scene: &W,
    (known, among): (Known<'_>, Among),
    end: R,
    at: &dyn Fn(R) -> Instant<R>,
) -> Option<Reached<R>> {
    let Known { lasting, left } = known;
    let start = at(R::ZERO);
    let (mut x, mut here) = (R::ZERO, start);
    let mut step = end;
    // The obstacles that it touches there, and on which side.
    let mut near: Nearby<R> = Nearby::new();
    for _ in 0..MOST_PIECES {
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
                if let Some(end) = falls([(x, here), (to, there)], at, gap) {
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
            let is_over =
                || start.turn == R::ZERO && lies_over(scene, &start.placed, obstacle, lasting);
            if here.placed.apart(round) > reach || is_over() {
                continue;
            }
            let piece = [(x, here), (to, there)];
            let before = (&start.placed, lasting);
            let last = near.iter().find(|(index, _)| *index == obstacle);
            let beside = Beside {
                left: if x == R::ZERO { left } else { &[] },
                last: last.map(|&(_, last)| last),
                near: R::TOUCH,
            };
            match closes(scene, obstacle, (before, beside), piece, at) {
                Closing::Nothing => {}
                Closing::Near(side) => {
                    // Of more than there is room for it is not known.
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
                // Nothing is reached yet, but what is watched there changes too often.
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

/// A place of a motion, and the body there.
type Place<R> = (R, Instant<R>);

/// Obstacles that a body touches, and on which side.
type Nearby<R> = Vec<(usize, Vec2<R>), 8>;

/// What happens with an obstacle on a piece of a motion.
enum Closing<R> {
    Nothing,
    /// It is touched in the end where it is not reached, with the body on this side.
    Near(Vec2<R>),
    /// It is reached: where, and in which contact; no contact where what is watched changes too often.
    At(Place<R>, Option<Pair>),
}

/// Where a gap closes on a piece of a motion.
fn falls<R: Real>(
    [from, to]: [Place<R>; 2],
    at: &dyn Fn(R) -> Instant<R>,
    gap: impl Fn(&Instant<R>) -> Sloped<R>,
) -> Option<Place<R>> {
    let width = to.0 - from.0;
    // A place is found to a rounding of the way there, however fast the body goes.
    let way = (to.1.placed.point - from.1.placed.point).length_bound();
    let (mut end, mut unit) = (width, R::ONE);
    for _ in 0..MOST_DOUBLINGS {
        if end.doubled() <= way {
            (end, unit) = (end.doubled(), unit.doubled());
        }
    }
    let found = first_fall((end, end), |x| {
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

/// Where an obstacle is reached on a piece of a motion.
fn closes<R: Real, W: World<R>>(
    scene: &W,
    obstacle: usize,
    ((before, lasting), mut beside): ((&Placed<R>, &[Pair]), Beside<'_, R>),
    [mut from, to]: [Place<R>; 2],
    at: &dyn Fn(R) -> Instant<R>,
) -> Closing<R> {
    for _ in 0..MOST_AXES {
        let (Some(axis), _) = widest(scene, &from.1, obstacle, (lasting, beside)) else {
            return Closing::Nothing;
        };
        if is_flat_on(scene, &from.1.placed, (obstacle, axis), lasting) {
            return Closing::Nothing;
        }
        let mut end = to;
        let mut found = false;
        for feature in features(scene, (obstacle, axis)) {
            if contact(scene, axis, feature).is_some_and(|pair| lasts(scene, pair, lasting)) {
                continue;
            }
            let gap = |body: &Instant<R>| off(scene, body, axis, feature);
            if let Some(first) = falls([from, end], at, gap) {
                end = first;
                found = true;
            }
        }
        let side = direction(scene, &end.1.placed, axis);
        if !found {
            let gap = gap_along(scene, &end.1, (obstacle, axis), lasting);
            return if gap <= R::TOUCH {
                Closing::Near(side)
            } else {
                Closing::Nothing
            };
        }
        beside = Beside {
            left: if end.0 > R::ZERO { &[] } else { beside.left },
            last: Some(side),
            near: R::TOUCH - gap_along(scene, &end.1, (obstacle, axis), lasting).min(R::ZERO),
        };
        let (_, gap) = widest(scene, &end.1, obstacle, (lasting, beside));
        if gap <= beside.near
            && let Some(contact) =
                touched(scene, lasting, (obstacle, side), (before, &end.1.placed))
        {
            return Closing::At(end, Some(contact));
        }
        // It is apart along another axis, or touches where it does already.
        from = end;
    }
    Closing::At(from, None)
}

/// The contact with an obstacle that a motion has reached: of those that close there the one whose gap was the largest before. Where the
/// obstacle's own corner is covered, it is one of another obstacle.
fn touched<R: Real, W: World<R>>(
    scene: &W,
    lasting: &[Pair],
    (obstacle, side): (usize, Vec2<R>),
    (before, now): (&Placed<R>, &Placed<R>),
) -> Option<Pair> {
    let own = corners(scene, obstacle);
    let is_own = |pair: Pair| {
        let side = |corner: u8| !pair.is_corner() && line_of(scene, corner) == pair.surface;
        own.contains(&pair.surface) || own.clone().any(side)
    };
    let owner = |pair: Pair| scene.corner(pair.surface).map(|corner| corner.obstacle);
    let is_new = |pair: Pair| {
        // An overlap that short goes on as its other end.
        let closed = before.gap(scene, pair) > R::TOUCH;
        let is_taken = |&other: &Pair| {
            let is_here = now.are_at_one_place(scene, [other, pair]);
            let replaces = closed && is_here && owner(other) == owner(pair);
            !replaces && now.are_one(scene, [other, pair])
        };
        !lasting.contains(&pair) && !lasting.iter().any(is_taken)
    };
    let mut near = R::TOUCH;
    for _ in 0..4 {
        let mut list = Pairs::new();
        now.touching_obstacles(scene, near, &mut list);
        let mut latest: Option<(bool, R, Pair)> = None;
        for pair in list.into_iter().filter(|&pair| is_new(pair)) {
            let normal = scene.face(pair, now.orientation.rotation()).normal;
            let is_beside = is_own(pair) && faces(normal, side);
            let this = (is_beside, before.gap(scene, pair), pair);
            if latest.is_none_or(|latest| (this.0, this.1) > (latest.0, latest.1)) {
                latest = Some(this);
            }
        }
        if let Some((.., pair)) = latest {
            return Some(pair);
        }
        near = near * R::from_int(8);
    }
    None
}

#[cfg(test)]
mod tests;
