//! Estimated errors of each result of an analysis.

mod band_error;
mod damped;
mod hump;

use faer::{Col, Mat, c64};
use rayon::prelude::*;

pub use self::band_error::BandError;
use self::band_error::magnitude;
use self::damped::fastest;
use self::hump::merged;

use super::band::{Instability, InstabilityKind};
use super::basis::REMAINDER;
use super::search_result::StabilityChart;
use crate::model::scene::SpeedRange;
use crate::model::system::GyroscopicSystem;
use crate::modes::branches::SpeedSample;
use crate::modes::{
    Cancellation, DescribedMode, LargerBasis, ModeKind, SpectralModel, SpectrumError, State, Work,
    companion_eigenpairs, critical_speeds, orthonormal, smallest, split,
};

/// Estimated errors, from the changes that a larger basis would make.
#[derive(Debug)]
pub struct Estimates {
    larger: LargerBasis,
    /// Relative error of each critical speed within the range.
    pub critical: Vec<f64>,
    /// Largest relative error of the lowest frequencies at rest.
    pub at_rest: f64,
    /// Largest error of a drawn frequency, relative to its value in the frame of the blade.
    pub drawn: f64,
    /// Errors of each band.
    pub bands: Vec<BandError>,
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
        larger: LargerBasis,
        at_rest: f64,
    ) -> Result<Self, SpectrumError> {
        let within = model
            .critical
            .iter()
            .filter(|c| c.speed_rad_per_s <= range.to_rad_per_s);
        let critical: Vec<f64> = within
            .map(|critical| REMAINDER.get() * larger.critical_error(&model.components, critical))
            .collect();
        let samples = &chart.campbell.samples;
        let looks = LOOKS
            .map(|share| range.from_rad_per_s + share * range.width())
            .into_iter()
            .filter_map(|speed| smallest(samples, |sample| (sample.speed_rad_per_s - speed).abs()));
        let errors = looks.flat_map(|sample| {
            larger.frequency_errors(&model.components, sample.speed_rad_per_s, &sample.modes)
        });
        let drawn = REMAINDER.get() * errors.flatten().fold(0.0, f64::max);
        let least = critical.iter().copied().fold(0.0, f64::max);
        let mut estimates = Estimates {
            larger,
            critical,
            at_rest,
            drawn,
            bands: Vec::new(),
        };
        let step = Work::of("errors of bands", chart.instabilities.len());
        let bands: Result<Vec<BandError>, SpectrumError> = chart
            .instabilities
            .par_iter()
            .map(|band| {
                Cancellation::current().check()?;
                let at_peak = samples
                    .iter()
                    .find(|s| s.speed_rad_per_s == band.peak_rad_per_s);
                let changes = match at_peak {
                    Some(sample) => estimates.band(model, band, sample)?,
                    None => BandError::default(),
                };
                step.advance();
                Ok(changes.of(band, least))
            })
            .collect();
        estimates.bands = bands?;
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
            .larger
            .frequency_errors(&model.components, speed_rad_per_s, modes);
        let with_remainder = |error: Option<f64>| error.map(|error| REMAINDER.get() * error);
        errors.into_iter().map(with_remainder).collect()
    }

    /// Changes of a band by the larger basis, from the modes at its peak.
    fn band(
        &self,
        model: &SpectralModel,
        band: &Instability,
        sample: &SpeedSample,
    ) -> Result<BandError, SpectrumError> {
        let Some(modes) = modes_of(band, &sample.modes) else {
            return Ok(BandError::default());
        };
        match (band.kind, model.is_conservative()) {
            (InstabilityKind::Divergence, true) => self.standing(model, band, modes[0]),
            (InstabilityKind::Flutter, true) => Ok(self.merging(model, band, modes)),
            _ => self.damped(model, band, modes[0], &sample.modes),
        }
    }

    /// Projects a component on some vectors, without and with the softening by the larger basis at the peak
    /// of a band. Returns an orthonormal basis of the vectors, and both projections.
    fn projected(
        &self,
        model: &SpectralModel,
        band: &Instability,
        component: usize,
        vectors: &[Col<f64>],
    ) -> (Mat<f64>, [GyroscopicSystem; 2]) {
        let full = &model.components[component].full;
        let basis = orthonormal(full.order(), vectors, INDEPENDENT);
        let found = full.project(basis.as_ref());
        let mut larger = found.clone();
        larger.stiffness -= self
            .larger
            .softening(component, band.peak_rad_per_s, &basis);
        (basis, [found, larger])
    }

    /// Estimates flutter of an undamped blade on the two waves that coalesce.
    fn merging(
        &self,
        model: &SpectralModel,
        band: &Instability,
        modes: [&DescribedMode; 2],
    ) -> BandError {
        let component = modes[0].mode.component;
        let halves = modes.map(|m| split(&model.components[component].coordinates(&m.shape)));
        let vectors: Vec<Col<f64>> = halves
            .iter()
            .flat_map(|(re, im)| [re.clone(), im.clone()])
            .collect();
        let (basis, [found, larger]) = self.projected(model, band, component, &vectors);
        let states = [0, 1].map(|k| {
            let (re, im) = &halves[k];
            let (re, im) = (basis.transpose() * re, basis.transpose() * im);
            let q = Col::from_fn(re.nrows(), |i| c64::new(re[i], im[i]));
            State::new(&found, band.peak_rad_per_s, (modes[k].mode.lambda, q))
        });
        merged([&found, &larger], &states, band)
    }

    /// Estimates growth of a damped blade on the growing mode and its neighbours. The larger basis shifts the
    /// band, so the largest growth rates are compared, each at its own speed.
    fn damped(
        &self,
        model: &SpectralModel,
        band: &Instability,
        growing: &DescribedMode,
        modes: &[DescribedMode],
    ) -> Result<BandError, SpectrumError> {
        let component = growing.mode.component;
        let own = modes.iter().filter(|m| m.mode.component == component);
        let mut near: Vec<&DescribedMode> = own.collect();
        let away = |m: &DescribedMode| (m.mode.lambda.im - growing.mode.lambda.im).abs();
        near.sort_by(|x, y| away(x).total_cmp(&away(y)));
        let halves: Vec<Col<f64>> = near
            .iter()
            .take(NEAR_MODES)
            .flat_map(|m| {
                let (re, im) = split(&model.components[component].coordinates(&m.shape));
                [re, im]
            })
            .collect();
        let (_, systems) = self.projected(model, band, component, &halves);
        let [before, after] = systems.map(|system| fastest(&system, growing, band));
        Ok(BandError {
            speed: None,
            growth: magnitude(after? / before? - 1.0),
        })
    }

    /// Estimates divergence between two critical speeds on the waves that stand still there and the growing
    /// mode. The larger basis shifts both speeds and changes the growth between them.
    fn standing(
        &self,
        model: &SpectralModel,
        band: &Instability,
        growing: &DescribedMode,
    ) -> Result<BandError, SpectrumError> {
        let component = growing.mode.component;
        let ends = model.critical.iter().filter(|c| {
            let is_end = |end: f64| (c.speed_rad_per_s / end - 1.0).abs() < SAME_SPEED;
            c.component == component && (is_end(band.from_rad_per_s) || is_end(band.to_rad_per_s))
        });
        let (re, im) = split(&model.components[component].coordinates(&growing.shape));
        let shapes: Vec<Col<f64>> = ends.map(|c| c.shape.clone()).chain([re, im]).collect();
        let (_, [found, larger]) = self.projected(model, band, component, &shapes);
        let [before, after] = [Lean::new(&found, band)?, Lean::new(&larger, band)?];
        let [Some(before), Some(after)] = [before, after] else {
            return Ok(BandError::default());
        };
        Ok(BandError {
            speed: magnitude(after.from / before.from - 1.0),
            growth: magnitude(after.growth / before.growth - 1.0),
        })
    }
}

