//! Estimated errors of each result of an analysis, by the change that a larger basis makes on a few modes.

mod band_error;
mod ends;
mod fastest;

use faer::{Col, c64};
use rayon::prelude::*;

pub use self::band_error::BandError;
use self::band_error::magnitude;
use self::ends::change_of_ends;
use self::fastest::fastest;

use super::band::Instability;
use super::basis::REMAINDER;
use super::instability_kind::InstabilityKind;
use super::search_result::StabilityChart;
use crate::model::scene::SpeedRange;
use crate::model::system::GyroscopicSystem;
use crate::modes::branches::SpeedSample;
use crate::modes::{
    BasisError, Cancellation, DescribedMode, DoubleEigenvalue, ModeKind, NamedMode, SpectralModel,
    SpectrumError, Work, companion_eigenpairs, critical_speeds, orthonormal, smallest, split,
};

/// Estimated errors, from the changes that a larger basis would make.
#[derive(Debug)]
pub struct Estimates {
    basis_error: BasisError,
    /// Relative error of each critical speed within the range.
    pub critical: Vec<f64>,
    /// Largest relative error of the lowest frequencies at rest.
    pub at_rest: f64,
    /// Largest error of a drawn frequency, relative to its value in the frame of the blade.
    pub drawn: f64,
    /// Errors of each band.
    pub bands: Vec<BandError>,
    /// Largest backward error, on the full model, of the modes by which the errors are estimated.
    pub backward_error: f64,
}

/// Speeds, as shares of the range, near which the errors of drawn frequencies are estimated.
const LOOKS: [f64; 3] = [0.0, 0.5, 1.0];

impl Estimates {
    /// Estimates the errors of a chart.
    ///
    /// # Errors
    /// [`SpectrumError`] when a small eigenproblem fails.
    pub fn new(
        model: &SpectralModel,
        range: SpeedRange,
        chart: &StabilityChart,
        basis_error: BasisError,
        at_rest: f64,
    ) -> Result<Self, SpectrumError> {
        let within = model
            .critical
            .iter()
            .filter(|c| c.speed_rad_per_s <= range.to_rad_per_s);
        let critical: Vec<f64> = within
            .map(|critical| {
                REMAINDER.get() * basis_error.critical_error(&model.components, critical)
            })
            .collect();
        let samples = &chart.campbell.samples;
        let looks = LOOKS
            .map(|share| range.from_rad_per_s + share * range.width())
            .into_iter()
            .filter_map(|speed| chart.campbell.solved_near(speed))
            .map(|nearest| &samples[nearest]);
        let (mut drawn, mut backward_error) = (0.0_f64, 0.0_f64);
        for sample in looks {
            let speed = sample.speed_rad_per_s;
            let modes = described(model, speed, sample.modes.iter());
            backward_error = largest_backward_error(&modes).max(backward_error);
            let errors = basis_error.frequency_errors(&model.components, speed, &modes);
            drawn = errors
                .into_iter()
                .flatten()
                .map(|e| REMAINDER.get() * e)
                .fold(drawn, f64::max);
        }
        let least = critical.iter().copied().fold(0.0, f64::max);
        let mut estimates = Estimates {
            basis_error,
            critical,
            at_rest,
            drawn,
            bands: Vec::new(),
            backward_error,
        };
        let step = Work::of("errors of bands", chart.instabilities.len());
        let bands: Result<Vec<(BandError, f64)>, SpectrumError> = chart
            .instabilities
            .par_iter()
            .map(|band| {
                Cancellation::current().check()?;
                let at_peak = chart.campbell.solved_near(band.peak_rad_per_s);
                let modes =
                    at_peak.map_or_else(Vec::new, |peak| modes_of(model, band, &samples[peak]));
                let changes = estimates.band(model, band, &modes)?;
                step.advance();
                Ok((changes.of(band, least), largest_backward_error(&modes)))
            })
            .collect();
        for (error, backward) in bands? {
            estimates.bands.push(error);
            estimates.backward_error = estimates.backward_error.max(backward);
        }
        Ok(estimates)
    }

    /// Relative errors of the frequencies of modes at one speed, in the frame of the blade.
    pub fn frequencies(
        &self,
        model: &SpectralModel,
        speed_rad_per_s: f64,
        modes: &[DescribedMode],
    ) -> Vec<Option<f64>> {
        let errors = self
            .basis_error
            .frequency_errors(&model.components, speed_rad_per_s, modes);
        let with_remainder = |error: Option<f64>| error.map(|error| REMAINDER.get() * error);
        errors.into_iter().map(with_remainder).collect()
    }

