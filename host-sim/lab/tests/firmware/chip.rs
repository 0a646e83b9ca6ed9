//! The boards, and their images as cargo builds them: with the board's own scene, or with another one. What is missing is reported
//! with the command that installs it; with CI=true it must be there.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command as Process;
use std::sync::{Mutex, MutexGuard, PoisonError};
use stiction_host_sim::firmware::board::Board;
use stiction_host_sim::firmware::image::Contents;
use stiction_host_sim::firmware::process::{if_installed, output_of};
use stiction_host_sim::firmware::workspace;

#[derive(Debug)]
pub(crate) struct Chip {
    pub(crate) board: Board,
    /// Of its package.
    features: &'static str,
    /// Built for little flash.
    is_small: bool,
    /// An instruction takes 2^N ns: between half of what it takes on the chip and twice that.
    pub(crate) shift: u32,
    /// Bytes that its line brings in a second: a tenth of the baud.
    pub(crate) line_rate: u32,
}

pub(crate) const F405: Chip = Chip {
    board: Board::OLIMEX,
    features: "",
    is_small: false,
    shift: 3,
    line_rate: 92_160,
};

/// With a device of its own.
pub(crate) const PANTOGRAPH: Chip = F405.with("pantograph");

pub(crate) const MICROBIT: Chip = Chip {
    board: Board::MICROBIT,
    shift: 6,
    line_rate: 11_520,
    ..F405
};

/// Its clock goes with the real one.
pub(crate) const PICO: Chip = Chip {
    board: Board::PICO,
    shift: 0,
    ..F405
};

/// No emulator runs its image: it is built and looked into.
pub(crate) const PICO2: Chip = Chip {
    board: Board::PICO2,
    shift: 0,
    ..F405
};

/// In the place of the Pico 2: an instruction takes 1.2 of its cycles.
pub(crate) const AN505: Chip = Chip {
    board: Board::AN505,
    shift: 3,
    ..PICO2
};

/// As it is flashed, with its log.
pub(crate) const PICO_FLASHED: Chip = PICO.with("rtt");

pub(crate) const KNOB: Chip = PICO.with("knob");

pub(crate) const KNOB_2: Chip = PICO2.with("knob");

pub(crate) const PICO_PANTOGRAPH: Chip = PICO.with("pantograph");

/// With a log, and an end where it stops.
pub(crate) const ENDING_AN505: Chip = AN505.with("semihosting");

pub(crate) const SMALL_MICROBIT: Chip = Chip {
    is_small: true,
    ..MICROBIT
};

/// The images of a board that have been built. Whoever builds one holds them until it has been copied or read: the next one of the same
/// board takes its place.
pub(crate) type Built = MutexGuard<'static, BTreeSet<PathBuf>>;

pub(crate) struct Image {
    pub(crate) path: PathBuf,
    pub(crate) contents: Contents,
}

impl Chip {
    const fn with(self, features: &'static str) -> Self {
        Self { features, ..self }
    }

    /// Of its folder in firmware/boards.
    pub(crate) const fn name(&self) -> &'static str {
        self.board.name
    }

    /// The release image without logs; nothing where something is missing.
    pub(crate) fn image(&self) -> Option<Image> {
        self.image_of(None)
    }

    /// The image with a bundled scene of the host compiled in, or with the board's own. It is built once and copied.
    pub(crate) fn image_of(&self, scene: Option<&str>) -> Option<Image> {
        if_installed(self.board.require_emulator())?;
        let name = [self.name(), self.features, scene.unwrap_or("own")].join("-");
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let mut built = self.built();
        if !built.contains(&path) {
            let scene = scene.map(bundled);
            let image = match &scene {
                Some(scene) if self.is_small => self.board.small_image(scene),
                _ => self.board.image(self.features, scene.as_deref()),
            };
            let image = if_installed(image)?;
            fs::copy(image, &path).unwrap();
            built.insert(path.clone());
        }
        let contents = Contents::of(&path).unwrap();
        Some(Image { path, contents })
    }

    /// Waits until nobody builds an image of this board.
    pub(crate) fn built(&self) -> Built {
        const BOARDS: [Board; 5] = [
            Board::OLIMEX,
            Board::MICROBIT,
            Board::PICO,
            Board::PICO2,
            Board::AN505,
        ];
        static BUILT: [Mutex<BTreeSet<PathBuf>>; BOARDS.len()] =
            [const { Mutex::new(BTreeSet::new()) }; BOARDS.len()];
        let place = BOARDS.iter().position(|board| *board == self.board);
        let built = BUILT[place.expect("one of the boards")].lock();
        built.unwrap_or_else(PoisonError::into_inner)
    }

    /// What `cargo emulate` needs for the log.
    pub(crate) fn log_installed(&self) -> Option<()> {
        let mut printer = Process::new("defmt-print");
        printer.arg("--version");
        if_installed(output_of(printer)).map(drop)
    }
}

pub(crate) fn bundled(name: &str) -> PathBuf {
    let scenes = workspace().join("host-sim/scenes");
    scenes.join(name).with_extension("toml")
}
