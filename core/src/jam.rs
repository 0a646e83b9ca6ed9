//! A jam: contacts bear a load, but only with a reaction beyond the limit (R43). What a contact bears within it is a triangle of wrenches,
//! what all bear the sum of these: a body whose faces are normal to two edges of the triangles.

use crate::cone::{ConeEdge, WrenchCone};
use crate::geometry::Wrench;
use crate::list::gather;
use crate::real::Real;
use crate::state::{Body, Freedom};
use crate::thresholds::Thresholds;
use crate::world::Statics;
use core::iter::from_fn;

impl<R: Real> WrenchCone<R> {
    /// The edges of one contact after the other.
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
    /// With the reactions of N = 1 along its edges.
    fn of_unit_normals(&self) -> Self {
        let edges = self.edges.iter().map(|&edge| ConeEdge {
            wrench: edge.wrench * (R::ONE / edge.cone.cos),
            ..edge
        });
        Self {
            edges: gather(edges),
        }
    }
    /// x·load and the most of x·w for all w that are borne within the limit, of edges with N = 1, for x and for -x; as soon as both are
    /// `enough`, no more is added.
    fn margins(&self, x: Wrench<R>, load: Wrench<R>, enough: R) -> [R; 2] {
        let along = x.dot(load);
        let [mut ahead, mut back] = [along, -along];
        for own in self.contacts() {
            let (mut least, mut most) = (R::ZERO, R::ZERO);
            for edge in own {
                let along = x.dot(edge.wrench);
                (least, most) = (least.min(along), most.max(along));
            }
            (ahead, back) = (ahead + most * R::limit(), back - least * R::limit());
            if ahead >= enough && back >= enough {
                break;
            }
        }
        [ahead, back]
    }
    /// Directions among which are the normals of all faces of what is borne: those to two of the sides, in a corner, whose contacts bear
    /// forces through one vertex, those to one.
    fn normals(&self, is_corner: bool, each: &mut dyn FnMut(Wrench<R>)) {
        for (i, a) in self.sides().enumerate() {
            if is_corner {
                each(Wrench {
                    force: a.force.turned(),
                    moment: R::ZERO,
                });
                continue;
            }
            for b in self.sides().skip(i.saturating_add(1)) {
                each(a.cross(b));
            }
        }
    }
    /// The change of a load, at most `most`, up to which it is borne with every N within the limit, as in (E18); negative if it is not. What
    /// `little` leaves of a load that is borne is none.
    fn within_limit(&self, is_corner: bool, load: Wrench<R>, little: R, most: R) -> R {
        let reactions = self.of_unit_normals();
        let mut least = most;
        self.normals(is_corner, &mut |x| {
            let size = x.size();
            if size <= R::in_plane() {
                return;
            }
            for margin in reactions.margins(x, load, least * size) {
                let is_none = margin.abs() <= little * (R::ONE + size);
                let margin = if is_none { R::ZERO } else { margin };
                least = least.min(margin / size);
            }
        });
        least
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The change of the load, at most `most`, before which the contacts are not jammed; none if they are. Contacts in one line have no load
    /// that they hold by their inner force.
    #[inline(never)]
    pub(crate) fn free_of_jam(&self, body: &Body<R>, most: R) -> Option<R> {
        let is_corner = match body.freedom() {
            Freedom::Fixed if !self.is_edge(&body.contacts) => false,
            Freedom::Turns if body.contacts.len() > 1 => true,
            Freedom::Free
            | Freedom::Turns
            | Freedom::Slides
            | Freedom::Together
            | Freedom::Fixed => return Some(most),
        };
        let (cone, load) = (self.cone(body), self.present_load(body));
        let change = cone.within_limit(is_corner, load, self.rounding(body), most);
        let is_within =
            change >= -R::of_release(load.size()) || self.bears_within_limit(body, load);
        is_within.then(|| change.max(R::ZERO))
    }
    /// The reactions that are reported are within the limit and leave no more of the load than a body at rest may: on the very edge of what is
    /// borne a face does not decide.
    fn bears_within_limit(&self, body: &Body<R>, load: Wrench<R>) -> bool {
        let (mut rest, mut sum) = (load, R::ZERO);
        for (contact, [n, t]) in body.contacts.iter().zip(self.fixed_shares(body)) {
            let frame = self.frame(contact, body.rotation, body.holding);
            rest = rest + Wrench::at(frame.r, frame.n * n + frame.t * t);
            sum = sum.max(n);
        }
        sum <= R::limit() && rest.size() <= self.left_at_rest(body) + R::of_balance(sum)
    }
}
