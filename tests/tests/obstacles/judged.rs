//! Runs of the solver among obstacles before the judge of traces: frames, and what follows from the frames before.

use stiction_core::Evolution;
use stiction_judge::{Bounds, Judge};
use stiction_tests::Number;
use stiction_tests::obstacles::before_judge::{frame, scene};
use stiction_tests::obstacles::worlds::world;
use stiction_tests::obstacles::{Among, Run, cases};

fn look<R: Number>(
    name: &str,
    among: &Among,
    hands: &[[f64; 3]],
    evolution: Evolution,
    bounds: Bounds,
) -> usize {
    let of_judge = match evolution {
        Evolution::Path => stiction_judge::Evolution::Path,
        _ => stiction_judge::Evolution::Frame,
    };
    let mut judge = Judge::new(scene::<R>(among), bounds, of_judge);
    let mut run = Run::<R>::start(among, evolution, hands[0]);
    let mut count = 0;
    let mut last = None;
    for (i, &hand) in hands.iter().enumerate() {
        if i > 0 {
            run.step(hand);
        }
        let now = frame(i, &run.frame);
        for finding in judge.next(now.clone()) {
            if !finding.holds() {
                count += 1;
                if count <= 2 {
                    println!(
                        "{name} frame {i}: {} {:.2e} {:.1e}\n   {last:?}\n   {now:?}",
                        finding.law, finding.residual, finding.bound
                    );
                }
            }
        }
        last = Some(now);
    }
    count
}

#[test]
fn explore() {
    for case in cases::all().into_iter().filter(|c| !c.refused) {
        for evolution in [Evolution::Path, Evolution::Frame] {
            let n = look::<f64>(
                &case.name,
                &case.among,
                &case.hands,
                evolution,
                Bounds::DOUBLE,
            );
            let m = look::<f32>(
                &case.name,
                &case.among,
                &case.hands,
                evolution,
                Bounds::SINGLE,
            );
            println!("## {} {evolution:?} {n} {m}", case.name);
        }
    }
    for number in 0..150 {
        let world = world(number);
        let hands = world.hands();
        let n = look::<f64>(
            &format!("world {number}"),
            &world.among,
            &hands,
            Evolution::Path,
            Bounds::DOUBLE,
        );
        let m = look::<f32>(
            &format!("world {number} f32"),
            &world.among,
            &hands,
            Evolution::Path,
            Bounds::SINGLE,
        );
        println!("## world {number} {n} {m}");
    }
}
