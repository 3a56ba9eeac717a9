//! Studies of many saws: how manufacturing tolerances and grids of design numbers change the speeds of a saw.
//!
//! A [`Study`] names numbers of a scene and their distributions. Each of its [`Saw`]s is analysed independently; a
//! [`StudyReport`] contains the statistics. [`study()`] keeps all saws in memory; the program writes each to a [`Log`] when it is
//! finished, from which a stopped study is resumed.
//!
//! ```
//! use sawflutter::model::scene::{Accuracy, Scene};
//! use sawflutter::analyses::study::{StudyFile, study};
//!
//! let scene = Scene::paper().edited(|saw| {
//!     saw.accuracy = Accuracy::Draft;
//!     saw.guides.clear();
//! })?;
//! let file = StudyFile::from_json(
//!     r#"{ "name": "Thickness", "saws": 8, "parameters": [{ "path": "blade.thickness_m",
//!          "distribution": { "kind": "tolerance", "plus_minus": 5e-5 } }] }"#,
//! )?;
//! let report = study(scene, file, &|_, _| ())?;
//! // Quantiles are as fine as eight saws allow: 25, 50 and 75 %.
//! let median = report.all.first_critical.quantiles[1].rpm.unwrap();
//! assert!((median / 1476.6 - 1.0).abs() < 0.01, "{median}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub(crate) mod chart;
mod counts;
mod csv;
mod distribution;
mod file;
mod finished_saws;
mod inputs;
mod log;
mod order;
mod outline;
#[cfg(feature = "parquet")]
mod parquet;
mod plan;
mod processor;
mod report;
mod rows;
mod run;
mod saw;
mod sequence;
mod statistics;
mod table;
mod tally;
mod validation;

pub use self::{
    csv::CsvTable,
    inputs::Inputs,
    log::{Log, LogError, read_inputs, rows_of},
    plan::Shard,
    processor::processor,
    rows::Rows,
    table::Table,
    tally::sum_up,
};
pub use file::{
    DistributionFile, GapFile, ParameterFile, StudyError, StudyFile, StudyLimits, json_schema,
};
#[doc(hidden)]
pub(crate) use outline::{accuracy_of_saws, outline};
#[cfg(feature = "parquet")]
#[doc(hidden)]
pub use parquet::ParquetTable;
pub use plan::Study;
pub use report::{
    GapStatistics, GridNumber, Group, Histogram, LimitStatistics, NumberQuantile, NumberStatistics,
    Passing, Quantile, Refusal, Reliability, ReliabilityPoint, SpeedStatistics, StudyReport,
    WorstSaw,
};
pub use saw::{Found, Outcome, Saw};
pub(crate) use validation::check_varies;

use crate::model::scene::Scene;
use crate::modes::branches::Progress;

/// Analyses the saws of a study on all threads, in memory, and returns their statistics.
///
/// # Errors
/// [`StudyError`] that names the key, what is allowed and what to do.
pub fn study(
    scene: Scene,
    file: StudyFile,
    progress: Progress<'_>,
) -> Result<StudyReport, StudyError> {
    let study = Study::new(scene, file)?;
    let count = study.count();
    let saws = study.saws(&|done| progress(done.len(), count));
    Ok(study.report(&saws)?)
}
