//! What every board does: its tick, and its log while nothing else is to be done. Its own part is `board`, which gives the clock, the
//! watchdog and the device, and in `main.rs` what it is (`Setup`), its lines and who interrupts whom.

use stiction_firmware::line::Line;
use stiction_firmware::station::{Log, Setup, Watch, station_of};

use crate::board::{Clock, Device, Watchdog};
use crate::log::{self, info};
use crate::stop::stop;

mod scene {
    include!(concat!(env!("OUT_DIR"), "/scene.rs"));
}

pub(crate) use scene::SCENE;
use scene::{CompiledScene, OBSTACLES};

/// With room for what is compiled in, see build.rs.
pub(crate) type Program = station_of!(CompiledScene);

/// What the tick tells the log.
static WATCH: Watch = Watch::new();

/// The program of a board; without one, nothing is started.
pub(crate) fn program(setup: &'static Setup) -> Program {
    let Ok(program) = Program::among(setup, OBSTACLES) else {
        stop()
    };
    info!(
        "{=str}, {=u16} ticks a second",
        setup.name, setup.mode.tick_rate
    );
    program
}

/// What the tick works with.
pub(crate) struct Work {
    pub(crate) clock: Clock,
    pub(crate) watchdog: Watchdog,
    pub(crate) device: Device,
    pub(crate) program: Program,
}

impl Work {
    /// A tick; `wake` lets the interrupt of the line come when there is something to send.
    pub(crate) fn tick<const N: usize>(&mut self, line: &Line<N>, wake: fn()) {
        let now_us = self.clock.tick();
        let mut link = line.link(&mut self.clock, wake);
        self.program.tick(now_us, &mut link, &mut self.device);
        self.clock.set_rate(self.program.mode().tick_rate);
        WATCH.show(&self.program.health());
        // Last: a tick that did not do its work feeds nothing.
        self.watchdog.feed();
    }
}

/// Logs what there is to say, for ever: `lost` bytes came when there was no room for them; in between it rests.
pub(crate) fn log(setup: &Setup, lost: impl Fn() -> u32, rest: fn()) -> ! {
    let mut news = Log::new(&WATCH, setup.mode.tick_rate);
    loop {
        news.look(&WATCH, |news| log::tell(news, lost()));
        rest();
    }
}
