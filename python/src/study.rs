//! Many saws: computed here or on other machines, logged in a folder, summed up.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use sawflutter::figure;
use sawflutter::study::{self, Log, Saw, Shard, StudyFile, StudyReport, finished_in};

use crate::arguments;
use crate::failure::Failure;
use crate::watch::compute;

/// A study of a scene, both given as JSON.
#[pyclass(frozen, module = "sawflutter._native")]
pub struct Study(Arc<study::Study>);

#[pymethods]
impl Study {
    #[new]
    fn new(py: Python<'_>, scene: &str, study: &str) -> PyResult<Self> {
        let scene = arguments::scene(scene)?;
        let file = StudyFile::from_json(study).map_err(Failure::from)?;
        // Without an end of the sweep, the saw of the scene itself is analysed for one.
        let study = compute(py, None, move |_| Ok(study::Study::new(scene, file)?))?;
        Ok(Study(Arc::new(study)))
    }

    /// Number of saws.
    #[getter]
    fn count(&self) -> usize {
        self.0.count()
    }

    /// Values of the numbers that vary, of one saw.
    fn values(&self, index: usize) -> PyResult<Vec<f64>> {
        let saws = self.0.count();
        if index < saws {
            return Ok(self.0.values(index));
        }
        let (allowed, remedy) = (format!("below {saws}"), "saws are numbered from 0");
        Err(Failure::argument("index", index, allowed, remedy).into())
    }

    /// Analyses saws; each as JSON, in their order.
    #[pyo3(signature = (indices, *, progress=None))]
    fn saws(
        &self,
        py: Python<'_>,
        indices: Vec<usize>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Vec<String>> {
        if let Some(last) = indices.iter().max() {
            self.values(*last)?;
        }
        let study = self.0.clone();
        compute(py, progress, move |meter| {
            let found = Mutex::new(Vec::new());
            study::run(&study, &indices, &|saw| {
                let mut found = found.lock().unwrap_or_else(PoisonError::into_inner);
                found.push(saw);
                meter.show(found.len(), indices.len());
                stopped()
            })?;
            let mut found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
            let place = |saw: &Saw| indices.iter().position(|index| *index == saw.index);
            found.sort_by_key(place);
            let lines = found.iter().map(serde_json::to_string);
            Ok(lines.collect::<Result<_, _>>()?)
        })
    }

    /// Numbers of the saws that the logs of a folder do not have.
    fn missing(&self, folder: PathBuf) -> PyResult<Vec<usize>> {
        let finished = finished_in(&folder, &self.0).map_err(Failure::from)?;
        let missing = finished.iter().enumerate().filter(|(_, saw)| saw.is_none());
        Ok(missing.map(|(index, _)| index).collect())
    }

    /// Analyses the saws that a folder does not have, each logged there as soon as it is done.
    #[pyo3(signature = (folder, *, progress=None))]
    fn run(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let missing = self.missing(folder.clone())?;
        let path = folder.join(Log::name(Shard::WHOLE));
        let (log, _) = Log::open(&path, &self.0).map_err(Failure::from)?;
        let study = self.0.clone();
        compute(py, progress, move |meter| {
            let done = AtomicUsize::new(study.count() - missing.len());
            let log = Mutex::new(log);
            study::run(&study, &missing, &|saw| {
                // A saw that was stopped half-way is none.
                stopped()?;
                let mut log = log.lock().unwrap_or_else(PoisonError::into_inner);
                log.append(&study, &saw)?;
                meter.show(done.fetch_add(1, Ordering::Relaxed) + 1, study.count());
                Ok(())
            })
        })
    }

    /// The log of a folder, for saws that others have computed.
    fn log(&self, folder: PathBuf) -> PyResult<StudyLog> {
        let path = folder.join(Log::name(Shard::WHOLE));
        let (log, _) = Log::open(&path, &self.0).map_err(Failure::from)?;
        Ok(StudyLog {
            study: self.0.clone(),
            log: Mutex::new(log),
        })
    }

    /// What the program writes of the saws in a folder, by the names of the files.
    fn files<'py>(
        &self,
        py: Python<'py>,
        folder: PathBuf,
    ) -> PyResult<Vec<(&'static str, Bound<'py, PyBytes>)>> {
        let files = py.detach(|| self.summed_up(folder))?;
        let files = files.into_iter();
        Ok(files
            .map(|(name, b)| (name, PyBytes::new(py, &b)))
            .collect())
    }
}

impl Study {
    fn summed_up(&self, folder: PathBuf) -> Result<Vec<(&'static str, Vec<u8>)>, Failure> {
        let study = &self.0;
        let finished = finished_in(&folder, study)?;
        let saws: Vec<Saw> = finished.into_iter().flatten().collect();
        if saws.len() < study.count() {
            let value = format!("{} of {} saws", saws.len(), study.count());
            let remedy = "run the study again, it goes on where it was";
            let allowed = "a folder with all of them".to_owned();
            return Err(Failure::argument("folder", value, allowed, remedy));
        }
        let report = StudyReport::new(study, &saws);
        let table = |error: &dyn std::error::Error| Failure::Failed(error.to_string());
        Ok(vec![
            ("study.png", figure::study_png(&report)?),
            ("study.svg", figure::study_svg(&report)?.into_bytes()),
            (
                "study.parquet",
                study::parquet(study, &saws).map_err(|e| table(&e))?,
            ),
            (
                "study.csv",
                study::csv(study, &saws).map_err(|e| table(&e))?,
            ),
            (
                "study.json",
                serde_json::to_string_pretty(&report)?.into_bytes(),
            ),
        ])
    }
}

/// A log that saws are added to. No other run can write to it at the same time.
#[pyclass(frozen, module = "sawflutter._native")]
pub struct StudyLog {
    study: Arc<study::Study>,
    log: Mutex<Log>,
}

#[pymethods]
impl StudyLog {
    /// Adds saws, each as the JSON that `Study.saws` gives.
    fn append(&self, saws: Vec<String>) -> PyResult<()> {
        let mut log = self.log.lock().unwrap_or_else(PoisonError::into_inner);
        for saw in saws {
            let saw: Saw = serde_json::from_str(&saw).map_err(Failure::from)?;
            log.append(&self.study, &saw).map_err(Failure::from)?;
        }
        Ok(())
    }
}

/// An error once the computation of this thread was stopped.
fn stopped() -> Result<(), Failure> {
    Ok(sawflutter::spectrum::Cancellation::current().check()?)
}
