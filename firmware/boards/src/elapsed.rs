//! Time from a counter of 32 bits, which wraps.

/// The time that has passed by the counts of a counter, in two units that are read independently of each other.
#[derive(Debug)]
pub struct Elapsed {
    /// The count at the last call of [`Self::us`].
    last: u32,
    /// Counts that do not make up a µs yet.
    rest: u32,
    now_us: u32,
    /// The count at the last call of [`Self::ns`].
    looked: u32,
    now_ns: u32,
}

impl Elapsed {
    /// From this count on.
    pub const fn since(count: u32) -> Self {
        Self {
            last: count,
            rest: 0,
            now_us: 0,
            looked: count,
            now_ns: 0,
        }
    }

    /// The time at this count (µs, wrapping), if a µs has `per_us` counts. It must be called before the counter wraps.
    #[inline]
    pub fn us(&mut self, count: u32, per_us: u32) -> u32 {
        let counts = count.wrapping_sub(self.last).saturating_add(self.rest);
        self.last = count;
        // Never 0.
        let per_us = per_us.max(1);
        self.rest = counts % per_us;
        self.now_us = self.now_us.wrapping_add(counts / per_us);
        self.now_us
    }

    /// The time at this count (ns, wrapping), for durations of up to 50 ms.
    #[inline]
    pub fn ns(&mut self, count: u32, per_us: u32) -> u32 {
        let passed = count.wrapping_sub(self.looked).saturating_mul(1_000);
        self.looked = count;
        self.now_ns = self.now_ns.wrapping_add(passed / per_us.max(1));
        self.now_ns
    }
}
