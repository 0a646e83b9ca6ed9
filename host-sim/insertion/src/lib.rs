//! Whitney's meter of a peg in a hole: how deep the peg is, the load on it, and whether that load slides it in or jams it. From the
//! scene and one frame alone (pose, contacts with forces); it shares no code with the solver. f64, SI units.
//!
//! ```text
//! body, obstacles, half-planes, start ─ Meter::find ─┐
//! pose, contacts ────────────────────────────────────┴─ Meter::read ─ Insertion (depth, load, margin, verdict)
//! where the unloaded peg would be, springs ─────────── Meter::small_angles (F_z by Whitney's formulas)
//! ```
//!
//! # What is a peg, what a hole
//!
//! * A **peg** is two parallel sides of the body, d apart, r = d/2.
//! * A **hole** is two parallel sides of two obstacles that face each other, D_h apart, where they lie opposite each other. Its mouth is
//!   the end of that stretch whose middle no obstacle and no half-plane covers; of two the one nearer to the body at the start.
//! * A peg goes with a hole where d < D_h and the clearance c = (D_h - d)/D_h is at most [`MOST_CLEARANCE`]. Of several the pair with
//!   the least c counts, of equal ones that with the mouth nearest to the start. A bevel is not of the hole: l counts from below it.
//!
//! # The meter
//!
//! While both ends of the peg's tip are below the mouth and between the walls. l is the depth below the mouth, along the hole, of
//! that end of the tip that is less deep: the one that meets a wall when the peg tilts. The load is what the walls' reactions
//! balance, in the **peg's frame**: F_x lateral, F_z along the peg into the hole, M counter-clockwise about the middle of the tip,
//! with x to the left of z. What a contact bears whose normal is within 45 degrees of the peg's axis (the bottom) is not in it. mu
//! is the smaller mu_d of the walls, lambda = l/(2 r mu).
//!
//! The jamming diagram, F_x/F_z across and M/(r F_z) up, has for small angles the parallelogram of [`Diagram`]. A load inside
//! slides the peg in, one outside jams it, however large it is. The margin is the signed distance to the nearest of the four lines,
//! positive inside. It is there while F_z > 0 and nothing but the walls holds the peg. In balance no load is inside but by
//! mu_s > mu_d or by its tilt: a peg that slides is on the boundary.
//!
//! # Small angles, and the exact balance
//!
//! In the peg's frame a corner of the mouth on the peg's side has F_x/F_z = 1/mu exactly, whatever the tilt theta; the end of the
//! tip on a wall has cot(atan mu + theta), because the wall's normal leans against the insertion. The corner's lever along the peg
//! is l cos theta + D_h sin theta. So the lines are exact to about 2 theta/mu, and a load counts as jammed only farther outside.
//!
//! Along the **hole's** axis the same force is larger by what the tilt of a reaction on the peg's side adds, N_1 sin theta.
//! OBSTACLES 11 has a case at l = 9.842262 mm whose exact F_z is 3.775724 N along the hole, 3.722823 N along the peg, and 3.515731 N by
//! Whitney's formula; and one with a single point, 0.470780 N, 0.410241 N and 0.407740 N: the formulas are
//! forces along the peg, and nearer than they look beside the hole's.
//!
//! # Wedging
//!
//! Two contacts on opposite walls whose line is inside both cones bear any load. With cos(theta + alpha) = (1 - c) cos alpha from
//! D_h cos theta - l sin theta = d and tan alpha = l/D_h, theta + alpha <= atan mu is alpha <= acos(cos(atan mu)/(1 - c)), see
//! [`deepest_wedge`]. It is possible from mu = tan(acos(1 - c)), about sqrt(2c), on. The known mu > 2 sqrt(c) leaves out
//! theta²/2 beside theta l/D_h, which is not small there: with c = 0.001 and mu = 0.06, below 2 sqrt(c) = 0.0632, a peg is wedged
//! at l = 0.04 D_h.

mod diagram;
mod find;
mod plane;
mod read;
mod small_angles;
mod wedge;

pub use diagram::Diagram;
pub use find::{MOST_CLEARANCE, Scene, Solid};
pub use read::{Insertion, Reaction, Verdict};
pub use small_angles::{SmallAngles, Springs};
pub use wedge::{deepest_wedge, least_friction};

use plane::Vec2;

/// A peg and its hole. World frame for the hole, body frame for the peg.
#[derive(Clone, Debug, PartialEq)]
pub struct Meter {
    /// Half the width of the peg, r (m).
    pub radius: f64,
    /// The width of the hole, D_h (m).
    pub width: f64,
    /// mu: the smaller dynamic friction of the walls.
    pub friction: f64,
    /// How long the walls lie opposite each other (m).
    pub length: f64,
    /// The middle of the mouth (m).
    pub mouth: Vec2,
    /// The unit vector along the hole, inwards.
    pub inwards: Vec2,
    /// The ends (m) of the peg's two sides: those at the tip if the axis, which is the unit vector from the other ends to them, goes into
    /// the hole.
    peg: Peg,
}

/// The two sides of a peg, body frame.
#[derive(Clone, Debug, PartialEq)]
struct Peg {
    /// The unit vector along the sides.
    axis: Vec2,
    /// The ends of both sides towards `axis`, and those at the other end (m).
    ends: [[Vec2; 2]; 2],
    /// Distance of the sides (m).
    width: f64,
}

impl Meter {
    /// c = (D_h - d)/D_h
    pub fn clearance(&self) -> f64 {
        (self.width - 2.0 * self.radius) / self.width
    }

    /// lambda = l/(2 r mu); none without friction.
    pub fn lambda(&self, depth: f64) -> Option<f64> {
        (self.friction > 0.0).then(|| depth / (2.0 * self.radius * self.friction))
    }
}
