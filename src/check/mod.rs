//! Compares a saw with limits that its designer sets.
//!
//! ```
//! use sawflutter::check::{Check, Limits};
//! use sawflutter::scene::{Accuracy, Scene, rad_per_s};
//!
//! let scene = Scene::paper().edited(|saw| saw.accuracy = Accuracy::Draft)?;
//! let limits = Limits {
//!     min_critical_rad_per_s: Some(rad_per_s(1500.0)),
//!     ..Limits::at(rad_per_s(1250.0))
//! };
//! let check = Check::new(&scene, &limits)?;
//! assert!(check.passed(), "{:?}", check.failures());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod criteria;
mod limits;
mod rim;
mod static_deflection;

use crate::analyses::deflect::rim_compliance_m_per_n;
use crate::scene::{Scene, SceneError, SpeedRange, rpm};
use crate::spectrum::SpectrumError;
use crate::stability::{Analysis, AnalysisError, Rise, saturations};
use crate::stretched::StretchedError;

use criteria::{of_gaps, without_stiffness};
#[cfg(feature = "cli")]
pub(crate) use limits::RIM_LIMIT_M_PER_S;
pub use limits::{Limits, LimitsFile};
use rim::point_load_plate;
pub(crate) use rim::{rim_stiffness_at_rest_n_per_m, side_force_factor};
use static_deflection::StaticDeflection;

