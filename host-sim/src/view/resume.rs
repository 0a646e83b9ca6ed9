//! Begins a recording where the body is: a scene with this start, and the hand that holds the body there.

use stiction_core::{Hold, Present, reach_again};
use stiction_scene::SceneFile;

use stiction_live::guide::HandPose;

/// Returns a scene that begins where the body of `present` is, and the hand of its first tick. A hand that closed during the run
/// does so again: it begins at the pose where its springs are relaxed, and returns with the next tick. `now`: the pose of the
/// hand.
pub(super) fn resumed(
    scene: &SceneFile,
    present: &Present<f64>,
    now: HandPose,
) -> (SceneFile, HandPose) {
    let mut scene = scene.clone();
    let written = &mut scene.written;
    let [x, y] = present.position;
    written.start = [x, y, present.angle.radians()];
    match (present.hold, present.held) {
        (Hold::Never, _) | (Hold::Given, true) => (scene, now),
        // A holding point is only for the first hold.
        (_, false) => {
            written.holding_point = None;
            (scene, now)
        }
        (Hold::Taken, true) => {
            written.holding_point = None;
            written.reach = reach_again(&written.vertices, written.reach);
            // The hand of `present` is turned back by the body's whole turns.
            let (idle, pulling) = (HandPose::of(&present.idle()), HandPose::of(&present.hand));
            let part = |i: usize| now.pose[i] + (idle.pose[i] - pulling.pose[i]) + 0.0;
            let pose = std::array::from_fn(part);
            (scene, HandPose { pose, ..now })
        }
    }
}
