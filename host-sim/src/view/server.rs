//! The server: the page, the socket, recordings and uploads. Only the page itself, and programs other than browsers, may send
//! requests.

use std::io;
use std::net::{Ipv4Addr, Ipv6Addr};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use axum::Router;
use axum::body::Body;
use axum::extract::{Extension, Path, Request, State, WebSocketUpgrade};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::middleware::{self, Next};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use futures_util::stream::try_unfold;
use serde_json::json;
use tokio::io::AsyncReadExt;
use tokio::sync::{Semaphore, mpsc, watch};
use tokio::task::spawn_blocking;

use super::connections::Seat;
use super::feed::SharedFeed;
use super::orders::Order;
use super::pictures::picture;
use super::recording::LiveRecording;
use super::retained::Retained;
use super::upload::upload;
use super::{client, page, written};
use crate::board::Identity;
use stiction_live::scenes::Offer;

/// A message longer than this ends the connection; a shorter one that exceeds the readable length is answered.
const LONGEST_WIRE: usize = 64 << 10;
/// Maximum size of a reading from a client (bytes).
const AT_ONCE: usize = 4 << 10;
/// A file is sent in pieces of this size (bytes).
const PIECE: usize = 64 << 10;

pub(super) struct Hub {
    pub(super) feed: Arc<SharedFeed>,
    pub(super) orders: mpsc::Sender<Order>,
    pub(super) scenes: Vec<Offer>,
    /// The board that has the solver.
    pub(super) board: Option<Identity>,
    /// True when the server ends.
    pub(super) stop: watch::Receiver<bool>,
    pub(super) clients: AtomicU32,
    /// Places for uploaded paths, and for scenes.
    pub(super) uploads: Arc<Semaphore>,
    pub(super) scene_places: Arc<Semaphore>,
    /// Uploaded paths, and recordings.
    pub(super) retained: Retained,
}

