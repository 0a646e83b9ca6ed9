//! Three or more contacts (STATICS 6): the pose is fixed while some combination of the friction cones bears the load. If none does, the
//! facet of their common cone that yields first determines which contacts last and how they move.

use super::fixed_pose::FixedPose;
use crate::contact::{MAX_CONTACTS, Pair, Pairs, Reactions};
use crate::grip::Grip;
use crate::list::gather;
use crate::load::Load;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::verb::Moved;
use crate::work::Work;
use crate::world::World;
use heapless::Vec;

/// The memory: where the first contact is held, the fixed angle, the other contacts.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Locked<R> {
    pub(crate) pivot: Pivot<R>,
    pub(crate) others: Vec<Pair, { MAX_CONTACTS - 1 }>,
    /// mu_s limits the friction, not mu_d.
    pub(crate) stiction: bool,
    /// Edges of the friction cones that bore the load last.
    pub(crate) bearers: [u8; 3],
}

impl<R: Real> Locked<R> {
    pub(crate) fn new(pivot: Pivot<R>, others: &[Pair]) -> Self {
        Self {
            pivot,
            others: gather(others.iter().copied()),
            stiction: false,
            bearers: [0, 1, 2],
        }
    }

    pub(crate) fn contacts(&self) -> Pairs {
        let first = [self.pivot.contact];
        gather(first.into_iter().chain(self.others.iter().copied()))
    }

    fn fixed_pose(&self, scene: &impl World<R>) -> FixedPose<R> {
        FixedPose::new(scene, &self.pivot, (&self.contacts(), self.stiction))
    }

    /// A certified frame: it stays. The set of loads that are borne is convex, so that the end of the path decides.
    pub(crate) fn follow(&mut self, scene: &impl World<R>, to: &Grip<R>, work: &mut Work) -> bool {
        let fixed_pose = self.fixed_pose(scene);
        let bears = fixed_pose.bears(scene, to, &mut self.bearers);
        work.spend(fixed_pose.work());
        bears
    }

    /// Stays as the hand moves, as long as the contacts bear the load.
    #[inline(never)]
    pub(crate) fn advance(&self, scene: &impl World<R>, from: &Grip<R>, to: &Grip<R>) -> Moved<R> {
        self.fixed_pose(scene).advance(scene, from, to)
    }

    /// Tests the contacts in the present pose.
    #[inline(never)]
    pub(crate) fn relax(&self, scene: &impl World<R>, grip: &Grip<R>, tried: usize) -> Moved<R> {
        self.fixed_pose(scene).test(scene, grip, tried)
    }

    pub(crate) fn is_jammed(&self, scene: &impl World<R>, grip: &Grip<R>, work: &mut Work) -> bool {
        let fixed_pose = self.fixed_pose(scene);
        let is_jammed = fixed_pose.is_jammed(scene, grip);
        work.spend(fixed_pose.work());
        is_jammed
    }

    pub(crate) fn release(&self, scene: &impl World<R>, grip: &Grip<R>, work: &mut Work) -> R {
        let fixed_pose = self.fixed_pose(scene);
        let release = fixed_pose.release(scene, grip);
        work.spend(fixed_pose.work());
        release
    }

    pub(crate) fn reactions(&self, scene: &impl World<R>, load: &Load<R>) -> Reactions<R> {
        self.fixed_pose(scene).reactions(scene, load)
    }
}
