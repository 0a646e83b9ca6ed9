//! The body comes to rest under a frozen hand: one motion after another, each chosen from the contacts and the load, until
//! forces inside the static friction cones balance it.

use super::cone::{inner, times};
use super::scene::{Screw, Touch, add, cross, dot, scale, sub};
use super::statics::sign;
use super::walk::End;
use super::{CLEARANCE, Reference};

/// Motions after which the body is left where it is.
const MOTIONS: usize = 60;
/// Vertices that come this close together with the first one touch with it, in body sizes.
const TOGETHER: f64 = 1e-10;
/// A contact that the free pose leaves by less than this carries nothing worth a motion, in body sizes.
const WEIGHTLESS: f64 = 1e-5;
/// A gap that changes more slowly than this, per unit of a unit twist, neither opens nor closes.
const STILL: f64 = 1e-9;

/// What a motion has left to the next one.
#[derive(Default)]
struct Carry {
    /// The last contact slides already: dynamic friction decides.
    sliding: bool,
    /// Contacts that have just opened.
    left: Vec<Touch>,
}

/// A motion from which the static test starts again.
enum Mode {
    Slide([Touch; 2], Screw),
    Keep(Vec<Touch>),
}

impl Reference {
    /// Relaxes under the frozen `hand`.
    pub(super) fn relax(&mut self, hand: [f64; 3]) {
        let mut carry = Carry::default();
        for _ in 0..MOTIONS {
            let rested = match *self.contacts.as_slice() {
                [] => self.relax_free(hand, &mut carry),
                [only] => self.relax_vertex(only, hand, &mut carry),
                [a, b] if a.vertex == b.vertex => self.relax_corner([a, b], hand, &mut carry),
                _ => self.relax_locked(hand, &mut carry),
            };
            if rested {
                return;
            }
        }
        self.ambiguous = true;
    }

