//! 3: the contact state. Each variant owns exactly the memory that it needs from one frame to the next; each has a file of its own with the
//! same verbs in the same order:
//!
//! * `contacts`, `pose`: what touches, and the pose of the body;
//! * `follow`: a certified frame, in which nothing happens before its end: follows the hand, or returns false and has not moved;
//! * `advance`: follows the hand on a straight path, in balance, to the first event (path evolution);
//! * `relax`: hand frozen, comes to balance without sliding and tests friction;
//! * `slide`: hand frozen, slides to the end of the slip;
//! * `reactions`: the forces of the contacts at rest.
//!
//! On a single surface without friction a vertex and an edge glide: the same verbs with the foot in balance.
//!
//! Each verb except the certified frame is a call of its own (`inline(never)`): the stack holds the data of one, not of all.

use crate::contact::{Pair, Pairs, Reactions, Regime};
use crate::detect::Placed;
use crate::event::StateKind;
use crate::geometry::Pose;
use crate::grip::Grip;
use crate::load::Load;
use crate::moment::{Pinned, Sliding};
use crate::pivot::Pivot;
use crate::real::Real;
use crate::verb::{Moved, Relax, Trigger, seat};
use crate::work::Work;
use crate::world::World;

mod corner;
mod edge;
mod fixed_pose;
mod free;
mod locked;
mod on_corner;
mod onset;
mod segment;
mod short_slip;
mod side_end;
mod single_vertex;
mod slide;
mod swing;
mod trammel;
mod two_vertex;

pub(crate) use corner::Corner;
pub(crate) use edge::Edge;
pub(crate) use free::Free;
pub(crate) use locked::Locked;
pub(crate) use on_corner::{CORNER_LOOK, MAX_HALVINGS, MOST_OF_PIECES};
pub(crate) use single_vertex::SingleVertex;
pub(crate) use trammel::{MOST_OF_RUN, MOST_OF_SLIDE, RUN, SLIDE, SPOT, SPOT_LOOK};
pub(crate) use two_vertex::{Slip, TwoVertex};

/// The contact state with its memory.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ContactState<R: Real> {
    Free(Free<R>),
    SingleVertex(SingleVertex<R>),
    Edge(Edge<R>),
    TwoVertex(TwoVertex<R>),
    Corner(Corner<R>),
    Locked(Locked<R>),
}

impl<R: Real> ContactState<R> {
    pub(crate) fn kind(&self) -> StateKind {
        match self {
            Self::Free(_) => StateKind::NonContact,
            Self::SingleVertex(_) => StateKind::SingleVertex,
            Self::Edge(_) => StateKind::Edge,
            Self::TwoVertex(_) => StateKind::TwoVertex,
            Self::Corner(_) => StateKind::Corner,
            Self::Locked(_) => StateKind::Locked,
        }
    }

    pub(crate) fn contacts(&self) -> Pairs {
        match self {
            Self::Free(_) => Pairs::new(),
            Self::SingleVertex(s) => s.contacts(),
            Self::Edge(s) => s.contacts(),
            Self::TwoVertex(s) => s.contacts(),
            Self::Corner(s) => s.contacts(),
            Self::Locked(s) => s.contacts(),
        }
    }

    /// The pivot that fixes the pose; without contact the pose itself.
    pub(crate) fn anchor(&self) -> Result<&Pivot<R>, &Pose<R>> {
        match self {
            Self::Free(s) => Err(&s.pose),
            Self::SingleVertex(s) => Ok(&s.pivot),
            Self::Edge(s) => Ok(&s.pivot),
            Self::TwoVertex(s) => Ok(&s.pivot),
            Self::Corner(s) => Ok(&s.pivot),
            Self::Locked(s) => Ok(&s.pivot),
        }
    }

    /// The body placed by the point that fixes its pose.
    pub(crate) fn placed(&self, scene: &impl World<R>) -> Placed<R> {
        match self.anchor() {
            Ok(pivot) => pivot.placed(scene),
            Err(pose) => Placed::at(pose),
        }
    }

    /// The load on the body about the point that holds its pose.
    pub(crate) fn load(&self, scene: &impl World<R>, grip: &Grip<R>) -> Load<R> {
        Load::new(scene, self.placed(scene), grip)
    }

    pub(crate) fn pose(&self, scene: &impl World<R>) -> Pose<R> {
        self.placed(scene).pose()
    }

    /// Returns whether the number type can represent the springs between the body and a hand.
    pub(crate) fn can_be_held<W: World<R>>(&self, scene: &W, grip: &Grip<R>) -> bool {
        let load = self.load(scene, grip);
        if W::GLIDES {
            load.is_representable_sliding()
        } else {
            load.is_representable()
        }
    }

    /// Returns whether the contacts hold the body, but only with reactions beyond the limit (STATICS 6).
    #[inline(never)]
    pub(crate) fn is_jammed<W: World<R>>(
        &self,
        scene: &W,
        grip: &Grip<R>,
        work: &mut Work,
    ) -> bool {
        match self {
            Self::TwoVertex(s) if W::SURFACES => s.is_jammed(scene, grip, work),
            Self::Corner(s) if W::SURFACES => s.is_jammed(scene, grip, work),
            Self::Locked(s) if W::SURFACES => s.is_jammed(scene, grip, work),
            _ => false,
        }
    }

