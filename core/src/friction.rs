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
            let (cos, sin) = normalized(R::Si::ONE, mu);
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
        normal.combine(self.fixed.sin, friction, along(sign, self.fixed.cos))
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

    /// True if a reaction lies inside the static cone by more than `slack`, 0 or more.
    pub(crate) fn is_within(&self, normal: R, friction: R, slack: R) -> bool {
        // No deeper than the normal force is large.
        R::difference_of_products(normal, self.fixed.sin, friction.abs(), self.fixed.cos) > slack
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
        (self.fixed.cos, along(edge, self.fixed.sin))
    }

    /// The reaction of a contact that slides along sign·t, as (normal, friction) parts; sign 0: no friction.
    pub(crate) fn sliding_edge(&self, sign: R) -> (R, R) {
        (self.sliding.cos, -self.sliding.sin * sign)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cone of a line, and one of a half-plane: cosine and sine are 1 and 0 to the last bit.
    fn extremes() -> [Coulomb<f64>; 2] {
        [0.0, 1e300].map(|mu| Coulomb::from_coefficients(mu, mu))
    }

    #[test]
    fn within_is_by_more_than_the_slack() {
        let [smooth, rough] = extremes();
        for slack in [0.0_f64, 0.25] {
            assert!(rough.is_within(slack.next_up(), 0.0, slack));
            assert!(!rough.is_within(slack, 0.0, slack));
            assert!(!rough.is_within(-1.0, 0.0, slack));
            assert!(!smooth.is_within(1.0, 0.0, slack), "on both edges");
        }
        let half = Coulomb::<f64>::from_coefficients(0.5, 0.25);
        assert!(half.is_within(1.0, 0.49, 0.0) && !half.is_within(1.0, -0.51, 0.0));
    }

    #[test]
    fn verdict_is_to_within_the_rounding() {
        let [smooth, rough] = extremes();
        let rounding = 0.125_f64;
        let more = rounding.next_up();
        assert_eq!(smooth.judge(-rounding, 0.0, rounding), Verdict::Sticks);
        assert_eq!(smooth.judge(-more, 0.0, rounding), Verdict::Opens);
        for sign in [1.0, -1.0] {
            let judged = |friction: f64| smooth.judge(0.0, sign * friction, rounding);
            assert_eq!(judged(rounding), Verdict::Sticks);
            assert_eq!(judged(more), Verdict::Slides(-sign));
            // Against friction to the one side it slides to the other.
            let driven = |friction: f64| smooth.is_driven(0.0, -sign * friction, sign, rounding);
            assert!(!driven(rounding) && driven(more) && !driven(-more));
        }
        assert_eq!(rough.judge(1.0, 1e3, rounding), Verdict::Sticks);
    }

    /// T = mu N on the edges of the cones, along the sign where it holds and against it where it slides; none without a sign.
    #[test]
    fn edges_bear_friction_in_proportion() {
        let friction = Coulomb::<f64>::from_coefficients(0.75, 0.5);
        for sign in [1.0, -1.0] {
            let (normal, along) = friction.static_edge(sign);
            assert!((along - sign * 0.75 * normal).abs() < 1e-15);
            let (normal, along) = friction.sliding_edge(sign);
            assert!((along + sign * 0.5 * normal).abs() < 1e-15);
            let margin = |start| Margin {
                start,
                along: 0.0,
                turning: Vec2::ZERO,
                rounding: 0.0,
            };
            let holds = |t: f64| friction.holds(margin(1.0), margin(t), sign).start;
            assert!(holds(-0.74 * sign) > 0.0 && holds(-0.76 * sign) < 0.0);
            let drives = |t: f64| friction.drives(margin(1.0), margin(t), sign).start;
            assert!(drives(-0.51 * sign) > 0.0 && drives(-0.49 * sign) < 0.0);
        }
        assert_eq!(friction.sliding_edge(0.0).1, 0.0);
    }
}
