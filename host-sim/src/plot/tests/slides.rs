//! Slides in a picture over time.

use super::*;

#[test]
fn slides_are_bars_and_no_notes() {
    let mut run = drag(2000);
    let without = texts(&forces::svg(&run, &Page::screen()).expect("a picture"));
    assert!(!without.iter().any(|text| text.starts_with("slide")));
    for frame in &mut run.frames[500..1500] {
        frame.contacts[0].sliding = -1;
    }
    run.frames[500].events = vec![Event::Slide];
    run.frames[1500].events = vec![Event::Stop];
    let svg = forces::svg(&run, &Page::screen()).expect("a picture");
    let texts = texts(&svg);
    for entry in ["slide", "slides: 0.5 s"] {
        assert!(texts.iter().any(|text| text == entry), "{texts:?}");
    }
    assert!(!texts.iter().any(|text| text.contains("stop,")));
    // One bar, over half of the time axis.
    let document = Document::parse(&svg).expect("well-formed XML");
    let bars = document.descendants().filter(|node| {
        node.has_tag_name("rect")
            && node.attribute("fill") == Some("#943E6C")
            && node.attribute("height") == Some(&sheet::px(9.0).to_string())
    });
    let widths: Vec<f64> = bars
        .filter_map(|bar| bar.attribute("width")?.parse().ok())
        .collect();
    let half = f64::from(sheet::px(0.5 * Page::screen().inner()));
    assert!(
        widths.len() == 1 && (widths[0] - half).abs() < 0.01 * half,
        "{widths:?}"
    );
}
