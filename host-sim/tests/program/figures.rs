//! Figures for a paper: the figures of the one that the method is from, and the options of one's own.

use std::io::Read as _;

use flate2::read::ZlibDecoder;

use crate::common::{Folder, text};

/// What is between two marks, wherever it occurs.
fn between<'a>(bytes: &'a [u8], begin: &str, end: &str) -> Vec<&'a [u8]> {
    let find = |bytes: &[u8], mark: &str| {
        let windows = bytes.windows(mark.len());
        windows.into_iter().position(|part| part == mark.as_bytes())
    };
    let (mut rest, mut found) = (bytes, Vec::new());
    while let Some(start) = find(rest, begin) {
        rest = &rest[start + begin.len()..];
        let Some(length) = find(rest, end) else { break };
        found.push(&rest[..length]);
        rest = &rest[length..];
    }
    found
}

fn inflated(stream: &[u8]) -> Option<String> {
    let mut text = Vec::new();
    ZlibDecoder::new(stream).read_to_end(&mut text).ok()?;
    Some(String::from_utf8_lossy(&text).into_owned())
}

/// Width and height of the page, and the sizes of all letters, in points, as the operators of the page have them.
fn printed(pdf: &[u8]) -> ([f64; 2], Vec<f64>) {
    let number = |word: &str| word.parse::<f64>().expect("a number");
    let page = between(pdf, "/MediaBox [", "]");
    let page: Vec<f64> = String::from_utf8_lossy(page[0])
        .split_whitespace()
        .map(number)
        .collect();
    let streams = between(pdf, ">>\nstream\n", "\nendstream");
    let content = streams.into_iter().filter_map(inflated);
    let content = content
        .into_iter()
        .find(|text| text.contains(" Tf"))
        .expect("letters");
    let (mut font, mut sizes) = (0.0, Vec::new());
    for line in content.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            [_, size, "Tf"] => font = number(size),
            [a, b, _, _, _, _, "Tm"] => sizes.push(font * number(a).hypot(number(b))),
            _ => {}
        }
    }
    ([page[2], page[3]], sizes)
}

#[test]
fn one_command_draws_the_figures_of_the_paper() {
    let folder = Folder::new();
    let printed_names = folder.done("figures --paper paper");
    for number in 9..=14 {
        let name = format!("figure-{number:02}.pdf");
        assert!(printed_names.contains(&name), "{printed_names}");
        let pdf = std::fs::read(folder.file(format!("paper/{name}"))).expect("a figure");
        assert!(
            pdf.starts_with(b"%PDF-1.") && pdf.ends_with(b"%%EOF"),
            "{name}"
        );
        // A paper has no use for a font that it does not bring along.
        assert!(!between(&pdf, "/FontFile2 ", " ").is_empty(), "{name}");
        let ([width, height], sizes) = printed(&pdf);
        let millimetres = width / 72.0 * 25.4;
        assert!(
            (millimetres - 85.0).abs() < 0.01,
            "{name}: {millimetres} mm"
        );
        // A column of a paper is 240 mm high.
        assert!(height < 240.0 / 25.4 * 72.0, "{name}: {height} pt");
        assert!(sizes.len() > 50, "{name}: {} letters", sizes.len());
        for size in sizes {
            assert!((7.0..=9.0).contains(&size), "{name}: {size} pt");
        }
    }
}

/// The paper's words for Figure 13. The floor holds the box back, to the right, by almost mu_s N; and to the left it slips.
#[test]
fn figure_13_is_about_to_slip_to_the_left() {
    let folder = Folder::new();
    folder.done("run edge-about-to-slip --number f64 --out trace.jsonl");
    let trace = folder.read("trace.jsonl");
    let frames = trace
        .lines()
        .map(|line| serde_json::from_str(line).expect("a frame"));
    let frames: Vec<serde_json::Value> = frames.collect();
    let sum = |frame: &serde_json::Value, key: &str| -> f64 {
        let contacts = frame["contacts"].as_array().expect("contacts").iter();
        contacts
            .map(|contact| contact[key].as_f64().expect("a force"))
            .sum()
    };
    let before = &frames[1500];
    assert_eq!(before["state"], "edge");
    let share = sum(before, "friction") / (0.5 * sum(before, "normal"));
    assert!((share - 0.98).abs() < 1e-6, "{share}");
    let x = |frame: &serde_json::Value| frame["pose"][0].as_f64().expect("a place");
    // A slip of (mu_s - mu_d) 10 mm.
    let slip = x(&frames[2500]) - x(before);
    assert!((slip + 0.002).abs() < 1e-6, "{slip}");
}

