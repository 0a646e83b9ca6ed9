//! The surroundings of the walk: the box of the benchmarks, with weight by a floor and a wall, without weight among obstacles.

use stiction_core::{
    Description, Full, Model, ObstacleDescription, Real, Scene, SiFloat, SurfaceDescription,
    Weightless, WithObstacles,
};

/// The wall leans back, so that a vertex of the box fits where it meets the floor, at x = 0.12 m.
const WALL: ([f64; 2], f64) = ([-0.8, 0.6], -0.096);
/// A table that begins at x = -0.06 m, a block on its right end that leans back, so that a vertex of the box fits between them, and a pin
/// on the left (m).
const TABLE: [[f64; 2]; 4] = [[-0.06, -0.1], [0.12, -0.1], [0.12, 0.0], [-0.06, 0.0]];
const BLOCK: [[f64; 2]; 4] = [[0.08, -0.1], [0.4, -0.1], [0.4, 0.05], [0.14, 0.05]];
const PIN: [[f64; 2]; 1] = [[-0.12, 0.03]];

/// A model with surroundings for the walk.
pub trait Place: Model {
    /// The scene, which is sound.
    fn scene<R: Real<Si: SiFloat>>() -> Option<Scene<R, 4, 2, Self>>
    where
        Self: Sized;
}

/// The model of the walk among obstacles, without weight: with weight, it does not fit into the flash of the smallest chip.
pub type Among = WithObstacles<3, 9, Weightless>;

impl Place for Full {
    fn scene<R: Real<Si: SiFloat>>() -> Option<Scene<R, 4, 2>> {
        let surface = |normal: [f64; 2], offset: f64| SurfaceDescription {
            normal: normal.map(R::Si::narrow),
            offset: R::Si::narrow(offset),
            friction_static: R::Si::narrow(0.5),
            friction_dynamic: R::Si::narrow(0.3),
            memory: None,
        };
        let surfaces = [surface([0.0, 1.0], 0.0), surface(WALL.0, WALL.1)];
        with_box((&surfaces, &[]), 1.0, |description| {
            Scene::new(description).ok()
        })
    }
}

impl Place for Among {
    fn scene<R: Real<Si: SiFloat>>() -> Option<Scene<R, 4, 2, Self>> {
        let narrow = |[x, y]: [f64; 2]| [R::Si::narrow(x), R::Si::narrow(y)];
        let (table, block, pin) = (TABLE.map(narrow), BLOCK.map(narrow), PIN.map(narrow));
        let of_wood = |vertices| ObstacleDescription {
            vertices,
            friction_static: R::Si::narrow(0.5),
            friction_dynamic: R::Si::narrow(0.3),
            memory: None,
        };
        let obstacles = [of_wood(&table), of_wood(&block), of_wood(&pin)];
        with_box((&[], &obstacles), 0.0, |description| {
            Scene::new(description).ok()
        })
    }
}

/// The box among these surfaces and obstacles, with a weight (N).
fn with_box<F: SiFloat, T>(
    (surfaces, obstacles): (&[SurfaceDescription<F>], &[ObstacleDescription<'_, F>]),
    weight: f64,
    take: impl FnOnce(&Description<'_, F>) -> T,
) -> T {
    let narrow = F::narrow;
    let vertices = [[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]];
    take(&Description {
        vertices: &vertices.map(|vertex| vertex.map(narrow)),
        start: [-0.03, 0.08, 0.0].map(narrow),
        weight: narrow(weight),
        holding_point: Some([0.0, 0.02].map(narrow)),
        reach: narrow(0.0),
        stiffness_translation: narrow(500.0),
        stiffness_rotation: narrow(0.5),
        surfaces,
        obstacles,
    })
}
