//! The server: the page, the socket, recordings and uploads. Only the page itself, and programs that are no browser, may ask.

use std::net::IpAddr;
use std::path::Path as FilePath;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use axum::Router;
use axum::body::{Body, Bytes};
use axum::extract::rejection::{BytesRejection, QueryRejection};
use axum::extract::{DefaultBodyLimit, Path, Query, Request, State, WebSocketUpgrade};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::middleware::{self, Next};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use serde::Deserialize;
use serde_json::json;
use stiction_scene::{HandPath, InputError, Source};
use tokio::sync::{mpsc, watch};
use tokio::task::spawn_blocking;
use tokio_util::io::ReaderStream;

use super::feed::Feed;
use super::orders::Order;
use super::recording::Recording;
use super::replay::Way;
use super::{client, page};
use crate::board::Identity;

/// The largest path that is uploaded (bytes).
const LARGEST: usize = 16 << 20;
/// A message that is longer than this ends the connection; one that is longer than is read is answered.
const LONGEST_WIRE: usize = 64 << 10;
/// The longest name of a path, in characters.
const NAME: usize = 100;

/// What every client needs.
pub(super) struct Hub {
    pub(super) feed: Arc<Feed>,
    pub(super) orders: mpsc::Sender<Order>,
    pub(super) scenes: Vec<String>,
    /// The board that has the solver.
    pub(super) board: Option<Identity>,
    /// True when the server ends.
    pub(super) stop: watch::Receiver<bool>,
    pub(super) clients: AtomicU32,
}

impl Hub {
    /// The number of the next client.
    pub(super) fn number(&self) -> u32 {
        self.clients.fetch_add(1, Ordering::Relaxed) + 1
    }
}

/// All there is to ask for; without the page where it is not wanted.
pub(super) fn router(hub: Arc<Hub>, with_page: bool) -> Router {
    let router = Router::new()
        .route("/ws", get(socket))
        .route("/recording/{file}", get(recording))
        .route("/upload", post(upload))
        .layer(DefaultBodyLimit::max(LARGEST));
    let router = match with_page {
        true => router.fallback(file),
        false => router,
    };
    router.layer(middleware::from_fn(guard)).with_state(hub)
}

