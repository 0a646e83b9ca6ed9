//! One vertex on one surface (STATICS 3): pinned it turns in balance of moments about the contact, the angle on its branch; it slips along
//! the surface with the moment balanced at every position.

use super::segment::Segment;
use super::short_slip::ShortSlip;
use super::side_end::stop_at_end;
use super::two_vertex::Slip;
use crate::balance_curve::Margin;
use crate::certified::CertifiedTurn;
use crate::contact::{Pairs, Reactions, Regime};
use crate::detect::{PointPath, Short, Watch};
use crate::friction::Verdict;
use crate::grip::{Displacement, Grip};
use crate::list::gather;
use crate::load::Load;
use crate::moment::{Downhill, Pinned};
use crate::pivot::Pivot;
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::verb::{Moved, Trigger};
use crate::work::{SLIP, Work};
use crate::world::{Surface, World};

/// The memory: where the vertex is held, the angle, which is the branch, and whether it sticks.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SingleVertex<R> {
    pub(crate) pivot: Pivot<R>,
    pub(crate) regime: Regime<R>,
    /// The angle by which the body can turn about the pivot before another vertex can touch (rad); 0: not known.
    pub(super) room: R,
    pub(super) watch: Watch,
}

/// A short motion of a vertex or a corner, for the purpose of what else it may touch.
pub(super) struct Travel<R> {
    /// No point of the body moves farther than this.
    pub(super) bound: R,
    /// A gap to a half-plane that ends larger than this was never closed.
    pub(super) open: R,
    /// The body turns by no more than this, and the foot moves in one direction.
    pub(super) turn: R,
}

/// Normal reaction and friction on a path of the hand.
struct Reaction<R> {
    normal: Margin<R>,
    friction: Margin<R>,
}

impl<R: Real> SingleVertex<R> {
    pub(crate) fn new(pivot: Pivot<R>) -> Self {
        Self {
            pivot,
            regime: Regime::LOOSE,
            room: R::ZERO,
            watch: Watch::NONE,
        }
    }

    pub(crate) fn contacts(&self) -> Pairs {
        gather([self.pivot.contact])
    }

    /// Returns whether it is a corner of an obstacle on a side of the body.
    pub(crate) fn is_corner<W: World<R>>(&self, _: &W) -> bool {
        W::CORNERS && self.pivot.contact.is_corner()
    }

    /// Returns whether only the contact holds the angle of a body whose vertex slides (STATICS 3.7).
    pub(crate) fn swings<W: World<R>>(&self, scene: &W, grip: &Grip<R>) -> bool {
        !self.is_corner(scene) && grip.swings(scene)
    }

    fn reaction(
        load: &Load<R>,
        surface: &Surface<R>,
        displacement: &Displacement<R>,
    ) -> Reaction<R> {
        Reaction {
            normal: load.reaction(surface.normal, displacement),
            friction: load.reaction(surface.tangent, displacement),
        }
    }

    /// A certified frame: it sticks and turns.
    pub(crate) fn follow(
        &mut self,
        scene: &impl World<R>,
        (from, to): (&Grip<R>, &Grip<R>),
        work: &mut Work,
    ) -> bool {
        let load = self.pivot.load(scene, to);
        if !load.is_representable() {
            return false;
        }
        let displacement = from.displacement_to(to);
        let certified = CertifiedTurn::pinned::<Pinned>(scene, &load, to, &displacement);
        let Some(certified) = certified else {
            return false;
        };
        let orientation = certified.orientation;
        // Because of the turn the reaction deviates from the straight line to where the hand alone would take it ...
        if !self.holds(scene, &load, certified.turn_bound) {
            // ... and by much less from the straight line to where it ends.
            let end = load.turned(scene, orientation, to);
            let stray = certified
                .curvature_bound(&load.drive(&displacement))
                .halved();
            if self.is_corner(scene) || !self.holds(scene, &end, stray) {
                return false;
            }
        }
        let Some(regime) = self.pressed(scene, (&load, to), &certified) else {
            return false;
        };
        let follows = self.has_room_to_turn(scene, &certified, work);
        if follows {
            self.pivot.orientation = orientation;
            self.regime = regime;
        }
        follows
    }

