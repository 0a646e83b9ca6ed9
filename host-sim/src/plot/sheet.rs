//! A sheet of drawing paper: from drawing commands to the text of an SVG, and from there to a PNG. Lengths are pixels of the
//! SVG; plotters draws on integers, so the sheet is divided into finer steps and scaled back by its view box.

use super::page::Page;
use super::style::{DASHES, PAPER, SUBSCRIPT, number};
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
pub(super) type Drawn<T = ()> = Result<T, DrawingAreaErrorKind<io::Error>>;

/// Steps per pixel.
const STEPS: f64 = 10.0;
/// Pixels of the PNG per pixel of the SVG on a screen.
pub(super) const PNG_SCALE: u32 = 2;
/// Pixels per inch of the PNG in a paper: what printers of papers ask of drawings with text.
const PRINTED: f32 = 600.0;
/// Pixels per inch of an SVG.
const PER_INCH: f32 = 96.0;

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

/// The SVG of what `draw` draws on a white sheet, `height` pixels high.
pub(super) fn svg(page: &Page, height: f64, draw: impl FnOnce(&Area) -> Drawn) -> Drawn<String> {
    let height = height.ceil();
    let steps = (px(page.width) as u32, px(height) as u32);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, steps).into_drawing_area();
        area.fill(&PAPER)?;
        draw(&area)?;
        area.present()?;
    }
    let fine = format!(r#"<svg width="{}" height="{}""#, steps.0, steps.1);
    let (unit, name) = page.unit();
    let [width, height] = [page.width, height].map(|length| number(unit * length));
    let scaled =
        format!(r#"<svg width="{width}{name}" height="{height}{name}" stroke-linejoin="round""#);
    Ok(lowered(&dash(text.replacen(&fine, &scaled, 1))))
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

/// Sets every letter after [`SUBSCRIPT`] smaller and lower; plotters has one size and one line for a text. Unicode has no subscript d.
fn lowered(svg: &str) -> String {
    /// In parts of the type's size; `DOWN` in that of the small letter, `UP` in that of the line. The letter has 7 points in a paper,
    /// the least that can be read.
    const SMALL: f64 = 0.85;
    const UP: f64 = 0.22;
    const DOWN: f64 = UP / SMALL;
    let (first, marked) = svg.split_once(SUBSCRIPT).unwrap_or((svg, ""));
    let mut text = first.to_owned();
    for part in marked.split(SUBSCRIPT).filter(|part| !part.is_empty()) {
        let (letter, rest) = part.split_at(part.chars().next().map_or(0, char::len_utf8));
        let (line, after) = rest.split_at(rest.find("</text>").unwrap_or(rest.len()));
        text += &format!(r#"<tspan dy="{DOWN:.3}em" font-size="{SMALL}em">{letter}</tspan>"#);
        text += &format!(r#"<tspan dy="-{UP:.3}em">{line}</tspan>{after}"#);
    }
    text
}

pub(super) struct Rasterizer {
    options: usvg::Options<'static>,
}

impl Rasterizer {
    /// With DejaVu Sans, which is built into the program.
    pub(super) fn new() -> Self {
        let mut options = usvg::Options::default();
        let fonts = options.fontdb_mut();
        fonts.load_font_source(usvg::fontdb::Source::Binary(Arc::new(
            dejavu::sans::regular(),
        )));
        fonts.set_sans_serif_family("DejaVu Sans");
        Self { options }
    }

    /// An SVG with its texts laid out.
    pub(super) fn tree(&self, svg: &str) -> Result<usvg::Tree, String> {
        usvg::Tree::from_str(svg, &self.options).map_err(|error| error.to_string())
    }

    /// The PNG of an SVG for a screen, [`PNG_SCALE`] times as large.
    pub(super) fn png(&self, svg: &str) -> Result<Vec<u8>, String> {
        let pixels = pixels(&self.tree(svg)?, PNG_SCALE as f32)?;
        pixels.encode_png().map_err(|error| error.to_string())
    }

    /// The PNG of an SVG for a paper, which states its size in print.
    pub(super) fn printed(&self, svg: &str) -> Result<Vec<u8>, String> {
        const INCH: f32 = 0.0254;
        let pixels = pixels(&self.tree(svg)?, PRINTED / PER_INCH)?;
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, pixels.width(), pixels.height());
        encoder.set_color(png::ColorType::Rgba);
        let per_metre = (PRINTED / INCH).round() as u32;
        encoder.set_pixel_dims(Some(png::PixelDimensions {
            xppu: per_metre,
            yppu: per_metre,
            unit: png::Unit::Meter,
        }));
        // The sheet is opaque: what is multiplied by the opacity is as it was.
        let written = encoder.write_header().and_then(|mut writer| {
            writer.write_image_data(pixels.data())?;
            writer.finish()
        });
        written.map_err(|error| error.to_string())?;
        Ok(bytes)
    }
}

/// A picture with `scale` pixels per pixel of its SVG.
fn pixels(tree: &usvg::Tree, scale: f32) -> Result<tiny_skia::Pixmap, String> {
    let side = |length: f32| (length * scale).ceil() as u32;
    let (width, height) = (side(tree.size().width()), side(tree.size().height()));
    let mut pixels = tiny_skia::Pixmap::new(width, height)
        .ok_or_else(|| format!("a picture of {width} x {height} pixels is not possible"))?;
    let scale = tiny_skia::Transform::from_scale(scale, scale);
    resvg::render(tree, scale, &mut pixels.as_mut());
    Ok(pixels)
}

#[cfg(test)]
mod tests {
    use super::super::legend::{self, Entry, Mark};
    use super::super::style::symbol;
    use super::*;

    fn page() -> Page {
        Page {
            width: 100.0,
            ..Page::screen()
        }
    }

    /// A subscript is smaller than the letters of its line and stands lower, and the line continues at its own height.
    #[test]
    fn subscripts_stand_lower() {
        let drawn = svg(&page(), 20.0, |area| {
            let text = format!("{} N, {}", symbol("μ", 's'), symbol("μ", 'd'));
            legend::draw(area, &[Entry::new(Mark::Dot(PAPER), text)])
        })
        .expect("a drawing");
        let document = roxmltree::Document::parse(&drawn).expect("well-formed XML");
        let nodes = document.descendants().filter(|node| node.is_text());
        let whole: String = nodes.filter_map(|node| node.text()).collect();
        assert_eq!(whole.trim(), "μs N, μd");
        let lowest = |text: String| {
            let svg = svg(&page(), 20.0, |area| {
                legend::draw(area, &[Entry::new(Mark::Dot(PAPER), text)])
            });
            let png = Rasterizer::new()
                .png(&svg.expect("a drawing"))
                .expect("a PNG");
            let png = tiny_skia::Pixmap::decode_png(&png).expect("a PNG");
            let dark = png.pixels().iter().rposition(|pixel| pixel.red() < 128);
            dark.expect("a letter") / png.width() as usize
        };
        let (line, lowered) = (lowest("Fx".to_owned()), lowest(symbol("F", 'x')));
        assert!(lowered > line, "{lowered} {line}");
    }
}
