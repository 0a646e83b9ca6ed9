//! Writes the moving picture of the README: the run of a bundled scene as an SVG that plays by itself, in a browser and on a web
//! page. Its pictures are frames of the run, 40 a second: body, hand, spring and the reactions of the contacts, to scale.
//!
//! ```sh
//! cargo run --release -p stiction-host-sim --example animation
//! ```

use std::error::Error;
use std::fs;
use std::path::Path;

use stiction_core::Evolution;
use stiction_host_sim::firmware::workspace;
use stiction_live::drawing::{Point, Window, corners_of, placed};
use stiction_live::input::open_path;
use stiction_live::number::Number;
use stiction_live::record::{ContactRecord, Frame};
use stiction_live::scenes;
use stiction_live::session::Session;
use stiction_scene::SceneFile;

const SCENE: &str = "table-edge";
const TITLE: &str = "A box is pushed over the edge of a table by a hand and its spring: it sticks, slips, tips about the corner";
/// Pictures a second: a slip, which takes no time, takes one of them.
const RATE: f64 = 40.0;
/// The last picture before it begins again (s).
const REST: f64 = 1.0;
/// Width of the picture (pixels).
const WIDTH: f64 = 760.0;
/// Room around all that moves (m).
const MARGIN: f64 = 0.025;
/// Length of an arrow (m/N).
const FORCE: f64 = 0.004;
/// So many contacts have arrows.
const CONTACTS: usize = 2;
/// The colours of the plots.
const NORMAL: &str = "#009e73";
const FRICTION: &str = "#d55e00";
const HAND: &str = "#e69f00";
const BODY: &str = "#0072b2";

/// Two points in pixels.
type Line = [Point; 2];

fn main() -> Result<(), Box<dyn Error>> {
    let source = scenes::find(Path::new(SCENE)).ok_or("there is no such scene")?;
    let scene = SceneFile::parse(source, Number::F32.limit())?;
    let mut session = Session::new(&scene, Number::F32, Evolution::Path, u32::MAX)?;
    let (path, rate) = open_path(&scene, None, None)?;
    let frames: Vec<Frame> = path
        .frames(rate)
        .map(|sample| session.step(&sample))
        .collect();
    let every = (1.0 / (RATE * (frames[1].t - frames[0].t))).round() as usize;
    let shown: Vec<Frame> = frames
        .iter()
        .step_by(every)
        .chain(frames.last())
        .cloned()
        .collect();
    let text = Animation::of(&scene, &shown).svg(&shown);
    fs::write(workspace().join("host-sim/animation.svg"), text)?;
    Ok(())
}

/// A scene and its mapping to the picture, and the times of all that moves.
struct Animation<'a> {
    scene: &'a SceneFile,
    window: Window,
    /// Pixels per metre.
    scale: f64,
    seconds: f64,
    times: String,
}

impl<'a> Animation<'a> {
    fn of(scene: &'a SceneFile, frames: &[Frame]) -> Self {
        let bodies = frames
            .iter()
            .flat_map(|frame| placed(&scene.vertices, frame.pose));
        let seen = Window::around(bodies.chain(frames.iter().map(hand)));
        let Window { x, y } = seen.unwrap_or(Window::centred((0.0, 0.0), 1.0, 1.0));
        let window = Window {
            x: x.start - MARGIN..x.end + MARGIN,
            y: y.start - MARGIN..y.end + MARGIN,
        };
        let seconds = frames.last().map_or(0.0, |frame| frame.t) + REST;
        let times = frames.iter().map(|frame| frame.t).chain([seconds]);
        let times: Vec<String> = times.map(|t| format!("{:.4}", t / seconds)).collect();
        Self {
            scene,
            scale: WIDTH / window.width(),
            window,
            seconds,
            times: times.join(";"),
        }
    }

    fn height(&self) -> f64 {
        (self.window.height() * self.scale).round()
    }

    /// A point in pixels.
    fn at(&self, (x, y): Point) -> Point {
        let Window { x: xs, y: ys } = &self.window;
        ((x - xs.start) * self.scale, (ys.end - y) * self.scale)
    }

