//! Counts and statistics of a group of saws: all of a study, or those of one point of its grid.

use std::io;
use std::path::Path;

use super::order::Values;
use super::plan::Study;
use super::report::{CriterionEntry, GridEntry, Group, Histogram, Passing, Quantile, SpeedEntry};
use super::saw::{Outcome, Saw};
use super::statistics::interval;
use crate::scene::rpm;

/// More bars of a histogram cannot be distinguished.
const MOST_BARS: usize = 40;

/// A group of saws.
pub(super) struct Counts<'a> {
    study: &'a Study,
    grid: Vec<GridEntry>,
    /// Number of saws.
    pub saws: usize,
    refused: usize,
    failed: usize,
    lowest_critical: Values,
    flutter: Values,
    passed: usize,
    kept: Vec<usize>,
}

impl<'a> Counts<'a> {
    /// An empty group for a point of the grid; without `grid`, for all saws. Values that do not fit into
    /// memory are written to `folder`.
    pub fn new(study: &'a Study, grid: Vec<GridEntry>, folder: &Path) -> Self {
        Counts {
            study,
            grid,
            saws: 0,
            refused: 0,
            failed: 0,
            lowest_critical: Values::new(folder),
            flutter: Values::new(folder),
            passed: 0,
            kept: vec![0; study.criteria_of_nothing().len()],
        }
    }

    /// Adds a saw.
    pub fn add(&mut self, saw: &Saw) -> io::Result<()> {
        self.saws += 1;
        let found = match &saw.outcome {
            Outcome::Analysed(found) => found,
            Outcome::Refused(_) => {
                self.refused += 1;
                return Ok(());
            }
            Outcome::Failed(_) => {
                self.failed += 1;
                return Ok(());
            }
        };
        self.passed += usize::from(found.passed() == Some(true));
        for (count, kept) in self.kept.iter_mut().zip(&found.kept) {
            *count += usize::from(*kept);
        }
        let speeds = [
            (&mut self.lowest_critical, found.lowest_critical_rpm),
            (&mut self.flutter, found.flutter_rpm),
        ];
        for (values, speed) in speeds {
            if let Some(rpm) = speed {
                values.push(rpm)?;
            }
        }
        Ok(())
    }

    /// Number of saws that were analysed.
    pub fn analysed(&self) -> usize {
        self.saws - self.refused - self.failed
    }

    /// The statistics of the group.
    pub fn report(mut self) -> io::Result<Group> {
        let (analysed, shares) = (self.analysed(), &self.study.file().quantiles);
        let passing = self.study.limits().map(|_| self.passing());
        Ok(Group {
            grid: self.grid,
            saws: self.saws,
            refused: self.refused,
            failed: self.failed,
            lowest_critical: speed(&mut self.lowest_critical, analysed, shares)?,
            flutter: speed(&mut self.flutter, analysed, shares)?,
            passing,
        })
    }

    fn passing(&self) -> Passing {
        let (study, saws) = (self.study, self.saws);
        let confidence = study.file().confidence;
        // Different points of the grid have the same deviations, so their saws are not independent.
        let is_drawn = study.file().saws.is_some() && saws == study.drawn();
        let criteria = study.criteria_of_nothing().into_iter().zip(&self.kept);
        Passing {
            passed: self.passed,
            probability: self.passed as f64 / saws.max(1) as f64,
            confidence,
            interval: is_drawn.then(|| interval(self.passed, saws, confidence)),
            criteria: criteria
                .map(|(criterion, passed)| CriterionEntry {
                    key: criterion.key.to_owned(),
                    name: criterion.name.to_owned(),
                    asked_rpm: rpm(criterion.asked),
                    passed: *passed,
                })
                .collect(),
        }
    }
}

fn speed(values: &mut Values, analysed: usize, shares: &[f64]) -> io::Result<SpeedEntry> {
    let beyond = analysed - values.count();
    let median = values.quantiles(beyond, &[0.5])?;
    let found = values.quantiles(beyond, shares)?;
    let quantiles = shares.iter().zip(found);
    Ok(SpeedEntry {
        saws: values.count(),
        beyond,
        median_rpm: median[0],
        quantiles: quantiles
            .map(|(&share, rpm)| Quantile { share, rpm })
            .collect(),
        histogram: histogram(values)?,
    })
}

/// The number of bars is twice the cube root of the number of saws (Rice's rule).
fn histogram(values: &mut Values) -> io::Result<Option<Histogram>> {
    let Some((from, to)) = values.range() else {
        return Ok(None);
    };
    let bars = (2.0 * (values.count() as f64).cbrt()).round() as usize;
    let bars = bars.clamp(1, MOST_BARS);
    let mut counts = vec![0; bars];
    values.each(&mut |rpm| {
        // A range of zero length has one bar.
        let share = if to > from {
            (rpm - from) / (to - from)
        } else {
            0.0
        };
        counts[((share * bars as f64) as usize).min(bars - 1)] += 1;
    })?;
    Ok(Some(Histogram {
        from_rpm: from,
        to_rpm: to,
        counts,
    }))
}
