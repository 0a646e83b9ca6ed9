//! The pictures of an invented run: a box that is dragged over the floor by stick-slip, against a wall, and released.

use super::legend::{Entry, Mark};
use super::series::{envelope, outline, sparse};
use super::sheet::PNG_SCALE;
use super::*;
use resvg::tiny_skia::Pixmap;
use resvg::usvg::roxmltree::Document;
use stiction_core::{Event, Evolution, StateKind, Status, Touch};
use stiction_live::number::Number;
use stiction_live::record::{ContactRecord, Frame};
use stiction_live::scenes;
use stiction_scene::{Source, WrittenScene};

mod figure;
mod slides;

/// The maximum size of an SVG [bytes].
const LARGEST_SVG: u64 = 1_000_000;

/// A drag of one second in `count` frames: a saw-tooth of 20 slips that ends at the wall.
fn drag(count: usize) -> Run {
    let frame = |index: usize| {
        let t = index as f64 / count as f64;
        let phase = (20.0 * t).fract();
        let slipped = index > 0 && phase < (20.0 * (t - 1.0 / count as f64)).fract();
        let x = 0.01 * (20.0 * t).floor();
        let (normal, friction) = (10.0, -3.0 - 2.0 * phase);
        let contact = |vertex, x| ContactRecord {
            touch: Touch::Surface { vertex, surface: 0 },
            direction: [0.0, 1.0],
            point: [x, 0.0],
            normal: 0.5 * normal,
            friction: 0.5 * friction,
            sliding: 0,
        };
        Frame {
            t,
            hand: [x - friction / 500.0, 0.05 - normal / 500.0, 0.1 * t],
            held: t < 0.95,
            pose: [x, 0.03, 0.0],
            depth: 0.0,
            state: if t < 0.1 {
                StateKind::NonContact
            } else {
                StateKind::Edge
            },
            contacts: vec![contact(0, x - 0.05), contact(1, x + 0.05)],
            wrench: [-friction, -normal, 0.5 * 0.1 * t],
            slips: u32::from(slipped),
            longest_slip: if slipped { 0.01 } else { 0.0 },
            events: if slipped {
                vec![Event::Slip, Event::Tip]
            } else {
                Vec::new()
            },
            status: if t > 0.9 {
                Status::Ambiguous
            } else {
                Status::Ok
            },
            behind: None,
        }
    };
    let corner = scenes::find(Path::new("corner-stick-slip")).expect("a bundled scene");
    let source = Source::new("drag <&> stop.toml", corner.text());
    let scene = WrittenScene::parse(source, f64::MAX).expect("a scene");
    Run {
        frames: (0..count).map(frame).collect(),
        ..Run::of(&scene, Number::F32, Evolution::Path)
    }
}

/// The texts of an SVG, which must be well-formed.
fn texts(svg: &str) -> Vec<String> {
    let document = Document::parse(svg).expect("well-formed XML");
    let texts = document
        .descendants()
        .filter(|node| node.has_tag_name("text"));
    let whole = |node: roxmltree::Node<'_, '_>| -> String {
        let parts = node.descendants().filter(|node| node.is_text());
        parts.filter_map(|node| node.text()).collect()
    };
    texts.map(|node| whole(node).trim().to_owned()).collect()
}

#[test]
fn every_picture_is_written_as_svg_and_png() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = write(&drag(2000), &folder.path().join("new/plots")).expect("plots");
    let names: Vec<_> = files
        .iter()
        .filter_map(|file| file.file_name()?.to_str())
        .collect();
    assert_eq!(
        names,
        [
            "trajectory.svg",
            "trajectory.png",
            "forces.svg",
            "forces.png",
            "motion.svg",
            "motion.png",
            "strip.svg",
            "strip.png"
        ]
    );
    for pair in files.chunks(2) {
        let svg = fs::read_to_string(&pair[0]).expect("an SVG");
        let document = Document::parse(&svg).expect("well-formed XML");
        let side = |name| document.root_element().attribute(name)?.parse::<f64>().ok();
        let (width, height) = (
            side("width").expect("a width"),
            side("height").expect("a height"),
        );
        let png = Pixmap::load_png(&pair[1]).expect("a PNG");
        let pixels = |length: f64| length.ceil() as u32 * PNG_SCALE;
        assert_eq!((png.width(), png.height()), (pixels(width), pixels(height)));
    }
}

#[test]
fn pictures_name_what_they_show_with_units() {
    let run = drag(2000);
    let expected: [(&str, &[&str]); 4] = [
        (
            "trajectory",
            &[
                "hand, holding",
                "holding point",
                "body at end",
                "x [mm]",
                "y [mm]",
            ],
        ),
        (
            "forces",
            &[
                "normal N",
                "friction T",
                "static limit ±μs N",
                "slip end ±μd N",
                "floor [N]",
                "slip [mm]",
                "time t [s]",
            ],
        ),
        (
            "motion",
            &[
                "hand",
                "hand, open",
                "vertices in contact",
                "angle [°]",
                "x [mm]",
                "time t [s]",
            ],
        ),
        (
            "strip",
            &[
                "normal force",
                "friction",
                "hand and spring",
                "20 mm",
                "10 N",
            ],
        ),
    ];
    for ((name, picture), (same, entries)) in PICTURES.into_iter().zip(expected) {
        assert_eq!(name, same);
        let texts = texts(&picture(&run, &Page::screen()).expect("a picture"));
        for entry in entries {
            assert!(
                texts.iter().any(|text| text == entry),
                "{name} lacks {entry}: {texts:?}"
            );
        }
        assert!(
            texts[0].starts_with("drag <&> stop: "),
            "{name} is called {}",
            texts[0]
        );
    }
}

