//! A scene that is run sample by sample, whatever the type of its solver: the object behind the bindings for other languages.

use stiction_core::{Evolution, Model};
use stiction_scene::{HostSolver, InputError, Sample, SceneFile};

use crate::number::Number;
use crate::record::Frame;
pub use crate::simulate::Contacts;
use crate::simulate::{Kind, Running, Shared, Task, with_solver};

/// A solver with its run. A copy is an independent run.
pub struct Session(Box<dyn Steps>);

impl Session {
    /// Creates a session of a scene, before its first sample, with the budget of a frame (units of work; `u32::MAX`: none).
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
    pub fn of<R: Shared, M: Model>(running: Running<R, M>) -> Self
    where
        HostSolver<R, M>: Send + Sync,
    {
        Self(Box::new(running))
    }

    /// Returns the frame of the next sample; the first sample starts the scene.
    pub fn step(&mut self, sample: &Sample) -> Frame {
        self.0.step(sample)
    }

    /// Passes the frames of samples without their contacts to `take`; the returned value computes the contacts on demand.
    pub fn run(
        &mut self,
        samples: &mut dyn Iterator<Item = Sample>,
        take: &mut dyn FnMut(&Frame),
    ) -> Box<dyn Contacts> {
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
        take: &mut dyn FnMut(&Frame),
    ) -> Box<dyn Contacts>;
    fn copy(&self) -> Box<dyn Steps>;
}

impl<R: Shared, M: Model> Steps for Running<R, M>
where
    HostSolver<R, M>: Send + Sync,
{
    fn step(&mut self, sample: &Sample) -> Frame {
        self.frame(sample)
    }

    fn run(
        &mut self,
        samples: &mut dyn Iterator<Item = Sample>,
        take: &mut dyn FnMut(&Frame),
    ) -> Box<dyn Contacts> {
        self.without_contacts(samples, take)
    }

    fn copy(&self) -> Box<dyn Steps> {
        Box::new(self.clone())
    }
}

struct Boxed;

impl Task for Boxed {
    type Done = Session;

    fn with<R: Shared, M: Model>(self, running: Running<R, M>) -> Session
    where
        HostSolver<R, M>: Send + Sync,
    {
        Session::of(running)
    }
}
