//! Radial functions R_nj(r): polynomials, orthonormal with weight r on the annulus.
//!
//! A free edge asks nothing of them. A clamped bore multiplies them by
//! ((r−a)/(b−a))². For n = 1 on a free bore the first two are turned so that the
//! first is the rigid tilt, R ∝ r; for n = 0 the first is the rigid heave already.

use crate::scene::{Blade, Bore};

use super::quadrature::{self, Rule};

/// R, R′ and R″ of every radial function at one radius.
#[derive(Debug, Clone, Default)]
pub struct RadialValues {
    /// R_nj(r), in 1/m.
    pub value: Vec<f64>,
    /// R_nj′(r), in 1/m².
    pub slope: Vec<f64>,
    /// R_nj″(r), in 1/m³.
    pub curvature: Vec<f64>,
}

/// J radial functions for each number of nodal diameters n, with
/// ∫ R_nj R_nk r dr = δ_jk over a < r < b.
#[derive(Debug, Clone)]
pub struct RadialBasis {
    inner_radius_m: f64,
    width_m: f64,
    clamped: bool,
    /// Three-term recurrence x pⱼ = offᵢ₊₁ pⱼ₊₁ + diagⱼ pⱼ + offⱼ pⱼ₋₁; `off[0]` scales p₀.
    diag: Vec<f64>,
    off: Vec<f64>,
    /// (cos, sin) of the turn that makes the first function of n = 1 the rigid tilt.
    tilt: Option<(f64, f64)>,
    rule: Rule,
}

impl RadialBasis {
    /// Builds J ≥ 2 functions by the discretised Stieltjes procedure
    /// (Gautschi, *Orthogonal Polynomials*, 2004, section 2.2), which keeps full
    /// accuracy where Gram–Schmidt on monomials would lose it.
    pub fn new(blade: &Blade, functions: usize) -> Self {
        let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
        let mut basis = RadialBasis {
            inner_radius_m: a,
            width_m: b - a,
            clamped: matches!(blade.bore, Bore::Clamped(_)),
            diag: Vec::with_capacity(functions),
            off: Vec::with_capacity(functions),
            tilt: None,
            rule: quadrature::graded(a, b, functions + 12),
        };
        basis.stieltjes(functions);
        if !basis.clamped {
            basis.tilt = Some(basis.tilt_turn());
        }
        basis
    }

    /// Number J of radial functions.
    pub fn count(&self) -> usize {
        self.diag.len()
    }

    /// Whether rigid heave and tilt are part of the motion.
    pub fn has_rigid_motions(&self) -> bool {
        !self.clamped
    }

    /// A rule that integrates products of two radial functions with r dr, r⁻¹ dr
    /// and r⁻³ dr to rounding; the weights do not contain r.
    pub fn rule(&self) -> &Rule {
        &self.rule
    }

    fn stieltjes(&mut self, functions: usize) {
        let weights: Vec<f64> = self
            .rule
            .iter()
            .map(|(r, w)| w * r * self.clamp(r)[0].powi(2))
            .collect();
        let x: Vec<f64> = self.rule.points.iter().map(|&r| self.mapped(r)).collect();
        let mut previous = vec![0.0; x.len()];
        let mut current = vec![1.0; x.len()];
        let mut off = 0.0;
        for _ in 0..functions {
            let norm = dot(&weights, &current, &current).sqrt();
            current.iter_mut().for_each(|p| *p /= norm);
            self.off.push(norm);
            let xp: Vec<f64> = x.iter().zip(&current).map(|(x, p)| x * p).collect();
            let diag = dot(&weights, &xp, &current);
            self.diag.push(diag);
            off = if self.off.len() == 1 { off } else { norm };
            let next = (0..x.len())
                .map(|k| xp[k] - diag * current[k] - off * previous[k])
                .collect();
            previous = std::mem::replace(&mut current, next);
        }
    }

    /// The tilt r = c₀p₀ + c₁p₁, as the cosine and sine of the turn in that plane.
    fn tilt_turn(&self) -> (f64, f64) {
        let mut coefficient = [0.0; 2];
        for (r, w) in self.rule.iter() {
            let p = self.unturned(r).value;
            coefficient[0] += w * r * r * p[0];
            coefficient[1] += w * r * r * p[1];
        }
        let norm = coefficient[0].hypot(coefficient[1]);
        (coefficient[0] / norm, coefficient[1] / norm)
    }

    /// x ∈ [−1, 1] for r ∈ [a, b].
    fn mapped(&self, r: f64) -> f64 {
        2.0 * (r - self.inner_radius_m) / self.width_m - 1.0
    }

    /// The factor of a clamped bore and its two derivatives.
    fn clamp(&self, r: f64) -> [f64; 3] {
        if !self.clamped {
            return [1.0, 0.0, 0.0];
        }
        let t = (r - self.inner_radius_m) / self.width_m;
        [t * t, 2.0 * t / self.width_m, 2.0 / self.width_m.powi(2)]
    }

