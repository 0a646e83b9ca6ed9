//! Which event leads from which state to which: the arms of the law as they are seen from outside.

use crate::bench::{Run, Setup, side};
use std::collections::BTreeSet;
use stiction_core::{Event, Evolution, StateKind, SurfaceDescription};

/// From each of these states to each of those.
fn arms(event: Event) -> (&'static [StateKind], &'static [StateKind]) {
    use StateKind::{Corner, Edge, Locked, NonContact, SingleVertex, TwoVertex};
    match event {
        Event::Touch => (
            &[NonContact, SingleVertex],
            &[SingleVertex, TwoVertex, Corner],
        ),
        Event::Land => (&[NonContact, SingleVertex], &[Edge]),
        Event::Jam => (&StateKind::ALL, &[Locked]),
        Event::Lift => (
            &StateKind::ALL,
            &[NonContact, SingleVertex, Edge, TwoVertex, Corner],
        ),
        Event::Tip => (&[Edge, Locked], &[SingleVertex, Locked]),
        Event::Slip | Event::Slide | Event::Stop => (
            &[SingleVertex, Edge, TwoVertex],
            &[SingleVertex, Edge, TwoVertex],
        ),
        Event::Snap => (&StateKind::ALL, &StateKind::ALL),
        Event::Grasp | Event::Release => (&[], &[]),
    }
}

/// Multiples of the golden ratio without their integers: numbers that are spread evenly.
struct Spread(f64);
impl Spread {
    fn number(&mut self, least: f64, most: f64) -> f64 {
        self.0 = (self.0 + 0.618_033_988_749_894_9).fract();
        least + (most - least) * self.0
    }
}

/// A block in a corner of floor and wall, under a ceiling.
fn room(spread: &mut Spread) -> Setup {
    let mut mu = || {
        let fixed = spread.number(0.1, 0.9);
        [fixed, fixed * 0.6]
    };
    Setup {
        vertices: vec![[-0.4, -0.3], [0.4, -0.3], [0.4, 0.3], [-0.4, 0.3]],
        held: Some([0.1, 0.1]),
        springs: [1.0, 0.3],
        start: [0.0, 0.0, 0.2],
        surfaces: [
            side([0.0, 1.0], -0.6, mu()),
            side([1.0, 0.0], -0.8, mu()),
            side([0.0, -1.0], -0.6, mu()),
        ]
        .map(|s| SurfaceDescription { memory: None, ..s })
        .into(),
        ..Setup::default()
    }
}

#[test]
fn an_event_leads_from_its_states_to_its_states() {
    let mut spread = Spread(0.0);
    let mut seen = BTreeSet::new();
    for _ in 0..20 {
        let setup = room(&mut spread);
        let mut run = Run::<f64>::new(&setup, Evolution::Path, [0.1, 0.1, 0.2]);
        for _ in 0..12 {
            let to = [
                spread.number(-1.2, 0.5),
                spread.number(-1.0, 1.0),
                spread.number(-1.5, 1.5),
            ];
            let from = run.at();
            for k in 1..=60 {
                let before = run.output.state;
                let part = f64::from(k) / 60.0;
                run.to([0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * part));
                let after = run.output.state;
                let [event] = run.output.events() else {
                    assert!(before == after || !run.output.events().is_empty());
                    continue;
                };
                let (befores, afters) = arms(*event);
                let allowed = befores.contains(&before) && afters.contains(&after);
                let stays = matches!(event, Event::Slip | Event::Slide | Event::Stop);
                assert!(
                    allowed && (!stays || before == after),
                    "{event:?}: {before:?} to {after:?}"
                );
                seen.insert((event.name(), before.name(), after.name()));
            }
        }
    }
    // All but the rare: a fold, a vertex that reaches two sides.
    let events: BTreeSet<_> = seen.iter().map(|(event, _, _)| *event).collect();
    let states: BTreeSet<_> = seen.iter().flat_map(|arm| [arm.1, arm.2]).collect();
    assert!(events.len() >= 6 && states.len() >= 4, "{seen:?}");
}