/// Divergence of a small system between two critical speeds.
struct Lean {
    /// Speed at which it begins, in rad/s.
    from: f64,
    /// Largest growth rate, in 1/s.
    growth: f64,
}

impl Lean {
    /// The band of a small system that is nearest to a known band.
    fn new(system: &GyroscopicSystem, band: &Instability) -> Result<Option<Self>, SpectrumError> {
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
        Ok(Some(Lean { from, growth }))
    }
}

/// Relative distance within which the end of a band is a critical speed.
const SAME_SPEED: f64 = 1e-6;
/// Number of parts of a band of divergence in the search for its largest growth.
const LEANING_LOOKS: usize = 16;
/// Number of modes in the estimate for a damped band.
const NEAR_MODES: usize = 6;
/// Vectors closer than this to the span of the others are omitted.
const INDEPENDENT: f64 = 1e-6;

/// The growing mode of a band, and the mode with which it has coalesced; for a damped blade the mode of the
/// nearest frequency, for divergence the same mode again.
fn modes_of<'a>(band: &Instability, modes: &'a [DescribedMode]) -> Option<[&'a DescribedMode; 2]> {
    let distance =
        |m: &&DescribedMode| (m.mode.frequency_rad_per_s() - band.frequency_rad_per_s).abs();
    let nearest = |modes: &mut dyn Iterator<Item = &'a DescribedMode>| smallest(modes, distance);
    let close =
        |m: &&DescribedMode| (m.mode.growth_per_s() / band.peak_growth_per_s - 1.0).abs() < 0.1;
    let growing = nearest(&mut modes.iter().filter(close))?;
    let own = |m: &&DescribedMode| m.mode.component == growing.mode.component;
    let partner = match growing.mode.kind {
        ModeKind::Flutter => {
            let decaying = |m: &&DescribedMode| m.mode.kind == ModeKind::Decaying;
            nearest(&mut modes.iter().filter(own).filter(decaying))?
        }
        ModeKind::Divergent => growing,
        _ => {
            let others = modes.iter().filter(|m| !std::ptr::eq(*m, growing));
            nearest(&mut others.filter(own))?
        }
    };
    Some([growing, partner])
}
