//! What builds and emulates images: looked for before anything is built, and all that is missing named at once, with the commands that
//! install it.

use std::env;
use std::path::Path;
use std::process::Command;

use super::process::{EmulatorError, install, output_of, require_qemu_arm};
use super::{BOARDS, SOURCES, workspace};

/// Something that is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// The packages that images are built from, and cargo with the compiler.
    Build,
    /// A target of the compiler.
    Target(&'static str),
    /// The linker that puts the stack below the variables.
    FlipLink,
    /// QEMU for boards with an ARM processor.
    QemuArm,
}

impl Need {
    fn missing(self) -> Option<(String, String)> {
        let named = |error| {
            let EmulatorError::Missing { what, install } = error else {
                return None;
            };
            Some((what, install))
        };
        match self {
            Self::Build => sources().or_else(rust),
            Self::Target(target) => {
                let mut rustc =
                    Command::new(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
                rustc.current_dir(workspace());
                rustc.args(["--print", "target-libdir", "--target", target]);
                // Without a compiler that is what is missing.
                let folder = output_of(rustc).ok()?;
                let add = format!("rustup target add {target}");
                let is_there = Path::new(folder.trim()).is_dir();
                (!is_there).then(|| (format!("the target {target}"), add))
            }
            Self::FlipLink => {
                let name = "flip-link";
                let file = format!("{name}{}", env::consts::EXE_SUFFIX);
                let path = env::var_os("PATH").unwrap_or_default();
                let is_there = env::split_paths(&path).any(|folder| folder.join(&file).is_file());
                (!is_there).then(|| (name.to_owned(), install(name)))
            }
            Self::QemuArm => require_qemu_arm().err().and_then(named),
        }
    }
}

/// The sources, if they are nowhere.
fn sources() -> Option<(String, String)> {
    let is_there = workspace().join(BOARDS).is_dir();
    let place = match env::var_os(SOURCES) {
        Some(folder) => format!(" ({SOURCES} is {})", Path::new(&folder).display()),
        None => String::new(),
    };
    let what = format!("the sources of stiction, which this command builds from{place}");
    let install = format!("run it in a checkout, or set {SOURCES} to the folder of one");
    (!is_there).then_some((what, install))
}

/// The compiler and what calls it, if they are not installed.
fn rust() -> Option<(String, String)> {
    let mut rustc = Command::new(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
    rustc.arg("--version");
    let install = "see https://rustup.rs".to_owned();
    match output_of(rustc) {
        Err(EmulatorError::Missing { .. }) => Some(("Rust".to_owned(), install)),
        _ => None,
    }
}

/// All of this is there.
///
/// # Errors
/// [`EmulatorError::Missing`] with everything that is not.
pub fn require(needs: impl IntoIterator<Item = Need>) -> Result<(), EmulatorError> {
    let missing: Vec<_> = needs.into_iter().filter_map(Need::missing).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let (what, install): (Vec<_>, Vec<_>) = missing.into_iter().unzip();
    let install = match &install[..] {
        [one] => one.clone(),
        several => format!("these commands\n  {}", several.join("\n  ")),
    };
    let what = what.join(", ");
    Err(EmulatorError::Missing { what, install })
}
