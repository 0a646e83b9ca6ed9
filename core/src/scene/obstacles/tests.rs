//! Worlds of obstacles for the tests of refusals, of axes and of united sides.

extern crate std;

use super::*;
use crate::scene::SurfaceDescription;
use crate::si::SiFloat;
use std::vec;
use std::vec::Vec as List;

mod axes;
mod refused;
mod united;

/// The capacities of a solver in these tests.
type Among<R> = Scene<R, 4, 2, WithObstacles<6, 24>>;

/// An obstacle in f64.
#[derive(Clone)]
struct Shape {
    vertices: List<[f64; 2]>,
    mu: [f64; 2],
    memory: Option<f64>,
}

fn shape(vertices: &[[f64; 2]]) -> Shape {
    Shape {
        vertices: vertices.to_vec(),
        mu: [0.5, 0.3],
        memory: None,
    }
}

/// A box given by its lower left corner.
fn block([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Shape {
    let (right, top) = (x + width, y + height);
    shape(&[[x, y], [right, y], [right, top], [x, top]])
}

/// A body of size 1, half-planes as normal and offset, obstacles.
#[derive(Clone)]
struct Setup {
    body: List<[f64; 2]>,
    start: [f64; 3],
    planes: List<([f64; 2], f64)>,
    shapes: List<Shape>,
}

impl Setup {
    /// A rod, far above all obstacles.
    fn of(shapes: &[Shape]) -> Self {
        Self {
            body: vec![[-0.5, 0.0], [0.5, 0.0]],
            start: [0.0, 9.0, 0.0],
            planes: vec![],
            shapes: shapes.to_vec(),
        }
    }

    fn scene<R: Real<Si: SiFloat>, const V: usize, const S: usize, M: Model>(
        &self,
    ) -> Result<Scene<R, V, S, M>, SceneError<R::Si>> {
        let nd = |x: f64| <R::Si as SiFloat>::narrow(x);
        let points = |list: &[[f64; 2]]| -> List<[R::Si; 2]> {
            list.iter().map(|point| point.map(nd)).collect()
        };
        let surfaces: List<_> = (self.planes.iter())
            .map(|(normal, offset)| SurfaceDescription {
                normal: normal.map(nd),
                offset: nd(*offset),
                friction_static: nd(0.0),
                friction_dynamic: nd(0.0),
                memory: None,
            })
            .collect();
        let corners: List<_> = self.shapes.iter().map(|s| points(&s.vertices)).collect();
        let obstacles: List<_> = (self.shapes.iter().zip(&corners))
            .map(|(shape, corners)| ObstacleDescription {
                vertices: corners,
                friction_static: nd(shape.mu[0]),
                friction_dynamic: nd(shape.mu[1]),
                memory: shape.memory.map(nd),
            })
            .collect();
        let description = Description {
            vertices: &points(&self.body),
            start: self.start.map(nd),
            weight: nd(0.0),
            holding_point: None,
            reach: nd(0.0),
            stiffness_translation: nd(1.0),
            stiffness_rotation: nd(1.0),
            surfaces: &surfaces,
            obstacles: &obstacles,
        };
        Scene::new(&description)
    }
}

/// Runs a check in every number type.
macro_rules! in_all_numbers {
    ($check:ident $(, $argument:expr)*) => {
        $check::<f64>($($argument),*);
        $check::<f32>($($argument),*);
        $check::<crate::real::Fixed>($($argument),*);
    };
}
use in_all_numbers;
