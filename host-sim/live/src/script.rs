//! Scripts of the page as they are sent to a browser: without comments, which are a third of them, and empty lines.

/// A script without its comment lines and empty lines. It relies on the style of the page: a comment begins a line, or is a cast before
/// code, and no text has empty lines.
pub fn without_comments(script: &str) -> String {
    let (mut code, mut inside) = (String::new(), false);
    for line in script.lines() {
        let text = line.trim();
        let is_comment = inside || text.starts_with("//") || text.starts_with("/**");
        inside = (inside || text.starts_with("/**")) && !text.contains("*/");
        // A comment that ends before code, such as a cast, is part of a line.
        let is_whole = text.ends_with("*/") || inside || text.starts_with("//");
        if !(is_comment && is_whole || text.is_empty()) {
            code.push_str(line);
            code.push('\n');
        }
    }
    code
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_stays_and_comments_go() {
        let script = "// What it does.\n\n/** A sum. @param {number} a */\nfunction f(a) {\n  /**\n   * More\n   * of it.\n   */\n  const b = /** @type {any} */ (a); // kept\n  /** @type {any} */ (b).c = \"//\";\n}\n";
        let code = "function f(a) {\n  const b = /** @type {any} */ (a); // kept\n  /** @type {any} */ (b).c = \"//\";\n}\n";
        assert_eq!(without_comments(script), code);
    }
}