#[test]
fn pictures_over_time_show_the_states_that_occur_and_limited_answers() {
    let texts = texts(&forces::svg(&drag(2000), &Page::screen()).expect("a picture"));
    for state in StateKind::ALL {
        let occurs = matches!(state, StateKind::NonContact | StateKind::Edge);
        assert_eq!(texts.iter().any(|text| text == state.name()), occurs);
    }
    assert!(texts.iter().any(|text| text.contains("ambiguous")));
    assert!(
        !texts.iter().any(|text| text == "wall [N]"),
        "the wall is not touched"
    );
}

#[test]
fn clock_time_counts_from_a_round_time() {
    let mut run = drag(200);
    for frame in &mut run.frames {
        frame.t += 1_305_031_098.6;
    }
    let texts = texts(&motion::svg(&run, &Page::screen()).expect("a picture"));
    assert!(
        texts.iter().any(|text| text == "time t − 1305031090 s [s]"),
        "{texts:?}"
    );
    assert!(texts.iter().any(|text| text == "9.1"), "{texts:?}");
}

#[test]
fn letters_need_no_font_of_the_machine() {
    let rasterizer = sheet::Rasterizer::new();
    let page = Page {
        width: 100.0,
        ..Page::screen()
    };
    let dark = |text: &str| {
        let entry = [Entry::new(Mark::Dot(style::PAPER), text)];
        let svg = sheet::svg(&page, 20.0, |area| legend::draw(area, &entry)).expect("a drawing");
        let png = Pixmap::decode_png(&rasterizer.png(&svg).expect("a PNG")).expect("a PNG");
        png.pixels()
            .iter()
            .filter(|pixel| pixel.red() < 128)
            .count()
    };
    assert_eq!(dark(""), 0);
    assert!(dark("μθφ±") > 100);
}

#[test]
fn a_long_run_stays_small() {
    let run = drag(200_000);
    for (name, picture) in PICTURES {
        let size = picture(&run, &Page::screen()).expect("a picture").len() as u64;
        assert!(size < LARGEST_SVG, "{name}: {size} bytes");
    }
}

#[test]
fn thinning_keeps_spikes_ends_and_gaps() {
    let times: Vec<f64> = (0..10_000).map(f64::from).collect();
    let mut values = vec![0.0; times.len()];
    values[1234] = 5.0;
    values[1235] = -7.0;
    values[5000..5300].fill(f64::NAN);
    let lines = envelope(&times, &values, 100);
    assert_eq!(lines.len(), 2);
    assert!(lines.iter().map(Vec::len).sum::<usize>() <= 404);
    assert!(lines[0].contains(&(1234.0, 5.0)) && lines[0].contains(&(1235.0, -7.0)));
    assert_eq!(lines[1].last(), Some(&(9999.0, 0.0)));
    assert!(outline(&times, &values, 100)[0].contains(&(1235.0, -7.0)));
}

#[test]
fn a_thinned_path_keeps_its_ends() {
    let circle = |index: u32| f64::from(index).to_radians().sin_cos();
    let path: Vec<_> = (0..100_000).map(circle).collect();
    let chosen = sparse(&path, 0.001, 500);
    assert!(chosen.len() <= 501);
    assert_eq!((chosen.first(), chosen.last()), (path.first(), path.last()));
}

#[test]
fn snapshots_show_the_ends_and_every_state() {
    let run = drag(2000);
    let chosen = instants::choose(&run, 8);
    let ends = (chosen.first(), chosen.last());
    assert_eq!(ends, (Some(&0), Some(&1999)));
    assert!((4..=8).contains(&chosen.len()), "{chosen:?}");
    assert!(chosen.is_sorted());
    for state in [StateKind::NonContact, StateKind::Edge] {
        assert!(chosen.iter().any(|&index| run.frames[index].state == state));
    }
}

#[test]
fn a_single_frame_a_point_body_and_no_surface_are_drawn() {
    let mut run = drag(1);
    run.scene.vertices.truncate(1);
    run.scene.surfaces.clear();
    run.frames[0].contacts.clear();
    for (name, picture) in PICTURES {
        assert!(
            !texts(&picture(&run, &Page::screen()).expect("a picture")).is_empty(),
            "{name}"
        );
    }
}

#[test]
fn a_picture_is_replaced_as_a_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let (file, link) = (folder.path().join("forces.svg"), folder.path().join("link"));
    fs::write(&file, "before").expect("a file");
    fs::hard_link(&file, &link).expect("a second name");
    write(&drag(10), folder.path()).expect("plots");
    assert_eq!(fs::read_to_string(&link).expect("the old one"), "before");
    let names = fs::read_dir(folder.path()).expect("the folder");
    assert_eq!(names.count(), 9, "eight pictures and the link");
}

#[test]
fn errors_name_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("taken");
    fs::write(&file, "").expect("a file");
    let error = write(&drag(10), &file)
        .expect_err("not a directory")
        .to_string();
    assert!(
        error.starts_with("cannot create the plot directory") && error.contains("taken"),
        "{error}"
    );
    fs::create_dir(folder.path().join("trajectory.svg")).expect("a directory");
    let error = write(&drag(10), folder.path())
        .expect_err("not a file")
        .to_string();
    assert!(
        error.starts_with("cannot write the plot") && error.contains("trajectory.svg"),
        "{error}"
    );
    assert!(matches!(
        write(&drag(0), folder.path()),
        Err(PlotError::Empty)
    ));
}
