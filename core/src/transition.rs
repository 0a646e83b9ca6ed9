//! The transition table (STATICS 8): its arms, each with its two states and its physics in a sentence; sets of arms; and the arm and the
//! event for each change of the state.

use crate::event::{Event, StateKind};
use crate::real::Real;
use crate::state::ContactState;

macro_rules! transitions {
    ($($name:ident $(($before:ident -> $after:ident))?: $text:literal),+ $(,)?) => {
        /// An arm of the transition table (STATICS 8): from which contact state to which, and why.
        ///
        /// ```
        /// use stiction_core::{StateKind, Transition};
        ///
        /// assert_eq!(Transition::EdgeTips.before(), Some(StateKind::Edge));
        /// assert_eq!(Transition::EdgeTips.after(), Some(StateKind::SingleVertex));
        /// assert_eq!(
        ///     Transition::EdgeTips.describe(),
        ///     "N_i falls to zero: the body tips about the other vertex."
        /// );
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[repr(u8)]
        pub enum Transition {
            $(#[doc = $text] $name),+
        }

        impl Transition {
            /// All arms, in the order of the table.
            pub const ALL: &'static [Self] = &[$(Self::$name),+];

            /// The physics of the arm in a sentence: the condition, a colon, what follows from it.
            pub const fn describe(self) -> &'static str {
                match self {
                    $(Self::$name => $text),+
                }
            }

            /// The state that the arm leaves. `None` only for [`Self::Stays`], which every state has.
            pub const fn before(self) -> Option<StateKind> {
                match self {
                    $(Self::$name => transitions!(@state $($before)?)),+
                }
            }

            /// The state that the arm leads to; that of [`Self::before`] if it stays the same.
            pub const fn after(self) -> Option<StateKind> {
                match self {
                    $(Self::$name => transitions!(@state $($after)?)),+
                }
            }
        }
    };
    (@state) => { None };
    (@state $kind:ident) => { Some(StateKind::$kind) };
}

