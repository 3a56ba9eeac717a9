//! Names and units above the columns of a table of an instrument.

use super::FitError;
use super::cells::{Record, Separator, wrong};

/// Units, alone or before a division or a power such as in `mm/N` and `m/s²`; longer ones in small letters.
const UNITS: &str = "s sec second seconds sek sekunde sekunden seconde secondes ms msec millisecond milliseconds \
    millisekunden us µs μs ns min h m mm cm um µm μm nm in mil V mv volt volts pa kpa mpa N kn g hz khz \
    rpm krpm 1/min min-1 min^-1 min⁻¹ u/min r/min rev/min tr/min rps 1/s rev/s u/s rad radian radians \
    deg degree degrees ° grad gon db dbv % inch mils ma kw bar °c";
/// Units that are words of names as well, so that they need brackets, a division, or "in" before them.
const WORDS: [&str; 3] = ["min", "h", "in"];
/// Arguments of a function such as in `x(t)`.
const ARGUMENTS: [&str; 4] = ["t", "f", "ω", "jω"];

/// Names and units of columns; both are shorter than the table where it has none.
#[derive(Default)]
pub(super) struct Titles {
    /// Line of the names; `None` without one, and for a comment.
    pub(super) line: Option<u64>,
    pub(super) names: Vec<String>,
    units: Vec<String>,
}

impl Titles {
    /// Titles from the rows of text above the numbers, or from a comment directly above these.
    pub(super) fn of(
        mut rows: Vec<Record>,
        comment: Option<&str>,
        width: usize,
        separator: Separator,
    ) -> Result<Self, FitError> {
        // Where semicolons separate the cells, a comment that begins with one is a short line with a blank first cell.
        let is_remark = |row: &Record| {
            row.cells[0].is_empty() && row.cells.len() < width && !is_row_of_units(row)
        };
        rows.retain(|row| !is_remark(row));
        let is_units = rows.len() > 1 && rows.last().is_some_and(is_row_of_units);
        let units = if is_units { rows.pop() } else { None };
        let units = units.map_or(Vec::new(), |row| row.cells);
        let Some(Record { line, cells: names }) = rows.pop() else {
            return Ok(Titles {
                line: None,
                names: comment.map_or(Vec::new(), |text| of_comment(text, width, separator)),
                units,
            });
        };
        // A row of one cell is the title of the whole table.
        if let Some(other) = rows.iter().find(|row| width == 1 || row.cells.len() > 1) {
            return Err(wrong(
                other.line,
                format!(
                    "it is text, and so is line {line}; keep one line with the names of the columns, and below it at \
                     most one with their units in brackets"
                ),
            ));
        }
        let is_each_named = names.len() == width || separator != Separator::Blanks;
        if names.len() < width || !is_each_named {
            return Err(wrong(
                line,
                format!(
                    "it has {} names, the numbers below {width} columns; name every column, and separate names with \
                     blanks, and numbers with decimal commas, by semicolons or tabs",
                    names.len()
                ),
            ));
        }
        Ok(Titles {
            line: Some(line),
            names,
            units,
        })
    }

    /// Titles of all columns, with the units of the line below them.
    pub(super) fn with_units(&self) -> Vec<String> {
        let unit = |column| {
            self.units
                .get(column)
                .map_or("", |cell: &String| bare(cell))
        };
        let names = self.names.iter().enumerate();
        names
            .map(|(column, name)| match unit(column) {
                "" => name.clone(),
                unit => format!("{name} [{unit}]"),
            })
            .collect()
    }

    /// Title of a column; "column 2" without one.
    pub(super) fn of_column(&self, column: usize) -> String {
        let title = self
            .names
            .get(column)
            .map_or("", |name| name.trim_matches('"'));
        let words: Vec<&str> = title.split_whitespace().collect();
        if words.is_empty() {
            format!("column {}", column + 1)
        } else {
            words.join(" ")
        }
    }

    /// Name and unit of a column.
    pub(super) fn split(&self, column: usize) -> (String, String) {
        let (name, unit) = split_unit(&self.of_column(column));
        match self.units.get(column).map_or("", |cell| bare(cell)) {
            "" => (name, unit),
            below => (name, below.to_owned()),
        }
    }
}

/// Names of a comment, if it has one for each column, with the separator of the numbers or another one.
fn of_comment(text: &str, width: usize, separator: Separator) -> Vec<String> {
    let others = [Separator::of(text), Separator::Blanks];
    let mut found = std::iter::once(separator).chain(others).filter_map(|mark| {
        let cells = mark.records(text).ok()?.pop()?.cells;
        (cells.len() == width).then_some(cells)
    });
    found.next().unwrap_or_default()
}

