//! Compares a saw with limits that its designer sets.
//!
//! ```
//! use sawflutter::prelude::*;
//! use sawflutter::model::scene::{LimitsFile, rad_per_s};
//!
//! let scene = Scene::paper().edited(|saw| saw.accuracy = Accuracy::Draft)?;
//! let limits = Limits {
//!     limits: LimitsFile { min_critical_rpm: Some(1500.0), ..LimitsFile::default() },
//!     ..Limits::at(rad_per_s(1250.0))
//! };
//! let report = sawflutter::check(&scene, &limits)?;
//! assert!(report.passed, "{:?}", report.failures());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub(crate) mod chart;
mod criteria;
mod limits;
mod options;
mod outline;
mod report;
mod rim;
mod searched;
mod static_deflection;

use crate::analyses::board_deviation::BoardDeviation;
use crate::analyses::campbell::{InstabilityBand, Numbered, add_amplitudes, lifting_off};
use crate::analyses::deflect::PointLoad;
use crate::model::scene::{Scene, SceneError, SpeedRange, rpm};
use crate::modes::SpectrumError;
use crate::motion::stretched_blade::StretchedError;
use crate::motion::stretched_blade::{Rise, saturations};
use crate::stability::{Analysis, AnalysisError, check_stretch};
pub(crate) use outline::outline;

use criteria::lateral;
pub(crate) use criteria::{judged, of_deviation};
pub use limits::Limits;
use limits::Reach;
pub use options::Options;
pub(crate) use options::{MARGIN, MAX_AMPLITUDE, MAX_RIM, MIN_FLUTTER};
pub use report::{CheckReport, RimStiffness};
pub(crate) use rim::{
    Judged, point_load_plate, rim_at_cut, rim_stiffness_at_rest_n_per_m, side_force_factor,
};
pub(crate) use searched::Searched;
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

/// Analyses a saw from rest to the end of its sweep, or further if the limits require it, and compares the
/// results with the limits. They equal those of an [`Analysis`] of the scene.
///
/// # Errors
/// [`CheckError`] when the saw cannot be analysed that far.
pub fn check(scene: &Scene, limits: &Limits) -> Result<CheckReport, CheckError> {
    let mut analysis = analysed(scene, limits)?;
    if analysis.scene.operating_rad_per_s() != Some(limits.operating_rad_per_s) {
        analysis.look_at_slots(limits.operating_rad_per_s);
    }
    of_analysis(&analysis, scene, limits)
}

/// Compares a saw with limits by its analysis, which reaches as far as they require.
fn of_analysis(
    analysis: &Analysis,
    scene: &Scene,
    limits: &Limits,
) -> Result<CheckReport, CheckError> {
    let angle = scene.cut_angle_rad();
    let plate = &point_load_plate(&analysis.scene, analysis.model.plate.resolution);
    let critical = analysis.critical_rad_per_s();
    let first_critical = critical.first().copied();
    let operating = limits.operating_rad_per_s;
    let is_stiff = first_critical.is_none_or(|lowest| operating < lowest);
    let lateral = lateral(scene, plate, operating);
    let bending =
        first_critical.and_then(|critical| StaticDeflection::new(plate, angle, lateral, critical));
    let saturations = match limits.limits.max_amplitude_m {
        None => Vec::new(),
        Some(_) => saturations(analysis)?,
    };
    let deviation = BoardDeviation::of(analysis, operating);
    let verdict = judged(
        analysis,
        &limits.limits,
        Some(&deviation),
        Some(operating),
        &saturations,
    );
    let compared_gaps = verdict.limits.iter().filter(|of| of.key == "gap").count();
    let warnings = warnings(analysis, limits, compared_gaps);
    // Nothing resists a side force where rigid motions are free, or where K(Ω) is singular.
    let side_force = PointLoad::new(plate, rim_at_cut(scene));
    let stiffness = |speed: f64| {
        let compliance = side_force
            .as_ref()
            .and_then(|force| force.compliance_m_per_n(speed));
        compliance.map_or(0.0, |m_per_n| 1.0 / m_per_n)
    };
    let to_rad_per_s = analysis.range_rad_per_s.to_rad_per_s;
    let mut report = CheckReport {
        sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
        scene: scene.file().clone(),
        condition: scene.condition(),
        unusual_numbers: limits.unusual_numbers(scene),
        accept_unusual: limits.accept_unusual,
        passed: false,
        verdict,
        operating_rpm: rpm(operating),
        to_rpm: rpm(to_rad_per_s),
        first_critical_rpm: first_critical.map(rpm),
        critical_rpm: critical
            .into_iter()
            .take_while(|speed| *speed <= to_rad_per_s)
            .map(rpm)
            .collect(),
        instabilities: bands(analysis, &saturations),
        flutter_threshold_per_s: scene.flutter_threshold_per_s(),
        rim_stiffness_at_rest_n_per_m: stiffness(0.0),
        rim_stiffness_n_per_m: is_stiff.then(|| stiffness(operating)),
        rim_stiffness: bending
            .map(|bending| bending.rim_stiffness())
            .unwrap_or_default(),
        side_force_factor: side_force_factor(analysis, operating),
        deviation: Some(deviation),
        rim_speed_m_per_s: operating * scene.blade().outer_radius_m,
        limits: limits.limits,
        estimated_relative_error: analysis.estimated_relative_error,
        warnings,
    };
    report.passed = report.failures().is_empty();
    Ok(report)
}

