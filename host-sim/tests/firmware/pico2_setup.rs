//! How the image for the Pico 2 sets its chip up. It runs from the reset vector on, on the core of a chip whose registers remember, see
//! `rp2350`. Every register must hold what its description in the RP2350 datasheet asks for what the board promises: 150 MHz from a crystal of
//! 12 MHz, USB, 921600 8N1, 1 000 ticks a second, a watchdog of 20 ms. What the chip makes of its registers is not shown.

use crate::bench::Clocked;
use crate::chip::PICO2;
use crate::rp2350::*;
use stiction_tests::station::client::{Client, Said};
use stiction_tools::image::flashed;
use stiction_wire::Mode;

/// Of the crystal, the processor and USB (Hz).
const CRYSTAL: u32 = 12_000_000;
const CLOCK: u32 = 150_000_000;
const USB_CLOCK: u32 = 48_000_000;
const BAUD: u32 = 921_600;
/// Of ticks (µs).
const PERIOD: u32 = 1_000_000 / Mode::DEFAULT.tick_rate as u32;
/// The watchdog waits for so long (µs).
const PATIENCE: u32 = 20_000;
/// Many times what the set-up takes, so that one that waits for ever ends.
const MOST_STEPS: u64 = 1_000_000;

/// Bits of a register: from the lowest one on.
const fn bits(word: u32, lowest: u32, count: u32) -> u32 {
    word >> lowest & ((1 << count) - 1)
}

/// The chip, as soon as the program has nothing to do but wait.
fn started() -> Option<Chip> {
    let image = PICO2.image()?;
    let mut chip = Chip::new(flashed(&image.path, FLASH).unwrap());
    while !chip.sleeps() {
        assert!(
            chip.cycles() < MOST_STEPS,
            "it never sleeps: {:#x}",
            chip.at()
        );
        chip.step();
    }
    Some(chip)
}

/// What a PLL makes of the crystal by its registers CS, PWR, FBDIV_INT and PRIM, and what it must keep to (datasheet, 8.6).
fn frequency(chip: &Chip, pll: u32) -> u32 {
    let [control, power, feedback, dividers] = [0, 4, 8, 12].map(|offset| chip.word(pll + offset));
    // BYPASS; VCOPD, POSTDIVPD, PD.
    assert_eq!((bits(control, 8, 1), power & 0b10_1001), (0, 0));
    // REFDIV, FBDIV_INT, POSTDIV1, POSTDIV2.
    let reference = CRYSTAL / bits(control, 0, 6);
    let feedback = bits(feedback, 0, 12);
    let [first, second] = [16, 12].map(|lowest| bits(dividers, lowest, 3));
    let oscillator = reference * feedback;
    assert!(reference >= 5_000_000 && (16..=320).contains(&feedback));
    assert!((750_000_000..=1_600_000_000).contains(&oscillator));
    assert!(first >= second && oscillator.is_multiple_of(first * second));
    oscillator / (first * second)
}

#[test]
fn the_pico_2_runs_at_150_mhz_from_its_crystal() {
    let Some(chip) = started() else { return };
    // CTRL: ENABLE; FREQ_RANGE of 1 to 15 MHz. STARTUP: DELAY in 256 cycles, 1 ms at least; without X4.
    assert_eq!(chip.word(XOSC), 0xFAB << 12 | 0xAA0);
    let delay = bits(chip.word(XOSC + 0xC), 0, 14) * 256;
    assert!(delay >= CRYSTAL / 1_000, "{delay} cycles");
    assert_eq!(frequency(&chip, PLL_SYS), CLOCK);
    assert_eq!(frequency(&chip, PLL_USB), USB_CLOCK);
    // CLK_REF_CTRL: SRC is the crystal. CLK_SYS_CTRL: SRC is AUXSRC, which is PLL_SYS.
    assert_eq!(bits(chip.word(CLOCKS + 0x30), 0, 2), 2);
    let system = chip.word(CLOCKS + 0x3C);
    assert_eq!((bits(system, 0, 1), bits(system, 5, 3)), (1, 0));
    // CLK_PERI_CTRL: ENABLE, no KILL, AUXSRC is CLK_SYS. CLK_USB_CTRL: the same bits, AUXSRC is PLL_USB.
    for control in [0x48, 0x60].map(|offset| chip.word(CLOCKS + offset)) {
        assert_eq!((bits(control, 10, 2), bits(control, 5, 3)), (0b10, 0));
    }
    // Their dividers: INT is 1, FRAC 0.
    for offset in [0x34, 0x40, 0x4C, 0x64] {
        assert_eq!(chip.word(CLOCKS + offset), 1 << 16, "{offset:#x}");
    }
}

