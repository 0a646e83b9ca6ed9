//! Figures for a paper: the size of their type in print, their labels, and what they show.

use super::super::figure::{Figure, FigureFormat, FigurePicture, WIDTHS};
use super::super::style::{BODY, BODY_THEN, FRICTION, HAND};
use super::*;
use crate::figures::recorded;
use clap::ValueEnum;
use plotters::style::RGBColor;
use resvg::usvg::{Node, Paint, Rect, Text, Tree};

/// The type that is read without effort in print [pt].
const TYPE: std::ops::RangeInclusive<f32> = 7.0..=9.0;
/// Points per px of an SVG.
const POINTS: f32 = 0.75;

fn figure(picture: FigurePicture, width: f64) -> Figure {
    Figure {
        picture,
        width,
        title: None,
        at: Vec::new(),
        interval: None,
    }
}

fn tree(run: &Run, figure: &Figure) -> Tree {
    let svg = figure.bytes(run, FigureFormat::Svg).expect("a figure");
    let svg = String::from_utf8(svg).expect("text");
    sheet::Rasterizer::new().tree(&svg).expect("an SVG")
}

/// What is drawn, out of its groups.
fn marks(tree: &Tree) -> Vec<&Node> {
    fn collect<'a>(nodes: &'a [Node], marks: &mut Vec<&'a Node>) {
        for node in nodes {
            match node {
                Node::Group(group) => collect(group.children(), marks),
                Node::Text(_) | Node::Path(_) | Node::Image(_) => marks.push(node),
            }
        }
    }
    let mut marks = Vec::new();
    collect(tree.root().children(), &mut marks);
    marks
}

fn labels(tree: &Tree) -> Vec<&Text> {
    let labels = marks(tree).into_iter().filter_map(|mark| match mark {
        Node::Text(text) => Some(&**text),
        Node::Path(_) | Node::Image(_) | Node::Group(_) => None,
    });
    labels.collect()
}

fn written(label: &Text) -> String {
    label
        .chunks()
        .iter()
        .map(|chunk| chunk.text().trim())
        .collect()
}

/// The ink of a label.
fn ink(label: &Text) -> Rect {
    label.flattened().abs_bounding_box()
}

/// The sizes of a label's letters in print [pt].
fn sizes(label: &Text) -> impl Iterator<Item = f32> {
    let (scale, _) = label.abs_transform().get_scale();
    let glyphs = label
        .layouted()
        .iter()
        .flat_map(|span| &span.positioned_glyphs);
    glyphs.map(move |glyph| glyph.font_size() * scale * POINTS)
}

/// Of scenes with surfaces, with obstacles, with a peg; from the narrowest column to two of them.
#[test]
fn labels_have_7_to_9_points_and_do_not_overlap() {
    let scenes = [
        "vertex-stick-slip",
        "corner-stick-slip",
        "table-edge",
        "peg-in-hole",
        "locked",
    ];
    let mut count = 0;
    for scene in scenes {
        let run = recorded(scene).expect("a run");
        for picture in FigurePicture::value_variants() {
            if *picture == FigurePicture::Insertion && run.meter.is_none() {
                continue;
            }
            for width in [*WIDTHS.start(), 85.0, 120.0, 180.0] {
                let what = format!("{scene}, {picture:?}, {width} mm");
                let tree = tree(&run, &figure(*picture, width));
                let printed = f64::from(tree.size().width() * POINTS) * 25.4 / 72.0;
                assert!((printed - width).abs() < 0.01, "{what}: {printed} mm");
                let labels = labels(&tree);
                for (index, label) in labels.iter().enumerate() {
                    let name = written(label);
                    for size in sizes(label) {
                        assert!(TYPE.contains(&size), "{what}: {name:?} has {size} pt");
                        count += 1;
                    }
                    let room = ink(label);
                    let (right, bottom) = (tree.size().width(), tree.size().height());
                    let inside = room.left() >= 0.0 && room.top() >= 0.0;
                    let inside = inside && room.right() <= right && room.bottom() <= bottom;
                    assert!(inside, "{what}: {name:?} is cut off");
                    for other in &labels[..index] {
                        let apart = ink(other).intersect(&room).is_none();
                        assert!(apart, "{what}: {name:?} covers {:?}", written(other));
                    }
                }
            }
        }
    }
    assert!(count > 10_000, "{count} letters");
}

/// The straight lines and the bounds of the filled marks in one of these colors (px).
fn drawn(tree: &Tree, colors: &[RGBColor]) -> (Vec<[(f32, f32); 2]>, Vec<Rect>) {
    let is_one = |paint: &Paint| matches!(paint, Paint::Color(color) if colors.contains(&RGBColor(color.red, color.green, color.blue)));
    let (mut lines, mut bounds) = (Vec::new(), Vec::new());
    for mark in marks(tree) {
        let Node::Path(path) = mark else { continue };
        if path.stroke().is_some_and(|stroke| is_one(stroke.paint())) {
            let points: Vec<_> = path.data().points().iter().map(|p| (p.x, p.y)).collect();
            lines.extend(points.windows(2).map(|ends| [ends[0], ends[1]]));
        } else if path.stroke().is_none() && path.fill().is_some_and(|fill| is_one(fill.paint())) {
            bounds.push(path.abs_bounding_box());
        }
    }
    (lines, bounds)
}

