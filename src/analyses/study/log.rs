//! The log of a study: it lists every finished saw, so that a stopped run can be resumed.
//!
//! The first line contains the inputs of the study ([`Inputs`]), the second the names of the columns. Each
//! further line is a saw, written in one piece when it is finished, or the kind of a processor that has
//! computed saws. A last line without line end was truncated when the run stopped, and is ignored.

use std::collections::BTreeSet;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::csv::{columns, record, saw};
use super::finished_saws::Finished;
use super::inputs::Inputs;
use super::plan::{Shard, Study};
use super::saw::Saw;

/// Time after which new lines are forced to the disk; a power failure loses only the lines written within it.
const UNSYNCED: Duration = Duration::from_secs(1);

/// Reason for which a log was refused.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The system could not read or write the log.
    #[error("cannot use the log {}: {source}", path.display())]
    Io {
        /// Path of the log.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// Another run is writing to the log.
    #[error(
        "another run is writing to {}; wait for it, or name another folder",
        path.display()
    )]
    Busy {
        /// Path of the log.
        path: PathBuf,
    },
    /// The log was begun with other inputs.
    #[error(
        "{} belongs to another study: {difference}; name another folder, or remove this log and its saws",
        path.display()
    )]
    Other {
        /// Path of the log.
        path: PathBuf,
        /// Key and values that differ.
        difference: String,
    },
    /// The file is not a log of this program.
    #[error("{} is no log of a study; name another folder", path.display())]
    Foreign {
        /// Path of the file.
        path: PathBuf,
    },
    /// A row does not belong to the study.
    #[error("a row does not belong to this study: {row}")]
    NoRow {
        /// The row.
        row: String,
    },
    /// The tables of the saws cannot be written.
    #[error("cannot write the tables of the saws: {0}")]
    Tables(#[source] std::io::Error),
}

/// Content of a line after the first two.
#[derive(Debug)]
pub(super) enum Line {
    /// A saw.
    Saw(Saw),
    /// Kind of a processor that has computed saws of this log.
    Processor(String),
}

/// Start of a line that names a processor.
const PROCESSOR: &str = "# processor: ";

/// A log open for writing. It is locked against other runs.
#[derive(Debug)]
pub struct Log {
    file: File,
    path: PathBuf,
    synced: Instant,
    finished: Finished,
    processors: BTreeSet<String>,
}

impl Log {
    /// File name of the log of a part of a study.
    pub fn name(shard: Shard) -> String {
        match shard {
            Shard::WHOLE => "study.log".into(),
            Shard { number, of } => format!("study-{number}-of-{of}.log"),
        }
    }

    /// Every log in a folder, sorted by name.
    ///
    /// # Errors
    /// [`LogError::Io`] if the folder cannot be read.
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

