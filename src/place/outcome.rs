//! What a saw is worth that is tried.

use crate::plate::Resolution;
use crate::scene::Scene;
use crate::stability::{
    AnalysisError, Certificate, Evidence, Instability, flutter_onsets, resolved, search_bands,
};

use super::{Goal, Tolerances};

/// What was found out about a saw.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// What is to be made large, in rad/s.
    pub value_rad_per_s: f64,
    /// Onset of the first flutter band that reaches the threshold; `None` within the sweep.
    pub flutter_rad_per_s: Option<f64>,
    /// Lowest critical speed, if the blade has one.
    pub critical_rad_per_s: Option<f64>,
    /// The window without instability around the operating speed, if that is what is asked for; nothing where
    /// the operating speed is in a band or within 5 % of a critical speed.
    pub window: Option<(f64, f64)>,
    /// By how much the lowest critical speed misses its limit, in rad/s.
    pub short_rad_per_s: f64,
    /// Every band of the sweep.
    pub bands: Vec<Instability>,
    /// What this list was held against.
    pub certificate: Certificate,
}

/// What is asked of every saw that is tried.
#[derive(Debug, Clone)]
pub struct Question {
    pub goal: Goal,
    pub min_critical_rad_per_s: Option<f64>,
    /// Sweep, the same for all.
    pub range: (f64, f64),
    /// The basis, or the least of all where a saw takes a larger one.
    pub resolution: Resolution,
    /// How far its numbers may be off.
    pub tolerances: Tolerances,
}

/// The cost of a saw worse than any that can be analysed.
pub const REFUSED: f64 = 1e12;

impl Question {
    /// Analyses a saw as far as the question asks.
    ///
    /// # Errors
    /// [`AnalysisError`] when an eigenproblem fails, or no basis holds the waves of the sweep.
    pub fn ask(&self, scene: &Scene) -> Result<Outcome, AnalysisError> {
        let (saw, critical) = resolved(scene, self.resolution, self.range.1)?;
        let critical_rad_per_s: Vec<f64> = critical.iter().map(|c| c.speed_rad_per_s).collect();
        let lowest = critical_rad_per_s.first().copied();
        let short = match (self.min_critical_rad_per_s, lowest) {
            (Some(asked), Some(found)) => (asked - found).max(0.0),
            // Without a critical speed every limit is kept.
            _ => 0.0,
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
            short_rad_per_s: short,
            bands,
            certificate,
        })
    }
}

impl Outcome {
    /// What a minimizer makes small: how far the limit is missed, and where it is kept, which no positive
    /// number is, the value with the other sign.
    pub(crate) fn cost(&self) -> f64 {
        match self.is_kept() {
            true => -self.value_rad_per_s,
            false => self.short_rad_per_s,
        }
    }

    /// Whether the limit is kept.
    pub fn is_kept(&self) -> bool {
        self.short_rad_per_s == 0.0
    }
}
