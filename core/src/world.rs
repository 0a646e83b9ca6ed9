//! The world as the statics sees it: the body's vertices and centroid, the sides and corners that it can touch, the springs, the weight.
//! Lengths / L, forces / (k_h L). L is the largest distance of two vertices, k_h the translational stiffness.

use crate::geometry::Vec2;
use crate::motion::Kind;
use crate::obstacles::{Corner, Obstacle};
use crate::real::Real;
use crate::thresholds::Thresholds;
use heapless::Vec;

/// An angle of friction lambda, tan(lambda) = mu: as sine and cosine, so that mu from 0 to infinity is regular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cone<R> {
    pub(crate) sin: R,
    pub(crate) cos: R,
}

/// Coulomb's law of a side: a reaction N n + T t sticks while |T| <= mu_s N and slides with |T| = mu_d N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Friction<R> {
    /// atan mu_s
    pub(crate) fixed: Cone<R>,
    /// atan mu_d
    pub(crate) sliding: Cone<R>,
    /// mu_s - mu_d
    pub(crate) drop: R,
    /// N* = D_c / (mu_s - mu_d) (k_h L), or [`Real::HUGE`] without stiction.
    pub(crate) threshold: R,
    /// D_c (L), at least 2^-19
    pub(crate) memory: R,
}

impl<R: Real> Friction<R> {
    pub(crate) const NONE: Self = {
        let cone = Cone {
            sin: R::ZERO,
            cos: R::ONE,
        };
        Self {
            fixed: cone,
            sliding: cone,
            drop: R::ZERO,
            threshold: R::HUGE,
            memory: R::ZERO,
        }
    };

    /// The cone of a contact that sticks, with stiction or without.
    pub(crate) fn cone(&self, stiction: bool) -> Cone<R> {
        if stiction { self.fixed } else { self.sliding }
    }
    /// A contact with this normal reaction has stiction (R24).
    pub(crate) fn is_pressed(&self, normal: R) -> bool {
        self.threshold < R::HUGE && normal >= self.threshold
    }
}

/// A side: the free half-plane is n·p >= b.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Side<R> {
    /// n, of length 1
    pub(crate) normal: Vec2<R>,
    /// t = (n_y, -n_x)
    pub(crate) tangent: Vec2<R>,
    /// b
    pub(crate) offset: R,
    pub(crate) friction: Friction<R>,
}

impl<R: Real> Side<R> {
    /// A side that nothing reaches.
    pub(crate) const NOWHERE: Self = Self {
        normal: Vec2::new(R::ZERO, R::ONE),
        tangent: Vec2::new(R::ONE, R::ZERO),
        offset: R::LEAST,
        friction: Friction::NONE,
    };

    /// Wherever a body can be, its gaps to both close together: within a touch.
    fn coincides(&self, other: &Self) -> bool {
        let turn = (self.normal - other.normal).length_bound();
        let way = (self.offset - other.offset).abs();
        turn <= R::TOUCH / R::RANGE && way <= R::TOUCH
    }
}

/// Half-planes, of which only the one of the largest static friction is left where some coincide, as together they bear what it bears alone; of
/// equal ones the first.
pub(crate) fn united<R: Real, const S: usize>(mut sides: Vec<Side<R>, S>) -> Vec<Side<R>, S> {
    let mut rest = sides.as_mut_slice();
    while let Some((side, others)) = rest.split_first_mut() {
        for other in others.iter_mut() {
            if side.coincides(other) {
                let [own, its] = [&*side, other].map(|side| side.friction.fixed.sin);
                let worse = if its > own { &mut *side } else { other };
                *worse = Side::NOWHERE;
            }
        }
        rest = others;
    }
    sides
}

/// The rotational stiffness k = k_theta / (k_h L²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stiffness<R> {
    /// k
    pub(crate) value: R,
    /// For angles up to 2 rad, and for larger ones.
    near: Scaled<R>,
    far: Scaled<R>,
}

/// k times a power of two, and that: a small k has few places in fixed point.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Scaled<R> {
    times: R,
    unit: R,
}

impl<R: Real> Stiffness<R> {
    /// From k and 64 k.
    pub(crate) fn new(value: R, value_64: R) -> Self {
        let plain = Scaled {
            times: value,
            unit: R::ONE,
        };
        if !R::is_fixed() || value >= R::ONE {
            return Self {
                value,
                near: plain,
                far: plain,
            };
        }
        let near = Scaled {
            times: value_64,
            unit: R::from_int(64),
        };
        // At most 2, so that its product with the largest turn, 64 rad, is a number.
        let mut far = near;
        while far.times > R::TWO && far.unit > R::ONE {
            (far.times, far.unit) = (far.times.halved(), far.unit.halved());
        }
        Self { value, near, far }
    }
    /// k x
    pub(crate) fn of(&self, x: R) -> R {
        if !R::is_fixed() {
            return self.value * x;
        }
        let by = if x.abs() < R::TWO {
            self.near
        } else {
            self.far
        };
        (by.times * x).in_units(by.unit)
    }
}

