//! What contacts that fix the pose bear: the cone of all sums of their reactions, by the planes through two of its edges (STATICS 8).

use crate::contact::{MAX_CONTACTS, Sense};
use crate::geometry::{Vec2, Wrench};
use crate::real::Real;
use crate::state::{Body, HandPose};
use crate::thresholds::Thresholds;
use crate::world::{Cone, Statics};
use heapless::Vec;

/// An edge of the friction cone of a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ConeEdge<R> {
    /// The reaction, of force 1, about the holding point.
    pub(crate) wrench: Wrench<R>,
    /// The place of the contact among those of the body.
    pub(crate) contact: usize,
    /// The slide that begins at this edge: against its friction; without friction either.
    pub(crate) slide: Sense,
    /// The angle of friction.
    pub(crate) cone: Cone<R>,
}

/// A plane through two edges that has all others on one side: x·w >= 0 for all reactions w, x inward.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facet<'a, R> {
    pub(crate) inward: Wrench<R>,
    pub(crate) edges: [&'a ConeEdge<R>; 2],
}

/// How long contacts bear a load along a displacement of the hand.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Borne<R> {
    /// To its end, where they bear any load that differs by less than this.
    All(R),
    /// Up to this part of it.
    Until(R),
    /// Up to this part of it, where a slip of an edge begins in this sense.
    Slips(R, Sense),
}

/// The cone of the reactions of all contacts.
pub(crate) struct WrenchCone<R> {
    pub(crate) edges: Vec<ConeEdge<R>, { 2 * MAX_CONTACTS }>,
}

