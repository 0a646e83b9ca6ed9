//! What contacts do that cannot hold the body under a frozen hand: one motion, selected from those that fit the load.

use super::cone::{inner, times};
use super::contact::Touch;
use super::scene::{Screw, add, cross, dot, scale, sub};
use super::statics::sign;
use super::{CLEARANCE, Reference};

/// A gap that changes by less than this, per unit of a unit twist, neither opens nor closes.
pub(super) const STILL: f64 = 1e-9;

/// A motion that starts.
pub(super) enum Mode {
    Slide([Touch; 2], Screw),
    Keep(Vec<Touch>),
}

/// Whether the same vertex of the body is in both contacts.
pub(super) fn same_vertex(a: Touch, b: Touch) -> bool {
    a.vertex().is_some() && a.vertex() == b.vertex()
}

impl Reference {
    /// Whether the body touches two surfaces with one vertex and nothing else.
    pub(super) fn corner(&self) -> bool {
        matches!(*self.contacts.as_slice(), [a, b] if same_vertex(a, b))
    }

    /// How a vertex leaves a corner: along one surface if friction does not hold it there; otherwise it comes free.
    pub(super) fn leaves_corner(&self, hand: [f64; 3]) -> Option<Mode> {
        let &[a, b] = self.contacts.as_slice() else {
            return None;
        };
        let slides = |&(staying, other): &(Touch, Touch)| {
            let [normal, friction] = self.reaction(&self.pose, staying, hand);
            let way = scale(-sign(friction), self.scene.tangent(&self.pose, staying));
            let leaves = dot(way, self.scene.normal(&self.pose, other)) > 0.0;
            normal > 0.0
                && friction.abs() > self.grip(self.scene.friction(staying)) * normal
                && leaves
        };
        let staying = [(a, b), (b, a)].into_iter().find(slides);
        Some(Mode::Keep(
            staying.map(|(staying, _)| staying).into_iter().collect(),
        ))
    }

    /// The motion of contacts that cannot hold, from rest or already `slipping`: they turn about one that sticks; else
    /// slide with the fewest openings; else come free.
    pub(super) fn mode(&self, hand: [f64; 3], slipping: bool) -> Option<Mode> {
        let count = self.contacts.len();
        let pairs = || {
            (0..count)
                .flat_map(|i| (i + 1..count).map(move |j| [self.contacts[i], self.contacts[j]]))
        };
        let corner = || {
            pairs()
                .find(|pair| count > 2 && same_vertex(pair[0], pair[1]) && self.pivots(pair, hand))
        };
        let single = |sticks: bool| {
            self.contacts.iter().copied().find(|&touch| {
                let [normal, friction] = self.reaction(&self.pose, touch, hand);
                let of = self.scene.friction(touch);
                let grip = if slipping { of.mu_d } else { self.grip(of) };
                let held = friction.abs() <= grip * normal;
                normal > 0.0 && (held || !sticks) && self.pivots(&[touch], hand)
            })
        };
        let slide = |pressed: bool| {
            let slides = pairs().filter_map(|pair| self.slide_mode(pair, pressed, hand));
            slides
                .max_by(|a, b| a.1.total_cmp(&b.1))
                .map(|(mode, _)| mode)
        };
        let keep = |touch: Touch| Mode::Keep(vec![touch]);
        let corner = corner().map(|pair| Mode::Keep(pair.to_vec()));
        let turns = corner.or_else(|| single(true).map(keep));
        let moves = turns
            .or_else(|| slide(true))
            .or_else(|| slide(false))
            .or_else(|| single(false).map(keep));
        let free = || self.opens(hand) || self.pulled_off(hand);
        moves.or_else(|| free().then(|| Mode::Keep(Vec::new())))
    }

    /// Whether the load pulls the body off all contacts with obstacles: then the holding point may move first and the body
    /// turn afterwards.
    fn pulled_off(&self, hand: [f64; 3]) -> bool {
        let force = self.scene.applied_force(&self.pose, hand);
        self.contacts.iter().all(|&touch| {
            touch.obstacle().is_some() && dot(force, self.scene.normal(&self.pose, touch)) > 0.0
        })
    }

