//! The solver against the slow reference in random scenes: every frame of the reference starts from the solver's own pose and
//! contacts; state and pose are compared at its end. Scene `i` and frame `k` of a report are the same in every run.

use std::f64::consts::{FRAC_PI_2, PI};
use stiction_core::{Event, Evolution, StateKind, Status};
use stiction_tests::draw::{Draw, polygon};
use stiction_tests::obstacles::Among;
use stiction_tests::reference::{Foot, Reference, Scene};
use stiction_tests::{Frame, Run, Setup, times};

/// Number of scenes, each of a hundred frames.
fn number_of_scenes() -> usize {
    times(4, 200)
}
const SUBSTEPS: usize = 50;
/// Largest difference between equal poses, in body sizes and rad.
const POSE: f64 = 1e-6;
/// Largest difference if the phase of the slips is undetermined.
const PHASE: f64 = 1e-2;

/// A scene of 3 to 6 vertices and 1 to 3 surfaces (a slanted floor; a wall, a ceiling parallel to the floor or at any angle), and
/// the hand's frames: it presses first, then presses, drags, twists and lifts.
fn case(draw: &mut Draw) -> (Setup, Vec<[f64; 3]>) {
    let size = draw.power(-2.0, 0.5);
    let count = 3 + draw.below(4);
    let vertices = polygon(draw, count, size);
    let k_h = draw.power(1.0, 3.0);
    let k_theta = k_h * size * size * draw.power(-2.0, 0.3);
    let weight = if draw.below(3) == 0 {
        draw.between(0.0, 0.2) * k_h * size
    } else {
        0.0
    };
    let holding_point = [
        draw.between(-0.2, 0.2) * size,
        draw.between(-0.2, 0.2) * size,
    ];
    let theta = draw.between(-3.0, 3.0);
    let mut setup = Setup::new(&vertices)
        .at([0.0, 0.0, theta])
        .held_at(holding_point)
        .springs(k_h, k_theta)
        .weighing(weight);
    let corners: Vec<_> = vertices
        .iter()
        .map(|&v| setup.world(setup.start, v))
        .collect();
    let slant = draw.between(-0.3, 0.3);
    let second = [0.0, PI, slant - FRAC_PI_2, draw.between(-1.0, 4.0)][draw.below(4)];
    let facings = [FRAC_PI_2 + slant, second, draw.between(-0.5, 3.6)];
    for facing in &facings[..1 + draw.below(3)] {
        let normal = [facing.cos(), facing.sin()];
        let lowest = corners
            .iter()
            .map(|c| normal[0] * c[0] + normal[1] * c[1])
            .fold(f64::INFINITY, f64::min);
        let mu_s = draw.between(0.05, 1.2);
        let mu_d = mu_s
            * if draw.below(8) == 0 {
                1.0
            } else {
                draw.between(0.3, 1.0)
            };
        setup = setup.surface(
            normal,
            lowest - draw.between(0.02, 0.3) * size,
            [mu_s, mu_d],
        );
    }
    let [x, y] = setup.grip();
    let hands = path(draw, [x, y, theta], size, [slant.sin(), -slant.cos()]);
    (setup, hands)
}

/// Five straight legs of twenty frames.
fn path(draw: &mut Draw, start: [f64; 3], size: f64, down: [f64; 2]) -> Vec<[f64; 3]> {
    let mut hands = vec![start];
    for leg in 0..5 {
        let [x, y, phi] = hands[hands.len() - 1];
        let (press, drag) = (
            draw.between(0.1, 0.7) * size,
            draw.between(-1.0, 1.0) * size,
        );
        let moved = |press: f64, turn: f64| {
            [
                x + press * down[0] - drag * down[1],
                y + press * down[1] + drag * down[0],
                phi + turn,
            ]
        };
        let to = match if leg == 0 { 0 } else { draw.below(6) } {
            0 => [x + press * down[0], y + press * down[1], phi],
            1 => moved(0.0, 0.0),
            2 => [x, y, phi + draw.between(-1.5, 1.5)],
            3 => moved(0.0, draw.between(-1.0, 1.0)),
            4 => moved(-press, 0.0),
            _ => [
                x + draw.between(-0.5, 0.5) * size,
                y + draw.between(-0.5, 0.5) * size,
                phi + draw.between(-1.0, 1.0),
            ],
        };
        hands.extend((1..=20).map(|i| {
            [0, 1, 2].map(|k| [x, y, phi][k] + (to[k] - [x, y, phi][k]) * f64::from(i) / 20.0)
        }));
    }
    hands
}

