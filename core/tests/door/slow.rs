//! Pairs of contacts that slide: with a hand that moves by little more than the rounding of its number type, and where a foot turns back.

use crate::bench::{Number, Run, Setup, in_every_number_type, side};
use std::f64::consts::PI;
use stiction_core::{Evolution, SiFloat, StateKind, Status, SurfaceDescription};

in_every_number_type!(
    cases::a_pair_slides_on_however_slowly_the_hand_moves,
    cases::a_pair_slides_on_where_a_foot_turns_back,
);

/// A rod of length 2 that leans from the floor y = 0 against a wall through the origin, both without stiction, held at its middle by springs
/// of 1 N/m and `turning` N·m/rad.
fn rod(wall: [f64; 2], start: [f64; 3], turning: f64) -> Setup {
    let surfaces = [[0.0, 1.0], wall].map(|normal| SurfaceDescription {
        memory: None,
        ..side(normal, 0.0, [0.2, 0.2])
    });
    Setup {
        vertices: vec![[0.0, 0.0], [2.0, 0.0], [1.0, 0.1]],
        held: Some([1.0, 0.0]),
        springs: [1.0, turning],
        start,
        surfaces: surfaces.into(),
        ..Setup::default()
    }
}

mod cases {
    use super::*;

    /// A ladder without stiction against the wall x = 0, its foot on the floor: the hand turns slowly, and it slides on.
    pub(super) fn a_pair_slides_on_however_slowly_the_hand_moves<R: Number>() {
        let (sin, cos) = 1.0_f64.sin_cos();
        let setup = rod([-1.0, 0.0], [-2.0 * cos, 0.0, 1.0], 4.0);
        let hand = |phi: f64| [-cos, sin - 2.0, phi];
        let mut run = Run::<R>::new(&setup, Evolution::Path, hand(1.905));
        for k in 0..200 {
            run.to(hand(1.905 - 0.006 * f64::from(k)));
        }
        let slides = |run: &Run<R>| run.contacts().iter().filter(|c| c.sliding != 0).count();
        let last = 1.905 - 0.006 * 199.0;
        assert_eq!(slides(&run), 2);
        for k in 1..50 {
            run.to(hand(last - 4e-7 * f64::from(k)));
            assert_eq!(run.output.state, StateKind::TwoVertex);
            assert_eq!(slides(&run), 2, "in step {k}");
        }
    }

    /// A rod in a wedge of 60 degrees, pulled towards its apex and turned: its foot goes back where the rod stands upright on the wall. It
    /// slides on with the new friction; before and after each foot slides as its friction says.
    pub(super) fn a_pair_slides_on_where_a_foot_turns_back<R: Number>() {
        let (sin, cos) = (PI / 3.0).sin_cos();
        let wall = [-sin, -cos];
        let begin = [-2.0 * (PI * 2.0 / 3.0 - 0.3).sin() / sin, 0.0, 0.3];
        let hand = |phi: f64| [0.3, -0.5, phi];
        let mut run = Run::<R>::new(&rod(wall, begin, 16.0), Evolution::Path, hand(0.3));
        let mut signs = Vec::new();
        for k in 0..400 {
            run.to(hand(0.3 + 0.002 * f64::from(k)));
            assert_eq!(run.output.status, Status::Ok, "in step {k}");
            let (all, [fx, fy, _]) = (run.contacts(), run.wrench());
            let mut rest = [fx, fy];
            for (c, [x, y]) in all.iter().zip([[0.0, 1.0], wall]) {
                let (n, t) = (c.normal.widen(), c.friction.widen());
                rest = [rest[0] + n * x + t * y, rest[1] + n * y - t * x];
            }
            assert!(rest[0].hypot(rest[1]) < 1e-4, "{rest:?} in step {k}");
            let now: Vec<i8> = all.iter().map(|c| c.sliding).collect();
            if signs.last() != Some(&now) {
                signs.push(now);
            }
        }
        // Pushed down, it comes back: the foot goes out, then in.
        assert_eq!(signs, [[1, -1], [0, 0], [-1, 1], [1, 1]]);
    }
}
