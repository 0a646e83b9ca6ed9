//! One vertex that slides, on a body that swings freely about the holding point (STATICS 3.7). The moment about that point is -N (A×f):
//! either the vertex bears nothing and the angle follows from the gap, or its lever lies on the edge of the friction cone.

use super::SingleVertex;
use super::segment::Segment;
use super::side_end::stop_at_end_of_slide;
use crate::balance_curve::Margin;
use crate::contact::Regime;
use crate::detect::PointPath;
use crate::friction::SlidingEdge;
use crate::geometry::Vec2;
use crate::grip::{Displacement, Grip};
use crate::load::Load;
use crate::moment::{Downhill, Drive, Moment, Pinned};
use crate::real::{Real, along};
use crate::search::Looks;
use crate::verb::{Moved, Trigger};
use crate::world::{Surface, World};

/// The lever of a body that swings and has a vertex that slides along sign·t.
pub(super) struct Swing<R> {
    surface: Surface<R>,
    edge: SlidingEdge<R>,
    sign: R,
    load: Load<R>,
    /// (A·t, A·n)
    lever: Vec2<R>,
    /// On which side of the foot the holding point is, along t: ±1.
    side: R,
}

impl<R: Real> Swing<R> {
    /// The lever of a load about a vertex that slides along sign·t of a surface, in components along t and n (L).
    pub(super) fn new(load: &Load<R>, surface: &Surface<R>, sign: R) -> Self {
        let lever = Vec2::new(
            surface.tangent.dot(load.lever),
            surface.normal.dot(load.lever),
        );
        Self {
            surface: *surface,
            edge: surface.sliding(sign),
            sign,
            load: *load,
            lever,
            side: lever.x.sign(),
        }
    }

    /// side (A×f): a slide that bears nothing is stable where it is positive.
    fn off(&self) -> R {
        along(self.side, self.load.lever.cross(self.edge.reaction))
    }

    /// The lever lies on the edge of the cone, pointing into the surface, or is too short to be distinguished from one that does. For a
    /// vertex that is pressed the lever has the direction of the force, which is known the less accurately the smaller the force is. The
    /// vertex still presses after a turn onto the edge, which changes N by no more than the distance of the lever from it.
    pub(super) fn bears(&self) -> bool {
        let rounding = self.load.rounding_with_foot();
        let (normal, _) = self.surface.reaction(self.load.force);
        let (found, off) = (SingleVertex::found_to(&self.load), self.off().abs());
        let is_along =
            normal > found.max(off) && off * normal <= found * self.load.lever.length_bound();
        (off <= rounding || is_along) && self.load.lever.dot(self.edge.reaction) <= rounding
    }

    /// The bearing lever points away from the surface: it immediately turns aside.
    pub(super) fn topples(&self) -> bool {
        let rounding = self.load.rounding_with_foot();
        !self.is_unloaded() && self.load.lever.dot(self.edge.reaction) > rounding
    }

    /// The turn that lays the lever on the edge of the cone, into the surface.
    fn lean(&self) -> R {
        let (edge, lever) = (-self.edge.reaction, self.load.lever);
        lever.cross(edge).atan2(lever.dot(edge))
    }

    /// N as a function of the turn, as a moment: -side (N + n·(R - 1)A).
    fn gap(&self) -> Moment<R, Pinned> {
        let (normal, _) = self.surface.reaction(self.load.force);
        let lever = Vec2::new(self.lever.x, -self.lever.y);
        Moment {
            couple: along(self.side, self.lever.y - normal),
            stiffness: R::ZERO,
            hold: Vec2::new(along(self.side, lever.x), along(self.side, lever.y)),
            harmonic: Pinned,
        }
    }

    /// The gap that a displacement closes, however the body has turned.
    fn drive(&self, displacement: &Displacement<R>) -> Drive<R> {
        Drive {
            couple: along(self.side, self.surface.normal.dot(displacement.hand)),
            hold: Vec2::ZERO,
        }
    }

