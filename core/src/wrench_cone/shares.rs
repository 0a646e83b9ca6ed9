//! The distribution of a load among the contacts: three edges of the cone bear any load in it, two or one come close to others.

use heapless::Vec;

use super::{MAX_EDGES, WrenchCone};
use crate::contact::MAX_CONTACTS;
use crate::list::gather;
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::work::{THREE, TRIAL};
use crate::wrench2::Wrench2;

/// The components along edges that are almost coplanar are computed at most this many times, and refined in between.
const REFINEMENTS: usize = 4;

impl<R: Real> WrenchCone<R> {
    /// True if three given edges bear a load up to a small residual, with no reaction beyond the limit.
    pub(crate) fn bears_on(&self, edges: [u8; 3], load: Wrench2<R>, little: R) -> bool {
        let parts = self.bearing(edges.map(usize::from), load, little);
        parts.is_some_and(|parts| self.is_within_limit(&parts))
    }

    /// Finds three such edges.
    pub(crate) fn bearers(&self, load: Wrench2<R>, little: R) -> Option<[u8; 3]> {
        let small = |edges: [usize; 3]| edges.map(|k| u8::try_from(k).unwrap_or(u8::MAX));
        let mut triples = self.triples().map(small);
        triples.find(|&edges| self.bears_on(edges, load, little))
    }

    /// True if three edges bear a load up to a small residual, however large the reactions.
    pub(crate) fn jams(&self, load: Wrench2<R>, little: R) -> bool {
        let (mut part, step) = (load, R::digits());
        while part.size() > little * step {
            let mut is_beyond = false;
            for edges in self.triples() {
                self.spend(THREE);
                let Some((solution, volume)) = self.on_three(edges, part) else {
                    continue;
                };
                let mut parts = solution.iter().map(|&(_, part)| part);
                is_beyond |=
                    parts.clone().all(|part| part >= R::ZERO) && parts.any(|part| part >= R::HUGE);
                if (self.refined(edges, (solution, volume), (part, little))).is_some() {
                    return true;
                }
            }
            if !is_beyond {
                return false;
            }
            // Reactions beyond the range of the numbers: those that bear a fraction of the load are within it.
            part = part.over(step);
        }
        false
    }

    /// True if no contact has to press harder than the limit up to which reactions are reported as they are.
    #[inline(never)]
    fn is_within_limit(&self, solution: &[(usize, R)]) -> bool {
        (0..self.levers.len()).all(|contact| {
            let edges = solution
                .iter()
                .filter_map(|&(k, part)| Some((self.edges.get(k)?, part)));
            let own = edges.filter(|(edge, _)| edge.contact == contact);
            own.fold(R::ZERO, |sum, (edge, part)| sum + edge.pressing * part) <= R::limit()
        })
    }

    /// True if some contact of those that come closest to bearing a load presses harder than the limit up to which reactions are reported
    /// as they are.
    pub(crate) fn exceeds_limit(&self, load: Wrench2<R>, little: R) -> bool {
        let (parts, _) = self.parts(load, little);
        let all: Vec<(usize, R), MAX_EDGES> = gather(parts.iter().copied().enumerate());
        !self.is_within_limit(&all)
    }

    /// The residual of a load after the reactions that come closest to bearing it.
    pub(crate) fn left(&self, load: Wrench2<R>, little: R) -> R {
        self.parts(load, little).1
    }

    /// Distributes a load among the contacts, as components along the +t and the -t edge of each: the mean of all sets of components that
    /// bear it, up to a small residual, on three edges. For two contacts that is the middle of the interval of (E5).
    pub(crate) fn share(&self, load: Wrench2<R>, little: R) -> Vec<[R; 2], MAX_CONTACTS> {
        let (parts, _) = self.parts(load, little);
        let pairs = parts.chunks_exact(2);
        gather(pairs.filter_map(|pair| <[R; 2]>::try_from(pair).ok()))
    }

