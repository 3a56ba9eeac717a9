//! Refinement on the full model of the eigenvalues that a report lists: those at rest and at the peaks of bands, and that
//! of the fastest growing or slowest decaying mode at the operating speed.

use faer::c64;
use rayon::prelude::*;

use super::band::Instability;
use crate::modes::{DescribedMode, RefinedPair, SpectralModel, SpectrumError};

/// Refinement of listed eigenvalues, with the largest backward error so far.
pub(super) struct Listed {
    /// Largest backward error; `None` if an eigenvalue could not be refined.
    largest_error: Option<f64>,
}

impl Listed {
    /// A list that begins with the modes at rest. Those of a free blade are accurate without refinement.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(
        model: &SpectralModel,
        modes_at_rest: &[DescribedMode],
    ) -> Result<Self, SpectrumError> {
        let errors = modes_at_rest.par_iter().map(|mode| {
            let refined = model.refined(0.0, mode.mode.lambda)?;
            Ok(refined.map_or(mode.backward_error, |pair| pair.backward_error))
        });
        let errors: Vec<f64> = errors.collect::<Result<_, _>>()?;
        Ok(Listed {
            largest_error: Some(errors.into_iter().fold(0.0, f64::max)),
        })
    }

    /// Refines growth rate and frequency at the peaks of bands.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn refine_peaks(
        &mut self,
        model: &SpectralModel,
        bands: &mut [Instability],
    ) -> Result<(), SpectrumError> {
        let refined: Result<Vec<Option<RefinedPair>>, SpectrumError> = bands
            .par_iter()
            .map(|band| {
                let expected = c64::new(band.peak_growth_per_s, band.frequency_rad_per_s);
                model.refined(band.peak_rad_per_s, expected)
            })
            .collect();
        for (band, refined) in bands.iter_mut().zip(refined?) {
            self.note(refined);
            if let Some(RefinedPair { lambda, .. }) = refined {
                band.peak_growth_per_s = lambda.re;
                band.frequency_rad_per_s = lambda.im.abs();
            }
        }
        Ok(())
    }

    /// Refines an eigenvalue at a speed; a purely imaginary one remains purely imaginary.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn refine(
        &mut self,
        model: &SpectralModel,
        speed_rad_per_s: f64,
        lambda: c64,
    ) -> Result<c64, SpectrumError> {
        let refined = model.refined(speed_rad_per_s, lambda)?;
        self.note(refined);
        let re = |refined: RefinedPair| {
            if lambda.re == 0.0 {
                0.0
            } else {
                refined.lambda.re
            }
        };
        Ok(refined.map_or(lambda, |refined| c64::new(re(refined), refined.lambda.im)))
    }

    /// Largest backward error of the list; `None` if an eigenvalue could not be refined.
    pub fn largest_error(&self) -> Option<f64> {
        self.largest_error
    }

    fn note(&mut self, refined: Option<RefinedPair>) {
        let errors = self.largest_error.zip(refined);
        self.largest_error = errors.map(|(largest, pair)| largest.max(pair.backward_error));
    }
}

#[cfg(test)]
mod tests {
    use faer::linalg::solvers::Solve;
    use faer::{Col, Mat};

    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{Accuracy, Scene, SpeedRange, rad_per_s};
    use crate::model::system::{GyroscopicSystem, dynamic_stiffness};
    use crate::modes::{Strategy, companion_eigenpairs};
    use crate::stability::{InstabilityKind, chart};

    /// Inverse iteration with factorizations of the whole matrix, starting at the nearest dense eigenvalue.
    fn exact(system: &GyroscopicSystem, speed: f64, near: c64) -> c64 {
        let distance = |lambda: c64| (lambda - near).norm();
        let pairs = companion_eigenpairs(system, speed).unwrap();
        let nearest = pairs
            .into_iter()
            .min_by(|x, y| distance(x.0).total_cmp(&distance(y.0)));
        let (mut lambda, mut q) = nearest.unwrap();
        let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
        let order = system.order();
        for _ in 0..3 {
            let whole = dynamic_stiffness(&stiffness, &velocity, lambda);
            let slope = Mat::from_fn(order, 1, |i, _| {
                let carried: c64 = (0..order).map(|k| q[k] * velocity[(i, k)]).sum();
                lambda * q[i] * 2.0 + carried
            });
            let solved = whole.partial_piv_lu().solve(&slope);
            let share = q.adjoint() * solved.col(0);
            lambda -= 1.0 / share * q.norm_l2().powi(2);
            let norm = solved.norm_l2();
            q = Col::from_fn(order, |i| solved[(i, 0)] / norm);
        }
        lambda
    }

    /// Compares growth and frequency at peaks and at a speed, for an undamped and a damped saw, with dense
    /// solves of the whole matrix.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
    fn listed_eigenvalues_are_those_of_the_full_model() {
        let damped = Scene::paper().edited(|saw| saw.guides[0].damping_n_s_per_m = 2.0);
        for (scene, least) in [(Scene::paper(), 6), (damped.unwrap(), 2)] {
            let plate = Plate::new(&scene, Resolution::of(Accuracy::Draft));
            let range = SpeedRange::between_rpm(0.0, 2600.0);
            let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
            let mut bands = chart(&model, range, 5, &|_, _| ()).unwrap().instabilities;
            let mut listed = Listed::new(&model, &[]).unwrap();
            listed.refine_peaks(&model, &mut bands).unwrap();
            assert!(bands.len() >= least, "{}", bands.len());
            let system = &model.components[0].full;
            let lowest = model.modes(0.0).unwrap()[0].frequency_rad_per_s();
            for band in &bands {
                let is_real = band.kind == InstabilityKind::Divergence;
                assert_eq!(band.frequency_rad_per_s == 0.0, is_real);
                let found = c64::new(band.peak_growth_per_s, band.frequency_rad_per_s);
                let exact = exact(system, band.peak_rad_per_s, found);
                // For divergence the rounding of λ² is relative to the square of the lowest frequency.
                let error = (found - exact).norm() / exact.norm().max(lowest);
                assert!(error < 1e-12, "{found}: {error:e}");
            }
            let speed = rad_per_s(1000.0);
            let modes = model.modes(speed).unwrap();
            for mode in modes.iter().take(6) {
                let found = listed.refine(&model, speed, mode.lambda).unwrap();
                let exact = exact(system, speed, found);
                let error = (found - exact).norm() / exact.norm();
                assert!(error < 1e-12, "{found}: {error:e}");
            }
            let largest = listed.largest_error().unwrap();
            assert!(largest < 1e-13, "{largest:e}");
        }
    }
}