fn bare(cell: &str) -> &str {
    cell.trim_matches(['[', ']', '(', ')', ' ', '-'])
}

fn is_row_of_units(row: &Record) -> bool {
    row.cells.iter().all(|cell| {
        let is_bracketed = cell.starts_with(['[', '(']) && cell.ends_with([']', ')']);
        is_bracketed || is_unit(cell) || bare(cell).is_empty()
    })
}

fn is_unit(text: &str) -> bool {
    let text = text.trim().trim_end_matches('.');
    let head = text
        .split(['/', '*', '·', '²', '³', '^', ' '])
        .next()
        .unwrap_or_default();
    [text, head].into_iter().any(|text| {
        let small = text.to_lowercase();
        let is_long = text.chars().count() > 1;
        UNITS
            .split(' ')
            .any(|unit| unit == text || is_long && unit == small)
    })
}

/// A name without its unit, and the unit: `probe [mm]`, `deflection_m`, `t/s`, `Zeit in s`, `rpm`.
fn split_unit(text: &str) -> (String, String) {
    let text = text.trim_end_matches('_');
    let is_whole =
        is_unit(text) && !WORDS.contains(&text) && text != "s" && !text.starts_with("s/");
    let found = bracketed(text)
        .or_else(|| is_whole.then_some((text, text)))
        .or_else(|| with_level(text))
        .or_else(|| {
            let split = |mark| text.rsplit_once(mark).filter(|(_, unit)| is_unit(unit));
            let free = |mark| split(mark).filter(|(_, unit)| !WORDS.contains(unit));
            let over = || text.split_once('/').filter(|(_, unit)| is_unit(unit));
            split(" in ")
                .or_else(|| free(" "))
                .or_else(|| free("_"))
                .or_else(over)
                .or_else(|| split(","))
        });
    let (name, unit) = found.unwrap_or((text, ""));
    let name = name.trim_end_matches([' ', '/', ',', '_', '-']);
    (
        if name.is_empty() { unit } else { name }.to_owned(),
        unit.trim().to_owned(),
    )
}

/// A name, and the unit in the last brackets behind it, which are no number and no argument.
fn bracketed(text: &str) -> Option<(&str, &str)> {
    let end = text.rfind([']', ')'])?;
    let mut depth = 0;
    let begin = text[..=end].rfind(|c| {
        depth += i32::from(matches!(c, ']' | ')')) - i32::from(matches!(c, '[' | '('));
        depth == 0
    })?;
    let unit = text[begin + 1..end].trim();
    let is_number = unit.chars().all(|c| c.is_ascii_digit());
    (!is_number && !ARGUMENTS.contains(&unit)).then_some((&text[..begin], unit))
}

/// A name, and a level with its reference: `FRF dB re 1 mm/N`.
fn with_level(text: &str) -> Option<(&str, &str)> {
    let at = [" dB", " db", "_dB", "_db"]
        .iter()
        .find_map(|mark| text.find(mark))?;
    Some((&text[..at], &text[at + 1..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_split_from_its_name_in_any_form() {
        for (text, name, unit) in [
            ("probe [mm]", "probe", "mm"),
            ("Probe (µm)", "Probe", "µm"),
            ("x(t) (mm)", "x(t)", "mm"),
            ("x(t)", "x(t)", ""),
            ("Channel (1)", "Channel (1)", ""),
            ("deflection_m", "deflection", "m"),
            ("n/(1/min)", "n", "1/min"),
            ("t/s", "t", "s"),
            ("s/mm", "s", "mm"),
            ("n/min-1", "n", "min-1"),
            ("t / ms", "t", "ms"),
            ("Zeit in s", "Zeit", "s"),
            ("Zeit in h", "Zeit", "h"),
            ("Weg in x-Richtung", "Weg in x-Richtung", ""),
            ("Motor Speed RPM", "Motor Speed", "RPM"),
            ("time_min", "time_min", ""),
            ("Frequency_kHz_", "Frequency", "kHz"),
            ("column 2", "column 2", ""),
            ("Dev1/ai0", "Dev1/ai0", ""),
            ("FRF dB re 1 mm/N", "FRF", "dB re 1 mm/N"),
            ("Magnitude [dB (re 1 m/N)]", "Magnitude", "dB (re 1 m/N)"),
            ("mm/N", "mm/N", "mm/N"),
            ("acc [m/(s^2)]", "acc", "m/(s^2)"),
            ("rpm", "rpm", "rpm"),
            ("s", "s", ""),
            ("f", "f", ""),
        ] {
            assert_eq!(
                split_unit(text),
                (name.to_owned(), unit.to_owned()),
                "{text}"
            );
        }
    }
}