    /// One attribute over time; `more`: the kind of a transformation, or how values follow each other.
    fn moving(&self, tag: &str, attribute: &str, more: &str, mut values: Vec<String>) -> String {
        values.extend(values.last().cloned());
        if values.iter().all(|value| *value == values[0]) {
            return String::new();
        }
        let (seconds, times, values) = (self.seconds, &self.times, values.join(";"));
        format!(
            "<{tag} attributeName=\"{attribute}\" {more}dur=\"{seconds:.3}s\" repeatCount=\"indefinite\" keyTimes=\"{times}\" \
             values=\"{values}\"/>"
        )
    }

    fn line(&self, lines: &[Line], style: &str) -> String {
        let coordinate = |pick: fn(&Line) -> f64| -> Vec<String> {
            lines
                .iter()
                .map(|line| format!("{:.1}", pick(line)))
                .collect()
        };
        let ends = [
            ("x1", coordinate(|line| line[0].0)),
            ("y1", coordinate(|line| line[0].1)),
            ("x2", coordinate(|line| line[1].0)),
            ("y2", coordinate(|line| line[1].1)),
        ];
        let begin: Vec<String> = ends
            .iter()
            .map(|(name, values)| format!("{name}=\"{}\"", values[0]))
            .collect();
        let moves = ends
            .into_iter()
            .map(|(name, values)| self.moving("animate", name, "", values));
        format!(
            "<line {} {style}>{}</line>",
            begin.join(" "),
            moves.collect::<String>()
        )
    }

    /// An element that is there in some pictures.
    fn shown(&self, present: impl Iterator<Item = bool>, element: &str) -> String {
        let values: Vec<String> = present
            .map(|is_there| u8::from(is_there).to_string())
            .collect();
        let first = values[0].clone();
        let changes = self.moving("animate", "opacity", "calcMode=\"discrete\" ", values);
        format!("<g opacity=\"{first}\">{changes}{element}</g>")
    }

    fn ground(&self) -> String {
        let polygon = |corners: Vec<Point>| {
            let points = corners.into_iter().map(|corner| self.at(corner));
            let points: Vec<String> = points.map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
            format!(
                "<polygon class=\"ground\" points=\"{}\"/>",
                points.join(" ")
            )
        };
        self.scene
            .obstacles
            .iter()
            .map(|obstacle| polygon(corners_of(obstacle)))
            .collect()
    }

    /// The reactions of contact `k`: N along the normal or T along the surface, at the foot.
    fn reaction(&self, frames: &[Frame], k: usize, color: &str) -> String {
        let line = |frame: &Frame| match frame.contacts.get(k) {
            // Where the body is, without a length.
            None => [self.at((frame.pose[0], frame.pose[1])); 2],
            Some(contact) => {
                let (x, y) = along(contact, self.scene, color);
                let foot = (contact.point[0], contact.point[1]);
                [foot, (foot.0 + FORCE * x, foot.1 + FORCE * y)].map(|point| self.at(point))
            }
        };
        let lines: Vec<Line> = frames.iter().map(line).collect();
        let style = format!("stroke=\"{color}\" stroke-width=\"6\" stroke-linecap=\"round\"");
        let present = frames.iter().map(|frame| k < frame.contacts.len());
        self.shown(present, &self.line(&lines, &style))
    }

