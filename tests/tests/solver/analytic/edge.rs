//! A block on its bottom side: stick-slip, tipping, lift-off, and a wall.

use stiction_core::{Event, Evolution, StateKind, Status};
use stiction_tests::run::Frame;
use stiction_tests::{Number, Run, Setup, close, test_each};

test_each!(
    cases::sawtooth,
    cases::sawtooth_with_weight_to_the_left,
    cases::a_low_block_slides_before_it_tips,
    cases::a_high_block_tips_before_it_slides,
    cases::a_weighted_block_lifts_off,
    cases::slips_shrink_geometrically_towards_lift_off,
    cases::a_wall_locks_and_releases,
    cases::a_wall_cuts_a_slip_short,
    cases::translation_alone_breaks_away_at_its_lag,
);

fn slipped(frame: &Frame) -> bool {
    frame.slips > 0
}

mod cases {
    use super::*;

    /// The block 2 × 1 on the floor, held at its centre.
    fn block(friction: [f64; 2]) -> Setup {
        Setup::block(2.0, 1.0).held_at([0.0, 0.5]).floor(friction)
    }

    /// Case 1. In frame evolution, each of the 48 slips is found up to one frame of the hand too late.
    pub(super) fn sawtooth<R: Number>(evolution: Evolution) {
        let setup = block([0.5, 0.3]).at([0.0, 0.3, 0.0]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.8, 0.0]);
        run.lead([0.0, 0.3, 0.0], 10);
        assert_eq!(run.frame.state, StateKind::Edge);
        let mut path = Run::<R>::start(&setup, evolution, [0.0, 0.8, 0.0]);
        path.lead([0.0, 0.3, 0.0], 10);

        let first = path.onset([2.0, 0.3, 0.0], slipped);
        R::near("first slip", first.hand[0], 0.1);
        R::near("slip", path.frame.pose[0], 0.04);
        R::near("slip reported", path.frame.longest_slip, 0.04);
        let second = path.onset([2.0, 0.3, 0.0], slipped);
        R::near("period", second.hand[0] - first.hand[0], 0.04);

