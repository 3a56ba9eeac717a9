//! Many saws: computed here or on other machines, logged in a folder, and summarized.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use sawflutter::analyses::commands::CommandReport;
use sawflutter::analyses::door::CommandError;
use sawflutter::analyses::study::{
    self, CsvTable, Log, LogError, Outcome, ParquetTable, Rows, Saw, Shard, StudyFile, Table,
};
use sawflutter::model::scene::rpm;

use crate::arguments;
use crate::beside::study_of;
use crate::commands::json;
use crate::failure::Failure;
use crate::watch::{compute, lock};

/// A study of a scene, both given as JSON.
#[pyclass(frozen, module = "sawflutter._native")]
pub struct Study(Arc<study::Study>);

#[pymethods]
impl Study {
    #[new]
    fn new(py: Python<'_>, scene: &str, study: &str) -> PyResult<Self> {
        let scene = arguments::scene(scene)?;
        let file = StudyFile::from_json(study).map_err(Failure::from)?;
        // Without an end of the sweep, the saw of the scene itself determines it.
        let study = compute(py, None, move |_| Ok(study::Study::new(scene, file)?))?;
        Ok(Study(Arc::new(study)))
    }

    /// Number of saws.
    #[getter]
    fn count(&self) -> usize {
        self.0.count()
    }

    /// Values of the varied numbers of one saw.
    fn values(&self, index: usize) -> PyResult<Vec<f64>> {
        let saws = self.0.count();
        if index < saws {
            return Ok(self.0.values(index));
        }
        let (allowed, remedy) = (format!("below {saws}"), "saws are numbered from 0");
        Err(Failure::argument("index", index, allowed, remedy).into())
    }

    /// Analyses the saws from one up to another, which is not among them, on a thread of its own, and gives their rows
    /// in the format of a log.
    fn rows<'py>(
        &self,
        py: Python<'py>,
        first: usize,
        last: usize,
    ) -> PyResult<Bound<'py, PyBytes>> {
        if first >= last || last > self.0.count() {
            let allowed = format!("within 0 and {}", self.0.count());
            let value = format!("from {first} up to {last}");
            let remedy = "saws are numbered from 0, and the last one is not computed";
            return Err(Failure::argument("saws", value, allowed, remedy).into());
        }
        let study = self.0.clone();
        let rows = compute(py, None, move |_| {
            let saws = Mutex::<Vec<Saw>>::default();
            study.run(Some(1), first..last, &|saw| {
                // A saw whose computation was stopped has no row.
                stopped()?;
                lock(&saws).push(saw);
                Ok::<(), Failure>(())
            })?;
            Ok(study::rows_of(&study, &lock(&saws)))
        })?;
        Ok(PyBytes::new(py, &rows))
    }

    /// The row of a saw that could not be analysed, for this reason.
    fn failed<'py>(
        &self,
        py: Python<'py>,
        index: usize,
        reason: &str,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let saw = Saw {
            index,
            values: self.values(index)?,
            outcome: Outcome::failed(reason),
        };
        Ok(PyBytes::new(py, &study::rows_of(&self.0, &[saw])))
    }

    /// Analyses the saws that the folder lacks, and logs each as soon as it is finished.
    #[pyo3(signature = (folder, *, progress=None))]
    fn run(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let study = self.0.clone();
        compute(py, progress, move |meter| {
            let mut log = Log::open(&folder, Shard::WHOLE, &study)?;
            if log.finished().done() == study.count() {
                return Ok(());
            }
            log.append_processor(&study::processor())?;
            let missing = log.finished().clone().into_missing();
            let shared_log = Mutex::new(log);
            study.run(None, missing, &|saw| {
                // A saw whose computation was stopped has no row.
                stopped()?;
                let mut log = lock(&shared_log);
                log.append(&study, &saw)?;
                meter.show(log.finished().done(), study.count());
                Ok(())
            })
        })
    }

    /// The log of a folder, for rows that are computed elsewhere.
    fn log(&self, py: Python<'_>, folder: PathBuf) -> PyResult<StudyLog> {
        let log = py.detach(|| Log::open(&folder, Shard::WHOLE, &self.0));
        Ok(StudyLog {
            study: self.0.clone(),
            log: Mutex::new(Some(log.map_err(Failure::from)?)),
        })
    }

    /// Writes the tables of the saws in a folder to files, and gives the other files of the program by their names, the
    /// report last.
    fn sum_up<'py>(
        &self,
        py: Python<'py>,
        folder: PathBuf,
        csv: PathBuf,
        parquet: PathBuf,
    ) -> PyResult<Vec<(&'static str, Bound<'py, PyBytes>)>> {
        let files = py
            .detach(|| self.summed_up(&folder, &csv, &parquet))?
            .into_iter();
        Ok(files
            .map(|(name, b)| (name, PyBytes::new(py, &b)))
            .collect())
    }
}

