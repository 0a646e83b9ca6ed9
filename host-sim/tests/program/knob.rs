//! `stiction knob` with a board that is a thread of the test: the program of real boards behind a unix socket, with two pages in the place of the
//! flash. No verdict hangs on how fast anything is.

use std::convert::Infallible;
use std::os::unix::net::UnixListener;
use std::path::Path;
use std::thread;
use std::time::Duration;

use stiction_core::{Description, Hand, Wrench};
use stiction_firmware::device::{Actuators, Sample, Servo, Source};
use stiction_firmware::devices::knob::NUMBERS;
use stiction_firmware::knob::{PAGE, Stored, page};
use stiction_firmware::station::{Setup, Station};
use stiction_tests::station::BOX;
use stiction_wire::{KnobNumbers, NumberType};

use crate::common::{Folder, assert_all};
use crate::view::station::{LONGEST, Line, S, V, described};

const EXAMPLE: &str = include_str!("../../../firmware/knob.toml");
const EMPTY: [u8; PAGE] = [0xFF; PAGE];

/// A knob that nobody turns.
struct Still {
    has_numbers: bool,
}

impl Source for Still {
    const MEASURES: bool = true;
    const HAS_NUMBERS: bool = true;

    fn sample(&mut self, now_us: u32) -> Option<Sample> {
        Some(Sample {
            hand: Hand::new(0.0, 0.06, 0.0),
            number: 0,
            received_us: now_us,
        })
    }
}

impl Actuators for Still {
    type Fault = Infallible;

    fn give(&mut self, _: &Wrench<f32>) -> Result<(), Infallible> {
        Ok(())
    }
    fn off(&mut self) {}
}

/// With a scene that is passive with the compiled-in damping.
fn with_soft_scene() -> Setup {
    let scene = Description {
        stiffness_translation: 350.0,
        ..BOX
    };
    Setup {
        scene,
        ..described(NumberType::F32)
    }
}

/// From power-up until it restarts with other numbers.
fn lives(listener: &UnixListener, pages: [&[u8; PAGE]; 2], knob: &Still) -> KnobNumbers {
    let described = with_soft_scene();
    let info = Stored::read(pages).info(&NUMBERS, &described);
    let setup = match knob.has_numbers {
        true => described.with_knob(info),
        false => described,
    };
    let station = Station::<f32, V, S, 0, LONGEST>::new(Box::leak(Box::new(setup)));
    let mut station = station.expect("a board");
    let mut servo = Servo::new(Still { ..*knob });
    loop {
        let (stream, _) = listener.accept().expect("a client");
        let mut line = Line::new(stream);
        while line.listen() {
            station.tick(line.now_us(), &mut line, &mut servo);
            if let Some(numbers) = station.restarts_with() {
                return *numbers;
            }
            thread::sleep(Duration::from_millis(1));
        }
    }
}

/// Boards behind a socket, until the test ends. `forgets`: its flash takes nothing.
fn board(place: &Path, stored: [u8; PAGE], knob: Still, forgets: bool) {
    let listener = UnixListener::bind(place).expect("a socket");
    thread::spawn(move || {
        let mut pages = [stored, EMPTY];
        loop {
            let numbers = lives(&listener, pages.each_ref(), &knob);
            let free = Stored::read(pages.each_ref()).free;
            if !forgets {
                pages[free] = page(&numbers);
                pages[1 - free] = EMPTY;
            }
        }
    });
}

const WITH_NUMBERS: Still = Still { has_numbers: true };

#[test]
fn the_numbers_of_a_board_are_a_file_that_it_takes() {
    let folder = Folder::new();
    board(&folder.file("line"), EMPTY, WITH_NUMBERS, false);
    let said = folder.done("knob --socket line --timeout 20");
    let parts = [
        "a thread: compiled in, none are stored",
        "radius = 0.015 ",
        "# m",
    ];
    assert_all("knob", &said, &parts);
    // On a smaller one the same damping is more.
    let other = said.replace("radius = 0.015 ", "radius = 0.012 ");
    folder.write("mine.toml", &other);
    let said = folder.done("knob mine.toml --socket line --timeout 20");
    let expected = other.replace("compiled in, none are stored", "stored on the board");
    assert_eq!(said, expected);
    assert_eq!(folder.done("knob --socket line --timeout 20"), expected);
    // The example has the numbers that are compiled in, which replace the ones that are stored.
    folder.write("knob.toml", EXAMPLE);
    let said = folder.done("knob knob.toml --socket line --timeout 20");
    assert_eq!(said, expected.replace("radius = 0.012 ", "radius = 0.015 "));
}

