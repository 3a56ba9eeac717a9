//! Exact order statistics of any number of values in bounded memory.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::path::{Path, PathBuf};

use super::statistics::{between, rank};

/// Number of values kept in memory, 8 MB.
const KEPT: usize = 1 << 20;
/// Bits of a value that one pass over the file resolves.
const DIGIT: u32 = 8;

/// A list of values. A list in memory is sorted; for a list on disk, passes over the file determine the requested values
/// digit by digit. The results are identical.
#[derive(Debug)]
pub(super) struct Values {
    memory: Vec<f64>,
    kept: usize,
    folder: PathBuf,
    disk: Option<BufWriter<File>>,
    count: usize,
    range: Option<[f64; 2]>,
}

impl Values {
    /// An empty list; values that do not fit into memory are written to a file in `folder`.
    pub fn new(folder: &Path) -> Self {
        Values {
            memory: Vec::new(),
            kept: KEPT,
            folder: folder.to_owned(),
            disk: None,
            count: 0,
            range: None,
        }
    }

    /// Adds a value, which must be finite.
    ///
    /// # Errors
    /// The error of writing to the disk.
    pub fn push(&mut self, value: f64) -> io::Result<()> {
        self.count += 1;
        let [low, high] = self.range.unwrap_or([value; 2]);
        self.range = Some([low.min(value), high.max(value)]);
        self.memory.push(value);
        if self.memory.len() > self.kept {
            self.spill()?;
        }
        Ok(())
    }

    /// Number of values.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Smallest and largest value; `None` without values.
    pub fn range(&self) -> Option<[f64; 2]> {
        self.range
    }

    fn spill(&mut self) -> io::Result<()> {
        let file = match &mut self.disk {
            Some(file) => file,
            // The file has no name, so that the system removes it however the program ends.
            none => none.insert(BufWriter::new(tempfile::tempfile_in(&self.folder)?)),
        };
        for value in self.memory.drain(..) {
            file.write_all(&value.to_le_bytes())?;
        }
        Ok(())
    }

    /// Calls a function with every value, in no particular order.
    pub fn each(&mut self, visit: &mut dyn FnMut(f64)) -> io::Result<()> {
        self.memory.iter().copied().for_each(&mut *visit);
        let Some(disk) = &mut self.disk else {
            return Ok(());
        };
        disk.flush()?;
        let mut file = disk.get_ref();
        file.rewind()?;
        let mut reader = BufReader::with_capacity(1 << 16, file);
        let mut bytes = [0; 8];
        for _ in self.memory.len()..self.count {
            reader.read_exact(&mut bytes)?;
            visit(f64::from_le_bytes(bytes));
        }
        file.seek(io::SeekFrom::End(0))?;
        Ok(())
    }

    /// The quantiles of `shares`, where the list is extended by `beyond` values that are larger than any; `None` for a
    /// quantile among these.
    pub fn quantiles(&mut self, beyond: usize, shares: &[f64]) -> io::Result<Vec<Option<f64>>> {
        let total = self.count + beyond;
        let ranks: Vec<_> = shares.iter().map(|share| rank(total, *share)).collect();
        let mut wanted: Vec<usize> = ranks
            .iter()
            .flatten()
            .flat_map(|rank| [rank.below, rank.below + 1])
            .filter(|rank| *rank < self.count)
            .collect();
        wanted.sort_unstable();
        wanted.dedup();
        let found = self.ranked(&wanted)?;
        let value = |rank: usize| Some(found[wanted.binary_search(&rank).ok()?]);
        Ok(ranks
            .into_iter()
            .map(|rank| rank.and_then(|rank| between(rank, &value)))
            .collect())
    }

