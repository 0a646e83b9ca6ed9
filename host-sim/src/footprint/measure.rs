//! One model of a scene on one chip: images built for flash and for speed, the hand's path run in QEMU.

use stiction_core::{Evolution, Hand};
use stiction_firmware::job::Setting;

use crate::emulator::{
    Board, BoardNumber, Counted, Counter, EmulatorError, Profile, footprint, job, rust_source_in,
};
use crate::model::SceneModel;
use crate::scene_file::SceneFile;

/// A chip with the number type that suits it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chip {
    /// With a floating point unit: f32.
    CortexM4F,
    /// Without: fixed point.
    CortexM0,
}

impl Chip {
    /// All chips.
    pub const ALL: [Self; 2] = [Self::CortexM4F, Self::CortexM0];

    /// The name for a reader, with that of the number type.
    pub const fn name(self) -> &'static str {
        match self {
            Self::CortexM4F => "M4F, f32",
            Self::CortexM0 => "M0, fixed",
        }
    }

    const fn build(self) -> (Board, BoardNumber) {
        match self {
            Self::CortexM4F => (Board::Stm32F405, BoardNumber::F32),
            Self::CortexM0 => (Board::Nrf51822, BoardNumber::Fixed),
        }
    }
}

/// What a model takes on a chip. Instructions and stack are those of the build for speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Flash of the build for little flash (bytes).
    pub flash_small: u64,
    /// Flash of the build for speed (bytes).
    pub flash_fast: u64,
    /// Every frame, and the sizes.
    pub counted: Counted,
}

impl Measured {
    /// Instructions per frame, mean and worst; the start is not among them. `None`: there is no frame but that.
    pub fn instructions(&self) -> Option<(u64, u32)> {
        let steps = self.counted.frames.get(1..)?;
        let sum: u64 = steps.iter().map(|step| u64::from(step.instructions)).sum();
        let worst = steps.iter().map(|step| step.instructions).max()?;
        Some((sum / steps.len() as u64, worst))
    }
}

/// Builds the solver of a scene in a model for a chip, and runs the hand through it.
///
/// # Errors
/// As [`Counter::count`].
pub fn measure(
    chip: Chip,
    model: SceneModel,
    scene: &SceneFile,
    evolution: Evolution,
    hands: &[Hand<f64>],
) -> Result<Measured, EmulatorError> {
    let (board, number) = chip.build();
    let code = rust_source_in(model, scene, number, evolution);
    let exact = Setting {
        evolution,
        tolerance: 0.0,
    };
    let job = job(scene, exact, hands);
    Ok(Measured {
        flash_small: footprint(board, Profile::DeviceSmall, &code)?,
        flash_fast: footprint(board, Profile::Device, &code)?,
        counted: Counter::of_scene(board, Profile::Device, &code)?.count(&job)?,
    })
}
