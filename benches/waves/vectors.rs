//! Eigenvalues of K̃ + μC̃ + μ²M̃ with left and right vectors.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, EvdParams, evd_real, evd_scratch};
use faer::linalg::solvers::Solve;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Auto, Mat, MatRef, Par, Scale, Spec, c64};
use sawflutter::spectrum::undamped_eigenpairs;
use sawflutter::system::GyroscopicSystem;

/// Share of |λ| below which a part is rounding of an undamped wave.
pub const REAL: f64 = 1e-8;

/// An eigenvalue in units of the window with its vectors.
pub struct Vectors {
    /// μ, the eigenvalue.
    pub mu: c64,
    /// y, with yᴴL(μ) = 0.
    pub left: Vec<c64>,
    /// x, with L(μ)x = 0.
    pub right: Vec<c64>,
}

fn column(matrix: &Mat<f64>, k: usize) -> &[f64] {
    let column = matrix.as_ref().col(k).try_as_col_major();
    column.map_or(&[], |column| column.as_slice())
}

/// yᴴ X x.
pub fn form(left: &[c64], matrix: &Mat<f64>, right: &[c64]) -> c64 {
    let mut sum = c64::new(0.0, 0.0);
    for (k, x) in right.iter().enumerate() {
        let (mut re, mut im) = (0.0, 0.0);
        for (y, entry) in left.iter().zip(column(matrix, k)) {
            re += y.re * entry;
            im -= y.im * entry;
        }
        sum += c64::new(re, im) * x;
    }
    sum
}

/// Of an undamped saw: K̃ symmetric, C̃ skew, M̃ = RRᵀ, so that R⁻¹K̃R⁻ᵀ and R⁻¹C̃R⁻ᵀ are a system with the mass 1, whose
/// eigenvalues follow from a problem of half the order. The left vector of λ is the right one of −λ*.
pub fn undamped_vectors(terms: &[Mat<f64>], reach: f64) -> Vec<Vectors> {
    let size = terms[0].nrows();
    let inertia = Scale(0.5) * (&terms[2] + terms[2].transpose());
    let factor = inertia
        .llt(faer::Side::Lower)
        .expect("positive inertia")
        .L()
        .to_owned();
    let both_sides = |matrix: &Mat<f64>| {
        let mut half = matrix.clone();
        solve_lower_triangular_in_place(factor.as_ref(), half.as_mut(), Par::Seq);
        let mut half = half.transpose().to_owned();
        solve_lower_triangular_in_place(factor.as_ref(), half.as_mut(), Par::Seq);
        half.transpose().to_owned()
    };
    let (stiffness, velocity) = (both_sides(&terms[0]), both_sides(&terms[1]));
    let symmetric = Scale(0.5) * (&stiffness + stiffness.transpose());
    let skew = Scale(0.25) * (&velocity - velocity.transpose());
    let system = GyroscopicSystem {
        stiffness: symmetric,
        spin: Mat::zeros(size, size),
        gyroscopic: skew,
        damping: None,
        circulatory: None,
        nonconservative: None,
        free_rigid: Vec::new(),
        drift: None,
    };
    let pairs = undamped_eigenpairs(&system, 1.0).expect("converges");
    let kept: Vec<_> = pairs
        .into_iter()
        .filter(|(mu, _)| mu.norm() < reach)
        .collect();
    let mut shapes = Mat::from_fn(size, 2 * kept.len(), |i, k| {
        let entry = kept[k / 2].1[i];
        if k % 2 == 0 { entry.re } else { entry.im }
    });
    solve_upper_triangular_in_place(factor.transpose(), shapes.as_mut(), Par::Seq);
    let shape = |k: usize| -> Vec<c64> {
        (0..size)
            .map(|i| c64::new(shapes[(i, 2 * k)], shapes[(i, 2 * k + 1)]))
            .collect()
    };
    let partner = |mu: c64| {
        let off = |k: &usize| (kept[*k].0 + mu.conj()).norm();
        (0..kept.len()).min_by(|x, y| off(x).total_cmp(&off(y)))
    };
    let vectors = |k: usize| {
        let mu = kept[k].0;
        let is_wave = mu.re.abs() <= REAL * (mu.norm() + 1e-3);
        let left = if is_wave { k } else { partner(mu).unwrap_or(k) };
        Vectors {
            mu,
            left: shape(left),
            right: shape(k),
        }
    };
    (0..kept.len()).map(vectors).collect()
}

