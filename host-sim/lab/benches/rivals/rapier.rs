//! A scene in rapier2d, set up for one light body at a high frame rate: from a case to poses. The variants tried were the
//! hand as a joint with motors and as a force, one to eight solver iterations, contacts from 60 Hz to 5 kHz, masses from 2 g to
//! 0.3 kg and damping from one to four times critical; this variant holds the pose best and is as fast as any.

use rapier2d::prelude::*;
use stiction_scene::{Sample, SurfaceInfo};

use crate::case::{self, Case, hand_pose};
use crate::engine::Engine;

/// The lock file of the workspace, for the version that is linked.
const LOCK: &str = include_str!("../../../../Cargo.lock");

/// Statics does not depend on mass (kg), so it is free. A heavier body slides on when the hand stops; with a lighter one,
/// the contacts yield, whose stiffness in rapier scales with the mass, and at 10 g the hand's damping is unstable.
const MASS: f64 = 0.02;

/// Damping of the hand, relative to critical damping. At 1 the body overshoots, because the springs act off its centre; at 4 it
/// is unstable.
const DAMPING: f64 = 3.0;

/// Iterations of the solver per frame. rapier's default of 4 subdivides a frame of 1/60 s; a frame of 1 ms needs no
/// subdivision, and more iterations cost time without holding better.
const ITERATIONS: usize = 1;

/// How fast contacts with fixed surfaces push a body out (Hz), at rapier's own damping ratio. The default of 60 Hz, which is
/// also meant for frames of 1/60 s, lets this light body sink in by millimetres.
const CONTACT_FREQUENCY: f32 = 5000.0;

/// The size of objects here relative to rapier's metre, which scales its tolerances.
const LENGTH_UNIT: f32 = 0.1;

#[derive(Clone, Copy)]
pub(crate) struct Target {
    position: Vector,
    angle: f32,
}

struct Spring {
    stiffness: f32,
    damping: f32,
}

impl Spring {
    /// For a body of the given inertia (kg or kg·m²).
    fn new(stiffness: f64, inertia: f64) -> Self {
        Self {
            stiffness: stiffness as f32,
            damping: (2.0 * DAMPING * (stiffness * inertia).sqrt()) as f32,
        }
    }
}

/// A world with the case in it.
pub(crate) struct Rapier {
    world: PhysicsWorld,
    body: RigidBodyHandle,
    holding_point: Vector,
    translation: Spring,
    rotation: Spring,
    rate: f32,
    last: Target,
}

impl Engine for Rapier {
    type Hand = Target;

    fn name() -> String {
        format!("rapier2d {}", version())
    }

    fn new(case: &Case) -> Self {
        let mut world = world(case);
        for surface in &case.scene.surfaces {
            insert_surface(&mut world, surface);
        }
        let inertia = moment_of_inertia(&case.scene.vertices);
        let body = insert_body(&mut world, case, inertia);
        Self {
            world,
            body,
            holding_point: vector(case.holding_point()),
            translation: Spring::new(case.scene.stiffness_translation, MASS),
            rotation: Spring::new(case.scene.stiffness_rotation, inertia),
            rate: case.rate as f32,
            last: Self::hand(case.first()),
        }
    }

    fn hand(sample: &Sample) -> Target {
        let [x, y, angle] = hand_pose(sample);
        Target {
            position: vector([x, y]),
            angle: angle as f32,
        }
    }

    /// The hand's springs as a force and a torque, evaluated at the pose of the body after the frame and damped relative to the
    /// moving hand. A joint with motors needs the 4 iterations, takes 50 % longer and holds no better.
    fn step(&mut self, hand: Target) {
        let speed = (hand.position - self.last.position) * self.rate;
        let turning = (hand.angle - self.last.angle) * self.rate;
        self.last = hand;
        let dt = self.world.integration_parameters.dt;
        let body = &mut self.world.bodies[self.body];
        let held = body.position().transform_point(self.holding_point);
        let (velocity, spin) = (body.velocity_at_point(held), body.angvel());
        let force = (hand.position - held - velocity * dt) * self.translation.stiffness
            + (speed - velocity) * self.translation.damping;
        let ahead = hand.angle - body.rotation().angle() - spin * dt;
        let torque = ahead * self.rotation.stiffness + (turning - spin) * self.rotation.damping;
        body.reset_forces(false);
        body.reset_torques(false);
        body.add_force_at_point(force, held, true);
        body.add_torque(torque, true);
        self.world.step();
    }

    fn pose(&self) -> case::Pose {
        let body = &self.world.bodies[self.body];
        let at = body.translation();
        [at.x, at.y, body.rotation().angle()].map(f64::from)
    }
}

/// An empty world without gravity: the bodies of the scenes weigh nothing.
fn world(case: &Case) -> PhysicsWorld {
    let mut world = PhysicsWorld {
        gravity: Vector::ZERO,
        ..PhysicsWorld::default()
    };
    let parameters = &mut world.integration_parameters;
    parameters.dt = (1.0 / case.rate) as f32;
    parameters.length_unit = LENGTH_UNIT;
    parameters.num_solver_iterations = ITERATIONS;
    parameters.static_contact_softness.natural_frequency = CONTACT_FREQUENCY;
    // Some 20 micrometres per frame need no continuous collision detection.
    parameters.max_ccd_substeps = 0;
    world
}

/// A half-plane, as exact as the scene's. Its friction is that of the contact: rapier has one coefficient, which gets
/// the static one.
fn insert_surface(world: &mut PhysicsWorld, surface: &SurfaceInfo) {
    let normal = vector(surface.normal);
    let collider = ColliderBuilder::halfspace(rapier2d::na::Unit::new_unchecked(normal))
        .translation(normal * surface.offset as f32)
        .friction(surface.friction_static as f32)
        .friction_combine_rule(CoefficientCombineRule::Max);
    world.insert(RigidBodyBuilder::fixed(), collider);
}

/// The body. It may not sleep: a sleeping body neither creeps nor feels a slow hand.
fn insert_body(world: &mut PhysicsWorld, case: &Case, inertia: f64) -> RigidBodyHandle {
    let vertices: Vec<_> = case.scene.vertices.iter().map(|&v| vector(v)).collect();
    let shape = match *vertices.as_slice() {
        [a, b] => ColliderBuilder::segment(a, b),
        _ => ColliderBuilder::convex_hull(&vertices).expect("the body is a convex polygon"),
    };
    let [x, y, theta] = case.scene.start;
    let mass = MassProperties::new(Vector::ZERO, MASS as f32, inertia as f32);
    let body = RigidBodyBuilder::dynamic()
        .translation(vector([x, y]))
        .rotation(theta as f32)
        .additional_mass_properties(mass)
        .can_sleep(false);
    world.insert(body, shape.density(0.0).friction(0.0)).0
}

/// The moment of inertia of a rectangle or a rod about its middle, the origin of its frame (kg·m²).
fn moment_of_inertia(vertices: &[[f64; 2]]) -> f64 {
    let extent = |k: usize| {
        let size = |far: f64, v: &[f64; 2]| v[k].abs().max(far);
        2.0 * vertices.iter().fold(0.0, size)
    };
    MASS * (extent(0).powi(2) + extent(1).powi(2)) / 12.0
}

fn vector([x, y]: [f64; 2]) -> Vector {
    Vector::new(x as f32, y as f32)
}

fn version() -> &'static str {
    LOCK.split("name = \"rapier2d\"")
        .nth(1)
        .and_then(|rest| rest.split('"').nth(1))
        .unwrap_or_default()
}
