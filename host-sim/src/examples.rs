//! The examples at the end of each command's help. Each works as it is typed, in this order, in any folder, except those of
//! `sweep`, which need a checkout.

use clap::Command;

/// Commands, or the program as a whole, each with one of its examples.
const ALL: &str = "\
stiction: stiction
stiction: stiction scenes
stiction: stiction view ladder
stiction: stiction run ladder --plot plots
view: stiction view ladder
view: stiction view peg-in-hole --number f64 --listen 8500
view: stiction view --headless --osc 127.0.0.1:9000
run: stiction run ladder
run: stiction run ladder --out ladder.jsonl --plot plots
run: stiction run box-flat --number fixed --rate 250 --record box.jsonl
run: stiction run ladder --plot ladder.pdf --picture strip --at 0.5,1.5 --width 85mm
figures: stiction figures --paper figures
figures: stiction figures --paper figures --format svg --width 180mm
scenes: stiction scenes
scenes: stiction scenes --out scenes
new: stiction new mine
new: stiction new my-table --like table-edge
new: stiction run mine.toml
replay: stiction run ladder --record ladder-recording.jsonl
replay: stiction replay ladder-recording.jsonl
check: stiction run ladder --out ladder.jsonl
check: stiction check ladder.jsonl --scene ladder
trade: stiction trade --quick
trade: stiction trade --emulated --table
sweep: stiction sweep host-sim/sweeps/friction-stiffness.toml --dry-run
sweep: stiction sweep host-sim/sweeps/friction-stiffness.toml --shard 1/4
board: stiction board --emulate
board: stiction board box-flat --verify --emulate pico
board: stiction board ladder --port auto --out board.jsonl
info: stiction info --emulate
info: stiction info --port auto
knob: stiction knob --port auto > knob.toml
knob: stiction knob knob.toml --port auto
knob: stiction knob --emulate pico
image: stiction image pico
image: stiction image pico ladder --out ladder.uf2
code: stiction code table-edge --name table
code: stiction code ladder --number fixed
completions: stiction completions bash > stiction.bash
completions: stiction completions fish > stiction.fish
man: stiction man man1
";

/// Returns every command with its examples at the end of its help.
pub(crate) fn add(program: Command) -> Command {
    let commands = program.get_subcommands();
    let names: Vec<_> = commands.map(|of| of.get_name().to_owned()).collect();
    let program = program.after_help(text("stiction"));
    names.iter().fold(program, |program, name| {
        program.mut_subcommand(name, |command| command.after_help(text(name)))
    })
}

fn text(name: &str) -> String {
    let named = ALL.lines().filter_map(|line| line.split_once(": "));
    let examples = named.filter(|(of, _)| *of == name);
    let examples: Vec<_> = examples.map(|(_, example)| example).collect();
    format!("Examples:\n  {}", examples.join("\n  "))
}