impl Study {
    fn summed_up(
        &self,
        folder: &Path,
        csv: &Path,
        parquet: &Path,
    ) -> Result<Vec<(&'static str, Vec<u8>)>, Failure> {
        let study = &self.0;
        let rows = Rows::in_folder(study, folder)?;
        let done = rows.finished().done();
        if done < study.count() {
            let value = format!("{done} of {} saws", study.count());
            let remedy = "run the study again, it goes on where it was";
            let allowed = "a folder with all of them".to_owned();
            return Err(Failure::argument("folder", value, allowed, remedy));
        }
        let create = |path: &Path| File::create(path).map(BufWriter::new);
        let open_tables = || -> std::io::Result<Vec<Box<dyn Table + '_>>> {
            Ok(vec![
                Box::new(CsvTable::new(study, create(csv)?)?),
                Box::new(ParquetTable::new(study, create(parquet)?)?),
            ])
        };
        let tables = open_tables().map_err(LogError::Tables)?;
        let report = study::sum_up(&rows, folder, tables)?;
        let mut files = Vec::new();
        for figure in report.figures() {
            let [png, svg] = figure.names();
            files.push((png, figure.png()?));
            files.push((svg, figure.svg()?.into_bytes()));
        }
        let json = serde_json::to_string_pretty(&report)?;
        files.push((study::StudyReport::COMMAND.file, json.into_bytes()));
        Ok(files)
    }
}

/// Critical speeds, flutter speed and bands of a scene, as JSON, and the last speed in rpm; if another scene is given, on a
/// basis that is at least as large as that of the other one, and up to its last speed.
#[pyfunction]
pub fn speeds(py: Python<'_>, scene: &str, beside: Option<String>) -> PyResult<(String, f64)> {
    let scene = arguments::scene(scene)?;
    compute(py, None, move |_| {
        let (study, found) = match beside {
            None => {
                let study = Arc::new(study::Study::of_one(scene)?);
                let found = study.own_speeds();
                (study, found)
            }
            Some(text) => {
                let study = study_of(&text)?;
                let found = study.speeds(&scene);
                (study, found)
            }
        };
        let text = json(&found.map_err(CommandError::from)?)?;
        Ok((text, rpm(study.to_rad_per_s())))
    })
}

/// The type of this machine's processor.
#[pyfunction]
pub fn processor() -> String {
    study::processor()
}

/// A log that rows are added to. No other run can write to it at the same time.
#[pyclass(frozen, module = "sawflutter._native")]
pub struct StudyLog {
    study: Arc<study::Study>,
    /// The value is none after the log was closed.
    log: Mutex<Option<Log>>,
}

#[pymethods]
impl StudyLog {
    /// Number of saws that are finished.
    #[getter]
    fn done(&self) -> PyResult<usize> {
        Ok(self.with(|log| Ok(log.finished().done()))?)
    }

    /// The first missing saws from a number on, at most `most`; none after the last saw.
    fn missing(&self, first: usize, most: usize) -> PyResult<Option<(usize, usize)>> {
        let range = self.with(|log| Ok(log.finished().missing(first, most)))?;
        Ok(range.map(|range| (range.start, range.end)))
    }

    /// Adds rows of `Study.rows`, except those of finished saws, and gives the number of new rows.
    fn append(&self, py: Python<'_>, rows: &[u8]) -> PyResult<usize> {
        let append = |log: &mut Log| Ok(log.append_rows(&self.study, rows)?);
        Ok(py.detach(|| self.with(append))?)
    }

    /// Logs the type of processor that computed rows.
    fn append_processor(&self, name: &str) -> PyResult<()> {
        Ok(self.with(|log| Ok(log.append_processor(name)?))?)
    }

    /// Closes the log, so that other runs can open it.
    fn close(&self) {
        lock(&self.log).take();
    }
}

impl StudyLog {
    fn with<T>(&self, work: impl FnOnce(&mut Log) -> Result<T, Failure>) -> Result<T, Failure> {
        match lock(&self.log).as_mut() {
            Some(log) => work(log),
            None => Err(Failure::Failed("the log is closed".into())),
        }
    }
}

/// Gives an error if the computation of this thread was stopped.
fn stopped() -> Result<(), Failure> {
    Ok(sawflutter::modes::Cancellation::current().check()?)
}