    /// The regime after a certified turn: without stiction the vertex gains it if it is pressed hard enough (rule 3). `None` if the
    /// reaction may rise to that and fall again.
    fn pressed(
        &self,
        scene: &impl World<R>,
        (load, to): (&Load<R>, &Grip<R>),
        certified: &CertifiedTurn<R>,
    ) -> Option<Regime<R>> {
        let surface = self.pivot.surface(scene);
        let threshold = surface.friction.threshold();
        if self.regime.has_stiction() {
            return Some(self.regime);
        }
        let (normal, _) = surface.reaction(load.force);
        if normal + self.stray(scene, load, certified.turn_bound) < threshold
            || threshold >= R::HUGE
        {
            return Some(self.regime);
        }
        let end = load.turned(scene, certified.orientation, to);
        let surface = scene.face(self.pivot.contact, certified.orientation.rotation());
        let (normal, _) = surface.reaction(end.force);
        (surface.friction.is_pressed(normal)).then_some(Regime::Stick { stiction: true })
    }

    /// The deviation of a reaction whose lever deviates by a fraction of its length.
    fn stray<W: World<R>>(&self, scene: &W, load: &Load<R>, part: R) -> R {
        let mut lever = load.lever.length_bound();
        if self.is_corner(scene) {
            // The normal of a corner turns with the body.
            lever = lever + load.force.length_bound();
        }
        lever * part + load.rounding()
    }

    /// True if the reaction stays within the cone although the lever deviates by a fraction of its length.
    fn holds(&self, scene: &impl World<R>, load: &Load<R>, stray: R) -> bool {
        let surface = self.pivot.surface(scene);
        let (normal, friction) = surface.reaction(load.force);
        let slack = self.stray(scene, load, stray);
        (surface.friction).is_within((normal, friction), self.regime.has_stiction(), slack)
    }

    /// True if nothing else can be reached on the path from one pose to another.
    #[inline(always)]
    pub(super) fn has_room<W: World<R>>(
        &mut self,
        scene: &W,
        [begin, end]: [&Pivot<R>; 2],
        travel: &Travel<R>,
        work: &mut Work,
    ) -> bool {
        if W::CORNERS {
            // Nothing is near.
            if self.watch == Watch::NONE && self.room > travel.bound {
                self.room = self.room - travel.bound;
                return true;
            }
            self.has_room_among(scene, [begin, end], travel, work)
        } else {
            self.has_room_at(scene, end, (travel.bound, travel.open))
        }
    }

    /// No other vertex can reach a half-plane on the path to `end`, on which no point of the body moves farther than `travel_bound`, and on
    /// which a gap that ends larger than `open` was never closed.
    fn has_room_at<W: World<R>>(
        &mut self,
        scene: &W,
        end: &Pivot<R>,
        (travel_bound, open): (R, R),
    ) -> bool {
        let mut room = self.room - travel_bound;
        if room <= R::ZERO {
            room = end.placed(scene).room(scene, Some(end.contact.vertex));
            if room <= open {
                return false;
            }
        }
        self.room = room;
        true
    }

    /// The same with obstacles.
    #[inline(never)]
    fn has_room_among<W: World<R>>(
        &mut self,
        scene: &W,
        [begin, end]: [&Pivot<R>; 2],
        travel: &Travel<R>,
        work: &mut Work,
    ) -> bool {
        let short = Short {
            before: begin.placed(scene),
            after: end.placed(scene),
            lasting: &[end.contact],
            way: travel.bound,
            turn: travel.turn,
        };
        let mut room = self.room;
        if room <= travel.bound {
            let planes = short.after.room(scene, Some(end.contact.vertex));
            if planes <= travel.open {
                return false;
            }
            room = R::ZERO;
            if !short.keeps_off(scene, (&mut room, &mut self.watch), work) {
                return false;
            }
            self.room = room.min(planes);
            return true;
        }
        let keeps_off = short.keeps_off(scene, (&mut room, &mut self.watch), work);
        // What is near now need not be what is near half-planes.
        self.room = room.min(self.room - travel.bound);
        keeps_off
    }

    /// The same for a certified turn. No point of the body is farther from the pivot than one body size.
    pub(super) fn has_room_to_turn<W: World<R>>(
        &mut self,
        scene: &W,
        certified: &CertifiedTurn<R>,
        work: &mut Work,
    ) -> bool {
        let begin = self.pivot;
        let end = Pivot {
            orientation: certified.orientation,
            ..begin
        };
        let travel = Travel {
            bound: certified.turn_bound,
            open: (certified.turn_bound * certified.turn_bound).halved(),
            turn: certified.turn_bound,
        };
        self.has_room(scene, [&begin, &end], &travel, work)
    }

