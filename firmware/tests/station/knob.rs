//! The numbers of a knob as settings: asked for, refused by name, accepted with the motor off; stored, and what a start makes of what is stored.

use super::rig::{Rig, setup};
use crate::bench::Bench;
use crate::with;
use std::cell::Cell;
use std::rc::Rc;
use stiction_core::Description;
use stiction_firmware::device::Source;
use stiction_firmware::devices::knob::{GEOMETRY, MOTOR, NUMBERS};
use stiction_firmware::knob::{Counter, Knob, KnobSettings, PAGE, Stored, page};
use stiction_firmware::pantograph::Motor;
use stiction_firmware::station::Setup;
use stiction_tests::station::client::Said;
use stiction_tests::station::{BOX, OTHER_KNOB};
use stiction_wire::{
    Command, Drive, KnobInfo, KnobNumber, KnobNumbers, KnobSource, Mode, Reason, Reset, Subject,
};

const EMPTY: [u8; PAGE] = [0xFF; PAGE];
#[derive(Clone, Default)]
struct Shown(Rc<Cell<u16>>);

impl Counter for Shown {
    fn count(&mut self) -> Option<u16> {
        Some(self.0.get())
    }
}

type Device = Knob<Shown, Motor<Bench, Bench>>;

/// A box that is pressed 5 mm deep to the floor by a spring of 200 N/m.
fn described() -> Setup {
    Setup {
        scene: Description {
            stiffness_translation: 200.0,
            ..BOX
        },
        ..setup()
    }
}

/// A board that begins with what is stored in two sectors, its encoder, and its motor.
fn started(pages: [&[u8; PAGE]; 2]) -> (Rig<f32, 0, Device>, Shown, Bench) {
    let described = described();
    let info = Stored::read(pages).info(&NUMBERS, &described);
    let (shown, bench) = (Shown::default(), Bench::default());
    let settings = KnobSettings::new(&info.numbers);
    let motor = Motor::new(bench.clone(), bench.clone(), settings.motor).unwrap();
    let knob = Knob::new(&settings.geometry, shown.clone(), motor).unwrap();
    (Rig::with(described.with_knob(info), knob), shown, bench)
}

fn asked(rig: &mut Rig<f32, 0, Device>) -> KnobInfo {
    rig.send(Command::AskKnob);
    rig.client.inbox.clear();
    rig.tick();
    let info = rig.reports().find_map(|said| match said {
        Said::KnobInfo(info) => Some(info),
        _ => None,
    });
    info.expect("the numbers")
}

/// Turns the encoder until the motor gives torque.
fn driven(rig: &mut Rig<f32, 0, Device>, shown: &Shown, bench: &Bench) {
    for count in 0..60 {
        shown.0.set(count);
        rig.tick();
    }
    assert_ne!(*bench.duty.borrow(), 0);
}

#[test]
fn a_board_with_nothing_stored_has_the_numbers_that_are_compiled_in() {
    let (mut rig, ..) = started([&EMPTY; 2]);
    let expected = KnobInfo {
        source: KnobSource::CompiledIn,
        numbers: NUMBERS,
    };
    assert_eq!(asked(&mut rig), expected);
    let settings = KnobSettings::new(&NUMBERS);
    assert_eq!((settings.geometry, settings.motor), (GEOMETRY, MOTOR));
}

#[test]
fn accepted_numbers_are_stored_when_the_motor_is_off_and_the_reply_has_left() {
    let (mut rig, shown, bench) = started([&EMPTY; 2]);
    driven(&mut rig, &shown, &bench);
    rig.done(Command::Knob(OTHER_KNOB));
    assert_eq!(*bench.duty.borrow(), 0, "off in the tick of the reply");
    assert_eq!(rig.station.restarts_with(), None, "the reply is leaving");
    // Nothing that comes meanwhile brings the force back.
    for command in [
        Command::Reset(Reset::Everything),
        Command::Mode(Mode::DEFAULT),
        Command::Knob(NUMBERS),
    ] {
        assert_eq!(rig.ask(command).reason, Reason::NotNow);
    }
    rig.info();
    for _ in 0..60 {
        shown.0.set(shown.0.get() + 1);
        rig.tick();
        assert_eq!((*bench.duty.borrow(), rig.force.force), (0, [0.0; 2]));
    }
    assert_eq!(rig.health().drive, Drive::Latched);
    assert_eq!(rig.station.restarts_with(), Some(&OTHER_KNOB));
}

