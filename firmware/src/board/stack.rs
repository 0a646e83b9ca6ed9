//! How deep the stack grows: the free memory below the caller is painted, and later the deepest overwritten word is
//! found.
#![allow(unsafe_code)]

use core::arch::asm;
use core::ptr;

/// A value that no stack contains by chance.
const PAINT: u32 = 0x5AC0_DE5A;
/// At most this much is painted (bytes).
const LIMIT: usize = 0x1_0000;
/// Left unpainted directly below the caller, for the painter's own needs (bytes). A step needs more.
const MARGIN: usize = 128;

unsafe extern "C" {
    /// The end of the static variables; the stack grows down towards it.
    static mut __sheap: u32;
}

pub(super) struct Watch {
    top: usize,
    bottom: usize,
}

impl Watch {
    /// Paints the free memory below the caller.
    #[inline(always)]
    pub(super) fn begin() -> Self {
        let top = pointer();
        let end = (&raw const __sheap).addr();
        let bottom = end.max(top.saturating_sub(LIMIT)).next_multiple_of(4);
        let watch = Self { top, bottom };
        watch.paint();
        watch
    }

    #[inline(never)]
    fn paint(&self) {
        for word in (self.bottom..self.top.saturating_sub(MARGIN)).step_by(4) {
            // SAFETY: between the static variables and the stack pointer lies free RAM.
            unsafe { ptr::with_exposed_provenance_mut::<u32>(word).write_volatile(PAINT) };
        }
    }

    /// How far below its top the stack has been (bytes).
    pub(super) fn depth(&self) -> u32 {
        // SAFETY: the words are RAM, aligned, and read with their own type.
        let read = |word| unsafe { ptr::with_exposed_provenance::<u32>(word).read_volatile() };
        let mut words = (self.bottom..self.top).step_by(4);
        let deepest = words.find(|&word| read(word) != PAINT).unwrap_or(self.top);
        u32::try_from(self.top - deepest).unwrap_or(u32::MAX)
    }
}

#[inline(always)]
fn pointer() -> usize {
    let pointer;
    #[cfg(target_arch = "arm")]
    // SAFETY: reads a register.
    unsafe {
        asm!("mov {}, sp", out(reg) pointer, options(nomem, nostack, preserves_flags));
    }
    #[cfg(target_arch = "riscv32")]
    // SAFETY: reads a register.
    unsafe {
        asm!("mv {}, sp", out(reg) pointer, options(nomem, nostack, preserves_flags));
    }
    pointer
}