    /// Sticks and turns as the hand moves, to the first of fold, touch, friction limit, lift-off.
    #[inline(never)]
    pub(crate) fn advance(
        &mut self,
        scene: &impl World<R>,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        self.room = R::ZERO;
        if self.is_corner(scene) {
            return self.advance_on_corner(scene, (from, to));
        }
        let load = self.pivot.load(scene, from);
        let surface = self.pivot.surface(scene);
        let displacement = from.displacement_to(to);
        let mut segment = Segment::pinned(scene, &load, &displacement, &self.contacts());
        let Reaction { normal, friction } = Self::reaction(&load, &surface, &displacement);
        let stiction = self.regime.has_stiction();
        // Of events at one point the last counts.
        if let Some(loosens) = surface.friction.loosens(normal)
            && !stiction
        {
            segment.stop_at(&loosens, Trigger::Pressed);
        }
        for sign in [R::ONE, -R::ONE] {
            let holds = (surface.friction).holds((normal, friction), stiction, sign);
            segment.stop_at(&holds, Trigger::Slide(sign));
        }
        segment.stop_at(&normal, Trigger::Clear);
        segment.turn_with_hand(scene, &mut self.pivot, to)
    }

    /// Turns downhill about the vertex to balance, then tests friction. A vertex that already slides goes on while it is driven,
    /// immediately if the turn is blocked.
    #[inline(never)]
    pub(crate) fn relax<W: World<R>>(
        &mut self,
        scene: &W,
        grip: &Grip<R>,
        sliding: Option<R>,
    ) -> Moved<R> {
        let begin = self.clone();
        let mut moved = self.turn_down(scene, grip);
        let Some(sign) = sliding else {
            return moved;
        };
        // By a contact that was there at the beginning, not in its line beyond its side.
        let was_there = |pair| {
            let placed = begin.pivot.placed(scene);
            let near = R::met_before();
            placed.gap(scene, pair) <= near && (!W::CORNERS || placed.beyond(scene, pair) <= near)
        };
        // If the evaluations ran out among obstacles, there is no pair.
        let is_known = !W::CORNERS || !moved.unsure;
        let blocked = is_known && matches!(moved.trigger, Trigger::Touch(pair) if was_there(pair));
        if blocked {
            *self = begin;
        }
        let at_rest = matches!(moved.trigger, Trigger::Balanced | Trigger::Slide(_));
        if (blocked || at_rest) && self.is_driven(scene, &self.pivot.load(scene, grip), sign) {
            moved.trigger = Trigger::Slide(sign);
        }
        moved
    }

    /// Downhill to balance, or to the first touch: without a search if the balance is near and nothing blocks the turn.
    fn turn_down(&mut self, scene: &impl World<R>, grip: &Grip<R>) -> Moved<R> {
        let load = self.pivot.load(scene, grip);
        let mut work = Work::none();
        if let Some(certified) =
            CertifiedTurn::pinned::<Pinned>(scene, &load, grip, &Displacement::turn(R::ZERO))
            && self.has_room_to_turn(scene, &certified, &mut work)
        {
            self.pivot.orientation = certified.orientation;
            self.pivot.renew(scene, grip, &mut self.regime);
            let trigger = self.test(scene, &self.pivot.load(scene, grip));
            return Moved::by(trigger).after(scene, work);
        }
        let moved = self.turn_by(scene, grip, &load.pinned::<Pinned>().downhill());
        moved.after(scene, work)
    }

    /// True while the vertex slides on along sign·t, on a stable branch.
    fn is_driven(&self, scene: &impl World<R>, load: &Load<R>, sign: R) -> bool {
        self.is_driven_beyond(scene, load, (sign, load.rounding()))
    }

    /// The same, by more than `off`.
    fn is_driven_beyond(&self, scene: &impl World<R>, load: &Load<R>, (sign, off): (R, R)) -> bool {
        let surface = self.pivot.surface(scene);
        let (normal, friction) = surface.reaction(load.force);
        load.stability() > R::ZERO
            && normal > off
            && (surface.friction).is_driven(normal, friction, sign, off)
    }

    /// The uncertainty of the friction at the end of a slip.
    pub(super) fn found_to(load: &Load<R>) -> R {
        R::of_searches(load.rounding_with_foot())
    }

