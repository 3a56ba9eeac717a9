//! The report of the saws of a map.

use rayon::prelude::*;

use super::contour::contours;
use super::{Contour, Contoured, Map, MapReport, MappedSaw};
use crate::analyses::campbell::InstabilityBand;
use crate::analyses::check::Judged;
use crate::analyses::study::{Found, LogError, Rows, Saw};
use crate::model::scene::{rad_per_s, rpm};
use crate::stability::{StabilityState, critical_at, edges, undecided};

impl Map {
    /// Reports the saws from their logs.
    ///
    /// # Errors
    /// [`LogError`] where a log cannot be read.
    pub fn report_of_rows(&self, rows: &Rows<'_>) -> Result<MapReport, LogError> {
        let mut saws = Vec::new();
        rows.each_block(&mut |block| {
            saws.extend_from_slice(block);
            Ok(())
        })?;
        Ok(self.report(&saws))
    }

    /// Reports saws in the order of their numbers.
    pub fn report(&self, saws: &[Saw]) -> MapReport {
        let scene = self.study.scene();
        let mapped: Vec<MappedSaw> = saws.par_iter().map(|saw| self.mapped(saw)).collect();
        let found = || saws.iter().filter_map(Saw::found);
        let errors = found().map(|found| found.estimated_relative_error);
        MapReport {
            sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
            scene: scene.file().clone(),
            condition: scene.condition(),
            unusual_numbers: scene.file().unusual_numbers(),
            x: self.x.clone(),
            y: self.y.clone(),
            rpm: self.rpm,
            to_rpm: rpm(self.study.to_rad_per_s()),
            flutter_threshold_per_s: scene.flutter_threshold_per_s(),
            contours: self.contours(&mapped),
            largest_estimated_relative_error: errors.fold(0.0, f64::max),
            saws_with_krein_violations: found().filter(|found| found.krein_violations > 0).count(),
            warnings: warnings(&mapped),
            saws: mapped,
        }
    }

    fn mapped(&self, saw: &Saw) -> MappedSaw {
        let columns = self.x.values.len();
        let none = Found::default();
        let found = saw.found().unwrap_or(&none);
        let judged_rpm = self.rpm.filter(|_| saw.found().is_some());
        let end_rpm = rpm(self.study.to_rad_per_s());
        let within = |speed_rpm: &f64| *speed_rpm <= end_rpm;
        let state = judged_rpm.map(|rpm| match state_at(&found.bands, rpm, end_rpm) {
            StabilityState::Stable => StabilityState::of_none(rpm, self.covered_to_rpm(saw, found)),
            state => state,
        });
        let at_critical_rpm = judged_rpm
            .and_then(|rpm| critical_at(&found.critical_rpm, rpm))
            .map(|place| found.critical_rpm[place]);
        let judged = judged_rpm.zip(state).map(|(rpm, state)| Judged {
            speed_rad_per_s: rad_per_s(rpm),
            state,
            critical_rad_per_s: at_critical_rpm.map(rad_per_s),
            estimated_relative_error: Some(found.estimated_relative_error),
        });
        MappedSaw {
            side_force_factor: judged.and_then(|judged| self.side_force_factor(saw, &judged)),
            x: self.x.values[saw.index % columns],
            y: self.y.as_ref().map(|y| y.values[saw.index / columns]),
            lowest_critical_rpm: found.lowest_critical_rpm,
            flutter_speed_rpm: found.flutter_rpm,
            at_critical_rpm,
            critical_rpm: found.critical_rpm.iter().copied().filter(within).collect(),
            instabilities: found.bands.clone(),
            state,
            not_analysed: saw.outcome.reason().map(str::to_owned),
        }
    }

    /// Speed up to which a saw without a band is stable.
    fn covered_to_rpm(&self, saw: &Saw, found: &Found) -> f64 {
        let scene = self.study.scene_of(&saw.values);
        let covered = scene.map(|scene| scene.file().covered_to(found.lowest_critical_rpm));
        covered.unwrap_or(f64::INFINITY)
    }

    fn side_force_factor(&self, saw: &Saw, judged: &Judged) -> Option<f64> {
        let scene = self.study.scene_of(&saw.values).ok()?;
        judged.side_force_factor(&scene, self.study.basis()?)
    }

    fn contours(&self, saws: &[MappedSaw]) -> Vec<Contour> {
        let Some(y) = &self.y else {
            return Vec::new();
        };
        let of = |quantity: Contoured, speed: fn(&MappedSaw) -> Option<f64>| {
            let speeds: Vec<Option<f64>> = saws.iter().map(speed).collect();
            let rows: Vec<_> = speeds.chunks(self.x.values.len()).collect();
            contours(quantity, &rows, |[column, row]| {
                [self.x.at(column), y.at(row)]
            })
        };
        let flutter = of(Contoured::FlutterSpeed, |saw| saw.flutter_speed_rpm);
        let critical = of(Contoured::LowestCriticalSpeed, |saw| {
            saw.lowest_critical_rpm
        });
        [flutter, critical].concat()
    }
}

/// Whether a saw with these bands is stable at a speed within its sweep from rest to `end_rpm`, decided as [`Evidence::verdict`] does for an
/// analysis.
///
/// [`Evidence::verdict`]: crate::stability::Evidence::verdict
pub fn state_at(bands: &[InstabilityBand], rpm: f64, end_rpm: f64) -> StabilityState {
    let edges = bands.iter().flat_map(|band| {
        let stretches = band.counted_rpm.iter().copied();
        edges(
            [band.from_rpm, band.to_rpm],
            stretches,
            band.estimated_relative_error,
            [0.0, end_rpm],
        )
    });
    if undecided(edges, rpm).is_some() {
        return StabilityState::TooClose;
    }
    let around = |[from, to]: &[f64; 2]| (*from..=*to).contains(&rpm);
    let counted = bands
        .iter()
        .filter(|band| band.counted_rpm.iter().any(around));
    StabilityState::within(counted.map(|band| band.kind))
}

fn warnings(saws: &[MappedSaw]) -> Vec<String> {
    let mut lost = saws.iter().filter_map(|saw| saw.not_analysed.as_ref());
    let first = lost.next().map(|reason| {
        format!(
            "{} of {} saws were not analysed and are blank; the first one: {reason}",
            1 + lost.count(),
            saws.len()
        )
    });
    first.into_iter().collect()
}
