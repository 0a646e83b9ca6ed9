//! The certified frame of two contacts that slide with the hand (STATICS 5, (E15)): the hand moves along a short path, and both go on
//! sliding in balance. The loads at the ends of the hand's path on the body in its present pose prove that nothing else happens.

use super::on_edges;
use crate::contact::Pair;
use crate::detect::Placed;
use crate::geometry::Vec2;
use crate::grip::{Displacement, Grip};
use crate::load::Load;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::verb::seat_sliding;
use crate::world::{Surface, World};

/// The motion of two sliding contacts, at a point: its unit twist, and the contribution of a load to (E6) along it.
pub(super) struct Twist<R> {
    pub(super) surfaces: [Surface<R>; 2],
    /// The displacement of contact 1 along t_1, and the turn of the body.
    pub(super) slide: R,
    pub(super) turn: R,
    /// No |ds/dx| exceeds this.
    slide_bound: R,
    /// r = c_2 - c_1
    pub(super) arm: Vec2<R>,
    /// v_i·t_i
    pub(super) velocities: [R; 2],
    /// f_i: the directions of the two reactions.
    pub(super) reactions: [Vec2<R>; 2],
    /// f_1×f_2, r×f_2
    pub(super) spread: R,
    pub(super) second: R,
    /// The contribution to (E6) of a unit force against the slide of contact i, in the sense in which the slide falls.
    pub(super) frictions: [R; 2],
    /// The sign of (E6) where the load drives the slide.
    pub(super) sense: R,
}

/// Corrections of the position before a frame is left uncertified.
pub(super) const MAX_CORRECTIONS: usize = 4;

/// The change of the gap of contact 2 as the body slides along t_1 and turns about c_1.
pub(super) fn gradient<R: Real>([first, second]: &[Surface<R>; 2], arm: Vec2<R>) -> [R; 2] {
    [first.tangent, arm.turned()].map(|velocity| second.normal.dot(velocity))
}

impl<R: Real> Twist<R> {
    /// With a given sign of the unit twist; `None` if a contact hardly moves, or the reactions hardly span the plane.
    pub(super) fn of(
        scene: &impl World<R>,
        (pivot, other): (&Pivot<R>, Pair),
        direction: R,
    ) -> Option<Self> {
        let contacts = [pivot.contact, other];
        Self::at(scene, &pivot.placed(scene), (contacts, direction))
    }

    /// The same for a body that is placed by the first contact.
    pub(super) fn at(
        scene: &impl World<R>,
        placed: &Placed<R>,
        ([first, other], direction): ([Pair; 2], R),
    ) -> Option<Self> {
        let rotation = placed.orientation.rotation();
        let surfaces = [first, other].map(|contact| scene.face(contact, rotation));
        let [first, second] = surfaces;
        let arm = placed.arm_to(scene, other);
        let [by_slide, by_turn] = gradient(&surfaces, arm);
        let size = by_slide.hypot(by_turn);
        if size <= R::divisor() {
            return None;
        }
        let unit = direction / size;
        let (slide, turn) = (-by_turn * unit, by_slide * unit);
        let across = second.normal.dot(arm);
        let velocity = first.tangent * slide + arm.turned() * turn;
        let velocities = [slide, second.tangent.dot(velocity)];
        if velocities.iter().any(|v| v.abs() <= R::divisor()) {
            return None;
        }
        let signs = velocities.map(R::sign);
        let [s1, s2] = signs;
        let [f1, f2] = [(first, s1), (second, s2)]
            .map(|(surface, sign)| surface.direction(surface.friction.sliding_edge(sign)));
        let (spread, moment) = (f1.cross(f2), arm.cross(f2));
        // (E6) of a force along each tangent at its contact.
        let along = [
            -(moment * f1.cross(first.tangent)),
            arm.cross(second.tangent) * spread - moment * f1.cross(second.tangent),
        ];
        let [e1, e2] = along;
        let [v1, v2] = velocities;
        let resistance = R::sum_of_products(e1, v1, e2, v2);
        if spread.abs() <= R::divisor() || resistance.abs() <= R::divisor() {
            return None;
        }
        let sense = resistance.sign();
        Some(Self {
            surfaces,
            slide,
            turn,
            slide_bound: Vec2::new(by_turn, across).length_bound() / size,
            arm,
            velocities,
            reactions: [f1, f2],
            spread,
            second: moment,
            frictions: [e1 * s1 * sense, e2 * s2 * sense],
            sense,
        })
    }