    /// Changes of a band by the larger basis, from the growing mode at its peak and its neighbours.
    fn band(
        &self,
        model: &SpectralModel,
        band: &Instability,
        modes: &[DescribedMode],
    ) -> Result<BandError, SpectrumError> {
        let is_conservative = model.is_conservative();
        let growth = match (modes.first(), band.kind) {
            (None, _) => None,
            (Some(growing), InstabilityKind::Divergence) if is_conservative => {
                self.standing(model, band, growing)?
            }
            _ => match band.real_peak() {
                Some(end) => self.splitting(model, band, end, modes),
                None => self.grown(model, band, modes)?,
            },
        };
        // A damped band ends where its growth does, so that its ends change with it.
        let speed = if is_conservative {
            change_of_ends(model, &self.basis_error, band)
        } else {
            growth.map(|_| 0.0)
        };
        Ok(BandError { speed, growth })
    }

    /// Projections of a component on some vectors, of which those closer than a tolerance to the span of the others are omitted:
    /// without and with the softening by the larger basis at the peak of a band.
    fn projected(
        &self,
        model: &SpectralModel,
        band: &Instability,
        component: usize,
        vectors: &[Col<f64>],
        tolerance: f64,
    ) -> [GyroscopicSystem; 2] {
        let full = &model.components[component].full;
        let basis = orthonormal(full.order(), vectors, tolerance);
        let found = full.project(basis.as_ref());
        let mut larger = found.clone();
        larger.stiffness -= self
            .basis_error
            .softening(component, band.peak_rad_per_s, &basis);
        [found, larger]
    }

    /// Change of the largest growth of flutter of an undamped blade that grows most at an end where two real λ coalesce, beside a band
    /// of divergence.
    fn splitting(
        &self,
        model: &SpectralModel,
        band: &Instability,
        (end, lambda): (f64, c64),
        modes: &[DescribedMode],
    ) -> Option<f64> {
        let [found, larger] = self.projected_on(model, band, modes, BESIDE_COALESCENCE);
        let before = DoubleEigenvalue::next_to(&found, end, lambda);
        let is_same =
            |before: &DoubleEigenvalue| (before.lambda.re / lambda.re - 1.0).abs() < SAME_GROWTH;
        let before = before.filter(is_same)?;
        let after = DoubleEigenvalue::next_to(&larger, before.speed_rad_per_s, before.lambda)?;
        magnitude(after.lambda.re / before.lambda.re - 1.0)
    }

    /// Change of the largest growth of the modes at the peak of a band. The larger basis shifts a band, so that the largest growth
    /// rates are compared, each at its own speed.
    fn grown(
        &self,
        model: &SpectralModel,
        band: &Instability,
        modes: &[DescribedMode],
    ) -> Result<Option<f64>, SpectrumError> {
        let systems = self.projected_on(model, band, modes, INDEPENDENT);
        let growth = systems.map(|system| fastest(&system, &modes[0], band));
        let [before, after] = growth;
        Ok(magnitude(after? / before? - 1.0))
    }

    /// The component of some modes projected on them, see [`Estimates::projected`].
    fn projected_on(
        &self,
        model: &SpectralModel,
        band: &Instability,
        modes: &[DescribedMode],
        tolerance: f64,
    ) -> [GyroscopicSystem; 2] {
        let component = modes[0].mode.component;
        let halves = modes.iter().flat_map(|m| {
            let (re, im) = split(&model.components[component].coordinates(&m.shape));
            [re, im]
        });
        let halves: Vec<Col<f64>> = halves.collect();
        self.projected(model, band, component, &halves, tolerance)
    }

    /// Change of the largest growth of divergence between two critical speeds, on the waves that stand still there and the growing
    /// mode. `None` if the band ends otherwise, where other waves take part in the growth.
    fn standing(
        &self,
        model: &SpectralModel,
        band: &Instability,
        growing: &DescribedMode,
    ) -> Result<Option<f64>, SpectrumError> {
        let component = growing.mode.component;
        let ends = model.critical.iter().filter(|c| {
            let is_end = |end: f64| (c.speed_rad_per_s / end - 1.0).abs() < SAME_SPEED;
            c.component == component && (is_end(band.from_rad_per_s) || is_end(band.to_rad_per_s))
        });
        let (re, im) = split(&model.components[component].coordinates(&growing.shape));
        let shapes: Vec<Col<f64>> = ends.map(|c| c.shape.clone()).chain([re, im]).collect();
        let [found, larger] = self.projected(model, band, component, &shapes, INDEPENDENT);
        let [before, after] = [
            largest_growth(&found, band)?,
            largest_growth(&larger, band)?,
        ];
        Ok(before
            .zip(after)
            .and_then(|(before, after)| magnitude(after / before - 1.0)))
    }
}

