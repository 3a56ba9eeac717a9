//! The reduced models that the search for bands of an undamped blade uses.

use std::borrow::Cow;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use faer::c64;
use rayon::prelude::*;

use super::component::{Component, Solution};
use super::derivative;
use super::double_eigenvalue::DoubleEigenvalue;
use super::error::SpectrumError;
use super::interval::{Interval, KnownModes, StandingWave, interval_at, states_at, states_between};
use super::mode::{Mode, classify};
use super::model::SpectralModel;
use super::projection::Projection;
use super::vectors::Eigenpair;
use super::work::WorkCounters;

/// The reduced models that the search for bands of an undamped blade uses.
#[derive(Debug, Clone)]
pub struct SearchModel<'a> {
    intervals: Cow<'a, [Interval]>,
    height_rad_per_s: f64,
    counters: &'a WorkCounters,
}

impl<'a> SearchModel<'a> {
    /// The search model of an undamped blade's reduced model. `None` for a damped blade, and for one without a
    /// reduced model.
    pub(crate) fn new(model: &'a SpectralModel) -> Option<Self> {
        let component = guided(model)?;
        let Solution::Projected(intervals) = &component.solution else {
            return None;
        };
        Some(SearchModel {
            intervals: Cow::Borrowed(intervals),
            height_rad_per_s: model.reflected_to_rad_per_s,
            counters: &model.counters,
        })
    }

    /// The search model of the full model; the modes at some ascending speeds are the ends of the intervals.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub(crate) fn of_full_model(
        model: &'a SpectralModel,
        speeds: &[f64],
    ) -> Result<Option<Self>, SpectrumError> {
        let Some(component) = guided(model) else {
            return Ok(None);
        };
        let standing: Vec<StandingWave<'_>> = model
            .critical
            .iter()
            .map(|c| (c.speed_rad_per_s, &c.shape))
            .collect();
        let counters = &model.counters;
        let whole = Arc::new(Projection::whole(&component.full));
        let mut known: Vec<KnownModes> = speeds
            .par_iter()
            .map(|speed| KnownModes::of(&whole, *speed, counters))
            .collect::<Result<_, _>>()?;
        if let [only] = known.as_slice() {
            known.push(only.clone());
        }
        let height_rad_per_s = model.reflected_to_rad_per_s;
        let between = known.windows(2).map(|ends| {
            let ends = [&ends[0], &ends[1]];
            Interval {
                to_rad_per_s: ends[1].speed_rad_per_s,
                projection: whole.clone(),
                drawn: None,
                searched: states_between(&whole, ends, &standing, height_rad_per_s),
            }
        });
        let intervals: Vec<Interval> = between.collect();
        Ok((!intervals.is_empty()).then_some(SearchModel {
            intervals: Cow::Owned(intervals),
            height_rad_per_s,
            counters,
        }))
    }

    /// Frequency up to which the modes are complete and accurate.
    pub fn height_rad_per_s(&self) -> f64 {
        self.height_rad_per_s
    }

    /// Ends of the intervals, in speed.
    pub fn ends_rad_per_s(&self) -> impl Iterator<Item = f64> {
        self.intervals.iter().map(|interval| interval.to_rad_per_s)
    }

    fn at(&self, speed_rad_per_s: f64) -> &Interval {
        interval_at(&self.intervals, speed_rad_per_s)
    }

    fn pairs(&self, interval: &Interval, speed: f64) -> Result<Vec<Eigenpair>, SpectrumError> {
        match &interval.searched {
            Some(states) => states_at(states, speed, self.counters),
            None => interval.projected_pairs(speed, self.counters),
        }
    }

    /// Modes at a speed, in the coordinates of a projection. Those above [`SearchModel::height_rad_per_s`] are
    /// inaccurate; they show where the frequencies continue.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn modes(&self, speed_rad_per_s: f64) -> Result<Vec<Mode>, SpectrumError> {
        let interval = self.at(speed_rad_per_s);
        let pairs = self.pairs(interval, speed_rad_per_s)?;
        let system = &interval.projection.reduced;
        Ok(classify(system, speed_rad_per_s, 0, pairs))
    }

    /// The modes of [`SearchModel::modes`] by the projection, without the error of the states.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn projected_modes(&self, speed_rad_per_s: f64) -> Result<Vec<Mode>, SpectrumError> {
        let interval = self.at(speed_rad_per_s);
        let pairs = interval.projected_pairs(speed_rad_per_s, self.counters)?;
        let system = &interval.projection.reduced;
        Ok(classify(system, speed_rad_per_s, 0, pairs))
    }

    /// The eigenvalue of the projection next to an expected one with its slope, without an eigenproblem. `None` if
    /// Newton's method does not converge.
    pub fn next_to(&self, speed_rad_per_s: f64, expected: c64) -> Option<(c64, c64)> {
        self.counters.refined_pairs.fetch_add(1, Ordering::Relaxed);
        let system = &self.at(speed_rad_per_s).projection.reduced;
        derivative::next_to(system, speed_rad_per_s, expected)
    }

    /// The coalescence of two modes of the projection next to an expected one, without an eigenproblem. `None` if Newton's
    /// method does not converge.
    pub fn double_eigenvalue(
        &self,
        speed_rad_per_s: f64,
        expected: c64,
    ) -> Option<DoubleEigenvalue> {
        self.counters.refined_pairs.fetch_add(1, Ordering::Relaxed);
        let on = |interval: &Interval, speed: f64, lambda: c64| {
            DoubleEigenvalue::next_to(&interval.projection.reduced, speed, lambda)
        };
        let interval = self.at(speed_rad_per_s);
        let found = on(interval, speed_rad_per_s, expected)?;
        let there = self.at(found.speed_rad_per_s);
        if Arc::ptr_eq(&interval.projection, &there.projection) {
            Some(found)
        } else {
            on(there, found.speed_rad_per_s, found.lambda)
        }
    }
}

/// The only component of an undamped guided blade.
fn guided(model: &SpectralModel) -> Option<&Component> {
    match model.components.as_slice() {
        [component] if model.is_conservative() => Some(component),
        _ => None,
    }
}