    /// A displacement of the hand after which a load that the contacts could only just bear is certainly not borne any more.
    pub(crate) fn release<W: World<R>>(&self, scene: &W, grip: &Grip<R>, work: &mut Work) -> R {
        match self {
            Self::TwoVertex(s) if W::SURFACES => s.release(scene, grip, work),
            Self::Locked(s) if W::SURFACES => s.release(scene, grip, work),
            _ => self.load(scene, grip).release(),
        }
    }

    /// Whether the contacts stick or slide; without contact nothing sticks.
    pub(crate) fn regime(&self) -> Regime<R> {
        match self {
            Self::Free(_) => Regime::LOOSE,
            Self::SingleVertex(s) => s.regime,
            Self::Edge(s) => s.regime,
            Self::TwoVertex(s) => s.regime,
            Self::Corner(Corner { stiction, .. }) | Self::Locked(Locked { stiction, .. }) => {
                let stiction = *stiction;
                Regime::Stick { stiction }
            }
        }
    }

    /// The state and whether its contacts slide.
    pub(crate) fn motion(&self) -> (StateKind, bool) {
        (self.kind(), self.regime().slide().is_some())
    }

    /// The same state, sticking or sliding; a state that cannot slide sticks.
    pub(crate) fn set_regime(&mut self, regime: Regime<R>) {
        match self {
            Self::Free(_) => {}
            Self::SingleVertex(s) => s.regime = regime,
            Self::Edge(s) => s.regime = regime,
            Self::TwoVertex(s) => s.regime = regime,
            Self::Corner(Corner { stiction, .. }) | Self::Locked(Locked { stiction, .. }) => {
                *stiction = regime.has_stiction();
            }
        }
    }

    /// One vertex or an edge that sticks has stiction if it is pressed hard enough (rule 3).
    pub(crate) fn renew(&mut self, scene: &impl World<R>, grip: &Grip<R>) {
        if let Self::SingleVertex(SingleVertex { pivot, regime, .. })
        | Self::Edge(Edge { pivot, regime, .. }) = self
        {
            pivot.renew(scene, grip, regime);
        }
    }

    /// For contacts that fix the pose when a hand takes hold: they have stiction if one of them is pressed hard enough by a load that they
    /// can bear (rule 10 a).
    pub(crate) fn press<W: World<R>>(&mut self, scene: &W, grip: &Grip<R>) {
        if !W::SURFACES || !matches!(self, Self::TwoVertex(_) | Self::Corner(_) | Self::Locked(_)) {
            return;
        }
        self.set_regime(Regime::Stick { stiction: true });
        let (reactions, _) = self.reactions(scene, grip, &self.load(scene, grip));
        let contacts = self.contacts();
        let mut pairs = contacts.iter().zip(&reactions);
        let is_pressed = pairs.any(|(contact, &[normal, _])| {
            let friction = scene.surface(contact.surface).friction;
            friction.is_pressed(normal)
        });
        if !is_pressed {
            self.set_regime(Regime::LOOSE);
        }
    }

    /// True if it has followed a frame in which certainly nothing happens.
    pub(crate) fn follow<W: World<R>>(
        &mut self,
        scene: &W,
        (from, to): (&Grip<R>, &Grip<R>),
        work: &mut Work,
    ) -> bool {
        let path = (from, to);
        work.spend(self.certified_work());
        match self {
            Self::Free(s) if W::GLIDES => s.follow::<W, Sliding<R>>(scene, path, work),
            Self::Free(s) => s.follow::<W, Pinned>(scene, path, work),
            Self::SingleVertex(s) if W::GLIDES => s.follow_sliding(scene, path, (R::ONE, work)),
            Self::SingleVertex(s) => match s.regime {
                Regime::Slide(sign) => s.follow_sliding(scene, path, (sign, work)),
                Regime::Stick { .. } => s.follow(scene, path, work),
            },
            Self::Edge(s) if W::EDGES => s.follow(scene, path, work),
            Self::TwoVertex(s) if W::SURFACES => s.follow(scene, path, work),
            Self::Locked(s) if W::SURFACES => s.follow(scene, to, work),
            _ => false,
        }
    }

    /// Moves with the hand from one grip to another, in balance, to the first event (STATICS 7, step 1).
    pub(crate) fn advance<W: World<R>>(
        &mut self,
        scene: &W,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        match self {
            Self::Free(s) if W::GLIDES => s.advance::<Sliding<R>>(scene, from, to),
            Self::Free(s) => s.advance::<Pinned>(scene, from, to),
            Self::SingleVertex(s) if W::GLIDES => s.advance_sliding(scene, (from, to), R::ONE),
            Self::SingleVertex(s) => match s.regime {
                Regime::Slide(sign) => s.advance_sliding(scene, (from, to), sign),
                Regime::Stick { .. } => s.advance(scene, from, to),
            },
            Self::Edge(s) if W::EDGES => s.advance(scene, from, to),
            Self::TwoVertex(s) if W::SURFACES => s.advance(scene, from, to),
            Self::Corner(s) if W::SURFACES => s.advance(scene, from, to),
            Self::Locked(s) if W::SURFACES => s.advance(scene, from, to),
            _ => absent(),
        }
    }

