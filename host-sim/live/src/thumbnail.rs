//! A small picture of a scene: makes an SVG of about 1 kB from a scene file, the same for the page's gallery and for the
//! command line. It shows the world, the body at the start as an outline, and body and hand halfway along the path.
//!
//! Lines have `currentColor`; fills use variables of the page's style sheet, each with a fallback colour.

use std::fmt::Write as _;

use stiction_core::Evolution;
use stiction_scene::{InputError, SceneFile, Source};

use crate::body::Setting;
use crate::free::Springs;
use crate::number::Number;
use crate::record::Frame;
use crate::stage::Stage;

/// Width and height of the picture, in its own units, which are pixels of a card.
const SIZE: [f64; 2] = [120.0, 72.0];
/// Margin between the visible objects and the border.
const MARGIN: f64 = 10.0;
/// Half the length of a line that spans the picture wherever it is: more than the diagonal of the picture.
const REACH: f64 = 150.0;
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

/// A scene and its mapping to the picture.
struct Drawing<'a> {
    scene: &'a SceneFile,
    /// The holding point, if the hand holds.
    holding: Option<[f64; 2]>,
    /// The point in the middle of the picture (m).
    centre: [f64; 2],
    /// Picture units per metre.
    scale: f64,
}

impl<'a> Drawing<'a> {
    /// Fits the whole body and the hand into the picture.
    fn around(scene: &'a SceneFile, start: &Frame, middle: &Frame) -> Self {
        let holding = Springs::of(scene, middle).holding;
        let [x, y, _] = middle.hand;
        let seen = corners(scene, start)
            .chain(corners(scene, middle))
            .chain([[x, y]])
            .chain(holding);
        let mut least = [f64::INFINITY; 2];
        let mut most = [f64::NEG_INFINITY; 2];
        for point in seen {
            for axis in 0..2 {
                least[axis] = least[axis].min(point[axis]);
                most[axis] = most[axis].max(point[axis]);
            }
        }
        let fits = [0, 1].map(|axis| (SIZE[axis] - 2.0 * MARGIN) / (most[axis] - least[axis]));
        let scale = fits[0].min(fits[1]);
        Self {
            scene,
            holding,
            centre: [0, 1].map(|axis| f64::midpoint(least[axis], most[axis])),
            // A point that nobody holds has no extent to fit.
            scale: if scale.is_finite() { scale } else { 1.0 },
        }
    }

    /// Returns the position of a world point in the picture.
    fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let [dx, dy] = [0, 1].map(|axis| {
            let distance = self.scale * (point[axis] - self.centre[axis]);
            distance.clamp(-FARTHEST, FARTHEST)
        });
        [SIZE[0] / 2.0 + dx, SIZE[1] / 2.0 - dy]
    }

    /// Returns the points of a line in the syntax of an SVG path.
    fn line(&self, points: impl Iterator<Item = [f64; 2]>) -> String {
        let places = points.map(|point| {
            let [x, y] = self.place(point).map(number);
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
        self.obstacles(&mut svg);
        self.surfaces(&mut svg);
        if start.pose != middle.pose {
            let outline = self.line(corners(self.scene, start));
            let _ = write!(
                svg,
                "<path d=\"M{outline}Z\" opacity=\".45\" stroke-dasharray=\"2 3\"/>"
            );
        }
        let outline = self.line(corners(self.scene, middle));
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

    fn obstacles(&self, svg: &mut String) {
        for obstacle in &self.scene.obstacles {
            let outline = self.line(obstacle.vertices.iter().copied());
            let _ = write!(
                svg,
                "<path d=\"M{outline}Z\" fill=\"var(--solid,#e9e7e2)\"/>"
            );
        }
    }

    /// Draws the border of each surface with hatching on its solid side: one dashed line, as wide as the strokes are long, and
    /// slanted.
    fn surfaces(&self, svg: &mut String) {
        for surface in &self.scene.surfaces {
            let [nx, ny] = surface.normal;
            let [cx, cy] = self.centre;
            let away = nx * cx + ny * cy - surface.offset;
            let [x, y] = self.place([cx - away * nx, cy - away * ny]).map(number);
            let turn = number(nx.atan2(ny).to_degrees());
            let _ = write!(
                svg,
                "<g transform=\"translate({x} {y})rotate({turn})\"><path d=\"M-{REACH} 0H{REACH}\"/>\
                 <path d=\"M-{REACH} 4H{REACH}\" transform=\"skewX(-45)\" stroke=\"var(--hatch,#8d8f8c)\" \
                 stroke-width=\"7\" stroke-dasharray=\"1 5\" stroke-linecap=\"butt\"/></g>"
            );
        }
    }

    /// Draws the hand and its spring.
    fn hand(&self, svg: &mut String, frame: &Frame) {
        let [x, y, _] = frame.hand;
        if let Some(holding) = self.holding {
            // A point is held by a stick, without which the hand would be unconnected to it.
            let stick = corners(self.scene, frame).filter(|_| self.scene.vertices.len() == 1);
            let spring = self.line(stick.chain([holding, [x, y]]));
            let _ = write!(svg, "<path d=\"M{spring}\"/>");
        }
        let [x, y] = self.place([x, y]).map(number);
        let _ = write!(
            svg,
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"3\" fill=\"currentColor\"/>"
        );
    }
}

/// Returns the corners of the body in the world.
fn corners(scene: &SceneFile, frame: &Frame) -> impl Iterator<Item = [f64; 2]> {
    let [x, y, theta] = frame.pose;
    let (sin, cos) = theta.sin_cos();
    let corners = scene.vertices.iter();
    corners.map(move |[bx, by]| [x + cos * bx - sin * by, y + sin * bx + cos * by])
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
    use crate::simulate::OBSTACLES;

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
        let all = scenes::ALL.iter();
        for &(name, text) in all.filter(|scene| OBSTACLES || !scenes::has_obstacles(scene)) {
            let svg = thumbnail(&source(text)).expect(name);
            assert!(svg.len() <= LARGEST, "{name}: {} bytes", svg.len());
            for place in outline(&svg).chunks_exact(2) {
                assert!((0.0..=SIZE[0]).contains(&place[0]), "{name}: {svg}");
                assert!((0.0..=SIZE[1]).contains(&place[1]), "{name}: {svg}");
            }
            let surfaces = text.matches("\n[[surface]]").count();
            assert_eq!(svg.matches("stroke-dasharray=\"1 5\"").count(), surfaces);
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
        assert!(svg.contains("translate(60 61)rotate(0)"), "{svg}");
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