#[test]
fn the_pico_2_counts_microseconds_and_is_to_tick_after_a_period() {
    let Some(chip) = started() else { return };
    // TICKS: TIMER0 and WATCHDOG, each CTRL with ENABLE and CYCLES of the crystal in a microsecond.
    assert_eq!(PERIOD, 1_000);
    for offset in [0x18, 0x30] {
        assert_eq!(bits(chip.word(TICKS + offset), 0, 1), 1);
        assert_eq!(
            bits(chip.word(TICKS + offset + 4), 0, 9),
            CRYSTAL / 1_000_000
        );
    }
    // TIMER0: SOURCE is the tick, PAUSE is off; ALARM0 is armed, enabled in INTE and nothing is forced in INTF.
    let [armed, pause, source, enabled, forced] =
        [0x20, 0x30, 0x38, 0x40, 0x44].map(|offset| chip.word(TIMER0 + offset));
    assert_eq!([armed, pause, source, enabled, forced], [1, 0, 0, 1, 0]);
    // It fires a period after the start of the clock, which was before now and after power-up.
    let (alarm, now) = (chip.word(ALARM0), chip.cycles() / CYCLES);
    assert!(
        (PERIOD..=PERIOD + now as u32).contains(&alarm),
        "{alarm} µs"
    );
}

/// The timer fires and interrupts: the only thing that happens to the program.
#[test]
fn the_pico_2_ticks_every_ms_feeds_its_watchdog_and_sends_poses() {
    const COUNT: usize = 100;
    let Some(mut chip) = started() else { return };
    let begun = chip.written(ALARM0).len();
    // The last pose is on the line for a part of a period.
    let period = u64::from(PERIOD) * CYCLES;
    chip.run(COUNT as u64 * period + period / 2);
    let alarms = chip.written(ALARM0);
    assert_eq!(alarms.len() - begun, COUNT);
    let mut pairs = alarms.windows(2);
    assert!(
        pairs.all(|pair| pair[1].1 - pair[0].1 == PERIOD),
        "{alarms:?}"
    );
    // INTR: what has fired was cleared.
    assert_eq!(chip.word(TIMER0 + 0x3C), 0);
    // A turn for every tick, which feeds the watchdog before the next one.
    let fed = chip.written(WATCHDOG + 4);
    assert!(fed.iter().all(|(_, load)| *load == PATIENCE), "{fed:?}");
    for pair in alarms.windows(2) {
        let between = fed
            .iter()
            .filter(|(at, _)| (pair[0].0..pair[1].0).contains(at));
        assert_eq!(between.count(), 1, "{pair:?}");
    }
    // A pose for every tick, with its time, when nobody has sent anything.
    let mut client = Client::default();
    client.listen(&chip.gone());
    let poses = client
        .inbox
        .iter()
        .filter(|received| matches!(received.said, Said::Pose(_)));
    let times: Vec<u32> = poses.map(|received| received.time).collect();
    let due: Vec<u32> = alarms.iter().map(|(_, time)| *time).take(COUNT).collect();
    assert_eq!(times, due, "{:?}", client.faults());
}

#[test]
fn the_watchdog_of_the_pico_2_waits_for_20_ms() {
    let Some(chip) = started() else { return };
    // LOAD (µs). CTRL: ENABLE, no TRIGGER.
    assert_eq!(chip.word(WATCHDOG + 4), PATIENCE);
    assert_eq!(bits(chip.word(WATCHDOG), 30, 2), 1);
    // WDSEL: the stages RESETS and CLOCKS are reset, neither ROSC nor XOSC is.
    let stages = chip.word(PSM + 8);
    assert_eq!((bits(stages, 4, 2), bits(stages, 2, 2)), (0b11, 0));
}