    /// (E6) of a force and a moment, positive if they drive the slide.
    pub(super) fn drives(&self, force: Vec2<R>, moment: R) -> R {
        let [f1, _] = self.reactions;
        (self.spread * moment - self.second * f1.cross(force)) * self.sense
    }

    fn imbalance(&self, load: &Load<R>) -> R {
        self.drives(load.force, load.moment())
    }

    /// -dE/dx at the frozen hand, after the hand has moved back by `less`.
    fn stability(&self, scene: &impl World<R>, load: &Load<R>, less: Vec2<R>) -> R {
        let ([f1, f2], [first, _]) = (self.reactions, self.surfaces);
        let (pull, spring) = (load.force - less, load.spring - less);
        let force = -(first.tangent * self.slide + load.lever.turned() * self.turn);
        let moment = load.lever.cross(force)
            - (load.stiffness + load.lever.dot(spring) + load.centroid.dot(scene.weight()))
                * self.turn;
        let swing = self.arm.turned().cross(f2) * self.turn;
        let slope = self.spread * moment - swing * f1.cross(pull) - self.second * f1.cross(force);
        -slope * self.sense
    }

    /// The magnitudes of both reactions in balance.
    pub(super) fn sizes(&self, force: Vec2<R>) -> [R; 2] {
        let [f1, f2] = self.reactions;
        [-force.cross(f2), force.cross(f1)].map(|size| size / self.spread)
    }

    /// A bound of |dF/dx|.
    fn force_rate(&self, lever: R) -> R {
        self.slide_bound + self.turn.abs() * lever
    }

    /// A bound of |d²E/dx²| while the force is no larger than this.
    fn curvature(&self, scene: &impl World<R>, load: &Load<R>, force: R) -> R {
        let [lever, arm, centroid] = [load.lever, self.arm, load.centroid].map(Vec2::length_bound);
        let turn = self.turn.abs();
        let force_rate = self.force_rate(lever);
        let force_bend = turn * force_rate;
        let falls = centroid * scene.weight().length_bound();
        let moment = turn * (turn * (lever * force + falls) + (lever * force_rate).doubled())
            + lever * force_bend;
        let second = turn * (turn * (arm * force) + (arm * force_rate).doubled());
        self.spread.abs() * moment + second + arm * force_bend
    }

    /// The most by which the velocity of a contact changes over a distance.
    fn slows(&self, reach: R) -> R {
        let turn = self.turn.abs();
        turn * (self.slide_bound + turn * self.arm.length_bound()) * reach
    }

    /// True if no slip that began within a distance would be as long as the memory length (E14). `sizes`: no reaction is larger;
    /// `stability`: the slide is nowhere less stable.
    fn forgets(&self, sizes: [R; 2], reach: R, stability: R) -> bool {
        let swings = (self.turn.abs() * self.arm.length_bound() * reach).doubled();
        let jump = self.jump(sizes, |edge| edge, |worth| worth.abs() + swings);
        let slows = self.slows(reach);
        self.slips()
            .all(|(memory, speed)| (speed + slows) * jump < memory * stability)
    }

    /// True if a slip that began here would be as long as the memory length of a contact (E14).
    fn is_pressed(&self, sizes: [R; 2], stability: R) -> bool {
        let jump = self.jump(sizes, |edge| edge, |worth| worth);
        self.slips()
            .any(|(memory, speed)| speed * jump >= memory * stability)
    }

    /// The remainder of (E6) if the static cones bear the load. `counted` scales the edges; `worth` maps the contributions of the
    /// frictions, for an upper bound without their signs.
    pub(super) fn jump(
        &self,
        sizes: [R; 2],
        counted: impl Fn(R) -> R,
        worth: impl Fn(R) -> R,
    ) -> R {
        let frictions = self.surfaces.map(|surface| surface.friction);
        let jumps = frictions.iter().zip(sizes).zip(self.frictions);
        jumps.fold(R::ZERO, |sum, ((friction, size), of)| {
            let (normal, _) = friction.sliding_edge(R::ZERO);
            sum + counted(friction.drop() * normal) * size * worth(of)
        })
    }

