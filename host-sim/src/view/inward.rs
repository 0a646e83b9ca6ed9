//! Receives the hand from trackers by UDP: OSC, and the doubles of OpenTrack. What is dropped is reported once, with its reason.

use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::io;
use std::net::{IpAddr, UdpSocket as StdSocket};

use stiction_live::guide::HandPose;
use stiction_live::holder::Source;
use stiction_live::inbound::FARTHEST;
use tokio::net::UdpSocket;
use tokio::sync::mpsc::Sender;

use super::orders::Order;
use super::osc::{self, Message};
use super::outward::{CENTIMETRES, PoseFormat};
use crate::report;

/// The longest packet that is read: short enough for the depth of its nesting.
const PACKET: usize = 2048;
/// Bytes of the six doubles of OpenTrack, and with a seventh one, the switch.
const SIX: usize = 6 * 8;
const SEVEN: usize = 7 * 8;
/// The most reasons that are reported: a sender that is not meant for this port may send anything.
const REASONS: usize = 8;

/// A socket that listens on a port.
pub(super) fn at(address: IpAddr, port: u16) -> io::Result<StdSocket> {
    let socket = StdSocket::bind((address, port))?;
    socket.set_nonblocking(true)?;
    Ok(socket)
}

pub(super) async fn receive(
    socket: StdSocket,
    format: PoseFormat,
    orders: Sender<Order>,
) -> io::Result<()> {
    let socket = UdpSocket::from_std(socket)?;
    let mut bytes = [0; PACKET];
    let (mut tracker, mut dropped) = (Tracker::default(), Dropped::default());
    let (source, name) = match format {
        PoseFormat::Osc => (Source::Osc, "--osc-in"),
        PoseFormat::OpenTrack => (Source::OpenTrack, "--opentrack-in"),
    };
    loop {
        // If another receiver refused what was sent, reading continues.
        let Ok(count) = socket.recv(&mut bytes).await else {
            continue;
        };
        let packet = bytes.get(..count).unwrap_or_default();
        let news = match format {
            PoseFormat::Osc => tracker.osc(packet, &mut dropped),
            PoseFormat::OpenTrack => tracker.open_track(packet).unwrap_or_else(|reason| {
                dropped.add(reason);
                None
            }),
        };
        for reason in dropped.news.drain(..) {
            report::tell(format_args!("{name}: {reason}"));
        }
        if let Some(pose) = news {
            // A sample that the solver has no time for is overtaken by the next one.
            let _ = orders.try_send(Order::Hand(source, pose));
        }
    }
}

/// The reasons for which something was dropped, each reported once.
#[derive(Debug, Default)]
struct Dropped {
    known: BTreeSet<String>,
    /// Those that have not been reported yet.
    news: Vec<String>,
}

