//! Calibration: determines numbers of a scene from frequencies measured over speed.
//!
//! The sum of squares is minimized within bounds by the trust-region reflective method from several starts,
//! which are spread over the bounds, and from the best result with two guides exchanged. The search uses a
//! coarse basis; the best results are refined on the basis that the scene's tolerance requires. Frequencies are
//! |Im λ|/2π in space, and zero for a wave that diverges. The measured frequencies of a row, sorted, are
//! compared with the lowest computed ones, as in the calibration of the paper's saw with its Table 5.
//!
//! ```
//! use sawflutter::analyses::fit::{Measurement, Options, fit};
//! use sawflutter::model::plate::Resolution;
//! use sawflutter::model::scene::{Freed, Scene};
//!
//! let scene = Scene::paper();
//! let measured = scene.file().measured.as_ref().expect("the paper's Table 5");
//! let measurement = Measurement::of_scene(measured).up_to(1250.0);
//! let radius = Freed::new(scene.file(), "guides[0].radius_m", 0.1, 0.355)?;
//! let small = Resolution { max_diameters: 8, radial_functions: 4 };
//! let options = Options { resolution: Some(small), ..Options::default() };
//! let found = fit(&scene, &measurement, &[radius], &options, &|_, _| ())?;
//! assert!(found.rms_hz < 1.2 && (found.parameters[0].value - 0.2).abs() < 0.02);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cells;
pub(crate) mod chart;
mod columns;
mod comparison;
mod error;
mod exchange;
mod labview;
mod least_squares;
mod matching;
mod measurement;
mod minima;
mod model;
mod number_column;
mod options;
mod outline;
mod peaks;
mod report;
mod request;
mod starts;
mod table;
mod titles;

use crate::model::evenly_spaced;
use crate::model::plate::Resolution;
use crate::model::scene::{
    Freed, Parted, Scene, SceneError, SceneFile, SpeedRange, effective, rad_per_s, scene_at,
    unusual_number,
};
use crate::modes::SpectrumError;
use crate::modes::branches::Progress;
use crate::page::text::{Kind, OtherEncodings};
use crate::stability::ChosenBasis;
pub(crate) use outline::outline;

pub use columns::number_columns;
use comparison::Compared;
pub use error::FitError;
use least_squares::{Found, at_bound, statistics};
pub use measurement::{Columns, Measurement, Row};
use minima::{EQUAL_HZ, equally_good};
use model::Model;
pub use number_column::NumberColumn;
pub use options::Options;
pub use peaks::peaks;
pub use report::{Curves, FitReport, FittedParameter, Minimum, Residual, Start};
pub use request::Request;
use starts::{Searched, refined, search};

/// Largest size and encodings of a table of frequencies, which usually has the length of a page.
pub const TABLE_FILE: Kind = Kind {
    limit: 1 << 20,
    other_encodings: OtherEncodings::AsLatin1,
};

/// Shares at which the effect of a number is examined.
const LOOKED_AT: [f64; 3] = [0.1, 0.37, 0.83];
/// Tolerance that suffices to compare starts and to find numbers without effect.
const COARSE_TOLERANCE: f64 = 1e-2;

/// Number of speeds of the curves.
const CURVE_SPEEDS: usize = 121;
/// End of the curves, relative to the last fitted speed.
const BEYOND: f64 = 1.12;

