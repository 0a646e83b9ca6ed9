//! What two or more contacts can bear together: the cone of all wrenches that reactions within their friction cones
//! add up to (STATICS 5, 6). A load is borne iff it lies on the inner side of every facet of the cone, which is linear
//! in the load; the facet that yields first names the incipient motion: a contact none of whose edges lie in it
//! opens, one with both edges in it sticks, one with a single edge in it slides.

use crate::geometry::Vec2;
use crate::list::gather;
use crate::output::MAX_CONTACTS;
use crate::real::Real;
use heapless::Vec;

const MAX_EDGES: usize = 2 * MAX_CONTACTS;

/// A force with its moment about the pivot of the state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Screw<R> {
    pub(crate) force: Vec2<R>,
    pub(crate) moment: R,
}

impl<R: Real> Screw<R> {
    /// The product that is zero for a wrench in the plane of two others.
    pub(crate) fn dot(self, b: Self) -> R {
        self.force.dot(b.force) + self.moment * b.moment
    }

    /// Normal to two screws, as a facet of their cone.
    pub(crate) fn cross(self, b: Self) -> Self {
        let (f, g) = (self.force, b.force);
        Self {
            force: Vec2::new(
                f.y * b.moment - self.moment * g.y,
                self.moment * g.x - f.x * b.moment,
            ),
            moment: f.cross(g),
        }
    }

    fn scaled(self, k: R) -> Self {
        Self {
            force: self.force * k,
            moment: self.moment * k,
        }
    }

    fn over(self, k: R) -> Self {
        Self {
            force: self.force.over(k),
            moment: self.moment / k,
        }
    }

    fn size(self) -> R {
        self.force.length().hypot(self.moment)
    }
}

/// One edge of the friction cone of a contact.
#[derive(Clone, Copy, Debug)]
struct Edge<R> {
    screw: Screw<R>,
    contact: usize,
    /// Its part along t.
    friction: R,
}

/// The incipient motion at a facet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Yield<R> {
    /// Contact number `contact` sticks, all others open.
    Pivot { contact: usize },
    /// Contacts `first` and `second` slide along sign·t of their surfaces, all others open.
    Slide {
        first: (usize, R),
        second: (usize, R),
    },
}

/// One contact as the cone sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bearing<R> {
    /// Lever from the pivot.
    pub(crate) lever: Vec2<R>,
    pub(crate) normal: Vec2<R>,
    pub(crate) tangent: Vec2<R>,
    /// (normal, friction) parts of the two edges of the cone, friction along +t and along -t.
    pub(crate) edges: [(R, R); 2],
}

/// The cone of bearable wrenches.
#[derive(Clone, Debug, Default)]
pub(crate) struct Support<R: Real> {
    edges: Vec<Edge<R>, MAX_EDGES>,
    /// Of the contacts, from the pivot.
    levers: Vec<Vec2<R>, MAX_CONTACTS>,
}

impl<R: Real> Support<R> {
    /// How far from a facet an edge may lie and still count as in it.
    fn tolerance() -> R {
        R::from_int(64) * R::EPSILON
    }

    pub(crate) fn add(&mut self, bearing: &Bearing<R>) {
        for &(n, t) in &bearing.edges {
            let force = bearing.normal * n + bearing.tangent * t;
            let edge = Edge {
                screw: Screw {
                    force,
                    moment: bearing.lever.cross(force),
                },
                contact: self.levers.len(),
                friction: t,
            };
            // At most MAX_CONTACTS bearings are added.
            let _ = self.edges.push(edge);
        }
        let _ = self.levers.push(bearing.lever);
    }

    /// What moves when two edges alone bear the load, and it crosses their facet of an inner normal.
    fn incipient(&self, a: &Edge<R>, b: &Edge<R>, normal: Screw<R>) -> Yield<R> {
        if a.contact == b.contact {
            Yield::Pivot { contact: a.contact }
        } else {
            Yield::Slide {
                first: (a.contact, self.slides(a, normal)),
                second: (b.contact, self.slides(b, normal)),
            }
        }
    }

    /// The direction along t in which the contact of an edge slides when the load crosses the facet of an inner normal:
    /// against the friction; without friction the normal is the motion itself.
    fn slides(&self, edge: &Edge<R>, normal: Screw<R>) -> R {
        if edge.friction != R::ZERO {
            return -edge.friction.sign();
        }
        // Of a force along t, which is a quarter turn from n.
        let force = -edge.screw.force.turned();
        let lever = self.levers.get(edge.contact).copied().unwrap_or_default();
        let moment = lever.cross(force);
        normal.dot(Screw { force, moment }).sign()
    }

