//! The log of a study: every finished saw, so that a run that was stopped goes on where it was.
//!
//! The first line is what the saws belong to ([`Inputs`]), the second names the columns, and
//! each further one is a saw, written in one piece when it is done. A line without its end was
//! cut off by what stopped the run, and counts for nothing.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::csv::{columns, record, saw};
use super::inputs::Inputs;
use super::plan::{Shard, Study};
use super::saw::Saw;

/// Saws that a machine that loses its power may lose.
const UNSYNCED: Duration = Duration::from_secs(1);

/// Why a log was refused.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The system refused to read or write.
    #[error("cannot use the log {}: {source}", path.display())]
    Io {
        /// The log.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// Another run is writing to it.
    #[error(
        "another run is writing to {}; wait for it, or name another folder with --out",
        path.display()
    )]
    Busy {
        /// The log.
        path: PathBuf,
    },
    /// It was begun with other inputs.
    #[error(
        "{} belongs to another study: {difference}; name another folder with --out, or remove this log and its saws",
        path.display()
    )]
    Other {
        /// The log.
        path: PathBuf,
        /// Key and values that differ.
        difference: String,
    },
    /// It is no log of this program.
    #[error("{} is no log of a study; name another folder with --out", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
    },
}

/// A log that is written to. No other run can write to it at the same time.
#[derive(Debug)]
pub struct Log {
    file: File,
    path: PathBuf,
    synced: Instant,
}

impl Log {
    /// Name of the log of a part of a study.
    pub fn name(shard: Shard) -> String {
        match shard {
            Shard::WHOLE => "study.log".into(),
            Shard { number, of } => format!("study-{number}-of-{of}.log"),
        }
    }

    /// Every log in a folder, by name.
    ///
    /// # Errors
    /// [`LogError::Io`] where the folder cannot be read.
    pub fn all_in(folder: &Path) -> Result<Vec<PathBuf>, LogError> {
        let entries = std::fs::read_dir(folder).map_err(io(folder))?;
        let mut logs = Vec::new();
        for entry in entries {
            let entry = entry.map_err(io(folder))?;
            let name = entry.file_name().to_string_lossy().into_owned();
            if name == Self::name(Shard::WHOLE) || is_shard(&name) {
                logs.push(entry.path());
            }
        }
        logs.sort();
        Ok(logs)
    }

    /// Opens a log, or begins it, and reads the saws in it.
    ///
    /// # Errors
    /// [`LogError`] where it belongs to another study, or another run writes to it.
    pub fn open(path: &Path, study: &Study) -> Result<(Self, Vec<Saw>), LogError> {
        let mut options = OpenOptions::new();
        options.read(true).write(true).create(true).truncate(false);
        let mut file = options.open(path).map_err(io(path))?;
        // Where files cannot be locked, runs are not told apart.
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(LogError::Busy {
                path: path.to_owned(),
            });
        }
        let mut text = Vec::new();
        file.read_to_end(&mut text).map_err(io(path))?;
        let header = header(study);
        let saws = parse(path, &text, study)?;
        let end = if header.as_bytes().starts_with(&text) {
            // New, or stopped before it was begun in earnest.
            file.set_len(0).map_err(io(path))?;
            file.rewind().map_err(io(path))?;
            file.write_all(header.as_bytes()).map_err(io(path))?;
            file.sync_all().map_err(io(path))?;
            header.len()
        } else {
            let whole = text.iter().rposition(|byte| *byte == b'\n');
            whole.map_or(0, |k| k + 1)
        };
        file.set_len(end as u64).map_err(io(path))?;
        file.seek(SeekFrom::End(0)).map_err(io(path))?;
        let log = Log {
            file,
            path: path.to_owned(),
            synced: Instant::now(),
        };
        Ok((log, saws))
    }

    /// Adds a saw.
    ///
    /// # Errors
    /// [`LogError::Io`].
    pub fn append(&mut self, study: &Study, saw: &Saw) -> Result<(), LogError> {
        let line = line(&record(study, saw));
        let written = self.file.write_all(&line).and_then(|()| {
            if self.synced.elapsed() > UNSYNCED {
                self.file.sync_data()?;
                self.synced = Instant::now();
            }
            Ok(())
        });
        written.map_err(io(&self.path))
    }
}

