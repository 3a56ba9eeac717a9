//! A column of numbers of a table.

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
