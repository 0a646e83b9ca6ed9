//! A picture as PDF of one page: lines and areas as they are, texts as text, in a subset of the font that is built into the program.
//! From an SVG that is laid out. It has what the pictures have: plain colors, dashes, opacity; no images, gradients or clips.

use std::collections::BTreeMap;
use std::io::{self, Write as _};

use flate2::Compression;
use flate2::write::ZlibEncoder;
use pdf_writer::types::{
    CidFontType, FontFlags, LineCapStyle, LineJoinStyle, SystemInfo, UnicodeCmap,
};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str};
use resvg::tiny_skia::{PathSegment, Point, Transform};
use resvg::usvg::{self, LineCap, LineJoin, Node, Paint};
use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, GlyphId, MetadataProvider};
use subsetter::{GlyphRemapper, subset};

/// Points per px of an SVG.
const POINTS: f32 = 0.75;
const FONT: Name<'_> = Name(b"F");
const FONT_NAME: Name<'_> = Name(b"STICTN+DejaVuSans");
const IDENTITY: SystemInfo<'_> = SystemInfo {
    registry: Str(b"Adobe"),
    ordering: Str(b"Identity"),
    supplement: 0,
};

const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const TYPE0: Ref = Ref::new(5);
const CID_FONT: Ref = Ref::new(6);
const DESCRIPTOR: Ref = Ref::new(7);
const FONT_FILE: Ref = Ref::new(8);
const TO_UNICODE: Ref = Ref::new(9);
const INFO: Ref = Ref::new(10);
/// The first of the states of opacity.
const OPACITIES: i32 = 11;

/// The PDF of a laid out SVG, whose size is that of the page.
pub(super) fn pdf(tree: &usvg::Tree) -> Result<Vec<u8>, String> {
    let [width, height] = [tree.size().width(), tree.size().height()].map(|side| side * POINTS);
    let mut drawing = Drawing {
        content: Content::new(),
        glyphs: GlyphRemapper::new(),
        texts: BTreeMap::new(),
        opacities: Vec::new(),
    };
    // PDF counts from the lower left corner.
    let page = Transform::from_row(POINTS, 0.0, 0.0, -POINTS, 0.0, height);
    drawing.group(tree.root(), page, 1.0);
    let error = |error: io::Error| error.to_string();

    let mut pdf = Pdf::new();
    pdf.catalog(CATALOG).pages(PAGES);
    pdf.pages(PAGES).kids([PAGE]).count(1);
    let producer = pdf_writer::TextStr(concat!("stiction ", env!("CARGO_PKG_VERSION")));
    pdf.document_info(INFO).producer(producer);
    let mut page = pdf.page(PAGE);
    page.media_box(Rect::new(0.0, 0.0, width, height));
    page.parent(PAGES);
    page.contents(CONTENT);
    let mut resources = page.resources();
    resources.fonts().pair(FONT, TYPE0);
    let mut states = resources.ext_g_states();
    for (index, _) in drawing.opacities.iter().enumerate() {
        states.pair(Name(opacity_name(index).as_bytes()), opacity_ref(index));
    }
    states.finish();
    resources.finish();
    page.finish();
    for (index, opacity) in drawing.opacities.iter().enumerate() {
        let mut state = pdf.ext_graphics(opacity_ref(index));
        state.non_stroking_alpha(*opacity).stroking_alpha(*opacity);
    }
    font(&mut pdf, &drawing.glyphs, &drawing.texts)?;
    let content = deflated(&drawing.content.finish()).map_err(error)?;
    pdf.stream(CONTENT, &content).filter(Filter::FlateDecode);
    Ok(pdf.finish())
}

fn opacity_name(index: usize) -> String {
    format!("O{index}")
}

fn opacity_ref(index: usize) -> Ref {
    Ref::new(OPACITIES + index as i32)
}

fn deflated(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    encoder.finish()
}

/// The page while it is drawn.
struct Drawing {
    content: Content,
    /// The glyphs of the subset, and the text of each.
    glyphs: GlyphRemapper,
    texts: BTreeMap<u16, String>,
    /// The opacities that occur.
    opacities: Vec<f32>,
}

