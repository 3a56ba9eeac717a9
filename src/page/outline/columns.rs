//! An outline in 80 columns.

use textwrap::{Options, WordSeparator, WordSplitter};

use super::table::Table;
use super::{Block, Fact, Outline};

/// Largest number of characters of a line.
pub const WIDTH: usize = 80;
/// Number of characters before the rows of a table and the facts.
const INDENT: usize = 2;
/// Number of characters between two columns.
const GAP: usize = 2;
/// Least room for the words of a last column; with less they begin on a line of their own.
const LEAST_ROOM: usize = 30;

impl Outline {
    /// The text in lines of at most 80 columns, with its details if asked for.
    pub fn in_columns(&self, with_details: bool) -> String {
        let mut text = String::new();
        let mut before = None;
        let shown = self.parts.iter();
        for part in shown.filter(|part| with_details || !part.is_detail) {
            if before.is_some_and(|before| are_apart(before, &part.block)) {
                text.push('\n');
            }
            text.push_str(&written(&part.block));
            before = Some(&part.block);
        }
        text
    }
}

/// Whether an empty line separates two blocks: on both sides of rows, and before the answer.
fn are_apart(before: &Block, block: &Block) -> bool {
    let has_rows = |block: &Block| matches!(block, Block::Facts { .. } | Block::Table(_));
    let is_answer = |block: &Block| matches!(block, Block::Headline(_));
    has_rows(before) || has_rows(block) || (is_answer(block) && !is_answer(before))
}

fn written(block: &Block) -> String {
    match block {
        Block::Heading(text) | Block::Headline(text) | Block::Sentence(text) => {
            format!("{}\n", wrapped(text))
        }
        Block::Reason(text) => format!("{}\n", hanging(text, INDENT, 2 * INDENT)),
        Block::Remark { word, text } => format!("{}\n", wrapped(&format!("{word}: {text}"))),
        Block::Facts { title, facts } => in_lines(title, facts),
        Block::Table(table) => in_rows(table),
    }
}

fn in_lines(title: &str, facts: &[Fact]) -> String {
    let widths = facts.iter().map(|fact| fact.name.chars().count());
    let width = widths.max().unwrap_or(0);
    let mut text = String::new();
    if !title.is_empty() {
        text.push_str(&format!("{}\n", wrapped(title)));
    }
    for fact in facts {
        let line = format!("{:<width$}  {}", fact.name, fact.in_words());
        text.push_str(&format!(
            "{}\n",
            hanging(&line, INDENT, INDENT + width + GAP)
        ));
    }
    text
}

/// Widths and sides of the columns of a table.
struct Grid {
    widths: Vec<usize>,
    /// Whether a column is aligned to the left, as words are.
    is_left: Vec<bool>,
    /// Number of characters of a line before the last column.
    before_last: usize,
}

impl Grid {
    fn of(table: &Table, heads: &[Vec<String>], rows: &[Vec<String>]) -> Self {
        let columns = 0..table.columns.len();
        let cells = |k: usize| heads.iter().chain(rows).filter_map(move |row| row.get(k));
        let width = |k: usize| cells(k).map(|cell| cell.chars().count()).max();
        let widths: Vec<usize> = columns.clone().map(|k| width(k).unwrap_or(0)).collect();
        let is_left = columns.map(|k| {
            let mut own = table.rows.iter().filter_map(|row| row.cells.get(k));
            table.columns[k].unit.is_empty() && own.all(|value| !value.is_number())
        });
        let first = widths.iter().rev().skip(1);
        Grid {
            before_last: INDENT + first.map(|width| width + GAP).sum::<usize>(),
            is_left: is_left.collect(),
            widths,
        }
    }

