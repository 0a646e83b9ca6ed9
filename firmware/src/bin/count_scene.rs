//! The instruction bench with the solver of a compiled-in scene: of its number type, its capacities and its model.
#![no_std]
#![no_main]

use stiction_core::Solver;
use stiction_firmware::board::{self, entry};

mod scene {
    include!(env!("STICTION_SCENE_FILE"));
}
use scene::{CompiledScene, EVOLUTION, SCENE};

#[entry]
fn main() -> ! {
    match CompiledScene::new(&SCENE) {
        Ok(scene) => board::count_compiled(Solver::new(scene, EVOLUTION)),
        Err(_) => board::no_scene(),
    }
}
