//! A corner of an obstacle on a side of the body (STATICS 12.2): how a single contact at a corner differs from a vertex on a surface. Where
//! it sticks the body turns about the corner as about a vertex, but the normal turns with it. A slip is that of a vertex with body and
//! world exchanged. A slide with the hand has a balance that is quadratic in the displacement, and is followed in pieces.

use super::SingleVertex;
use super::segment::Segment;
use super::side_end::{room_ahead, stop_at_end};
use super::single_vertex::Travel;
use crate::balance_curve::Margin;
use crate::bounded::Sloped;
use crate::contact::Pair;
use crate::detect::{Among, Known, PointPath, Reached, Watch, first_reached};
use crate::falls::{Level, MOST_FALLS, first_fall};
use crate::friction::SlidingEdge;
use crate::geometry::Vec2;
use crate::grip::{Displacement, Grip};
use crate::load::Load;
use crate::moment::{Drive, Pinned};
use crate::motion::Instant;
use crate::pivot::Pivot;
use crate::real::{Real, along};
use crate::search::Found;
use crate::thresholds::Thresholds;
use crate::verb::{Moved, Trigger};
use crate::work::Work;
use crate::world::World;

/// The cost of evaluating a point of a slide, in units of work.
pub(crate) const CORNER_LOOK: u32 = 9;

/// Corrections of a point of a slide.
const MAX_CORRECTIONS: usize = 6;

/// The maximum number of times that a piece of a slide is shortened.
pub(crate) const MAX_HALVINGS: usize = 12;

/// A piece whose end is not found is searched again, shorter; at most this many times in all.
pub(crate) const MOST_OF_PIECES: u32 = 2;

/// The initial rates of a slide of a corner, per unit of a displacement of the hand.
pub(super) struct SlideRates<R> {
    /// -dM/dtheta, with the foot in balance.
    pub(super) stability: R,
    /// dM/dtau
    drive: R,
    /// The rate of the foot along t: with the turn, and with the hand.
    foot_by_turn: R,
    foot_by_hand: R,
    /// M
    moment: R,
}

impl<R: Real> SlideRates<R> {
    /// The rates of the foot along t, and of the turn.
    pub(super) fn rates(&self) -> Option<(R, R)> {
        (self.stability > R::ZERO).then(|| {
            let turn = self.drive / self.stability;
            (self.foot_by_hand + self.foot_by_turn * turn, turn)
        })
    }
}

/// A slide of a corner along sign·t, from where the body is in balance, along a curve of turn and fraction of the hand's displacement.
struct CornerSlide<'a, R, W> {
    scene: &'a W,
    pivot: Pivot<R>,
    path: (&'a Grip<R>, &'a Grip<R>),
    sign: R,
    /// The direction in which it begins: turn and fraction, of length 1.
    ahead: (R, R),
    /// The slope of the moment there across that direction.
    steepness: R,
    /// Axes along which the body was last separated from obstacles.
    watch: Watch,
}

/// A point of it.
struct Spot<R> {
    pivot: Pivot<R>,
    rates: SlideRates<R>,
    part: R,
    /// Rates of turn, fraction and foot along the curve.
    turn_rate: R,
    part_rate: R,
    foot_rate: R,
}

