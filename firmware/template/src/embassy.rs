//! The program of a board on embassy, on an RP2040: the line in two futures, the solver in a third one, by the timer.
#![no_std]
#![no_main]

mod setup;

use embassy_futures::join::join3;
use embassy_rp::uart::{BufferedInterruptHandler, BufferedUart, Config};
use embassy_rp::{bind_interrupts, peripherals::UART0, watchdog::Watchdog};
use embassy_sync::{blocking_mutex::raw::CriticalSectionRawMutex, signal::Signal};
use embassy_time::{Duration, Instant, Timer};
use embedded_io_async::{Read, Write};
use panic_halt as _;
use setup::{Program, SETUP};
use stiction_firmware::device::{FromLine, NoActuators, Servo};
use stiction_firmware::line::{Line, Micros};

bind_interrupts!(struct Interrupts { UART0_IRQ => BufferedInterruptHandler<UART0>; });

static LINE: Line<1_024> = Line::new();
static WAKE: Signal<CriticalSectionRawMutex, ()> = Signal::new();

#[embassy_executor::main]
async fn main(_spawner: embassy_executor::Spawner) {
    let chip = embassy_rp::init(Default::default());
    let (mut config, mut out, mut into) = (Config::default(), [0; 256], [0; 256]);
    config.baudrate = setup::BAUD;
    let (uart, tx, rx) = (chip.UART0, chip.PIN_0, chip.PIN_1);
    let port = BufferedUart::new(uart, tx, rx, Interrupts, &mut out, &mut into, config);
    let (tx, rx) = port.split();
    join3(receive(rx), send(tx), ticks(Watchdog::new(chip.WATCHDOG))).await;
}

async fn receive(mut port: impl Read) {
    let mut bytes = [0; 32];
    loop {
        match port.read(&mut bytes).await {
            Ok(count) => LINE.receive_all(bytes.iter().take(count)),
            Err(_) => LINE.lose(),
        }
    }
}

async fn send(mut port: impl Write) {
    loop {
        WAKE.wait().await;
        while let Some(byte) = LINE.next() {
            let _ = port.write(&[byte]).await;
        }
    }
}

async fn ticks(mut watchdog: Watchdog) {
    let Ok(mut program) = Program::new(&SETUP) else {
        return;
    };
    watchdog.start(Duration::from_millis(20));
    let mut servo = Servo::new((FromLine, NoActuators));
    let now_us = || Instant::now().as_micros() as u32;
    let (mut due, mut clock) = (Instant::now(), Micros(now_us));
    loop {
        due = Instant::now().max(due + Duration::from_hz(program.mode().tick_rate.into()));
        Timer::at(due).await;
        let mut line = LINE.link(&mut clock, || WAKE.signal(()));
        program.tick(now_us(), &mut line, &mut servo);
        watchdog.feed(Duration::from_millis(20));
    }
}
