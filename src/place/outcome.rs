//! Result of a saw in a placement.

use crate::gap::GapError;
use crate::plate::Resolution;
use crate::scene::Scene;
use crate::stability::{
    Certificate, Evidence, Instability, flutter_onsets, resolved, search_bands,
};

use super::{GapDemands, Goal, Tolerances};

/// The result of a saw.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Value of the goal, to be maximized, in rad/s.
    pub value_rad_per_s: f64,
    /// Flutter speed; `None` if it exceeds the sweep.
    pub flutter_rad_per_s: Option<f64>,
    /// Lowest critical speed, if the blade has one.
    pub critical_rad_per_s: Option<f64>,
    /// Window without instability around the operating speed, in rad/s, if it is the goal; `None` if the operating
    /// speed lies in a band that counts or within 5 % of a critical speed.
    pub window: Option<(f64, f64)>,
    /// Deflection at the cut, if it has a limit; `None` also where the model is not valid.
    pub deflection_m: Option<f64>,
    /// Sum of the shares by which limits are missed; zero if they are kept.
    pub short: f64,
    /// All bands of the sweep.
    pub bands: Vec<Instability>,
    /// Certificate of this list of bands.
    pub certificate: Certificate,
}

/// Goal, limits, speeds and basis with which every saw of a search is computed.
#[derive(Debug, Clone)]
pub struct Question {
    pub goal: Goal,
    pub min_critical_rad_per_s: Option<f64>,
    /// Limit of the deflection, and amplitude, for guides with a gap.
    pub gap: Option<GapDemands>,
    /// Range of speeds, the same for every saw.
    pub range: (f64, f64),
    /// The basis, or its lower limit if each saw chooses its own.
    pub resolution: Resolution,
    /// Tolerances of production.
    pub tolerances: Tolerances,
}

/// Share by which the limit of the deflection is missed where the model is not valid: more than any valid deflection.
const FAR_BEYOND: f64 = 1e6;
/// Cost of a saw that cannot be analysed, larger than any other.
pub const REFUSED: f64 = 1e12;

impl Question {
    /// Analyses a saw.
    ///
    /// # Errors
    /// [`GapError`] if an eigenproblem fails, no basis represents the waves of the sweep, or the deflection cannot be
    /// computed.
    pub fn ask(&self, scene: &Scene) -> Result<Outcome, GapError> {
        let charted = match &self.gap {
            Some(gap) => &gap.case.at_amplitude(scene)?,
            None => scene,
        };
        let (saw, critical) = resolved(charted, self.resolution, self.range.1)?;
        let critical_rad_per_s: Vec<f64> = critical.iter().map(|c| c.speed_rad_per_s).collect();
        let lowest = critical_rad_per_s.first().copied();
        let short = match (self.min_critical_rad_per_s, lowest) {
            (Some(asked), Some(found)) => (1.0 - found / asked).max(0.0),
            // A blade without a critical speed satisfies every lower limit of the first critical speed.
            _ => 0.0,
        };
        let limit = self
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
        let (bands, certificate) = search_bands(saw, critical, self.range)?;
        let threshold = scene.flutter_threshold_per_s();
        let [flutter, _] = flutter_onsets(&bands, threshold);
        let window = match self.goal {
            Goal::FlutterSpeed => None,
            Goal::StableWindow { around_rad_per_s } => {
                let evidence = Evidence {
                    bands: &bands,
                    critical_rad_per_s: &critical_rad_per_s,
                    threshold_per_s: threshold,
                    range_rad_per_s: self.range,
                };
                evidence.window_without_instability(around_rad_per_s)
            }
        };
        let value = match self.goal {
            Goal::FlutterSpeed => flutter.unwrap_or(self.range.1),
            Goal::StableWindow { .. } => window.map_or(0.0, |(from, to)| to - from),
        };
        Ok(Outcome {
            value_rad_per_s: value,
            flutter_rad_per_s: flutter,
            critical_rad_per_s: lowest,
            window,
            deflection_m,
            short: short + beyond,
            bands,
            certificate,
        })
    }
}

impl Outcome {
    /// The cost to minimize: the negative goal in rad/s if the limits are kept, otherwise the share by which they are
    /// missed, which is positive.
    pub(crate) fn cost(&self) -> f64 {
        match self.is_kept() {
            true => -self.value_rad_per_s,
            false => self.short,
        }
    }

    /// Whether the limits of the critical speed and of the deflection are kept.
    pub fn is_kept(&self) -> bool {
        self.short == 0.0
    }
}
