//! A jam: contacts bear a load, but only with a reaction beyond the limit (R43). What a contact bears within it is a triangle of wrenches,
//! what all bear the sum of these: a body whose faces are normal to two edges of the triangles.

use crate::cone::{ConeEdge, WrenchCone};
use crate::geometry::Wrench;
use crate::real::Real;
use crate::state::{Body, Freedom};
use crate::thresholds::Thresholds;
use crate::world::Statics;
use core::iter::from_fn;

impl<R: Real> WrenchCone<R> {
    /// The edges of one contact after the other.
    fn contacts(&self) -> impl Iterator<Item = &[ConeEdge<R>]> {
        let mut rest = self.edges();
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
    /// The most of x·w for all w that are borne within the limit.
    fn most_along(&self, x: Wrench<R>) -> R {
        let of_contact = self.contacts().map(|own| {
            let all = own.iter().map(|edge| x.dot(edge.wrench) / edge.cone.cos);
            all.fold(R::ZERO, R::max)
        });
        of_contact.fold(R::ZERO, |sum, most| sum + most) * R::limit()
    }
    /// The change of a load up to which it is borne with every N within the limit, as in (E18); negative if it is not. What `little` leaves
    /// of a load that is borne is none.
    fn within_limit(&self, load: Wrench<R>, little: R) -> R {
        let mut least = R::HUGE;
        for (i, a) in self.sides().enumerate() {
            for b in self.sides().skip(i.saturating_add(1)) {
                let x = a.cross(b);
                let size = x.size();
                if size <= R::in_plane() {
                    continue;
                }
                let rounding = little * (R::ONE + size);
                for x in [x, x * -R::ONE] {
                    let margin = self.most_along(x) + x.dot(load);
                    let margin = if margin.abs() <= rounding {
                        R::ZERO
                    } else {
                        margin
                    };
                    least = least.min(margin / size);
                }
            }
        }
        least
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The change of the load before which the contacts are not jammed; none if they are. Contacts in one line have no load that they hold
    /// by their inner force.
    #[inline(never)]
    pub(crate) fn free_of_jam(&self, body: &Body<R>) -> Option<R> {
        if body.freedom() != Freedom::Fixed || self.is_edge(&body.contacts) {
            return Some(R::HUGE);
        }
        let load = self.present_load(body);
        let change = self.cone(body).within_limit(load, self.rounding(body));
        (change >= -R::of_release(load.size())).then(|| change.max(R::ZERO))
    }
}
