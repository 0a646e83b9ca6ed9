//! Every motion by central differences, and the certificate's bounds on random motions.

extern crate std;

use crate::bounds::Extent;
use crate::contact::{Feature, Sense};
use crate::geometry::Vec2;
use crate::motion::{Factor, Instant, Kind, Motion, Spot};
use crate::scene::{Description, SurfaceDescription};
use crate::state::{Body, HandPose};
use crate::window::Begin;
use crate::world::{Statics, World};
use std::vec::Vec;

type Room = World<f64, 4, 2, 0>;

/// Numbers that are alike on every machine.
struct Random(u64);
impl Random {
    fn number(&mut self, least: f64, most: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        let unit = (self.0 >> 11) as f64 / (1_u64 << 53) as f64;
        least + (most - least) * unit
    }
    fn vector(&mut self, size: f64) -> Vec2<f64> {
        Vec2::new(self.number(-size, size), self.number(-size, size))
    }
}

/// A quadrilateral with a weight over a floor and beside a leaning wall, of any friction.
fn world(random: &mut Random) -> Room {
    let mut near = |x: f64| x + random.number(-0.1, 0.1);
    let vertices = [
        [near(-0.4), near(-0.3)],
        [near(0.4), near(-0.3)],
        [near(0.4), near(0.3)],
        [near(-0.4), near(0.3)],
    ];
    let mut side = |angle: f64| SurfaceDescription {
        normal: [-angle.sin(), angle.cos()],
        offset: random.number(-9.0, -8.0),
        friction_static: random.number(0.5, 1.0),
        friction_dynamic: random.number(0.0, 0.5),
        memory: None,
    };
    let surfaces = [side(0.1), side(1.3)];
    let described = crate::scene::Scene::new(&Description {
        vertices: &vertices,
        start: [0.0; 3],
        weight: random.number(0.0, 0.5),
        holding_point: None,
        reach: 0.0,
        stiffness_translation: 1.0,
        stiffness_rotation: random.number(0.1, 1.0),
        surfaces: &surfaces,
        obstacles: &[],
    });
    described.expect("a scene").world
}

/// The kinds of motion, each with the contacts and signs that it has.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Case {
    Free,
    Stick,
    Slip,
    Slide,
    Line,
    Pair,
}
const CASES: [Case; 6] = [
    Case::Free,
    Case::Stick,
    Case::Slip,
    Case::Slide,
    Case::Line,
    Case::Pair,
];

type Held<'a> = Statics<'a, f64, 4, 2, 0>;

