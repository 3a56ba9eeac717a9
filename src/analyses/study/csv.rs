//! `study.csv`, with one row for each saw; the log has the same rows.

use std::io::{self, Write};

use super::plan::Study;
use super::saw::{Found, Outcome, STATUS, Saw};
use super::table::Table;
use crate::analyses::campbell::InstabilityBand;
use crate::stability::InstabilityKind;

/// A table of saws as comma-separated values.
#[derive(Debug)]
pub struct CsvTable<'a, W: Write> {
    study: &'a Study,
    writer: csv::Writer<W>,
}

impl<'a, W: Write> CsvTable<'a, W> {
    /// A table without saws.
    ///
    /// # Errors
    /// The error of writing the column names.
    pub fn new(study: &'a Study, out: W) -> io::Result<Self> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(columns(study))?;
        Ok(CsvTable { study, writer })
    }
}

impl<W: Write> Table for CsvTable<'_, W> {
    fn add(&mut self, saws: &[Saw]) -> io::Result<()> {
        for saw in saws {
            self.writer.write_record(record(self.study, saw))?;
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.writer.flush()
    }
}

/// Names of the columns.
pub(super) fn columns(study: &Study) -> Vec<String> {
    let paths = (study.varying.iter()).map(|varying| varying.parameter.path().to_owned());
    let kept = study
        .criteria_of_nothing()
        .into_iter()
        .map(|criterion| format!("keeps_{}", criterion.key));
    let before = [
        "status",
        "first_critical_rpm",
        "flutter_rpm",
        "first_merge_rpm",
        "passed",
    ];
    let after = ["functions", "estimated_relative_error", "krein_violations"];
    let listed: &[&str] = if study.file().bands {
        &["critical_rpm", "bands"]
    } else {
        &[]
    };
    let owned = |names: &[&str]| names.iter().map(|n| (*n).to_owned()).collect::<Vec<_>>();
    std::iter::once("saw".to_owned())
        .chain(paths)
        .chain(owned(&before))
        .chain(kept)
        .chain(owned(study.gap_columns()))
        .chain(owned(&after))
        .chain(owned(listed))
        .chain(["reason".to_owned()])
        .collect()
}

/// The cells of a saw. Numbers have so many digits that the same bits are read back.
pub(super) fn record(study: &Study, saw: &Saw) -> Vec<String> {
    let mut cells = vec![saw.index.to_string()];
    cells.extend(saw.values.iter().map(f64::to_string));
    let found = saw.found();
    let number = |value: Option<f64>| value.map_or(String::new(), |v| v.to_string());
    let text = |value: Option<String>| value.unwrap_or_default();
    cells.push(saw.outcome.status().to_owned());
    cells.push(number(found.and_then(|f| f.first_critical_rpm)));
    cells.push(number(found.and_then(|f| f.flutter_rpm)));
    cells.push(number(found.and_then(|f| f.first_merge_rpm)));
    cells.push(text(found.and_then(Found::passed).map(|p| p.to_string())));
    let kept = 0..study.criteria_of_nothing().len();
    cells.extend(kept.map(|k| text(found.map(|f| f.kept[k].to_string()))));
    let gap = 0..study.gap_columns().len();
    cells.extend(gap.map(|k| number(found.and_then(|f| f.gap[k]))));
    cells.push(text(found.map(|f| f.functions.to_string())));
    cells.push(number(found.map(|f| f.estimated_relative_error)));
    cells.push(text(found.map(|f| f.krein_violations.to_string())));
    if study.file().bands {
        cells.push(text(found.map(|f| numbers_in_words(&f.critical_rpm))));
        cells.push(text(found.map(|f| bands_in_words(&f.bands))));
    }
    cells.push(saw.outcome.reason().unwrap_or_default().to_owned());
    cells
}

/// The saw of a row; `None` if the row does not have the cells of this study.
pub(super) fn saw(study: &Study, cells: &mut dyn Iterator<Item = &str>) -> Option<Saw> {
    let index: usize = cells.next()?.parse().ok()?;
    let mut values = Vec::new();
    for _ in 0..study.varying.len() {
        values.push(cells.next()?.parse().ok()?);
    }
    let status = cells.next()?;
    let rest: Vec<&str> = cells.collect();
    let (reason, speeds) = rest.split_last()?;
    let outcome = match STATUS.iter().position(|name| *name == status)? {
        0 => Outcome::Analysed(found(study, speeds)?),
        1 => Outcome::Refused((*reason).to_owned()),
        _ => Outcome::Failed((*reason).to_owned()),
    };
    let width = study.criteria_of_nothing().len()
        + study.gap_columns().len()
        + 7
        + 2 * usize::from(study.file().bands);
    (index < study.count() && speeds.len() == width).then_some(Saw {
        index,
        values,
        outcome,
    })
}