impl<R: Real, W: World<R>> CornerSlide<'_, R, W> {
    /// At a turn and a fraction, with the foot in balance.
    fn at(&self, (turn, part): (R, R)) -> Spot<R> {
        let (from, to) = self.path;
        let grip = from.lerp(to, part);
        let mut pivot = self.pivot.moved(R::ZERO, turn);
        let edge = pivot.surface(self.scene).sliding(self.sign);
        pivot.slide(self.scene, &grip, &edge);
        let load = pivot.load(self.scene, &grip);
        let rates = slide_rates(
            self.scene,
            (&load, &pivot),
            &edge,
            &from.displacement_to(to),
        );
        Spot {
            pivot,
            rates,
            part,
            turn_rate: R::ZERO,
            part_rate: R::ZERO,
            foot_rate: R::ZERO,
        }
    }

    /// The slope of the moment across the direction ahead: steepest at the beginning, zero where the curve has turned by a right angle.
    fn falls(&self, spot: &Spot<R>) -> R {
        let (a, b) = self.ahead;
        spot.rates.stability * b + spot.rates.drive * a
    }

    /// At a point of the curve: this far ahead, and in balance.
    fn along(&self, x: R) -> Spot<R> {
        let (a, b) = self.ahead;
        let mut aside = R::ZERO;
        let mut spot = self.at((a * x, b * x));
        for _ in 0..MAX_CORRECTIONS {
            let falls = self.falls(&spot);
            if falls <= R::EPSILON {
                break;
            }
            // The curve is no farther to the side than ahead.
            let step = (spot.rates.moment / falls).max(-x).min(x);
            aside = aside - step;
            spot = self.at((a * x - b * aside, b * x + a * aside));
            if step.abs() <= R::EPSILON {
                break;
            }
        }
        let rates = &spot.rates;
        let falls = self.falls(&spot).max(R::EPSILON);
        let aside_rate = (rates.stability * a - rates.drive * b) / falls;
        spot.turn_rate = a - b * aside_rate;
        spot.part_rate = b + a * aside_rate;
        spot.foot_rate = rates.foot_by_turn * spot.turn_rate + rates.foot_by_hand * spot.part_rate;
        spot
    }

    fn instant(&self, spot: &Spot<R>) -> Instant<R> {
        let tangent = spot.pivot.surface(self.scene).tangent;
        Instant {
            placed: spot.pivot.placed(self.scene),
            velocity: tangent * spot.foot_rate,
            turn: spot.turn_rate,
        }
    }

    /// The possible ends: N = 0, the end of the side, N*, a halt, a fold, the end of the displacement.
    fn ends(&self, spot: &Spot<R>) -> [Option<Level<R>>; 6] {
        let (from, to) = self.path;
        let displacement = from.displacement_to(to);
        let body = self.instant(spot);
        let hand = from.lerp(to, spot.part).hand;
        let force = body.force(
            self.scene,
            from.holding_point,
            (hand, displacement.hand * spot.part_rate),
        );
        let contact = spot.pivot.contact;
        let bears = body.bears(self.scene, contact, force);
        let rounding = R::of_sums(force.0.length_bound() + R::ONE);
        let coulomb = self.scene.surface(contact.surface).friction;
        let slack = SingleVertex::<R>::slack(&displacement);
        let advances = along(self.sign, spot.foot_rate) + slack * spot.part_rate.abs();
        let steady = |value: R| Level {
            value,
            slope: R::ZERO,
            rounding: R::EPSILON,
        };
        let loosens = Sloped {
            value: coulomb.threshold() - bears.normal.value,
            slope: -bears.normal.slope,
        };
        [
            Some(Level::new(bears.normal, rounding)),
            Some(room_ahead(self.scene, &body, (contact, self.sign))),
            (coulomb.threshold() < R::HUGE).then(|| Level::new(loosens, rounding)),
            Some(steady(advances)),
            Some(steady(spot.part_rate)),
            Some(Level {
                value: R::ONE - spot.part,
                slope: -spot.part_rate,
                rounding: R::EPSILON,
            }),
        ]
    }

    /// Returns whether a point of the curve is in balance, to the accuracy of a search, and the curve has turned by less than 60 degrees.
    fn finds(&self, x: R) -> bool {
        let (from, to) = self.path;
        let spot = self.along(x);
        let load = spot.pivot.load(self.scene, &from.lerp(to, spot.part));
        spot.rates.moment.abs() <= SingleVertex::found_to(&load)
            && self.falls(&spot).doubled() > self.steepness
    }

    /// Follows the curve to a point or to an earlier event: how far, why, and whether a search got no farther; and the cost, in units of
    /// work.
    fn piece(&self, contacts: &[Pair], end: R) -> ((R, Trigger<R>, bool), u32) {
        let mut work = 0_u32;
        let found = first_fall((end, end), MOST_FALLS, |x| {
            work = work.saturating_add(CORNER_LOOK);
            self.ends(&self.along(x))
        });
        let (x, which, unsure) = match found {
            Found::Nothing { .. } => (end, None, false),
            Found::Zero { x, which } => (x, Some(which), false),
            Found::Unsure { x, which } => (x, Some(which), true),
        };
        let sign = self.sign;
        let trigger = match which {
            None => Trigger::GoesOn,
            Some(0) => Trigger::Clear,
            Some(1) => Trigger::Off { contact: 0, sign },
            Some(2) => Trigger::Pressed,
            Some(3) => Trigger::Halts,
            Some(4) => Trigger::Fold(sign),
            Some(_) => Trigger::Balanced,
        };
        let at = |x: R| self.instant(&self.along(x));
        let known = Known {
            watch: self.watch,
            ..Known::of(contacts)
        };
        let known = (known, Among::All);
        let (reached, searched) = first_reached(self.scene, known, x, (&at, CORNER_LOOK));
        let found = match reached {
            Some(Reached { x, contact, unsure }) => (x, Trigger::Touch(contact), unsure),
            None => (x, trigger, unsure),
        };
        (found, work.saturating_add(searched))
    }
}

