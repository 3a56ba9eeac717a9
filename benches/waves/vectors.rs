//! Eigenvalues of K̃ + μC̃ + μ²M̃ of an undamped saw with their Krein signs.

use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Mat, Par, Scale, c64};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::undamped_eigenpairs;
use sawflutter::modes::waves::WaveModel;

/// Share of |λ| below which a part is rounding of an undamped wave.
pub const REAL: f64 = 1e-8;

/// An eigenvalue with its slope.
#[derive(Debug, Clone, Copy)]
pub struct Root {
    /// λ, in 1/s.
    pub lambda: c64,
    /// dλ/dΩ.
    pub slope: c64,
    /// Krein sign of an undamped wave, else 0.
    pub sign: i8,
}

/// An eigenvalue in units of the window with its vectors.
struct Vectors {
    /// μ, the eigenvalue.
    mu: c64,
    /// y, with yᴴL(μ) = 0.
    left: Vec<c64>,
    /// x, with L(μ)x = 0.
    right: Vec<c64>,
}

/// All eigenvalues of an undamped saw at a speed with Im λ ≥ 0 and |λ| within the reach.
pub fn undamped_roots(model: &WaveModel, speed: f64, window: f64) -> Vec<Root> {
    let (terms, slopes) = model.at(speed);
    let root = |Vectors { mu, left, right }: &Vectors| {
        let form = |matrix: &Mat<f64>| form(left, matrix, right);
        let by_root = form(&terms[1]) + 2.0 * mu * form(&terms[2]);
        let moved = form(&slopes[0]) + mu * form(&slopes[1]) + mu * mu * form(&slopes[2]);
        // xᴴ(−iL′)x, where an undamped wave has x as its left vector too.
        let is_wave = mu.re.abs() <= REAL * (mu.norm() + 1e-3);
        let sign = match is_wave {
            true if (c64::new(0.0, -1.0) * by_root).re > 0.0 => 1,
            true => -1,
            false => 0,
        };
        Root {
            lambda: mu * window,
            slope: -moved / by_root * window,
            sign,
        }
    };
    let pairs = undamped_vectors(&terms, model.reach_per_s() / window);
    pairs.iter().map(root).collect()
}

fn column(matrix: &Mat<f64>, k: usize) -> &[f64] {
    let column = matrix.as_ref().col(k).try_as_col_major();
    column.map_or(&[], |column| column.as_slice())
}

/// yᴴ X x.
fn form(left: &[c64], matrix: &Mat<f64>, right: &[c64]) -> c64 {
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
fn undamped_vectors(terms: &[Mat<f64>], reach: f64) -> Vec<Vectors> {
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
