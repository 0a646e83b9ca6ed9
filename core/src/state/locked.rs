//! Three or more contacts (STATICS 6): the pose is fixed while some combination of the friction cones bears the load. If
//! none does, the facet of their common cone that yields first tells which contacts last and how they move.

use super::{Moved, Pair, Pairs, Reactions, Trigger};
use crate::coupling::{Grip, Pivot, Stance};
use crate::detect::Placed;
use crate::output::MAX_CONTACTS;
use crate::real::Real;
use crate::scene::Scene;
use crate::support::{Bearing, Support, Yield};
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
            ..Moved::by(trigger)
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
        stance: &Stance<R>,
    ) -> Reactions<R> {
        shared_reactions(scene, &self.contacts(), stance)
    }
}

/// The common cone of contacts, moments about the pivot.
fn support<R: Real, const V: usize, const S: usize>(
    scene: &Scene<R, V, S>,
    placed: &Placed<R>,
    contacts: &[Pair],
) -> Support<R> {
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

/// The part of the hand's way after which fixed contacts cannot bear the load, and what happens then.
pub(super) fn first_yield<R: Real, const V: usize, const S: usize>(
    scene: &Scene<R, V, S>,
    pivot: &Pivot<R>,
    contacts: &[Pair],
    from: &Grip<R>,
    to: &Grip<R>,
) -> (R, Trigger<R>) {
    let placed = pivot.placed(scene);
    let support = support(scene, &placed, contacts);
    let [before, after] = [from, to].map(|grip| Stance::new(scene, placed, grip).load());
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
    contacts: &[Pair],
    stance: &Stance<R>,
) -> Reactions<R> {
    let shares = support(scene, &stance.placed, contacts).share(stance.load());
    let pairs = contacts.iter().zip(shares);
    pairs
        .map(|(contact, [plus, minus])| {
            let (n, t) = scene.surface(contact.surface).friction.static_edge(R::ONE);
            [(plus + minus) * n, (plus - minus) * t]
        })
        .collect()
}
