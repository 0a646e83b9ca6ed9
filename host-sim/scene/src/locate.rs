//! From a parameter that the solver refuses to the key of the scene file that gave it.

use stiction_core::{Parameter, SceneError, SiFloat};

use crate::document::Number;
use crate::source::InputError;
use crate::written::{CORNERS, OBSTACLES, WrittenScene};

/// A key, where its value starts in the text, and the value as it was written.
type Place = (String, usize, String);

fn place<T: std::fmt::Debug>(key: impl Into<String>, given: &toml::Spanned<T>) -> Place {
    let value = format!("{:?}", given.get_ref());
    (key.into(), given.span().start, value)
}

impl WrittenScene {
    /// A solver without obstacles takes none.
    ///
    /// # Errors
    /// There are some.
    pub(crate) fn check_half_planes(&self) -> Result<(), InputError> {
        let Some(first) = self.document.obstacle.first() else {
            return Ok(());
        };
        let problem = "there is an `[[obstacle]]`, allowed: `[[surface]]` alone; `run`, `replay`, `check`, `sweep`, `board` and, without a board, `view` take obstacles";
        Err(self.source.error_at(first.span().start, problem))
    }

    /// The error of a solver with room for so many vertices and surfaces, in the words of the file.
    pub(crate) fn explain<F: SiFloat>(
        &self,
        error: &SceneError<F>,
        [vertices, surfaces]: [usize; 2],
    ) -> InputError {
        let allowed = match error.parameter {
            Parameter::VertexCount => format!("1 to {vertices}"),
            Parameter::SurfaceCount => format!("0 to {surfaces}"),
            Parameter::ObstacleCount => format!("0 to {OBSTACLES}"),
            Parameter::CornerCount => format!("at most {CORNERS}"),
            _ => error.allowed.to_owned(),
        };
        if let Parameter::Penetration { surface, vertex } = error.parameter {
            let (key, offset, _) = place("body.start", &self.document.body.start);
            let name = self.surfaces.get(surface).map_or("", |s| s.name.as_str());
            let depth = error.value.widen();
            let problem = format!(
                "`{key}` puts vertex {vertex} {depth:.3e} m inside surface {name:?}, allowed: {allowed}"
            );
            return self.source.error_at(offset, problem);
        }
        if let Parameter::Overlap(obstacle) = error.parameter {
            let (key, offset, _) = place("body.start", &self.document.body.start);
            let name = self.obstacles.get(obstacle).map_or("", |o| o.name.as_str());
            let depth = error.value.widen();
            let problem = format!(
                "`{key}` puts the body {depth:.3e} m inside obstacle {name:?}, allowed: {allowed}"
            );
            return self.source.error_at(offset, problem);
        }
        match self.place(error.parameter) {
            Some((key, offset, _)) if matches!(error.parameter, Parameter::Side { .. }) => {
                let length = error.value.widen();
                let problem =
                    format!("`{key}` begins a side of {length:.3e} m, allowed: {allowed}");
                self.source.error_at(offset, problem)
            }
            Some((key, offset, value)) => {
                let problem = format!("`{key}` is {value}, allowed: {allowed}");
                self.source.error_at(offset, problem)
            }
            None => self.source.error(error),
        }
    }

