//! Cells of the tables of spreadsheets and instruments: comments, separators, decimal marks, lines above the numbers.

use super::FitError;

/// Marks at the beginning of a comment. A semicolon is one, too, unless it separates the cells.
const COMMENTS: [char; 3] = ['#', '%', '*'];

/// The error of a line, numbered from 1.
pub(super) fn wrong(line: u64, problem: String) -> FitError {
    FitError::Table { line, problem }
}

/// A table: lines of text above the numbers, and rows of numbers.
pub(super) struct Cells {
    pub(super) above: Vec<Record>,
    /// The comment directly above the numbers.
    pub(super) comment: Option<String>,
    pub(super) rows: Vec<Record>,
    pub(super) separator: Separator,
}

impl Cells {
    /// Divides a text before its first line of numbers. Blank lines and comments are left out.
    ///
    /// # Errors
    /// [`FitError::Table`] for a line that cannot be divided into cells.
    pub(super) fn of(
        text: &str,
        separator: Separator,
        is_numbers: impl Fn(&Record) -> bool,
    ) -> Result<Self, FitError> {
        let mut above = separator.records(text)?;
        let count = above
            .iter()
            .take_while(|record| !is_numbers(record))
            .count();
        let rows = above.split_off(count);
        let first = rows.first().map_or(u64::MAX, |row| row.line) as usize;
        let leading = text.lines().take(first - 1);
        let last = leading.filter(|line| !line.trim().is_empty()).last();
        let comment = last.filter(|line| separator.is_comment(line));
        let marks = |c: char| COMMENTS.contains(&c) || c == ';' || c.is_whitespace();
        Ok(Cells {
            above,
            comment: comment.map(|line| line.trim_start_matches(marks).to_owned()),
            rows,
            separator,
        })
    }
}

/// Separator between cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Separator {
    Mark(u8),
    Blanks,
}

pub(super) struct Record {
    pub(super) line: u64,
    pub(super) cells: Vec<String>,
}

impl Record {
    fn new<'a>(line: u64, cells: impl Iterator<Item = &'a str>) -> Self {
        let mut cells: Vec<String> = cells.map(|cell| cell.trim().to_owned()).collect();
        while cells.last().is_some_and(String::is_empty) {
            cells.pop();
        }
        Record { line, cells }
    }
}

fn is_marked(line: &str) -> bool {
    line.trim_start().starts_with(COMMENTS)
}

impl Separator {
    /// The first of semicolon, tab and comma that occurs outside quotation marks; blanks if none does. In a table with
    /// semicolons or tabs a comma may be decimal, but not the other way round.
    pub(super) fn of(text: &str) -> Self {
        let is_table = |line: &&str| !is_marked(line) && !line.trim().is_empty();
        // Lines that begin with a semicolon are comments, unless the first cell of all is blank.
        let is_blank_first = |line: &str| line.starts_with(';');
        let every = text.lines().filter(is_table).all(is_blank_first);
        let mut quoted = false;
        let mut seen = [false; 3];
        for line in text
            .lines()
            .filter(is_table)
            .filter(|line| every || !is_blank_first(line))
        {
            for character in line.chars() {
                match character {
                    '"' => quoted = !quoted,
                    ';' if !quoted => seen[0] = true,
                    '\t' if !quoted => seen[1] = true,
                    ',' if !quoted => seen[2] = true,
                    _ => (),
                }
            }
        }
        let marks = [b';', b'\t', b','];
        let found = marks.into_iter().zip(seen).find(|(_, seen)| *seen);
        found.map_or(Separator::Blanks, |(mark, _)| Separator::Mark(mark))
    }

    fn is_comment(self, line: &str) -> bool {
        let is_semicolon = self != Separator::Mark(b';') && line.starts_with(';');
        is_marked(line) || is_semicolon
    }