    /// The rates of the foot along t and of the turn as the hand goes on; `None` if the lever is upright and bears nothing.
    pub(super) fn rates(&self, displacement: &Displacement<R>) -> Option<(R, R)> {
        let hand = displacement.hand;
        if self.bears() {
            return Some((self.edge.balanced.dot(hand) / self.edge.cos, R::ZERO));
        }
        (self.lever.x != R::ZERO).then(|| {
            let foot = self.load.lever.dot(hand) / self.lever.x;
            (foot, self.surface.normal.dot(hand) / self.lever.x)
        })
    }

    /// A quantity of first order in the lever, its component along a direction, from its present position on.
    fn along(&self, direction: Vec2<R>, sign: R) -> Margin<R> {
        let (start, turning) = (
            direction.dot(self.load.lever),
            direction.dot(self.load.lever.turned()),
        );
        Margin {
            start: along(sign, start),
            along: R::ZERO,
            turning: Vec2::new(along(sign, start), along(sign, turning)),
            rounding: R::rounding(self.load.lever.length_bound() * direction.length_bound())
                .doubled(),
        }
    }

    /// Positive until the lever reaches the edge of the cone.
    fn leans(&self) -> Margin<R> {
        self.along(self.edge.balanced, self.side)
    }

    /// Positive while the foot moves along sign·t.
    fn goes(&self, displacement: &Displacement<R>) -> Margin<R> {
        self.along(displacement.hand, along(self.side, self.sign))
    }

    /// Returns whether the vertex bears nothing but rounding.
    fn is_unloaded(&self) -> bool {
        let (normal, _) = self.surface.reaction(self.load.force);
        normal <= self.load.rounding_with_foot()
    }

    /// Returns whether a slide is in balance: the vertex bears nothing, or bears on the edge of the cone.
    pub(super) fn is_balanced(&self) -> bool {
        self.is_unloaded() || self.bears()
    }

    /// At a frozen hand, in a direction: to where the vertex bears nothing, or to where the lever bears on the edge of the cone.
    fn downhill(&self, direction: R) -> R {
        if self.is_unloaded() {
            return R::ZERO;
        }
        let (normal, _) = self.surface.reaction(self.load.force);
        let ahead = |turn: R| {
            let turn = along(direction, turn);
            if turn < R::ZERO { turn + R::TAU } else { turn }
        };
        let mut way = ahead(self.lean());
        // A·n where N is zero.
        let (length, level) = (self.lever.length(), self.lever.y - normal);
        if level > -length {
            let root = R::root_of_products(length - level, length + level, R::ZERO, R::ZERO);
            for across in [root, -root] {
                let to = Vec2::new(across, level);
                // t×n = 1: angles of (t, n) are those of the plane.
                way = way.min(ahead(self.lever.cross(to).atan2(self.lever.dot(to))));
            }
        }
        along(direction, way)
    }
}

impl<R: Real> SingleVertex<R> {
    /// A slide along sign·t.
    pub(super) fn swing(&self, scene: &impl World<R>, grip: &Grip<R>, sign: R) -> Swing<R> {
        let surface = self.pivot.surface(scene);
        Swing::new(&self.pivot.load(scene, grip), &surface, sign)
    }

    /// Slides along sign·t as the hand moves: to the first of touch, halt, lift-off and the place where its lever reaches the edge of the
    /// cone; one that bears on it to the first of touch, halt, lift-off, N = N*.
    pub(super) fn advance_swinging<W: World<R>>(
        &mut self,
        scene: &W,
        (from, to): (&Grip<R>, &Grip<R>),
        sign: R,
    ) -> Moved<R> {
        let swing = self.swing(scene, from, sign);
        let displacement = from.displacement_to(to);
        let moved = if swing.bears() {
            self.advance_leaning(scene, &swing, &displacement)
        } else {
            self.advance_unloaded(scene, &swing, &displacement)
        };
        let at = from.lerp(to, moved.part);
        if moved.trigger == Trigger::Balanced && !moved.unsure && !swing.bears() {
            let turn = self.swing(scene, to, sign).gap().polish();
            self.pivot = self.pivot.moved(R::ZERO, turn);
        }
        self.pivot.slide_on_side(scene, &at, &swing.edge);
        moved
    }

