//! Scenes that clients write: a whole file or the changes to the present scene, read and sent to the solver; and the text of the
//! present scene.

use std::sync::Arc;

use axum::body::Body;
use axum::extract::rejection::QueryRejection;
use axum::extract::{Query, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde_json::json;
use stiction_live::feed::Latest;
use stiction_live::own;
use stiction_live::stage::Stage;
use tokio::sync::mpsc;
use tokio::task::spawn_blocking;

use super::change::Reply;
use super::orders::Order;
use super::server::{Hub, problem};
use super::upload::{Name, Refusal, answered, nameless, received};

/// The largest scene (bytes), the same as for a file.
const LARGEST: usize = 1 << 20;

/// Receives the text of a scene file.
pub(super) async fn scene(
    State(hub): State<Arc<Hub>>,
    name: Result<Query<Name>, QueryRejection>,
    body: Body,
) -> Response {
    let read = |latest: &Latest, name: &str, bytes| {
        let stage = own::parse(name, bytes, latest.number.limit());
        stage.map_err(|error| error.to_string())
    };
    answered(taken(&hub, name, body, read).await)
}

/// Receives the changes to the present scene.
pub(super) async fn edit(
    State(hub): State<Arc<Hub>>,
    name: Result<Query<Name>, QueryRejection>,
    body: Body,
) -> Response {
    let read = |latest: &Latest, name: &str, bytes: Vec<u8>| {
        own::edited(&latest.stage, name, &bytes, latest.number.limit())
    };
    answered(taken(&hub, name, body, read).await)
}

/// Receives a client's data, converts it to a scene by `read`, and shows the scene.
async fn taken(
    hub: &Hub,
    name: Result<Query<Name>, QueryRejection>,
    body: Body,
    read: impl FnOnce(&Latest, &str, Vec<u8>) -> Result<Stage, String> + Send + 'static,
) -> Result<String, Refusal> {
    let refused = |text: String| (StatusCode::BAD_REQUEST, text);
    let gone = || (StatusCode::SERVICE_UNAVAILABLE, "the program ends".into());
    let Query(Name { name }) = name.map_err(|_| nameless())?;
    let (place, bytes) = received(&hub.scene_places, body, LARGEST).await?;
    let latest = hub.feed.read().latest.clone().ok_or_else(gone)?;
    let stage = spawn_blocking(move || {
        // If the client has gone meanwhile, the place remains taken until the scene is read.
        let _place = place;
        read(&latest, &name, bytes)
    });
    let stage = stage
        .await
        .map_err(|_| refused("it cannot be read".into()))?;
    let stage = stage.map_err(refused)?;
    let answer = json!({"scene": stage.scene.title}).to_string();
    let (reply, mut result) = mpsc::channel(1);
    let order = Order::Scene(Box::new(stage), Reply::Direct(reply));
    hub.orders.send(order).await.map_err(|_| gone())?;
    let result = result.recv().await.ok_or_else(gone)?;
    result.map_err(refused)?;
    Ok(answer)
}

/// The present scene, as a file that can be run.
pub(super) async fn text(State(hub): State<Arc<Hub>>) -> Response {
    let latest = hub.feed.read().latest.clone();
    let Some(latest) = latest else {
        return problem(StatusCode::NOT_FOUND, "there is no scene yet");
    };
    let text = own::text(&latest.stage, &latest.scene);
    ([(header::CONTENT_TYPE, "application/toml")], text).into_response()
}
