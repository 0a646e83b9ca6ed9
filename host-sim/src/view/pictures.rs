//! Pictures of the available scenes: from the name of a scene to an SVG. They are drawn on request.

use std::path::Path as FilePath;
use std::sync::Arc;

use axum::extract::{Path, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use stiction_live::thumbnail::thumbnail;
use stiction_scene::Source;
use tokio::task::spawn_blocking;

use super::server::{Hub, problem};
use stiction_live::scenes;

/// Returns the scene of a name: the present one, one of the clients', or a bundled one.
fn source(hub: &Hub, name: &str) -> Option<Source> {
    let latest = hub.feed.read().latest.clone();
    let own = latest.and_then(|latest| {
        let mut known = std::iter::once(&latest.stage).chain(latest.own.iter());
        let named = known.find(|stage| stage.scene.title == name);
        named.map(|stage| stage.scene.source().clone())
    });
    own.or_else(|| scenes::find(FilePath::new(name)))
}

/// `NAME.svg`.
pub(super) async fn picture(State(hub): State<Arc<Hub>>, Path(file): Path<String>) -> Response {
    let name = file.strip_suffix(".svg");
    let Some(source) = name.and_then(|name| source(&hub, name)) else {
        return problem(StatusCode::NOT_FOUND, "there is no such scene");
    };
    match spawn_blocking(move || thumbnail(&source)).await {
        Ok(Ok(svg)) => ([(header::CONTENT_TYPE, "image/svg+xml")], svg).into_response(),
        Ok(Err(error)) => problem(StatusCode::INTERNAL_SERVER_ERROR, &error.to_string()),
        Err(_) => problem(StatusCode::INTERNAL_SERVER_ERROR, "it could not be drawn"),
    }
}
