//! Two contacts that slide together: placement, balance, velocities of the feet, shares of the load (STATICS 3). Moments about the first
//! contact.

use crate::contact::Sense;
use crate::couple::Couple;
use crate::frame::Frame;
use crate::geometry::{Rotation, Vec2, Wrench};
use crate::motion::{Instant, Kind, Motion, Pair, Spot};
use crate::real::Real;
use crate::state::{Body, HandPose, gap_slope};
use crate::thresholds::Thresholds;
use crate::world::Statics;

/// The normal reactions of a pair, and the drag along the motion that takes up what is not balanced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shares<R> {
    pub(crate) normal: [R; 2],
    pub(crate) drag: R,
    /// What the normal reactions are known to: over a short lever a moment tells little.
    pub(crate) known: R,
}

impl<R: Real> Shares<R> {
    /// No contact is pulled by more than a touch and what the reactions are known to.
    pub(crate) fn press(&self) -> bool {
        self.press_within(R::TOUCH + self.known)
    }
    /// No contact is pulled by more than `little`.
    pub(crate) fn press_within(&self, little: R) -> bool {
        self.normal.iter().all(|&n| n >= -little)
    }
}

/// det(a, b, c) of wrenches about the first contact, the first of which is a force through it: (f, 0).
fn through_first<R: Real>(f: Vec2<R>, b: Wrench<R>, c: Wrench<R>) -> R {
    R::difference_of_products(f.cross(b.force), c.moment, f.cross(c.force), b.moment)
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The slide of the body's first two contacts, with given contacts' friction, in the direction of `sense` (1 or -1) times (g_y, -g_x).
    pub(crate) fn pair(&self, body: &Body<R>, hand_p: HandPose<R>, sense: R) -> Motion<R> {
        let frames = self.frames(body.contacts.pair(), body.rotation, body.holding);
        self.pair_of(body, hand_p, sense, &frames)
    }
    /// [`Self::pair`], with the frames of both contacts.
    pub(crate) fn pair_of(
        &self,
        body: &Body<R>,
        hand_p: HandPose<R>,
        sense: R,
        frames: &[Frame<R>; 2],
    ) -> Motion<R> {
        let mut m = Motion::new(Kind::Pair, body, hand_p);
        let [first, second] = frames;
        let [c1, c2] = m.contacts;
        let g = gap_slope(frames);
        let slope = g.length();
        let twist = Vec2::new(g.y, -g.x) * (sense / slope);
        let apart = (second.r - first.r).length_bound();
        // Of one kind only a turn changes g: between parallel normals there is none, however far they slide.
        let bend = if first.turns == second.turns {
            apart * (twist.y.abs() + twist.y.abs().halved().halved()).min(R::ONE)
        } else {
            apart + R::ONE + R::HALF.halved()
        };
        let line = self.is_in_line(c1, c2);
        m.pair = Pair {
            twist,
            flip: R::ONE,
            slope,
            reach: if line || bend == R::ZERO {
                R::HUGE
            } else {
                slope / (bend * R::from_int(5))
            },
            line,
            even: line && self.has_one_friction(c1, c2),
            spread: false,
            pressed: true,
        };
        let v = self.feet_ahead(&m, frames);
        for (contact, v) in m.contacts.iter_mut().zip(v) {
            contact.sense = if v.abs() > R::standstill() {
                Sense::of(v)
            } else {
                Sense::Rests
            };
        }
        // No foot stands still for long: then its sense is known.
        if m.contacts.iter().any(|contact| !contact.sense.slides()) {
            m.pair.reach = m.pair.reach.min(R::ahead());
        }
        m.pair.flip = self.flip(&m, frames, v);
        let [c1, c2] = m.contacts;
        let sine = self.edge(c1, first).f.cross(self.edge(c2, second).f);
        m.pair.spread = sine.abs() >= R::spread();
        m
    }
    /// v_k at the beginning of a pair; where a slide turns back those just ahead, against which friction acts.
    fn feet_ahead(&self, m: &Motion<R>, frames: &[Frame<R>; 2]) -> [R; 2] {
        let ([first, _], twist, slope) = (frames, m.pair.twist, m.pair.slope);
        let g_u = first.t * twist.x - first.r.turned() * twist.y;
        let v = frames.map(|frame| frame.advance(g_u, twist.y));
        let [v1, v2] = v;
        let slower = v1.abs().min(v2.abs());
        if slower > R::standstill() && slower * slope >= R::of_turn() {
            return v;
        }
        let ahead = Spot {
            u: R::ahead(),
            p: R::ZERO,
        };
        self.feet(m, &self.placed(m, ahead))
    }
    /// The sign of E such that E > 0 drives: that of the product of X = w_1×w_2 and the drag's opposite.
    fn flip(&self, m: &Motion<R>, [first, second]: &[Frame<R>; 2], v: [R; 2]) -> R {
        let [c1, c2] = m.contacts;
        let [v1, v2] = v;
        let r12 = second.r - first.r;
        let f1 = self.edge(c1, first).f;
        let w2 = if m.pair.even {
            Wrench::COUPLE
        } else {
            Wrench::at(r12, self.edge(c2, second).f)
        };
        let along = Wrench {
            force: first.t * v1 + second.t * v2,
            moment: r12.cross(second.t) * v2,
        };
        if through_first(f1, w2, along) < R::ZERO {
            -R::ONE
        } else {
            R::ONE
        }
    }
    /// The pair in the direction in which its first contact slides in a sense.
    pub(crate) fn pair_along(
        &self,
        body: &Body<R>,
        hand_p: HandPose<R>,
        sense: Sense,
    ) -> Motion<R> {
        let m = self.pair(body, hand_p, R::ONE);
        if m.first().sense == sense {
            m
        } else {
            self.pair(body, hand_p, -R::ONE)
        }
    }

    /// (foot, angle) = tau u + (i tau) y, with y from Newton's iteration on the second gap; the angle is that of tau u so far.
    #[inline(never)]
    pub(crate) fn place_pair(&self, m: &Motion<R>, i: &mut Instant<R>) {
        if !self.has_pairs() {
            return;
        }
        let tau = m.pair.twist;
        let [c1, c2] = m.contacts;
        i.foot = m.foot + tau.x * i.u;
        let mut tangent = tau;
        for _ in 0..4 {
            // A vertex and a corner slide to each other: where they meet the second gap tells nothing of the angle.
            if m.pair.line && c1.is_corner() != c2.is_corner() {
                break;
            }
            let (c, frames) = self.seat_first(m, i);
            let g = gap_slope(&frames);
            // d gap/dy = g·(i tau); z_u = (g_y, -g_x)/D
            let across = R::ONE / g.dot(tau.turned());
            let y = -(self.gap_beside([c1, c2], c, i.rotation, i.g) * across);
            tangent = Vec2::new(g.y, -g.x) * across;
            let turn = tau.x * y;
            i.foot = i.foot - tau.y * y;
            i.angle = i.angle + turn;
            if R::is_last(y) {
                i.rotation = i.rotation.nudged(turn);
                break;
            }
            i.rotation = Rotation::by(i.angle);
        }
        let (_, [first, second]) = self.seat_first(m, i);
        i.r2 = second.r;
        (i.xi_u, i.theta_u) = (tangent.x, tangent.y);
        i.g_u = first.t * tangent.x - first.r.turned() * tangent.y;
    }
    /// The holding point from foot and rotation of the first contact; its point, the frames there.
    fn seat_first(&self, m: &Motion<R>, i: &mut Instant<R>) -> (Vec2<R>, [Frame<R>; 2]) {
        let foot = self.foot(m.first(), i.rotation, i.foot);
        (i.g, i.r) = (foot.c - foot.r, foot.r);
        let [c1, c2] = m.contacts;
        let frames = [c1, c2].map(|c| self.frame_inlined(c, i.rotation, i.g));
        (foot.c, self.levelled(m.contacts, frames))
    }

    /// w_2 and its derivative by u: (f_2, r12×f_2). Two contacts in one line with one friction bear any couple, however near they are to each
    /// other: there a couple of 1.
    fn second(&self, m: &Motion<R>, k: &Couple<R>) -> [Wrench<R>; 2] {
        if m.pair.even {
            return [Wrench::COUPLE, Wrench::ZERO];
        }
        let ([_, f2], [_, f2_u], [r1_u, r2_u]) = (k.f, k.f_u, k.r_u);
        let moment_u = (r2_u - r1_u).cross(f2) + k.r12.cross(f2_u);
        [
            Wrench::at(k.r12, f2),
            Wrench {
                force: f2_u,
                moment: moment_u,
            },
        ]
    }
    /// E = (f_1×f_2) M_1 - (r12×f_2)(f_1×F), M_1 = M - r_1×F, with its partial derivatives; in one line with [`Self::second`] (E7).
    #[inline(never)]
    pub(crate) fn weigh_pair(&self, m: &Motion<R>, m_theta: R, i: &mut Instant<R>) {
        if !self.has_pairs() {
            return;
        }
        let k = self.couple_inlined(m, i);
        let ([f1, _], [f1_u, _], [r1_u, _]) = (k.f, k.f_u, k.r_u);
        let [w2, w2_u] = self.second(m, &k);
        let (spread, arm, side) = (f1.cross(w2.force), w2.moment, f1.cross(i.force));
        let m1 = i.moment - i.r.cross(i.force);
        let spread_u = f1_u.cross(w2.force) + f1.cross(w2_u.force);
        let arm_u = w2_u.moment;
        let side_u = f1_u.cross(i.force) - f1.cross(i.g_u);
        let m1_u = i.theta_u * m_theta - r1_u.cross(i.force) + i.r.cross(i.g_u);
        let h_p = m.hand_p.at;
        let m1_p = self.world.stiffness.of(m.hand_p.angle) - i.r.cross(h_p);
        let flip = m.pair.flip;
        i.e = (spread * m1 - arm * side) * flip;
        i.e_u = (spread * m1_u + spread_u * m1 - arm_u * side - arm * side_u) * flip;
        i.e_p = (spread * m1_p - arm * f1.cross(h_p)) * flip;
    }
    /// E_up of a pair.
    #[inline(never)]
    pub(crate) fn e_up_pair(&self, m: &Motion<R>, i: &Instant<R>) -> R {
        if !self.has_pairs() {
            return R::ZERO;
        }
        let k = self.couple(m, i);
        let ([f1, _], [f1_u, _], [r1_u, _]) = (k.f, k.f_u, k.r_u);
        let [w2, w2_u] = self.second(m, &k);
        let h_p = m.hand_p.at;
        let m1_p = self.world.stiffness.of(m.hand_p.angle) - i.r.cross(h_p);
        let spread_u = f1_u.cross(w2.force) + f1.cross(w2_u.force);
        let e_up = spread_u * m1_p
            - f1.cross(w2.force) * r1_u.cross(h_p)
            - w2_u.moment * f1.cross(h_p)
            - w2.moment * f1_u.cross(h_p);
        e_up * m.pair.flip
    }

    /// v_k: the velocities of both feet along t, per u.
    pub(crate) fn feet(&self, m: &Motion<R>, i: &Instant<R>) -> [R; 2] {
        let k = self.couple(m, i);
        k.frames.map(|frame| frame.advance(i.g_u, i.theta_u))
    }
    /// The normal reactions that bear the load; out of balance a drag at both contacts against their velocities takes up the excess.
    pub(crate) fn shares(&self, m: &Motion<R>, i: &Instant<R>) -> Shares<R> {
        self.shares_of(m, i, &self.couple(m, i))
    }
    fn shares_of(&self, m: &Motion<R>, i: &Instant<R>, k: &Couple<R>) -> Shares<R> {
        let [f1, f2] = k.f;
        let [first, second] = &k.frames;
        let [v1, v2] = k.frames.map(|frame| frame.advance(i.g_u, i.theta_u));
        let w2 = Wrench::at(k.r12, f2);
        let drag = Wrench {
            force: -(first.t * v1 + second.t * v2),
            moment: -(k.r12.cross(second.t) * v2),
        };
        // What they have to bear.
        let borne = Wrench {
            force: -i.force,
            moment: i.r.cross(i.force) - i.moment,
        };
        let full = through_first(f1, w2, drag);
        let [cos1, cos2] = m.contacts.map(|c| self.friction(c).sliding.cos);
        let load = i.force.length_bound().max(i.moment.abs());
        Shares {
            known: R::of_balance(load) * drag.size() / full.abs(),
            normal: [
                w2.cross(drag).dot(borne) / full * cos1,
                through_first(f1, borne, drag) / full * cos2,
            ],
            drag: through_first(f1, w2, borne) / full,
        }
    }
    /// D_c less the length of the slip that would begin here (E21), the less one of the feet that can have stiction.
    pub(crate) fn room_to_stiction(&self, m: &Motion<R>, i: &Instant<R>, k: &Couple<R>) -> R {
        let [f1, f2] = k.f;
        let w2 = Wrench::at(k.r12, f2);
        let mut sum = R::ZERO;
        let normal = self.shares_of(m, i, k).normal;
        let levers = [Vec2::ZERO, k.r12];
        for (((contact, frame), n), lever) in
            m.contacts.iter().zip(&k.frames).zip(normal).zip(levers)
        {
            let product = through_first(f1, w2, Wrench::at(lever, frame.t)) * m.pair.flip;
            sum = sum
                + contact
                    .sense
                    .along(self.friction(*contact).drop * n * product);
        }
        let scale = sum / -i.e_u;
        let rooms = m.contacts.iter().zip(&k.frames).map(|(contact, frame)| {
            let friction = self.friction(*contact);
            if friction.threshold < R::HUGE {
                friction.memory - frame.advance(i.g_u, i.theta_u).abs() * scale
            } else {
                R::HUGE
            }
        });
        rooms.fold(R::HUGE, R::min)
    }
    /// N of two contacts in one line together.
    pub(crate) fn normal_of_edge(&self, m: &Motion<R>, i: &Instant<R>) -> R {
        -self.frame(m.first(), i.rotation, i.g).n.dot(i.force)
    }
    /// The pair has enough to its stiction: N rises to N* in one line, a slip would be as long as D_c otherwise.
    pub(crate) fn has_stiction(&self, m: &Motion<R>, i: &Instant<R>) -> bool {
        if m.pair.even {
            self.friction(m.first())
                .is_pressed(self.normal_of_edge(m, i))
        } else {
            self.room_to_stiction(m, i, &self.couple(m, i)) <= R::ZERO
        }
    }
}