fn scene(setup: &Setup) -> Scene {
    let among = Among {
        setup: setup.clone(),
        obstacles: Vec::new(),
    };
    among.reference()
}

/// The reference in the pose and contacts of a frame, with stiction or without.
fn reference_at(setup: &Setup, frame: &Frame, stiction: bool) -> Reference {
    let contacts: Vec<_> = frame
        .contacts
        .iter()
        .map(|c| Foot {
            touch: c.touch,
            slides: c.sliding,
        })
        .collect();
    let held = (contacts.as_slice(), stiction);
    Reference::resumed(scene(setup), frame.pose, held, frame.hand)
}

/// How a frame of the solver compares with the reference.
#[derive(Debug, PartialEq)]
enum Verdict {
    Same,
    /// Slips without a start (from a touch) or an end (before lift-off), or the event limit: same state, phase of the slips undetermined.
    OpenPhase,
    /// The reference or the solver found no motion that fits.
    Ambiguous,
    Pose,
    State,
}

fn verdict(size: f64, before: &Frame, frame: &Frame, reference: &Reference) -> (Verdict, f64) {
    let (a, b) = (frame.pose, reference.pose());
    let difference = ((a[0] - b[0]).hypot(a[1] - b[1]) / size).max((a[2] - b[2]).abs());
    let same_state = frame.state.name() == reference.state();
    let ladder = before.state == StateKind::NonContact && frame.saw(Event::Slip);
    let open = ladder || reference.skipped() || frame.status == Status::EventLimit;
    let verdict = match (same_state, difference <= POSE) {
        (true, true) => Verdict::Same,
        _ if reference.ambiguous() || frame.status == Status::Ambiguous => Verdict::Ambiguous,
        (true, false) if open && difference <= PHASE => Verdict::OpenPhase,
        (true, false) => Verdict::Pose,
        (false, _) => Verdict::State,
    };
    (verdict, difference)
}

#[test]
fn random_scenes_follow_the_reference() {
    let mut draw = Draw::new(0);
    let (mut frames, mut open, mut ambiguous, mut report) = (0_usize, 0_usize, 0_usize, Vec::new());
    for i in 0..number_of_scenes() {
        let (setup, hands) = case(&mut draw);
        let mut run = Run::<f64>::start(&setup, Evolution::Path, hands[0]);
        let mut reference = Reference::new(scene(&setup), setup.start, hands[0]);
        for (k, &hand) in hands.iter().enumerate().skip(1) {
            let before = run.frame.clone();
            reference.step(hand, SUBSTEPS);
            let frame = run.step(hand);
            let (verdict, difference) = verdict(setup.size(), &before, frame, &reference);
            frames += 1;
            open += usize::from(verdict == Verdict::OpenPhase);
            ambiguous += usize::from(verdict == Verdict::Ambiguous);
            if verdict != Verdict::Same {
                // The next frame is compared from the solver's own pose, with the reference's own memory.
                reference = reference_at(&setup, frame, reference.stiction());
            }
            if !matches!(verdict, Verdict::Same | Verdict::OpenPhase) {
                let (state, other) = (frame.state.name(), reference.state());
                let (slips, events) = ([frame.slips, reference.slips()], &frame.events);
                report.push(format!("scene {i} frame {k} {verdict:?} {difference:.0e}: {state} / {other}, slips {slips:?}, {events:?}"));
            }
        }
    }
    println!(
        "{frames} frames, {open} with open slip phase, {ambiguous} ambiguous, {} reported",
        report.len()
    );
    let lines = report.join("\n");
    assert!(
        report.len() * 1000 <= frames,
        "{} of {frames} frames differ:\n{lines}",
        report.len()
    );
    assert!(
        open * 100 <= frames,
        "{open} of {frames} frames with open slip phase"
    );
}

#[test]
fn a_dragged_block_slips_as_often_as_in_the_reference() {
    let setup = Setup::block(2.0, 1.0)
        .held_at([0.0, 0.5])
        .at([0.0, 0.3, 0.0])
        .floor([0.5, 0.3]);
    let mut run = Run::<f64>::start(&setup, Evolution::Path, [0.0, 0.8, 0.0]);
    let mut reference = reference_at(&setup, &run.frame, true);
    for hand in [[0.0, 0.3, 0.0], [2.0, 0.3, 0.0]] {
        reference.step(hand, 100);
        let frame = run.step(hand);
        let difference = frame.pose[0] - reference.pose()[0];
        assert!(difference.abs() < 1e-9, "{difference:e}");
        assert_eq!(frame.slips, reference.slips());
    }
    assert_eq!(reference.slips(), 48);
}
