//! Tokens of JSON, with which comments are removed and causes of syntax errors are found.

/// Kind of a token.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// One of the characters `{}[]:,`.
    Mark,
    /// Text in double quotation marks.
    Quoted,
    /// Other text without white space: a number, `true`, or text without quotation marks.
    Word,
    /// `// …` or `/* … */`.
    Comment,
}

/// A token and its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Token<'a> {
    /// Kind of the token.
    pub part: Part,
    /// Characters of the token, with its quotation marks.
    pub text: &'a str,
    /// Offset of the first character in the whole text, in bytes.
    pub start: usize,
}

impl Token<'_> {
    /// Offset after the last character in the whole text, in bytes.
    pub fn end(&self) -> usize {
        self.start + self.text.len()
    }
}

/// Divides a text, which need not be JSON, into tokens.
pub fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut found = Vec::new();
    let mut start = 0;
    while let Some(first) = text[start..].chars().next() {
        let rest = &text[start..];
        if first.is_whitespace() {
            start += first.len_utf8();
            continue;
        }
        let (part, length) = match first {
            '{' | '}' | '[' | ']' | ':' | ',' => (Part::Mark, 1),
            '"' => (Part::Quoted, quoted(rest)),
            _ => match comment(rest) {
                Some(length) => (Part::Comment, length),
                None => (Part::Word, word(rest)),
            },
        };
        found.push(Token {
            part,
            text: &rest[..length],
            start,
        });
        start += length;
    }
    found
}

/// Length in bytes of the quoted text at the beginning; without a closing quotation mark it ends with the line.
fn quoted(rest: &str) -> usize {
    let mut escaped = false;
    for (offset, character) in rest.char_indices().skip(1) {
        match character {
            '"' if !escaped => return offset + 1,
            '\n' => return offset,
            _ => escaped = character == '\\' && !escaped,
        }
    }
    rest.len()
}

/// Length in bytes of the comment at the beginning; `None` if no comment begins there, or it is not closed.
fn comment(rest: &str) -> Option<usize> {
    if rest.starts_with("//") {
        return Some(rest.find('\n').unwrap_or(rest.len()));
    }
    let inside = rest.strip_prefix("/*")?;
    inside.find("*/").map(|length| length + 4)
}

/// Length in bytes of the word at the beginning.
fn word(rest: &str) -> usize {
    let ends = |(offset, character): &(usize, char)| {
        let mark = matches!(character, '{' | '}' | '[' | ']' | ':' | ',' | '"');
        mark || character.is_whitespace() || (*offset > 0 && comment(&rest[*offset..]).is_some())
    };
    let end = rest.char_indices().skip(1).find(ends);
    end.map_or(rest.len(), |(offset, _)| offset)
}

/// Replaces comments, and commas before a closing bracket, by as many spaces as they have bytes. All other
/// characters keep their positions.
pub fn without_comments(text: &str) -> String {
    let all = tokens(text).into_iter();
    let (mut blanks, others): (Vec<_>, Vec<_>) = all.partition(|t| t.part == Part::Comment);
    let before_closing = |pair: &&[Token]| pair[0].text == "," && matches!(pair[1].text, "}" | "]");
    blanks.extend(others.windows(2).filter(before_closing).map(|pair| pair[0]));
    let mut tidy = text.to_owned();
    for token in blanks {
        let blank = |c: char| if c == '\n' { '\n' } else { ' ' };
        let spaces = token.text.bytes().map(|byte| blank(char::from(byte)));
        tidy.replace_range(token.start..token.end(), &spaces.collect::<String>());
    }
    tidy
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_comments_and_last_commas_are_replaced_by_spaces() {
        let text = "{ // Säge\n\"a\": \"// no, [comment,]\", /* two\nlines */ \"b\": [1, 2,],\n}";
        let tidy = without_comments(text);
        assert_eq!(tidy.len(), text.len());
        let read: serde_json::Value = serde_json::from_str(&tidy).unwrap();
        assert_eq!(
            read,
            serde_json::json!({"a": "// no, [comment,]", "b": [1, 2]})
        );
        assert_eq!(tidy.matches('\n').count(), text.matches('\n').count());
        let plain = "{\"a\\\"\": [1e-3, null], \"b\": \"\\\\\"}";
        assert_eq!(without_comments(plain), plain);
    }

    #[test]
    fn text_that_is_not_json_is_divided_into_tokens() {
        for text in ["\"open", "/* open", "{,,}]", "ä/b//c", "\\\"\\", "/"] {
            for token in tokens(text) {
                assert_eq!(&text[token.start..token.end()], token.text);
            }
        }
    }
}