    /// Opens or creates the log of a part of a study in a folder. The run of the whole study also reads the
    /// logs of parts; a part reads only its own, because other parts may be running.
    ///
    /// # Errors
    /// [`LogError`] if a log cannot be read or written, belongs to another study, or another run writes to it.
    pub fn open(folder: &Path, shard: Shard, study: &Study) -> Result<Self, LogError> {
        let path = folder.join(Self::name(shard));
        let mut options = OpenOptions::new();
        options.read(true).write(true).create(true).truncate(false);
        let mut file = options.open(&path).map_err(io(&path))?;
        // On file systems without locks simultaneous runs are not detected.
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(LogError::Busy { path });
        }
        let mut finished = Finished::none_of(study.count());
        let mut processors = BTreeSet::new();
        let mut keep = |own: bool, line: Line| match line {
            Line::Saw(saw) => {
                finished.insert(saw.index);
            }
            Line::Processor(name) if own => {
                processors.insert(name);
            }
            Line::Processor(_) => {}
        };
        let end = match scan(&path, &file, study, &mut |_, line| keep(true, line))? {
            Some(end) => end,
            // The log is new, or its run stopped before the header was complete.
            None => begin(&mut file, study).map_err(io(&path))?,
        };
        file.set_len(end).map_err(io(&path))?;
        file.seek(SeekFrom::End(0)).map_err(io(&path))?;
        let others = if shard == Shard::WHOLE {
            Self::all_in(folder)?
        } else {
            Vec::new()
        };
        for other in others.iter().filter(|other| **other != path) {
            read(other, study, &mut |_, line| keep(false, line))?;
        }
        let synced = Instant::now();
        Ok(Log {
            file,
            path,
            synced,
            finished,
            processors,
        })
    }

    /// The finished saws: those in this log and, for the whole study, those in the logs of parts in the same
    /// folder.
    pub fn finished(&self) -> &Finished {
        &self.finished
    }

    /// Adds a saw unless it is in the log already.
    ///
    /// # Errors
    /// [`LogError::Io`] if the line cannot be written, and [`LogError::NoRow`] if the saw does not belong to the study.
    pub fn append(&mut self, study: &Study, saw: &Saw) -> Result<(), LogError> {
        self.append_rows(study, &line(&record(study, saw)))
            .map(|_| ())
    }

    /// Adds rows of saws made by [`rows_of`], without those that are in the log already; returns the number
    /// of added rows.
    ///
    /// # Errors
    /// [`LogError::Io`] if the rows cannot be written; [`LogError::NoRow`] if a row does not belong to this study, and
    /// then no row is added.
    pub fn append_rows(&mut self, study: &Study, rows: &[u8]) -> Result<usize, LogError> {
        let mut saws = Vec::new();
        for line in rows.split_inclusive(|byte| *byte == b'\n') {
            let saw = row(line, study).ok_or_else(|| LogError::NoRow {
                row: String::from_utf8_lossy(line).trim_end().to_owned(),
            })?;
            saws.push((saw.index, line));
        }
        // The same saw may occur twice among the rows.
        let mut seen = BTreeSet::new();
        saws.retain(|(index, _)| !self.finished.has(*index) && seen.insert(*index));
        let lines: Vec<&[u8]> = saws.iter().map(|(_, line)| *line).collect();
        self.append_lines(&lines.concat())?;
        for (index, _) in &saws {
            self.finished.insert(*index);
        }
        Ok(saws.len())
    }

    /// Records the kind of processor that computes saws of this log, once.
    ///
    /// # Errors
    /// [`LogError::Io`] if the line cannot be written.
    pub fn append_processor(&mut self, name: &str) -> Result<(), LogError> {
        let name = name.split_whitespace().collect::<Vec<_>>().join(" ");
        if self.processors.contains(&name) {
            return Ok(());
        }
        self.append_lines(format!("{PROCESSOR}{name}\n").as_bytes())?;
        self.processors.insert(name);
        Ok(())
    }

    /// Appends complete lines.
    fn append_lines(&mut self, lines: &[u8]) -> Result<(), LogError> {
        let written = self.file.write_all(lines).and_then(|()| {
            if self.synced.elapsed() > UNSYNCED {
                self.file.sync_data()?;
                self.synced = Instant::now();
            }
            Ok(())
        });
        written.map_err(io(&self.path))
    }
}

/// Reads the inputs of the study to which a log belongs.
///
/// # Errors
/// [`LogError`] if the file cannot be read or is not a log.
pub fn read_inputs(path: &Path) -> Result<Inputs, LogError> {
    let mut first = Vec::new();
    let file = File::open(path).map_err(io(path))?;
    let mut reader = BufReader::new(file.take(LONGEST_LINE));
    reader.read_until(b'\n', &mut first).map_err(io(path))?;
    let inputs = first
        .ends_with(b"\n")
        .then(|| serde_json::from_slice(&first));
    inputs
        .and_then(Result::ok)
        .ok_or_else(|| LogError::Foreign {
            path: path.to_owned(),
        })
}

/// Largest length of the first line, in bytes; it contains a scene with its tables and is shorter in any log.
const LONGEST_LINE: u64 = 1 << 28;