    /// Comes to balance at a frozen hand without sliding, then tests friction (STATICS 7, step 3).
    pub(crate) fn relax<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        how: Relax<R>,
    ) -> Moved<R> {
        match self {
            Self::Free(s) if W::GLIDES => s.relax::<Sliding<R>>(scene, grip),
            Self::Free(s) => s.relax::<Pinned>(scene, grip),
            Self::SingleVertex(s) if !W::GLIDES => s.relax(scene, grip, how.sliding),
            Self::SingleVertex(s) => s.glide_down(scene, grip),
            Self::Edge(s) if W::EDGES => s.relax(scene, grip, how.sliding),
            Self::TwoVertex(s) if W::SURFACES => s.relax(scene, grip, how),
            Self::Corner(s) if W::SURFACES => s.relax(scene, grip),
            Self::Locked(s) if W::SURFACES => s.relax(scene, grip, how.tried),
            _ => absent(),
        }
    }

    /// From a fold of the branch, on in the direction of the sign. A free body continues from there without it.
    #[inline(never)]
    pub(crate) fn snap<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        (direction, under_way): (R, &mut Option<Slip<R>>),
    ) -> Moved<R> {
        match self {
            Self::Free(s) if W::GLIDES => s.snap::<Sliding<R>>(scene, grip, direction),
            Self::Free(s) => s.snap::<Pinned>(scene, grip, direction),
            Self::SingleVertex(s) if W::GLIDES => s.snap_sliding(scene, grip, (direction, R::ONE)),
            Self::SingleVertex(s) => match s.regime {
                Regime::Slide(sign) => s.snap_sliding(scene, grip, (direction, sign)),
                Regime::Stick { .. } => s.snap(scene, grip, direction),
            },
            Self::TwoVertex(s) if W::SURFACES => s.snap(scene, grip, direction, under_way),
            Self::Corner(s) if W::SURFACES => s.snap(scene, grip, direction),
            other => other.relax(scene, grip, Relax::default()),
        }
    }

    /// Only a single vertex, an edge and two vertices slip; the others give way to one of these first. It may take several pieces:
    /// `under_way` stores its progress.
    pub(crate) fn slip<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        (sign, under_way): (R, &mut Option<Slip<R>>),
    ) -> Moved<R> {
        match self {
            Self::SingleVertex(s) if !W::GLIDES => s.slip(scene, grip, (sign, under_way)),
            Self::Edge(s) if W::EDGES && !W::GLIDES => s.slip(scene, grip, sign),
            Self::TwoVertex(s) if W::SURFACES => s.slip(scene, grip, under_way),
            _ => absent(),
        }
    }

    /// The reactions, (N, T) of each contact, and the directions along t in which the contacts slide: 0 if they stick.
    pub(crate) fn reactions<W: World<R>>(
        &self,
        scene: &W,
        grip: &Grip<R>,
        load: &Load<R>,
    ) -> (Reactions<R>, [R; 2]) {
        let reactions = match self {
            Self::TwoVertex(s) if W::SURFACES => return s.reactions(scene, grip, load),
            Self::SingleVertex(s) => s.reactions(scene, load),
            Self::Edge(s) if W::EDGES => s.reactions(scene, load),
            Self::Corner(s) if W::SURFACES => s.reactions(scene, load),
            Self::Locked(s) if W::SURFACES => s.reactions(scene, load),
            _ => Reactions::new(),
        };
        (reactions, [self.regime().slide().unwrap_or(R::ZERO); 2])
    }

    /// The state of a pivot and further contacts that all touch to within a tolerance; the pose is seated on them.
    pub(crate) fn seated<W: World<R>>(scene: &W, pivot: Pivot<R>, others: &[Pair]) -> Self {
        if !W::SEVERAL {
            return Self::SingleVertex(SingleVertex::new(pivot));
        }
        let pivot = seat(scene, pivot, others);
        match *others {
            [other]
                if W::SURFACES
                    && other.vertex == pivot.contact.vertex
                    && !(W::CORNERS && other.is_corner()) =>
            {
                Self::Corner(Corner {
                    pivot,
                    surface: other.surface,
                    stiction: false,
                })
            }
            [other]
                if W::EDGES
                    && pivot
                        .placed(scene)
                        .are_in_line(scene, [pivot.contact, other]) =>
            {
                Self::Edge(Edge::new(pivot, other))
            }
            [other] if W::SURFACES => Self::TwoVertex(TwoVertex::new(pivot, other)),
            [_, _, ..] if W::SURFACES => Self::Locked(Locked::new(pivot, others)),
            _ => Self::SingleVertex(SingleVertex::new(pivot)),
        }
    }
}

/// The verb of a state that does not occur in the scene, or that has no such verb.
fn absent<R: Real>() -> Moved<R> {
    Moved::by(Trigger::Undriven)
}

#[cfg(test)]
mod tests;