    fn relax_free(&mut self, hand: [f64; 3], carry: &mut Carry) -> bool {
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
        if carry.sliding && self.slides_on(touch, hand, carry) {
            return false;
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
        if self.admissible(&pose, &[touch], hand) {
            return true;
        }
        let (pose, end) = self.slide_vertex((touch, -sign(friction)), &carry.left, hand);
        self.pose = pose;
        self.follow_slide(end, carry);
        end == End::Lost
    }

    /// A contact that was sliding together with another one slides on while dynamic friction cannot hold it.
    fn slides_on(&mut self, touch: Touch, hand: [f64; 3], carry: &mut Carry) -> bool {
        carry.sliding = false;
        let [normal, friction] = self.reaction(&self.pose, touch, hand);
        let excess = friction.abs() - self.scene.surfaces[touch.surface].mu_d * normal;
        if normal <= 0.0 || excess <= self.force_tolerance(&self.pose, hand) {
            return false;
        }
        let (pose, end) = self.slide_vertex((touch, -sign(friction)), &carry.left, hand);
        self.pose = pose;
        self.follow_slide(end, carry);
        true
    }

    /// One vertex on two surfaces: it turns in the corner, then stays or leaves along one of the surfaces.
    fn relax_corner(&mut self, pair: [Touch; 2], hand: [f64; 3], carry: &mut Carry) -> bool {
        let (pose, end) = self.turn(&self.pose, pair[0].vertex, hand, (f64::INFINITY, true));
        self.pose = pose;
        if end == End::Touch {
            self.land(carry);
            return false;
        }
        if self.admissible(&pose, &pair, hand) {
            return true;
        }
        for (kept, other) in [(pair[0], pair[1]), (pair[1], pair[0])] {
            let surface = self.scene.surfaces[kept.surface];
            let [normal, friction] = self.reaction(&pose, kept, hand);
            let way = scale(-sign(friction), surface.tangent());
            let leaves = dot(way, self.scene.surfaces[other.surface].normal) > 0.0;
            if normal > 0.0 && friction.abs() > surface.mu_s * normal && leaves {
                self.release(&[kept], carry);
                return false;
            }
        }
        self.release(&[], carry);
        false
    }

    /// Two contacts or more that hold the pose: they stay, slide along the one motion two of them leave free, or open.
    fn relax_locked(&mut self, hand: [f64; 3], carry: &mut Carry) -> bool {
        if self.admissible(&self.pose, &self.contacts, hand) {
            return true;
        }
        match self.mode(hand) {
            Some(Mode::Slide(pair, way)) => {
                let stays = |touch: &Touch| {
                    pair.contains(touch)
                        || inner(self.normal_line(&self.pose, *touch), way) <= STILL
                };
                self.contacts = self.contacts.iter().copied().filter(stays).collect();
                let (pose, end) = self.slide_pair(pair, way, hand);
                self.pose = pose;
                let end = match end {
                    End::Lift(index) => End::Lift(
                        self.contacts
                            .iter()
                            .position(|&touch| touch == pair[index])
                            .unwrap_or(0),
                    ),
                    other => other,
                };
                self.follow_slide(end, carry);
                end == End::Lost
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

    /// What the contacts do that cannot hold: turn about one that sticks, else slide with the fewest openings, else come free.
    fn mode(&self, hand: [f64; 3]) -> Option<Mode> {
        let count = self.contacts.len();
        let pairs = || {
            (0..count)
                .flat_map(|i| (i + 1..count).map(move |j| [self.contacts[i], self.contacts[j]]))
        };
        let corner = || {
            pairs().find(|pair| {
                count > 2 && pair[0].vertex == pair[1].vertex && self.pivots(pair, hand)
            })
        };
        let single = |sticks: bool| {
            self.contacts.iter().copied().find(|&touch| {
                let [normal, friction] = self.reaction(&self.pose, touch, hand);
                let held = friction.abs() <= self.scene.surfaces[touch.surface].mu_s * normal;
                normal > 0.0 && (held || !sticks) && self.pivots(&[touch], hand)
            })
        };
        let slide = |pressed: bool| {
            let slides = pairs().filter_map(|pair| self.slide_mode(pair, pressed, hand));
            slides
                .max_by(|a, b| a.1.total_cmp(&b.1))
                .map(|(mode, _)| mode)
        };
        let keep = |touch: Touch| Mode::Keep(vec![touch]);
        let corner = corner().map(|pair| Mode::Keep(pair.to_vec()));
        let turns = corner.or_else(|| single(true).map(keep));
        let moves = turns
            .or_else(|| slide(true))
            .or_else(|| slide(false))
            .or_else(|| single(false).map(keep));
        moves.or_else(|| self.opens(hand).then(|| Mode::Keep(Vec::new())))
    }

    /// Whether the way to the free pose opens all contacts.
    fn opens(&self, hand: [f64; 3]) -> bool {
        let held = self.scene.holding_point;
        let (from, target) = (self.pose, self.free_pose(hand));
        let shift = sub(target.apply(held), from.apply(held));
        let turn = target.angle - from.angle;
        self.contacts.iter().all(|&touch| {
            let arm = sub(
                from.apply(self.scene.vertices[touch.vertex]),
                from.apply(held),
            );
            let velocity = add(shift, scale(turn, [-arm[1], arm[0]]));
            dot(velocity, self.scene.surfaces[touch.surface].normal) > -CLEARANCE * self.size
        })
    }

    /// The slide of a pair, if the load drives it, both contacts (or one, if not `pressed`) press and all others stay or open;
    /// with its drive.
    fn slide_mode(&self, pair: [Touch; 2], pressed: bool, hand: [f64; 3]) -> Option<(Mode, f64)> {
        if pair[0].vertex == pair[1].vertex {
            return None;
        }
        let twist = self.free_twist(&self.pose, pair);
        [twist, times(-1.0, twist)].into_iter().find_map(|way| {
            let state = self.sliding(&self.pose, pair, way, hand)?;
            let tolerance = self.force_tolerance(&self.pose, hand);
            let [first, second] = state.normals;
            let presses =
                first.max(second) > tolerance && (!pressed || first.min(second) >= -tolerance);
            let opens = |&touch: &Touch| {
                pair.contains(&touch) || inner(self.normal_line(&self.pose, touch), way) >= -STILL
            };
            let runs = presses && state.drive > 0.0 && self.contacts.iter().all(opens);
            runs.then_some((Mode::Slide(pair, way), state.drive))
        })
    }

    /// Whether the load turns the body about the kept vertex so that all other contacts open, and the kept ones can hold it.
    fn pivots(&self, kept: &[Touch], hand: [f64; 3]) -> bool {
        let pin = self.pose.apply(self.scene.vertices[kept[0].vertex]);
        let moment = self.scene.applied_moment(&self.pose, hand, pin);
        let opens = |&touch: &Touch| {
            let arm = sub(self.pose.apply(self.scene.vertices[touch.vertex]), pin);
            kept.contains(&touch)
                || sign(moment) * cross(arm, self.scene.surfaces[touch.surface].normal)
                    > STILL * self.size
        };
        self.contacts.iter().all(opens) && (kept.len() == 1 || self.carries(kept, hand))
    }

    /// Whether the two cones of a corner carry the applied force.
    fn carries(&self, pair: &[Touch], hand: [f64; 3]) -> bool {
        let pin = self.pose.apply(self.scene.vertices[pair[0].vertex]);
        let mut free_of_moment = self.clone();
        let turn = self.scene.applied_moment(&self.pose, hand, pin);
        let balanced = if self.scene.k_theta > 0.0 {
            hand[2] - turn / self.scene.k_theta
        } else {
            hand[2]
        };
        free_of_moment.contacts = pair.to_vec();
        free_of_moment.admissible(&self.pose, pair, [hand[0], hand[1], balanced])
    }

    fn follow_slide(&mut self, end: End, carry: &mut Carry) {
        match end {
            End::Touch => self.land(carry),
            End::Lift(index) => {
                let mut kept = self.contacts.clone();
                kept.remove(index);
                self.release(&kept, carry);
                carry.sliding = true;
            }
            End::Rest => {
                self.slips += 1;
                carry.sliding = false;
            }
            End::Snap => carry.sliding = false,
            End::Lost => self.ambiguous = true,
        }
    }

    /// Takes up the vertices that have come into contact.
    fn land(&mut self, carry: &mut Carry) {
        let near = |&touch: &Touch| self.scene.gap(&self.pose, touch) <= TOGETHER * self.size;
        let new: Vec<Touch> = self.others().filter(near).collect();
        self.contacts.extend(new);
        self.contacts
            .sort_by_key(|touch| (touch.vertex, touch.surface));
        self.pose = self.onto(self.pose, &self.contacts);
        *carry = Carry::default();
    }

    fn release(&mut self, kept: &[Touch], carry: &mut Carry) {
        carry.left = std::mem::replace(&mut self.contacts, kept.to_vec());
        carry.sliding = false;
    }
}
