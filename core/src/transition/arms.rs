//! The arms of the transition table, each with its physics in a sentence.

macro_rules! transitions {
    ($($name:ident: $text:literal),+ $(,)?) => {
        /// An arm of the transition table.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[repr(u8)]
        pub enum Transition {
            $(#[doc = $text] $name),+
        }

        impl Transition {
            /// All arms, in the order of the table.
            pub const ALL: &'static [Self] = &[$(Self::$name),+];

            /// The physics of the arm in a sentence.
            pub const fn describe(self) -> &'static str {
                match self {
                    $(Self::$name => $text),+
                }
            }
        }
    };
}

transitions! {
    FreeMoves: "No contact: the body follows the hand.",
    FreeFolds: "No contact: the weight turns the body over a fold of its balance.",
    FreeTouches: "A vertex reaches a surface: single-vertex.",
    FreeLands: "Two vertices reach one surface together: edge.",
    FreeTouchesTwo: "Two vertices reach two surfaces together: two-vertex.",
    FreeCorners: "A vertex reaches two surfaces together: corner.",
    FreeJams: "Three contacts or more close together: locked.",
    VertexSticks: "The reaction lies in the friction cone: the vertex stays.",
    VertexSnaps: "The angle's branch folds: the body turns about the vertex to the next balance.",
    VertexSlips: "Friction gives way: the vertex slips until |T| = mu_d N.",
    VertexLifts: "N falls to zero: the vertex leaves the surface.",
    VertexLands: "A second vertex reaches the same surface: edge.",
    VertexTouchesTwo: "A second vertex reaches another surface: two-vertex.",
    VertexCorners: "The vertex itself reaches another surface: corner.",
    VertexJams: "Two more contacts close together: locked.",
    EdgeSticks: "The total reaction lies in the friction cone: the edge stays.",
    EdgeTips: "N_i falls to zero: the body tips about the other vertex.",
    EdgeTipsSliding: "N_i falls to zero in mid-slip: the other vertex slides on.",
    EdgeSlips: "Friction gives way: the edge slips until |T| = mu_d N.",
    EdgeLifts: "Both N_i are negative: the edge leaves the surface.",
    EdgeJams: "A vertex reaches another surface: locked.",
    TwoSticks: "Some internal force keeps both reactions in their cones: the pose stays.",
    TwoOpens: "One reaction vanishes, or no slip is driven: the other vertex remains.",
    TwoSlips: "Two cone edges bind and the trammel is driven: it slips to balance at mu_d.",
    TwoOpensSliding: "One reaction vanishes in mid-slip: the other vertex slides on.",
    TwoJams: "A further vertex reaches a surface: locked.",
    CornerSticks: "The reaction lies in the sum of the two cones: the vertex stays in the corner.",
    CornerSnaps: "The angle's branch folds: the body turns about the corner to the next balance.",
    CornerSlides: "The reaction leaves the sum of the cones: the vertex slides along one surface.",
    CornerLifts: "Both reactions are negative: the vertex leaves the corner.",
    CornerJams: "A further vertex reaches a surface: locked.",
    LockedHolds: "The contacts together bear the load: the pose stays.",
    LockedTips: "All reactions but one vanish: the body turns about one vertex.",
    LockedSlidesEdge: "Two contacts of one surface remain and slide: edge.",
    LockedSlidesTwo: "Two contacts of two surfaces remain and slide: two-vertex.",
    LockedCorners: "The two contacts of one vertex remain: corner.",
    Stays: "No mode of motion is consistent with friction: the body stays.",
}

/// A set of arms of the transition table.
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
    pub(super) fn add(&mut self, arm: Transition) {
        self.0 |= Self::bit(arm);
    }
    const fn bit(arm: Transition) -> u64 {
        1_u64.wrapping_shl(arm as u32)
    }
}
