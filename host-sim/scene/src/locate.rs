//! From a parameter that the solver refuses to the key of the scene file that gave it.

use stiction_core::{Parameter, SceneError, SiFloat};

use crate::source::InputError;
use crate::written::WrittenScene;

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
        let problem = "there is an `[[obstacle]]`, allowed: `[[surface]]` alone; `run`, `replay`, `check` and `sweep` take obstacles";
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
        match self.place(error.parameter) {
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
            Parameter::Start | Parameter::Penetration { .. } => {
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
        }
    }

    /// A key of surface `i`; friction may stand in the surface itself or in `[friction]`.
    fn surface_place(&self, i: usize, name: &str) -> Option<Place> {
        let surface = self.document.surface.get(i)?.get_ref();
        let default = &self.document.friction;
        let key = format!("surface[{i}].{name}");
        let (own, default) = match name {
            "normal" => return Some(place(key, &surface.normal)),
            "offset" => return Some(place(key, &surface.offset)),
            "static" => (&surface.stick, &default.stick),
            "memory" => (&surface.memory, &default.memory),
            _ => (&surface.slip, &default.slip),
        };
        let default = default
            .as_ref()
            .map(|given| (format!("friction.{name}"), given));
        let (key, given) = own.as_ref().map(|given| (key, given)).or(default)?;
        Some(place(key, given))
    }
}
