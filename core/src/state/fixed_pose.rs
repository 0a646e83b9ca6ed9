//! Contacts that fix the pose together, two of two surfaces or more (STATICS 5, 6): how long they bear the load, and the motion that begins
//! when they do not. A motion is only begun if it is consistent: driven by the load, and closing no gap of a contact that it leaves.

mod twist;

use core::cell::Cell;

use super::trammel::Demand;
use crate::contact::{Pair, Pairs, Reactions};
use crate::grip::Grip;
use crate::list::gather;
use crate::load::Load;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::verb::{Moved, Trigger};
use crate::work;
use crate::world::{Surface, World};
use crate::wrench_cone::{Bearing, WrenchCone, Yield};

/// The contacts, placed by a pivot that is the first of them.
pub(super) struct FixedPose<R: Real> {
    pivot: Pivot<R>,
    contacts: Pairs,
    stiction: bool,
    cone: WrenchCone<R>,
}

/// An incipient motion: the contacts that last, and the direction in which the first of them slides.
type Mode<R> = ([usize; 2], Option<R>);

/// How far along a path of the hand contacts bear the load.
enum Borne<R> {
    ToTheEnd,
    /// Up to this fraction of the path.
    Until(R),
    /// Not to the end, but none of the facets shows where it ends: they may be known less accurately than reactions.
    Unknown,
}

/// How a motion can begin, those with fewest openings first.
#[derive(Clone, Copy)]
enum Begin {
    SlideTogether,
    Turn,
    SlideAlone,
    Open,
    SlideTogetherInBalance,
    /// Away from a contact that the slide would take along (STATICS 12.6).
    SlideAway,
}

impl Begin {
    const ALL: [Self; 5] = [
        Self::SlideTogether,
        Self::Turn,
        Self::SlideAlone,
        Self::Open,
        Self::SlideTogetherInBalance,
    ];
}

fn keep<R: Real>((contacts, sliding): Mode<R>) -> Trigger<R> {
    Trigger::Keep { contacts, sliding }
}

impl<R: Real> FixedPose<R> {
    /// With stiction or without it.
    pub(super) fn new(
        scene: &impl World<R>,
        pivot: &Pivot<R>,
        (contacts, stiction): (&Pairs, bool),
    ) -> Self {
        let placed = pivot.placed(scene);
        let mut cone = WrenchCone::default();
        for contact in contacts {
            let surface = scene.face(*contact, placed.orientation.rotation());
            cone.add(&Bearing {
                lever: placed.arm_to(scene, *contact),
                normal: surface.normal,
                tangent: surface.tangent,
                edges: [R::ONE, -R::ONE].map(|edge| surface.friction.edge(stiction, edge)),
            });
        }
        Self {
            pivot: *pivot,
            contacts: contacts.clone(),
            stiction,
            cone,
        }
    }

    /// The work done with it so far, in units of work.
    pub(super) fn work(&self) -> u32 {
        work::pose(self.cone.count()).saturating_add(self.cone.work())
    }

    /// True if the contacts bear the load on three edges of their cones, within the limit: on those of last time, or on others, which are
    /// stored.
    pub(super) fn bears(
        &self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        bearers: &mut [u8; 3],
    ) -> bool {
        let load = self.pivot.load(scene, grip);
        if !load.is_representable() {
            return false;
        }
        let wrench = load.wrench();
        let little = load.little();
        if self.cone.bears_on(*bearers, wrench, little) {
            return true;
        }
        let found = self.cone.bearers(wrench, little);
        *bearers = found.unwrap_or(*bearers);
        found.is_some()
    }

    /// True if the contacts bear the load, however large their reactions.
    fn holds(&self, load: &Load<R>) -> bool {
        let (wrench, little) = (load.wrench(), load.little());
        if self.cone.jams(wrench, little) {
            return true;
        }
        // Contacts without friction bear a load on fewer edges, at the edge of a cone and beyond a facet by a rounding.
        let rounding = R::of_reactions(load.rounding());
        let is_inside = self.cone.first_yield(wrench, wrench, rounding).is_none();
        is_inside && self.cone.left(wrench, little) <= little
    }

    /// True if the contacts bear the load, but with no reactions within the limit.
    pub(super) fn is_jammed(&self, scene: &impl World<R>, grip: &Grip<R>) -> bool {
        let load = self.pivot.load(scene, grip);
        let (wrench, little) = (load.wrench(), load.little());
        self.cone.bearers(wrench, little).is_none() && self.cone.exceeds_limit(wrench, little)
    }

