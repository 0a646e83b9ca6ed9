//! The models of the solver on a computer: half-planes alone, or obstacles with corners, too. From a written scene to a scene in
//! either model, and from a state to the touching features.

use stiction_core::{
    Description, Full, Model, Parts, Real, Scene, SceneError, SiFloat, State, Touches,
    WithObstacles,
};

use crate::clip::Indices;
use crate::scene_file::{HostScene, HostSolver};
use crate::source::InputError;
use crate::written::{CORNERS, OBSTACLES, SURFACES, VERTICES, WrittenScene};

/// A model with obstacles, with the capacities of the host.
pub type Among<M = Full> = WithObstacles<OBSTACLES, CORNERS, M>;

/// A scene for a solver, and the meaning of its obstacle indices if they differ from those of the file.
type Built<R, M> = (HostScene<R, M>, Option<Indices>);

/// What differs between scenes with obstacles and scenes without.
pub trait HostModel: Model {
    /// The scene for a solver, and the meaning of its obstacle indices if they differ from those of the file.
    ///
    /// # Errors
    /// The numbers do not make a scene, or the model lacks a part that it needs.
    fn scene<R: Real<Si: SiFloat>>(written: &WrittenScene) -> Result<Built<R, Self>, InputError>;

    /// The scene of a description, which may differ from the written one in all but obstacles, and the meaning of its indices.
    ///
    /// # Errors
    /// The numbers do not make a scene.
    fn build<R: Real<Si: SiFloat>>(
        written: &WrittenScene,
        description: &Description<'_, R::Si>,
    ) -> Result<Built<R, Self>, SceneError<R::Si>>;

    /// The touching features and their directions; `None` without obstacles, since the contacts then contain everything.
    fn touches<R: Real>(solver: &HostSolver<R, Self>, state: &State<R>) -> Option<Touches<R::Si>>;
}

impl<const FRICTION: bool, const WEIGHT: bool> HostModel for Parts<FRICTION, WEIGHT> {
    fn scene<R: Real<Si: SiFloat>>(written: &WrittenScene) -> Result<Built<R, Self>, InputError> {
        Ok((written.scene_in()?, None))
    }

    fn build<R: Real<Si: SiFloat>>(
        _: &WrittenScene,
        description: &Description<'_, R::Si>,
    ) -> Result<Built<R, Self>, SceneError<R::Si>> {
        Ok((Scene::new(description)?, None))
    }

    fn touches<R: Real>(_: &HostSolver<R, Self>, _: &State<R>) -> Option<Touches<R::Si>> {
        None
    }
}

impl<M: Model> HostModel for Among<M> {
    fn scene<R: Real<Si: SiFloat>>(written: &WrittenScene) -> Result<Built<R, Self>, InputError> {
        let built = written.described(|description| Self::build(written, description));
        built.map_err(|error| written.explain(&error, [VERTICES, SURFACES]))
    }

    fn build<R: Real<Si: SiFloat>>(
        written: &WrittenScene,
        description: &Description<'_, R::Si>,
    ) -> Result<Built<R, Self>, SceneError<R::Si>> {
        let (scene, indices) =
            written.obstacles_in::<R, _>(|obstacles| Scene::among(description, obstacles));
        match scene {
            Ok(scene) => Ok((scene, indices)),
            Err(error) => Err(indices.as_ref().map_or(error, |known| known.error(error))),
        }
    }

    fn touches<R: Real>(solver: &HostSolver<R, Self>, state: &State<R>) -> Option<Touches<R::Si>> {
        Some(solver.touches(state))
    }
}
