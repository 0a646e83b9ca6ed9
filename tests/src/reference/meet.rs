//! What follows an event on the hand's path, according to the rules of the slides: the contacts stick, slide, slip, open or close.

use super::contact::Touch;
use super::events::{BACK, Happening};
use super::follow::ahead;
use super::mode::Mode;
use super::relax::{Carry, Driven};
use super::statics::sign;
use super::{CLEARANCE, Reference};

/// Displacement of the hand over which the rates after a touch are evaluated, in body sizes.
const SOON: f64 = 1e-6;

impl Reference {
    /// Applies the consequences of `event`, with the hand at `self.hand` moving along `way`.
    pub(super) fn meet(&mut self, event: Happening, way: [f64; 3]) {
        match event {
            Happening::Fold => self.fold(),
            Happening::Touch => self.touch(way),
            Happening::Lift => {
                self.slide = None;
                self.let_go(&[]);
            }
            Happening::Hold => self.strike(way),
            Happening::Open(index) => self.open(index, way),
            Happening::Yield => self.give_way(way),
            Happening::Memory => {
                self.stiction = true;
                self.slide = None;
            }
            Happening::Reversal => self.stop(),
            Happening::Off(index) => self.off(index),
        }
    }

    /// The body sticks, without the stiction bit.
    fn stop(&mut self) {
        self.slide = None;
        self.stiction = false;
    }

    /// The balance is lost: a sliding foot sticks if it can; otherwise it slips to its next balance. A sticking body turns.
    fn fold(&mut self) {
        if let Some(pose) = self.followed(self.hand) {
            // It has only turned by a large angle.
            self.pose = pose;
            return;
        }
        if self.slide.is_some() && self.sticks() {
            return;
        }
        let slide = self.slide.take().unwrap_or_default();
        let mut carry = Carry::default();
        match (self.pair(), self.contacts.as_slice(), slide.as_slice()) {
            (_, &[touch], &[way]) => carry.driven = Some(Driven::Vertex(touch, way)),
            (Some(pair), _, &[first, second]) => {
                let motion = self.motion(&self.pose, pair, [first, second]);
                carry.driven = motion.map(|twist| Driven::Pair(pair, twist));
            }
            _ => {}
        }
        self.settle(self.hand, carry);
    }

    /// A slide that has lost its balance sticks if dynamic friction holds the foot where it is.
    fn sticks(&mut self) -> bool {
        let mut stuck = self.clone();
        stuck.stop();
        let Some(pose) = stuck.followed(self.hand) else {
            return false;
        };
        let sticks =
            stuck.admissible(&pose, &stuck.contacts, self.hand) && !stuck.enters(&pose, CLEARANCE);
        if sticks {
            stuck.pose = pose;
            *self = stuck;
        }
        sticks
    }

    /// A vertex has reached a surface. From the air, the rates decide; a vertex that becomes an edge continues as it was;
    /// if a sliding vertex meets a second surface, a joint slide follows if both feet move on and the new one presses.
    fn touch(&mut self, way: [f64; 3]) {
        let before = self.contacts.clone();
        if !self.take_up() {
            // The body now sees an obstacle from another side, or turns over to a free pose behind one.
            if before.is_empty() {
                self.settle(self.hand, Carry::default());
            }
            return;
        }
        let slide = self.slide.take();
        if before.is_empty() {
            self.strike(way);
        } else if let Some(&[slides]) = slide.as_deref() {
            if self.on_one_surface() {
                self.slide = Some(vec![slides; self.contacts.len()]);
            } else if !self.slides_jointly((before[0], slides), way) {
                self.stop();
            }
        } else if slide.is_some() {
            self.stop();
        }
    }

    /// A sliding contact has left its side.
    fn off(&mut self, index: usize) {
        let slide = self.slide.take().unwrap_or_default();
        let mut carry = Carry::default();
        if self.pass_on((index, slide[index]), self.hand, &mut carry) {
            self.slide = Some(slide);
        } else {
            self.settle(self.hand, carry);
        }
    }

    /// Starts a joint slide in which the contact `old` keeps its direction, if the hand drives it and the new contact presses.
    fn slides_jointly(&mut self, (old, slides): (Touch, f64), way: [f64; 3]) -> bool {
        let Some(pair) = self.pair() else {
            return false;
        };
        let speeds = self.speeds(&self.pose, pair, self.free_twist(&self.pose, pair));
        let keeper = usize::from(pair[1] == old);
        let turned = slides * sign(speeds[keeper]);
        let ways = speeds.map(|speed| turned * sign(speed));
        self.slide = Some(ways.to_vec());
        let soon = ahead(self.hand, way, SOON);
        let presses = self.followed(soon).is_some_and(|pose| {
            let normals = self.pair_normals(&pose, pair, ways, soon);
            normals.is_some_and(|normals| normals[1 - keeper] > 0.0)
        });
        let runs = presses && self.runs(way);
        if !runs {
            self.slide = None;
        }
        runs
    }

    /// Whether all sliding feet move in the direction of their slide.
    fn runs(&self, way: [f64; 3]) -> bool {
        let rates = self.rates(self.hand, way);
        rates.is_some_and(|rates| rates.iter().all(|&rate| rate > BACK))
    }

