//! Other numbers for the knob of the emulated Pico, over its line: it stores them in its flash and restarts with them. What erases and programs
//! the flash is a model of the chip's ROM (`pico/chip/rom.rs`), with the longest times of the flash; code that is read from the flash meanwhile
//! is a panic there.

use crate::bench::{Bench, MS};
use crate::chip::KNOB;
use crate::wiring::{Driver, Pins, Tracks, turn};
use stiction_firmware::devices::knob::NUMBERS;
use stiction_tests::station::OTHER_KNOB;
use stiction_tests::station::client::{Client, Said};
use stiction_wire::{
    Command, Drive, KnobInfo, KnobNumber, KnobNumbers, KnobSource, Mode, Reason, Subject,
};

/// The hand presses the tool 6 mm deep.
const OTHERS: KnobNumbers = KnobNumbers {
    origin: [0.001, 0.034],
    ..OTHER_KNOB
};
/// Where the linker leaves room: the last two sectors of 2 MB.
const SECTORS: [usize; 2] = [(2 << 20) - 8192, (2 << 20) - 4096];
/// A restart takes two sectors, a page and the wait for the reply: at most 0.4 s, 3 ms and 50 ms.
const RESTART_MS: u64 = 900;

fn asked(bench: &mut Bench) -> KnobInfo {
    bench.send(Command::AskKnob);
    bench.wait(|said| match said {
        Said::KnobInfo(info) => Some(*info),
        _ => None,
    })
}

/// Sends numbers, and waits until the board is back.
fn stored(bench: &mut Bench, numbers: KnobNumbers) {
    let resets = bench.chip.resets();
    bench.done(Command::Knob(numbers));
    bench.chip.run(RESTART_MS * MS);
    assert_eq!(bench.chip.resets(), resets + 1);
    bench.chip.gone();
    bench.client = Client::default();
    bench.wait(|said| matches!(said, Said::Pose(_)).then_some(()));
}

/// The force along x (N) at these counts, and what the motor gets: the duty, negative where the direction is high.
fn driven(bench: &mut Bench, counts: i32) -> [f64; 2] {
    let pins = Pins::drawn("knob.svg");
    let mut tracks = [Tracks::new(&pins, "Encoder")];
    let driver = Driver::new(&pins, "Motor driver");
    bench.done(Command::Mode(Mode {
        forces_every: 10,
        ..Mode::DEFAULT
    }));
    turn(bench, &mut tracks, &[counts]);
    let along = bench.wait(|said| match said {
        Said::Forces { feedback, .. } => Some(feedback.force[0]),
        _ => None,
    });
    [f64::from(along), driver.duty(bench)]
}

/// The force of a tool of 40 mm that sticks, at a displacement of the hand (m), pressed to the plate by a depth (m): the stiffnesses of the
/// grip and of the tilt in series, as in `knob.rs`.
fn statics(x: f64, depth: f64) -> f64 {
    let tilt = (0.5 - 350.0 * depth * 0.04) / (0.04 * 0.04);
    -x / (1.0 / 350.0 + 1.0 / tilt)
}

#[test]
fn numbers_over_the_line_are_those_of_the_hand_and_the_motor_from_then_on() {
    let Some(mut bench) = Bench::start(&KNOB) else {
        return;
    };
    let compiled_in = KnobInfo {
        source: KnobSource::CompiledIn,
        numbers: NUMBERS,
    };
    assert_eq!(asked(&mut bench), compiled_in);
    for (refused, reason, number) in [
        (
            KnobNumbers {
                radius: 0.0,
                ..OTHERS
            },
            Reason::Number,
            KnobNumber::Radius,
        ),
        // The stiffness of the scene is 350 N/m.
        (
            KnobNumbers {
                damping: 1e-4,
                ..OTHERS
            },
            Reason::NotPassive,
            KnobNumber::Damping,
        ),
    ] {
        let answer = bench.ask(Command::Knob(refused));
        assert_eq!(
            (answer.reason, answer.subject),
            (reason, Subject::Knob(number))
        );
    }
    bench.chip.run(RESTART_MS * MS);
    assert_eq!((bench.chip.flash_writes(), bench.chip.resets()), (0, 0));
    assert_eq!(asked(&mut bench), compiled_in);

    stored(&mut bench, OTHERS);
    let now = KnobInfo {
        source: KnobSource::Stored,
        numbers: OTHERS,
    };
    assert_eq!(asked(&mut bench), now);
    // After another power-up, too: 40 counts the other way round are x = x0 + r q, and the motor gets r F of 0.2 N·m at full duty.
    let mut bench = Bench::of(bench.chip.flash().to_vec());
    assert_eq!(asked(&mut bench), now);
    let [along, duty] = driven(&mut bench, -40);
    let x = 0.001 + 0.03 * 40.0 / 4_096.0 * std::f64::consts::TAU;
    // The square of the tilt, 0.04 rad, is left out.
    assert!(
        (along / statics(x, 0.006) - 1.0).abs() < 0.005,
        "{along} N at {x} m"
    );
    // It is connected the other way round. A period of the PWM has 6 250 counts.
    assert!(
        (-duty * 0.2 - 0.03 * along).abs() < 1.5 * 0.2 / 6_250.0,
        "{duty}"
    );
    assert_eq!(bench.health().drive, Drive::On);
}

#[test]
fn damaged_numbers_leave_the_motor_off_and_the_board_takes_others() {
    let Some(mut bench) = Bench::start(&KNOB) else {
        return;
    };
    stored(&mut bench, OTHERS);
    let mut flash = bench.chip.flash().to_vec();
    let written = SECTORS.map(|at| flash[at] != 0xFF);
    assert_eq!(written, [true, false], "one sector has them");
    flash[SECTORS[0] + 20] ^= 8;
    let mut bench = Bench::of(flash);
    let unusable = KnobInfo {
        source: KnobSource::Unusable,
        numbers: NUMBERS,
    };
    assert_eq!(asked(&mut bench), unusable);
    let [along, duty] = driven(&mut bench, 200);
    assert_eq!([along, duty.abs()], [0.0; 2]);
    stored(&mut bench, OTHERS);
    assert_eq!(asked(&mut bench).source, KnobSource::Stored);
}

/// The flash is erased, programmed and erased: whatever is done when the power fails, the board has the former numbers or the new ones.
#[test]
fn a_loss_of_power_leaves_the_former_numbers_or_the_new_ones() {
    let Some(mut bench) = Bench::start(&KNOB) else {
        return;
    };
    stored(&mut bench, OTHERS);
    let former = bench.chip.flash().to_vec();
    let new = KnobNumbers {
        radius: 0.025,
        ..OTHERS
    };
    let mut bench = Bench::of(former);
    bench.done(Command::Knob(new));
    let mut states = vec![];
    for writes in 1..=3 {
        while bench.chip.flash_writes() < writes {
            assert_eq!(bench.chip.resets(), 0);
            bench.chip.run(1);
        }
        let flash = bench.chip.flash().to_vec();
        let KnobInfo { source, numbers } = asked(&mut Bench::of(flash));
        assert_eq!(source, KnobSource::Stored, "after {writes}");
        states.push(numbers.radius);
    }
    assert_eq!(states, [OTHERS.radius, OTHERS.radius, new.radius]);
}
