//! The functions of the header.
//!
//! None may be called for the same memory from two threads at the same time.

use core::ffi::c_char;
use core::fmt::Write;
use core::{slice, str};

use stiction_core::{Evolution, Touch};

use crate::input::{Described, Hand, Scene};
use crate::memory::{
    Checked, Inner, Memory, Snapshot, World, begin, checked, give, given, keep, solver, solver_mut,
    stored,
};
use crate::output::{CONTACTS, Contact, Kind, Output, Wrench};
use crate::result::{Error, Parameter, Result};
use crate::text::Text;

fn answer(done: Checked<()>) -> Result {
    match done {
        Ok(()) => Result::Ok,
        Err(result) => result,
    }
}

/// Builds a solver for a scene, in memory of the caller.
///
/// size: `sizeof(stiction)`, abi: `STICTION_ABI`. error: receives what is wrong with the scene if the result is `STICTION_RESULT_SCENE`;
/// may be null. The evolution is `path`, and there is no budget.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
pub extern "C" fn stiction_init(
    memory: *mut Memory,
    size: usize,
    abi: u32,
    scene: *const Scene,
    error: *mut Error,
) -> Result {
    let world = || {
        let described = Described::read(given(scene)?)?;
        World::new(&described.scene()).map_err(|why| {
            if checked(error).is_ok() {
                give(error, Error::of(&why));
            }
            Result::Scene
        })
    };
    if !error.is_null() && !error.is_aligned() {
        return Result::Unaligned;
    }
    answer(begin(memory, size, abi, world))
}

/// Chooses how frames are evolved: 0, `path`, exact events along the straight path of the hand, whatever the frame rate; 1, `frame`, cheaper:
/// from the first event on the hand jumps to the end of the frame.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
pub extern "C" fn stiction_set_evolution(memory: *mut Memory, evolution: u8) -> Result {
    answer(solver_mut(memory).and_then(|inner| {
        let evolution = *Evolution::ALL
            .get(usize::from(evolution))
            .ok_or(Result::Choice)?;
        inner.solver = inner.solver.clone().with_evolution(evolution);
        Ok(())
    }))
}

/// Bounds the work of a step, in units (the README says what one costs); `UINT32_MAX`: no bound. A step that would take more leaves the
/// body behind the hand, and the next one goes on from there.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
pub extern "C" fn stiction_set_budget(memory: *mut Memory, units: u32) -> Result {
    answer(solver_mut(memory).map(|inner| {
        inner.solver = inner.solver.clone().with_budget(units);
    }))
}

/// Starts a new run: the body at its start pose, with the hand at its first pose. output: may be null.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
pub extern "C" fn stiction_start(
    memory: *mut Memory,
    hand: *const Hand,
    output: *mut Output,
) -> Result {
    answer(moved(memory, hand, output, |inner, hand| {
        let (run, output) = inner.solver.start(hand.sample());
        inner.run = Some(run);
        Ok(Output::of(&output))
    }))
}

/// One frame: the hand moves to its new pose, and the body follows. A sample that is not finite leaves the body as it is, and the status of
/// the output reports it. output: may be null.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
pub extern "C" fn stiction_step(
    memory: *mut Memory,
    hand: *const Hand,
    output: *mut Output,
) -> Result {
    answer(moved(memory, hand, output, |inner, hand| {
        let run = inner.run.as_mut().ok_or(Result::NotStarted)?;
        Ok(Output::of(&inner.solver.step(run, hand.sample())))
    }))
}

fn moved(
    memory: *mut Memory,
    hand: *const Hand,
    output: *mut Output,
    by: impl FnOnce(&mut Inner, &Hand) -> Checked<Output>,
) -> Checked<()> {
    let hand = given(hand)?;
    if !output.is_null() {
        checked(output)?;
    }
    let moved = by(solver_mut(memory)?, hand)?;
    if !output.is_null() {
        give(output, moved);
    }
    Ok(())
}

/// Force and moment of the hand on the body; zero while it is not held. A device outputs the opposite to the hand.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
pub extern "C" fn stiction_wrench(memory: *const Memory, wrench: *mut Wrench) -> Result {
    answer(solver(memory).and_then(|inner| {
        checked(wrench)?;
        let run = inner.run.as_ref().ok_or(Result::NotStarted)?;
        let given = inner.solver.wrench(run);
        let [fx, fy] = given.force;
        give(
            wrench,
            Wrench {
                fx,
                fy,
                moment: given.moment,
            },
        );
        Ok(())
    }))
}

