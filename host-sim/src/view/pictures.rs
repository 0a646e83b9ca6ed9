//! Pictures of the scenes that can be shown: from the name of a scene to an SVG. They are drawn as they are asked for.

use std::path::Path as FilePath;
use std::sync::Arc;

use axum::extract::{Path, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use stiction_live::stage::Stage;
use stiction_live::thumbnail::thumbnail;
use stiction_scene::Source;
use tokio::task::spawn_blocking;

use super::server::{Hub, problem};
use crate::scenes;

/// What there are pictures of, besides the bundled scenes.
#[derive(Clone, Debug)]
pub(super) struct Pictures {
    own: Option<(String, Source)>,
}

impl Pictures {
    /// With a scene file of its own.
    pub(super) fn new(own: Option<&Stage>) -> Self {
        let named = |own: &Stage| (own.scene.title.clone(), own.scene.source().clone());
        Self {
            own: own.map(named),
        }
    }

    fn source(&self, name: &str) -> Option<Source> {
        let own = self.own.as_ref().filter(|(title, _)| title == name);
        let own = own.map(|(_, source)| source.clone());
        own.or_else(|| scenes::find(FilePath::new(name)))
    }
}

/// `NAME.svg`.
pub(super) async fn picture(State(hub): State<Arc<Hub>>, Path(file): Path<String>) -> Response {
    let source = file
        .strip_suffix(".svg")
        .and_then(|name| hub.pictures.source(name));
    let Some(source) = source else {
        return problem(StatusCode::NOT_FOUND, "there is no such scene");
    };
    match spawn_blocking(move || thumbnail(&source)).await {
        Ok(Ok(svg)) => ([(header::CONTENT_TYPE, "image/svg+xml")], svg).into_response(),
        Ok(Err(error)) => problem(StatusCode::INTERNAL_SERVER_ERROR, &error.to_string()),
        Err(_) => problem(StatusCode::INTERNAL_SERVER_ERROR, "it could not be drawn"),
    }
}
