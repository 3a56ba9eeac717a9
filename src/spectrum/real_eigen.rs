//! Every eigenvalue, and the eigenvectors, of a real matrix; the only such solver outside of tests.
//!
//! faer's blocked QR iteration orders the eigenvalues of a window by exchanging neighbours. Two conjugate
//! pairs that are equal except for rounding cannot be exchanged (Z. Bai, J. Demmel, Linear Algebra Appl. 186,
//! 1993), and the iteration does not end; this occurs for damped free blades at rest, for which every wave is
//! double. The double-shift iteration without such a window takes at most 30 steps for each eigenvalue. faer
//! does not report whether 30 steps were enough, but the traces of the matrix and of its square show it.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, EvdParams, evd_real, evd_scratch};
use faer::{Auto, Col, Mat, MatMut, MatRef, Par, Spec, c64};

use super::vectors::joined;

/// Error of a trace, relative to the size of the matrix, above which the eigenvalues are wrong. A backward
/// stable iteration has errors of 1e-13.
const TRACE_TOLERANCE: f64 = 1e-9;

/// The QR iteration did not converge, or the matrix is not finite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NoConvergence;

/// Eigenvalues and eigenvectors of a real matrix.
#[derive(Debug)]
pub struct RealEigen {
    /// Eigenvalues; conjugates are neighbours, the one with Im λ > 0 first.
    pub values: Vec<c64>,
    /// The vector of a real λ in its column; for conjugates the real part of the first vector in the first
    /// column, its imaginary part in the second.
    columns: Mat<f64>,
}

impl RealEigen {
    /// The eigenvalues and eigenvectors of a matrix.
    ///
    /// # Errors
    /// [`NoConvergence`].
    pub fn new(matrix: MatRef<'_, f64>) -> Result<Self, NoConvergence> {
        let mut columns = Mat::zeros(matrix.nrows(), matrix.ncols());
        let values = solve(matrix, Some(columns.as_mut()))?;
        Ok(RealEigen { values, columns })
    }

    /// The eigenvector of value `i`.
    pub fn vector(&self, i: usize) -> Col<c64> {
        joined(&self.halves_of(&[i]), 0)
    }

    /// Real and imaginary parts of vectors side by side, two columns each.
    pub fn halves_of(&self, places: &[usize]) -> Mat<f64> {
        Mat::from_fn(self.columns.nrows(), 2 * places.len(), |row, k| {
            let i = places[k / 2];
            match (k % 2, self.values[i].im) {
                (0, im) if im >= 0.0 => self.columns[(row, i)],
                (0, _) => self.columns[(row, i - 1)],
                (_, im) if im > 0.0 => self.columns[(row, i + 1)],
                (_, im) if im < 0.0 => -self.columns[(row, i)],
                _ => 0.0,
            }
        })
    }

    /// Indices of the λ with Im λ ≥ 0.
    pub fn upper(&self) -> Vec<usize> {
        let all = 0..self.values.len();
        all.filter(|&i| self.values[i].im >= 0.0).collect()
    }
}

/// The eigenvalues alone.
///
/// # Errors
/// [`NoConvergence`].
pub fn real_eigenvalues(matrix: MatRef<'_, f64>) -> Result<Vec<c64>, NoConvergence> {
    solve(matrix, None)
}

fn solve(
    matrix: MatRef<'_, f64>,
    vectors: Option<MatMut<'_, f64>>,
) -> Result<Vec<c64>, NoConvergence> {
    let order = matrix.nrows();
    let mut params = <EvdParams as Auto<f64>>::auto();
    params.schur.blocking_threshold = usize::MAX;
    let right = match vectors {
        Some(_) => ComputeEigenvectors::Yes,
        None => ComputeEigenvectors::No,
    };
    let left = ComputeEigenvectors::No;
    let scratch = evd_scratch::<f64>(order, left, right, Par::Seq, Spec::from(params));
    let (mut re, mut im) = (Diag::zeros(order), Diag::zeros(order));
    evd_real(
        matrix,
        re.as_mut(),
        im.as_mut(),
        None,
        vectors,
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        Spec::from(params),
    )
    .map_err(|_| NoConvergence)?;
    let values: Vec<c64> = (0..order).map(|i| c64::new(re[i], im[i])).collect();
    match are_all(matrix, &values) {
        true => Ok(values),
        false => Err(NoConvergence),
    }
}