/// By the companion matrix. The lower half of its left vector times M̃⁻¹ is the left vector of L.
pub fn damped_vectors(terms: &[Mat<f64>], reach: f64) -> Vec<Vectors> {
    let size = terms[0].nrows();
    let inertia = terms[2].partial_piv_lu();
    let (mut stiffness, mut velocity) = (terms[0].clone(), terms[1].clone());
    inertia.solve_in_place(&mut stiffness);
    inertia.solve_in_place(&mut velocity);
    let companion = Mat::from_fn(2 * size, 2 * size, |i, k| match (i < size, k < size) {
        (true, true) => 0.0,
        (true, false) => f64::from(u8::from(i + size == k)),
        (false, true) => -stiffness[(i - size, k)],
        (false, false) => -velocity[(i - size, k - size)],
    });
    let eigen = TwoSided::new(companion.as_ref());
    let kept: Vec<usize> = (0..2 * size)
        .filter(|k| eigen.values[*k].im >= 0.0 && eigen.values[*k].norm() < reach)
        .collect();
    let lower: Vec<Vec<c64>> = kept
        .iter()
        .map(|k| eigen.vector(&eigen.left, *k, size, size))
        .collect();
    let mut left = Mat::from_fn(size, 2 * kept.len(), |i, k| {
        let entry = lower[k / 2][i];
        if k % 2 == 0 { entry.re } else { entry.im }
    });
    inertia.solve_transpose_in_place(&mut left);
    let vectors = |(k, place): (usize, &usize)| Vectors {
        mu: eigen.values[*place],
        left: (0..size)
            .map(|i| c64::new(left[(i, 2 * k)], left[(i, 2 * k + 1)]))
            .collect(),
        right: eigen.vector(&eigen.right, *place, 0, size),
    };
    kept.iter().enumerate().map(vectors).collect()
}

/// Eigenvalues with left and right vectors.
struct TwoSided {
    values: Vec<c64>,
    left: Mat<f64>,
    right: Mat<f64>,
}

impl TwoSided {
    fn new(matrix: MatRef<'_, f64>) -> Self {
        let order = matrix.nrows();
        let mut params = <EvdParams as Auto<f64>>::auto();
        params.schur.blocking_threshold = usize::MAX;
        let yes = ComputeEigenvectors::Yes;
        let scratch = evd_scratch::<f64>(order, yes, yes, Par::Seq, Spec::from(params));
        let (mut re, mut im) = (Diag::zeros(order), Diag::zeros(order));
        let (mut left, mut right) = (Mat::zeros(order, order), Mat::zeros(order, order));
        evd_real(
            matrix,
            re.as_mut(),
            im.as_mut(),
            Some(left.as_mut()),
            Some(right.as_mut()),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
            Spec::from(params),
        )
        .expect("converges");
        TwoSided {
            values: (0..order).map(|i| c64::new(re[i], im[i])).collect(),
            left,
            right,
        }
    }

    /// Rows `first` to `first + count` of a vector of an eigenvalue with Im λ ≥ 0.
    fn vector(&self, columns: &Mat<f64>, k: usize, first: usize, count: usize) -> Vec<c64> {
        let im = |i: usize| match self.values[k].im > 0.0 {
            true => columns[(i, k + 1)],
            false => 0.0,
        };
        (first..first + count)
            .map(|i| c64::new(columns[(i, k)], im(i)))
            .collect()
    }
}