/// Refuses what another page asks for, and adds what a browser has to know.
async fn guard(request: Request, next: Next) -> Response {
    let mut response = match is_own(request.headers()) {
        true => next.run(request).await,
        false => (
            StatusCode::FORBIDDEN,
            "another page asks, allowed: this one\n",
        )
            .into_response(),
    };
    let headers = response.headers_mut();
    for (name, value) in [
        (
            header::CONTENT_SECURITY_POLICY,
            "default-src 'self'; connect-src 'self' ws:",
        ),
        (header::CACHE_CONTROL, "no-store"),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (HeaderName::from_static("referrer-policy"), "no-referrer"),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}

/// The host is asked for by an address or as localhost, which no foreign name can be made to mean, and a page that asks is
/// of this host.
fn is_own(headers: &HeaderMap) -> bool {
    let text = |name| headers.get(name).map(HeaderValue::to_str);
    let Some(Ok(host)) = text(header::HOST) else {
        return false;
    };
    let name = match host.strip_prefix('[') {
        Some(rest) => rest.split(']').next().unwrap_or(rest),
        None => host.split(':').next().unwrap_or(host),
    };
    let is_here = name.eq_ignore_ascii_case("localhost") || name.parse::<IpAddr>().is_ok();
    let of_page = match text(header::ORIGIN) {
        None => true,
        Some(Ok(origin)) => origin.strip_prefix("http://") == Some(host),
        Some(Err(_)) => false,
    };
    // What another page has its browser fetch has no origin; but a link to this page may stand anywhere.
    let is_fetched = !matches!(text(FETCH_MODE), Some(Ok("navigate")))
        && matches!(text(FETCH_SITE), Some(Ok("cross-site" | "same-site")));
    is_here && of_page && !is_fetched
}

const FETCH_MODE: HeaderName = HeaderName::from_static("sec-fetch-mode");
const FETCH_SITE: HeaderName = HeaderName::from_static("sec-fetch-site");

async fn socket(State(hub): State<Arc<Hub>>, upgrade: WebSocketUpgrade) -> Response {
    upgrade
        .max_message_size(LONGEST_WIRE)
        .max_frame_size(LONGEST_WIRE)
        .on_upgrade(move |socket| client::serve(socket, hub))
}

async fn file(request: Request) -> Response {
    match page::find(request.uri().path()) {
        Some((kind, bytes)) => ([(header::CONTENT_TYPE, kind)], bytes).into_response(),
        None => (StatusCode::NOT_FOUND, "not here\n").into_response(),
    }
}

async fn recording(State(hub): State<Arc<Hub>>, Path(file): Path<String>) -> Response {
    let kind = match file.as_str() {
        "trace.jsonl" => "application/x-ndjson",
        "scene.toml" => "application/toml",
        "hand.csv" => "text/csv",
        _ => return problem(StatusCode::NOT_FOUND, "not here"),
    };
    let recorded = hub.feed.read().recorded.clone();
    let Some(recorded) = recorded else {
        return problem(StatusCode::NOT_FOUND, "there is no recording");
    };
    let name = file.clone();
    let body = spawn_blocking(move || content(&recorded, &name)).await;
    let named = format!("attachment; filename=\"{file}\"");
    match body {
        Ok(Ok((body, length))) => (
            [
                (header::CONTENT_TYPE, kind),
                (header::CONTENT_DISPOSITION, named.as_str()),
                (header::CONTENT_LENGTH, &length.to_string()),
            ],
            body,
        )
            .into_response(),
        Ok(Err(error)) => problem(StatusCode::INTERNAL_SERVER_ERROR, &error),
        Err(_) => problem(
            StatusCode::INTERNAL_SERVER_ERROR,
            "it could not be computed",
        ),
    }
}

/// A file of a recording, and its bytes.
fn content(recorded: &Recording, file: &str) -> Result<(Body, u64), String> {
    let text = match file {
        "trace.jsonl" => {
            // The trace of ten minutes is hundreds of megabytes: it is read as it is sent.
            let trace = recorded.trace()?;
            let length = trace.metadata().map_err(|error| error.to_string())?.len();
            let bytes = ReaderStream::new(tokio::fs::File::from_std(trace));
            return Ok((Body::from_stream(bytes), length));
        }
        "scene.toml" => recorded.scene.clone(),
        _ => recorded.hand_csv(),
    };
    let length = text.len() as u64;
    Ok((text.into(), length))
}

#[derive(Deserialize)]
struct Name {
    name: String,
}

async fn upload(
    State(hub): State<Arc<Hub>>,
    name: Result<Query<Name>, QueryRejection>,
    body: Result<Bytes, BytesRejection>,
) -> Response {
    let bytes = match body {
        Ok(bytes) => bytes,
        Err(rejection) => return problem(rejection.status(), &rejection.body_text()),
    };
    let Ok(Query(Name { name })) = name else {
        return problem(
            StatusCode::BAD_REQUEST,
            "`name` is missing, allowed: the name of the file",
        );
    };
    // The name of a file, whatever stands before it.
    let name = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let name: String = name.chars().take(NAME).collect();
    let scene = hub
        .feed
        .read()
        .latest
        .as_ref()
        .map(|latest| Arc::clone(&latest.scene));
    let Some(scene) = scene else {
        return problem(StatusCode::SERVICE_UNAVAILABLE, "there is no scene yet");
    };
    let called = name.clone();
    let read = spawn_blocking(move || {
        let source = Source::of_bytes(FilePath::new(&called), bytes.into())?;
        let path = HandPath::parse(&source, &scene.hand.placement)?;
        checked(path, &source)
    });
    let (path, answer) = match read.await {
        Ok(Ok(read)) => read,
        Ok(Err(error)) => return problem(StatusCode::BAD_REQUEST, &error.to_string()),
        Err(_) => return problem(StatusCode::BAD_REQUEST, "it cannot be read"),
    };
    match hub.orders.send(Order::Upload(name, path)).await {
        Ok(()) => ([(header::CONTENT_TYPE, "application/json")], answer).into_response(),
        Err(_) => problem(StatusCode::SERVICE_UNAVAILABLE, "the program ends"),
    }
}

/// A path that is not too long, with the answer to it.
fn checked(path: HandPath, source: &Source) -> Result<(Arc<HandPath>, String), InputError> {
    let (records, path) = (path.count(), Arc::new(path));
    let way = Way::Path(Arc::clone(&path));
    way.check()
        .map_err(|problem| HandPath::error_at_end_of(source, &problem))?;
    let answer = json!({"seconds": way.seconds(), "records": records});
    Ok((path, answer.to_string()))
}

fn problem(status: StatusCode, text: &str) -> Response {
    let body = json!({"message": text}).to_string();
    let kind = [(header::CONTENT_TYPE, "application/json")];
    (status, kind, body).into_response()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn own(host: &'static str, origin: Option<&'static str>) -> bool {
        let mut headers = HeaderMap::new();
        headers.insert(header::HOST, HeaderValue::from_static(host));
        if let Some(origin) = origin {
            headers.insert(header::ORIGIN, HeaderValue::from_static(origin));
        }
        is_own(&headers)
    }

    #[test]
    fn the_own_page_and_programs_may_ask() {
        assert!(own("127.0.0.1:8405", None));
        assert!(own("127.0.0.1:8405", Some("http://127.0.0.1:8405")));
        assert!(own("localhost:8405", Some("http://localhost:8405")));
        assert!(own("[::1]:8405", Some("http://[::1]:8405")));
    }

    #[test]
    fn other_pages_and_foreign_names_of_this_host_may_not() {
        assert!(!own("127.0.0.1:8405", Some("http://127.0.0.1:80")));
        assert!(!own("127.0.0.1:8405", Some("http://example.org")));
        assert!(!own("127.0.0.1:8405", Some("https://127.0.0.1:8405")));
        assert!(!own("127.0.0.1:8405", Some("null")));
        let fetched = |site, mode| {
            let mut headers = HeaderMap::new();
            headers.insert(header::HOST, HeaderValue::from_static("127.0.0.1:8405"));
            headers.insert(FETCH_SITE, HeaderValue::from_static(site));
            headers.insert(FETCH_MODE, HeaderValue::from_static(mode));
            is_own(&headers)
        };
        // A picture or a script of another page, and a link in it.
        assert!(!fetched("cross-site", "no-cors") && !fetched("same-site", "no-cors"));
        assert!(fetched("cross-site", "navigate") && fetched("same-origin", "cors"));
        // A name that was made to mean this computer.
        assert!(!own("example.org:8405", Some("http://example.org:8405")));
        assert!(!own("example.org", None));
    }
}
