//! The range that a number type represents, and what it reports beyond that: scenes, hands and grasps far out.

use stiction_core::{Evolution, Fixed, Parameter, Real, SceneError, StateKind, Status};
use stiction_tests::setup::VERTICES;
use stiction_tests::{Number, Run, RunOf, Setup, close, test_each};

test_each!(
    cases::pull_counts_from_the_body,
    cases::hand_takes_hold_wound_up_to_a_bound,
    cases::springs_of_a_body_at_rest_are_reported_as_they_are,
    cases::scene_goes_as_far_as_the_numbers,
);

/// The farthest coordinate that is accepted (L).
fn range<R: Number>() -> f64 {
    R::wide(R::RANGE.to_si(R::si(1.0)))
}

/// The largest angle by which a hand may be turned against the body that it holds (rad).
fn most_turn<R: Number>() -> f64 {
    f64::min(1e5, R::wide(R::HUGE.to_si(R::si(1.0))) / 2.0)
}

mod cases {
    use super::*;

    /// A hand near a body is near it wherever both are, and far from it if it is on the other side of the origin.
    pub(super) fn pull_counts_from_the_body<R: Number>(evolution: Evolution) {
        let setup = |x: f64, y: f64| Setup::rod(1.0).held_at([0.0; 2]).at([x, y, 0.0]);
        let far = 0.7 * range::<R>();
        for (x, y) in [(far, 0.0), (-far, 0.0), (0.0, far), (0.0, -far)] {
            let near = Run::<R>::start(&setup(x, y), evolution, [x, y, 0.0]).frame;
            assert_eq!((near.held, near.status), (true, Status::Ok), "{x} {y}");
            let beyond = Run::<R>::start(&setup(x, y), evolution, [-x, -y, 0.0]).frame;
            let refused = (false, Status::Saturated);
            assert_eq!((beyond.held, beyond.status), refused, "{x} {y}");
            assert_eq!(beyond.pose, near.pose);
        }
    }

    /// A hand can grasp a body that it is turned against by up to 10^5 rad, in fixed point up to 64 rad (R44). Its
    /// angle in the world does not matter.
    pub(super) fn hand_takes_hold_wound_up_to_a_bound<R: Number>(evolution: Evolution) {
        let most = most_turn::<R>();
        for theta in [0.0, -40.0, 300.0] {
            let setup = Setup::rod(1.0).springs(1.0, 0.5).at([0.0, 0.0, theta]);
            for (turn, holds) in [(0.985, true), (1.015, false)] {
                for sign in [-1.0, 1.0] {
                    let hand = theta + sign * turn * most;
                    let frame = Run::<R>::start(&setup, evolution, [0.0, 0.0, hand]).frame;
                    let status = if holds { Status::Ok } else { Status::Saturated };
                    assert_eq!((frame.held, frame.status), (holds, status), "{hand}");
                    let follows = if holds { hand } else { theta };
                    close("theta", frame.pose[2], follows, 1e-6 * most);
                }
            }
        }
    }

    /// A rod in a slot cannot turn, and a block on a floor does not lift: in certified frames, too, the spring forces are reported as they
    /// are, or refused beyond the range of the number type.
    pub(super) fn springs_of_a_body_at_rest_are_reported_as_they_are<R: Number>(
        evolution: Evolution,
    ) {
        let most = most_turn::<R>();
        let slot = Setup::rod(1.0)
            .held_at([0.5, 0.0])
            .springs(1.0, 0.1 * 64.0 / most)
            .floor([0.5, 0.3])
            .surface([0.0, -1.0], 0.0, [0.5, 0.3]);
        let mut run = Run::<R>::start(&slot, evolution, [0.5, 0.0, 0.0]);
        for i in 1..=120 {
            let turn = (f64::from(i) - 0.5) * most / 50.0;
            let frame = run.step([0.5, 0.0, turn]);
            let carried = turn <= most;
            let status = if carried {
                Status::Ok
            } else {
                Status::Saturated
            };
            assert_eq!(frame.status, status, "{turn}");
            let reported = if carried { turn } else { 0.99 * most };
            close("moment", frame.wrench[2], 6.4 * reported / most, 1e-3);
        }
        // Pressed down, with its middle above the floor.
        let range = range::<R>();
        let block = Setup::block(0.8, 0.6)
            .held_at([0.0, 0.3])
            .at([0.0, 0.0, 0.0])
            .floor([0.5, 0.3]);
        let mut run = Run::<R>::start(&block, evolution, [0.0, 0.3, 0.0]);
        for i in 1..=120 {
            let pull = (f64::from(i) - 0.5) * range / 50.0;
            let frame = run.step([0.0, 0.3 - pull, 0.0]);
            let reported = -frame.wrench[1];
            if frame.status == Status::Ok {
                close("pull", reported, pull, 1e-3 * range);
                assert!(pull <= range, "{pull}");
            } else {
                assert!(
                    pull > 0.9 * range && frame.status == Status::Saturated,
                    "{pull} {frame:?}"
                );
            }
        }
    }