    /// A line; words of a last column for which there is no room continue on further lines.
    fn line(&self, cells: &[String]) -> String {
        let mut line = " ".repeat(INDENT);
        let last = self.widths.len().saturating_sub(1);
        for (k, cell) in cells.iter().enumerate() {
            let missing = self.widths[k].saturating_sub(cell.chars().count());
            let space = " ".repeat(missing);
            let is_long = k == last && line.chars().count() + cell.chars().count() > WIDTH;
            match (is_long, self.is_left[k]) {
                (true, _) => return self.continued(&line, cell),
                (false, true) => line.push_str(&format!("{cell}{space}")),
                (false, false) => line.push_str(&format!("{space}{cell}")),
            }
            line.push_str(&" ".repeat(GAP));
        }
        format!("{}\n", line.trim_end())
    }

    fn continued(&self, line: &str, words: &str) -> String {
        if WIDTH.saturating_sub(self.before_last) < LEAST_ROOM {
            format!(
                "{}\n{}\n",
                line.trim_end(),
                hanging(words, 2 * INDENT, 3 * INDENT)
            )
        } else {
            let whole = format!("{line}{words}");
            format!("{}\n", hanging(&whole, 0, self.before_last))
        }
    }

    /// Names of groups, each at the right end of its columns.
    fn groups(&self, table: &Table) -> String {
        let mut line = String::new();
        let mut end = INDENT;
        for (k, column) in table.columns.iter().enumerate() {
            end += self.widths[k];
            let next = table.columns.get(k + 1);
            if !column.group.is_empty() && next.is_none_or(|next| next.group != column.group) {
                let room = end.saturating_sub(line.chars().count());
                line.push_str(&format!("{:>room$}", column.group));
            }
            end += GAP;
        }
        format!("{line}\n")
    }
}

fn in_rows(table: &Table) -> String {
    let names = table.columns.iter().map(|column| column.name.clone());
    let units = table.columns.iter().map(|column| match column.unit {
        "" => String::new(),
        unit => format!("[{unit}]"),
    });
    let mut heads = vec![names.collect::<Vec<_>>(), units.collect()];
    heads.retain(|head| head.iter().any(|cell| !cell.is_empty()));
    let shown = table.rows.iter().take(table.shown);
    let in_words = |row: &super::Row| row.cells.iter().map(super::Value::in_words).collect();
    let rows: Vec<Vec<String>> = shown.clone().map(in_words).collect();
    let grid = Grid::of(table, &heads, &rows);
    let mut text = String::new();
    if !table.title.is_empty() {
        text.push_str(&format!("{}\n", wrapped(&table.title)));
    }
    if table.columns.iter().any(|column| !column.group.is_empty()) {
        text.push_str(&grid.groups(table));
    }
    heads
        .iter()
        .for_each(|head| text.push_str(&grid.line(head)));
    for (row, cells) in shown.zip(&rows) {
        text.push_str(&grid.line(cells));
        if let Some(remark) = &row.remark {
            let line = hanging(remark, 2 * INDENT, 3 * INDENT);
            text.push_str(&format!("{line}\n"));
        }
    }
    match table.rows.len().saturating_sub(rows.len()) {
        0 => text,
        rest => format!("{text}  … and {rest} more in {}\n", table.file),
    }
}

/// The line, cut off with an ellipsis if it has more characters than `width`.
pub fn shortened(line: &str, width: usize) -> String {
    if line.chars().count() <= width {
        return line.to_owned();
    }
    line.chars().take(width - 1).chain(['…']).collect()
}

/// Breaks a sentence at spaces into lines of at most 80 characters; all but the first are indented.
pub fn wrapped(sentence: &str) -> String {
    hanging(sentence, 0, INDENT)
}

/// Breaks a text at spaces into lines of at most 80 characters with an indent, and one of all but the first.
fn hanging(text: &str, first: usize, rest: usize) -> String {
    let [first, rest] = [first, rest].map(|indent| " ".repeat(indent));
    let at_spaces = Options::new(WIDTH)
        .initial_indent(&first)
        .subsequent_indent(&rest)
        .word_separator(WordSeparator::AsciiSpace)
        .word_splitter(WordSplitter::NoHyphenation)
        .break_words(false);
    // A number is not parted from its percent sign.
    let bound = text.replace(" %", "\u{a0}%");
    textwrap::fill(&bound, at_spaces).replace('\u{a0}', " ")
}
