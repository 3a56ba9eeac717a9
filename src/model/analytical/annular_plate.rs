//! Natural frequencies of the thin annular plate at rest.
//!
//! The deflection w = [A Jₙ(kr) + B Yₙ(kr) + C Iₙ(kr) + D Kₙ(kr)] cos nθ solves
//! D ∇⁴w = ρh ω² w with k⁴ = ρh ω²/D. Two conditions at each edge are four linear equations for
//! A, B, C, D; the frequencies are where their determinant vanishes.
//!
//! Sources: A. W. Leissa, *Vibration of Plates*, NASA SP-160 (1969), sections 1.1 and 2.2;
//! R. V. Southwell, Proc. R. Soc. Lond. A 101 (1922), 133–153, for the clamped bore.

use nalgebra::Matrix4;

use super::bessel::{Point, four};
use super::bisected;

/// Boundary condition at the bore; the rim is free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bore {
    /// No bending moment and no Kirchhoff shear force.
    Free,
    /// No deflection and no slope.
    Clamped,
}

/// Step in kb, small compared with the distance of two roots of one n, which is π/(1 − a/b) for the higher
/// ones and above 1 for all.
const STEP: f64 = 0.1;
/// Largest kb of the search.
const LARGEST: f64 = 1000.0;

/// A thin annular plate with a free rim.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnnularPlate {
    /// Boundary condition at the bore.
    pub bore: Bore,
    /// Ratio a/b of the inner to the outer radius.
    pub radius_ratio: f64,
    /// Poisson's ratio ν.
    pub poisson_ratio: f64,
}

impl AnnularPlate {
    /// The lowest `count` elastic roots λ² = ω b² √(ρh/D), ascending, of n nodal diameters; the s-th
    /// has s nodal circles, for a free bore and n ≤ 1 one more. Rigid heave and tilt of a free plate
    /// (λ = 0) are not listed.
    ///
    /// Valid for 0.001 ≤ a/b ≤ 0.995, n ≤ 64, −0.99 ≤ ν < 0.5 and kb = √λ² < 1000, where the roots are
    /// accurate to 1e-10 or better. Outside this range the list may be shorter than `count`.
    pub fn roots(&self, nodal_diameters: usize, count: usize) -> Vec<f64> {
        let at = |k: f64| self.determinant(nodal_diameters, k);
        // The search starts below every elastic root:
        // a narrow free ring has kb ≥ 1.6 for n = 2, and kb ≥ 0.9 n for larger n;
        // the mode n = 0 has kb = 1.04 for ν = −0.99. At much smaller kb rounding errors dominate the
        // determinant.
        let mut low = f64::max(0.5, 0.6 * nodal_diameters as f64);
        let mut before = at(low);
        let mut found = Vec::new();
        while found.len() < count && low < LARGEST {
            let high = low + STEP;
            let after = at(high);
            if before.is_nan() || after.is_nan() {
                break;
            }
            if before * after < 0.0 {
                found.push(bisected(low, high, |k| after.signum() * at(k)).powi(2));
            }
            (low, before) = (high, after);
        }
        found
    }

    /// Angular frequency ω = λ² √(D/ρh)/b².
    pub fn frequency_rad_per_s(
        lambda_squared: f64,
        rim_radius_m: f64,
        flexural_rigidity_n_m: f64,
        mass_per_area_kg_per_m2: f64,
    ) -> f64 {
        lambda_squared * (flexural_rigidity_n_m / mass_per_area_kg_per_m2).sqrt()
            / rim_radius_m.powi(2)
    }

    /// The determinant of the two conditions at the bore and the two at the rim, with rows and columns
    /// scaled; `rim_argument` is kb.
    pub fn determinant(&self, nodal_diameters: usize, rim_argument: f64) -> f64 {
        let inner_argument = self.radius_ratio * rim_argument;
        let at_bore = functions(nodal_diameters, inner_argument);
        let at_rim = functions(nodal_diameters, rim_argument);
        let free = |at: &[Term; 4], x: f64| free_edge(at, nodal_diameters, x, self.poisson_ratio);
        let [first, second] = match self.bore {
            Bore::Free => free(&at_bore, inner_argument),
            Bore::Clamped => [
                at_bore.map(|term| term.at.value),
                at_bore.map(|term| term.at.slope),
            ],
        };
        let [third, fourth] = free(&at_rim, rim_argument);
        let mut rows = [first, second, third, fourth];
        // The scaled I and K lack the factors e^x and e^−x. A common factor of a column only scales the
        // determinant, so that only the ratio of these factors at the two edges is applied.
        let decay = (inner_argument - rim_argument).exp();
        for row in &mut rows[..2] {
            row[2] *= decay;
        }
        for row in &mut rows[2..] {
            row[3] *= decay;
        }
        scaled_determinant(rows)
    }
}

/// One of J, Y, I, K at an edge, with the sign of its Laplacian: ∇²f = ∓f in units of 1/k².
#[derive(Clone, Copy)]
struct Term {
    at: Point,
    laplacian: f64,
}

fn functions(n: usize, x: f64) -> [Term; 4] {
    let four = four(n, x);
    let term = |at: Point, laplacian: f64| Term { at, laplacian };
    [
        term(four.j, -1.0),
        term(four.y, -1.0),
        term(four.scaled_i, 1.0),
        term(four.scaled_k, 1.0),
    ]
}

/// Moment M_r = ∇²w − (1 − ν)(w′/r − n²w/r²) and shear force V_r = (∇²w)′ − (1 − ν) n² (w′/r² − w/r³) of each
/// function, with r in units of 1/k.
fn free_edge(at: &[Term; 4], n: usize, x: f64, nu: f64) -> [[f64; 4]; 2] {
    let n2 = (n * n) as f64;
    let moment = |term: Term| {
        let Point { value, slope } = term.at;
        term.laplacian * value - (1.0 - nu) * (slope / x - n2 * value / (x * x))
    };
    let shear = |term: Term| {
        let Point { value, slope } = term.at;
        term.laplacian * slope - (1.0 - nu) * n2 * (slope / (x * x) - value / x.powi(3))
    };
    [at.map(moment), at.map(shear)]
}

/// Determinant after division of columns and rows by their largest entries, which does not change roots.
fn scaled_determinant(mut rows: [[f64; 4]; 4]) -> f64 {
    for column in 0..4 {
        let largest = rows
            .iter()
            .fold(0.0, |top: f64, row| top.max(row[column].abs()));
        rows.iter_mut().for_each(|row| row[column] /= largest);
    }
    for row in &mut rows {
        let largest = row.iter().fold(0.0, |top: f64, value| top.max(value.abs()));
        row.iter_mut().for_each(|value| *value /= largest);
    }
    Matrix4::from_fn(|row, column| rows[row][column])
        .lu()
        .determinant()
}
