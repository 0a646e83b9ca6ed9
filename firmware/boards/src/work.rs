//! The work of every board: its ticks, its turns, and its log while there is nothing else to do. Ticks interrupt turns.

use core::sync::atomic::{AtomicU32, Ordering};

use rtic::Mutex;
use stiction_firmware::device::{Actuators, FromLine, LockServo, NoActuators, Servo, Source};
use stiction_firmware::line::{self, Line};
use stiction_firmware::safety::Limits;
use stiction_firmware::station::{Log, SceneType, Setup, Watch, station_of};
use stiction_wire::Mode;

use crate::log::{self, info};
use crate::stop;
use crate::{Ticks, Watchdog};

mod scene {
    include!(concat!(env!("OUT_DIR"), "/scene.rs"));
}

use scene::{CompiledScene, SCENE};

/// With room for what is compiled in, see build.rs.
pub type Program = station_of!(CompiledScene);

/// Samples come over the line, and the force is only reported.
pub type NoDevice = (FromLine, NoActuators);
/// The value of this type.
pub const NO_DEVICE: NoDevice = (FromLine, NoActuators);

/// What most boards have in common: no device, the scene that is compiled in. Each names itself and its speed.
pub const SETUP: Setup = Setup {
    name: "",
    number: CompiledScene::NUMBER,
    line_rate: 0,
    fastest_tick: 0,
    work_rate: 0,
    limits: Limits::DEFAULT,
    passivity: None,
    mode: Mode::DEFAULT,
    scene: SCENE,
    knob: None,
};

/// The news of the turn for the log.
static WATCH: Watch = Watch::new();

/// The longest tick (ns), without its entry: for the log, and for inspection of the memory.
static LONGEST_TICK: AtomicU32 = AtomicU32::new(0);

/// The program of a board; if there is none, nothing is started.
// Compiled in the image, as its turns are: otherwise both crates had a solver of their own, 23 kB more.
#[inline]
pub fn program(setup: &'static Setup) -> Program {
    let Ok(program) = Program::new(setup) else {
        stop()
    };
    info!(
        "{=str}, {=u16} ticks per second",
        setup.name, setup.mode.tick_rate
    );
    program
}

/// A tick has come: the hand is measured, the force is updated. A turn follows.
pub fn tick<C, D>(mut clock: impl Mutex<T = C>, mut servo: impl Mutex<T = Servo<D>>)
where
    C: Ticks,
    D: Source + Actuators,
{
    let (now_us, begun) = clock.lock(|clock| (clock.tick(), clock.now_ns()));
    servo.lock(|servo| servo.tick(now_us));
    let took = clock.lock(|clock| clock.now_ns()).wrapping_sub(begun);
    // Nothing else writes it, and a Cortex-M0 has no atomic maximum.
    if took > LONGEST_TICK.load(Ordering::Relaxed) {
        LONGEST_TICK.store(took, Ordering::Relaxed);
    }
}

/// The resources of turns.
pub struct Work<W> {
    /// The program.
    pub program: Program,
    /// The watchdog.
    pub watchdog: W,
}

impl<W: Watchdog> Work<W> {
    /// A turn; `wake` triggers the interrupt of the line when there is something to send.
    pub fn turn<C, D, const N: usize>(
        &mut self,
        clock: impl Mutex<T = C>,
        servo: impl Mutex<T = Servo<D>>,
        line: &Line<N>,
        wake: fn(),
    ) where
        C: Ticks,
        D: Source + Actuators,
    {
        let (mut clock, mut servo) = (Locked(clock), Locked(servo));
        let mut link = line.link(&mut clock, wake);
        self.program.turn(&mut link, &mut servo);
        let rate = self.program.mode().tick_rate;
        clock.0.lock(|clock| clock.set_rate(rate));
        WATCH.show(&self.program.health());
        // Last: a turn that did not do its work does not feed the watchdog; without ticks there are no turns.
        self.watchdog.feed();
    }
}

/// Locks a resource in a turn: ticks interrupt the turn except while it holds the lock.
struct Locked<M>(M);

impl<D, M: Mutex<T = Servo<D>>> LockServo<D> for Locked<M> {
    fn lock<T>(&mut self, used: impl FnOnce(&mut Servo<D>) -> T) -> T {
        self.0.lock(used)
    }
}

impl<M: Mutex<T: Ticks>> line::Clock for Locked<M> {
    fn now_ns(&mut self) -> u32 {
        self.0.lock(|clock| clock.now_ns())
    }
}

/// Logs the news for ever; `lost`: the number of bytes that arrived when there was no room for them. It rests in between.
pub fn log(setup: &Setup, lost: impl Fn() -> u32, rest: fn()) -> ! {
    let mut news = Log::new(&WATCH, setup.mode.tick_rate);
    loop {
        let longest_tick = LONGEST_TICK.load(Ordering::Relaxed);
        news.look(&WATCH, |news| log::report(news, longest_tick, lost()));
        rest();
    }
}
