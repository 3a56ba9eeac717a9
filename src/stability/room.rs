//! Memory of a chart, before the search.

use super::basis::ChosenBasis;
use super::chart::CHART_SPEEDS;
use super::critical_sides::with_critical_speeds;
use super::error::AnalysisError;
use crate::model::evenly_spaced;
use crate::modes::branches::check_memory;
use crate::modes::{clear_range, highest_reflected, waves_within};

/// A guided saw is assumed to have this share of the modes of its free blade in the window. The paper's saw has 1.2 times as
/// many at the end of sweeps to 5000 and to 20 000 rpm, because guides lower the frequencies of reflected waves.
const REMAINING: f64 = 0.9;

/// Refuses the chart of a guided saw that would not fit into memory, by the waves of its free blade up to the highest
/// reflected one. The reduced model, from which the number of modes is known, takes minutes for such a sweep.
///
/// # Errors
/// [`AnalysisError::Campbell`] where the chart would be too large, or an eigenproblem fails.
pub(super) fn check_room(chosen: &ChosenBasis) -> Result<(), AnalysisError> {
    let (plate, critical) = (&chosen.saw.plate, chosen.critical.as_slice());
    if plate.is_axisymmetric() {
        return Ok(());
    }
    let range = clear_range(critical, chosen.range_rad_per_s);
    let to = range.to_rad_per_s;
    let window = highest_reflected(plate, to)?;
    let waves = waves_within(plate, to, window)?;
    let modes = (REMAINING * waves as f64) as usize;
    let even = evenly_spaced(range.ends(), CHART_SPEEDS);
    let speeds = with_critical_speeds(plate, critical, range, even);
    Ok(check_memory(plate, critical, modes, &speeds)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Accuracy, Scene, SpeedRange};
    use crate::modes::branches::CampbellError;
    use crate::modes::{SpectralModel, Strategy};
    use crate::stability::{Analysis, AnalysisOptions};

    /// The modes of the guided saw at the end of a sweep, by the reduced model of the chart.
    #[test]
    fn a_guided_saw_has_at_least_as_many_modes_in_the_window_as_its_free_blade() {
        for to_rpm in [3000.0, 5000.0] {
            let saw = Scene::paper()
                .swept(SpeedRange::between_rpm(0.0, to_rpm))
                .unwrap();
            let chosen = ChosenBasis::new(&saw, Accuracy::Draft.tolerance()).unwrap();
            let to = clear_range(&chosen.critical, chosen.range_rad_per_s).to_rad_per_s;
            let plate = &chosen.saw.plate;
            let waves = waves_within(plate, to, highest_reflected(plate, to).unwrap()).unwrap();
            let range = chosen.range_rad_per_s;
            let model =
                SpectralModel::with_critical(chosen.saw, chosen.critical, range, Strategy::Reduced);
            let modes = model.unwrap().modes(to).unwrap().len();
            assert!(modes >= waves, "{to_rpm}: {modes} {waves}");
        }
    }

    /// 136 critical speeds: refused before the reduced model and its estimate of the work.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "a large basis: run it in release")]
    fn a_chart_beyond_memory_is_refused_before_its_model() {
        let fast = Scene::paper()
            .edited(|saw| saw.accuracy = Accuracy::Draft)
            .unwrap()
            .swept(SpeedRange::between_rpm(0.0, 20_000.0))
            .unwrap();
        let told = std::sync::atomic::AtomicBool::new(false);
        let tell = |_| told.store(true, std::sync::atomic::Ordering::Relaxed);
        let options = AnalysisOptions {
            expected: Some(&tell),
            ..AnalysisOptions::default()
        };
        match Analysis::with_options(&fast, options) {
            Err(AnalysisError::Campbell(CampbellError::TooLarge {
                largest_end_rpm, ..
            })) => {
                assert!(largest_end_rpm.is_some_and(|end| end < 20_000.0));
            }
            other => panic!("{other:?}"),
        }
        assert!(!told.into_inner());
    }
}
