//! The connections: a limited number, each with a time limit for its request. If all places are taken, a new connection replaces
//! the oldest of those that have sent nothing: active users of the program are not locked out.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use axum::Router;
use axum::extract::Request;
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{Notify, watch};
use tokio::time::sleep;
use tower_service::Service;

use super::client::ended;

/// Maximum number of connections: pages have up to seven each. This is an eighth of the smallest limit of descriptors per
/// process.
const MOST: usize = 128;
/// Time limit for the head of a request, and for each piece of its body after the previous one: a browser sends both immediately.
pub(super) const PIECE: Duration = Duration::from_secs(5);
/// If the system provides no connection, the next attempt is made after this time.
const BREATH: Duration = Duration::from_millis(50);

/// Accepts clients until `stop`, and waits until they are gone.
pub(super) async fn serve(listener: TcpListener, router: Router, mut stop: watch::Receiver<bool>) {
    let connections = Connections::default();
    loop {
        let accepted = tokio::select! {
            () = ended(&mut stop) => break,
            accepted = listener.accept() => accepted,
        };
        let Ok((stream, _)) = accepted else {
            sleep(BREATH).await;
            continue;
        };
        // A connection without a place is closed.
        if let Some(seat) = connections.enter() {
            // A frame does not wait for the acknowledgement of the previous one. If this cannot be set, frames are only later.
            let _ = stream.set_nodelay(true);
            tokio::spawn(connection(stream, router.clone(), seat, stop.clone()));
        }
    }
    while !connections.seats().taken.is_empty() {
        sleep(BREATH).await;
    }
}

/// Serves a connection; one that becomes a socket continues without this.
async fn connection(
    stream: TcpStream,
    router: Router,
    seat: Arc<Seat>,
    mut stop: watch::Receiver<bool>,
) {
    let handle = Arc::clone(&seat);
    let service = service_fn(move |mut request: Request<Incoming>| {
        request.extensions_mut().insert(Arc::clone(&handle));
        router.clone().call(request)
    });
    let mut server = http1::Builder::new();
    server.timer(TokioTimer::new()).header_read_timeout(PIECE);
    let serving = server.serve_connection(TokioIo::new(stream), service);
    let mut serving = std::pin::pin!(serving.with_upgrades());
    tokio::select! {
        // A client that disconnects is no fault of this program.
        _ = &mut serving => {}
        () = seat.lost() => {}
        () = ended(&mut stop) => {
            serving.as_mut().graceful_shutdown();
            let _ = serving.await;
        }
    }
}

#[derive(Debug, Default)]
struct Connections(Arc<Mutex<Seats>>);

#[derive(Debug, Default)]
struct Seats {
    /// The oldest first.
    taken: VecDeque<Occupied>,
    next: u64,
}

#[derive(Debug)]
struct Occupied {
    number: u64,
    /// Its connection has sent something.
    is_active: bool,
    /// Notified when the place is lost.
    lost: Arc<Notify>,
}

impl Connections {
    fn seats(&self) -> MutexGuard<'_, Seats> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns a place for a new connection; none if all places are taken by active ones.
    fn enter(&self) -> Option<Arc<Seat>> {
        let mut seats = self.seats();
        if seats.taken.len() >= MOST {
            let silent = seats.taken.iter().position(|place| !place.is_active)?;
            seats.taken.remove(silent)?.lost.notify_one();
        }
        let (number, lost) = (seats.next, Arc::new(Notify::new()));
        seats.next += 1;
        seats.taken.push_back(Occupied {
            number,
            is_active: false,
            lost: Arc::clone(&lost),
        });
        Some(Arc::new(Seat {
            seats: Arc::clone(&self.0),
            number,
            lost,
        }))
    }
}

/// A place, until it is dropped.
#[derive(Debug)]
pub(super) struct Seat {
    seats: Arc<Mutex<Seats>>,
    number: u64,
    lost: Arc<Notify>,
}

impl Seat {
    /// A client of the socket sent a message or answered a ping: it keeps its place.
    pub(super) fn mark_active(&self) {
        let mut seats = self.seats.lock().unwrap_or_else(PoisonError::into_inner);
        let mut places = seats.taken.iter_mut();
        if let Some(own) = places.find(|place| place.number == self.number) {
            own.is_active = true;
        }
    }

    /// Waits until a new connection takes the place.
    pub(super) async fn lost(&self) {
        self.lost.notified().await;
    }
}

impl Drop for Seat {
    fn drop(&mut self) {
        let mut seats = self.seats.lock().unwrap_or_else(PoisonError::into_inner);
        seats.taken.retain(|place| place.number != self.number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::future::Future;
    use std::task::{Context, Waker};

    fn is_lost(seat: &Seat) -> bool {
        let mut lost = std::pin::pin!(seat.lost());
        let mut context = Context::from_waker(Waker::noop());
        lost.as_mut().poll(&mut context).is_ready()
    }

    #[test]
    fn a_newcomer_gets_the_place_of_the_oldest_that_was_silent() {
        let connections = Connections::default();
        let seats: Vec<Arc<Seat>> = (0..MOST).filter_map(|_| connections.enter()).collect();
        assert_eq!(seats.len(), MOST);
        seats[0].mark_active();
        let late = connections.enter().expect("a place");
        assert!(!is_lost(&seats[0]) && is_lost(&seats[1]) && !is_lost(&seats[2]));
        seats[2..].iter().for_each(|seat| seat.mark_active());
        late.mark_active();
        assert!(connections.enter().is_none(), "all are active");
        drop(late);
        assert!(connections.enter().is_some());
    }
}
