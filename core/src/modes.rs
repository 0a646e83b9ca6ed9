//! The motions that a load can begin at contacts that fix the pose, ranked (STATICS 8): a pure function of the pose, the load and the motions
//! that are struck off.

use crate::cone::{ConeEdge, Facet, WrenchCone};
use crate::contact::{Contact, Sense};
use crate::frame::Frame;
use crate::geometry::{Vec2, Wrench};
use crate::motion::Motion;
use crate::real::Real;
use crate::state::{Body, HandPose};
use crate::thresholds::Thresholds;
use crate::world::Statics;
use heapless::Vec;

/// A motion that may begin. Contacts by their places among those of the body; those that are not named open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mode {
    /// All contacts open.
    Lift,
    /// The body turns about a contact; a second one of the same vertex stays too.
    Turn { about: usize, with: Option<usize> },
    /// One contact slides.
    Slide { contact: usize, sense: Sense },
    /// Two slide. A sense `Rests` is not asked for.
    Joint {
        contacts: [usize; 2],
        senses: [Sense; 2],
    },
}

/// A motion by what touches and how it slides: the same whatever other contacts there are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Begun {
    contacts: [Option<Contact>; 2],
}

/// Whether the reactions of a joint slide have to press on the way, or at balance only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pressing {
    Always,
    AtBalance,
}

/// How far the list is done at one pose and hand, and which motions are struck off: those that came back without moving the body.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ranking<R> {
    place: Place<R>,
    struck: Vec<Begun, 12, u8>,
}
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place<R> {
    /// The facets that yield by more than this are done.
    Facets(R),
    /// So many of the list are done.
    List(u8),
}
impl<R: Real> Default for Ranking<R> {
    fn default() -> Self {
        Self {
            place: Place::Facets(R::LEAST),
            struck: Vec::new(),
        }
    }
}
impl<R: Real> Ranking<R> {
    /// The list from its beginning, without those that are struck off.
    pub(crate) fn restart(&mut self) {
        self.place = Place::Facets(R::LEAST);
    }
    pub(crate) fn strike(&mut self, begun: Begun) {
        if !self.struck.contains(&begun) {
            // A full list ends in the limit of rounds.
            let _ = self.struck.push(begun);
        }
    }
}

/// What a look at one candidate found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Picked {
    Mode(Mode),
    /// Not this one.
    More,
    None,
}

