//! Measured frequencies, and their assignment to computed ones.

use crate::model::scene::{Measured, MeasuredRow, quantity};

use super::FitError;
use super::cells::wrong;
use super::table::{Others, Table, TableRow, read};

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
pub(super) const MAX_HZ: f64 = quantity("measured.rows[].frequencies_hz[]").allowed.to;
/// Largest speed in rpm, as in scenes.
pub(super) const MAX_RPM: f64 = quantity("measured.rows[].rpm").allowed.to;

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

    /// Number of lowest modes among which those of the row are expected. At rest every wave but the umbrella mode is one of
    /// a pair. A nodal circle raises a frequency about as much as two diameters (Chladni's law), so that n²/2 modes are
    /// below that of n diameters.
    pub(super) fn modes_needed(&self) -> usize {
        match self.columns {
            Columns::Ranks if self.rpm > 0.0 => self.depth(),
            Columns::Ranks => 2 * self.depth(),
            Columns::Diameters => (self.most_diameters() + 3).pow(2),
        }
    }

    /// Largest number of nodal diameters by which a frequency is named.
    fn most_diameters(&self) -> usize {
        let named = self.pairs.iter().map(|(diameters, _)| *diameters);
        match self.columns {
            Columns::Ranks => 0,
            Columns::Diameters => named.max().unwrap_or(0),
        }
    }
}

impl Measurement {
    /// Reads the block `measured` of a scene.
    pub fn of_scene(measured: &Measured) -> Self {
        let row = |row: &MeasuredRow| match &row.diameters {
            None => Row::new(row.rpm, &row.frequencies_hz),
            Some(diameters) => {
                let named = diameters.iter().zip(&row.frequencies_hz);
                let seen = named.filter_map(|(diameters, hz)| Some((*diameters as usize, (*hz)?)));
                Row::by_diameters(row.rpm, &seen.collect::<Vec<_>>())
            }
        };
        Measurement {
            source: measured.source.clone(),
            rows: measured.rows.iter().map(row).collect(),
        }
    }

    /// Reads a table with a speed in rpm, followed by frequencies in Hz or blanks, separated by commas,
    /// semicolons, tabs or spaces. A line of names determines which column is the speed; comments, which begin with
    /// #, % or *, are ignored.
    ///
    /// # Errors
    /// [`FitError::Table`] with line, column and description, and [`FitError::Empty`].
    pub fn from_csv(source: &str, text: &str) -> Result<Self, FitError> {
        let Table {
            rows: typed,
            diameters,
        } = read(text, Others::Refused)?;
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

    /// Largest number of nodal diameters by which a frequency is named.
    pub(super) fn most_diameters(&self) -> usize {
        self.rows.iter().map(Row::most_diameters).max().unwrap_or(0)
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

    /// The block `measured` of a scene with these data: rows in ascending speed, without empty ones.
    pub fn as_scene_block(&self) -> Measured {
        let row = |row: &Row| match row.columns {
            Columns::Ranks => {
                let mut frequencies_hz = vec![None; row.depth()];
                for &(place, hz) in &row.pairs {
                    frequencies_hz[place] = Some(hz);
                }
                MeasuredRow {
                    rpm: row.rpm,
                    diameters: None,
                    frequencies_hz,
                }
            }
            Columns::Diameters => MeasuredRow {
                rpm: row.rpm,
                diameters: Some(row.pairs.iter().map(|(n, _)| *n as u32).collect()),
                frequencies_hz: row.pairs.iter().map(|(_, hz)| Some(*hz)).collect(),
            },
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

/// The number of a cell, from 0 to the largest allowed one.
pub(super) fn number(
    line: u64,
    (column, text): &(usize, String),
    most: f64,
    unit: &str,
) -> Result<f64, FitError> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=most).contains(&value) => Ok(value),
        _ => Err(wrong(
            line,
            format!(
                "column {column} must be a number between 0 and {most:e} (you gave {text:?}); give it in {unit}"
            ),
        )),
    }
}

/// Reads a line of a table whose columns are ascending frequencies, or have the given numbers of nodal diameters.
fn row(typed: &TableRow, diameters: Option<&[usize]>) -> Result<Row, FitError> {
    let number = |cell: &(usize, String), most, unit| number(typed.line, cell, most, unit);
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
    use crate::model::analytical::annular_plate::{AnnularPlate, Bore};

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
    fn a_scene_keeps_the_nodal_diameters_of_a_table() {
        let text = "n2,rpm,n0,n1,n1\n152.6,0,127.1,,124.3\n";
        let table = Measurement::from_csv("taps", text).unwrap();
        assert_eq!(table.rows[0].pairs, [(0, 127.1), (1, 124.3), (2, 152.6)]);
        assert_eq!(Measurement::of_scene(&table.as_scene_block()), table);
    }

    /// A free disc, which has the most circles below a number of diameters, by its exact frequencies.
    #[test]
    fn the_modes_needed_include_those_of_the_named_diameters() {
        let free = AnnularPlate {
            bore: Bore::Free,
            radius_ratio: 0.05,
            poisson_ratio: 0.3,
        };
        for most in [2, 5, 9, 14] {
            // The lowest elastic mode of n = 0 and 1 has a nodal circle.
            let named = free.roots(most, 1)[0];
            let below = |n: usize| {
                free.roots(n, most)
                    .iter()
                    .filter(|root| **root <= named)
                    .count()
            };
            let rigid = 3;
            let modes: usize = rigid + below(0) + (1..=most).map(|n| 2 * below(n)).sum::<usize>();
            let row = Row::by_diameters(0.0, &[(most, 100.0), (0, 40.0)]);
            assert!(row.modes_needed() >= modes, "n = {most}: {modes} modes");
        }
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
