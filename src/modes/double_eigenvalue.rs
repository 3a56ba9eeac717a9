//! Speed at which two eigenvalues coalesce, with both, by Newton's method.
//!
//! With columns b and c next to the left and the right vector, the bordered matrix in
//!
//! [L b; cᴴ 0] [v; g] = [0; 1],  [wᴴ ḡ] [L b; cᴴ 0] = [0 1]
//!
//! is regular at a double eigenvalue, and g(λ, Ω) is zero at every eigenvalue. Two of them coalesce where g = 0 and
//! ∂g/∂λ = 0. With the subscripts s and t for derivatives with respect to λ or Ω,
//!
//! g_s = −wᴴL_s v,  g_st = −wᴴ(L_st v + L_s v_t + L_t v_s),  [L b; cᴴ 0] [v_s; g_s] = [−L_s v; 0]
//!
//! and so on. Next to the coalescence the eigenvalues differ from the double one by ±√(aδΩ) + mδΩ, with
//! a = −2g_Ω/g_λλ and m = −(g_λΩ + a g_λλλ/6)/g_λλ
//!
//! (A. Griewank & G. W. Reddien, *Characterization and computation of generalized turning points*, SIAM J. Numer. Anal. 21
//! (1984), 176–185).

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Col, Mat, Scale, c64};

use super::family::{Family, MatrixPolynomial};
use super::single_eigenvalue::nearest;
use super::vectors::unit;

/// A double eigenvalue.
#[derive(Debug, Clone)]
pub struct DoubleEigenvalue {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// λ, in 1/s.
    pub lambda: c64,
    /// a = d((λ₁ − λ₂)/2)²/dΩ of the two eigenvalues, in 1/s.
    pub square_slope: f64,
    /// m = d((λ₁ + λ₂)/2)/dΩ.
    pub mean_slope: c64,
    /// Right vector, L(λ)x = 0, ‖x‖ = 1.
    pub right: Col<c64>,
    /// Left vector, yᴴL(λ) = 0, ‖y‖ = 1.
    pub left: Col<c64>,
}

/// Largest number of steps; convergence is quadratic.
const STEPS: usize = 12;
/// Relative size of the last correction of the speed.
const TOLERANCE: f64 = 1e-9;
impl DoubleEigenvalue {
    /// The coalescence next to an expected one. That of waves λ = iω or of real λ is at another λ of this kind. `None` if the
    /// iteration does not converge, or leaves the speeds of the family.
    pub fn next_to(family: &impl Family, speed_rad_per_s: f64, expected: c64) -> Option<Self> {
        let (mut speed, mut lambda) = (speed_rad_per_s, expected);
        let [mut right, mut left] = vectors(family, speed, lambda)?;
        for _ in 0..STEPS {
            let jet = Jet::new(family, speed, lambda, [&right, &left])?;
            let [by_root, by_speed, twice_by_root, by_both, thrice_by_root] = jet.slopes;
            let determinant = by_root * by_both - by_speed * twice_by_root;
            let change = (by_speed * by_root - by_both * jet.value) / determinant;
            let step = ((twice_by_root * jet.value - by_root * by_root) / determinant).re;
            lambda += change;
            speed += step;
            if expected.im == 0.0 {
                lambda.im = 0.0;
            } else if expected.re == 0.0 {
                lambda.re = 0.0;
            }
            if !(lambda.is_finite() && speed.is_finite()) {
                return None;
            }
            (right, left) = (unit(jet.right.as_ref()), unit(jet.left.as_ref()));
            if step.abs() <= TOLERANCE * speed {
                let square_slope = -2.0 * by_speed / twice_by_root;
                return Some(DoubleEigenvalue {
                    speed_rad_per_s: speed,
                    lambda,
                    square_slope: square_slope.re,
                    mean_slope: -(by_both + square_slope * thrice_by_root / 6.0) / twice_by_root,
                    right,
                    left,
                });
            }
        }
        None
    }
}

/// The right and the left vector of the eigenvalue nearest to λ.
fn vectors(family: &impl Family, speed: f64, lambda: c64) -> Option<[Col<c64>; 2]> {
    let at = family.at(speed)?;
    let [value, by_root] = at.by_root(lambda);
    let found = nearest(&at, lambda, [&value, &by_root], None);
    found.iter().all(Col::is_all_finite).then_some(found)
}

/// The function g at a point with its vectors.
struct Jet {
    /// g.
    value: c64,
    /// g_λ, g_Ω, g_λλ, g_λΩ, g_λλλ.
    slopes: [c64; 5],
    /// v.
    right: Col<c64>,
    /// w.
    left: Col<c64>,
}