    /// A contact that is not loaded yet sticks if the rate of its force lies in the cone of dynamic friction; otherwise it slides.
    fn strike(&mut self, way: [f64; 3]) {
        self.stop();
        if !self.on_one_surface() {
            return;
        }
        let touch = self.contacts[0];
        let soon = ahead(self.hand, way, SOON);
        let Some(stuck) = self.followed(soon) else {
            return;
        };
        let [normal, friction] = self.reaction(&stuck, touch, soon);
        if normal > 0.0 && friction.abs() <= self.scene.friction(touch).mu_d * normal {
            return;
        }
        self.slide = Some(vec![-sign(friction); self.contacts.len()]);
        let presses = self.followed(soon).is_some_and(|pose| {
            self.reaction(&pose, touch, soon)[0] > -self.force_tolerance(&pose, soon)
        });
        if !presses || !self.runs(way) {
            self.slide = None;
        }
    }

    /// The contact with this index no longer presses: if the motion of the rest opens its gap, the rest continues;
    /// otherwise all stick.
    fn open(&mut self, index: usize, way: [f64; 3]) {
        let mut rest = self.clone();
        let left = rest.contacts.remove(index);
        if let Some(ways) = &mut rest.slide {
            ways.remove(index);
        }
        let soon = ahead(self.hand, way, SOON);
        let opens = |pose| self.scene.gap(&pose, left) >= -CLEARANCE * self.size;
        if self.pair().is_some() && !rest.followed(soon).is_some_and(opens) {
            self.stop();
            return;
        }
        rest.stiction |= rest.slide.is_none() && rest.pressed_hard(&rest.pose, rest.hand);
        *self = rest;
    }

    /// Friction at rest does not bear the load: with the stiction bit a slip follows, without it a slide of the
    /// remaining contacts.
    fn give_way(&mut self, way: [f64; 3]) {
        if let Some(pair) = self.pair() {
            return self.pair_gives_way(pair, way);
        }
        let begins = !self.stiction
            && if self.on_one_surface() {
                let [_, friction] = self.reaction(&self.pose, self.contacts[0], self.hand);
                self.begins(vec![-sign(friction); self.contacts.len()], way)
            } else {
                self.remainder_begins(way)
            };
        if !begins {
            self.settle(
                self.hand,
                Carry {
                    slipping: self.on_one_surface(),
                    ..Carry::default()
                },
            );
        }
    }

    /// Starts a slide without a jump, if the hand drives it.
    fn begins(&mut self, ways: Vec<f64>, way: [f64; 3]) -> bool {
        self.slide = Some(ways);
        let balanced = self.followed(self.hand).is_some() && self.rates(self.hand, way).is_some();
        let begins = balanced && !self.turned_back(self.hand, way);
        if !begins {
            self.slide = None;
        }
        begins
    }

    /// A corner or three and more contacts yield without the stiction bit: what remains slides, or sticks if it can.
    fn remainder_begins(&mut self, way: [f64; 3]) -> bool {
        let whole = self.clone();
        let motion = if self.corner() {
            self.leaves_corner(self.hand)
        } else {
            self.mode(self.hand, false)
        };
        match motion {
            Some(Mode::Slide(pair, twist)) => {
                let ways = self.speeds(&self.pose, pair, twist).map(sign);
                self.contacts = pair.to_vec();
                if self.begins(ways.to_vec(), way) {
                    return true;
                }
            }
            Some(Mode::Keep(staying)) if !staying.is_empty() => {
                self.contacts = staying;
                self.stiction = self.pressed_hard(&self.pose, self.hand);
                return true;
            }
            _ => {}
        }
        *self = whole;
        false
    }

    /// Two contacts on two surfaces yield. If only one of them bears the load, the other opens if it can. If the loaded
    /// cone edges of both belong to a motion, and the stiction bit is not set, a slide follows; in all other cases, a slip.
    fn pair_gives_way(&mut self, pair: [Touch; 2], way: [f64; 3]) {
        let bound = self.bound_edges(&self.pose, &pair, self.hand);
        let bears = [0, 1].map(|i: usize| bound[i][0] + bound[i][1] > 0.0);
        if let Some(other) = bears.iter().position(|&bears| !bears)
            && self.rests_on(1 - other, way)
        {
            return;
        }
        let ways = [0, 1].map(|i: usize| sign(bound[i][1]) - sign(bound[i][0]));
        if !self.stiction && bears == [true; 2] && self.motion(&self.pose, pair, ways).is_some() {
            if self.would_slip(&self.pose, pair, ways, self.hand) {
                self.stiction = true;
                return;
            }
            if self.begins(ways.to_vec(), way) {
                return;
            }
        }
        self.settle(
            self.hand,
            Carry {
                slipping: true,
                ..Carry::default()
            },
        );
    }

    /// Leaves the body on the contact with this index alone, if that one sticks and the hand opens the other.
    fn rests_on(&mut self, index: usize, way: [f64; 3]) -> bool {
        let mut alone = self.clone();
        let left = alone.contacts.remove(1 - index);
        let soon = ahead(self.hand, way, SOON);
        let rests = alone.followed(soon).is_some_and(|pose| {
            self.scene.gap(&pose, left) >= -CLEARANCE * self.size
                && alone.reaction(&pose, alone.contacts[0], soon)[0] > 0.0
                && alone.admissible(&pose, &alone.contacts, soon)
        });
        if rests {
            alone.stiction |= alone.pressed_hard(&alone.pose, alone.hand);
            *self = alone;
        }
        rests
    }
}
