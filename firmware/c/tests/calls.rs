//! The functions of the header, called as C calls them: the bits of the solver, snapshots, and arguments that cannot be used.
#![allow(unsafe_code)]

use std::mem::{MaybeUninit, size_of};
use std::ptr::{null, null_mut};

use stiction::{
    ABI, CONTACTS, Contact, Error, Hand, Memory, Output, Parameter, Result, Scene, Snapshot,
    Surface, WORDS, Wrench, stiction_contacts, stiction_error_text, stiction_init,
    stiction_restore, stiction_set_budget, stiction_set_evolution, stiction_start, stiction_step,
    stiction_take_snapshot, stiction_wrench,
};

const BOX: [[f32; 2]; 4] = [[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]];

fn floor() -> Surface {
    Surface {
        normal: [0.0, 1.0],
        offset: 0.0,
        friction_static: 0.5,
        friction_dynamic: 0.3,
        memory: 0.0,
        has_memory: 0,
    }
}

fn scene(surfaces: &[Surface]) -> Scene {
    Scene {
        vertices: BOX.as_ptr(),
        vertex_count: 4,
        start: [0.0, 0.03, 0.0],
        weight: 0.0,
        holding_point: [0.0, 0.02],
        has_holding_point: 1,
        reach: 0.0,
        stiffness_translation: 500.0,
        stiffness_rotation: 0.5,
        surfaces: surfaces.as_ptr(),
        surface_count: surfaces.len() as u32,
        obstacles: null(),
        obstacle_count: 0,
    }
}

fn hand(x: f32, y: f32, phi: f32) -> Hand {
    Hand {
        x,
        y,
        phi,
        turns: 0,
        depth: 0.0,
        held: 1,
    }
}

const EMPTY: Memory = Memory { words: [0; WORDS] };

fn begun() -> Box<Memory> {
    let mut memory = Box::new(EMPTY);
    let floor = [floor()];
    let result = stiction_init(
        &mut *memory,
        size_of::<Memory>(),
        ABI,
        &scene(&floor),
        null_mut(),
    );
    assert_eq!(result, Result::Ok);
    assert_eq!(
        stiction_start(&mut *memory, &hand(0.0, 0.04, 0.0), null_mut()),
        Result::Ok
    );
    memory
}

fn step(memory: &mut Memory, hand: &Hand) -> Output {
    let mut output = MaybeUninit::uninit();
    assert_eq!(stiction_step(memory, hand, output.as_mut_ptr()), Result::Ok);
    // SAFETY: it was written.
    unsafe { output.assume_init() }
}

/// The outputs of a run, as bits.
fn answers(memory: &mut Memory, hand: &Hand) -> Vec<u32> {
    let output = step(memory, hand);
    let mut wrench = Wrench {
        fx: 0.0,
        fy: 0.0,
        moment: 0.0,
    };
    assert_eq!(stiction_wrench(memory, &mut wrench), Result::Ok);
    let numbers = [
        output.x,
        output.y,
        output.theta,
        output.longest_slip,
        wrench.fx,
        wrench.fy,
        wrench.moment,
    ];
    let mut bits: Vec<u32> = numbers.iter().map(|x| x.to_bits()).collect();
    bits.extend([
        output.slips,
        output.work,
        output.status as u32,
        output.state as u32,
        u32::from(output.event_count),
    ]);
    bits
}

/// Down, along with a turn, and up.
fn way(i: u32) -> Hand {
    let t = i as f32 / 500.0;
    hand(
        0.05 * (3.0 * t).sin(),
        0.05 - 0.02 * t.sin(),
        0.3 * (2.0 * t).sin(),
    )
}

#[test]
fn a_snapshot_leads_to_the_same_bits_again() {
    let mut memory = begun();
    for i in 0..300 {
        step(&mut memory, &way(i));
    }
    let mut snapshot = MaybeUninit::<Snapshot>::uninit();
    assert_eq!(
        stiction_take_snapshot(&*memory, snapshot.as_mut_ptr()),
        Result::Ok
    );
    let first: Vec<_> = (300..900).map(|i| answers(&mut memory, &way(i))).collect();
    assert_eq!(
        stiction_restore(&mut *memory, snapshot.as_ptr()),
        Result::Ok
    );
    let again: Vec<_> = (300..900).map(|i| answers(&mut memory, &way(i))).collect();
    assert_eq!(first, again);
}

/// A copy of the memory is a run of its own.
#[test]
fn memory_can_be_moved() {
    let mut memory = begun();
    step(&mut memory, &way(10));
    let mut moved = memory.clone();
    assert_eq!(
        answers(&mut memory, &way(11)),
        answers(&mut moved, &way(11))
    );
}

