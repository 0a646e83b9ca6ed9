//! A sheet of drawing paper: from drawing commands to the text of an SVG, and from there to a PNG. Lengths are pixels of the
//! SVG; plotters draws on integers, so the sheet is divided into finer steps and scaled back by its view box.

use super::style::{DASHES, PAPER};
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use resvg::{tiny_skia, usvg};
use std::io;
use std::sync::Arc;

/// A part of a sheet, measured in steps.
pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// A part of a sheet with two axes.
pub(super) type Plane<'a> =
    DrawingArea<SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
/// What drawing gives.
pub(super) type Drawn<T = ()> = Result<T, DrawingAreaErrorKind<io::Error>>;

/// Steps per pixel.
const STEPS: f64 = 10.0;
/// Pixels of the PNG per pixel of the SVG.
pub(super) const PNG_SCALE: u32 = 2;

/// A length in pixels as steps.
pub(super) fn px(length: f64) -> i32 {
    (length * STEPS).round() as i32
}

/// The stroke of a line, in a color and a width [px].
pub(super) fn stroke(color: impl Into<RGBAColor>, width: f64) -> ShapeStyle {
    ShapeStyle {
        color: color.into(),
        filled: false,
        stroke_width: px(width) as u32,
    }
}

/// The width and height of an area [px].
pub(super) fn size(area: &Area) -> (f64, f64) {
    let (width, height) = area.dim_in_pixel();
    (f64::from(width) / STEPS, f64::from(height) / STEPS)
}

/// The part of an area from `corner` on, of the given width and height [px].
pub(super) fn part<'a>(area: &Area<'a>, corner: (f64, f64), size: (f64, f64)) -> Area<'a> {
    area.clone()
        .shrink((px(corner.0), px(corner.1)), (px(size.0), px(size.1)))
}

/// The SVG of what `draw` draws on a white sheet of `width` × `height` pixels.
pub(super) fn svg((width, height): (f64, f64), draw: impl FnOnce(&Area) -> Drawn) -> Drawn<String> {
    let steps = (px(width) as u32, px(height) as u32);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, steps).into_drawing_area();
        area.fill(&PAPER)?;
        draw(&area)?;
        area.present()?;
    }
    let fine = format!(r#"<svg width="{}" height="{}""#, steps.0, steps.1);
    let scaled = format!(r#"<svg width="{width}" height="{height}" stroke-linejoin="round""#);
    Ok(dash(text.replacen(&fine, &scaled, 1)))
}

/// Dashes the lines in the colors of [`DASHES`]; plotters itself cuts a dashed line into one element per dash.
fn dash(svg: String) -> String {
    DASHES.iter().fold(svg, |svg, (color, pattern)| {
        let RGBColor(r, g, b) = *color;
        let stroke = format!(r##"stroke="#{r:02X}{g:02X}{b:02X}""##);
        let steps = pattern.map(px);
        let dashed = format!(r#"{stroke} stroke-dasharray="{} {}""#, steps[0], steps[1]);
        svg.replace(&stroke, &dashed)
    })
}

/// Turns SVGs into PNGs with a font of its own.
pub(super) struct Rasterizer {
    options: usvg::Options<'static>,
}

impl Rasterizer {
    /// With DejaVu Sans, which the program carries.
    pub(super) fn new() -> Self {
        let mut options = usvg::Options::default();
        let fonts = options.fontdb_mut();
        fonts.load_font_source(usvg::fontdb::Source::Binary(Arc::new(
            dejavu::sans::regular(),
        )));
        fonts.set_sans_serif_family("DejaVu Sans");
        Self { options }
    }

    /// The PNG of an SVG, [`PNG_SCALE`] times as large.
    pub(super) fn png(&self, svg: &str) -> Result<Vec<u8>, String> {
        let tree = usvg::Tree::from_str(svg, &self.options).map_err(|error| error.to_string())?;
        let size = tree.size().to_int_size();
        let (width, height) = (size.width() * PNG_SCALE, size.height() * PNG_SCALE);
        let mut pixels = tiny_skia::Pixmap::new(width, height)
            .ok_or_else(|| format!("a picture of {width} x {height} pixels is not possible"))?;
        let scale = tiny_skia::Transform::from_scale(PNG_SCALE as f32, PNG_SCALE as f32);
        resvg::render(&tree, scale, &mut pixels.as_mut());
        pixels.encode_png().map_err(|error| error.to_string())
    }
}