    /// The components of the load edge by edge, and its residual. If the reactions are beyond all numbers but bear a fraction of the
    /// load, they are reported as the largest number.
    fn parts(&self, load: Wrench2<R>, little: R) -> (Components<R>, R) {
        let nearest = self.nearest(load, little);
        if nearest.beyond && nearest.left > little {
            let step = R::digits();
            let (mut small, mut times) = (load.over(step), step);
            while small.size() > little * step {
                let Nearest { parts, left, .. } = self.nearest(small, little);
                let parts: Components<R> = gather(parts.iter().map(|&part| part * times));
                let is_borne = left <= little.min(small.size() * R::divisor());
                let mut reactions = parts.chunks(2).map(|pair| {
                    let parts = pair.iter();
                    parts.fold(R::ZERO, |sum, &part| sum + part)
                });
                if is_borne && reactions.any(|sum| sum >= R::HUGE) {
                    return (parts, left);
                }
                (small, times) = (small.over(step), times * step);
            }
        }
        (nearest.parts, nearest.left)
    }

    /// The mean of all that bear it within the limit, or the closest to that, as far as the numbers permit. Compiled once per image.
    #[inline(never)]
    fn nearest(&self, load: Wrench2<R>, little: R) -> Nearest<R> {
        let mut parts = self.none();
        let mut solutions = 0_i32;
        let mut large = None;
        for solution in self.triples().filter_map(|t| self.bearing(t, load, little)) {
            if self.is_within_limit(&solution) {
                solutions = solutions.saturating_add(1);
                add(&mut parts, &solution);
            } else {
                large = Some(solution);
            }
        }
        if let (0, Some(solution)) = (solutions, large) {
            add(&mut parts, &solution);
        }
        let share = R::ONE / R::from_int(solutions.max(1));
        for part in &mut parts {
            *part = *part * share;
        }
        // Removes the rounding; if no three edges bear the load, this is the closest that up to three come to it.
        let mut beyond = false;
        let mut remainder = self.remainder(load, &parts);
        let mut left = remainder.size();
        for _ in 0..2 {
            if left <= R::of_sums(load.size()) {
                break;
            }
            let triple = self.triples().filter_map(|t| self.on_three(t, remainder));
            let triple = triple.map(|(solution, _)| solution);
            let pair = self.pairs().filter_map(|p| self.on_two(p, remainder));
            let single = (0..self.edges.len()).filter_map(|i| self.on_one(i, remainder));
            let mut better = None;
            let solutions = triple
                .map(gather::<_, 3>)
                .chain(pair.map(gather))
                .chain(single.map(gather));
            for solution in solutions {
                self.spend(TRIAL);
                beyond |= solution.iter().any(|&(_, part)| part >= R::HUGE);
                let mut trial = parts.clone();
                add(&mut trial, &solution);
                let remainder = self.remainder(load, &trial);
                let size = remainder.size();
                if size < left {
                    left = size;
                    better = Some((trial, remainder));
                }
            }
            match better {
                Some(better) => (parts, remainder) = better,
                None => break,
            }
        }
        Nearest {
            parts,
            left,
            beyond,
        }
    }

    fn none(&self) -> Components<R> {
        gather(self.edges.iter().map(|_| R::ZERO))
    }

    /// The residual of a load after components along the edges.
    // Compiled once per image.
    #[inline(never)]
    fn remainder(&self, load: Wrench2<R>, parts: &Components<R>) -> Wrench2<R> {
        let edges = self.edges.iter().zip(parts);
        edges.fold(load, |remainder, (edge, &part)| Wrench2 {
            force: remainder.force + edge.wrench.force * part,
            moment: remainder.moment + edge.wrench.moment * part,
        })
    }

    fn pairs(&self) -> impl Iterator<Item = [usize; 2]> + use<R> {
        let n = self.edges.len();
        (0..n).flat_map(move |i| (i.saturating_add(1)..n).map(move |k| [i, k]))
    }

    pub(super) fn triples(&self) -> impl Iterator<Item = [usize; 3]> + use<R> {
        let n = self.edges.len();
        let pairs = self.pairs();
        pairs.flat_map(move |[i, j]| (j.saturating_add(1)..n).map(move |k| [i, j, k]))
    }

    fn wrench(&self, edge: usize) -> Option<Wrench2<R>> {
        self.edges.get(edge).map(|edge| edge.wrench)
    }

    /// The components along three edges that bear a load. Those along edges that are almost coplanar are hardly known: their residual is
    /// distributed once more, and it may be small then. Compiled once per image.
    #[inline(never)]
    pub(super) fn bearing(
        &self,
        edges: [usize; 3],
        load: Wrench2<R>,
        little: R,
    ) -> Option<[(usize, R); 3]> {
        self.spend(THREE);
        let found = self.on_three(edges, load)?;
        self.refined(edges, found, (load, little))
    }

