//! Measured frequencies, and their assignment to computed ones.

use crate::model::scene::{Measured, MeasuredRow, quantity};

use super::FitError;
use super::table::{Table, TableRow, read, wrong};

/// Frequencies measured over speed.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// Person or file from which the data come.
    pub source: String,
    /// One row for each speed.
    pub rows: Vec<Row>,
}

/// Frequencies at one speed.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Rotation speed.
    pub rpm: f64,
    /// Meaning of the columns.
    pub columns: Columns,
    /// Pairs (k, measured frequency in Hz) of the number k of a column, from 0, or of its nodal diameters.
    pub pairs: Vec<(usize, f64)>,
}

/// Meaning of the columns of measured frequencies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Columns {
    /// Frequencies in ascending order; at rest one for each pair of equal frequencies, or two.
    Ranks,
    /// The lowest frequency of each number of nodal diameters, at rest.
    Diameters,
}

/// Largest numbers of rows and of frequencies in a row; larger tables are not measured by a person.
const MAX_ROWS: usize = 1000;
const MAX_COLUMNS: usize = 24;
/// End of the range of speeds for frequencies measured at rest only, because the choice of a basis needs a range.
const LEAST_RPM: f64 = 100.0;
/// Largest frequency in Hz, as in scenes.
const MAX_HZ: f64 = quantity("measured.rows[].frequencies_hz[]").allowed.to;

impl Row {
    /// Pairs the numbers of a row, in ascending order, with the columns that contain a number: the number of the k-th
    /// column is compared with the k-th lowest computed frequency. Numbers are sorted because a spectrum does not
    /// show which waves have crossed. A blank third column means that the third lowest frequency was not measured.
    pub fn new(rpm: f64, columns: &[Option<f64>]) -> Self {
        let places = columns.iter().enumerate().filter(|(_, hz)| hz.is_some());
        let mut numbers: Vec<f64> = columns.iter().copied().flatten().collect();
        numbers.sort_by(f64::total_cmp);
        Row {
            rpm,
            columns: Columns::Ranks,
            pairs: places.map(|(place, _)| place).zip(numbers).collect(),
        }
    }

    /// Pairs (nodal diameters, frequency in Hz), each compared with the lowest mode of so many nodal diameters.
    pub fn by_diameters(rpm: f64, pairs: &[(usize, f64)]) -> Self {
        Row {
            rpm,
            columns: Columns::Diameters,
            pairs: pairs.to_vec(),
        }
    }

    /// Number of columns up to the last one that contains a number.
    pub(super) fn depth(&self) -> usize {
        self.pairs.last().map_or(0, |(place, _)| place + 1)
    }

    /// Number of lowest modes among which those of the row are expected; at rest every wave but the umbrella mode is one of
    /// a pair, and modes with nodal circles may lie below those of many diameters.
    pub(super) fn modes_needed(&self) -> usize {
        match self.columns {
            Columns::Ranks if self.rpm > 0.0 => self.depth(),
            Columns::Ranks => 2 * self.depth(),
            Columns::Diameters => 4 * self.depth(),
        }
    }
}

impl Measurement {
    /// Reads the block `measured` of a scene.
    pub fn of_scene(measured: &Measured) -> Self {
        let row = |row: &MeasuredRow| Row::new(row.rpm, &row.frequencies_hz);
        Measurement {
            source: measured.source.clone(),
            rows: measured.rows.iter().map(row).collect(),
        }
    }

    /// Reads a table with a speed in rpm, followed by frequencies in Hz or blanks, separated by commas,
    /// semicolons, tabs or spaces. A first line of names determines which column is the speed; lines that
    /// begin with # are ignored.
    ///
    /// # Errors
    /// [`FitError::Table`] with line, column and description, and [`FitError::Empty`].
    pub fn from_csv(source: &str, text: &str) -> Result<Self, FitError> {
        let Table {
            rows: typed,
            diameters,
        } = read(text)?;
        let rows: Vec<Row> = typed
            .iter()
            .map(|typed| row(typed, diameters.as_deref()))
            .collect::<Result<_, _>>()?;
        if let Some(beyond) = typed.get(MAX_ROWS) {
            let problem = format!(
                "it is row {} of {}, but at most {MAX_ROWS} are allowed; leave out some speeds",
                MAX_ROWS + 1,
                rows.len()
            );
            return Err(wrong(beyond.line, problem));
        }
        if rows.iter().all(|row| row.pairs.is_empty()) {
            let source_name = source.to_owned();
            return Err(FitError::Empty { source_name });
        }
        Ok(Measurement {
            source: source.to_owned(),
            rows,
        })
    }

    /// The rows up to a speed.
    pub fn up_to(&self, rpm: f64) -> Self {
        let within = self.rows.iter().filter(|row| row.rpm <= rpm);
        Measurement {
            source: self.source.clone(),
            rows: within.cloned().collect(),
        }
    }

    /// Number of frequencies.
    pub fn count(&self) -> usize {
        self.rows.iter().map(|row| row.pairs.len()).sum()
    }

