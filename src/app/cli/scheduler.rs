//! `sawflutter study --scheduler`: the saws of a study on a cluster of Dask, through the Python
//! package of this program.

use std::path::Path;

use crate::analyses::study::{Inputs, Study};

use super::python::Need;

const NEED: Need = Need {
    of: "--scheduler",
    beside: "Dask",
    modules: "distributed",
    extras: "dask",
    runs: "sawflutter._scheduler",
};

/// Computes the saws that the log of a folder lacks.
pub fn compute(study: &Study, folder: &Path, address: &str) -> anyhow::Result<()> {
    let inputs = serde_json::to_string(&Inputs::of(study))?;
    NEED.answer(&[address, &folder.to_string_lossy()], &inputs)?;
    Ok(())
}