    /// To the end of the hand's path, or to where the load is not borne any more. The set of loads that are borne is convex, so that the
    /// end decides.
    pub(super) fn advance(&self, scene: &impl World<R>, from: &Grip<R>, to: &Grip<R>) -> Moved<R> {
        let (part, trigger) = match self.bears_until(scene, (from, to)) {
            Borne::ToTheEnd => (R::ONE, Trigger::Balanced),
            Borne::Unknown => (R::ONE, self.give_way(scene, (to, &|| *to), 0)),
            Borne::Until(part) => {
                let at = from.lerp(to, part);
                // A motion that gives way without stiction is not driven at the bound itself; what it is shows beyond the rounding, no
                // matter where the frame ends.
                let ahead = || at.ahead(scene, to, self.release(scene, &at));
                (part, self.give_way(scene, (&at, &ahead), 0))
            }
        };
        Moved {
            part,
            work: self.work(),
            ..Moved::by(trigger)
        }
    }

    /// How far along the hand's path the contacts bear the load. A call of its own: the loads are off the stack when it returns.
    #[inline(never)]
    fn bears_until(&self, scene: &impl World<R>, (from, to): (&Grip<R>, &Grip<R>)) -> Borne<R> {
        let [before, after] = [from, to].map(|grip| self.pivot.load(scene, grip));
        let (wrench, little) = (after.wrench(), after.little());
        if self.cone.jams(wrench, little) {
            return Borne::ToTheEnd;
        }
        let of_reactions = R::of_reactions(after.rounding());
        let rounding = (before.rounding() + after.rounding()).doubled();
        let roundings = [of_reactions, rounding];
        let [beyond, yields] = (self.cone).first_yields(before.wrench(), wrench, roundings);
        if beyond.is_none() && self.cone.left(wrench, little) <= little {
            return Borne::ToTheEnd;
        }
        yields.map_or(Borne::Unknown, Borne::Until)
    }

    /// A displacement of the hand after which a load that the contacts could only just bear is certainly beyond that.
    pub(super) fn release(&self, scene: &impl World<R>, grip: &Grip<R>) -> R {
        let load = self.pivot.load(scene, grip);
        let of_reactions = self
            .cone
            .rounding_of_reactions(load.wrench(), load.little());
        load.release() + of_reactions.doubled()
    }

    /// At rest, or the motion that begins. `tried`: how many motions did not move the body.
    pub(super) fn test(&self, scene: &impl World<R>, grip: &Grip<R>, tried: usize) -> Moved<R> {
        let trigger = if self.holds(&self.pivot.load(scene, grip)) {
            Trigger::Balanced
        } else {
            self.give_way(scene, (grip, &|| *grip), tried)
        };
        Moved {
            work: self.work(),
            ..Moved::by(trigger)
        }
    }

    /// True if there are reactions that balance the load, to the accuracy with which the end of a slip is found.
    pub(super) fn is_at_rest(&self, scene: &impl World<R>, grip: &Grip<R>) -> bool {
        let load = self.pivot.load(scene, grip);
        let little = load.little();
        self.cone.left(load.wrench(), little) <= little
    }

    /// The directions along t in which two contacts slide if the load crosses the facet of one edge of each.
    pub(super) fn sliding_signs(&self, scene: &impl World<R>, grip: &Grip<R>) -> Option<[R; 2]> {
        let load = self.pivot.load(scene, grip);
        match self
            .cone
            .yields(load.wrench(), load.rounding(), &|_| true)?
        {
            Yield::Slide { first, second } if first.0 < second.0 => Some([first.1, second.1]),
            Yield::Slide { first, second } => Some([second.1, first.1]),
            Yield::Pivot { .. } => None,
        }
    }

    /// The motion that begins after `tried` others were tried in vain. `ahead`: the position of the hand at which it shows what is driven.
    fn give_way(
        &self,
        scene: &impl World<R>,
        (grip, ahead): (&Grip<R>, &dyn Fn() -> Grip<R>),
        tried: usize,
    ) -> Trigger<R> {
        let load = self.pivot.load(scene, grip);
        // Computed once, when it is first needed.
        let known = Cell::new(None);
        let ahead = || {
            let found = known.get().unwrap_or_else(ahead);
            known.set(Some(found));
            found
        };
        let mut motions = self.motions(scene, (grip, &ahead), &load);
        motions.nth(tried).unwrap_or(Trigger::Undriven)
    }

