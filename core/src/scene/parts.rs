//! The parts of a world made of those of a description: sides with their friction, the normals of the body, its centroid.

use super::SurfaceDescription;
use crate::geometry::{Vec2, normalized, one_in};
use crate::real::Real;
use crate::units::Units;
use crate::world::{Cone, Friction, Side};

/// The inward normals of the body's sides, each from its first vertex to the next; a point has none.
pub(super) fn normals<R: Real>(vertices: &[[R::Si; 2]]) -> impl Iterator<Item = Vec2<R>> {
    let is_point = vertices.len() < 2;
    let next = vertices.iter().skip(1).chain(vertices.first());
    let sides = vertices.iter().zip(next).filter(move |_| !is_point);
    sides.map(|(&[ax, ay], &[bx, by])| {
        let side = Vec2::new(bx, by) - Vec2::new(ax, ay);
        let (x, y) = normalized(side.x, side.y);
        plain(Vec2::<R::Si>::new(x, y)).turned()
    })
}

/// A vector without a unit.
pub(super) fn plain<R: Real>(v: Vec2<R::Si>) -> Vec2<R> {
    let [x, y] = [v.x, v.y].map(|x| R::from_si(x, R::Si::ONE));
    Vec2::new(x, y)
}

fn unit<F: Real>([x, y]: [F; 2]) -> [F; 2] {
    let (x, y) = normalized(x, y);
    [x, y]
}

pub(super) fn side<R: Real>(s: &SurfaceDescription<R::Si>, units: &Units<R::Si>) -> Side<R> {
    let [x, y] = unit(s.normal);
    let normal = plain(Vec2::<R::Si>::new(x, y));
    Side {
        normal,
        tangent: Vec2::new(normal.y, -normal.x),
        offset: units.length(units.offset([x, y], s.offset)),
        friction: Friction::described([s.friction_static, s.friction_dynamic], s.memory, units),
    }
}

impl<R: Real> Friction<R> {
    /// From mu_s and mu_d, and the memory length (m).
    pub(crate) fn described(
        [fixed, sliding]: [R::Si; 2],
        memory: Option<R::Si>,
        units: &Units<R::Si>,
    ) -> Self {
        // L/4096 unless it is given.
        let memory = memory.map_or(one_in(4096), |memory| units.length(memory));
        Self::new(fixed, sliding, memory)
    }
    /// From mu_s and mu_d, both 0 or more, and the memory length in body sizes; it is at least the shortest that the number types
    /// distinguish.
    fn new(fixed: R::Si, sliding: R::Si, memory: R::Si) -> Self {
        let cone = |mu: R::Si| {
            let (cos, sin) = normalized(R::Si::ONE, mu);
            Cone {
                sin: R::from_si(sin, R::Si::ONE),
                cos: R::from_si(cos, R::Si::ONE),
            }
        };
        let number = |x: R::Si| R::from_si(x, R::Si::ONE).min(R::HUGE);
        let memory = memory.max(R::MICRO.to_si(R::Si::ONE));
        let (drop, threshold) = drop_and_threshold(fixed, sliding, memory);
        let cones = [fixed, sliding].map(cone);
        let [held, slides] = cones;
        Self {
            fixed: held,
            sliding: slides,
            drop: number(drop),
            // Coefficients that the number type does not distinguish count as one.
            threshold: if held == slides {
                R::HUGE
            } else {
                number(threshold)
            },
            memory: number(memory),
        }
    }
}

/// mu_s - mu_d, and N* = D_c / (mu_s - mu_d).
fn drop_and_threshold<F: Real>(fixed: F, sliding: F, memory: F) -> (F, F) {
    let drop = fixed - sliding;
    (drop, memory / drop)
}

/// The centroid of the area; for a point and a rod the mean of the vertices.
pub(super) fn centroid<R: Real>(vertices: &[Vec2<R>]) -> Vec2<R> {
    let at = |end: Option<&Vec2<R>>| end.copied().unwrap_or(Vec2::ZERO);
    let (first, last) = (at(vertices.first()), at(vertices.last()));
    if vertices.len() < 3 {
        return first + (last - first) * R::HALF;
    }
    let (mut sum, mut area) = (Vec2::ZERO, R::ZERO);
    for (a, b) in vertices.iter().zip(vertices.iter().skip(1)) {
        let (a, b) = (*a - first, *b - first);
        let twice = a.cross(b);
        sum = sum + (a + b) * twice;
        area = area + twice;
    }
    first + sum * (R::ONE / (R::from_int(3) * area))
}
