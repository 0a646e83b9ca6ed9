//! A jam: contacts bear a load, but only with a reaction beyond the limit (R43). What a contact bears within it is a triangle of wrenches,
//! what all bear the sum of these: a body whose faces are normal to two edges of the triangles.

use crate::cone::{ConeEdge, WrenchCone};
use crate::contact::MAX_CONTACTS;
use crate::geometry::Wrench;
use crate::list::fill;
use crate::real::Real;
use crate::state::{Body, Freedom};
use crate::thresholds::Thresholds;
use crate::world::Statics;
use core::iter::from_fn;
use heapless::Vec;

/// The sides of the triangles: three of each contact.
type Sides<R> = Vec<Wrench<R>, { 3 * MAX_CONTACTS }>;
/// The corners of the triangles but for zero.
type Corners<R> = Vec<[Wrench<R>; 2], MAX_CONTACTS>;

/// What is borne within the limit, as a body in the space of wrenches.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    Solid,
    /// Without friction a triangle is a segment, and the sum of segments may lie in one plane.
    Flat,
    /// In the plane of forces.
    Corner,
}

impl<R: Real> WrenchCone<R> {
    /// The edges of one contact after the other. `chunk_by` has a panic in it that is not optimised away.
    fn contacts(&self) -> impl Iterator<Item = &[ConeEdge<R>]> {
        let mut rest = self.edges.as_slice();
        from_fn(move || {
            let contact = rest.first()?.contact;
            let count = rest.iter().take_while(|edge| edge.contact == contact);
            let (own, others) = rest.split_at_checked(count.count())?;
            rest = others;
            Some(own)
        })
    }
    /// The directions of all edges of the triangles.
    fn sides(&self) -> impl Iterator<Item = Wrench<R>> + '_ {
        self.contacts().flat_map(|own| {
            let edges = own.iter().map(|edge| edge.wrench);
            let across = own.iter().zip(own.iter().skip(1));
            edges.chain(across.map(|(a, b)| b.wrench + a.wrench * -R::ONE))
        })
    }
    /// The corners of the triangles: the reactions with N = 1 along both edges of each contact, without friction the same twice.
    fn corners(&self) -> impl Iterator<Item = [Wrench<R>; 2]> + '_ {
        let unit = |edge: &ConeEdge<R>| edge.wrench * (R::ONE / edge.cone.cos);
        let both = move |own: &[ConeEdge<R>]| Some([unit(own.first()?), unit(own.last()?)]);
        self.contacts().filter_map(both)
    }
    /// A load that is borne, and any that differs by at most `most`, is borne within the limit, by one direction x that has all edges ahead
    /// of it: no force along an edge is negative, so each is at most the part of the load along x over the least x·edge. x is the mean of the
    /// edges; where those of one side outnumber another one, it leans to the edge that is least ahead.
    fn is_surely_within_limit(&self, is_corner: bool, load: Wrench<R>, most: R) -> bool {
        let part = R::ONE / R::from_int(self.edges.len() as i32);
        let sum = (self.edges.iter()).fold(Wrench::ZERO, |sum, edge| sum + edge.wrench * part);
        // In a corner the contacts bear forces alone.
        let direction = |x: Wrench<R>| Wrench {
            moment: if is_corner { R::ZERO } else { x.moment },
            ..x
        };
        let bounds = |x: Wrench<R>, least: R| {
            least > R::ZERO && most * x.size() - x.dot(load) < least * R::limit()
        };
        let mean = direction(sum);
        let (least, last) = self.least_along(mean);
        if bounds(mean, least) {
            return true;
        }
        let leaning = direction(mean + last * part);
        bounds(leaning, self.least_along(leaning).0)
    }
    /// The least x·edge, and its edge.
    #[inline(never)]
    fn least_along(&self, x: Wrench<R>) -> (R, Wrench<R>) {
        let (mut least, mut last) = (R::HUGE, Wrench::ZERO);
        for edge in &self.edges {
            let along = x.dot(edge.wrench);
            if along < least {
                (least, last) = (along, edge.wrench);
            }
        }
        (least, last)
    }
    /// The change of a load, at most `most`, up to which it is borne with every N within the limit, as in (E18); negative if it is not. What
    /// `little` leaves of a load that is borne is none.
    fn within_limit(&self, is_corner: bool, load: Wrench<R>, little: R, most: R) -> R {
        let (mut sides, mut corners) = (Sides::new(), Corners::new());
        fill(&mut sides, self.sides());
        fill(&mut corners, self.corners());
        let shape = if is_corner {
            Shape::Corner
        } else if sides.len() == corners.len() {
            Shape::Flat
        } else {
            Shape::Solid
        };
        let mut least = most;
        normals(&sides, shape, &mut |x| {
            let size = x.size();
            if size <= R::in_plane() {
                return;
            }
            for margin in margins(&corners, x, load, least * size) {
                let is_none = margin.abs() <= little * (R::ONE + size);
                let margin = if is_none { R::ZERO } else { margin };
                least = least.min(margin / size);
            }
        });
        least
    }
}

