//! The cases of `cases/obstacles.json`: scene, path of the hand, and values known to 15 digits or more from the balance of the contacts.
//!
//! The reference finds the position of a touch to 1e-12 body sizes, and a force at the edge of its cone to 1e-12 of the spring force
//! at a deflection of one body size, which is some ten times the force in these cases. Errors reached: 2e-12 in poses and 3e-11 in
//! forces if a slip begins at such a position; 1e-14 if nothing slips.

use stiction_tests::close;
use stiction_tests::obstacles::Among;
use stiction_tests::obstacles::answers::frame_of;
use stiction_tests::obstacles::cases::{Case, all};
use stiction_tests::obstacles::judged::{answer, within};
use stiction_tests::reference::Reference;

/// The number of substeps per frame for the hand.
const SUBSTEPS: usize = 20;
/// Largest error of a pose in body sizes and rad.
const POSE: f64 = 5e-12;
/// Largest error of a force, relative to the largest force of its frame.
const FORCE: f64 = 1e-10;
/// The number of cases that are run; the remaining one must be refused by the reader.
const RUN: usize = 15;

/// Poses, forces and contacts of a run; each frame is passed to `look`.
pub(crate) fn run(
    among: &Among,
    case: &Case,
    mut look: impl FnMut(usize, &Reference, ([f64; 3], u32)),
) {
    let mut body = Reference::new(among.reference(), among.setup.start, case.hands[0]);
    let mut slips = 0;
    for (frame, &hand) in case.hands.iter().enumerate() {
        if frame > 0 {
            body.step(hand, SUBSTEPS);
            assert!(!body.ambiguous() && !body.skipped(), "frame {frame}");
            slips += body.slips();
        }
        look(frame, &body, (hand, slips));
    }
}

pub(crate) fn cases() -> Vec<Case> {
    all().into_iter().filter(|case| !case.refused).collect()
}

#[test]
fn every_case_has_its_known_answer() {
    let cases = cases();
    assert_eq!(cases.len(), RUN);
    for case in cases {
        println!("{}", case.name);
        let scene = case.among.reference();
        run(&case.among, &case, |frame, body, (hand, slips)| {
            let answer = answer(&frame_of(&scene, body, (0.0, hand)), slips);
            for check in case.checks.iter().filter(|check| check.frame == frame) {
                let bound = if check.value.is_pose() { POSE } else { FORCE };
                assert_eq!(within(check, &answer, bound), Ok(()));
            }
        });
    }
}

#[test]
fn a_block_as_large_as_a_floor_is_one() {
    let case = cases().into_iter().find(|case| case.twin.is_some());
    let case = case.expect("the case of a block");
    let plane = case.twin.clone().expect("its half-plane");
    let mut path = Vec::new();
    run(&plane, &case, |_, body, _| {
        path.push((body.pose(), body.slips()))
    });
    let mut path = path.into_iter();
    run(&case.among, &case, |frame, body, _| {
        let (pose, slips) = path.next().expect("as many frames");
        assert_eq!(body.slips(), slips, "frame {frame}");
        let same = body.pose().into_iter().zip(pose);
        same.for_each(|(got, want)| close("pose", got, want, POSE));
    });
}
