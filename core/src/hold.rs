//! How the hand came to hold the body: at the scene's holding point, or where the hand was.

use crate::event::Event;

/// How the hand came to hold the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Hold {
    /// It has not held it yet.
    #[default]
    Never,
    /// At the holding point of the scene.
    Given,
    /// Where the hand was when it took hold.
    Taken,
}

impl Hold {
    /// The hold after a step with these events that left the body `held`, for one who has the answers but not the [`State`](crate::State).
    #[must_use]
    pub fn after(self, events: &[Event], held: bool) -> Self {
        if events.contains(&Event::Grasp) {
            Self::Taken
        } else if held && self == Self::Never {
            Self::Given
        } else {
            self
        }
    }
}
