//! A table of an outline.

use super::value::{Measure, Value};

/// Number of rows that a text shows; a table in a page has all.
const ROWS: usize = 12;

/// A table with a title, heads and rows.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "page", derive(serde::Serialize))]
pub struct Table {
    pub title: String,
    pub columns: Vec<Column>,
    pub rows: Vec<Row>,
    /// Number of rows that a text shows.
    #[cfg_attr(feature = "page", serde(skip))]
    pub shown: usize,
    /// File with all rows.
    #[cfg_attr(feature = "page", serde(skip))]
    pub file: &'static str,
}

/// Head of a column.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "page", derive(serde::Serialize))]
pub struct Column {
    /// What this column and its neighbours have in common; empty for most.
    pub group: &'static str,
    pub name: String,
    pub unit: &'static str,
}

/// A row, and a remark on it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "page", derive(serde::Serialize))]
pub struct Row {
    pub cells: Vec<Value>,
    pub remark: Option<String>,
}

impl Column {
    /// A column of numbers.
    pub fn of(name: impl Into<String>, measure: &'static Measure) -> Self {
        Column {
            group: "",
            name: name.into(),
            unit: measure.unit,
        }
    }

    /// A column of words.
    pub fn words(name: impl Into<String>) -> Self {
        Column {
            group: "",
            name: name.into(),
            unit: "",
        }
    }

    /// The column of words with the unit of the numbers in them.
    pub fn in_unit(self, unit: &'static str) -> Self {
        Column { unit, ..self }
    }

    /// The column as one of a group.
    pub fn in_group(self, group: &'static str) -> Self {
        Column { group, ..self }
    }
}

impl Table {
    pub fn new(title: impl Into<String>, columns: impl IntoIterator<Item = Column>) -> Self {
        Table {
            title: title.into(),
            columns: columns.into_iter().collect(),
            rows: Vec::new(),
            shown: ROWS,
            file: "",
        }
    }

    /// The table with the file that has the rows that a text does not show.
    pub fn in_file(self, file: &'static str) -> Self {
        Table { file, ..self }
    }

    /// The table of which a text shows a number of rows.
    pub fn showing(self, shown: usize) -> Self {
        Table { shown, ..self }
    }

    pub fn row(&mut self, cells: impl IntoIterator<Item = Value>) {
        self.row_with(cells, None);
    }

    pub fn row_with(&mut self, cells: impl IntoIterator<Item = Value>, remark: Option<String>) {
        let cells = cells.into_iter().collect();
        self.rows.push(Row { cells, remark });
    }

    /// The table with rows.
    pub fn with_rows<const N: usize>(mut self, rows: impl IntoIterator<Item = [Value; N]>) -> Self {
        rows.into_iter().for_each(|cells| self.row(cells));
        self
    }
}
