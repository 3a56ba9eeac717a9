//! What a record is made of: damped and growing sinusoids, by the matrix pencil method.
//!
//! It sees nothing but the record, so that its growth rate is a second opinion on the
//! eigenvalue's. A straight line through the logarithm of an envelope would be biased by
//! every mode that rings beside the growing one (Y. Hua, T. K. Sarkar, *Matrix pencil
//! method for estimating parameters of exponentially damped/undamped sinusoids in noise*,
//! IEEE Trans. Acoustics, Speech and Signal Processing 38 (1990) 814–824).

use faer::linalg::solvers::SolveLstsq;
use faer::{Col, Mat, c64};

/// Re(2 a e^{λt}), or a e^{λt} for a real λ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sinusoid {
    /// λ, in 1/s, Im λ ≥ 0; frequencies beyond half the sampling rate are folded.
    pub lambda: c64,
    /// Largest size within the record, in the unit of the record.
    pub largest: f64,
}

/// Singular values below this share of the largest are rounding.
const RANK_TOLERANCE: f64 = 1e-10;
/// Samples that the method looks at: its cost grows with their cube.
const SAMPLES: usize = 401;
/// Sinusoids smaller than this share of the record are what is left of rounding.
const AUDIBLE: f64 = 1e-3;

/// The sinusoids of an evenly sampled record, the largest first. Empty when the record
/// is silent, too short, or not finite.
pub fn damped_sinusoids(record: &[f64], step_s: f64) -> Vec<Sinusoid> {
    let stride = (record.len() / SAMPLES).max(1);
    let samples: Vec<f64> = record.iter().copied().step_by(stride).collect();
    let loudest = samples.iter().fold(0.0_f64, |max, x| max.max(x.abs()));
    if samples.len() < 8 || !(loudest > 0.0 && loudest.is_finite()) {
        return Vec::new();
    }
    let roots = pencil_roots(&samples).unwrap_or_default();
    let step_s = step_s * stride as f64;
    let mut found: Vec<Sinusoid> = amplitudes(&samples, &roots)
        .into_iter()
        .zip(&roots)
        .filter(|(_, z)| z.im >= 0.0)
        .map(|(amplitude, z)| {
            let sides = if z.im > 0.0 { 2.0 } else { 1.0 };
            let end = z.norm().powi(samples.len() as i32 - 1).max(1.0);
            Sinusoid {
                lambda: z.ln() / step_s,
                largest: sides * amplitude.norm() * end,
            }
        })
        .filter(|s| s.lambda.is_finite() && s.largest.is_finite() && s.largest > AUDIBLE * loudest)
        .collect();
    found.sort_by(|x, y| y.largest.total_cmp(&x.largest));
    found
}

/// The fastest growth among the sinusoids of a record, and its frequency in rad/s.
pub fn fitted_growth(sinusoids: &[Sinusoid]) -> Option<c64> {
    let lambda = sinusoids.iter().map(|s| s.lambda);
    lambda.max_by(|x, y| x.re.total_cmp(&y.re))
}

/// z with samples Σ a zᵏ: eigenvalues of the pencil of two shifted Hankel matrices, on
/// their leading singular vectors.
fn pencil_roots(samples: &[f64]) -> Option<Vec<c64>> {
    let width = samples.len() / 2;
    let height = samples.len() - width;
    let hankel = Mat::from_fn(height, width + 1, |i, k| {
        samples.get(i + k).copied().unwrap_or(0.0)
    });
    // The last row would reach past the record.
    let hankel = hankel.subrows(0, height - 1).to_owned();
    let svd = hankel.thin_svd().ok()?;
    let largest = svd.S()[0];
    let rank = (0..hankel.nrows().min(hankel.ncols()))
        .take_while(|&k| svd.S()[k] > RANK_TOLERANCE * largest)
        .count()
        .min(width);
    let right = svd.V().subcols(0, rank);
    let (first, second) = (right.subrows(0, width), right.subrows(1, width));
    let step = first.qr().solve_lstsq(second);
    step.eigenvalues().ok()
}

/// Least squares for a in samples Σ a zᵏ; growing z are counted from the end of the
/// record, so that no power overflows.
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
    (0..roots.len())
        .map(|i| {
            let z = roots[i];
            if z.norm() > 1.0 {
                solution[i] * z.powi(-last)
            } else {
                solution[i]
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A growing tone under a larger steady one, a static offset and a decaying one.
    #[test]
    fn a_growing_tone_is_found_among_others() {
        let tone = |t: f64| {
            0.1 * (1.7 * t).exp() * (30.0 * t + 0.4).cos()
                + 2.0 * (55.0 * t).cos()
                + 0.7
                + 0.5 * (-4.0 * t).exp() * (90.0 * t).sin()
        };
        let record: Vec<f64> = (0..900).map(|k| tone(1e-3 * f64::from(k))).collect();
        let found = fitted_growth(&damped_sinusoids(&record, 1e-3)).unwrap();
        assert!((found - c64::new(1.7, 30.0)).norm() < 1e-6, "{found}");
    }

    #[test]
    fn steady_tones_do_not_grow() {
        let record: Vec<f64> = (0..1200)
            .map(|k| {
                let t = 1e-3 * f64::from(k);
                (1..30)
                    .map(|m| (13.0 * f64::from(m * m) * t).cos() / f64::from(m))
                    .sum()
            })
            .collect();
        let found = fitted_growth(&damped_sinusoids(&record, 1e-3)).unwrap();
        assert!(found.re.abs() < 1e-4, "{found}");
    }

    #[test]
    fn silence_and_noise_of_rounding_are_nothing() {
        assert!(damped_sinusoids(&[0.0; 100], 1e-3).is_empty());
        assert!(damped_sinusoids(&[f64::NAN; 100], 1e-3).is_empty());
        assert!(damped_sinusoids(&[1.0; 3], 1e-3).is_empty());
    }
}