/// Reason for which a check failed to run.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// The scene refuses the sweep that the limits require.
    #[error("the limits were refused: {0}")]
    Scene(#[from] SceneError),
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The amplitude of flutter could not be computed.
    #[error(transparent)]
    Stretched(#[from] StretchedError),
}

/// A limit and its result.
#[derive(Debug, Clone, PartialEq)]
pub struct Criterion {
    /// Identifier, used in tables.
    pub key: &'static str,
    /// Requirement, as text.
    pub name: String,
    /// Result, as text.
    pub finding: String,
    /// Speed that was found, in rad/s: the critical or flutter speed itself, or the speed from which on another limit is
    /// exceeded; `None` if it exceeds the sweep.
    pub found: Option<f64>,
    /// Speed with which the found one is compared, in rad/s.
    pub asked: f64,
    /// Whether the limit is kept.
    pub passed: bool,
}

/// Result of comparing a saw with limits.
#[derive(Debug)]
pub struct Check {
    /// Limits of speeds, which studies evaluate as well, and their results.
    pub criteria: Vec<Criterion>,
    /// Limits of the rim speed, the amplitude of flutter and the gaps of guides with their results, and a failed
    /// criterion if a rigid motion of the blade is free.
    pub of_rim_and_gaps: Vec<Criterion>,
    /// Speeds in rad/s up to the lowest critical one, and the lateral stiffness in N/m of the rim at the
    /// middle of the cut; empty if rigid motions are free.
    pub rim_stiffness_over_speed: Vec<(f64, f64)>,
    /// Lateral stiffness of this point of the rim at rest, in N/m.
    pub rim_stiffness_at_rest_n_per_m: f64,
    /// Lateral stiffness of this point at the operating speed; `None` from the first critical speed on, because
    /// K(Ω) is not positive definite there and the ratio of force to deflection may have any value and sign.
    pub rim_stiffness_n_per_m: Option<f64>,
    /// Deflection of this point under a constant side force, relative to that at rest, for a stable saw within 5 % of
    /// a critical speed; negative if it moves against the force.
    pub side_force_factor: Option<f64>,
    /// Amplitude to which the flutter of each band rises; empty if the amplitude has no limit.
    pub saturations: Vec<Rise>,
    /// Unusual numbers of the scene and of the limits.
    pub unusual_numbers: Vec<String>,
    /// Whether a saw with unusual numbers may pass.
    pub accept_unusual: bool,
    /// Analysis from which the speeds were taken.
    pub analysis: Analysis,
}

impl Check {
    /// Analyses a saw from rest to the end of its sweep, or further if the limits require it, and compares the
    /// results with the limits. They equal those of an [`Analysis`] of the scene.
    ///
    /// # Errors
    /// [`CheckError`] when the saw cannot be analysed that far.
    pub fn new(scene: &Scene, limits: &Limits) -> Result<Self, CheckError> {
        let analysis = analysed(scene, limits.reach_rad_per_s())?;
        let angle = scene.cut_angle_rad();
        let plate = &point_load_plate(&analysis);
        let lowest_critical = analysis.model.critical.first().map(|c| c.speed_rad_per_s);
        let operating = limits.operating_rad_per_s;
        let is_stiff = lowest_critical.is_none_or(|lowest| operating < lowest);
        let lateral = scene.cut().and_then(|cut| {
            let run = cut.at_rpm(rpm(operating)).ok()?;
            Some((cut, run.lateral_n))
        });
        let bending = lowest_critical
            .and_then(|critical| StaticDeflection::new(plate, angle, lateral, critical));
        let mut of_rim_and_gaps = vec![limits.of_rim(plate.blade.outer_radius_m)];
        of_rim_and_gaps.extend(of_gaps(scene, plate, bending.as_ref(), operating));
        let saturations = match limits.max_amplitude_m {
            None => Vec::new(),
            Some(_) => saturations(&analysis)?,
        };
        of_rim_and_gaps.extend(limits.of_amplitude(&analysis, &saturations));
        let mut components = analysis.model.components.iter();
        let is_free = components.any(|component| !component.full.free_rigid.is_empty());
        of_rim_and_gaps.extend(is_free.then(|| without_stiffness(operating)));
        // Nothing resists a side force where rigid motions are free, or where K(Ω) is singular.
        let stiffness = |speed: f64| {
            let compliance = rim_compliance_m_per_n(plate, angle, speed);
            compliance.map_or(0.0, |m_per_n| 1.0 / m_per_n)
        };
        Ok(Check {
            side_force_factor: side_force_factor(&analysis, operating),
            of_rim_and_gaps,
            rim_stiffness_over_speed: bending
                .as_ref()
                .map_or_else(Vec::new, StaticDeflection::rim_stiffness_n_per_m),
            criteria: limits.criteria(&analysis.evidence(&analysis.critical_rad_per_s())),
            saturations,
            unusual_numbers: limits.unusual_numbers(scene),
            accept_unusual: limits.accept_unusual,
            rim_stiffness_at_rest_n_per_m: stiffness(0.0),
            rim_stiffness_n_per_m: is_stiff.then(|| stiffness(operating)),
            analysis,
        })
    }

    /// All limits: of speeds, of the rim and of the gaps.
    pub fn all_criteria(&self) -> impl Iterator<Item = &Criterion> {
        self.criteria.iter().chain(&self.of_rim_and_gaps)
    }

    /// Unusual numbers that prevent the check from passing.
    fn refused_numbers(&self) -> &[String] {
        match self.accept_unusual {
            true => &[],
            false => &self.unusual_numbers,
        }
    }

    /// Whether every limit is kept and unusual numbers are absent or accepted.
    pub fn passed(&self) -> bool {
        self.refused_numbers().is_empty() && self.all_criteria().all(|criterion| criterion.passed)
    }

    /// Unusual numbers and limits that are not kept, with values in rpm, for assertions.
    pub fn failures(&self) -> Vec<String> {
        let failed = self.all_criteria().filter(|criterion| !criterion.passed);
        let failed = failed.map(Criterion::to_string);
        self.refused_numbers()
            .iter()
            .cloned()
            .chain(failed)
            .collect()
    }
}

/// The analysis of a scene from rest to the end of its sweep, given or chosen by the program, or further if
/// required.
fn analysed(scene: &Scene, least_end_rad_per_s: f64) -> Result<Analysis, CheckError> {
    let to = |end_rad_per_s: f64| {
        let range = (0.0, end_rad_per_s.max(least_end_rad_per_s));
        Ok(Analysis::new(&scene.swept(range.into())?)?)
    };
    if let Some(SpeedRange { to_rad_per_s, .. }) = scene.sweep() {
        return to(to_rad_per_s);
    }
    let analysis = Analysis::new(scene)?;
    match analysis.range_rad_per_s.1 >= least_end_rad_per_s {
        true => Ok(analysis),
        false => to(least_end_rad_per_s),
    }
}

impl std::fmt::Display for Criterion {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{}: {}", self.name, self.finding)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Accuracy, rad_per_s};

    /// The program ends the sweep of this saw; limits require much less, and more.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
    fn a_check_finds_what_an_analysis_finds() {
        let scene = Scene::paper().edited(|saw| {
            (saw.accuracy, saw.sweep) = (Accuracy::Draft, None);
        });
        let scene = scene.unwrap();
        let analysis = Analysis::new(&scene).unwrap();
        let limits = |asked_rpm: f64| Limits {
            min_flutter_rad_per_s: Some(rad_per_s(asked_rpm)),
            ..Limits::at(rad_per_s(300.0))
        };
        let near = Check::new(&scene, &limits(400.0)).unwrap();
        assert_eq!(near.analysis.range_rad_per_s, analysis.range_rad_per_s);
        assert!(analysis.flutter_speed_rad_per_s.is_some());
        assert_eq!(near.criteria[2].found, analysis.flutter_speed_rad_per_s);
        let far = limits(1.1 * rpm(analysis.range_rad_per_s.1));
        let end = Check::new(&scene, &far).unwrap().analysis.range_rad_per_s.1;
        assert!(end > far.min_flutter_rad_per_s.unwrap());
    }
}
