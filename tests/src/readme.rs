//! The parts of the README that a command writes: from a text to its place between two marks.

use std::io;

const README: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../README.md");

/// Puts `text` between `<!-- part: begin -->` and `<!-- part: end -->`.
///
/// # Errors
/// The README cannot be read or written, or has no such marks.
pub fn write(part: &str, text: &str) -> io::Result<()> {
    let (begin, end) = (
        format!("<!-- {part}: begin -->"),
        format!("<!-- {part}: end -->"),
    );
    let readme = std::fs::read_to_string(README)?;
    let (Some(from), Some(to)) = (readme.find(&begin), readme.find(&end)) else {
        return Err(io::Error::other(format!(
            "README.md has no place for: {part}"
        )));
    };
    let (head, tail) = (&readme[..from + begin.len()], &readme[to..]);
    std::fs::write(README, format!("{head}\n{text}{tail}"))
}

/// The name of the processor, as the system gives it.
pub fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info
        .lines()
        .find_map(|line| line.strip_prefix("model name"));
    name.map_or_else(
        || std::env::consts::ARCH.to_string(),
        |name| name.trim_start_matches([' ', '\t', ':']).to_string(),
    )
}
