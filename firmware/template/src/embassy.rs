//! The program of a board on embassy, on an RP2040. The line and the ticks are in an executor that interrupts the solver's: no byte
//! and no tick waits for a long turn.
#![no_std]
#![no_main]

mod setup;

use core::cell::RefCell;
use core::future::pending;
use core::sync::atomic::{AtomicU16, Ordering};
use embassy_executor::InterruptExecutor;
use embassy_futures::join::join3;
use embassy_rp::interrupt;
use embassy_rp::interrupt::{InterruptExt, Priority};
use embassy_rp::uart::{BufferedInterruptHandler, BufferedUart, Config};
use embassy_rp::{bind_interrupts, peripherals::UART0, watchdog::Watchdog};
use embassy_sync::blocking_mutex::raw::{CriticalSectionRawMutex, RawMutex};
use embassy_sync::{blocking_mutex::Mutex, signal::Signal};
use embassy_time::{Duration, Instant, Timer};
use embedded_io_async::{Read, Write};
use setup::{Program, SETUP};
use stiction_firmware::device::{FromLine, LockServo, NoActuators, Servo};
use stiction_firmware::line::{Line, Micros};

bind_interrupts!(struct Interrupts { UART0_IRQ => BufferedInterruptHandler<UART0>; });

type Device = (FromLine, NoActuators);

/// Without a turn for this long, the watchdog resets the board.
const PATIENCE: Duration = Duration::from_millis(20);
static LINE: Line<1_024> = Line::new();
static SEND: Signal<CriticalSectionRawMutex, ()> = Signal::new();
static TURN: Signal<CriticalSectionRawMutex, ()> = Signal::new();
static RATE: AtomicU16 = AtomicU16::new(SETUP.mode.tick_rate);
static SERVO: Mutex<NoTicks, RefCell<Option<Servo<Device>>>> = Mutex::new(RefCell::new(None));
static URGENT: InterruptExecutor = InterruptExecutor::new();

/// The interrupt of the calendar, which nothing else uses, runs the urgent executor.
#[interrupt]
unsafe fn RTC_IRQ() {
    // SAFETY: this is the handler of the interrupt with which it was started.
    unsafe { URGENT.on_interrupt() }
}

#[embassy_executor::main]
async fn main(_spawner: embassy_executor::Spawner) {
    let chip = embassy_rp::init(Default::default());
    let (mut config, mut out, mut into) = (Config::default(), [0; 256], [0; 256]);
    config.baudrate = setup::BAUD;
    let (uart, tx, rx) = (chip.UART0, chip.PIN_0, chip.PIN_1);
    let port = BufferedUart::new(uart, tx, rx, Interrupts, &mut out, &mut into, config);
    // After the interrupts of UART and timer, which are at P0.
    interrupt::RTC_IRQ.set_priority(Priority::P1);
    let urgent = urgent(port).map(|task| URGENT.start(interrupt::RTC_IRQ).spawn(task));
    let mut watchdog = Watchdog::new(chip.WATCHDOG);
    watchdog.start(PATIENCE);
    // Without a program or ticks, nothing feeds the watchdog.
    let (Ok(mut program), Ok(())) = (Program::new(&SETUP), urgent) else {
        return pending().await;
    };
    let mut clock = Micros(now_us);
    loop {
        TURN.wait().await;
        let mut line = LINE.link(&mut clock, || SEND.signal(()));
        program.turn(&mut line, &mut Shared);
        RATE.store(program.mode().tick_rate, Ordering::Relaxed);
        watchdog.feed(PATIENCE);
    }
}

#[embassy_executor::task]
async fn urgent(port: BufferedUart) {
    let (tx, rx) = port.split();
    join3(receive(rx), send(tx), ticks()).await;
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
        SEND.wait().await;
        while let Some(byte) = LINE.next() {
            let _ = port.write(&[byte]).await;
        }
    }
}

async fn ticks() {
    let mut due = Instant::now();
    loop {
        let period = Duration::from_hz(RATE.load(Ordering::Relaxed).into());
        due = Instant::now().max(due + period);
        Timer::at(due).await;
        Shared.lock(|servo| servo.tick(now_us()));
        TURN.signal(());
    }
}

fn now_us() -> u32 {
    Instant::now().as_micros() as u32
}

/// Keeps ticks out of a turn, and no other interrupt: the UART has room for 43 us.
struct NoTicks;

// SAFETY: ticks run in this interrupt, and turns nowhere else than below it. In a tick itself it is active, and nothing changes.
unsafe impl RawMutex for NoTicks {
    const INIT: Self = Self;

    fn lock<R>(&self, used: impl FnOnce() -> R) -> R {
        interrupt::RTC_IRQ.disable();
        let result = used();
        // SAFETY: it was enabled: turns begin after ticks.
        unsafe { interrupt::RTC_IRQ.enable() };
        result
    }
}

/// The servo loop, for ticks and turns.
struct Shared;

impl LockServo<Device> for Shared {
    fn lock<T>(&mut self, used: impl FnOnce(&mut Servo<Device>) -> T) -> T {
        let device = (FromLine, NoActuators);
        SERVO.lock(|servo| used(servo.borrow_mut().get_or_insert_with(|| Servo::new(device))))
    }
}

/// Turn your motors off here: the watchdog resets the board only later.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