/// Whether the sums of the values and of their squares equal the traces of the matrix and of its square.
fn are_all(matrix: MatRef<'_, f64>, values: &[c64]) -> bool {
    let unit = matrix.norm_max();
    if unit == 0.0 {
        return true;
    }
    let order = matrix.nrows();
    let (mut trace, mut square, mut size) = (0.0, 0.0, 0.0);
    for k in 0..order {
        trace += matrix[(k, k)] / unit;
        for i in 0..order {
            let entry = matrix[(i, k)] / unit;
            square += entry * (matrix[(k, i)] / unit);
            size += entry * entry;
        }
    }
    let sum: c64 = values.iter().map(|value| value / unit).sum();
    let sum_of_squares: c64 = values.iter().map(|value| (value / unit).powi(2)).sum();
    (sum - trace).norm() <= TRACE_TOLERANCE * (order as f64 * size).sqrt()
        && (sum_of_squares - square).norm() <= TRACE_TOLERANCE * size
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;
    use std::time::Duration;

    use super::*;
    use crate::plate::{Plate, Resolution};
    use crate::scene::{DampingFile, Scene, ThicknessRow};
    use crate::spectrum::vectors::Eigenpair;
    use crate::spectrum::{Component, companion_eigenpairs};
    use crate::system::GyroscopicSystem;

    /// A damped free blade with three thicknesses, from a random test: every wave is double.
    fn twice_every_wave() -> Plate {
        let scene = Scene::paper().edited(|saw| {
            (saw.cut, saw.runup, saw.probe, saw.measured) = (None, None, None, None);
            saw.guides.clear();
            let blade = &mut saw.blade;
            blade.outer_diameter_m = 1.7039005956434714;
            blade.inner_diameter_m = 1.1401680670583623;
            blade.thickness_m = 0.000022727469526954823;
            let steps = [
                (0.5804473014594919, 0.000035810356070992554),
                (0.6127822457633207, 4.522951973305025e-6),
            ];
            blade.profile = steps
                .map(|(radius_m, thickness_m)| ThicknessRow {
                    radius_m,
                    thickness_m,
                })
                .to_vec();
            blade.material.youngs_modulus_pa = 100186744734.62596;
            blade.material.poisson_ratio = -0.29091325246051736;
            blade.material.density_kg_per_m3 = 29644.980423250156;
            saw.damping = Some(DampingFile {
                material_retardation_time_s: 1.2609351739477124e-6,
                air_n_s_per_m3: 1.2154437772463647,
                air_rotation_share: 0.8173495078965438,
                ..DampingFile::default()
            });
        });
        let resolution = Resolution {
            max_diameters: 5,
            radial_functions: 5,
        };
        Plate::new(&scene.unwrap(), resolution)
    }

    /// The iteration ends, and finds the eigenvalues of each harmonic.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
    fn equal_pairs_do_not_keep_the_iteration_from_its_end() {
        let (send, receive) = channel();
        std::thread::spawn(move || {
            let system = GyroscopicSystem::of_plate(&twice_every_wave());
            send.send(companion_eigenpairs(&system, 0.0).unwrap())
        });
        let limit = Duration::from_secs(60);
        let whole = receive
            .recv_timeout(limit)
            .expect("an end of the iteration");
        let harmonics = Component::of(&twice_every_wave());
        let harmonics = harmonics.iter().map(|component| &component.full);
        let mut apart: Vec<c64> = harmonics
            .flat_map(|system| companion_eigenpairs(system, 0.0).unwrap())
            .flat_map(with_conjugate)
            .collect();
        let whole: Vec<c64> = whole.into_iter().flat_map(with_conjugate).collect();
        assert_eq!(whole.len(), apart.len());
        let largest = whole.last().expect("eigenvalues").norm();
        for lambda in whole {
            let distance = |other: &c64| (other - lambda).norm();
            let nearest = (0..apart.len())
                .min_by(|&i, &k| distance(&apart[i]).total_cmp(&distance(&apart[k])))
                .unwrap();
            let error = distance(&apart.swap_remove(nearest));
            // Errors are ε times the largest eigenvalue, and the root of ε for double ones.
            assert!(error <= 1e-7 * largest, "{lambda}: {error:e}");
        }
    }

    /// An eigenvalue, and its conjugate if it is complex: rounding may turn two equal real ones into such a
    /// pair.
    fn with_conjugate((lambda, _): Eigenpair) -> impl Iterator<Item = c64> {
        let conjugate = (lambda.im > 0.0).then(|| lambda.conj());
        [Some(lambda), conjugate].into_iter().flatten()
    }

    #[test]
    fn wrong_eigenvalues_are_detected() {
        let matrix = Mat::from_fn(6, 6, |i, k| ((i * i + 3 * k * i + k) as f64).sin());
        let eigen = RealEigen::new(matrix.as_ref()).unwrap();
        assert!(are_all(matrix.as_ref(), &eigen.values));
        for i in 0..6 {
            let mut wrong = eigen.values.clone();
            wrong[i] = c64::new(0.0, 0.0);
            assert!(!are_all(matrix.as_ref(), &wrong), "{i}");
        }
        let mut halves = 0;
        for i in 0..6 {
            let q = eigen.vector(i);
            let off = Col::from_fn(6, |row| {
                (0..6).map(|k| q[k] * matrix[(row, k)]).sum::<c64>() - eigen.values[i] * q[row]
            });
            assert!(off.norm_l2() < 1e-12 * q.norm_l2(), "{}", eigen.values[i]);
            halves += usize::from(eigen.values[i].im < 0.0);
        }
        assert_eq!(eigen.upper().len(), 6 - halves);
    }

    #[test]
    fn a_matrix_that_is_not_finite_has_no_eigenvalues() {
        let matrix = Mat::from_fn(4, 4, |i, k| if i == k { f64::NAN } else { 1.0 });
        assert_eq!(real_eigenvalues(matrix.as_ref()), Err(NoConvergence));
    }
}
