//! Calibration: determines numbers of a scene from frequencies measured over speed.
//!
//! The sum of squares is minimized within bounds by the trust-region reflective method from several starts,
//! which are spread over the bounds. The search uses a coarse basis; the best results are refined on the
//! basis that the scene's tolerance requires. Frequencies are |Im λ|/2π in space, and zero for a wave that
//! diverges. The measured frequencies of a row, sorted, are compared with the lowest computed ones, as in the
//! calibration of the paper's saw with its Table 5.
//!
//! ```
//! use sawflutter::fit::{Fit, Measurement, Options};
//! use sawflutter::plate::Resolution;
//! use sawflutter::scene::{Freed, Scene};
//!
//! let scene = Scene::paper();
//! let measured = scene.file().measured.as_ref().expect("the paper's Table 5");
//! let measurement = Measurement::of_scene(measured).up_to(1250.0);
//! let radius = Freed::new(scene.file(), "guides[0].radius_m", 0.1, 0.355)?;
//! let small = Resolution { max_diameters: 8, radial_functions: 4 };
//! let options = Options { resolution: Some(small), ..Options::default() };
//! let fit = Fit::new(&scene, &measurement, &[radius], &options, &|_, _| ())?;
//! assert!(fit.rms_hz < 1.2 && (fit.parameters[0].value - 0.2).abs() < 0.02);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod compared;
mod error;
mod measurement;
mod model;
mod solve;
mod starts;
mod table;

use crate::campbell::Progress;
use crate::plate::Resolution;
use crate::scene::{Freed, RefusedValue, Scene, SceneError, effective, rad_per_s, scene_at};
use crate::spectrum::SpectrumError;
use crate::stability::ChosenBasis;

pub(crate) use compared::Compared;
pub use compared::Curves;
pub use error::FitError;
pub use measurement::{Measurement, Row};
use model::Model;
use solve::{Found, at_bound, statistics};
pub use starts::Start;
use starts::{refined, search};

/// Confidence, starts and speeds of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Probability that an interval contains the true value.
    pub confidence: f64,
    /// Number of starts: the original values, and others spread over the bounds.
    pub starts: usize,
    /// Seed of the other starts.
    pub seed: u64,
    /// Speed in rpm up to which rows are fitted.
    pub to_rpm: f64,
    /// A basis to use instead of the one that the tolerance of the scene requires.
    pub resolution: Option<Resolution>,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            confidence: 0.95,
            starts: 12,
            seed: 0,
            to_rpm: f64::INFINITY,
            resolution: None,
        }
    }
}

/// Largest number of starts, far more than are needed to find the lowest minimum.
const MAX_STARTS: usize = 1000;

impl Options {
    /// Checks the options for a fit to a measurement.
    ///
    /// # Errors
    /// [`RefusedValue`] that names the option, or the last speed if nothing is measured up to it.
    pub fn checked(self, measurement: &Measurement) -> Result<Self, RefusedValue> {
        if !(self.confidence > 0.0 && self.confidence < 1.0) {
            let (key, remedy) = ("confidence", "0.95 is usual");
            let allowed = "between 0 and 1";
            return Err(RefusedValue::new(key, self.confidence, allowed, remedy));
        }
        if !(1..=MAX_STARTS).contains(&self.starts) {
            let allowed = format!("from 1 to {MAX_STARTS}");
            let remedy = "a dozen is usual";
            return Err(RefusedValue::new("starts", self.starts, allowed, remedy));
        }
        if measurement.count() > 0 && measurement.up_to(self.to_rpm).count() == 0 {
            let source = &measurement.source;
            let allowed = format!("at least the lowest speed of {source} with a frequency");
            let remedy = "give a higher speed, or another table";
            return Err(RefusedValue::new("to_rpm", self.to_rpm, allowed, remedy));
        }
        Ok(self)
    }
}

/// A free number and its fitted value.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedParameter {
    /// The number and its bounds.
    pub freed: Freed,
    /// Value in the scene.
    pub start: f64,
    /// Fitted value.
    pub value: f64,
    /// Confidence interval. `None` at a bound, and if the data do not determine this number: they do not
    /// distinguish it from others, or the interval is wider than the distance between its bounds.
    pub interval: Option<(f64, f64)>,
    /// Whether the value is a bound.
    pub at_bound: bool,
}

/// A scene fitted to measured frequencies.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The fitted saw.
    pub scene: Scene,
    /// The original saw.
    pub before: Scene,
    /// The measurement.
    pub measurement: Measurement,
    /// Speed in rpm up to which rows were fitted.
    pub to_rpm: f64,
    /// Probability that an interval contains the true value.
    pub confidence: f64,
    /// The free numbers and their fitted values.
    pub parameters: Vec<FittedParameter>,
    /// Freed numbers that change no measured frequency, or whose effect other numbers have as well, such as
    /// one of the angles if all guides may turn. They keep their values.
    pub without_effect: Vec<Freed>,
    /// Correlation of the parameters, with one row and one column for each.
    pub correlation: Vec<Vec<f64>>,
    /// Number of measured frequencies minus number of free numbers.
    pub degrees_of_freedom: usize,
    /// Root mean square of computed minus measured frequencies.
    pub rms_hz: f64,
    /// Root mean square of computed minus measured frequencies before the fit.
    pub rms_before_hz: f64,
    /// Basis of the fit.
    pub resolution: Resolution,
    /// Estimated relative error of the critical speeds; `None` if the basis was given.
    pub estimated_relative_error: Option<f64>,
    /// All starts, on a coarser basis.
    pub(crate) starts: Vec<Start>,
    /// Computed frequencies before and after the fit.
    pub(crate) compared: Compared,
}

