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

fn parse_name(text: &str) -> Result<String, String> {
    let is_letter = |c: char| c == '_' || c.is_ascii_alphabetic();
    let is_name =
        text.starts_with(is_letter) && text.chars().all(|c| is_letter(c) || c.is_ascii_digit());
    let allowed = "allowed: letters, digits and `_`, with no digit first";
    is_name
        .then(|| text.to_owned())
        .ok_or_else(|| allowed.to_owned())
}

/// Prints the code.
pub(crate) fn code(args: &CodeArgs) -> Result<(), InputError> {
    let scene = open_scene(&args.scene, args.number.into())?;
    match args.number {
        NumberType::F32 => scene.check_scene::<f32>()?,
        NumberType::Fixed => scene.check_scene::<Fixed>()?,
    }
    let code = c_source(&scene, args.number, &args.name);
    report::printed(io::stdout().write_all(code.as_bytes()));
    Ok(())
}
