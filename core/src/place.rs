//! Where a motion places the body, its load there, and their partial derivatives (STATICS 3).

use crate::frame::Foot;
use crate::geometry::{Rotation, Vec2};
use crate::motion::{Factor, Instant, Kind, Motion, Rates, Spot};
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::world::Statics;

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The body at a point of a motion.
    pub(crate) fn placed(&self, m: &Motion<R>, at: Spot<R>) -> Instant<R> {
        let mut instant = Instant::ZERO;
        self.place(m, at, None, &mut instant);
        instant
    }
    /// The body at the beginning of a motion in its angle, at p = 0.
    pub(crate) fn placed_at_start(&self, m: &Motion<R>) -> Instant<R> {
        let u = match m.kind {
            Kind::Line | Kind::Pair => R::ZERO,
            Kind::Free | Kind::Pin | Kind::Slide => m.angle,
        };
        self.placed(m, Spot { u, p: R::ZERO })
    }

    /// The body at a point of a motion, in place: with its rotation, if that is known.
    #[inline(never)]
    pub(crate) fn place(
        &self,
        m: &Motion<R>,
        at: Spot<R>,
        known: Option<Rotation<R>>,
        i: &mut Instant<R>,
    ) {
        self.place_inlined(m, at, known, i);
    }
    /// [`Self::place`], compiled into the caller: what it knows of the motion is decided there.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub(crate) fn place_inlined(
        &self,
        m: &Motion<R>,
        at: Spot<R>,
        known: Option<Rotation<R>>,
        i: &mut Instant<R>,
    ) {
        (i.u, i.placed, i.p) = (at.u, at.u, at.p);
        (i.g_u, i.g_p, i.r) = (Vec2::ZERO, Vec2::ZERO, Vec2::ZERO);
        (i.xi_u, i.xi_p, i.theta_u) = (R::ZERO, R::ZERO, R::ONE);
        i.foot = m.foot;
        i.angle = match m.kind {
            Kind::Line => {
                let pose = m.on_line(at.u);
                i.g = pose.at;
                pose.angle
            }
            Kind::Free | Kind::Pin | Kind::Slide => at.u,
            Kind::Pair => m.angle + m.pair.twist.y * at.u,
        };
        i.rotation = known.unwrap_or_else(|| Rotation::by(i.angle));
        let hand = m.hand_at(at.p);
        let pull = hand.at + self.weight_force();
        match m.kind {
            Kind::Line => {
                let way = m.line();
                (i.g_u, i.theta_u) = (way.at, way.angle);
            }
            Kind::Free => {
                i.g = pull;
                i.g_p = m.hand_p.at;
            }
            Kind::Pin => self.place_pin(m, i),
            Kind::Slide => self.place_slide(m, pull, i),
            Kind::Pair => self.place_pair(m, i),
        }
        self.weigh(m, (pull, hand.angle), i);
    }

    /// G = c - r, the foot moved by p.
    #[inline(always)]
    fn place_pin(&self, m: &Motion<R>, i: &mut Instant<R>) {
        i.foot = m.foot + m.foot_p * i.p;
        i.xi_p = m.foot_p;
        let foot = self.foot(m.first(), i.rotation, i.foot);
        i.r = foot.r;
        i.g = foot.c - foot.r;
        i.g_u = -foot.r.turned();
        if i.xi_p != R::ZERO {
            let frame = self.frame_inlined(m.first(), i.rotation, i.g);
            i.g_p = frame.t * i.xi_p;
        }
    }

    /// The foot where e·F = 0 (STATICS 3).
    #[inline(always)]
    fn place_slide(&self, m: &Motion<R>, pull: Vec2<R>, i: &mut Instant<R>) {
        let Foot { c, r } = self.foot(m.first(), i.rotation, m.foot);
        let frame = self.frame_inlined(m.first(), i.rotation, c - r);
        let edge = self.edge(m.first(), &frame);
        let delta = edge.e.dot(pull - c + r) / edge.cos;
        i.foot = m.foot + delta;
        i.xi_p = edge.e.dot(m.hand_p.at) / edge.cos;
        if frame.turns {
            i.xi_u = edge.e.turned().dot(pull - c) / edge.cos;
            i.r = r - frame.t * delta;
            i.g = c - i.r;
        } else {
            i.xi_u = edge.e.dot(r.turned()) / edge.cos;
            i.r = r;
            i.g = c + frame.t * delta - r;
        }
        i.g_u = frame.t * i.xi_u - i.r.turned();
        i.g_p = frame.t * i.xi_p;
    }

    /// F, M, and the residual of balance with its partial derivatives (STATICS 3).
    #[inline(always)]
    fn weigh(&self, m: &Motion<R>, (pull, phi): (Vec2<R>, R), i: &mut Instant<R>) {
        i.force = pull - i.g;
        // B, times w
        let b = i.rotation.apply(self.grip.centroid) * self.world.weight;
        i.moment = self.world.stiffness.of(phi - i.angle) - b.x;
        let m_theta = b.y - self.world.stiffness.value;
        let m_p = self.world.stiffness.of(m.hand_p.angle);
        let force_p = m.hand_p.at - i.g_p;
        match m.kind {
            Kind::Line => (i.e, i.e_u, i.e_p) = (R::ZERO, R::ZERO, R::ZERO),
            Kind::Free if self.grip.swings => self.keep_angle(m, i),
            Kind::Pin | Kind::Slide if self.is_held_there(m, i) => self.keep_angle(m, i),
            Kind::Slide if m.factor != Factor::Both => {
                // Another instant of what counts, so that a slide that follows no factor needs none in memory.
                let now = Instant {
                    rotation: i.rotation,
                    g: i.g,
                    r: i.r,
                    force: i.force,
                    ..Instant::ZERO
                };
                let of = (m.first(), m.factor);
                [i.e, i.e_u, i.e_p] = self.weigh_factor(of, &now, m.hand_p.at);
            }
            // The spring alone, however soft: in units of k_theta.
            Kind::Free if self.world.weight == R::ZERO => {
                (i.e, i.e_u, i.e_p) = (phi - i.angle, -R::ONE, m.hand_p.angle);
            }
            Kind::Free => (i.e, i.e_u, i.e_p) = (i.moment - m.lasting, m_theta, m_p),
            Kind::Pin | Kind::Slide => {
                let turns = self.turns(m.first());
                let r_u = if turns { -i.g_u } else { i.r.turned() };
                i.e = i.moment - i.r.cross(i.force) - m.lasting;
                i.e_u = m_theta - r_u.cross(i.force) + i.r.cross(i.g_u);
                i.e_p = m_p - i.r.cross(force_p);
                if turns {
                    // r_p = -G_p
                    i.e_p = i.e_p + i.g_p.cross(i.force);
                }
            }
            Kind::Pair => self.weigh_pair(m, m_theta, i),
        }
    }

    /// Velocities along the hand's path.
    pub(crate) fn rates(&self, m: &Motion<R>, i: &Instant<R>) -> Rates<R> {
        // u' = -E_p/E_u
        self.rates_of(m, i, -i.e_p / i.e_u, R::ONE)
    }
    /// Velocities with u and p.
    pub(crate) fn rates_of(&self, m: &Motion<R>, i: &Instant<R>, u: R, p: R) -> Rates<R> {
        let g = i.g_u * u + i.g_p * p;
        let theta = i.theta_u * u;
        let b = i.rotation.apply(self.grip.centroid) * self.world.weight;
        let m_theta = b.y - self.world.stiffness.value;
        Rates {
            u,
            p,
            g,
            theta,
            xi: i.xi_u * u + i.xi_p * p,
            force: m.hand_p.at * p - g,
            moment: self.world.stiffness.of(m.hand_p.angle) * p + m_theta * theta,
        }
    }

    /// E_up: E is linear in p, so its slope E_u is too (but for the slide of a C).
    #[inline(always)]
    pub(crate) fn e_up(&self, m: &Motion<R>, i: &Instant<R>) -> R {
        match m.kind {
            Kind::Line | Kind::Free => R::ZERO,
            Kind::Slide if m.factor != Factor::Both => self.e_up_factor(m, i),
            Kind::Pin | Kind::Slide if self.turns(m.first()) => {
                i.r.dot(m.hand_p.at) - i.g_p.dot(i.force - i.r)
            }
            Kind::Pin | Kind::Slide => i.r.dot(m.hand_p.at - i.g_p),
            Kind::Pair => self.e_up_pair(m, i),
        }
    }

    /// A Newton step of which only the first order matters.
    #[inline(always)]
    pub(crate) fn nudge(&self, m: &Motion<R>, i: &mut Instant<R>, u: R) {
        let turn = i.theta_u * u;
        let b = i.rotation.apply(self.grip.centroid) * self.world.weight;
        i.u = i.u + u;
        i.foot = i.foot + i.xi_u * u;
        i.angle = i.angle + turn;
        i.g = i.g + i.g_u * u;
        i.force = i.force - i.g_u * u;
        i.moment = i.moment + turn * (b.y - self.world.stiffness.value);
        if self.turns(m.first()) {
            i.r = i.r - i.g_u * u;
        } else {
            i.r = i.r + i.r.turned() * turn;
        }
        if m.kind == Kind::Pair {
            let [_, second] = m.contacts;
            i.r2 = if self.turns(second) {
                i.r2 - i.g_u * u
            } else {
                i.r2 + i.r2.turned() * turn
            };
        }
        i.rotation = i.rotation.nudged(turn);
        i.e = R::ZERO;
    }
    /// The first Newton step u of a frozen parameter towards balance, of second order for a turn about a fixed point.
    #[inline(always)]
    pub(crate) fn first_step(&self, m: &Motion<R>, i: &Instant<R>) -> R {
        let step = -i.e / i.e_u;
        if m.kind != Kind::Pin || self.turns(m.first()) {
            return step;
        }
        // E_uu
        let bend = self.world.weight * i.rotation.apply(self.grip.centroid).x + i.r.cross(i.force);
        step - step * step * bend / i.e_u.doubled()
    }
    /// The end of Newton's iteration again, where it was placed last.
    pub(crate) fn balance_again(&self, m: &Motion<R>, at: Spot<R>, i: &mut Instant<R>) {
        self.place(m, at, None, i);
        let step = -i.e / i.e_u;
        if R::is_last(step) {
            self.nudge(m, i, step);
        }
    }
    /// Newton's iteration to balance at a fixed p, from a spot with the first step of u known.
    #[inline(never)]
    pub(crate) fn balance(&self, m: &Motion<R>, from: Spot<R>, first: R, i: &mut Instant<R>) {
        let (mut u, mut step) = (from.u, first);
        for _ in 0..6 {
            u = u + step;
            self.place(m, Spot { u, ..from }, None, i);
            step = -i.e / i.e_u;
            if R::is_last(step) {
                return self.nudge(m, i, step);
            }
        }
    }
}
