//! A step allocates nothing, according to a counter per thread.

use stiction_core::{Evolution, Hand, Solver};
use stiction_tests::setup::{SURFACES, VERTICES};
use stiction_tests::{Number, scenes, test_each};

test_each!(cases::no_step_allocates);

mod cases {
    use super::*;

    pub(super) fn no_step_allocates<R: Number>(evolution: Evolution) {
        for (name, scenario) in scenes::all() {
            let hand = |[x, y, phi]: [f64; 3]| Hand::new(R::si(x), R::si(y), R::si(phi));
            let hands: Vec<_> = scenario.hands(50).into_iter().map(hand).collect();
            let scene = scenario.setup.scene::<R>().expect("a named scene is valid");
            let mut contacts = 0;
            let used = allocation_counter::measure(|| {
                let solver = Solver::<R, VERTICES, SURFACES>::new(scene, evolution);
                let (mut state, _) = solver.start(hands[0]);
                for &hand in &hands {
                    solver.step(&mut state, hand);
                    contacts += solver.contacts(&state).len();
                }
            });
            assert_eq!((used.count_total, used.bytes_total), (0, 0), "{name}");
            assert!(contacts > 0, "{name} touches something");
        }
    }
}