    pub(super) fn records(self, text: &str) -> Result<Vec<Record>, FitError> {
        let mut records = Vec::new();
        let is_left_out = |line: &str| line.trim().is_empty() || self.is_comment(line);
        match self {
            Separator::Blanks => {
                for (index, line) in text.lines().enumerate() {
                    if !is_left_out(line) {
                        records.push(Record::new(index as u64 + 1, line.split_whitespace()));
                    }
                }
            }
            Separator::Mark(mark) => {
                // The crate does not count blank lines; a line of one blank cell is counted, and left out below.
                let kept = |line| if is_left_out(line) { "\"\"" } else { line };
                let lines = text.lines().map(kept).collect::<Vec<_>>().join("\n");
                let mut reader = csv::ReaderBuilder::new()
                    .has_headers(false)
                    .flexible(true)
                    .delimiter(mark)
                    .from_reader(lines.as_bytes());
                for record in reader.records() {
                    let record = record.map_err(|error| {
                        let line = error.position().map_or(0, csv::Position::line);
                        wrong(
                            line,
                            format!("it cannot be read ({error}); give rpm and frequencies in Hz"),
                        )
                    })?;
                    let line = record.position().map_or(0, csv::Position::line);
                    records.push(Record::new(line, record.iter()));
                }
            }
        }
        // Some spreadsheets write a first line such as "sep=;", which contains no data.
        let is_hint = |cell: &String| cell.starts_with("sep=");
        records.retain(|record| record.cells.first().is_some_and(|cell| !is_hint(cell)));
        Ok(records)
    }
}

/// The value of a number with a decimal point or a decimal comma; `None` for other text.
pub(super) fn number(cell: &str) -> Option<f64> {
    cell.replace(',', ".").parse().ok()
}

/// Whether commas in numbers are decimal. A table that contains both points and commas, or commas that may
/// separate thousands, is refused.
pub(super) fn has_decimal_comma(
    records: &[Record],
    separator: Separator,
) -> Result<bool, FitError> {
    let cells = records
        .iter()
        .flat_map(|record| record.cells.iter().map(|cell| (record.line, cell)));
    let (mut comma, mut point, mut thousands) = (None, None, true);
    let is_number = |cell: &str| {
        cell.contains([',', '.'])
            && cell
                .chars()
                .all(|c| c.is_ascii_digit() || "+-.,eE ".contains(c))
    };
    for (line, cell) in cells.filter(|(_, cell)| is_number(cell)) {
        if cell.contains(',') && cell.contains('.') {
            let problem =
                format!("{cell:?} has both a comma and a point; write a decimal point alone");
            return Err(wrong(line, problem));
        }
        if number(cell).is_none() {
            continue;
        }
        if let Some((whole, decimals)) = cell.split_once(',') {
            comma = comma.or(Some((line, cell)));
            let whole = whole.trim_start_matches('-');
            thousands &= decimals.len() == 3 && whole != "0" && whole.len() <= 3;
        } else {
            point = point.or(Some(cell));
        }
    }
    match (comma, point) {
        (Some((line, comma)), Some(point)) => Err(wrong(
            line,
            format!(
                "{comma:?} has a comma, {point:?} a point; write a decimal point everywhere, and nothing between thousands"
            ),
        )),
        (Some((line, comma)), None) if thousands && separator != Separator::Mark(b';') => {
            Err(wrong(
                line,
                format!(
                    "{comma:?} may have a decimal comma, or one between thousands; write a decimal point, and nothing between thousands"
                ),
            ))
        }
        _ => Ok(comma.is_some()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_numbers(record: &Record) -> bool {
        record.cells.iter().all(|cell| number(cell).is_some())
    }

    #[test]
    fn comments_have_any_mark_and_do_not_count_as_lines_of_the_table() {
        for (text, comment) in [
            ("* from, REW; 5\n\n* f_hz mag\n1 2\n", Some("f_hz mag")),
            ("% a; b\n%f_hz,mag\n\n1,2\n", Some("f_hz,mag")),
            (
                "; made by a logger\n; f_hz\tmag\n\n1\t2\n",
                Some("f_hz\tmag"),
            ),
            ("# a\n\nf_hz;mag\n1;2\n", None),
        ] {
            let cells = Cells::of(text, Separator::of(text), is_numbers).unwrap();
            assert_eq!(cells.comment.as_deref(), comment, "{text:?}");
            assert_eq!(cells.rows[0].cells, ["1", "2"], "{text:?}");
            assert_eq!(cells.rows[0].line, 4, "{text:?}");
        }
    }

    #[test]
    fn a_first_column_of_blanks_is_no_comment() {
        let cells = Cells::of(";t;x\n;0;1,5\n", Separator::of(";t;x\n;0;1,5\n"), |row| {
            row.line == 2
        });
        assert_eq!(cells.unwrap().rows[0].cells, ["", "0", "1,5"]);
    }
}