    /// The memory length of each contact, and |v_i·t_i|.
    fn slips(&self) -> impl Iterator<Item = (R, R)> {
        let memories = self.surfaces.map(|surface| surface.friction.memory());
        let speeds = self.velocities.map(R::abs);
        memories.into_iter().zip(speeds)
    }
}

/// The loads on both contacts, and the signs of their velocities, if the force alone determines them to the last digit.
pub(super) fn sliding_reactions<R: Real>(
    scene: &impl World<R>,
    contacts: (&Pivot<R>, Pair),
    force: Vec2<R>,
    direction: R,
) -> Option<([[R; 2]; 2], [R; 2])> {
    let twist = Twist::of(scene, contacts, direction)?;
    let signs = twist.velocities.map(R::sign);
    let reactions = || on_edges((&twist.surfaces, signs), twist.sizes(force));
    (twist.spread.abs() > R::spread()).then(|| (reactions(), signs))
}

/// A certified slide.
pub(crate) struct CertifiedSlide<R> {
    pub(crate) pivot: Pivot<R>,
    /// No point of the body moves farther.
    pub(crate) travel_bound: R,
    /// The body turns by no more.
    pub(crate) turn_bound: R,
}

/// The slide in a sense of the unit twist as the hand moves along a path, provided that nothing else can happen except a touch.
pub(crate) fn certified_slide<R: Real>(
    scene: &impl World<R>,
    contacts: (&Pivot<R>, Pair),
    (from, to): (&Grip<R>, &Grip<R>),
    direction: R,
) -> Option<CertifiedSlide<R>> {
    let (pivot, other) = contacts;
    let mut twist = Twist::of(scene, contacts, direction)?;
    let after = pivot.load(scene, to);
    if !after.is_representable() {
        return None;
    }
    let Displacement { hand, .. } = from.displacement_to(to);
    let [standing, stability] = [hand, Vec2::ZERO].map(|less| twist.stability(scene, &after, less));
    let least = standing.min(stability);
    let drive = twist.imbalance(&after);
    if least <= R::divisor() || drive < R::ZERO {
        return None;
    }
    // (E15): there is one balance within reach for every fraction of the path.
    let newton = drive / least;
    let reach = newton + newton.halved().halved();
    let lever = after.lever.length_bound();
    let force_rate = twist.force_rate(lever);
    let before = after.force - hand;
    let pull = (after.force.length_bound()).max(after.spring.length_bound());
    let force = pull + hand.length_bound() + force_rate * reach;
    let bend = twist.curvature(scene, &after, force) / least;
    if bend * newton > R::HALF.halved() {
        return None;
    }
    // On the path the hand drives it on, and both press and go on.
    let swings = twist.turn.abs() * reach;
    let drive_falls = swings * hand.length_bound() * (lever + twist.arm.length_bound());
    let stray = force_rate * reach / twist.spread.abs() + after.rounding();
    let [[b1, b2], [a1, a2]] = [before, after.force].map(|force| twist.sizes(force));
    let presses = b1.min(a1) > stray && b2.min(a2) > stray;
    let slows = twist.slows(reach);
    let goes_on = twist.velocities.iter().all(|v| v.abs() > slows);
    let sizes = [b1.max(a1) + stray, b2.max(a2) + stray];
    // A slide goes on if a slip would be as long as the memory length from its beginning.
    let forgets = || {
        twist.forgets(sizes, reach, least - least * (bend * reach))
            || twist.is_pressed([b1, b2], standing)
    };
    if drive <= drive_falls || !presses || !goes_on || !forgets() {
        return None;
    }
    // No point of the body is farther from contact 1 than one body size.
    let travel_bound = (twist.slide_bound + twist.turn.abs()) * reach;
    let mut end = *pivot;
    let mut step = drive / stability;
    for _ in 0..MAX_CORRECTIONS {
        let moved = end.moved(twist.slide * step, twist.turn * step);
        end = seat_sliding(scene, moved, other);
        // The residual of a Newton step.
        if (bend * step * step).halved() <= R::EPSILON {
            return Some(CertifiedSlide {
                pivot: end,
                travel_bound,
                turn_bound: swings,
            });
        }
        twist = Twist::of(scene, (&end, other), direction)?;
        let load = end.load(scene, to);
        step = twist.imbalance(&load) / twist.stability(scene, &load, Vec2::ZERO);
    }
    None
}
