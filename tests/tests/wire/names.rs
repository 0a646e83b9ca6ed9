//! The names of states, events and messages in traces and logs: those of the variants, with hyphens.

use std::fmt::Debug;

use stiction_core::{Event, Evolution, StateKind, Status};
use stiction_wire::{
    Drive, FaultKind, Frame, KnobNumber, KnobSource, NumberType, Reason, Reset, Stepping,
};

use crate::Either;
use crate::random::{Random, Store};

/// `TooLong` is `too-long`; the fields of a variant are not part of its name.
fn hyphenated(variant: &impl Debug) -> String {
    let shown = format!("{variant:?}");
    let letters = shown.chars().take_while(char::is_ascii_alphanumeric);
    let mut name = String::new();
    for letter in letters {
        if letter.is_ascii_uppercase() && !name.is_empty() {
            name.push('-');
        }
        name.push(letter.to_ascii_lowercase());
    }
    name
}

macro_rules! named {
    ($($kind:ident),*) => {$(
        for variant in $kind::ALL {
            assert_eq!(variant.name(), hyphenated(&variant));
        }
    )*};
}

#[test]
fn names_are_those_of_the_variants() {
    named!(
        StateKind, Event, Status, Evolution, Reason, Drive, Reset, Stepping, NumberType, FaultKind,
        KnobNumber, KnobSource
    );
}

#[test]
fn messages_are_named_by_what_they_are() {
    let mut random = Random(4);
    for _ in 0..400 {
        let store = Store::fill(&mut random, 3);
        let (name, named) = match store.frame(&mut random) {
            Either::Command(Frame { message, .. }) => (message.name(), hyphenated(&message)),
            Either::Report(Frame { message, .. }) => (message.name(), hyphenated(&message)),
        };
        assert_eq!(name, named);
    }
}