/// The contacts with their forces: written to `contacts`, which has room for `STICTION_CONTACTS`; their number is written to `count`.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
pub extern "C" fn stiction_contacts(
    memory: *const Memory,
    contacts: *mut Contact,
    count: *mut u32,
) -> Result {
    answer(solver(memory).and_then(|inner| {
        checked(contacts)?;
        checked(count)?;
        let all = listed(inner)?;
        let mut number = 0;
        for contact in all.into_iter().flatten() {
            give(contacts.wrapping_add(number), contact);
            number += 1;
        }
        give(count, u32::try_from(number).unwrap_or(u32::MAX));
        Ok(())
    }))
}

fn listed(inner: &Inner) -> Checked<[Option<Contact>; CONTACTS]> {
    let run = inner.run.as_ref().ok_or(Result::NotStarted)?;
    let small = |index: usize| u8::try_from(index).unwrap_or(u8::MAX);
    let mut all = [None; CONTACTS];
    let given = inner.solver.contacts(run);
    for (to, from) in all.iter_mut().zip(given.iter()) {
        let [x, y] = from.point;
        let (kind, feature, other, part) = match from.touch {
            Touch::Surface { vertex, surface } => (Kind::Surface, vertex, surface, 0),
            Touch::Side {
                vertex,
                obstacle,
                side,
            } => (Kind::Side, vertex, obstacle, side),
            Touch::Corner {
                obstacle,
                corner,
                body_side,
            } => (Kind::Corner, body_side, obstacle, corner),
        };
        *to = Some(Contact {
            x,
            y,
            normal: from.normal,
            friction: from.friction,
            sliding: from.sliding,
            kind,
            feature: small(feature),
            other: small(other),
            part: small(part),
        });
    }
    Ok(all)
}

/// Saves the present state of a run.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
pub extern "C" fn stiction_take_snapshot(memory: *const Memory, snapshot: *mut Snapshot) -> Result {
    answer(solver(memory).and_then(|inner| {
        let run = inner.run.as_ref().ok_or(Result::NotStarted)?;
        keep(run, snapshot)
    }))
}

/// Restores a saved state of a run: the same hands lead to the same bits again. The snapshot must be of the same scene.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
pub extern "C" fn stiction_restore(memory: *mut Memory, snapshot: *const Snapshot) -> Result {
    answer(solver_mut(memory).and_then(|inner| {
        inner.run = Some(stored(snapshot)?);
        Ok(())
    }))
}

/// The meaning of a result, and for `STICTION_RESULT_SCENE` what is wrong: `<parameter>, allowed: <what>`. The text ends with 0, and is cut
/// if `size` bytes are too few. error: as `stiction_init` has written it, or null.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
pub extern "C" fn stiction_error_text(
    result: i32,
    error: *const Error,
    text: *mut c_char,
    size: usize,
) -> Result {
    answer(write_error(result, error, text.cast(), size))
}

#[allow(unsafe_code)]
fn write_error(result: i32, error: *const Error, text: *mut u8, size: usize) -> Checked<()> {
    checked(text)?;
    // No text is longer.
    let size = size.min(512);
    // SAFETY: the header requires room for `size` bytes that nothing else uses.
    let mut text = Text::new(unsafe { slice::from_raw_parts_mut(text, size) });
    let written = if result == Result::Scene as i32 && !error.is_null() {
        let error = given(error)?;
        let indices = [error.index, error.second].map(usize::from);
        match Parameter::named(error.parameter, indices) {
            Some(parameter) if !error.allowed.is_null() => {
                // SAFETY: `stiction_init` wrote them from a string.
                let allowed = unsafe { slice::from_raw_parts(error.allowed, error.allowed_length) };
                let allowed = str::from_utf8(allowed).unwrap_or_default();
                write!(text, "{parameter}, allowed: {allowed}")
            }
            _ => text.write_str("the scene can be used"),
        }
    } else {
        text.write_str(meaning(result))
    };
    written.map_err(|_| Result::Size)
}

fn meaning(result: i32) -> &'static str {
    match result {
        0 => "success",
        -1 => "a pointer is null",
        -2 => "a pointer is not aligned for what it points to",
        -3 => {
            "the library does not match the header: another version, number type, or with obstacles or without"
        }
        -4 => "the memory is smaller than the header says",
        -5 => "the memory holds no solver: stiction_init has not been called, or has failed",
        -6 => "the solver has no run: stiction_start has not been called",
        -7 => "the scene cannot be used",
        -8 => "the choice does not exist",
        -9 => "the snapshot holds no run of this library",
        _ => "not a result of this library",
    }
}