    /// The motions that a load can begin, ranked: that of the facet that yields, then all others that are consistent, those with fewest
    /// openings first. Each is computed only when it is requested.
    fn motions<W: World<R>>(
        &self,
        scene: &W,
        (grip, ahead): (&Grip<R>, &dyn Fn() -> Grip<R>),
        load: &Load<R>,
    ) -> impl Iterator<Item = Trigger<R>> {
        let is_consistent = move |mode: &Mode<R>| {
            // Where a contact is about to open the moment is zero; its direction shows ahead.
            if mode.1.is_none() {
                self.is_consistent(scene, &ahead(), mode)
            } else {
                self.is_consistent(scene, grip, mode)
            }
        };
        let of_facet = move || {
            let yields = self.cone.yields(load.wrench(), load.rounding(), &|yields| {
                // At the bound itself the drive is zero.
                let mode = self.mode_of(yields);
                is_consistent(&mode) || self.is_consistent(scene, &ahead(), &mode)
            });
            yields.map(|yields| keep(self.mode_of(&yields)))
        };
        let of_kind = move |begin: Begin| {
            self.choices(begin).filter_map(move |(i, k, sign)| {
                let mode = match begin {
                    Begin::Turn => self.about(i),
                    _ => ([i, k], Some(sign)),
                };
                let begins = match begin {
                    Begin::Open => self.is_pulled(scene, load),
                    Begin::SlideTogetherInBalance => {
                        self.twist(scene, grip, &mode, Demand::AtTheEnd).is_some()
                    }
                    Begin::SlideAway => {
                        self.is_consistent_with(scene, grip, (&mode, Demand::AtTheEnd))
                    }
                    _ => is_consistent(&mode),
                };
                begins.then(|| match begin {
                    Begin::Open => Trigger::Clear,
                    _ => keep(mode),
                })
            })
        };
        let last = W::CORNERS.then_some(Begin::SlideAway);
        let others = Begin::ALL.into_iter().chain(last).flat_map(of_kind);
        core::iter::once_with(of_facet).flatten().chain(others)
    }

    /// The pairs of contacts and directions in which a motion of a kind can begin.
    fn choices(&self, begin: Begin) -> impl Iterator<Item = (usize, usize, R)> + use<R> {
        let count = self.contacts.len();
        let all = (0..count).flat_map(move |i| (i..count).map(move |k| (i, k)));
        all.flat_map(|(i, k)| [(i, k, R::ONE), (i, k, -R::ONE)])
            .filter(move |&(i, k, sign)| match begin {
                Begin::SlideTogether | Begin::SlideTogetherInBalance => i < k,
                Begin::Turn => i == k && sign > R::ZERO,
                Begin::SlideAlone | Begin::SlideAway => i == k,
                Begin::Open => i == 0 && k == 0 && sign > R::ZERO,
            })
    }

    /// Returns whether the load pulls contacts off and presses none.
    fn is_pulled(&self, scene: &impl World<R>, load: &Load<R>) -> bool {
        let pull = |&c: &Pair| self.surface(scene, c).normal.dot(load.force);
        self.contacts.iter().all(|c| pull(c) >= R::ZERO)
            && self.contacts.iter().any(|c| pull(c) > R::ZERO)
    }

    /// A turn about a contact; in a corner both contacts of the vertex last.
    fn about(&self, index: usize) -> Mode<R> {
        let vertex = self.contact(index).vertex;
        let corner = self.contacts.iter().enumerate();
        let mut other = corner
            .filter(|&(k, c)| k != index && c.vertex == vertex && !c.is_corner())
            .map(|(k, _)| k);
        ([index, other.next().unwrap_or(index)], None)
    }

    /// The mode in which a facet yields; two contacts of one vertex, in a corner, last together.
    fn mode_of(&self, yields: &Yield<R>) -> Mode<R> {
        match *yields {
            Yield::Pivot { contact } => self.about(contact),
            Yield::Slide { first, second } => {
                let [a, b] = [first.0, second.0].map(|i| self.contact(i));
                if a.vertex == b.vertex && !a.is_corner() {
                    self.about(first.0)
                } else {
                    ([first.0, second.0], Some(first.1))
                }
            }
        }
    }

    /// The surface of a contact at the present orientation of the body.
    fn surface(&self, scene: &impl World<R>, contact: Pair) -> Surface<R> {
        scene.face(contact, self.pivot.orientation.rotation())
    }

    fn contact(&self, index: usize) -> Pair {
        self.contacts.get(index).copied().unwrap_or_default()
    }

    /// Reactions, which are statically indeterminate.
    pub(super) fn reactions(&self, scene: &impl World<R>, load: &Load<R>) -> Reactions<R> {
        let little = load.little();
        let shares = self.cone.share(load.wrench(), little);
        let pairs = self.contacts.iter().zip(&shares);
        gather(pairs.map(|(contact, &[plus, minus])| {
            let (n, t) = scene
                .surface(contact.surface)
                .friction
                .edge(self.stiction, R::ONE);
            [plus * n + minus * n, plus * t - minus * t]
        }))
    }
}
