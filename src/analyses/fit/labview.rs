//! Header of a LabVIEW measurement file (.lvm). Its fields are those of the columns at the same places.

use super::FitError;
use super::columns::NumberColumn;
use super::table::{Separator, wrong};

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

    /// Unit of a column without one in its title.
    pub(super) fn unit(&self, name: &str, column: usize) -> &'a str {
        if name == ABSCISSA {
            return self.unit_of_abscissa();
        }
        self.field("Y_Unit_Label", column).unwrap_or_default()
    }

    fn unit_of_abscissa(&self) -> &'a str {
        match self.field("X_Dimension", 1) {
            None | Some("Time") => "s",
            Some("Frequency") => "Hz",
            Some(other) => other,
        }
    }

    /// Abscissas of rows that the file does not contain, from their first value and step; `None` if it states neither.
    pub(super) fn abscissa(
        &self,
        columns: &[NumberColumn],
    ) -> Result<Option<NumberColumn>, FitError> {
        let fields = |tag| self.header.iter().rev().find(|row| row[0] == tag);
        let steps = fields("Delta_X").map_or(&[][..], |row| &row[1..]);
        let number = |field: &str| field.replace(',', ".").parse::<f64>().ok();
        let mut known = steps.iter().filter(|step| !step.is_empty());
        let Some(step) = known.next() else {
            return Ok(None);
        };
        if columns.iter().any(|column| column.name == ABSCISSA) {
            return Ok(None);
        }
        if let Some(other) = known.find(|other| *other != step) {
            let problem = format!("Delta_X is {step} and {other}; export channels of one rate");
            return Err(wrong(1, problem));
        }
        let Some(step) = number(step) else {
            return Err(wrong(
                1,
                format!("Delta_X must be a number (you gave '{step}'); correct it"),
            ));
        };
        let first = self.field("X0", 1).and_then(number).unwrap_or_default();
        let count = columns.first().map_or(0, |column| column.numbers.len());
        Ok(Some(NumberColumn {
            name: ABSCISSA.to_owned(),
            unit: self.unit_of_abscissa().to_owned(),
            numbers: (0..count).map(|row| first + step * row as f64).collect(),
        }))
    }
}