    /// The components along three edges that bear a load, refined from known ones; with them the volume of the edges.
    fn refined(
        &self,
        edges: [usize; 3],
        (solution, volume): ([(usize, R); 3], R),
        (load, little): (Wrench2<R>, R),
    ) -> Option<[(usize, R); 3]> {
        let presses = |solution: &[(usize, R); 3]| {
            solution
                .iter()
                .all(|&(_, part)| part >= R::ZERO && part < R::HUGE)
        };
        if !presses(&solution) {
            return None;
        }
        if volume > R::sharp() {
            return Some(solution);
        }
        let remainder_of = |solution: &[(usize, R); 3]| {
            let mut parts = self.none();
            add(&mut parts, solution);
            self.remainder(load, &parts)
        };
        let mut refined = solution;
        for _ in 0..REFINEMENTS {
            let remainder = remainder_of(&refined);
            let rounding = Self::rounding(refined.iter().map(|(_, part)| part), load);
            if presses(&refined) && remainder.size() <= little + rounding {
                return Some(refined);
            }
            // Scaled so that the residual is a sixteenth: then its components are within the range of the numbers, and those of the faces
            // show.
            let fine = remainder.size().unit() * R::digits();
            let (more, _) = self.on_three(edges, remainder.over(fine))?;
            for (part, (_, more)) in refined.iter_mut().zip(more) {
                part.1 = part.1 + more * fine;
            }
        }
        None
    }

    /// The residual that the rounding of the components along edges leaves of a load, at most the fraction of the load below which its
    /// direction is known.
    fn rounding<'a>(parts: impl IntoIterator<Item = &'a R>, load: Wrench2<R>) -> R {
        let sum = parts.into_iter().fold(R::ZERO, |sum, &part| sum + part);
        R::of_sums(sum).min(load.size() * R::divisor())
    }

    /// The residual that the rounding of the reactions that bear a load leaves of it.
    pub(crate) fn rounding_of_reactions(&self, load: Wrench2<R>, little: R) -> R {
        let bearing = (self.triples()).find_map(|edges| self.bearing(edges, load, little));
        match bearing {
            Some(parts) => Self::rounding(parts.iter().map(|(_, part)| part), load),
            None => Self::rounding(&self.nearest(load, little).parts, load),
        }
    }

    /// The components along three edges that balance a load, and the volume of the edges.
    fn on_three(&self, [i, j, k]: [usize; 3], load: Wrench2<R>) -> Option<([(usize, R); 3], R)> {
        let (a, b, c) = (self.wrench(i)?, self.wrench(j)?, self.wrench(k)?);
        let (ab, bc, ca) = (a.cross(b), b.cross(c), c.cross(a));
        let volume = a.dot(bc);
        let part = |face: Wrench2<R>| -face.dot(load) / volume;
        // A component that is hardly known shows in its residual.
        let usable = volume.abs() > R::EPSILON;
        usable.then(|| {
            let solution = [(i, part(bc)), (j, part(ca)), (k, part(ab))];
            (solution, volume.abs())
        })
    }

    /// The components along two edges that come closest to bearing a load.
    fn on_two(&self, [i, k]: [usize; 2], load: Wrench2<R>) -> Option<[(usize, R); 2]> {
        let (a, b) = (self.wrench(i)?, self.wrench(k)?);
        let normal = a.cross(b);
        let area = normal.size();
        let plane = normal.over(area);
        let part = |face: Wrench2<R>| -face.dot(plane) / area;
        let usable = area > R::parallel();
        usable.then(|| [(i, part(load.cross(b))), (k, part(a.cross(load)))])
    }

    /// The component along one edge that comes closest to bearing a load.
    fn on_one(&self, i: usize, load: Wrench2<R>) -> Option<[(usize, R); 1]> {
        let edge = self.wrench(i)?;
        Some([(i, -edge.dot(load) / edge.dot(edge))])
    }
}

type Components<R> = Vec<R, MAX_EDGES>;

/// The components along the edges that come closest to bearing a load.
struct Nearest<R: Real> {
    parts: Components<R>,
    /// The size of their residual.
    left: R,
    /// Others would need components beyond all numbers.
    beyond: bool,
}

/// Adds to the components along some edges; no component falls below zero.
fn add<R: Real>(parts: &mut Components<R>, more: &[(usize, R)]) {
    for &(edge, part) in more {
        if let Some(sum) = parts.get_mut(edge) {
            *sum = (*sum + part).max(R::ZERO);
        }
    }
}
