//! The same bits on every machine: a walk of the hand through the solver, and one number that depends on every bit of
//! every answer. Two machines with the same number agree in all of them.

mod place;
mod walk;

use stiction_core::{Contact, Evolution, Real, SiFloat, Touch};

pub use place::{Among, Place};
pub use walk::{Answer, Walk, follow};

/// The hash of the walk's first `frames` frames: its first half in each evolution.
pub fn of_walk<R: Real<Si: SiFloat>, M: Place>(frames: u32) -> u64 {
    let mut hash = Hash::new();
    let half = frames / 2;
    for (evolution, frames) in [(Evolution::Path, frames - half), (Evolution::Frame, half)] {
        follow::<R, M>(evolution, frames, |answer| hash.answer(answer));
    }
    hash.value
}

/// FNV-1a on 32 bits at a time.
struct Hash {
    value: u64,
}

impl Hash {
    const fn new() -> Self {
        Self {
            value: 0xCBF2_9CE4_8422_2325,
        }
    }

    fn word(&mut self, word: u32) {
        self.value = (self.value ^ u64::from(word)).wrapping_mul(0x0000_0100_0000_01B3);
    }

    fn float<F: SiFloat>(&mut self, value: F) {
        let bits = value.bits();
        self.word(bits as u32);
        self.word((bits >> 32) as u32);
    }

    fn answer<F: SiFloat>(&mut self, answer: &Answer<F>) {
        let Answer {
            output,
            wrench,
            contacts,
        } = answer;
        self.word(u32::from(output.held));
        self.word(output.state as u32);
        self.word(output.status as u32);
        self.word(output.slips);
        self.word(output.angle.turns.cast_unsigned());
        let ([x, y], [force_x, force_y]) = (output.position, wrench.force);
        for value in [x, y, output.depth, output.angle.rest, output.longest_slip] {
            self.float(value);
        }
        for value in [force_x, force_y, wrench.moment] {
            self.float(value);
        }
        for &event in output.events() {
            self.word(event as u32);
        }
        for arm in output.transitions.iter() {
            self.word(arm as u32);
        }
        for contact in contacts.iter() {
            self.contact(contact);
        }
    }

    fn contact<F: SiFloat>(&mut self, contact: &Contact<F>) {
        let words = match contact.touch {
            Touch::Surface { vertex, surface } => [0, vertex, surface, 0],
            Touch::Side {
                vertex,
                obstacle,
                side,
            } => [1, vertex, obstacle, side],
            Touch::Corner {
                obstacle,
                corner,
                body_side,
            } => [2, body_side, obstacle, corner],
        };
        for word in words {
            self.word(word as u32);
        }
        let ([n_x, n_y], [x, y]) = (contact.direction, contact.point);
        for value in [n_x, n_y, x, y, contact.normal, contact.friction] {
            self.float(value);
        }
    }
}
