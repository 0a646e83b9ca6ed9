//! By what a computer knows a board of stiction on its USB: what boards say of themselves and computers look for.

/// Raspberry Pi.
pub const VENDOR: u16 = 0x2E8A;
/// Of this vendor, for serial lines of an RP2040: others use it for their programs, too.
pub const PICO: u16 = 0x000A;
/// Of this vendor, for serial lines of an RP2350, likewise.
pub const PICO_2: u16 = 0x0009;
/// By this name boards of stiction are told from others with these numbers.
pub const MANUFACTURER: &str = "stiction";

/// Whether what says this of itself is a board of stiction.
pub fn is_board(vendor: u16, product: u16, manufacturer: &str) -> bool {
    vendor == VENDOR && matches!(product, PICO | PICO_2) && manufacturer == MANUFACTURER
}