#[test]
fn a_number_that_cannot_be_used_is_named_with_its_line_before_anything_is_sent() {
    let folder = Folder::new();
    // There is no board.
    let line = "knob mine.toml --socket line";
    for (from, to, parts) in [
        (
            "radius = 0.015",
            "radius = 0",
            &[
                "mine.toml, line 5",
                "`radius` is 0.0 m, allowed: 0.001 to 10, the limit: 0.001 m",
            ][..],
        ),
        (
            "counts_per_turn = 2400",
            "counts_per_turn = 2.5",
            &[
                "line 6",
                "`counts_per_turn` is floating point `2.5`, allowed: a whole number",
            ],
        ),
        (
            "torque_limit = 0.05",
            "torque_limit = 0.07",
            &[
                "line 10",
                "`torque_limit` is 0.07 N·m, allowed: more than 0, at most",
                "the limit: 0.06 N·m",
            ],
        ),
        (
            "damping = 1e-4",
            "damping = nan",
            &["line 15", "`damping` is NaN"],
        ),
        ("damping = 1e-4", "", &["missing field `damping`"]),
        ("radius =", "radios =", &["line 5", "radios", "radius"]),
        (
            "motor_reversed = false",
            "motor_reversed = 1",
            &["line 11", "`motor_reversed` is integer `1`"],
        ),
    ] {
        assert!(EXAMPLE.contains(from), "{from}");
        folder.write("mine.toml", EXAMPLE.replacen(from, to, 1));
        folder.refused(line, parts);
    }
    folder.write("mine.toml", EXAMPLE);
    folder.refused(line, &["line: "]);
    folder.refused("knob", &["--port"]);
    let pins = "microbit has no pins for a knob, allowed: --emulate pico";
    folder.refused("knob --emulate microbit", &[pins]);
    folder.refused("knob nowhere.toml --socket line", &["nowhere.toml"]);
}

#[test]
fn what_a_board_refuses_is_named_with_its_line() {
    let folder = Folder::new();
    board(&folder.file("line"), EMPTY, WITH_NUMBERS, false);
    // Half of the stiffness is passive with it.
    folder.write("mine.toml", EXAMPLE.replace("1e-4", "5e-5"));
    let parts = [
        "mine.toml, line 15",
        "`damping` is 5e-5 N·m·s/rad",
        "passive",
        "the limit: 9.84",
    ];
    folder.refused("knob mine.toml --socket line --timeout 20", &parts);
    let said = folder.done("knob --socket line --timeout 20");
    assert_all(
        "unchanged",
        &said,
        &["none are stored", "damping = 0.0001 "],
    );
}

#[test]
fn a_board_without_a_knob_says_so() {
    let folder = Folder::new();
    let without = Still { has_numbers: false };
    board(&folder.file("line"), EMPTY, without, false);
    folder.write("knob.toml", EXAMPLE);
    for line in ["knob", "knob knob.toml"] {
        let line = format!("{line} --socket line --timeout 20");
        folder.refused(
            &line,
            &[
                "the board refuses the",
                "knob",
                "allowed: for a board with a knob",
            ],
        );
    }
}

#[test]
fn a_board_that_is_not_back_with_the_numbers_is_an_error() {
    let folder = Folder::new();
    let mut damaged = page(&NUMBERS);
    damaged[7] ^= 1;
    board(&folder.file("line"), damaged, WITH_NUMBERS, true);
    let said = folder.done("knob --socket line --timeout 20");
    assert_all("damaged", &said, &["are damaged", "the motor is off"]);
    folder.write("knob.toml", EXAMPLE);
    let parts = ["took the numbers, but has others", "are damaged"];
    folder.refused("knob knob.toml --socket line --timeout 1", &parts);
}