    /// Whether the path to the free pose opens all contacts.
    pub(super) fn opens(&self, hand: [f64; 3]) -> bool {
        let held = self.scene.holding_point;
        let (from, target) = (self.pose, self.free_pose(hand));
        let shift = sub(target.apply(held), from.apply(held));
        let turn = target.angle - from.angle;
        self.contacts.iter().all(|&touch| {
            let arm = sub(self.scene.point(&from, touch), from.apply(held));
            let velocity = add(shift, scale(turn, [-arm[1], arm[0]]));
            dot(velocity, self.scene.normal(&from, touch)) > -CLEARANCE * self.size
        })
    }

    /// The joint slip of two contacts on two surfaces that friction no longer holds: of the driven slips, one in which
    /// both contacts press, or else the most strongly driven one.
    pub(super) fn slip_of_pair(
        &self,
        pair: [Touch; 2],
        hand: [f64; 3],
    ) -> Option<([Touch; 2], Screw)> {
        let twist = self.free_twist(&self.pose, pair);
        let driven = |way: Screw| {
            let state = self.sliding(&self.pose, pair, way, hand)?;
            let least = state.normals[0].min(state.normals[1]);
            let presses = least >= -self.force_tolerance(&self.pose, hand);
            (state.drive > 0.0).then_some((presses, state.drive, way))
        };
        let slips = [twist, times(-1.0, twist)].into_iter().filter_map(driven);
        let best = slips.max_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)))?;
        Some((pair, best.2))
    }

    /// The slide of a pair, with its drive, if the load drives it, both contacts press (or one, if not `pressed`) and all
    /// others stay closed or open.
    fn slide_mode(&self, pair: [Touch; 2], pressed: bool, hand: [f64; 3]) -> Option<(Mode, f64)> {
        if same_vertex(pair[0], pair[1]) {
            return None;
        }
        let twist = self.free_twist(&self.pose, pair);
        [twist, times(-1.0, twist)].into_iter().find_map(|way| {
            let state = self.sliding(&self.pose, pair, way, hand)?;
            let tolerance = self.force_tolerance(&self.pose, hand);
            let [first, second] = state.normals;
            let presses =
                first.max(second) > tolerance && (!pressed || first.min(second) >= -tolerance);
            let opens = |&touch: &Touch| {
                pair.contains(&touch) || inner(self.normal_line(&self.pose, touch), way) >= -STILL
            };
            let runs = presses && state.drive > 0.0 && self.contacts.iter().all(opens);
            runs.then_some((Mode::Slide(pair, way), state.drive))
        })
    }

    /// Whether the load turns the body about the vertex that stays so that all other contacts open, and whether the other contacts
    /// can hold it.
    fn pivots(&self, staying: &[Touch], hand: [f64; 3]) -> bool {
        let pin = self.scene.point(&self.pose, staying[0]);
        let moment = self.scene.applied_moment(&self.pose, hand, pin);
        let opens = |&touch: &Touch| {
            let arm = sub(self.scene.point(&self.pose, touch), pin);
            staying.contains(&touch)
                || sign(moment) * cross(arm, self.scene.normal(&self.pose, touch))
                    > STILL * self.size
        };
        self.contacts.iter().all(opens) && (staying.len() == 1 || self.carries(staying, hand))
    }

    /// Whether the two cones of a corner bear the applied force.
    fn carries(&self, pair: &[Touch], hand: [f64; 3]) -> bool {
        let pin = self.scene.point(&self.pose, pair[0]);
        let mut free_of_moment = self.clone();
        let turn = self.scene.applied_moment(&self.pose, hand, pin);
        let balanced = if self.scene.k_theta > 0.0 {
            hand[2] - turn / self.scene.k_theta
        } else {
            hand[2]
        };
        free_of_moment.contacts = pair.to_vec();
        free_of_moment.admissible(&self.pose, pair, [hand[0], hand[1], balanced])
    }
}
