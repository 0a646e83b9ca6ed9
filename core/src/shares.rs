//! The reactions of all states: the distribution of the load among the contacts.

use crate::cone::{ConeEdge, WrenchCone};
use crate::contact::MAX_CONTACTS;
use crate::geometry::Wrench;
use crate::list::gather;
use crate::motion::Motion;
use crate::real::Real;
use crate::state::{Body, Freedom, HandPose, gap_slope};
use crate::thresholds::Thresholds;
use crate::world::Statics;
use heapless::Vec;

/// N and T of each contact, in their order.
pub(crate) type Reactions<R> = Vec<[R; 2], MAX_CONTACTS>;

impl<R: Real> ConeEdge<R> {
    /// N and T of a component along it.
    fn reaction(&self, part: R) -> [R; 2] {
        [
            part * self.cone.cos,
            -self.slide.along(part * self.cone.sin),
        ]
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The reactions of all contacts at rest.
    pub(crate) fn reactions(&self, body: &Body<R>) -> Reactions<R> {
        let mut out = Reactions::new();
        let mut add = |reaction| {
            // There is room for one of each contact.
            let _ = out.push(reaction);
        };
        match self.freedom(body) {
            Freedom::Free => {}
            Freedom::Slides => add(self.reaction(body)),
            Freedom::Turns if body.contacts.len() == 1 => add(self.reaction(body)),
            Freedom::Together => self.sliding_shares(body).0.into_iter().for_each(add),
            Freedom::Fixed if self.is_edge(&body.contacts) => {
                self.edge_shares(body).into_iter().for_each(add);
            }
            Freedom::Turns | Freedom::Fixed => {
                let shares = self.fixed_shares(body);
                shares.into_iter().for_each(add);
            }
        }
        out
    }
    /// Two contacts that slide: along the edges of their cones, in balance. Where these differ enough they bear the force, since over a short
    /// lever the moment tells less; otherwise the second bears the moment about the first, and both together the force. Also that sine or lever:
    /// they are known to the rounding of the load over it.
    pub(crate) fn sliding_shares(&self, body: &Body<R>) -> ([[R; 2]; 2], R) {
        let contacts = body.contacts.pair();
        let [a, b] = contacts;
        if self.is_even(a, b) {
            return (self.edge_shares(body), R::ONE);
        }
        let [first, second] = &self.frames(contacts, body.rotation, body.holding);
        let load = self.present_load(body);
        let (f1, f2) = (self.edge(a, first).f, self.edge(b, second).f);
        let sine = f1.cross(f2);
        let (sizes, over) = if sine.abs() >= R::spread() {
            let force = load.force;
            ([f2.cross(force) / sine, force.cross(f1) / sine], sine)
        } else {
            let moment = load.moment - first.r.cross(load.force);
            let lever = (second.r - first.r).cross(f2);
            let of_second = -moment / lever;
            let of_first = -f1.dot(load.force) - f1.dot(f2) * of_second;
            ([of_first, of_second], lever)
        };
        let mut out = [[R::ZERO; 2]; 2];
        for ((slot, size), c) in out.iter_mut().zip(sizes).zip(contacts) {
            let cone = self.friction(c).sliding;
            *slot = [size * cone.cos, -c.sense.along(size * cone.sin)];
        }
        (out, over.abs())
    }
    /// Two contacts in one line: N_2 by the moment about the first (E20), T in proportion to N.
    fn edge_shares(&self, body: &Body<R>) -> [[R; 2]; 2] {
        let frames = body
            .contacts
            .pair()
            .map(|c| self.frame(c, body.rotation, body.holding));
        let [first, second] = &frames;
        let load = self.present_load(body);
        let [n, t] = self.reaction(body);
        let moment = load.moment - first.r.cross(load.force);
        let span = (second.r - first.r).cross(first.n);
        let of_second = (-(moment / span)).max(R::ZERO);
        let of_first = (n - of_second).max(R::ZERO);
        let sum = of_first + of_second;
        [of_first, of_second].map(|n| {
            let t = if sum > R::ZERO {
                t * (n / sum)
            } else {
                R::ZERO
            };
            [n, t]
        })
    }
    #[inline(never)]
    pub(crate) fn fixed_shares(&self, body: &Body<R>) -> Reactions<R> {
        let mut cone = WrenchCone::new();
        self.cone(body, &mut cone);
        // Along an edge of large friction the component of a reaction is far more than its N, and so is its moment over a long lever: of a
        // part of the load they are representable.
        let parts = cone.edges.iter().map(|c| c.cone.cos / c.wrench.size());
        let part = if R::is_fixed() {
            parts.fold(R::ONE, R::min).unit()
        } else {
            R::ONE
        };
        let load = self.present_load(body) * part;
        let shared = cone.shared(load, little(load), R::limit() * part);
        let mut out: Reactions<R> = gather(body.contacts.iter().map(|_| [R::ZERO; 2]));
        for (edge, &size) in cone.edges.iter().zip(&shared) {
            let [n, t] = edge.reaction(size).map(|x| x.scaled(part));
            if let Some([sum_n, sum_t]) = out.get_mut(edge.contact) {
                (*sum_n, *sum_t) = (*sum_n + n, *sum_t + t);
            }
        }
        out
    }
    /// The motion of two contacts that slide, in the direction of their senses: the one in which friction takes power by their velocities, as
    /// a foot that turns back goes the same way in both.
    pub(crate) fn sliding_pair(&self, body: &Body<R>, hand_p: HandPose<R>) -> Motion<R> {
        let pair = body.contacts.pair();
        let frames = self.frames(pair, body.rotation, body.holding);
        let [first, second] = &frames;
        let g = gap_slope(&frames);
        let velocity = first.t * g.y + first.r.turned() * g.x;
        let [v1, v2] = [first, second].map(|frame| frame.advance(velocity, -g.x));
        let [c1, c2] = pair;
        let along = c1.sense.along(v1) + c2.sense.along(v2);
        let sense = if along < R::ZERO { -R::ONE } else { R::ONE };
        self.pair_of(body, hand_p, sense, &frames)
    }
}

/// The residual that reactions may leave of a load: rounding, and what is as small as a gap that counts as closed.
fn little<R: Real>(load: Wrench<R>) -> R {
    R::of_balance(load.size()).doubled() + load.size() * R::TOUCH
}
