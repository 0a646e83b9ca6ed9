//! The slip of a body with two vertices on two surfaces: one degree of freedom, the unit twist of slide along t1 and
//! turn, regular for parallel surfaces too (STATICS 5, 10). Frictions oppose the velocities of the vertices.

use crate::balance_curve::{BalanceCurve, Extent};
use crate::bounded::{Bounded, Bounds, Sloped};
use crate::contact::Pair;
use crate::detect::{Moving, PointPath};
use crate::geometry::Vec2;
use crate::grip::Grip;
use crate::load::Load;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::search::{Found, Looks, Samples, first_zero};
use crate::thresholds::Thresholds;
use crate::world::{Surface, World};

mod certified;
mod course;
mod kinematics;
mod slide;

use kinematics::Quantities;

pub(crate) use certified::{CertifiedSlide, certified_slide};
pub(crate) use course::{Course, SPOT, certified_slide_among, certified_slip};
pub(crate) use slide::{LOOK as SPOT_LOOK, MOST_OF_SLIDE, SLIDE, SlideEnding, Slides};

/// The cost of evaluating the motion of two slipping contacts, in evaluations of the motion of one; and of beginning a run of it.
const LOOK: u32 = 7;
pub(crate) const RUN: u32 = 32;

/// The maximum number of evaluations of a motion of two contacts: it continues with new ones from where they lead.
const MOST_LOOKS: u8 = 12;

/// The evaluations for a touch on such a motion.
const MOST_FOR_TOUCH: u8 = 32;

/// The maximum cost of a run without its own evaluations, in units of work.
pub(crate) const MOST_OF_RUN: u32 =
    RUN + LOOK * MOST_LOOKS as u32 + MOST_FOR_TOUCH as u32 + Looks::MOST_BESIDE as u32;

/// One direction of the trammel motion, from the present position, everything about contact 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trammel<R> {
    sense: Sense<R>,
    surfaces: [Surface<R>; 2],
    load: Load<R>,
    /// r = c2 - c1
    arm: Vec2<R>,
    weight: Vec2<R>,
    /// 1 over the magnitude of the load: the unit of forces and moments.
    per_load: R,
}

/// What depends on the direction of a trammel motion.
#[derive(Clone, Copy, Debug)]
struct Sense<R> {
    /// The sign of the unit twist.
    direction: R,
    curve: BalanceCurve<R>,
    /// Signs of the velocities of the two contacts along their tangents; 0 if a contact rests.
    signs: [R; 2],
    /// f_i: the directions of the two reactions.
    reactions: [Vec2<R>; 2],
    /// The excess of drive over friction, and its rounding.
    excess: R,
    rounding: R,
    /// The determinant that scales the excess and the reactions.
    resistance: R,
}

/// What is demanded of the reactions of a trammel motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Demand {
    /// Both press; one that vanishes opens.
    Pressed,
    /// Examined at balance only, where no opening is consistent before.
    AtTheEnd,
}

/// The extent of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run<R> {
    /// The displacement along t1.
    pub(crate) slide: R,
    pub(crate) turn: R,
    pub(crate) unsure: bool,
    /// Its cost, in units of work.
    pub(crate) work: u32,
}

/// What ended a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Ending<R> {
    /// (E6)
    Stopped,
    /// (E6), with both contacts certainly pressed.
    Rests,
    /// The reaction of one contact fell to zero; contact `lasts` slides on along sign·t.
    Opens { lasts: usize, sliding: R },
    /// Another vertex reached a surface.
    Touches(Pair),
    /// A contact reaches the turning point of its motion.
    Reverses,
    /// Contact number `contact`, which slides along sign·t, has left its side.
    Off { contact: usize, sign: R },
    /// The end of the range in which the bounds hold.
    Window,
}

/// The velocities of both contacts along their tangents, and their rates of change.
type Turning<R> = [Sloped<R>; 2];

impl<R: Real> Sense<R> {
    /// Along a motion whose friction is not known yet.
    fn along(curve: BalanceCurve<R>, direction: R) -> Self {
        Self {
            direction,
            curve,
            signs: [R::ZERO; 2],
            reactions: [Vec2::ZERO; 2],
            excess: R::ZERO,
            rounding: R::ZERO,
            resistance: R::ZERO,
        }
    }
}

impl<R: Real> Trammel<R> {
    /// The direction in which the hand drives a body with a pivot and another contact, if any.
    pub(crate) fn driven(
        scene: &impl World<R>,
        (pivot, other): (&Pivot<R>, Pair),
        grip: &Grip<R>,
        demand: Demand,
    ) -> Option<Self> {
        Self::driven_in(scene, (pivot, other), grip, (&[R::ONE, -R::ONE], demand))
    }