#[test]
fn contacts_bear_what_the_hand_gives() {
    let memory = begun();
    let mut contacts = [MaybeUninit::<Contact>::uninit(); CONTACTS];
    let mut count = 0;
    let result = stiction_contacts(&*memory, contacts.as_mut_ptr().cast(), &mut count);
    assert_eq!((result, count), (Result::Ok, 2));
    // SAFETY: this many were written.
    let normal: f32 = contacts[..2]
        .iter()
        .map(|c| unsafe { c.assume_init_ref() }.normal)
        .sum();
    assert!((normal - 5.0).abs() < 1e-3, "{normal}");
}

#[test]
fn arguments_that_cannot_be_used_are_refused() {
    let mut memory = EMPTY;
    let floor = [floor()];
    let good = scene(&floor);
    let size = size_of::<Memory>();
    let place: *mut Memory = &mut memory;
    let askew: *mut Memory = place.cast::<u8>().wrapping_add(1).cast();
    let init = |place, size, abi, scene| stiction_init(place, size, abi, scene, null_mut());
    assert_eq!(init(null_mut(), size, ABI, &good), Result::Null);
    assert_eq!(init(place, size, ABI, null()), Result::Null);
    assert_eq!(init(askew, size, ABI, &good), Result::Unaligned);
    assert_eq!(init(place, size - 1, ABI, &good), Result::Size);
    assert_eq!(init(place, size, ABI ^ 1, &good), Result::Abi);
    let empty = Scene {
        vertices: null(),
        ..good
    };
    assert_eq!(init(place, size, ABI, &empty), Result::Null);
    // Nothing was done.
    let at = hand(0.0, 0.04, 0.0);
    assert_eq!(
        stiction_start(place, &at, null_mut()),
        Result::NotInitialised
    );
    assert_eq!(
        stiction_step(place, &at, null_mut()),
        Result::NotInitialised
    );
    assert_eq!(init(place, size, ABI, &good), Result::Ok);
    assert_eq!(stiction_step(place, &at, null_mut()), Result::NotStarted);
    assert_eq!(stiction_step(place, null(), null_mut()), Result::Null);
    assert_eq!(stiction_wrench(place, null_mut()), Result::Null);
    assert_eq!(
        stiction_contacts(place, null_mut(), null_mut()),
        Result::Null
    );
    assert_eq!(stiction_set_evolution(place, 2), Result::Choice);
    assert_eq!(stiction_set_budget(place, 400), Result::Ok);
    let nothing = Snapshot {
        words: [0; stiction::SNAPSHOT_WORDS],
    };
    assert_eq!(stiction_restore(place, &nothing), Result::NoSnapshot);
    assert_eq!(
        stiction_take_snapshot(place, null_mut()),
        Result::NotStarted
    );
}

/// A sample that is not finite leaves the body where it is.
#[test]
fn a_hand_that_is_not_finite_is_held() {
    let mut memory = begun();
    let before = step(&mut memory, &way(100));
    for bad in [f32::NAN, f32::INFINITY] {
        let output = step(&mut memory, &hand(bad, 0.0, 0.0));
        assert_eq!(
            (output.x, output.y, output.theta),
            (before.x, before.y, before.theta)
        );
        assert_eq!(output.status, stiction::Status::HeldLast);
    }
}

#[test]
fn what_is_wrong_with_a_scene_is_named() {
    let mut memory = EMPTY;
    let odd = [
        floor(),
        Surface {
            friction_static: 0.1,
            ..floor()
        },
    ];
    let mut error = MaybeUninit::<Error>::uninit();
    let result = stiction_init(
        &mut memory,
        size_of::<Memory>(),
        ABI,
        &scene(&odd),
        error.as_mut_ptr(),
    );
    assert_eq!(result, Result::Scene);
    // SAFETY: it was written.
    let error = unsafe { error.assume_init() };
    assert_eq!(
        (error.parameter, error.index, error.value),
        (Parameter::FrictionStatic as u8, 1, 0.1)
    );
    let mut text = [b'x'; 100];
    assert_eq!(
        stiction_error_text(result as i32, &error, text.as_mut_ptr().cast(), text.len()),
        Result::Ok
    );
    let end = text.iter().position(|&byte| byte == 0).expect("an end");
    assert_eq!(
        std::str::from_utf8(&text[..end]),
        Ok("static friction of surface 1, allowed: not less than the dynamic friction")
    );
    let mut short = [b'x'; 8];
    assert_eq!(
        stiction_error_text(-1, null(), short.as_mut_ptr().cast(), short.len()),
        Result::Ok
    );
    assert_eq!(&short, b"a point\0");
    let many = [floor(); 6];
    let result = stiction_init(
        &mut memory,
        size_of::<Memory>(),
        ABI,
        &scene(&many),
        null_mut(),
    );
    assert_eq!(result, Result::Scene);
}