    /// Visits the facets: inner normal of unit size, how exactly it is known, from 0 (its edges are parallel) to 1, and the
    /// incipient motion when the load crosses it.
    fn each_facet(&self, visit: &mut dyn FnMut(Screw<R>, R, Yield<R>)) {
        for (i, a) in self.edges.iter().enumerate() {
            for (k, b) in self.edges.iter().enumerate().skip(i.saturating_add(1)) {
                let normal = a.screw.cross(b.screw);
                let size = normal.size();
                if size <= Self::tolerance() {
                    continue;
                }
                let (unit, sharpness) = (normal.over(size), size.min(R::ONE));
                let (mut inner, mut outer) = (true, true);
                for (j, edge) in self.edges.iter().enumerate() {
                    if j != i && j != k {
                        let side = unit.dot(edge.screw);
                        inner &= side >= -Self::tolerance();
                        outer &= side <= Self::tolerance();
                    }
                }
                for (faces, sign) in [(inner, R::ONE), (outer, -R::ONE)] {
                    if faces {
                        let normal = unit.scaled(sign);
                        visit(normal, sharpness, self.incipient(a, b, normal));
                    }
                }
                if inner && outer {
                    self.each_end((unit, sharpness), [a, b], visit);
                }
            }
        }
    }

    /// A cone that lies in a plane, of two contacts without friction, ends at single edges, too: beyond one the other opens.
    fn each_end(
        &self,
        (plane, sharpness): (Screw<R>, R),
        edges: [&Edge<R>; 2],
        visit: &mut dyn FnMut(Screw<R>, R, Yield<R>),
    ) {
        for edge in edges {
            let across = plane.cross(edge.screw);
            let unit = across.over(across.size());
            for normal in [unit, unit.scaled(-R::ONE)] {
                let is_end = |other: &Edge<R>| normal.dot(other.screw) >= -Self::tolerance();
                if self.edges.iter().all(is_end) {
                    let contact = edge.contact;
                    visit(normal, sharpness, Yield::Pivot { contact });
                }
            }
        }
    }

    /// The part of the way from one load to another after which the contacts cannot bear it any more, if that comes.
    pub(crate) fn first_yield(&self, from: Screw<R>, to: Screw<R>, rounding: R) -> Option<R> {
        let (mut first, mut has_facets) = (None, false);
        self.each_facet(&mut |normal, sharpness, _| {
            has_facets = true;
            // The reactions are the opposite of the load.
            let (start, end) = (-normal.dot(from), -normal.dot(to));
            if end * sharpness < -rounding {
                let part = if start > R::ZERO {
                    start / (start - end)
                } else {
                    R::ZERO
                };
                first = Some(first.map_or(part, |least: R| least.min(part)));
            }
        });
        if has_facets || self.is_on_line(to, rounding) {
            first
        } else {
            Some(R::ZERO)
        }
    }

    /// Without facets all edges lie in one line, as of contacts without friction on opposite sides of a slot: they bear what
    /// lies in that line against one of them, and nothing else.
    fn is_on_line(&self, load: Screw<R>, rounding: R) -> bool {
        let mut edges = self.edges.iter().map(|edge| edge.screw);
        edges.any(|edge| {
            let size = edge.size();
            edge.dot(load) <= rounding * size && edge.cross(load).size() <= rounding * size
        })
    }

    /// The incipient motion at the facet that a load violates most, among those that `allows` lets pass.
    pub(crate) fn yields(
        &self,
        load: Screw<R>,
        rounding: R,
        allows: &dyn Fn(&Yield<R>) -> bool,
    ) -> Option<Yield<R>> {
        let mut most: Option<(R, Yield<R>)> = None;
        self.each_facet(&mut |normal, _, mode| {
            let excess = normal.dot(load);
            let is_most = most.is_none_or(|(largest, _)| excess > largest);
            if excess >= -rounding && is_most && allows(&mode) {
                most = Some((excess, mode));
            }
        });
        most.map(|(_, mode)| mode)
    }

    /// True if three edges alone bear a load.
    pub(crate) fn bears_on(&self, edges: [u8; 3], load: Screw<R>) -> bool {
        let way = self.on_three(edges.map(usize::from), load);
        way.is_some_and(|way| way.iter().all(|&(_, part)| part >= R::ZERO))
    }

    /// Three edges that bear a load.
    pub(crate) fn bearers(&self, load: Screw<R>) -> Option<[u8; 3]> {
        let small = |edges: [usize; 3]| edges.map(|k| u8::try_from(k).unwrap_or(u8::MAX));
        let mut triples = self.triples().map(small);
        triples.find(|&edges| self.bears_on(edges, load))
    }

    /// What the reactions that come nearest to bearing a load leave of it.
    pub(crate) fn left(&self, load: Screw<R>) -> R {
        self.rest(load, &self.parts(load)).size()
    }