/// The analysis of a scene from rest to the end of its sweep, given or chosen by the program, or further if
/// required.
fn analysed(scene: &Scene, limits: &Limits) -> Result<Analysis, CheckError> {
    let Reach {
        key,
        factor,
        end_rad_per_s: least_end_rad_per_s,
    } = limits.reach();
    let to = |end_rad_per_s: f64| {
        let range = required_range(scene, limits, end_rad_per_s)?;
        let analysis = Analysis::new(&scene.swept(range)?);
        Ok(analysis.map_err(|error| {
            if end_rad_per_s < least_end_rad_per_s {
                error.due_to(key, factor)
            } else {
                error
            }
        })?)
    };
    if let Some(SpeedRange { to_rad_per_s, .. }) = scene.sweep() {
        return to(to_rad_per_s);
    }
    required_range(scene, limits, 0.0)?;
    let analysis = Analysis::new(scene)?;
    if analysis.range_rad_per_s.to_rad_per_s >= least_end_rad_per_s {
        Ok(analysis)
    } else {
        to(0.0)
    }
}

/// The speeds from rest to an end, or further if limits require it.
///
/// # Errors
/// [`AnalysisError`] if the blade would yield at a speed that they require.
pub(crate) fn required_range(
    scene: &Scene,
    limits: &Limits,
    end_rad_per_s: f64,
) -> Result<SpeedRange, AnalysisError> {
    let reach = limits.reach();
    check_stretch(scene.blade(), reach.end_rad_per_s)
        .map_err(|error| error.due_to(reach.key, reach.factor))?;
    Ok(SpeedRange::new(0.0, end_rad_per_s.max(reach.end_rad_per_s)))
}

/// The bands of the chart, with their amplitudes if those were computed.
fn bands(analysis: &Analysis, saturations: &[Rise]) -> Vec<InstabilityBand> {
    let branches = Numbered::new(analysis);
    let threshold_per_s = analysis.scene.flutter_threshold_per_s();
    let entry = |band| InstabilityBand::in_chart(band, &branches, threshold_per_s);
    let mut bands: Vec<InstabilityBand> = analysis.chart.instabilities.iter().map(entry).collect();
    add_amplitudes(&mut bands, saturations);
    bands
}

/// Remarks on the validity of the result, of which so many criteria compare a gap.
fn warnings(analysis: &Analysis, limits: &Limits, compared_gaps: usize) -> Vec<String> {
    let scene = &analysis.scene;
    let mut warnings: Vec<String> = lifting_off(scene).into_iter().collect();
    let operating = limits.operating_rad_per_s;
    let gaps = scene.file().guides.iter().filter(|g| g.gap_m.is_some());
    if gaps.count() > compared_gaps {
        warnings.push(
            "a guide has a gap_m, but the scene has no lateral force that could close it (cut.lateral_n_per_tooth), or nothing holds the blade"
                .to_owned(),
        );
    }
    let critical = analysis.model.critical.first();
    let is_above = critical.is_some_and(|first| operating >= first.speed_rad_per_s);
    if is_above && compared_gaps > 0 {
        warnings.push(
            "above the first critical speed a static deflection does not show whether the gaps of guides close".to_owned(),
        );
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Accuracy, LimitsFile, rad_per_s};

    /// A lower limit of the flutter speed.
    fn asked(min_flutter_rpm: f64) -> LimitsFile {
        LimitsFile {
            min_flutter_rpm: Some(min_flutter_rpm),
            ..LimitsFile::default()
        }
    }

    /// The rim is stretched by a tenth at Ωb = √(0.1 E/ρ). The sweep of a check goes on to 1.02/0.85 times the operating speed.
    #[test]
    fn a_speed_beyond_the_model_is_refused_by_the_limit_that_requires_it() {
        let soft = Scene::paper().edited(|saw| {
            (saw.accuracy, saw.sweep) = (Accuracy::Draft, None);
            saw.blade.material.youngs_modulus_pa = 1e8;
        });
        let scene = soft.unwrap();
        let material = scene.blade().material;
        let torn = (0.1 * 1e8 / material.density_kg_per_m3).sqrt() / 0.355;
        let message = |limits: &Limits| check(&scene, limits).unwrap_err().to_string();
        let operating = message(&Limits::at(rad_per_s(1250.0)));
        let said = format!(
            "operating_rpm must be at most {:.0} (you gave 1250)",
            rpm(torn) * 0.85 / 1.02
        );
        assert!(operating.starts_with(&said), "{operating}");
        let flutter = message(&Limits {
            limits: asked(4000.0),
            ..Limits::at(rad_per_s(300.0))
        });
        let said = format!(
            "min_flutter_rpm must be at most {:.0} (you gave 4000)",
            rpm(torn) / 1.02
        );
        assert!(flutter.starts_with(&said), "{flutter}");
    }

    /// The program ends the sweep of this saw; limits require much less, and more.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
    fn a_check_finds_what_an_analysis_finds() {
        let scene = Scene::paper()
            .edited(|saw| {
                (saw.accuracy, saw.sweep) = (Accuracy::Draft, None);
            })
            .unwrap();
        let analysis = Analysis::new(&scene).unwrap();
        let limits = |asked_rpm: f64| Limits {
            limits: asked(asked_rpm),
            ..Limits::at(rad_per_s(300.0))
        };
        let near = check(&scene, &limits(400.0)).unwrap();
        let end_rpm = rpm(analysis.range_rad_per_s.to_rad_per_s);
        assert_eq!(near.to_rpm, end_rpm);
        let flutter = analysis.flutter_speed_rad_per_s.unwrap();
        let mut found = near.verdict.limits.iter();
        let asked = found.find(|limit| limit.key == "min_flutter").unwrap();
        assert_eq!(asked.found_rpm, Some(rpm(flutter)));
        let asked_rpm = 1.1 * end_rpm;
        assert!(check(&scene, &limits(asked_rpm)).unwrap().to_rpm > asked_rpm);
    }
}