    /// The values at some ranks, counted from 0; ranks and values ascend.
    pub fn ranked(&mut self, ranks: &[usize]) -> io::Result<Vec<f64>> {
        if self.disk.is_none() {
            self.memory.sort_unstable_by(f64::total_cmp);
            return Ok(ranks.iter().map(|rank| self.memory[*rank]).collect());
        }
        let mut searches: Vec<Search> = ranks.iter().map(|rank| Search::new(*rank)).collect();
        for shift in (0..u64::BITS).step_by(DIGIT as usize).rev() {
            // Searches with the same leading digits share one table of counts. Such searches are neighbours,
            // because searches ascend.
            let mut heads: Vec<u64> = searches.iter().map(|search| search.head).collect();
            heads.dedup();
            let mut counts = vec![[0_usize; 1 << DIGIT]; heads.len()];
            self.each(&mut |value| {
                let key = key(value);
                if let Ok(which) = heads.binary_search(&above(key, shift + DIGIT)) {
                    counts[which][(key >> shift) as usize & ((1 << DIGIT) - 1)] += 1;
                }
            })?;
            for search in &mut searches {
                if let Ok(which) = heads.binary_search(&search.head) {
                    search.narrow(&counts[which]);
                }
            }
        }
        Ok(searches.iter().map(|search| value(search.head)).collect())
    }
}

/// A search for a value whose leading digits are known.
struct Search {
    head: u64,
    /// Rank among the values with the same leading digits.
    rank: usize,
}

impl Search {
    fn new(rank: usize) -> Self {
        Search { head: 0, rank }
    }

    fn narrow(&mut self, counts: &[usize; 1 << DIGIT]) {
        let mut digit = 0;
        while digit + 1 < counts.len() && self.rank >= counts[digit] {
            self.rank -= counts[digit];
            digit += 1;
        }
        self.head = self.head << DIGIT | digit as u64;
    }
}

fn above(key: u64, shift: u32) -> u64 {
    key.checked_shr(shift).unwrap_or(0)
}

/// Maps values to integers whose order is that of `f64::total_cmp`.
fn key(value: f64) -> u64 {
    let bits = value.to_bits();
    match bits >> 63 {
        0 => bits | 1 << 63,
        _ => !bits,
    }
}

fn value(key: u64) -> f64 {
    f64::from_bits(match key >> 63 {
        0 => !key,
        _ => key & !(1 << 63),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::study::statistics::quantile;

    /// Quantiles from disk and from memory equal those of a sorted list, for values with repetitions,
    /// negative ones and many of one magnitude.
    #[test]
    fn on_the_disk_quantiles_are_those_of_a_sorted_list() {
        let mut state = 5_u64;
        let mut draw = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 33) as f64 / f64::from(1_u32 << 31)
        };
        let shares = [0.0, 0.001, 0.1, 0.25, 0.5, 0.75, 0.9, 0.999, 1.0];
        for (count, beyond) in [(1, 0), (2, 3), (999, 0), (1000, 40), (5003, 1)] {
            let scales = [1500.0, -3.0, -3.0];
            let value = |k: usize, even: f64| match k % 5 {
                0 => 1500.0,
                _ => scales[k % 3] * (1.0 + 0.01 * even),
            };
            let mut sorted: Vec<f64> = (0..count).map(|k| value(k, draw())).collect();
            for kept in [10, 997, usize::MAX] {
                let folder = std::env::temp_dir();
                let mut values = Values {
                    kept,
                    ..Values::new(&folder)
                };
                sorted.iter().for_each(|value| values.push(*value).unwrap());
                assert_eq!(values.disk.is_some(), count > kept);
                let found = values.quantiles(beyond, &shares).unwrap();
                let mut own = sorted.clone();
                own.sort_by(f64::total_cmp);
                let exact: Vec<_> = shares
                    .iter()
                    .map(|share| quantile(&own, beyond, *share))
                    .collect();
                assert_eq!(found, exact, "{count} {kept}");
                assert_eq!(values.range(), Some([own[0], own[count - 1]]));
                // Quantiles remain right after more values are added.
                values.push(-1e9).unwrap();
                assert_eq!(values.ranked(&[0, count]).unwrap(), [-1e9, own[count - 1]]);
                let mut sum = 0;
                values.each(&mut |_| sum += 1).unwrap();
                assert_eq!(sum, count + 1);
            }
            sorted.clear();
        }
    }
}
