//! Whitney's meter of a peg in a hole: how deep the peg is, the load on it, and whether that load slides it in or jams it. It uses
//! only the scene and one frame (pose, contacts with forces). f64, SI units.
//!
//! ```text
//! body, obstacles, half-planes, start ─ Meter::find ─┐
//! pose, contacts ────────────────────────────────────┴─ Meter::read ─ Insertion (depth, load, margin, verdict)
//! where the unloaded peg would be, springs ─────────── Meter::small_angles (F_z by Whitney's formulas)
//! ```
//!
//! # Definition of peg and hole
//!
//! * A **peg** is two parallel sides of the body, d apart, r = d/2.
//! * A **hole** is two parallel sides of two obstacles that face each other, D_h apart, over the stretch in which they are opposite each
//!   other. Its mouth is the end of that stretch whose middle no obstacle and no half-plane covers; of two such ends, the one nearer to
//!   the body at the start.
//! * A peg fits a hole if d < D_h and the clearance c = (D_h - d)/D_h is at most [`MOST_CLEARANCE`].
//!   Of several pairs the one with the smallest c counts; of equal ones, that with the mouth nearest
//!   to the start. A bevel does not belong to the hole: l is measured from below it.
//!
//! # The meter
//!
//! The meter applies while both ends of the peg's tip are below the mouth and between the walls. l is the depth below the mouth, along
//! the hole, of the shallower end of the tip: the one that meets a wall when the peg tilts. The load is the wrench that the walls'
//! reactions balance, in the **peg's frame**: F_x lateral, F_z along the peg into the hole, M counter-clockwise about the middle of the
//! tip, with x to the left of z. Contacts whose normal is within 45 degrees of the peg's axis (the bottom) are excluded. mu is the
//! smaller mu_d of the walls, lambda = l/(2 r mu).
//!
//! For small angles, the jamming diagram, with F_x/F_z horizontally and M/(r F_z) vertically, is the parallelogram of [`Diagram`]. A
//! load inside slides the peg in; a load outside jams it, however large it is. The margin is the signed distance to the nearest of the
//! four lines, positive inside. It is defined while F_z > 0 and only the walls hold the peg. In balance, a load is inside only because
//! of mu_s > mu_d or of the tilt: a sliding peg is on the boundary.
//!
//! # Small angles, and the exact balance
//!
//! In the peg's frame, a corner of the mouth on the peg's side has F_x/F_z = 1/mu exactly, whatever the tilt theta; the end of the tip
//! on a wall has cot(atan mu + theta), because the wall's normal leans against the insertion. The corner's lever along the peg is l cos
//! theta + D_h sin theta. So the lines are exact to about 2 theta/mu, and a load counts as jammed only if it is farther outside.
//!
//! Along the **hole's** axis, the same force is larger by N_1 sin theta, the contribution of the tilt of a reaction on the peg's side.
//! OBSTACLES 11 has a case at l = 9.842262 mm whose exact F_z is 3.775724 N along the hole, 3.722823 N along the peg, and 3.515731 N by
//! Whitney's formula; and one with a single contact point, 0.470780 N, 0.410241 N and 0.407740 N. The formulas give forces along the
//! peg, and are closer than a comparison with the force along the hole suggests.
//!
//! # Wedging
//!
//! Two contacts on opposite walls bear any load if the line between them is inside both cones. With cos(theta + alpha) = (1 - c) cos
//! alpha, which follows from D_h cos theta - l sin theta = d and tan alpha = l/D_h, the condition theta + alpha <= atan mu becomes alpha
//! <= acos(cos(atan mu)/(1 - c)), see [`deepest_wedge`]. Wedging is possible from mu = tan(acos(1 - c)) on, about sqrt(2c). The
//! well-known condition mu > 2 sqrt(c) neglects theta²/2 against theta l/D_h, although it is not small there: with c = 0.001 and mu =
//! 0.06, below 2 sqrt(c) = 0.0632, a peg is wedged at l = 0.04 D_h.

mod diagram;
mod find;
mod plane;
mod read;
mod small_angles;
mod wedge;

pub use diagram::Diagram;
pub use find::MOST_CLEARANCE;
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
    /// The length over which the walls are opposite each other (m).
    pub length: f64,
    /// The middle of the mouth (m).
    pub mouth: Vec2,
    /// The unit vector along the hole, inwards.
    pub inwards: Vec2,
    /// The ends (m) of the peg's two sides: those at the tip if the axis, the unit vector towards them from the opposite ends, points
    /// into the hole.
    peg: Peg,
}

#[derive(Clone, Debug, PartialEq)]
struct Peg {
    /// The unit vector along the sides.
    axis: Vec2,
    /// The ends of both sides towards `axis`, and the opposite ones (m).
    ends: [[Vec2; 2]; 2],
    /// Distance between the sides (m).
    width: f64,
}

impl Meter {
    /// c = (D_h - d)/D_h
    pub fn clearance(&self) -> f64 {
        (self.width - 2.0 * self.radius) / self.width
    }

    /// lambda = l/(2 r mu); `None` without friction.
    pub fn lambda(&self, depth: f64) -> Option<f64> {
        (self.friction > 0.0).then(|| depth / (2.0 * self.radius * self.friction))
    }
}
