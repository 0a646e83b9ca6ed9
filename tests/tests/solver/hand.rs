//! The hand: grasping, letting go, and samples that are not a pose.

use stiction_core::{Angle, Event, Evolution, Hand, StateKind, Status};
use stiction_tests::laws::assert_lawful;
use stiction_tests::run::planar;
use stiction_tests::{Number, Run, Setup, close, test_each};

test_each!(
    cases::hand_takes_hold_where_it_is,
    cases::reach_limits_the_grasp,
    cases::grasp_beyond_the_number_type_is_none,
    cases::released_body_stays,
    cases::body_is_taken_hold_of_again_elsewhere,
    cases::given_holding_point_pulls_from_the_start,
    cases::bad_sample_is_held_and_forgotten,
    cases::tilted_hand_is_followed_and_says_so,
    cases::start_with_a_bad_sample_is_finite,
    cases::hand_out_of_range_is_held,
    cases::depth_passes_through,
    cases::soft_grip_turns_a_free_body_up_to_the_floor,
    cases::heavy_body_follows_a_hand_that_turns_by_many_turns,
);

mod cases {
    use super::*;

    /// A block 2 × 1 in the air that can be grasped anywhere.
    fn loose() -> Setup {
        Setup {
            holding_point: None,
            ..Setup::block(2.0, 1.0).at([0.0, 2.0, 0.2]).floor([0.5, 0.3])
        }
    }

    fn open<R: Number>(hand: [f64; 3]) -> Hand<R::Si> {
        planar::<R>(hand).released()
    }

