//! Studies of many saws: how manufacturing tolerances and grids of design numbers change the speeds of a saw.
//!
//! A [`Study`] names numbers of a scene and their distributions. Each of its [`Saw`]s is analysed
//! independently and written to a [`Log`] when it is finished; a [`StudyReport`] contains the statistics.
//!
//! ```
//! use sawflutter::scene::{Accuracy, Scene};
//! use sawflutter::study::{Study, StudyFile, StudyReport};
//!
//! let scene = Scene::paper().edited(|saw| {
//!     saw.accuracy = Accuracy::Draft;
//!     saw.guides.clear();
//! })?;
//! let study = StudyFile::from_json(
//!     r#"{ "name": "Thickness", "saws": 8, "parameters": [{ "path": "blade.thickness_m",
//!          "distribution": { "kind": "tolerance", "plus_minus": 5e-5 } }] }"#,
//! )?;
//! let study = Study::new(scene, study)?;
//! let saws: Vec<_> = (0..study.count()).map(|index| study.saw(index)).collect();
//! let report = StudyReport::new(&study, &saws)?;
//! let median = report.all.lowest_critical.quantiles[3].rpm.unwrap();
//! assert!((median / 1476.6 - 1.0).abs() < 0.01, "{median}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod counts;
mod csv;
mod distribution;
mod file;
mod finished;
mod inputs;
mod log;
mod order;
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
mod sum;
mod table;
mod tally;

#[doc(hidden)]
pub use csv::CsvTable;
pub use file::{DistributionFile, GapFile, ParameterFile, StudyError, StudyFile, json_schema};
#[doc(hidden)]
pub use inputs::Inputs;
#[doc(hidden)]
pub use log::{Log, LogError, read_inputs, rows_of};
#[doc(hidden)]
#[cfg(feature = "parquet")]
pub use parquet::ParquetTable;
#[doc(hidden)]
pub use plan::Shard;
pub use plan::Study;
#[doc(hidden)]
pub use processor::processor;
pub use report::{
    CriterionEntry, GapStatistics, GridEntry, Group, Histogram, NumberEntry, NumberQuantile,
    Passing, Quantile, Refusal, Reliability, ReliabilityPoint, SpeedEntry, StudyReport, WorstSaw,
};
#[doc(hidden)]
pub use rows::Rows;
pub use saw::{Found, FoundBand, Outcome, Saw};
#[doc(hidden)]
pub use sum::sum_up;
#[doc(hidden)]
pub use table::Table;
