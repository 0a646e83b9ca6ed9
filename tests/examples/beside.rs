//! Runs the slow reference beside the solver (f64, along the path) on random scenes among obstacles: the share of frames with the same
//! contacts.
//!
//! ```sh
//! cargo run --release -p stiction-tests --example beside -- 50   # scenes 0 to 49
//! ```

use std::process::ExitCode;
use stiction_core::Evolution;
use stiction_tests::obstacles::Run;
use stiction_tests::obstacles::answers::frame_of;
use stiction_tests::obstacles::laws::Laws;
use stiction_tests::obstacles::run::touches;
use stiction_tests::obstacles::worlds::world;
use stiction_tests::reference::Reference;

/// The number of substeps per frame for the hand of the reference.
const SUBSTEPS: usize = 20;
/// Poses that differ by more than this are different, in body sizes and rad.
const SAME: f64 = 1e-3;

/// How well runs of the solver and of the reference agree.
#[derive(Default)]
struct Total {
    /// Frames that were compared: all those before the reference gives up.
    frames: usize,
    /// Frames with the same contacts, and those of them with the same pose.
    contacts: usize,
    poses: usize,
    /// Scenes whose contacts are the same in every frame.
    whole: usize,
}

fn compare(number: u64, total: &mut Total) {
    let world = world(number);
    let among = &world.among;
    let laws = Laws::new::<f64>(among);
    let hands = world.hands();
    let scene = among.reference();
    let mut body = Reference::new(scene.clone(), among.setup.start, hands[0]);
    let mut run = Run::<f64>::start(among, Evolution::Path, hands[0]);
    let mut differs = false;
    for (i, &hand) in hands.iter().enumerate() {
        if i > 0 {
            body.step(hand, SUBSTEPS);
            run.step(hand);
        }
        if body.ambiguous() || body.skipped() {
            println!("scene {number} frame {i}: the reference gives up");
            break;
        }
        let frame = frame_of(&scene, &body, (0.0, hand));
        for finding in laws.broken(&frame) {
            let (law, amount) = (finding.law, finding.severity());
            println!(
                "scene {number} frame {i}: the reference: {law}: {amount:.1e} times what is allowed"
            );
        }
        let [solver, reference] = [&run.frame, &frame].map(touches);
        let same = solver == reference;
        if !same && !differs {
            println!("scene {number} frame {i}: {solver:?}, reference {reference:?}");
            differs = true;
        }
        let [x, y, turn] = [0, 1, 2].map(|k| (run.frame.pose[k] - frame.pose[k]).abs());
        let near = (x.max(y) / among.setup.size()).max(turn) <= SAME;
        total.frames += 1;
        total.contacts += usize::from(same);
        total.poses += usize::from(same && near);
    }
    total.whole += usize::from(!differs);
}

fn main() -> ExitCode {
    let Some(count) = std::env::args().nth(1).and_then(|n| n.parse().ok()) else {
        eprintln!("usage: beside SCENES");
        return ExitCode::from(2);
    };
    let mut total = Total::default();
    (0..count).for_each(|number| compare(number, &mut total));
    let share = |part: usize| 100.0 * part as f64 / total.frames.max(1) as f64;
    println!(
        "{} frames; same contacts {:.2} %, and within 1e-3 L {:.2} %; {} whole scenes",
        total.frames,
        share(total.contacts),
        share(total.poses),
        total.whole
    );
    ExitCode::SUCCESS
}
