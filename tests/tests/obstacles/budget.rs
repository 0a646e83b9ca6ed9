//! The budget of a step among obstacles: no step exceeds it, every frame is lawful, and a cut step continues to the same bits.

use stiction_core::{Evolution, State, Status};
use stiction_judge::law;
use stiction_tests::obstacles::laws::Laws;
use stiction_tests::obstacles::run::Run;
use stiction_tests::obstacles::worlds::{World, world};
use stiction_tests::{Number, test_each, times};

fn number_of_scenes() -> u64 {
    times(3, 20)
}
/// The scene is sampled at this stride of frames, so that much happens in one step.
const STRIDE: usize = 20;

test_each! {
    cases::what_is_cut_goes_on_to_the_same_bits,
}

/// The hand at the sampled frames.
fn hands(world: &World) -> impl Iterator<Item = [f64; 3]> {
    world.hands().into_iter().step_by(STRIDE)
}

/// Steps until nothing is left to do, each within its budget and lawful. Returns how many steps were cut, and the final state.
fn steps<R: Number>(
    run: &mut Run<R>,
    (laws, hand): (&Laws, [f64; 3]),
    is_bound: bool,
) -> (usize, Status, u32) {
    let (mut cut, mut slips) = (0, 0);
    loop {
        let limit = run.solver.budget();
        run.step(hand);
        let (frame, output) = (&run.frame, &run.output);
        // A body that is behind may be at an event, with contacts that are about to change.
        let is_cut = output.status == Status::Behind;
        let broken = laws.broken(frame).into_iter();
        let mut broken =
            broken.filter(|finding| !is_cut || [law::OUTSIDE, law::FINITE].contains(&finding.law));
        let first = broken.next();
        assert!(first.is_none(), "{first:?}: {frame:?}");
        assert!(!is_bound || output.work <= limit, "{limit}: {frame:?}");
        slips += frame.slips;
        if output.status < Status::Behind || R::wide(output.behind) == 0.0 {
            return (cut, output.status, slips);
        }
        cut += 1;
    }
}

mod cases {
    use super::*;

    /// From the smallest budget on no step exceeds it, and each budget leads to the same bits as no budget.
    pub(super) fn what_is_cut_goes_on_to_the_same_bits<R: Number>(evolution: Evolution) {
        let mut cut = 0;
        for number in 0..number_of_scenes() {
            let world = world(number);
            let laws = Laws::new::<R>(&world.among);
            let mut hands = hands(&world);
            let first = hands.next().expect("a path");
            let mut whole = Run::<R>::start(&world.among, evolution, first);
            for hand in hands {
                let before: State<R> = whole.state.clone();
                let (_, status, slips) = steps(&mut whole, (&laws, hand), false);
                for units in [0, 1, 7, 50] {
                    let mut tight = Run::<R> {
                        solver: whole.solver.clone().with_budget(units),
                        state: before.clone(),
                        frame: whole.frame.clone(),
                        output: whole.output.clone(),
                    };
                    let (times, end, counted) = steps(&mut tight, (&laws, hand), units > 0);
                    assert_eq!(tight.state, whole.state, "scene {number}, budget {units}");
                    assert_eq!((end, counted), (status, slips), "scene {number}");
                    cut += times;
                }
            }
        }
        println!("{cut} steps were cut");
        assert!(cut > 20, "{cut}");
    }
}
