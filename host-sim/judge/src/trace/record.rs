//! A record as a trace writes it, in either format, and its frame: names are looked up in the scene, and a number that is not finite, `null`
//! in JSON, becomes NaN.

use std::borrow::{Borrow, Cow};

use serde::{Deserialize, Deserializer};
use stiction_core::{Event, StateKind as State, Status, Touch};

use crate::frame::{Contact, EVENTS, Frame, STATUSES};
use crate::scene::Scene;

#[derive(Deserialize)]
pub(super) struct Record<'a> {
    #[serde(deserialize_with = "number")]
    pub(super) t: f64,
    pub(super) hand: [Option<f64>; 3],
    pub(super) held: bool,
    pub(super) pose: [Option<f64>; 3],
    #[serde(default, deserialize_with = "number")]
    pub(super) depth: f64,
    #[serde(borrow)]
    pub(super) state: Cow<'a, str>,
    #[serde(borrow)]
    pub(super) contacts: Vec<Entry<'a>>,
    /// Contacts for which a row of a table has no columns.
    #[serde(skip)]
    pub(super) more_contacts: bool,
    pub(super) wrench: [Option<f64>; 3],
    pub(super) slips: u32,
    #[serde(borrow)]
    pub(super) events: Vec<Cow<'a, str>>,
    #[serde(borrow)]
    pub(super) status: Cow<'a, str>,
    pub(super) behind: Option<f64>,
}

/// One of its contacts; absent keys are `None`.
#[derive(Deserialize)]
pub(super) struct Entry<'a> {
    pub(super) vertex: Option<usize>,
    #[serde(borrow)]
    pub(super) surface: Option<Cow<'a, str>>,
    #[serde(borrow)]
    pub(super) obstacle: Option<Cow<'a, str>>,
    pub(super) side: Option<usize>,
    pub(super) corner: Option<usize>,
    pub(super) body_side: Option<usize>,
    pub(super) point: [Option<f64>; 2],
    pub(super) direction: Option<[Option<f64>; 2]>,
    #[serde(deserialize_with = "number")]
    pub(super) normal: f64,
    #[serde(deserialize_with = "number")]
    pub(super) friction: f64,
    pub(super) sliding: Option<i64>,
}

fn number<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(finite(Option::deserialize(deserializer)?))
}

fn finite(number: Option<f64>) -> f64 {
    number.unwrap_or(f64::NAN)
}

impl Record<'_> {
    /// Its frame in a scene with these names.
    pub(super) fn frame(&self, names: &Names) -> Result<Frame, String> {
        let contact = |(i, entry): (usize, &Entry<'_>)| {
            Ok(Contact {
                touch: names.touch(i, entry)?,
                point: entry.point.map(finite),
                direction: entry.direction.map(|direction| direction.map(finite)),
                normal: entry.normal,
                friction: entry.friction,
                sliding: entry.sliding.map(|sign| sliding(i, sign)).transpose()?,
            })
        };
        let contacts = self.contacts.iter().enumerate().map(contact);
        let event = |name: &Cow<'_, str>| named("one of `events`", name, EVENTS, Event::name);
        Ok(Frame {
            t: self.t,
            hand: self.hand.map(finite),
            held: self.held,
            pose: self.pose.map(finite),
            depth: self.depth,
            state: named("`state`", &self.state, State::ALL, State::name)?,
            contacts: contacts.collect::<Result<_, String>>()?,
            complete: !self.more_contacts,
            wrench: self.wrench.map(finite),
            slips: self.slips,
            events: self.events.iter().map(event).collect::<Result<_, _>>()?,
            status: named("`status`", &self.status, STATUSES, Status::name)?,
            behind: self.behind,
        })
    }
}

fn sliding(contact: usize, sign: i64) -> Result<i8, String> {
    match sign {
        -1..=1 => Ok(sign as i8),
        _ => Err(format!(
            "`sliding` of contact {contact} is {sign}, allowed: -1, 0, 1"
        )),
    }
}

/// The item with this name.
fn named<T: Copy, const N: usize>(
    what: &str,
    given: &str,
    all: [T; N],
    name: fn(T) -> &'static str,
) -> Result<T, String> {
    let found = all.into_iter().find(|item| name(*item) == given);
    found.ok_or_else(|| unknown(what, given, &all.map(name)))
}

fn unknown<S: Borrow<str>>(what: &str, name: &str, known: &[S]) -> String {
    format!("{what} is {name:?}, allowed: {}", known.join(", "))
}

/// The scene's names of surfaces and obstacles, and the numbers of their vertices and of the body's.
pub(super) struct Names {
    surfaces: Vec<String>,
    obstacles: Vec<String>,
    corners: Vec<usize>,
    vertices: usize,
}

impl Names {
    pub(super) fn of(scene: &Scene) -> Self {
        Self {
            surfaces: scene.surfaces.iter().map(|s| s.name.clone()).collect(),
            obstacles: scene.obstacles.iter().map(|o| o.name.clone()).collect(),
            corners: scene.obstacles.iter().map(|o| o.vertices.len()).collect(),
            vertices: scene.vertices.len(),
        }
    }

    /// The touching features of a contact.
    fn touch(&self, contact: usize, entry: &Entry<'_>) -> Result<Touch, String> {
        let find = |kind: &str, known: &[String], name: &str| {
            let place = known.iter().position(|known| known == name);
            place.ok_or_else(|| unknown(&format!("the `{kind}` of contact {contact}"), name, known))
        };
        let obstacle = |name: &str| find("obstacle", &self.obstacles, name);
        let index = |key: &str, index: usize, count: usize| match count {
            _ if index < count => Ok(index),
            0 => Err(format!(
                "the `{key}` of contact {contact} is {index}, but there is none"
            )),
            _ => Err(format!(
                "the `{key}` of contact {contact} is {index}, allowed: 0 to {}",
                count - 1
            )),
        };
        let sides = |vertices: usize| if vertices < 2 { 0 } else { vertices };
        let vertex = entry.vertex.map(|k| index("vertex", k, self.vertices));
        let features = (vertex, entry.side, entry.corner, entry.body_side);
        match (
            features,
            entry.surface.as_deref(),
            entry.obstacle.as_deref(),
        ) {
            ((Some(vertex), None, None, None), Some(surface), None) => Ok(Touch::Surface {
                vertex: vertex?,
                surface: find("surface", &self.surfaces, surface)?,
            }),
            ((Some(vertex), Some(side), None, None), None, Some(name)) => {
                let obstacle = obstacle(name)?;
                Ok(Touch::Side {
                    vertex: vertex?,
                    obstacle,
                    side: index("side", side, sides(self.corners[obstacle]))?,
                })
            }
            ((None, None, Some(corner), Some(body_side)), None, Some(name)) => {
                let obstacle = obstacle(name)?;
                Ok(Touch::Corner {
                    obstacle,
                    corner: index("corner", corner, self.corners[obstacle])?,
                    body_side: index("body_side", body_side, sides(self.vertices))?,
                })
            }
            _ => Err(format!(
                "contact {contact}: allowed: `vertex` and `surface`, `vertex`, `obstacle` and `side`, or `corner`, `obstacle` and \
                 `body_side`"
            )),
        }
    }
}
