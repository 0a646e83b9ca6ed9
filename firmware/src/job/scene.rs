//! The scene of a job: to bytes on the host, from bytes to the scene of any number type on the board.

use heapless::Vec;
use stiction_core::{
    Description, Evolution, Model, ObstacleDescription, Real, Scene, SceneError, SiFloat,
    SurfaceDescription, WithObstacles,
};

use super::fields::{Fields, Record};
use super::{FormatError, VERSION};

/// The bytes of a job before its vertices.
pub(crate) const HEAD_BYTES: usize = 96;
const VERTEX_BYTES: usize = 16;
const SURFACE_BYTES: usize = 48;
const OBSTACLE_BYTES: usize = 32;
const MARK: [u8; 4] = *b"stjb";

/// Passes the bytes of a job to `sink`, up to its samples, whose number is given, for steps of a budget. The scene has at most 255
/// vertices, 255 surfaces and 255 obstacles.
///
/// # Errors
/// The first error of `sink`.
pub fn write_scene<E>(
    (scene, obstacles): (&Description<'_, f64>, &[ObstacleDescription<'_, f64>]),
    evolution: Evolution,
    (samples, budget): (u32, u32),
    mut sink: impl FnMut(&[u8]) -> Result<(), E>,
) -> Result<(), E> {
    let count = |n: usize| u8::try_from(n).unwrap_or(u8::MAX);
    let mut head = Record::<HEAD_BYTES>::new();
    head.put(MARK).u8(VERSION);
    head.u8(match evolution {
        Evolution::Path => 0,
        Evolution::Frame => 1,
    });
    head.u8(count(scene.vertices.len()))
        .u8(count(scene.surfaces.len()));
    head.u32(samples)
        .u32(u32::from(scene.holding_point.is_some()));
    let [x, y, theta] = scene.start;
    head.f64(x).f64(y).f64(theta).f64(scene.weight);
    let [x, y] = scene.holding_point.unwrap_or_default();
    head.f64(x).f64(y).f64(scene.reach);
    head.f64(scene.stiffness_translation)
        .f64(scene.stiffness_rotation);
    head.u32(budget).u8(count(obstacles.len()));
    sink(&head.bytes())?;
    let point = |&[x, y]: &[f64; 2]| Record::<VERTEX_BYTES>::new().f64(x).f64(y).bytes();
    for vertex in scene.vertices {
        sink(&point(vertex))?;
    }
    for surface in scene.surfaces {
        let [x, y] = surface.normal;
        let mut record = Record::<SURFACE_BYTES>::new();
        record.f64(x).f64(y).f64(surface.offset);
        record
            .f64(surface.friction_static)
            .f64(surface.friction_dynamic)
            .f64(surface.memory.unwrap_or(f64::NAN));
        sink(&record.bytes())?;
    }
    for obstacle in obstacles {
        let mut record = Record::<OBSTACLE_BYTES>::new();
        record
            .f64(obstacle.friction_static)
            .f64(obstacle.friction_dynamic)
            .f64(obstacle.memory.unwrap_or(f64::NAN))
            .u8(count(obstacle.vertices.len()));
        sink(&record.bytes())?;
        for corner in obstacle.vertices {
            sink(&point(corner))?;
        }
    }
    Ok(())
}

/// The head of a job.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Head {
    /// The evolution within a frame.
    pub(crate) evolution: Evolution,
    /// The number of hand samples that follow.
    pub(crate) samples: u32,
    /// The budget of a step.
    pub(crate) budget: u32,
    vertices: u8,
    surfaces: u8,
    obstacles: u8,
    start: [f64; 3],
    weight: f64,
    holding_point: Option<[f64; 2]>,
    reach: f64,
    stiffness_translation: f64,
    stiffness_rotation: f64,
}

impl Head {
    /// The head of these bytes.
    ///
    /// # Errors
    /// They are not a job of this version.
    pub(crate) fn decode(bytes: &[u8; HEAD_BYTES]) -> Result<Self, FormatError> {
        let mut fields = Fields::new(bytes);
        if fields.take() != MARK || fields.u8() != VERSION {
            return Err(FormatError::Mark);
        }
        let evolution = match fields.u8() {
            0 => Evolution::Path,
            1 => Evolution::Frame,
            _ => return Err(FormatError::Value),
        };
        let (vertices, surfaces) = (fields.u8(), fields.u8());
        let (samples, has_holding_point) = (fields.u32(), fields.u32() != 0);
        let start = [fields.f64(), fields.f64(), fields.f64()];
        let weight = fields.f64();
        let holding_point = [fields.f64(), fields.f64()];
        let [reach, stiffness_translation, stiffness_rotation] = [(); 3].map(|()| fields.f64());
        Ok(Self {
            evolution,
            samples,
            budget: fields.u32(),
            obstacles: fields.u8(),
            vertices,
            surfaces,
            start,
            weight,
            holding_point: has_holding_point.then_some(holding_point),
            reach,
            stiffness_translation,
            stiffness_rotation,
        })
    }

