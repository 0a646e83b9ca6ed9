//! The distribution of a load among contacts that fix the pose: three edges of their cone bear any load in it, two or one come close to
//! others. And the reactions of all states.

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

/// Edges, and so components along them.
const MOST: usize = 2 * MAX_CONTACTS;
/// The components along edges that are almost coplanar are computed at most this many times, and refined in between.
const REFINEMENTS: usize = 4;

/// N and T of each contact, in their order.
pub(crate) type Reactions<R> = Vec<[R; 2], MAX_CONTACTS>;

/// The component along an edge, by its place.
#[derive(Clone, Copy, Debug)]
struct Part<R> {
    edge: usize,
    size: R,
}

impl<R: Real> Part<R> {
    const NONE: Self = Self {
        edge: 0,
        size: R::ZERO,
    };
}

/// Components along up to three edges.
type Solution<R> = [Part<R>; 3];

impl<R: Real> WrenchCone<R> {
    /// The mean of all sets of components that bear a load on three edges within the limit, or the closest to that.
    #[inline(never)]
    fn shared(&self, load: Wrench<R>, little: R, limit: R) -> Vec<R, MOST> {
        let mut parts = self.none();
        let (mut count, mut large) = (0_i32, None);
        self.triples(|edges| {
            let Some(solution) = self.bearing(edges, load, little) else {
                return;
            };
            if self.is_within_limit(&solution, limit) {
                count = count.saturating_add(1);
                add(&mut parts, &solution);
            } else {
                large = Some(solution);
            }
        });
        if let (0, Some(solution)) = (count, large) {
            add(&mut parts, &solution);
        }
        let share = R::ONE / R::from_int(count.max(1));
        for part in &mut parts {
            *part = *part * share;
        }
        self.approach(load, &mut parts);
        parts
    }
    /// Removes the rounding; if no three edges bear the load, this is the closest that up to three come to it.
    #[inline(never)]
    fn approach(&self, load: Wrench<R>, parts: &mut Vec<R, MOST>) {
        for _ in 0..2 {
            let rest = self.remainder(load, parts);
            if rest.size() <= R::of_balance(load.size()).halved() {
                return;
            }
            let (mut left, mut better) = (rest.size(), None);
            let mut consider = |solution: Solution<R>| {
                let mut trial = parts.clone();
                add(&mut trial, &solution);
                let size = self.remainder(load, &trial).size();
                if size < left {
                    (left, better) = (size, Some(solution));
                }
            };
            self.solutions(rest, &mut consider);
            match better {
                Some(solution) => add(parts, &solution),
                None => return,
            }
        }
    }
    /// The components along any three, two and single edges that bear a load or come closest to it.
    fn solutions(&self, load: Wrench<R>, consider: &mut dyn FnMut(Solution<R>)) {
        self.triples(|edges| {
            if let Some((solution, _)) = self.on_three(edges, load) {
                consider(solution);
            }
        });
        let n = self.edges.len();
        for i in 0..n {
            for k in i.saturating_add(1)..n {
                if let Some([a, b]) = self.on_two([i, k], load) {
                    consider([a, b, Part::NONE]);
                }
            }
        }
        for (edge, along) in self.edges.iter().enumerate() {
            let w = along.wrench;
            let size = -(w.dot(load) / w.dot(w));
            consider([Part { edge, size }, Part::NONE, Part::NONE]);
        }
    }
    fn none(&self) -> Vec<R, MOST> {
        gather(self.edges.iter().map(|_| R::ZERO))
    }
    /// What components along the edges leave of a load.
    #[inline(never)]
    fn remainder(&self, load: Wrench<R>, parts: &[R]) -> Wrench<R> {
        let edges = self.edges.iter().zip(parts);
        edges.fold(load, |rest, (edge, &part)| rest + edge.wrench * part)
    }
    /// Any three edges.
    fn triples(&self, mut each: impl FnMut([usize; 3])) {
        let n = self.edges.len();
        for i in 0..n {
            for j in i.saturating_add(1)..n {
                for k in j.saturating_add(1)..n {
                    each([i, j, k]);
                }
            }
        }
    }
    fn wrench(&self, edge: usize) -> Option<Wrench<R>> {
        self.edges.get(edge).map(|edge| edge.wrench)
    }
    /// The components along three edges that bear a load; those along edges that are almost coplanar are refined.
    #[inline(never)]
    fn bearing(&self, edges: [usize; 3], load: Wrench<R>, little: R) -> Option<Solution<R>> {
        let (mut solution, volume) = self.on_three(edges, load)?;
        let presses = |solution: &Solution<R>| {
            let is_usable = |part: &Part<R>| part.size >= R::ZERO && part.size < R::HUGE;
            solution.iter().all(is_usable)
        };
        if !presses(&solution) {
            return None;
        }
        if volume > R::sharp() {
            return Some(solution);
        }
        for _ in 0..REFINEMENTS {
            let mut parts = self.none();
            add(&mut parts, &solution);
            let rest = self.remainder(load, &parts);
            let sum = solution.iter().fold(R::ZERO, |sum, part| sum + part.size);
            let rounding = (R::EPSILON * sum * R::from_int(4)).min(load.size() * R::divisor());
            let size = rest.size();
            if size <= little + rounding {
                return presses(&solution).then_some(solution);
            }
            // In units of its size, as it is small beside the load.
            let unit = size.unit();
            let (more, _) = self.on_three(edges, rest.in_units(unit))?;
            for (part, more) in solution.iter_mut().zip(more) {
                part.size = part.size + more.size * unit;
            }
        }
        None
    }
    /// The components along three edges that balance a load, and the volume of the edges.
    #[inline(never)]
    fn on_three(&self, [i, j, k]: [usize; 3], load: Wrench<R>) -> Option<(Solution<R>, R)> {
        let (a, b, c) = (self.wrench(i)?, self.wrench(j)?, self.wrench(k)?);
        let (ab, bc, ca) = (a.cross(b), b.cross(c), c.cross(a));
        let volume = a.dot(bc);
        let part = |edge, face: Wrench<R>| Part {
            edge,
            size: -(face.dot(load) / volume),
        };
        // A component that is hardly known shows in its residual.
        let is_usable = volume.abs() > R::EPSILON;
        is_usable.then(|| ([part(i, bc), part(j, ca), part(k, ab)], volume.abs()))
    }
    /// The components along two edges that come closest to bearing a load.
    fn on_two(&self, [i, k]: [usize; 2], load: Wrench<R>) -> Option<[Part<R>; 2]> {
        let (a, b) = (self.wrench(i)?, self.wrench(k)?);
        let normal = a.cross(b);
        let square = normal.dot(normal);
        let part = |edge, face: Wrench<R>| Part {
            edge,
            size: -(face.dot(normal) / square),
        };
        let is_usable = normal.size() > R::EPSILON * R::from_int(4);
        is_usable.then(|| [part(i, load.cross(b)), part(k, a.cross(load))])
    }
    /// No contact has to press harder than the limit up to which reactions are reported as they are.
    fn is_within_limit(&self, solution: &[Part<R>], limit: R) -> bool {
        let edges = &self.edges;
        let pressing = |contact: usize| {
            let own = solution.iter().filter_map(|part| {
                let edge = edges
                    .get(part.edge)
                    .filter(|edge| edge.contact == contact)?;
                Some(edge.cone.cos * part.size)
            });
            own.fold(R::ZERO, |sum, part| sum + part)
        };
        (0..MAX_CONTACTS).all(|contact| pressing(contact) <= limit)
    }
}

