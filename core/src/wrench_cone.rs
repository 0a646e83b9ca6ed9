//! The loads that two or more contacts can bear together: the cone of all sums of reactions within their friction cones
//! (STATICS 5, 6). A load is borne iff it lies on the inner side of every facet of the cone, which is linear in the
//! load; the facet that yields first determines the incipient motion.

mod facets;
mod shares;

use core::cell::Cell;
use heapless::Vec;

use crate::contact::MAX_CONTACTS;
use crate::geometry::Vec2;
use crate::real::Real;
use crate::wrench2::Wrench2;
pub(crate) use facets::Yield;

const MAX_EDGES: usize = 2 * MAX_CONTACTS;

/// One contact as the cone represents it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bearing<R> {
    /// Lever from the pivot.
    pub(crate) lever: Vec2<R>,
    pub(crate) normal: Vec2<R>,
    pub(crate) tangent: Vec2<R>,
    /// (normal, friction) components of the two edges of the cone, friction along +t and along -t.
    pub(crate) edges: [(R, R); 2],
}

/// One edge of the friction cone of a contact.
#[derive(Clone, Copy, Debug)]
struct ConeEdge<R> {
    wrench: Wrench2<R>,
    contact: usize,
    /// Its components along n and along t.
    pressing: R,
    friction: R,
}

/// The cone of bearable wrenches.
#[derive(Clone, Debug, Default)]
pub(crate) struct WrenchCone<R: Real> {
    edges: Vec<ConeEdge<R>, MAX_EDGES>,
    /// The levers of the contacts, from the pivot.
    levers: Vec<Vec2<R>, MAX_CONTACTS>,
    /// The work done with it so far, in units of work.
    work: Cell<u32>,
}

impl<R: Real> WrenchCone<R> {
    /// Counts work that is done with it.
    pub(crate) fn spend(&self, units: u32) {
        self.work.set(self.work.get().saturating_add(units));
    }

    /// The number of contacts.
    pub(crate) fn count(&self) -> u32 {
        u32::try_from(self.levers.len()).unwrap_or(u32::MAX)
    }

    /// The work done with it so far, in units of work.
    pub(crate) fn work(&self) -> u32 {
        self.work.get()
    }

    /// Adds the two edges of the friction cone of a contact, as forces with their moments about the pivot.
    pub(crate) fn add(&mut self, bearing: &Bearing<R>) {
        for &(n, t) in &bearing.edges {
            let force = bearing.normal * n + bearing.tangent * t;
            let edge = ConeEdge {
                wrench: Wrench2 {
                    force,
                    moment: bearing.lever.cross(force),
                },
                contact: self.levers.len(),
                pressing: n,
                friction: t,
            };
            // At most MAX_CONTACTS bearings are added.
            let _ = self.edges.push(edge);
        }
        let _ = self.levers.push(bearing.lever);
    }
}

#[cfg(test)]
mod tests;
