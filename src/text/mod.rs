//! Text as people have it: files of any editor or spreadsheet as Unicode, JSON with comments, and
//! words that may be shown on a terminal.
//!
//! In go the bytes of a file; out comes text, or an error that names the line and column.

mod fault;
mod file;
mod json;
mod number;
mod problem;
mod token;

pub(crate) use fault::KeyedError;
#[cfg(feature = "cli")]
pub(crate) use file::read_stream;
pub use file::{FileError, Kind, OtherEncodings, read_path};
pub(crate) use json::from_keyed_json;
pub(crate) use number::{shown, shown_to};

/// Characters that steer a terminal, or turn the direction of what follows, as their escapes.
/// Line breaks stay.
pub fn printable(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for character in text.chars() {
        let steers = character.is_control() && character != '\n';
        let turns = matches!(character, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        match steers || turns {
            // An escape of JSON too: what is printed as JSON stays the same text.
            true => shown.push_str(&format!("\\u{:04x}", u32::from(character))),
            false => shown.push(character),
        }
    }
    shown
}

/// The same on one line.
pub fn printable_line(text: &str) -> String {
    printable(text).replace('\n', "\\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_steers_a_terminal_is_shown_as_its_escape() {
        assert_eq!(printable("Säge Ω\n"), "Säge Ω\n");
        assert_eq!(printable("a\u{1b}[2J\u{7}b"), "a\\u001b[2J\\u0007b");
        assert_eq!(
            printable("\u{9b}31m\u{7f}\u{202e}"),
            "\\u009b31m\\u007f\\u202e"
        );
        assert_eq!(printable_line("one\r\ntwo"), "one\\u000d\\ntwo");
    }
}
