//! Modes between the speeds of a search, read off its pieces.

use rayon::prelude::*;

use crate::modes::branches::{self, CampbellError, ModesAt};
use crate::modes::{Mode, SpectralModel};

/// Modes at any speed of a search.
pub struct Between<'a> {
    pub model: &'a SpectralModel,
    /// All modes of a blade at a speed without their coordinates; `None` where its pieces do not show them.
    pub interpolated: Box<dyn Fn(f64) -> Option<Vec<Mode>> + Sync + 'a>,
}

impl Between<'_> {
    /// Modes at speeds, interpolated where the search settled and computed elsewhere.
    ///
    /// # Errors
    /// [`CampbellError`] of a speed at which an eigenproblem fails.
    pub fn at_all(&self, speeds: &[f64]) -> Result<Vec<ModesAt>, CampbellError> {
        let at = |speed: &f64| match (self.interpolated)(*speed) {
            Some(modes) => Ok(vec![self.shown(*speed, modes)]),
            None => branches::sample(self.model, &[*speed], &|_, _| ()),
        };
        let all: Vec<Vec<ModesAt>> = speeds.par_iter().map(at).collect::<Result<_, _>>()?;
        Ok(all.concat())
    }

    fn shown(&self, speed_rad_per_s: f64, modes: Vec<Mode>) -> ModesAt {
        let mut modes = self.model.shown(modes);
        modes.sort_by(|x, y| x.frequency_rad_per_s().total_cmp(&y.frequency_rad_per_s()));
        ModesAt {
            speed_rad_per_s,
            modes,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::Scene;
    use crate::modes::smallest;
    use crate::stability::Analysis;

    /// Reference: the eigenproblem of each speed. Errors of growth are relative to fast decay or to the fastest growth.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "charts: run it in release")]
    fn interpolated_modes_are_eigenvalues() {
        let mut compared = 0;
        for name in [
            "damped-pad",
            "damped-material",
            "in-cut-wood",
            "weak-pad",
            "opposed-pads",
        ] {
            let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/gallery");
            let scene = Scene::from_path(format!("{folder}/{name}.json")).unwrap();
            let analysis = Analysis::new(&scene).unwrap();
            let model = &analysis.model;
            let growth = analysis.bands().iter().map(|band| band.peak_growth_per_s);
            let fastest = growth.fold(0.0, f64::max);
            let samples = analysis.chart.campbell.samples.iter();
            for sample in samples.filter(|sample| !sample.is_solved()) {
                let exact = model.modes(sample.speed_rad_per_s).unwrap();
                assert_eq!(exact.len(), sample.modes.len(), "{name}");
                for mode in sample.modes.iter().map(|named| &named.mode) {
                    let off = |exact: &&Mode| (exact.lambda - mode.lambda).norm();
                    let nearest = smallest(&exact, off).unwrap();
                    let share = off(&nearest) / model.complete_to_rad_per_s;
                    assert!(share < 5e-4, "{name}: {share} {}", nearest.lambda);
                    let growth = nearest.lambda.re.abs().max(fastest);
                    let share = (nearest.lambda.re - mode.lambda.re).abs() / growth;
                    assert!(share < 0.03, "{name}: {share} {}", nearest.lambda);
                    assert_eq!(nearest.kind, mode.kind, "{name}: {}", nearest.lambda);
                    compared += 1;
                }
            }
        }
        assert!(compared > 8000, "{compared}");
    }
}
