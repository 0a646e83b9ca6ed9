//! Three or more contacts (STATICS 6): the pose is fixed while some combination of the friction cones bears the load. If
//! none does, the facet of their common cone that yields first tells which contacts last and how they move.

use super::{ContactState, Moved, Pair, Pairs, Reactions, Trigger};
use crate::coupling::{Grip, Pivot, Stance};
use crate::output::MAX_CONTACTS;
use crate::real::Real;
use crate::scene::Scene;
use crate::support::{Bearing, Screw, Support, Yield};
use heapless::Vec;

/// The memory: where the first contact is held, the fixed angle, the other contacts.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Locked<R> {
    pub(crate) pivot: Pivot<R>,
    pub(crate) others: Vec<Pair, { MAX_CONTACTS - 1 }>,
}

impl<R: Real> Locked<R> {
    pub(crate) fn contacts(&self) -> Pairs {
        let first = [self.pivot.contact];
        first.into_iter().chain(self.others.iter().copied()).collect()
    }

    /// Stays as the hand moves, as long as the contacts bear the load.
    pub(crate) fn advance<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        let (part, trigger) = first_yield(scene, &self.pivot, &self.contacts(), from, to);
        Moved {
            part,
            ..Moved::new(ContactState::Locked(self.clone()), trigger)
        }
    }

    /// Puts the contacts to the test as they are.
    pub(crate) fn relax<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
    ) -> Moved<R> {
        self.advance(scene, grip, grip)
    }

    pub(crate) fn reactions<const V: usize, const S: usize>(
        &self,
        scene: &Scene<R, V, S>,
        grip: &Grip<R>,
    ) -> Reactions<R> {
        shared_reactions(scene, &self.pivot, &self.contacts(), grip)
    }
}

/// The common cone of contacts, moments about the pivot.
fn support<R: Real, const V: usize, const S: usize>(
    scene: &Scene<R, V, S>,
    pivot: &Pivot<R>,
    contacts: &[Pair],
) -> Support<R> {
    let placed = pivot.placed(scene);
    let mut support = Support::default();
    for contact in contacts {
        let surface = scene.surface(contact.surface);
        support.add(&Bearing {
            lever: placed.arm(scene, contact.vertex),
            normal: surface.normal,
            tangent: surface.tangent,
            edges: [R::ONE, -R::ONE].map(|edge| surface.friction.static_edge(edge)),
        });
    }
    support
}

fn load<R: Real, const V: usize, const S: usize>(
    scene: &Scene<R, V, S>,
    pivot: &Pivot<R>,
    grip: &Grip<R>,
) -> Screw<R> {
    Stance::new(scene, pivot.placed(scene), pivot.angle, grip).load()
}

/// The part of the hand's way after which fixed contacts cannot bear the load, and what happens then.
pub(super) fn first_yield<R: Real, const V: usize, const S: usize>(
    scene: &Scene<R, V, S>,
    pivot: &Pivot<R>,
    contacts: &[Pair],
    from: &Grip<R>,
    to: &Grip<R>,
) -> (R, Trigger<R>) {
    let support = support(scene, pivot, contacts);
    let (before, after) = (load(scene, pivot, from), load(scene, pivot, to));
    match support.first_yield(before, after) {
        None => (R::ONE, Trigger::Balanced),
        Some((part, Yield::Pivot { contact })) => (
            part,
            Trigger::Keep {
                contacts: [contact, contact],
                sliding: None,
            },
        ),
        Some((part, Yield::Slide { first, second })) => (
            part,
            Trigger::Keep {
                contacts: [first.0, second.0],
                sliding: Some(first.1),
            },
        ),
    }
}

/// Reactions of contacts that are statically indeterminate.
pub(super) fn shared_reactions<R: Real, const V: usize, const S: usize>(
    scene: &Scene<R, V, S>,
    pivot: &Pivot<R>,
    contacts: &[Pair],
    grip: &Grip<R>,
) -> Reactions<R> {
    let shares = support(scene, pivot, contacts).share(load(scene, pivot, grip));
    let pairs = contacts.iter().zip(shares);
    pairs
        .map(|(contact, [plus, minus])| {
            let (n, t) = scene.surface(contact.surface).friction.static_edge(R::ONE);
            [(plus + minus) * n, (plus - minus) * t]
        })
        .collect()
}
