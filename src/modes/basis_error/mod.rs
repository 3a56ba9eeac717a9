//! Error of a basis, estimated by the change that the functions of a larger one cause.
//!
//! On a larger basis L(λ) has the block L_cc, which was solved, the block L_nn of the new functions, and L_nc
//! between the two. A mode q leaves the residual L_nc q there, and the larger basis reduces qᵀLq by (L_nc q)ᵀ
//! S⁻¹ (L_nc q), S = L_nn − L_nc L_cc⁻¹ L_cn, because the old functions respond too. Mass and gyroscopic
//! matrix couple no two functions of different index, so L_nc = K_nc(Ω); in S the stiffness at rest
//! approximates L, because functions of high frequency dominate it.

use faer::{Col, Mat, Scale, c64};

use super::component::Component;
use super::critical_speed::NamedCriticalSpeed;
use super::error::SpectrumError;
use super::mode::{Mode, ModeKind};
use super::model::DescribedMode;
use super::resting_mode::RestingMode;
use super::vectors::{halves, real_times};
use crate::model::plate::Plate;

mod added_functions;

use self::added_functions::AddedFunctions;

/// Errors of the basis of a plate, from the functions that a larger one adds.
#[derive(Debug)]
pub struct BasisError {
    /// Added functions of each component of the plate.
    added: Vec<AddedFunctions>,
}

/// Smallest slope, relative to the frequency in the body frame, of a mode whose frequency is smooth.
const LEAST_SLOPE: f64 = 0.3;

impl BasisError {
    /// The functions of `larger` that are absent from `plate`, which is the same saw in a smaller basis.
    ///
    /// # Errors
    /// [`SpectrumError::UnstableAtRest`] when the blade is unstable on the larger basis.
    pub fn new(plate: &Plate, larger: &Plate) -> Result<Self, SpectrumError> {
        let added = if plate.is_axisymmetric() {
            (0..=plate.max_diameters())
                .map(|n| AddedFunctions::of_harmonic(plate, larger, n))
                .collect::<Result<_, _>>()?
        } else {
            vec![AddedFunctions::of_coupled(plate, larger)?]
        };
        Ok(BasisError { added })
    }

    /// Relative error of a frequency at rest.
    pub fn resting_error(&self, mode: &RestingMode) -> f64 {
        let shape = column(&mode.shape);
        let softening = self.added[mode.component].softening(0.0, &shape)[(0, 0)];
        0.5 * softening / mode.frequency_rad_per_s.powi(2)
    }

    /// Relative error of a critical speed Ω, xᵀK₀x = Ω² xᵀ(N − K_σ)x.
    pub fn critical_error(&self, components: &[Component], critical: &NamedCriticalSpeed) -> f64 {
        let shape = column(&critical.shape);
        let speed = critical.speed_rad_per_s;
        let softening = self.added[critical.component].softening(speed, &shape)[(0, 0)];
        let x = &critical.shape;
        let stiffness = x.transpose() * &components[critical.component].full.stiffness * x;
        0.5 * softening / stiffness
    }