/// Fits the freed numbers p of a scene: minimizes Σ (f_k(p) − f̂_k)², with the k-th lowest computed
/// frequency f_k of a row in Hz and the measured one f̂_k. Intervals follow from the linearized problem
/// with Student's t. Other minima that fit about as well are reported beside the best.
///
/// # Errors
/// [`FitError`] if the measurement does not determine the freed numbers, or no start between the bounds
/// can be analysed.
pub fn fit(
    scene: &Scene,
    measured: &Measurement,
    freed: &[Freed],
    options: &Options,
    progress: Progress<'_>,
) -> Result<FitReport, FitError> {
    let measurement = &measured.up_to(options.to_rpm);
    let coarse = match options.resolution {
        Some(resolution) => resolution,
        None => {
            let tolerance = scene.tolerance().max(COARSE_TOLERANCE);
            basis(scene, measurement, tolerance)?.saw.plate.resolution
        }
    };
    let coarse = holding(coarse, measurement);
    let Parted {
        moving: freed,
        idle: without_effect,
    } = parted(scene, measurement, freed, coarse)?;
    check_determined(freed.len(), measurement.count())?;
    let model = |resolution| Model {
        scene: scene.file(),
        freed: &freed,
        measurement,
        resolution,
    };
    let Searched { starts, candidates } = search(&model(coarse), options, progress)?;
    let Some(best_start) = candidates.first() else {
        let starts = starts.len();
        return Err(FitError::NoStart { starts });
    };
    let (resolution, estimated_relative_error) = match options.resolution {
        Some(resolution) => (resolution, None),
        None => {
            let near = scene_at(scene.file(), &freed, &best_start.shares)?;
            let chosen = basis(&near, measurement, scene.tolerance())?;
            let error = chosen.estimated_relative_error;
            (chosen.saw.plate.resolution, Some(error))
        }
    };
    let resolution = holding(resolution, measurement);
    let fine = model(resolution);
    let mut reached = refined(&fine, &candidates)?;
    if reached.is_empty() {
        reached.push(best_start.clone());
    }
    let (best, others) = (&reached[0], &reached[1..]);
    let spread = statistics(&fine, &best.shares, options.confidence)?;
    let equal = equally_good(best, others, &spread, options.confidence);
    let other_minima = equal
        .into_iter()
        .map(|found| {
            let own = statistics(&fine, &found.shares, options.confidence)?;
            Ok(Minimum {
                rms_hz: found.rms_hz,
                parameters: parameters(scene, &freed, &found.shares, &own.half_widths)?,
            })
        })
        .collect::<Result<_, FitError>>()?;
    let before = fine.residuals_of_saw_hz(scene)?;
    let fitted = calibrated(scene, measurement, &freed, best)?;
    let compared = Compared::new(scene, &fitted, resolution);
    let residuals = compared.residuals(measured, options.to_rpm)?;
    let deepest = residuals.iter().map(|r| r.place).max().unwrap_or(0);
    let end_rpm = BEYOND * measurement.end_of_range_rpm();
    let mut report = FitReport {
        sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
        scene: fitted.file().clone(),
        condition: fitted.condition(),
        unusual_numbers: unusual_numbers(fitted.file(), measurement),
        source: measurement.source.clone(),
        confidence: options.confidence,
        parameters: parameters(scene, &freed, &best.shares, &spread.half_widths)?,
        without_effect: without_effect.iter().map(path).collect(),
        other_minima,
        correlation: spread.correlation,
        measured_frequencies: measurement.count(),
        degrees_of_freedom: spread.degrees_of_freedom,
        rms_hz: best.rms_hz,
        rms_before_hz: rms(&before),
        curves: compared.curves(evenly_spaced([0.0, end_rpm], CURVE_SPEEDS), deepest)?,
        residuals,
        starts,
        max_diameters: resolution.max_diameters,
        radial_functions: resolution.radial_functions_on(fitted.blade()),
        estimated_relative_error,
        warnings: Vec::new(),
    };
    report.warnings = report.remarks(measurement);
    Ok(report)
}

/// Unusual numbers of the scene, and the highest measured speed if it is unusual and the scene does not contain the
/// measurement.
fn unusual_numbers(scene: &SceneFile, measurement: &Measurement) -> Vec<String> {
    let mut unusual = scene.unusual_numbers();
    let of_measurement = |sentence: &String| sentence.contains("measured.rows");
    if !unusual.iter().any(of_measurement) {
        let label = "the highest measured speed";
        let top_rpm = measurement.top_rpm();
        unusual.extend(unusual_number(scene, label, "sweep.to_rpm", top_rpm));
    }
    unusual
}

