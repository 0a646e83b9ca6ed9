//! `stiction figures`: the figures 9 to 14 of the paper, from the bundled scenes. `FIGURES.md` says what is known of each.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::figure_options::parse_width;
use crate::files::{self, WriteError};
use crate::input::open_scene;
use crate::plot::figure::{Figure, FigureFormat, FigurePicture};
use crate::report;
use crate::settings::Settings;
use stiction_live::input::open_path;
use stiction_live::record::Run;
use stiction_scene::InputError;

/// The arguments of `stiction figures`.
#[derive(Args, Clone, Debug)]
pub struct FiguresArgs {
    /// Folder for the figures 9 to 14 of the paper that the method is from, in its order
    #[arg(long, value_name = "DIR")]
    paper: PathBuf,
    /// Format of the files
    #[arg(long, value_enum, default_value_t = FigureFormat::Pdf)]
    format: FigureFormat,
    /// Width in print, in mm, cm, in or pt
    #[arg(long, default_value = "85mm", value_parser = parse_width)]
    width: f64,
}

/// A figure of the paper.
struct Numbered {
    number: u32,
    scene: &'static str,
    picture: FigurePicture,
    /// The instants at which the body is shown, and the part of the run [s].
    at: &'static [f64],
    interval: Option<[f64; 2]>,
}

/// In the order of the paper.
const FIGURES: [Numbered; 6] = [
    Numbered {
        number: 9,
        scene: "vertex-stick-slip",
        picture: FigurePicture::Trajectory,
        at: &[0.5, 3.0, 5.5],
        interval: None,
    },
    Numbered {
        number: 10,
        scene: "vertex-stick-slip",
        picture: FigurePicture::Forces,
        at: &[],
        interval: Some([0.0, 2.5]),
    },
    Numbered {
        number: 11,
        scene: "corner-stick-slip",
        picture: FigurePicture::Trajectory,
        at: &[0.5, 2.0, 3.5],
        interval: Some([0.5, 3.5]),
    },
    Numbered {
        number: 12,
        scene: "corner-stick-slip",
        picture: FigurePicture::Motion,
        at: &[],
        interval: Some([1.0, 3.5]),
    },
    Numbered {
        number: 13,
        scene: "edge-about-to-slip",
        picture: FigurePicture::Strip,
        at: &[1.5],
        interval: None,
    },
    Numbered {
        number: 14,
        scene: "edge-about-to-slip",
        picture: FigurePicture::Strip,
        at: &[2.5],
        interval: None,
    },
];

/// Draws the figures, each from a run of its scene.
///
/// # Errors
/// A file cannot be written; those before it are complete.
pub(crate) fn figures(args: &FiguresArgs) -> Result<(), Box<dyn Error>> {
    let file = |number: u32| {
        let name = format!("figure-{number:02}.{}", args.format.name());
        args.paper.join(name)
    };
    let written = FIGURES
        .iter()
        .map(|figure| ("--paper", file(figure.number)));
    files::check(std::iter::empty(), written)?;
    fs::create_dir_all(&args.paper).map_err(WriteError::of(&args.paper))?;
    let mut text = String::new();
    for of in &FIGURES {
        let figure = Figure {
            picture: of.picture,
            width: args.width,
            title: None,
            at: of.at.to_vec(),
            interval: of.interval,
        };
        let file = figure.write(&recorded(of.scene)?, &file(of.number))?;
        text += &report::written(&format!("figure {}", of.number), &file);
    }
    report::print(&text);
    Ok(())
}

/// The run of a bundled scene, in the default settings.
pub(crate) fn recorded(scene: &str) -> Result<Run, InputError> {
    let settings = Settings::default();
    let scene = open_scene(Path::new(scene), settings.number)?;
    let mut run = Run::of(&scene, settings.number, settings.evolution);
    let (path, rate) = open_path(&scene, None, None)?;
    settings.simulate(&scene, path.frames(rate), |frame| {
        run.frames.push(frame);
        Ok::<_, InputError>(())
    })?;
    Ok(run)
}
