//! Columns of numbers from the tables of instruments, with names and units, and either decimal mark.

use super::FitError;
use super::cells::{Cells, Record, Separator, has_decimal_comma, number, wrong};
use super::labview::Labview;
use super::number_column::NumberColumn;
use super::titles::Titles;

/// Names of columns with remarks on some rows.
const REMARKS: [&str; 3] = ["comment", "kommentar", "commentaire"];

/// Reads a table of numbers. Names, and units below them, are optional, also in a comment directly above the numbers;
/// other comments are ignored, and so are blank columns and remarks. The header of a LabVIEW file gives
/// it units, and abscissas if it has none.
///
/// # Errors
/// [`FitError::Table`] with the line that is no row of as many finite numbers as the first one.
pub fn number_columns(text: &str) -> Result<Vec<NumberColumn>, FitError> {
    let (labview, above, body) = match Labview::of(text)? {
        Some((header, lines, body)) => (Some(header), lines, body),
        None => (None, 0, text),
    };
    let separator = labview
        .as_ref()
        .map_or_else(|| Separator::of(body), |header| header.separator);
    let is_numbers = |record: &Record| record.cells.iter().any(|cell| number(cell).is_some());
    let Cells {
        above: mut records,
        comment,
        mut rows,
        ..
    } = Cells::of(body, separator, is_numbers)?;
    let all = records.iter_mut().chain(&mut rows);
    all.for_each(|record| record.line += above);
    let Some(first) = rows.first() else {
        let problem = "it has no line of numbers; give a table with one row for each sample";
        return Err(wrong(
            records.last().map_or(1, |record| record.line),
            problem.to_owned(),
        ));
    };
    let titles = Titles::of(records, comment.as_deref(), first.cells.len(), separator)?;
    has_decimal_comma(&rows, separator)?;
    let is_remark = |name: &str| REMARKS.contains(&name.to_lowercase().as_str());
    let width = first.cells.len().max(titles.names.len());
    let mut columns: Vec<(usize, NumberColumn)> = Vec::new();
    for place in 0..width {
        let title = titles.of_column(place);
        let is_blank = |row: &Record| row.cells.get(place).is_none_or(String::is_empty);
        if is_remark(&title) || rows.iter().all(is_blank) {
            continue;
        }
        let of_header = labview
            .as_ref()
            .and_then(|header| header.unit(&title, place));
        let (name, unit) = match of_header {
            Some(unit) => (title, unit.to_owned()),
            None => titles.split(place),
        };
        let numbers = Vec::with_capacity(rows.len());
        columns.push((
            place,
            NumberColumn {
                name,
                unit,
                numbers,
            },
        ));
    }
    let abscissas = match &labview {
        Some(header) => header.abscissas(&columns, rows.len())?,
        None => None,
    };
    let columns = read_rows(&rows, columns, width)?;
    Ok(abscissas.into_iter().chain(columns).collect())
}

/// Columns with their places in the rows, filled with numbers.
fn read_rows(
    rows: &[Record],
    mut columns: Vec<(usize, NumberColumn)>,
    width: usize,
) -> Result<Vec<NumberColumn>, FitError> {
    let last = columns.last().map_or(0, |(place, _)| *place);
    for Record { line, cells } in rows {
        if cells.len() > width || cells.len() <= last {
            let count = cells.len();
            let problem = format!(
                "it has {count} columns, the first one {}; give every line the same columns",
                last + 1
            );
            return Err(wrong(*line, problem));
        }
        for (place, column) in &mut columns {
            let cell = &cells[*place];
            let found = number(cell).filter(|number| number.is_finite());
            column.numbers.push(found.ok_or_else(|| {
                let remedy = if cell.contains(':') {
                    "give times as seconds, or remove the column"
                } else {
                    "remove the line or the column, or fill the gap"
                };
                let place = *place + 1;
                let problem =
                    format!("column {place} must be a finite number (you gave '{cell}'); {remedy}");
                wrong(*line, problem)
            })?);
        }
    }
    Ok(columns.into_iter().map(|(_, column)| column).collect())
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
