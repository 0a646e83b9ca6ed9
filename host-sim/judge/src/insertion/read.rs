//! Reads the meter: from the pose and the contacts of a frame to depth, load, margin and verdict.

use std::f64::consts::FRAC_1_SQRT_2;

use super::find::Placed;
use super::plane::{Vec2, add, cross, dot, left, scaled, sub};
use super::wedge::is_wedged;
use super::{Diagram, Meter};

/// Uncertainty due to rounding of a ratio of forces, and so of a position in the diagram, relative to its size: in f32, the
/// friction of a sliding contact equals mu_d N more accurately than this.
const OPEN: f64 = 1.0 / 1024.0;

/// A contact of the body, world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction {
    /// Its position (m).
    pub point: Vec2,
    /// The unit normal n towards the body.
    pub direction: Vec2,
    /// N (N)
    pub normal: f64,
    /// T (N) on the body, along (n_y, -n_x).
    pub friction: f64,
}

impl Reaction {
    fn force(&self) -> Vec2 {
        let along = scaled(left(self.direction), -self.friction);
        add(scaled(self.direction, self.normal), along)
    }
}

/// The condition of a peg in its hole.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// No wall touches it.
    Free,
    /// One wall does.
    OnePoint,
    /// Both walls do.
    TwoPoint,
    /// Its load is outside the diagram: it does not push the peg in, however large it is.
    Jammed,
    /// The walls bear any load.
    Wedged,
}

impl Verdict {
    /// All verdicts.
    pub const ALL: [Self; 5] = [
        Self::Free,
        Self::OnePoint,
        Self::TwoPoint,
        Self::Jammed,
        Self::Wedged,
    ];

    /// Its name in traces.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::OnePoint => "one-point",
            Self::TwoPoint => "two-point",
            Self::Jammed => "jammed",
            Self::Wedged => "wedged",
        }
    }
}

/// A peg in its hole; the load in the peg's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Insertion {
    /// l (m), above 0.
    pub depth: f64,
    /// F_x (N), lateral.
    pub fx: f64,
    /// F_z (N), into the hole.
    pub fz: f64,
    /// M (N·m), counter-clockwise about the middle of the tip.
    pub m: f64,
    /// lambda = l/(2 r mu); `None` without friction.
    pub lambda: Option<f64>,
    /// The signed distance to the nearest line of the diagram, positive inside; `None` if the load has no position in it.
    pub margin: Option<f64>,
    /// The number of walls that touch it.
    pub walls: usize,
    /// The peg's condition.
    pub verdict: Verdict,
}

impl Insertion {
    /// The position of the load in the diagram, F_x/F_z and M/(r F_z); `None` if it has none.
    pub fn load(&self, radius: f64) -> Option<Vec2> {
        self.margin
            .map(|_| [self.fx / self.fz, self.m / (radius * self.fz)])
    }
}

struct Walls {
    /// The contacts whose normal points to the right of the insertion direction, and those to the left.
    right: Vec<Reaction>,
    left: Vec<Reaction>,
    fx: f64,
    fz: f64,
    m: f64,
}

impl Walls {
    fn of(peg: &Placed, contacts: &[Reaction]) -> Self {
        let (across, tip) = (left(peg.axis), peg.middle());
        let along = |contact: &Reaction| dot(contact.direction, across);
        let side = |sign: f64| {
            let is_there = move |contact: &&Reaction| sign * along(contact) > FRAC_1_SQRT_2;
            contacts.iter().filter(is_there).copied().collect()
        };
        let (right, left): (Vec<Reaction>, Vec<Reaction>) = (side(-1.0), side(1.0));
        let (mut force, mut m) = ([0.0; 2], 0.0);
        for wall in right.iter().chain(&left) {
            force = sub(force, wall.force());
            m -= cross(sub(wall.point, tip), wall.force());
        }
        let (fx, fz) = (dot(across, force), dot(peg.axis, force));
        Self {
            right,
            left,
            fx,
            fz,
            m,
        }
    }

    fn count(&self) -> usize {
        self.right.len() + self.left.len()
    }

    fn are_wedging(&self, friction: f64) -> bool {
        let pairs = (self.right.iter()).flat_map(|a| self.left.iter().map(move |b| (a, b)));
        pairs.into_iter().any(|(a, b)| is_wedged(friction, a, b))
    }
}

impl Meter {
    /// The meter of a frame; `None` if the peg is not in the hole.
    pub fn read(&self, pose: [f64; 3], contacts: &[Reaction]) -> Option<Insertion> {
        let peg = self.peg.pointing(pose, self.inwards);
        let depth = self.depth(&peg)?;
        let walls = Walls::of(&peg, contacts);
        // A peg that stands on the bottom is not held by the walls alone.
        let by_walls = walls.fz > 0.0 && walls.count() == contacts.len();
        let lambda = self.lambda(depth);
        let diagram = lambda.filter(|_| by_walls).map(|lambda| Diagram {
            friction: self.friction,
            lambda,
        });
        let load = [walls.fx, walls.m / self.radius].map(|part| part / walls.fz);
        let margin = diagram.map(|diagram| diagram.margin(load));
        let margin = margin.filter(|margin| margin.is_finite());
        // The lines are exact to within the tilt and rounding.
        let tilt = cross(self.inwards, peg.axis).abs();
        let open = |diagram: Diagram| 2.0 * tilt / self.friction + OPEN * diagram.size();
        let is_outside = |(diagram, margin)| margin < -open(diagram);
        let verdict = match (walls.right.is_empty(), walls.left.is_empty()) {
            (true, true) => Verdict::Free,
            _ if walls.are_wedging(self.friction) => Verdict::Wedged,
            _ if diagram.zip(margin).is_some_and(is_outside) => Verdict::Jammed,
            (false, false) => Verdict::TwoPoint,
            _ => Verdict::OnePoint,
        };
        Some(Insertion {
            depth,
            fx: walls.fx,
            fz: walls.fz,
            m: walls.m,
            lambda,
            margin,
            walls: usize::from(!walls.right.is_empty()) + usize::from(!walls.left.is_empty()),
            verdict,
        })
    }

    /// l (m) of a peg in the hole.
    fn depth(&self, peg: &Placed) -> Option<f64> {
        let depth = |point| dot(self.inwards, sub(point, self.mouth));
        let ([a, b], [c, d]) = (peg.tip.map(depth), peg.back.map(depth));
        let lateral = dot(left(self.inwards), sub(peg.middle(), self.mouth));
        let l = a.min(b);
        let is_in = l > 0.0 && c.min(d) < self.length && lateral.abs() < 0.5 * self.width;
        is_in.then_some(l)
    }
}
