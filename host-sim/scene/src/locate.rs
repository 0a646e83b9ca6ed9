//! From a parameter that the solver refuses to the key of the scene file that set it.

use stiction_core::{Parameter, SceneError, SiFloat};

use crate::clip::Indices;
use crate::document::{Document, Number};
use crate::outline::{self, Fault};
use crate::source::{InputError, Source};
use crate::written::{CORNERS, OBSTACLES, SURFACES, VERTICES, WrittenScene};

/// A key, the position of its value in the text, and the value as it was written.
type Place = (String, usize, String);

fn place<T: std::fmt::Debug>(key: impl Into<String>, given: &toml::Spanned<T>) -> Place {
    let value = format!("{:?}", given.get_ref());
    (key.into(), given.span().start, value)
}

/// The allowed number of items.
fn allowed_count(parameter: Parameter) -> Option<String> {
    match parameter {
        Parameter::VertexCount => Some(format!("1 to {VERTICES}")),
        Parameter::SurfaceCount => Some(format!("0 to {SURFACES}")),
        Parameter::ObstacleCount => Some(format!("0 to {OBSTACLES}")),
        Parameter::CornerCount => Some(format!("at most {CORNERS}")),
        _ => None,
    }
}

impl Document {
    /// Checks that nothing exceeds the capacity of the solver, wherever the scene runs: before the items themselves are processed.
    pub(crate) fn check_counts(&self, source: &Source) -> Result<(), InputError> {
        let vertices = self.body.vertices.as_ref();
        for (parameter, count, most) in [
            (
                Parameter::VertexCount,
                vertices.map_or(0, |list| list.get_ref().len()),
                VERTICES,
            ),
            (Parameter::SurfaceCount, self.surface.len(), SURFACES),
            (Parameter::ObstacleCount, self.obstacle.len(), OBSTACLES),
            (Parameter::CornerCount, self.corner_count(), CORNERS),
        ] {
            let place = self.place_of_count(parameter).filter(|_| count > most);
            let allowed = allowed_count(parameter);
            if let (Some((key, offset, value)), Some(allowed)) = (place, allowed) {
                let problem = format!("`{key}` is {value}, allowed: {allowed}");
                return Err(source.error_at(offset, problem));
            }
        }
        Ok(())
    }

    fn corner_count(&self) -> usize {
        let lists = self.obstacle.iter().map(|given| &given.get_ref().vertices);
        lists.map(|list| list.get_ref().len()).sum()
    }

    /// The key that sets a number of items; of several sections, the last one.
    fn place_of_count(&self, parameter: Parameter) -> Option<Place> {
        let section = |key: &str, start: usize, count| (key.to_owned(), start, count);
        match parameter {
            Parameter::VertexCount => self.body.vertices.as_ref().map(|list| {
                let count = format!("{} vertices long", list.get_ref().len());
                section("body.vertices", list.span().start, count)
            }),
            Parameter::SurfaceCount => self.surface.last().map(|last| {
                let count = format!("given {} times", self.surface.len());
                section("surface", last.span().start, count)
            }),
            Parameter::ObstacleCount => self.obstacle.last().map(|last| {
                let count = format!("given {} times", self.obstacle.len());
                section("obstacle", last.span().start, count)
            }),
            Parameter::CornerCount => self.obstacle.last().map(|last| {
                let count = format!("given with {} corners in all", self.corner_count());
                section("obstacle", last.span().start, count)
            }),
            _ => None,
        }
    }
}

impl WrittenScene {
    /// Checks that there are no obstacles, for a board.
    ///
    /// # Errors
    /// The first one.
    pub fn check_half_planes(&self) -> Result<(), InputError> {
        let Some(first) = self.document.obstacle.first() else {
            return Ok(());
        };
        let problem = "there is an `[[obstacle]]`, allowed: `[[surface]]` alone; `run`, `replay`, `check`, `sweep`, `board` and, without a board, `view` take obstacles";
        Err(self.source.error_at(first.span().start, problem))
    }