    /// The scene, whose vertices and surfaces are taken from `source`.
    ///
    /// # Errors
    /// `source` fails, there are obstacles, or the numbers do not make a scene of these capacities.
    pub(crate) fn scene<R: Real<Si: SiFloat>, const V: usize, const S: usize, M: Model, E>(
        &self,
        mut source: impl FnMut(&mut [u8]) -> Result<(), E>,
    ) -> Result<Scene<R, V, S, M>, E>
    where
        E: From<SceneError<R::Si>> + From<FormatError>,
    {
        if self.obstacles > 0 {
            return Err(FormatError::Value.into());
        }
        self.described::<R, V, S, _, E>(&mut source, |description, _| Ok(Scene::new(description)?))
    }

    /// The same with its obstacles.
    ///
    /// # Errors
    /// `source` fails, or the numbers do not make a scene of these capacities.
    pub(crate) fn among<R, const V: usize, const S: usize, const O: usize, const C: usize, E>(
        &self,
        mut source: impl FnMut(&mut [u8]) -> Result<(), E>,
    ) -> Result<Scene<R, V, S, WithObstacles<O, C>>, E>
    where
        R: Real<Si: SiFloat>,
        E: From<SceneError<R::Si>> + From<FormatError>,
    {
        self.described::<R, V, S, _, E>(&mut source, |description, source| {
            let mut corners: Vec<[R::Si; 2], C> = Vec::new();
            let mut records: Vec<[u8; OBSTACLE_BYTES], O> = Vec::new();
            for _ in 0..self.obstacles {
                let mut bytes = [0; OBSTACLE_BYTES];
                source(&mut bytes)?;
                records.push(bytes).map_err(|_| FormatError::Value)?;
                for _ in 0..Obstacle::<R::Si>::of(&bytes).corners {
                    let corner = point(source)?;
                    corners.push(corner).map_err(|_| FormatError::Value)?;
                }
            }
            let mut rest = corners.as_slice();
            let obstacles = records.iter().map(|bytes| {
                let obstacle = Obstacle::of(bytes);
                let (vertices, others) = rest.split_at_checked(obstacle.corners.into())?;
                rest = others;
                Some(ObstacleDescription {
                    vertices,
                    friction_static: obstacle.friction_static,
                    friction_dynamic: obstacle.friction_dynamic,
                    memory: obstacle.memory,
                })
            });
            let obstacles: Vec<_, O> = obstacles.flatten().collect();
            Ok(Scene::among(description, &obstacles)?)
        })
    }

    /// The result of `take` for the description, whose vertices and surfaces are taken from `source`.
    fn described<R: Real<Si: SiFloat>, const V: usize, const S: usize, T, E: From<FormatError>>(
        &self,
        source: &mut impl FnMut(&mut [u8]) -> Result<(), E>,
        take: impl FnOnce(
            &Description<'_, R::Si>,
            &mut dyn FnMut(&mut [u8]) -> Result<(), E>,
        ) -> Result<T, E>,
    ) -> Result<T, E> {
        let narrow = R::Si::narrow;
        let mut vertices: Vec<[R::Si; 2], V> = Vec::new();
        for _ in 0..self.vertices {
            let vertex = point(source)?;
            vertices.push(vertex).map_err(|_| FormatError::Value)?;
        }
        let mut surfaces: Vec<SurfaceDescription<R::Si>, S> = Vec::new();
        for _ in 0..self.surfaces {
            let mut bytes = [0; SURFACE_BYTES];
            source(&mut bytes)?;
            let surface = surface(&bytes);
            surfaces.push(surface).map_err(|_| FormatError::Value)?;
        }
        let description = Description {
            vertices: &vertices,
            start: self.start.map(narrow),
            weight: narrow(self.weight),
            holding_point: self.holding_point.map(|point| point.map(narrow)),
            reach: narrow(self.reach),
            stiffness_translation: narrow(self.stiffness_translation),
            stiffness_rotation: narrow(self.stiffness_rotation),
            surfaces: &surfaces,
        };
        take(&description, source)
    }
}

/// A vertex or a corner.
fn point<F: SiFloat, E>(
    source: &mut (impl FnMut(&mut [u8]) -> Result<(), E> + ?Sized),
) -> Result<[F; 2], E> {
    let mut bytes = [0; VERTEX_BYTES];
    source(&mut bytes)?;
    let mut fields = Fields::new(&bytes);
    Ok([fields.f64(), fields.f64()].map(F::narrow))
}

/// An obstacle without its corners.
struct Obstacle<F> {
    friction_static: F,
    friction_dynamic: F,
    memory: Option<F>,
    corners: u8,
}

impl<F: SiFloat> Obstacle<F> {
    fn of(bytes: &[u8; OBSTACLE_BYTES]) -> Self {
        let mut fields = Fields::new(bytes);
        let [friction_static, friction_dynamic] = [(); 2].map(|()| F::narrow(fields.f64()));
        Self {
            friction_static,
            friction_dynamic,
            memory: memory(fields.f64()),
            corners: fields.u8(),
        }
    }
}

/// A memory length; NaN if none is given.
fn memory<F: SiFloat>(length: f64) -> Option<F> {
    (!length.is_nan()).then(|| F::narrow(length))
}

fn surface<F: SiFloat>(bytes: &[u8; SURFACE_BYTES]) -> SurfaceDescription<F> {
    let mut fields = Fields::new(bytes);
    let mut next = || fields.f64();
    SurfaceDescription {
        normal: [next(), next()].map(F::narrow),
        offset: F::narrow(next()),
        friction_static: F::narrow(next()),
        friction_dynamic: F::narrow(next()),
        memory: memory(next()),
    }
}
