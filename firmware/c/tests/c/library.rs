//! The archive of a variant of the library, as `archives.sh` builds it.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};

use stiction_host_sim::firmware::process::{EmulatorError, output_of};
use stiction_scene::NumberType;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Library {
    pub(crate) number: NumberType,
    pub(crate) room: Room,
}

/// What a scene of a library may contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Room {
    Surfaces,
    Obstacles,
    Plane,
}

pub(crate) fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

impl Library {
    /// Its name for `archives.sh`.
    fn variant(self) -> &'static str {
        match (self.number, self.room) {
            (NumberType::F32, Room::Surfaces) => "float",
            (NumberType::Fixed, Room::Surfaces) => "fixed",
            (NumberType::F32, Room::Obstacles) => "obstacles",
            (NumberType::Fixed, Room::Obstacles) => "fixed,obstacles",
            (NumberType::F32, Room::Plane) => "plane",
            (NumberType::Fixed, Room::Plane) => "fixed,plane",
        }
    }

    /// What a program that is compiled for it defines.
    pub(crate) fn defines(self) -> Vec<&'static str> {
        let fixed = self.number == NumberType::Fixed;
        let all = [
            (fixed, "-DSTICTION_FIXED"),
            (self.room == Room::Obstacles, "-DSTICTION_OBSTACLES"),
            (self.room == Room::Plane, "-DSTICTION_PLANE"),
        ];
        all.into_iter()
            .filter_map(|(is, name)| is.then_some(name))
            .collect()
    }

    /// The archive for a target of rustc.
    ///
    /// # Errors
    /// The target is missing, or the archive cannot be built.
    pub(crate) fn archive(self, target: &str) -> Result<PathBuf, EmulatorError> {
        /// cargo puts one variant in the place of another.
        static BUILDING: Mutex<()> = Mutex::new(());
        let _building = BUILDING.lock().unwrap_or_else(PoisonError::into_inner);
        let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("archives");
        let mut script = Command::new("bash");
        script
            .arg(folder().join("archives.sh"))
            .arg(&out)
            .arg(target);
        script.env("STICTION_VARIANTS", self.variant());
        output_of(script)?;
        let name = match self.variant() {
            "float" => "libstiction.a".to_owned(),
            variant => format!("libstiction_{}.a", variant.replace(',', "_")),
        };
        Ok(out.join("lib").join(target).join(name))
    }
}
