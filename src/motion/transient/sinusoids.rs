//! Decomposition of a record into damped and growing sinusoids, by the matrix pencil method.
//!
//! The method uses the record alone, so that its growth rate is an independent check of the eigenvalue. A
//! straight line through the logarithm of an envelope would be biased by every mode that rings beside the
//! growing one (Y. Hua, T. K. Sarkar, *Matrix pencil method for estimating parameters of exponentially
//! damped/undamped sinusoids in noise*, IEEE Trans. Acoustics, Speech and Signal Processing 38 (1990)
//! 814–824).

use faer::linalg::solvers::SolveLstsq;
use faer::{Col, Mat, c64};

use crate::model::linalg::{RightSingular, real_eigenvalues};

/// Re(2 a e^{λt}), or a e^{λt} for a real λ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sinusoid {
    /// λ, in 1/s, Im λ ≥ 0; frequencies above half the sampling rate are aliased.
    pub lambda: c64,
    /// Largest magnitude within the record, in the unit of the record.
    pub largest: f64,
    /// Whether it grows, decays or oscillates within the record; otherwise it is the static response to a
    /// load.
    pub moves: bool,
}

/// Reason for which a record could not be decomposed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{samples} samples of a deflection could not be decomposed into sinusoids")]
pub struct FitError {
    /// Number of samples used.
    pub samples: usize,
}

/// Share of the largest singular value below which others are rounding.
const RANK_TOLERANCE: f64 = 1e-10;
/// Largest number of samples used: the cost grows with its cube.
pub(crate) const SAMPLES: usize = 801;
/// Share of the largest sample below which a sinusoid is rounding.
const AUDIBLE: f64 = 1e-3;
/// Largest |λ| times the duration of the record for which a sinusoid is the static response.
const STATIC: f64 = 1e-2;

/// The sinusoids of an evenly sampled record, in descending order of magnitude; empty if the record is zero
/// or too short.
///
/// A long record is not thinned, which would alias its frequencies. Its first or its last samples are used,
/// whichever are larger: growth appears at the end, decay at the beginning.
///
/// # Errors
/// [`FitError`] if the record is not finite or the decomposition fails.
pub fn damped_sinusoids(record: &[f64], step_s: f64) -> Result<Vec<Sinusoid>, FitError> {
    let samples = louder_end(record);
    let failed = FitError {
        samples: samples.len(),
    };
    if !record.iter().all(|x| x.is_finite()) {
        return Err(failed);
    }
    let loudest = largest(samples);
    if samples.len() < 8 || loudest == 0.0 {
        return Ok(Vec::new());
    }
    let roots = pencil_roots(samples).ok_or(failed)?;
    let mut found: Vec<Sinusoid> = amplitudes(samples, &roots)
        .into_iter()
        .zip(&roots)
        .filter(|(_, z)| z.im >= 0.0)
        .map(|(amplitude, z)| {
            let sides = if z.im > 0.0 { 2.0 } else { 1.0 };
            let lambda = z.ln() / step_s;
            Sinusoid {
                lambda,
                largest: sides * amplitude.norm(),
                moves: lambda.norm() * step_s * samples.len() as f64 > STATIC,
            }
        })
        // The logarithm of a root at zero, which decays within one step, is not finite.
        .filter(|s| s.lambda.is_finite() && s.largest > AUDIBLE * loudest)
        .collect();
    found.sort_by(|x, y| y.largest.total_cmp(&x.largest));
    Ok(found)
}

/// The first or the last samples of a record, whichever have the larger magnitude.
fn louder_end(record: &[f64]) -> &[f64] {
    let count = record.len().min(SAMPLES);
    let (first, last) = (&record[..count], &record[record.len() - count..]);
    if largest(first) > largest(last) {
        first
    } else {
        last
    }
}

fn largest(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0_f64, |max, x| max.max(x.abs()))
}

/// The sinusoid that grows fastest. The static response counts only if nothing moves. `None` without
/// sinusoids.
pub fn fitted_growth(sinusoids: &[Sinusoid]) -> Option<Sinusoid> {
    let fastest = |x: &&Sinusoid, y: &&Sinusoid| x.lambda.re.total_cmp(&y.lambda.re);
    let moving = sinusoids.iter().filter(|s| s.moves).max_by(fastest);
    moving.or_else(|| sinusoids.iter().max_by(fastest)).copied()
}

