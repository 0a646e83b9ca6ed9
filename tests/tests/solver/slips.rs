//! What a frame reports about its slips: how many occurred, and how far the first contact moved in the longest one.

use stiction_core::{Event, Evolution, Fixed, StateKind, Status};
use stiction_tests::random::scenarios;
use stiction_tests::run::run;
use stiction_tests::{Frame, Number, Run, scenes, times};

/// The displacement of the first contact in a frame in which that contact persists, and no other slides.
fn way(before: &Frame, after: &Frame) -> Option<f64> {
    let pairs = |frame: &Frame| -> Vec<_> {
        let contacts = frame.contacts.iter();
        contacts.map(|c| c.touch).collect()
    };
    let only_slips = after.events.iter().all(|event| *event == Event::Slip);
    let slides = [before, after].map(|frame| frame.contacts.iter().any(|c| c.sliding != 0));
    if before.state != after.state
        || pairs(before) != pairs(after)
        || !only_slips
        || slides.contains(&true)
    {
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
    for scenario in named.chain(scenarios(times(10, 100), 4)) {
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

/// A hand that rises obliquely causes slips that become ever shorter as the box lifts; the later events of the same frame, here slips
/// along a wall, follow the hand's path as they do over many frames.
fn way_goes_on_after_slips_that_crowd<R: Number>() {
    let setup = scenes::box_flat().setup.wall(0.13, [0.5, 0.3]);
    let [x, y] = setup.grip();
    let (pressed, raised) = ([x, y - 0.01, 0.0], [x + 0.1, y + 0.05, 0.0]);
    let ends = [1, 7, 100].map(|frames| {
        let mut run = Run::<R>::start(&setup, Evolution::Path, [x, y, 0.0]);
        run.lead(pressed, 10);
        let frames = run.lead(raised, frames);
        let slips = frames.iter().map(|frame| frame.slips).sum::<u32>();
        (slips, frames.into_iter().last().expect("frames"))
    });
    for (slips, end) in &ends {
        assert!(*slips > 20, "{slips}");
        let (_, many) = &ends[2];
        assert_eq!(end.state, many.state);
        for (a, b) in end.pose.iter().zip(many.pose) {
            assert!((a - b).abs() < 2e-5, "{}: {end:?} for {many:?}", R::NAME);
        }
    }
}

#[test]
fn way_goes_on_after_slips_that_crowd_in_every_number_type() {
    way_goes_on_after_slips_that_crowd::<f64>();
    way_goes_on_after_slips_that_crowd::<f32>();
    way_goes_on_after_slips_that_crowd::<Fixed>();
}

/// If mu_s = mu_d, the box slides as the hand drags it, until it meets the wall 30 mm ahead. That does not count as a slip.
fn slide_up_to_a_wall_is_no_slip<R: Number>() {
    let mut setup = scenes::box_flat().setup.wall(0.13, [0.3, 0.3]);
    (
        setup.surfaces[0].friction_static,
        setup.surfaces[0].friction_dynamic,
    ) = (0.3, 0.3);
    let [x, y] = setup.grip();
    let mut run = Run::<R>::start(&setup, Evolution::Path, [x, y, 0.0]);
    run.lead([x, y - 0.01, 0.0], 10);
    let end = run.step([x + 0.1, y - 0.01, 0.0]);
    assert_eq!((end.status, end.state), (Status::Ok, StateKind::Locked));
    assert_eq!((end.slips, end.longest_slip), (0, 0.0), "{}", R::NAME);
    let reported = [Event::Slide, Event::Jam, Event::Stop];
    assert_eq!(end.events, reported, "{}: {end:?}", R::NAME);
    assert!((end.pose[0] - 0.08).abs() < 1e-6, "{}: {end:?}", R::NAME);
}

#[test]
fn slide_up_to_a_wall_is_no_slip_in_any_number_type() {
    slide_up_to_a_wall_is_no_slip::<f64>();
    slide_up_to_a_wall_is_no_slip::<f32>();
    slide_up_to_a_wall_is_no_slip::<Fixed>();
}
