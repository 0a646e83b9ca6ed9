//! The memory that the caller owns: solver, state and last answer, with a mark that identifies them; and snapshots of a state.

use core::mem::{align_of, size_of};
use core::ptr;

use stiction_core::{Evolution, Scene, Solver, State};

use crate::result::Result;

#[cfg(feature = "fixed")]
pub(crate) type Number = stiction_core::Fixed;
#[cfg(not(feature = "fixed"))]
pub(crate) type Number = f32;

/// The maximum number of vertices of a body.
pub const VERTICES: usize = 8;
/// The maximum number of surfaces of a scene.
#[cfg(feature = "plane")]
pub const SURFACES: usize = 1;
/// The maximum number of surfaces of a scene.
#[cfg(not(feature = "plane"))]
pub const SURFACES: usize = 4;
/// The maximum number of obstacles of a scene.
pub const OBSTACLES: usize = 8;
/// The maximum number of corners of all obstacles together.
pub const CORNERS: usize = 32;

/// The solver's capacity of corners.
///
/// cbindgen:ignore
const ROOM: usize = if cfg!(feature = "obstacles") {
    CORNERS
} else {
    0
};

/// cbindgen:ignore
pub(crate) type World = Scene<Number, VERTICES, SURFACES, ROOM>;
/// cbindgen:ignore
pub(crate) type Engine = Solver<Number, VERTICES, SURFACES, ROOM>;
/// cbindgen:ignore
pub(crate) type Run = State<Number>;

/// The size of the memory in words of 8 bytes.
#[cfg(feature = "obstacles")]
pub const WORDS: usize = 512;
/// The size of the memory in words of 8 bytes.
#[cfg(all(not(feature = "obstacles"), not(feature = "plane")))]
pub const WORDS: usize = 144;
/// The size of the memory in words of 8 bytes.
#[cfg(all(not(feature = "obstacles"), feature = "plane"))]
pub const WORDS: usize = 120;
/// The size of a snapshot in words of 8 bytes.
pub const SNAPSHOT_WORDS: usize = 72;

/// What the library and the header must agree on: version 1.0, number type, room. `stiction_init` compares it.
#[cfg(all(
    not(feature = "fixed"),
    not(feature = "obstacles"),
    not(feature = "plane")
))]
pub const ABI: u32 = 0x0100;
/// What the library and the header must agree on: version 1.0, number type, room. `stiction_init` compares it.
#[cfg(all(feature = "fixed", not(feature = "obstacles"), not(feature = "plane")))]
pub const ABI: u32 = 0x0101;
/// What the library and the header must agree on: version 1.0, number type, room. `stiction_init` compares it.
#[cfg(all(not(feature = "fixed"), feature = "obstacles"))]
pub const ABI: u32 = 0x0102;
/// What the library and the header must agree on: version 1.0, number type, room. `stiction_init` compares it.
#[cfg(all(feature = "fixed", feature = "obstacles"))]
pub const ABI: u32 = 0x0103;
/// What the library and the header must agree on: version 1.0, number type, room. `stiction_init` compares it.
#[cfg(all(not(feature = "fixed"), not(feature = "obstacles"), feature = "plane"))]
pub const ABI: u32 = 0x0104;
/// What the library and the header must agree on: version 1.0, number type, room. `stiction_init` compares it.
#[cfg(all(feature = "fixed", not(feature = "obstacles"), feature = "plane"))]
pub const ABI: u32 = 0x0105;

#[cfg(all(feature = "obstacles", feature = "plane"))]
compile_error!("the features `obstacles` and `plane` exclude each other");

/// A solver with its run. Its contents are private; to move it, copy the whole.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Memory {
    /// Private.
    pub words: [u64; WORDS],
}

/// A saved state of a run.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Snapshot {
    /// Private.
    pub words: [u64; SNAPSHOT_WORDS],
}

pub(crate) struct Inner {
    mark: u32,
    pub(crate) solver: Engine,
    pub(crate) run: Option<Run>,
}

struct Stored {
    mark: u32,
    run: Run,
}

