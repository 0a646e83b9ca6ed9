//! Faults in a lawful trace: each is found, under the name of its law. Single numbers and events that are wrong, slips that are too
//! short, too long or early, and creep, are among the mutants of true traces, in the test `mutations`.

use std::collections::BTreeSet;

use stiction_judge::{Event, Evolution, Frame, Scene, State, Status, law};

use crate::drag::{drag, drag_scene};
use crate::write::{broken, judged, lines, on, only};

/// The laws that the dragged box breaks after a fault in one of its frames.
fn after(frame: usize, fault: impl FnOnce(&mut Frame)) -> BTreeSet<&'static str> {
    let mut frames = drag(false);
    fault(&mut frames[frame]);
    broken(&drag_scene(), Evolution::Path, &frames)
}

/// A frame in which the box sticks, and the frame in which the release begins.
const STICKS: usize = 5;
const RELEASED: usize = 42;

#[test]
fn dragged_box_is_lawful_in_both_evolutions() {
    let scene = drag_scene();
    let none = BTreeSet::new();
    assert_eq!(broken(&scene, Evolution::Path, &drag(false)), none);
    assert_eq!(broken(&scene, Evolution::Frame, &drag(true)), none);
}

/// With path evolution, a slip begins on the path; one that begins at the end of a jump is a different slip. With frame
/// evolution, it may be either.
#[test]
fn jumps_are_not_the_path() {
    let laws = broken(&drag_scene(), Evolution::Path, &drag(true));
    assert_eq!(laws, only(law::SLIP_ENDS));
    for jumps in [false, true] {
        let frames = drag(jumps);
        assert_eq!(
            broken(&drag_scene(), Evolution::Frame, &frames),
            BTreeSet::new()
        );
    }
}

#[test]
fn last_slip_of_several_is_judged() {
    // One frame that contains more than two slips: the second or a later one ends at mu_d N somewhere on its path.
    let (scene, whole) = (drag_scene(), drag(false));
    let slips: Vec<usize> = (0..RELEASED).filter(|&i| whole[i].slips > 0).collect();
    let mut frames = whole[..slips[0]].to_vec();
    let mut end = whole[slips[2]].clone();
    end.slips = 3;
    frames.push(end);
    assert_eq!(broken(&scene, Evolution::Path, &frames), BTreeSet::new());
    // 3 mm before a position at which a third slip could have ended.
    let mut short = whole[..slips[0]].to_vec();
    let mut end = whole[slips[0] - 1].clone();
    (end.slips, end.events, end.t) = (2, vec![Event::Slip], end.t + 1.0);
    (end.hand[0], end.pose[0]) = (end.hand[0] - 0.005, end.pose[0] - 0.005);
    end.contacts.iter_mut().for_each(|c| c.point[0] -= 0.005);
    short.push(end);
    assert_eq!(
        broken(&scene, Evolution::Frame, &short),
        only(law::SLIP_LAST)
    );
}

#[test]
fn hold_that_is_not_reported_is_found() {
    assert_eq!(
        after(RELEASED, |frame| frame.events.clear()),
        only(law::HOLD)
    );
    assert_eq!(
        after(RELEASED + 2, |frame| frame.events.clear()),
        only(law::HOLD)
    );
    assert_eq!(
        after(RELEASED, |frame| frame.wrench[0] = 1e-3),
        only(law::IDLE)
    );
    // The hand grasped again, at another point and turned.
    assert_eq!(
        after(RELEASED + 3, |frame| frame.wrench[0] += 1e-3),
        only(law::WRENCH)
    );
}

#[test]
fn body_that_moves_by_itself_is_found() {
    let away = |frame: &mut Frame| {
        frame.pose[0] += 1e-5;
        frame.contacts.iter_mut().for_each(|c| c.point[0] += 1e-5);
    };
    let released = after(RELEASED + 1, away);
    assert!(released.contains(law::RESTS), "{released:?}");
    for status in [Status::HeldLast, Status::Saturated] {
        // The previous frame again: a hand that is not used, or a body that nothing can balance.
        let again = |moves: bool| {
            let mut frames = drag(false)[..=STICKS].to_vec();
            let mut frame = frames[STICKS].clone();
            (frame.t, frame.status) = (frame.t + 1.0, status);
            if moves {
                away(&mut frame);
            }
            frames.push(frame);
            broken(&drag_scene(), Evolution::Path, &frames)
        };
        assert_eq!(again(false), BTreeSet::new());
        assert!(again(true).contains(law::RESTS), "{status:?}");
    }
    // `ambiguous` means out of balance, but not for a body that could stay or move.
    let unbalanced = |status| {
        after(STICKS, |frame| {
            (frame.status, frame.contacts[0].normal) = (status, 0.1);
        })
    };
    assert!(unbalanced(Status::Ambiguous).contains(law::STATUS));
    assert!(unbalanced(Status::EventLimit).contains(law::FORCES));
    // As long as the hand is not used, this does not change.
    let mut frames = drag(false)[..=STICKS].to_vec();
    let mut frame = frames[STICKS].clone();
    frame.contacts[0].normal = 0.1;
    for status in [Status::Ambiguous, Status::HeldLast, Status::HeldLast] {
        (frame.t, frame.status) = (frame.t + 1.0, status);
        frames.push(frame.clone());
    }
    assert_eq!(
        broken(&drag_scene(), Evolution::Path, &frames),
        only(law::STATUS)
    );
}

/// A scene that gives less than it could.
#[test]
fn holding_point_comes_from_the_hand_where_the_scene_has_none() {
    let scene = Scene {
        holding_point: None,
        ..drag_scene()
    };
    let mut frames = drag(false);
    // The body is grasped where it is: the first hand is at the point that the scene would name.
    frames[0].events = vec![Event::Grasp];
    assert_eq!(broken(&scene, Evolution::Path, &frames), BTreeSet::new());
    frames[0].events.clear();
    assert_eq!(broken(&scene, Evolution::Path, &frames), only(law::HOLD));
}

/// A row of CSV has columns for four contacts: further contacts are not held against the balance.
#[test]
fn contacts_that_a_row_has_no_room_for_are_not_held_against_it() {
    let mut scene = drag_scene();
    scene.surfaces[1].normal = [0.0, -1.0];
    scene.surfaces[1].offset = -0.06;
    let mut frame = drag(false)[1].clone();
    for vertex in [2, 3] {
        let mut contact = frame.contacts[0];
        contact.touch = on(vertex, 1);
        contact.point = [if vertex == 2 { 0.05 } else { -0.05 }, 0.06];
        frame.contacts.push(contact);
    }
    frame.state = State::Locked;
    let broken = |format: &str| {
        let text = lines(format, &scene, std::slice::from_ref(&frame)).join("\n");
        let survey = judged(&scene, Evolution::Path, format, &text).expect("a trace");
        survey.laws[law::WRENCH].broken + survey.laws.get(law::FORCES).map_or(0, |law| law.broken)
    };
    assert_eq!((broken("jsonl"), broken("csv")), (1, 0));
}