pub(super) fn io(path: &Path) -> impl Fn(std::io::Error) -> LogError {
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
    let inputs = serde_json::to_string(&Inputs::of(study))
        .expect("keys are strings, and numbers of a scene finite");
    let names = line(&columns(study));
    format!("{inputs}\n{}", String::from_utf8_lossy(&names))
}

/// A line of comma-separated values, with line end.
pub(super) fn line(cells: &[String]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing to memory cannot fail.
    let _ = writer.write_record(cells);
    writer.into_inner().unwrap_or_default()
}

/// Writes the header of a log; returns its length.
fn begin(file: &mut File, study: &Study) -> std::io::Result<u64> {
    let header = header(study);
    file.set_len(0)?;
    file.rewind()?;
    file.write_all(header.as_bytes())?;
    file.sync_all()?;
    Ok(header.len() as u64)
}

/// Calls a function with the position and the content of every complete line of a log, which is only read.
pub(super) fn read(
    path: &Path,
    study: &Study,
    visit: &mut dyn FnMut(Range<u64>, Line),
) -> Result<(), LogError> {
    let file = File::open(path).map_err(io(path))?;
    scan(path, &file, study, visit).map(|_| ())
}

/// Calls a function with the position and the content of every complete line after the header. Returns the end of the
/// last complete line, or `None` if the header is incomplete.
fn scan(
    path: &Path,
    file: &File,
    study: &Study,
    visit: &mut dyn FnMut(Range<u64>, Line),
) -> Result<Option<u64>, LogError> {
    let mut file = BufReader::with_capacity(1 << 16, file);
    let header = header(study);
    let mut begun = Vec::new();
    let mut limited = file.by_ref().take(header.len() as u64);
    limited.read_to_end(&mut begun).map_err(io(path))?;
    if begun != header.as_bytes() {
        // A log that contains only the beginning of the header belongs to a run that stopped while it wrote
        // the header.
        return if header.as_bytes().starts_with(&begun) {
            Ok(None)
        } else {
            Err(differing(path, study))
        };
    }
    let (mut from, mut text) = (header.len() as u64, Vec::new());
    loop {
        text.clear();
        let length = file.read_until(b'\n', &mut text).map_err(io(path))?;
        if !text.ends_with(b"\n") {
            return Ok(Some(from));
        }
        let to = from + length as u64;
        if let Some(line) = parsed(&text, study) {
            visit(from..to, line);
        }
        from = to;
    }
}

/// Describes how the inputs of a log differ from those of the study.
fn differing(path: &Path, study: &Study) -> LogError {
    let difference = match read_inputs(path) {
        Ok(there) => there.difference(&Inputs::of(study)),
        Err(error) => return error,
    };
    LogError::Other {
        path: path.to_owned(),
        difference: difference.unwrap_or_else(|| "its columns differ".into()),
    }
}

/// Parses a complete line; `None` if it is damaged.
fn parsed(line: &[u8], study: &Study) -> Option<Line> {
    match line.strip_prefix(PROCESSOR.as_bytes()) {
        None => row(line, study).map(Line::Saw),
        Some(name) => {
            let name = std::str::from_utf8(name).ok()?.trim();
            Some(Line::Processor(name.to_owned()))
        }
    }
}

/// Rows of saws in the form that [`Log::append_rows`] accepts.
pub fn rows_of(study: &Study, saws: &[Saw]) -> Vec<u8> {
    let lines = saws.iter().map(|saw| line(&record(study, saw)));
    lines.collect::<Vec<_>>().concat()
}

/// The saw of a complete line; `None` if it does not belong to this study.
pub(super) fn row(line: &[u8], study: &Study) -> Option<Saw> {
    let line = line.strip_suffix(b"\n")?;
    let saw = if line.contains(&b'"') {
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .from_reader(line);
        let mut record = csv::StringRecord::new();
        reader.read_record(&mut record).ok()?;
        saw(study, &mut record.iter())?
    } else {
        // Splitting at commas is faster and suffices for lines without quotes.
        saw(study, &mut std::str::from_utf8(line).ok()?.split(','))?
    };
    (saw.values == study.values(saw.index)).then_some(saw)
}
