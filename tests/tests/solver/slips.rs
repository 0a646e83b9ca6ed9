//! What is told of slips: how many, and how far the first contact went in the longest.

use stiction_core::{Event, Evolution, Fixed};
use stiction_tests::random::scenarios;
use stiction_tests::run::run;
use stiction_tests::{Frame, Number, budget, scenes};

/// How far the first contact went in a frame that it lasted, and the first contact alone slides.
fn way(before: &Frame, after: &Frame) -> Option<f64> {
    let pairs = |frame: &Frame| -> Vec<_> {
        let contacts = frame.contacts.iter();
        contacts.map(|c| (c.vertex, c.surface)).collect()
    };
    let only_slips = after.events.iter().all(|event| *event == Event::Slip);
    if before.state != after.state || pairs(before) != pairs(after) || !only_slips {
        return None;
    }
    let (from, to) = (
        before.contacts.first()?.point,
        after.contacts.first()?.point,
    );
    Some((to[0] - from[0]).hypot(to[1] - from[1]))
}

fn longest_slip_is_the_way_of_the_foot<R: Number>() {
    let named = scenes::all().into_iter().map(|(_, scenario)| scenario);
    let mut states = Vec::new();
    for scenario in named.chain(scenarios(budget(100, 10), 4)) {
        let size = scenario.setup.size();
        for evolution in Evolution::ALL {
            let frames = run::<R>(&scenario.setup, evolution, &scenario.hands(40));
            for pair in frames.windows(2) {
                let Some(way) = way(&pair[0], &pair[1]) else {
                    continue;
                };
                let frame = &pair[1];
                let off = 1e2 * R::ROUNDING * size;
                let longest = frame.longest_slip;
                if frame.slips <= 1 {
                    assert!(
                        (way - longest).abs() <= off,
                        "{way} {longest} {off} {frame:?}"
                    );
                } else {
                    assert!(
                        way <= f64::from(frame.slips) * (longest + off),
                        "{way} {frame:?}"
                    );
                }
                if frame.slips == 1 && longest > 10.0 * off && !states.contains(&frame.state) {
                    states.push(frame.state);
                }
            }
        }
    }
    assert!(
        states.len() >= 3,
        "one vertex, two, and an edge: {states:?}"
    );
}

#[test]
fn longest_slip_is_how_far_the_first_contact_went() {
    longest_slip_is_the_way_of_the_foot::<f64>();
    longest_slip_is_the_way_of_the_foot::<f32>();
    longest_slip_is_the_way_of_the_foot::<Fixed>();
}