impl Hub {
    /// The number of the next client.
    pub(super) fn number(&self) -> u32 {
        self.clients.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// Drops data that nobody needs any more.
    pub(super) fn tidy(&self) {
        let recorded = self.feed.read().recorded.clone();
        if let Some(recorded) = recorded {
            self.retained.keep(recorded);
        }
        self.retained.tidy();
    }
}

/// All resources; without the page if it is not wanted.
pub(super) fn router(hub: Arc<Hub>, with_page: bool) -> Router {
    let router = Router::new()
        .route("/ws", get(socket))
        .route("/recording/{file}", get(recording))
        .route("/scenes/{file}", get(picture))
        .route("/upload", post(upload))
        .route("/scene", post(written::scene))
        .route("/edit", post(written::edit))
        .route("/scene.toml", get(written::text));
    let router = match with_page {
        true => router.fallback(file),
        false => router,
    };
    router.layer(middleware::from_fn(guard)).with_state(hub)
}

/// Refuses requests of other pages, and adds the headers that a browser needs.
async fn guard(request: Request, next: Next) -> Response {
    let place = own_place(request.headers());
    let policy = policy(place);
    let mut response = match place {
        Some(_) => next.run(request).await,
        None => (
            StatusCode::FORBIDDEN,
            "another page asks, allowed: this one\n",
        )
            .into_response(),
    };
    let headers = response.headers_mut();
    for (name, value) in [
        (header::CACHE_CONTROL, "no-store"),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::X_FRAME_OPTIONS, "DENY"),
        (header::REFERRER_POLICY, "no-referrer"),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
    headers.insert(header::CONTENT_SECURITY_POLICY, policy);
    response
}

/// The policy for a page from here: it may use resources of this host and port, and may not be in a frame of another page.
fn policy(place: Option<&str>) -> HeaderValue {
    let socket = place.map_or_else(String::new, |place| format!(" ws://{place}"));
    let text = format!("default-src 'self'; connect-src 'self'{socket}; frame-ancestors 'none'");
    // The host is an IP address or localhost.
    HeaderValue::from_str(&text).unwrap_or(HeaderValue::from_static(
        "default-src 'none'; frame-ancestors 'none'",
    ))
}

/// Returns the host and port of the request if it uses an IP address or localhost, which no foreign name can be made to resolve
/// to, and if the requesting page is of this host.
fn own_place(headers: &HeaderMap) -> Option<&str> {
    let text = |name| headers.get(name).map(HeaderValue::to_str);
    let Some(Ok(host)) = text(header::HOST) else {
        return None;
    };
    let of_page = match text(header::ORIGIN) {
        None => true,
        Some(Ok(origin)) => origin.strip_prefix("http://") == Some(host),
        Some(Err(_)) => false,
    };
    // A request that another page makes through its browser has no origin; but a link to this page may be anywhere.
    let is_fetched = !matches!(text(FETCH_MODE), Some(Ok("navigate")))
        && matches!(text(FETCH_SITE), Some(Ok("cross-site" | "same-site")));
    (is_here(host) && of_page && !is_fetched).then_some(host)
}

/// An IP address or localhost, with or without a port.
fn is_here(host: &str) -> bool {
    let (name, port) = match host.rsplit_once(':') {
        // The colons of an IPv6 address are within brackets.
        Some((name, port)) if !port.ends_with(']') => (name, Some(port)),
        _ => (host, None),
    };
    let is_port = port.is_none_or(|port| port.parse::<u16>().is_ok());
    let bare = name
        .strip_prefix('[')
        .and_then(|name| name.strip_suffix(']'));
    let is_name = match bare {
        Some(bare) => bare.parse::<Ipv6Addr>().is_ok(),
        None => name.eq_ignore_ascii_case("localhost") || name.parse::<Ipv4Addr>().is_ok(),
    };
    is_port && is_name
}

const FETCH_MODE: HeaderName = HeaderName::from_static("sec-fetch-mode");
const FETCH_SITE: HeaderName = HeaderName::from_static("sec-fetch-site");

async fn socket(
    State(hub): State<Arc<Hub>>,
    Extension(seat): Extension<Arc<Seat>>,
    upgrade: WebSocketUpgrade,
) -> Response {
    upgrade
        .max_message_size(LONGEST_WIRE)
        .max_frame_size(LONGEST_WIRE)
        .read_buffer_size(AT_ONCE)
        // Every message is sent immediately.
        .write_buffer_size(0)
        .on_upgrade(move |socket| client::serve(socket, hub, seat))
}

async fn file(request: Request) -> Response {
    let accepted = request.headers().get(header::ACCEPT_ENCODING);
    let accepted = accepted.and_then(|value| value.to_str().ok());
    let takes_gzip = accepted.is_some_and(page::takes_gzip);
    let Some(found) = page::find(request.uri().path(), takes_gzip) else {
        return (StatusCode::NOT_FOUND, "not here\n").into_response();
    };
    let head = [
        (header::CONTENT_TYPE, found.kind),
        (header::VARY, "accept-encoding"),
    ];
    let packed = found
        .is_packed
        .then_some([(header::CONTENT_ENCODING, "gzip")]);
    (head, packed, found.bytes).into_response()
}

async fn recording(State(hub): State<Arc<Hub>>, Path(file): Path<String>) -> Response {
    let kind = match file.as_str() {
        "trace.jsonl" | "recording.jsonl" => "application/x-ndjson",
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
fn content(recorded: &LiveRecording, file: &str) -> Result<(Body, u64), String> {
    let file = match file {
        "trace.jsonl" => recorded.trace()?,
        "recording.jsonl" => recorded.file()?,
        "scene.toml" => return Ok(of_text(recorded.scene.clone())),
        _ => return Ok(of_text(recorded.hand_csv())),
    };
    // A recording of ten minutes has hundreds of megabytes: it is read as it is sent.
    let length = file.metadata().map_err(|error| error.to_string())?.len();
    let pieces = try_unfold(tokio::fs::File::from_std(file), async |mut file| {
        let mut piece = vec![0; PIECE];
        let count = file.read(&mut piece).await?;
        piece.truncate(count);
        Ok::<_, io::Error>((count > 0).then_some((piece, file)))
    });
    Ok((Body::from_stream(pieces), length))
}

fn of_text(text: String) -> (Body, u64) {
    let length = text.len() as u64;
    (text.into(), length)
}

/// An answer that reports an error.
pub(super) fn problem(status: StatusCode, text: &str) -> Response {
    let body = json!({"message": text}).to_string();
    let kind = [(header::CONTENT_TYPE, "application/json")];
    (status, kind, body).into_response()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn own(fields: &[(HeaderName, &'static str)]) -> bool {
        let field = |(name, value): &(HeaderName, &'static str)| {
            (name.clone(), HeaderValue::from_static(value))
        };
        own_place(&fields.iter().map(field).collect()).is_some()
    }

    #[test]
    fn the_own_page_and_programs_may_ask_and_others_may_not() {
        let asks = |host, origin: Option<&'static str>| {
            let origin = origin.map(|origin| (header::ORIGIN, origin));
            own(&[(header::HOST, host)]
                .into_iter()
                .chain(origin)
                .collect::<Vec<_>>())
        };
        for (host, origin) in [
            ("127.0.0.1:8405", None),
            ("127.0.0.1:8405", Some("http://127.0.0.1:8405")),
            ("localhost:8405", Some("http://localhost:8405")),
            ("[::1]:8405", Some("http://[::1]:8405")),
        ] {
            assert!(asks(host, origin), "{host} {origin:?}");
        }
        for (host, origin) in [
            ("127.0.0.1:8405", Some("http://127.0.0.1:80")),
            ("127.0.0.1:8405", Some("http://example.org")),
            ("127.0.0.1:8405", Some("https://127.0.0.1:8405")),
            ("127.0.0.1:8405", Some("null")),
            // A foreign name that was made to resolve to this computer.
            ("example.org:8405", Some("http://example.org:8405")),
            ("example.org", None),
            // Text that would be another part of the policy.
            ("127.0.0.1:80; script-src *", None),
            ("[::1]:x", None),
            ("[127.0.0.1]", None),
            ("127.0.0.1:", None),
        ] {
            assert!(!asks(host, origin), "{host} {origin:?}");
        }
        // A picture or a script of another page, and a link in it.
        for (site, mode, may) in [
            ("cross-site", "no-cors", false),
            ("same-site", "no-cors", false),
            ("cross-site", "navigate", true),
            ("same-origin", "cors", true),
        ] {
            let host = (header::HOST, "127.0.0.1:8405");
            let fetched = own(&[host, (FETCH_SITE, site), (FETCH_MODE, mode)]);
            assert_eq!(fetched, may, "{site} {mode}");
        }
    }

    #[test]
    fn a_page_may_talk_to_its_own_host_and_be_in_no_frame() {
        for (place, sources) in [
            (Some("[::1]:8405"), "'self' ws://[::1]:8405"),
            (None, "'self'"),
        ] {
            let expected =
                format!("default-src 'self'; connect-src {sources}; frame-ancestors 'none'");
            assert_eq!(policy(place), expected);
        }
    }
}
