//! The calm frame (STATICS 3.4): the hand goes a short way and nothing happens, the body only turns a little about the
//! point that holds it. That this is certain follows from the balance at the end alone, which is why an ordinary frame
//! needs no search: path and frame evolution agree in it.

use crate::coupling::{Grip, Stance, Way};
use crate::geometry::{Orientation, Vec2};
use crate::motion::Bend;
use crate::real::Real;
use crate::roots::Moment;
use crate::scene::World;

/// A turn that keeps the balance all the way, and how much anything can stray on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Calm<R> {
    /// The body's after the turn.
    pub(crate) orientation: Orientation<R>,
    /// No turn on the way is larger (rad).
    pub(crate) reach: R,
    /// At least 1 over the stability anywhere on the way.
    per_least: R,
    /// At most |z| over the stability anywhere on the way.
    bend: R,
}

/// Corrections of the angle before a frame is not called calm.
const MAX_CORRECTIONS: usize = 4;

impl<R: Real> Calm<R> {
    /// About a pinned point, with the hand at the end `to` of its way: `stance` is the body's load there before it turns.
    pub(crate) fn pinned<B: Bend<R>>(
        scene: &impl World<R>,
        stance: &Stance<R>,
        to: &Grip<R>,
        way: &Way<R>,
    ) -> Option<Self> {
        let drive = stance.lever.conj_mul(way.hand);
        let moment = stance.pinned::<B>();
        Self::turn(&moment, drive, stance.placed.orientation, |orientation| {
            stance.turned(scene, orientation, to).pinned()
        })
    }

    /// With the hand at the end of its way: `moment` is that on the body in an orientation before it turns, balanced at the
    /// beginning, `drive` what the way adds to z, `then` the moment in another orientation. Nothing where the balance may
    /// fold or change much on the way (E8).
    pub(crate) fn turn<B: Bend<R>>(
        moment: &Moment<R, B>,
        drive: Vec2<R>,
        mut orientation: Orientation<R>,
        then: impl Fn(Orientation<R>) -> Moment<R, B>,
    ) -> Option<Self> {
        // The least stability and the largest |z| of the way.
        let least = moment.stability() - drive.x.max(R::ZERO);
        let pull = drive.reach();
        let size = moment.bent() + pull;
        if least <= R::ZERO || pull > least.halved() || !moment.is_carried() {
            return None;
        }
        let per_stability = R::ONE / moment.stability();
        // The stability is at most half as much again as the least one.
        let per_least = per_stability + per_stability.halved();
        if per_least >= R::HUGE {
            return None;
        }
        // Newton's step and how much the balance bends: with the condition of Kantorovich a balance is at most two steps
        // away.
        let quarter = R::HALF.halved();
        let (step, bend) = (moment.now().abs() * per_least + R::MICRO, size * per_least);
        if step > quarter || bend * step >= quarter {
            return None;
        }
        let reach = step.doubled();
        let calm = |orientation| Self {
            orientation,
            reach,
            per_least,
            bend,
        };
        if reach <= moment.tolerance {
            return Some(calm(orientation));
        }
        let mut turn = moment.correction(per_stability);
        for _ in 0..MAX_CORRECTIONS {
            orientation = orientation.plus(turn);
            // What is left is of the third order in the turn, (bend²/2 + bend/6) turn³.
            let bent = bend * turn.abs();
            let left = (bent * (bent + turn.abs()) * turn.abs()).halved();
            if left <= R::EPSILON.max(moment.tolerance) {
                return Some(calm(orientation));
            }
            let moment = then(orientation);
            turn = moment.correction(R::ONE / moment.stability());
        }
        None
    }