fn found(study: &Study, cells: &[&str]) -> Option<Found> {
    let number = |cell: &str| match cell {
        "" => Some(None),
        digits => digits.parse::<f64>().ok().map(Some),
    };
    let (critical_rpm, mut bands, cells) = match (study.file().bands, cells) {
        (true, [cells @ .., critical, bands]) => (numbers_of(critical)?, bands_of(bands)?, cells),
        _ => (Vec::new(), Vec::new(), cells),
    };
    let [
        critical,
        flutter,
        merge,
        _passed,
        limits_and_gap @ ..,
        functions,
        error,
        violations,
    ] = cells
    else {
        return None;
    };
    let limits = study.criteria_of_nothing().len();
    (limits_and_gap.len() == limits + study.gap_columns().len()).then_some(())?;
    let (words, gap) = limits_and_gap.split_at(limits);
    let kept: Vec<bool> = words
        .iter()
        .map(|k| k.parse().ok())
        .collect::<Option<_>>()?;
    let estimated_relative_error = number(error)??;
    // Edges have the error of the critical speeds, which the text of a band does not repeat.
    for band in &mut bands {
        band.estimated_relative_error = Some(estimated_relative_error);
    }
    Some(Found {
        first_critical_rpm: number(critical)?,
        flutter_rpm: number(flutter)?,
        first_merge_rpm: number(merge)?,
        kept,
        gap: gap.iter().map(|cell| number(cell)).collect::<Option<_>>()?,
        functions: functions.parse().ok()?,
        estimated_relative_error,
        krein_violations: violations.parse().ok()?,
        critical_rpm,
        bands,
    })
}

/// Numbers as text, separated by spaces.
pub(super) fn numbers_in_words(numbers: &[f64]) -> String {
    let numbers: Vec<String> = numbers.iter().map(f64::to_string).collect();
    numbers.join(" ")
}

fn numbers_of(text: &str) -> Option<Vec<f64>> {
    let numbers = text.split_whitespace();
    numbers.map(|number| number.parse().ok()).collect()
}

/// Bands as text, each with kind, onset and end in rpm, whether both are within the sweep, speed of largest growth in rpm, this
/// growth in 1/s, frequency in Hz, the ranges in which it counts, and after a bar those in which it is felt: "divergence 1500 1560 true
/// 1530 0.4 0 1500 1560 | 1500 1560;flutter 2255.9 2266.1 true 2261 0.1 6.01 | 2255.9 2266.1".
pub(super) fn bands_in_words(bands: &[InstabilityBand]) -> String {
    let band = |band: &InstabilityBand| {
        let (kind, closed) = (band.kind, band.closed);
        let at_peak = [band.peak_rpm, band.peak_growth_per_s, band.frequency_hz];
        let numbers = at_peak.iter().chain(band.counted_rpm.iter().flatten());
        let edges = format!("{kind} {} {} {closed}", band.from_rpm, band.to_rpm);
        let text = numbers.fold(edges, |text, number| format!("{text} {number}"));
        let felt = band.felt_rpm.iter().flatten();
        felt.fold(text + " |", |text, number| format!("{text} {number}"))
    };
    bands.iter().map(band).collect::<Vec<_>>().join(";")
}

fn bands_of(text: &str) -> Option<Vec<InstabilityBand>> {
    let band = |text: &str| {
        let words: Vec<&str> = text.split(' ').collect();
        let ([kind_word, from, to, closed], number_words) = words.split_first_chunk()?;
        let kinds = [InstabilityKind::Divergence, InstabilityKind::Flutter];
        let kind = kinds
            .into_iter()
            .find(|own| own.to_string() == *kind_word)?;
        let edges = [from.parse().ok()?, to.parse().ok()?];
        let numbers = |words: &[&str]| {
            let numbers = words.iter().map(|word| word.parse().ok());
            numbers.collect::<Option<Vec<f64>>>()
        };
        let pairs = |ends: &[f64]| ends.chunks_exact(2).map(|c| [c[0], c[1]]).collect();
        let bar = number_words.iter().position(|word| *word == "|")?;
        let (numbers, felt) = (
            numbers(&number_words[..bar])?,
            numbers(&number_words[bar + 1..])?,
        );
        let (&[peak_rpm, peak_growth_per_s, frequency_hz], counted) =
            numbers.split_first_chunk()?;
        Some(InstabilityBand {
            closed: closed.parse().ok()?,
            peak_rpm,
            peak_growth_per_s,
            frequency_hz,
            counted_rpm: pairs(counted),
            felt_rpm: pairs(&felt),
            ..InstabilityBand::between(kind, edges)
        })
    };
    let parts = text.split(';').filter(|part| !part.is_empty());
    parts.map(band).collect()
}
