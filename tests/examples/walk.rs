//! A long random walk of the hand: a box with weight between a floor and a wall, with the laws judged on every frame. Every
//! 100 000 frames the body is taken into the air, where its pose must equal the closed form: nothing has drifted.
//!
//! ```sh
//! cargo run --release -p stiction-tests --example walk -- 1000000000   # steps, over three number types and two evolutions
//! ```

use std::process::ExitCode;
use stiction_core::{Evolution, Fixed, StateKind, Status};
use stiction_tests::laws::{FINITE, judge, worst};
use stiction_tests::{Number, Run, Setup};

/// The number of frames between two checks of the drift.
const ROUND: u64 = 100_000;
/// Steps of the hand (m, rad) of many sizes, so that it creeps, drags and jumps.
const STRIDES: [f64; 4] = [1e-5, 1e-4, 1e-3, 1e-2];
/// Limits of x, y (m) and phi (rad) of the hand.
const RANGE: [[f64; 2]; 3] = [[-0.1, 0.11], [-0.01, 0.12], [-1.2, 1.2]];
/// The number of steps, unless the command line gives another.
const STEPS: u64 = 10_000_000;

/// Random numbers (splitmix64).
struct Random(u64);

impl Random {
    /// The next number, in [-1, 1).
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / (1u64 << 63) as f64 - 1.0
    }
}

/// The results of a walk.
#[derive(Default)]
struct Tally {
    steps: u64,
    states: [u64; StateKind::ALL.len()],
    limited: u64,
    unlawful: u64,
    drift: f64,
    first: Option<String>,
}

impl Tally {
    fn look<R: Number>(&mut self, setup: &Setup, run: &Run<R>) {
        let frame = &run.frame;
        self.steps += 1;
        if let Some(i) = StateKind::ALL.iter().position(|&s| s == frame.state) {
            self.states[i] += 1;
        }
        let claims = frame.status <= Status::EventLimit;
        self.limited += u64::from(frame.status != Status::Ok);
        let findings = judge::<R>(setup, frame).into_iter();
        let finding = worst(findings.filter(|f| claims || f.law == FINITE));
        if !finding.holds() {
            self.unlawful += 1;
            let step = self.steps;
            self.first.get_or_insert_with(|| {
                format!(
                    "step {step}: {} off by {:.1e}: {frame:?}",
                    finding.law, finding.residual
                )
            });
        }
    }
}

fn walk<R: Number>(steps: u64, evolution: Evolution) -> Tally {
    let setup = Setup::bench_box()
        .at([0.0, 0.03, 0.0])
        .weighing(1.0)
        .floor([0.5, 0.3])
        .surface([-0.8, 0.6], -0.096, [0.4, 0.3]);
    let grip = setup.grip();
    let mut hand = [grip[0], grip[1], 0.0];
    let mut run = Run::<R>::start(&setup, evolution, hand);
    let mut free = Run::<R>::start(&setup, evolution, hand);
    let aloft = [0.0, 0.3, 0.1];
    let aloft_at_once = free.lead(aloft, 300).pop().map(|frame| frame.pose);
    let mut random = Random(1);
    let mut tally = Tally::default();
    while tally.steps < steps {
        for i in 0..ROUND {
            let stride = STRIDES[(i / 64 % 4) as usize];
            for (x, [low, high]) in hand.iter_mut().zip(RANGE) {
                let wide = if high - low > 1.0 { 10.0 } else { 1.0 };
                *x = (*x + wide * stride * random.next()).clamp(low, high);
            }
            run.step(hand);
            tally.look(&setup, &run);
        }
        // Straight up, away from both surfaces, to the pose of a body that has never walked.
        let above = [hand[0].min(0.0), 0.3, hand[2]];
        for frame in run.lead(above, 200).into_iter().chain(run.lead(aloft, 100)) {
            tally.steps += 1;
            tally.limited += u64::from(frame.status != Status::Ok);
        }
        let apart = aloft_at_once.map_or(f64::INFINITY, |there| {
            let here = run.frame.pose;
            (0..3)
                .map(|k| (here[k] - there[k]).abs())
                .fold(0.0, f64::max)
        });
        tally.drift = tally.drift.max(apart);
        run.lead(hand, 100);
    }
    tally
}

fn report<R: Number>(steps: u64) -> bool {
    Evolution::ALL.into_iter().all(|evolution| {
        let tally = walk::<R>(steps / 6, evolution);
        let states = StateKind::ALL.iter().zip(tally.states);
        let states: Vec<_> = states
            .map(|(state, n)| format!("{} {n}", state.name()))
            .collect();
        println!(
            "{} {evolution:?}: {} steps ({}), status not ok {}, unlawful {}, drift {:.1e}",
            R::NAME,
            tally.steps,
            states.join(", "),
            tally.limited,
            tally.unlawful,
            tally.drift
        );
        if let Some(first) = &tally.first {
            println!("  {first}");
        }
        // A few roundings of an angle and of a position: no more after many steps than after few.
        tally.unlawful == 0 && tally.drift <= 16.0 * R::ROUNDING
    })
}

fn main() -> ExitCode {
    let steps = match std::env::args().nth(1) {
        None => STEPS,
        Some(text) => match text.parse() {
            Ok(steps) => steps,
            Err(_) => {
                eprintln!("walk: the number of steps is {text:?}, allowed: a whole number");
                return ExitCode::from(2);
            }
        },
    };
    let lawful = [
        report::<f32>(steps),
        report::<Fixed>(steps),
        report::<f64>(steps),
    ];
    if lawful == [true; 3] {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
