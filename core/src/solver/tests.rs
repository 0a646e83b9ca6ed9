//! If a search gives up, the frame reports it, or ends where it should all the same.

use super::*;
use crate::contact::Pair;
use crate::fixtures::{sampled, scene, searches};
use crate::hand::Hand;
use crate::world::World;
use core::f64::consts::FRAC_PI_2;

mod among;
mod flat;
mod seam;
mod single_corner;

/// Boxes and rods that are dragged, turned and pushed into a corner, with searches that give up after one step, two steps and so on.
#[test]
fn frame_that_gives_up_says_so() {
    let walls = scene::<4, 2>(
        &[[-0.5, -0.3], [0.5, -0.3], [0.5, 0.3], [-0.5, 0.3]],
        &[0.0, FRAC_PI_2],
    );
    let slopes = scene::<2, 2>(&[[-0.5, 0.0], [0.5, 0.0]], &[-0.6, 0.8]);
    let paths = [
        [(3.0, 0.1, 0.1), (-0.2, -0.2, 1.2)],
        [(2.0, 0.4, -0.2), (-0.4, 0.1, -2.0)],
        [(1.0, 0.2, 0.5), (4.0, -1.0, 5.0)],
        [(1.0, 1.0, 0.0), (1.0, -0.8, -0.7)],
    ];
    let mut seen = [0; 2];
    for evolution in [Evolution::Path, Evolution::Frame] {
        for path in paths {
            gives_up(&Solver::new(walls.clone(), evolution), path, &mut seen);
            gives_up(&Solver::new(slopes.clone(), evolution), path, &mut seen);
        }
    }
    assert!(
        cfg!(miri) || seen.iter().all(|count| *count > 10),
        "{seen:?}"
    );
}

type At = (f64, f64, f64);

fn gives_up<const V: usize, const S: usize>(
    solver: &Solver<f64, V, S>,
    [from, to]: [At; 2],
    seen: &mut [usize; 2],
) {
    let [from, to] = [from, to].map(|(x, y, angle)| Hand::new(x, y, angle));
    let (begin, _) = solver.start(from);
    let mut whole = begin.clone();
    let end = solver.step(&mut whole, to);
    for most in sampled(1..60, 29) {
        let mut state = begin.clone();
        let (output, counts) = searches::giving_up(most, || solver.step(&mut state, to));
        stays_outside(solver, &state, &output);
        if output.status != end.status {
            assert!(counts.unsure > 0, "{most} {output:?}");
            seen[0] += 1;
            continue;
        }
        seen[1] += usize::from(counts.unsure > 0);
        let [[x, y], [there_x, there_y]] = [output.position, end.position];
        let off = libm::hypot(x - there_x, y - there_y);
        assert!(
            off < 1e-6 && output.state == end.state,
            "{most}: {output:?} for {end:?}"
        );
        let first = |output: &Output<f64>| output.events().first().copied();
        assert_eq!(first(&output), first(&end), "{most} {:?}", solver.evolution);
    }
}

/// Every contact is on its surface, and no vertex is inside one, wherever a search gave up.
fn stays_outside<const V: usize, const S: usize>(
    solver: &Solver<f64, V, S>,
    state: &State<f64>,
    output: &Output<f64>,
) {
    let (scene, contact) = (&solver.scene, &state.contact);
    let placed = contact.placed(scene);
    for surface in scene.surface_indices() {
        for vertex in scene.vertex_indices() {
            let pair = Pair { vertex, surface };
            let gap = placed.gap(scene, pair);
            let is_lawful = if contact.contacts().contains(&pair) {
                gap.abs() < 1e-9
            } else {
                gap > -1e-9
            };
            assert!(is_lawful, "{pair:?} is at {gap}: {output:?}");
        }
    }
}