/// Passes random motions in random worlds to a check, each of the case of its round.
fn each_motion(
    seed: u64,
    rounds: usize,
    case: impl Fn(usize) -> Case,
    mut check: impl FnMut(&mut Random, &Held<'_>, Case, Motion<f64>),
) {
    let mut random = Random(seed);
    for case in (0..rounds).map(case) {
        let world = world(&mut random);
        let grip = world.grip(random.vector(0.2));
        let (_, m) = motion(&mut random, &world, case);
        check(&mut random, &world.held(&grip), case, m);
    }
}

fn in_turn(round: usize) -> Case {
    CASES[round % CASES.len()]
}

/// The body exactly on its contacts. A step seats it from within a touch of them; from the far starts here that takes more corrections.
fn seated(statics: &Held<'_>, body: &mut Body<f64>) {
    for _ in 0..100 {
        statics.seat(body);
    }
    for contact in body.contacts.iter() {
        let gap = statics.gap(contact, body.rotation, body.holding);
        assert!(gap.abs() <= 1e-12, "{gap}");
    }
}

/// A motion with a hand near balance, and the body at its beginning.
fn motion(random: &mut Random, world: &Room, case: Case) -> (Body<f64>, Motion<f64>) {
    let grip = world.grip(random.vector(0.2));
    let statics = world.held(&grip);
    let angle = random.number(-0.4, 0.4);
    let hand = HandPose {
        at: random.vector(0.3),
        angle: angle + random.number(-0.5, 0.5),
    };
    let hand_p = HandPose {
        at: random.vector(0.1),
        angle: random.number(-0.1, 0.1),
    };
    let mut body = Body::new(random.vector(0.5), angle, hand);
    let on = |vertex, side| Feature::Vertex { vertex, side };
    if case != Case::Free {
        body.contacts.add(on(0, 0));
        body.foot = random.number(-1.0, 1.0);
    }
    match case {
        Case::Pair => body.contacts.add(on(1, 1)),
        Case::Line => body.contacts.add(on(1, 0)),
        Case::Free | Case::Stick | Case::Slip | Case::Slide => {}
    }
    if case != Case::Free {
        seated(&statics, &mut body);
    }
    body.hand.at = body.holding + random.vector(0.4);
    let m = match case {
        Case::Free => Motion::new(Kind::Free, &body, hand_p),
        Case::Stick => Motion::new(Kind::Pin, &body, hand_p),
        Case::Slip => Motion::slip(&body, 1.0),
        Case::Slide => {
            body.contacts.slide(Sense::Plus);
            Motion::new(Kind::Slide, &body, hand_p)
        }
        Case::Line | Case::Pair => statics.pair(&body, hand_p, 1.0),
    };
    (body, m)
}

fn close(what: &str, is: f64, should: f64, within: f64) {
    assert!(
        (is - should).abs() <= within,
        "{what}: {is} and not {should}"
    );
}

/// The centre of each comparison: not at the beginning of a pair, where its normal correction is zero.
fn centre(case: Case, m: &Motion<f64>) -> Spot<f64> {
    let u = match case {
        Case::Line | Case::Pair => 0.3 * m.pair.reach.min(1.0),
        Case::Free | Case::Stick | Case::Slip | Case::Slide => m.angle,
    };
    Spot { u, p: 0.2 }
}

#[test]
fn partial_derivatives_are_those_of_differences() {
    each_motion(1, 300, in_turn, |_, statics, case, m| {
        let at = centre(case, &m);
        let step = 1e-5;
        let along = |u: f64, p: f64| {
            let near = |sign: f64| {
                statics.placed(
                    &m,
                    Spot {
                        u: at.u + sign * u,
                        p: at.p + sign * p,
                    },
                )
            };
            (near(1.0), near(-1.0))
        };
        let slope = |f: &dyn Fn(&Instant<f64>) -> f64, u: f64, p: f64| {
            let (after, before) = along(u, p);
            (f(&after) - f(&before)) / (2.0 * step)
        };
        let i = statics.placed(&m, at);
        let (u, p) = ((step, 0.0), (0.0, step));
        let check = |what: &str, is: f64, f: &dyn Fn(&Instant<f64>) -> f64, (u, p)| {
            close(&std::format!("{case:?} {what}"), is, slope(f, u, p), 1e-8);
        };
        check("E_u", i.e_u, &|i| i.e, u);
        check("E_p", i.e_p, &|i| i.e, p);
        check("E_up", statics.e_up(&m, &i), &|i| i.e_u, p);
        check("G_u", i.g_u.x, &|i| i.g.x, u);
        check("G_p", i.g_p.y, &|i| i.g.y, p);
        check("theta_u", i.theta_u, &|i| i.angle, u);
        check("xi_u", i.xi_u, &|i| i.foot, u);
        check("xi_p", i.xi_p, &|i| i.foot, p);
        let rates = statics.rates_of(&m, &i, 1.0, 0.0);
        check("F_u", rates.force.x, &|i| i.force.x, u);
        check("M_u", rates.moment, &|i| i.moment, u);
    });
}

#[test]
fn factors_of_a_slide_have_the_derivatives_of_differences() {
    let factors = [
        Factor::Lever,
        Factor::Normal(Sense::Plus),
        Factor::Normal(Sense::Minus),
    ];
    let mut factors = factors.into_iter().cycle();
    each_motion(
        4,
        60,
        |_| Case::Slide,
        |_, statics, _, mut m| {
            m.factor = factors.next().expect("a cycle");
            let e = |u: f64, p: f64| statics.placed(&m, Spot { u: m.angle + u, p }).e;
            let (i, step) = (statics.placed_at_start(&m), 1e-5);
            let slopes = [e(step, 0.0) - e(-step, 0.0), e(0.0, step) - e(0.0, -step)];
            let [e_u, e_p] = slopes.map(|d| d / (2.0 * step));
            close("E_u", i.e_u, e_u, 1e-8);
            close("E_p", i.e_p, e_p, 1e-8);
        },
    );
}

/// The points of an accepted window in balance, from p = 0 to `way`.
fn followed(
    statics: &Held<'_>,
    m: &Motion<f64>,
    begin: &Instant<f64>,
    way: f64,
) -> Vec<Instant<f64>> {
    let points = (0..=40).map(|k| {
        let p = way * f64::from(k) / 40.0;
        let mut i = *begin;
        let mut u = begin.u;
        for _ in 0..8 {
            i = statics.placed(m, Spot { u, p });
            u -= i.e / i.e_u;
        }
        i
    });
    points.collect()
}

#[test]
fn bounds_hold_on_every_accepted_window() {
    let mut accepted = [0; CASES.len()];
    each_motion(2, 900, in_turn, |random, statics, case, mut m| {
        // The moment of the hand that makes a balance of the beginning.
        let mut begin = statics.placed_at_start(&m);
        let per_angle = {
            let mut turned = m;
            turned.hand.angle += 1.0;
            statics.placed_at_start(&turned).e - begin.e
        };
        if per_angle.abs() > 1e-6 {
            m.hand.angle -= begin.e / per_angle;
        } else {
            // In one line the moment does not matter.
            let mut moved = m;
            moved.hand.at.x += 1.0;
            m.hand.at.x -= begin.e / (statics.placed_at_start(&moved).e - begin.e);
        }
        begin = statics.placed_at_start(&m);
        let way = random.number(0.01, 0.6);
        let mut end = Instant::ZERO;
        if begin.e.abs() > 1e-12 || begin.e_u >= 0.0 {
            return;
        }
        let mut pair = None;
        let Ok(pace) = statics.window(&m, Begin::At(&begin), way, &mut end, &mut pair) else {
            return;
        };
        accepted[case as usize] += 1;
        let bound = statics.bound(&m, &end, &pace, pair.as_ref());
        let points = followed(statics, &m, &begin, way);
        let last = points.last().expect("points");
        close("end of the window", end.u, last.u, 1e-9);
        let curvature = statics.curvature(&m, &begin, pace.extent);
        let step = 1.0 / 40.0;
        let at_most = |what: &str, is: f64, bound: f64, rounding: f64| {
            let is = is.abs();
            assert!(
                is <= bound * (1.0 + 1e-6) + rounding,
                "{case:?} {what}: {is} beyond {bound}"
            );
        };
        for three in points.windows(3) {
            let [a, b, c] = three else { continue };
            let second =
                |f: &dyn Fn(&Instant<f64>) -> f64| (f(a) - 2.0 * f(b) + f(c)) / (step * step);
            let first = |f: &dyn Fn(&Instant<f64>) -> f64| (f(c) - f(a)) / (2.0 * step);
            let (rounding1, rounding2) = (1e-11, 1e-9);
            at_most("u'", first(&|i| i.u), pace.rate, rounding1);
            at_most("u''", second(&|i| i.u), pace.bent, rounding2);
            at_most("G''", second(&|i| i.g.x), bound.holding, rounding2);
            at_most("xi'", first(&|i| i.foot), bound.foot[0], rounding1);
            at_most("xi''", second(&|i| i.foot), bound.foot[1], rounding2);
            for (_, v) in statics.vertices() {
                let arm = end.rotation.apply(v) - end.r;
                let gap = |i: &Instant<f64>| i.g.y + i.rotation.apply(v).y;
                at_most(
                    "gap''",
                    second(&gap),
                    statics.gap_bound(&m, &bound, arm),
                    rounding2,
                );
                at_most("way'", first(&gap), bound.way, rounding1);
                let corner = end.g + arm + end.r * 1.5;
                let gap = |i: &Instant<f64>| i.rotation.undo(corner - i.g).y;
                let arm = corner - end.g - end.r;
                let bound = statics.corner_bound(&m, &bound, arm);
                at_most("corner's gap''", second(&gap), bound, rounding2);
            }
            let apart = 1e-5;
            let near = |du: f64, dp: f64| {
                statics.placed(
                    &m,
                    Spot {
                        u: b.u + du,
                        p: b.p + dp,
                    },
                )
            };
            let e_uu = (near(apart, 0.0).e_u - near(-apart, 0.0).e_u) / (2.0 * apart);
            at_most("E_uu", e_uu, curvature.k, 1e-8);
            at_most("E_up", statics.e_up(&m, b), curvature.j, 1e-8);
        }
    });
    assert!(accepted.iter().all(|&count| count > 20), "{accepted:?}");
}

#[test]
fn reactions_of_a_pair_bear_the_load() {
    each_motion(
        3,
        200,
        |_| Case::Pair,
        |_, statics, _, m| {
            let i = statics.placed_at_start(&m);
            let couple = statics.couple(&m, &i);
            let shares = statics.shares(&m, &i);
            let [v1, v2] = statics.feet(&m, &i);
            let (mut force, mut moment) = (i.force, i.moment);
            for ((((n, f), frame), v), c) in (shares.normal.iter().zip(couple.f))
                .zip(couple.frames)
                .zip([v1, v2])
                .zip(m.contacts)
            {
                let cos = statics.friction(c).sliding.cos;
                let reaction = f * (n / cos) - frame.t * (shares.drag * v);
                force = force + reaction;
                moment += frame.r.cross(reaction);
            }
            close(
                "force",
                force.x.hypot(force.y),
                0.0,
                1e-9 * (1.0 + shares.drag.abs()),
            );
            close("moment", moment, 0.0, 1e-9 * (1.0 + shares.drag.abs()));
        },
    );
}

/// K of a pair is a bound within all of its reach.
#[test]
fn the_curvature_of_a_pair_holds_within_its_reach() {
    each_motion(
        4,
        300,
        |_| Case::Pair,
        |_, statics, _, m| {
            let reach = m.pair.reach;
            let middle = statics.placed_at_start(&m);
            let extent = Extent {
                way: 0.0,
                strip: reach,
            };
            let curvature = statics.curvature(&m, &middle, extent);
            for k in -9..=9 {
                let u = reach * f64::from(k) / 10.0;
                let at = |u| statics.placed(&m, Spot { u, p: 0.0 }).e_u;
                let e_uu = (at(u + 1e-5) - at(u - 1e-5)) / 2e-5;
                assert!(
                    e_uu.abs() <= curvature.k + 1e-8,
                    "{e_uu} beyond {}",
                    curvature.k
                );
            }
        },
    );
}
