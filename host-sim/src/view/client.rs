//! One client of the socket: forwards its messages to the solver, and answers, the state and frames to it. A slow reader delays
//! nobody else; a client that floods is no longer read and is disconnected, and so is one that sends nothing, not even answers to
//! pings.

use std::sync::Arc;
use std::time::{Duration, Instant};

use axum::body::Bytes;
use axum::extract::ws::{CloseFrame, Message as Wire, WebSocket};
use futures_util::stream::{SplitSink, SplitStream};
use futures_util::{FutureExt, SinkExt, StreamExt};
use stiction_live::feed::Cursor;
use stiction_live::inbound::{self, Incoming, LONGEST, Message};
use stiction_live::outbound::{self, Runner};
use tokio::sync::{mpsc, watch};
use tokio::time::{Instant as Tick, sleep_until, timeout};

use super::connections::Seat;
use super::orders::Order;
use super::server::Hub;
use crate::board::Identity;

/// Maximum number of messages of a client per second. Messages beyond the readable length count more than once.
const MOST: usize = 2000;
const SECOND: Duration = Duration::from_secs(1);
/// Maximum number of answers that wait for a client.
const WAITING: usize = 256;
/// Frames per second, unless the client requests another rate.
const RATE: f64 = 60.0;
/// Interval of the checks of the state.
const STATE_EVERY: Duration = Duration::from_millis(20);
/// Interval of the pings of a client, which its library answers.
const PING_EVERY: Duration = Duration::from_secs(10);
/// A client that sends or accepts nothing for this time, three pings, counts as gone.
const PATIENCE: Duration = Duration::from_secs(30);
/// The server ends.
const GOING_AWAY: u16 = 1001;

/// Serves a client until it disconnects or the server ends.
pub(super) async fn serve(socket: WebSocket, hub: Arc<Hub>, seat: Arc<Seat>) {
    let client = hub.number();
    let (sink, stream) = socket.split();
    let (answers, inbox) = mpsc::channel(WAITING);
    let (rate, wanted) = watch::channel(RATE);
    let inbound = Inbound {
        hub: &hub,
        seat: &seat,
        client,
        answers,
        rate,
        second: (Instant::now(), 0),
    };
    let outbound = Outbound {
        hub: &hub,
        client,
        sink,
        skipped: 0,
        period: Duration::from_secs_f64(1.0 / RATE),
    };
    if hub.orders.send(Order::Joined).await.is_err() {
        return;
    }
    tokio::select! {
        () = inbound.listen(stream) => {}
        _ = outbound.talk(inbox, wanted) => {}
        () = seat.lost() => {}
    }
    // If the solver has ended, nobody needs to know.
    let _ = hub.orders.send(Order::Left(client)).await;
}

struct Inbound<'a> {
    hub: &'a Hub,
    seat: &'a Seat,
    client: u32,
    answers: mpsc::Sender<String>,
    rate: watch::Sender<f64>,
    /// Start of the present second, and the number of messages in it.
    second: (Instant, usize),
}

impl Inbound<'_> {
    /// Runs until the client disconnects, floods or sends nothing.
    async fn listen(mut self, mut stream: SplitStream<WebSocket>) {
        while let Ok(Some(Ok(message))) = timeout(PATIENCE, stream.next()).await {
            self.seat.mark_active();
            if self.is_too_fast(&message) {
                let problem =
                    format!("too many messages, allowed: {MOST} a second; the connection ends");
                // What the client still sends is dropped: closing before it is read would also drop the warning on its way.
                let _ = timeout(SECOND, async {
                    let _ = self.answers.send(outbound::error(None, &problem)).await;
                    while let Some(Ok(_)) = stream.next().await {}
                })
                .await;
                return;
            }
            let refusal = match message {
                Wire::Text(text) => self.take(inbound::read(&text)),
                Wire::Binary(_) => Some(outbound::error(None, "a binary message, allowed: text")),
                Wire::Close(_) => return,
                Wire::Ping(_) | Wire::Pong(_) => None,
            };
            if let Some(answer) = refusal {
                // A client that does not read loses answers.
                let _ = self.answers.try_send(answer);
            }
        }
    }

    /// Whether the client has sent too many messages in this second.
    fn is_too_fast(&mut self, message: &Wire) -> bool {
        let length = match message {
            Wire::Text(text) => text.len(),
            Wire::Binary(bytes) | Wire::Ping(bytes) | Wire::Pong(bytes) => bytes.len(),
            Wire::Close(_) => 0,
        };
        if self.second.0.elapsed() >= SECOND {
            self.second = (Instant::now(), 0);
        }
        let count = &mut self.second.1;
        *count += 1 + length / (LONGEST + 1);
        *count > MOST
    }

    /// Forwards a message; returns the answer if it is already known.
    fn take(&self, Incoming { id, message }: Incoming) -> Option<String> {
        let message = match message {
            Ok(message) => message,
            Err(problem) => return Some(outbound::error(id, &problem)),
        };
        if let Message::Rate { value } = message {
            let _ = self.rate.send(value);
            return id.map(outbound::done);
        }
        let order = Order::Message {
            client: self.client,
            id,
            message,
            answers: self.answers.clone(),
        };
        let sent = self.hub.orders.try_send(order);
        sent.err()
            .map(|_| outbound::error(id, "too much to do, allowed: to send it again"))
    }
}