/// x = x0 + r q, and tau = r Fx at the duty of tau over that at full duty, by the numbers that are stored.
#[test]
fn a_start_with_stored_numbers_has_their_hand_and_their_torque() {
    let stored = page(&OTHER_KNOB);
    for pages in [[&stored, &EMPTY], [&EMPTY, &stored]] {
        let (mut rig, shown, bench) = started(pages);
        assert_eq!(asked(&mut rig).source, KnobSource::Stored);
        for count in 0..200u16 {
            // It counts down.
            shown.0.set(count.wrapping_neg());
            rig.tick();
        }
        let [along, up] = rig.force.force;
        let [x, y] = rig.servo.device.sample(0).unwrap().hand.position;
        let wanted = 0.01 + 0.03 * 199.0 / 4_096.0 * core::f32::consts::TAU;
        assert!((x - wanted).abs() < 1e-7 && y == 0.03, "{x} {wanted}");
        // The hand goes to the right over the box, which it presses down by 20 mm.
        assert!(along < 0.0 && up > 0.0, "{along} {up}");
        let torque = 0.03 * along;
        let duty = f32::from(*bench.duty.borrow()) / 8_400.0;
        assert!((duty * 0.2 - torque.abs()).abs() < 0.51 * 0.2 / 8_400.0);
        // Clockwise by a low level, as the motor is reversed.
        assert!(!*bench.high.borrow());
    }
}

#[test]
fn a_number_that_cannot_be_used_is_refused_by_its_name_with_the_nearest() {
    use KnobNumber::{
        CountsPerTurn, Damping, FullCurrent, Origin, Radius, TorqueConstant, TorqueLimit,
    };
    type Change = fn(&mut KnobNumbers);
    let none = f32::NAN;
    let cases: [(Change, KnobNumber, f32, &str); 12] = [
        (|n| n.origin[1] = -11.0, Origin, -10.0, "-10"),
        (|n| n.origin[0] = f32::NAN, Origin, none, "10"),
        (|n| n.radius = 0.0, Radius, 0.001, "0.001"),
        (|n| n.radius = 11.0, Radius, 10.0, "10"),
        (|n| n.counts_per_turn = 3, CountsPerTurn, 4.0, "4"),
        (
            |n| n.counts_per_turn = u32::MAX,
            CountsPerTurn,
            4_194_304.0,
            "4194304",
        ),
        (|n| n.torque_constant = 0.0, TorqueConstant, 1e-6, "1e-6"),
        (
            |n| n.full_current = f32::INFINITY,
            FullCurrent,
            1_000.0,
            "1000",
        ),
        (
            |n| n.torque_limit = 0.25,
            TorqueLimit,
            0.2,
            "torque constant",
        ),
        (|n| n.torque_limit = -1.0, TorqueLimit, none, "more than 0"),
        (|n| n.damping = -1e-4, Damping, 0.0, "0 or more"),
        (|n| n.damping = f32::NAN, Damping, none, "0"),
    ];
    let stored = page(&OTHER_KNOB);
    for (change, number, limit, allowed) in cases {
        let (mut rig, ..) = started([&stored, &EMPTY]);
        let refused = rig.ask(Command::Knob(with(OTHER_KNOB, change)));
        assert_eq!(
            (refused.reason, refused.subject),
            (Reason::Number, Subject::Knob(number))
        );
        assert!(refused.allowed.to_string().contains(allowed), "{refused:?}");
        assert_eq!(refused.limit.to_bits(), limit.to_bits(), "{refused:?}");
        // Nothing changes.
        for _ in 0..100 {
            rig.tick();
        }
        assert_eq!(rig.station.restarts_with(), None);
        assert_eq!(asked(&mut rig).numbers, OTHER_KNOB);
    }
}

