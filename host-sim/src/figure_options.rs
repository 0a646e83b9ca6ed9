//! The options of `stiction run` that ask for pictures: a folder of all, or a file with one of them for a paper.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{OsStringValueParser, TypedValueParser};

use crate::files::Written;
use crate::plot::figure::{COLUMN, Figure, FigureError, FigureFormat, FigurePicture, WIDTHS};
use crate::plot::{self, PlotError};
use crate::report;
use stiction_live::record::Run;

/// Which pictures are drawn.
#[derive(Args, Clone, Debug)]
pub(crate) struct FigureOptions {
    /// Folder for all plots, or a file for one of them, as a figure for a paper: FILE.pdf, FILE.svg or FILE.png
    #[arg(long, value_name = "DIR|FILE", value_parser = OsStringValueParser::new().try_map(target))]
    plot: Option<PlotTarget>,
    /// What the figure shows (default: trajectory)
    #[arg(long, value_enum, help_heading = FIGURE)]
    picture: Option<FigurePicture>,
    /// Width of the figure in print, in mm, cm, in or pt (default: 85mm)
    #[arg(long, value_parser = parse_width, help_heading = FIGURE)]
    width: Option<f64>,
    /// Title of the figure; without it there is none
    #[arg(long, value_name = "TEXT", help_heading = FIGURE)]
    title: Option<String>,
    /// Instants (s) at which the figure shows the body: 1.5 or 0.5,1.5,2
    #[arg(long, value_name = "T,...", value_delimiter = ',', value_parser = parse_instant, allow_hyphen_values = true, help_heading = FIGURE)]
    at: Vec<f64>,
    /// Part of the run (s) that the figure shows: 0.5..2
    #[arg(long, value_name = "BEGIN..END", value_parser = parse_interval, allow_hyphen_values = true, help_heading = FIGURE)]
    interval: Option<[f64; 2]>,
}

const FIGURE: &str = "Options of a figure, --plot FILE";

/// Where pictures go.
#[derive(Clone, Debug)]
enum PlotTarget {
    Folder(PathBuf),
    File(PathBuf),
}

/// A file if its name says so, unless there is a folder of that name.
fn target(name: std::ffi::OsString) -> Result<PlotTarget, &'static str> {
    /// Names of pictures that nobody gives to a folder.
    const OTHERS: [&str; 9] = [
        "bmp", "emf", "eps", "gif", "jpeg", "jpg", "ps", "tif", "tiff",
    ];
    let path = PathBuf::from(name);
    let extension = path.extension().and_then(|extension| extension.to_str());
    let is_other = extension.is_some_and(|name| OTHERS.contains(&name.to_lowercase().as_str()));
    match FigureFormat::of(&path) {
        _ if path.is_dir() => Ok(PlotTarget::Folder(path)),
        Some(_) => Ok(PlotTarget::File(path)),
        None if path.is_file() => {
            Err("it is a file, allowed: a folder, or FILE.pdf, FILE.svg or FILE.png")
        }
        None if is_other => Err("allowed: a folder, or FILE.pdf, FILE.svg or FILE.png"),
        None => Ok(PlotTarget::Folder(path)),
    }
}

/// A width in print (mm).
pub(crate) fn parse_width(text: &str) -> Result<f64, String> {
    /// The units, in mm.
    const UNITS: [(&str, f64); 4] = [("mm", 1.0), ("cm", 10.0), ("in", 25.4), ("pt", 25.4 / 72.0)];
    let length = UNITS.iter().find_map(|(unit, length)| {
        let number = text.strip_suffix(unit)?.trim();
        number.parse::<f64>().ok().map(|number| number * length)
    });
    match length {
        Some(length) if WIDTHS.contains(&length) => Ok(length),
        _ => Err(format!(
            "allowed: a length from {} to {} mm with its unit mm, cm, in or pt, as in 85mm",
            WIDTHS.start(),
            WIDTHS.end()
        )),
    }
}

fn parse_instant(text: &str) -> Result<f64, String> {
    match text.trim().parse() {
        Ok(time) if f64::is_finite(time) => Ok(time),
        _ => Err("allowed: times in s with commas between, as in 0.5,1.5".to_owned()),
    }
}

fn parse_interval(text: &str) -> Result<[f64; 2], String> {
    let ends = text.split_once("..");
    let ends = ends.map(|(begin, end)| [begin, end].map(parse_instant));
    match ends {
        Some([Ok(begin), Ok(end)]) if begin < end => Ok([begin, end]),
        _ => Err("allowed: two times in s, the earlier one first, as in 0.5..2".to_owned()),
    }
}

/// An option of a figure without a file for it.
#[derive(Debug, thiserror::Error)]
#[error("{0}: only a figure has it, allowed: with --plot FILE.pdf, FILE.svg or FILE.png")]
pub(crate) struct NoFigure(&'static str);

impl FigureOptions {
    /// The pictures that were asked for.
    pub(crate) fn pictures(&self) -> Result<Pictures, NoFigure> {
        let Some(PlotTarget::File(file)) = &self.plot else {
            let given = [
                ("--picture", self.picture.is_some()),
                ("--width", self.width.is_some()),
                ("--title", self.title.is_some()),
                ("--at", !self.at.is_empty()),
                ("--interval", self.interval.is_some()),
            ];
            if let Some((option, _)) = given.into_iter().find(|(_, given)| *given) {
                return Err(NoFigure(option));
            }
            return Ok(match &self.plot {
                Some(PlotTarget::Folder(folder)) => Pictures::Folder(folder.clone()),
                _ => Pictures::None,
            });
        };
        let figure = Figure {
            picture: self.picture.unwrap_or(FigurePicture::Trajectory),
            width: self.width.unwrap_or(COLUMN),
            title: self.title.clone(),
            at: self.at.clone(),
            interval: self.interval,
        };
        Ok(Pictures::Figure(file.clone(), Box::new(figure)))
    }
}

/// The pictures of a run.
pub(crate) enum Pictures {
    None,
    /// All of them, into a folder.
    Folder(PathBuf),
    /// One, into a file.
    Figure(PathBuf, Box<Figure>),
}

impl Pictures {
    /// Whether they need the frames of the run.
    pub(crate) fn any(&self) -> bool {
        !matches!(self, Self::None)
    }

    /// The files that are written.
    pub(crate) fn places(&self, run: &Run) -> Vec<Written> {
        let places = match self {
            Self::None => Vec::new(),
            Self::Folder(folder) => plot::places(run, folder),
            Self::Figure(file, _) => vec![file.clone()],
        };
        places.into_iter().map(|file| ("--plot", file)).collect()
    }

    /// Whether a run over these times [s] has them.
    pub(crate) fn check(
        &self,
        run: &Run,
        times: impl Iterator<Item = f64>,
    ) -> Result<(), FigureError> {
        let Self::Figure(_, figure) = self else {
            return Ok(());
        };
        let ends = times.fold(None, |ends: Option<[f64; 2]>, t| {
            Some([ends.map_or(t, |[begin, _]| begin), t])
        });
        match ends {
            Some(ends) => figure.check(run, ends),
            None => Ok(()),
        }
    }

    /// Writes them; returns the lines of the summary that say where.
    pub(crate) fn write(&self, run: &Run) -> Result<String, PlotError> {
        Ok(match self {
            Self::None => String::new(),
            Self::Folder(folder) => report::plots(folder, &plot::write(run, folder)?),
            Self::Figure(file, figure) => report::written("figure", &figure.write(run, file)?),
        })
    }
}