    /// The uncertainty of a reaction that has fallen to zero.
    pub(crate) fn found_to_at(&self, scene: &impl World<R>, grip: &Grip<R>) -> R {
        Self::found_to(&self.pivot.load(scene, grip))
    }

    /// The same from a fold of the branch, on in the direction of the sign.
    #[inline(never)]
    pub(crate) fn snap(&mut self, scene: &impl World<R>, grip: &Grip<R>, direction: R) -> Moved<R> {
        let moment = self.pivot.load(scene, grip).pinned::<Pinned>();
        self.turn_by(scene, grip, &moment.over_fold(direction))
    }

    /// Turns the body about the vertex by the result of a search downhill, to balance or to the first touch, then tests friction.
    fn turn_by(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        downhill: &Downhill<R>,
    ) -> Moved<R> {
        self.room = R::ZERO;
        let lasting = self.contacts();
        let mut moved = Segment::<R>::turn_downhill(scene, &mut self.pivot, &lasting, downhill);
        if moved.trigger == Trigger::Balanced {
            self.pivot.renew(scene, grip, &mut self.regime);
            moved.trigger = self.test(scene, &self.pivot.load(scene, grip));
        }
        moved
    }

    /// Friction at rest.
    fn test(&self, scene: &impl World<R>, load: &Load<R>) -> Trigger<R> {
        let surface = self.pivot.surface(scene);
        let (normal, friction) = surface.reaction(load.force);
        let rounding = load.rounding();
        let stiction = self.regime.has_stiction();
        match (surface.friction).judge((normal, friction), stiction, rounding) {
            Verdict::Sticks => Trigger::Balanced,
            Verdict::Slides(sign) => Trigger::Slide(sign),
            Verdict::Opens => Trigger::Clear,
        }
    }

    /// Slips along sign·t, with the moment unchanged (balanced, except for a contact that opened in mid-slip), to the first of (E3), touch,
    /// lift-off, fold. If it ends in balance it sticks if it is pressed hard enough, otherwise it slides on with the hand (rule 4). It
    /// proceeds piece by piece.
    #[inline(never)]
    pub(crate) fn slip(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        (sign, under_way): (R, &mut Option<Slip<R>>),
    ) -> Moved<R> {
        let slip = under_way.take().unwrap_or(Slip::from(&self.pivot, sign));
        let moved = self.slip_on(scene, grip, sign);
        if moved.trigger == Trigger::GoesOn {
            *under_way = Some(slip);
        }
        Moved {
            slip: self.pivot.foot - slip.foot,
            work: moved.work.saturating_add(SLIP),
            ..moved
        }
    }

    /// Slips along sign·t: by the short slip of (E9) if it is certified, otherwise by a search.
    fn slip_on<W: World<R>>(&mut self, scene: &W, grip: &Grip<R>, sign: R) -> Moved<R> {
        let load = self.pivot.load(scene, grip);
        let placed = (&self.pivot, &load);
        let found = if self.is_corner(scene) {
            Err(None)
        } else {
            ShortSlip::find(scene, placed, grip, sign)
        };
        let mut work = Work::none();
        if let Ok(slip) = found {
            let (begin, end) = (self.pivot, self.pivot.moved(slip.slide, slip.turn));
            let travel = Travel {
                bound: slip.travel_bound,
                open: slip.open,
                turn: slip.travel_bound,
            };
            if end.is_on_side(scene) && self.has_room(scene, [&begin, &end], &travel, &mut work) {
                self.pivot = end;
                self.end_slip(scene, grip, sign);
                return Moved::by(Trigger::Stopped).after(scene, work);
            }
        }
        let about = match found {
            Ok(slip) => Some(slip.slide.abs()),
            Err(about) => about,
        };
        let moved = self.slip_far(scene, (&load, about), grip, sign);
        moved.after(scene, work)
    }

