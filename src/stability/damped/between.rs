//! Modes of a damped blade between the speeds of its search, read off the pieces.

use rayon::prelude::*;

use super::curve::upper;
use super::spectrum::finite;
use crate::modes::branches::{self, CampbellError, ModesAt};
use crate::modes::{Mode, SpectralModel};
use crate::stability::group::Sloped;
use crate::stability::pieces::Piece;

/// Pieces of the search of each part of a blade that does not act on the others.
pub struct Between<'a> {
    pub model: &'a SpectralModel,
    /// Index of the component of each part, and its pieces by ascending speed.
    pub parts: Vec<(usize, Vec<Piece>)>,
}

impl Between<'_> {
    /// Modes at speeds, interpolated where the search settled and computed elsewhere.
    ///
    /// # Errors
    /// [`CampbellError`] of a speed at which an eigenproblem fails.
    pub fn at_all(&self, speeds: &[f64]) -> Result<Vec<ModesAt>, CampbellError> {
        let at = |speed: &f64| match self.at(*speed) {
            Some(modes) => Ok(vec![modes]),
            None => branches::sample(self.model, &[*speed], &|_, _| ()),
        };
        let all: Vec<Vec<ModesAt>> = speeds.par_iter().map(at).collect::<Result<_, _>>()?;
        Ok(all.concat())
    }

    /// Interpolated modes at a speed; `None` where a part has no settled piece.
    fn at(&self, speed_rad_per_s: f64) -> Option<ModesAt> {
        let mut modes = Vec::new();
        for (component, pieces) in &self.parts {
            let ends = |piece: &Piece| piece.ends[1].speed_rad_per_s;
            let piece = pieces.get(pieces.partition_point(|p| ends(p) < speed_rad_per_s))?;
            if piece.groups.is_empty() || !piece.contains(speed_rad_per_s) {
                return None;
            }
            let numbers: Vec<Sloped> = piece
                .groups
                .iter()
                .flat_map(|grouped| grouped.group.sloped_at(speed_rad_per_s))
                .collect();
            let seen = upper(&numbers, self.model.complete_to_rad_per_s);
            let seen = seen.into_iter();
            modes.extend(
                seen.map(|(lambda, slope)| Mode::interpolated(lambda, finite(slope), *component)),
            );
        }
        let mut modes = self.model.shown(modes);
        modes.sort_by(|x, y| x.frequency_rad_per_s().total_cmp(&y.frequency_rad_per_s()));
        Some(ModesAt {
            speed_rad_per_s,
            modes,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::Scene;
    use crate::modes::smallest;
    use crate::stability::Analysis;

    /// Reference: the eigenproblem of each speed. At a coalescence growth has the square root of the error of the interpolation.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "charts: run it in release")]
    fn interpolated_modes_are_eigenvalues() {
        let mut compared = 0;
        for name in ["damped-pad", "damped-material", "in-cut-wood"] {
            let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/gallery");
            let scene = Scene::from_path(format!("{folder}/{name}.json")).unwrap();
            let analysis = Analysis::new(&scene).unwrap();
            let model = &analysis.model;
            let growth = analysis.bands().iter().map(|band| band.peak_growth_per_s);
            let fastest = growth.fold(0.0, f64::max);
            let samples = analysis.chart.campbell.samples.iter();
            for sample in samples.filter(|sample| !sample.is_solved()) {
                let exact = model.modes(sample.speed_rad_per_s).unwrap();
                for mode in sample.modes.iter().map(|named| &named.mode) {
                    let off = |exact: &&Mode| (exact.lambda - mode.lambda).norm();
                    let nearest = smallest(&exact, off).unwrap();
                    assert!(
                        off(&nearest) < 2e-4 * model.complete_to_rad_per_s,
                        "{name}: {nearest:?}"
                    );
                    let growth = nearest.lambda.re.abs().max(fastest);
                    let off = (nearest.lambda.re - mode.lambda.re).abs();
                    assert!(off < 0.01 * growth, "{name}: {off} {nearest:?}");
                    compared += 1;
                }
            }
        }
        assert!(compared > 3000, "{compared}");
    }
}
