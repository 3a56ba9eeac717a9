//! Flutter of two coalesced modes in small systems: changes of onset and growth by a larger basis.

use super::band_error::{BandError, magnitude};
use crate::model::system::GyroscopicSystem;
use crate::modes::{HamiltonianReduction, State};
use crate::stability::band::Instability;

/// Relative changes of onset and growth between two systems, in which σ² of the pair is nearly a parabola in
/// speed.
pub fn merged(
    systems: [&GyroscopicSystem; 2],
    states: &[State; 2],
    band: &Instability,
) -> BandError {
    let humps = systems.map(|system| {
        let model = HamiltonianReduction::new(system, band.frequency_rad_per_s, states)?;
        (model.order() == 4).then_some(())?;
        Hump::new(band, |speed| {
            let [sum, product] = model.pair_invariants(speed);
            -0.25 * (sum - 2.0 * product)
        })
    });
    let [Some(before), Some(after)] = humps else {
        return BandError::default();
    };
    BandError {
        speed: magnitude((after.onset() - before.onset()) / band.from_rad_per_s),
        growth: magnitude(after.growth() / before.growth() - 1.0),
    }
}

/// σ²(Ω) = height − curvature (Ω − top)², and σ² at the peak of the band if the peak is at an end of the band.
struct Hump {
    top: f64,
    height: f64,
    curvature: f64,
    at_peak: Option<f64>,
}

impl Hump {
    fn new(band: &Instability, square: impl Fn(f64) -> f64) -> Option<Self> {
        let mut top = band.peak_rad_per_s;
        let step = 0.25 * band.range().width().max(1e-9 * band.peak_rad_per_s);
        let mut hump = None;
        for _ in 0..8 {
            let [left, middle, right] = [top - step, top, top + step].map(&square);
            let curvature = 0.5 * (2.0 * middle - left - right) / (step * step);
            if curvature.is_nan() || curvature <= 0.0 {
                break;
            }
            let offset = 0.25 * (right - left) / (step * curvature);
            hump = Some(Hump {
                top: top + offset,
                height: middle + curvature * offset * offset,
                curvature,
                at_peak: None,
            });
            top += offset.clamp(-0.02 * band.peak_rad_per_s, 0.02 * band.peak_rad_per_s);
            if offset.abs() < 1e-3 * step {
                break;
            }
        }
        let at_end =
            band.peak_rad_per_s == band.from_rad_per_s || band.peak_rad_per_s == band.to_rad_per_s;
        let at_peak = at_end.then(|| square(band.peak_rad_per_s));
        hump.map(|hump| Hump { at_peak, ..hump })
    }

    fn growth(&self) -> f64 {
        self.at_peak.unwrap_or(self.height).max(0.0).sqrt()
    }

    fn onset(&self) -> f64 {
        self.top - (self.height / self.curvature).max(0.0).sqrt()
    }
}
