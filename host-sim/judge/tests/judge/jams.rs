//! A rod of length 1, upright between a floor and a ceiling that are both tilted so that the gap opens towards +x: a wedge that
//! holds it by friction. The reactions are chosen, and the hand is placed so that they balance it.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;

use stiction_judge::{Contact, Event, Evolution, Frame, Scene, State, Status, law};

use crate::write::{a_second_apart, broken, frame, on, only, scene};

/// k_h = k_theta = 1, mu 0.5 / 0.3, held in the middle.
fn wedge(slope: f64) -> Scene {
    let ceiling = -1.0 / slope.hypot(1.0);
    scene(&format!(
        "[body]\nvertices = [[-0.5, 0.0], [0.5, 0.0]]\nstart = [0.0, 0.5, {FRAC_PI_2:?}]\n[grasp]\npoint = [0.0, 0.0]\n\
         [spring]\ntranslation = 1.0\nrotation = 1.0\n[friction]\nstatic = 0.5\ndynamic = 0.3\n\
         [[surface]]\nname = \"floor\"\nnormal = [{slope:?}, 1.0]\noffset = 0.0\n\
         [[surface]]\nname = \"ceiling\"\nnormal = [{slope:?}, -1.0]\noffset = {ceiling:?}\n"
    ))
}

/// The rod in the position where it fits, with N of floor and ceiling, and both frictions `ratio` times as large, towards
/// the narrow end.
fn held(scene: &Scene, normals: [f64; 2], ratio: f64, sliding: Option<i8>) -> Frame {
    let (mut force, mut moment) = ([0.0; 2], 0.0);
    let mut contacts = Vec::new();
    for (vertex, side) in [1.0, -1.0].into_iter().enumerate() {
        let [x, y] = scene.surfaces[vertex].normal;
        let (normal, friction) = (normals[vertex], -side * ratio * normals[vertex]);
        let reaction = [normal * x + friction * y, normal * y - friction * x];
        force = [force[0] - reaction[0], force[1] - reaction[1]];
        // The lever is (0, -side / 2).
        moment -= side / 2.0 * reaction[0];
        contacts.push(Contact {
            touch: on(vertex, vertex),
            direction: None,
            point: [0.0, vertex as f64],
            normal,
            friction,
            sliding,
        });
    }
    Frame {
        state: State::TwoVertex,
        contacts,
        wrench: [force[0], force[1], moment],
        ..frame(
            0.0,
            [force[0], 0.5 + force[1], FRAC_PI_2 + moment],
            [0.0, 0.5, FRAC_PI_2],
        )
    }
}

/// The rod was let go: it moves to the hand of `last`.
fn let_go(last: &Frame) -> Frame {
    Frame {
        events: vec![Event::Lift],
        ..frame(1.0, last.hand, last.hand)
    }
}

fn laws(scene: &Scene, frames: impl IntoIterator<Item = Frame>) -> BTreeSet<&'static str> {
    let frames = a_second_apart(frames);
    let [path, jump] =
        [Evolution::Path, Evolution::Frame].map(|evolution| broken(scene, evolution, &frames));
    assert_eq!(path, jump);
    path
}

const REPORTED: [Option<i8>; 2] = [None, Some(0)];

#[test]
fn jam_that_holds_is_lawful() {
    let scene = wedge(0.2);
    for reported in REPORTED {
        let frames = [1.0, 1.2].map(|n| held(&scene, [n, 1.1 * n], 0.28, reported));
        assert_eq!(laws(&scene, frames), BTreeSet::new());
    }
}

#[test]
fn jam_that_is_let_go_is_found() {
    let scene = wedge(0.2);
    for reported in REPORTED {
        // Pulled outwards and up: the ceiling's gap would close.
        let [last, next] = [0.05, 0.06].map(|n| held(&scene, [n, 2.0 * n], 0.28, reported));
        let laws = laws(&scene, [last, let_go(&next)]);
        assert!(laws.contains(law::HOLDS), "{laws:?}");
    }
}

/// The hand's pull alone opens both gaps (STATICS 5).
#[test]
fn jam_that_is_pulled_apart_may_open() {
    let scene = wedge(0.2);
    for reported in REPORTED {
        let frames = [1.0, 1.2].map(|n| held(&scene, [n, n], 0.28, reported));
        let opened = let_go(&frames[1]);
        assert_eq!(laws(&scene, [frames[0].clone(), opened]), BTreeSet::new());
    }
}