    /// The error of a solver in the terms of the file. `indices`: the meaning of its obstacle indices if they differ from those of the file.
    pub(crate) fn explain<F: SiFloat>(
        &self,
        error: &SceneError<F>,
        indices: Option<&Indices>,
    ) -> InputError {
        let error = indices.map_or(*error, |indices| indices.error(*error));
        let allowed = allowed_count(error.parameter);
        let allowed = allowed.unwrap_or_else(|| error.allowed.to_owned());
        let within = match error.parameter {
            Parameter::Penetration { surface, vertex } => {
                let name = self.surfaces.get(surface).map_or("", |s| s.name.as_str());
                Some((format!("vertex {vertex}"), "surface", name))
            }
            Parameter::Overlap(obstacle) => {
                let name = self.obstacles.get(obstacle).map_or("", |o| o.name.as_str());
                Some(("the body".to_owned(), "obstacle", name))
            }
            _ => None,
        };
        if let Some((what, kind, name)) = within {
            let (key, offset, _) = place("body.start", &self.document.body.start);
            let depth = error.value.widen();
            let problem = format!(
                "`{key}` puts {what} {depth:.3e} m inside {kind} {name:?}, allowed: {allowed}"
            );
            return self.source.error_at(offset, problem);
        }
        if let Some((key, offset, fault)) = self.fault(error.parameter) {
            let mend = match error.parameter {
                Parameter::Vertex(_) => ", or set `body.repair = true`",
                _ => "",
            };
            return self.source.error_at(offset, fault.message(&key) + mend);
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

    /// The fault of the outline that has a refused corner: the key and the position of the list.
    fn fault(&self, parameter: Parameter) -> Option<(String, usize, Fault)> {
        let (key, list, corners) = match parameter {
            Parameter::Vertex(_) => {
                let list = self.document.body.vertices.as_ref()?;
                ("body.vertices".to_owned(), list, &self.vertices)
            }
            Parameter::Corner { obstacle, .. } => {
                let list = &self.document.obstacle.get(obstacle)?.get_ref().vertices;
                let key = format!("obstacle[{obstacle}].vertices");
                (key, list, &self.obstacles.get(obstacle)?.vertices)
            }
            _ => return None,
        };
        let fault = outline::fault(corners)?;
        let corner = fault.corner().and_then(|k| list.get_ref().get(k));
        let offset = corner.map_or(list.span(), toml::Spanned::span).start;
        Some((key, offset, fault))
    }

    /// The key that set a parameter; `None` if the file does not contain it.
    fn place(&self, parameter: Parameter) -> Option<Place> {
        let document = &self.document;
        let (body, grasp, spring) = (&document.body, &document.grasp, &document.spring);
        match parameter {
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
            Parameter::Normal(i) => self.surface_place(i, "normal"),
            Parameter::Offset(i) => self.surface_place(i, "offset"),
            Parameter::FrictionStatic(i) => self.surface_place(i, "static"),
            Parameter::FrictionDynamic(i) => self.surface_place(i, "dynamic"),
            Parameter::Memory(i) => self.surface_place(i, "memory"),
            _ => self.place_of_obstacle(parameter),
        }
    }

    /// A key of surface `i`; friction may be in the surface itself or in `[friction]`.
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

    /// The key that set a parameter of an obstacle.
    fn place_of_obstacle(&self, parameter: Parameter) -> Option<Place> {
        let all = &self.document.obstacle;
        let corner = |i: usize, k: usize| {
            let corner = all.get(i)?.get_ref().vertices.get_ref().get(k)?;
            Some(place(format!("obstacle[{i}].vertices[{k}]"), corner))
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
            _ => self.document.place_of_count(parameter),
        }
    }

    /// A key of friction, either the item's own or in `[friction]`.
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
