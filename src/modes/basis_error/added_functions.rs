//! The functions that a component lacks, and their flexibility.

use faer::linalg::solvers::Llt;
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Col, Mat, Par, Scale, Side};

use crate::model::plate::Plate;
use crate::model::system::GyroscopicSystem;
use crate::modes::error::SpectrumError;
use crate::modes::structured_stiffness::{LARGE, StructuredStiffness};
use crate::modes::symmetric_pencil::stiffened;
use crate::modes::work::Cancellation;

/// Functions that a component lacks.
#[derive(Debug)]
pub enum AddedFunctions {
    /// For a small blade, and for one without such a structure.
    Dense(DenseFunctions),
    /// For a large guided blade: S⁻¹ is the block of K₀⁻¹ of the larger basis between the new functions.
    Structured {
        larger: Box<StructuredStiffness>,
        /// Indices of the old functions.
        kept: Vec<usize>,
        /// K_n of the larger basis.
        nonconservative: Option<Mat<f64>>,
    },
}

/// Blocks of the matrices of the larger basis.
#[derive(Debug)]
pub struct DenseFunctions {
    /// K₀ between the new functions and those of the component.
    stiffness: Mat<f64>,
    /// K_σ − N between the new functions and those of the component.
    spin: Mat<f64>,
    /// K_n between the new functions and those of the component, and the transpose of that between those of the component and the new
    /// ones.
    nonconservative: Option<[Mat<f64>; 2]>,
    /// Factor of S = K_nn − K_nc K_cc⁻¹ K_cn.
    factor: Llt<f64>,
}

impl AddedFunctions {
    pub fn of_harmonic(plate: &Plate, larger: &Plate, n: usize) -> Result<Self, SpectrumError> {
        let system = GyroscopicSystem::of_harmonic(larger, n);
        DenseFunctions::new(&system, &kept(plate, larger, n..=n)).map(AddedFunctions::Dense)
    }

    pub fn of_coupled(plate: &Plate, larger: &Plate) -> Result<Self, SpectrumError> {
        let kept = kept(plate, larger, 0..=plate.max_diameters());
        let nonconservative = larger.contact.nonconservative_stiffness();
        Cancellation::current().check()?;
        let is_large = larger.degrees_of_freedom() >= LARGE;
        let nearly = is_large
            .then(|| StructuredStiffness::nearly(larger))
            .flatten();
        // The dense method reports a blade that is unstable at rest, so it is used unless the structured
        // model proves that the stiffness at rest has no negative eigenvalue.
        let structured = nearly.filter(|larger| larger.full.critical_speeds_below(0.0) == Some(0));
        if let Some(larger) = structured {
            return Ok(AddedFunctions::Structured {
                larger: Box::new(larger),
                kept,
                nonconservative: nonconservative.cloned(),
            });
        }
        Cancellation::current().check()?;
        let system = GyroscopicSystem::of_plate(larger);
        DenseFunctions::new(&system, &kept).map(AddedFunctions::Dense)
    }

    /// QᵀK_cn S⁻¹ K_nc Q, in 1/s², for the columns Q of waves that stand still, on which K_n does not act.
    pub fn softening(&self, speed_rad_per_s: f64, columns: &Mat<f64>) -> Mat<f64> {
        match self {
            AddedFunctions::Dense(dense) => {
                let force = dense.whitened(dense.force(speed_rad_per_s, columns));
                force.transpose() * &force
            }
            AddedFunctions::Structured { larger, kept, .. } => {
                let force = force_on_new(larger, kept, speed_rad_per_s, columns);
                force.transpose() * larger.at_rest.solve(force.as_ref())
            }
        }
    }

    /// The same for modes, on which K_n acts.
    pub fn softening_of_modes(&self, speed_rad_per_s: f64, columns: &Mat<f64>) -> Mat<f64> {
        match self {
            AddedFunctions::Dense(
                dense @ DenseFunctions {
                    nonconservative: Some(parts),
                    ..
                },
            ) => {
                let force = dense.force(speed_rad_per_s, columns);
                let [right, left] = parts
                    .each_ref()
                    .map(|part| dense.whitened(&force + part * columns));
                left.transpose() * right
            }
            AddedFunctions::Structured {
                larger,
                kept,
                nonconservative: Some(matrix),
            } => {
                let force = force_on_new(larger, kept, speed_rad_per_s, columns);
                let wide = widened(larger, kept, columns);
                let [right, left] = [matrix * &wide, matrix.transpose() * &wide]
                    .map(|more| &force + on_new(more, kept));
                left.transpose() * larger.at_rest.solve(right.as_ref())
            }
            _ => self.softening(speed_rad_per_s, columns),
        }
    }

