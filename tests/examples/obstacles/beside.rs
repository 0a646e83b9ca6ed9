//! Compares the slow reference with the solver on random scenes: the share of frames with the same contacts.

use std::time::Duration;
use stiction_core::Evolution;
use stiction_tests::Number;
use stiction_tests::obstacles::compare::{Comparison, compare};
use stiction_tests::obstacles::guard::{Outcome, within};

/// More time than any scene takes.
const LIMIT: Duration = Duration::from_secs(60);

/// Scenes `from` .. `to`.
pub(crate) fn beside<R: Number>((from, to): (u64, u64), evolution: Evolution) {
    std::panic::set_hook(Box::new(|_| {}));
    let mut total = Comparison::default();
    let mut whole = 0;
    for scene in from..to {
        let one = match within(LIMIT, move || compare::<R>(scene, evolution)) {
            Outcome::Done(one) => one,
            Outcome::Panic(words) => {
                println!("scene {scene}: panic: {words}");
                continue;
            }
            Outcome::Late => {
                println!("scene {scene}: more than {LIMIT:?}");
                continue;
            }
        };
        if let Some((frame, [solver, reference])) = &one.first_other {
            println!("scene {scene} frame {frame}: {solver:?}, reference {reference:?}");
        } else {
            whole += 1;
        }
        if let Some((frame, law, amount)) = one.unlawful {
            println!(
                "scene {scene} frame {frame}: the reference: {law}: {amount:.1e} times what is allowed"
            );
        }
        if let Some(frame) = one.gave_up {
            println!("scene {scene} frame {frame}: the reference gives up");
        }
        total.frames += one.frames;
        total.contacts += one.contacts;
        total.poses += one.poses;
        for (sum, of_one) in total.touching.iter_mut().zip(one.touching) {
            *sum += of_one;
        }
    }
    let share = |part: usize, of: usize| 100.0 * part as f64 / of.max(1) as f64;
    let [touching, same] = total.touching;
    println!(
        "\n{} {}: {} frames; same contacts {:.2} %, and within 1e-3 L {:.2} %; of {touching} frames in contact {:.2} %; {whole} whole scenes",
        R::NAME,
        evolution.name(),
        total.frames,
        share(total.contacts, total.frames),
        share(total.poses, total.frames),
        share(same, touching),
    );
}
