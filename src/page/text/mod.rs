//! Input and output of text: files of any editor or spreadsheet, JSON with comments, numbers in messages, and
//! text that is safe to show on a terminal.

mod fault;
mod file;
mod json;
mod missing;
mod number;
mod problem;
mod token;

pub(crate) use fault::KeyedError;
#[cfg(any(feature = "cli", feature = "page"))]
pub(crate) use file::read_stream;
pub use file::{FileError, Kind, OtherEncodings, read_path};
pub(crate) use json::from_keyed_json;
pub use number::shown_to;
pub(crate) use number::{
    MOST_DIGITS, capitalized, counted, fixed, rounded_between, rounded_down, shown, time_in_words,
};

/// Replaces characters that control a terminal or change the direction of text by their escapes. Line breaks
/// are kept.
pub fn printable(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for character in text.chars() {
        let controls = character.is_control() && character != '\n';
        let turns = matches!(character, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        if controls || turns {
            // JSON has the same escape, so that printed JSON keeps its meaning.
            shown.push_str(&format!("\\u{:04x}", u32::from(character)))
        } else {
            shown.push(character)
        }
    }
    shown
}

/// Makes a text [`printable`], with its line breaks as `\n`, on one line.
pub fn printable_line(text: &str) -> String {
    printable(text).replace('\n', "\\n")
}

/// Makes a text [`printable`] within an element or a quoted attribute of HTML and XML.
pub(crate) fn escaped(text: &str) -> String {
    let text = printable(text).replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_that_control_a_terminal_are_shown_as_escapes() {
        assert_eq!(printable("Säge Ω\n"), "Säge Ω\n");
        assert_eq!(printable("a\u{1b}[2J\u{7}b"), "a\\u001b[2J\\u0007b");
        assert_eq!(
            printable("\u{9b}31m\u{7f}\u{202e}"),
            "\\u009b31m\\u007f\\u202e"
        );
        assert_eq!(printable_line("one\r\ntwo"), "one\\u000d\\ntwo");
    }
}
