//! The common part of every board: its ticks, its turns, and its log while there is nothing else to do. The board's own part is `board`,
//! with the clock, the watchdog and the device, and in `main.rs` its description (`Setup`), its lines and the priorities of its interrupts:
//! ticks interrupt turns.

use core::sync::atomic::{AtomicU32, Ordering};

use rtic::Mutex;
use stiction_firmware::device::{LockServo, Servo};
use stiction_firmware::line::{self, Clock as _, Line};
use stiction_firmware::station::{Log, Setup, Watch, station_of};

use crate::board::{Clock, Device, Watchdog};
use crate::log::{self, info};
use crate::stop::stop;

mod scene {
    include!(concat!(env!("OUT_DIR"), "/scene.rs"));
}

use scene::OBSTACLES;
pub(crate) use scene::{CompiledScene, SCENE};

/// With room for what is compiled in, see build.rs.
pub(crate) type Program = station_of!(CompiledScene);

/// The news of the turn for the log.
static WATCH: Watch = Watch::new();

/// The longest tick (ns), without its entry: for the log, and for inspection of the memory.
static LONGEST_TICK: AtomicU32 = AtomicU32::new(0);

/// The program of a board; if there is none, nothing is started.
pub(crate) fn program(setup: &'static Setup) -> Program {
    let Ok(program) = Program::among(setup, OBSTACLES) else {
        stop()
    };
    info!(
        "{=str}, {=u16} ticks per second",
        setup.name, setup.mode.tick_rate
    );
    program
}

/// The clock, for ticks and turns. RTIC requires the types that tasks share to be public.
#[allow(unreachable_pub)]
pub struct SharedClock(pub(crate) Clock);

/// The servo loop, likewise.
#[allow(unreachable_pub)]
pub struct SharedServo(Servo<Device>);

impl SharedServo {
    pub(crate) fn new(device: Device) -> Self {
        Self(Servo::new(device))
    }
}

/// A tick has come: the hand is measured, the force is updated. A turn follows.
pub(crate) fn tick(mut clock: impl Mutex<T = SharedClock>, mut servo: impl Mutex<T = SharedServo>) {
    let (now_us, begun) = clock.lock(|clock| (clock.0.tick(), clock.0.now_ns()));
    servo.lock(|servo| servo.0.tick(now_us));
    let took = clock.lock(|clock| clock.0.now_ns()).wrapping_sub(begun);
    // Nothing else writes it, and a Cortex-M0 has no atomic maximum.
    if took > LONGEST_TICK.load(Ordering::Relaxed) {
        LONGEST_TICK.store(took, Ordering::Relaxed);
    }
}

/// The resources of turns.
pub(crate) struct Work {
    pub(crate) program: Program,
    pub(crate) watchdog: Watchdog,
}

impl Work {
    /// A turn; `wake` triggers the interrupt of the line when there is something to send.
    pub(crate) fn turn<const N: usize>(
        &mut self,
        clock: impl Mutex<T = SharedClock>,
        servo: impl Mutex<T = SharedServo>,
        line: &Line<N>,
        wake: fn(),
    ) {
        let (mut clock, mut servo) = (Locked(clock), Locked(servo));
        let mut link = line.link(&mut clock, wake);
        self.program.turn(&mut link, &mut servo);
        let rate = self.program.mode().tick_rate;
        clock.0.lock(|clock| clock.0.set_rate(rate));
        WATCH.show(&self.program.health());
        // Last: a turn that did not do its work does not feed the watchdog; without ticks there are no turns.
        self.watchdog.feed();
    }
}

/// Locks a resource in a turn: ticks interrupt the turn except while it holds the lock.
struct Locked<M>(M);

impl<M: Mutex<T = SharedServo>> LockServo<Device> for Locked<M> {
    fn lock<T>(&mut self, used: impl FnOnce(&mut Servo<Device>) -> T) -> T {
        self.0.lock(|servo| used(&mut servo.0))
    }
}

impl<M: Mutex<T = SharedClock>> line::Clock for Locked<M> {
    fn now_ns(&mut self) -> u32 {
        self.0.lock(|clock| clock.0.now_ns())
    }
}

/// Logs the news for ever; `lost`: the number of bytes that arrived when there was no room for them. It rests in between.
pub(crate) fn log(setup: &Setup, lost: impl Fn() -> u32, rest: fn()) -> ! {
    let mut news = Log::new(&WATCH, setup.mode.tick_rate);
    loop {
        let longest_tick = LONGEST_TICK.load(Ordering::Relaxed);
        news.look(&WATCH, |news| log::tell(news, longest_tick, lost()));
        rest();
    }
}
