//! A recording begins where the body is: the scene whose start that is, and the hand that holds the body there.

use stiction_scene::SceneFile;

use crate::body::{Hold, Present, within_reach};
use stiction_live::guide::HandPose;

/// The scene that begins where the body of `present` is, and the hand of its first tick. A hand that took hold on the way does so
/// again: it begins where it pulls at nothing, and comes back with the next tick. `now`: where the hand is.
pub(super) fn resumed(
    scene: &SceneFile,
    present: &Present,
    now: HandPose,
) -> (SceneFile, HandPose) {
    let mut scene = scene.clone();
    let written = &mut scene.written;
    let [x, y] = present.position;
    written.start = [x, y, present.angle.radians()];
    match (present.hold, present.held) {
        (Hold::Never, _) | (Hold::Given, true) => (scene, now),
        // A holding point is for the first hold only.
        (_, false) => {
            written.holding_point = None;
            (scene, now)
        }
        (Hold::Taken, true) => {
            written.holding_point = None;
            written.reach = within_reach(written, written.reach);
            // The hand of `present` is turned back by the whole turns of the body.
            let (idle, pulling) = (HandPose::of(&present.idle()), HandPose::of(&present.hand));
            let part = |i: usize| now.pose[i] + (idle.pose[i] - pulling.pose[i]) + 0.0;
            let pose = std::array::from_fn(part);
            (scene, HandPose { pose, ..now })
        }
    }
}
