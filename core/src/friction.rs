//! Coulomb's law, in one place: no other file knows mu. A reaction N n + T t sticks while |T| <= mu_s N and slides with
//! |T| = mu_d N. Written with the angle of friction lambda = atan mu, so that mu from 0 to infinity is regular
//! (STATICS 10).

use crate::geometry::{Vec2, unit};
use crate::motion::Margin;
use crate::real::Real;

/// An angle of friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cone<R> {
    sin: R,
    cos: R,
}

/// Where the reaction of one contact stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Verdict<R> {
    /// Inside the static cone.
    Sticks,
    /// Pressed, and pushed sideways beyond the cone: slides along sign·t.
    Slides(R),
    /// Pulled off.
    Opens,
}

/// Static and dynamic friction of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coulomb<R> {
    fixed: Cone<R>,
    sliding: Cone<R>,
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
        }
    };

    /// From mu_s and mu_d, both 0 or more.
    pub(crate) fn from_coefficients(fixed: R::Si, sliding: R::Si) -> Self {
        let cone = |mu: R::Si| {
            let (cos, sin) = unit(R::Si::ONE, mu);
            Cone {
                sin: R::from_si(sin, R::Si::ONE),
                cos: R::from_si(cos, R::Si::ONE),
            }
        };
        Self {
            fixed: cone(fixed),
            sliding: cone(sliding),
        }
    }

    /// mu_s = mu_d: slides without jumps.
    pub(crate) fn is_continuous(&self) -> bool {
        self.fixed == self.sliding
    }

    /// Positive while the contact does not break away along sign·t.
    pub(crate) fn holds(&self, normal: Margin<R>, friction: Margin<R>, sign: R) -> Margin<R> {
        normal.combine(self.fixed.sin, friction, self.fixed.cos * sign)
    }

    /// Positive while the contact slides on along sign·t: (E3) is its zero.
    pub(crate) fn drives(&self, normal: Margin<R>, friction: Margin<R>, sign: R) -> Margin<R> {
        normal.combine(-self.sliding.sin, friction, -self.sliding.cos * sign)
    }

    /// The direction q in which a force on the body drives a contact on along ±t: q·F is positive while it slides, (E3) its
    /// zero.
    pub(crate) fn drive(&self, normal: Vec2<R>, along: Vec2<R>) -> Vec2<R> {
        normal * self.sliding.sin + along * self.sliding.cos
    }

    /// True if a reaction lies inside the static cone by more than `slack`.
    pub(crate) fn is_within(&self, normal: R, friction: R, slack: R) -> bool {
        let depth =
            R::difference_of_products(normal, self.fixed.sin, friction.abs(), self.fixed.cos);
        normal > slack && depth > slack
    }

    /// The static test of a reaction, to within `rounding` of the forces.
    pub(crate) fn judge(&self, normal: R, friction: R, rounding: R) -> Verdict<R> {
        if normal < -rounding {
            return Verdict::Opens;
        }
        if friction.abs() * self.fixed.cos - normal * self.fixed.sin > rounding {
            Verdict::Slides(-friction.sign())
        } else {
            Verdict::Sticks
        }
    }

    /// True while a contact that slides along sign·t is driven on.
    pub(crate) fn is_driven(&self, normal: R, friction: R, sign: R, rounding: R) -> bool {
        -sign * friction * self.sliding.cos - normal * self.sliding.sin > rounding
    }

    /// The edge of the static cone as (normal, friction) parts: +1 the one with friction along +t.
    pub(crate) fn static_edge(&self, edge: R) -> (R, R) {
        (self.fixed.cos, self.fixed.sin * edge)
    }

    /// The reaction of a contact that slides along sign·t, as (normal, friction) parts; sign 0: no friction.
    pub(crate) fn sliding_edge(&self, sign: R) -> (R, R) {
        (self.sliding.cos, -self.sliding.sin * sign)
    }
}