    /// The value of [`AddedFunctions::softening`] for one column and one part of K_nc, given on the larger basis.
    /// `None` for a saw without the structure of a guided blade.
    pub fn softening_by(&self, part: &Mat<f64>, shape: &Mat<f64>) -> Option<f64> {
        let AddedFunctions::Structured { larger, kept, .. } = self else {
            return None;
        };
        let force = on_new(part * widened(larger, kept, shape), kept);
        Some((force.transpose() * larger.at_rest.solve(force.as_ref()))[(0, 0)])
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
    let product = larger.full.times(wide.as_ref());
    let force = product.map_or(wide, |product| product.stiffness_at(speed_rad_per_s));
    on_new(force, kept)
}

/// Forces without those on the old functions.
fn on_new(mut force: Mat<f64>, kept: &[usize]) -> Mat<f64> {
    for k in 0..force.ncols() {
        kept.iter().for_each(|&place| force[(place, k)] = 0.0);
    }
    force
}

/// Columns of the old functions in the unknowns of the larger basis.
fn widened(larger: &StructuredStiffness, kept: &[usize], columns: &Mat<f64>) -> Mat<f64> {
    let mut wide = Mat::zeros(larger.at_rest.order(), columns.ncols());
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
        // Free rigid motions have no component on the added functions.
        let on_old = |z: &Col<f64>| Col::from_fn(kept.len(), |i| z[kept[i]]);
        let free: Vec<Col<f64>> = larger.free_rigid.iter().map(on_old).collect();
        let old = stiffened(&block(&larger.stiffness, kept, kept), &free)
            .llt(Side::Lower)
            .map_err(unstable)?;
        let mut whitened = block(&larger.stiffness, kept, &added);
        solve_lower_triangular_in_place(old.L(), whitened.as_mut(), Par::Seq);
        let schur = block(&larger.stiffness, &added, &added) - whitened.transpose() * &whitened;
        Ok(DenseFunctions {
            stiffness: block(&larger.stiffness, &added, kept),
            spin: block(&larger.spin, &added, kept),
            nonconservative: larger.nonconservative.as_ref().map(|matrix| {
                let of_new = block(matrix, &added, kept);
                [of_new, block(matrix, kept, &added).transpose().to_owned()]
            }),
            factor: schur.llt(Side::Lower).map_err(unstable)?,
        })
    }

    /// K_nc Q without K_n.
    fn force(&self, speed_rad_per_s: f64, columns: &Mat<f64>) -> Mat<f64> {
        &self.stiffness * columns + Scale(speed_rad_per_s.powi(2)) * &self.spin * columns
    }

    /// L⁻¹ times a force, with the Cholesky factor L of S = LLᵀ.
    fn whitened(&self, mut force: Mat<f64>) -> Mat<f64> {
        solve_lower_triangular_in_place(self.factor.L(), force.as_mut(), Par::Seq);
        force
    }
}

/// Indices of the functions of some harmonics of a plate in a larger basis, ascending. Both have the same heads of guide arms and states of
/// pads.
fn kept(plate: &Plate, larger: &Plate, range: std::ops::RangeInclusive<usize>) -> Vec<usize> {
    let (few, many) = (plate.basis.count(), larger.basis.count());
    let first = larger.offset(*range.start());
    range
        .flat_map(|n| {
            let cosine = larger.offset(n) - first;
            let phases = if n == 0 { 1 } else { 2 };
            let attached = if n == 0 { larger.attached() } else { 0 };
            let waves =
                (0..phases).flat_map(move |phase| (0..few).map(move |j| cosine + phase * many + j));
            waves.chain((0..attached).map(move |k| many + k))
        })
        .collect()
}
