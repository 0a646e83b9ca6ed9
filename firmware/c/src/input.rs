//! The input from C: a scene and samples of the hand. SI units; the world frame is right-handed with y upwards, angles are
//! counter-clockwise.

use core::{ptr, slice};

use stiction_core::{
    Angle, Description, Hand as CoreHand, ObstacleDescription, SurfaceDescription,
};

use crate::memory::{CORNERS, Checked, OBSTACLES, SURFACES, VERTICES, checked};

/// A fixed half-plane. It has no ends and does not move.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Its normal, which points to the free side; of any length but 0.
    pub normal: [f32; 2],
    /// Its position b (m): the free side is n.p >= b, with n of length 1.
    pub offset: f32,
    /// Coefficient of static friction, not less than that of dynamic friction.
    pub friction_static: f32,
    /// Coefficient of dynamic friction, 0 or more. If it equals the static one contacts slide steadily, if it is smaller they stick and
    /// slip.
    pub friction_dynamic: f32,
    /// Memory length D_c (m), 0 or more: if the normal force is at least k_h D_c / (mu_s - mu_d) a contact sticks and slips, if it is less
    /// it slides. Only with `has_memory`; without, D_c is 1/4096 of the size of the body.
    pub memory: f32,
    /// Not 0: `memory` applies.
    pub has_memory: u8,
}

/// A fixed obstacle: a convex polygon, a thin wall or a pin. Only in a library with obstacles.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Obstacle {
    /// Its corners (m), counter-clockwise: a strictly convex polygon, two for a thin wall, one for a pin.
    pub vertices: *const [f32; 2],
    /// The number of corners.
    pub vertex_count: u32,
    /// As for a surface.
    pub friction_static: f32,
    /// As for a surface.
    pub friction_dynamic: f32,
    /// As for a surface.
    pub memory: f32,
    /// Not 0: `memory` applies.
    pub has_memory: u8,
}

/// A scene. It is copied: nothing of it is needed after `stiction_init` has returned. Members that are not named in an initialiser are 0,
/// which is a usable choice for all except vertices and stiffness.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// The body's vertices (m), in its own frame: a point, a rod of two, or a strictly convex polygon, counter-clockwise.
    pub vertices: *const [f32; 2],
    /// The number of vertices: 1 to `STICTION_VERTICES`.
    pub vertex_count: u32,
    /// Start pose: x, y (m), theta (rad) of the body's frame in the world. No vertex is deeper in a surface than 1e-5 of the body's size.
    pub start: [f32; 3],
    /// Weight (N), 0 or more, at the centroid, along -y.
    pub weight: f32,
    /// The point at which the hand holds the body first (m), in the body's frame. Only with `has_holding_point`.
    pub holding_point: [f32; 2],
    /// Not 0: `holding_point` applies. 0: the hand takes hold where it is.
    pub has_holding_point: u8,
    /// How far outside the body a hand may be and still take hold (m), 0 or more.
    pub reach: f32,
    /// Translational stiffness k_h (N/m), more than 0: the hand pulls the holding point with k_h times its displacement.
    pub stiffness_translation: f32,
    /// Rotational stiffness k_theta (N m/rad), 0 or more: the hand turns the body with k_theta times the difference of angles.
    pub stiffness_rotation: f32,
    /// The surfaces; may be null if there are none.
    pub surfaces: *const Surface,
    /// The number of surfaces: at most `STICTION_SURFACES`.
    pub surface_count: u32,
    /// The obstacles; null if there are none, and in a library without obstacles.
    pub obstacles: *const Obstacle,
    /// The number of obstacles: at most `STICTION_OBSTACLES`, with at most `STICTION_CORNERS` corners together; 0 in a library without
    /// obstacles.
    pub obstacle_count: u32,
}

/// A sample of the hand.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Hand {
    /// Position (m).
    pub x: f32,
    /// Position (m).
    pub y: f32,
    /// Angle (rad), unwrapped: it goes on beyond a turn.
    pub phi: f32,
    /// Whole turns that are added to it: with many turns in `phi` alone few digits would be left.
    pub turns: i32,
    /// Depth across the plane (m); it is passed through.
    pub depth: f32,
    /// Not 0: the hand holds the body, or takes hold as soon as it is within reach.
    pub held: u8,
}

