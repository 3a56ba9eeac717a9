//! The report of the saws of a map.

use rayon::prelude::*;

use super::contour::{contours, lines};
use super::{Contour, Contoured, Map, MapReport, MappedSaw};
use crate::analyses::campbell::InstabilityBand;
use crate::analyses::check::Searched;
use crate::analyses::study::{Found, LogError, Rows, Saw};
use crate::analyses::verdict::Verdict;
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{Scene, SpeedRange, rad_per_s, rpm};
use crate::model::system::GyroscopicSystem;
use crate::stability::Evidence;

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
        let end_rpm = rpm(self.study.to_rad_per_s());
        let within = |speed_rpm: &f64| *speed_rpm <= end_rpm;
        let scene = self.study.scene_of(&saw.values).ok();
        let judged = saw
            .found()
            .and(scene)
            .map(|scene| self.judged(&scene, found));
        let (verdict, side_force_factor) = judged.unzip();
        MappedSaw {
            side_force_factor: side_force_factor.flatten(),
            x: self.x.values[saw.index % columns],
            y: self.y.as_ref().map(|y| y.values[saw.index / columns]),
            first_critical_rpm: found.first_critical_rpm,
            flutter_rpm: found.flutter_rpm,
            critical_rpm: found.critical_rpm.iter().copied().filter(within).collect(),
            instabilities: found.bands.clone(),
            verdict,
            not_analysed: saw.outcome.reason().map(str::to_owned),
        }
    }

    /// The verdict on a saw, and how far a side force at the cut deflects it relative to rest.
    fn judged(&self, scene: &Scene, found: &Found) -> (Verdict, Option<f64>) {
        let critical = found.critical_rad_per_s();
        let evidence = Evidence {
            bands: found.bands.iter().map(InstabilityBand::listed).collect(),
            has_failed: false,
            critical_rad_per_s: &critical,
            threshold_per_s: scene.flutter_threshold_per_s(),
            range_rad_per_s: SpeedRange::new(0.0, self.study.to_rad_per_s()),
            not_covered: scene.file().not_covered(critical.first().copied()),
            floquet: None,
        };
        let basis = self.study.basis();
        let basis = basis.unwrap_or_else(|| Resolution::of(scene.accuracy()));
        let searched = Searched {
            scene,
            basis,
            evidence: &evidence,
            limits: &scene.limits(),
            is_held: !has_free_motions(scene, basis),
            estimated_relative_error: found.estimated_relative_error,
        };
        let speed = self.rpm.map(rad_per_s);
        let factor = speed.and_then(|speed| searched.side_force_factor(speed));
        (searched.judged(speed).0, factor)
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
        let flutter = of(Contoured::FlutterSpeed, |saw| saw.flutter_rpm);
        let critical = of(Contoured::FirstCriticalSpeed, |saw| saw.first_critical_rpm);
        let limits = self.rpm.map(|rpm| {
            let distances: Vec<Option<f64>> = saws.iter().map(MappedSaw::distance).collect();
            let rows: Vec<_> = distances.chunks(self.x.values.len()).collect();
            let lines = lines(&rows, 0.0, |[column, row]| [self.x.at(column), y.at(row)]);
            let contour = |points| Contour {
                quantity: Contoured::Limits,
                rpm,
                points,
            };
            lines.into_iter().map(contour).collect::<Vec<_>>()
        });
        [flutter, critical, limits.unwrap_or_default()].concat()
    }
}

/// Whether nothing holds some rigid motion of the blade of a scene.
fn has_free_motions(scene: &Scene, basis: Resolution) -> bool {
    GyroscopicSystem::has_free_motions(&Plate::new(scene, basis))
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
