//! The facets of the cone: where a load leaves it, and which motion then begins. A contact without an edge in the facet opens, one with
//! both edges in it sticks, one with a single edge in it slides.

use super::{ConeEdge, WrenchCone};
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::work;
use crate::wrench2::Wrench2;

/// The incipient motion at a facet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Yield<R> {
    /// Contact number `contact` sticks, all others open.
    Pivot { contact: usize },
    /// Contacts `first` and `second` slide along sign·t of their surfaces, all others open.
    Slide {
        first: (usize, R),
        second: (usize, R),
    },
}

impl<R: Real> WrenchCone<R> {
    /// The fraction of the path from one load to another after which the contacts cannot bear it any more, if there is one.
    pub(crate) fn first_yield(&self, from: Wrench2<R>, to: Wrench2<R>, rounding: R) -> Option<R> {
        let [first] = self.first_yields(from, to, [rounding]);
        first
    }

    /// For each rounding the fraction of the path from one load to another after which the contacts cannot bear it any more, if any.
    pub(crate) fn first_yields<const N: usize>(
        &self,
        from: Wrench2<R>,
        to: Wrench2<R>,
        roundings: [R; N],
    ) -> [Option<R>; N] {
        let (mut firsts, mut has_facets) = ([None; N], false);
        self.each_facet(&mut |normal, sharpness, _| {
            has_facets = true;
            // The reactions are the opposite of the load.
            let (start, end) = (-normal.dot(from), -normal.dot(to));
            for (first, rounding) in firsts.iter_mut().zip(roundings) {
                if end * sharpness < -rounding {
                    let part = if start > R::ZERO {
                        start / (start - end)
                    } else {
                        R::ZERO
                    };
                    *first = Some(first.map_or(part, |least: R| least.min(part)));
                }
            }
        });
        for (first, rounding) in firsts.iter_mut().zip(roundings) {
            if !has_facets && !self.is_on_line(to, rounding) {
                *first = Some(R::ZERO);
            }
        }
        firsts
    }

    /// Without facets all edges are collinear, as for contacts without friction on opposite sides of a slot: they bear loads in that line
    /// that press against one of them, and nothing else.
    fn is_on_line(&self, load: Wrench2<R>, rounding: R) -> bool {
        let mut edges = self.edges.iter().map(|edge| edge.wrench);
        edges.any(|edge| {
            let size = edge.size();
            edge.dot(load) <= rounding * size && edge.cross(load).size() <= rounding * size
        })
    }

    /// The incipient motion at the facet that a load violates most, among those that `allows` lets pass.
    pub(crate) fn yields(
        &self,
        load: Wrench2<R>,
        rounding: R,
        allows: &dyn Fn(&Yield<R>) -> bool,
    ) -> Option<Yield<R>> {
        let mut most: Option<(R, Yield<R>)> = None;
        self.each_facet(&mut |normal, _, mode| {
            let excess = normal.dot(load);
            let is_most = most.is_none_or(|(largest, _)| excess > largest);
            if excess >= -rounding && is_most && allows(&mode) {
                most = Some((excess, mode));
            }
        });
        most.map(|(_, mode)| mode)
    }

    /// The motion if two edges alone bear the load, and it crosses their facet with an inner normal.
    fn incipient(&self, a: &ConeEdge<R>, b: &ConeEdge<R>, normal: Wrench2<R>) -> Yield<R> {
        if a.contact == b.contact {
            Yield::Pivot { contact: a.contact }
        } else {
            Yield::Slide {
                first: (a.contact, self.slides(a, normal)),
                second: (b.contact, self.slides(b, normal)),
            }
        }
    }

    /// The direction along t in which the contact of an edge slides when the load crosses the facet with an inner normal: against the
    /// friction; without friction the normal is the motion itself.
    fn slides(&self, edge: &ConeEdge<R>, normal: Wrench2<R>) -> R {
        if edge.friction != R::ZERO {
            return -edge.friction.sign();
        }
        // For a force along t, which is a quarter turn from n.
        let force = -edge.wrench.force.turned();
        let lever = self.levers.get(edge.contact).copied().unwrap_or_default();
        let moment = lever.cross(force);
        normal.dot(Wrench2 { force, moment }).sign()
    }

    /// Visits the facets: inner normal of unit size, its accuracy, from 0 (its edges are parallel) to 1, and the incipient motion when the
    /// load crosses it.
    fn each_facet(&self, visit: &mut dyn FnMut(Wrench2<R>, R, Yield<R>)) {
        self.spend(work::facets(self.count()));
        for (i, a) in self.edges.iter().enumerate() {
            for (k, b) in self.edges.iter().enumerate().skip(i.saturating_add(1)) {
                let normal = a.wrench.cross(b.wrench);
                let size = normal.size();
                if size <= R::in_plane() {
                    continue;
                }
                let (plane, sharpness) = (normal.over(size), size.min(R::ONE));
                let (mut inner, mut outer) = (true, true);
                for (j, edge) in self.edges.iter().enumerate() {
                    if j != i && j != k {
                        let side = plane.dot(edge.wrench);
                        inner &= side >= -R::in_plane();
                        outer &= side <= R::in_plane();
                    }
                }
                for (faces, sign) in [(inner, R::ONE), (outer, -R::ONE)] {
                    if faces {
                        let normal = plane.scaled(sign);
                        visit(normal, sharpness, self.incipient(a, b, normal));
                    }
                }
                if inner && outer {
                    self.each_end((plane, sharpness), [a, b], visit);
                }
            }
        }
    }

    /// A cone that lies in a plane, of two contacts without friction, also ends at single edges: beyond one of them the other opens.
    fn each_end(
        &self,
        (plane, sharpness): (Wrench2<R>, R),
        edges: [&ConeEdge<R>; 2],
        visit: &mut dyn FnMut(Wrench2<R>, R, Yield<R>),
    ) {
        for edge in edges {
            let across = plane.cross(edge.wrench);
            let end = across.over(across.size());
            for normal in [end, end.scaled(-R::ONE)] {
                let is_end = |other: &ConeEdge<R>| normal.dot(other.wrench) >= -R::in_plane();
                if self.edges.iter().all(is_end) {
                    let contact = edge.contact;
                    visit(normal, sharpness, Yield::Pivot { contact });
                }
            }
        }
    }
}
