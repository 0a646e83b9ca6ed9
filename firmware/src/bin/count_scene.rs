//! The instruction bench in the number type, the capacities, the model and the evolution of a compiled-in scene, for the scenes of jobs.
#![no_std]
#![no_main]

use stiction_firmware::board::{self, entry};

#[expect(dead_code, reason = "the scene is that of a job")]
mod scene {
    include!(env!("STICTION_SCENE_FILE"));
}
use scene::{CompiledScene, EVOLUTION};

#[entry]
fn main() -> ! {
    board::count_in_model(CompiledScene::new, EVOLUTION)
}
