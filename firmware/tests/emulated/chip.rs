//! The boards, and their images as cargo builds them: with the board's own scene, or with another one. What is missing is told
//! with the command that installs it; with CI=true it must be there.

use crate::image::Image;
use std::collections::BTreeSet;
use std::env;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command as Process;
use std::sync::Mutex;

/// A board with its emulator.
#[derive(Debug)]
pub(crate) struct Chip {
    /// Its folder in firmware/boards, and its name.
    pub(crate) name: &'static str,
    /// QEMU's name of it.
    pub(crate) machine: &'static str,
    /// Of its package.
    features: &'static str,
    /// Serial lines before the one that is used.
    pub(crate) unused_lines: usize,
    /// An instruction takes 2^N ns: near to what it takes on the chip.
    pub(crate) shift: u32,
}

pub(crate) const F405: Chip = Chip {
    name: "olimex-stm32-h405",
    machine: "olimex-stm32-h405",
    features: "",
    unused_lines: 1,
    shift: 3,
};

/// With a device of its own.
pub(crate) const PANTOGRAPH: Chip = Chip {
    features: "pantograph",
    ..F405
};

pub(crate) const MICROBIT: Chip = Chip {
    name: "microbit",
    machine: "microbit",
    features: "",
    unused_lines: 0,
    shift: 6,
};

impl Chip {
    /// The release image without logs; nothing where something is missing.
    pub(crate) fn image(&self) -> Option<Image> {
        self.image_of(None)
    }

    /// The image with a bundled scene of the host compiled in, or with the board's own. It is built once and copied: in the
    /// folder of the build the next one takes its place.
    pub(crate) fn image_of(&self, scene: Option<&str>) -> Option<Image> {
        static BUILT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
        self.installed()?;
        let name = format!("{}-{}-{}", self.name, self.features, scene.unwrap_or("own"));
        let copy = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let mut built = BUILT.lock().unwrap();
        if !built.contains(&copy) {
            fs::copy(self.built(scene)?, &copy).unwrap();
            built.insert(copy.clone());
        }
        Some(Image::of(copy))
    }

    /// In firmware/boards.
    pub(crate) fn folder(&self) -> PathBuf {
        let boards = Path::new(env!("CARGO_MANIFEST_DIR")).join("boards");
        boards.join(self.name)
    }

    fn built(&self, scene: Option<&str>) -> Option<PathBuf> {
        // Cargo of the test sets what is not for this one.
        let mut cargo = Process::new("cargo");
        match scene {
            Some(name) => cargo.env("STICTION_SCENE", bundled(name)),
            None => cargo.env_remove("STICTION_SCENE"),
        };
        let output = cargo
            .args(["build", "--profile", "device", "--locked"])
            .args(["--no-default-features", "--features", self.features])
            .arg("--message-format=json-render-diagnostics")
            .current_dir(self.folder())
            .output()
            .unwrap();
        let (said, errors) = (
            String::from_utf8_lossy(&output.stdout),
            String::from_utf8_lossy(&output.stderr),
        );
        if errors.contains("target may not be installed") {
            return missing(
                "a target",
                "rustup target add thumbv7em-none-eabihf thumbv6m-none-eabi",
            );
        }
        assert!(output.status.success(), "{errors}");
        let (_, path) = said.rsplit_once("\"executable\":\"").expect("an image");
        let (path, _) = path.split_once('"').unwrap();
        Some(path.into())
    }

    /// What `cargo emulate` needs for the log.
    pub(crate) fn log_installed(&self) -> Option<()> {
        self.installed()?;
        match is_there("defmt-print") {
            true => Some(()),
            false => missing("defmt-print", "cargo install defmt-print"),
        }
    }

    fn installed(&self) -> Option<()> {
        if !is_there("flip-link") {
            return missing("flip-link", "cargo install flip-link");
        }
        let machines = Process::new("qemu-system-arm")
            .args(["-M", "help"])
            .output();
        let knows = machines.is_ok_and(|output| {
            String::from_utf8_lossy(&output.stdout)
                .lines()
                .any(|line| line.split(' ').next() == Some(self.machine))
        });
        if knows {
            Some(())
        } else {
            missing(
                "qemu-system-arm 10",
                "apt-get install -y --no-install-recommends qemu-system-arm (Debian 12: -t bookworm-backports)",
            )
        }
    }
}

/// The file of a bundled scene of the host.
pub(crate) fn bundled(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../host-sim/scenes")
        .join(name)
        .with_extension("toml")
}

fn is_there(program: &str) -> bool {
    let path = env::var_os("PATH").unwrap_or_default();
    env::split_paths(&path).any(|folder| folder.join(program).is_file())
}

fn missing<T>(what: &str, install: &str) -> Option<T> {
    let message = format!("missing: {what}; to install it: {install}");
    assert_ne!(env::var("CI").as_deref(), Ok("true"), "{message}");
    // Not `println!`, which is silent in a test that passes.
    let _ = writeln!(std::io::stderr(), "skipped: {message}");
    None
}
