//! Reads tables of measured frequencies from spreadsheets and instruments. Separators, decimal commas and the
//! order of the columns are determined from the table.

use super::FitError;
use crate::model::scene::quantity;

const MAX_DIAMETERS: f64 = quantity("measured.rows[].diameters[]").allowed.to;

/// A line of numbers or blanks: first the speed, then the frequencies in the order of their columns.
#[derive(Debug, PartialEq)]
pub struct TableRow {
    /// Line in the file, from 1.
    pub line: u64,
    /// Column number in the file, from 1, and text of each cell; blanks at the end are omitted.
    pub cells: Vec<(usize, String)>,
}

/// The lines of a table, and the nodal diameters of its columns if their names are `n0`, `n1` and so on.
#[derive(Debug)]
pub struct Table {
    pub rows: Vec<TableRow>,
    pub diameters: Option<Vec<usize>>,
}

/// The error of a line, numbered from 1.
pub fn wrong(line: u64, problem: String) -> FitError {
    FitError::Table { line, problem }
}

/// Reads a table. Blank lines and lines that begin with # are ignored.
///
/// # Errors
/// [`FitError::Table`] with line and description.
pub fn read(text: &str) -> Result<Table, FitError> {
    let separator = Separator::of(text);
    let mut records = separator.records(text)?;
    let header = Header::take(&mut records)?;
    let comma = has_decimal_comma(&records, separator)?;
    let rows = records
        .into_iter()
        .map(|record| row(record, header.as_ref(), comma))
        .collect::<Result<_, _>>()?;
    Ok(Table {
        rows,
        diameters: header.and_then(|header| header.diameters),
    })
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

fn is_comment(line: &str) -> bool {
    line.trim_start().starts_with('#')
}

impl Separator {
    /// The first of semicolon, tab and comma that occurs outside quotation marks; blanks if none does. In a table with
    /// semicolons or tabs a comma may be decimal, but not the other way round.
    pub(super) fn of(text: &str) -> Self {
        let mut quoted = false;
        let mut seen = [false; 3];
        for line in text.lines().filter(|line| !is_comment(line)) {
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

    pub(super) fn records(self, text: &str) -> Result<Vec<Record>, FitError> {
        let mut records = Vec::new();
        match self {
            Separator::Blanks => {
                for (index, line) in text.lines().enumerate() {
                    if !is_comment(line) {
                        records.push(Record::new(index as u64 + 1, line.split_whitespace()));
                    }
                }
            }
            Separator::Mark(mark) => {
                let mut reader = csv::ReaderBuilder::new()
                    .has_headers(false)
                    .flexible(true)
                    .comment(Some(b'#'))
                    .delimiter(mark)
                    .from_reader(text.as_bytes());
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

/// Number of names, column of the speed, and columns of the frequencies in their order.
struct Header {
    names: usize,
    speed: usize,
    frequencies: Vec<usize>,
    /// Nodal diameters of the frequencies, if the columns are named by them.
    diameters: Option<Vec<usize>>,
}

impl Header {
    /// Removes the first row if it contains names, and a row of units below it.
    fn take(records: &mut Vec<Record>) -> Result<Option<Self>, FitError> {
        let Some(first) = records.first() else {
            return Ok(None);
        };
        let named = first.cells.iter().any(|name| is_speed(name));
        let numbers = first.cells.iter().filter(|cell| number(cell).is_some());
        if !named && numbers.count() > 0 {
            return Ok(None);
        }
        let Record { line, cells } = records.remove(0);
        if !named {
            return Err(wrong(
                line,
                format!(
                    "it has neither numbers nor the names of columns, one of them rpm ({:?}); write \
                     names like rpm, f1, f2, or correct the numbers",
                    cells.join(", ")
                ),
            ));
        }
        let mut names = cells;
        if records
            .first()
            .is_some_and(|record| record.cells.iter().all(|cell| is_unit(cell)))
        {
            for (name, unit) in names.iter_mut().zip(records.remove(0).cells) {
                *name += &format!(" [{unit}]");
            }
        }
        Header::of_names(line, &names).map(Some)
    }

    fn of_names(line: u64, names: &[String]) -> Result<Self, FitError> {
        let speeds: Vec<usize> = (0..names.len()).filter(|k| is_speed(&names[*k])).collect();
        let [speed] = speeds[..] else {
            let problem = format!(
                "{} of its columns are speeds; keep the one in rpm",
                speeds.len()
            );
            return Err(wrong(line, problem));
        };
        for (column, name) in names.iter().enumerate() {
            let small = name.to_lowercase();
            let foreign = ["rad/s", "khz", "krpm", "1/s", "rps", "rev/s", "(ms)", "[s]"];
            let other = foreign.iter().any(|unit| small.contains(unit));
            // The unit must be a whole word, since "Drehzahl" contains "hz".
            let mut words = small.split(|c: char| !c.is_alphanumeric());
            let in_hz = column == speed && words.any(|word| word == "hz");
            if other || in_hz {
                let problem = format!(
                    "column {} is {name:?}; give speeds in rpm and frequencies in Hz",
                    column + 1
                );
                return Err(wrong(line, problem));
            }
            if column != speed && !is_frequency(&small) {
                let problem = format!(
                    "column {} is {name:?}, which is neither the speed nor a frequency; remove it, \
                     or call it f1, f2 and so on if it is one",
                    column + 1
                );
                return Err(wrong(line, problem));
            }
        }
        let mut frequencies: Vec<usize> = (0..names.len()).filter(|k| *k != speed).collect();
        let place = |column: &usize| last_number(&names[*column]);
        if frequencies.iter().all(|column| place(column).is_some()) {
            frequencies.sort_by_key(place);
        }
        let diameters = diameters_of_all(line, names, &frequencies)?;
        check_named_apart(line, names, &frequencies, diameters.as_deref())?;
        Ok(Header {
            names: names.len(),
            speed,
            frequencies,
            diameters,
        })
    }
}

/// The nodal diameters of the columns, if their names give them.
fn diameters_of_all(
    line: u64,
    names: &[String],
    frequencies: &[usize],
) -> Result<Option<Vec<usize>>, FitError> {
    let found: Vec<Option<usize>> = frequencies
        .iter()
        .map(|column| nodal_diameters(&names[*column]))
        .collect();
    if found.iter().all(Option::is_none) {
        return Ok(None);
    }
    let most = MAX_DIAMETERS as usize;
    for (column, diameters) in frequencies.iter().zip(&found) {
        let problem = match diameters {
            None => "no number of nodal diameters, as others are; call it n0, n1 and so on, or the others f1, f2".into(),
            Some(n) if *n > most => format!("more than {most} nodal diameters; remove it"),
            Some(_) => continue,
        };
        let name = &names[*column];
        return Err(wrong(
            line,
            format!("column {} is {name:?}, {problem}", column + 1),
        ));
    }
    Ok(found.into_iter().collect())
}

/// Refuses a number that names more columns than there are modes: two if it is a number of nodal diameters above zero,
/// otherwise one.
fn check_named_apart(
    line: u64,
    names: &[String],
    frequencies: &[usize],
    diameters: Option<&[usize]>,
) -> Result<(), FitError> {
    for (k, column) in frequencies.iter().enumerate() {
        let number = |k: usize| match diameters {
            Some(diameters) => Some(diameters[k] as u64),
            None => last_number(&names[frequencies[k]]),
        };
        let (most, remedy) = match (diameters, number(k)) {
            (_, None) => continue,
            (Some(_), Some(0)) => (1, "there is one mode without nodal diameters"),
            (Some(_), _) => (2, "a mode with nodal diameters has two frequencies at most"),
            (None, _) => (1, "number the frequencies in ascending order"),
        };
        if (0..k).filter(|other| number(*other) == number(k)).count() == most {
            let name = &names[*column];
            let problem = format!("column {} is {name:?} once more; {remedy}", column + 1);
            return Err(wrong(line, problem));
        }
    }
    Ok(())
}

/// Whether the name of a column means the speed, in the languages of saw manufacturers.
fn is_speed(name: &str) -> bool {
    let small = name.to_lowercase();
    let words = [
        "rpm", "speed", "drehzahl", "1/min", "min-1", "min^-1", "min⁻¹", "u/min", "r/min",
        "rev/min", "tr/min", "vitesse", "velocid", "varvtal", "omega", "Ω",
    ];
    words.iter().any(|word| small.contains(word)) || small == "n" || name.contains('Ω')
}

/// Whether the name of a column, in small letters, means a frequency: `f1`, `mode 2`, `frequency`, `(0,2)`, `3`.
fn is_frequency(small: &str) -> bool {
    let words = [
        "hz", "freq", "fréq", "mode", "peak", "wave", "eigen", "diameter",
    ];
    let numbered = |prefix: &str| {
        let rest = small
            .strip_prefix(prefix)
            .map(|rest| rest.trim_start_matches(['_', ' ', '-', '.']));
        rest.is_some_and(|rest| rest.chars().all(|c| c.is_ascii_digit()))
    };
    words.iter().any(|word| small.contains(word))
        || ["f", "fn", "m", "n", "n=", ""]
            .iter()
            .any(|prefix| numbered(prefix))
        || small.starts_with('(')
}

/// The number of nodal diameters by which a column is named: 2 of `n2`, `n = 2`, `2 diameters`.
fn nodal_diameters(name: &str) -> Option<usize> {
    let small = name.split(['(', '[']).next()?.trim().to_lowercase();
    let number = small
        .strip_prefix('n')
        .map(|rest| rest.trim_start_matches([' ', '_', '=']))
        .or_else(|| small.split_once(" diameter").map(|(number, _)| number))?;
    number.trim().parse().ok()
}

/// Whether a cell contains only a unit.
fn is_unit(cell: &str) -> bool {
    let bare = cell.trim_matches(['[', ']', '(', ')']).to_lowercase();
    let units = [
        "", "rpm", "1/min", "min-1", "min^-1", "u/min", "r/min", "hz", "khz", "rad/s", "1/s",
    ];
    units.contains(&bare.as_str())
}

/// The number in a name, outside its unit: 3 of `f3 (Hz)`.
fn last_number(name: &str) -> Option<u64> {
    let bare = name.split(['(', '[']).next().unwrap_or(name).trim_end();
    let digits = bare.len() - bare.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    bare[bare.len() - digits..].parse().ok()
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
    for (line, cell) in cells.filter(|(_, cell)| cell.contains([',', '.'])) {
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

fn row(record: Record, header: Option<&Header>, comma: bool) -> Result<TableRow, FitError> {
    let Record { line, cells } = record;
    let names = header.map_or(usize::MAX, |header| header.names);
    if cells.len() > names {
        let problem = format!(
            "it has {} columns, the header {names}; name every column, and if the numbers have \
             decimal commas, put semicolons between them",
            cells.len()
        );
        return Err(wrong(line, problem));
    }
    let order: Vec<usize> = match header {
        Some(header) => std::iter::once(header.speed)
            .chain(header.frequencies.iter().copied())
            .collect(),
        None => (0..cells.len()).collect(),
    };
    let text = |column: &usize| {
        let text = cells.get(*column).cloned().unwrap_or_default();
        if comma { text.replace(',', ".") } else { text }
    };
    let mut ordered: Vec<(usize, String)> = order.iter().map(|k| (k + 1, text(k))).collect();
    while ordered.last().is_some_and(|(_, text)| text.is_empty()) {
        ordered.pop();
    }
    Ok(TableRow {
        line,
        cells: ordered,
    })
}

#[cfg(test)]
#[path = "table_tests.rs"]
mod tests;
