//! How a computer recognises a stiction board on its USB: what boards report about themselves and computers look for.

/// Raspberry Pi.
pub const VENDOR: u16 = 0x2E8A;
/// Product number of this vendor, for serial lines of an RP2040: others use it for their programs, too.
pub const PICO: u16 = 0x000A;
/// Product number of this vendor, for serial lines of an RP2350, likewise.
pub const PICO_2: u16 = 0x0009;
/// This name distinguishes stiction boards from others with these numbers.
pub const MANUFACTURER: &str = "stiction";

/// Returns whether a device with this description is a stiction board.
pub fn is_board(vendor: u16, product: u16, manufacturer: &str) -> bool {
    vendor == VENDOR && matches!(product, PICO | PICO_2) && manufacturer == MANUFACTURER
}
