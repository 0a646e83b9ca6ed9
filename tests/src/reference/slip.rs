//! Slips under a frozen hand, and their ends: the memory of the contacts decides whether they stick or slide on with the hand.

use super::contact::Touch;
use super::relax::{Carry, Driven};
use super::scene::{Pose, Screw, length, sub};
use super::statics::sign;
use super::walk::{End, SMALLEST};
use super::{CLEARANCE, Reference};

/// A shorter joint slip does not count, in body sizes.
const MOVED: f64 = 1e-9;
/// A balance counts as pulling on a contact if the pull exceeds this, in force tolerances.
const PULL: f64 = 1e3;

impl Reference {
    /// One vertex slips until dynamic friction holds it.
    pub(super) fn slip_vertex(
        &mut self,
        slip: (Touch, f64),
        hand: [f64; 3],
        carry: &mut Carry,
    ) -> bool {
        let (mut pose, end) = self.slide_vertex(slip, &carry.left, hand);
        if end == End::Snap && pose == self.pose {
            // It is at the fold and has to be moved across it.
            pose = self.shifted(&pose, slip, 2.0 * SMALLEST * self.size);
        }
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
            End::Off(_) => {
                carry.left.clear();
                self.pass_on((0, slip.1), hand, carry);
            }
            End::Snap => {}
            End::Lost => {
                self.ambiguous = true;
                return true;
            }
        }
        false
    }

    /// Stops two slipping contacts if dynamic friction holds them from the start, for example when one of them has just closed.
    pub(super) fn stop_slip(&mut self, hand: [f64; 3]) -> bool {
        let mut ways = Vec::new();
        if self.on_one_surface() {
            let [_, friction] = self.reaction(&self.pose, self.contacts[0], hand);
            ways = vec![-sign(friction); 2];
        }
        if self.contacts.len() == 2 {
            let staying = self.keeps_stiction(&ways, hand);
            self.end_slip(ways, staying);
        }
        true
    }

    /// Whether two contacts have the stiction bit after a slip along `ways` that has ended; if it was held from the start, as before.
    fn keeps_stiction(&self, ways: &[f64], hand: [f64; 3]) -> bool {
        match (self.pair(), ways) {
            (Some(pair), &[first, second]) => {
                self.would_slip(&self.pose, pair, [first, second], hand)
            }
            (Some(_), _) => self.stiction,
            (None, _) => self.pressed_hard(&self.pose, hand),
        }
    }

    /// Two contacts slip until dynamic friction holds them.
    pub(super) fn slip_pair(
        &mut self,
        (pair, way): ([Touch; 2], Screw),
        hand: [f64; 3],
        carry: &mut Carry,
    ) -> bool {
        let began = *carry.began.get_or_insert(self.pose);
        let (pose, way, end) = self.slide_pair(pair, way, hand, !carry.unwatched);
        self.pose = pose;
        let ways = self.speeds(&pose, pair, way).map(sign);
        match end {
            End::Touch => self.land(carry),
            // A flat contact continues to slip, any other one is tested with its new normal.
            End::Off(index) => {
                self.contacts = pair.to_vec();
                if self.pass_on((index, ways[index]), hand, carry) {
                    let pair = [self.contacts[0], self.contacts[1]];
                    let onward = self.onward(&self.pose, pair, way);
                    carry.driven = Some(Driven::Pair(pair, onward));
                }
            }
            End::Lift(index) if self.lined(&pose, pair) => {
                self.release(&[pair[1 - index]], carry);
                carry.slipping = true;
            }
            End::Lift(index) => {
                let opening = (pair[index], pair[1 - index], Some(ways[1 - index]));
                if self.contacts.len() == 2 && self.opens_in_slip(opening, &began, hand) {
                    return true;
                }
                carry.unwatched = true;
                carry.driven = Some(Driven::Pair(pair, way));
            }
            End::Rest if self.contacts.len() == 2 => {
                if let Some(index) = self.pulled(ways, hand) {
                    *carry = Carry::default();
                    return self.opens_in_slip((pair[index], pair[1 - index], None), &began, hand);
                }
                let staying = self.keeps_stiction(&ways, hand);
                self.end_slip(ways.to_vec(), staying);
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

    /// The end of a slip at dynamic friction: the contacts stick and have the stiction bit if it is `staying`; otherwise
    /// they slide on.
    fn end_slip(&mut self, ways: Vec<f64>, staying: bool) {
        self.slips += 1;
        self.stiction = staying;
        self.slide = (!staying && ways.len() == self.contacts.len()).then_some(ways);
    }

    /// The contact that the balance of a joint slip pulls on instead of pressing.
    fn pulled(&self, ways: [f64; 2], hand: [f64; 3]) -> Option<usize> {
        let normals = self.pair_normals(&self.pose, self.pair()?, ways, hand)?;
        let weak = usize::from(normals[1] < normals[0]);
        (normals[weak] < -PULL * self.force_tolerance(&self.pose, hand)).then_some(weak)
    }

    /// Opens the contact `left` in a joint slip, if the gap stays open in the balance of the contact that is `staying`, in its
    /// slip along `way` (if given), or in the lift of both.
    fn opens_in_slip(
        &mut self,
        (left, staying, way): (Touch, Touch, Option<f64>),
        began: &Pose,
        hand: [f64; 3],
    ) -> bool {
        let moved = length(sub(self.pose.position, began.position)) > MOVED * self.size;
        let open = |pose: &Pose| self.scene.gap(pose, left) >= -CLEARANCE * self.size;
        let mut alone = self.clone();
        alone.pose = alone
            .turn(&self.pose, staying, hand, (f64::INFINITY, false))
            .0;
        let [normal, friction] = alone.reaction(&alone.pose, staying, hand);
        let held = normal > 0.0 && alone.admissible_in_slip(&alone.pose, &[staying], hand);
        if held && open(&alone.pose) && !alone.enters(&alone.pose, CLEARANCE) {
            alone.contacts = vec![staying];
            alone.slips += u32::from(moved);
            alone.stiction |= alone.pressed_hard(&alone.pose, hand);
            *self = alone;
            return true;
        }
        if normal <= 0.0 && self.comes_free(hand, 0.0) {
            self.contacts.clear();
            if self.scene.obstacles.is_empty() {
                self.pose = self.free_pose(hand);
            }
            return false;
        }
        let way = way.unwrap_or(-sign(friction));
        if normal <= 0.0 || -way * friction <= self.scene.friction(staying).mu_d * normal {
            return false;
        }
        let (pose, end) = alone.slide_vertex((staying, way), &[], hand);
        if end != End::Rest || !open(&pose) {
            return false;
        }
        alone.contacts = vec![staying];
        alone.pose = pose;
        alone.end_slip(vec![way], alone.pressed_hard(&pose, hand));
        *self = alone;
        true
    }
}
