//! Coulomb's law, in one place: no other file knows mu. A reaction N n + T t sticks while |T| <= mu_s N and slides with
//! |T| = mu_d N. Written with the angle of friction lambda = atan mu, so that mu from 0 to infinity is regular
//! (STATICS 10).

use crate::balance_curve::Margin;
use crate::geometry::{Vec2, normalized};
use crate::real::{Real, along};

/// An angle of friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cone<R> {
    sin: R,
    cos: R,
}

/// The state of the reaction of one contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Verdict<R> {
    /// Inside the static cone.
    Sticks,
    /// Pressed, and pushed sideways beyond the cone: slides along sign·t.
    Slides(R),
    /// Pulled off.
    Opens,
}

/// Static and dynamic friction of a surface, and its memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coulomb<R> {
    fixed: Cone<R>,
    sliding: Cone<R>,
    /// mu_s - mu_d
    drop: R,
    /// D_c: a shorter slip is not distinguished from a slide.
    memory: R,
    /// N* = D_c / (mu_s - mu_d): the normal reaction at and above which a contact has stiction.
    threshold: R,
}

/// The directions of a contact that slides along sign·t (STATICS 3.6), both of length 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SlidingEdge<R> {
    /// f cos(lambda), f = n - sign mu_d t: the direction of the reaction.
    pub(crate) reaction: Vec2<R>,
    /// e cos(lambda), e = t + sign mu_d n, perpendicular to f: no load remains along it.
    pub(crate) balanced: Vec2<R>,
    /// cos(lambda) and sign sin(lambda), lambda = atan mu_d.
    pub(crate) cos: R,
    pub(crate) sin: R,
}

impl<R: Real> Coulomb<R> {
    /// mu_s = mu_d = 0
    pub(crate) const FRICTIONLESS: Self = {
        let cone = Cone {
            sin: R::ZERO,
            cos: R::ONE,
        };
        Self {
            fixed: cone,
            sliding: cone,
            drop: R::ZERO,
            memory: R::ZERO,
            threshold: R::HUGE,
        }
    };

    /// From mu_s and mu_d, both 0 or more, and the memory length in body sizes; it is at least the shortest that the number types
    /// distinguish, 2^-19.
    pub(crate) fn from_coefficients(fixed: R::Si, sliding: R::Si, memory: R::Si) -> Self {
        let cone = |mu: R::Si| {
            let (cos, sin) = normalized(R::Si::ONE, mu);
            Cone {
                sin: R::from_si(sin, R::Si::ONE),
                cos: R::from_si(cos, R::Si::ONE),
            }
        };
        let nd = |x: R::Si| R::from_si(x, R::Si::ONE).min(R::HUGE);
        let memory = memory.max(R::MICRO.to_si(R::Si::ONE));
        let (drop, least) = drop_and_threshold(fixed, sliding, memory);
        // Coefficients that the number type does not distinguish count as one.
        let cones = [fixed, sliding].map(cone);
        let threshold = if cones[0] == cones[1] {
            R::HUGE
        } else {
            nd(least)
        };
        Self {
            fixed: cones[0],
            sliding: cones[1],
            drop: nd(drop),
            memory: nd(memory),
            threshold,
        }
    }

    fn cone(&self, stiction: bool) -> &Cone<R> {
        if stiction { &self.fixed } else { &self.sliding }
    }

    /// Returns whether a contact with this normal reaction has stiction (rule 3).
    pub(crate) fn is_pressed(&self, normal: R) -> bool {
        self.threshold < R::HUGE && normal >= self.threshold
    }

    /// Positive while the contact presses too little for stiction; `None` if there is no stiction.
    pub(crate) fn loosens(&self, normal: Margin<R>) -> Option<Margin<R>> {
        (self.threshold < R::HUGE).then(|| Margin {
            start: self.threshold - normal.start,
            along: -normal.along,
            turning: -normal.turning,
            rounding: normal.rounding,
        })
    }