    /// Every number of a scene, to just below the range of the type and just above it.
    pub(super) fn scene_goes_as_far_as_the_numbers<R: Number>(_: Evolution) {
        let body = || Setup::rod(1.0);
        // Coordinates count from where the body's first vertex starts, in floats.
        let from_origin = R::wide(R::Si::RANGE);
        let setups = |part: f64| {
            let far = part * range::<R>();
            let mut aside = body();
            for vertex in &mut aside.vertices {
                vertex[0] += far;
            }
            [
                (Parameter::Vertex(0), aside),
                (Parameter::Start, body().at([0.0, part * from_origin, 0.0])),
                (Parameter::HoldingPoint, body().held_at([0.0, -far])),
                (
                    Parameter::Offset(0),
                    body().surface([0.0, 1.0], -far, [0.5; 2]),
                ),
                (Parameter::StiffnessRotation, body().springs(1.0, far)),
                (Parameter::Weight, body().weighing(far)),
            ]
        };
        let refused = |setup: &Setup| setup.scene::<R>().err().map(|e| e.parameter);
        let [within, beyond] = [0.9, 1.1].map(setups);
        for ((parameter, near), (_, far)) in within.into_iter().zip(beyond) {
            assert_eq!(refused(&near), None, "{parameter}");
            let vertex = matches!(parameter, Parameter::Vertex(_));
            let is = refused(&far);
            let same = is == Some(parameter) || vertex && is == Some(Parameter::Vertex(1));
            assert!(same, "{parameter}: {is:?}");
        }
    }
}

/// The lever counts from the contact, wherever the body's frame has its origin: the moments are those of half a rod.
#[test]
fn lever_counts_from_the_contact() {
    let upright = std::f64::consts::FRAC_PI_2;
    for aside in [-15.0, -8.0, 0.0, 8.0, 15.0] {
        let setup = Setup::new(&[[aside, 0.0], [aside + 1.0, 0.0]])
            .standing(0, [0.0; 2], upright)
            .held_at([aside + 0.5, 0.0])
            .floor([0.5, 0.3]);
        let hand = [0.0, -6.0, upright];
        let frame = Run::<Fixed>::start(&setup, Evolution::Path, hand).frame;
        assert_eq!((frame.held, frame.status), (true, Status::Ok), "{aside}");
    }
}

/// E_u of a contact contains the lever times the pull from the contact, of which fixed point represents 128 (R44): with a pull of P towards
/// the contact, lever·(lever + P). It does not matter whether the contact sticks or slides.
#[test]
fn lever_times_the_pull_from_the_contact_is_carried_up_to_128() {
    for (lever, carried) in [(9.0, true), (9.1, false)] {
        let upright = std::f64::consts::FRAC_PI_2;
        for friction in [0.0, 0.5] {
            let rod = Setup::rod(1.0).standing(0, [0.0; 2], upright);
            let setup = rod.held_at([lever, 0.0]).floor([friction; 2]);
            // lever (2 lever - 4) = 128 at a lever of 9.06.
            let hand = [0.0, 4.0, upright];
            let run = RunOf::<Fixed, VERTICES, 1, 0>::start(&setup, Evolution::Path, hand).frame;
            let status = if carried {
                Status::Ok
            } else {
                Status::Saturated
            };
            assert_eq!((run.held, run.status), (carried, status), "{lever}");
        }
    }
}

/// With the largest overlap that is allowed at the start, 1e-5 of the body's size, the scene is still accepted.
#[test]
fn depth_at_the_start_is_allowed_up_to_its_bound() {
    let start = |depth: f64| {
        let setup = Setup::rod(1.0).at([0.0, -depth, 0.0]).floor([0.5, 0.3]);
        let error = |e: SceneError<f64>| e.parameter;
        setup.scene::<f64>().map(|_| ()).map_err(error)
    };
    let first = Parameter::Penetration {
        surface: 0,
        vertex: 0,
    };
    assert_eq!(start(1e-5), Ok(()));
    assert_eq!(
        start(1e-5_f64.next_up()),
        Err(first),
        "of two equally deep surfaces, the first"
    );
}

/// A block that rises at 45 degrees slips by ever shorter distances; when it is pressed less than its memory requires, it slides
/// until it lifts. A hundred slips do not limit a frame; more events than are resolved do (R42).
#[test]
fn hundred_slips_of_a_frame_are_no_limit() {
    let (mut few, mut many) = (0, 0);
    for mu_d in [0.1, 0.3, 0.4, 0.45, 0.495, 0.498] {
        let setup = Setup::block(2.0, 1.0)
            .held_at([0.0, 0.5])
            .floor([0.5, mu_d])
            .remembering(0.0);
        let mut run = Run::<f64>::start(&setup, Evolution::Path, [0.0, 0.3, 0.0]);
        let frame = run.step([0.4, 0.7, 0.0]);
        assert_eq!(frame.state, StateKind::NonContact);
        let limited = frame.slips > 120;
        let status = if limited {
            Status::EventLimit
        } else {
            Status::Ok
        };
        assert_eq!(frame.status, status, "{mu_d}: {}", frame.slips);
        *(if limited { &mut many } else { &mut few }) += 1;
    }
    assert!(few > 2 && many > 1, "{few} {many}");
}
