//! The body of a board according to its last answer: nothing moves it here.

use stiction_core::{Angle, Hand, Hold, Present, Wrench};

use stiction_live::body::{Body, Setting};
use stiction_live::record::Frame;

/// The last answer of a board.
#[derive(Clone, Debug)]
pub(super) struct Mirror {
    frame: Frame,
    /// The sample that it answered.
    pub(super) hand: Hand<f64>,
    hold: Hold,
    stiffness: [f64; 2],
    holding_point: Option<[f64; 2]>,
}

impl Mirror {
    /// Creates it from an answer; `before`: the previous state of the body.
    pub(super) fn of(frame: &Frame, before: Present<f64>, setting: &Setting) -> Self {
        let [x, y, phi] = frame.hand;
        Self {
            frame: frame.clone(),
            hand: Hand {
                position: [x, y],
                angle: Angle::from_radians(phi),
                depth: frame.depth,
                held: frame.held,
                tilted: false,
            },
            hold: before.hold.after(&frame.events, frame.held),
            stiffness: [
                setting.scene.stiffness_translation,
                setting.scene.stiffness_rotation,
            ],
            holding_point: setting.scene.holding_point,
        }
    }
}

impl Body for Mirror {
    fn step(&mut self, _hand: &Hand<f64>) {}

    fn frame(&self, t: f64) -> Frame {
        Frame {
            t,
            ..self.frame.clone()
        }
    }

    fn present(&self) -> Present<f64> {
        let [x, y, theta] = self.frame.pose;
        let [fx, fy, moment] = self.frame.wrench;
        let angle = Angle::from_radians(theta);
        Present {
            position: [x, y],
            angle,
            held: self.frame.held,
            hold: self.hold,
            holding_point: self.holding_point,
            hand: self.hand.turned(angle.turns.saturating_neg()),
            wrench: Wrench {
                force: [fx, fy],
                moment,
            },
            stiffness: self.stiffness,
        }
    }

    fn copy(&self) -> Box<dyn Body> {
        Box::new(self.clone())
    }
}