/// In every scene with obstacles, also where posts stand close to each other and the hand passes a shank.
#[test]
fn names_of_obstacles_stand_under_no_path_no_body_and_no_other_name() {
    for scene in [
        "table-edge",
        "step",
        "peg-in-hole",
        "plank-on-posts",
        "hook",
    ] {
        let run = recorded(scene).expect("a run");
        for width in [85.0, 120.0, 180.0] {
            let what = format!("{scene}, {width} mm");
            let tree = tree(&run, &figure(FigurePicture::Trajectory, width));
            let (lines, bounds) = drawn(&tree, &[HAND, BODY, BODY_THEN, FRICTION]);
            let labels = labels(&tree);
            for obstacle in &run.scene.obstacles {
                let is_name = |label: &&&Text| written(label) == obstacle.name;
                let name = labels.iter().find(is_name);
                let room = ink(name.unwrap_or_else(|| panic!("{what}: no {:?}", obstacle.name)));
                let is_in = |x: f32, y: f32| {
                    (room.left()..=room.right()).contains(&x)
                        && (room.top()..=room.bottom()).contains(&y)
                };
                for [from, to] in &lines {
                    let steps = (to.0 - from.0).hypot(to.1 - from.1).ceil() as i32 + 1;
                    let crossed = (0..=steps).map(|k| k as f32 / steps as f32);
                    let mut crossed = crossed
                        .map(|s| (from.0 + s * (to.0 - from.0), from.1 + s * (to.1 - from.1)));
                    let crossed = crossed.any(|(x, y)| is_in(x, y));
                    assert!(!crossed, "{what}: a line covers {:?}", obstacle.name);
                }
                let free = bounds.iter().all(|mark| mark.intersect(&room).is_none());
                assert!(free, "{what}: a mark covers {:?}", obstacle.name);
                let others = labels.iter().filter(|label| !is_name(label));
                for other in others {
                    let apart = ink(other).intersect(&room).is_none();
                    assert!(
                        apart,
                        "{what}: {:?} covers {:?}",
                        written(other),
                        obstacle.name
                    );
                }
            }
        }
    }
}

#[test]
fn a_figure_has_the_title_that_was_asked_for_and_no_other() {
    let run = drag(2000);
    let title = "A box that sticks and slips on the floor until it comes to the wall";
    for picture in [FigurePicture::Trajectory, FigurePicture::Strip] {
        let mut figure = figure(picture, 85.0);
        let all = |figure: &Figure| {
            let tree = tree(&run, figure);
            let labels = labels(&tree).into_iter().map(written);
            labels.collect::<Vec<_>>().join(" ")
        };
        assert!(!all(&figure).contains("drag"));
        figure.title = Some(title.to_owned());
        assert!(all(&figure).starts_with(title), "{}", all(&figure));
    }
}

#[test]
fn an_interval_and_instants_choose_what_is_shown() {
    let run = drag(2000);
    let mut figure = figure(FigurePicture::Forces, 85.0);
    figure.interval = Some([0.21, 0.49]);
    let shown = |figure: &Figure| -> Vec<String> {
        labels(&tree(&run, figure))
            .into_iter()
            .map(written)
            .collect()
    };
    let texts = shown(&figure);
    let states = StateKind::ALL.map(StateKind::name);
    let states: Vec<_> = texts
        .iter()
        .filter(|text| states.contains(&text.as_str()))
        .collect();
    assert_eq!(states, ["edge"]);
    // 20 slips a second.
    assert!(
        texts.iter().any(|text| text.starts_with("slips: 5,")),
        "{texts:?}"
    );
    figure = Figure {
        picture: FigurePicture::Strip,
        at: vec![0.25, 0.7],
        interval: None,
        ..figure
    };
    let texts = shown(&figure);
    let captions: Vec<_> = texts
        .iter()
        .filter(|text| text.starts_with("t = "))
        .collect();
    assert_eq!(captions, ["t = 0.250 s: edge", "t = 0.700 s: edge"]);
}

/// The heads of arrows on the hand's path: tip and middle of the back (px).
fn heads(svg: &str) -> Vec<[(f64, f64); 2]> {
    let document = Document::parse(svg).expect("well-formed XML");
    let polygons = document
        .descendants()
        .filter(|node| node.has_tag_name("polygon") && node.attribute("fill") == Some("#000000"));
    let corners = |node: roxmltree::Node<'_, '_>| -> Vec<(f64, f64)> {
        let points = node.attribute("points").unwrap_or("").split_whitespace();
        let number = |text: &str| text.parse::<f64>().expect("a number");
        let pair = |point: &str| point.split_once(',').map(|(x, y)| (number(x), number(y)));
        points.filter_map(pair).collect()
    };
    let head = |corners: Vec<(f64, f64)>| {
        let [tip, a, b] = corners[..] else {
            panic!("{corners:?}")
        };
        [tip, (0.5 * (a.0 + b.0), 0.5 * (a.1 + b.1))]
    };
    polygons.map(corners).map(head).collect()
}

#[test]
fn heads_on_a_path_show_its_direction() {
    let mut run = drag(2000);
    let page = Page::paper(85.0, None);
    for sign in [1.0, -1.0] {
        let heads = heads(&trajectory::svg(&run, &page).expect("a picture"));
        assert!(!heads.is_empty());
        for [tip, back] in heads {
            let (along, across) = (sign * (tip.0 - back.0), (tip.1 - back.1).abs());
            assert!(along > 3.0 * across, "{tip:?} {back:?}");
        }
        run.frames.reverse();
    }
}

/// A body that moves in the first half of the run alone: a spread over time would show it at rest again and again.
#[test]
fn snapshots_differ() {
    let mut run = drag(2000);
    for frame in &mut run.frames {
        frame.held = true;
    }
    let rest = run.frames[999].clone();
    for frame in &mut run.frames[1000..] {
        *frame = Frame {
            t: frame.t,
            ..rest.clone()
        };
    }
    let chosen = instants::choose(&run, 8);
    let at_rest = chosen.iter().filter(|&&index| index >= 999);
    assert_eq!(at_rest.count(), 1, "{chosen:?}");
    assert!(chosen.len() >= 3, "{chosen:?}");
}