        let (frames, late) = match evolution {
            Evolution::Path => (100, R::ANALYTIC),
            Evolution::Frame => (20_000, 48.0 * 2.0 / 20_000.0),
        };
        let slips: u32 = run
            .lead([2.0, 0.3, 0.0], frames)
            .iter()
            .map(|f| f.slips)
            .sum();
        assert_eq!(slips, 48);
        close("end", run.frame.pose[0], 1.92, late);
    }

    /// Case 2.
    pub(super) fn sawtooth_with_weight_to_the_left<R: Number>(evolution: Evolution) {
        let setup = block([0.8, 0.35])
            .springs(200.0, 5.0)
            .weighing(3.0)
            .at([0.0, 0.3, 0.0]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.8, 0.0]);
        run.lead([0.0, 0.49, 0.0], 10);
        let target = [-0.1, 0.49, 0.0];
        let first = run.onset(target, slipped);
        R::near("first slip", first.hand[0], -0.02);
        R::near("slip", run.frame.pose[0], -0.01125);

        let (frames, late) = match evolution {
            Evolution::Path => (10, R::ANALYTIC),
            Evolution::Frame => (2_000, 8.0 * 0.08 / 2_000.0),
        };
        let rest: u32 = run.lead(target, frames).iter().map(|f| f.slips).sum();
        assert_eq!(rest, 7);
        close("end", run.frame.pose[0], -0.09, late);
    }

    /// Case 6a, mu_s below w / 2 y_g. At the end of the hand's path, 0.16, the next slip is exactly due, so the path
    /// stops just before.
    pub(super) fn a_low_block_slides_before_it_tips<R: Number>(evolution: Evolution) {
        let setup = Setup::block(1.0, 1.6).held_at([0.0, 0.8]).floor([0.6, 0.4]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.6, 0.0]);
        let trigger = run.onset([0.16, 0.6, 0.0], slipped);
        R::near("first slip", trigger.hand[0], 0.12);
        R::near("slip", run.frame.longest_slip, 0.04);
        run.lead([0.1599, 0.6, 0.0], 10);
        assert_eq!(run.frame.state, StateKind::Edge);
        R::near("end", run.frame.pose[0], 0.04);
    }

    /// Case 6b, mu_s above w / 2 y_g.
    pub(super) fn a_high_block_tips_before_it_slides<R: Number>(evolution: Evolution) {
        let setup = Setup::block(1.0, 1.6)
            .held_at([0.0, 0.8])
            .floor([0.65, 0.4]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.6, 0.0]);
        let trigger = run.onset([0.1251, 0.6, 0.0], |f| f.state != StateKind::Edge);
        R::near("tips", trigger.hand[0], 0.125);
        assert!(run.frame.saw(Event::Tip), "{:?}", run.frame);
        run.lead([0.1251, 0.6, 0.0], 1);
        assert_eq!(run.frame.state, StateKind::SingleVertex);
        R::near("angle", run.frame.pose[2], -4.797_745_055_04e-5);
        R::near("pivot", run.frame.contacts[0].point[0], 0.5);
    }

    /// Case 10.
    pub(super) fn a_weighted_block_lifts_off<R: Number>(evolution: Evolution) {
        let setup = block([0.5, 0.3]).springs(10.0, 1.0).weighing(3.0);
        let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.3, 0.0]);
        assert_eq!(run.frame.state, StateKind::Edge);
        let lift = run.onset([0.0, 0.9, 0.0], |f| f.state == StateKind::NonContact);
        R::near("lift-off", lift.hand[1], 0.8);
        run.lead([0.0, 0.9, 0.0], 10);
        assert_eq!(run.frame.state, StateKind::NonContact);
        R::near("height", run.frame.pose[1], 0.1);
    }

    /// A block that rises at 45 degrees slips infinitely often; each slip is (1 + mu_d) / (1 + mu_s) of the last one.
    pub(super) fn slips_shrink_geometrically_towards_lift_off<R: Number>(evolution: Evolution) {
        let mut run = Run::<R>::start(&block([0.5, 0.3]), evolution, [0.0, 0.3, 0.0]);
        let mut last = None;
        for _ in 0..10 {
            let ([x, y, phi], ahead) = (run.frame.hand, 0.4 * run.frame.normal());
            run.onset([x + ahead, y + ahead, phi], slipped);
            let slip = run.frame.longest_slip;
            if let Some(last) = last {
                R::near("ratio", slip / last, 0.866_666_667);
            }
            last = Some(slip);
        }
        run.lead([0.4, 0.7, 0.0], 1);
        assert_eq!(run.frame.state, StateKind::NonContact);
        R::near("height", run.frame.pose[1], 0.2);
        let limited = matches!(run.frame.status, Status::Ok | Status::EventLimit);
        assert!(limited, "{:?}", run.frame);
    }

    /// Case 11.
    pub(super) fn a_wall_locks_and_releases<R: Number>(evolution: Evolution) {
        let setup = block([0.5, 0.3]).wall(1.5, [0.5, 0.3]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.3, 0.0]);
        run.lead([1.5, 0.3, 0.0], 1_500);
        assert_eq!(run.frame.state, StateKind::Locked);
        R::near("at the wall", run.frame.pose[0], 0.5);
        run.lead([0.45, 0.3, 0.0], 10);
        let release = run.onset([0.35, 0.3, 0.0], slipped);
        R::near("release", release.hand[0], 0.4);
        R::near("slip", release.before.pose[0] - run.frame.pose[0], 0.04);
        run.lead([-0.2, 0.3, 0.0], 300);
        assert_eq!(
            (run.frame.state, run.frame.status),
            (StateKind::Edge, Status::Ok)
        );
    }

    /// Case 13: the free slip would be 0.08.
    pub(super) fn a_wall_cuts_a_slip_short<R: Number>(evolution: Evolution) {
        let setup = block([0.5, 0.1]).wall(1.03, [0.5, 0.1]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0, 0.3, 0.0]);
        let trigger = run.onset([0.11, 0.3, 0.0], |f| f.state != StateKind::Edge);
        R::near("trigger", trigger.hand[0], 0.1);
        assert_eq!(run.frame.state, StateKind::Locked);
        R::near("end", run.frame.pose[0], 0.03);
    }

    /// Held at the contact itself, at depth e: lag mu_s e before a slip, mu_d e after it, period (mu_s - mu_d) e.
    pub(super) fn translation_alone_breaks_away_at_its_lag<R: Number>(evolution: Evolution) {
        let (e, mu_s, mu_d) = (0.2, 0.5, 0.3);
        let mut run = Run::<R>::start(
            &Setup::point().floor([mu_s, mu_d]),
            evolution,
            [0.0, -e, 0.0],
        );
        let target = [1.0, -e, 0.0];
        let first = run.onset(target, slipped);
        R::near("lag before", first.hand[0] - first.before.pose[0], mu_s * e);
        R::near("lag after", first.hand[0] - run.frame.pose[0], mu_d * e);
        let second = run.onset(target, slipped);
        R::near("period", second.hand[0] - first.hand[0], (mu_s - mu_d) * e);
    }
}