#[test]
fn a_figure_is_one_file_in_the_format_of_its_name() {
    let folder = Folder::new();
    let words =
        folder.done("run ladder --plot new.pdf --width 3.5in --picture motion --title Ladder");
    assert!(
        words.contains("figure") && words.contains("new.pdf"),
        "{words}"
    );
    let pdf = std::fs::read(folder.file("new.pdf")).expect("a figure");
    let ([width, _], _) = printed(&pdf);
    assert!((width - 252.0).abs() < 0.01, "{width} pt");
    folder.done("run ladder --plot new.svg --picture strip --at 0.5,1.5 --quiet");
    let svg = folder.read("new.svg");
    assert!(svg.starts_with("<svg width=\"85mm\""), "{}", &svg[..80]);
    folder.done("run ladder --plot new.png --interval 0.5..1 --quiet");
    let png = std::fs::read(folder.file("new.png")).expect("a figure");
    // Width in the header: 85 mm at 600 pixels per inch, which the picture says of itself (23622 a metre).
    let width = u32::from_be_bytes(png[16..20].try_into().expect("four bytes"));
    assert!((2007..=2009).contains(&width), "{width}");
    assert!(!between(&png, "pHYs\0\0\x5c\x46", "I").is_empty());
    assert_eq!(folder.names(), ["new.pdf", "new.png", "new.svg"]);
}

/// What is typed, and what the message names.
const REFUSED: &[(&str, &[&str])] = &[
    (
        "run ladder --plot a.pdf --width 85",
        &["'85'", "--width", "from 70 to 420 mm", "mm, cm, in or pt"],
    ),
    (
        "run ladder --plot a.pdf --width 30mm",
        &["'30mm'", "from 70 to 420 mm"],
    ),
    (
        "run ladder --plot a.pdf --picture pose",
        &["'pose'", "trajectory, forces, motion, strip, insertion"],
    ),
    (
        "run ladder --plot a.pdf --picture insertion",
        &[
            "the scene has no peg and hole",
            "trajectory, forces, motion, strip",
        ],
    ),
    (
        "run ladder --plot a.pdf --at one",
        &["'one'", "--at", "times in s"],
    ),
    (
        "run ladder --plot a.pdf --at 100",
        &["--at: 100 s is not in the run", "from 0 to"],
    ),
    (
        "run ladder --plot a.pdf --at -1",
        &["--at: -1 s is not in the run"],
    ),
    (
        "run ladder --plot a.pdf --interval 2..1",
        &["'2..1'", "the earlier one first"],
    ),
    (
        "run ladder --plot a.pdf --interval 0..100",
        &["--interval: 100 s is not in the run"],
    ),
    (
        "run ladder --plot plots --width 85mm",
        &["--width", "--plot FILE.pdf, FILE.svg or FILE.png"],
    ),
    (
        "run ladder --interval 0..1",
        &["--interval", "--plot FILE.pdf"],
    ),
    ("figures", &["--paper <DIR>"]),
    (
        "figures --paper new --format gif",
        &["'gif'", "pdf, svg, png"],
    ),
];

#[test]
fn options_of_figures_that_cannot_be_used_are_explained() {
    let folder = Folder::new();
    for (typed, said) in REFUSED {
        let output = folder.stiction(typed);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{typed}: {message}");
        for part in *said {
            assert!(
                message.contains(part),
                "{typed}: {part:?} is missing: {message}"
            );
        }
    }
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}