    /// A rod turns with the hand until its end reaches the floor; its turn per frame is so small, and its grip so soft, that the
    /// moment is below the last digit.
    pub(super) fn soft_grip_turns_a_free_body_up_to_the_floor<R: Number>(evolution: Evolution) {
        for stiffness in [1e-6, 1e-5, 1e-3] {
            let setup = Setup::rod(1.0)
                .at([0.0, 0.5, 0.0])
                .springs(1.0, stiffness)
                .floor([0.5, 0.3]);
            let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.5, -0.52]);
            for frame in run.lead([0.0, 0.5, -0.53], 200) {
                let end = setup.world(frame.pose, [1.0, 0.0]);
                assert!(end[1] > -R::GAP, "{stiffness}: {end:?}");
                assert_eq!(frame.contacts.is_empty(), end[1] > R::GAP, "{frame:?}");
                assert_eq!(frame.status, Status::Ok);
            }
            assert_eq!(run.frame.state, StateKind::SingleVertex);
        }
    }

    /// A body that its weight turns by up to 2 rad from the hand hangs in balance wherever the hand is next.
    pub(super) fn heavy_body_follows_a_hand_that_turns_by_many_turns<R: Number>(
        evolution: Evolution,
    ) {
        let setup = Setup::block(0.1, 0.06)
            .at([0.0, 1.5, 0.0])
            .held_at([0.05, 0.06])
            .weighing(30.0)
            .springs(500.0, 0.8)
            .floor([0.5, 0.3]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0, 1.5, 0.0]);
        for phi in [3.0, 20.0, -15.0, 25.0, -30.0, 0.4] {
            let frame = run.step([0.0, 1.5, phi]).clone();
            assert_eq!(
                (frame.state, frame.status),
                (StateKind::NonContact, Status::Ok)
            );
            assert_lawful::<R>(&setup, std::slice::from_ref(&frame));
        }
    }

    pub(super) fn hand_takes_hold_where_it_is<R: Number>(evolution: Evolution) {
        let setup = loose();
        let ([x, y], phi) = (setup.world(setup.start, [0.6, 0.3]), 1.0);
        let mut run = Run::<R>::start_with(&setup, evolution, open::<R>([x, y, phi]));
        assert!(!run.frame.held);
        let frame = run.step([x, y, phi]).clone();
        assert!(frame.held && frame.saw(Event::Grasp), "{frame:?}");
        for k in 0..3 {
            close(
                "the grasp moves nothing",
                frame.pose[k],
                setup.start[k],
                R::GAP,
            );
            close("the grasp pulls nothing", frame.wrench[k], 0.0, R::GAP);
        }
        let moved = run.step([x + 0.5, y + 0.2, phi]).pose;
        R::near("x follows", moved[0], 0.5);
        R::near("y follows", moved[1], 2.2);
        let turned = run.step([x + 0.5, y + 0.2, phi + 0.4]).pose;
        R::near("theta follows", turned[2], 0.6);
        let [gx, gy] = setup.world(turned, [0.6, 0.3]);
        R::near("turns about the hand: x", gx, x + 0.5);
        R::near("turns about the hand: y", gy, y + 0.2);
    }

    pub(super) fn reach_limits_the_grasp<R: Number>(evolution: Evolution) {
        let setup = Setup {
            reach: 0.1,
            ..loose().at([0.0, 2.0, 0.0])
        };
        for (beyond, held) in [(-0.3, true), (0.09, true), (0.11, false), (3.0, false)] {
            let hand = [1.0 + beyond, 2.5, 0.0];
            let run = Run::<R>::start(&setup, evolution, hand);
            assert_eq!(run.frame.held, held, "{beyond} m outside");
            let mut run = Run::<R>::start_with(&setup, evolution, open::<R>(hand));
            let frame = run.step(hand);
            assert_eq!(
                (frame.held, frame.saw(Event::Grasp)),
                (held, held),
                "{beyond} m outside"
            );
        }
        let mut missed = Run::<R>::start(&setup, evolution, [3.0, 2.5, 0.0]);
        let frame = missed.step([5.0, 2.5, 0.0]);
        assert_eq!((frame.pose, frame.wrench), ([0.0, 2.0, 0.0], [0.0; 3]));
    }

    /// A hand reaches for a point far away: a number type that can represent the springs grasps it and reports so; one that
    /// cannot reports that it is out of range, and no grasp.
    pub(super) fn grasp_beyond_the_number_type_is_none<R: Number>(evolution: Evolution) {
        for far in [0.01, 0.1, 1.0, 3.0, 5.0] {
            let body = Setup::new(&[[far, 0.0]]).springs(1e4, 42.0);
            let mut setup = body.floor([0.1, 0.06]);
            (setup.holding_point, setup.reach) = (None, 1e3);
            let frame = Run::<R>::start(&setup, evolution, [0.0; 3]).frame;
            assert_eq!(
                frame.held,
                frame.saw(Event::Grasp),
                "{}: {frame:?}",
                R::NAME
            );
            assert_eq!(
                frame.held,
                frame.status == Status::Ok,
                "{}: {frame:?}",
                R::NAME
            );
        }
    }

    pub(super) fn released_body_stays<R: Number>(evolution: Evolution) {
        let setup = Setup::block(2.0, 1.0).held_at([0.0, 0.5]).floor([0.5, 0.3]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.3, 0.0]);
        let pressed = run.lead([1.0, 0.3, 0.0], 50).pop().expect("50 frames");
        let released = run.feed(open::<R>([1.0, 0.3, 0.0])).clone();
        assert!(
            released.saw(Event::Release) && !released.held,
            "{released:?}"
        );
        for hand in [[5.0, 5.0, 2.0], [-1.0, -1.0, 0.0]] {
            let frame = run.feed(open::<R>(hand)).clone();
            assert_eq!((frame.pose, frame.wrench), (pressed.pose, [0.0; 3]));
            assert_lawful::<R>(&setup, &[frame]);
        }
    }

    pub(super) fn body_is_taken_hold_of_again_elsewhere<R: Number>(evolution: Evolution) {
        let setup = Setup::block(2.0, 1.0).held_at([0.0, 0.5]).floor([0.5, 0.3]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.3, 0.0]);
        run.feed(open::<R>([0.8, 0.9, 1.0]));
        let frame = run.step([0.8, 0.9, 1.0]).clone();
        assert!(frame.saw(Event::Grasp), "{frame:?}");
        assert_eq!(frame.pose, [0.0; 3]);
        close(
            "new rest",
            frame.wrench[0].hypot(frame.wrench[1]),
            0.0,
            R::GAP,
        );
        run.lead([0.8, 1.9, 1.0], 20);
        assert_eq!(run.frame.state, StateKind::NonContact);
        let [gx, gy] = setup.world(run.frame.pose, [0.8, 0.9]);
        R::near("held at the new point: x", gx, 0.8);
        R::near("held at the new point: y", gy, 1.9);
        R::near("with the new rest angle", run.frame.pose[2], 0.0);
    }

    pub(super) fn given_holding_point_pulls_from_the_start<R: Number>(evolution: Evolution) {
        let setup = Setup::block(2.0, 1.0)
            .held_at([0.0, 0.5])
            .at([0.0, 3.0, 0.0])
            .floor([0.5, 0.3]);
        let frame = Run::<R>::start(&setup, evolution, [4.0, 5.0, 0.5]).frame;
        let [gx, gy] = setup.world(frame.pose, [0.0, 0.5]);
        R::near("x", gx, 4.0);
        R::near("y", gy, 5.0);
        R::near("theta", frame.pose[2], 0.5);
    }

    /// A hand with one component invalid.
    fn spoilt<R: Number>(hand: Hand<R::Si>) -> Vec<Hand<R::Si>> {
        let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].map(R::si);
        let spoil = |bad| {
            let [x, y] = hand.position;
            let turned = Angle {
                rest: bad,
                ..hand.angle
            };
            [
                Hand {
                    position: [bad, y],
                    ..hand
                },
                Hand {
                    position: [x, bad],
                    ..hand
                },
                Hand {
                    angle: turned,
                    ..hand
                },
                Hand { depth: bad, ..hand },
            ]
        };
        bad.into_iter().flat_map(spoil).collect()
    }

    pub(super) fn bad_sample_is_held_and_forgotten<R: Number>(evolution: Evolution) {
        let setup = Setup::bench_box()
            .standing(0, [0.0, 0.0], 0.5)
            .floor([0.5, 0.3]);
        let ([x, y], phi) = (setup.grip(), 0.5);
        let mut run = Run::<R>::start(&setup, evolution, [x, y, phi]);
        let last = run
            .lead([x + 0.02, y - 0.01, phi], 50)
            .pop()
            .expect("50 frames");
        let mut undisturbed = Run::<R>::start(&setup, evolution, [x, y, phi]);
        undisturbed.lead([x + 0.02, y - 0.01, phi], 50);
        for hand in spoilt::<R>(planar::<R>([x, y, phi])) {
            let frame = run.feed(hand).clone();
            assert_eq!(frame.status, Status::HeldLast, "{hand:?}");
            assert_eq!(
                (frame.pose, frame.hand, &frame.contacts),
                (last.pose, last.hand, &last.contacts)
            );
            assert_eq!(
                (frame.state, frame.wrench, frame.slips),
                (last.state, last.wrench, 0)
            );
        }
        let next = [x + 0.03, y - 0.01, phi];
        assert_eq!(run.step(next), undisturbed.step(next));
    }

    pub(super) fn tilted_hand_is_followed_and_says_so<R: Number>(evolution: Evolution) {
        let setup = Setup::block(2.0, 1.0).held_at([0.0, 0.5]).floor([0.5, 0.3]);
        let hand = planar::<R>([0.0, 0.3, 0.0]);
        let tilted = Hand {
            tilted: true,
            ..hand
        };
        let [mut plain, mut run] =
            [hand, tilted].map(|hand| Run::<R>::start_with(&setup, evolution, hand));
        for x in 0..20 {
            assert_eq!(
                (plain.frame.status, run.frame.status),
                (Status::Ok, Status::Twist)
            );
            assert_eq!(
                (run.frame.pose, run.frame.slips),
                (plain.frame.pose, plain.frame.slips)
            );
            assert_lawful::<R>(&setup, std::slice::from_ref(&run.frame));
            let next = planar::<R>([0.05 * f64::from(x), 0.3, 0.0]);
            plain.feed(next);
            run.feed(Hand {
                tilted: true,
                ..next
            });
        }
        assert_eq!(run.feed(planar::<R>([0.0, 0.3, 0.0])).status, Status::Ok);
    }

    pub(super) fn start_with_a_bad_sample_is_finite<R: Number>(evolution: Evolution) {
        let setup = Setup::block(2.0, 1.0).held_at([0.0, 0.5]).floor([0.5, 0.3]);
        for hand in spoilt::<R>(planar::<R>([0.0, 0.3, 0.0])) {
            let mut run = Run::<R>::start_with(&setup, evolution, hand);
            assert_eq!(run.frame.status, Status::HeldLast, "{hand:?}");
            assert_eq!(run.frame.pose, [0.0; 3]);
            assert_lawful::<R>(&setup, std::slice::from_ref(&run.frame));
            assert_eq!(run.step([0.0, 0.3, 0.0]).status, Status::Ok);
        }
    }

    pub(super) fn hand_out_of_range_is_held<R: Number>(evolution: Evolution) {
        let setup = Setup::block(2.0, 1.0).held_at([0.0, 0.5]).floor([0.5, 0.3]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.3, 0.0]);
        let last = run.frame.clone();
        for far in [
            [1e30, 0.0, 0.0],
            [0.0, -1e30, 0.0],
            [1e14, 1e14, 0.0],
            [0.0, 0.3, 1e30],
        ] {
            let frame = run.step(far).clone();
            assert_eq!(frame.status, Status::Saturated, "{far:?}");
            assert_eq!((frame.pose, frame.wrench), (last.pose, last.wrench));
            assert_lawful::<R>(&setup, &[frame]);
        }
        for turns in [i32::MAX, i32::MIN] {
            let hand = planar::<R>([0.0, 0.3, 0.0]);
            let angle = Angle {
                turns,
                ..hand.angle
            };
            let frame = run.feed(Hand { angle, ..hand }).clone();
            assert!(
                frame
                    .pose
                    .iter()
                    .chain(&frame.wrench)
                    .all(|x| x.is_finite()),
                "{frame:?}"
            );
        }
    }

    pub(super) fn depth_passes_through<R: Number>(evolution: Evolution) {
        let setup = Setup::block(2.0, 1.0).held_at([0.0, 0.5]).floor([0.5, 0.3]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.3, 0.0]);
        for depth in [0.25, -3.0] {
            let hand = Hand {
                depth: R::si(depth),
                ..planar::<R>([0.0, 0.3, 0.0])
            };
            close("depth", run.feed(hand).depth, depth, 0.0);
            close(
                "depth of an open hand",
                run.feed(hand.released()).depth,
                depth,
                0.0,
            );
        }
    }
}