    /// The one of several directions in which the hand drives it most strongly, if any.
    pub(crate) fn driven_in<W: World<R>>(
        scene: &W,
        contacts: (&Pivot<R>, Pair),
        grip: &Grip<R>,
        (directions, demand): (&[R], Demand),
    ) -> Option<Self> {
        let mut trammel = Self::at(scene, contacts, grip);
        let mut best: Option<Sense<R>> = None;
        for &direction in directions {
            trammel.sense = trammel.turned_to(direction);
            let excess = best.map_or(R::LEAST, |sense| sense.excess);
            let meets_friction = trammel.meets_friction((scene, contacts, grip), demand);
            if meets_friction && trammel.sense.excess > excess {
                best = Some(trammel.sense);
            }
        }
        best.map(|sense| Self { sense, ..trammel })
    }

    /// In a direction, driven or not. Compiled once per image.
    #[inline(never)]
    pub(crate) fn in_sense(
        scene: &impl World<R>,
        contacts: (&Pivot<R>, Pair),
        grip: &Grip<R>,
        direction: R,
    ) -> Self {
        let mut trammel = Self::at(scene, contacts, grip);
        trammel.sense = trammel.turned_to(direction);
        trammel.meets_friction((scene, contacts, grip), Demand::AtTheEnd);
        trammel
    }

    /// At a pose, without a motion yet.
    fn at(scene: &impl World<R>, (pivot, other): (&Pivot<R>, Pair), grip: &Grip<R>) -> Self {
        let placed = pivot.placed(scene);
        let load = Load::new(scene, placed, grip);
        let size =
            load.force.length_bound() + load.lever.length_bound() + scene.weight().length_bound();
        Self {
            sense: Sense::along(BalanceCurve::straight(), R::ONE),
            surfaces: [
                pivot.surface(scene),
                scene.face(other, placed.orientation.rotation()),
            ],
            load,
            arm: placed.arm_to(scene, other),
            weight: scene.weight(),
            per_load: R::ONE / (size + load.couple.abs() + load.stiffness),
        }
    }

    fn turned_to(&self, direction: R) -> Sense<R> {
        let curve = Self::curve(&self.surfaces, self.arm, direction);
        Sense::along(curve, direction)
    }

    /// The sign of (E6) if the load drives the motion, and its rounding.
    pub(crate) fn falls(&self) -> (R, R) {
        (self.sense.resistance.sign(), self.sense.rounding)
    }

    /// The sign of the unit twist.
    pub(crate) fn direction(&self) -> R {
        self.sense.direction
    }

    /// The signs of the velocities of both contacts along their tangents; 0 if one rests.
    pub(crate) fn signs(&self) -> [R; 2] {
        self.sense.signs
    }

    /// Returns whether neither reaction pulls by more than its rounding.
    pub(crate) fn presses_both(&self) -> bool {
        let found: Quantities<R> = self.quantities(&self.sense.curve.at(R::ZERO), R::ONE);
        let sign = self.sense.resistance.sign();
        let mut pressing = found.normals.into_iter().map(|n| n * sign);
        pressing.all(|n| n >= -R::of_searches(self.sense.rounding))
    }

    /// Returns whether the moment about contact 1 presses contact 2, whose reaction is on the edge of its dynamic cone.
    pub(crate) fn moment_presses(&self) -> bool {
        let [_, second] = self.sense.reactions;
        let moment = self.load.moment();
        let lever = self.arm.cross(second);
        moment > R::ZERO && lever < R::ZERO || moment < R::ZERO && lever > R::ZERO
    }

    /// The reactions (N, T) of both contacts in balance, each on an edge of its dynamic cone: from the force alone if that determines them
    /// better than force and moment together.
    pub(crate) fn reactions(&self) -> [[R; 2]; 2] {
        let [f1, f2] = self.sense.reactions;
        let spread = f1.cross(f2);
        if spread.abs() > R::spread().min((self.sense.resistance * self.per_load).abs()) {
            // Reactions that balance the force do so to the last digit.
            let force = self.load.force;
            let sizes = [-force.cross(f2) / spread, force.cross(f1) / spread];
            return on_edges((&self.surfaces, self.sense.signs), sizes);
        }
        let found: Quantities<R> = self.quantities(&self.sense.curve.at(R::ZERO), R::ONE);
        let per = found.resistance * self.per_load;
        let sizes = found.normals.map(|size| size / per);
        on_edges((&self.surfaces, self.sense.signs), sizes)
    }

