//! A scene that is run sample by sample, whatever the type of its solver: the object behind the bindings for other languages.

use std::collections::TryReserveError;
use std::ops::ControlFlow;

use stiction_core::Evolution;
use stiction_scene::{HostSolver, InputError, Sample, SceneFile};

use crate::number::Number;
use crate::record::Frame;
pub use crate::simulate::Contacts;
use crate::simulate::{Kind, Running, Shared, Task, with_solver};

/// A solver with its run. A copy is an independent run.
pub struct Session(Box<dyn Steps>);

impl Session {
    /// Creates a session of a scene, before its first sample, with the budget of a frame (pieces of work; `u32::MAX`: none).
    ///
    /// # Errors
    /// The scene is refused in this number type.
    pub fn new(
        scene: &SceneFile,
        number: Number,
        evolution: Evolution,
        budget: u32,
    ) -> Result<Self, InputError> {
        let kind = Kind {
            number,
            evolution,
            budget,
        };
        with_solver(scene, kind, Boxed)
    }

    /// Creates a session of a solver of any type, before its first sample.
    pub fn of<R: Shared>(running: Running<R>) -> Self
    where
        HostSolver<R>: Send + Sync,
    {
        Self(Box::new(running))
    }

    /// Returns the frame of the next sample; the first sample starts the scene.
    pub fn step(&mut self, sample: &Sample) -> Frame {
        self.0.step(sample)
    }

    /// Passes the frames of samples without their contacts to `take`, which may end the run; the returned value computes the contacts
    /// on demand.
    ///
    /// # Errors
    /// There is no memory for the hands of the samples.
    pub fn run(
        &mut self,
        samples: &mut dyn Iterator<Item = Sample>,
        take: &mut dyn FnMut(&Frame) -> ControlFlow<()>,
    ) -> Result<Box<dyn Contacts>, TryReserveError> {
        self.0.run(samples, take)
    }
}

impl Clone for Session {
    fn clone(&self) -> Self {
        Self(self.0.copy())
    }
}

trait Steps: Send + Sync {
    fn step(&mut self, sample: &Sample) -> Frame;
    fn run(
        &mut self,
        samples: &mut dyn Iterator<Item = Sample>,
        take: &mut dyn FnMut(&Frame) -> ControlFlow<()>,
    ) -> Result<Box<dyn Contacts>, TryReserveError>;
    fn copy(&self) -> Box<dyn Steps>;
}

impl<R: Shared> Steps for Running<R>
where
    HostSolver<R>: Send + Sync,
{
    fn step(&mut self, sample: &Sample) -> Frame {
        self.frame(sample)
    }

    fn run(
        &mut self,
        samples: &mut dyn Iterator<Item = Sample>,
        take: &mut dyn FnMut(&Frame) -> ControlFlow<()>,
    ) -> Result<Box<dyn Contacts>, TryReserveError> {
        self.without_contacts(samples, take)
    }

    fn copy(&self) -> Box<dyn Steps> {
        Box::new(self.clone())
    }
}

struct Boxed;

impl Task for Boxed {
    type Done = Session;

    fn with<R: Shared>(self, running: Running<R>) -> Session
    where
        HostSolver<R>: Send + Sync,
    {
        Session::of(running)
    }
}
