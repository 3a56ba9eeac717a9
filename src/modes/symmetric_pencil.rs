//! Eigenvalues of the symmetric pencil A − m B.

use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Col, Mat, Par, Scale, Side};

use super::error::SpectrumError;
use super::work::Cancellation;
use crate::model::linalg::SymmetricEigen;

/// K₀ with a stiffness added to its free motions z, K₀z = 0, which makes it definite and changes no other
/// motion.
pub fn stiffened(stiffness: &Mat<f64>, free: &[Col<f64>]) -> Mat<f64> {
    let mut stiffened = stiffness.clone();
    let mean = stiffness.norm_l2() / (stiffness.nrows() as f64).sqrt();
    for z in free {
        stiffened += Scale(mean) * z * z.transpose();
    }
    stiffened
}

/// Every m > 0 at which A − m B is singular, ascending, with x of (A − m B) x = 0, ‖x‖ = 1, for symmetric A
/// and B. A is positive definite except on the motions `free`, on which both vanish.
///
/// # Errors
/// [`SpectrumError::UnstableAtRest`] when A is not positive definite on the other motions;
/// [`SpectrumError::Decomposition`].
pub fn singular_multiples(
    stiffness: &Mat<f64>,
    free: &[Col<f64>],
    softening: &Mat<f64>,
) -> Result<Vec<(f64, Col<f64>)>, SpectrumError> {
    Cancellation::current().check()?;
    let order = stiffness.nrows();
    let stiffness = stiffened(stiffness, free);
    let unstable = || SpectrumError::UnstableAtRest { order };
    let factor = stiffness.llt(Side::Lower).map_err(|_| unstable())?;
    let lower = factor.L();
    let mut rows = softening.clone();
    solve_lower_triangular_in_place(lower, rows.as_mut(), Par::Seq);
    let mut whitened = rows.transpose().to_owned();
    solve_lower_triangular_in_place(lower, whitened.as_mut(), Par::Seq);
    let eigen = SymmetricEigen::new(whitened.as_ref()).map_err(SpectrumError::at(0.0))?;
    let noise = 1e-14 * whitened.norm_l2();
    // The multiples m are the inverses of the positive eigenvalues, which ascend.
    let places: Vec<usize> = (0..order)
        .rev()
        .filter(|&i| eigen.values[i] > noise)
        .collect();
    let mut shapes = Mat::from_fn(order, places.len(), |i, k| eigen.vectors[(i, places[k])]);
    solve_upper_triangular_in_place(lower.transpose(), shapes.as_mut(), Par::Seq);
    let multiple = |(k, &i): (usize, &usize)| {
        let x = shapes.col(k);
        (eigen.values[i].recip(), Scale(1.0 / x.norm_l2()) * x)
    };
    let mut multiples: Vec<(f64, Col<f64>)> = places.iter().enumerate().map(multiple).collect();
    multiples.sort_by(|x, y| x.0.total_cmp(&y.0));
    Ok(multiples)
}
