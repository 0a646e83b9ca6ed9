//! The pictures of a run, each as SVG and PNG: the paths in the plane, the forces over time, the motion over time, a strip of
//! snapshots, and the insertion of a peg; or one of them as a figure for a paper, also as PDF. From a recorded run in SI units, world
//! frame, to files that need no font on the machine.

pub(crate) mod figure;
mod forces;
pub(crate) mod fronts;
mod insertion;
mod instants;
mod legend;
mod motion;
mod notes;
mod obstacles;
mod page;
mod pdf;
mod plane;
mod series;
mod sheet;
mod slides;
mod states;
mod strip;
pub(crate) mod style;
mod timeline;
mod trajectory;

#[cfg(test)]
mod tests;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::files::whole as files;

use page::Page;
use stiction_live::record::Run;

/// The reason why the pictures of a run could not be written.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// The run has no record, so there is nothing to show.
    #[error("the run has no frames to plot")]
    Empty,
    /// The directory cannot be created.
    #[error("cannot create the plot directory {}: {source}", path.display())]
    Directory {
        /// The directory.
        path: PathBuf,
        /// The system's message.
        source: io::Error,
    },
    /// A picture cannot be written.
    #[error("cannot write the plot {}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The system's message.
        source: io::Error,
    },
    /// A picture cannot be drawn.
    #[error("cannot draw the plot {name}: {reason}")]
    Drawing {
        /// The picture.
        name: &'static str,
        /// The drawing library's message.
        reason: String,
    },
}

/// A picture: from a run to the text of an SVG.
type Picture = fn(&Run, &Page) -> sheet::Drawn<String>;

/// The pictures of any run by the stems of their file names.
const PICTURES: [(&str, Picture); 4] = [
    ("trajectory", trajectory::svg),
    ("forces", forces::svg),
    ("motion", motion::svg),
    ("strip", strip::svg),
];

const INSERTION: (&str, Picture) = ("insertion", insertion::svg);

fn pictures(run: &Run) -> impl Iterator<Item = (&'static str, Picture)> {
    let insertion = run.meter.is_some().then_some(INSERTION);
    PICTURES.into_iter().chain(insertion)
}

/// The files that [`write`] writes into `dir` of this run.
pub(crate) fn places(run: &Run, dir: &Path) -> Vec<PathBuf> {
    let both = |(name, _)| ["svg", "png"].map(|extension| dir.join(name).with_extension(extension));
    pictures(run).flat_map(both).collect()
}

/// Writes `trajectory`, `forces`, `motion`, `strip` and, for a peg and a hole, `insertion`, each as `.svg` and `.png`, to `dir`,
/// which is created if it is missing. Returns the paths of the files in that order.
pub(crate) fn write(run: &Run, dir: &Path) -> Result<Vec<PathBuf>, PlotError> {
    if run.frames.is_empty() {
        return Err(PlotError::Empty);
    }
    fs::create_dir_all(dir).map_err(|source| PlotError::Directory {
        path: dir.to_owned(),
        source,
    })?;
    let rasterizer = sheet::Rasterizer::new();
    let mut files = Vec::new();
    for (name, picture) in pictures(run) {
        let drawing = |reason| PlotError::Drawing { name, reason };
        let svg = picture(run, &Page::screen()).map_err(|error| drawing(error.to_string()))?;
        files.push(save(dir.join(name).with_extension("svg"), svg.as_bytes())?);
        let png = rasterizer.png(&svg).map_err(drawing)?;
        files.push(save(dir.join(name).with_extension("png"), &png)?);
    }
    Ok(files)
}

/// The pictures of a run: the stems of their file names, and SVG.
///
/// # Errors
/// [`PlotError`]: no frames, or one cannot be drawn.
pub fn svgs(run: &Run) -> Result<Vec<(String, String)>, PlotError> {
    if run.frames.is_empty() {
        return Err(PlotError::Empty);
    }
    let drawn = |(name, picture): (&'static str, Picture)| match picture(run, &Page::screen()) {
        Ok(svg) => Ok((name.to_owned(), svg)),
        Err(error) => Err(PlotError::Drawing {
            name,
            reason: error.to_string(),
        }),
    };
    pictures(run).map(drawn).collect()
}

/// A picture of errors against costs: the text of its SVG, and its PNG.
pub(crate) fn fronts(fronts: &fronts::Fronts) -> Result<(String, Vec<u8>), PlotError> {
    let drawing = |reason| PlotError::Drawing {
        name: "fronts",
        reason,
    };
    let svg = fronts.svg().map_err(|error| drawing(error.to_string()))?;
    let png = sheet::Rasterizer::new().png(&svg).map_err(drawing)?;
    Ok((svg, png))
}

fn save(path: PathBuf, bytes: &[u8]) -> Result<PathBuf, PlotError> {
    match files::write(&path, bytes) {
        Ok(()) => Ok(path),
        Err(source) => Err(PlotError::File { path, source }),
    }
}
