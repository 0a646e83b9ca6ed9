//! The short slip (STATICS 3.5): the vertex slides a little and the body turns a little with it, in balance throughout, to (E3). Its
//! beginning alone proves that nothing else ends it, so an ordinary slip needs no search.

use crate::geometry::Vec2;
use crate::grip::Grip;
use crate::load::Load;
use crate::pivot::Pivot;
use crate::real::Real;
use crate::world::World;

/// A slip to (E3) on which nothing else happens.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShortSlip<R> {
    /// Along t.
    pub(super) slide: R,
    pub(super) turn: R,
    /// No point of the body moves farther towards a surface.
    pub(super) travel_bound: R,
    /// A gap that is larger than this at the end was open throughout.
    pub(super) open: R,
}

/// Newton's steps before a slip is no longer considered short.
const MAX_CORRECTIONS: usize = 4;

/// The error of a point of the slip: the balance of moments and (E3), by Newton's step.
struct Step<R> {
    /// |lever| / s: the most by which the body turns while it slides by 1.
    arm: R,
    /// |z| / s
    bend: R,
    /// M / s
    lack: R,
    /// The turn that goes with a slide by 1.
    lean: R,
    /// The decrease of the excess of the drive while the vertex slides by 1.
    decay: R,
    /// q·F, less the change with the turn `lack`.
    excess: R,
}

impl<R: Real> Step<R> {
    /// `along`: the direction of the slide; `drive`: q. `None` if it is not stable or the drive hardly falls.
    fn at(load: &Load<R>, along: Vec2<R>, drive: Vec2<R>) -> Option<Self> {
        let stability = load.stability();
        if stability <= R::ZERO {
            return None;
        }
        let per_stability = R::ONE / stability;
        if per_stability >= R::HUGE {
            return None;
        }
        let lack = load.moment() * per_stability;
        let lean = along.cross(load.lever) * per_stability;
        // dE/dtheta = -bite
        let bite = drive.dot(load.lever.turned());
        let decay = drive.dot(along) + bite * lean;
        (decay > R::HALF.halved()).then(|| Self {
            arm: load.lever.length_bound() * per_stability,
            bend: load.hold.length_bound() * per_stability,
            lack,
            lean,
            decay,
            excess: drive.dot(load.force) - bite * lack,
        })
    }

    /// The slide and the turn.
    fn correction(&self) -> (R, R) {
        let slide = self.excess / self.decay;
        (slide, self.lack + self.lean * slide)
    }
}

impl<R: Real> ShortSlip<R> {
    /// For a vertex in balance that breaks away along sign·t, with `load` the load on the body. If something else may happen (E9), an
    /// estimate of how far it slides, if its beginning permits one; touches are left to the caller.
    pub(super) fn find(
        scene: &impl World<R>,
        (pivot, load): (&Pivot<R>, &Load<R>),
        grip: &Grip<R>,
        sign: R,
    ) -> Result<Self, Option<R>> {
        let surface = pivot.surface(scene);
        let along = surface.tangent * sign;
        let drive = surface.friction.drive(surface.normal, along);
        let normal = |load: &Load<R>| -surface.normal.dot(load.force);
        let begin = Step::at(load, along, drive).ok_or(None)?;
        let (guess, _) = begin.correction();
        if guess < R::ZERO || begin.lack.abs() > R::MICRO {
            return Err(None);
        }
        let about = Err(Some(guess));
        // If it ends within these, the stability falls by less than a seventh on it.
        let farthest = guess + guess.halved().halved();
        let swing = begin.arm * farthest;
        let widest = swing + swing.halved().halved();
        let lever = load.lever.length_bound();
        let bend = begin.bend + R::from_int(3);
        // The decay changes by less than this; so does dN with the slide.
        let curved = (lever * begin.arm * swing * bend).doubled();
        let sixteenth = R::ONE / R::from_int(16);
        let is_short = load.is_representable()
            && swing <= sixteenth
            && begin.bend * swing <= sixteenth
            && curved <= begin.decay.min(R::ONE);
        if !is_short {
            return about;
        }
        let sagitta = curved * farthest + load.rounding();
        if normal(load) <= sagitta {
            return about;
        }
        let (mut slide, mut turn) = (guess, begin.lean * guess);
        for _ in 0..MAX_CORRECTIONS {
            let load = pivot.moved(sign * slide, turn).load(scene, grip);
            let Some(step) = Step::at(&load, along, drive) else {
                return about;
            };
            let (slide_on, turn_on) = step.correction();
            slide = slide + slide_on;
            turn = turn + turn_on;
            let size = slide_on.abs() + turn_on.abs();
            let left = size * size * (bend + begin.arm) * (R::ONE + lever) * (R::ONE + begin.arm);
            if left.doubled() <= R::EPSILON {
                let ends_within = slide >= R::ZERO && slide <= farthest && turn.abs() <= widest;
                let presses = normal(&load) > sagitta + lever * size;
                let slip = Self {
                    slide: sign * slide,
                    turn,
                    travel_bound: widest + farthest,
                    open: swing * swing * bend,
                };
                return if ends_within && presses {
                    Ok(slip)
                } else {
                    about
                };
            }
        }
        about
    }
}

#[cfg(test)]
mod tests;
