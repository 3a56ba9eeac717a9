//! Makes tables and statistics from the logs, in one pass and bounded memory.

use std::path::Path;

use super::log::LogError;
use super::report::StudyReport;
use super::rows::Rows;
use super::table::Table;
use super::tally::Tally;

/// Writes the tables of all saws and returns their statistics. Temporary files are in `folder` and are
/// removed.
///
/// # Errors
/// [`LogError`] where a log cannot be read or a table cannot be written.
pub fn sum_up(
    rows: &Rows<'_>,
    folder: &Path,
    mut tables: Vec<Box<dyn Table + '_>>,
) -> Result<StudyReport, LogError> {
    let mut tally = Tally::new(rows.study(), folder);
    rows.each_block(&mut |saws| {
        for saw in saws {
            tally.add(saw).map_err(LogError::Tables)?;
        }
        let mut tables = tables.iter_mut();
        tables
            .try_for_each(|table| table.add(saws))
            .map_err(LogError::Tables)
    })?;
    for table in tables {
        table.finish().map_err(LogError::Tables)?;
    }
    let processors = rows.processors().cloned().collect();
    tally.report(processors).map_err(LogError::Tables)
}
