//! The obstacles in a board's model: none, or room for some. The whole difference between the two is here, so that an image without
//! obstacles contains nothing of them: from a scene as given to the solver's scene, from a command to a scene, from contacts to the report
//! of their forces.

use core::fmt::Debug;
use heapless::Vec;
use stiction_core::{
    Description, MAX_CONTACTS, Model, ObstacleDescription, Parameter, Parts, Real, Scene,
    SceneError, Solver, State, SurfaceDescription, WithObstacles,
};
use stiction_wire::{
    Command, CommandAmong, ContactAmong, Forces, List, Message, ObstacleList, Parameters, Report,
    ReportAmong, Room, obstacle_bytes,
};

/// The model of a board's solver.
pub trait BoardModel: Model {
    /// There is room for obstacles. As a constant it leaves no code for them to compile.
    const AMONG: bool;
    /// The room; `None` if the model has none.
    const ROOM: Option<Room>;
    /// The number of bytes by which the longest scene with obstacles exceeds the one without.
    const OBSTACLE_BYTES: usize;
    /// Bytes of a contact in the longer report of forces.
    const CONTACT_BYTES: usize;

    /// The obstacles of a scene as given: a slice of descriptions, or nothing.
    type Surroundings<'a>: Copy + Debug;
    /// The obstacles of a scene, stored with all that they refer to.
    type Stored: Clone + Debug + PartialEq;
    /// The messages that the board receives.
    type Command<'a>: Message<'a> + Into<CommandAmong<'a>>;
    /// The messages that it sends.
    type Report<'a>: Message<'a> + From<Report<'a>>;

    /// No obstacles.
    const NO_OBSTACLES: Self::Surroundings<'static>;

    /// The scene for the solver.
    ///
    /// # Errors
    /// Those of [`Scene::new`], and those of the obstacles.
    fn scene<R: Real<Si = f32>, const V: usize, const S: usize>(
        description: &Description<'_, f32>,
        obstacles: Self::Surroundings<'_>,
    ) -> Result<Scene<R, V, S, Self>, SceneError<f32>>
    where
        Self: Sized;

    /// The report of its room, in answer to hello.
    fn room_report() -> Option<Self::Report<'static>>;

    /// Passes obstacles that arrived over the wire to `take`.
    ///
    /// # Errors
    /// There is no room for them.
    fn with_received<T>(
        obstacles: &ObstacleList<'_>,
        take: impl for<'a> FnOnce(Self::Surroundings<'a>) -> T,
    ) -> Result<T, SceneError<f32>>;

    /// Stores obstacles; `None` if there is no room for them.
    fn keep(obstacles: Self::Surroundings<'_>) -> Option<Self::Stored>;

    /// Passes the stored obstacles to a function.
    fn with_stored<T>(
        stored: &Self::Stored,
        look: impl for<'a> FnOnce(Self::Surroundings<'a>) -> T,
    ) -> T;

    /// Friction and memory length of every obstacle.
    fn set_friction(stored: &mut Self::Stored, new: &Parameters);

    /// mu_s, mu_d and memory length of the first obstacle.
    fn first_friction(stored: &Self::Stored) -> Option<([f32; 2], Option<f32>)>;

    /// Passes the report of forces, with the contacts of a state, to `send`.
    fn with_forces<R: Real<Si = f32>, const V: usize, const S: usize, T>(
        forces: Forces<'_>,
        solver: &Solver<R, V, S, Self>,
        state: Option<&State<R>>,
        stored: &Self::Stored,
        send: impl FnOnce(Self::Report<'_>) -> T,
    ) -> T
    where
        Self: Sized;
}

impl<const FRICTION: bool, const WEIGHT: bool> BoardModel for Parts<FRICTION, WEIGHT> {
    const AMONG: bool = false;
    const ROOM: Option<Room> = None;
    const OBSTACLE_BYTES: usize = 0;
    const CONTACT_BYTES: usize = 19;
    const NO_OBSTACLES: () = ();
    type Surroundings<'a> = ();
    type Stored = ();
    type Command<'a> = Command<'a>;
    type Report<'a> = Report<'a>;

    fn scene<R: Real<Si = f32>, const V: usize, const S: usize>(
        description: &Description<'_, f32>,
        (): (),
    ) -> Result<Scene<R, V, S, Self>, SceneError<f32>> {
        Scene::new(description)
    }
    fn room_report() -> Option<Report<'static>> {
        None
    }
    fn with_received<T>(
        obstacles: &ObstacleList<'_>,
        _: impl FnOnce(()) -> T,
    ) -> Result<T, SceneError<f32>> {
        // None of its commands contains any.
        Err(SceneError {
            parameter: Parameter::ObstacleCount,
            value: u16::try_from(obstacles.len()).map_or(f32::INFINITY, f32::from),
            allowed: "0 in a model without obstacles",
        })
    }
    fn keep((): ()) -> Option<()> {
        Some(())
    }
    fn with_stored<T>((): &(), look: impl FnOnce(()) -> T) -> T {
        look(())
    }
    fn set_friction((): &mut (), _: &Parameters) {}
    fn first_friction((): &()) -> Option<([f32; 2], Option<f32>)> {
        None
    }
    fn with_forces<R: Real<Si = f32>, const V: usize, const S: usize, T>(
        forces: Forces<'_>,
        _: &Solver<R, V, S, Self>,
        _: Option<&State<R>>,
        (): &(),
        send: impl FnOnce(Report<'_>) -> T,
    ) -> T {
        send(Report::Forces(forces))
    }
}

