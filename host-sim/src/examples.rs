//! The examples at the end of each command's help. Each works as it is typed, in this order, in any folder, except those of
//! `sweep`, which need a checkout.

use clap::Command;

/// Examples of the program as a whole.
const FIRST: [&str; 4] = [
    "stiction",
    "stiction scenes",
    "stiction view ladder",
    "stiction run ladder --plot plots",
];

const ALL: &[(&str, &[&str])] = &[
    (
        "view",
        &[
            "stiction view ladder",
            "stiction view peg-in-hole --number f64 --listen 8500",
            "stiction view --headless --osc 127.0.0.1:9000",
        ],
    ),
    (
        "run",
        &[
            "stiction run ladder",
            "stiction run ladder --out ladder.jsonl --plot plots",
            "stiction run box-flat --number fixed --rate 250 --record box.jsonl",
        ],
    ),
    (
        "scenes",
        &["stiction scenes", "stiction scenes --out scenes"],
    ),
    (
        "new",
        &[
            "stiction new mine",
            "stiction new my-table --like table-edge",
            "stiction run mine.toml",
        ],
    ),
    (
        "replay",
        &[
            "stiction run ladder --record ladder-recording.jsonl",
            "stiction replay ladder-recording.jsonl",
        ],
    ),
    (
        "check",
        &[
            "stiction run ladder --out ladder.jsonl",
            "stiction check ladder.jsonl --scene ladder",
        ],
    ),
    (
        "trade",
        &[
            "stiction trade --quick",
            "stiction trade --emulated --table",
        ],
    ),
    (
        "sweep",
        &[
            "stiction sweep host-sim/sweeps/friction-stiffness.toml --dry-run",
            "stiction sweep host-sim/sweeps/friction-stiffness.toml --shard 1/4",
        ],
    ),
    (
        "board",
        &[
            "stiction board --emulate",
            "stiction board box-flat --verify --emulate pico",
            "stiction board ladder --port auto --out board.jsonl",
        ],
    ),
    (
        "info",
        &["stiction info --emulate", "stiction info --port auto"],
    ),
    (
        "image",
        &[
            "stiction image pico",
            "stiction image pico ladder --out ladder.uf2",
        ],
    ),
    (
        "code",
        &[
            "stiction code table-edge --name table",
            "stiction code ladder --number fixed",
        ],
    ),
    (
        "completions",
        &[
            "stiction completions bash > stiction.bash",
            "stiction completions fish > stiction.fish",
        ],
    ),
    ("man", &["stiction man man1"]),
];

/// Returns every command with its examples at the end of its help.
pub(crate) fn add(program: Command) -> Command {
    let program = program.after_help(text(&FIRST));
    ALL.iter().fold(program, |program, (name, examples)| {
        program.mut_subcommand(name, |command| command.after_help(text(examples)))
    })
}

fn text(examples: &[&str]) -> String {
    format!("Examples:\n  {}", examples.join("\n  "))
}