    /// N*, beyond all numbers if there is no stiction.
    pub(crate) fn threshold(&self) -> R {
        self.threshold
    }

    /// D_c
    pub(crate) fn memory(&self) -> R {
        self.memory
    }

    /// mu_s - mu_d
    pub(crate) fn drop(&self) -> R {
        self.drop
    }

    /// The directions of a contact that slides along sign·t.
    pub(crate) fn sliding_along(
        &self,
        (normal, tangent): (Vec2<R>, Vec2<R>),
        sign: R,
    ) -> SlidingEdge<R> {
        let (cos, sin) = (self.sliding.cos, along(sign, self.sliding.sin));
        SlidingEdge {
            reaction: normal * cos - tangent * sin,
            balanced: tangent * cos + normal * sin,
            cos,
            sin,
        }
    }

    /// Positive while the contact, with stiction or without, does not break away along sign·t.
    pub(crate) fn holds(
        &self,
        (normal, friction): (Margin<R>, Margin<R>),
        stiction: bool,
        sign: R,
    ) -> Margin<R> {
        let (of_normal, of_friction) = self.holding(stiction, sign);
        normal.combine(of_normal, friction, of_friction)
    }

    /// The coefficients of N and T in [`Self::holds`].
    pub(crate) fn holding(&self, stiction: bool, sign: R) -> (R, R) {
        let cone = self.cone(stiction);
        (cone.sin, along(sign, cone.cos))
    }

    /// Positive while the contact slides on along sign·t: (E3) is its zero.
    pub(crate) fn drives(&self, normal: Margin<R>, friction: Margin<R>, sign: R) -> Margin<R> {
        normal.combine(-self.sliding.sin, friction, -along(sign, self.sliding.cos))
    }

    /// The direction q in which a force on the body drives a contact on along ±t: q·F is positive while it slides, (E3) its
    /// zero.
    pub(crate) fn drive(&self, normal: Vec2<R>, along: Vec2<R>) -> Vec2<R> {
        normal * self.sliding.sin + along * self.sliding.cos
    }

    /// True if a reaction lies inside the cone of a stick by more than `slack`, which is 0 or more.
    pub(crate) fn is_within(&self, (normal, friction): (R, R), stiction: bool, slack: R) -> bool {
        let cone = self.cone(stiction);
        // The depth is no larger than the normal force.
        R::difference_of_products(normal, cone.sin, friction.abs(), cone.cos) > slack
    }

    /// Judges a reaction of a stick, to within `rounding` of the forces.
    pub(crate) fn judge(
        &self,
        (normal, friction): (R, R),
        stiction: bool,
        rounding: R,
    ) -> Verdict<R> {
        let cone = self.cone(stiction);
        if normal < -rounding {
            return Verdict::Opens;
        }
        if friction.abs() * cone.cos - normal * cone.sin > rounding {
            Verdict::Slides(-friction.sign())
        } else {
            Verdict::Sticks
        }
    }

    /// True while a contact that slides along sign·t is driven on.
    pub(crate) fn is_driven(&self, normal: R, friction: R, sign: R, rounding: R) -> bool {
        -sign * friction * self.sliding.cos - normal * self.sliding.sin > rounding
    }

    /// The edge of the cone of a stick as (normal, friction) components: +1 for the one with friction along +t.
    pub(crate) fn edge(&self, stiction: bool, edge: R) -> (R, R) {
        let cone = self.cone(stiction);
        (cone.cos, along(edge, cone.sin))
    }

    /// The reaction of a contact that slides along sign·t, as (normal, friction) components; sign 0: no friction.
    pub(crate) fn sliding_edge(&self, sign: R) -> (R, R) {
        (self.sliding.cos, -self.sliding.sin * sign)
    }
}

/// mu_s - mu_d, and N* = D_c / (mu_s - mu_d).
fn drop_and_threshold<F: Real>(fixed: F, sliding: F, memory: F) -> (F, F) {
    let drop = fixed - sliding;
    (drop, memory / drop)
}

#[cfg(test)]
mod tests;