/// Largest growth rate, in 1/s, of divergence of a small system between the two critical speeds that are nearest to those of a band.
fn largest_growth(
    system: &GyroscopicSystem,
    band: &Instability,
) -> Result<Option<f64>, SpectrumError> {
    let critical = critical_speeds(system)?;
    let speeds: Vec<f64> = critical.iter().map(|c| c.speed_rad_per_s).collect();
    let middle = |pair: &&[f64]| {
        (0.5 * (pair[0] + pair[1]) - 0.5 * (band.from_rad_per_s + band.to_rad_per_s)).abs()
    };
    let Some(&[from, to]) = smallest(speeds.windows(2), middle) else {
        return Ok(None);
    };
    let mut growth = 0.0_f64;
    for look in 1..LEANING_LOOKS {
        let speed = from + (to - from) * look as f64 / LEANING_LOOKS as f64;
        let pairs = companion_eigenpairs(system, speed)?;
        let real = pairs.iter().filter(|(lambda, _)| lambda.im <= lambda.re);
        growth = real.fold(growth, |top, (lambda, _)| top.max(lambda.re));
    }
    Ok(Some(growth))
}

/// Relative distance within which the end of a band is a critical speed.
const SAME_SPEED: f64 = 1e-6;
/// Relative difference of growth rates within which a coalescence of the small system is that of the band.
const SAME_GROWTH: f64 = 1e-3;
/// Number of parts of a band of divergence in the search for its largest growth.
const LEANING_LOOKS: usize = 16;
/// Number of modes in the estimate for a damped band.
const NEAR_MODES: usize = 6;
/// Vectors closer than this to the span of the others are omitted: the rest would contain their errors of 1e-6, which the larger basis
/// softens most, because they are in the stiffest waves.
const INDEPENDENT: f64 = 1e-2;
/// The same for the modes beside a coalescence of real λ, which have almost one shape: only their small difference, 1e-3 to 1e-2, tells how
/// λ changes there. On a saw with a pad of 1.5e5 N/m, modes in the middle of the band, which differ more, gave the same change of
/// growth within 0.2 % in twelve bands; without the difference the coalescence of the small system was another one.
const BESIDE_COALESCENCE: f64 = 1e-4;

/// The growing mode of a band at the speed of its peak, and its neighbours: without damping the mode with which it has coalesced, else
/// those of the nearest frequencies. Empty if none grows as the band does.
fn modes_of(model: &SpectralModel, band: &Instability, sample: &SpeedSample) -> Vec<DescribedMode> {
    let distance = |m: &&NamedMode| (m.mode.frequency_rad_per_s() - band.frequency_rad_per_s).abs();
    let close = |m: &&NamedMode| (m.mode.growth_per_s() / band.peak_growth_per_s - 1.0).abs() < 0.1;
    let Some(growing) = smallest(sample.modes.iter().filter(close), distance) else {
        return Vec::new();
    };
    let kept = match growing.mode.kind {
        ModeKind::Divergent => 1,
        ModeKind::Flutter => 2,
        _ => NEAR_MODES,
    };
    let is_other = |m: &&NamedMode| {
        let is_partner =
            growing.mode.kind != ModeKind::Flutter || m.mode.kind == ModeKind::Decaying;
        m.mode.component == growing.mode.component && !std::ptr::eq(*m, growing) && is_partner
    };
    let away = |m: &NamedMode| (m.mode.lambda.im - growing.mode.lambda.im).abs();
    let mut others: Vec<&NamedMode> = sample.modes.iter().filter(is_other).collect();
    others.sort_by(|x, y| away(x).total_cmp(&away(y)));
    let near = [growing].into_iter().chain(others).take(kept);
    described(model, sample.speed_rad_per_s, near)
}

fn largest_backward_error(modes: &[DescribedMode]) -> f64 {
    let errors = modes.iter().map(|m| m.backward_error);
    errors.fold(0.0, f64::max)
}

/// Modes of one speed with their shapes.
fn described<'a>(
    model: &SpectralModel,
    speed_rad_per_s: f64,
    modes: impl Iterator<Item = &'a NamedMode>,
) -> Vec<DescribedMode> {
    model.describe(speed_rad_per_s, modes.map(|m| m.mode.clone()).collect())
}