transitions! {
    FreeMoves(NonContact -> NonContact): "No surface is reached: the body follows the hand.",
    FreeFolds(NonContact -> NonContact): "The balance of the weight folds: the body turns over to the next one.",
    FreeTouches(NonContact -> SingleVertex): "A vertex reaches a surface: single-vertex.",
    FreeLands(NonContact -> Edge): "Two vertices reach one surface together: edge.",
    FreeTouchesTwo(NonContact -> TwoVertex): "Two vertices reach two surfaces together: two-vertex.",
    FreeCorners(NonContact -> Corner): "A vertex reaches two surfaces together: corner.",
    FreeJams(NonContact -> Locked): "Three contacts or more close together: locked.",
    VertexSticks(SingleVertex -> SingleVertex): "The reaction lies in the friction cone: the vertex stays.",
    VertexSnaps(SingleVertex -> SingleVertex): "The angle's branch folds: the body turns about the vertex to the next balance.",
    VertexSlips(SingleVertex -> SingleVertex): "Friction gives way with stiction: the vertex slips until |T| = mu_d N.",
    VertexSlides(SingleVertex -> SingleVertex): "Friction is mu_d N without stiction: the vertex slides with the hand.",
    VertexStops(SingleVertex -> SingleVertex): "The slide comes to a halt, or N rises to N*: the vertex sticks.",
    VertexLifts(SingleVertex -> NonContact): "N falls to zero: the vertex leaves the surface.",
    VertexLands(SingleVertex -> Edge): "A second vertex reaches the same surface: edge.",
    VertexTouchesTwo(SingleVertex -> TwoVertex): "A second vertex reaches another surface: two-vertex.",
    VertexCorners(SingleVertex -> Corner): "The vertex itself reaches another surface: corner.",
    VertexJams(SingleVertex -> Locked): "Two more contacts close together: locked.",
    EdgeSticks(Edge -> Edge): "The total reaction lies in the friction cone: the edge stays.",
    EdgeTips(Edge -> SingleVertex): "N_i falls to zero: the body tips about the other vertex.",
    EdgeTipsSliding(Edge -> SingleVertex): "N_i falls to zero in mid-slip: the other vertex slides on.",
    EdgeSlips(Edge -> Edge): "Friction gives way with stiction: the edge slips until |T| = mu_d N.",
    EdgeSlides(Edge -> Edge): "Friction is mu_d N without stiction: the edge slides with the hand.",
    EdgeStops(Edge -> Edge): "The slide comes to a halt, or N rises to N*: the edge sticks.",
    EdgeLifts(Edge -> NonContact): "Both N_i are negative: the edge leaves the surface.",
    EdgeJams(Edge -> Locked): "A vertex reaches another surface: locked.",
    TwoSticks(TwoVertex -> TwoVertex): "Some internal force keeps both reactions in their cones: the pose stays.",
    TwoOpens(TwoVertex -> SingleVertex): "One reaction vanishes, or no slip is driven: the other vertex remains.",
    TwoLifts(TwoVertex -> NonContact): "Both reactions are negative: the body leaves both surfaces.",
    TwoSlips(TwoVertex -> TwoVertex): "Two cone edges bind and the trammel is driven: it slips to balance at mu_d.",
    TwoSlides(TwoVertex -> TwoVertex): "Two dynamic cone edges bind without stiction: the trammel slides with the hand.",
    TwoStops(TwoVertex -> TwoVertex): "The slide halts, or a slip would be as long as the memory: both stick.",
    TwoSnaps(TwoVertex -> TwoVertex): "The balance of a slide folds: both slip on to the next one.",
    TwoOpensSliding(TwoVertex -> SingleVertex): "One reaction vanishes in mid-slip: the other vertex slides on.",
    TwoJams(TwoVertex -> Locked): "A further vertex reaches a surface: locked.",
    CornerSticks(Corner -> Corner): "The reaction lies in the sum of the two cones: the vertex stays in the corner.",
    CornerSnaps(Corner -> Corner): "The angle's branch folds: the body turns about the corner to the next balance.",
    CornerSlides(Corner -> SingleVertex): "The reaction leaves the sum of the cones: the vertex slides along one surface.",
    CornerLifts(Corner -> NonContact): "Both reactions are negative: the vertex leaves the corner.",
    CornerJams(Corner -> Locked): "A further vertex reaches a surface: locked.",
    LockedHolds(Locked -> Locked): "The contacts together bear the load: the pose stays.",
    LockedTips(Locked -> SingleVertex): "All reactions but one vanish: the body turns about one vertex, or slides on it.",
    LockedSlidesEdge(Locked -> Edge): "Two contacts of one surface remain and slide: edge.",
    LockedSlidesTwo(Locked -> TwoVertex): "Two contacts of two surfaces remain and slide: two-vertex.",
    LockedCorners(Locked -> Corner): "The two contacts of one vertex remain: corner.",
    LockedLifts(Locked -> NonContact): "All reactions are negative: the body leaves all surfaces.",
    Stays: "No mode of motion is consistent with friction: the body stays.",
}

/// A set of arms of the transition table: those taken in a frame ([`Output::transitions`](crate::Output::transitions)). It contains which
/// ones, not how often or in which order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Transitions(u64);

impl Transitions {
    /// True if the arm was taken.
    pub const fn contains(self, arm: Transition) -> bool {
        self.0 & Self::bit(arm) != 0
    }
    /// The arms in the set, in the order of the table.
    pub fn iter(self) -> impl Iterator<Item = Transition> {
        let arms = Transition::ALL.iter().copied();
        arms.filter(move |&arm| self.contains(arm))
    }
    /// The union with another set.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
    pub(crate) fn add(&mut self, arm: Transition) {
        self.0 |= Self::bit(arm);
    }
    const fn bit(arm: Transition) -> u64 {
        1_u64.wrapping_shl(arm as u32)
    }
}

/// The arm of a state that rests.
pub(crate) fn rest_arm<R: Real>(state: &ContactState<R>) -> Transition {
    match state {
        ContactState::Free(_) => Transition::FreeMoves,
        ContactState::SingleVertex(_) => Transition::VertexSticks,
        ContactState::Edge(_) => Transition::EdgeSticks,
        ContactState::TwoVertex(_) => Transition::TwoSticks,
        ContactState::Corner(_) => Transition::CornerSticks,
        ContactState::Locked(_) => Transition::LockedHolds,
    }
}

/// The arm of a slip that ended at mu_d N.
pub(crate) fn slip_arm<R: Real>(state: &ContactState<R>) -> Transition {
    match state.kind() {
        StateKind::Edge => Transition::EdgeSlips,
        StateKind::TwoVertex => Transition::TwoSlips,
        StateKind::NonContact | StateKind::SingleVertex | StateKind::Corner | StateKind::Locked => {
            Transition::VertexSlips
        }
    }
}

