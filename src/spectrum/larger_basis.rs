//! What the functions that a basis lacks would change: its error, measured.
//!
//! On a larger basis L(λ) has the block L_cc that was solved, L_nn of the new functions and L_nc
//! between them. A mode q leaves the residual L_nc q there, and what the larger basis takes off
//! qᵀLq is (L_nc q)ᵀ S⁻¹ (L_nc q), S = L_nn − L_nc L_cc⁻¹ L_cn: the old functions give way too.
//! Mass and gyroscopic matrix couple no two functions of different index, so L_nc = K_nc(Ω); in S
//! the stiffness at rest stands for L, for it is ruled by functions of high frequency.

use faer::linalg::solvers::Llt;
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Col, Mat, Par, Scale, Side, c64};

use super::at_rest::RestingMode;
use super::component::Component;
use super::critical::NamedCriticalSpeed;
use super::error::SpectrumError;
use super::mode::{Mode, ModeKind};
use super::model::DescribedMode;
use super::structured::{LARGE, StructuredStiffness};
use super::vectors::real_times;
use crate::plate::Plate;
use crate::system::GyroscopicSystem;
use crate::tuned::Tuned;

/// A larger basis that contains the one of a plate.
#[derive(Debug)]
pub struct LargerBasis {
    /// Of each component of the plate.
    added: Vec<AddedFunctions>,
}

/// Functions that a component lacks.
#[derive(Debug)]
enum AddedFunctions {
    Dense(DenseFunctions),
    /// Of a large guided blade. The block of K₀⁻¹ of the larger basis between the new functions is S⁻¹.
    Structured {
        larger: Box<StructuredStiffness>,
        /// Where the old functions stand in it.
        kept: Vec<usize>,
    },
}

/// By blocks of the matrices of the larger basis.
#[derive(Debug)]
struct DenseFunctions {
    /// K₀ between them and those of the component.
    stiffness: Mat<f64>,
    /// K_σ − N between them.
    spin: Mat<f64>,
    /// Of S = K_nn − K_nc K_cc⁻¹ K_cn.
    factor: Llt<f64>,
}

/// Least slope of a mode whose frequency is told, relative to its frequency seen from the blade.
const LEAST_SLOPE: Tuned = Tuned::new("spectrum/larger_basis::LEAST_SLOPE", 0.3);

impl LargerBasis {
    /// The functions that `larger` has beyond those of `plate`, the same saw on fewer.
    ///
    /// # Errors
    /// [`SpectrumError::UnstableAtRest`] when the blade is unstable on the larger basis.
    pub fn new(plate: &Plate, larger: &Plate) -> Result<Self, SpectrumError> {
        let added = match plate.is_axisymmetric() {
            true => (0..=plate.max_diameters())
                .map(|n| {
                    let system = GyroscopicSystem::of_harmonic(larger, n);
                    DenseFunctions::new(&system, &kept(plate, larger, n..=n))
                        .map(AddedFunctions::Dense)
                })
                .collect::<Result<_, _>>()?,
            false => vec![AddedFunctions::of_coupled(plate, larger)?],
        };
        Ok(LargerBasis { added })
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

    /// Errors of the frequencies of modes of one speed, each relative to what it is seen from the
    /// blade, ‖λq + ΩGq‖/‖q‖. qᴴL(ω)q has the slope 2 (ω + Ωγ), qᴴGq = iγ. `None` of a mode that
    /// grows, and of one that is about to merge with another or to stand still: there the slope
    /// vanishes, and what is smooth is not the frequency but the speed at which it happens.
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
            let columns = Mat::from_fn(component.full.order(), 2 * shapes.len(), |i, k| {
                let q = shapes[k / 2][i];
                if k % 2 == 0 { q.re } else { q.im }
            });
            let softened = self.added[index].softened(speed_rad_per_s, &columns);
            for (k, (&place, q)) in places.iter().zip(&shapes).enumerate() {
                let softening = softened[2 * k] + softened[2 * k + 1];
                let lambda = modes[place].mode.lambda;
                let turned = Scale(c64::new(speed_rad_per_s, 0.0))
                    * real_times(&component.full.gyroscopic, q);
                let on_blade = (Scale(lambda) * q + &turned).norm_l2();
                // (ω + Ωγ)‖q‖, γ = −i qᴴGq/qᴴq.
                let drift: c64 = q.adjoint() * &turned;
                let slope = (lambda.im * q.norm_l2() + drift.im / q.norm_l2()).abs();
                if slope > LEAST_SLOPE.get() * on_blade {
                    errors[place] = Some(0.5 * softening / (slope * on_blade));
                }
            }
        }
        errors
    }

    /// What eliminating the functions takes off the stiffness of a component, projected on columns.
    pub fn softening(
        &self,
        component: usize,
        speed_rad_per_s: f64,
        columns: &Mat<f64>,
    ) -> Mat<f64> {
        self.added[component].softening(speed_rad_per_s, columns)
    }

    /// What one part of the stiffness alone, given on the larger basis, would take off a frequency's square, qᵀK_cn S⁻¹ K_nc q.
    /// `None` of a saw without the structure of a guided blade.
    pub fn softening_by(&self, component: usize, part: &Mat<f64>, shape: &Mat<f64>) -> Option<f64> {
        let AddedFunctions::Structured { larger, kept } = &self.added[component] else {
            return None;
        };
        let mut force = part * widened(larger, kept, shape);
        kept.iter().for_each(|&place| force[(place, 0)] = 0.0);
        Some((force.transpose() * larger.solve(&force))[(0, 0)])
    }
}

