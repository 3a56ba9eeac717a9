//! Columns of numbers from the tables of instruments, with names and units, and either decimal mark.

use super::FitError;
use super::table::{Record, Separator, has_decimal_comma, number, wrong};

/// Rows of names and units above the numbers.
const TITLES: usize = 2;
/// Units as the end of a name, like `deflection_mm`.
const ENDINGS: [&str; 15] = [
    "rpm", "hz", "khz", "s", "ms", "us", "m", "mm", "um", "µm", "v", "mv", "pa", "n", "g",
];

/// A column of a table.
#[derive(Debug, PartialEq)]
pub struct NumberColumn {
    /// Name; "column 2" without one.
    pub name: String,
    /// Unit; empty without one.
    pub unit: String,
    /// Numbers, one for each row, all finite.
    pub numbers: Vec<f64>,
}

/// Reads a table of numbers without blanks. Names, and units below them, are optional; lines that begin with # are
/// ignored.
///
/// # Errors
/// [`FitError::Table`] with the line that is no row of as many finite numbers as the first one.
pub fn number_columns(text: &str) -> Result<Vec<NumberColumn>, FitError> {
    let separator = Separator::of(text);
    let mut records = separator.records(text)?;
    let is_title = |record: &Record| record.cells.iter().all(|cell| number(cell).is_none());
    let count = records
        .iter()
        .take(TITLES)
        .take_while(|record| is_title(record))
        .count();
    let titles: Vec<Record> = records.drain(..count).collect();
    let Some(width) = records.first().map(|record| record.cells.len()) else {
        let line = titles.last().map_or(1, |record| record.line);
        let problem = "it has no line of numbers; give a table with one row for each sample";
        return Err(wrong(line, problem.to_owned()));
    };
    has_decimal_comma(&records, separator)?;
    let title = |row: usize, column: usize| {
        let cell = titles.get(row).and_then(|record| record.cells.get(column));
        cell.map_or("", String::as_str)
    };
    let named = |column: usize| {
        let (name, unit) = split_unit(title(0, column));
        let below = title(1, column).trim_matches(['[', ']', '(', ')', ' ']);
        NumberColumn {
            name: if name.is_empty() {
                format!("column {}", column + 1)
            } else {
                name
            },
            unit: if below.is_empty() {
                unit
            } else {
                below.to_owned()
            },
            numbers: Vec::with_capacity(records.len()),
        }
    };
    let mut columns: Vec<NumberColumn> = (0..width).map(named).collect();
    for Record { line, cells } in &records {
        if cells.len() != width {
            let count = cells.len();
            let problem = format!(
                "it has {count} columns, the first one {width}; give every line the same columns"
            );
            return Err(wrong(*line, problem));
        }
        for (place, (column, cell)) in columns.iter_mut().zip(cells).enumerate() {
            let found = number(cell).filter(|number| number.is_finite());
            column.numbers.push(found.ok_or_else(|| {
                let problem = format!(
                    "column {} must be a finite number (you gave '{cell}'); remove the line, or fill the gap",
                    place + 1
                );
                wrong(*line, problem)
            })?);
        }
    }
    Ok(columns)
}

/// A name without its unit, and the unit: `probe [mm]`, `deflection_m`, `rpm`.
fn split_unit(text: &str) -> (String, String) {
    let text = text.trim();
    if let Some((name, rest)) = text.split_once(['[', '(']) {
        let unit = rest.split([']', ')']).next().unwrap_or_default().trim();
        let name = name.trim();
        return (
            if name.is_empty() { unit } else { name }.to_owned(),
            unit.to_owned(),
        );
    }
    match text.rsplit_once('_') {
        Some((name, unit))
            if !name.is_empty() && ENDINGS.contains(&unit.to_lowercase().as_str()) =>
        {
            (name.to_owned(), unit.to_owned())
        }
        _ if text.eq_ignore_ascii_case("rpm") => (text.to_owned(), "rpm".to_owned()),
        _ => (text.to_owned(), String::new()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_have_names_and_units_in_any_form() {
        let found =
            number_columns("# a record\nt;probe;n\n[s];[mm];\n0,0;0,1;0\n0,5;0,2;10\n").unwrap();
        let heads: Vec<_> = found
            .iter()
            .map(|of| (of.name.as_str(), of.unit.as_str()))
            .collect();
        assert_eq!(heads, [("t", "s"), ("probe", "mm"), ("n", "")]);
        assert_eq!(found[1].numbers, [0.1, 0.2]);
        for (text, name, unit) in [
            ("probe [mm]", "probe", "mm"),
            ("deflection_m", "deflection", "m"),
            ("rpm", "rpm", "rpm"),
            ("f", "f", ""),
        ] {
            assert_eq!(split_unit(text), (name.to_owned(), unit.to_owned()));
        }
        let bare = number_columns("0 1\n1 2\n").unwrap();
        assert_eq!(
            (bare[1].name.as_str(), &bare[1].numbers[..]),
            ("column 2", &[1.0, 2.0][..])
        );
    }

    #[test]
    fn a_line_that_is_no_row_is_refused() {
        for (text, said) in [
            ("t,x\n0,1\n1,b\n", "line 3 of"),
            ("t,x\n0,1\n1\n", "has 1 columns"),
            ("t,x\n0,1\n1,nan\n", "finite"),
            ("t,x\n", "no line of numbers"),
        ] {
            let error = number_columns(text).unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
        }
    }
}