/// Obstacles as they were given, with room for O of them and C corners.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredObstacles<const O: usize, const C: usize> {
    corners: Vec<[f32; 2], C>,
    rows: Vec<Row, O>,
}

/// An obstacle without its corners, of which it has `corners`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Row {
    corners: usize,
    friction_static: f32,
    friction_dynamic: f32,
    memory: Option<f32>,
}

/// A place for a surface that is to be received.
pub(crate) const NOWHERE: SurfaceDescription<f32> = SurfaceDescription {
    normal: [0.0, 1.0],
    offset: 0.0,
    friction_static: 0.0,
    friction_dynamic: 0.0,
    memory: None,
};

const NO_OBSTACLE: ObstacleDescription<'static, f32> = ObstacleDescription {
    vertices: &[],
    friction_static: 0.0,
    friction_dynamic: 0.0,
    memory: None,
};

const fn byte(count: usize) -> u8 {
    if count < 255 { count as u8 } else { 255 }
}

impl<const O: usize, const C: usize, M: Model> BoardModel for WithObstacles<O, C, M> {
    const AMONG: bool = true;
    const ROOM: Option<Room> = Some(Room {
        obstacles: byte(O),
        corners: byte(C),
    });
    const OBSTACLE_BYTES: usize = obstacle_bytes(O, C);
    const CONTACT_BYTES: usize = 28;
    const NO_OBSTACLES: &'static [ObstacleDescription<'static, f32>] = &[];
    type Surroundings<'a> = &'a [ObstacleDescription<'a, f32>];
    type Stored = StoredObstacles<O, C>;
    type Command<'a> = CommandAmong<'a>;
    type Report<'a> = ReportAmong<'a>;

    fn scene<R: Real<Si = f32>, const V: usize, const S: usize>(
        description: &Description<'_, f32>,
        obstacles: &[ObstacleDescription<'_, f32>],
    ) -> Result<Scene<R, V, S, Self>, SceneError<f32>> {
        Scene::among(description, obstacles)
    }

    fn room_report() -> Option<ReportAmong<'static>> {
        Self::ROOM.map(ReportAmong::Room)
    }

    fn with_received<T>(
        obstacles: &ObstacleList<'_>,
        take: impl for<'a> FnOnce(&'a [ObstacleDescription<'a, f32>]) -> T,
    ) -> Result<T, SceneError<f32>> {
        let mut corners = [[0.0; 2]; C];
        let mut places = [NO_OBSTACLE; O];
        obstacles.descriptions(&mut corners, &mut places).map(take)
    }

    fn keep(obstacles: &[ObstacleDescription<'_, f32>]) -> Option<Self::Stored> {
        let mut stored = StoredObstacles {
            corners: Vec::new(),
            rows: Vec::new(),
        };
        for obstacle in obstacles {
            stored.corners.extend_from_slice(obstacle.vertices).ok()?;
            let row = Row {
                corners: obstacle.vertices.len(),
                friction_static: obstacle.friction_static,
                friction_dynamic: obstacle.friction_dynamic,
                memory: obstacle.memory,
            };
            stored.rows.push(row).ok()?;
        }
        Some(stored)
    }

    fn with_stored<T>(
        stored: &Self::Stored,
        look: impl for<'a> FnOnce(&'a [ObstacleDescription<'a, f32>]) -> T,
    ) -> T {
        let mut rest = stored.corners.as_slice();
        let mut obstacles: Vec<_, O> = Vec::new();
        for row in &stored.rows {
            // The number of corners is the sum over the rows, and there is one row for each obstacle.
            let (vertices, after) = rest.split_at_checked(row.corners).unwrap_or((rest, &[]));
            rest = after;
            let _ = obstacles.push(ObstacleDescription {
                vertices,
                friction_static: row.friction_static,
                friction_dynamic: row.friction_dynamic,
                memory: row.memory,
            });
        }
        look(&obstacles)
    }

    fn set_friction(stored: &mut Self::Stored, new: &Parameters) {
        for row in &mut stored.rows {
            row.friction_static = new.friction_static;
            row.friction_dynamic = new.friction_dynamic;
            row.memory = new.memory;
        }
    }

    fn first_friction(stored: &Self::Stored) -> Option<([f32; 2], Option<f32>)> {
        let first = stored.rows.first()?;
        let coefficients = [first.friction_static, first.friction_dynamic];
        Some((coefficients, first.memory))
    }

    fn with_forces<R: Real<Si = f32>, const V: usize, const S: usize, T>(
        forces: Forces<'_>,
        solver: &Solver<R, V, S, Self>,
        state: Option<&State<R>>,
        stored: &Self::Stored,
        send: impl FnOnce(ReportAmong<'_>) -> T,
    ) -> T {
        if stored.rows.is_empty() {
            return send(ReportAmong::Common(Report::Forces(forces)));
        }
        let touches = state.map(|state| solver.touches(state)).unwrap_or_default();
        let pairs = forces.contacts.iter().zip(touches.iter());
        let among = pairs.map(|(contact, touching)| ContactAmong::new(&contact, touching));
        let mut contacts: Vec<ContactAmong, MAX_CONTACTS> = Vec::new();
        for contact in among {
            // There are never more than there is room for.
            let _ = contacts.push(contact);
        }
        send(ReportAmong::ForcesAmong(Forces {
            wrench: forces.wrench,
            feedback: forces.feedback,
            turns: forces.turns,
            contacts: List::from(contacts.as_slice()),
        }))
    }
}