impl Hand {
    pub(crate) fn sample(&self) -> CoreHand<f32> {
        let angle = Angle::from_radians(self.phi);
        CoreHand {
            position: [self.x, self.y],
            angle: Angle {
                turns: angle.turns.saturating_add(self.turns),
                rest: angle.rest,
            },
            depth: self.depth,
            held: self.held != 0,
            tilted: false,
        }
    }
}

/// A description in the core's types, with the lists of surfaces and obstacles that it borrows.
pub(crate) struct Described<'a> {
    scene: &'a Scene,
    vertices: &'a [[f32; 2]],
    surfaces: [SurfaceDescription<f32>; SURFACES + 1],
    obstacles: [ObstacleDescription<'a, f32>; OBSTACLES + 1],
}

impl<'a> Described<'a> {
    /// Reads the data that the pointers of a scene point to.
    pub(crate) fn read(scene: &'a Scene) -> Checked<Self> {
        let vertices = list(
            scene.vertices,
            scene.vertex_count,
            &[[0.0; 2]; VERTICES + 1],
        )?;
        let given = list(
            scene.surfaces,
            scene.surface_count,
            &[Surface::NONE; SURFACES + 1],
        )?;
        let mut surfaces = [SurfaceDescription::from(&Surface::NONE); SURFACES + 1];
        for (to, from) in surfaces.iter_mut().zip(given) {
            *to = from.into();
        }
        let given = list(
            scene.obstacles,
            scene.obstacle_count,
            &[Obstacle::NONE; OBSTACLES + 1],
        )?;
        let nothing = ObstacleDescription {
            vertices: &[],
            friction_static: 0.0,
            friction_dynamic: 0.0,
            memory: None,
        };
        let mut obstacles = [nothing; OBSTACLES + 1];
        for (to, from) in obstacles.iter_mut().zip(given) {
            *to = ObstacleDescription {
                vertices: list(from.vertices, from.vertex_count, &[[0.0; 2]; CORNERS + 1])?,
                friction_static: from.friction_static,
                friction_dynamic: from.friction_dynamic,
                memory: (from.has_memory != 0).then_some(from.memory),
            };
        }
        Ok(Self {
            scene,
            vertices,
            surfaces,
            obstacles,
        })
    }

    pub(crate) fn scene(&self) -> Description<'_, f32> {
        let scene = self.scene;
        Description {
            vertices: self.vertices,
            start: scene.start,
            weight: scene.weight,
            holding_point: (scene.has_holding_point != 0).then_some(scene.holding_point),
            reach: scene.reach,
            stiffness_translation: scene.stiffness_translation,
            stiffness_rotation: scene.stiffness_rotation,
            surfaces: first(&self.surfaces, scene.surface_count),
            obstacles: first(&self.obstacles, scene.obstacle_count),
        }
    }
}

impl Surface {
    const NONE: Self = Self {
        normal: [0.0; 2],
        offset: 0.0,
        friction_static: 0.0,
        friction_dynamic: 0.0,
        memory: 0.0,
        has_memory: 0,
    };
}

impl Obstacle {
    const NONE: Self = Self {
        vertices: ptr::null(),
        vertex_count: 0,
        friction_static: 0.0,
        friction_dynamic: 0.0,
        memory: 0.0,
        has_memory: 0,
    };
}

impl From<&Surface> for SurfaceDescription<f32> {
    fn from(given: &Surface) -> Self {
        Self {
            normal: given.normal,
            offset: given.offset,
            friction_static: given.friction_static,
            friction_dynamic: given.friction_dynamic,
            memory: (given.has_memory != 0).then_some(given.memory),
        }
    }
}

/// The first `count` elements, or all.
fn first<T>(list: &[T], count: u32) -> &[T] {
    let count = usize::try_from(count).unwrap_or(usize::MAX);
    list.get(..count).unwrap_or(list)
}

/// A list from C; an empty one may be a null pointer. If a list is longer than there is room for, it is not read: `too_many`, one more than
/// fits, stands for it, so that the core reports it.
#[allow(unsafe_code)]
fn list<T>(place: *const T, count: u32, too_many: &[T]) -> Checked<&[T]> {
    if count == 0 {
        return Ok(&[]);
    }
    let place = checked(place)?;
    let count = usize::try_from(count).unwrap_or(usize::MAX);
    if count >= too_many.len() {
        return Ok(too_many);
    }
    // SAFETY: the header requires a pointer to `count` elements that exist while the function runs; it is aligned and not null, and every
    // value of the bytes is a value of T, which contains only numbers and pointers.
    Ok(unsafe { slice::from_raw_parts(place, count) })
}
