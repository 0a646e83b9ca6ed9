//! Ordinary surroundings: a floor, a floor with a wall or a slope, a tray, a tray with a slope or a lid.

use crate::draw::Draw;
use std::f64::consts::{FRAC_PI_2, PI};

/// A half-plane: normal·p >= offset is free.
pub(super) struct Place {
    pub(super) normal: [f64; 2],
    pub(super) offset: f64,
}

/// One to four surfaces about the origin, which lies on the floor, for a body of size `l`.
pub(super) fn place(draw: &mut Draw, l: f64) -> Vec<Place> {
    let tilt = draw.between(-0.2, 0.2);
    let (sin, cos) = f64::sin_cos(tilt);
    let floor = |x: f64| [x * cos, x * sin];
    let rise = |(low, high): (f64, f64), draw: &mut Draw| PI - draw.between(low, high).to_radians();
    let [right, left] = [0.0; 2].map(|_: f64| l * draw.between(0.8, 1.5));
    let mut places = vec![line(floor(0.0), tilt)];
    let count = 1 + draw.below(4);
    if count == 2 {
        // From a sharp wedge through a wall to two slopes.
        places.push(line(floor(right), tilt + rise((60.0, 140.0), draw)));
    }
    if count > 2 {
        places.push(line(floor(right), tilt + rise((80.0, 120.0), draw)));
        places.push(line(floor(-left), tilt - rise((80.0, 110.0), draw)));
    }
    if count == 4 {
        places.push(match draw.below(2) {
            0 => line(floor(-0.7 * left), tilt - rise((120.0, 155.0), draw)),
            _ => {
                let height = l * draw.between(1.6, 2.2);
                line([0.0, height], tilt + PI + draw.between(-0.1, 0.1))
            }
        });
    }
    places
}

/// The surface through a point along a direction (rad), free on its left.
fn line([x, y]: [f64; 2], direction: f64) -> Place {
    let (sin, cos) = (direction + FRAC_PI_2).sin_cos();
    Place {
        normal: [cos, sin],
        offset: cos * x + sin * y,
    }
}