#[test]
fn the_line_of_the_pico_2_is_at_its_pins_with_921600_8n1() {
    let Some(chip) = started() else { return };
    // UARTIBRD, UARTFBRD: 16 bits of the baud rate fit into the clock so often, in 64ths.
    let divisor = chip.word(UART0 + 0x24) * 64 + chip.word(UART0 + 0x28);
    let ideal = f64::from(CLOCK) / (16.0 * f64::from(BAUD)) * 64.0;
    assert_eq!(divisor, ideal.round() as u32);
    // UARTLCR_H: WLEN of 8 bits, FEN; not SPS, STP2, EPS, PEN, BRK.
    assert_eq!(chip.word(UART0 + 0x2C), 0b11 << 5 | 1 << 4);
    // UARTCR: RXE, TXE, UARTEN; no flow control, no loop.
    assert_eq!(chip.word(UART0 + 0x30), 1 << 9 | 1 << 8 | 1);
    // UARTIMSC: RTIM, RXIM.
    assert_eq!(chip.word(UART0 + 0x38), 1 << 6 | 1 << 4);
    // UARTIFLS: RXIFLSEL leaves half of 32 bytes free.
    assert_eq!(bits(chip.word(UART0 + 0x34), 3, 3), 2);
    for pin in 0..2 {
        // GPIO_CTRL: FUNCSEL of UART0, nothing inverted or forced.
        assert_eq!(chip.word(IO_BANK0 + 4 + 8 * pin), 2, "GP{pin}");
        // Pad: IE; not ISO, not OD.
        assert_eq!(
            bits(chip.word(PADS_BANK0 + 4 + 4 * pin), 6, 3),
            1,
            "GP{pin}"
        );
    }
}

#[test]
fn no_other_pin_of_the_pico_2_drives_anything() {
    let Some(chip) = started() else { return };
    for pin in 2..30 {
        // GPIO_CTRL: FUNCSEL is NULL. Pad: ISO.
        let control = chip.word(IO_BANK0 + 4 + 8 * pin);
        let pad = chip.word(PADS_BANK0 + 4 + 4 * pin);
        assert_eq!((bits(control, 0, 5), bits(pad, 8, 1)), (31, 1), "GP{pin}");
    }
}

#[test]
fn the_pico_2_is_a_device_on_usb_with_its_own_number() {
    let Some(chip) = started() else { return };
    // MAIN_CTRL: CONTROLLER_EN; no HOST_NDEVICE, PHY_ISO, SIM_TIMING.
    assert_eq!(chip.word(USB + 0x40), 1);
    // SIE_CTRL: PULLUP_EN, no PULLDOWN_EN, no TRANSCEIVER_PD.
    assert_eq!(bits(chip.word(USB + 0x4C), 15, 4), 0b0010);
    // USB_MUXING: SOFTCON, TO_PHY. USB_PWR: VBUS_DETECT_OVERRIDE_EN, VBUS_DETECT.
    assert_eq!(chip.word(USB + 0x74), 1 << 3 | 1);
    assert_eq!(chip.word(USB + 0x78), 1 << 3 | 1 << 2);
    // INTE: SETUP_REQ, BUS_RESET, BUFF_STATUS at least.
    let needed = 1 << 16 | 1 << 12 | 1 << 4;
    assert_eq!(chip.word(USB + 0x90) & needed, needed);
    // The wafer comes first.
    let number = format!("{WAFER:08X}{DEVICE:08X}");
    let mut places = chip.ram().windows(number.len());
    assert!(places.any(|place| place == number.as_bytes()));
}

#[test]
fn what_must_not_wait_interrupts_the_rest_of_the_pico_2() {
    let Some(chip) = started() else { return };
    // UART0, TIMER0, the turn by SPARE_IRQ 0, USB (datasheet, 3.2): as main.rs has it.
    let priorities = [33, 0, 46, 14].map(|interrupt| chip.priority(interrupt).expect("enabled"));
    assert!(
        priorities.is_sorted_by(|sooner, later| sooner < later),
        "{priorities:x?}"
    );
    assert_eq!(chip.enabled(), priorities.len());
}

#[test]
fn the_pico_2_reaches_no_peripheral_in_reset() {
    let Some(chip) = started() else { return };
    assert!(chip.lost().is_empty(), "{:x?}", chip.lost());
    // RESETS: out of it are IO_BANK0, PADS_BANK0, both PLLs, TIMER0, UART0, USBCTRL.
    let used = [6, 9, 14, 15, 23, 26, 28].map(|bit| bits(chip.word(RESETS), bit, 1));
    assert_eq!(used, [0; 7]);
}
