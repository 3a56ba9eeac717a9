//! Radial functions R_nj(r): polynomials, orthonormal with weight r on the annulus.
//!
//! A free edge imposes no condition on them. For a clamped bore they are multiplied by ((r−a)/(b−a))², for a clamp that yields
//! to a slope by (r−a)/(b−a). For n
//! = 1 on a free bore the first two are rotated so that the first is the rigid tilt, R ∝ r; for n = 0 the
//! first is the rigid heave.
//!
//! If the thickness is not uniform the weight is μ(r) r, where μ is the mass per area relative to that of the
//! thickness `thickness_m`, including the mass of teeth at one radius, so that the mass matrix remains the
//! identity. At a step of thickness the moment is continuous and the curvature is not, which polynomials
//! approximate poorly: truncated powers (r − r_k)₊^p are added to the basis there. They follow the first two
//! polynomials, so that a larger basis begins with a smaller one.

use nalgebra::{DMatrix, Matrix2};

use crate::model::scene::{Blade, Bore};

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

/// J polynomials, and a few functions for each knot of the thickness, for each number of nodal diameters n,
/// with ∫ R_nj R_nk μ r dr = δ_jk over a < r < b.
#[derive(Debug, Clone)]
pub(crate) struct RadialBasis {
    inner_radius_m: f64,
    width_m: f64,
    /// Power of (r−a)/(b−a) that the functions contain: 0 for a free bore, 1 for a clamp that yields, 2 for a rigid one.
    held: usize,
    /// Three-term recurrence x pⱼ = offᵢ₊₁ pⱼ₊₁ + diagⱼ pⱼ + offⱼ pⱼ₋₁; `off[0]` scales p₀.
    diag: Vec<f64>,
    off: Vec<f64>,
    /// Rotation of the first two functions that makes the first one of n = 1 the rigid tilt.
    tilt: Option<Turn>,
    knots: Option<KnotFunctions>,
    /// Rule for integrals over the radius; the weights do not contain r.
    rule: Rule,
    /// Rule for integrals over the mass; the weights contain μ r.
    mass_rule: Rule,
}

/// Cosine and sine of a rotation.
#[derive(Debug, Clone, Copy)]
struct Turn {
    cos: f64,
    sin: f64,
}

/// A function (r − r_k)₊^p.
#[derive(Debug, Clone, Copy)]
struct TruncatedPower {
    /// Knot r_k.
    knot_m: f64,
    /// Exponent p.
    power: i32,
}

/// Truncated powers, and the coefficients that orthonormalize them together with the polynomials.
#[derive(Debug, Clone)]
struct KnotFunctions {
    powers: Vec<TruncatedPower>,
    /// Row j: coefficients of the first j + 1 of p₀, p₁, powers, p₂ … in function j.
    rows: Vec<Vec<f64>>,
}

/// Powers added where the curvature jumps, at a step of the thickness. A kink needs only the higher ones, but
/// a step that tends to zero must have a continuous limit.
const AT_STEP: [i32; 3] = [2, 3, 4];
/// Powers added where only the slope of the curvature jumps, at the mass of teeth.
const AT_MASS: [i32; 2] = [3, 4];
/// A knot closer than this share of the width to an edge or another knot gets no functions, because they
/// would be nearly dependent.
const MIN_SPACING: f64 = 0.02;

impl RadialBasis {
    /// Builds J ≥ 2 functions by the discretized Stieltjes procedure (Gautschi, *Orthogonal Polynomials*,
    /// 2004, section 2.2), because Gram–Schmidt on monomials would lose accuracy.
    pub fn new(blade: &Blade, functions: usize) -> Self {
        let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
        let powers = knot_powers(blade);
        let points = functions + powers.len() + 12;
        let rule = quadrature::piecewise(&blade.edges_m(), points);
        let mut basis = RadialBasis {
            inner_radius_m: a,
            width_m: b - a,
            held: match (blade.bore, blade.clamp_n_m_per_rad_per_m) {
                (Bore::Free, _) => 0,
                (Bore::Clamped(_), Some(_)) => 1,
                (Bore::Clamped(_), None) => 2,
            },
            diag: Vec::with_capacity(functions),
            off: Vec::with_capacity(functions),
            tilt: None,
            knots: None,
            mass_rule: mass_rule(blade, &rule),
            rule,
        };
        basis.stieltjes(functions);
        if basis.held == 0 {
            basis.tilt = Some(basis.tilt_turn());
        }
        if !powers.is_empty() {
            basis.knots = Some(basis.knot_functions(powers));
        }
        basis
    }

    /// Number of functions that steps, kinks and the mass of teeth of a blade add.
    pub fn functions_at_knots(blade: &Blade) -> usize {
        knot_powers(blade).len()
    }