impl Jet {
    fn new(family: &impl Family, speed: f64, lambda: c64, [c, b]: [&Col<c64>; 2]) -> Option<Self> {
        let at = family.at(speed)?;
        let [dynamic, by_root, twice_by_root, thrice_by_root] = &at.by_root(lambda);
        let [by_speed, by_both] = &at.by_speed(lambda);
        let bordered = Bordered::new(dynamic, c, b);
        let (right, value) = bordered.solved(&Col::zeros(at.order()), c64::new(1.0, 0.0));
        let left = bordered.left();
        let form = |x: Col<c64>| -(left.adjoint() * x);
        let [rooted, sped] = [by_root * &right, by_speed * &right];
        let moved = |load: &Col<c64>| bordered.solved(&-load, c64::new(0.0, 0.0)).0;
        let [right_by_root, right_by_speed] = [moved(&rooted), moved(&sped)];
        let times = |factor: f64| Scale(c64::new(factor, 0.0));
        let both = by_both * &right + by_root * &right_by_speed + by_speed * &right_by_root;
        let twice = twice_by_root * &right + times(2.0) * (by_root * &right_by_root);
        let thrice = thrice_by_root * &right
            + times(3.0) * (twice_by_root * &right_by_root + by_root * moved(&twice));
        let slopes = [rooted, sped, twice, both, thrice].map(form);
        let is_finite = value.is_finite() && slopes.iter().all(|slope| slope.is_finite());
        is_finite.then_some(Jet {
            value,
            slopes,
            right,
            left,
        })
    }
}

/// [L b; cᴴ 0], factorized.
struct Bordered {
    factors: PartialPivLu<c64>,
    order: usize,
}

impl Bordered {
    fn new(dynamic: &Mat<c64>, c: &Col<c64>, b: &Col<c64>) -> Self {
        let order = dynamic.nrows();
        let matrix = Mat::from_fn(order + 1, order + 1, |i, k| match (i < order, k < order) {
            (true, true) => dynamic[(i, k)],
            (true, false) => b[i],
            (false, true) => c[k].conj(),
            (false, false) => c64::new(0.0, 0.0),
        });
        Bordered {
            factors: matrix.partial_piv_lu(),
            order,
        }
    }

    /// x and y with Lx + by = `load` and cᴴx = `last`.
    fn solved(&self, load: &Col<c64>, last: c64) -> (Col<c64>, c64) {
        let right = Col::from_fn(
            self.order + 1,
            |i| if i < self.order { load[i] } else { last },
        );
        let solved: Col<c64> = self.factors.solve(right);
        (solved.subrows(0, self.order).to_owned(), solved[self.order])
    }

    /// w.
    fn left(&self) -> Col<c64> {
        let unit = Col::from_fn(self.order + 1, |i| {
            c64::new(f64::from(u8::from(i == self.order)), 0.0)
        });
        let solved: Col<c64> = self.factors.solve_adjoint(unit);
        solved.subrows(0, self.order).to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::system::GyroscopicSystem;

    /// A turning shaft on springs a and b: λ⁴ + (a + b + 2Ω²)λ² + (a − Ω²)(b − Ω²) has a double λ² = −(a + b)/2 − Ω² where
    /// 8Ω² = −(a − b)²/(a + b). With λ₁λ₂ = ∓√((a − Ω²)(b − Ω²)), − for waves and + for real λ,
    /// ((λ₁ − λ₂)/2)² = −((a + b)/2 + Ω² + λ₁λ₂)/2 next to it.
    #[test]
    fn modes_of_a_shaft_coalesce_at_the_speed_of_the_closed_form() {
        for (a, b) in [(1.0, -2.0), (-0.1, -2.0)] {
            let matrix = |entries: [f64; 4]| Mat::from_fn(2, 2, |i, k| entries[2 * i + k]);
            let system = GyroscopicSystem {
                stiffness: matrix([a, 0.0, 0.0, b]),
                spin: matrix([-1.0, 0.0, 0.0, -1.0]),
                gyroscopic: matrix([0.0, -1.0, 1.0, 0.0]),
                damping: None,
                circulatory: None,
                nonconservative: None,
                free_rigid: Vec::new(),
                drift: None,
            };
            let exact = (-(a - b).powi(2) / (8.0 * (a + b))).sqrt();
            let double_square: f64 = -0.5 * (a + b) - exact * exact;
            let double = c64::new(double_square, 0.0).sqrt();
            // ((λ₁ ∓ λ₂)/2)².
            let square = |speed: f64, sign: f64| {
                let (sum, product) = (a + b, (a - speed * speed) * (b - speed * speed));
                -0.5 * (0.5 * sum + speed * speed + sign * double_square.signum() * product.sqrt())
            };
            let found = DoubleEigenvalue::next_to(&system, 1.02 * exact, double * 1.03).unwrap();
            let of_speed = found.speed_rad_per_s / exact - 1.0;
            assert!(of_speed.abs() < 1e-9, "{found:?} {exact}");
            assert!((found.lambda - double).norm() < 1e-6, "{found:?} {double}");
            let h = 1e-5;
            let slope = |of: &dyn Fn(f64) -> f64| (of(exact + h) - of(exact - h)) / (2.0 * h);
            let difference = slope(&|speed| square(speed, 1.0));
            let of_slope = found.square_slope / difference - 1.0;
            assert!(of_slope.abs() < 1e-6, "{found:?} {difference}");
            // The slope of the root of a square.
            let mean = slope(&|speed| square(speed, -1.0)) / (2.0 * double);
            assert!((found.mean_slope - mean).norm() < 1e-6, "{found:?} {mean}");
        }
    }
}