/// For a corner that slides along an edge of the cone, per unit of a displacement.
pub(super) fn slide_rates<R: Real>(
    scene: &impl World<R>,
    (load, pivot): (&Load<R>, &Pivot<R>),
    edge: &SlidingEdge<R>,
    displacement: &Displacement<R>,
) -> SlideRates<R> {
    let tangent = pivot.surface(scene).tangent;
    // q: hand and weight relative to the corner.
    let pull = load.force + load.lever;
    let twist = tangent.cross(pull);
    let foot_by_turn = edge.balanced.turned().dot(pull) / edge.cos;
    let foot_by_hand = edge.balanced.dot(displacement.hand) / edge.cos;
    SlideRates {
        stability: load.stability() - foot_by_turn * twist,
        drive: load.drive(displacement).now() + foot_by_hand * twist,
        foot_by_turn,
        foot_by_hand,
        moment: load.moment(),
    }
}

impl<R: Real> SingleVertex<R> {
    /// Sticks and turns about the corner as the hand moves, to the first of fold, touch, friction limit, lift-off.
    pub(super) fn advance_on_corner<W: World<R>>(
        &mut self,
        scene: &W,
        (from, to): (&Grip<R>, &Grip<R>),
    ) -> Moved<R> {
        let load = self.pivot.load(scene, from);
        let displacement = from.displacement_to(to);
        let mut segment = Segment::pinned(scene, &load, &displacement, &self.contacts());
        let stiction = self.regime.has_stiction();
        let (contact, rounding) = (self.pivot.contact, load.rounding());
        let friction = scene.surface(contact.surface).friction;
        segment.stop_at_first(
            |curve, place| {
                let (part, rate) = curve.part_and_rate(place);
                let path = PointPath::straight(Vec2::ZERO);
                let body = curve.instant(place, &load.placed, &path);
                let hand = from.lerp(to, part).hand;
                let hand = (hand, displacement.hand * rate);
                let force = body.force(scene, from.holding_point, hand);
                let bears = body.bears(scene, contact, force);
                let holds = |sign: R| {
                    let holds = bears.combine(friction.holding(stiction, sign));
                    Some(Level::new(holds, rounding))
                };
                let loosens = Sloped {
                    value: friction.threshold() - bears.normal.value,
                    slope: -bears.normal.slope,
                };
                let gains = !stiction && friction.threshold() < R::HUGE;
                [
                    Some(Level::new(bears.normal, rounding)),
                    holds(-R::ONE),
                    holds(R::ONE),
                    gains.then(|| Level::new(loosens, rounding)),
                ]
            },
            [
                Trigger::Clear,
                Trigger::Slide(-R::ONE),
                Trigger::Slide(R::ONE),
                Trigger::Pressed,
            ],
        );
        segment.turn_with_hand(scene, &mut self.pivot, to)
    }

    /// A slip of the body's side along a corner by `shift` along t, or to an earlier event (E7'): its extent, and its curve.
    pub(super) fn slip_on_corner<W: World<R>>(
        &self,
        scene: &W,
        load: &Load<R>,
        shift: R,
    ) -> (R, Segment<R>) {
        let surface = self.pivot.surface(scene);
        let (normal, tangent) = (surface.normal, surface.tangent);
        // q: hand and weight relative to the corner.
        let pull = load.force + load.lever;
        let reaction = |direction: Vec2<R>| Margin {
            start: -direction.dot(load.force),
            along: direction.dot(tangent) * shift,
            turning: -Vec2::new(direction.dot(pull), direction.turned().dot(pull)),
            rounding: load.rounding(),
        };
        let (bears, rubs) = (reaction(normal), reaction(tangent));
        let drive = Drive {
            couple: R::ZERO,
            hold: tangent.conj_mul(pull) * shift,
        };
        let drives = surface.friction.drives(bears, rubs, shift.sign());
        let moment = load.pinned::<Pinned>();
        let ends = (&drives, Trigger::Stopped);
        let mut segment = Segment::balanced_until(&moment, &drive, Trigger::Stopped, ends);
        let (pivot, contacts) = (self.pivot, self.contacts());
        segment.stop_at_reached(scene, &contacts, |curve, place| {
            let (part, rate) = curve.part_and_rate(place);
            let pivot = pivot.moved(shift * part, place.turn);
            Instant {
                placed: pivot.placed(scene),
                velocity: pivot.surface(scene).tangent * (shift * rate),
                turn: curve.rate(),
            }
        });
        segment.stop_at(&bears, Trigger::Clear);
        stop_at_end(scene, &mut segment, (&self.pivot, shift));
        (shift * segment.part(), segment)
    }

