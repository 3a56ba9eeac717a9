//! Reads tables of measured frequencies. Separators, decimal commas and the order of the columns are determined from the
//! table.

use super::FitError;
use super::cells::{Cells, Record, Separator, has_decimal_comma, number, wrong};
use super::titles::Titles;
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

/// Columns that are neither the speed nor a frequency.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Others {
    /// They are refused, because each column is one of the lowest frequencies.
    Refused,
    /// They are left out, such as the amplitude of a peak; the speed and the frequencies need names.
    LeftOut,
}

/// Reads a table. Blank lines and comments are ignored.
///
/// # Errors
/// [`FitError::Table`] with line and description.
pub fn read(text: &str, others: Others) -> Result<Table, FitError> {
    let named = |record: &Record| record.cells.iter().any(|name| is_speed(name));
    let numbers = |record: &Record| record.cells.iter().any(|cell| number(cell).is_some());
    let cells = Cells::of(text, Separator::of(text), |record| {
        !named(record) && numbers(record)
    })?;
    let comma = has_decimal_comma(&cells.rows, cells.separator)?;
    let Cells { rows, above, .. } = cells;
    let header = Header::of(
        above,
        cells.comment.as_deref(),
        &rows,
        cells.separator,
        others,
    )?;
    let rows = rows
        .into_iter()
        .map(|record| row(record, header.as_ref(), comma))
        .collect::<Result<_, _>>()?;
    Ok(Table {
        rows,
        diameters: header.and_then(|header| header.diameters),
    })
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
    /// The header of lines of text above the numbers, or of a comment directly above these.
    fn of(
        above: Vec<Record>,
        comment: Option<&str>,
        rows: &[Record],
        separator: Separator,
        others: Others,
    ) -> Result<Option<Self>, FitError> {
        let line = above.last().map_or(1, |record| record.line);
        let has_names = !above.is_empty();
        let widest = above.iter().map(|record| record.cells.len()).max();
        let width = widest.or(rows.first().map(|row| row.cells.len()));
        let titles = Titles::of(above, comment, width.unwrap_or(0), separator)?;
        let names = titles.with_units();
        let named = names.iter().any(|name| is_speed(name));
        if named {
            return Header::of_names(titles.line.unwrap_or(line), &names, others).map(Some);
        }
        let problem = match others {
            Others::Refused if !has_names => return Ok(None),
            Others::Refused => format!(
                "it has neither numbers nor the names of columns, one of them rpm ({:?}); write names like rpm, f1, f2, \
                 or correct the numbers",
                names.join(", ")
            ),
            Others::LeftOut => {
                "it has no name of a column of the speed; name the columns rpm and frequency_hz, in a line above the \
                 numbers".to_owned()
            }
        };
        Err(wrong(line, problem))
    }

    fn of_names(line: u64, names: &[String], others: Others) -> Result<Self, FitError> {
        let speeds: Vec<usize> = (0..names.len()).filter(|k| is_speed(&names[*k])).collect();
        let [speed] = speeds[..] else {
            let listed: Vec<&str> = speeds.iter().map(|k| names[*k].as_str()).collect();
            let problem = format!(
                "{} of its columns are speeds ({}); keep the one in rpm",
                speeds.len(),
                listed.join(", ")
            );
            return Err(wrong(line, problem));
        };
        let mut frequencies: Vec<usize> = (0..names.len()).filter(|k| *k != speed).collect();
        if others == Others::LeftOut {
            frequencies = named_frequencies(names, &frequencies);
            if frequencies.is_empty() {
                let problem = format!(
                    "it has {}, but no frequency; name a column frequency_hz",
                    names.join(", ")
                );
                return Err(wrong(line, problem));
            }
        }
        let used = |column: usize| column == speed || frequencies.contains(&column);
        for (column, name) in names.iter().enumerate().filter(|(column, _)| used(*column)) {
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
        let place = |column: &usize| last_number(&names[*column]);
        if frequencies.iter().all(|column| place(column).is_some()) {
            frequencies.sort_by_key(place);
        }
        let diameters = match others {
            Others::Refused => diameters_of_all(line, names, &frequencies)?,
            Others::LeftOut => None,
        };
        check_named_apart(line, names, &frequencies, diameters.as_deref())?;
        Ok(Header {
            names: names.len(),
            speed,
            frequencies,
            diameters,
        })
    }
}

/// Those of the columns that have the unit or the name of a frequency; without one, those with numbered names such as f1.
fn named_frequencies(names: &[String], columns: &[usize]) -> Vec<usize> {
    let small = |column: &usize| names[*column].to_lowercase();
    let is_plain =
        |name: String| name.contains("hz") || name.contains("freq") || name.contains("fréq");
    let plain: Vec<usize> = columns
        .iter()
        .copied()
        .filter(|k| is_plain(small(k)))
        .collect();
    if plain.is_empty() {
        columns
            .iter()
            .copied()
            .filter(|k| is_frequency(&small(k)))
            .collect()
    } else {
        plain
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

/// The number in a name, outside its unit: 3 of `f3 (Hz)`.
fn last_number(name: &str) -> Option<u64> {
    let bare = name.split(['(', '[']).next().unwrap_or(name).trim_end();
    let digits = bare.len() - bare.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    bare[bare.len() - digits..].parse().ok()
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