    fn svg(&self, frames: &[Frame]) -> String {
        let (scale, height) = (self.scale, self.height());
        let [gx, gy] = self.scene.holding_point.unwrap_or_default();
        let moves: Vec<String> = (frames.iter())
            .map(|frame| self.at((frame.pose[0], frame.pose[1])))
            .map(|(x, y)| format!("{x:.1} {y:.1}"))
            .collect();
        let turns: Vec<String> = frames
            .iter()
            .map(|frame| format!("{:.2}", -frame.pose[2].to_degrees()))
            .collect();
        // The body in its own frame, upwards as the picture has it.
        let outline: Vec<String> = (self.scene.vertices.iter())
            .map(|[x, y]| format!("{:.1},{:.1}", x * scale, -y * scale))
            .collect();
        let held = |frame: &Frame| placed(&[[gx, gy]], frame.pose)[0];
        let springs: Vec<Line> = frames
            .iter()
            .map(|frame| [held(frame), hand(frame)].map(|point| self.at(point)))
            .collect();
        let hands: Vec<Point> = frames.iter().map(|frame| self.at(hand(frame))).collect();
        let mut states: Vec<&str> = frames.iter().map(|frame| frame.state.name()).collect();
        states.sort_unstable();
        states.dedup();
        let label = |state: &&str| {
            let text = format!("<text x=\"16\" y=\"30\">{state}</text>");
            self.shown(
                frames.iter().map(|frame| frame.state.name() == *state),
                &text,
            )
        };
        let contacts = (0..CONTACTS)
            .flat_map(|k| [NORMAL, FRICTION].map(|color| self.reaction(frames, k, color)));
        let of_hands = |pick: fn(&Point) -> f64| {
            hands
                .iter()
                .map(|hand| format!("{:.1}", pick(hand)))
                .collect()
        };
        [
            format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" height=\"{height}\" role=\"img\">\n<title>{TITLE}</title>\n"),
            "<style>text{font:18px sans-serif;fill:#333}.ground{fill:#ecebe7;stroke:#333;stroke-width:1.5}</style>\n".to_owned(),
            format!("<rect width=\"{WIDTH}\" height=\"{height}\" rx=\"8\" fill=\"#fff\"/>\n{}\n", self.ground()),
            format!("<g transform=\"translate({})\">{}\n", moves[0], self.moving("animateTransform", "transform", "type=\"translate\" ", moves.clone())),
            format!("<g transform=\"rotate({})\">{}\n", turns[0], self.moving("animateTransform", "transform", "type=\"rotate\" ", turns.clone())),
            format!("<polygon points=\"{}\" fill=\"{BODY}\" fill-opacity=\"0.18\" stroke=\"{BODY}\" stroke-width=\"2.5\"/>\n", outline.join(" ")),
            format!("<circle r=\"4\" fill=\"{BODY}\" cx=\"{:.1}\" cy=\"{:.1}\"/></g></g>\n", gx * scale, -gy * scale),
            contacts.collect::<String>() + "\n",
            self.line(&springs, &format!("stroke=\"{HAND}\" stroke-width=\"4\"")) + "\n",
            format!("<circle r=\"7\" fill=\"#fff\" stroke=\"{HAND}\" stroke-width=\"3.5\" cx=\"{:.1}\" cy=\"{:.1}\">", hands[0].0, hands[0].1),
            self.moving("animate", "cx", "", of_hands(|hand| hand.0)) + &self.moving("animate", "cy", "", of_hands(|hand| hand.1)) + "</circle>\n",
            states.iter().map(label).collect::<String>() + "\n",
            legend() + "\n</svg>\n",
        ]
        .concat()
    }
}

fn hand(frame: &Frame) -> Point {
    (frame.hand[0], frame.hand[1])
}

/// The force that has this color (N).
fn along(contact: &ContactRecord, scene: &SceneFile, color: &str) -> Point {
    let [nx, ny] = contact.normal_among(&scene.surfaces);
    match color == NORMAL {
        true => (contact.normal * nx, contact.normal * ny),
        false => (contact.friction * ny, -contact.friction * nx),
    }
}

/// What the colours are.
fn legend() -> String {
    let (mut text, mut x) = (String::new(), WIDTH as usize - 16);
    for (name, color) in [
        ("friction", FRICTION),
        ("normal force", NORMAL),
        ("hand and spring", HAND),
    ] {
        x -= 9 * name.len();
        text += &format!(
            "<text x=\"{x}\" y=\"30\">{name}</text><path d=\"M{} 24h18\" stroke=\"{color}\" stroke-width=\"5\"/>",
            x - 26
        );
        x -= 46;
    }
    text
}