    /// Shares a load out among the contacts, as parts of the +t and the -t edge of each: the mean of all ways to bear it
    /// on three edges. For two contacts that is the middle of the interval of (E5).
    pub(crate) fn share(&self, load: Screw<R>) -> Vec<[R; 2], MAX_CONTACTS> {
        let parts = self.parts(load);
        let pairs = parts.chunks_exact(2);
        gather(pairs.filter_map(|pair| <[R; 2]>::try_from(pair).ok()))
    }

    /// As [`Self::share`], edge by edge.
    fn parts(&self, load: Screw<R>) -> Parts<R> {
        let mut parts: Parts<R> = gather(self.edges.iter().map(|_| R::ZERO));
        let mut ways = 0_i32;
        for way in self.triples().filter_map(|t| self.on_three(t, load)) {
            if way
                .iter()
                .all(|&(_, part)| part >= R::ZERO && part < R::RANGE)
            {
                ways = ways.saturating_add(1);
                add(&mut parts, &way);
            }
        }
        let share = R::ONE / R::from_int(ways.max(1));
        for part in &mut parts {
            *part = *part * share;
        }
        // Takes out the rounding; where no three edges bear the load, this is the nearest that up to three come to it.
        for _ in 0..2 {
            let rest = self.rest(load, &parts);
            let triple = self.triples().filter_map(|t| self.on_three(t, rest));
            let pair = self.pairs().filter_map(|p| self.on_two(p, rest));
            let single = (0..self.edges.len()).filter_map(|i| self.on_one(i, rest));
            let mut best = rest.size();
            let mut better = None;
            let ways = triple
                .map(gather::<_, 3>)
                .chain(pair.map(gather))
                .chain(single.map(gather));
            for way in ways {
                let mut trial = parts.clone();
                add(&mut trial, &way);
                let left = self.rest(load, &trial).size();
                if left < best {
                    best = left;
                    better = Some(trial);
                }
            }
            match better {
                Some(trial) => parts = trial,
                None => break,
            }
        }
        parts
    }

    /// What parts of the edges leave of a load.
    fn rest(&self, load: Screw<R>, parts: &Parts<R>) -> Screw<R> {
        let edges = self.edges.iter().zip(parts);
        edges.fold(load, |rest, (edge, &part)| Screw {
            force: rest.force + edge.screw.force * part,
            moment: rest.moment + edge.screw.moment * part,
        })
    }

    fn pairs(&self) -> impl Iterator<Item = [usize; 2]> + use<R> {
        let n = self.edges.len();
        (0..n).flat_map(move |i| (i.saturating_add(1)..n).map(move |k| [i, k]))
    }

    fn triples(&self) -> impl Iterator<Item = [usize; 3]> + use<R> {
        let n = self.edges.len();
        let pairs = self.pairs();
        pairs.flat_map(move |[i, j]| (j.saturating_add(1)..n).map(move |k| [i, j, k]))
    }

    fn screw(&self, edge: usize) -> Option<Screw<R>> {
        self.edges.get(edge).map(|edge| edge.screw)
    }

    /// The parts of three edges that bear a load.
    fn on_three(&self, [i, j, k]: [usize; 3], load: Screw<R>) -> Option<[(usize, R); 3]> {
        let (a, b, c) = (self.screw(i)?, self.screw(j)?, self.screw(k)?);
        let (ab, bc, ca) = (a.cross(b), b.cross(c), c.cross(a));
        let volume = a.dot(bc);
        let part = |face: Screw<R>| -face.dot(load) / volume;
        let usable = volume.abs() > Self::tolerance();
        usable.then(|| [(i, part(bc)), (j, part(ca)), (k, part(ab))])
    }

    /// The parts of two edges that come nearest to bearing a load.
    fn on_two(&self, [i, k]: [usize; 2], load: Screw<R>) -> Option<[(usize, R); 2]> {
        let (a, b) = (self.screw(i)?, self.screw(k)?);
        let normal = a.cross(b);
        let area = normal.size();
        let unit = normal.over(area);
        let part = |face: Screw<R>| -face.dot(unit) / area;
        let usable = area > Self::tolerance();
        usable.then(|| [(i, part(load.cross(b))), (k, part(a.cross(load)))])
    }

    /// The part of one edge that comes nearest to bearing a load.
    fn on_one(&self, i: usize, load: Screw<R>) -> Option<[(usize, R); 1]> {
        let edge = self.screw(i)?;
        Some([(i, -edge.dot(load) / edge.dot(edge))])
    }
}

type Parts<R> = Vec<R, MAX_EDGES>;

/// Adds to the parts of some edges; no part falls below zero.
fn add<R: Real>(parts: &mut Parts<R>, more: &[(usize, R)]) {
    for &(edge, part) in more {
        if let Some(sum) = parts.get_mut(edge) {
            *sum = (*sum + part).max(R::ZERO);
        }
    }
}
