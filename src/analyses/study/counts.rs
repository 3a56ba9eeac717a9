//! Counts and statistics of a group of saws: all of a study, or those of one point of its grid.

use std::io;
use std::path::Path;

use crate::analyses::check::Limits;
use crate::model::scene::rpm;

use super::order::Values;
use super::plan::Study;
use super::report::{
    GapStatistics, GridNumber, Group, Histogram, LimitStatistics, NumberQuantile, NumberStatistics,
    Passing, Quantile, SpeedStatistics,
};
use super::saw::{Outcome, Saw};
use super::statistics::{interval, is_resolved};

/// Largest number of bars of a histogram; more cannot be distinguished.
const MOST_BARS: usize = 40;

/// A group of saws.
pub(super) struct Counts<'a> {
    study: &'a Study,
    grid: Vec<GridNumber>,
    /// Number of saws.
    pub saws: usize,
    refused: usize,
    failed: usize,
    first_critical: Values,
    flutter: Values,
    passed: usize,
    kept: Vec<usize>,
    /// Deflections, pad forces and critical speeds of guides with a gap.
    gap: Vec<Values>,
    /// Number of saws that keep the limit of the deflection at the cut.
    within: usize,
}

impl<'a> Counts<'a> {
    /// An empty group for a point of the grid; without `grid`, for all saws. Values that do not fit into
    /// memory are written to `folder`.
    pub fn new(study: &'a Study, grid: Vec<GridNumber>, folder: &Path) -> Self {
        Counts {
            study,
            grid,
            saws: 0,
            refused: 0,
            failed: 0,
            first_critical: Values::new(folder),
            flutter: Values::new(folder),
            passed: 0,
            kept: vec![0; study.criteria_of_nothing().len()],
            gap: (study.gap_columns().iter().map(|_| Values::new(folder))).collect(),
            within: 0,
        }
    }

    /// Adds a saw.
    ///
    /// # Errors
    /// The error of writing values that do not fit into memory.
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
        for (values, number) in self.gap.iter_mut().zip(&found.gap) {
            if let Some(number) = number {
                values.push(*number)?;
            }
        }
        let deflection_m = found.gap.first().copied().flatten();
        self.within += usize::from(
            self.limit_m()
                .zip(deflection_m)
                .is_some_and(|(limit, found)| found <= limit),
        );
        let speeds = [
            (&mut self.first_critical, found.first_critical_rpm),
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
    ///
    /// # Errors
    /// The error of reading values that did not fit into memory.
    pub fn report(mut self) -> io::Result<Group> {
        let (analysed, shares) = (self.analysed(), &self.study.file().quantiles);
        let passing = self.study.limits().map(|limits| self.passing(limits));
        let saws_within = self.limit_m().map(|_| self.within);
        let mut numbers = self
            .gap
            .iter_mut()
            .map(|values| number(values, analysed, shares))
            .collect::<io::Result<Vec<NumberStatistics>>>()?
            .into_iter();
        let gap =
            numbers
                .next()
                .zip(numbers.next())
                .map(|(deflection_at_cut, largest_pad_force)| GapStatistics {
                    deflection_at_cut,
                    largest_pad_force,
                    critical_at_amplitude: numbers.next(),
                    saws_within,
                });
        Ok(Group {
            grid: self.grid,
            saws: self.saws,
            refused: self.refused,
            failed: self.failed,
            first_critical: speed(&mut self.first_critical, analysed, shares)?,
            flutter: speed(&mut self.flutter, analysed, shares)?,
            passing,
            gap,
        })
    }

    /// Upper limit of the deflection at the cut.
    fn limit_m(&self) -> Option<f64> {
        self.study.file().gap?.limit_m(self.study.scene().file())
    }

    fn passing(&self, limits: &Limits) -> Passing {
        let (study, saws) = (self.study, self.saws);
        let confidence = study.file().confidence;
        // The saws of different points of a grid have the same deviations and are not independent, so that
        // the interval is given for a single point only.
        let is_drawn = study.file().saws.is_some() && saws == study.drawn();
        let criteria = study.criteria_of_nothing().into_iter().zip(&self.kept);
        Passing {
            operating_rpm: rpm(limits.operating_rad_per_s),
            passed: self.passed,
            probability: self.passed as f64 / saws.max(1) as f64,
            confidence,
            interval: is_drawn.then(|| interval(self.passed, saws, confidence)),
            criteria: criteria
                .map(|(criterion, passed)| LimitStatistics {
                    key: criterion.key,
                    name: criterion.name,
                    asked_rpm: criterion.asked_rpm,
                    passed: *passed,
                })
                .collect(),
        }
    }
}

/// The shares whose quantiles a sample of this size has.
fn resolved(shares: &[f64], saws: usize) -> Vec<f64> {
    let found = shares.iter().filter(|share| is_resolved(**share, saws));
    found.copied().collect()
}

fn number(values: &mut Values, analysed: usize, shares: &[f64]) -> io::Result<NumberStatistics> {
    let unknown = analysed - values.count();
    let median = values.quantiles(unknown, &[0.5])?;
    let shares = &resolved(shares, analysed);
    let found = values.quantiles(unknown, shares)?;
    let quantiles = shares.iter().zip(found);
    Ok(NumberStatistics {
        saws: values.count(),
        median: median[0],
        quantiles: quantiles
            .map(|(&share, value)| NumberQuantile { share, value })
            .collect(),
    })
}

fn speed(values: &mut Values, analysed: usize, shares: &[f64]) -> io::Result<SpeedStatistics> {
    let beyond = analysed - values.count();
    let median = values.quantiles(beyond, &[0.5])?;
    let shares = &resolved(shares, analysed);
    let found = values.quantiles(beyond, shares)?;
    let quantiles = shares.iter().zip(found);
    Ok(SpeedStatistics {
        saws: values.count(),
        beyond,
        median_rpm: median[0],
        quantiles: quantiles
            .map(|(&share, rpm)| Quantile { share, rpm })
            .collect(),
        histogram: histogram(values)?,
    })
}

/// A histogram of values; `None` without values. The number of bars is twice the cube root of the number of values
/// (Rice's rule).
fn histogram(values: &mut Values) -> io::Result<Option<Histogram>> {
    let Some([from, to]) = values.range() else {
        return Ok(None);
    };
    let even = (2.0 * (values.count() as f64).cbrt()).round();
    let bars = (even as usize).clamp(1, MOST_BARS);
    let mut counts = vec![0; bars];
    values.each(&mut |rpm| {
        // If all values are equal, they are counted in the first bar.
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
