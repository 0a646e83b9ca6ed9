//! One model of a scene on one chip: images built for flash and for speed, the hand's path run in emulation.

use stiction_core::{Evolution, Hand};
use stiction_host_sim::firmware::process::EmulatorError;
use stiction_host_sim::trade::chip::Chip;
use stiction_scene::{SceneFile, SceneModel, rust_source};

use crate::emulator::{Board, Counted, Counter, Profile, footprint, job};

/// The resources of a model on a chip. Stack, instructions and cycles are those of the build for speed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Measured {
    /// Flash of the build for small size (bytes).
    pub(super) flash_small: u64,
    /// Flash of the build for speed (bytes).
    pub(super) flash_fast: u64,
    /// Every frame, and the sizes.
    pub(super) counted: Counted,
}

impl Measured {
    /// The count per frame (see [`Chip::unit`]), mean and worst, without the start. `None`: there is no other frame.
    pub(super) fn per_frame(&self) -> Option<[u64; 2]> {
        let counted = &self.counted;
        let figures = [counted.mean() as u64, counted.worst().into()];
        (!counted.steps().is_empty()).then_some(figures)
    }
}

/// Builds the solver of a scene in a model for a chip, and runs the hand through it.
///
/// # Errors
/// As [`Counter::count`].
pub(super) fn measure(
    chip: Chip,
    model: SceneModel,
    scene: &SceneFile,
    evolution: Evolution,
    hands: &[Hand<f64>],
) -> Result<Measured, EmulatorError> {
    let (board, number) = (Board::of(chip), chip.number());
    let code = rust_source(scene, model, number, evolution);
    let job = job(scene, evolution, hands);
    Ok(Measured {
        flash_small: footprint(Board::with_flash_of(chip), Profile::DeviceSmall, &code)?,
        flash_fast: footprint(Board::with_flash_of(chip), Profile::Device, &code)?,
        counted: Counter::of_model(board, Profile::Device, &code)?.count(&job, u32::MAX)?,
    })
}
