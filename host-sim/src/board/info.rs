//! A board's description of itself, as a table.

use stiction_core::Axis;
use stiction_wire::{FaultKind, Health, Mode};

use super::message::About;
use super::print::table;

/// The board's identity and settings.
pub(super) fn about(about: &About) -> String {
    let [major, minor, patch] = about.version;
    let mode = &about.mode;
    let mut rows = vec![
        ("firmware", format!("{major}.{minor}.{patch}")),
        ("solver", about.number.name().to_owned()),
        (
            "room for",
            format!(
                "{} vertices, {} surfaces, {}, frames of {} bytes",
                about.vertices,
                about.surfaces,
                obstacles(about),
                about.longest_frame
            ),
        ),
        ("actuators", actuators(about)),
        (
            "ticks",
            format!("{} Hz, at most {} Hz", mode.tick_rate, about.fastest_tick),
        ),
        ("budget", budget(about)),
        (
            "springs now",
            format!(
                "k_h {} N/m, k_theta {} N·m/rad",
                about.stiffness[0], about.stiffness[1]
            ),
        ),
        (
            "friction now",
            format!(
                "mu_s {}, mu_d {}, memory length {}",
                about.friction_now[0],
                about.friction_now[1],
                match about.memory_now {
                    Some(length) => format!("{length} m"),
                    None => "L / 4096".to_owned(),
                }
            ),
        ),
    ];
    rows.extend(works(mode));
    table(&about.name, &rows)
}

fn obstacles(about: &About) -> String {
    match about.corners {
        0 => "no obstacles".to_owned(),
        count => format!("obstacles with {count} corners"),
    }
}

fn budget(about: &About) -> String {
    match about.budget {
        u32::MAX => "none".to_owned(),
        units => format!("{units} pieces of work in a step"),
    }
}

fn actuators(about: &About) -> String {
    let [k_h, k_theta] = about.stiffest;
    if about.actuators {
        format!("yes, passive below k_h {k_h} N/m, k_theta {k_theta} N·m/rad")
    } else {
        "none".to_owned()
    }
}

fn works(mode: &Mode) -> [(&'static str, String); 5] {
    let every = |count: u16, unit: &str| match count {
        0 => "none".to_owned(),
        1 => format!("every {unit}"),
        count => format!("every {count} {unit}s"),
    };
    let events = if mode.events { "yes" } else { "no" };
    let [x, y] = mode.plane.map(axis);
    [
        ("evolution", mode.evolution.name().to_owned()),
        ("stepping", mode.stepping.name().to_owned()),
        ("tracker's plane", format!("{x}{y}")),
        (
            "poses, forces",
            format!(
                "{}, {}; events: {events}",
                every(mode.pose_every, "step"),
                every(mode.forces_every, "step")
            ),
        ),
        (
            "health",
            match mode.health_every {
                0 => "never".to_owned(),
                period => format!("every {period} ms"),
            },
        ),
    ]
}

fn axis(axis: Axis) -> String {
    let sign = if axis.negative { "-" } else { "" };
    let letter = ["x", "y", "z"].get(axis.index).unwrap_or(&"?");
    format!("{sign}{letter}")
}

pub(super) fn health(health: &Health) -> String {
    let faults: Vec<String> = FaultKind::ALL
        .iter()
        .filter(|kind| health.faults.of(**kind) > 0)
        .map(|kind| format!("{} {}", kind.name(), health.faults.of(*kind)))
        .collect();
    let faults = match faults.is_empty() {
        true => "none".to_owned(),
        false => faults.join(", "),
    };
    let microseconds = |nanoseconds: u32| f64::from(nanoseconds) / 1000.0;
    table(
        "since it was switched on",
        &[
            ("force to the hand", health.drive.name().to_owned()),
            (
                "ticks",
                format!("{}, {} missed", health.ticks, health.missed_ticks),
            ),
            (
                "samples",
                format!("{}, {} late", health.samples, health.late_samples),
            ),
            ("lost frames", health.lost_frames.to_string()),
            ("reports not sent", health.unsent.to_string()),
            ("faulty frames", faults),
            (
                "worst step, tick",
                format!(
                    "{:.1} µs, {:.1} µs",
                    microseconds(health.worst_step),
                    microseconds(health.worst_tick)
                ),
            ),
        ],
    )
}