/// Checks that the measured frequencies can determine so many free numbers.
fn check_determined(free: usize, measured: usize) -> Result<(), FitError> {
    match free {
        0 => Err(FitError::NothingFree),
        free if measured <= free => Err(FitError::TooFew { measured, free }),
        _ => Ok(()),
    }
}

/// Divides the freed numbers into those that change a measured frequency and the others.
fn parted(
    scene: &Scene,
    measurement: &Measurement,
    freed: &[Freed],
    resolution: Resolution,
) -> Result<Parted, SpectrumError> {
    let model = Model {
        scene: scene.file(),
        freed,
        measurement,
        resolution,
    };
    let residuals = |shares: &[f64]| {
        let residuals = model.residuals_hz(shares)?;
        Ok((!residuals.iter().any(|r| r.is_nan())).then_some(residuals))
    };
    let differ = |x: &Vec<f64>, y: &Vec<f64>| {
        let mut pairs = x.iter().zip(y);
        pairs.any(|(x, y)| (x - y).abs() > EQUAL_HZ)
    };
    effective(scene, freed, &LOOKED_AT, residuals, differ)
}

/// Widest half of an interval as a share of the bounds: a wider interval contains no more information than
/// the bounds.
const WIDEST_HALF: f64 = 0.5;

/// The free numbers with their results, from shares of the bounds.
fn parameters(
    scene: &Scene,
    freed: &[Freed],
    shares: &[f64],
    half_widths: &[Option<f64>],
) -> Result<Vec<FittedParameter>, SceneError> {
    let numbers = freed.iter().enumerate().map(|(k, freed)| {
        let half_width = half_widths[k].filter(|h| *h <= WIDEST_HALF);
        let end = |half_width: f64| freed.value(shares[k] + half_width);
        Ok(FittedParameter {
            path: path(freed),
            start: freed.parameter.get(scene.file())?,
            value: freed.value(shares[k]),
            interval_from: half_width.map(|h| end(-h)),
            interval_to: half_width.map(end),
            bound_from: freed.from,
            bound_to: freed.to,
            at_bound: at_bound(shares[k]),
        })
    });
    numbers.collect()
}

fn path(freed: &Freed) -> String {
    freed.parameter.path().to_owned()
}

/// Root mean square of residuals.
fn rms(residuals: &[f64]) -> f64 {
    (residuals.iter().map(|r| r * r).sum::<f64>() / residuals.len() as f64).sqrt()
}

/// A basis that also has the nodal diameters by which frequencies are named.
fn holding(resolution: Resolution, measurement: &Measurement) -> Resolution {
    let max_diameters = resolution.max_diameters.max(measurement.most_diameters());
    Resolution {
        max_diameters,
        ..resolution
    }
}

/// The basis for a tolerance up to the measured speeds.
fn basis(
    scene: &Scene,
    measurement: &Measurement,
    tolerance: f64,
) -> Result<ChosenBasis, FitError> {
    let end_rad_per_s = rad_per_s(measurement.end_of_range_rpm());
    let swept = scene.swept(SpeedRange::new(0.0, end_rad_per_s))?;
    Ok(ChosenBasis::new(&swept, tolerance)?)
}

/// The scene with the fitted numbers, and a note on their origin.
fn calibrated(
    scene: &Scene,
    measurement: &Measurement,
    freed: &[Freed],
    best: &Found,
) -> Result<Scene, SceneError> {
    let names: Vec<&str> = freed.iter().map(|f| f.parameter.path()).collect();
    let note = format!(
        "{}: fitted to {} measured frequencies ({}), {:.4} Hz rms",
        names.join(", "),
        measurement.count(),
        measurement.source,
        best.rms_hz
    );
    scene_at(scene.file(), freed, &best.shares)?.edited(|file| {
        file.notes.push(note);
        if file.measured.is_none() {
            file.measured = Some(measurement.as_scene_block());
        }
    })
}
