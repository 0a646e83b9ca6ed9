//! `stiction code`: a scene as C, for the C library.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;
use stiction_core::Fixed;
use stiction_live::number::named;
use stiction_scene::{InputError, NumberType, c_source};

use crate::input::open_scene;
use crate::report;
use crate::shell::scene_completer;

/// The arguments of `stiction code`.
#[derive(Args, Clone, Debug)]
pub struct CodeArgs {
    /// Scene file (TOML), or the name of a bundled scene
    #[arg(add = scene_completer())]
    scene: PathBuf,
    /// Number type of the library: f32, or fixed (without floating point)
    #[arg(long, default_value = "f32", value_parser = parse_number)]
    number: NumberType,
    /// Name of the scene in the code
    #[arg(long, default_value = "scene", value_parser = parse_name)]
    name: String,
}

fn parse_number(text: &str) -> Result<NumberType, String> {
    named(NumberType::ALL, NumberType::name, text)
}

/// The keywords of C23 and C++23, whose header the code may be in, and `main`.
#[rustfmt::skip]
const KEYWORDS: &[&str] = &[
    "alignas", "alignof", "and", "and_eq", "asm", "atomic_cancel", "atomic_commit", "atomic_noexcept", "auto", "bitand", "bitor", "bool",
    "break", "case", "catch", "char", "char16_t", "char32_t", "char8_t", "class", "compl", "concept", "const", "const_cast",
    "consteval", "constexpr", "constinit", "continue", "co_await", "co_return", "co_yield", "decltype", "default", "delete", "do", "double",
    "dynamic_cast", "else", "enum", "explicit", "export", "extern", "false", "float", "for", "friend", "goto", "if",
    "inline", "int", "long", "main", "mutable", "namespace", "new", "noexcept", "not", "not_eq", "nullptr", "operator",
    "or", "or_eq", "private", "protected", "public", "reflexpr", "register", "reinterpret_cast", "requires", "restrict", "return", "short",
    "signed", "sizeof", "static", "static_assert", "static_cast", "struct", "switch", "synchronized", "template", "this", "thread_local", "throw",
    "true", "try", "typedef", "typeid", "typename", "typeof", "typeof_unqual", "union", "unsigned", "using", "virtual", "void",
    "volatile", "wchar_t", "while", "xor", "xor_eq",
];

/// Two underscores, or one and a capital, are the compiler's.
fn is_reserved(name: &str) -> bool {
    let begins = name.strip_prefix('_');
    let has_capital = begins.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_uppercase()));
    has_capital || name.contains("__")
}

fn parse_name(text: &str) -> Result<String, String> {
    let is_letter = |c: char| c == '_' || c.is_ascii_alphabetic();
    let is_name =
        text.starts_with(is_letter) && text.chars().all(|c| is_letter(c) || c.is_ascii_digit());
    if !is_name {
        return Err("allowed: letters, digits and `_`, with no digit first".to_owned());
    }
    let reason = if KEYWORDS.contains(&text) {
        "a word of C or C++"
    } else if text.starts_with("stiction_") {
        "begins as the names of the library do"
    } else if is_reserved(text) {
        "reserved for the compiler"
    } else {
        return Ok(text.to_owned());
    };
    Err(format!(
        "{reason}, allowed: any other name, as `my_{}`",
        text.trim_matches('_')
    ))
}

/// Prints the code.
pub(crate) fn code(args: &CodeArgs) -> Result<(), InputError> {
    let scene = open_scene(&args.scene, args.number.into())?;
    match args.number {
        NumberType::F32 => scene.scene::<f32>().map(drop)?,
        NumberType::Fixed => scene.scene::<Fixed>().map(drop)?,
    }
    report::notes(&scene.notes);
    let code = c_source(&scene, args.number, &args.name);
    report::printed(io::stdout().write_all(code.as_bytes()));
    Ok(())
}