    /// To the first event that may end it; `about`: an estimate of its length, if known.
    fn slip_far<W: World<R>>(
        &mut self,
        scene: &W,
        (load, about): (&Load<R>, Option<R>),
        grip: &Grip<R>,
        sign: R,
    ) -> Moved<R> {
        self.room = R::ZERO;
        // Beyond this displacement the hand would pull back; if this load needs a longer one it is made in several slips.
        let lever = load.lever.length_bound();
        let farthest =
            (load.force.length_bound() + lever.doubled()).min(R::LOAD / lever.max(R::ONE));
        // Searching no farther than needed is cheap.
        let near = about.map_or(farthest, |about| farthest.min(about.doubled().doubled()));
        let (slip, segment) = self.slip_segment(scene, load, sign * near);
        let goes_on = segment.goes_on() && near < farthest;
        self.pivot = self.pivot.moved(slip, R::ZERO);
        let moved = segment.turn_with_hand(scene, &mut self.pivot, grip);
        if goes_on || moved.unsure && slip != R::ZERO {
            // Nothing has ended it so far.
            return Moved {
                work: moved.work,
                ..Moved::by(Trigger::GoesOn)
            };
        }
        let load = self.pivot.load(scene, grip);
        let surface = self.pivot.surface(scene);
        let (normal, friction) = surface.reaction(load.force);
        // For a body that swings round at the first pull a search sees nothing but rounding, and may end it anywhere.
        let off = Self::found_to(&load);
        let drives = |sign| (surface.friction).is_driven(normal, friction, sign, off);
        let folds = matches!(moved.trigger, Trigger::Fold(_));
        let unbalanced = !self.is_balanced(&load) || !folds && (drives(sign) || drives(-sign));
        if moved.trigger == Trigger::Stopped && !moved.unsure && !unbalanced {
            self.end_slip(scene, grip, sign);
        }
        Moved {
            unbalanced,
            ..moved
        }
    }

    fn end_slip(&mut self, scene: &impl World<R>, grip: &Grip<R>, sign: R) {
        if self.swings(scene, grip) {
            self.lean_on(scene, grip, sign);
        }
        self.regime = Regime::after_slip(self.pivot.is_pressed(scene, grip), sign);
    }

    /// A slip by `shift` along t, or to an earlier event: its extent, and its curve.
    fn slip_segment<W: World<R>>(&self, scene: &W, load: &Load<R>, shift: R) -> (R, Segment<R>) {
        if self.is_corner(scene) {
            return self.slip_on_corner(scene, load, shift);
        }
        let surface = self.pivot.surface(scene);
        let displacement = Displacement::slide(surface.tangent * shift);
        let moment = load.pinned::<Pinned>();
        let Reaction { normal, friction } = Self::reaction(load, &surface, &displacement);
        let drives = surface.friction.drives(normal, friction, shift.sign());
        let ends = (&drives, Trigger::Stopped);
        let drive = load.drive(&displacement);
        let mut segment = Segment::balanced_until(&moment, &drive, Trigger::Stopped, ends);
        let lasting = self.contacts();
        segment.stop_at_touch(
            scene,
            &load.placed,
            (&PointPath::straight(surface.tangent * shift), &lasting),
        );
        segment.stop_at(&normal, Trigger::Clear);
        if W::CORNERS {
            stop_at_end(scene, &mut segment, (&self.pivot, shift));
        }
        (shift * segment.part(), segment)
    }

    /// True if the body is in balance about the vertex, to the accuracy with which the end of a path is found.
    pub(crate) fn is_found(&self, scene: &impl World<R>, grip: &Grip<R>) -> bool {
        let load = self.pivot.load(scene, grip);
        load.moment().abs() <= Self::found_to(&load)
    }

    /// True if its reaction is in the cone, to the same accuracy.
    pub(crate) fn is_in_cone(&self, scene: &impl World<R>, grip: &Grip<R>) -> bool {
        let load = self.pivot.load(scene, grip);
        let surface = self.pivot.surface(scene);
        let (reaction, found) = (surface.reaction(load.force), Self::found_to(&load));
        let verdict = (surface.friction).judge(reaction, self.regime.has_stiction(), found);
        matches!(verdict, Verdict::Sticks)
    }

    /// True if the moment of the load is rounding.
    fn is_balanced(&self, load: &Load<R>) -> bool {
        // The angle is rounded, too.
        let angle = R::of_sums(load.stability());
        let rounding = (load.rounding_with_foot() + angle).doubled();
        load.moment().abs() <= rounding
    }

    pub(crate) fn reactions(&self, scene: &impl World<R>, load: &Load<R>) -> Reactions<R> {
        let surface = self.pivot.surface(scene);
        let (normal, friction) = surface.reaction(load.force);
        gather([[normal.max(R::ZERO), friction]])
    }
}

#[cfg(test)]
mod tests;
