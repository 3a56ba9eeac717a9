//! Amplitude to which the flutter of each band rises.

use faer::c64;

use crate::modes::{SpectrumError, Work};
use crate::motion::stretched_blade::{FlutterRise, Saturation, StretchedError};
use crate::stability::{Analysis, Instability, InstabilityKind};

/// Amplitude to which the flutter of a band rises; `None` for divergence, and if the blade without damping does not
/// flutter; the reason if the amplitude could not be computed.
pub type Rise = Result<Option<Saturation>, StretchedError>;

/// Amplitude to which the flutter of each band rises at the speed of its largest growth.
///
/// # Errors
/// [`StretchedError`] if no amplitude of this blade can be computed, or the computation was cancelled.
pub fn saturations(analysis: &Analysis) -> Result<Vec<Rise>, StretchedError> {
    let bands = &analysis.chart.instabilities;
    let flutters = |band: &&Instability| band.kind == InstabilityKind::Flutter;
    let count = bands.iter().filter(flutters).count();
    if count == 0 {
        return Ok(bands.iter().map(|_| Ok(None)).collect());
    }
    let rise = FlutterRise::new(&analysis.model.plate)?;
    let work = Work::of("bands of flutter", count);
    let of_band = |band: &Instability| match band.kind {
        InstabilityKind::Divergence => Ok(Ok(None)),
        InstabilityKind::Flutter => {
            let lambda = c64::new(band.peak_growth_per_s, band.frequency_rad_per_s);
            let found = rise.near(band.peak_rad_per_s, lambda);
            work.advance();
            match found {
                Err(StretchedError::Spectrum(SpectrumError::Cancelled)) => found.map(Ok),
                found => Ok(found),
            }
        }
    };
    bands.iter().map(of_band).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Accuracy, Scene, rad_per_s};

    /// At the edge of a band two eigenvalues are equal, and Newton's method for one of them does not converge: the other
    /// bands keep their amplitudes, and this one says that it has none.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
    fn an_amplitude_that_does_not_converge_leaves_the_others() {
        let scene = Scene::paper()
            .edited(|saw| saw.accuracy = Accuracy::Draft)
            .unwrap();
        let mut analysis = Analysis::new(&scene).unwrap();
        let whole = saturations(&analysis).unwrap();
        let flutters = |found: &Rise| matches!(found, Ok(Some(_)));
        let place = whole.iter().position(flutters).unwrap();
        let band = &mut analysis.chart.instabilities[place];
        (band.peak_rad_per_s, band.peak_growth_per_s) = (band.from_rad_per_s, 0.0);
        let found = saturations(&analysis).unwrap();
        assert!(found[place].is_err(), "{:?}", found[place]);
        for (k, (one, other)) in whole.iter().zip(&found).enumerate() {
            let equal = one.as_ref().ok() == other.as_ref().ok();
            assert_eq!(equal, k != place, "{one:?} {other:?}");
        }
        let mut report = analysis.report();
        report.add_amplitudes(&analysis).unwrap();
        let entry = &report.instabilities[place];
        assert_eq!(entry.saturated_amplitude_m, None);
        assert!(entry.amplitude_not_computed.is_some());
        let summary = report.summary();
        assert!(summary.contains("not computed"), "{summary}");
        let limits = crate::model::scene::LimitsFile {
            max_amplitude_m: Some(1.0),
            ..Default::default()
        };
        let operating = rad_per_s(1000.0);
        let verdict =
            crate::analyses::check::judged(&analysis, &limits, None, Some(operating), &found);
        let mut of_all = verdict.limits.iter();
        let criterion = of_all.find(|limit| limit.key == "max_amplitude").unwrap();
        assert!(criterion.finding.contains("not computed"), "{criterion:?}");
    }
}
