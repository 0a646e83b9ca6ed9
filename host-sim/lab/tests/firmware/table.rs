//! What the images of the boards take in the emulator, as the table of the README: bytes, instructions, silence, bits.

use crate::bits::{SAMPLES, same_bits};
use crate::budgets::{Taken, measure};
use crate::chip::{self, F405, MICROBIT, PICO};
use crate::silence::silence;
use stiction_core::Fixed;
use stiction_host_sim::columns::thousands;
use stiction_host_sim::trade::chip::Chip;
use stiction_lab::markdown::{Destination, Table};
use stiction_wire::NumberType;

const COMMAND: &str = "cargo test -p stiction-lab --test firmware -- --ignored table";

/// Smaller ones than the board's own.
const SCENES: [&str; 2] = ["box-flat", "point-stick-slip"];

struct Column {
    taken: Taken,
    /// The flash with [`SCENES`] compiled in (bytes).
    with_scenes: [u64; 2],
    silence_us: u32,
    /// Its chip, with the time that it takes.
    timing: Chip,
}

fn column(chip: &'static chip::Chip, timing: Chip) -> Option<Column> {
    let taken = measure(chip)?;
    let [first, second] = SCENES.map(|scene| chip.image_of(Some(scene)));
    match taken.about.number {
        NumberType::F32 => same_bits::<f32>(chip, NumberType::F32, SAMPLES)?,
        NumberType::Fixed => same_bits::<Fixed>(chip, NumberType::Fixed, SAMPLES)?,
    };
    Some(Column {
        taken,
        with_scenes: [first?.contents.flash, second?.contents.flash],
        silence_us: silence(chip)?,
        timing,
    })
}

impl Column {
    fn seconds(&self, instructions: u32) -> f64 {
        1e-6 * self.timing.microseconds(f64::from(instructions))
    }

    /// Instructions, and the part that they take of a tick at the rate after power-up.
    fn of_tick(&self, instructions: u32) -> String {
        let rate = f64::from(self.taken.about.mode.tick_rate);
        let percent = 100.0 * self.seconds(instructions) * rate;
        format!("{} ({percent:.0} %)", thousands(instructions.into()))
    }
}

type Row = (&'static str, fn(&Column) -> String);

const ROWS: [Row; 16] = [
    ("number type, room for vertices and surfaces", |c| {
        let about = &c.taken.about;
        format!(
            "{}, {}, {}",
            about.number.name(),
            about.vertices,
            about.surfaces
        )
    }),
    ("flash (bytes)", |c| thousands(c.taken.flash)),
    ("flash with box-flat, with point-stick-slip", |c| {
        c.with_scenes.map(thousands).join(", ")
    }),
    ("RAM: variables + deepest stack (bytes)", |c| {
        let (variables, stack) = (c.taken.variables, c.taken.stack);
        format!("{} + {}", thousands(variables), thousands(stack))
    }),
    ("ticks per second after power-up, at most", |c| {
        let about = &c.taken.about;
        let [now, most] = [about.mode.tick_rate, about.fastest_tick];
        format!("{}, {}", thousands(now.into()), thousands(most.into()))
    }),
    ("evolution after power-up", |c| {
        c.taken.about.mode.evolution.name().to_owned()
    }),
    ("budget of a step then (pieces of work)", |c| {
        thousands(c.taken.about.budget.into())
    }),
    ("cycles of an instruction, estimated", |c| match c.timing {
        Chip::CortexM0Plus => "counted".to_owned(),
        timing @ (Chip::CortexM4F | Chip::CortexM33 | Chip::CortexM0) => {
            timing.cycles().to_string()
        }
    }),
    ("the longest tick (instructions, part of its period)", |c| {
        c.of_tick(c.taken.tick)
    }),
    ("the longest step of the solver", |c| {
        c.of_tick(c.taken.step)
    }),
    ("the longest turn", |c| c.of_tick(c.taken.turn)),
    ("the most ticks per second with all turns in time", |c| {
        thousands((1.0 / c.seconds(c.taken.turn)) as u64)
    }),
    ("the longest turn with a command", |c| {
        c.of_tick(c.taken.command)
    }),
    ("missed ticks, without commands", |c| {
        c.taken.missed.to_string()
    }),
    ("the same bits as on this computer, path and frame", |_| {
        // Else there is no table.
        format!("{SAMPLES} of {SAMPLES} poses each")
    }),
    ("from the last sample to zero force", |c| {
        format!("{:.0} ms", f64::from(c.silence_us) / 1000.0)
    }),
];

fn table(columns: &[Column]) -> String {
    let mut table = Table::new("image without a log | F405: | micro:bit: | Pico, cycles:");
    for (name, figure) in ROWS {
        table.row(std::iter::once(name.to_owned()).chain(columns.iter().map(figure)));
    }
    format!(
        "Written by `{COMMAND}`, measured in emulators along {SAMPLES}\nsamples of a hand that presses, drags, tips and \
         whirls the box: instructions and, of the Pico, cycles, those of the\nserial line's interrupts among them. The time of \
         instructions is an estimate. A turn is the work that follows a tick.\n\n{table}"
    )
}

#[test]
#[ignore = "writes a table of the README"]
fn the_table_of_the_readme() {
    let chips = [
        (&F405, Chip::CortexM4F),
        (&MICROBIT, Chip::CortexM0),
        (&PICO, Chip::CortexM0Plus),
    ];
    let columns = chips.map(|(chip, timing)| column(chip, timing));
    let columns: Vec<_> = columns.into_iter().flatten().collect();
    if columns.len() < chips.len() {
        return;
    }
    let document = Destination { write: true };
    let written = document.put("firmware/README.md", "boards", &table(&columns));
    written.unwrap();
}
