//! The emulated boards: their counter and stack, and the files of the host by semihosting. Exit statuses: 0 done, 1 a file cannot be read
//! or written, 2 bad command line, 3 not a job, 4 not a scene, 5 the emulator does not count instructions correctly, 101 a panic, 102 a
//! fault of the processor.

use core::ffi::CStr;
use semihosting::experimental::env;
use semihosting::fs::File;
use semihosting::io::{Read, Write};
use semihosting::process;
use stiction_core::{Description, Evolution, Real, Scene, SceneError, SiFloat};

use crate::bits;
use crate::count::{self, Failure, FileError, Files, Instruments, Totals};

#[cfg(target_arch = "arm")]
mod arm;
#[cfg(all(target_arch = "arm", not(chip = "rp2040")))]
mod cortex_m;
#[cfg(target_arch = "riscv32")]
mod riscv;
#[cfg(chip = "rp2040")]
mod rp2040;
mod stack;

#[cfg(all(target_arch = "arm", not(chip = "rp2040")))]
use self::cortex_m::Counter;
#[cfg(target_arch = "riscv32")]
use self::riscv::Counter;
#[cfg(chip = "rp2040")]
use self::rp2040::Counter;
use self::stack::Watch;
#[cfg(target_arch = "arm")]
pub use cortex_m_rt::entry;
#[cfg(target_arch = "riscv32")]
pub use riscv_rt::entry;

/// The number of instructions of a loop that must be counted.
const PROBE: u32 = 501;
/// The compiler may put at most this many instructions of the caller between the two readings of the counter.
const TOLERANCE: u32 = 4;

/// The longest command line, and the longest file name in it.
const LINE: usize = 256;

struct HostFiles {
    job: File,
    results: File,
}

impl Files for HostFiles {
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, FileError> {
        self.job.read(bytes).map_err(|_| FileError)
    }
    fn write(&mut self, bytes: &[u8]) -> Result<(), FileError> {
        self.results.write_all(bytes).map_err(|_| FileError)
    }
}

/// The programs `count` and `count_among`: do the job in the first file on the command line, in a model, with the budget of a step that
/// follows the second file, write the results to that file, print the totals, and end.
pub fn count<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize>() -> ! {
    measured(|budget, files, instruments| {
        count::run::<R, V, S, C>(None, budget, files, instruments)
    })
}

/// Builds a scene of a number type, capacities for vertices and surfaces, and a model from a description.
pub type Make<R, const V: usize, const S: usize, const C: usize> =
    fn(&Description<'_, <R as Real>::Si>) -> Result<Scene<R, V, S, C>, SceneError<<R as Real>::Si>>;

/// The program `count_scene`: like [`count`], in the model of a compiled-in scene and with its evolution.
#[inline(always)]
pub fn count_in_model<R: Real<Si = f32>, const V: usize, const S: usize, const C: usize>(
    _: Make<R, V, S, C>,
    evolution: Evolution,
) -> ! {
    measured(|budget, files, instruments| {
        count::run::<R, V, S, C>(Some(evolution), budget, files, instruments)
    })
}

struct Board {
    counter: Counter,
    watch: Option<Watch>,
}

impl Instruments for Board {
    #[inline(always)]
    fn count<T>(&mut self, work: impl FnOnce() -> T) -> (u32, T) {
        self.counter.count(work)
    }
    #[inline(always)]
    fn watch_stack(&mut self) {
        self.watch = Some(Watch::begin());
    }
    fn deepest_stack(&mut self) -> u32 {
        self.watch.as_ref().map_or(0, Watch::depth)
    }
}

fn measured(job: impl FnOnce(u32, &mut HostFiles, &mut Board) -> Result<Totals, Failure>) -> ! {
    let Some(mut files) = open() else {
        process::exit(1)
    };
    let budget = argument(3, |text| text.to_str().ok()?.parse().ok()).flatten();
    let Some(budget) = budget else {
        process::exit(2)
    };
    let Some(counter) = Counter::take() else {
        process::exit(5)
    };
    let mut instruments = Board {
        counter,
        watch: None,
    };
    process::exit(match job(budget, &mut files, &mut instruments) {
        Ok(Totals {
            stack,
            solver,
            state,
        }) => {
            semihosting::println!("{stack} {solver} {state}");
            0
        }
        Err(Failure::File) => 1,
        Err(Failure::Format) => 3,
        Err(Failure::Scene(_)) => 4,
    })
}

fn open() -> Option<HostFiles> {
    let job = argument(1, |name| File::open(name))?;
    let results = argument(2, |name| File::create(name))?;
    Some(HostFiles {
        job: job.ok()?,
        results: results.ok()?,
    })
}

/// The program `bits`: prints the hash of the walk, of as many frames as the command line says, in the surroundings of a model, and ends.
pub fn print_bits<R: Real<Si: SiFloat>, const C: usize>() -> ! {
    let frames = argument(1, |text| text.to_str().ok()?.parse().ok()).flatten();
    let Some(frames) = frames else {
        process::exit(2)
    };
    semihosting::println!("{:016x}", bits::of_walk::<R, C>(frames));
    process::exit(0)
}

/// Uses a word of the command line; the program's own name is word 0.
fn argument<T>(index: usize, used: impl FnOnce(&CStr) -> T) -> Option<T> {
    let line = env::args::<LINE>().ok()?;
    let word = (&line).into_iter().nth(index)?.ok()?;
    let mut name = [0; LINE];
    name.get_mut(..word.len())?.copy_from_slice(word.as_bytes());
    CStr::from_bytes_until_nul(&name).ok().map(used)
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    process::exit(101)
}
