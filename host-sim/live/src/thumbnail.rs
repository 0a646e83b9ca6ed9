//! A small picture of a scene: makes an SVG of about 1 kB from a scene file, the same for the page's gallery and for the
//! command line. It shows the world, the body at the start as an outline, and body and hand halfway along the path.
//!
//! Lines have `currentColor`; fills use variables of the page's style sheet, each with a fallback colour.

use std::fmt::Write as _;

use stiction_core::Evolution;
use stiction_scene::{InputError, SceneFile, Source};

use crate::body::Setting;
use crate::drawing::{Point, Role, Shape, Solids, Window, placed};
use crate::free::Springs;
use crate::number::Number;
use crate::record::Frame;
use crate::stage::Stage;

/// Width and height of the picture, in its own units, which are pixels of a card.
const SIZE: [f64; 2] = [120.0, 72.0];
/// Margin between the visible objects and the border.
const MARGIN: f64 = 10.0;
const SPACING: f64 = 6.0;
/// Coordinates are clamped to this distance from the middle: anything beyond is out of sight, and the numbers stay short.
const FARTHEST: f64 = 9999.0;
/// Number of steps to the middle of the path. Events are found between frames, so the number does not matter, except for
/// corners of the path that the steps cut.
const STEPS: u16 = 200;

/// Returns the picture of a scene.
///
/// # Errors
/// The scene cannot be used, or its path cannot be read.
pub fn thumbnail(source: &Source) -> Result<String, InputError> {
    let scene = SceneFile::parse(source.clone(), Number::F64.limit())?;
    let stage = Stage::new(scene)?;
    let [start, middle] = moments(&stage).map_err(|problem| source.error(problem))?;
    Ok(Drawing::around(&stage.scene, &start, &middle).svg(&start, &middle))
}

/// Returns the body at the start and in the middle of the path.
fn moments(stage: &Stage) -> Result<[Frame; 2], String> {
    let setting = Setting {
        scene: stage.scene.clone(),
        number: Number::F64,
        evolution: Evolution::Path,
    };
    let mut body = setting.start(&stage.home)?;
    let start = body.frame(0.0);
    if let Some(path) = &stage.path
        && path.seconds() > 0.0
    {
        let rate = 2.0 * f64::from(STEPS) / path.seconds();
        let hands = (1..=usize::from(STEPS)).filter_map(|k| path.sample(k, rate));
        hands.for_each(|sample| body.step(&sample.hand));
    }
    Ok([start, body.frame(0.0)])
}

struct Drawing<'a> {
    scene: &'a SceneFile,
    holding: Option<Point>,
    window: Window,
    /// Picture units per metre.
    scale: f64,
}

impl<'a> Drawing<'a> {
    /// Fits the whole body and the hand into the picture.
    fn around(scene: &'a SceneFile, start: &Frame, middle: &Frame) -> Self {
        let holding = Springs::of(scene, middle).holding.map(Point::from);
        let bodies = [start, middle].map(|frame| placed(&scene.vertices, frame.pose));
        let points = bodies.into_iter().flatten();
        let points = points.chain([hand(middle)]).chain(holding);
        let seen = Window::around(points).unwrap_or(Window::centred((0.0, 0.0), 0.0, 0.0));
        let [width, height] = SIZE;
        let fits = (width - 2.0 * MARGIN) / seen.width();
        let scale = fits.min((height - 2.0 * MARGIN) / seen.height());
        // A point that nobody holds has no extent to fit.
        let scale = if scale.is_finite() { scale } else { 1.0 };
        Self {
            scene,
            holding,
            window: Window::centred(seen.centre(), width / scale, height / scale),
            scale,
        }
    }

    /// Returns the position of a world point in the picture.
    fn place(&self, (x, y): Point) -> [f64; 2] {
        let at = |distance: f64| number((self.scale * distance).clamp(-FARTHEST, FARTHEST));
        [at(x - self.window.x.start), at(self.window.y.end - y)]
    }

    /// Returns the points of a line in the syntax of an SVG path.
    fn line(&self, points: impl IntoIterator<Item = Point>) -> String {
        let places = points.into_iter().map(|point| {
            let [x, y] = self.place(point);
            format!("{x} {y}")
        });
        places.collect::<Vec<_>>().join("L")
    }