/// Body and surroundings: at most V vertices, S sides, C corners. It never changes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct World<R, const V: usize, const S: usize, const C: usize> {
    /// Body frame, counter-clockwise.
    pub(crate) vertices: Vec<Vec2<R>, V>,
    /// cg, body frame
    pub(crate) centroid: Vec2<R>,
    pub(crate) sides: Vec<Side<R>, S>,
    /// The inward normals of the body's sides, body frame.
    pub(crate) normals: Vec<Vec2<R>, V>,
    pub(crate) corners: Vec<Corner<R>, C>,
    /// [`Corner::NOWHERE`]: what stands for a corner or side that there is not.
    pub(crate) nowhere: Corner<R>,
    pub(crate) obstacles: Vec<Obstacle<R>, C>,
    pub(crate) stiffness: Stiffness<R>,
    /// w >= 0: the size of the weight, which acts along -y.
    pub(crate) weight: R,
}

/// Where a body is held, and what follows from it for as long as it is held there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grip<R> {
    /// g, body frame
    pub(crate) point: Vec2<R>,
    /// cg - g, body frame
    pub(crate) centroid: Vec2<R>,
    /// An upper bound of the distance of the vertices from g.
    pub(crate) size: R,
    /// Nothing holds the angle: no spring, and no weight that turns the body (R34).
    pub(crate) swings: bool,
}

/// A world whose body is held at a point of its own: levers count from there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Statics<'a, R, const V: usize, const S: usize, const C: usize> {
    pub(crate) world: &'a World<R, V, S, C>,
    pub(crate) grip: &'a Grip<R>,
}

impl<R: Real, const V: usize, const S: usize, const C: usize> World<R, V, S, C> {
    /// What is only needed among obstacles is not done without them, whatever the capacity, so that all capacities give the same bits.
    pub(crate) fn has_obstacles(&self) -> bool {
        C > 0 && !self.obstacles.is_empty()
    }
    /// A hold of the body at g, body frame.
    pub(crate) fn grip(&self, point: Vec2<R>) -> Grip<R> {
        let lever = self.centroid - point;
        // Within rounding it is not known on which side of the holding point the weight acts.
        let is_known = lever.length_bound() > R::of_products();
        let centroid = if is_known { lever } else { Vec2::ZERO };
        let hangs = self.weight > R::ZERO && is_known;
        let levers = self.vertices.iter().map(|&v| (v - point).length_bound());
        Grip {
            point,
            centroid,
            size: levers.fold(R::ZERO, R::max),
            swings: self.stiffness.value == R::ZERO && !hangs,
        }
    }
    /// The body held in this way.
    pub(crate) fn held<'a>(&'a self, grip: &'a Grip<R>) -> Statics<'a, R, V, S, C> {
        Statics { world: self, grip }
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// A body can have two contacts and more: a point on one half-plane has one. What only these need is not compiled without them.
    pub(crate) const fn has_pairs(&self) -> bool {
        V > 1 || S > 1 || C > 0
    }
    /// A motion is of two contacts.
    pub(crate) fn is_pair(&self, kind: Kind) -> bool {
        self.has_pairs() && kind == Kind::Pair
    }
    /// Contacts can be in several lines: those of one half-plane are in one.
    pub(crate) const fn has_wedges(&self) -> bool {
        S > 1 || C > 0
    }
    /// a: the lever of a vertex from the holding point, body frame; zero if there is no such vertex.
    pub(crate) fn vertex(&self, index: u8) -> Vec2<R> {
        let vertex = self.world.vertices.get(usize::from(index));
        vertex.map_or(Vec2::ZERO, |&v| v - self.grip.point)
    }
    /// From one vertex to another, whatever the holding point.
    pub(crate) fn way_between(&self, pair: [u8; 2]) -> Vec2<R> {
        let [from, to] = pair.map(|index| {
            let vertex = self.world.vertices.get(usize::from(index));
            vertex.map_or(Vec2::ZERO, |&v| v)
        });
        to - from
    }
    /// The levers of all vertices, with their indices.
    pub(crate) fn vertices(&self) -> impl Iterator<Item = (u8, Vec2<R>)> {
        (0_u8..).zip(self.world.vertices.iter().map(|&v| v - self.grip.point))
    }
    /// A half-plane, or a side of an obstacle after them; one that nothing reaches if there is none of that index.
    pub(crate) fn side(&self, index: u8) -> &Side<R> {
        match self.world.sides.get(usize::from(index)) {
            Some(side) => side,
            None if C == 0 => &self.world.nowhere.side,
            None => {
                let corner = self.corner_of_side(index);
                corner.map_or(&self.world.nowhere.side, |c| &self.corner(c).side)
            }
        }
    }
    /// All half-planes, with their indices.
    pub(crate) fn sides(&self) -> impl Iterator<Item = (u8, &Side<R>)> {
        (0_u8..).zip(&self.world.sides)
    }
    /// W: the weight as a force.
    pub(crate) fn weight_force(&self) -> Vec2<R> {
        Vec2::new(R::ZERO, -self.world.weight)
    }
}
