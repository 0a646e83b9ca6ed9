//! The components of a load along the edges of a cone: three bear any load in it, two or one come close to others (STATICS 9).

use crate::cone::WrenchCone;
use crate::contact::MAX_CONTACTS;
use crate::geometry::Wrench;
use crate::list::gather;
use crate::real::Real;
use crate::thresholds::Thresholds;
use heapless::Vec;

/// Edges, and so components along them.
const MOST: usize = 2 * MAX_CONTACTS;
/// The components along edges that are almost coplanar are computed at most this many times, and refined in between.
const REFINEMENTS: usize = 4;

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
    /// The mean of all components along three edges that bear a load within the limit, or along two or one where no three do; beyond the limit
    /// those of one set, and otherwise the closest to the load.
    #[inline(never)]
    pub(crate) fn shared(&self, load: Wrench<R>, little: R, limit: R) -> Vec<R, MOST> {
        let (mut parts, mut large) = (self.none(), None);
        let mut count = 0_i32;
        for size in [3, 2, 1] {
            self.sets(size, &mut |edges| {
                let Some(solution) = self.bearing(edges, load, little) else {
                    return;
                };
                if self.is_within_limit(&solution, limit) {
                    count = count.saturating_add(1);
                    average(&mut parts, &solution, R::ONE / R::from_int(count));
                } else {
                    large = Some(solution);
                }
            });
            if count > 0 {
                break;
            }
        }
        if let (0, Some(solution)) = (count, large) {
            add(&mut parts, &solution);
        }
        self.approach(load, &mut parts);
        parts
    }
    /// Removes the rounding; if no edges bear the load, this is the closest that up to three come to it.
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
        for size in [3, 2, 1] {
            self.sets(size, &mut |edges| {
                if let Some((solution, _)) = self.on(edges, load) {
                    consider(solution);
                }
            });
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
    /// Any one, two or three edges.
    fn sets(&self, size: usize, each: &mut dyn FnMut(&[usize])) {
        let n = self.edges.len();
        for i in 0..n {
            if size == 1 {
                each(&[i]);
                continue;
            }
            for j in i.saturating_add(1)..n {
                if size == 2 {
                    each(&[i, j]);
                    continue;
                }
                for k in j.saturating_add(1)..n {
                    each(&[i, j, k]);
                }
            }
        }
    }
    fn wrench(&self, edge: usize) -> Option<Wrench<R>> {
        self.edges.get(edge).map(|edge| edge.wrench)
    }
    /// The components along edges that bear a load; those along edges that are almost coplanar are refined.
    #[inline(never)]
    fn bearing(&self, edges: &[usize], load: Wrench<R>, little: R) -> Option<Solution<R>> {
        let (mut solution, volume) = self.on(edges, load)?;
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
            if rest.size() <= little + rounding {
                return presses(&solution).then_some(solution);
            }
            let (more, _) = self.on(edges, rest)?;
            for (part, more) in solution.iter_mut().zip(more) {
                part.size = part.size + more.size;
            }
        }
        None
    }
    /// The components along edges that balance a load or come closest to it, and the volume of three.
    #[inline(never)]
    fn on(&self, edges: &[usize], load: Wrench<R>) -> Option<(Solution<R>, R)> {
        let (load, unit) = normalized(load);
        let (mut solution, small, volume) = match *edges {
            [i, j, k] => self.on_three([i, j, k], load)?,
            [i, k] => self.on_two([i, k], load)?,
            [i] => self.on_one(i, load)?,
            _ => return None,
        };
        let times = unit.in_units(small);
        for part in &mut solution {
            part.size = part.size * times;
        }
        Some((solution, volume))
    }
    /// The components along three edges that balance a load, divided by a unit, this unit, and the volume of the edges.
    fn on_three(&self, [i, j, k]: [usize; 3], load: Wrench<R>) -> Option<(Solution<R>, R, R)> {
        let (a, b, c) = (self.wrench(i)?, self.wrench(j)?, self.wrench(k)?);
        let (ab, bc, ca) = (a.cross(b), b.cross(c), c.cross(a));
        let volume = a.dot(bc);
        let small = unit_of(volume);
        let divisor = volume.in_units(small);
        let part = |edge, face: Wrench<R>| Part {
            edge,
            size: -(face.dot(load) / divisor),
        };
        // A component that is hardly known shows in its residual.
        let is_usable = volume.abs() > R::EPSILON;
        let solution = [part(i, bc), part(j, ca), part(k, ab)];
        is_usable.then_some((solution, small, volume.abs()))
    }
    /// The components along two edges that come closest to bearing a load, divided by a unit, this unit, and no volume.
    fn on_two(&self, [i, k]: [usize; 2], load: Wrench<R>) -> Option<(Solution<R>, R, R)> {
        let (a, b) = (self.wrench(i)?, self.wrench(k)?);
        let across = a.cross(b);
        let (normal, small) = normalized(across);
        let square = normal.dot(normal);
        let part = |edge, face: Wrench<R>| Part {
            edge,
            size: -(face.dot(normal) / square),
        };
        let is_usable = across.size() > R::EPSILON * R::from_int(4);
        let solution = [part(i, load.cross(b)), part(k, a.cross(load)), Part::NONE];
        is_usable.then_some((solution, small, R::ZERO))
    }
    /// The component along an edge that comes closest to bearing a load, divided by a unit, this unit, and no volume.
    fn on_one(&self, edge: usize, load: Wrench<R>) -> Option<(Solution<R>, R, R)> {
        let (along, small) = normalized(self.wrench(edge)?);
        let size = -(along.dot(load) / along.dot(along));
        Some((
            [Part { edge, size }, Part::NONE, Part::NONE],
            small,
            R::ZERO,
        ))
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

/// The mean with one more solution, of this share.
fn average<R: Real>(parts: &mut Vec<R, MOST>, solution: &[Part<R>], share: R) {
    for (edge, part) in parts.iter_mut().enumerate() {
        let own = solution.iter().filter(|own| own.edge == edge);
        let size = own.fold(R::ZERO, |sum, own| sum + own.size);
        *part = *part + (size - *part) * share;
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

/// A wrench in units of its size, and this unit.
fn normalized<R: Real>(w: Wrench<R>) -> (Wrench<R>, R) {
    let unit = unit_of(w.size());
    (w.in_units(unit), unit)
}

/// In fixed point a unit in which products with a number of this size are representable, and small ones keep their digits.
fn unit_of<R: Real>(size: R) -> R {
    if R::is_fixed() {
        size.abs().max(R::EPSILON).unit()
    } else {
        R::ONE
    }
}
