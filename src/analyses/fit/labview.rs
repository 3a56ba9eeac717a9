//! Header of a LabVIEW measurement file (.lvm). Its fields are those of the columns at the same places.

use super::FitError;
use super::cells::{Separator, wrong};
use super::number_column::NumberColumn;

const BEGIN: &str = "LabVIEW Measurement";
const END: &str = "***End_of_Header***";
const ABSCISSA: &str = "X_Value";

/// Header and numbers of a file.
pub(super) struct Labview<'a> {
    header: Vec<Vec<&'a str>>,
    pub(super) separator: Separator,
}

impl<'a> Labview<'a> {
    /// The header of a file, the number of its lines, and the text below it; `None` for any other table.
    pub(super) fn of(text: &'a str) -> Result<Option<(Self, u64, &'a str)>, FitError> {
        if !text.trim_start().starts_with(BEGIN) {
            return Ok(None);
        }
        let ends: Vec<usize> = text.match_indices(END).map(|(at, _)| at).collect();
        let line = |at: usize| text[..at].matches('\n').count() as u64 + 1;
        let last = match ends[..] {
            [last] | [_, last] => last,
            [_, _, third, ..] => {
                let problem = format!(
                    "it begins segment 2 of {}; keep one segment in the file, with the header above it",
                    ends.len() - 1
                );
                return Err(wrong(line(third), problem));
            }
            [] => {
                return Err(wrong(
                    1,
                    format!("the header has no end ({END}); export the file again"),
                ));
            }
        };
        let body = text[last..].split_once('\n').map_or("", |(_, body)| body);
        let rows = text[..last].lines();
        let is_comma = rows.clone().any(|row| row.starts_with("Separator,"));
        let mark = if is_comma { ',' } else { '\t' };
        let header = rows
            .map(|row| row.split(mark).map(str::trim).collect())
            .collect();
        let separator = Separator::Mark(mark as u8);
        Ok(Some((Labview { header, separator }, line(last), body)))
    }

    /// Field of a column, from 0; `None` if it is blank.
    fn field(&self, tag: &str, column: usize) -> Option<&'a str> {
        let row = self.header.iter().rev().find(|row| row[0] == tag)?;
        row.get(column).copied().filter(|field| !field.is_empty())
    }

    /// Unit of a column, whose title may have none; `None` if the header does not state it either.
    pub(super) fn unit(&self, title: &str, column: usize) -> Option<&'a str> {
        if title == ABSCISSA {
            return Some(self.unit_of_abscissa());
        }
        self.field("Y_Unit_Label", column)
    }

    fn unit_of_abscissa(&self) -> &'a str {
        match self.field("X_Dimension", 1) {
            None | Some("Time") => "s",
            Some("Frequency") => "Hz",
            Some(other) => other,
        }
    }

    /// Abscissas of rows of columns at some places, from the first value and the step of these columns; `None` if
    /// the table contains abscissas, or its header no step.
    pub(super) fn abscissas(
        &self,
        columns: &[(usize, NumberColumn)],
        rows: usize,
    ) -> Result<Option<NumberColumn>, FitError> {
        if columns.iter().any(|(_, column)| column.name == ABSCISSA) {
            return Ok(None);
        }
        let number = |tag, column| {
            let Some(field) = self.field(tag, column) else {
                return Ok(None);
            };
            let found = field.replace(',', ".").parse::<f64>();
            let problem =
                || format!("{tag} of the header must be a number (you gave '{field}'); correct it");
            found.map(Some).map_err(|_| wrong(1, problem()))
        };
        let mut known = None;
        for (place, column) in columns {
            let found = (
                number("X0", *place)?.unwrap_or_default(),
                number("Delta_X", *place)?,
            );
            match known.get_or_insert(found) {
                before if *before == found => (),
                (first, step) => {
                    let problem = format!(
                        "{} has X0 {} and Delta_X {}, the columns before it {first} and {}; keep columns with the same \
                         abscissas",
                        column.name,
                        found.0,
                        found.1.unwrap_or_default(),
                        step.unwrap_or_default()
                    );
                    return Err(wrong(1, problem));
                }
            }
        }
        let Some((first, Some(step))) = known else {
            return Ok(None);
        };
        Ok(Some(NumberColumn {
            name: ABSCISSA.to_owned(),
            unit: self.unit_of_abscissa().to_owned(),
            numbers: (0..rows).map(|row| first + step * row as f64).collect(),
        }))
    }
}

#[cfg(test)]
mod tests {
    use crate::analyses::fit::number_columns;

    #[test]
    fn units_and_missing_abscissas_are_those_of_the_header() {
        let text = "LabVIEW Measurement\nSeparator\tTab\n***End_of_Header***\nY_Unit_Label\tmm\tN\nX_Dimension\tTime\t\
                    Time\nX0\t1,0\t1,0\nDelta_X\t0,5\t0,5\n***End_of_Header***\nX_Value\tprobe (raw)\tforce\tComment\n\
                    \t0,1\t3,0\ttap\n\t0,2\t4,0\n";
        let found = number_columns(text).unwrap();
        let heads: Vec<_> = found
            .iter()
            .map(|of| (of.name.as_str(), of.unit.as_str(), &of.numbers[..]))
            .collect();
        assert_eq!(
            heads,
            [
                ("X_Value", "s", &[1.0, 1.5][..]),
                ("probe (raw)", "mm", &[0.1, 0.2]),
                ("force", "N", &[3.0, 4.0]),
            ]
        );
        let error = number_columns(&text.replace("\t0,5\n", "\t0,25\n")).unwrap_err();
        assert!(error.to_string().contains("Delta_X 0.25"), "{error}");
        let error = number_columns(&text.replace("\t4,0", "\tb")).unwrap_err();
        assert!(error.to_string().contains("line 11 of"), "{error}");
    }
}