impl<R: Real> WrenchCone<R> {
    /// Of no contact.
    pub(crate) const fn new() -> Self {
        Self { edges: Vec::new() }
    }
    /// All facets, one after the other. Compiled once.
    #[inline(never)]
    pub(crate) fn facets<'a>(&'a self, each: &mut dyn FnMut(Facet<'a, R>)) {
        for (i, a) in self.edges.iter().enumerate() {
            for (k, b) in self.edges.iter().enumerate().skip(i.saturating_add(1)) {
                self.through([(i, a), (k, b)], each);
            }
        }
        self.in_line(each);
    }
    /// Of edges that all lie in one line: the planes through it, each twice, and its end if it has one.
    fn in_line<'a>(&'a self, each: &mut dyn FnMut(Facet<'a, R>)) {
        let Some(edge) = self.edges.first() else {
            return;
        };
        let w = edge.wrench;
        let is_in_line = |c: &ConeEdge<R>| w.cross(c.wrench).size() <= R::in_plane();
        if !self.edges.iter().all(is_in_line) {
            return;
        }
        let side = Wrench {
            force: w.force.turned(),
            moment: R::ZERO,
        };
        let other = w.cross(side);
        let ends = self.edges.iter().all(|c| w.dot(c.wrench) > R::ZERO);
        let planes = [side, side * -R::ONE, other, other * -R::ONE];
        for inward in planes.into_iter().chain(ends.then_some(w)) {
            each(Facet {
                inward,
                edges: [edge; 2],
            });
        }
    }
    /// The facets through two edges, with their places: none or one, or up to four where all edges lie in one plane.
    #[inline(always)]
    fn through<'a>(
        &'a self,
        [(i, a), (k, b)]: [(usize, &'a ConeEdge<R>); 2],
        each: &mut dyn FnMut(Facet<'a, R>),
    ) {
        let edges = [a, b];
        let x = a.wrench.cross(b.wrench);
        let (mut inside, mut outside) = (false, false);
        let least = R::of_volume();
        for (other, c) in self.edges.iter().enumerate() {
            if other != i && other != k {
                let side = x.dot(c.wrench);
                if side > least {
                    inside = true;
                } else if side < -least {
                    outside = true;
                }
                if inside && outside {
                    return;
                }
            }
        }
        if x.size() <= R::in_plane() {
            return;
        }
        let back = x * -R::ONE;
        if inside || outside {
            let inward = if outside { back } else { x };
            return each(Facet { inward, edges });
        }
        // Contacts without friction: the load has to lie in their plane, between the outer edges.
        let both = self.outer(edges, x).into_iter().flatten();
        for facet in [
            Facet { inward: x, edges },
            Facet {
                inward: back,
                edges,
            },
        ]
        .into_iter()
        .chain(both)
        {
            each(facet);
        }
    }
    /// The lines through those of two edges that are outer ones in the plane of all, of normal x.
    fn outer<'a>(
        &'a self,
        [a, b]: [&'a ConeEdge<R>; 2],
        x: Wrench<R>,
    ) -> [Option<Facet<'a, R>>; 2] {
        [(a, b), (b, a)].map(|(edge, other)| {
            let side = x.cross(edge.wrench);
            let inward = side * side.dot(other.wrench).sign();
            let is_outer = |c: &ConeEdge<R>| inward.dot(c.wrench) >= -R::in_plane();
            let edges = [edge, edge];
            self.edges
                .iter()
                .all(is_outer)
                .then_some(Facet { inward, edges })
        })
    }
}

impl<R: Real> Facet<'_, R> {
    /// Not negative while the facet does not yield to a load.
    pub(crate) fn margin(&self, load: Wrench<R>) -> R {
        -self.inward.dot(load)
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The cone of the reactions of a body's contacts, in place, as it is large: into an empty one.
    #[inline(never)]
    pub(crate) fn cone(&self, body: &Body<R>, cone: &mut WrenchCone<R>) {
        for (contact, c) in body.contacts.iter().enumerate() {
            let frame = self.frame_inlined(c, body.rotation, body.holding);
            let friction = self.friction(c).cone(body.stiction);
            let both = [Sense::Minus, Sense::Plus];
            let slides = if friction.sin > R::ZERO {
                both.as_slice()
            } else {
                &[Sense::Rests]
            };
            for &slide in slides {
                let force = frame.n * friction.cos - frame.t * slide.along(friction.sin);
                // There is room for two of each contact.
                let _ = cone.edges.push(ConeEdge {
                    wrench: Wrench::at(frame.r, force),
                    contact,
                    slide,
                    cone: friction,
                });
            }
        }
    }
    /// Several contacts of one vertex: the two extreme edges, counter-clockwise from the first to the second; none if they span all
    /// directions. Opposite edges, to rounding, span a line: the first one twice.
    pub(crate) fn extreme_edges(&self, body: &Body<R>) -> Option<[Vec2<R>; 2]> {
        let mut cone = WrenchCone::new();
        self.cone(body, &mut cone);
        let extreme = |sign: R| {
            let mut forces = cone.edges.iter().map(|edge| edge.wrench.force);
            forces.find(|a| {
                let mut others = cone.edges.iter();
                others.all(|b| sign * a.cross(b.wrench.force) >= -R::of_products())
            })
        };
        Some([extreme(R::ONE)?, extreme(-R::ONE)?])
    }
    /// How long the contacts bear the load along the hand's displacement to another pose, as a part of it.
    #[inline(never)]
    pub(crate) fn borne(&self, body: &Body<R>, to: &HandPose<R>) -> Borne<R> {
        if let Some(borne) = self.borne_by_edge(body, to) {
            return borne;
        }
        let mut cone = WrenchCone::new();
        self.cone(body, &mut cone);
        let (begin, end) = (self.present_load(body), self.load(body, to));
        let little = -R::of_balance(end.size());
        let (mut first, mut slack) = (None, R::HUGE);
        cone.facets(&mut |facet| {
            let (v1, size) = (facet.margin(end), facet.inward.size());
            if v1 >= little * size {
                slack = slack.min(v1 / size);
                return;
            }
            let v0 = facet.margin(begin).max(R::ZERO);
            let part = v0 / (v0 - v1);
            first = Some(first.map_or(part, |least: R| least.min(part)));
        });
        match first {
            Some(part) => Borne::Until(part),
            None => Borne::All(slack),
        }
    }
    /// The contacts bear the present load, up to what it is known to. The normal of a facet is known to its rounding, however short it is.
    pub(crate) fn bears(&self, body: &Body<R>, known: R) -> bool {
        let mut cone = WrenchCone::new();
        self.cone(body, &mut cone);
        let load = self.present_load(body);
        let of_normal = R::of_normal(load.size());
        let mut bears = true;
        cone.facets(&mut |facet| {
            bears &= facet.margin(load) >= -(known * facet.inward.size() + of_normal);
        });
        bears
    }
    /// The hand a little further towards a target, to where a load that was only just borne is certainly not borne any more, no matter where
    /// the path ends.
    pub(crate) fn released(&self, body: &Body<R>, target: &HandPose<R>) -> HandPose<R> {
        let way = body.hand.to(target);
        let size = way.per_p.size();
        if size <= R::ZERO {
            return body.hand;
        }
        let mut p = R::TOUCH * R::from_int(4) / size;
        if self.has_pairs() && !body.contacts.turn_about_first() {
            let most = R::from_int(16) * R::ahead() / size;
            p = p.max(self.beyond_facets(body, &way.per_p, most));
        }
        if p == way.whole {
            *target
        } else {
            body.hand.moved(&way.per_p, p)
        }
    }
    /// How far the hand has to go on along a displacement until facets that only just bear the load certainly do not, at most `most`.
    fn beyond_facets(&self, body: &Body<R>, per_p: &HandPose<R>, most: R) -> R {
        let mut cone = WrenchCone::new();
        self.cone(body, &mut cone);
        let load = self.present_load(body);
        let change = Wrench {
            force: per_p.at,
            moment: self.world.stiffness.of(per_p.angle),
        };
        let released = R::of_release(load.size());
        let mut way = R::ZERO;
        cone.facets(&mut |facet| {
            let little = released * facet.inward.size();
            let rate = -facet.margin(change);
            if facet.margin(load).abs() <= little && rate > R::ZERO {
                way = way.max((little / rate).min(most));
            }
        });
        way
    }
}
