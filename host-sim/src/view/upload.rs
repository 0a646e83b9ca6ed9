//! Receives a path from a client piece by piece, with a time limit for each and few paths in parallel, reads it, and sends it to
//! the solver.

use std::path::Path as FilePath;
use std::sync::Arc;
use std::time::Duration;

use axum::body::Body;
use axum::extract::rejection::QueryRejection;
use axum::extract::{Query, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use futures_util::StreamExt;
use serde::Deserialize;
use serde_json::json;
use stiction_scene::{HandPath, InputError, SceneFile, Source, doubts};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::task::spawn_blocking;
use tokio::time::timeout;

use super::connections::PIECE;
use super::orders::Order;
use super::server::{Hub, problem};
use stiction_live::feed::Latest;
use stiction_live::replay::Way;

/// The largest path (bytes).
const LARGEST: usize = 16 << 20;
/// Number of paths that are received and read in parallel; others wait. One has up to 16 MiB of text, and six times that as
/// records.
const AT_ONCE: usize = 2;
/// Time limit for a whole path: the largest one at 2.3 Mbit/s.
const WHOLE: Duration = Duration::from_secs(60);
/// The longest name of a path, in characters.
const NAME: usize = 100;

/// The answer to a client whose path is refused.
pub(super) type Refusal = (StatusCode, String);

/// The places for paths that are received and read.
pub(super) fn places() -> Arc<Semaphore> {
    Arc::new(Semaphore::new(AT_ONCE))
}

#[derive(Deserialize)]
pub(super) struct Name {
    pub(super) name: String,
}

pub(super) async fn upload(
    State(hub): State<Arc<Hub>>,
    name: Result<Query<Name>, QueryRejection>,
    body: Body,
) -> Response {
    answered(match name {
        Ok(Query(Name { name })) => taken(&hub, &name, body).await,
        Err(_) => Err(nameless()),
    })
}

/// The response to an uploaded file.
pub(super) fn answered(result: Result<String, Refusal>) -> Response {
    match result {
        Ok(answer) => ([(header::CONTENT_TYPE, "application/json")], answer).into_response(),
        Err((status, text)) => problem(status, &text),
    }
}

/// A file without a name.
pub(super) fn nameless() -> Refusal {
    let text = "`name` is missing, allowed: the name of the file";
    (StatusCode::BAD_REQUEST, text.to_owned())
}

async fn taken(hub: &Hub, name: &str, body: Body) -> Result<String, Refusal> {
    let busy = |text: &str| (StatusCode::SERVICE_UNAVAILABLE, text.to_owned());
    let refused = |text: String| (StatusCode::BAD_REQUEST, text);
    let (place, bytes) = received(&hub.uploads, body, LARGEST).await?;
    // The name of a file, without its folders.
    let name = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let name: String = name.chars().take(NAME).collect();
    let latest = |latest: &Latest| Arc::clone(&latest.scene);
    let scene = hub.feed.read().latest.as_ref().map(latest);
    let scene = scene.ok_or_else(|| busy("there is no scene yet"))?;
    let called = name.clone();
    let read = spawn_blocking(move || {
        // If the client has gone meanwhile, the place remains taken until its path is read.
        let _place = place;
        let source = Source::of_bytes(FilePath::new(&called), bytes)?;
        let path = HandPath::parse(&source, &scene.hand.placement)?;
        checked(path, &source, &scene)
    });
    let read = read
        .await
        .map_err(|_| refused("it cannot be read".into()))?;
    let (path, answer) = read.map_err(|error: InputError| refused(error.to_string()))?;
    hub.retained.keep(Arc::clone(&path) as _);
    match hub.orders.send(Order::Upload(name, path)).await {
        Ok(()) => Ok(answer),
        Err(_) => Err(busy("the program ends")),
    }
}

/// Receives a body of at most `largest` bytes, and the place that it holds until it is read.
pub(super) async fn received(
    places: &Arc<Semaphore>,
    body: Body,
    largest: usize,
) -> Result<(OwnedSemaphorePermit, Vec<u8>), Refusal> {
    let free = timeout(PIECE, Arc::clone(places).acquire_owned());
    let Ok(Ok(place)) = free.await else {
        let text = "others are being taken, allowed: to send it again";
        return Err((StatusCode::SERVICE_UNAVAILABLE, text.to_owned()));
    };
    let whole = timeout(WHOLE, gathered(body, largest));
    let bytes = whole.await.unwrap_or_else(|_| Err(late()))?;
    Ok((place, bytes))
}

async fn gathered(body: Body, largest: usize) -> Result<Vec<u8>, Refusal> {
    let (mut bytes, mut pieces) = (Vec::new(), body.into_data_stream());
    loop {
        let piece = timeout(PIECE, pieces.next());
        match piece.await.map_err(|_| late())? {
            None => return Ok(bytes),
            Some(Err(error)) => return Err((StatusCode::BAD_REQUEST, error.to_string())),
            Some(Ok(piece)) if bytes.len() + piece.len() > largest => {
                let text = format!("it is longer than {largest} bytes, allowed: at most so many");
                return Err((StatusCode::PAYLOAD_TOO_LARGE, text));
            }
            Some(Ok(piece)) => bytes.extend_from_slice(&piece),
        }
    }
}

fn late() -> Refusal {
    let text = format!(
        "it did not come whole, allowed: pieces within {PIECE:?} of each other, all within {WHOLE:?}"
    );
    (StatusCode::REQUEST_TIMEOUT, text)
}

/// Checks that a path is not too long, and creates the answer to it.
fn checked(
    path: HandPath,
    source: &Source,
    scene: &SceneFile,
) -> Result<(Arc<HandPath>, String), InputError> {
    let notes: Vec<String> = path
        .notes()
        .iter()
        .cloned()
        .chain(doubts(scene, &path))
        .collect();
    let (records, path) = (path.count(), Arc::new(path));
    let way = Way::Path(Arc::clone(&path));
    way.check()
        .map_err(|problem| HandPath::error_at_end_of(source, &problem))?;
    let answer = json!({"seconds": way.seconds(), "records": records, "notes": notes});
    Ok((path, answer.to_string()))
}
