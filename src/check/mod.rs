//! Pass or fail: a saw against limits that its designer sets.
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
mod static_deflection;

use faer::linalg::solvers::Solve;

use crate::deflect::saturations;
use crate::plate::{Plate, Resolution};
use crate::scene::{Scene, SceneError, SpeedRange, rpm};
use crate::spectrum::SpectrumError;
use crate::stability::{Analysis, AnalysisError};
use crate::stretched::{Saturation, StretchedError};
use crate::system::GyroscopicSystem;

use criteria::{of_gaps, without_stiffness};
#[cfg(feature = "cli")]
pub(crate) use limits::RIM_LIMIT_M_PER_S;
pub use limits::{Limits, LimitsFile};
use static_deflection::{StaticDeflection, point};

/// Why a saw could not be held against limits.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// No sweep reaches as far as the limits ask.
    #[error("the limits were refused: {0}")]
    Scene(#[from] SceneError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The amplitude of flutter could not be computed.
    #[error(transparent)]
    Stretched(#[from] StretchedError),
}

/// One limit and what was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Criterion {
    /// Which limit, in one word, for tables.
    pub key: &'static str,
    /// What is asked, in words.
    pub name: String,
    /// What the saw does, in words.
    pub finding: String,
    /// What was found, in rad/s; `None` where there is no such speed within the sweep.
    pub found: Option<f64>,
    /// What was asked, in rad/s.
    pub asked: f64,
    /// Whether it is kept.
    pub passed: bool,
}

/// A saw held against limits.
#[derive(Debug)]
pub struct Check {
    /// Every limit of speeds that a study asks about too.
    pub criteria: Vec<Criterion>,
    /// The speed of the rim, the amplitude of flutter where it is limited, the gap of every guide that has one, and of a blade that nothing holds its want of
    /// stiffness.
    pub of_rim_and_gaps: Vec<Criterion>,
    /// Speeds in rad/s up to the lowest critical one, and the stiffness in N/m of the same point
    /// there; empty where rigid motions are free.
    pub rim_stiffness_over_speed: Vec<(f64, f64)>,
    /// Lateral stiffness of a point of the rim at the middle of the cut, at rest, in N/m.
    pub rim_stiffness_at_rest_n_per_m: f64,
    /// The same at the operating speed; `None` from the first critical speed on: K(Ω) is not
    /// positive definite there, and force over deflection may be anything, of either sign.
    pub rim_stiffness_n_per_m: Option<f64>,
    /// How far the flutter of each band rises; none where it was not asked.
    pub saturations: Vec<Option<Saturation>>,
    /// Numbers that no saw has, of the scene and of the limits.
    pub unusual_numbers: Vec<String>,
    /// Whether a saw with such numbers may pass.
    pub accept_unusual: bool,
    /// What the speeds were taken from.
    pub analysis: Analysis,
}

/// A point dents the rim in waves of all lengths: what n diameters add falls with n³ only, so
/// that critical speeds are right long before the stiffness of a point is.
const POINT_LOAD_BASIS: Resolution = Resolution {
    max_diameters: 30,
    radial_functions: 12,
};

impl Check {
    /// Analyses a saw from rest to where its sweep ends, or further where the limits ask for more,
    /// and compares: what is found is what an [`Analysis`] of the scene finds.
    ///
    /// # Errors
    /// [`CheckError`] when the saw cannot be analysed that far.
    pub fn new(scene: &Scene, limits: &Limits) -> Result<Self, CheckError> {
        let analysis = analysed(scene, limits.reach_rad_per_s())?;
        let angle = scene.cut().map_or(0.0, |cut| cut.angle_rad);
        let plate = &Plate::new(scene, POINT_LOAD_BASIS);
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
        Ok(Check {
            of_rim_and_gaps,
            rim_stiffness_over_speed: bending
                .as_ref()
                .map_or_else(Vec::new, StaticDeflection::rim_stiffness_n_per_m),
            criteria: limits.criteria(&analysis.evidence(&analysis.critical_rad_per_s())),
            saturations,
            unusual_numbers: limits.unusual_numbers(scene),
            accept_unusual: limits.accept_unusual,
            rim_stiffness_at_rest_n_per_m: rim_stiffness_n_per_m(plate, angle, 0.0),
            rim_stiffness_n_per_m: is_stiff.then(|| rim_stiffness_n_per_m(plate, angle, operating)),
            analysis,
        })
    }

    /// Every limit: those of speeds, of the rim and of the gaps.
    pub fn all_criteria(&self) -> impl Iterator<Item = &Criterion> {
        self.criteria.iter().chain(&self.of_rim_and_gaps)
    }

    /// Numbers that no saw has, where they keep the check from being passed.
    fn refused_numbers(&self) -> &[String] {
        match self.accept_unusual {
            true => &[],
            false => &self.unusual_numbers,
        }
    }

    /// Whether every limit is kept, by a saw whose numbers saws have, or that are accepted.
    pub fn passed(&self) -> bool {
        self.refused_numbers().is_empty() && self.all_criteria().all(|criterion| criterion.passed)
    }

    /// Numbers that no saw has, and the limits that are not kept, with their numbers in rpm: for
    /// assertions.
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

/// Of a scene from rest to the end of its sweep, or that of the program's choice, or further where as much is asked.
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

/// 1/(φᵀ K(Ω)⁻¹ φ) with φ the functions at the rim: force over deflection of a point that
/// stands in space, the saw turning under it. Zero where rigid motions are free.
fn rim_stiffness_n_per_m(plate: &Plate, angle_rad: f64, speed_rad_per_s: f64) -> f64 {
    let point = point(plate, plate.blade.outer_radius_m, angle_rad);
    let system = GyroscopicSystem::of_plate(plate);
    if !system.free_rigid.is_empty() {
        return 0.0;
    }
    let answer = system
        .stiffness_at(speed_rad_per_s)
        .partial_piv_lu()
        .solve(&point);
    let stiffness = 1.0 / (point.transpose() * answer);
    if stiffness.is_finite() {
        stiffness
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Accuracy, rad_per_s};

    /// Of a saw whose sweep the program ends, asked for far less, and for more.
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
