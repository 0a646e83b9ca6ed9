//! The trammel motion against statics written out: reactions that oppose the sliding, and the remaining drive, balance the load at every
//! position; their slopes are derivatives, and their bounds hold up to the window.

use super::*;
use crate::fixtures::{Random, sampled, searches};
use crate::geometry::{Angle, Orientation, Pose};
use crate::pivot::Pivot;
use crate::scene::{Description, Scene, SurfaceDescription};
use crate::state::TwoVertex;
use crate::verb::Trigger;

mod moves;

const MU_D: [f64; 2] = [0.3, 0.2];

struct Case {
    scene: Scene<f64, 3, 2>,
    state: TwoVertex<f64>,
    grip: Grip<f64>,
}

/// A triangle with vertex 0 on one surface and vertex 1 on another one, pushed.
fn case(random: &mut Random) -> Option<Case> {
    let vertices = [[0.0, 0.0], [1.0, 0.0], [0.4, 0.3]];
    let pose = Pose {
        position: random.vector(),
        orientation: Orientation::new(Angle::from_radians(3.0 * random.next())),
    };
    let at = |[x, y]: [f64; 2]| pose.position + pose.orientation.rotation().apply(Vec2::new(x, y));
    let mut surface = |i: usize| {
        let (sin, cos) = libm::sincos(3.0 * random.next());
        SurfaceDescription {
            normal: [-sin, cos],
            offset: Vec2::new(-sin, cos).dot(at(vertices[i])),
            friction_static: MU_D[i] + 0.2,
            friction_dynamic: MU_D[i],
            memory: None,
        }
    };
    let surfaces = [surface(0), surface(1)];
    let holding_point = random.vector();
    let scene = Scene::new(&Description {
        vertices: &vertices,
        start: [
            pose.position.x,
            pose.position.y,
            pose.orientation.angle().radians(),
        ],
        weight: 0.3 * random.next().abs(),
        holding_point: None,
        reach: 0.0,
        stiffness_translation: 1.0,
        stiffness_rotation: random.next().abs(),
        surfaces: &surfaces,
        obstacles: &[],
    });
    let first = Pair {
        vertex: 0,
        surface: 0,
    };
    let second = Pair {
        vertex: 1,
        surface: 1,
    };
    let scene = scene.ok()?;
    let state = TwoVertex::new(Pivot::at(&scene, &pose, first), second);
    let grip = Grip {
        holding_point,
        hand: pose.position + random.vector() * 2.0,
        angle: Angle::from_radians(3.0 * random.next()),
    };
    Some(Case { scene, state, grip })
}

/// At a point of a motion: the contacts relative to where contact 1 began, and the load about it.
struct Place2 {
    contacts: [Vec2<f64>; 2],
    force: Vec2<f64>,
    moment: f64,
}

impl Case {
    fn at(&self, slide: f64, turn: f64) -> Place2 {
        let pivot = self.state.pivot.moved(slide, turn);
        let rotation = pivot.orientation.rotation();
        let contact = pivot.point(&self.scene);
        let grip = &self.grip;
        let lever = rotation.apply(grip.holding_point);
        let spring = grip.hand - contact - lever;
        let weight = self.scene.weight();
        let couple = self.scene.stiffness() * grip.angle.minus(pivot.orientation.angle());
        Place2 {
            contacts: [contact, contact + rotation.apply(self.scene.vertex(1))],
            force: spring + weight,
            moment: couple
                + lever.cross(spring)
                + rotation.apply(self.scene.centroid()).cross(weight),
        }
    }
}

/// All cases that are driven, of many.
fn driven(demand: Demand, mut look: impl FnMut(&Case, &Trammel<f64>, u64)) -> usize {
    let mut count = 0;
    for seed in sampled(0..3000, 97) {
        let Some(case) = case(&mut Random(seed)) else {
            continue;
        };
        if let Some(trammel) = Trammel::driven(
            &case.scene,
            (&case.state.pivot, case.state.other),
            &case.grip,
            demand,
        ) {
            look(&case, &trammel, seed);
            count += 1;
        }
    }
    count
}

/// Slide, turn and velocities, N_1, N_2 and delta at x of a trammel.
fn quantities(trammel: &Trammel<f64>, x: f64) -> ([f64; 2], [f64; 2], [f64; 3]) {
    let p = trammel.sense.curve.at(x);
    let found: Quantities<Bounded<f64>> = trammel.quantities(&p, 1.0);
    let per = 1.0 / (found.resistance.value * trammel.per_load);
    let [n1, n2] = found.normals.map(|n| n.value * per);
    let velocities = found.velocities.map(|v| v.value);
    (
        [p.part(), p.turn],
        velocities,
        [n1, n2, found.imbalance.value * per],
    )
}