impl Drawing {
    fn group(&mut self, group: &usvg::Group, page: Transform, opacity: f32) {
        let opacity = opacity * group.opacity().get();
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group, page, opacity),
                Node::Path(path) => self.path(path, page, opacity),
                Node::Text(text) => self.text(text, page, opacity),
                Node::Image(_) => {}
            }
        }
    }

    fn opacity(&mut self, opacity: f32) {
        if opacity >= 1.0 {
            return;
        }
        let known = self.opacities.iter().position(|known| *known == opacity);
        let index = known.unwrap_or_else(|| {
            self.opacities.push(opacity);
            self.opacities.len() - 1
        });
        let name = opacity_name(index);
        self.content.set_parameters(Name(name.as_bytes()));
    }

    fn path(&mut self, path: &usvg::Path, page: Transform, opacity: f32) {
        let to_page = page.pre_concat(path.abs_transform());
        if let Some(fill) = path.fill()
            && let Some([r, g, b]) = rgb(fill.paint())
        {
            self.content.save_state();
            self.opacity(opacity * fill.opacity().get());
            self.content.set_fill_rgb(r, g, b);
            self.segments(path, to_page);
            match fill.rule() {
                usvg::FillRule::NonZero => self.content.fill_nonzero(),
                usvg::FillRule::EvenOdd => self.content.fill_even_odd(),
            };
            self.content.restore_state();
        }
        if let Some(stroke) = path.stroke()
            && let Some([r, g, b]) = rgb(stroke.paint())
        {
            // The pictures are scaled alike in both directions.
            let (scale, _) = to_page.get_scale();
            self.content.save_state();
            self.opacity(opacity * stroke.opacity().get());
            self.content.set_stroke_rgb(r, g, b);
            self.content.set_line_width(stroke.width().get() * scale);
            self.content.set_line_cap(match stroke.linecap() {
                LineCap::Butt => LineCapStyle::ButtCap,
                LineCap::Round => LineCapStyle::RoundCap,
                LineCap::Square => LineCapStyle::ProjectingSquareCap,
            });
            self.content.set_line_join(match stroke.linejoin() {
                LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
                LineJoin::Round => LineJoinStyle::RoundJoin,
                LineJoin::Bevel => LineJoinStyle::BevelJoin,
            });
            if let Some(dashes) = stroke.dasharray() {
                let dashes = dashes.iter().map(|length| length * scale);
                self.content
                    .set_dash_pattern(dashes, stroke.dashoffset() * scale);
            }
            self.segments(path, to_page);
            self.content.stroke();
            self.content.restore_state();
        }
    }

    fn segments(&mut self, path: &usvg::Path, to_page: Transform) {
        let placed = |mut point: Point| {
            to_page.map_point(&mut point);
            (point.x, point.y)
        };
        let mut last = Point::zero();
        for segment in path.data().segments() {
            match segment {
                PathSegment::MoveTo(to) => {
                    let (x, y) = placed(to);
                    self.content.move_to(x, y);
                    last = to;
                }
                PathSegment::LineTo(to) => {
                    let (x, y) = placed(to);
                    self.content.line_to(x, y);
                    last = to;
                }
                PathSegment::QuadTo(control, to) => {
                    // The cubic of the same curve.
                    let toward = |end: Point| {
                        let part = |end: f32, control: f32| end + (control - end) * (2.0 / 3.0);
                        Point::from_xy(part(end.x, control.x), part(end.y, control.y))
                    };
                    self.cubic([toward(last), toward(to), to].map(placed));
                    last = to;
                }
                PathSegment::CubicTo(first, second, to) => {
                    self.cubic([first, second, to].map(placed));
                    last = to;
                }
                PathSegment::Close => {
                    self.content.close_path();
                }
            }
        }
    }

    fn cubic(&mut self, [first, second, to]: [(f32, f32); 3]) {
        self.content
            .cubic_to(first.0, first.1, second.0, second.1, to.0, to.1);
    }

    /// Each glyph where the layout has it: kerning and subscripts need nothing else.
    fn text(&mut self, text: &usvg::Text, page: Transform, opacity: f32) {
        let to_page = page.pre_concat(text.abs_transform());
        for span in text.layouted() {
            let Some(fill) = &span.fill else { continue };
            let Some([r, g, b]) = rgb(fill.paint()) else {
                continue;
            };
            self.content.save_state();
            self.opacity(opacity * fill.opacity().get());
            self.content.set_fill_rgb(r, g, b);
            self.content.begin_text();
            for glyph in &span.positioned_glyphs {
                let Ok(id) = u16::try_from(glyph.id.0) else {
                    continue;
                };
                let placed = to_page.pre_concat(glyph.outline_transform());
                // The transform takes units of the font to the page; the matrix takes its size in points.
                let size = glyph.font_size() * to_page.get_scale().0;
                let em = size / placed.get_scale().0;
                let [a, b, c, d] =
                    [placed.sx, placed.ky, placed.kx, placed.sy].map(|x| x * em / size);
                self.content.set_font(FONT, size);
                self.content
                    .set_text_matrix([a, b, c, d, placed.tx, placed.ty]);
                let id = self.glyphs.remap(id);
                self.content.show(Str(&id.to_be_bytes()));
                self.texts.entry(id).or_insert_with(|| glyph.text.clone());
            }
            self.content.end_text();
            self.content.restore_state();
        }
    }
}