struct Outbound<'a> {
    hub: &'a Hub,
    client: u32,
    sink: SplitSink<WebSocket, Wire>,
    /// Frames that the client did not receive.
    skipped: u64,
    /// Time between two frames.
    period: Duration,
}

struct Gone;

impl Outbound<'_> {
    async fn talk(
        mut self,
        mut inbox: mpsc::Receiver<String>,
        mut rate: watch::Receiver<f64>,
    ) -> Result<(), Gone> {
        let mut stop = self.hub.stop.clone();
        let board = self.hub.board.as_ref();
        let source = board.map_or(Runner::Core, Identity::source);
        let hello = outbound::hello(self.client, &self.hub.scenes, &source);
        self.send(Wire::Text(hello.into())).await?;
        let mut due = Tick::now();
        let mut ping = due;
        let mut cursor = Cursor::new(&self.hub.feed.read());
        loop {
            tokio::select! {
                biased;
                () = ended(&mut stop) => return self.close().await,
                Some(answer) = inbox.recv() => self.skipped += self.send(Wire::Text(answer.into())).await?,
                Ok(()) = rate.changed() => {
                    self.period = Duration::from_secs_f64(1.0 / *rate.borrow_and_update());
                    due = Tick::now();
                }
                () = sleep_until(ping) => {
                    ping = Tick::now() + PING_EVERY;
                    self.skipped += self.send(Wire::Ping(Bytes::new())).await?;
                }
                () = sleep_until(due.min(Tick::now() + STATE_EVERY)) => {
                    let with_frame = Tick::now() >= due;
                    if with_frame {
                        due = (due + self.period).max(Tick::now());
                    }
                    self.tell(&mut cursor, with_frame).await?;
                }
            }
        }
    }

    /// Sends the state if it has changed, and the frame if it has.
    async fn tell(&mut self, cursor: &mut Cursor, with_frame: bool) -> Result<(), Gone> {
        let (state, news) = cursor.look(&self.hub.feed.read(), with_frame);
        if let Some(state) = state {
            self.send(Wire::Text(state.as_ref().into())).await?;
        }
        if let Some(news) = news {
            let message = news.message(self.client, self.skipped);
            self.skipped += self.send(Wire::Text(message.into())).await?;
        }
        Ok(())
    }

    /// Sends a message. Returns how many frames were lost because the client did not accept it.
    async fn send(&mut self, message: Wire) -> Result<u64, Gone> {
        let mut sending = self.sink.send(message);
        // If there is room, this completes immediately, whatever else this computer does.
        let (sent, lost) = match (&mut sending).now_or_never() {
            Some(sent) => (sent, 0),
            None => {
                let begun = Instant::now();
                let sent = timeout(PATIENCE, sending).await.map_err(|_| Gone)?;
                let waited = begun.elapsed().as_secs_f64() / self.period.as_secs_f64();
                (sent, waited as u64)
            }
        };
        sent.map(|()| lost).map_err(|_| Gone)
    }

    async fn close(&mut self) -> Result<(), Gone> {
        let frame = CloseFrame {
            code: GOING_AWAY,
            reason: "the program ends".into(),
        };
        let close = self.sink.send(Wire::Close(Some(frame)));
        match timeout(Duration::from_millis(500), close).await {
            Ok(Ok(())) => Ok(()),
            _ => Err(Gone),
        }
    }
}

/// The server ends.
pub(super) async fn ended(stop: &mut watch::Receiver<bool>) {
    // The disappearance of the other side is an end, too.
    let _ = stop.wait_for(|stop| *stop).await;
}
