//! Output for the user: one line while the stream runs, a table at the end.

use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

use super::counts::Counts;
use crate::report;

/// The progress line: rewritten on a terminal, otherwise one below the other.
#[derive(Debug)]
pub(super) struct Screen {
    terminal: bool,
    quiet: bool,
    /// Whether the line has text.
    dirty: bool,
    last: Option<(Instant, u64)>,
}

impl Screen {
    pub(super) fn new(quiet: bool) -> Self {
        Self {
            terminal: io::stdout().is_terminal(),
            quiet,
            dirty: false,
            last: None,
        }
    }

    pub(super) fn show(&mut self, counts: &Counts) {
        let now = Instant::now();
        let (then, poses) = *self.last.get_or_insert((now, counts.poses));
        let passed = now.duration_since(then);
        if self.quiet || passed < self.interval() {
            return;
        }
        self.last = Some((now, counts.poses));
        let rate = (counts.poses - poses) as f64 / passed.as_secs_f64();
        let line = line(counts, now, rate);
        if self.terminal {
            report::print(&format!("\r\x1b[K{line}"));
            self.dirty = true;
        } else {
            report::print(&format!("{line}\n"));
        }
    }

    const fn interval(&self) -> Duration {
        match self.terminal {
            true => Duration::from_millis(200),
            false => Duration::from_secs(1),
        }
    }

    /// Prints a line that stays on the screen.
    pub(super) fn note(&mut self, text: &str) {
        self.clear();
        if !self.quiet {
            report::tell(text);
        }
    }

    pub(super) fn clear(&mut self) {
        if self.dirty {
            report::print("\r\x1b[K");
            self.dirty = false;
        }
    }
}

/// `rate`: recent answers per second.
fn line(counts: &Counts, now: Instant, rate: f64) -> String {
    let seconds = counts
        .begun
        .map_or(0.0, |begun| now.duration_since(begun).as_secs_f64());
    format!(
        "{seconds:7.1} s  {rate:5.0} Hz  latency {}  late {}  lost {}  faults {}",
        latency(counts),
        counts.late(),
        counts.lost(),
        counts.faults
    )
}

fn latency(counts: &Counts) -> String {
    let quantile = |part| counts.latency.quantile(part);
    match (quantile(0.5), quantile(0.99)) {
        (Some(median), Some(most)) => format!("{median:.2} ms (99 %: {most:.2} ms)"),
        _ => "-".to_owned(),
    }
}

/// Names and values in a column.
pub(super) fn table(title: &str, rows: &[(&str, String)]) -> String {
    let mut text = format!("{title}\n");
    for (name, value) in rows {
        text.push_str(&format!("  {name:<18}{value}\n"));
    }
    text
}

pub(super) fn summary(title: &str, counts: &Counts, seconds: f64) -> String {
    let rate = counts.poses as f64 / seconds.max(1e-9);
    let mut rows = vec![
        ("samples", format!("{} in {seconds:.3} s", counts.samples)),
        ("poses", format!("{}, {rate:.0} in a second", counts.poses)),
        (
            "latency",
            format!(
                "{}, worst {:.2} ms",
                latency(counts),
                counts.latency.worst()
            ),
        ),
        (
            "late",
            format!("{}, overtaken before a step", counts.late()),
        ),
        ("lost", counts.lost().to_string()),
    ];
    if counts.incomplete > 0 {
        rows.push((
            "incomplete",
            format!("{}, not in the trace", counts.incomplete),
        ));
    }
    rows.push(("garbled frames", counts.faults.to_string()));
    if let Some(health) = counts.health() {
        rows.push((
            "board",
            format!(
                "worst step {} µs, worst tick {} µs, {} of {} ticks missed, {} reports not sent",
                health.worst_step / 1000,
                health.worst_tick / 1000,
                health.missed_ticks,
                health.ticks,
                health.unsent
            ),
        ));
    }
    table(title, &rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_tells_rate_latency_and_losses() {
        let begun = Instant::now();
        let mut counts = Counts::default();
        counts.samples = 1000;
        counts.poses = 990;
        counts.unanswered = 10;
        counts.faults = 3;
        counts.begun = Some(begun);
        counts.latency.add(Duration::from_micros(1230));
        let text = line(&counts, begun + Duration::from_millis(1500), 990.4);
        assert_eq!(
            text,
            "    1.5 s    990 Hz  latency 1.24 ms (99 %: 1.24 ms)  late 0  lost 10  faults 3"
        );
        let text = summary("a board", &counts, 1.0);
        for part in ["1000 in 1.000 s", "990, 990 in a second", "worst 1.23 ms"] {
            assert!(text.contains(part), "{part}: {text}");
        }
    }
}
