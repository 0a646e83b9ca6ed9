//! A figure for a paper: one picture of a run, or of a part of it, at the width that it has in print.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use clap::ValueEnum;

use super::page::Page;
use super::{PlotError, pdf, sheet};
use stiction_live::record::{Frame, Run};

/// Widths in print [mm]: below, the labels have no room; above, there is no paper.
pub(crate) const WIDTHS: RangeInclusive<f64> = 70.0..=420.0;
/// The width of a column of most papers [mm].
pub(crate) const COLUMN: f64 = 85.0;

/// The format of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum FigureFormat {
    Pdf,
    Svg,
    Png,
}

impl FigureFormat {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Pdf => "pdf",
            Self::Svg => "svg",
            Self::Png => "png",
        }
    }

    /// The format that a file's name ends in.
    pub(crate) fn of(file: &Path) -> Option<Self> {
        let extension = file.extension()?.to_str()?.to_lowercase();
        let formats = Self::value_variants().iter();
        formats.copied().find(|format| format.name() == extension)
    }
}

/// What a figure shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum FigurePicture {
    /// The paths in the plane
    Trajectory,
    /// The forces over time
    Forces,
    /// The motion over time
    Motion,
    /// Snapshots
    Strip,
    /// A peg in its hole
    Insertion,
}

impl FigurePicture {
    fn picture(self) -> super::Picture {
        match self {
            Self::Trajectory => super::trajectory::svg,
            Self::Forces => super::forces::svg,
            Self::Motion => super::motion::svg,
            Self::Strip => super::strip::svg,
            Self::Insertion => super::insertion::svg,
        }
    }
}

/// A figure, apart from the run that it shows.
#[derive(Clone, Debug)]
pub(crate) struct Figure {
    pub(crate) picture: FigurePicture,
    /// Width in print [mm].
    pub(crate) width: f64,
    pub(crate) title: Option<String>,
    /// The instants at which the body is shown [s]; without one, the picture chooses them.
    pub(crate) at: Vec<f64>,
    /// The part of the run [s].
    pub(crate) interval: Option<[f64; 2]>,
}

/// The reason why a run has no such figure.
#[derive(Debug, thiserror::Error)]
pub(crate) enum FigureError {
    /// An instant or an interval outside the run.
    #[error("{option}: {asked} s is not in the run, allowed: from {begin} to {end} s")]
    Outside {
        option: &'static str,
        asked: f64,
        begin: f64,
        end: f64,
    },
    /// The picture of a peg, of a scene without one.
    #[error(
        "--picture insertion: the scene has no peg and hole, allowed: trajectory, forces, motion, strip"
    )]
    NoPeg,
    #[error("{0}")]
    Plot(#[from] PlotError),
}

impl Figure {
    /// Whether a run from `begin` to `end` [s] of this scene has the figure.
    pub(crate) fn check(&self, run: &Run, [begin, end]: [f64; 2]) -> Result<(), FigureError> {
        let asked = self.at.iter().map(|t| ("--at", *t));
        let ends = self.interval.iter().flatten().map(|t| ("--interval", *t));
        for (option, asked) in ends.chain(asked) {
            if !(begin..=end).contains(&asked) {
                return Err(FigureError::Outside {
                    option,
                    asked,
                    begin,
                    end,
                });
            }
        }
        match self.picture {
            FigurePicture::Insertion if run.meter.is_none() => Err(FigureError::NoPeg),
            _ => Ok(()),
        }
    }

    /// The figure as SVG, its width and height in mm.
    fn svg(&self, run: &Run) -> Result<String, PlotError> {
        let within = |frame: &&Frame| {
            let interval = self.interval.iter();
            interval
                .clone()
                .all(|[begin, end]| (*begin..=*end).contains(&frame.t))
        };
        let part = Run {
            frames: run.frames.iter().filter(within).cloned().collect(),
            ..run.clone()
        };
        if part.frames.is_empty() {
            return Err(PlotError::Empty);
        }
        let page = Page::paper(self.width, self.title.clone()).at(self.at.clone());
        (self.picture.picture())(&part, &page).map_err(|error| drawing(error.to_string()))
    }

    /// The content of the figure's file.
    pub(crate) fn bytes(&self, run: &Run, format: FigureFormat) -> Result<Vec<u8>, PlotError> {
        let svg = self.svg(run)?;
        let rasterizer = sheet::Rasterizer::new();
        match format {
            FigureFormat::Svg => Ok(svg.into_bytes()),
            FigureFormat::Png => rasterizer.printed(&svg).map_err(drawing),
            FigureFormat::Pdf => {
                let tree = rasterizer.tree(&svg).map_err(drawing)?;
                pdf::pdf(&tree).map_err(drawing)
            }
        }
    }

    /// Writes the figure in the format of the file's name.
    pub(crate) fn write(&self, run: &Run, file: &Path) -> Result<PathBuf, PlotError> {
        let format = FigureFormat::of(file).unwrap_or(FigureFormat::Pdf);
        super::save(file.to_owned(), &self.bytes(run, format)?)
    }
}

fn drawing(reason: String) -> PlotError {
    PlotError::Drawing {
        name: "figure",
        reason,
    }
}