impl AddedFunctions {
    fn of_coupled(plate: &Plate, larger: &Plate) -> Result<Self, SpectrumError> {
        let kept = kept(plate, larger, 0..=plate.max_diameters());
        let is_large = larger.degrees_of_freedom() >= LARGE;
        let structured = is_large.then(|| StructuredStiffness::of(larger)).flatten();
        // A blade that is not certain to be stable is looked at closely.
        let structured =
            structured.filter(|larger| larger.basis.critical_speeds_below(0.0) == Some(0));
        if let Some(larger) = structured {
            return Ok(AddedFunctions::Structured {
                larger: Box::new(larger),
                kept,
            });
        }
        let system = GyroscopicSystem::of_plate(larger);
        DenseFunctions::new(&system, &kept).map(AddedFunctions::Dense)
    }

    /// QᵀK_cn S⁻¹ K_nc Q.
    fn softening(&self, speed_rad_per_s: f64, columns: &Mat<f64>) -> Mat<f64> {
        match self {
            AddedFunctions::Dense(dense) => {
                let force = dense.whitened_force(speed_rad_per_s, columns);
                force.transpose() * &force
            }
            AddedFunctions::Structured { larger, kept } => {
                let force = force_on_new(larger, kept, speed_rad_per_s, columns);
                force.transpose() * larger.solve(&force)
            }
        }
    }

    /// Its diagonal.
    fn softened(&self, speed_rad_per_s: f64, columns: &Mat<f64>) -> Vec<f64> {
        let places = 0..columns.ncols();
        match self {
            AddedFunctions::Dense(dense) => {
                let force = dense.whitened_force(speed_rad_per_s, columns);
                places.map(|k| force.col(k).squared_norm_l2()).collect()
            }
            AddedFunctions::Structured { larger, kept } => {
                let force = force_on_new(larger, kept, speed_rad_per_s, columns);
                let given_way = larger.solve(&force);
                places
                    .map(|k| force.col(k).transpose() * given_way.col(k))
                    .collect()
            }
        }
    }
}

/// K_nc Q in the unknowns of the larger basis, zero on the old functions.
fn force_on_new(
    larger: &StructuredStiffness,
    kept: &[usize],
    speed_rad_per_s: f64,
    columns: &Mat<f64>,
) -> Mat<f64> {
    let wide = widened(larger, kept, columns);
    let product = larger.basis.times(wide.as_ref());
    let mut force = product.map_or(wide, |product| product.stiffness_at(speed_rad_per_s));
    for k in 0..columns.ncols() {
        kept.iter().for_each(|&place| force[(place, k)] = 0.0);
    }
    force
}

/// Columns of the old functions in the unknowns of the larger basis.
fn widened(larger: &StructuredStiffness, kept: &[usize], columns: &Mat<f64>) -> Mat<f64> {
    let mut wide = Mat::zeros(larger.inverse.order(), columns.ncols());
    for k in 0..columns.ncols() {
        for (row, &place) in kept.iter().enumerate() {
            wide[(place, k)] = columns[(row, k)];
        }
    }
    wide
}

