//! The body comes to rest under a frozen hand: one motion after another, each chosen from the contacts and the load, until
//! friction bears the load. At the end of a slip the memory of the contacts decides whether they stick or slide on.

use super::cone::inner;
use super::mode::{Mode, STILL};
use super::scene::{Pose, Screw, Touch, length, sub};
use super::statics::sign;
use super::walk::End;
use super::{CLEARANCE, Reference};

/// Motions after which the body is left where it is.
const MOTIONS: usize = 60;
/// Vertices that come this close together with the first one touch with it, in body sizes.
const TOGETHER: f64 = 1e-10;
/// A contact that the free pose leaves by less than this carries nothing worth a motion, in body sizes.
const WEIGHTLESS: f64 = 1e-5;

/// A joint slip shorter than this is none, in body sizes.
const MOVED: f64 = 1e-9;

/// A slip that is known to begin.
#[derive(Clone, Copy)]
pub(super) enum Driven {
    Vertex(Touch, f64),
    Pair([Touch; 2], Screw),
}

/// What a motion has left to the next one.
#[derive(Default)]
pub(super) struct Carry {
    /// The contacts slip already: dynamic friction decides.
    pub slipping: bool,
    /// The slip that comes first.
    pub driven: Option<Driven>,
    /// Where the slip of two contacts began.
    pub began: Option<Pose>,
    /// The normal forces of two contacts count at the end of their slip only.
    pub unwatched: bool,
    /// Contacts that have just opened.
    pub left: Vec<Touch>,
}

impl Reference {
    /// Relaxes under the frozen `hand`.
    pub(super) fn relax(&mut self, hand: [f64; 3]) {
        self.settle(hand, Carry::default());
    }

