//! Numbers and names for people.

use std::path::Path;

/// A path on one line: control characters are written as escapes.
pub fn path_name(path: &Path) -> String {
    if path.as_os_str() == "-" {
        return "standard input".to_owned();
    }
    one_line(&path.display().to_string())
}

/// A text on one line: control characters are written as escapes.
pub fn one_line(text: &str) -> String {
    let escape = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.into() };
    text.chars().map(escape).collect()
}

/// A count with its thousands apart: `11,478`.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::with_capacity(digits.len() * 4 / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A count and its noun: `1 face`, `11,478 faces`.
pub fn counted(n: u64, noun: &str) -> String {
    let ending = if n == 1 { "" } else { "s" };
    format!("{} {noun}{ending}", grouped(n))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_set_apart() {
        for (n, text) in [(0, "0"), (999, "999"), (1000, "1,000"), (1_234_567, "1,234,567")] {
            assert_eq!(grouped(n), text);
        }
        assert_eq!(counted(1, "face"), "1 face");
        assert_eq!(counted(1000, "face"), "1,000 faces");
    }

    #[test]
    fn names_stay_on_one_line() {
        assert_eq!(path_name(Path::new("a\nb\x1b[31m é.obj")), "a\\nb\\u{1b}[31m é.obj");
    }
}
