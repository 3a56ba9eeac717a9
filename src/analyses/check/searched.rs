//! The verdict on a saw of which critical speeds and bands were searched without a chart: one of a map, of a study, or of the search for
//! a number.

use super::criteria::of_deflection;
use super::rim::Judged;
use crate::analyses::board_deviation::BoardDeviation;
use crate::analyses::verdict::{Judge, Verdict};
use crate::model::plate::Resolution;
use crate::model::scene::{ForceCause, LimitsFile, Scene, rpm};
use crate::stability::Evidence;

/// A saw with its critical speeds and bands.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Searched<'a> {
    pub scene: &'a Scene,
    /// Basis of the search.
    pub basis: Resolution,
    pub evidence: &'a Evidence<'a>,
    pub limits: &'a LimitsFile,
    /// Whether something holds every rigid motion of the blade.
    pub is_held: bool,
    /// Estimated error of critical speeds.
    pub estimated_relative_error: f64,
}

impl<'a> Searched<'a> {
    /// Whether a saw is judged by its critical speeds, its bands and the deflection at the cut alone: without amplitudes of flutter,
    /// without Floquet multipliers of slots that pass guides, and without gaps that the cut may close.
    pub fn suffices(scene: &Scene) -> bool {
        let file = scene.file();
        let has_gaps = file.guides.iter().any(|guide| guide.gap_m.is_some());
        scene.limits().max_amplitude_m.is_none()
            && file.slot_passing().is_none()
            && !(has_gaps && file.cut.is_some())
    }

    /// The verdict at a speed, and the deflection at the cut where it can change it.
    pub fn judged(&self, speed_rad_per_s: Option<f64>) -> (Verdict, Option<BoardDeviation>) {
        let judge = self.judge();
        let deviation = speed_rad_per_s.and_then(|speed| self.deviation(speed));
        let further = deviation
            .as_ref()
            .map(|found| of_deflection(self.scene, &judge, found));
        let verdict = judge.verdict(speed_rad_per_s, further.unwrap_or_default());
        (verdict, deviation)
    }

    pub fn judge(&self) -> Judge<'a> {
        Judge {
            found: self.evidence,
            limits: self.limits,
            rim_radius_m: self.scene.blade().outer_radius_m,
            is_held: self.is_held,
            accuracy: self.scene.accuracy(),
        }
    }

    /// The deflection at the cut; `None` where no limit and no typed force depends on it.
    pub fn deviation(&self, speed_rad_per_s: f64) -> Option<BoardDeviation> {
        let force = self.scene.constant_force_at(rpm(speed_rad_per_s));
        // A force that is only assumed breaks no limit that nobody set.
        let decides = self.limits.max_deviation_m.is_some() || force.cause != ForceCause::Assumed;
        decides
            .then(|| BoardDeviation::of_judged(self.scene, self.basis, &self.at(speed_rad_per_s)))
    }

    /// The number of [`side_force_factor`](super::side_force_factor).
    pub fn side_force_factor(&self, speed_rad_per_s: f64) -> Option<f64> {
        self.at(speed_rad_per_s)
            .side_force_factor(self.scene, self.basis)
    }

    fn at(&self, speed_rad_per_s: f64) -> Judged {
        let own = self.evidence.verdict(speed_rad_per_s);
        Judged {
            speed_rad_per_s,
            state: own.state,
            critical_rad_per_s: own
                .critical
                .map(|place| self.evidence.critical_rad_per_s[place]),
            estimated_relative_error: Some(self.estimated_relative_error),
        }
    }
}
