//! Eigenvalues with the delayed force, starting from those without it.
//!
//! Newton's method is applied to det(1 + kX(λ)) Π(λ − λ_k), which is smooth at the eigenvalues λ_k of the saw
//! without the force, for all roots at once. Aberth's term prevents two iterations from converging to the
//! same root (O. Aberth, Math. Comp. 27 (1973), 339–344).

use faer::c64;

use super::delayed_saw::DelayedSaw;

/// An eigenvalue with the delayed force, Im λ ≥ 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    /// Eigenvalue λ.
    pub lambda: c64,
    /// Eigenvalue without the force from which the search started; `None` for one that exists only because of
    /// the delay.
    pub without: Option<c64>,
}

/// Largest number of iterations.
const MOST_STEPS: usize = 80;
/// Relative change below which the iteration has converged.
const CONVERGED: f64 = 1e-11;
/// Relative imaginary part below which a value is real.
const REAL: f64 = 1e-12;
/// Relative length of Newton's step for the determinant itself up to which a value is a root.
const NEAR: f64 = 1e-6;
/// Relative distance of the first iterate from the eigenvalue without the force, where the function is the product
/// of a pole and a zero.
const BESIDE: f64 = 1e-7;

/// The roots that start at the eigenvalues without the force, and roots that exist only because of the delay
/// until all growing ones are found, if their number is known.
pub fn roots_with_all_growing(
    saw: &DelayedSaw,
    stiffness: f64,
    growing: Option<usize>,
) -> Vec<Root> {
    let mut found = roots(saw, stiffness);
    let highest = saw.reach(stiffness);
    let places = 8 + (2.0 * highest * saw.delay.longest_s()) as usize;
    while growing.is_some_and(|count| count > right_of_axis(&found)) {
        let starts = (0..=places).map(|k| c64::new(1.0, highest * k as f64 / places as f64));
        match another(saw, stiffness, &found, starts) {
            Some(root) => found.push(root),
            None => break,
        }
    }
    found
}

/// Number of eigenvalues in the right half plane; a root with Im λ > 0 represents two of them.
pub fn right_of_axis(found: &[Root]) -> usize {
    let growing = found.iter().filter(|root| root.lambda.re > 0.0);
    growing
        .map(|root| if root.lambda.im > 0.0 { 2 } else { 1 })
        .sum()
}

/// The roots that start at the eigenvalues without the force, without those that did not converge.
fn roots(saw: &DelayedSaw, stiffness: f64) -> Vec<Root> {
    let all = &saw.transfer.poles;
    let own: Vec<usize> = (0..all.len()).filter(|&k| all[k].im >= 0.0).collect();
    let mut found: Vec<c64> = own
        .iter()
        .map(|&k| first_guess(saw, stiffness, k))
        .collect();
    let mut done = vec![false; found.len()];
    for _ in 0..MOST_STEPS {
        for j in 0..found.len() {
            if done[j] {
                continue;
            }
            let Some(step) = step(saw, stiffness, found[j], others(&found, j)) else {
                continue;
            };
            found[j] -= step;
            done[j] = step.norm() <= CONVERGED * found[j].norm();
        }
        if done.iter().all(|done| *done) {
            break;
        }
    }
    let accepted = own
        .iter()
        .zip(found)
        .zip(done)
        .filter(|((_, lambda), done)| *done && is_root(saw, stiffness, *lambda));
    let roots = accepted.map(|((k, lambda), _)| Root {
        lambda: upper(lambda),
        without: Some(all[*k]),
    });
    roots.collect()
}

/// A root in the right half plane other than the known ones, searched from several starting points.
fn another(
    saw: &DelayedSaw,
    stiffness: f64,
    known: &[Root],
    from: impl Iterator<Item = c64>,
) -> Option<Root> {
    let values: Vec<c64> = known.iter().map(|root| root.lambda).collect();
    for start in from {
        let mut lambda = start;
        for _ in 0..MOST_STEPS {
            let mut all = values.clone();
            all.push(lambda);
            let others = others(&all, values.len());
            let Some(step) = step(saw, stiffness, lambda, others) else {
                break;
            };
            lambda -= step;
            if step.norm() <= CONVERGED * lambda.norm() {
                if lambda.re > 0.0 && is_root(saw, stiffness, lambda) {
                    return Some(Root {
                        lambda: upper(lambda),
                        without: None,
                    });
                }
                break;
            }
        }
    }
    None
}

/// Whether the determinant vanishes: Newton's step for the determinant alone is negligible.
fn is_root(saw: &DelayedSaw, stiffness: f64, lambda: c64) -> bool {
    let slope = saw.logarithmic_slope(stiffness, lambda);
    // At an exact root the matrix is singular, so that there is no slope.
    lambda.is_finite() && slope.is_none_or(|slope| slope.norm() * NEAR * lambda.norm() >= 1.0)
}

/// The value or its conjugate, whichever has Im λ ≥ 0.
fn upper(lambda: c64) -> c64 {
    c64::new(lambda.re, lambda.im.abs())
}

/// First iterate for the root that starts at an eigenvalue without the force.
fn first_guess(saw: &DelayedSaw, stiffness: f64, pole: usize) -> c64 {
    let lambda = saw.transfer.poles[pole];
    let moved = -saw.delay.at(lambda) * saw.transfer.mobility(pole) * stiffness;
    let beside = c64::new(BESIDE * lambda.norm().max(1.0), 0.0);
    // First-order perturbation is valid only for a step shorter than the distance to the next mode, which is
    // taken as a tenth of |λ|.
    if moved.is_finite() && moved.norm() < 0.1 * lambda.norm() {
        lambda + moved + beside
    } else {
        lambda + beside
    }
}

/// The other roots and their conjugates, and the conjugate of this one.
fn others(found: &[c64], own: usize) -> impl Iterator<Item = c64> + '_ {
    let all = found.iter().enumerate();
    all.flat_map(move |(k, value)| {
        // A real value is its own conjugate.
        let is_complex = value.im.abs() > REAL * value.norm();
        let conjugate = is_complex.then(|| value.conj());
        [(k != own).then_some(*value), conjugate]
            .into_iter()
            .flatten()
    })
}

/// Newton's step with Aberth's term, of limited length; `None` if it is not finite.
fn step(
    saw: &DelayedSaw,
    stiffness: f64,
    lambda: c64,
    others: impl Iterator<Item = c64>,
) -> Option<c64> {
    let poles: c64 = saw
        .transfer
        .poles
        .iter()
        .map(|pole| (lambda - pole).inv())
        .sum();
    let others: c64 = others.map(|other| (lambda - other).inv()).sum();
    let slope = saw.logarithmic_slope(stiffness, lambda)? + poles - others;
    let step = slope.inv();
    // The limit keeps a step from leading far into the right half plane.
    let longest = 0.3 * lambda.norm();
    let size = step.norm();
    if !step.is_finite() {
        return None;
    }
    Some(if size > longest {
        step * (longest / size)
    } else {
        step
    })
}