    /// Number of radial functions, including those of the knots.
    pub fn count(&self) -> usize {
        self.diag.len() + self.knots.as_ref().map_or(0, |knots| knots.powers.len())
    }

    /// Highest polynomial degree of the functions between the knots.
    pub(crate) fn degree(&self) -> usize {
        let powers = self.knots.iter().flat_map(|knots| &knots.powers);
        let highest = powers.map(|own| own.power as usize).max().unwrap_or(0);
        self.held + highest.max(self.diag.len() - 1)
    }

    /// Whether rigid heave and tilt are part of the motion.
    pub(crate) fn has_rigid_motions(&self) -> bool {
        self.held == 0
    }

    /// Rule that integrates products of two radial functions with r dr, r⁻¹ dr and r⁻³ dr to rounding; the
    /// weights do not contain r.
    pub(crate) fn rule(&self) -> &Rule {
        &self.rule
    }

    fn stieltjes(&mut self, functions: usize) {
        let mass = &self.mass_rule;
        let weights: Vec<f64> = mass
            .iter()
            .map(|(r, w)| w * self.clamp(r)[0].powi(2))
            .collect();
        let x: Vec<f64> = mass.points.iter().map(|&r| self.mapped(r)).collect();
        let mut previous = vec![0.0; x.len()];
        let mut current = vec![1.0; x.len()];
        for _ in 0..functions {
            let norm = dot(&weights, &current, &current).sqrt();
            current.iter_mut().for_each(|p| *p /= norm);
            self.off.push(norm);
            let xp: Vec<f64> = x.iter().zip(&current).map(|(x, p)| x * p).collect();
            let diag = dot(&weights, &xp, &current);
            self.diag.push(diag);
            let next = (0..x.len())
                .map(|k| xp[k] - diag * current[k] - norm * previous[k])
                .collect();
            previous = std::mem::replace(&mut current, next);
        }
    }

    /// The rotation of the first two functions that makes the first one proportional to r.
    fn tilt_turn(&self) -> Turn {
        let mut coefficient = [0.0; 2];
        for (r, w) in self.mass_rule.iter() {
            let p = self.unturned(r).value;
            coefficient[0] += w * r * p[0];
            coefficient[1] += w * r * p[1];
        }
        let norm = coefficient[0].hypot(coefficient[1]);
        Turn {
            cos: coefficient[0] / norm,
            sin: coefficient[1] / norm,
        }
    }

    /// x ∈ [−1, 1] for r ∈ [a, b].
    fn mapped(&self, r: f64) -> f64 {
        2.0 * (r - self.inner_radius_m) / self.width_m - 1.0
    }

    /// The factor of a clamped bore and its two derivatives.
    fn clamp(&self, r: f64) -> [f64; 3] {
        let t = (r - self.inner_radius_m) / self.width_m;
        match self.held {
            0 => [1.0, 0.0, 0.0],
            1 => [t, self.width_m.recip(), 0.0],
            _ => [t * t, 2.0 * t / self.width_m, 2.0 / self.width_m.powi(2)],
        }
    }

    /// Gram–Schmidt orthogonalization, repeated because one pass loses digits.
    fn knot_functions(&self, powers: Vec<TruncatedPower>) -> KnotFunctions {
        let mass = &self.mass_rule;
        let raw: Vec<Vec<f64>> = mass
            .points
            .iter()
            .map(|&r| self.with_powers(&powers, r).value)
            .collect();
        let count = self.diag.len() + powers.len();
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(count);
        let mut done: Vec<Vec<f64>> = Vec::with_capacity(count);
        for j in 0..count {
            let mut row = vec![0.0; j + 1];
            row[j] = 1.0;
            let mut values: Vec<f64> = raw.iter().map(|point| point[j]).collect();
            for _ in 0..2 {
                for (known, known_row) in done.iter().zip(&rows) {
                    let share = dot(&mass.weights, known, &values);
                    let all = values
                        .iter_mut()
                        .zip(known)
                        .chain(row.iter_mut().zip(known_row));
                    all.for_each(|(value, known)| *value -= share * known);
                }
            }
            let norm = dot(&mass.weights, &values, &values).sqrt();
            values.iter_mut().for_each(|value| *value /= norm);
            row.iter_mut().for_each(|factor| *factor /= norm);
            rows.push(row);
            done.push(values);
        }
        KnotFunctions { powers, rows }
    }