/// Adds to the components along some edges; no component falls below zero.
fn add<R: Real>(parts: &mut Vec<R, MOST>, more: &[Part<R>]) {
    for part in more {
        if let Some(sum) = parts.get_mut(part.edge) {
            *sum = (*sum + part.size).max(R::ZERO);
        }
    }
}

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
        match body.freedom() {
            Freedom::Free => {}
            Freedom::Slides => add(self.reaction(body)),
            Freedom::Turns if body.contacts.len() == 1 => add(self.reaction(body)),
            Freedom::Together => self.sliding_shares(body).into_iter().for_each(add),
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
    /// lever the moment tells less; otherwise each bears the moment about the other.
    fn sliding_shares(&self, body: &Body<R>) -> [[R; 2]; 2] {
        let contacts = body.contacts.pair();
        let [a, b] = contacts;
        if self.is_even(a, b) {
            return self.edge_shares(body);
        }
        let [first, second] = &self.frames(contacts, body.rotation, body.holding);
        let load = self.present_load(body);
        let (f1, f2) = (self.edge(a, first).f, self.edge(b, second).f);
        let sine = f1.cross(f2);
        let sizes = if sine.abs() >= R::spread() {
            let force = load.force;
            [f2.cross(force) / sine, force.cross(f1) / sine]
        } else {
            let r12 = second.r - first.r;
            let [m1, m2] = [first, second].map(|at| load.moment - at.r.cross(load.force));
            [m2 / r12.cross(f1), -m1 / r12.cross(f2)]
        };
        let mut out = [[R::ZERO; 2]; 2];
        for ((slot, size), c) in out.iter_mut().zip(sizes).zip(contacts) {
            let cone = self.friction(c).sliding;
            *slot = [size * cone.cos, -c.sense.along(size * cone.sin)];
        }
        out
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
        // Along an edge of large friction the component of a reaction is far more than its N: of a part of the load it is representable.
        let cosines = cone.edges.iter().map(|edge| edge.cone.cos.doubled());
        let part = if R::is_fixed() {
            cosines.fold(R::ONE, R::min).unit()
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