/// The arm of contacts that begin to slide with the hand.
pub(crate) fn slide_arm<R: Real>(state: &ContactState<R>) -> Transition {
    match state.kind() {
        StateKind::Edge => Transition::EdgeSlides,
        StateKind::TwoVertex => Transition::TwoSlides,
        StateKind::NonContact | StateKind::SingleVertex | StateKind::Corner | StateKind::Locked => {
            Transition::VertexSlides
        }
    }
}

/// The arm of contacts that stick after a slide.
pub(crate) fn halt_arm<R: Real>(state: &ContactState<R>) -> Transition {
    match state.kind() {
        StateKind::Edge => Transition::EdgeStops,
        StateKind::TwoVertex => Transition::TwoStops,
        StateKind::NonContact | StateKind::SingleVertex | StateKind::Corner | StateKind::Locked => {
            Transition::VertexStops
        }
    }
}

/// The arm of a balance that folds.
pub(crate) fn fold_arm<R: Real>(state: &ContactState<R>) -> Transition {
    match state.kind() {
        StateKind::NonContact => Transition::FreeFolds,
        StateKind::TwoVertex => Transition::TwoSnaps,
        StateKind::Corner => Transition::CornerSnaps,
        StateKind::SingleVertex | StateKind::Edge | StateKind::Locked => Transition::VertexSnaps,
    }
}

/// The arm of a body that leaves all surfaces.
pub(crate) fn clear_arm<R: Real>(state: &ContactState<R>) -> Transition {
    match state.kind() {
        StateKind::Edge => Transition::EdgeLifts,
        StateKind::TwoVertex => Transition::TwoLifts,
        StateKind::Corner => Transition::CornerLifts,
        StateKind::Locked => Transition::LockedLifts,
        StateKind::NonContact | StateKind::SingleVertex => Transition::VertexLifts,
    }
}

/// The arm and the event of an additional contact.
pub(crate) fn touch_arm(before: StateKind, after: StateKind) -> (Transition, Event) {
    use StateKind as Kind;
    match before {
        Kind::NonContact => match after {
            Kind::Edge => (Transition::FreeLands, Event::Land),
            Kind::TwoVertex => (Transition::FreeTouchesTwo, Event::Touch),
            Kind::Corner => (Transition::FreeCorners, Event::Touch),
            Kind::Locked => (Transition::FreeJams, Event::Jam),
            Kind::NonContact | Kind::SingleVertex => (Transition::FreeTouches, Event::Touch),
        },
        Kind::SingleVertex => match after {
            Kind::Edge => (Transition::VertexLands, Event::Land),
            Kind::Corner => (Transition::VertexCorners, Event::Touch),
            Kind::Locked => (Transition::VertexJams, Event::Jam),
            Kind::NonContact | Kind::SingleVertex | Kind::TwoVertex => {
                (Transition::VertexTouchesTwo, Event::Touch)
            }
        },
        Kind::Edge => (Transition::EdgeJams, Event::Jam),
        Kind::Corner => (Transition::CornerJams, Event::Jam),
        Kind::TwoVertex | Kind::Locked => (Transition::TwoJams, Event::Jam),
    }
}

/// The arm and the event of contacts that open, with or without a slide of those that last.
pub(crate) fn keep_arm(before: StateKind, after: StateKind, sliding: bool) -> (Transition, Event) {
    use StateKind as Kind;
    match before {
        Kind::Edge if sliding => (Transition::EdgeTipsSliding, Event::Tip),
        Kind::Edge => (Transition::EdgeTips, Event::Tip),
        Kind::TwoVertex if sliding => (Transition::TwoOpensSliding, Event::Lift),
        Kind::TwoVertex => (Transition::TwoOpens, Event::Lift),
        Kind::Corner => (Transition::CornerSlides, Event::Lift),
        Kind::NonContact | Kind::SingleVertex | Kind::Locked => match after {
            Kind::Edge => (Transition::LockedSlidesEdge, Event::Lift),
            Kind::TwoVertex => (Transition::LockedSlidesTwo, Event::Lift),
            Kind::Corner => (Transition::LockedCorners, Event::Lift),
            Kind::NonContact | Kind::SingleVertex | Kind::Locked => {
                (Transition::LockedTips, Event::Tip)
            }
        },
    }
}
