//! The body comes to rest under a frozen hand: one motion after another, each chosen from the contacts and the load, until
//! friction bears the load.

use super::Reference;
use super::cone::inner;
use super::contact::Touch;
use super::mode::{Mode, STILL};
use super::scene::{Pose, Screw};
use super::statics::sign;
use super::walk::End;

/// Number of motions after which the body is left where it is.
const MOTIONS: usize = 60;
/// A contact that the free pose leaves by less than this bears no load worth a motion, in body sizes.
const WEIGHTLESS: f64 = 1e-5;

/// A slip that is about to begin.
#[derive(Clone, Copy)]
pub(super) enum Driven {
    Vertex(Touch, f64),
    Pair([Touch; 2], Screw),
}

/// What one motion hands over to the next.
#[derive(Default)]
pub(super) struct Carry {
    /// The contacts are already slipping: dynamic friction decides.
    pub slipping: bool,
    /// The slip that comes first.
    pub driven: Option<Driven>,
    /// Where the slip of two contacts began.
    pub began: Option<Pose>,
    /// The normal forces of two contacts count only at the end of their slip.
    pub unwatched: bool,
    /// Contacts that have just opened.
    pub left: Vec<Touch>,
}

impl Reference {
    /// Relaxes under the frozen `hand`.
    pub(super) fn relax(&mut self, hand: [f64; 3]) {
        self.settle(hand, Carry::default());
    }

    /// Relaxes in continuation of a motion.
    pub(super) fn settle(&mut self, hand: [f64; 3], mut carry: Carry) {
        self.slide = None;
        for _ in 0..MOTIONS {
            self.before = self.pose;
            self.look();
            let rested = match (carry.driven.take(), self.contacts.as_slice()) {
                (Some(Driven::Vertex(touch, way)), _) => {
                    self.slip_vertex((touch, way), hand, &mut carry)
                }
                (Some(Driven::Pair(pair, way)), _) => self.slip_pair((pair, way), hand, &mut carry),
                (None, []) => self.relax_free(hand, &mut carry),
                (None, &[only]) => self.relax_vertex(only, hand, &mut carry),
                (None, _) if self.corner() => self.relax_corner(hand, &mut carry),
                _ => self.relax_locked(hand, &mut carry),
            };
            if rested {
                return;
            }
        }
        self.ambiguous = true;
    }

    /// Releases all contacts except `staying`, with the hand where it is.
    pub(super) fn let_go(&mut self, staying: &[Touch]) {
        let mut carry = Carry::default();
        self.release(staying, &mut carry);
        self.settle(self.hand, carry);
    }

    fn relax_free(&mut self, hand: [f64; 3], carry: &mut Carry) -> bool {
        self.stiction = false;
        let (pose, end) = self.sweep(&carry.left, hand);
        self.pose = pose;
        match end {
            End::Touch => self.land(carry),
            End::Lost => {
                self.contacts = std::mem::take(&mut carry.left);
                let depth = |touch: &Touch| -self.scene.gap(&self.free_pose(hand), *touch);
                self.ambiguous = self
                    .contacts
                    .iter()
                    .any(|touch| depth(touch) > WEIGHTLESS * self.size);
                return true;
            }
            _ => return true,
        }
        false
    }

    fn relax_vertex(&mut self, touch: Touch, hand: [f64; 3], carry: &mut Carry) -> bool {
        if carry.slipping {
            let [normal, friction] = self.reaction(&self.pose, touch, hand);
            let excess = friction.abs() - self.scene.friction(touch).mu_d * normal;
            if normal > 0.0 && excess > self.force_tolerance(&self.pose, hand) {
                return self.slip_vertex((touch, -sign(friction)), hand, carry);
            }
        }
        let (pose, end) = self.turn(&self.pose, touch, hand, (f64::INFINITY, true));
        self.pose = pose;
        if end == End::Touch {
            self.land(carry);
            return false;
        }
        let [normal, friction] = self.reaction(&pose, touch, hand);
        let tolerance = self.force_tolerance(&pose, hand);
        if normal < -tolerance {
            self.release(&[], carry);
            return false;
        }
        self.stiction |= self.pressed_hard(&pose, hand);
        if self.admissible(&pose, &[touch], hand) {
            return true;
        }
        self.slip_vertex((touch, -sign(friction)), hand, carry)
    }

    /// One vertex on two surfaces: it turns in the corner, then stays or leaves along one of the surfaces.
    fn relax_corner(&mut self, hand: [f64; 3], carry: &mut Carry) -> bool {
        let (pose, end) = self.turn(&self.pose, self.contacts[0], hand, (f64::INFINITY, true));
        self.pose = pose;
        if end == End::Touch {
            self.land(carry);
            return false;
        }
        if self.admissible(&pose, &self.contacts, hand) {
            return true;
        }
        if let Some(Mode::Keep(staying)) = self.leaves_corner(hand) {
            self.release(&staying, carry);
        }
        false
    }

    /// Two or more contacts that fix the pose: they stay, slip along the one motion that two of them leave free, or open.
    fn relax_locked(&mut self, hand: [f64; 3], carry: &mut Carry) -> bool {
        if carry.slipping {
            if self.admissible_in_slip(&self.pose, &self.contacts, hand) {
                return self.stop_slip(hand);
            }
            if let Some(way) = self.pair().and_then(|pair| self.slip_of_pair(pair, hand)) {
                return self.slip_pair(way, hand, carry);
            }
        } else {
            self.stiction |= self.pressed_hard(&self.pose, hand);
            if self.admissible(&self.pose, &self.contacts, hand) {
                return true;
            }
        }
        match self.mode(hand, carry.slipping) {
            Some(Mode::Slide(pair, way)) => {
                let stays = |touch: &Touch| {
                    pair.contains(touch)
                        || inner(self.normal_line(&self.pose, *touch), way) <= STILL
                };
                self.contacts = self.contacts.iter().copied().filter(stays).collect();
                self.slip_pair((pair, way), hand, carry)
            }
            Some(Mode::Keep(staying)) => {
                self.release(&staying, carry);
                false
            }
            None => {
                self.ambiguous = true;
                true
            }
        }
    }

    /// Adds the vertices that have come into contact, under a frozen hand.
    pub(super) fn land(&mut self, carry: &mut Carry) {
        self.take_up();
        *carry = Carry::default();
    }

    pub(super) fn release(&mut self, staying: &[Touch], carry: &mut Carry) {
        carry.left = std::mem::replace(&mut self.contacts, staying.to_vec());
        carry.slipping = false;
    }
}