/// z with samples Σ a zᵏ: eigenvalues of the pencil of two shifted Hankel matrices, projected on their
/// leading singular vectors.
fn pencil_roots(samples: &[f64]) -> Option<Vec<c64>> {
    let width = samples.len() / 2;
    let height = samples.len() - width - 1;
    let hankel = Mat::from_fn(height, width + 1, |i, k| samples[i + k]);
    let RightSingular { values, vectors } = RightSingular::new(hankel.as_ref()).ok()?;
    let rank = values
        .iter()
        .take_while(|value| **value > RANK_TOLERANCE * values[0])
        .count()
        .min(width);
    let right = vectors.subcols(0, rank);
    let (first, second) = (right.subrows(0, width), right.subrows(1, width));
    let step = first.qr().solve_lstsq(second);
    real_eigenvalues(step.as_ref()).ok()
}

/// Least squares for a in samples Σ a zᵏ. The amplitude of a decaying sinusoid is that at the beginning of the
/// record, the amplitude of a growing one that at its end, so that no power overflows and each is the largest.
fn amplitudes(samples: &[f64], roots: &[c64]) -> Vec<c64> {
    if roots.is_empty() || roots.len() > samples.len() {
        return Vec::new();
    }
    let last = samples.len() as i32 - 1;
    let matrix = Mat::from_fn(samples.len(), roots.len(), |k, i| {
        let z = roots[i];
        if z.norm() > 1.0 {
            z.powi(k as i32 - last)
        } else {
            z.powi(k as i32)
        }
    });
    let right = Col::from_fn(samples.len(), |k| c64::new(samples[k], 0.0));
    let solution = matrix.col_piv_qr().solve_lstsq(&right);
    solution.iter().copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(count: u32, step_s: f64, tone: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..count).map(|k| tone(step_s * f64::from(k))).collect()
    }

    fn fitted(record: &[f64], step_s: f64) -> c64 {
        let found = fitted_growth(&damped_sinusoids(record, step_s).unwrap());
        found.unwrap().lambda
    }

    /// The record contains a growing tone, a larger steady one, a static offset and a decaying tone.
    #[test]
    fn a_growing_tone_is_found_among_others() {
        let record = record(900, 1e-3, |t| {
            0.1 * (1.7 * t).exp() * (30.0 * t + 0.4).cos()
                + 2.0 * (55.0 * t).cos()
                + 0.7
                + 0.5 * (-4.0 * t).exp() * (90.0 * t).sin()
        });
        let found = fitted(&record, 1e-3);
        assert!((found - c64::new(1.7, 30.0)).norm() < 1e-6, "{found}");
    }

    /// A tone of 50 Hz in records of 10 and 60 s: every 25th or 50th sample would show an aliased frequency.
    #[test]
    fn a_tone_of_50_hz_keeps_its_frequency_in_a_long_record() {
        for (count, step_s) in [(10_000, 1e-3), (20_000, 3e-3), (60_000, 1e-3)] {
            for growth in [0.0, 0.3, -0.3] {
                let exact = c64::new(growth, std::f64::consts::TAU * 50.0);
                let tone = |t: f64| 1e-3 * (growth * t).exp() * (exact.im * t + 0.3).cos();
                for offset in [0.0, 1e-3] {
                    let record = record(count, step_s, |t| tone(t) + offset);
                    let found = fitted(&record, step_s);
                    let error = (found - exact).norm();
                    assert!(error < 1e-6, "{count} {step_s} {offset}: {found} {exact}");
                }
            }
        }
    }

    #[test]
    fn steady_tones_do_not_grow() {
        let record = record(1200, 1e-3, |t| {
            (1..30)
                .map(|m| (13.0 * f64::from(m * m) * t).cos() / f64::from(m))
                .sum()
        });
        let found = fitted(&record, 1e-3);
        assert!(found.re.abs() < 1e-4, "{found}");
    }

    #[test]
    fn silence_and_too_few_samples_are_nothing() {
        assert_eq!(damped_sinusoids(&[0.0; 100], 1e-3), Ok(Vec::new()));
        assert_eq!(damped_sinusoids(&[1.0; 3], 1e-3), Ok(Vec::new()));
    }

    /// A record that has overflowed is not taken for a zero record.
    #[test]
    fn what_is_not_a_number_is_refused() {
        for x in [f64::NAN, f64::INFINITY] {
            assert!(damped_sinusoids(&[x; 100], 1e-3).is_err());
        }
    }
}
