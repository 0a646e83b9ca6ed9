//! The short slip against small steps: its conditions, its end and its bounds.

use super::*;
use crate::contact::Pair;
use crate::fixtures::sampled;
use crate::geometry::{Angle, Orientation};
use crate::scene::{Description, Scene, SurfaceDescription};

mod random;

const MU_S: f64 = 0.5;
const MU_D: f64 = 0.3;
/// A triangle with sides of 1 at its tip, and cg.
const VERTICES: [[f64; 2]; 3] = [[0.0, 0.0], [0.28, 0.96], [-0.28, 0.96]];
const CENTROID: Vec2<f64> = Vec2 { x: 0.0, y: 0.64 };

/// It stands with its tip on the floor at the origin, pushed towards ±t.
#[derive(Clone, Copy, Debug)]
struct Case {
    stiffness: f64,
    lever: Vec2<f64>,
    weight: f64,
    /// F less the weight.
    force: Vec2<f64>,
    /// M
    lack: f64,
    sign: f64,
}

impl Case {
    fn find(&self) -> Result<ShortSlip<f64>, Option<f64>> {
        let lever = self.lever;
        let floor = SurfaceDescription {
            normal: [0.0, 1.0],
            offset: 0.0,
            friction_static: MU_S,
            friction_dynamic: MU_D,
            memory: None,
        };
        let scene: Scene<f64, 3, 1> = Scene::new(&Description {
            vertices: &VERTICES,
            start: [0.0; 3],
            weight: self.weight,
            holding_point: Some([lever.x, lever.y]),
            reach: 0.0,
            stiffness_translation: 1.0,
            stiffness_rotation: self.stiffness,
            surfaces: &[floor],
            obstacles: &[],
        })
        .expect("a sound scene");
        let pivot = Pivot {
            contact: Pair::default(),
            foot: 0.0,
            orientation: Orientation::new(Angle::default()),
        };
        let grip = Grip {
            holding_point: lever,
            hand: self.hand(),
            angle: Angle::from_radians(self.phi()),
        };
        let load = pivot.load(&scene, &grip);
        ShortSlip::find(&scene, (&pivot, &load), &grip, self.sign)
    }

    fn hand(&self) -> Vec2<f64> {
        self.lever + self.force + Vec2::new(0.0, self.weight)
    }

    /// So that the moment is `lack` with the body in its present pose.
    fn phi(&self) -> f64 {
        let spring = self.hand() - self.lever;
        let load = self.lever.cross(spring) - CENTROID.x * self.weight;
        (self.lack - load) / self.stiffness
    }

    /// Force and moment about the foot after a slide by x and a turn.
    fn load(&self, x: f64, turn: f64) -> (Vec2<f64>, f64) {
        let (sin, cos) = libm::sincos(turn);
        let rotated = |v: Vec2<f64>| Vec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y);
        let lever = rotated(self.lever);
        let spring = self.hand() - Vec2::new(x * self.sign, 0.0) - lever;
        let centroid = rotated(CENTROID);
        let moment =
            self.stiffness * (self.phi() - turn) + lever.cross(spring) - centroid.x * self.weight;
        (spring - Vec2::new(0.0, self.weight), moment)
    }

    /// The turn that balances the moment next to a guess, and E there.
    fn balance(&self, x: f64, near: f64) -> (f64, f64) {
        let (mut low, mut high) = (near - 0.05, near + 0.05);
        for _ in 0..70 {
            let middle = 0.5 * (low + high);
            if self.load(x, middle).1 > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        (low, self.excess(self.load(x, low).0))
    }

    /// E = q·F
    fn excess(&self, force: Vec2<f64>) -> f64 {
        let size = libm::hypot(1.0, MU_D);
        (force.y * MU_D + force.x * self.sign) / size
    }
}

fn cases() -> impl Iterator<Item = Case> {
    let levers = [
        (0.1, 0.5),
        (-0.3, 0.2),
        (0.0, -0.4),
        (0.02, 0.01),
        (-0.9, 0.7),
    ];
    let forces = [
        (0.02, -0.03),
        (0.004, -0.006),
        (0.1, -0.15),
        (0.0004, -0.0006),
        (0.2, -0.01),
        (0.7, -0.9),
        (0.001, -0.6),
    ];
    let grips = [
        (1.0, 0.0),
        (0.2, 0.01),
        (0.05, 0.002),
        (4.0, 0.2),
        (0.01, 0.0),
    ];
    let off = [0.0, 0.0, 1e-9, 0.01];
    levers.into_iter().flat_map(move |lever| {
        forces.into_iter().flat_map(move |(t, n)| {
            grips.into_iter().flat_map(move |(stiffness, weight)| {
                off.into_iter()
                    .zip([1.0, -1.0, 1.0, 1.0])
                    .map(move |(lack, sign)| Case {
                        stiffness,
                        lever: Vec2::new(lever.0, lever.1),
                        weight,
                        force: Vec2::new(t * sign, n),
                        lack: lack * stiffness,
                        sign,
                    })
            })
        })
    })
}

