//! From a description in SI units to the world of the solver, in units of L and k_h L.

use crate::geometry::{Vec2, normalized, one_in};
use crate::list::gather;
use crate::obstacles::union::unite;
use crate::real::Real;
use crate::state::HandPose;
use crate::world::{Cone, Friction, Side, Stiffness, World};
use heapless::Vec;
use stiction_core::{
    Angle, Description, ObstacleDescription, Parameter, Scene, SceneError, SurfaceDescription,
    WithObstacles,
};

/// The size of 1 inside the solver, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Units<F> {
    /// L (m)
    pub(crate) length: F,
    /// k_h L (N)
    pub(crate) force: F,
    /// k_h L² (N·m)
    pub(crate) moment: F,
    /// 1/L (1/m)
    per_length: F,
    /// The place (m) of the origin inside the solver, where the first vertex starts: so coordinates keep their digits far from that of the
    /// world.
    pub(crate) origin: [F; 2],
}

/// A checked scene.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Described<R: Real, const V: usize, const S: usize, const C: usize> {
    pub(crate) world: World<R, V, S, C>,
    pub(crate) units: Units<R::Si>,
    /// g, body frame, if the scene has one.
    pub(crate) holding_point: Option<Vec2<R>>,
    /// How far outside the body a hand may be and still take hold.
    pub(crate) reach: R,
    /// The pose of the body's origin at the start, and its whole turns.
    pub(crate) start: HandPose<R>,
    pub(crate) turns: i32,
}

impl<F: Real> Units<F> {
    fn of(d: &Description<'_, F>) -> Self {
        let mut length = F::ZERO;
        for [ax, ay] in d.vertices {
            for [bx, by] in d.vertices {
                length = length.max((*ax - *bx).hypot(*ay - *by));
            }
        }
        if length <= F::ZERO {
            length = size_of_point(d);
        }
        let force = d.stiffness_translation * length;
        let [x, y, theta] = d.start;
        let (_, rest) = theta.turns();
        let (sin, cos) = rest.sin_cos();
        let [a, b] = d.vertices.first().copied().unwrap_or([F::ZERO; 2]);
        Self {
            length,
            force,
            moment: force * length,
            per_length: F::ONE / length,
            origin: [x + cos * a - sin * b, y + sin * a + cos * b],
        }
    }
    /// So many per k_h L² (1/(N·m)).
    fn per_moment(&self, count: i32) -> F {
        F::from_int(count) / self.moment
    }
    /// 1/(k_h L) (1/N)
    fn per_force(&self) -> F {
        F::ONE / self.force
    }
    /// The units of a tangent: of the pose by the hand, of the wrench by the hand.
    pub(crate) fn of_tangent(&self) -> [[[F; 3]; 3]; 2] {
        let per_hand = [self.per_length, self.per_length, F::ONE];
        let table = |rows: [F; 3]| rows.map(|row| per_hand.map(|per| row * per));
        [
            table([self.length, self.length, F::ONE]),
            table([self.force, self.force, self.moment]),
        ]
    }
    /// A coordinate (m) has no digits left within the body.
    fn is_far(&self, x: F) -> bool {
        x.abs() > F::RANGE * self.length
    }
    /// A pose (m, rad) as it is seen from the origin inside the solver.
    fn seen(&self, x: F, y: F, theta: F) -> [F; 3] {
        let [from_x, from_y] = self.origin;
        [x - from_x, y - from_y, theta]
    }
    /// A length (m), non-dimensional.
    pub(crate) fn length<R: Real<Si = F>>(&self, x: F) -> R {
        R::from_si(x, self.per_length)
    }
    /// A vector (m), or a point of the body frame, non-dimensional.
    pub(crate) fn vector<R: Real<Si = F>>(&self, [x, y]: [F; 2]) -> Vec2<R> {
        Vec2::new(self.length(x), self.length(y))
    }
    /// A point of the world (m), non-dimensional.
    pub(crate) fn point<R: Real<Si = F>>(&self, [x, y]: [F; 2]) -> Vec2<R> {
        let [from_x, from_y] = self.origin;
        self.vector([x - from_x, y - from_y])
    }
    /// A point of the world in m.
    pub(crate) fn place<R: Real<Si = F>>(&self, point: Vec2<R>) -> [F; 2] {
        let [x, y] = self.origin;
        [
            x + point.x.to_si(self.length),
            y + point.y.to_si(self.length),
        ]
    }
    /// The offset (m) of a line of unit normal from the origin inside the solver.
    fn offset(&self, [x, y]: [F; 2], offset: F) -> F {
        let [from_x, from_y] = self.origin;
        offset - (x * from_x + y * from_y)
    }
}

