//! Starts the processes of a survey, restarts them after a step that never ends, and adds up their reports.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};
use std::sync::mpsc::{Sender, channel};
use std::thread;

/// Processes that run simultaneously.
const PARTS: u64 = 2;
/// Unlawful frames of a scene that are printed.
const PRINTED: usize = 3;

/// The reports of all processes.
#[derive(Default)]
struct Total {
    scenes: u64,
    frames: u64,
    unlawful: BTreeMap<String, Law>,
    unlawful_frames: u64,
    unlawful_scenes: u64,
    statuses: BTreeMap<String, u64>,
    states: BTreeMap<String, u64>,
    others: BTreeMap<String, u64>,
    work: u64,
    /// Scene, last unlawful frame and how many were printed, by process.
    last: BTreeMap<u64, (u64, u64, usize)>,
}

#[derive(Default)]
struct Law {
    frames: u64,
    worst: f64,
    place: String,
}

/// Examines `count` scenes; `part` is the command of a process.
pub(crate) fn survey(command: &str, count: u64, number: &str, evolution: &str) {
    let (send, receive) = channel();
    for part in 0..PARTS {
        let (send, names) = (
            send.clone(),
            [command, number, evolution].map(str::to_owned),
        );
        thread::spawn(move || run_part(part, count, &names, &send));
    }
    drop(send);
    let mut total = Total::default();
    for line in receive {
        total.take(&line);
    }
    total.print(number, evolution);
}

fn run_part(
    part: u64,
    count: u64,
    [part_command, number, evolution]: &[String; 3],
    send: &Sender<String>,
) {
    let Ok(program) = std::env::current_exe() else {
        return;
    };
    let mut from = part;
    while from < count {
        let mut command = Command::new(&program);
        let bounds = [from, PARTS, count].map(|n| n.to_string());
        command
            .arg(part_command)
            .args(bounds)
            .args([number, evolution]);
        let Ok(mut child) = command.stdout(Stdio::piped()).spawn() else {
            return;
        };
        let mut begun: Option<u64> = None;
        let mut ended = None;
        let lines = child
            .stdout
            .take()
            .into_iter()
            .flat_map(|out| BufReader::new(out).lines());
        for line in lines.map_while(Result::ok) {
            let scene = line.split(' ').nth(1).and_then(|n| n.parse().ok());
            if line.starts_with("begin ") {
                begun = scene;
            } else if line.starts_with("end ") {
                ended = scene;
            }
            let _ = send.send(line);
        }
        let status = child.wait();
        match begun {
            // The process ended in the middle of a scene.
            Some(scene) if begun != ended => {
                let code = status.ok().and_then(|status| status.code());
                if code != Some(stiction_tests::obstacles::survey::NEVER_ENDS) {
                    let _ = send.send(format!("crash {scene} {code:?}"));
                }
                let _ = send.send(format!("end {scene} 0 0"));
                from = scene + PARTS;
            }
            Some(_) => return,
            None => {
                eprintln!("a process that does not start: {status:?}");
                return;
            }
        }
    }
}

impl Total {
    fn take(&mut self, line: &str) {
        let mut words = line.splitn(4, ' ');
        let mut next = || words.next().unwrap_or_default();
        let (what, scene, count, rest) = (next(), next(), next(), next());
        let number: u64 = count.parse().unwrap_or_default();
        let scene: u64 = scene.parse().unwrap_or_default();
        match what {
            "begin" => {}
            "end" => {
                self.scenes += 1;
                self.frames += number;
                self.work = self.work.max(rest.parse().unwrap_or_default());
            }
            "status" => *self.statuses.entry(rest.to_owned()).or_default() += number,
            "state" => *self.states.entry(rest.to_owned()).or_default() += number,
            "unlawful" => self.unlawful(scene, number, rest),
            other => {
                println!("{line}");
                *self.others.entry(other.to_owned()).or_default() += 1;
            }
        }
    }

    fn unlawful(&mut self, scene: u64, frame: u64, rest: &str) {
        let mut words = rest.splitn(3, ' ');
        let amount: f64 = words
            .next()
            .and_then(|n| n.parse().ok())
            .unwrap_or_default();
        let residual = words.next().unwrap_or_default();
        let law = words.next().unwrap_or_default();
        let part = self.last.entry(scene % PARTS).or_insert((u64::MAX, 0, 0));
        if part.0 != scene {
            *part = (scene, u64::MAX, 0);
            self.unlawful_scenes += 1;
        }
        if part.1 != frame {
            (part.1, part.2) = (frame, part.2 + 1);
            self.unlawful_frames += 1;
        }
        if part.2 <= PRINTED {
            println!(
                "scene {scene} frame {frame}: {law}: {amount:.1e} times what is allowed ({residual})"
            );
        } else if part.2 == PRINTED + 1 {
            println!("scene {scene} ...");
            part.2 += 1;
        }
        let known = self.unlawful.entry(law.to_owned()).or_default();
        known.frames += 1;
        if amount > known.worst {
            (known.worst, known.place) = (amount, format!("scene {scene} frame {frame}"));
        }
    }

    fn print(&self, number: &str, evolution: &str) {
        let Self {
            scenes,
            frames,
            unlawful_frames,
            unlawful_scenes,
            ..
        } = self;
        println!(
            "\n{number} {evolution}: {scenes} scenes, {frames} frames, {unlawful_frames} unlawful in {unlawful_scenes} scenes; most work {}",
            self.work
        );
        for (law, known) in &self.unlawful {
            let (frames, worst, place) = (known.frames, known.worst, &known.place);
            println!("  {law}: {frames} frames, worst {worst:.1e} times in {place}");
        }
        for (title, counts) in [
            ("status", &self.statuses),
            ("scenes", &self.others),
            ("state", &self.states),
        ] {
            let list: Vec<_> = counts
                .iter()
                .map(|(name, n)| format!("{name} {n}"))
                .collect();
            println!("  {title}: {}", list.join(", "));
        }
    }
}