    /// The key that gave a parameter; `None` where the file holds none.
    fn place(&self, parameter: Parameter) -> Option<Place> {
        let document = &self.document;
        let (body, grasp, spring) = (&document.body, &document.grasp, &document.spring);
        match parameter {
            Parameter::VertexCount => body.vertices.as_ref().map(|list| {
                let count = format!("{} vertices long", list.get_ref().len());
                ("body.vertices".to_owned(), list.span().start, count)
            }),
            Parameter::Vertex(i) => match &body.vertices {
                Some(list) => {
                    (list.get_ref().get(i)).map(|v| place(format!("body.vertices[{i}]"), v))
                }
                None => body.rectangle.as_ref().map(|r| place("body.rectangle", r)),
            },
            Parameter::Start | Parameter::Penetration { .. } | Parameter::Overlap(_) => {
                Some(place("body.start", &body.start))
            }
            Parameter::Weight => body.weight.as_ref().map(|w| place("body.weight", w)),
            Parameter::HoldingPoint => grasp.point.as_ref().map(|p| place("grasp.point", p)),
            Parameter::Reach => grasp.reach.as_ref().map(|r| place("grasp.reach", r)),
            Parameter::StiffnessTranslation => {
                Some(place("spring.translation", &spring.translation))
            }
            Parameter::StiffnessRotation => Some(place("spring.rotation", &spring.rotation)),
            Parameter::SurfaceCount => document.surface.last().map(|last| {
                let count = format!("given {} times", document.surface.len());
                ("surface".to_owned(), last.span().start, count)
            }),
            Parameter::Normal(i) => self.surface_place(i, "normal"),
            Parameter::Offset(i) => self.surface_place(i, "offset"),
            Parameter::FrictionStatic(i) => self.surface_place(i, "static"),
            Parameter::FrictionDynamic(i) => self.surface_place(i, "dynamic"),
            Parameter::Memory(i) => self.surface_place(i, "memory"),
            _ => self.place_of_obstacle(parameter),
        }
    }

    /// A key of surface `i`; friction may stand in the surface itself or in `[friction]`.
    fn surface_place(&self, i: usize, name: &str) -> Option<Place> {
        let surface = self.document.surface.get(i)?.get_ref();
        let key = format!("surface[{i}].{name}");
        let own = match name {
            "normal" => return Some(place(key, &surface.normal)),
            "offset" => return Some(place(key, &surface.offset)),
            "static" => &surface.stick,
            "memory" => &surface.memory,
            _ => &surface.slip,
        };
        self.friction_place(key, own.as_ref(), name)
    }

    /// The key that gave a parameter of an obstacle.
    fn place_of_obstacle(&self, parameter: Parameter) -> Option<Place> {
        let all = &self.document.obstacle;
        let corner = |i: usize, k: usize| {
            let corner = all.get(i)?.get_ref().vertices.get_ref().get(k)?;
            Some(place(format!("obstacle[{i}].vertices[{k}]"), corner))
        };
        let counted = |count: String| {
            let last = all.last()?;
            Some(("obstacle".to_owned(), last.span().start, count))
        };
        let friction = |i: usize, name: &str| {
            let obstacle = all.get(i)?.get_ref();
            let own = match name {
                "static" => &obstacle.stick,
                "memory" => &obstacle.memory,
                _ => &obstacle.slip,
            };
            self.friction_place(format!("obstacle[{i}].{name}"), own.as_ref(), name)
        };
        match parameter {
            Parameter::ObstacleCount => counted(format!("given {} times", all.len())),
            Parameter::CornerCount => {
                let corners = self.obstacles.iter().map(|o| o.vertices.len());
                counted(format!(
                    "given with {} corners in all",
                    corners.sum::<usize>()
                ))
            }
            Parameter::Corners(obstacle) => {
                let list = &all.get(obstacle)?.get_ref().vertices;
                let count = format!("{} corners long", list.get_ref().len());
                let key = format!("obstacle[{obstacle}].vertices");
                Some((key, list.span().start, count))
            }
            Parameter::Corner {
                obstacle,
                corner: k,
            }
            | Parameter::Side { obstacle, side: k } => corner(obstacle, k),
            Parameter::ObstacleFrictionStatic(i) => friction(i, "static"),
            Parameter::ObstacleFrictionDynamic(i) => friction(i, "dynamic"),
            Parameter::ObstacleMemory(i) => friction(i, "memory"),
            _ => None,
        }
    }

    /// A key of friction, which is its own or stands in `[friction]`.
    fn friction_place(&self, key: String, own: Option<&Number>, name: &str) -> Option<Place> {
        let default = &self.document.friction;
        let default = match name {
            "static" => &default.stick,
            "memory" => &default.memory,
            _ => &default.slip,
        };
        let default = default
            .as_ref()
            .map(|given| (format!("friction.{name}"), given));
        let (key, given) = own.map(|given| (key, given)).or(default)?;
        Some(place(key, given))
    }
}