const _: () = assert!(
    size_of::<Inner>() <= size_of::<Memory>() && align_of::<Inner>() <= align_of::<Memory>()
);
const _: () = assert!(
    size_of::<Stored>() <= size_of::<Snapshot>() && align_of::<Stored>() <= align_of::<Snapshot>()
);

/// The first word of memory that holds a solver, and of a snapshot that holds a run.
const SOLVER: u32 = ABI ^ 0x534f_0000;
const RUN: u32 = ABI ^ 0x5255_0000;

/// A value, or the reason why a function cannot be carried out.
///
/// cbindgen:ignore
pub(crate) type Checked<T> = core::result::Result<T, Result>;

/// A pointer that is neither null nor misaligned.
pub(crate) fn checked<T>(place: *const T) -> Checked<*const T> {
    if place.is_null() {
        Err(Result::Null)
    } else if place.is_aligned() {
        Ok(place)
    } else {
        Err(Result::Unaligned)
    }
}

#[allow(unsafe_code)]
pub(crate) fn given<'a, T>(place: *const T) -> Checked<&'a T> {
    // SAFETY: the header requires a pointer to a T that nothing changes while the function runs; it is aligned and not null.
    checked(place).map(|place| unsafe { &*place })
}

#[allow(unsafe_code)]
pub(crate) fn give<T>(place: *mut T, value: T) {
    // SAFETY: as in `given`; nothing else uses the location while the function runs. The old value needs no drop.
    unsafe { ptr::write(place, value) }
}

/// Checks that the memory is large enough, and its caller uses the same header.
fn fits(memory: *mut Memory, size: usize, abi: u32) -> Checked<*mut Inner> {
    checked(memory)?;
    if abi != ABI {
        return Err(Result::Abi);
    }
    if size < size_of::<Memory>() {
        return Err(Result::Size);
    }
    Ok(memory.cast())
}

/// Puts a solver without a run into the memory.
pub(crate) fn begin(
    memory: *mut Memory,
    size: usize,
    abi: u32,
    scene: impl FnOnce() -> Checked<World>,
) -> Checked<()> {
    let place = fits(memory, size, abi)?;
    let inner = Inner {
        mark: SOLVER,
        solver: Solver::new(scene()?, Evolution::Path),
        run: None,
    };
    give(place, inner);
    Ok(())
}

#[allow(unsafe_code)]
pub(crate) fn solver<'a>(memory: *const Memory) -> Checked<&'a Inner> {
    let place = checked(memory)?.cast::<Inner>();
    // SAFETY: aligned, not null, and as large as the header says; the mark is a number, whatever its bytes are.
    let mark = unsafe { ptr::read(&raw const (*place).mark) };
    if mark != SOLVER {
        return Err(Result::NotInitialised);
    }
    // SAFETY: if the mark is there, `begin` has written a whole value.
    Ok(unsafe { &*place })
}

#[allow(unsafe_code)]
pub(crate) fn solver_mut<'a>(memory: *mut Memory) -> Checked<&'a mut Inner> {
    solver(memory)?;
    // SAFETY: as in `solver`, and nothing else uses it while the function runs, which the header requires.
    Ok(unsafe { &mut *memory.cast::<Inner>() })
}

#[allow(unsafe_code)]
pub(crate) fn stored(snapshot: *const Snapshot) -> Checked<Run> {
    let place = checked(snapshot)?.cast::<Stored>();
    // SAFETY: as in `solver`.
    let mark = unsafe { ptr::read(&raw const (*place).mark) };
    if mark != RUN {
        return Err(Result::NoSnapshot);
    }
    // SAFETY: if the mark is there, `keep` has written a whole value.
    Ok(unsafe { (*place).run.clone() })
}

pub(crate) fn keep(run: &Run, snapshot: *mut Snapshot) -> Checked<()> {
    checked(snapshot)?;
    let stored = Stored {
        mark: RUN,
        run: run.clone(),
    };
    give(snapshot.cast(), stored);
    Ok(())
}