/// x·load and the most of x·w for all w that are borne within the limit, for x and for -x; as soon as both are `enough`, no more is added.
fn margins<R: Real>(
    corners: &[[Wrench<R>; 2]],
    x: Wrench<R>,
    load: Wrench<R>,
    enough: R,
) -> [R; 2] {
    let along = x.dot(load);
    let [mut ahead, mut back] = [along, -along];
    for corners in corners {
        let [a, b] = corners.map(|corner| x.dot(corner));
        let (least, most) = (R::ZERO.min(a).min(b), R::ZERO.max(a).max(b));
        (ahead, back) = (ahead + most * R::limit(), back - least * R::limit());
        if ahead >= enough && back >= enough {
            break;
        }
    }
    [ahead, back]
}

/// Directions among which are the normals of all faces of what is borne: those to two of the sides; if all may lie in one plane, also those
/// in it to one; in a corner, whose contacts bear forces through one vertex, those to one.
fn normals<R: Real>(sides: &[Wrench<R>], shape: Shape, each: &mut dyn FnMut(Wrench<R>)) {
    for (i, &a) in sides.iter().enumerate() {
        if shape == Shape::Corner {
            each(Wrench {
                force: a.force.turned(),
                moment: R::ZERO,
            });
            continue;
        }
        for &b in sides.iter().skip(i.saturating_add(1)) {
            let normal = a.cross(b);
            each(normal);
            if shape == Shape::Flat {
                each(normal.cross(a));
                each(normal.cross(b));
            }
        }
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The change of the load, at most `most`, before which the contacts are not jammed; none if they are. Contacts in one line have no load
    /// that they hold by their inner force.
    #[inline(never)]
    pub(crate) fn free_of_jam(&self, body: &Body<R>, most: R) -> Option<R> {
        if !self.has_wedges() {
            return Some(most);
        }
        let is_corner = match self.freedom(body) {
            Freedom::Fixed if !self.is_edge(&body.contacts) => false,
            Freedom::Turns if body.contacts.len() > 1 => true,
            Freedom::Free
            | Freedom::Turns
            | Freedom::Slides
            | Freedom::Together
            | Freedom::Fixed => return Some(most),
        };
        let (mut cone, load) = (WrenchCone::new(), self.present_load(body));
        self.cone(body, &mut cone);
        if cone.is_surely_within_limit(is_corner, load, most) {
            return Some(most);
        }
        let change = cone.within_limit(is_corner, load, self.rounding(body), most);
        let is_within =
            change >= -R::of_release(load.size()) || self.bears_within_limit(body, load);
        is_within.then(|| change.max(R::ZERO))
    }
    /// The reactions that are reported are within the limit and leave no more of the load than a body at rest may: on the very edge of what is
    /// borne a face does not decide.
    fn bears_within_limit(&self, body: &Body<R>, load: Wrench<R>) -> bool {
        let (mut rest, mut sum) = (load, R::ZERO);
        let shares = self.fixed_shares(body);
        for (contact, &[n, t]) in body.contacts.iter().zip(&shares) {
            let frame = self.frame(contact, body.rotation, body.holding);
            rest = rest + Wrench::at(frame.r, frame.n * n + frame.t * t);
            sum = sum.max(n);
        }
        sum <= R::limit() && rest.size() <= self.left_at_rest(body) + R::of_balance(sum)
    }
}
