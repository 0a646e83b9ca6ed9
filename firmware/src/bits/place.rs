//! The surroundings of the walk: the box of the benchmarks by a floor and a wall, or among obstacles.

use stiction_core::{Description, ObstacleDescription, Real, Scene, SiFloat, SurfaceDescription};

/// The wall leans back, so that a vertex of the box fits where it meets the floor, at x = 0.12 m.
const WALL: ([f64; 2], f64) = ([-0.8, 0.6], -0.096);
/// A table that begins at x = -0.06 m, a block on its right end that leans back, so that a vertex of the box fits between them, and a pin
/// on the left (m).
const TABLE: [[f64; 2]; 4] = [[-0.06, -0.1], [0.12, -0.1], [0.12, 0.0], [-0.06, 0.0]];
const BLOCK: [[f64; 2]; 4] = [[0.08, -0.1], [0.4, -0.1], [0.4, 0.05], [0.14, 0.05]];
const PIN: [[f64; 2]; 1] = [[-0.12, 0.03]];

/// The corners of the obstacles.
pub const CORNERS: usize = TABLE.len() + BLOCK.len() + PIN.len();

/// The scene of the walk, which is sound: by the walls, or, with room for corners, among the obstacles.
pub(super) fn scene<R: Real<Si: SiFloat>, const C: usize>() -> Option<Scene<R, 4, 2, C>> {
    let narrow = |[x, y]: [f64; 2]| [R::Si::narrow(x), R::Si::narrow(y)];
    let [friction_static, friction_dynamic] = narrow([0.5, 0.3]);
    if C == 0 {
        let surface = |normal: [f64; 2], offset: f64| SurfaceDescription {
            normal: narrow(normal),
            offset: R::Si::narrow(offset),
            friction_static,
            friction_dynamic,
            memory: None,
        };
        let surfaces = [surface([0.0, 1.0], 0.0), surface(WALL.0, WALL.1)];
        return with_box((&surfaces, &[]), |description| Scene::new(description).ok());
    }
    let (table, block, pin) = (TABLE.map(narrow), BLOCK.map(narrow), PIN.map(narrow));
    let of_wood = |vertices| ObstacleDescription {
        vertices,
        friction_static,
        friction_dynamic,
        memory: None,
    };
    let obstacles = [of_wood(&table), of_wood(&block), of_wood(&pin)];
    with_box((&[], &obstacles), |description| {
        Scene::new(description).ok()
    })
}

/// The box among these surfaces and obstacles.
fn with_box<F: SiFloat, T>(
    (surfaces, obstacles): (&[SurfaceDescription<F>], &[ObstacleDescription<'_, F>]),
    take: impl FnOnce(&Description<'_, F>) -> T,
) -> T {
    let narrow = F::narrow;
    let vertices = [[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]];
    take(&Description {
        vertices: &vertices.map(|vertex| vertex.map(narrow)),
        start: [-0.03, 0.08, 0.0].map(narrow),
        weight: narrow(1.0),
        holding_point: Some([0.0, 0.02].map(narrow)),
        reach: narrow(0.0),
        stiffness_translation: narrow(500.0),
        stiffness_rotation: narrow(0.5),
        surfaces,
        obstacles,
    })
}
