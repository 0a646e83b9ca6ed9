//! The functions of the header, called as C calls them: snapshots, and scenes that cannot be used. Other arguments and the bits of the solver
//! are tested in C.
#![allow(unsafe_code)]

use std::mem::{MaybeUninit, size_of};
use std::ptr::{null, null_mut};

use stiction::{
    ABI, Error, Hand, Memory, Output, Parameter, Result, Scene, Snapshot, Surface, WORDS, Wrench,
    stiction_error_text, stiction_init, stiction_restore, stiction_start, stiction_step,
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

/// Builds a solver by these surfaces; `error` may be null.
fn init(memory: &mut Memory, surfaces: &[Surface], error: *mut Error) -> Result {
    stiction_init(memory, size_of::<Memory>(), ABI, &scene(surfaces), error)
}

/// The outputs of a step, to the last bit.
fn answers(memory: &mut Memory, hand: &Hand) -> String {
    let mut output = MaybeUninit::<Output>::uninit();
    assert_eq!(stiction_step(memory, hand, output.as_mut_ptr()), Result::Ok);
    let mut wrench = MaybeUninit::<Wrench>::uninit();
    assert_eq!(stiction_wrench(memory, wrench.as_mut_ptr()), Result::Ok);
    // SAFETY: both were written.
    let (output, wrench) = unsafe { (output.assume_init(), wrench.assume_init()) };
    format!("{output:?} {wrench:?}")
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
    let mut memory = EMPTY;
    assert_eq!(init(&mut memory, &[floor()], null_mut()), Result::Ok);
    let start = stiction_start(&mut memory, &hand(0.0, 0.04, 0.0), null_mut());
    assert_eq!(start, Result::Ok);
    for i in 0..300 {
        answers(&mut memory, &way(i));
    }
    let mut snapshot = MaybeUninit::<Snapshot>::uninit();
    assert_eq!(
        stiction_take_snapshot(&memory, snapshot.as_mut_ptr()),
        Result::Ok
    );
    let first: Vec<_> = (300..900).map(|i| answers(&mut memory, &way(i))).collect();
    assert_eq!(stiction_restore(&mut memory, snapshot.as_ptr()), Result::Ok);
    let again: Vec<_> = (300..900).map(|i| answers(&mut memory, &way(i))).collect();
    assert_eq!(first, again);
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
    let result = init(&mut memory, &odd, error.as_mut_ptr());
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
    assert_eq!(init(&mut memory, &[floor(); 6], null_mut()), Result::Scene);
}