    /// The slide along t1 and the turn, per unit of the motion.
    pub(super) fn twist(&self) -> (R, R) {
        let start = self.sense.curve.at(R::ZERO);
        let curve = &self.sense.curve;
        (curve.part_velocity_as(&start), curve.rate_as())
    }

    /// n2·(s t1 + (R(ϑ) - 1) r) = 0 solved for the slide s of contact 1, both divided by the length of the twist.
    fn curve(surfaces: &[Surface<R>; 2], arm: Vec2<R>, sense: R) -> BalanceCurve<R> {
        let [first, second] = surfaces;
        let by_slide = second.normal.dot(first.tangent);
        let by_turn = second.normal.dot(arm.turned());
        let size = by_slide.hypot(by_turn);
        if size <= R::standstill() {
            // Wedged straight across parallel surfaces: it slides without a turn. A turn would open the gap.
            return BalanceCurve::kinematic(R::ZERO, Vec2::new(sense, R::ZERO));
        }
        // Across almost collinear surfaces the path bends sharply: longer units keep it within what the number type represents.
        let across = second.normal.dot(arm);
        let size = if by_slide == R::ZERO {
            size
        } else {
            size.max(across.abs() / R::LOAD.doubled())
        };
        BalanceCurve::kinematic(
            sense * by_slide / size,
            Vec2::new(-by_turn, across).over(size) * sense,
        )
    }

    /// Computes the directions of friction; returns true if the hand drives the motion: [w1 w2 -sum v_i w_ti] (N1, N2, delta) = -w_hand has
    /// a solution with delta > 0 and N_i >= 0.
    fn meets_friction<W: World<R>>(
        &mut self,
        (scene, contacts, grip): (&W, (&Pivot<R>, Pair), &Grip<R>),
        demand: Demand,
    ) -> bool {
        let start = self.sense.curve.at(R::ZERO);
        let standstill = R::standstill();
        let velocities: [R; 2] = self.velocities(&start);
        let mut ahead = velocities;
        if velocities.iter().any(|v| v.abs() <= standstill) {
            // A contact at the turning point of its motion is about to continue in the opposite direction.
            let turning: Turning<R> = if W::CORNERS {
                Course::of(scene, contacts, grip, self).turning()
            } else {
                self.velocities(&start)
            };
            for (ahead, v) in ahead.iter_mut().zip(turning) {
                if v.value.abs() <= standstill {
                    *ahead = v.slope;
                }
            }
        }
        self.sense.signs = ahead.map(|v| {
            if v.abs() > standstill {
                v.sign()
            } else {
                R::ZERO
            }
        });
        let [(first, s1), (second, s2)] = [
            (self.surfaces[0], self.sense.signs[0]),
            (self.surfaces[1], self.sense.signs[1]),
        ];
        self.sense.reactions = [(first, s1), (second, s2)]
            .map(|(surface, sign)| surface.direction(surface.friction.sliding_edge(sign)));
        let found: Quantities<R> = self.quantities(&start, R::ONE);
        self.sense.resistance = found.resistance;
        let [first, second] = self.sense.reactions;
        // In this unit, the size of the facet's normal, the excess is the quantity that the test of the contacts uses.
        let facet = first.cross(second).hypot(self.arm.cross(second));
        let resolved = R::of_sums(facet);
        let rounding = (self.load.rounding() * self.per_load * facet).max(resolved);
        let [n1, n2] = found.normals.map(|n| n * self.sense.resistance.sign());
        self.sense.excess = found.imbalance * self.sense.resistance.sign();
        self.sense.rounding = rounding;
        let pressed = n1 >= -rounding && n2 >= -rounding;
        self.sense.resistance.abs() > standstill
            && self.sense.excess > rounding
            && (pressed || demand == Demand::AtTheEnd)
    }

    /// At a fold of (E6), where it and its slope are zero: it grows with the curvature ahead up to here.
    pub(crate) fn clear_of_fold(&self) -> R {
        let p = self.sense.curve.at(R::ZERO);
        let curved: Bounded<R> = self.imbalance_slope(&p, R::ONE);
        let ahead = curved.slope * self.sense.resistance.sign();
        let [.., bent] = curved.bounds.suprema;
        if ahead > R::ZERO {
            (R::ONE + R::HALF) * ahead / bent.max(ahead)
        } else {
            R::ZERO
        }
    }