fn rgb(paint: &Paint) -> Option<[f32; 3]> {
    match paint {
        Paint::Color(color) => {
            Some([color.red, color.green, color.blue].map(|part| f32::from(part) / 255.0))
        }
        Paint::LinearGradient(_) | Paint::RadialGradient(_) | Paint::Pattern(_) => None,
    }
}

/// The subset of the font, with widths and texts of its glyphs.
fn font(
    pdf: &mut Pdf,
    glyphs: &GlyphRemapper,
    texts: &BTreeMap<u16, String>,
) -> Result<(), String> {
    let data = dejavu::sans::regular();
    let face = FontRef::new(data).map_err(|cause| cause.to_string())?;
    // PDF counts in thousandths of the size.
    let (em, location) = (Size::new(1000.0), LocationRef::default());
    let (metrics, advances) = (face.metrics(em, location), face.glyph_metrics(em, location));
    let bounds = metrics.bounds.unwrap_or_default();
    let small = subset(data, 0, glyphs).map_err(|cause| cause.to_string())?;
    let file = deflated(&small).map_err(|cause| cause.to_string())?;
    pdf.type0_font(TYPE0)
        .base_font(FONT_NAME)
        .encoding_predefined(Name(b"Identity-H"))
        .descendant_font(CID_FONT)
        .to_unicode(TO_UNICODE);
    let widths = glyphs.remapped_gids().map(|id| {
        let id = GlyphId::from(id);
        advances.advance_width(id).unwrap_or(0.0)
    });
    let mut cid_font = pdf.cid_font(CID_FONT);
    cid_font
        .subtype(CidFontType::Type2)
        .base_font(FONT_NAME)
        .system_info(IDENTITY)
        .font_descriptor(DESCRIPTOR)
        .cid_to_gid_map_predefined(Name(b"Identity"));
    cid_font.widths().consecutive(0, widths);
    cid_font.finish();
    pdf.font_descriptor(DESCRIPTOR)
        .name(FONT_NAME)
        .flags(FontFlags::SYMBOLIC)
        .bbox(Rect::new(
            bounds.x_min,
            bounds.y_min,
            bounds.x_max,
            bounds.y_max,
        ))
        .italic_angle(0.0)
        .ascent(metrics.ascent)
        .descent(metrics.descent)
        .cap_height(metrics.cap_height.unwrap_or(metrics.ascent))
        // Unknown, by the format's definition.
        .stem_v(0.0)
        .font_file2(FONT_FILE);
    pdf.stream(FONT_FILE, &file)
        .filter(Filter::FlateDecode)
        .pair(Name(b"Length1"), small.len() as i32);
    let mut map = UnicodeCmap::new(Name(b"Custom"), IDENTITY);
    for (id, text) in texts {
        map.pair_with_multiple(*id, text.chars());
    }
    pdf.cmap(TO_UNICODE, &map.finish());
    Ok(())
}
