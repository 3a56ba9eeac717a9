//! Reads the rows of logs in the order of the saws; the rows may have been written in any order.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::finished_saws::{BLOCK, Finished};
use super::log::{Line, Log, LogError, io, read, row};
use super::plan::Study;
use super::saw::Saw;

/// Index of the rows in the logs of a study. The rows remain in the logs and are read 65 536 at a time.
pub struct Rows<'a> {
    study: &'a Study,
    logs: Vec<PathBuf>,
    finished: Finished,
    processors: BTreeSet<String>,
    /// Positions of the rows of each block of saws, in the order of the logs.
    blocks: Vec<Vec<Extent>>,
}

/// Position of consecutive rows of a log that belong to one block of saws. Saws are started in the order of their
/// numbers, so a block has few such positions.
struct Extent {
    log: usize,
    place: Range<u64>,
}

impl<'a> Rows<'a> {
    /// Indexes logs. If a saw is in several of them, its first row counts.
    ///
    /// # Errors
    /// [`LogError`] if a log cannot be read, or belongs to another study.
    pub fn of(study: &'a Study, logs: Vec<PathBuf>) -> Result<Self, LogError> {
        let mut rows = Rows {
            study,
            finished: Finished::none_of(study.count()),
            processors: BTreeSet::new(),
            blocks: Vec::new(),
            logs,
        };
        rows.blocks
            .resize_with(study.count().div_ceil(BLOCK), Vec::new);
        for log in 0..rows.logs.len() {
            let Rows {
                logs,
                finished,
                processors,
                blocks,
                ..
            } = &mut rows;
            read(&logs[log], study, &mut |place, line| match line {
                Line::Processor(name) => {
                    processors.insert(name);
                }
                Line::Saw(saw) => {
                    if finished.insert(saw.index) {
                        add(&mut blocks[saw.index / BLOCK], log, place);
                    }
                }
            })?;
        }
        Ok(rows)
    }

    /// Indexes every log in a folder.
    ///
    /// # Errors
    /// [`LogError`] if the folder or a log cannot be read, or a log belongs to another study.
    pub fn in_folder(study: &'a Study, folder: &Path) -> Result<Self, LogError> {
        Self::of(study, Log::all_in(folder)?)
    }

    /// The finished saws.
    pub fn finished(&self) -> &Finished {
        &self.finished
    }

    /// The study to which the rows belong.
    pub fn study(&self) -> &'a Study {
        self.study
    }

    /// Kinds of processors that have computed the saws, sorted by name.
    pub fn processors(&self) -> impl Iterator<Item = &String> {
        self.processors.iter()
    }

    /// Calls a function with the saws in the order of their numbers, block by block.
    ///
    /// # Errors
    /// [`LogError`] if a log cannot be read, and the errors of `visit`.
    pub fn each_block(
        &self,
        visit: &mut dyn FnMut(&[Saw]) -> Result<(), LogError>,
    ) -> Result<(), LogError> {
        for (number, extents) in self.blocks.iter().enumerate() {
            let mut slots: Vec<Option<Saw>> = Vec::new();
            slots.resize_with(BLOCK.min(self.study.count() - number * BLOCK), || None);
            for extent in extents {
                for line in self.text(extent)?.split_inclusive(|byte| *byte == b'\n') {
                    if let Some(saw) = row(line, self.study) {
                        slots[saw.index % BLOCK].get_or_insert(saw);
                    }
                }
            }
            let saws: Vec<Saw> = slots.into_iter().flatten().collect();
            visit(&saws)?;
        }
        Ok(())
    }

    fn text(&self, extent: &Extent) -> Result<Vec<u8>, LogError> {
        let path = &self.logs[extent.log];
        let Range { start, end } = extent.place;
        let mut file = File::open(path).map_err(io(path))?;
        file.seek(SeekFrom::Start(start)).map_err(io(path))?;
        let mut text = Vec::with_capacity((end - start) as usize);
        file.take(end - start)
            .read_to_end(&mut text)
            .map_err(io(path))?;
        Ok(text)
    }
}

fn add(extents: &mut Vec<Extent>, log: usize, place: Range<u64>) {
    match extents.last_mut() {
        Some(last) if last.log == log && last.place.end == place.start => {
            last.place.end = place.end;
        }
        _ => extents.push(Extent { log, place }),
    }
}