    /// A certified frame: it slides along sign·t and turns. As for a vertex (STATICS 3.4), except that the foot and the normal depend on
    /// the turn.
    pub(super) fn follow_sliding_on_corner<W: World<R>>(
        &mut self,
        scene: &W,
        path: (&Grip<R>, &Grip<R>),
        (sign, work): (R, &mut Work),
    ) -> bool {
        let slide = CornerSlide {
            scene,
            pivot: self.pivot,
            path,
            sign,
            ahead: (R::ZERO, R::ONE),
            steepness: R::ZERO,
            watch: self.watch,
        };
        let displacement = path.0.displacement_to(path.1);
        let (before, mut spot) = (slide.at((R::ZERO, R::ZERO)), slide.at((R::ZERO, R::ONE)));
        let load = spot.pivot.load(scene, path.1);
        if !load.is_representable_sliding() {
            return false;
        }
        // Q / cos(lambda), and from it bounds of the second derivative of M, and of the change of its first one with the hand.
        let edge = spot.pivot.surface(scene).sliding(sign);
        let (lever, hand) = (load.lever.length_bound(), displacement.hand.length_bound());
        let pull = (load.force + load.lever).length_bound() + hand;
        let glide = pull / edge.cos;
        let curvature = load.hold.length_bound() + lever * hand + (pull * glide) * R::from_int(3);
        let change = hand * (lever + glide.doubled().doubled());
        let least = spot.rates.stability - change;
        if least <= R::divisor() || curvature > R::LOAD {
            return false;
        }
        let step = spot.rates.moment.abs() / least + R::MICRO;
        let bend = curvature / least;
        if step > R::divisor() || bend * step > R::divisor() {
            return false;
        }
        let turn_bound = step.doubled();
        // The balance at both ends of the path determines the rest except for what changes with the turn.
        let rates = before.rates.rates();
        let mut turn = R::ZERO;
        for _ in 0..MAX_CORRECTIONS {
            let correction = spot.rates.moment / spot.rates.stability;
            turn = turn + correction;
            spot = slide.at((turn, R::ONE));
            if bend * correction * correction <= R::EPSILON {
                break;
            }
        }
        let (Some((foot, turning)), Some((foot_after, _))) = (rates, spot.rates.rates()) else {
            return false;
        };
        let goes = glide * turning.abs() + foot.abs();
        let slack = Self::slack(&displacement) + goes * R::divisor();
        let advances = along(sign, foot).min(along(sign, foot_after));
        let normals = [(&before.pivot, path.0), (&spot.pivot, path.1)].map(|(pivot, grip)| {
            let load = pivot.load(scene, grip);
            pivot.surface(scene).reaction(load.force).0
        });
        let [first, last] = normals;
        let stray =
            (lever + glide + load.force.length_bound() + hand) * turn_bound + load.rounding();
        let threshold = scene
            .surface(self.pivot.contact.surface)
            .friction
            .threshold();
        let bound = (spot.pivot.foot - self.pivot.foot).abs() + (glide + R::ONE) * turn_bound;
        let travel = Travel {
            bound,
            open: bound,
            turn: turn_bound,
        };
        let mut end = Self {
            pivot: spot.pivot,
            ..self.clone()
        };
        let follows = advances > slack
            && first.min(last) > stray
            && first.max(last) + stray < threshold
            && spot.pivot.is_on_side(scene)
            && end.has_room(scene, [&self.pivot, &spot.pivot], &travel, work);
        if follows {
            *self = end;
        }
        follows
    }

