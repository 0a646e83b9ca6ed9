//! Text in columns.

/// Lines whose cells are padded with spaces to the width of their column. The first `words` columns are left-aligned,
/// the others, which are numbers, right-aligned.
///
/// # Panics
/// A line has more cells than the first one.
pub fn aligned(lines: &[Vec<String>], words: usize) -> Vec<Vec<String>> {
    let mut widths = vec![0; lines.first().map_or(0, Vec::len)];
    for line in lines {
        for (width, cell) in widths.iter_mut().zip(line) {
            *width = cell.chars().count().max(*width);
        }
    }
    let padded = |(k, cell): (usize, &String)| {
        let width = widths[k];
        match k < words {
            true => format!("{cell:<width$}"),
            false => format!("{cell:>width$}"),
        }
    };
    let line = |line: &Vec<String>| line.iter().enumerate().map(padded).collect();
    lines.iter().map(line).collect()
}

/// The number with its digits in groups of three.
pub fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let parts: Vec<&str> = digits
        .as_bytes()
        .rchunks(3)
        .rev()
        .filter_map(|part| std::str::from_utf8(part).ok())
        .collect();
    parts.join(" ")
}

#[cfg(test)]
mod tests {
    use super::{aligned, thousands};

    #[test]
    fn digits_stand_in_threes() {
        assert_eq!(
            [0, 12, 123, 1_234_567].map(thousands),
            ["0", "12", "123", "1 234 567"]
        );
    }

    #[test]
    fn words_begin_together_and_figures_end_together() {
        let lines = [
            ["scene", "error (µm)"],
            ["flat", "1.5"],
            ["stick-slip", "120"],
        ];
        let lines = lines.map(|line| line.map(str::to_owned).to_vec());
        let expected = [
            ["scene     ", "error (µm)"],
            ["flat      ", "       1.5"],
            ["stick-slip", "       120"],
        ];
        assert_eq!(aligned(&lines, 1), expected);
    }
}