    /// Largest speed.
    pub fn top_rpm(&self) -> f64 {
        self.rows.iter().fold(0.0, |top, row| row.rpm.max(top))
    }

    /// End of a range of speeds that includes the measured ones; slightly above zero for measurements at
    /// rest.
    pub(super) fn end_of_range_rpm(&self) -> f64 {
        match self.top_rpm() {
            rpm if rpm > 0.0 => rpm,
            _ => LEAST_RPM,
        }
    }

    /// The block `measured` of a scene with these data: rows in ascending speed, without empty ones. A scene has its
    /// frequencies in ascending order, so that those by nodal diameters are sorted.
    pub fn as_scene_block(&self) -> Measured {
        let row = |row: &Row| {
            let mut frequencies_hz = vec![None; row.depth()];
            for &(place, hz) in &row.pairs {
                frequencies_hz[place] = Some(hz);
            }
            if row.columns == Columns::Diameters {
                let mut sorted: Vec<f64> = frequencies_hz.iter().copied().flatten().collect();
                sorted.sort_by(f64::total_cmp);
                frequencies_hz = sorted.into_iter().map(Some).collect();
            }
            MeasuredRow {
                rpm: row.rpm,
                frequencies_hz,
            }
        };
        let seen = self.rows.iter().filter(|row| !row.pairs.is_empty());
        let mut rows: Vec<MeasuredRow> = seen.map(row).collect();
        rows.sort_by(|x, y| x.rpm.total_cmp(&y.rpm));
        Measured {
            source: self.source.clone(),
            rows,
        }
    }
}

/// Reads a line of a table whose columns are ascending frequencies, or have the given numbers of nodal diameters.
fn row(typed: &TableRow, diameters: Option<&[usize]>) -> Result<Row, FitError> {
    let number = |(column, text): &(usize, String), most: f64, unit: &str| match text.parse::<f64>()
    {
        Ok(value) if (0.0..=most).contains(&value) => Ok(value),
        _ => Err(wrong(
            typed.line,
            format!(
                "column {column} must be a number between 0 and {most:e} (you gave {text:?}); give it in {unit}"
            ),
        )),
    };
    let Some((speed, frequencies)) = typed.cells.split_first() else {
        let problem = "it has no speed; give it in rpm";
        return Err(wrong(typed.line, problem.into()));
    };
    if frequencies.len() > MAX_COLUMNS {
        let problem = format!(
            "it has {} frequencies, but at most {MAX_COLUMNS} are allowed; leave out the highest",
            frequencies.len()
        );
        return Err(wrong(typed.line, problem));
    }
    const MAX_RPM: f64 = quantity("measured.rows[].rpm").allowed.to;
    let rpm = number(speed, MAX_RPM, "revolutions per minute")?;
    let columns = frequencies
        .iter()
        .map(|cell| match cell.1.as_str() {
            "" => Ok(None),
            _ => number(cell, MAX_HZ, "Hz, or leave it blank").map(Some),
        })
        .collect::<Result<Vec<_>, _>>()?;
    let Some(diameters) = diameters else {
        return Ok(Row::new(rpm, &columns));
    };
    if rpm != 0.0 {
        let problem = "columns by nodal diameters (n0, n1, …) hold frequencies at rest, but its speed is not 0; name \
                       the columns f1, f2, … in ascending order, since rotation splits every pair";
        return Err(wrong(typed.line, problem.into()));
    }
    let pairs: Vec<(usize, f64)> = diameters
        .iter()
        .zip(columns)
        .filter_map(|(diameters, hz)| Some((*diameters, hz?)))
        .collect();
    Ok(Row::by_diameters(rpm, &pairs))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_a_row_are_paired_in_ascending_order_with_the_places_that_hold_one() {
        let text = "rpm,f1,f2,f3,f4\n# seen twice\n0,9,10.5,,43\n2000, 4, 0, 9\n";
        let table = Measurement::from_csv("here", text).unwrap();
        assert_eq!(table.rows[0].pairs, [(0, 9.0), (1, 10.5), (3, 43.0)]);
        assert_eq!(table.rows[1].pairs, [(0, 0.0), (1, 4.0), (2, 9.0)]);
        assert_eq!((table.count(), table.top_rpm()), (6, 2000.0));
        let block = table.as_scene_block();
        let first = [Some(9.0), Some(10.5), None, Some(43.0)];
        assert_eq!(block.rows[0].frequencies_hz, first);
        assert_eq!(Measurement::of_scene(&block), table);
        assert_eq!(table.up_to(1999.0).rows.len(), 1);
    }

    #[test]
    fn what_is_no_number_is_refused_with_its_place() {
        for (text, expected) in [
            ("rpm,f\n0,9\n10,x\n", "line 3"),
            ("0,9\n-5,9\n", "(you gave \"-5\")"),
            ("0,NaN\n", "(you gave \"NaN\")"),
            ("0,inf\n", "(you gave \"inf\")"),
        ] {
            let error = Measurement::from_csv("t", text).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    }
}
