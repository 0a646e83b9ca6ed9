//! Sends poses to renderers, and receives the hand from trackers, by UDP: OSC, and the six doubles of OpenTrack.

use std::io;
use std::net::{IpAddr, SocketAddr, ToSocketAddrs, UdpSocket as StdSocket};
use std::sync::Arc;
use std::time::Duration;

use stiction_scene::SceneFile;
use tokio::net::UdpSocket;
use tokio::sync::mpsc::Sender;
use tokio::time::{MissedTickBehavior, interval};

use super::feed::SharedFeed;
use super::orders::Order;
use super::osc::{self, Argument, Message};
use stiction_live::guide::HandPose;
use stiction_live::holder::Source;
use stiction_live::inbound::FARTHEST;
use stiction_live::record::Frame;

/// The longest packet that is read: short enough for the depth of its nesting.
const PACKET: usize = 2048;
/// Centimetres per metre.
const CENTIMETRES: f64 = 100.0;

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

/// A socket that listens on a port.
pub(super) fn at(address: IpAddr, port: u16) -> io::Result<StdSocket> {
    let socket = StdSocket::bind((address, port))?;
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

pub(super) async fn receive(
    socket: StdSocket,
    format: PoseFormat,
    orders: Sender<Order>,
) -> io::Result<()> {
    let socket = UdpSocket::from_std(socket)?;
    let mut bytes = [0; PACKET];
    let mut tracker = Tracker::default();
    loop {
        // If another receiver refused what was sent, reading continues.
        let Ok(count) = socket.recv(&mut bytes).await else {
            continue;
        };
        let packet = bytes.get(..count).unwrap_or_default();
        let (source, news) = match format {
            PoseFormat::Osc => (Source::Osc, tracker.osc(packet)),
            PoseFormat::OpenTrack => (Source::OpenTrack, tracker.open_track(packet)),
        };
        if let Some(pose) = news {
            // A sample that the solver has no time for is overtaken by the next one.
            let _ = orders.try_send(Order::Hand(source, pose));
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Tracker {
    hand: Option<HandPose>,
    held: bool,
}

impl Default for Tracker {
    fn default() -> Self {
        Self {
            hand: None,
            held: true,
        }
    }
}

impl Tracker {
    /// Returns the hand, if the packet contains a part of it.
    fn osc(&mut self, packet: &[u8]) -> Option<HandPose> {
        let messages = osc::messages(packet)?;
        let take = |is_new, message| self.take(message) | is_new;
        let is_new = messages.iter().fold(false, take);
        let hand = self.hand.filter(|_| is_new)?;
        Some(HandPose {
            held: self.held,
            ..hand
        })
    }

    fn take(&mut self, message: &Message) -> bool {
        match (message.address.as_str(), message.arguments.as_slice()) {
            ("/stiction/hand", [Argument::Float(x), Argument::Float(y), Argument::Float(phi)]) => {
                let pose = [x, y, phi].map(|&value| f64::from(value) + 0.0);
                self.lead(pose, 0.0)
            }
            ("/stiction/held", [Argument::Int(held)]) => {
                self.held = *held != 0;
                true
            }
            _ => false,
        }
    }

    /// Returns the hand of six doubles; its angle is unwrapped over whole turns.
    fn open_track(&mut self, packet: &[u8]) -> Option<HandPose> {
        let packet: &[u8; 48] = packet.try_into().ok()?;
        let value = |i: usize| {
            let bytes = packet.get(8 * i..8 * i + 8)?;
            Some(f64::from_le_bytes(bytes.try_into().ok()?))
        };
        let [x, y, depth] = [value(0)?, value(1)?, value(2)?].map(|cm| cm / CENTIMETRES + 0.0);
        let roll = Some(value(5)?.to_radians()).filter(|roll| roll.abs() <= FARTHEST)?;
        let last = self.hand.map_or(0.0, |hand| hand.pose[2]);
        let change = (roll - last + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU);
        let phi = last + change - std::f64::consts::PI;
        self.lead([x, y, phi], depth).then_some(self.hand)?
    }

    /// Stores a pose that is within range.
    fn lead(&mut self, pose: [f64; 3], depth: f64) -> bool {
        let fits = pose
            .iter()
            .chain([&depth])
            .all(|value| value.abs() <= FARTHEST);
        if fits {
            let held = self.held;
            self.hand = Some(HandPose { pose, depth, held });
        }
        fits
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track(roll: f64) -> Vec<u8> {
        let values = [1.0, 2.0, 3.0, 0.0, 0.0, roll];
        values
            .iter()
            .flat_map(|value: &f64| value.to_le_bytes())
            .collect()
    }

    #[test]
    fn the_roll_of_a_tracker_is_unwrapped() {
        let mut tracker = Tracker::default();
        let degrees = [170.0, -170.0, -10.0, 150.0, -50.0];
        let angles = degrees.map(|roll| {
            let hand = tracker.open_track(&track(roll)).expect("a pose");
            hand.pose[2].to_degrees().round()
        });
        assert_eq!(angles, [170.0, 190.0, 350.0, 510.0, 670.0]);
    }

    #[test]
    fn packets_that_are_no_pose_are_dropped() {
        let mut tracker = Tracker::default();
        for bad in [f64::NAN, f64::INFINITY, 1e300] {
            assert!(tracker.open_track(&track(bad)).is_none());
        }
        assert!(tracker.open_track(&[0; 47]).is_none());
        for packet in [
            &b""[..],
            b"#bundle\0",
            b"/stiction/hand\0\0,ff\0",
            &[255; PACKET],
        ] {
            assert!(tracker.osc(packet).is_none());
        }
    }
}
