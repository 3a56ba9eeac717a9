//! Charts of what has no report: a scene, records of instruments, and series of saws. Like those of reports they are
//! data, which matplotlib and plotly paint.

use pyo3::prelude::*;
use sawflutter::page::figure::ChartData;

use crate::failure::Failure;

mod records;
mod saw;
mod series;

pub use records::{spectrum_chart, waterfall_chart};
pub use saw::saw_chart;
pub use series::{grid_chart, stiffness_chart};

fn written(chart: &ChartData) -> PyResult<String> {
    Ok(serde_json::to_string(chart).map_err(Failure::from)?)
}
