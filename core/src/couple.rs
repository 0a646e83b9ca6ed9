//! Two contacts at an instant of a pair: directions and levers, and how they change along u.

use crate::contact::{Contact, Feature};
use crate::frame::Frame;
use crate::geometry::Vec2;
use crate::motion::{Instant, Motion};
use crate::real::Real;
use crate::values::Moving;
use crate::world::Statics;

/// Two contacts at an instant, with what changes along u.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Couple<R> {
    pub(crate) frames: [Frame<R>; 2],
    /// The directions of the two reactions, of length 1.
    pub(crate) f: [Vec2<R>; 2],
    /// Their derivatives by u, and those of the levers.
    pub(crate) f_u: [Vec2<R>; 2],
    pub(crate) r_u: [Vec2<R>; 2],
    /// From the first contact to the second.
    pub(crate) r12: Vec2<R>,
}

impl<R: Real> Couple<R> {
    /// r12 along x, if u' is the velocity of u.
    pub(crate) fn arm(&self, u: R) -> Moving<R> {
        let [r1_u, r2_u] = self.r_u;
        Moving {
            at: self.r12,
            rate: (r2_u - r1_u) * u,
        }
    }
    /// f_1, f_2 along x.
    pub(crate) fn directions(&self, u: R) -> [Moving<R>; 2] {
        let [f1, f2] = self.f;
        let [f1_u, f2_u] = self.f_u;
        [(f1, f1_u), (f2, f2_u)].map(|(at, f_u)| Moving { at, rate: f_u * u })
    }
    /// r_1, r_2 along x.
    pub(crate) fn levers(&self, u: R) -> [Moving<R>; 2] {
        let [first, second] = &self.frames;
        let [r1_u, r2_u] = self.r_u;
        [(first.r, r1_u), (second.r, r2_u)].map(|(at, r_u)| Moving { at, rate: r_u * u })
    }
    /// t_1, t_2 along x, if theta' is the velocity of the angle.
    pub(crate) fn tangents(&self, theta: R) -> [Moving<R>; 2] {
        let [first, second] = &self.frames;
        [first, second].map(|frame| Moving {
            at: frame.t,
            rate: if frame.turns {
                frame.t.turned() * theta
            } else {
                Vec2::ZERO
            },
        })
    }
}

impl<R: Real, const V: usize, const S: usize, const C: usize> Statics<'_, R, V, S, C> {
    /// The two contacts at an instant.
    #[inline(never)]
    pub(crate) fn couple(&self, m: &Motion<R>, i: &Instant<R>) -> Couple<R> {
        self.couple_inlined(m, i)
    }
    /// [`Self::couple`], compiled into the caller: what is not needed there is not computed.
    #[inline(always)]
    pub(crate) fn couple_inlined(&self, m: &Motion<R>, i: &Instant<R>) -> Couple<R> {
        let frames = self.pair_frames(m, i);
        let [first, second] = &frames;
        let f = self.reactions_of_pair(m, &frames);
        let per_u = |frame: &Frame<R>, f: Vec2<R>| {
            if frame.turns {
                [f.turned() * i.theta_u, -i.g_u]
            } else {
                [Vec2::ZERO, frame.r.turned() * i.theta_u]
            }
        };
        let [f1, f2] = f;
        let [[f1_u, r1_u], [f2_u, r2_u]] = [per_u(first, f1), per_u(second, f2)];
        Couple {
            frames,
            f,
            f_u: [f1_u, f2_u],
            r_u: [r1_u, r2_u],
            r12: i.r2 - i.r,
        }
    }
    /// The directions of the two reactions of a pair.
    #[inline(always)]
    pub(crate) fn reactions_of_pair(
        &self,
        m: &Motion<R>,
        [first, second]: &[Frame<R>; 2],
    ) -> [Vec2<R>; 2] {
        let [c1, c2] = m.contacts;
        [self.edge(c1, first).f, self.edge(c2, second).f]
    }
    /// The frames of a pair at an instant.
    #[inline(always)]
    pub(crate) fn pair_frames(&self, m: &Motion<R>, i: &Instant<R>) -> [Frame<R>; 2] {
        let [c1, c2] = m.contacts;
        let frames = [self.frame_at(c1, i.r, i), self.frame_at(c2, i.r2, i)];
        self.levelled(m.contacts, frames)
    }
    /// The frame of a contact at an instant with its lever.
    #[inline(always)]
    fn frame_at(&self, contact: Contact, r: Vec2<R>, i: &Instant<R>) -> Frame<R> {
        match contact.feature {
            Feature::Vertex { side, .. } => {
                let side = self.side(side);
                Frame {
                    n: side.normal,
                    t: side.tangent,
                    r,
                    turns: false,
                }
            }
            Feature::Corner { .. } => Frame {
                r,
                ..self.frame(contact, i.rotation, i.g)
            },
        }
    }
}