/// The size of a body of one vertex: a power of two near the length at which its springs balance.
fn size_of_point<F: Real>(d: &Description<'_, F>) -> F {
    let mut square = d.stiffness_rotation / d.stiffness_translation;
    for ([gx, gy], [vx, vy]) in d.holding_point.iter().zip(d.vertices) {
        let (x, y) = (*gx - *vx, *gy - *vy);
        square = square + x * x + y * y;
    }
    let mut size = F::ONE;
    if square > F::ZERO && square.is_finite() {
        while size * size > square * F::from_int(64) {
            size = size.halved();
        }
        while size * size * F::from_int(16) < square {
            size = size.doubled();
        }
    }
    size
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Described<R, V, S, C> {
    /// Checks a description and makes it non-dimensional.
    ///
    /// # Errors
    /// Those of [`Scene::new`].
    pub(crate) fn new(d: &Description<'_, R::Si>) -> Result<Self, SceneError<R::Si>> {
        let units = Units::of(d);
        check::<R, V, S, C>(d, &units)?;
        let vertices = gather(d.vertices.iter().map(|&v| units.vector::<R>(v)));
        let (corners, obstacles) = if C > 0 {
            unite::<R, S, C>(d.surfaces, d.obstacles, &units)
        } else {
            (Vec::new(), Vec::new())
        };
        let centroid = centroid(&vertices);
        let k = d.stiffness_rotation;
        let [x, y, theta] = d.start;
        let theta = Angle::from_radians(theta);
        let world = World {
            vertices,
            centroid,
            sides: gather(d.surfaces.iter().map(|s| side(s, &units))),
            normals: gather(normals::<R>(d.vertices)),
            corners,
            obstacles,
            stiffness: Stiffness::new(
                R::from_si(k, units.per_moment(1)),
                R::from_si(k, units.per_moment(64)),
            ),
            weight: R::from_si(d.weight, units.per_force()),
        };
        Ok(Self {
            world,
            units,
            holding_point: d.holding_point.map(|g| units.vector(g)),
            reach: units.length(d.reach),
            start: HandPose {
                at: units.point([x, y]),
                angle: R::from_si(theta.rest, R::Si::ONE),
            },
            turns: theta.turns,
        })
    }
}

/// The checks are those of the crate that this one will be part of, of the scene seen from where the body starts.
fn check<R: Real, const V: usize, const S: usize, const C: usize>(
    d: &Description<'_, R::Si>,
    units: &Units<R::Si>,
) -> Result<(), SceneError<R::Si>> {
    let [x, y, theta] = d.start;
    let of_start = |value, allowed| SceneError {
        parameter: Parameter::Start,
        value,
        allowed,
    };
    if let Some(value) = d.start.into_iter().find(|x| !x.is_finite()) {
        return Err(of_start(value, "finite numbers"));
    }
    let farther = if y.abs() > x.abs() { y } else { x };
    if units.is_far(farther) {
        let is_double = R::Si::RANGE > R::Si::from_int(1_000_000);
        let allowed = if is_double {
            "at most 1e12 body sizes from the origin"
        } else {
            "at most 1e6 body sizes from the origin"
        };
        return Err(of_start(farther, allowed));
    }
    let shifted = d.surfaces.iter().map(|s| SurfaceDescription {
        offset: units.offset(unit(s.normal), s.offset),
        ..*s
    });
    let surfaces: Vec<_, S> = gather(shifted);
    let corners = d.obstacles.iter().flat_map(|obstacle| obstacle.vertices);
    let corners: Vec<_, C> = gather(corners.map(|&[x, y]| {
        let [x, y, _] = units.seen(x, y, R::Si::ZERO);
        [x, y]
    }));
    let mut rest = corners.as_slice();
    let obstacles: Vec<_, C> = gather(d.obstacles.iter().map(|obstacle| {
        let count = obstacle.vertices.len();
        let (vertices, after) = rest.split_at_checked(count).unwrap_or((rest, &[]));
        rest = after;
        ObstacleDescription {
            vertices,
            ..*obstacle
        }
    }));
    let counts = d.obstacles.iter().map(|obstacle| obstacle.vertices.len());
    let fits = d.obstacles.len() <= C && counts.fold(0, usize::saturating_add) <= C;
    let near = Description {
        start: units.seen(x, y, theta),
        surfaces: if d.surfaces.len() > S {
            d.surfaces
        } else {
            &surfaces
        },
        obstacles: if fits { &obstacles } else { d.obstacles },
        ..*d
    };
    let checked = if C > 0 {
        Scene::<R, V, S, WithObstacles<C, C>>::new(&near).map(drop)
    } else {
        Scene::<R, V, S>::new(&near).map(drop)
    };
    checked.map_err(|mut error| {
        if let Parameter::Offset(i) = error.parameter {
            error.value = d.surfaces.get(i).map_or(error.value, |s| s.offset);
        }
        error
    })
}

/// The inward normals of the body's sides, each from its first vertex to the next; a point has none.
fn normals<R: Real>(vertices: &[[R::Si; 2]]) -> impl Iterator<Item = Vec2<R>> {
    let is_point = vertices.len() < 2;
    let next = vertices.iter().skip(1).chain(vertices.first());
    let sides = vertices.iter().zip(next).filter(move |_| !is_point);
    sides.map(|(&[ax, ay], &[bx, by])| {
        let (x, y) = normalized(bx - ax, by - ay);
        let number = |x| R::from_si(x, R::Si::ONE);
        Vec2::new(number(-y), number(x))
    })
}

fn unit<F: Real>([x, y]: [F; 2]) -> [F; 2] {
    let (x, y) = normalized(x, y);
    [x, y]
}

fn side<R: Real>(s: &SurfaceDescription<R::Si>, units: &Units<R::Si>) -> Side<R> {
    let [x, y] = unit(s.normal);
    let normal = Vec2::new(R::from_si(x, R::Si::ONE), R::from_si(y, R::Si::ONE));
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
fn centroid<R: Real>(vertices: &[Vec2<R>]) -> Vec2<R> {
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