    /// p₀, p₁, the truncated powers, p₂ … at a radius.
    fn with_powers(&self, powers: &[TruncatedPower], r: f64) -> RadialValues {
        let mut values = self.polynomials(r);
        let [c, dc, ddc] = self.clamp(r);
        let truncated: Vec<[f64; 3]> = powers
            .iter()
            .map(|&TruncatedPower { knot_m, power }| {
                let t = ((r - knot_m) / self.width_m).max(0.0);
                let p = f64::from(power);
                let e = [
                    t.powi(power),
                    p * t.powi(power - 1) / self.width_m,
                    p * (p - 1.0) * t.powi(power - 2) / self.width_m.powi(2),
                ];
                let beyond = if r > knot_m { 1.0 } else { 0.0 };
                [
                    c * e[0],
                    dc * e[0] + c * e[1],
                    ddc * e[0] + 2.0 * dc * e[1] + c * e[2] * beyond,
                ]
            })
            .collect();
        let RadialValues {
            value,
            slope,
            curvature,
        } = &mut values;
        for (k, part) in [value, slope, curvature].into_iter().enumerate() {
            part.splice(2..2, truncated.iter().map(|e| e[k]));
        }
        values
    }

    /// The functions of n ≠ 1 at a radius.
    fn unturned(&self, r: f64) -> RadialValues {
        let Some(knots) = &self.knots else {
            return self.polynomials(r);
        };
        let raw = self.with_powers(&knots.powers, r);
        let combined = |raw: &[f64]| {
            let rows = knots.rows.iter();
            let sum = |row: &Vec<f64>| row.iter().zip(raw).map(|(f, v)| f * v).sum();
            rows.map(sum).collect::<Vec<f64>>()
        };
        RadialValues {
            value: combined(&raw.value),
            slope: combined(&raw.slope),
            curvature: combined(&raw.curvature),
        }
    }

    /// The orthonormal polynomials at a radius, with the factor of a clamped bore.
    fn polynomials(&self, r: f64) -> RadialValues {
        let x = self.mapped(r);
        let dx = 2.0 / self.width_m;
        let [c, dc, ddc] = self.clamp(r);
        let mut values = RadialValues::default();
        let mut previous = [0.0; 3];
        let mut p = [1.0 / self.off[0], 0.0, 0.0];
        for j in 0..self.diag.len() {
            values.value.push(c * p[0]);
            values.slope.push(dc * p[0] + c * p[1] * dx);
            let curvature = ddc * p[0] + 2.0 * dc * p[1] * dx + c * p[2] * dx * dx;
            values.curvature.push(curvature);
            let Some(&next_off) = self.off.get(j + 1) else {
                break;
            };
            let (off, shifted) = (self.off[j], x - self.diag[j]);
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

    /// Converts a J × J block from the functions of n ≠ 1 to those of n (rows) and m (columns) nodal diameters.
    pub(crate) fn turned(&self, n: usize, m: usize, mut block: DMatrix<f64>) -> DMatrix<f64> {
        let Some(Turn { cos, sin }) = self.tilt else {
            return block;
        };
        let turn = Matrix2::new(cos, sin, -sin, cos);
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

/// The knots that get functions, with the powers of each.
fn knot_powers(blade: &Blade) -> Vec<TruncatedPower> {
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let apart = MIN_SPACING * (b - a);
    let steps = blade.knots_m().into_iter().map(|r| (r, &AT_STEP[..]));
    let teeth = blade.rim.map(|rim| (rim.radius_m, &AT_MASS[..]));
    let mut kept: Vec<(f64, &[i32])> = Vec::new();
    // Steps are added first, so that a step is kept and a circle of teeth close to it is omitted.
    for (radius, powers) in steps.chain(teeth) {
        let alone = kept
            .iter()
            .all(|(other, _)| (radius - other).abs() >= apart);
        if radius - a >= apart && b - radius >= apart && alone {
            kept.push((radius, powers));
        }
    }
    kept.sort_by(|x, y| x.0.total_cmp(&y.0));
    kept.into_iter()
        .flat_map(|(knot_m, powers)| {
            (powers.iter()).map(move |&power| TruncatedPower { knot_m, power })
        })
        .collect()
}

/// Rule for ∫ … dm/(2πρh₀) of a function of the radius, including the mass of teeth.
fn mass_rule(blade: &Blade, area: &Rule) -> Rule {
    let mut rule = Rule {
        points: area.points.clone(),
        weights: area
            .iter()
            .map(|(r, w)| w * r * blade.thickness_ratio(r))
            .collect(),
    };
    if let Some(rim) = blade.rim {
        rule.points.push(rim.radius_m);
        let per_area = std::f64::consts::TAU * blade.mass_per_area_kg_per_m2();
        rule.weights.push(rim.mass_kg / per_area);
    }
    rule
}

fn rotate(values: &mut [f64], Turn { cos, sin }: Turn) {
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
mod tests;
