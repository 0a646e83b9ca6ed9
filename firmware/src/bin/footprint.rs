//! An image with the solver of a compiled-in scene: the pose and the hand's wrench for every sample of the hand. The difference in size
//! from `footprint_baseline` is the solver's share of the flash.
#![no_std]
#![no_main]

use core::hint::black_box;
use stiction_core::{Hand, Solver};
use stiction_firmware::board::entry;

mod scene {
    include!(env!("STICTION_SCENE_FILE"));
}
use scene::{CompiledScene, EVOLUTION, SCENE};

#[entry]
fn main() -> ! {
    // The compiler does not know what comes from a `black_box`, and must compute what goes into one.
    if let Ok(scene) = CompiledScene::new(&SCENE) {
        let solver = Solver::new(scene, EVOLUTION);
        let (mut state, output) = solver.start(black_box(Hand::default()));
        black_box(output);
        loop {
            black_box(solver.step(&mut state, black_box(Hand::default())));
            black_box(solver.wrench(&state));
        }
    }
    loop {
        black_box(());
    }
}
