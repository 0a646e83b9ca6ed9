//! The diagram of contact states as SVG, drawn from the transition table: a card for every state with the arms that stay in it,
//! and one arrow for all arms from one state to another. Lengths in px, y downwards.

mod arrow;
mod card;
mod words;

use arrow::{Arrow, Port, Side};
use card::{Card, draw_loop};
use std::fmt::{self, Write};
use std::path::PathBuf;
use stiction_core::StateKind::{self, Corner, Edge, Locked, NonContact, SingleVertex, TwoVertex};
use stiction_core::Transition;
use words::markup;

/// Width and height of the picture (px).
pub const SIZE: [f64; 2] = [1560.0, 1470.0];
const INK: &str = "#1d2b36";
const CLOSES: &str = "#15616d";
const OPENS: &str = "#a8461f";
const STAYS: &str = "#5b6470";
const FONT: &str = "'Helvetica Neue', Helvetica, Arial, 'Liberation Sans', sans-serif";

/// A rectangle: left, top, width, height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area(pub [f64; 4]);

impl Area {
    /// Around a centre.
    fn around([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Self {
        Self([x - width / 2.0, y - height / 2.0, width, height])
    }
    /// True if two rectangles overlap, one of them widened by `room`.
    #[must_use]
    pub fn meets(&self, other: &Self, room: f64) -> bool {
        let ([x, y, w, h], [u, v, a, b]) = (self.0, other.0);
        x - room < u + a && u - room < x + w && y - room < v + b && v - room < y + h
    }
}

/// The arrows in both directions between two states, the first of them towards more contacts: where they leave the cards (the
/// side, and the position along it), how far they bulge, and half the distance between them.
const WAYS: [(StateKind, StateKind, [Port; 2], [f64; 2]); 12] = [
    (
        NonContact,
        Edge,
        [Port(Side::Right, 0.1), Port(Side::Left, 0.5)],
        [170.0, 9.0],
    ),
    (
        NonContact,
        SingleVertex,
        [Port(Side::Right, 0.36), Port(Side::Left, 0.5)],
        [130.0, 9.0],
    ),
    (
        NonContact,
        TwoVertex,
        [Port(Side::Right, 0.64), Port(Side::Left, 0.5)],
        [130.0, 9.0],
    ),
    (
        NonContact,
        Corner,
        [Port(Side::Right, 0.9), Port(Side::Left, 0.5)],
        [170.0, 9.0],
    ),
    (
        NonContact,
        Locked,
        [Port(Side::Top, 0.4), Port(Side::Top, 0.6)],
        [740.0, 9.0],
    ),
    (
        SingleVertex,
        Edge,
        [Port(Side::Top, 0.5), Port(Side::Bottom, 0.5)],
        [40.0, 80.0],
    ),
    (
        SingleVertex,
        TwoVertex,
        [Port(Side::Bottom, 0.5), Port(Side::Top, 0.5)],
        [40.0, 80.0],
    ),
    (
        SingleVertex,
        Corner,
        [Port(Side::Right, 0.85), Port(Side::Right, 0.25)],
        [160.0, 9.0],
    ),
    (
        Edge,
        Locked,
        [Port(Side::Right, 0.5), Port(Side::Left, 0.1)],
        [170.0, 9.0],
    ),
    (
        SingleVertex,
        Locked,
        [Port(Side::Right, 0.4), Port(Side::Left, 0.36)],
        [130.0, 9.0],
    ),
    (
        TwoVertex,
        Locked,
        [Port(Side::Right, 0.5), Port(Side::Left, 0.64)],
        [130.0, 9.0],
    ),
    (
        Corner,
        Locked,
        [Port(Side::Right, 0.75), Port(Side::Left, 0.9)],
        [220.0, 9.0],
    ),
];

/// The arms from one state to another.
fn arms(from: StateKind, to: StateKind) -> impl Iterator<Item = Transition> {
    let all = Transition::ALL.iter().copied();
    all.filter(move |arm| arm.before() == Some(from) && arm.after() == Some(to))
}

/// The diagram before it is rendered.
pub struct Diagram {
    cards: Vec<Card>,
    arrows: Vec<Arrow>,
}

impl Diagram {
    /// Builds the diagram from the transition table.
    ///
    /// # Errors
    /// The table has an arm between two states for which no arrow is laid out.
    pub fn new() -> Result<Self, String> {
        let cards = Card::all();
        let area = |state| {
            let card = cards.iter().find(|card| card.state() == state);
            card.map_or(Area([0.0; 4]), |card| card.area)
        };
        let mut arrows = Vec::new();
        for (a, b, [out, back], bow) in WAYS {
            let ends = [(area(a), out), (area(b), back)];
            for (from, to, lane) in [(a, b, -1.0), (b, a, 1.0)] {
                let (arms, colour) = if lane < 0.0 {
                    (arms(a, b), CLOSES)
                } else {
                    (arms(b, a), OPENS)
                };
                let arms: Vec<Transition> = arms.collect();
                if !arms.is_empty() {
                    arrows.push(Arrow::new((from, to), (ends, lane, bow), &arms, colour));
                }
            }
        }
        for arm in Transition::ALL {
            let ends = (arm.before(), arm.after());
            let is_drawn =
                ends.0 == ends.1 || arrows.iter().any(|a| ends == (Some(a.from), Some(a.to)));
            if !is_drawn {
                return Err(format!(
                    "no arrow is laid out for {arm:?}, from and to {ends:?}"
                ));
            }
        }
        let blocked: Vec<Area> = cards.iter().map(|card| card.area).collect();
        arrow::place_labels(&mut arrows, &blocked);
        Ok(Self { cards, arrows })
    }

    /// The rectangles of all cards and of all labels on arrows.
    pub fn areas(&self) -> Vec<Area> {
        let cards = self.cards.iter().map(|card| card.area);
        cards
            .chain(self.arrows.iter().map(Arrow::label_area))
            .collect()
    }

    /// Renders the diagram as SVG.
    ///
    /// # Errors
    /// None: writing to a string cannot fail.
    pub fn svg(&self) -> Result<String, fmt::Error> {
        let mut out = String::new();
        let [width, height] = SIZE;
        writeln!(
            out,
            r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="100%" role="img" aria-label="Contact states and transitions" font-family="{FONT}">"#
        )?;
        writeln!(
            out,
            r##"<rect width="{width}" height="{height}" rx="10" fill="#fbfaf7"/>"##
        )?;
        self.arrows
            .iter()
            .try_for_each(|arrow| arrow.draw_line(&mut out))?;
        self.cards.iter().try_for_each(|card| card.draw(&mut out))?;
        self.arrows
            .iter()
            .try_for_each(|arrow| arrow.draw_label(&mut out))?;
        legend(&mut out)?;
        out.push_str("</svg>\n");
        Ok(out)
    }
}

/// What the colours mean, and the arms that every state has.
fn legend(out: &mut String) -> fmt::Result {
    let (x, mut y) = (30.0, 1340.0);
    for (colour, text) in [(CLOSES, "contacts close"), (OPENS, "contacts open")] {
        writeln!(
            out,
            r#"<path d="M{x} {y}h34" stroke="{colour}" stroke-width="2"/><path d="M{} {y}l-10 -5v10Z" fill="{colour}"/><text x="{}" y="{}" font-size="15" fill="{INK}">{text}</text>"#,
            x + 42.0,
            x + 54.0,
            y + 5.0
        )?;
        y += 26.0;
    }
    draw_loop(out, [x + 20.0, y])?;
    for text in [
        "the contacts stay as they are",
        "dashed: states beyond the paper's four",
    ] {
        writeln!(
            out,
            r#"<text x="{}" y="{}" font-size="15" fill="{INK}">{text}</text>"#,
            x + 54.0,
            y + 5.0
        )?;
        y += 26.0;
    }
    for arm in Transition::ALL.iter().filter(|arm| arm.before().is_none()) {
        writeln!(
            out,
            r#"<text x="{x}" y="{}" font-size="15" fill="{INK}">In any state. {}</text>"#,
            y + 5.0,
            markup(arm.describe())
        )?;
    }
    Ok(())
}

/// The transition table in Markdown.
pub fn table() -> String {
    let name = |state: Option<StateKind>| state.map_or("any", StateKind::name);
    let rows = Transition::ALL.iter().map(|arm| {
        let to = match (arm.before(), arm.after()) {
            (before, after) if before == after => "the same",
            (_, after) => name(after),
        };
        let physics = arm.describe().replace('|', "\\|");
        format!("| {} | {to} | {physics} |\n", name(arm.before()))
    });
    "| from | to | condition: what follows |\n|---|---|---|\n".to_owned()
        + &rows.collect::<String>()
}

/// A file of the documentation of the solver.
pub fn document(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../core")
        .join(name)
}