impl Dropped {
    fn add(&mut self, reason: String) {
        if self.known.len() < REASONS && self.known.insert(reason.clone()) {
            self.news.push(format!("dropped: {reason}"));
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
    fn osc(&mut self, packet: &[u8], dropped: &mut Dropped) -> Option<HandPose> {
        let messages = osc::messages(packet).unwrap_or_else(|reason| {
            dropped.add(reason.to_owned());
            Vec::new()
        });
        let mut is_new = false;
        for message in &messages {
            match self.take(message) {
                Ok(()) => is_new = true,
                Err(reason) => dropped.add(reason),
            }
        }
        let hand = self.hand.filter(|_| is_new)?;
        Some(HandPose {
            held: self.held,
            ..hand
        })
    }

    /// Takes a part of the hand. Returns the reason why there is none.
    fn take(&mut self, message: &Message) -> Result<(), String> {
        let (address, types) = (&message.address, message.types());
        let numbers: Option<Vec<f64>> = message
            .arguments
            .iter()
            .map(osc::Argument::number)
            .collect();
        match (address.as_str(), numbers.as_deref()) {
            ("/stiction/hand", Some(&[x, y, phi])) => self.lead([x, y, phi], 0.0),
            ("/stiction/held", Some(&[held])) => {
                self.held = held != 0.0;
                Ok(())
            }
            ("/stiction/hand", _) => Err(format!(
                "`{address}` with the types `{types}`, allowed: three numbers (f, d, i, h): x, y (m), phi (rad)"
            )),
            ("/stiction/held", _) => Err(format!(
                "`{address}` with the types `{types}`, allowed: one number, or T or F"
            )),
            _ => Err(format!(
                "`{address}`, which is not known, allowed: `/stiction/hand` and `/stiction/held`"
            )),
        }
    }

    /// Returns the hand of six doubles, or of seven with the switch; `None` if there is none yet.
    fn open_track(&mut self, packet: &[u8]) -> Result<Option<HandPose>, String> {
        let count = packet.len();
        if count != SIX && count != SEVEN {
            return Err(format!(
                "a packet of {count} bytes, allowed: {SIX}, six doubles, or {SEVEN} with the switch"
            ));
        }
        let doubles = packet
            .chunks_exact(8)
            .filter_map(|bytes| bytes.try_into().ok());
        let doubles: Vec<f64> = doubles.map(f64::from_le_bytes).collect();
        let [x, y, depth, _, _, roll, held @ ..] = doubles.as_slice() else {
            return Ok(None);
        };
        let held = match held {
            [held] if held.is_nan() => return Err("a switch that is no number".to_owned()),
            [held] => *held != 0.0,
            _ => true,
        };
        let [x, y, depth] = [x, y, depth].map(|cm| cm / CENTIMETRES);
        self.held = held;
        self.lead([x, y, roll.to_radians()], depth)?;
        Ok(self.hand)
    }

    /// Stores a pose that is within range; its angle continues by less than half a turn.
    fn lead(&mut self, [x, y, phi]: [f64; 3], depth: f64) -> Result<(), String> {
        let fits = |value: &f64| value.abs() <= FARTHEST;
        if ![x, y, phi, depth].iter().all(fits) {
            return Err(format!(
                "a pose that is not finite or beyond {FARTHEST:e} m or rad"
            ));
        }
        let last = self.hand.map_or(0.0, |hand| hand.pose[2]);
        let phi = phi + TAU * ((last - phi) / TAU).round();
        let held = self.held;
        // No negative zero: a recorded path would lose its sign.
        let pose = [x, y, phi].map(|value| value + 0.0);
        let depth = depth + 0.0;
        self.hand = Some(HandPose { pose, depth, held });
        Ok(())
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
            hand.expect("a pose").pose[2].to_degrees().round()
        });
        assert_eq!(angles, [170.0, 190.0, 350.0, 510.0, 670.0]);
    }

    #[test]
    fn packets_that_are_no_pose_are_dropped_with_a_reason() {
        let mut tracker = Tracker::default();
        for bad in [f64::NAN, f64::INFINITY, 1e300] {
            let reason = tracker.open_track(&track(bad)).expect_err("no pose");
            assert!(reason.contains("not finite or beyond"), "{reason}");
        }
        let reason = tracker.open_track(&[0; 47]).expect_err("no pose");
        assert!(reason.contains("47 bytes"), "{reason}");
        for packet in [
            &b""[..],
            b"#bundle\0",
            b"/stiction/hand\0\0,ff\0",
            b"/stiction/hand\0\0\0\0\0\0\0\0\0\0\0\0\0\0",
            b"/stiction/h*\0\0\0\0,\0\0\0",
            &[255; PACKET],
        ] {
            let mut dropped = Dropped::default();
            for _ in 0..2 {
                assert!(tracker.osc(packet, &mut dropped).is_none());
            }
            assert_eq!(dropped.news.len(), 1, "{packet:?}: {:?}", dropped.news);
        }
    }

    #[test]
    fn a_seventh_double_is_the_switch() {
        let mut tracker = Tracker::default();
        for (switch, held) in [(0.0, false), (1.0, true), (0.0, false)] {
            let mut packet = track(0.0);
            packet.extend(f64::to_le_bytes(switch));
            let hand = tracker.open_track(&packet).expect("a pose");
            assert_eq!(hand.expect("a pose").held, held);
        }
        let hand = tracker.open_track(&track(0.0)).expect("a pose");
        assert!(hand.expect("a pose").held, "without one it holds");
    }
}
