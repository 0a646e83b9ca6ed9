//! Quadrature encoders, counted by state machines of the PIO: 10 million changes per second, without the processor.
#![allow(unsafe_code)]

use pio::{
    Instruction, InstructionOperands, MovDestination, MovOperation, MovSource, Program,
    RP2040_MAX_PROGRAM_SIZE, SetDestination, pio_asm,
};

use super::hal::gpio::{FunctionPio0, PinId, PullUp, ValidFunction};
use super::hal::pac::PIO0;
use super::hal::pio::{
    InstalledProgram, PIO, PIOBuilder, Running, Rx, ShiftDirection, StateMachine,
    StateMachineIndex, UninitStateMachine,
};
use super::pins::Free;
use crate::{Tracks, stop};

/// Words that the queue of a state machine holds.
const QUEUE: usize = 4;
/// A state machine puts its count into its queue once in 13 cycles at most, in which a loop runs twice at most.
const TURNS: usize = 4;

/// Counts in Y. The first 16 instructions are a jump table, one for each pair of states of both tracks, the previous and the present one: a
/// track that changes alone is a step up or down; both together are a step that was too fast to be seen.
fn counting() -> Program<RP2040_MAX_PROGRAM_SIZE> {
    pio_asm!(
        ".origin 0",
        "    jmp tell", // 00 00
        "    jmp down", // 00 01
        "    jmp up",   // 00 10
        "    jmp tell", // 00 11
        "    jmp up",   // 01 00
        "    jmp tell", // 01 01
        "    jmp tell", // 01 10
        "    jmp down", // 01 11
        "    jmp down", // 10 00
        "    jmp tell", // 10 01
        "    jmp tell", // 10 10
        "    jmp up",   // 10 11
        "    jmp tell", // 11 00
        "    jmp up",   // 11 01
        "    jmp down", // 11 10
        "    jmp tell", // 11 11
        "down:",
        "    jmp y-- tell",
        "tell:",
        ".wrap_target",
        "    mov isr, y",
        "    push noblock",
        // The previous state is in OSR, the present one comes from the pins: together they are the jump address.
        "    out isr, 2",
        "    in pins, 2",
        "    mov osr, isr",
        "    mov pc, isr",
        // There is no y++.
        "up:",
        "    mov y, ~y",
        "    jmp y-- upped",
        "upped:",
        "    mov y, ~y",
        ".wrap",
    )
    .program
}

/// Sets Y to the middle of all numbers, whose lower half is 0, so that neither direction passes the end of the range: 1, with its bits
/// reversed.
const MIDDLE: [InstructionOperands; 2] = [
    InstructionOperands::SET {
        destination: SetDestination::Y,
        data: 1,
    },
    InstructionOperands::MOV {
        destination: MovDestination::Y,
        op: MovOperation::BitReverse,
        source: MovSource::Y,
    },
];

pub(super) fn install(pio: &mut PIO<PIO0>) -> InstalledProgram<PIO0> {
    // The PIO contains nothing else.
    match pio.install(&counting()) {
        Ok(program) => program,
        Err(_) => stop(),
    }
}

/// An encoder at two pins, counted by one state machine.
pub struct Encoder<M: StateMachineIndex> {
    counts: Rx<(PIO0, M)>,
    _machine: StateMachine<(PIO0, M), Running>,
}

impl<M: StateMachineIndex> Encoder<M> {
    /// Counts from 0. Track B is the pin after that of track A; a track that is not connected does not change.
    pub(super) fn start<A, B>(
        program: &InstalledProgram<PIO0>,
        machine: UninitStateMachine<(PIO0, M)>,
        Tracks { a, b }: Tracks<Free<A>, Free<B>>,
    ) -> Self
    where
        A: PinId + ValidFunction<FunctionPio0>,
        B: PinId + ValidFunction<FunctionPio0>,
    {
        let first = a.id().num;
        a.reconfigure::<FunctionPio0, PullUp>();
        b.reconfigure::<FunctionPio0, PullUp>();
        // SAFETY: the program stays in the PIO for ever.
        let program = unsafe { program.share() };
        let (mut machine, counts, _) = PIOBuilder::from_installed_program(program)
            .in_pin_base(first)
            .in_shift_direction(ShiftDirection::Left)
            .out_shift_direction(ShiftDirection::Right)
            .build(machine);
        for operands in MIDDLE {
            machine.exec_instruction(Instruction {
                operands,
                delay: 0,
                side_set: None,
            });
        }
        Self {
            counts,
            _machine: machine.start(),
        }
    }

    /// The lower half of the present count; `None` if the state machine does not respond.
    pub(super) fn count(&mut self) -> Option<u16> {
        // The contents of the queue are old: a full queue takes nothing new.
        for _ in 0..QUEUE {
            self.counts.read();
        }
        let count = (0..TURNS).find_map(|_| self.counts.read())?;
        Some(count as u16)
    }
}
