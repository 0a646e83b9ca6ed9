//! Sends poses to renderers by UDP: OSC, and the six doubles of OpenTrack.

use std::io;
use std::net::{SocketAddr, ToSocketAddrs, UdpSocket as StdSocket};
use std::sync::Arc;
use std::time::Duration;

use stiction_scene::SceneFile;
use tokio::net::UdpSocket;
use tokio::time::{MissedTickBehavior, interval};

use super::feed::SharedFeed;
use super::osc::{self, Argument, Message};
use stiction_live::record::Frame;

/// Centimetres per metre.
pub(super) const CENTIMETRES: f64 = 100.0;

/// A socket that sends to an address.
pub(super) fn to(address: &str) -> io::Result<StdSocket> {
    let resolved = address.to_socket_addrs()?.next();
    let to = resolved.ok_or_else(|| io::Error::other("no such host"))?;
    if to.port() == 0 {
        return Err(io::Error::other("nobody hears on port 0"));
    }
    let from: SocketAddr = match to {
        SocketAddr::V4(_) => ([0, 0, 0, 0], 0).into(),
        SocketAddr::V6(_) => ([0; 16], 0).into(),
    };
    let socket = StdSocket::bind(from)?;
    socket.connect(to)?;
    socket.set_nonblocking(true)?;
    Ok(socket)
}

#[derive(Clone, Copy, Debug)]
pub(super) enum PoseFormat {
    Osc,
    OpenTrack,
}

/// Sends the newest pose at this rate (Hz).
pub(super) async fn send(
    socket: StdSocket,
    format: PoseFormat,
    feed: Arc<SharedFeed>,
    rate: f64,
) -> io::Result<()> {
    let socket = UdpSocket::from_std(socket)?;
    let mut clock = interval(Duration::from_secs_f64(1.0 / rate));
    clock.set_missed_tick_behavior(MissedTickBehavior::Skip);
    let (_, mut next) = feed.read().since(u64::MAX);
    loop {
        clock.tick().await;
        let (latest, events) = {
            let shown = feed.read();
            let (records, now) = shown.since(next);
            next = now;
            let events = records.flat_map(|frame| frame.events.iter().map(|event| event.name()));
            let events: Vec<&'static str> = events.collect();
            let latest = shown.latest.as_ref();
            (
                latest.map(|latest| (Arc::clone(&latest.frame), Arc::clone(&latest.scene))),
                events,
            )
        };
        let Some((frame, scene)) = latest else {
            continue;
        };
        let bytes = match format {
            PoseFormat::Osc => osc::bundle(&parts(&frame, &scene, &events)),
            PoseFormat::OpenTrack => doubles(&frame).to_vec(),
        };
        // A receiver is not required.
        let _ = socket.send(&bytes).await;
    }
}

fn parts(frame: &Frame, scene: &SceneFile, events: &[&'static str]) -> Vec<Message> {
    let float = |value: f64| Argument::Float(value as f32);
    let text = |value: &str| Argument::Text(value.to_owned());
    let message = |name: &str, arguments: Vec<Argument>| Message {
        address: format!("/stiction/{name}"),
        arguments,
    };
    let mut content = vec![
        message("pose", frame.pose.map(float).to_vec()),
        message("depth", vec![float(frame.depth)]),
        message("state", vec![text(frame.state.name())]),
        message("wrench", frame.wrench.map(float).to_vec()),
    ];
    for contact in &frame.contacts {
        let surface = contact.touch.surface().and_then(|k| scene.surfaces.get(k));
        let obstacle = contact
            .touch
            .obstacle()
            .and_then(|k| scene.obstacles.get(k));
        let name = surface
            .map(|surface| &surface.name)
            .or(obstacle.map(|obstacle| &obstacle.name));
        // -1: a corner of an obstacle, on a side of the body.
        let vertex = contact
            .touch
            .vertex()
            .map(|k| i32::try_from(k).unwrap_or(i32::MAX));
        let [x, y] = contact.point.map(float);
        let args = vec![
            Argument::Int(vertex.unwrap_or(-1)),
            text(name.map_or("", String::as_str)),
            x,
            y,
            float(contact.normal),
            float(contact.friction),
            Argument::Int(contact.sliding.into()),
        ];
        content.push(message("contact", args));
    }
    content.extend(
        events
            .iter()
            .map(|event| message("event", vec![text(event)])),
    );
    content
}

/// x, y, depth (cm), yaw, pitch, roll (degrees).
fn doubles(frame: &Frame) -> [u8; 48] {
    let [x, y, theta] = frame.pose;
    let values = [
        x * CENTIMETRES,
        y * CENTIMETRES,
        frame.depth * CENTIMETRES,
        0.0,
        0.0,
        theta.to_degrees(),
    ];
    let mut bytes = [0; 48];
    for (place, value) in bytes.chunks_exact_mut(8).zip(values) {
        place.copy_from_slice(&value.to_le_bytes());
    }
    bytes
}
