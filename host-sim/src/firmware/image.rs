//! Images of the firmware: how cargo builds them, and their contents: flash and RAM, the start of the stack, symbols.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use object::read::elf::{FileHeader, ProgramHeader};
use object::{Endianness, Object, ObjectSection, ObjectSymbol, SectionFlags, elf};
use serde_json::Value;

use super::needs::{Need, require};
use super::process::{EmulatorError, output_of};

/// The lowest RAM address of the chips.
pub const RAM: u64 = 0x2000_0000;

/// Cargo at low priority: an emulator that a build keeps from its core loses bytes of its line.
pub fn cargo() -> Command {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    if !cfg!(unix) {
        return Command::new(cargo);
    }
    let mut nice = Command::new("nice");
    nice.args(["-n", "19"]).arg(cargo);
    nice
}

/// A cargo command that builds in a folder with a profile; [`built`] finds the built file in its messages.
pub fn cargo_build(folder: &Path, profile: &str) -> Command {
    let mut cargo = cargo();
    cargo.current_dir(folder);
    cargo.args(["build", "--locked", "--profile", profile]);
    cargo.arg("--message-format=json-render-diagnostics");
    cargo
}

/// The file of the last program in cargo's messages.
///
/// # Errors
/// Cargo, the target or the linker is missing, or the program cannot be built.
pub fn built(cargo: Command) -> Result<PathBuf, EmulatorError> {
    require([Need::Build])?;
    let messages = output_of(cargo)?;
    let file = messages.lines().rev().find_map(artifact);
    file.ok_or_else(|| EmulatorError::Output("cargo names no image".to_owned()))
}

/// The file in a message of cargo, if the message reports a finished program.
fn artifact(message: &str) -> Option<PathBuf> {
    let message: Value = serde_json::from_str(message).ok()?;
    if message["reason"] != "compiler-artifact" {
        return None;
    }
    message["executable"].as_str().map(PathBuf::from)
}

/// A part of the flash and the bytes that an image writes there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its start address.
    pub at: u32,
    /// Its contents.
    pub bytes: Vec<u8>,
}

/// The parts of the flash that an image writes.
///
/// # Errors
/// The file cannot be read, or is not an image of 32 bits.
pub fn parts(image: &Path) -> Result<Vec<Part>, EmulatorError> {
    let bytes = fs::read(image)?;
    let unread = |error: object::Error| EmulatorError::Output(error.to_string());
    let file = elf::FileHeader32::<Endianness>::parse(&*bytes).map_err(unread)?;
    let endian = file.endian().map_err(unread)?;
    let mut parts = Vec::new();
    for part in file.program_headers(endian, &*bytes).map_err(unread)? {
        let at = part.p_paddr(endian);
        let cut = || EmulatorError::Output(format!("the image lacks the data for {at:#x}"));
        let data = part.data(endian, &*bytes).map_err(|()| cut())?;
        if part.p_type(endian) == elf::PT_LOAD && !data.is_empty() {
            let bytes = data.to_owned();
            parts.push(Part { at, bytes });
        }
    }
    Ok(parts)
}

/// The contents of a flash that starts at an address after an image is written; the rest is 0.
///
/// # Errors
/// The errors of [`parts`], or a part lies before the flash.
pub fn flashed(image: &Path, begin: u32) -> Result<Vec<u8>, EmulatorError> {
    let mut flash = Vec::new();
    for Part { at, bytes } in parts(image)? {
        let unplaced = || EmulatorError::Output(format!("{at:#x} is not in the flash"));
        let at = at.checked_sub(begin).ok_or_else(unplaced)? as usize;
        flash.resize(flash.len().max(at + bytes.len()), 0);
        flash[at..at + bytes.len()].copy_from_slice(&bytes);
    }
    Ok(flash)
}

/// The contents of a board's image.
#[derive(Clone, Debug)]
pub struct Contents {
    /// Instructions, constants, the first values of variables (bytes).
    pub flash: u64,
    /// Static variables (bytes).
    pub variables: u64,
    /// The address from which the stack grows down, if the linker defines it.
    pub stack_top: Option<u64>,
    /// Names of functions, mangled, and their addresses.
    pub symbols: Vec<(String, u64)>,
}

impl Contents {
    /// The contents of a file.
    ///
    /// # Errors
    /// It cannot be read, or is not an image.
    pub fn of(image: &Path) -> Result<Self, EmulatorError> {
        let bytes = fs::read(image)?;
        let file = object::File::parse(&*bytes)
            .map_err(|error| EmulatorError::Output(error.to_string()))?;
        let mut contents = Self {
            flash: 0,
            variables: 0,
            stack_top: None,
            symbols: Vec::new(),
        };
        for section in file.sections() {
            let SectionFlags::Elf { sh_type, sh_flags } = section.flags() else {
                continue;
            };
            if !sh_flags.contains(elf::SHF_ALLOC) {
                continue;
            }
            if sh_type != elf::SHT_NOBITS {
                contents.flash += section.size();
            }
            if section.address() >= RAM {
                contents.variables += section.size();
            }
        }
        for symbol in file.symbols() {
            let name = symbol.name().unwrap_or_default();
            if name == "_stack_start" {
                contents.stack_top = Some(symbol.address());
            }
            contents.symbols.push((name.to_owned(), symbol.address()));
        }
        Ok(contents)
    }

    /// Symbols of panics: none in an image in which nothing can panic.
    pub fn panics(&self) -> Vec<&str> {
        let names = self.symbols.iter().map(|(name, _)| name.as_str());
        let of_panics = |name: &&str| name.contains("panic") || name.contains("unwrap_failed");
        names.filter(of_panics).collect()
    }
}
