//! Arrows between the cards: one curve for each direction, and a position on it for its label.

use super::Area;
use super::words::Words;
use std::fmt::{self, Write};
use stiction_core::{StateKind, Transition};

type Point = [f64; 2];

/// A side of a card.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Side {
    Left,
    Right,
    Top,
    Bottom,
}

/// A side, and the position along it (a fraction, from the left or from the top) at which both arrows of a pair of
/// states leave it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Port(pub(super) Side, pub(super) f64);

/// Length and half-width of an arrowhead.
const HEAD: [f64; 2] = [11.0, 5.0];
/// Font size of the labels.
const LETTERS: f64 = 15.0;
const WIDTH: f64 = 170.0;

/// All arms from one state to another.
pub(super) struct Arrow {
    pub(super) from: StateKind,
    pub(super) to: StateKind,
    /// A cubic Bézier curve.
    curve: [Point; 4],
    words: Words,
    title: String,
    colour: &'static str,
    /// The centre of its label.
    label: Point,
}

/// Both cards with their ports, the lane (-1: from the first to the second card, 1: back), the bulge, and half the distance
/// between the lanes.
type Way = ([(Area, Port); 2], f64, [f64; 2]);

impl Arrow {
    pub(super) fn new(
        (from, to): (StateKind, StateKind),
        (ends, lane, [swing, apart]): Way,
        arms: &[Transition],
        colour: &'static str,
    ) -> Self {
        let [(first, out), (second, back)] = ends;
        let beside = lane * apart;
        // Arrows that return to the same side are nested; the others run side by side, on steep sections too.
        let (other, [near, far]) = match (out.0, back.0) {
            (Side::Top, Side::Top) => (-beside, [swing * (1.0 - 0.04 * lane); 2]),
            (Side::Right, Side::Right) => (-beside, [swing * (1.0 - 0.2 * lane); 2]),
            (Side::Right, Side::Left) => {
                let shift = 1.6 * beside * (second.0[1] - first.0[1]).signum();
                (beside, [swing - shift, swing + shift])
            }
            _ => (beside, [swing; 2]),
        };
        let [a, b] = leave(first, out, beside, near);
        let [d, c] = leave(second, back, other, far);
        let bends = out.0 == Side::Top && back.0 == Side::Top;
        let causes = arms
            .iter()
            .map(|arm| arm.describe().split(':').next().unwrap_or_default());
        let sentences: Vec<&str> = arms.iter().map(|arm| arm.describe()).collect();
        Self {
            from,
            to,
            curve: if lane < 0.0 {
                [a, b, c, d]
            } else {
                [d, c, b, a]
            },
            words: Words::wrapped(causes, LETTERS, if bends { 2.0 * WIDTH } else { WIDTH }),
            title: sentences.join("\n"),
            colour,
            label: [0.0; 2],
        }
    }

    /// The point of the curve at parameter `t` (0 to 1).
    fn at(&self, t: f64) -> Point {
        let s = 1.0 - t;
        let parts = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        let sum = |k: usize| {
            self.curve
                .iter()
                .zip(parts)
                .map(|(p, part)| p[k] * part)
                .sum()
        };
        [sum(0), sum(1)]
    }

    /// The rectangle of its label.
    pub(super) fn label_area(&self) -> Area {
        self.label_at(self.label)
    }

    fn label_at(&self, middle: Point) -> Area {
        let [width, height] = self.words.size();
        Area::around(middle, [width + 8.0, height + 4.0])
    }

    pub(super) fn draw_line(&self, out: &mut String) -> fmt::Result {
        let [a, b, c, [x, y]] = self.curve;
        let length = (x - c[0]).hypot(y - c[1]);
        let [ux, uy] = [(x - c[0]) / length, (y - c[1]) / length];
        let [bx, by] = [x - HEAD[0] * ux, y - HEAD[0] * uy];
        let [wx, wy] = [-uy * HEAD[1], ux * HEAD[1]];
        let colour = self.colour;
        writeln!(
            out,
            r#"<path d="M{:.1} {:.1}C{:.1} {:.1} {:.1} {:.1} {bx:.1} {by:.1}" fill="none" stroke="{colour}" stroke-width="1.8"/><path d="M{x:.1} {y:.1}L{:.1} {:.1} {:.1} {:.1}Z" fill="{colour}"/>"#,
            a[0],
            a[1],
            b[0],
            b[1],
            c[0],
            c[1],
            bx + wx,
            by + wy,
            bx - wx,
            by - wy,
        )
    }

    pub(super) fn draw_label(&self, out: &mut String) -> fmt::Result {
        let Area([x, y, width, height]) = self.label_area();
        writeln!(
            out,
            r##"<g><title>{}</title><rect x="{x:.1}" y="{y:.1}" width="{width:.1}" height="{height:.1}" rx="6" fill="#fbfaf7" fill-opacity="0.93"/>"##,
            self.title
        )?;
        self.words
            .draw(out, ([self.label[0], y + 2.0], "middle", self.colour))?;
        writeln!(out, "</g>")
    }
}

/// Where an arrow leaves a card, and the point that it heads for first.
fn leave(area: Area, port: Port, beside: f64, swing: f64) -> [Point; 2] {
    let Area([x, y, width, height]) = area;
    let (across, along) = (x + width * port.1 + beside, y + height * port.1 + beside);
    match port.0 {
        Side::Left => [[x, along], [x - swing, along]],
        Side::Right => [[x + width, along], [x + width + swing, along]],
        Side::Top => [[across, y], [across, y - swing]],
        Side::Bottom => [[across, y + height], [across, y + height + swing]],
    }
}

/// Clearance between two labels.
const ROOM: f64 = 5.0;

/// Places the label of every arrow on its curve, where it overlaps no card, no other label and as few other arrows as
/// possible; the longest labels first.
pub(super) fn place_labels(arrows: &mut [Arrow], cards: &[Area]) {
    let mut taken = cards.to_vec();
    let parts = || (12..=88).map(|i| f64::from(i) / 100.0);
    let lines: Vec<Vec<Point>> = arrows
        .iter()
        .map(|a| (0..=100).map(|i| a.at(f64::from(i) / 100.0)).collect())
        .collect();
    let mut order: Vec<usize> = (0..arrows.len()).collect();
    order.sort_by(|&i, &k| arrows[k].words.size()[1].total_cmp(&arrows[i].words.size()[1]));
    for i in order {
        let cost = |t: f64| {
            let area = arrows[i].label_at(arrows[i].at(t));
            let overlaps = taken.iter().filter(|other| area.meets(other, ROOM)).count();
            let others = lines
                .iter()
                .enumerate()
                .filter(|&(k, _)| k != i)
                .flat_map(|(_, line)| line);
            let hidden = others
                .filter(|&&[x, y]| area.meets(&Area([x, y, 0.0, 0.0]), 0.0))
                .count();
            1000.0 * overlaps as f64 + hidden as f64 + 10.0 * (t - 0.5).abs()
        };
        let best = parts()
            .min_by(|&a, &b| cost(a).total_cmp(&cost(b)))
            .unwrap_or(0.5);
        arrows[i].label = arrows[i].at(best);
        taken.push(arrows[i].label_area());
    }
}