/// A candidate after the facets by its place, by class: slides of two, turns about one, slides of one, lift, slides of two whose reactions
/// count at balance only.
fn candidate(count: usize, place: usize) -> Option<(Mode, Pressing)> {
    let joints = count.saturating_mul(count.saturating_sub(1));
    let sizes = [joints, count, count.saturating_mul(2), 1];
    let (mut class, mut k) = (0_u8, place);
    for size in sizes {
        if k < size {
            break;
        }
        (class, k) = (class.saturating_add(1), k.saturating_sub(size));
    }
    let sense = [Sense::Plus, Sense::Minus].into_iter().nth(k % 2)?;
    let joint = |pressing| {
        let (contacts, senses) = (pair(count, k / 2)?, [sense, Sense::Rests]);
        Some((Mode::Joint { contacts, senses }, pressing))
    };
    let (about, contact, with) = (k, k / 2, None);
    let mode = match class {
        0 => return joint(Pressing::Always),
        1 => Mode::Turn { about, with },
        2 => Mode::Slide { contact, sense },
        3 => Mode::Lift,
        _ => return joint(Pressing::AtBalance),
    };
    Some((mode, Pressing::Always))
}
/// Two of so many contacts, by their place: (0, 1), (0, 2), .. (1, 2), ..
fn pair(count: usize, mut left: usize) -> Option<[usize; 2]> {
    for i in 0..count {
        let next = i.saturating_add(1);
        match left.checked_sub(count.saturating_sub(next)) {
            Some(rest) => left = rest,
            None => return Some([i, next.saturating_add(left)]),
        }
    }
    None
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// Looks at the next candidate.
    #[inline(never)]
    pub(crate) fn pick(
        &self,
        body: &Body<R>,
        hand: &HandPose<R>,
        ranking: &mut Ranking<R>,
    ) -> Picked {
        if !self.has_pairs() {
            return Picked::None;
        }
        let (mode, pressing) = match ranking.place {
            Place::Facets(last) => match self.worst_facet(body, hand, last) {
                Some((margin, mode)) => {
                    ranking.place = Place::Facets(margin);
                    (mode, Pressing::Always)
                }
                None => {
                    ranking.place = Place::List(0);
                    return Picked::More;
                }
            },
            Place::List(done) => match candidate(body.contacts.len(), done.into()) {
                Some((mode, pressing)) => {
                    ranking.place = Place::List(done.saturating_add(1));
                    (self.with_vertex(body, mode), pressing)
                }
                None => return Picked::None,
            },
        };
        let begun = self.begun(body, &mode);
        let is_struck = ranking.struck.contains(&begun);
        if !is_struck && self.is_consistent(body, hand, &mode, pressing) {
            Picked::Mode(mode)
        } else {
            Picked::More
        }
    }
    /// The facet that yields most of those that yield by less than `last`, over its size; and its motion.
    #[inline(never)]
    fn worst_facet(&self, body: &Body<R>, hand: &HandPose<R>, last: R) -> Option<(R, Mode)> {
        let load = self.load(body, hand);
        let mut cone = WrenchCone::new();
        self.cone(body, &mut cone);
        let mut worst: Option<(R, Facet<'_, R>)> = None;
        cone.facets(&mut |facet| {
            let margin = facet.margin(load);
            if margin >= R::ZERO {
                return;
            }
            let margin = margin / facet.inward.size();
            let is_worst = worst.as_ref().is_none_or(|(least, _)| margin < *least);
            if margin > last && is_worst {
                worst = Some((margin, facet));
            }
        });
        let (margin, facet) = worst?;
        let [a, b] = facet.edges;
        let contacts = [a.contact, b.contact];
        let [i, j] = contacts;
        let mode = if i == j {
            self.with_vertex(
                body,
                Mode::Turn {
                    about: i,
                    with: None,
                },
            )
        } else if body.contacts.get(i).shares_vertex(body.contacts.get(j)) {
            Mode::Turn {
                about: i,
                with: Some(j),
            }
        } else {
            Mode::Joint {
                contacts,
                senses: [a, b].map(|edge| self.slide_of(body, edge, &facet)),
            }
        };
        Some((margin, mode))
    }
    /// The slide that begins at an edge of a facet; without friction the facet's normal is the motion itself.
    fn slide_of(&self, body: &Body<R>, edge: &ConeEdge<R>, facet: &Facet<'_, R>) -> Sense {
        if edge.slide.slides() {
            return edge.slide;
        }
        let contact = body.contacts.get(edge.contact);
        let frame = self.frame(contact, body.rotation, body.holding);
        Sense::of(facet.inward.dot(Wrench::at(frame.r, frame.t)))
    }
    /// A turn about a contact of a vertex that has another contact keeps both.
    fn with_vertex(&self, body: &Body<R>, mode: Mode) -> Mode {
        let Mode::Turn { about, .. } = mode else {
            return mode;
        };
        let contact = body.contacts.get(about);
        let mut others = body.contacts.iter().enumerate();
        let other = others.find(|&(k, c)| k != about && c.shares_vertex(contact));
        Mode::Turn {
            about,
            with: other.map(|(k, _)| k),
        }
    }
    /// A motion by its features and senses.
    pub(crate) fn begun(&self, body: &Body<R>, mode: &Mode) -> Begun {
        let at = |k: usize, sense| Some(body.contacts.get(k).with(sense));
        let contacts = match *mode {
            Mode::Lift => [None, None],
            Mode::Turn { about, with } => [
                at(about, Sense::Rests),
                with.and_then(|k| at(k, Sense::Rests)),
            ],
            Mode::Slide { contact, sense } => [at(contact, sense), None],
            Mode::Joint {
                contacts: [i, j],
                senses: [of_i, of_j],
            } => [at(i, of_i), at(j, of_j)],
        };
        Begun { contacts }
    }
    /// Driven by the load, pressed, and closing no gap of a contact that is left.
    fn is_consistent(
        &self,
        body: &Body<R>,
        hand: &HandPose<R>,
        mode: &Mode,
        pressing: Pressing,
    ) -> bool {
        let rate = self.opening(body, hand, mode, pressing);
        rate.is_some_and(|rate| rate >= -R::in_plane())
    }
    /// The least rate at which a gap opens that is left; none if the motion is not driven or not pressed.
    pub(crate) fn opening(
        &self,
        body: &Body<R>,
        hand: &HandPose<R>,
        mode: &Mode,
        pressing: Pressing,
    ) -> Option<R> {
        let load = self.load(body, hand);
        let frame = |k: usize| self.frame(body.contacts.get(k), body.rotation, body.holding);
        let pulls = |k: usize| frame(k).n.dot(load.force);
        let (velocity, turn, lasting) = match *mode {
            Mode::Lift => {
                let mut all = (0..body.contacts.len()).map(pulls);
                let is_moved = load.size() > R::of_drive(load.size());
                return (is_moved && all.all(|pull| pull >= R::ZERO)).then_some(R::HUGE);
            }
            Mode::Turn { about, with } => {
                let r = frame(about).r;
                let moment = load.moment - r.cross(load.force);
                let little = R::of_drive(load.size());
                let is_pulled = pulls(about) > little && with.is_none_or(|k| pulls(k) > little);
                if is_pulled || moment.abs() <= little {
                    return None;
                }
                let sign = moment.sign();
                (-(r.turned() * sign), sign, [about, with.unwrap_or(about)])
            }
            Mode::Slide { contact, sense } => {
                let frame = frame(contact);
                let (g, turn) = self.slide_begins(body, &frame, contact, sense, load)?;
                (g, turn, [contact; 2])
            }
            Mode::Joint {
                contacts: [i, j],
                senses: [of_i, of_j],
            } => {
                let (first, second) = (body.contacts.get(i), body.contacts.get(j));
                if first.shares_vertex(second) {
                    return None;
                }
                if self.is_even(first, second) {
                    let frame = frame(i);
                    self.is_driven(&frame, first, of_i, load).then_some(())?;
                    (frame.t * of_i.number(), R::ZERO, [i, j])
                } else {
                    let driven = self.driven(body, hand, [i, j], pressing)?;
                    let [on_i, on_j] = driven.senses;
                    if of_i.opposes(on_i) || of_j.opposes(on_j) {
                        return None;
                    }
                    (driven.velocity, driven.turn, [i, j])
                }
            }
        };
        let left = (0..body.contacts.len()).filter(|k| !lasting.contains(k));
        let rates = left.map(|k| frame(k).opening(velocity, turn));
        Some(rates.fold(R::HUGE, R::min))
    }
    /// A contact that is pressed is pushed along its sense by more than its sliding friction.
    pub(crate) fn is_driven(
        &self,
        frame: &Frame<R>,
        contact: Contact,
        sense: Sense,
        load: Wrench<R>,
    ) -> bool {
        let cone = self.friction(contact).sliding;
        let (n, pull) = (-frame.n.dot(load.force), frame.t.dot(load.force));
        let excess = sense.along(pull) * cone.cos - cone.sin * n;
        n > R::ZERO && excess > R::of_drive(load.size())
    }
    /// Velocity and turn with which one contact begins to slide: t s, with the turn of its slip, which must be stable.
    #[inline(never)]
    fn slide_begins(
        &self,
        body: &Body<R>,
        frame: &Frame<R>,
        contact: usize,
        sense: Sense,
        load: Wrench<R>,
    ) -> Option<(Vec2<R>, R)> {
        if !self.is_driven(frame, body.contacts.get(contact), sense, load) {
            return None;
        }
        let s = sense.number::<R>();
        if frame.turns || self.grip.swings {
            let mut leading = *body;
            self.lead(&mut leading, contact);
            let i = self.placed_at_start(&Motion::slip(&leading, s));
            let turn = -i.e_p / i.e_u;
            return (i.e_u < R::ZERO).then(|| (i.g_p + i.g_u * turn, turn));
        }
        let r = frame.r;
        let b = body.rotation.apply(self.grip.centroid) * self.world.weight;
        let e_u = b.y - self.world.stiffness.value + r.dot(load.force - r);
        let turn = -(r.cross(frame.t) * s) / e_u;
        (e_u < R::ZERO).then(|| (frame.t * s - r.turned() * turn, turn))
    }
}
