//! The inputs and results of the verbs of the contact states (STATICS 7): on what terms a state comes to balance, why a verb ended, how far
//! it moved; and how a pose is seated on its contacts.

use crate::contact::Pair;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::work::Work;
use crate::world::World;

/// Why a verb ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Trigger<R> {
    /// At rest within all friction cones; for `advance`: the hand has arrived.
    Balanced,
    /// The rotation branch ends here; it goes on in the direction of the sign.
    Fold(R),
    /// A vertex reached a surface.
    Touch(Pair),
    /// Friction gives way along sign·t of the (first) surface.
    Slide(R),
    /// The slip ended at mu_d N.
    Stopped,
    /// The normal reaction has risen to N*: a sticking contact gains stiction, a sliding one sticks (rule 3).
    Pressed,
    /// The foot of a slide comes to a halt (rule 7).
    Halts,
    /// The lever of a body that swings has come to lie on the edge of the friction cone (STATICS 3.7).
    Bears,
    /// Only these contacts (by number, twice the same for one) last; the others open. With a sign the first one slides
    /// along sign·t.
    Keep {
        contacts: [usize; 2],
        sliding: Option<R>,
    },
    /// Contact number `contact`, which slides along sign·t, has left its side; with the sign 0, the body has turned about it, at the end of
    /// a side, to the end of what supports it. The contact is passed on (STATICS 12.4).
    Off { contact: usize, sign: R },
    /// All contacts open.
    Clear,
    /// No motion is driven although friction gives way.
    Undriven,
    /// Nothing has happened so far: the verb goes on from the present pose.
    GoesOn,
}

/// How a state comes to balance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Relax<R> {
    /// The direction in which the first contact is already in motion.
    pub(crate) sliding: Option<R>,
    /// The number of motions of these contacts that were tried without moving the body.
    pub(crate) tried: usize,
}

/// The outcome of a verb, which has moved the state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moved<R> {
    pub(crate) trigger: Trigger<R>,
    /// The fraction of the hand's path that is done (`advance`).
    pub(crate) part: R,
    /// How far a contact slid (`slip`).
    pub(crate) slip: R,
    /// The body turned over a fold (`relax`).
    pub(crate) snapped: bool,
    /// A search hit its bound.
    pub(crate) unsure: bool,
    /// A slip did not end in balance: one that began out of balance, when another contact opened, or one that was blocked.
    pub(crate) unbalanced: bool,
    /// Its cost in addition to the base cost of every verb of its kind, in units of work.
    pub(crate) work: u32,
}

impl<R: Real> Moved<R> {
    pub(crate) fn by(trigger: Trigger<R>) -> Self {
        Self {
            trigger,
            part: R::ONE,
            slip: R::ZERO,
            snapped: false,
            unsure: false,
            unbalanced: false,
            work: 0,
        }
    }

    /// Adds the work that occurs among obstacles only.
    pub(crate) fn after<W: World<R>>(self, _: &W, work: Work) -> Self {
        if !W::CORNERS {
            return self;
        }
        Self {
            work: self.work.saturating_add(work.done()),
            ..self
        }
    }
}

/// Turns (or, if that does not help, shifts) a pose with some gaps closed to within a tolerance so that they are closed to the rounding, or
/// as far as 16 sweeps over them achieve. The pivot's foot stays unless the other contacts leave no choice.
pub(crate) fn seat<R: Real, W: World<R>>(scene: &W, pivot: Pivot<R>, others: &[Pair]) -> Pivot<R> {
    let pivot = close_gaps(scene, pivot, (others, others.len() == 1));
    match *others {
        [other] if W::CORNERS && other.is_corner() != pivot.contact.is_corner() => {
            lay_flat(scene, pivot, other)
        }
        _ => pivot,
    }
}

/// If a vertex and a corner are so close to each other that their gaps do not determine the tilt of their sides, they are collinear.
fn lay_flat<R: Real>(scene: &impl World<R>, pivot: Pivot<R>, other: Pair) -> Pivot<R> {
    let placed = pivot.placed(scene);
    let rotation = placed.orientation.rotation();
    let [first, second] = [pivot.contact, other].map(|pair| scene.face(pair, rotation).normal);
    let tilt = first.cross(second);
    let off = tilt.abs() * placed.arm_to(scene, other).length_bound();
    let is_certain = off > placed.rounding().doubled() || tilt.abs() > R::snapped_flat();
    if is_certain || first.dot(second) < R::ZERO {
        return pivot;
    }
    // The normal of the corner turns with the body.
    let turn = if other.is_corner() { -tilt } else { tilt };
    pivot.moved(R::ZERO, turn)
}

/// Seats a pose on one more contact after a motion in which the pivot's foot slides: it is shifted and turned by the least displacement
/// that closes the gap.
pub(crate) fn seat_sliding<R: Real>(
    scene: &impl World<R>,
    pivot: Pivot<R>,
    other: Pair,
) -> Pivot<R> {
    close_gaps(scene, pivot, (&[other], false))
}

/// Closes the gaps of the other contacts to the rounding in sweeps of Newton's steps: by a turn about the pivot if its foot stays and the
/// lever suffices, otherwise by the least slide and turn.
fn close_gaps<R: Real>(
    scene: &impl World<R>,
    mut pivot: Pivot<R>,
    (others, foot_stays): (&[Pair], bool),
) -> Pivot<R> {
    const SWEEPS: usize = 16;
    let least = R::divisor();
    for _ in 0..SWEEPS {
        let mut is_seated = true;
        for &other in others {
            let placed = pivot.placed(scene);
            let gap = placed.gap(scene, other);
            if gap.abs() <= R::EPSILON {
                continue;
            }
            is_seated = false;
            let normal = scene.face(other, placed.orientation.rotation()).normal;
            let by_turn = normal.dot(placed.arm_to(scene, other).turned());
            let by_shift = normal.dot(pivot.surface(scene).tangent);
            pivot = if foot_stays && by_turn.abs() > least {
                pivot.moved(R::ZERO, -gap / by_turn)
            } else {
                let size = by_turn * by_turn + by_shift * by_shift;
                if size > least * least {
                    pivot.moved(-gap * by_shift / size, -gap * by_turn / size)
                } else {
                    pivot
                }
            };
        }
        if is_seated {
            break;
        }
    }
    pivot
}