/// b > K (T/2 + D) with the period of 1 ms and the turn of 750 µs: the stiffness of 200 N/m needs 0.25 N·s/m, by the square of the radius.
#[test]
fn a_damping_with_which_the_scene_after_power_up_is_not_passive_is_refused() {
    let least = 200.0 * (0.5e-3 + 0.75e-3) * 0.03 * 0.03;
    let (mut rig, ..) = started([&EMPTY; 2]);
    let refused = rig.ask(Command::Knob(with(OTHER_KNOB, |n| {
        n.damping = 0.999 * least
    })));
    assert_eq!(refused.reason, Reason::NotPassive);
    assert_eq!(refused.subject, Subject::Knob(KnobNumber::Damping));
    assert!((refused.limit / least - 1.0).abs() < 1e-5, "{refused:?}");
    rig.done(Command::Knob(with(OTHER_KNOB, |n| {
        n.damping = 1.001 * least
    })));
    // A scene of the client, too, has the bound of the numbers that are stored: 800 N/m here.
    let (mut rig, ..) = started([&page(&OTHER_KNOB), &EMPTY]);
    let [k_h, _] = rig.info().stiffest;
    assert!((k_h / 800.0 - 1.0).abs() < 1e-5, "{k_h}");
    static SOFT: Description<'static, f32> = Description {
        stiffness_translation: 799.0,
        ..BOX
    };
    static STIFF: Description<'static, f32> = Description {
        stiffness_translation: 801.0,
        ..BOX
    };
    let sent = |scene| stiction_tests::station::client::scene(scene);
    assert_eq!(rig.ask(sent(&STIFF)).reason, Reason::NotPassive);
    rig.done(sent(&SOFT));
}

/// What is not whole leads to the compiled-in numbers, without force: they may be those of a weaker motor.
#[test]
fn every_flipped_bit_of_what_is_stored_is_found_and_the_motor_is_off() {
    let stored = page(&OTHER_KNOB);
    let written = stored.iter().position(|&byte| byte == 0).expect("an end") + 1;
    let unusable = KnobInfo {
        source: KnobSource::Unusable,
        numbers: NUMBERS,
    };
    for bit in 0..8 * written {
        let mut damaged = stored;
        damaged[bit / 8] ^= 1 << (bit % 8);
        let read = Stored::read([&damaged, &EMPTY]);
        assert_eq!(read.info(&NUMBERS, &described()), unusable, "{bit}");
    }
    for end in 0..written {
        let mut torn = EMPTY;
        torn[..end].copy_from_slice(&stored[..end]);
        let read = Stored::read([&EMPTY, &torn]).info(&NUMBERS, &described());
        assert_eq!(read.source == KnobSource::CompiledIn, end == 0, "{end}");
        assert_eq!(read.numbers, NUMBERS);
        // The former numbers are still there.
        let former = page(&with(OTHER_KNOB, |n| n.radius = 0.02));
        let read = Stored::read([&torn, &former]).info(&NUMBERS, &described());
        assert_eq!(
            (read.source, read.numbers.radius),
            (KnobSource::Stored, 0.02)
        );
    }
    let mut damaged = stored;
    damaged[5] ^= 4;
    let (mut rig, shown, bench) = started([&damaged, &EMPTY]);
    assert_eq!(asked(&mut rig), unusable);
    for count in 0..200 {
        shown.0.set(count);
        rig.tick();
        assert_eq!((*bench.duty.borrow(), rig.force.force), (0, [0.0; 2]));
    }
    // It answers, and takes others.
    rig.done(Command::Knob(OTHER_KNOB));
}

#[test]
fn stored_numbers_with_which_another_scene_is_not_passive_do_not_stop_the_board() {
    let weak = page(&with(OTHER_KNOB, |n| n.damping = 1e-6));
    let (mut rig, ..) = started([&weak, &EMPTY]);
    assert_eq!(asked(&mut rig).source, KnobSource::Unusable);
    rig.done(Command::Knob(OTHER_KNOB));
}

#[test]
fn numbers_go_to_the_sector_that_has_none() {
    let stored = page(&OTHER_KNOB);
    for (pages, free) in [
        ([&EMPTY, &EMPTY], 0),
        ([&stored, &EMPTY], 1),
        ([&EMPTY, &stored], 0),
        ([&stored, &stored], 1),
    ] {
        assert_eq!(Stored::read(pages).free, free);
    }
}

#[test]
fn a_board_without_a_knob_refuses_both_commands() {
    let mut rig: Rig = Rig::new();
    for command in [Command::AskKnob, Command::Knob(NUMBERS)] {
        let refused = rig.ask(command);
        assert_eq!(refused.reason, Reason::Unsupported);
        assert!(
            refused.allowed.to_string().contains("a knob"),
            "{refused:?}"
        );
    }
    // With a knob whose numbers are constants.
    let motor = Motor::new(Bench::default(), Bench::default(), MOTOR).unwrap();
    let knob = Knob::new(&GEOMETRY, Shown::default(), motor).unwrap();
    let mut rig: Rig<f32, 0, Device> = Rig::with(setup(), knob);
    for command in [Command::AskKnob, Command::Knob(NUMBERS)] {
        assert_eq!(rig.ask(command).reason, Reason::Unsupported);
    }
}
