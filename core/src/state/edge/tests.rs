//! An edge near its limit load: within the rounding of its reactions nothing opens, and nothing is certified.

use super::*;
use crate::fixtures;
use crate::geometry::Angle;
use crate::work::Work;

const ROUNDING: f64 = 1.0 / 1024.0;

fn margin(start: f64) -> Margin<f64> {
    Margin {
        start: start * ROUNDING,
        along: 0.0,
        turning: Vec2::ZERO,
        rounding: ROUNDING,
    }
}

/// A reaction that is negative by no more than its rounding still presses.
#[test]
fn vertex_opens_where_it_is_pulled_beyond_doubt() {
    for first in [-2.0, -1.0, -0.5, 0.0, 1.0] {
        for second in [-2.0, -1.0, -0.5, 0.0, 1.0] {
            let reaction = Reaction {
                parts: [margin(first), margin(second)],
                normal: margin(first + second),
                friction: margin(0.0),
            };
            let should = match (first < -1.0, second < -1.0) {
                (true, true) => Some(Trigger::Clear),
                (true, false) => Some(keep(1, None)),
                (false, true) => Some(keep(0, None)),
                (false, false) => None,
            };
            assert_eq!(reaction.opens(None), should, "{first} {second}");
        }
    }
}

/// On a short edge a moment, and its rounding, is a large reaction: an edge is certified only if both reactions are larger than that.
#[test]
fn certified_edge_presses_beyond_the_rounding() {
    for span in [0.125, 0.5, 1.0] {
        // The third vertex makes the body as large as 1.
        let vertices = [[0.0, 0.0], [5.0 * span, 0.0], [3.0, 4.0]];
        let scene = fixtures::scene::<3, 1>(&vertices, &[0.0]);
        assert_eq!(scene.vertex(1).x, span);
        let pivot = fixtures::pivot(0.0);
        let edge = Edge::new(
            pivot,
            Pair {
                vertex: 1,
                surface: pivot.contact.surface,
            },
        );
        // Pressed by 1, above one of the vertices except for a few roundings.
        for (begin, side) in [(0.0, 1.0), (span, -1.0)] {
            let pressed = |off: f64| {
                let at = Vec2::new(begin + side * off, 0.0);
                Grip {
                    holding_point: at,
                    hand: at + Vec2::new(0.0, -1.0),
                    angle: Angle::default(),
                }
            };
            let rounding = |off: f64| pivot.load(&scene, &pressed(off)).rounding();
            let unit = rounding(rounding(0.0));
            for times in [0.5, 1.0, 1.5, 2.0] {
                // Above the second one the numbers are not exact enough for the bound itself.
                if begin > 0.0 && times == 1.0 {
                    continue;
                }
                let grip = pressed(times * unit);
                let is_certified = edge
                    .clone()
                    .follow(&scene, (&grip, &grip), &mut Work::none());
                assert_eq!(is_certified, times > 1.0, "{span} {begin} {times}");
                if begin == 0.0 {
                    let load = pivot.load(&scene, &grip);
                    let reaction = edge.reaction(&scene, &load, &Displacement::slide(Vec2::ZERO));
                    let [_, second] = reaction.parts;
                    let off = second.start / second.rounding - times;
                    assert!(off.abs() < 1e-12, "{span} {times}");
                }
            }
        }
    }
}