    /// Errors of the frequencies of modes at one speed, each relative to its frequency in the body frame,
    /// ‖λq + ΩGq‖/‖q‖. qᴴL(ω)q has the slope 2 (ω + Ωγ), qᴴGq = iγ. `None` for a mode that grows, or is about to
    /// coalesce with another or to stand still: there the slope vanishes, and not the frequency but the speed
    /// of this event is smooth.
    pub fn frequency_errors(
        &self,
        components: &[Component],
        speed_rad_per_s: f64,
        modes: &[DescribedMode],
    ) -> Vec<Option<f64>> {
        let mut errors = vec![None; modes.len()];
        for (index, component) in components.iter().enumerate() {
            let own = |k: &usize| modes[*k].mode.component == index && oscillates(&modes[*k].mode);
            let places: Vec<usize> = (0..modes.len()).filter(own).collect();
            if places.is_empty() {
                continue;
            }
            let shapes: Vec<Col<c64>> = places
                .iter()
                .map(|&k| component.coordinates(&modes[k].shape))
                .collect();
            let columns = halves(component.full.order(), shapes.iter());
            let softened = self.added[index].softening_of_modes(speed_rad_per_s, &columns);
            for (k, (&place, q)) in places.iter().zip(&shapes).enumerate() {
                let [re, im] = [2 * k, 2 * k + 1];
                let softening = softened[(re, re)] + softened[(im, im)];
                let lambda = modes[place].mode.lambda;
                let turned = Scale(c64::new(speed_rad_per_s, 0.0))
                    * real_times(&component.full.gyroscopic, q);
                let on_blade = (Scale(lambda) * q + &turned).norm_l2();
                // The slope is |ω + Ωγ| ‖q‖ with ω = Im λ, the rotation speed Ω, the gyroscopic matrix G and
                // γ = −i qᴴGq/qᴴq.
                let drift: c64 = q.adjoint() * &turned;
                let slope = (lambda.im * q.norm_l2() + drift.im / q.norm_l2()).abs();
                if slope > LEAST_SLOPE * on_blade {
                    errors[place] = Some(0.5 * softening / (slope * on_blade));
                }
            }
        }
        errors
    }

    /// Reduction of the stiffness of a component by the added functions, projected on modes, in 1/s².
    pub fn softening(
        &self,
        component: usize,
        speed_rad_per_s: f64,
        columns: &Mat<f64>,
    ) -> Mat<f64> {
        self.added[component].softening_of_modes(speed_rad_per_s, columns)
    }

    /// qᵀK_cn S⁻¹ K_nc q, in 1/s², with the block K_nc of one part of the stiffness, given on the larger
    /// basis. `None` for a saw without the structure of a guided blade.
    pub fn softening_by(&self, component: usize, part: &Mat<f64>, shape: &Mat<f64>) -> Option<f64> {
        self.added[component].softening_by(part, shape)
    }
}

/// Whether a mode is an oscillation, whose frequency depends smoothly on the matrices.
fn oscillates(mode: &Mode) -> bool {
    match mode.kind {
        ModeKind::Positive | ModeKind::Negative => true,
        ModeKind::Damped => mode.lambda.im > mode.lambda.re.abs(),
        _ => false,
    }
}

fn column(x: &Col<f64>) -> Mat<f64> {
    Mat::from_fn(x.nrows(), 1, |i, _| x[i])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::Resolution;
    use crate::model::scene::Scene;
    use crate::modes::SpectralModel;
    use crate::modes::resting_mode::modes_at_rest;

    /// Reference: the differences between the results of both bases.
    #[test]
    fn estimated_errors_are_the_changes_on_the_basis_error() {
        let free = Scene::paper().edited(|saw| saw.guides.clear()).unwrap();
        for scene in [Scene::paper(), free] {
            let [plate, larger] = [(10, 6), (18, 10)].map(|(max_diameters, radial_functions)| {
                let resolution = Resolution {
                    max_diameters,
                    radial_functions,
                };
                Plate::new(&scene, resolution)
            });
            let basis = BasisError::new(&plate, &larger).unwrap();
            let [components, finer] = [&plate, &larger].map(Component::of);
            let [coarse, fine] =
                [&components, &finer].map(|components| modes_at_rest(components, 10).unwrap());
            for (coarse, fine) in coarse.iter().zip(&fine) {
                let error = coarse.frequency_rad_per_s / fine.frequency_rad_per_s - 1.0;
                let estimate = basis.resting_error(coarse);
                assert!((estimate / error - 1.0).abs() < 0.1, "{estimate} {error}");
            }
            let [coarse, fine] =
                [&plate, &larger].map(|plate| SpectralModel::critical_speeds(plate).unwrap());
            for (coarse, fine) in coarse.iter().zip(&fine).take(6) {
                let error = coarse.speed_rad_per_s / fine.speed_rad_per_s - 1.0;
                let estimate = basis.critical_error(&components, coarse);
                assert!((estimate / error - 1.0).abs() < 0.2, "{estimate} {error}");
            }
        }
    }
}