/// The saws of a study that the logs of a folder have, each at its number.
///
/// # Errors
/// [`LogError`] where the folder cannot be read or a log belongs to another study.
pub fn finished_in(folder: &Path, study: &Study) -> Result<Vec<Option<Saw>>, LogError> {
    let mut finished = vec![None; study.count()];
    for path in Log::all_in(folder)? {
        keep(&mut finished, read_log(&path, study)?);
    }
    Ok(finished)
}

/// Puts saws in their places, where there is none yet.
pub fn keep(finished: &mut [Option<Saw>], saws: Vec<Saw>) {
    for saw in saws {
        let index = saw.index;
        finished[index].get_or_insert(saw);
    }
}

/// The saws in a log that is only read.
///
/// # Errors
/// [`LogError`] where it belongs to another study.
pub fn read_log(path: &Path, study: &Study) -> Result<Vec<Saw>, LogError> {
    parse(path, &std::fs::read(path).map_err(io(path))?, study)
}

/// What a log belongs to.
///
/// # Errors
/// [`LogError`] where it is none.
pub fn read_inputs(path: &Path) -> Result<Inputs, LogError> {
    let text = std::fs::read(path).map_err(io(path))?;
    inputs(&text).ok_or_else(|| LogError::Foreign {
        path: path.to_owned(),
    })
}

fn io(path: &Path) -> impl Fn(std::io::Error) -> LogError {
    move |source| LogError::Io {
        path: path.to_owned(),
        source,
    }
}

fn is_shard(name: &str) -> bool {
    let numbers = name.strip_prefix("study-").and_then(|rest| {
        let (number, of) = rest.strip_suffix(".log")?.split_once("-of-")?;
        Some((number.parse::<usize>().ok()?, of.parse::<usize>().ok()?))
    });
    numbers.is_some()
}

fn header(study: &Study) -> String {
    let inputs = serde_json::to_string(&Inputs::of(study));
    let inputs = inputs.expect("keys are strings, and numbers of a scene finite");
    let names = line(&columns(study));
    format!("{inputs}\n{}", String::from_utf8_lossy(&names))
}

fn inputs(text: &[u8]) -> Option<Inputs> {
    let end = text.iter().position(|byte| *byte == b'\n')?;
    serde_json::from_slice(&text[..end]).ok()
}

/// One line of comma-separated values, with its end.
fn line(cells: &[String]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing to memory cannot fail.
    let _ = writer.write_record(cells);
    writer.into_inner().unwrap_or_default()
}

fn parse(path: &Path, text: &[u8], study: &Study) -> Result<Vec<Saw>, LogError> {
    let header = header(study);
    if header.as_bytes().starts_with(text) {
        return Ok(Vec::new());
    }
    let Some(rows) = text.strip_prefix(header.as_bytes()) else {
        let difference = inputs(text).map(|there| {
            let differs = there.difference(&Inputs::of(study));
            differs.unwrap_or_else(|| "its columns are others".into())
        });
        let path = path.to_owned();
        return Err(match difference {
            Some(difference) => LogError::Other { path, difference },
            None => LogError::Foreign { path },
        });
    };
    let lines = rows.split_inclusive(|byte| *byte == b'\n');
    Ok(lines.filter_map(|line| row(line, study)).collect())
}

/// The saw of a whole line; a line that a broken disk has changed is computed again.
fn row(line: &[u8], study: &Study) -> Option<Saw> {
    line.ends_with(b"\n").then_some(())?;
    let mut reader = csv::ReaderBuilder::new();
    let mut reader = reader.has_headers(false).from_reader(line);
    let mut record = csv::StringRecord::new();
    reader.read_record(&mut record).ok()?;
    let saw = saw(study, &record)?;
    (saw.values == study.values(saw.index)).then_some(saw)
}
