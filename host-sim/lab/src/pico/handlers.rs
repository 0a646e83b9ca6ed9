//! How long interrupt handlers take, including all that interrupts them.

/// Exception number of the first interrupt.
pub(crate) const FIRST_INTERRUPT: u32 = 16;

/// The handlers, by exception number.
#[derive(Debug)]
pub(crate) struct Handlers {
    /// The start time of each active handler (cycles).
    begun: [u64; u64::BITS as usize],
    /// The longest time of each (cycles).
    longest: [u64; u64::BITS as usize],
}

impl Handlers {
    pub(crate) const fn new() -> Self {
        Self {
            begun: [0; u64::BITS as usize],
            longest: [0; u64::BITS as usize],
        }
    }

    /// Records the active exceptions before and after an instruction, bit by bit; the instruction began at `now` and
    /// took `cycles`.
    pub(crate) fn pass(&mut self, [before, after]: [u64; 2], now: u64, cycles: u64) {
        let changed = (0..u64::BITS).filter(|exception| (before ^ after) >> exception & 1 != 0);
        for exception in changed {
            let at = exception as usize;
            if after >> exception & 1 != 0 {
                self.begun[at] = now;
            } else {
                let took = now + cycles - self.begun[at];
                self.longest[at] = self.longest[at].max(took);
            }
        }
    }

    /// The longest time that the handler of an interrupt took (cycles).
    pub(crate) const fn longest(&self, interrupt: u32) -> u64 {
        self.longest[(FIRST_INTERRUPT + interrupt) as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_handler_takes_from_its_entry_to_its_return_with_what_interrupts_it() {
        let mut handlers = Handlers::new();
        let [slow, fast] = [25, 0].map(|interrupt| 1u64 << (FIRST_INTERRUPT + interrupt));
        handlers.pass([0, slow], 100, 15);
        handlers.pass([slow, slow | fast], 200, 15);
        handlers.pass([slow | fast, slow], 300, 13);
        handlers.pass([slow, 0], 400, 13);
        assert_eq!([25, 0, 1].map(|i| handlers.longest(i)), [313, 113, 0]);
        handlers.pass([0, fast], 500, 15);
        handlers.pass([fast, 0], 540, 13);
        assert_eq!(handlers.longest(0), 113);
    }
}
