//! Level floors in pieces: a box is dragged over them as over a half-plane.

use stiction_core::Evolution;
use stiction_judge::{Frame, Status};
use stiction_tests::obstacles::Run;
use stiction_tests::obstacles::floors::Floor;
use stiction_tests::obstacles::laws::Laws;
use stiction_tests::{Number, test_each, times};

fn number_of_floors() -> u64 {
    times(20, 500)
}
/// How far the body may be from where it is on a half-plane (m, rad), a hundred times the difference of tops; and a slip farther, which may
/// begin a frame sooner or later, or not at all where the hand turns back.
const AWAY: f64 = 1e-4;

/// How far two poses are apart (m, rad).
fn apart(one: &Frame, other: &Frame) -> f64 {
    let way = |k: usize| (one.pose[k] - other.pose[k]).abs();
    way(0).max(way(1)).max(way(2))
}

/// Where a run over the pieces differs from that on the half-plane, or is not lawful.
fn fault<R: Number>(floor: &Floor, evolution: Evolution) -> Option<String> {
    let laws = Laws::new::<R>(&floor.among);
    let start = floor.hands[0];
    let mut run = Run::<R>::start(&floor.among, evolution, start);
    let mut whole = Run::<R>::start(&floor.whole, evolution, start);
    let mut slip = 0.0_f64;
    for (i, &hand) in floor.hands.iter().enumerate() {
        run.step(hand);
        whole.step(hand);
        let (frame, on_plane) = (&run.frame, &whole.frame);
        let broken = laws.broken(frame);
        let away = apart(frame, on_plane);
        for output in [&run.output, &whole.output] {
            slip = slip.max(R::wide(output.longest_slip));
        }
        if frame.status != Status::Ok || !broken.is_empty() || away > AWAY + slip {
            let (status, contacts) = (frame.status.name(), &frame.contacts);
            return Some(format!(
                "frame {i}: {away:.1e} away, {status}, {broken:?}: {contacts:?}"
            ));
        }
    }
    None
}

/// All floors of a kind, on which a box has to move as on a half-plane.
fn are_one<R: Number>(floor_of: fn(u64) -> Floor, evolution: Evolution) {
    let faults: Vec<_> = (0..number_of_floors())
        .filter_map(|number| Some((number, fault::<R>(&floor_of(number), evolution)?)))
        .collect();
    assert!(faults.is_empty(), "{} {evolution:?}: {faults:#?}", R::NAME);
}

test_each!(
    cases::pieces_of_a_level_floor_are_one,
    cases::long_blocks_side_by_side_are_one
);

mod cases {
    use super::*;

    pub(super) fn pieces_of_a_level_floor_are_one<R: Number>(evolution: Evolution) {
        are_one::<R>(Floor::of, evolution);
    }

    pub(super) fn long_blocks_side_by_side_are_one<R: Number>(evolution: Evolution) {
        are_one::<R>(Floor::of_blocks, evolution);
    }
}
