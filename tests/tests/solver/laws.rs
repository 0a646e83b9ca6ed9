//! Every law on every frame of random scenes and of the named ones, in every number type and both evolutions.

use proptest::prelude::*;
use stiction_core::{Event, Evolution, Fixed, Status, Wrench};
use stiction_tests::laws::{assert_lawful, assert_lawful_run, judge_of, judged, worst};
use stiction_tests::random::{same_every_run, scenario, scenarios};
use stiction_tests::run::{polyline, run};
use stiction_tests::{Number, Run, Scenario, Setup, scenes, times};

fn lawful<R: Number>(scenario: &Scenario, evolution: Evolution) {
    let frames = run::<R>(&scenario.setup, evolution, &scenario.hands(40));
    assert_lawful_run::<R>(&scenario.setup, evolution, &frames);
}

/// The force of the body on the hand is opposite to that of the hand on the body.
#[test]
fn feedback_is_the_opposite_wrench() {
    let wrench = Wrench {
        force: [1.5, -5.0],
        moment: 0.25,
    };
    let opposite = Wrench {
        force: [-1.5, 5.0],
        moment: -0.25,
    };
    assert_eq!(wrench.feedback(), opposite);
}

#[test]
fn named_scenes_obey_every_law() {
    for (name, scenario) in scenes::all() {
        println!("{name}");
        for evolution in Evolution::ALL {
            lawful::<f64>(&scenario, evolution);
            lawful::<f32>(&scenario, evolution);
            lawful::<Fixed>(&scenario, evolution);
        }
    }
}

/// No frame evades the laws of balance.
#[test]
fn no_random_frame_is_ambiguous() {
    fn decided<R: Number>(scenario: &Scenario) {
        for evolution in Evolution::ALL {
            let frames = run::<R>(&scenario.setup, evolution, &scenario.hands(50));
            let ambiguous = frames.iter().find(|f| f.status == Status::Ambiguous);
            assert_eq!(ambiguous, None, "{} {evolution:?}", R::NAME);
        }
    }
    for scenario in scenarios(times(30, 1000), 4) {
        decided::<f64>(&scenario);
        decided::<f32>(&scenario);
        decided::<Fixed>(&scenario);
    }
}

/// Without friction, the two edges of each cone coincide, and two contacts bear only loads in one plane.
#[test]
fn scenes_without_friction_obey_every_law() {
    fn glides<R: Number>() {
        let (mut frames, mut ambiguous) = (0, 0);
        for scenario in scenarios(times(10, 100), 8) {
            let setup = scenario.setup.clone().smooth();
            for evolution in Evolution::ALL {
                let run = run::<R>(&setup, evolution, &scenario.hands(40));
                assert_lawful::<R>(&setup, &run);
                frames += run.len();
                ambiguous += run.iter().filter(|f| f.status == Status::Ambiguous).count();
            }
        }
        println!("{}: {ambiguous} of {frames} frames ambiguous", R::NAME);
        assert!(1000 * ambiguous <= frames);
    }
    glides::<f64>();
    glides::<f32>();
    glides::<Fixed>();
}

/// A box leans on a wall, with a corner just above the floor: as the hand turns, that corner touches slightly before balance,
/// and slips or opens again, so a slip begins slightly out of balance. It must not end out of balance.
#[test]
fn slip_that_begins_out_of_balance_ends_in_balance() {
    fn touches_and_slips<R: Number>() {
        let setup = Setup::bench_box()
            .at([0.090_498, 0.057_828_55, -1.164_641_5])
            .weighing(1.0)
            .floor([0.5, 0.3])
            .surface([-0.8, 0.6], -0.096, [0.4, 0.3]);
        let from = [0.108_934_97, 0.067_706_65, -1.199_382_2];
        let mut touched = 0;
        for i in 0..500 {
            let hand = [
                0.108_861_46,
                0.067_720_67,
                -1.199_32 + 6.4e-6 * f64::from(i),
            ];
            let mut run = Run::<R>::start(&setup, Evolution::Frame, from);
            run.step(hand);
            assert_lawful::<R>(&setup, std::slice::from_ref(&run.frame));
            let happened = |event| run.frame.events.contains(&event);
            let goes_on = happened(Event::Lift) || happened(Event::Slip);
            touched += usize::from(happened(Event::Touch) && goes_on);
        }
        assert!(touched > 100, "{}: {touched}", R::NAME);
    }
    touches_and_slips::<f64>();
    touches_and_slips::<f32>();
    touches_and_slips::<Fixed>();
}

/// A rod between floor and wall slides down; its upper end reverses on the path. The slip ends in balance at mu_d N, with
/// both frictions against the motion.
#[test]
fn two_vertex_slip_rubs_after_a_vertex_turned_back() {
    let setup = Setup::new(&[
        [0.037_041_366_891_807_62, 0.022_731_883_599_949_52],
        [-0.028_645_103_452_316_772, 0.027_738_154_013_207_66],
    ])
    .at([0.0, 0.0, 2.503_367_768_891_097_4])
    .held_at([0.019_717_559_838_210_97, -0.010_981_483_825_889_066])
    .springs(500.0, 0.741_125_456_928_775_1)
    .surface(
        [-0.178_841_844_273_885_1, 0.983_877_835_270_576_4],
        -0.039_868_679_325_936_934,
        [0.200_717_448_728_673_64, 0.128_234_495_441_786_67],
    )
    .surface(
        [0.958_265_335_633_706_9, -0.285_880_301_040_170_4],
        -0.045_114_716_622_949_226,
        [0.809_110_805_612_024_3, 0.520_835_763_064_258_3],
    );
    let [x, y] = setup.grip();
    let end = [
        -0.010_183_909_158_982_417,
        0.000_526_942_573_934_794_5,
        1.890_814_202_182_597_6,
    ];
    for evolution in Evolution::ALL {
        let hands = polyline(&[[x, y, setup.start[2]], end], 1000);
        let mut judge = judge_of::<f64>(&setup, evolution);
        for (i, frame) in run::<f64>(&setup, evolution, &hands).iter().enumerate() {
            let gravest = worst(judge.next(judged(i, frame)));
            assert!(gravest.holds(), "{evolution:?} frame {i}: {gravest:?}");
        }
    }
}

proptest! {
    #![proptest_config(same_every_run(times(40, 500)))]

    #[test]
    fn path_evolution_obeys_every_law(scenario in scenario(4)) {
        lawful::<f64>(&scenario, Evolution::Path);
        lawful::<f32>(&scenario, Evolution::Path);
        lawful::<Fixed>(&scenario, Evolution::Path);
    }

    #[test]
    fn frame_evolution_obeys_every_law(scenario in scenario(4)) {
        lawful::<f64>(&scenario, Evolution::Frame);
        lawful::<f32>(&scenario, Evolution::Frame);
        lawful::<Fixed>(&scenario, Evolution::Frame);
    }
}