/// N_1 w_1 + N_2 w_2 + load = delta (v_1 w_t1 + v_2 w_t2), forces and moments; friction N_i mu_d against the velocities at the beginning.
#[test]
fn reactions_and_what_drives_balance_the_load() {
    let count = driven(Demand::Pressed, |case, trammel, seed| {
        let (_, begin, [_, _, drive]) = quantities(trammel, 0.0);
        assert!(drive > 0.0, "{seed}");
        for x in [0.0, 0.1, 0.4] {
            let ([slide, turn], velocities, [n1, n2, delta]) = quantities(trammel, x);
            let place = case.at(slide, turn);
            let (mut force, mut moment) = (place.force, place.moment);
            for (i, n) in [n1, n2].into_iter().enumerate() {
                let surface = trammel.surfaces[i];
                let still = begin[i].abs() < 1e-14;
                let mu = if still {
                    0.0
                } else {
                    MU_D[i] * begin[i].signum()
                };
                // N is along the edge of the cone, whose size is 1.
                let edge = (surface.normal - surface.tangent * mu) * (1.0 / libm::hypot(1.0, mu));
                let sum = edge * n - surface.tangent * (velocities[i] * delta);
                force = force + sum;
                moment += (place.contacts[i] - place.contacts[0]).cross(sum);
            }
            let size = n1.abs() + n2.abs() + delta.abs() + place.force.length() + 1.0;
            assert!(
                force.length() < 1e-11 * size && moment.abs() < 1e-11 * size,
                "{seed} {x}"
            );
        }
    });
    assert!(cfg!(miri) || count > 100, "{count}");
}

/// Both contacts stay on their surfaces; their velocities are those along them.
#[test]
fn contacts_stay_on_their_surfaces() {
    driven(Demand::AtTheEnd, |case, trammel, seed| {
        let contacts = |x: f64| {
            let ([slide, turn], ..) = quantities(trammel, x);
            case.at(slide, turn).contacts
        };
        let begin = contacts(0.0);
        for x in [0.0, 0.1, 0.4] {
            let (_, velocities, _) = quantities(trammel, x);
            for i in 0..2 {
                let surface = trammel.surfaces[i];
                let displacement = contacts(x)[i] - begin[i];
                assert!(
                    surface.normal.dot(displacement).abs() < 1e-12,
                    "{seed} {x} {i}"
                );
                let step = (contacts(x + 1e-5)[i] - contacts(x - 1e-5)[i]) * 0.5e5;
                assert!(
                    (surface.tangent.dot(step) - velocities[i]).abs() < 1e-8,
                    "{seed}"
                );
            }
        }
    });
}

#[test]
fn slopes_are_derivatives_and_bounds_hold() {
    driven(Demand::AtTheEnd, |_, trammel, seed| {
        let all = |x: f64| {
            let q: Quantities<Bounded<f64>> = trammel.quantities(&trammel.sense.curve.at(x), 1.0);
            let [n1, n2] = q.normals;
            let [v1, v2] = q.velocities;
            [q.imbalance, n1, n2, q.resistance, v1, v2]
        };
        for x in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let (before, at, after) = (all(x - 1e-5), all(x), all(x + 1e-5));
            // To the same bits without slopes and bounds.
            let p = trammel.sense.curve.at(x);
            let listed = |q: Quantities<f64>| {
                let ([n1, n2], [v1, v2]) = (q.normals, q.velocities);
                [q.imbalance, n1, n2, q.resistance, v1, v2]
            };
            let alone = listed(trammel.quantities(&p, 1.0));
            assert_eq!(at.map(|bounded| bounded.value), alone, "{seed}");
            let Quantities {
                imbalance,
                normals: [n1, n2],
                resistance,
                velocities: [v1, v2],
            } = trammel.quantities::<Sloped<f64>>(&p, 1.0);
            let sloped = [imbalance, n1, n2, resistance, v1, v2];
            let both = |q: Bounded<f64>| Sloped {
                value: q.value,
                slope: q.slope,
            };
            assert_eq!(at.map(both), sloped, "{seed}");
            // The bounds of the beginning hold throughout.
            let begin = all(0.0);
            for (i, bounded) in at.iter().enumerate() {
                let slope = (after[i].value - before[i].value) * 0.5e5;
                let curved = (after[i].slope - before[i].slope) * 0.5e5;
                assert!((slope - bounded.slope).abs() < 1e-7, "{seed} {i}");
                let sizes = [bounded.value, bounded.slope, curved];
                for (size, bound) in sizes.into_iter().zip(begin[i].bounds.suprema) {
                    assert!(size.abs() <= bound + 1e-7, "{seed} {i} {size} {bound}");
                }
            }
        }
    });
}