    /// The same, from a motion under way.
    pub(super) fn settle(&mut self, hand: [f64; 3], mut carry: Carry) {
        self.slide = None;
        for _ in 0..MOTIONS {
            let rested = match (carry.driven.take(), self.contacts.as_slice()) {
                (Some(Driven::Vertex(touch, way)), _) => {
                    self.slip_vertex((touch, way), hand, &mut carry)
                }
                (Some(Driven::Pair(pair, way)), _) => self.slip_pair(pair, way, hand, &mut carry),
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

    /// Lets all contacts go but `kept`, under the hand where it is.
    pub(super) fn let_go(&mut self, kept: &[Touch]) {
        let mut carry = Carry::default();
        self.release(kept, &mut carry);
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
            let excess = friction.abs() - self.scene.surfaces[touch.surface].mu_d * normal;
            if normal > 0.0 && excess > self.force_tolerance(&self.pose, hand) {
                return self.slip_vertex((touch, -sign(friction)), hand, carry);
            }
        }
        let (pose, end) = self.turn(&self.pose, touch.vertex, hand, (f64::INFINITY, true));
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

    /// One vertex slips until dynamic friction holds it.
    fn slip_vertex(&mut self, slip: (Touch, f64), hand: [f64; 3], carry: &mut Carry) -> bool {
        let (pose, end) = self.slide_vertex(slip, &carry.left, hand);
        self.pose = pose;
        carry.slipping = false;
        match end {
            End::Rest => {
                self.end_slip(vec![slip.1], self.pressed_hard(&pose, hand));
                return true;
            }
            End::Touch => {
                self.land(carry);
                carry.slipping = self.contacts.len() == 2 && !self.corner();
            }
            End::Lift(_) => self.release(&[], carry),
            End::Snap => {}
            End::Lost => {
                self.ambiguous = true;
                return true;
            }
        }
        false
    }

    /// The end of a slip at dynamic friction: the contacts stick and have the bit if it is `kept`, else they slide on.
    fn end_slip(&mut self, ways: Vec<f64>, kept: bool) {
        self.slips += 1;
        self.stiction = kept;
        self.slide = (!kept && ways.len() == self.contacts.len()).then_some(ways);
    }

    /// One vertex on two surfaces: it turns in the corner, then stays or leaves along one of the surfaces.
    fn relax_corner(&mut self, hand: [f64; 3], carry: &mut Carry) -> bool {
        let vertex = self.contacts[0].vertex;
        let (pose, end) = self.turn(&self.pose, vertex, hand, (f64::INFINITY, true));
        self.pose = pose;
        if end == End::Touch {
            self.land(carry);
            return false;
        }
        if self.admissible(&pose, &self.contacts, hand) {
            return true;
        }
        if let Some(Mode::Keep(kept)) = self.leaves_corner(hand) {
            self.release(&kept, carry);
        }
        false
    }

    /// Two contacts or more that hold the pose: they stay, slip along the one motion two of them leave free, or open.
    fn relax_locked(&mut self, hand: [f64; 3], carry: &mut Carry) -> bool {
        if carry.slipping {
            if self.admissible_in_slip(&self.pose, &self.contacts, hand) {
                return self.stop_slip(hand, carry);
            }
            if let Some(way) = self.pair().and_then(|pair| self.slip_of_pair(pair, hand)) {
                return self.slip_pair(way.0, way.1, hand, carry);
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
                self.slip_pair(pair, way, hand, carry)
            }
            Some(Mode::Keep(kept)) => {
                self.release(&kept, carry);
                false
            }
            None => {
                self.ambiguous = true;
                true
            }
        }
    }

    /// Two contacts that slipped are held by dynamic friction where another one has closed.
    fn stop_slip(&mut self, hand: [f64; 3], carry: &mut Carry) -> bool {
        let began = carry.began.unwrap_or(self.pose);
        if self.on_one_surface() {
            let [_, friction] = self.reaction(&self.pose, self.contacts[0], hand);
            let hard = self.pressed_hard(&self.pose, hand);
            self.end_slip(vec![-sign(friction); 2], hard);
        } else if let Some(pair) = self.pair() {
            self.end_slip(Vec::new(), self.slipped_far(pair, &began));
        }
        true
    }

    /// Two contacts slip until dynamic friction holds them.
    fn slip_pair(
        &mut self,
        pair: [Touch; 2],
        way: Screw,
        hand: [f64; 3],
        carry: &mut Carry,
    ) -> bool {
        let began = *carry.began.get_or_insert(self.pose);
        let (pose, way, end) = self.slide_pair(pair, way, hand, !carry.unwatched);
        self.pose = pose;
        let ways = self.speeds(&pose, pair, way).map(sign);
        match end {
            End::Touch => {
                self.land(carry);
            }
            End::Lift(index) if pair[0].surface == pair[1].surface => {
                self.release(&[pair[1 - index]], carry);
                carry.slipping = true;
            }
            End::Lift(index) => {
                let moved = length(sub(pose.position, began.position)) > MOVED * self.size;
                let opening = (index, ways);
                if self.contacts.len() == 2 && self.opens_in_slip(pair, opening, (hand, moved)) {
                    return true;
                }
                carry.unwatched = true;
                carry.slipping = true;
            }
            End::Rest if self.contacts.len() == 2 => {
                if let Some(index) = self.pulled(ways, hand) {
                    let opens = self.opens_in_slip(pair, (index, ways), (hand, true));
                    *carry = Carry::default();
                    return opens;
                }
                let kept = if pair[0].surface == pair[1].surface {
                    self.pressed_hard(&pose, hand)
                } else {
                    self.slipped_far(pair, &began)
                };
                self.end_slip(ways.to_vec(), kept);
                return true;
            }
            End::Rest => {
                self.slips += 1;
                *carry = Carry::default();
            }
            End::Snap => carry.slipping = false,
            End::Lost => {
                self.ambiguous = true;
                return true;
            }
        }
        false
    }

    /// The contact that the balance of a joint slip pulls on, instead of pressing.
    fn pulled(&self, ways: [f64; 2], hand: [f64; 3]) -> Option<usize> {
        let normals = self.pair_normals(&self.pose, self.pair()?, ways, hand)?;
        let weak = usize::from(normals[1] < normals[0]);
        (normals[weak] < -1e3 * self.force_tolerance(&self.pose, hand)).then_some(weak)
    }

    /// Opens the contact of this index in a joint slip, if the balance of the other one, or its slip, keeps the gap open.
    fn opens_in_slip(
        &mut self,
        pair: [Touch; 2],
        (index, ways): (usize, [f64; 2]),
        (hand, moved): ([f64; 3], bool),
    ) -> bool {
        let (left, kept, way) = (pair[index], pair[1 - index], ways[1 - index]);
        let mut alone = self.clone();
        alone.contacts = vec![kept];
        let open = |pose: &Pose| self.scene.gap(pose, left) >= -CLEARANCE * self.size;
        let (pose, _) = alone.turn(&self.pose, kept.vertex, hand, (f64::INFINITY, false));
        let [normal, friction] = alone.reaction(&pose, kept, hand);
        let held = normal > 0.0 && alone.admissible_in_slip(&pose, &[kept], hand);
        if held
            && open(&pose)
            && !alone.enters_beside(&pose, &[(left, f64::NEG_INFINITY)], CLEARANCE)
        {
            alone.pose = pose;
            alone.slips += u32::from(moved);
            alone.stiction |= alone.pressed_hard(&pose, hand);
            *self = alone;
            return true;
        }
        if -way * friction <= self.scene.surfaces[kept.surface].mu_d * normal {
            return false;
        }
        let (pose, end) = alone.slide_vertex((kept, way), &[left], hand);
        if end != End::Rest || !open(&pose) {
            return false;
        }
        alone.pose = pose;
        alone.end_slip(vec![way], alone.pressed_hard(&pose, hand));
        *self = alone;
        true
    }

    /// Takes up the vertices that have come into contact, under a frozen hand.
    fn land(&mut self, carry: &mut Carry) {
        self.take_up();
        *carry = Carry::default();
    }

    /// Takes up the vertices that have come into contact.
    pub(super) fn take_up(&mut self) {
        let gap = |touch| self.scene.gap(&self.pose, touch);
        let mut new: Vec<Touch> = self
            .others()
            .filter(|&touch| gap(touch) <= TOGETHER * self.size)
            .collect();
        if new.is_empty() {
            new.extend(self.others().min_by(|&a, &b| gap(a).total_cmp(&gap(b))));
        }
        self.contacts.extend(new);
        self.contacts
            .sort_by_key(|touch| (touch.vertex, touch.surface));
        self.pose = self.onto(self.pose, &self.contacts);
    }

    fn release(&mut self, kept: &[Touch], carry: &mut Carry) {
        carry.left = std::mem::replace(&mut self.contacts, kept.to_vec());
        carry.slipping = false;
    }
}