/// Shares at which the effect of a number is examined.
const LOOKED_AT: [f64; 3] = [0.1, 0.37, 0.83];
/// A number whose changes move every measured frequency by less than this, in Hz, has no effect.
const IDLE_HZ: f64 = 1e-5;
/// Tolerance that suffices to compare starts and to find numbers without effect.
const COARSE_TOLERANCE: f64 = 1e-2;

impl Fit {
    /// Fits the freed numbers p of a scene: minimizes Σ (f_k(p) − f̂_k)², with the k-th lowest computed
    /// frequency f_k of a row in Hz and the measured one f̂_k. Intervals follow from the linearized problem
    /// with Student's t; the covariance is (JᵀJ)⁻¹ times the variance of the residuals.
    ///
    /// # Errors
    /// [`FitError`] if the measurement does not determine the freed numbers, or no start between the bounds
    /// can be analysed.
    pub fn new(
        scene: &Scene,
        measured: &Measurement,
        freed: &[Freed],
        options: &Options,
        progress: Progress<'_>,
    ) -> Result<Self, FitError> {
        let measurement = &measured.up_to(options.to_rpm);
        let coarse = match options.resolution {
            Some(resolution) => resolution,
            None => basis(scene, measurement, scene.tolerance().max(COARSE_TOLERANCE))?.0,
        };
        let (freed, without_effect) = moving(scene, measurement, freed, coarse)?;
        check_determined(freed.len(), measurement.count())?;
        let model = |resolution| Model {
            scene: scene.file(),
            freed: &freed,
            measurement,
            resolution,
        };
        let (starts, candidates) = search(&model(coarse), options, progress)?;
        let Some(best) = candidates.first() else {
            let starts = starts.len();
            return Err(FitError::NoStart { starts });
        };
        let (resolution, estimated_relative_error) = match options.resolution {
            Some(resolution) => (resolution, None),
            None => {
                let near = scene_at(scene.file(), &freed, &best.shares)?;
                let (resolution, error) = basis(&near, measurement, scene.tolerance())?;
                (resolution, Some(error))
            }
        };
        let fine = model(resolution);
        let best = refined(&fine, &candidates)?.unwrap_or_else(|| best.clone());
        let spread = statistics(&fine, &best.shares, options.confidence)?;
        let before = fine.residuals_of_saw_hz(scene)?;
        let fitted = calibrated(scene, measurement, &freed, &best)?;
        let to_rpm = options.to_rpm;
        Ok(Fit {
            compared: Compared::new([scene, &fitted], measured, to_rpm, resolution)?,
            scene: fitted,
            before: scene.clone(),
            measurement: measured.clone(),
            to_rpm,
            confidence: options.confidence,
            parameters: parameters(scene, &freed, &best.shares, &spread.half_widths)?,
            without_effect,
            correlation: spread.correlation,
            degrees_of_freedom: spread.degrees_of_freedom,
            rms_hz: best.rms_hz,
            rms_before_hz: rms(&before),
            resolution,
            estimated_relative_error,
            starts,
        })
    }
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
fn moving(
    scene: &Scene,
    measurement: &Measurement,
    freed: &[Freed],
    resolution: Resolution,
) -> Result<(Vec<Freed>, Vec<Freed>), SpectrumError> {
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
        pairs.any(|(x, y)| (x - y).abs() > IDLE_HZ)
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
        let end = |half_width: f64| freed.value(shares[k] + half_width);
        Ok(FittedParameter {
            freed: freed.clone(),
            start: freed.parameter.get(scene.file())?,
            value: freed.value(shares[k]),
            interval: half_widths[k]
                .filter(|h| *h <= WIDEST_HALF)
                .map(|h| (end(-h), end(h))),
            at_bound: at_bound(shares[k]),
        })
    });
    numbers.collect()
}

/// Root mean square of residuals.
fn rms(residuals: &[f64]) -> f64 {
    (residuals.iter().map(|r| r * r).sum::<f64>() / residuals.len() as f64).sqrt()
}

/// The basis for a tolerance up to the measured speeds, with its estimated error.
fn basis(
    scene: &Scene,
    measurement: &Measurement,
    tolerance: f64,
) -> Result<(Resolution, f64), FitError> {
    let end_rad_per_s = rad_per_s(measurement.end_of_range_rpm());
    let swept = scene.swept((0.0, end_rad_per_s).into())?;
    let chosen = ChosenBasis::new(&swept, tolerance)?;
    Ok((chosen.saw.plate.resolution, chosen.estimated_relative_error))
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
