//! Counts of growing modes of a damped saw on the full model, by the argument principle.

use rayon::prelude::*;

use faer::c64;

use super::spectrum::{Solver, Spectrum};
use crate::model::scene::SpeedRange;
use crate::modes::{FullModel, SpectralModel, SpectrumError};
use crate::stability::band::Instability;
use crate::stability::mode_counts::MiscountedModes;
use crate::stability::undamped::drawn_share;

/// Number of bands, from the lowest, with counts on both sides of their onsets; each count takes about forty
/// determinants.
const MOST_BANDS: usize = 8;
/// Number of further speeds of counts, drawn at random from a fixed seed.
const DRAWN: u64 = 4;
/// Distance of a count from an onset, as a share of the band's width.
const BESIDE: f64 = 0.02;
/// Smallest such distance, as a share of the speed.
const LEAST_BESIDE: f64 = 1e-4;
/// The window ends in the widest gap above this share of the highest accurate frequency.
const LEAST_WINDOW: f64 = 0.6;

/// Results of the counts; none for a free blade, free rigid motions, or a full model without structure.
#[derive(Debug, Default)]
pub struct Counts {
    /// Number of conclusive counts.
    pub made: usize,
    /// Counts that contradict the eigenvalues.
    pub miscounts: Vec<MiscountedModes>,
    /// Eigenvalues at the speeds of the counts.
    pub spectra: Vec<Spectrum>,
}

impl Counts {
    /// Counts on both sides of band onsets and at random speeds.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(
        model: &SpectralModel,
        solver: &Solver<'_>,
        bands: &[Instability],
        range: SpeedRange,
    ) -> Result<Self, SpectrumError> {
        if model.plate.is_axisymmetric() || model.has_free_motions() {
            return Ok(Counts::default());
        }
        let full = model.full_model();
        if !full.is_structured() {
            return Ok(Counts::default());
        }
        let spectra: Vec<Spectrum> = speeds(bands, range)
            .par_iter()
            .map(|&speed| solver.at(speed))
            .collect::<Result<_, _>>()?;
        let counted: Vec<Option<Option<MiscountedModes>>> = spectra
            .par_iter()
            .map(|spectrum| counted(full, spectrum, solver.highest()))
            .collect();
        Ok(Counts {
            made: counted.iter().flatten().count(),
            miscounts: counted.into_iter().flatten().flatten().collect(),
            spectra,
        })
    }
}

fn speeds(bands: &[Instability], range: SpeedRange) -> Vec<f64> {
    let from = range.from_rad_per_s;
    let drawn = (0..DRAWN).map(|k| from + drawn_share(k) * range.width());
    let beside = bands.iter().take(MOST_BANDS).flat_map(|band| {
        let away = (BESIDE * band.range().width()).max(LEAST_BESIDE * band.from_rad_per_s);
        [band.from_rad_per_s - away, band.from_rad_per_s + away]
    });
    let mut speeds: Vec<f64> = beside.chain(drawn).collect();
    speeds.retain(|speed| range.contains(*speed) && *speed > 0.0);
    speeds
}

fn counted(full: &FullModel, spectrum: &Spectrum, highest: f64) -> Option<Option<MiscountedModes>> {
    counted_in_window(full, spectrum.speed, &spectrum.values, highest)
}

/// Compares a list of eigenvalues with a count of the growing ones below a frequency up to which the list is
/// complete. `None` if the count is inconclusive because an eigenvalue is on the path.
pub fn counted_in_window(
    full: &FullModel,
    speed_rad_per_s: f64,
    listed: &[c64],
    highest_rad_per_s: f64,
) -> Option<Option<MiscountedModes>> {
    let top = window(listed, highest_rad_per_s)?;
    let unlisted = full.unlisted(speed_rad_per_s, listed, [top, top])?;
    // Two conjugate eigenvalues are one mode, and so is a single real eigenvalue.
    let modes = (unlisted + unlisted.signum()) / 2;
    Some((unlisted != 0).then_some(MiscountedModes::new(speed_rad_per_s, [0.0, top], modes)))
}

/// Upper end of the window of a count: the middle of the widest gap between frequencies.
fn window(listed: &[c64], highest: f64) -> Option<f64> {
    let mut frequencies: Vec<f64> = listed.iter().map(|value| value.im).collect();
    frequencies.extend([LEAST_WINDOW * highest, highest]);
    frequencies.retain(|f| (LEAST_WINDOW * highest..=highest).contains(f));
    frequencies.sort_by(f64::total_cmp);
    let gaps = frequencies.windows(2);
    let widest = gaps.max_by(|x, y| (x[1] - x[0]).total_cmp(&(y[1] - y[0])))?;
    Some(0.5 * (widest[0] + widest[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{Accuracy, Scene, rad_per_s};
    use crate::modes::Strategy;

    /// A count detects a growing eigenvalue that is absent from a list, and a listed one that does not exist.
    #[test]
    fn wrong_spectra_are_contradicted() {
        let scene = Scene::paper().edited(|saw| saw.guides[0].damping_n_s_per_m = 2.0);
        let range = SpeedRange::between_rpm(0.0, 2600.0);
        let plate = Plate::new(&scene.unwrap(), Resolution::of(Accuracy::Draft));
        let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
        let solver = Solver::new(&model);
        let counts = Counts::new(&model, &solver, &[], range).unwrap();
        assert_eq!(counts.made, DRAWN as usize);
        assert!(counts.miscounts.is_empty(), "{:?}", counts.miscounts);
        let full = model.full_model();
        let spectra = (0..40).map(|k| solver.at(rad_per_s(1540.0 + 25.0 * f64::from(k))).unwrap());
        let grows = |s: &Spectrum| s.values.iter().any(|v| v.re > 0.01);
        let sound = spectra.into_iter().find(grows).unwrap();
        assert_eq!(counted(full, &sound, solver.highest()), Some(None));
        let growing = sound.values.iter().position(|v| v.re > 0.01).unwrap();
        let mut missing = sound.clone();
        missing.values.remove(growing);
        let lost = counted(full, &missing, solver.highest()).unwrap().unwrap();
        assert_eq!(lost.missing, 1);
        let mut invented = sound.clone();
        let decaying = &mut invented.values[usize::from(growing == 0)];
        decaying.re = decaying.re.abs() + 0.1;
        let found = counted(full, &invented, solver.highest()).unwrap();
        let was_growing = sound.values[usize::from(growing == 0)].re > 0.0;
        assert!(was_growing || found.unwrap().missing == -1);
    }
}
