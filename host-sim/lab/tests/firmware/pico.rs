//! The Pico on its own clock, step by step: random drags at 1 kHz, and what happens when all is lost.

use crate::bench::{Bench, MS, PATIENCE};
use crate::budgets::Budget;
use crate::chip::{self as board, Image, PICO, PICO_FLASHED};
use crate::drags;
use stiction_core::{Hand, narrow_hand};
use stiction_host_sim::trade::Case;
use stiction_tests::station::client::{Client, Said};
use stiction_wire::{Command, Drive, Health, SceneCommand};

impl Bench {
    /// The hand presses until the board gives force.
    fn press(&mut self) {
        for _ in 0..PATIENCE {
            self.send(Command::Hand(Hand::new(0.0, 0.045, 0.0)));
            let gives = self.wait(|said| match said {
                Said::Pose(pose) => Some(pose.held && !pose.force_off),
                _ => None,
            });
            if gives {
                return;
            }
        }
        panic!("no force");
    }

    /// All is lost: at once no pin but that of the line drives anything; the chip is reset soon, and gives force when a hand presses.
    fn recovers(&mut self) {
        /// Of each pin, the second of its registers; in it, the field of what it is connected to, and the number of nothing.
        const PINS: std::ops::Range<u32> = 1..30;
        const CONTROL: u32 = 0x4001_4004;
        const FUNCTION: u32 = 31;
        const NOTHING: u32 = 31;
        /// The watchdog waits for 20 ms.
        const MOST: u32 = 21;
        self.chip.run(MS / 10);
        for pin in PINS {
            let function = self.chip.word(CONTROL + 8 * pin) & FUNCTION;
            assert_eq!(function, NOTHING, "GP{pin}");
        }
        assert_eq!(self.chip.resets(), 0);
        let takes = (0..MOST).find(|_| {
            self.chip.run(MS);
            self.chip.resets() == 1
        });
        assert!(takes.is_some(), "it is not reset: {:?}", self.chip);
        self.client = Client::default();
        self.chip.gone();
        let health = self.health();
        assert_eq!(health.drive, Drive::Silent);
        self.press();
        assert_eq!(self.chip.resets(), 1);
    }

    fn drag(&mut self, case: &Case) -> u32 {
        case.scene
            .described::<f32, _>(|scene| self.done(Command::Scene(SceneCommand::from(scene))));
        let mut frames = 0;
        for sample in case.path.frames(Some(1000.0)) {
            self.send(Command::Hand(narrow_hand(&sample.hand)));
            self.pass();
            self.client.inbox.clear();
            frames += 1;
        }
        frames
    }
}

/// What becomes of a board after something is done to it: with the image without a log, and with that which `cargo load` flashes, of which
/// the log holds panics of its own.
fn survives(boards: &[&board::Chip], disaster: impl Fn(&mut Bench, &Image)) {
    for board in boards {
        let Some(mut bench) = Bench::start(board) else {
            return;
        };
        bench.press();
        disaster(&mut bench, &board.image().unwrap());
        bench.recovers();
    }
}

/// Where a function is, by a part of its name.
fn place(image: &Image, name: &str) -> Option<u32> {
    let mut symbols = image.contents.symbols.iter();
    let (_, place) = symbols.find(|(symbol, _)| symbol.contains(name))?;
    Some(*place as u32 & !1)
}

#[test]
fn a_panic_is_zero_force_and_a_restart() {
    survives(&[&PICO, &PICO_FLASHED], |bench, image| {
        // Where all panics begin.
        let panic = place(image, "panic_fmt").expect("the image can panic, in what serves USB");
        bench.chip.go_on_at(panic);
    });
}

#[test]
fn a_panic_within_the_log_is_zero_force_and_a_restart() {
    survives(&[&PICO_FLASHED], |bench, image| {
        // The log is taken once a second, and not given back this time.
        let write = place(image, "_defmt_write").expect("the image logs");
        let second = bench.chip.cycles() + 1_100 * MS;
        while bench.chip.at() != write && bench.chip.cycles() < second {
            bench.chip.run(1);
        }
        assert_eq!(bench.chip.at(), write, "nothing is logged");
        let panic = place(image, "panic_fmt").unwrap();
        bench.chip.go_on_at(panic);
    });
}

#[test]
fn a_fault_is_zero_force_and_a_restart() {
    // There is nothing.
    survives(&[&PICO, &PICO_FLASHED], |bench, _| {
        bench.chip.go_on_at(0x3000_0000);
    });
}

/// What random drags come to.
struct Drags {
    health: Health,
    missed: u32,
    /// The longest tick, by the emulator (cycles).
    tick: u64,
}

fn random_drags(frames: u32) -> Option<Drags> {
    /// Of the timer.
    const TICK: u32 = 0;
    let mut bench = Bench::start(&PICO)?;
    let missed = bench.health().missed_ticks;
    let mut passed = 0;
    for case in drags::random() {
        passed += bench.drag(&case);
        if passed >= frames {
            break;
        }
    }
    let health = bench.health();
    let drags = Drags {
        missed: health.missed_ticks - missed,
        tick: bench.chip.longest(TICK),
        health,
    };
    println!(
        "{passed} frames: {health:?}; the longest tick takes {} cycles",
        drags.tick
    );
    assert_eq!((health.samples, health.lost_frames), (passed, 0));
    Some(drags)
}

#[test]
fn random_drags_are_within_the_budget() {
    let Some(drags) = random_drags(20_000) else {
        return;
    };
    let budget = Budget::of(&PICO);
    budget.holds("drags_missed", drags.missed.into());
    budget.holds("drags_tick", drags.tick);
    budget.holds("drags_late", drags.health.late_samples.into());
}

#[test]
#[ignore = "takes minutes"]
fn no_tick_is_missed_in_a_million_frames_of_random_drags() {
    let missed = random_drags(1_000_000).map(|drags| drags.missed);
    assert!(matches!(missed, None | Some(0)), "{missed:?}");
}