    /// It bears nothing, and the angle follows from the gap.
    fn advance_unloaded<W: World<R>>(
        &mut self,
        scene: &W,
        swing: &Swing<R>,
        displacement: &Displacement<R>,
    ) -> Moved<R> {
        if swing.surface.normal.dot(displacement.hand) > R::ZERO {
            // Nothing turns it: the hand lifts it off.
            return Moved {
                part: R::ZERO,
                ..Moved::by(Trigger::Clear)
            };
        }
        if displacement.hand == Vec2::ZERO {
            return Moved::by(Trigger::Balanced);
        }
        let goes = swing.goes(displacement);
        if !W::GLIDES && (swing.off() <= R::ZERO || goes.start < -goes.rounding) {
            return Moved {
                part: R::ZERO,
                ..Moved::by(Trigger::Halts)
            };
        }
        let drive = swing.drive(displacement);
        let mut segment = Segment::balanced(&swing.gap(), &drive, Trigger::Balanced);
        if W::SEVERAL {
            let foot = swing.load.foot(&swing.edge, displacement);
            let path = PointPath::of_foot(swing.surface.tangent, &foot, swing.edge.cos);
            segment.stop_at_touch(scene, &swing.load.placed, (&path, &self.contacts()));
            if W::CORNERS {
                let at = (&swing.load.placed, self.pivot.contact);
                let foot = (&foot, swing.edge.cos, swing.sign);
                stop_at_end_of_slide(scene, &mut segment, at, foot);
            }
        }
        segment.stop_at(&swing.leans(), Trigger::Bears);
        if !W::GLIDES {
            segment.stop_at(&goes, Trigger::Halts);
        }
        self.pivot = self.pivot.moved(R::ZERO, segment.turn());
        let mut moved = segment.moved();
        if let Trigger::Fold(_) = moved.trigger {
            // The lever is upright.
            moved.trigger = Trigger::Bears;
        }
        moved
    }

    /// The lever stays on the edge of the cone, and everything is linear.
    fn advance_leaning<W: World<R>>(
        &self,
        scene: &W,
        swing: &Swing<R>,
        displacement: &Displacement<R>,
    ) -> Moved<R> {
        let foot = swing.edge.balanced.dot(displacement.hand);
        if !W::GLIDES && along(swing.sign, foot) < -Self::slack(displacement) {
            return Moved {
                part: R::ZERO,
                ..Moved::by(Trigger::Halts)
            };
        }
        let mut segment = Segment::<R, Pinned>::straight(R::ONE, Trigger::Balanced);
        if W::SEVERAL {
            let shift = swing.surface.tangent * (foot / swing.edge.cos);
            let path = PointPath::straight(shift);
            segment.stop_at_touch(scene, &swing.load.placed, (&path, &self.contacts()));
            if W::CORNERS {
                let along = Margin {
                    start: R::ZERO,
                    along: foot,
                    turning: Vec2::ZERO,
                    rounding: R::ZERO,
                };
                let at = (&swing.load.placed, self.pivot.contact);
                let foot = (&along, swing.edge.cos, swing.sign);
                stop_at_end_of_slide(scene, &mut segment, at, foot);
            }
        }
        let normal = swing.load.reaction(swing.surface.normal, displacement);
        if let Some(loosens) = swing.surface.friction.loosens(normal)
            && !W::GLIDES
        {
            segment.stop_at(&loosens, Trigger::Pressed);
        }
        segment.stop_at(&normal, Trigger::Clear);
        segment.moved()
    }

