//! The certified frame of two contacts among obstacles that slide with the hand, and their certified slip (STATICS 12.8): the loads on both
//! at the ends of a short displacement, and bounds of how these change, prove that nothing else happens.

use super::super::CertifiedSlide;
use super::super::slide::per_memory;
use super::way::{Pairing, Way};
use crate::contact::Pair;
use crate::grip::Grip;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::world::World;

/// The effect of friction on a short displacement.
struct Memory<R> {
    /// No reaction is larger.
    sizes: [R; 2],
    /// The contribution of a friction to (E6), and a velocity, change by no more than this.
    change: R,
    slows: R,
    /// The slide is nowhere less stable.
    stability: R,
}

impl<R: Real> Pairing<R> {
    /// The memory length of each contact, and |v_i·t_i|.
    fn slips(&self) -> impl Iterator<Item = (R, R)> {
        let memories =
            (self.twist.surfaces).map(|surface| surface.friction.memory() * per_memory::<R>());
        memories.into_iter().zip(self.twist.velocities.map(R::abs))
    }

    /// True if no slip that began on the path would be as long as the memory length (E14), or one that began here would be: such a slide
    /// goes on.
    fn goes_on(&self, memory: &Memory<R>, (here, standing): ([R; 2], R)) -> bool {
        let counted = |edge| edge * per_memory();
        let most = |worth: R| worth.abs() + memory.change;
        let jump = self.twist.jump(memory.sizes, counted, most);
        let begins = self.twist.jump(here, counted, |worth| worth);
        (self.slips())
            .all(|(length, speed)| (speed + memory.slows) * jump < length * memory.stability)
            || (self.slips()).any(|(length, speed)| speed * begins >= length * standing)
    }
}

/// The slide in a direction of the unit twist as the hand moves along a path, provided that nothing else can happen except a touch and the
/// end of a side.
pub(crate) fn certified_slide_among<R: Real, W: World<R>>(
    scene: &W,
    contacts: (&Pivot<R>, Pair),
    path: (&Grip<R>, &Grip<R>),
    direction: R,
) -> Option<CertifiedSlide<R>> {
    let way = Way::of(scene, contacts, path, direction)?;
    let Way {
        pairing,
        after,
        sizes,
        reach,
        ..
    } = &way;
    let (reach, spread) = (*reach, way.spread());
    // On the path the hand drives it on.
    let hand = way.displacement.hand.length_bound();
    let couple = after.stiffness * way.displacement.turn.abs();
    let edge = sizes.edge;
    let drive_falls = way.spread_falls * (sizes.lever * hand + couple)
        + (edge * spread * sizes.parts(sizes.lever)
            + edge * sizes.second_rate()
            + edge * edge * sizes.arm * sizes.turn)
            * hand
            * reach;
    if way.drive <= drive_falls {
        return None;
    }
    let begin = pairing.twist.sizes(after.force - way.displacement.hand);
    // The deviation of a reaction with the fraction of the displacement that is done and with the directions of both.
    let uneven = way.bend * way.newton + drive_falls / way.drive;
    let turns = edge * sizes.turn * reach + way.spread_falls / spread;
    let bent = edge * hand * (uneven + turns);
    let end = way.end()?;
    let ([b1, b2], [e1, e2]) = (begin, end.reactions);
    let [l1, l2] = [b1.max(e1), b2.max(e2)];
    let [o1, o2] = [l1, l2].map(|size| way.strays(size, bent) + end.last.doubled());
    let presses = b1.min(e1) > o1 && b2.min(e2) > o2;
    let memory = Memory {
        sizes: [l1 + o1, l2 + o2],
        change: way.worth_changes(),
        slows: way.slows,
        stability: way.least - way.least * (way.bend * reach),
    };
    let lasts = presses && pairing.goes_on(&memory, (begin, way.standing));
    lasts.then(|| way.to(end.pivot))
}

/// The slip in a direction of the unit twist at a frozen hand, provided that it ends in balance with both contacts pressed throughout,
/// except for a touch and the end of a side.
pub(crate) fn certified_slip<R: Real, W: World<R>>(
    scene: &W,
    contacts: (&Pivot<R>, Pair),
    grip: &Grip<R>,
    direction: R,
) -> Option<CertifiedSlide<R>> {
    let way = Way::of(scene, contacts, (grip, grip), direction)?;
    let (twist, sizes, reach) = (&way.pairing.twist, &way.sizes, way.reach);
    let [v1, v2] = twist.velocities;
    let [first, second] = twist.surfaces;
    // The excess of the drive over friction is taken up by a drag against both velocities: a multiple of this force.
    let drag = first.tangent * v1 + second.tangent * v2;
    let resistance = R::sum_of_products(twist.frictions[0], v1.abs(), twist.frictions[1], v2.abs());
    let excess = way.drive / resistance;
    // The most by which these change, with the velocities and the directions of both contacts.
    let speed = v1.abs() + v2.abs();
    let turns = sizes.turn * reach;
    let worth = way.worth_changes();
    let worths = twist.frictions[0].abs() + twist.frictions[1].abs();
    let resists = worths * way.slows + (speed + way.slows.doubled()) * worth;
    if resists.doubled() > resistance {
        return None;
    }
    let uneven = way.bend * way.least * reach * reach;
    let excess_strays = (uneven + excess * resists).doubled() / resistance;
    let drags = way.slows.doubled() + speed * turns;
    let of_drag = twist.sizes(drag);
    let begin = twist.sizes(way.after.force - drag * excess);
    let end = way.end()?;
    let presses = |begin: R, end_of: R, of_drag: R| {
        let across = sizes.edge * (drags + (speed + drags) * turns);
        let changes = (across + of_drag.abs() * way.spread_falls).doubled() / way.spread();
        let dragged = excess_strays * (of_drag.abs() + changes) + excess * changes;
        let size = begin.abs().max(end_of) + excess * of_drag.abs();
        begin.min(end_of) > way.strays(size, R::ZERO) + dragged + end.last.doubled()
    };
    let ([b1, b2], [e1, e2], [d1, d2]) = (begin, end.reactions, of_drag);
    (presses(b1, e1, d1) && presses(b2, e2, d2)).then(|| way.to(end.pivot))
}
