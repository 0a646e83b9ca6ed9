//! The image of a board as a file: how much flash and RAM it takes, where its stack begins, which symbols are in it.

use object::{Object, ObjectSection, ObjectSymbol, SectionFlags, elf};
use std::fs;
use std::path::PathBuf;

/// The RAM of both chips begins here, and with flip-link the stack grows down to here.
pub(crate) const RAM: u64 = 0x2000_0000;

pub(crate) struct Image {
    pub(crate) path: PathBuf,
    /// Instructions, constants, the first values of variables (bytes).
    pub(crate) flash: u64,
    /// Static variables (bytes).
    pub(crate) variables: u64,
    /// The address from which the stack grows down.
    pub(crate) stack_top: u64,
    /// Names of functions, mangled.
    pub(crate) symbols: Vec<String>,
}

impl Image {
    pub(crate) fn of(path: PathBuf) -> Self {
        let bytes = fs::read(&path).unwrap();
        let file = object::File::parse(&*bytes).unwrap();
        let (mut flash, mut variables) = (0, 0);
        for section in file.sections() {
            let SectionFlags::Elf { sh_type, sh_flags } = section.flags() else {
                continue;
            };
            if !sh_flags.contains(elf::SHF_ALLOC) {
                continue;
            }
            if sh_type != elf::SHT_NOBITS {
                flash += section.size();
            }
            if section.address() >= RAM {
                variables += section.size();
            }
        }
        let symbols = file.symbols();
        let named: Vec<(String, u64)> = symbols
            .map(|symbol| {
                (
                    symbol.name().unwrap_or_default().to_owned(),
                    symbol.address(),
                )
            })
            .collect();
        let stack = named.iter().find(|(name, _)| name == "_stack_start");
        Self {
            flash,
            variables,
            stack_top: stack.expect("the linker names it").1,
            symbols: named.into_iter().map(|(name, _)| name).collect(),
            path,
        }
    }

    /// Symbols of panics: none in an image in which nothing can panic.
    pub(crate) fn panics(&self) -> Vec<&str> {
        let names = self.symbols.iter().map(String::as_str);
        let of_panics = |name: &&str| name.contains("panic") || name.contains("unwrap_failed");
        names.filter(of_panics).collect()
    }
}