    /// The functions of every n ≠ 1 at a radius.
    fn unturned(&self, r: f64) -> RadialValues {
        let x = self.mapped(r);
        let dx = 2.0 / self.width_m;
        let [c, dc, ddc] = self.clamp(r);
        let mut values = RadialValues::default();
        let mut previous = [0.0; 3];
        let mut p = [1.0 / self.off[0], 0.0, 0.0];
        for j in 0..self.count() {
            values.value.push(c * p[0]);
            values.slope.push(dc * p[0] + c * p[1] * dx);
            let curvature = ddc * p[0] + 2.0 * dc * p[1] * dx + c * p[2] * dx * dx;
            values.curvature.push(curvature);
            let Some(&next_off) = self.off.get(j + 1) else {
                break;
            };
            let off = if j == 0 { 0.0 } else { self.off[j] };
            let shifted = x - self.diag[j];
            let next = [
                shifted * p[0] - off * previous[0],
                p[0] + shifted * p[1] - off * previous[1],
                2.0 * p[1] + shifted * p[2] - off * previous[2],
            ]
            .map(|value| value / next_off);
            previous = std::mem::replace(&mut p, next);
        }
        values
    }

    /// The functions of n nodal diameters at radius r.
    pub fn evaluate(&self, n: usize, r: f64) -> RadialValues {
        let mut values = self.unturned(r);
        if n == 1
            && let Some(turn) = self.tilt
        {
            rotate(&mut values.value, turn);
            rotate(&mut values.slope, turn);
            rotate(&mut values.curvature, turn);
        }
        values
    }
}

impl RadialBasis {
    /// A J × J block between n and m diameters, from the functions shared by all
    /// harmonics to those of n (rows) and m (columns).
    pub fn turned(
        &self,
        n: usize,
        m: usize,
        mut block: nalgebra::DMatrix<f64>,
    ) -> nalgebra::DMatrix<f64> {
        let Some((cos, sin)) = self.tilt else {
            return block;
        };
        let turn = nalgebra::Matrix2::new(cos, sin, -sin, cos);
        if n == 1 {
            let rows = turn * block.rows(0, 2);
            block.rows_mut(0, 2).copy_from(&rows);
        }
        if m == 1 {
            let columns = block.columns(0, 2) * turn.transpose();
            block.columns_mut(0, 2).copy_from(&columns);
        }
        block
    }
}

fn rotate(values: &mut [f64], (cos, sin): (f64, f64)) {
    let (first, second) = (values[0], values[1]);
    values[0] = cos * first + sin * second;
    values[1] = -sin * first + cos * second;
}

fn dot(weights: &[f64], left: &[f64], right: &[f64]) -> f64 {
    weights
        .iter()
        .zip(left.iter().zip(right))
        .map(|(w, (x, y))| w * x * y)
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    fn paper_basis(functions: usize) -> RadialBasis {
        RadialBasis::new(Scene::paper().blade(), functions)
    }

    #[test]
    fn the_functions_are_orthonormal() {
        let basis = paper_basis(14);
        for n in [0, 1, 5] {
            for j in 0..14 {
                for k in 0..=j {
                    let product: f64 = basis
                        .rule()
                        .iter()
                        .map(|(r, w)| {
                            let values = basis.evaluate(n, r).value;
                            w * r * values[j] * values[k]
                        })
                        .sum();
                    let expected = f64::from(u8::from(j == k));
                    assert!((product - expected).abs() < 1e-12, "{n} {j} {k}: {product}");
                }
            }
        }
    }

    #[test]
    fn the_first_function_of_one_diameter_is_the_tilt() {
        let basis = paper_basis(8);
        let ratio = |r: f64| basis.evaluate(1, r).value[0] / r;
        assert!((ratio(0.11) / ratio(0.35) - 1.0).abs() < 1e-13);
        assert!(basis.evaluate(1, 0.2).curvature[0].abs() < 1e-10);
    }

    #[test]
    fn derivatives_agree_with_central_differences() {
        let basis = paper_basis(8);
        let (r, step) = (0.21, 1e-6);
        let middle = basis.evaluate(1, r);
        let (low, high) = (basis.evaluate(1, r - step), basis.evaluate(1, r + step));
        for j in 1..8 {
            let slope = (high.value[j] - low.value[j]) / (2.0 * step);
            assert!((slope / middle.slope[j] - 1.0).abs() < 1e-6);
            let curvature = (high.slope[j] - low.slope[j]) / (2.0 * step);
            assert!(
                (curvature - middle.curvature[j]).abs() < 1e-6 * middle.curvature[j].abs().max(1.0)
            );
        }
    }
}
