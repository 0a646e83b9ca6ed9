//! Random numbers, and a line that damages bytes with them.

/// xorshift*.
pub struct Random(pub u64);

impl Random {
    /// 32 of them.
    pub fn bits(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 32
    }
}

/// Passes bytes through a line that damages one byte in `per_byte / 4`.
pub fn garbled(random: &mut Random, bytes: &[u8], per_byte: u64) -> Vec<u8> {
    let mut out = Vec::new();
    for &byte in bytes {
        match random.bits() % per_byte {
            0 => out.push(byte ^ (1 << (random.bits() % 8))),
            1 => {}
            2 => out.extend([byte, byte]),
            3 => out.extend([byte, random.bits() as u8]),
            _ => out.push(byte),
        }
    }
    out
}
