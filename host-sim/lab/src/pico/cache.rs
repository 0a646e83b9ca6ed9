//! A model of the cache through which the chip reads its flash (RP2040 datasheet, 2.6.3): 16 KB, two ways, lines of 8 bytes. The line
//! of a set that was not used for longer makes room; whether the chip does the same is not documented.

/// Bytes of a line, as a power of two.
const LINE: u32 = 3;
const WAYS: usize = 2;
const SETS: usize = ((16 * 1024) >> LINE) / WAYS;

/// Cycles of the chip for which a line is awaited, at the least: 8 clocks for the address, 4 until the flash answers and 16 for the line
/// over four wires (W25Q080 datasheet, fast read quad I/O, continuous), each of two cycles, as the boot loader for this flash sets them.
pub(crate) const MISS: u64 = 2 * (8 + 4 + 16);

#[derive(Debug)]
pub(crate) struct Cache {
    /// The lines of each set by their numbers, the one used last first.
    sets: Vec<[u32; WAYS]>,
    misses: u64,
}

impl Default for Cache {
    fn default() -> Self {
        Self {
            sets: vec![[u32::MAX; WAYS]; SETS],
            misses: 0,
        }
    }
}

impl Cache {
    /// A read of an address, if it is one of the flash.
    #[inline]
    pub(crate) fn read(&mut self, at: u32) {
        if at >> 28 != 1 {
            return;
        }
        let line = at >> LINE;
        let [first, second] = &mut self.sets[line as usize % SETS];
        if *first != line {
            self.misses += u64::from(*second != line);
            (*first, *second) = (line, *first);
        }
    }

    /// Lines that were awaited.
    pub(crate) const fn misses(&self) -> u64 {
        self.misses
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The flash begins here.
    const FLASH: u32 = 0x1000_0000;

    fn misses(reads: impl IntoIterator<Item = u32>) -> u64 {
        let mut cache = Cache::default();
        reads.into_iter().for_each(|at| cache.read(FLASH + at));
        cache.misses()
    }

    #[test]
    fn a_line_is_awaited_once() {
        assert_eq!(misses(0..8), 1);
        assert_eq!(misses([0, 8, 7, 15]), 2);
        assert_eq!(misses([0x1000_0000, 0x2000_0000]), 0, "no flash");
    }

    #[test]
    fn what_fits_is_read_once_and_what_does_not_again_and_again() {
        let twice = |bytes: u32| misses((0..bytes).chain(0..bytes));
        assert_eq!(twice(16 * 1024), 2 * 1024);
        assert_eq!(twice(24 * 1024), 2 * 3 * 1024);
    }

    #[test]
    fn of_three_lines_of_a_set_the_oldest_makes_room() {
        let [a, b, c] = [0, 8 * 1024, 16 * 1024];
        assert_eq!(misses([a, b, a, b]), 2);
        assert_eq!(misses([a, b, a, c, a, b]), 4);
    }
}
