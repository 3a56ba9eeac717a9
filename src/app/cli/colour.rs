//! Colours of verdicts on a terminal.

use std::io::IsTerminal;

/// Meaning of a verdict for the user.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Tone {
    /// The result is good.
    Good,
    /// The result needs attention.
    Doubtful,
    /// The result is bad.
    Bad,
}

/// Whether verdicts are coloured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Paint {
    is_on: bool,
}

impl Paint {
    /// Colours on standard output if it is a terminal that supports them, unless the variable NO_COLOR is set
    /// (<https://no-color.org>).
    pub fn of_stdout() -> Self {
        let variable = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
        let is_dumb = variable("TERM").is_some_and(|term| term == "dumb");
        Paint {
            is_on: std::io::stdout().is_terminal() && variable("NO_COLOR").is_none() && !is_dumb,
        }
    }

    /// The text with its verdicts coloured.
    pub fn text(self, text: &str) -> String {
        if !self.is_on {
            return text.to_owned();
        }
        text.split_inclusive('\n').map(painted).collect()
    }
}

/// The line with its verdict bold and coloured.
fn painted(line: &str) -> String {
    let Some(verdict) = verdict(line) else {
        return line.to_owned();
    };
    let colour = match verdict.tone {
        Tone::Good => 32,
        Tone::Doubtful => 33,
        Tone::Bad => 31,
    };
    let (before, rest) = line.split_at(verdict.from);
    let (words, after) = rest.split_at(verdict.length);
    format!("{before}\u{1b}[1;{colour}m{words}\u{1b}[0m{after}")
}

/// Words of a line that state whether a result is good.
struct Verdict {
    from: usize,
    length: usize,
    tone: Tone,
}

fn verdict(line: &str) -> Option<Verdict> {
    let firsts = [
        ("Warning:", Tone::Doubtful),
        ("Unusual number", Tone::Doubtful),
        ("FAIL", Tone::Bad),
        ("RISK", Tone::Doubtful),
        ("PASS", Tone::Good),
    ];
    let first = firsts.iter().find(|(word, _)| line.starts_with(word));
    if let Some((word, tone)) = first {
        return Some(Verdict {
            from: 0,
            length: word.len(),
            tone: *tone,
        });
    }
    let from = line.find("? ").filter(|_| line.starts_with("Can it "))? + 2;
    let tone = match line.get(from..from + 2) {
        Some("YE") => Tone::Good,
        Some("NO") => Tone::Bad,
        _ => Tone::Doubtful,
    };
    let end = line[from..]
        .find(':')
        .map_or(line.trim_end().len(), |colon| from + colon);
    let length = end - from;
    Some(Verdict { from, length, tone })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_plain_unless_colour_is_on() {
        let text = "Can it run at 1800 rpm? NO: flutter grows\nmore\n";
        assert_eq!(Paint { is_on: false }.text(text), text);
        assert_eq!(
            Paint { is_on: true }.text(text),
            "Can it run at 1800 rpm? \u{1b}[1;31mNO\u{1b}[0m: flutter grows\nmore\n"
        );
    }

    /// Tests usually run without a terminal; on one this test compares nothing.
    #[test]
    fn what_is_no_terminal_is_not_coloured() {
        if !std::io::stdout().is_terminal() {
            assert_eq!(Paint::of_stdout(), Paint { is_on: false });
        }
    }
}