    /// The lever has reached the edge of the cone: it bears from here on, and slides if the hand takes the foot along.
    pub(crate) fn bears(&mut self, scene: &impl World<R>, (at, to): (&Grip<R>, &Grip<R>)) {
        let sign = self.regime.slide().unwrap_or(R::ONE);
        let swing = self.swing(scene, at, sign);
        self.lean(scene, at, &swing);
        let foot = swing.edge.balanced.dot(at.displacement_to(to).hand);
        if along(sign, foot) <= R::ZERO {
            self.regime = Regime::LOOSE;
        }
    }

    /// True if the lever points away from the surface.
    pub(crate) fn stands(&self, scene: &impl World<R>, grip: &Grip<R>) -> bool {
        let sign = self.regime.slide().unwrap_or(R::ONE);
        let swing = self.swing(scene, grip, sign);
        swing.load.lever.dot(swing.edge.reaction) > R::ZERO
    }

    /// Lays the lever on the edge of the cone. For a vertex that is hardly pressed another vertex may not permit that turn: then it bears
    /// as it is.
    fn lean(&mut self, scene: &impl World<R>, grip: &Grip<R>, swing: &Swing<R>) {
        let begin = self.pivot;
        self.pivot = self.pivot.moved(R::ZERO, swing.lean());
        self.pivot.slide(scene, grip, &swing.edge);
        if self.is_inside(scene) {
            self.pivot = begin;
        }
    }

    /// The same if a slip or a stick has come to it, to the accuracy with which that is found.
    pub(crate) fn lean_on(&mut self, scene: &impl World<R>, grip: &Grip<R>, sign: R) {
        let swing = self.swing(scene, grip, sign);
        if swing.bears() && swing.lean().abs() < R::ONE {
            self.lean(scene, grip, &swing);
        }
    }

    /// True if a slide along sign·t bears on the edge of the cone.
    pub(crate) fn is_leaning(&self, scene: &impl World<R>, grip: &Grip<R>, sign: R) -> bool {
        self.swing(scene, grip, sign).bears()
    }

    /// True if a slide along sign·t is in balance.
    pub(crate) fn swings_in_balance(&self, scene: &impl World<R>, grip: &Grip<R>, sign: R) -> bool {
        self.swing(scene, grip, sign).is_balanced()
    }

    /// True if it slides and bears.
    pub(crate) fn leans(&self, scene: &impl World<R>, grip: &Grip<R>) -> bool {
        let slide = self.regime.slide();
        slide.is_some_and(|sign| self.is_leaning(scene, grip, sign))
    }

    /// If the vertex bears nothing: depending on whether (A·dp), which only grows, is positive, the foot moves to the side of the holding
    /// point or away from it; it sticks if a slide is not stable.
    pub(super) fn begin_swinging(&mut self, scene: &impl World<R>, (at, to): (&Grip<R>, &Grip<R>)) {
        self.regime = Regime::LOOSE;
        let hand = at.displacement_to(to).hand;
        if hand == Vec2::ZERO {
            return;
        }
        // A lever that is no longer than the rounding lies on both edges.
        let mut is_short = true;
        for sign in [R::ONE, -R::ONE] {
            let swing = self.swing(scene, at, sign);
            if !swing.bears() {
                is_short = false;
            } else if along(sign, swing.edge.balanced.dot(hand)) > R::ZERO {
                self.lean_on(scene, at, sign);
                self.regime = Regime::Slide(sign);
                return;
            }
        }
        let swing = self.swing(scene, at, R::ONE);
        let sign = along(swing.side, swing.load.lever.dot(hand).sign());
        let swing = self.swing(scene, at, sign);
        if !is_short && swing.off() > R::ZERO {
            self.regime = Regime::Slide(sign);
        }
    }

    /// Downhill at a frozen hand, in a direction or, without one, in the direction of the moment.
    pub(super) fn swing_down(
        &self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        (direction, sign): (Option<R>, R),
    ) -> Downhill<R> {
        let swing = self.swing(scene, grip, sign);
        let down = -swing.load.lever.cross(swing.edge.reaction).sign();
        Downhill {
            turn: swing.downhill(direction.unwrap_or(down)),
            snapped: direction.is_some(),
            unsure: false,
            looks: Looks::ALL,
        }
    }
}
