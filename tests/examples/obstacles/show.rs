//! A random scene as a scene file, and single frames of its run in full.

use stiction_core::Evolution;
use stiction_judge::{Frame, Status};
use stiction_tests::Number;
use stiction_tests::obstacles::laws::Laws;
use stiction_tests::obstacles::run::touches;
use stiction_tests::obstacles::shape::{placed, separation};
use stiction_tests::obstacles::survey::{Kind, kind};
use stiction_tests::obstacles::{Among, Run};

/// Prints a scene and the requested frames; if none are requested, a line for each frame in which something changes.
pub(crate) fn show<R: Number>((scenes, number): (Kind, u64), evolution: Evolution, frames: &[u64]) {
    let world = scenes.scene::<R>(number);
    println!("# scene {number}\n{}", world.toml());
    let hands = world.hands();
    let last = frames
        .iter()
        .max()
        .map_or(hands.len() - 1, |&last| last as usize);
    let laws = Laws::new::<R>(&world.among);
    let mut run = Run::<R>::start(&world.among, evolution, hands[0]);
    let mut before = None;
    for (i, &hand) in hands.iter().enumerate().take(last + 1) {
        if frames.contains(&(i as u64)) {
            println!("frame {i}: the hand goes to {hand:?}");
        }
        if i > 0 {
            run.step(hand);
        }
        let frame = &run.frame;
        if frames.contains(&(i as u64)) {
            in_full(&world.among, frame);
            println!("  work    {}", run.output.work);
        }
        let broken = laws.broken_in(world.room.as_deref(), frame);
        let named = (kind(frame), touches(frame));
        let is_new = before.as_ref() != Some(&named);
        let is_shown = frames.is_empty() && (is_new || frame.status != Status::Ok);
        if is_shown || !broken.is_empty() {
            let (status, events) = (frame.status.name(), &frame.events);
            println!("frame {i}: {} {status} {events:?} {:?}", named.0, named.1);
        }
        for finding in broken {
            let (law, amount, residual) = (finding.law, finding.severity(), finding.residual);
            println!("  UNLAWFUL {law}: {amount:.1e} times what is allowed ({residual:.2e})");
        }
        before = Some(named);
    }
}

fn in_full(among: &Among, frame: &Frame) {
    println!("  hand    {:?}\n  pose    {:?}", frame.hand, frame.pose);
    println!("  state   {}, {}", frame.state.name(), frame.status.name());
    println!("  events  {:?}, {} slips", frame.events, frame.slips);
    println!("  wrench  {:?}", frame.wrench);
    for contact in &frame.contacts {
        println!("  {contact:?}");
    }
    let body = placed(&among.setup.vertices, frame.pose);
    let apart = among
        .obstacles
        .iter()
        .map(|o| separation(&body, &o.vertices));
    let apart: Vec<_> = apart.map(|apart| format!("{apart:.3e}")).collect();
    println!("  m from the obstacles  {}", apart.join(" "));
}