    /// Runs to the first ending, where a balance before `clear` does not count; `lasting`: the two contacts.
    pub(crate) fn run(
        &self,
        scene: &impl World<R>,
        lasting: &[Pair],
        (clear, demand): (R, Demand),
    ) -> (Run<R>, Ending<R>) {
        let sense = self.sense.resistance.sign();
        let window = R::ONE;
        let begin: Quantities<Bounded<R>> = self.quantities(&self.sense.curve.at(R::ZERO), window);
        let [of_n1, of_n2] = begin.normals.map(|normal| normal.bounds);
        let [of_v1, of_v2] = begin.velocities.map(|velocity| velocity.bounds);
        let mut of_balance = begin.imbalance.bounds;
        // Its drive is not zero to the search, whatever its bound.
        of_balance.error = of_balance.error.min(self.sense.rounding);
        // A contact that has just turned back does not turn again within a window.
        let ([v1, v2], [s1, s2]) = (begin.velocities, self.sense.signs);
        let [turns1, turns2] = [(v1, s1), (v2, s2)]
            .map(|(v, sign)| sign != R::ZERO && v.value.abs() > R::standstill());
        let presses = demand == Demand::Pressed;
        let mut looks = Looks::at_most(MOST_LOOKS);
        let found = first_zero(window, &mut looks, |x| {
            let q: Quantities<Sloped<R>> = self.quantities(&self.sense.curve.at(x), window);
            let look = |is_asked: bool, of: Sloped<R>, sign: R, bounds: &Bounds<R>| {
                is_asked.then(|| of.as_slope(sign, bounds))
            };
            let ([n1, n2], [v1, v2]) = (q.normals, q.velocities);
            Samples {
                functions: [
                    look(x >= clear, q.imbalance, sense, &of_balance),
                    look(presses, n1, sense, &of_n1),
                    look(presses, n2, sense, &of_n2),
                    look(turns1, v1, s1, &of_v1),
                    look(turns2, v2, s2, &of_v2),
                ],
                window: if x < clear { clear - x } else { R::HUGE },
            }
        });
        let (x, mut ending, is_unsure) = match found {
            Found::Nothing { .. } => (window, Ending::Window, false),
            Found::Zero { x, which } => (x, self.ending(which), false),
            // Nothing has ended it so far: it goes on from there.
            Found::Unsure { x, .. } => (x, Ending::Window, true),
        };
        let mut extent = Extent {
            unsure: is_unsure,
            looks: Looks::at_most(MOST_FOR_TOUCH),
            ..self.sense.curve.extent_to(x)
        };
        let moving = Moving {
            curve: &self.sense.curve,
            path: &PointPath::straight(self.surfaces[0].tangent),
            lasting,
            left: &[],
        };
        if let Some(pair) = self.load.placed.first_touch(scene, &mut extent, &moving) {
            ending = Ending::Touches(pair);
        }
        let run = Run {
            slide: extent.part(),
            turn: extent.end.turn,
            // A run that reaches the end of its bounds goes on from there.
            unsure: extent.unsure && (ending != Ending::Window || extent.end.x == R::ZERO),
            work: RUN
                .saturating_add(looks.taken().saturating_mul(LOOK))
                .saturating_add(extent.looks.taken()),
        };
        (run, ending)
    }

    /// The ending of a run for the function that became zero: (E6), N_1, N_2, or a velocity.
    fn ending(&self, which: usize) -> Ending<R> {
        match which {
            0 => Ending::Stopped,
            1 => Ending::Opens {
                lasts: 1,
                sliding: self.sense.signs[1],
            },
            2 => Ending::Opens {
                lasts: 0,
                sliding: self.sense.signs[0],
            },
            _ => Ending::Reverses,
        }
    }
}

/// The reactions (N, T) of two contacts that slide in balance in a direction of the unit twist, and the signs of their velocities.
pub(crate) fn sliding_reactions<R: Real>(
    scene: &impl World<R>,
    contacts: (&Pivot<R>, Pair),
    (grip, load): (&Grip<R>, &Load<R>),
    direction: R,
) -> ([[R; 2]; 2], [R; 2]) {
    if let Some(found) = certified::sliding_reactions(scene, contacts, load.force, direction) {
        return found;
    }
    let trammel = Trammel::in_sense(scene, contacts, grip, direction);
    (trammel.reactions(), trammel.signs())
}

/// (N, T) of sliding contacts from the components of their reactions along the edges of the dynamic cones.
fn on_edges<R: Real>((surfaces, signs): (&[Surface<R>; 2], [R; 2]), sizes: [R; 2]) -> [[R; 2]; 2] {
    let ([first, second], [s1, s2], [size1, size2]) = (surfaces, signs, sizes);
    [(first, s1, size1), (second, s2, size2)].map(|(surface, sign, size)| {
        let (n, t) = surface.friction.sliding_edge(sign);
        let size = size.max(R::ZERO);
        [size * n, size * t]
    })
}

#[cfg(test)]
mod tests;
