//! The card of a state: its picture, its name, and the arms of the table that stay in it.

use super::words::Words;
use super::{Area, INK, OPENS, STAYS, arms};
use std::fmt::{self, Write};
use stiction_core::StateKind::{self, Corner, Edge, Locked, NonContact, SingleVertex, TwoVertex};
use stiction_core::Transition;

/// What is drawn for a state: the position of its card, and the surfaces, the body and the contacts in a box of 36 by 24.
struct Place {
    state: StateKind,
    at: [f64; 2],
    ground: &'static str,
    body: &'static str,
    contacts: &'static [[f64; 2]],
}

const PLACES: [Place; 6] = [
    place(
        NonContact,
        [20.0, 600.0],
        "M3 22H33",
        "M9 10 24 5 27 12 12 17Z",
        &[],
    ),
    place(
        SingleVertex,
        [630.0, 414.0],
        "M3 22H33",
        "M13 22 6 8 20 3 27 17Z",
        &[[13.0, 22.0]],
    ),
    place(
        Edge,
        [630.0, 70.0],
        "M3 22H33",
        "M8 22V10H28V22Z",
        &[[8.0, 22.0], [28.0, 22.0]],
    ),
    place(
        TwoVertex,
        [630.0, 860.0],
        "M5 2V22H33",
        "M5 12 18 3 28 9 15 22Z",
        &[[5.0, 12.0], [15.0, 22.0]],
    ),
    place(
        Corner,
        [630.0, 1240.0],
        "M5 2V22H33",
        "M5 22 10 8 25 4 20 18Z",
        &[[5.0, 22.0]],
    ),
    place(
        Locked,
        [1240.0, 606.0],
        "M7 2V22H33",
        "M7 22V9H27V22Z",
        &[[7.0, 9.0], [7.0, 22.0], [27.0, 22.0]],
    ),
];
/// The states that the paper does not have.
const BEYOND: [StateKind; 2] = [Corner, Locked];
const WIDTH: f64 = 300.0;
const LEAST_HEIGHT: f64 = 170.0;
/// Height of a card above its text.
const HEAD: f64 = 74.0;

const fn place(
    state: StateKind,
    at: [f64; 2],
    ground: &'static str,
    body: &'static str,
    contacts: &'static [[f64; 2]],
) -> Place {
    Place {
        state,
        at,
        ground,
        body,
        contacts,
    }
}

/// A state with the arms that stay in it.
pub(super) struct Card {
    place: &'static Place,
    pub(super) area: Area,
    words: Words,
}

impl Card {
    /// The cards of all states.
    pub(super) fn all() -> Vec<Self> {
        PLACES.iter().map(Self::new).collect()
    }

    pub(super) fn state(&self) -> StateKind {
        self.place.state
    }

    fn new(place: &'static Place) -> Self {
        let arms = arms(place.state, place.state).map(Transition::describe);
        let words = Words::wrapped(arms, 14.0, WIDTH - 46.0);
        let height = (HEAD + words.size()[1] + 14.0).max(LEAST_HEIGHT);
        let [x, y] = place.at;
        Self {
            place,
            area: Area([x, y, WIDTH, height]),
            words,
        }
    }

    pub(super) fn draw(&self, out: &mut String) -> fmt::Result {
        let Area([x, y, width, height]) = self.area;
        let edge = if BEYOND.contains(&self.place.state) {
            "stroke-dasharray=\"7 4\""
        } else {
            ""
        };
        writeln!(
            out,
            r#"<rect x="{x}" y="{y}" width="{width}" height="{height:.1}" rx="14" fill="white" stroke="{INK}" stroke-width="1.6" {edge}/>"#
        )?;
        let Place {
            ground,
            body,
            contacts,
            state,
            ..
        } = self.place;
        writeln!(
            out,
            r##"<g transform="translate({} {}) scale(1.9)" stroke-linejoin="round"><path d="{body}" fill="#dfe8ec" stroke="{INK}" stroke-width="0.8"/><path d="{ground}" fill="none" stroke="{INK}" stroke-width="1.3"/>"##,
            x + 14.0,
            y + 10.0
        )?;
        for [cx, cy] in *contacts {
            writeln!(out, r#"<circle cx="{cx}" cy="{cy}" r="2" fill="{OPENS}"/>"#)?;
        }
        writeln!(
            out,
            r#"</g><text x="{}" y="{}" font-size="20" font-weight="600" fill="{INK}">{}</text>"#,
            x + 98.0,
            y + 42.0,
            state.name()
        )?;
        self.words
            .draw(out, ([x + 34.0, y + HEAD], "start", STAYS))?;
        for top in self.words.tops() {
            draw_loop(out, [x + 20.0, y + HEAD + top + 8.5])?;
        }
        Ok(())
    }
}

/// An arrow that returns to its start.
pub(super) fn draw_loop(out: &mut String, [x, y]: [f64; 2]) -> fmt::Result {
    writeln!(
        out,
        r#"<path d="M{:.1} {:.1}A5 5 0 1 0 {:.1} {:.1}" fill="none" stroke="{STAYS}" stroke-width="1.5"/><path d="M{:.1} {:.1}l6.4 0.6-4.6 4.6Z" fill="{STAYS}"/>"#,
        x + 1.0,
        y - 5.0,
        x + 5.0,
        y - 0.6,
        x - 0.6,
        y - 8.2,
    )
}