/// The reactions must lie outside the cones of mu_d and inside those of mu_s: there the wedge needs stiction to hold.
#[test]
fn jam_that_needs_stiction_holds_where_it_has_it() {
    let scene = wedge(0.4);
    let next = held(&scene, [0.06, 0.12], 0.48, Some(0));
    let after = |first: Frame| laws(&scene, [first, let_go(&next)]).contains(law::HOLDS);
    assert!(after(held(&scene, [0.05, 0.1], 0.48, Some(0))));
    // Pressed inwards before: whether it has stiction is unknown; in an older trace it has.
    assert!(!after(held(&scene, [0.05, 0.05], 0.0, Some(0))));
    assert!(after(held(&scene, [0.05, 0.05], 0.0, None)));
}

/// Nothing holds a rod that is pressed inwards by less than friction pushes it out, or lifted out of one contact.
#[test]
fn contacts_that_cannot_hold_may_open() {
    let scene = wedge(0.6);
    for reported in REPORTED {
        let first = held(&scene, [0.1, 0.1], 0.0, reported);
        let mut out = first.clone();
        out.hand = [0.1, 0.5, FRAC_PI_2];
        assert_eq!(laws(&scene, [first, let_go(&out)]), BTreeSet::new());
    }
}

/// Friction of 0.5 on slopes of 0.495: a pull of 1 needs reactions of 100 and more.
#[test]
fn jammed_is_what_reactions_within_the_limit_cannot_hold() {
    let jammed = |slope: f64, normal: f64, ratio: f64, status: Status| {
        let scene = wedge(slope);
        let first = held(&scene, [1.0, 1.0], 0.0, Some(0));
        let next = Frame {
            status,
            ..held(&scene, [normal; 2], ratio, Some(0))
        };
        laws(&scene, [first, next])
    };
    for normal in [110.0, 300.0] {
        assert_eq!(jammed(0.495, normal, 0.5, Status::Jammed), BTreeSet::new());
        assert_eq!(jammed(0.495, normal, 0.5, Status::Ok), only(law::JAMMED));
    }
    assert_eq!(jammed(0.495, 50.0, 0.5, Status::Ok), BTreeSet::new());
    // It holds as long as the pull lasts.
    let scene = wedge(0.495);
    let then = |status: Status, normal: f64, ratio: f64| {
        let start = held(&scene, [1.0; 2], 0.0, Some(0));
        let mut first = held(&scene, [200.0; 2], 0.5, Some(0));
        let mut second = held(&scene, [normal; 2], ratio, Some(0));
        (first.status, second.status) = (Status::Jammed, status);
        laws(&scene, [start, first, second])
    };
    assert_eq!(then(Status::Jammed, 210.0, 0.5), BTreeSet::new());
    assert_eq!(then(Status::Ok, 210.0, 0.5), only(law::JAMMED));
    // Pressed inwards again.
    assert_eq!(then(Status::Jammed, 2.0, 0.0), only(law::JAMMED));
    assert_eq!(then(Status::Ok, 2.0, 0.0), BTreeSet::new());
}

#[test]
fn jammed_body_stays_and_keeps_its_contacts() {
    let scene = wedge(0.495);
    let first = held(&scene, [1.0, 1.0], 0.0, Some(0));
    let jammed = |change: &dyn Fn(&mut Frame)| {
        let mut next = held(&scene, [200.0; 2], 0.5, Some(0));
        next.status = Status::Jammed;
        // The reported reactions need not balance.
        next.contacts.iter_mut().for_each(|c| c.normal = 128.0);
        change(&mut next);
        laws(&scene, [first.clone(), next])
    };
    assert_eq!(jammed(&|_| {}), BTreeSet::new());
    let moved = jammed(&|frame| {
        frame.pose[0] += 1e-5;
        frame.contacts.iter_mut().for_each(|c| c.point[0] += 1e-5);
    });
    assert!(moved.contains(law::RESTS), "{moved:?}");
    let dropped = jammed(&|frame| {
        frame.contacts.pop();
        frame.state = State::SingleVertex;
    });
    assert_eq!(dropped, BTreeSet::from([law::JAMMED, law::COME_AND_GO]));
}

/// If the hand's path is not followed to its end, the reported hand is not the one that balances the body.
#[test]
fn body_that_is_behind_is_not_asked_for_balance() {
    let scene = wedge(0.2);
    let frames = |status| {
        let frames = [1.0, 1.2].map(|n| held(&scene, [n, 1.1 * n], 0.28, Some(0)));
        let [first, mut second] = frames;
        second.hand[0] += 0.01;
        second.status = status;
        second.behind = (status == Status::Behind).then_some(0.5);
        laws(&scene, [first, second])
    };
    assert_eq!(frames(Status::Behind), BTreeSet::new());
    assert!(frames(Status::Twist).contains(law::FORCES));
}
