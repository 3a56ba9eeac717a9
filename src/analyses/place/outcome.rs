//! Result of a saw in a placement.

use serde::{Deserialize, Serialize};

use crate::analyses::gap::GapError;
use crate::model::plate::Resolution;
use crate::model::scene::{Scene, SpeedRange, rpm};
use crate::stability::{
    Certificate, Evidence, Instability, ListedBand, StabilityState, flutter_onsets, resolved,
    search_bands,
};

use super::deviation::operating_deviation_m;
use super::{Demands, Outcome, Tolerances};

/// A saw of a search.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Computed {
    pub outcome: Outcome,
    /// Value of the goal, to be maximized.
    pub value_rad_per_s: f64,
    /// Sum of the shares by which limits are missed; zero if they are kept.
    short: f64,
    /// Deflection at the cut at the operating speed: that of the limit, or on the basis of the search. `None`
    /// unless the saw is stable there, and where it is unknown.
    pub deviation_m: Option<f64>,
    /// All bands of the sweep.
    pub bands: Vec<Instability>,
    /// Certificate of this list of bands.
    pub certificate: Certificate,
}

/// The result of a saw, or the reason why it could not be computed (`None` if there is no such saw).
pub type Known = Result<Computed, Option<String>>;

/// Goal, limits, speeds and basis with which every saw of a search is computed.
#[derive(Debug, Clone)]
pub struct Question {
    pub demands: Demands,
    /// Range of speeds, the same for every saw.
    pub range: SpeedRange,
    /// The basis, or its lower limit if each saw chooses its own.
    pub resolution: Resolution,
    /// Tolerances of production.
    pub tolerances: Tolerances,
}

/// Share by which the limit of the deflection is missed where the model is not valid: more than any valid deflection.
const FAR_BEYOND: f64 = 1e6;
/// Cost of a saw that cannot be analysed, larger than any other.
pub const REFUSED: f64 = 1e12;
/// Smaller relative changes of speeds are no effect.
pub const IDLE: f64 = 1e-7;

impl Question {
    /// Analyses a saw.
    ///
    /// # Errors
    /// [`GapError`] if an eigenproblem fails, no basis represents the waves of the sweep, or the deflection cannot be
    /// computed.
    pub fn ask(&self, scene: &Scene) -> Result<Computed, GapError> {
        let demands = &self.demands;
        let charted = match &demands.gap {
            Some(gap) => &gap.case.at_amplitude(scene)?,
            None => scene,
        };
        let (saw, critical) = resolved(charted, self.resolution, self.range.to_rad_per_s)?;
        let critical_rad_per_s: Vec<f64> = critical.iter().map(|c| c.speed_rad_per_s).collect();
        let lowest = critical_rad_per_s.first().copied();
        let too_low = match (demands.min_critical_rad_per_s, lowest) {
            (Some(asked), Some(found)) => (1.0 - found / asked).max(0.0),
            // A blade without a critical speed satisfies every lower limit of the first critical speed.
            _ => 0.0,
        };
        let limit = demands
            .gap
            .and_then(|gap| Some((gap.case, gap.max_deflection_m?)));
        let (deflection_m, beyond) = match limit {
            None => (None, 0.0),
            Some((case, limit_m)) => {
                let found = case.deflection_m(scene, self.resolution)?;
                let beyond = found.map_or(FAR_BEYOND, |m| (m / limit_m - 1.0).max(0.0));
                (found, beyond)
            }
        };
        let deviation_m = match demands.gap {
            None => operating_deviation_m(scene, self.resolution, &saw.plate),
            Some(_) => deflection_m,
        };
        let found = search_bands(saw, critical, self.range)?;
        let (bands, certificate) = (found.instabilities, found.certificate);
        let threshold = scene.flutter_threshold_per_s();
        let [flutter, _] = flutter_onsets(&bands, threshold);
        let flutter = flutter.map(|onset| onset.speed_rad_per_s);
        let not_covered = scene
            .file()
            .not_covered(critical_rad_per_s.first().copied());
        let is_never_covered = not_covered.iter().any(|range| range.from_rad_per_s == 0.0);
        // A search compares saws; the errors of edges are those of the answer's own analysis.
        let listed = bands
            .iter()
            .map(|band| ListedBand::new(band, threshold, Some(0.0)));
        let evidence = Evidence {
            bands: listed.collect(),
            has_failed: certificate.has_failed(),
            critical_rad_per_s: &critical_rad_per_s,
            threshold_per_s: threshold,
            range_rad_per_s: self.range,
            not_covered,
            floquet: None,
        };
        let around = demands.around_rad_per_s;
        let window = around.and_then(|speed| evidence.window_without_instability(speed));
        let value_rad_per_s = match around {
            None => flutter.unwrap_or(self.range.to_rad_per_s),
            Some(_) => window.map_or(0.0, |range| range.width()),
        };
        let is_stable = scene
            .operating_rad_per_s()
            .is_some_and(|speed| evidence.verdict(speed).state == StabilityState::Stable);
        // A saw whose search failed keeps no limit that follows from its bands, and neither does one whose slots pass a guide.
        let unknown = if certificate.has_failed() || is_never_covered {
            FAR_BEYOND
        } else {
            0.0
        };
        let short = too_low + beyond + unknown;
        Ok(Computed {
            outcome: Outcome {
                goal_rpm: rpm(value_rad_per_s),
                flutter_rpm: flutter.map(rpm),
                first_critical_rpm: lowest.map(rpm),
                window_rpm: window.map(|range| range.ends().map(rpm)),
                deflection_m,
                kept: short == 0.0,
            },
            value_rad_per_s,
            deviation_m: deviation_m.filter(|_| is_stable),
            short,
            bands,
            certificate,
        })
    }
}

impl Computed {
    /// The cost to minimize: the negative goal in rad/s if the limits are kept, otherwise the share by which they are
    /// missed, which is positive.
    pub fn cost(&self) -> f64 {
        if self.outcome.kept {
            -self.value_rad_per_s
        } else {
            self.short
        }
    }
}
