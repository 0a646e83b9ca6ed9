//! What programs that measure have in common: sections of a README ([`readme`]), the name of the machine ([`machine`]).

pub mod machine;
pub mod readme;