    /// By half of this times its lever a point strays at most from the straight line between the ends of its way: a bound
    /// of ϑ'² + |ϑ''| in tau.
    pub(crate) fn bow(&self, stance: &Stance<R>, way: &Way<R>) -> R {
        let drive = stance.lever.conj_mul(way.hand).reach() * self.per_least;
        let rate = drive + stance.stiffness * way.turn.abs() * self.per_least;
        rate * (rate + self.bend * rate + drive.doubled())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Angle;
    use crate::motion::Unbent;

    /// A balance at the end of the hand's way, and what the way added to z.
    #[derive(Clone, Copy, Debug)]
    struct Case {
        /// M with the body not yet turned.
        now: f64,
        stiffness: f64,
        hold: Vec2<f64>,
        drive: Vec2<f64>,
    }

    impl Case {
        /// The moment on a body that is turned by an angle.
        fn moment(&self, turn: f64) -> Moment<f64, Unbent> {
            let (sin, cos) = libm::sincos(turn);
            let Vec2 { x, y } = self.hold;
            Moment {
                couple: self.now - y - self.stiffness * turn,
                stiffness: self.stiffness,
                hold: Vec2::new(x * cos + y * sin, y * cos - x * sin),
                bend: Unbent,
                tolerance: 0.0,
            }
        }

        fn calm(&self) -> Option<Calm<f64>> {
            let start = Orientation::new(Angle::default());
            Calm::turn(&self.moment(0.0), self.drive, start, |orientation| {
                self.moment(orientation.angle().radians())
            })
        }

        /// z at a part of the way.
        fn hold(&self, part: f64) -> Vec2<f64> {
            self.hold - self.drive * (1.0 - part)
        }

        /// The balance next to the unturned body at a part of the way, by halving.
        fn balance(&self, part: f64, within: f64) -> f64 {
            let Vec2 { x, y } = self.hold(part);
            let load = |turn: f64| {
                let (sin, cos) = libm::sincos(turn);
                // The way begins in balance.
                self.now * part - self.stiffness * turn + y * (cos - 1.0) - x * sin
            };
            let (mut low, mut high) = (-within, within);
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                if load(middle) > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            0.5 * (low + high)
        }
    }

    /// Grips from soft to stiff, pulled and pushed, near the balance and far from it, ways to all sides.
    fn cases() -> impl Iterator<Item = Case> {
        let holds = [
            (0.0, 0.0),
            (1.0, 0.4),
            (-0.5, 0.3),
            (-0.9, -0.1),
            (3.0, -2.0),
        ];
        let moments = [0.0, 1e-9, -1e-4, 0.01, -0.05, 0.1, 0.2, -0.4];
        let ways = (0..8).flat_map(|i| [0.0, 0.02, 0.2, 0.4, 0.7].map(|size| (size, i)));
        let all = [0.1, 1.0]
            .into_iter()
            .flat_map(move |k| holds.map(|hold| (k, hold)));
        all.flat_map(move |(stiffness, (x, y))| {
            let ways = ways.clone();
            moments.into_iter().flat_map(move |now| {
                ways.clone().map(move |(size, i)| {
                    let (sin, cos) = libm::sincos(f64::from(i) * 0.7);
                    Case {
                        now,
                        stiffness,
                        hold: Vec2::new(x, y),
                        drive: Vec2::new(cos * size, sin * size),
                    }
                })
            })
        })
    }

    /// (E8): where its conditions hold amply the frame is calm, where one fails it is not.
    #[test]
    fn frame_is_calm_where_kantorovich_says_so() {
        let mut found = [0, 0];
        for case in cases() {
            let stability = case.stiffness + case.hold.x;
            let least = stability - case.drive.x.max(0.0);
            let (hold, pull) = (case.hold, case.drive);
            let (hold, pull) = (libm::hypot(hold.x, hold.y), libm::hypot(pull.x, pull.y));
            let (step, bend) = (case.now.abs() / least, (hold + pull) / least);
            let conditions = [pull / least * 2.0, step * 4.0, bend * step * 4.0];
            let most = conditions.iter().fold(0.0, |a: f64, b| a.max(*b));
            let calm = case.calm().is_some();
            if least <= 0.0 || most > 1.0 {
                assert!(!calm, "{case:?}");
            } else if most <= 0.4 {
                assert!(calm, "{case:?}");
            }
            found[usize::from(calm)] += 1;
        }
        assert!(found.iter().all(|count| *count > 100), "{found:?}");
    }

    /// All the way there is a stable balance within what the calm frame promises, and it ends in that at the end.
    #[test]
    fn calm_turn_keeps_the_balance_and_its_bounds() {
        for case in cases() {
            let Some(calm) = case.calm() else { continue };
            let end = calm.orientation.angle().radians();
            assert!((end - case.balance(1.0, 0.6)).abs() < 1e-12, "{case:?}");
            for i in 0..=10 {
                let part = f64::from(i) / 10.0;
                let (turn, hold) = (case.balance(part, 0.6), case.hold(part));
                assert!(turn.abs() <= calm.reach * part + 1e-12, "{case:?}");
                let (sin, cos) = libm::sincos(turn);
                let stability = case.stiffness + hold.x * cos + hold.y * sin;
                assert!(stability * calm.per_least >= 1.0 - 1e-12, "{case:?}");
                let size = libm::hypot(hold.x, hold.y);
                assert!(size <= calm.bend * stability * (1.0 + 1e-12), "{case:?}");
            }
        }
    }
}