/// (E9) of a case: guess, arm, bend, decay.
fn beginning(case: &Case) -> [f64; 4] {
    let spring = case.hand() - case.lever;
    let h = 1e-6;
    let stability = (case.load(0.0, -h).1 - case.load(0.0, h).1) / (2.0 * h);
    let z =
        case.lever.conj_mul(spring + case.lever) + CENTROID.conj_mul(Vec2::new(0.0, -case.weight));
    let (arm, bend) = (
        libm::hypot(case.lever.x, case.lever.y),
        libm::hypot(z.x, z.y),
    );
    let turn = case.lack / stability;
    let lean = case.sign * case.lever.y / stability;
    let e = |x: f64, turn: f64| case.excess(case.load(x, turn).0);
    let decay = (e(-h, -h * lean) - e(h, h * lean)) / (2.0 * h);
    let guess = (e(0.0, 0.0) + (e(0.0, h) - e(0.0, -h)) / (2.0 * h) * turn) / decay;
    [guess, arm / stability, bend / stability, decay]
}

/// If the conditions of (E9) hold with room to spare there is a short slip, if one fails there is none; then an estimate of its length is
/// returned.
#[test]
fn slip_is_short_where_its_beginning_says_so() {
    let mut found = [0; 3];
    for case in sampled(cases(), 97) {
        let [guess, arm, bend, decay] = beginning(&case);
        let slip = case.find();
        if arm < 0.0 || decay <= 0.25 || guess < 0.0 || case.lack > 1e-5 * case.stiffness {
            assert!(matches!(slip, Err(None)), "{case:?} {slip:?}");
            found[0] += 1;
            continue;
        }
        if let Err(about) = slip {
            let about = about.unwrap_or_else(|| panic!("{case:?}: {guess} {arm} {decay}"));
            assert!(
                (about - guess).abs() <= 1e-6 * guess,
                "{case:?}: {about} {guess}"
            );
        }
        let farthest = 1.25 * guess;
        let swing = arm * farthest;
        let lever = libm::hypot(case.lever.x, case.lever.y);
        let curved = 2.0 * lever * arm * swing * (bend + 3.0);
        let conditions = [
            16.0 * swing,
            16.0 * bend * swing,
            curved / decay.min(1.0),
            curved * farthest / -case.force.y,
        ];
        let (turn, _) = case.balance(guess, 0.0);
        let pressed = -case.load(guess, turn).0.y;
        let most = conditions.iter().fold(0.0, |a: f64, b| a.max(*b));
        if most > 1.0 {
            assert!(slip.is_err(), "{case:?} {conditions:?} {slip:?}");
            found[1] += 1;
        } else if most < 0.5 && curved * farthest < 0.5 * pressed {
            assert!(slip.is_ok(), "{case:?} {conditions:?} {slip:?}");
            found[2] += 1;
        }
    }
    assert!(
        cfg!(miri) || found.iter().all(|count| *count > 50),
        "{found:?}"
    );
}

/// It ends where, by small steps, E first falls to zero; on the path the vertex is pressed and nothing moves farther than the bounds.
#[test]
fn short_slip_ends_at_the_first_balance_and_within_its_bounds() {
    const STEPS: i32 = 64;
    for case in sampled(cases(), 97) {
        let Ok(slip) = case.find() else { continue };
        let [guess, arm, bend, _] = beginning(&case);
        let length = slip.slide * case.sign;
        let (mut turn, mut farthest, mut last) = (0.0_f64, 0.0_f64, [0.0; 2]);
        let mut curved = 0.0_f64;
        for i in 0..=STEPS {
            let x = length * f64::from(i) / f64::from(STEPS);
            let (next, excess) = case.balance(x, turn);
            let normal = -case.load(x, next).0.y;
            assert!(normal > 0.0 && (excess > 0.0 || i == STEPS), "{case:?} {i}");
            farthest = farthest.max(x.abs() + next.abs());
            if i == STEPS {
                assert!(excess.abs() < 1e-15 * 8.0, "{case:?} {excess}");
                assert!((next - slip.turn).abs() < 1e-14, "{case:?}");
            }
            if i > 1 {
                let [before, at] = last;
                let second = next - 2.0 * at + before;
                curved = curved.max((next - at) * (next - at) + second.abs());
            }
            last = [last[1], next];
            turn = next;
        }
        // In units of the path's length; the curve has this many steps.
        let curved = curved * f64::from(STEPS * STEPS);
        let swing = 1.25 * arm * guess;
        let widest = 1.25 * (swing + guess);
        assert!(
            farthest <= slip.travel_bound && slip.travel_bound <= 1.3 * widest,
            "{case:?} {slip:?}"
        );
        assert!(
            curved <= slip.open + 1e-9 && slip.open <= 1.5 * swing * swing * (bend + 3.0),
            "{case:?} {slip:?} {curved}"
        );
    }
}