/// By small steps: before the end the motion is driven, both contacts press and slide on; at the end its cause is zero.
#[test]
fn run_ends_at_what_comes_first() {
    let mut ends = [0; 4];
    driven(Demand::Pressed, |case, trammel, seed| {
        let (run, ending) =
            trammel.run(&case.scene, &case.state.contacts(), (0.0, Demand::Pressed));
        let (_, begin, _) = quantities(trammel, 0.0);
        let left = |x: f64| {
            let (_, velocities, [n1, n2, delta]) = quantities(trammel, x);
            let on = |i: usize| {
                if begin[i].abs() < 1e-12 {
                    1.0
                } else {
                    velocities[i] * begin[i].signum()
                }
            };
            [delta, n1, n2, on(0), on(1)]
        };
        let steps = (1..1000).map(|i| f64::from(i) / 1000.0);
        let slide = |x: f64| quantities(trammel, x).0;
        let length = |[slide, turn]: [f64; 2]| slide.abs() + turn.abs();
        let whole = length([run.slide, run.turn]);
        for x in steps {
            if length(slide(x)) > whole * (1.0 - 1e-6) {
                break;
            }
            assert!(
                left(x).iter().all(|left| *left > -1e-9),
                "{seed} {x} {ending:?}"
            );
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if length(slide(middle)) < whole {
                low = middle;
            } else {
                high = middle;
            }
        }
        let [delta, n1, n2, v1, v2] = left(high).map(f64::abs);
        let (which, off) = match ending {
            Ending::Stopped => (0, delta),
            Ending::Opens { lasts, sliding } => {
                assert_eq!(sliding, begin[lasts].signum(), "{seed}");
                (1, if lasts == 0 { n2 } else { n1 })
            }
            Ending::Reverses => (2, v1.min(v2)),
            // As far as it was examined.
            Ending::Window => (3, 0.0),
            Ending::Touches(_) => return,
            Ending::Off { .. } | Ending::Rests => panic!("of obstacles alone"),
        };
        assert!(off < 1e-6, "{seed} {ending:?} {off}");
        ends[which] += 1;
    });
    assert!(
        cfg!(miri) || ends.iter().all(|count| *count > 0),
        "{ends:?}"
    );
}

/// A slip of both contacts is the displacement of the first one's foot. Only a slip that comes to (E6) ends in balance; one that does not
/// move has no motion; and a slip whose search gives up reports it.
#[test]
fn slip_is_told_as_it_is() {
    let mut seen = [0; 4];
    for seed in sampled(0..1500, 97) {
        let Some(case) = case(&mut Random(seed)) else {
            continue;
        };
        let (scene, grip) = (&case.scene, &case.grip);
        let mut state = case.state.clone();
        let moved = state.slip_to_the_end(scene, grip);
        let displacement = state.pivot.foot - case.state.pivot.foot;
        assert!(
            (displacement - moved.slip).abs() < 1e-9,
            "{seed}: {displacement} {moved:?}"
        );
        match moved.trigger {
            Trigger::Stopped => {
                assert!(
                    moved.slip.abs() > <f64 as Real>::MICRO || !moved.unbalanced,
                    "{seed}"
                );
                seen[0] += 1;
            }
            Trigger::Undriven => {
                assert!(
                    moved.slip.abs() <= <f64 as Real>::MICRO,
                    "{seed}: {moved:?}"
                );
                seen[1] += 1;
            }
            _ => {
                assert!(moved.unbalanced, "{seed}: {moved:?}");
                seen[2] += 1;
            }
        }
        for most in [4, 6, 8] {
            // From where a search stopped it goes on, to the same end.
            let mut again = case.state.clone();
            let slip = || again.slip_to_the_end(scene, grip);
            let (cut, counts) = searches::giving_up(most, slip);
            assert!(!cut.unsure || counts.unsure > 0, "{seed} {most}");
            if cut.unsure || moved.unsure || cut.unbalanced {
                continue;
            }
            assert_eq!(cut.trigger, moved.trigger, "{seed} {most}");
            let off = (again.pivot.foot - state.pivot.foot).abs();
            assert!(off < 1e-6, "{seed} {most}: {off} {cut:?} {moved:?}");
            seen[3] += usize::from(counts.unsure > 0);
        }
    }
    assert!(
        cfg!(miri) || seen.iter().all(|count| *count > 0),
        "{seen:?}"
    );
}