    /// Slides along sign·t as the hand moves, to the first of fold, touch, lift-off, halt, N = N*, the end of the side; or as far as one
    /// piece reaches.
    pub(super) fn advance_sliding_on_corner<W: World<R>>(
        &mut self,
        scene: &W,
        path: (&Grip<R>, &Grip<R>),
        sign: R,
    ) -> Moved<R> {
        let mut slide = CornerSlide {
            scene,
            pivot: self.pivot,
            path,
            sign,
            ahead: (R::ZERO, R::ONE),
            steepness: R::ZERO,
            watch: self.watch,
        };
        let start = slide.at((R::ZERO, R::ZERO));
        let SlideRates {
            stability, drive, ..
        } = start.rates;
        if stability <= R::ZERO {
            return Moved {
                part: R::ZERO,
                ..Moved::by(Trigger::Fold(sign))
            };
        }
        let size = stability.hypot(drive);
        let (turn, part) = (drive / size, stability / size);
        (slide.ahead, slide.steepness) = ((turn, part), size);
        // A turn of an eighth at most, and beyond the end of the displacement.
        let eighth = R::HALF.halved().halved();
        let mut end = (R::ONE + eighth) / part.max(R::MICRO);
        if turn.abs() * end > eighth {
            end = eighth / turn.abs();
        }
        // No farther than its points are still found.
        let contacts = self.contacts();
        let (mut piece, mut pieces, mut work) = (None, 0_u32, 0_u32);
        for _ in 0..MAX_HALVINGS {
            work = work.saturating_add(CORNER_LOOK);
            if slide.finds(end) {
                let (found, searched) = slide.piece(&contacts, end);
                end = found.0;
                pieces = pieces.saturating_add(1);
                work = work.saturating_add(searched).saturating_add(CORNER_LOOK);
                piece = Some(found).filter(|_| pieces == MOST_OF_PIECES || slide.finds(end));
            }
            if piece.is_some() {
                break;
            }
            end = end.halved();
        }
        let (x, trigger, unsure) = piece.unwrap_or_else(|| {
            let (found, searched) = slide.piece(&contacts, end);
            work = work.saturating_add(searched);
            found
        });
        let spot = slide.along(x);
        self.pivot = spot.pivot;
        let arrives = trigger == Trigger::Balanced && !unsure;
        let part = if arrives {
            R::ONE
        } else {
            spot.part.max(R::ZERO).min(R::ONE)
        };
        if arrives {
            self.rest_on_corner(scene, path.1, sign);
        }
        Moved {
            part,
            unsure,
            work,
            ..Moved::by(trigger)
        }
    }

    /// A slide along sign·t in balance at a grip, except for the rounding of the path, which it removes. Returns false if the error is
    /// larger.
    pub(super) fn rest_on_corner<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        sign: R,
    ) -> bool {
        let slide = CornerSlide {
            scene,
            pivot: self.pivot,
            path: (grip, grip),
            sign,
            ahead: (R::ZERO, R::ONE),
            steepness: R::ZERO,
            watch: self.watch,
        };
        let mut turn = R::ZERO;
        let mut spot = slide.at((turn, R::ZERO));
        for _ in 0..MAX_CORRECTIONS {
            let SlideRates {
                stability, moment, ..
            } = spot.rates;
            let is_near = moment.abs() <= stability * R::divisor();
            if stability <= R::ZERO || !is_near {
                return false;
            }
            let step = moment / stability;
            turn = turn + step;
            spot = slide.at((turn, R::ZERO));
            if step.abs() <= R::EPSILON {
                break;
            }
        }
        self.pivot = spot.pivot;
        true
    }

    /// The direction in which the body turns as a corner begins to slide along sign·t, if the balance of that slide is not stable.
    pub(super) fn topples_on_corner<W: World<R>>(
        &self,
        scene: &W,
        grip: &Grip<R>,
        sign: R,
    ) -> Option<R> {
        let load = self.pivot.load(scene, grip);
        let surface = self.pivot.surface(scene);
        let edge = surface.sliding(sign);
        let still = Displacement::slide(Vec2::ZERO);
        let rates = slide_rates(scene, (&load, &self.pivot), &edge, &still);
        let twist = surface.tangent.cross(load.force + load.lever);
        (rates.stability <= R::ZERO).then(|| along(sign, twist).sign())
    }
}