    fn svg(&self, start: &Frame, middle: &Frame) -> String {
        let [width, height] = SIZE;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" fill=\"none\" \
             stroke=\"currentColor\" stroke-width=\"1.5\" stroke-linejoin=\"round\" stroke-linecap=\"round\">"
        );
        self.solids(&mut svg);
        let body = |frame: &Frame| self.line(placed(&self.scene.vertices, frame.pose));
        if start.pose != middle.pose {
            let outline = body(start);
            let _ = write!(
                svg,
                "<path d=\"M{outline}Z\" opacity=\".45\" stroke-dasharray=\"2 3\"/>"
            );
        }
        let outline = body(middle);
        // A point is drawn only by the round caps of its line.
        let thick = match self.scene.vertices.len() {
            1 => 7,
            2 => 4,
            _ => 2,
        };
        let _ = write!(
            svg,
            "<path d=\"M{outline}Z\" fill=\"var(--body-fill,#0072b226)\" stroke=\"var(--body,#0072b2)\" \
             stroke-width=\"{thick}\"/>"
        );
        self.hand(&mut svg, middle);
        svg + "</svg>"
    }

    /// Draws the insides of obstacles, the hatches of surfaces, and all borders.
    fn solids(&self, svg: &mut String) {
        let solids = Solids {
            surfaces: &self.scene.surfaces,
            obstacles: &self.scene.obstacles,
            window: &self.window,
            pixel: 1.0 / self.scale,
            spacing: SPACING,
        };
        let path = |shapes: &[Shape], roles: &[Role]| -> String {
            let shown = shapes.iter().filter(|shape| roles.contains(&shape.role));
            let lines = shown.map(|shape| format!("M{}", self.line(shape.points.iter().copied())));
            lines.collect()
        };
        let mut draw = |path: String, style: &str| {
            if !path.is_empty() {
                let _ = write!(svg, "<path d=\"{path}\"{style}/>");
            }
        };
        draw(
            path(&solids.insides(), &[Role::Obstacle]),
            " fill=\"var(--solid,#e9e7e2)\" stroke=\"none\"",
        );
        let (surfaces, obstacles) = (solids.surface_borders(), solids.obstacle_borders());
        draw(
            path(&surfaces, &[Role::Hatch]),
            " stroke=\"var(--hatch,#8d8f8c)\" stroke-width=\".7\"",
        );
        let borders = path(&surfaces, &[Role::Border]);
        draw(
            borders + &path(&obstacles, &[Role::Border, Role::Wall, Role::Pin]),
            "",
        );
    }

    fn hand(&self, svg: &mut String, frame: &Frame) {
        if let Some(holding) = self.holding {
            // A point is held by a stick, without which the hand would be unconnected to it.
            let body = placed(&self.scene.vertices, frame.pose).into_iter();
            let stick = body.filter(|_| self.scene.vertices.len() == 1);
            let spring = self.line(stick.chain([holding, hand(frame)]));
            let _ = write!(svg, "<path d=\"M{spring}\"/>");
        }
        let [x, y] = self.place(hand(frame));
        let _ = write!(
            svg,
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"3\" fill=\"currentColor\"/>"
        );
    }
}

fn hand(frame: &Frame) -> Point {
    (frame.hand[0], frame.hand[1])
}

/// Returns a number with one decimal, or none if that is 0.
fn number(value: f64) -> f64 {
    // No negative zero.
    (10.0 * value).round() / 10.0 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes;

    /// Size limit of a gallery card (bytes), so that all of them together are smaller than the page.
    const LARGEST: usize = 2000;

    fn source(scene: &str) -> Source {
        Source::new("scene.toml", scene)
    }

    /// Returns the numbers in the path of the body.
    fn outline(svg: &str) -> Vec<f64> {
        let path = svg
            .split("<path d=\"M")
            .find(|part| part.contains("--body,"));
        let (path, _) = path.and_then(|part| part.split_once('Z')).expect("a body");
        let numbers = path.split([' ', 'L']);
        numbers.map(|n| n.parse().expect("a number")).collect()
    }

    #[test]
    fn every_bundled_scene_has_a_small_picture_with_the_body_in_sight() {
        for &(name, text) in scenes::ALL {
            let svg = thumbnail(&source(text)).expect(name);
            assert!(svg.len() <= LARGEST, "{name}: {} bytes", svg.len());
            for place in outline(&svg).chunks_exact(2) {
                assert!((0.0..=SIZE[0]).contains(&place[0]), "{name}: {svg}");
                assert!((0.0..=SIZE[1]).contains(&place[1]), "{name}: {svg}");
            }
            let has_surface = text.contains("\n[[surface]]");
            assert_eq!(svg.contains("--hatch"), has_surface, "{name}: {svg}");
        }
    }

    /// A box of 2 m × 1 m at rest on the floor without a hand's path: it is centred in the picture, apart from the hand, which
    /// is at the body's origin.
    #[test]
    fn a_box_at_rest_lies_flat_in_the_middle_and_on_its_floor() {
        let svg = thumbnail(&source(
            "[body]\nrectangle = [2.0, 1.0]\nstart = [5.0, 0.5, 0.0]\n[spring]\ntranslation = 500.0\nrotation = 0.5\n\
             [friction]\nstatic = 0.5\ndynamic = 0.3\n[[surface]]\nnormal = [0.0, 1.0]\noffset = 0.0\n",
        ));
        let svg = svg.expect("a scene");
        let corners = outline(&svg);
        // For 2 m: 120 units of width minus two margins of 10.
        assert_eq!(corners, [10.0, 61.0, 110.0, 61.0, 110.0, 11.0, 10.0, 11.0]);
        assert!(svg.contains("<path d=\"M0 61L120 61\"/>"), "{svg}");
    }

    #[test]
    fn what_is_wrong_with_a_scene_is_said_with_its_line() {
        let error = thumbnail(&source(
            "[body]\nrectangle = [2.0, -1.0]\nstart = [0.0, 0.0, 0.0]\n[spring]\ntranslation = 1.0\nrotation = 0.0\n",
        ));
        let error = error.expect_err("a negative height").to_string();
        assert!(error.contains("line 2"), "{error}");
    }
}