impl DenseFunctions {
    fn new(larger: &GyroscopicSystem, kept: &[usize]) -> Result<Self, SpectrumError> {
        let order = larger.order();
        let unstable = |_| SpectrumError::UnstableAtRest { order };
        let added: Vec<usize> = (0..order)
            .filter(|i| kept.binary_search(i).is_err())
            .collect();
        let block = |matrix: &Mat<f64>, rows: &[usize], columns: &[usize]| {
            Mat::from_fn(rows.len(), columns.len(), |i, k| {
                matrix[(rows[i], columns[k])]
            })
        };
        // Stiffening the free rigid motions, which have no part in the new functions, makes K_cc
        // definite and changes nothing else.
        let mut old = block(&larger.stiffness, kept, kept);
        let mean = old.norm_l2() / (kept.len() as f64).sqrt();
        for z in &larger.free_rigid {
            let z = Col::from_fn(kept.len(), |i| z[kept[i]]);
            old += Scale(mean) * &z * z.transpose();
        }
        let old = old.llt(Side::Lower).map_err(unstable)?;
        let mut whitened = block(&larger.stiffness, kept, &added);
        solve_lower_triangular_in_place(old.L(), whitened.as_mut(), Par::Seq);
        let schur = block(&larger.stiffness, &added, &added) - whitened.transpose() * &whitened;
        Ok(DenseFunctions {
            stiffness: block(&larger.stiffness, &added, kept),
            spin: block(&larger.spin, &added, kept),
            factor: schur.llt(Side::Lower).map_err(unstable)?,
        })
    }

    /// L⁻¹K_nc Q, S = LLᵀ.
    fn whitened_force(&self, speed_rad_per_s: f64, columns: &Mat<f64>) -> Mat<f64> {
        let mut force =
            &self.stiffness * columns + Scale(speed_rad_per_s.powi(2)) * &self.spin * columns;
        solve_lower_triangular_in_place(self.factor.L(), force.as_mut(), Par::Seq);
        force
    }
}

/// Whether a mode has a frequency that its functions determine smoothly.
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

/// Where the functions of some harmonics of a plate stand in a larger basis, ascending.
fn kept(plate: &Plate, larger: &Plate, range: std::ops::RangeInclusive<usize>) -> Vec<usize> {
    let (few, many) = (plate.basis.count(), larger.basis.count());
    let first = larger.offset(*range.start());
    range
        .flat_map(|n| {
            let cosine = larger.offset(n) - first;
            let phases = if n == 0 { 1 } else { 2 };
            (0..phases).flat_map(move |phase| (0..few).map(move |j| cosine + phase * many + j))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plate::Resolution;
    use crate::scene::Scene;
    use crate::spectrum::{SpectralModel, at_rest::modes_at_rest};

    /// Against the differences of two bases that were both solved.
    #[test]
    fn it_tells_what_the_larger_basis_gives() {
        let free = Scene::paper().edited(|saw| saw.guides.clear()).unwrap();
        for scene in [Scene::paper(), free] {
            let [plate, larger] = [(10, 6), (18, 10)].map(|(max_diameters, radial_functions)| {
                let resolution = Resolution {
                    max_diameters,
                    radial_functions,
                };
                Plate::new(&scene, resolution)
            });
            let basis = LargerBasis::new(&plate, &larger).unwrap();
            let [components, finer] = [&plate, &larger].map(Component::of);
            let [coarse, fine] =
                [&components, &finer].map(|components| modes_at_rest(components, 10).unwrap());
            for (coarse, fine) in coarse.iter().zip(&fine) {
                let error = coarse.frequency_rad_per_s / fine.frequency_rad_per_s - 1.0;
                let told = basis.resting_error(coarse);
                assert!((told / error - 1.0).abs() < 0.1, "{told} {error}");
            }
            let [coarse, fine] =
                [&plate, &larger].map(|plate| SpectralModel::critical_speeds(plate).unwrap());
            for (coarse, fine) in coarse.iter().zip(&fine).take(6) {
                let error = coarse.speed_rad_per_s / fine.speed_rad_per_s - 1.0;
                let told = basis.critical_error(&components, coarse);
                assert!((told / error - 1.0).abs() < 0.2, "{told} {error}");
            }
        }
    }
}
