//! Groups of neighbouring eigenvalues, interpolated between two speeds.
//!
//! An eigenvalue λ is a branch of an analytic function of the speed Ω, with branch points where eigenvalues
//! coalesce. The coefficients of the monic polynomial ∏(x − λ_k) of all eigenvalues that coalesce with one
//! another are analytic there too (T. Kato, *Perturbation theory for linear operators*, 1966, chapter II).
//! Cubic interpolation of these coefficients by values and slopes at two speeds therefore serves for waves
//! that cross, veer or coalesce, and for a pair that turns into two real eigenvalues. For two eigenvalues
//!
//! λ₁,₂ = T/2 ± √D,  T = λ₁ + λ₂,  D = ((λ₁ − λ₂)/2)².

use faer::{Mat, c64};

use crate::model::linalg::{complex_eigenvalues, real_eigenvalues};

use super::instability_kind::InstabilityKind;
use super::interpolation::{self, sign_changes};
use super::root::place_of_zero;

/// An eigenvalue with its slope: λ and dλ/dΩ.
pub type Sloped = (c64, c64);

/// A function of the speed by its values and slopes at both ends of a piece.
#[derive(Debug, Clone, Copy)]
struct Cubic {
    values: [c64; 2],
    /// Slopes multiplied by the width of the piece.
    rises: [c64; 2],
}

impl Cubic {
    /// Value at a share t of the piece, by Hermite's formula.
    fn at(&self, t: f64) -> c64 {
        let s = 1.0 - t;
        let ([from, to], [first, last]) = (self.values, self.rises);
        from * ((1.0 + 2.0 * t) * s * s) + to * (t * t * (1.0 + 2.0 * s)) + first * (t * s * s)
            - last * (t * t * s)
    }

    /// Derivative with respect to t.
    fn rise_at(&self, t: f64) -> c64 {
        let s = 1.0 - t;
        let ([from, to], [first, last]) = (self.values, self.rises);
        (to - from) * (6.0 * t * s) + first * (s * (1.0 - 3.0 * t)) + last * (t * (3.0 * t - 2.0))
    }

    /// The cubic of the real parts.
    fn real(&self) -> interpolation::Cubic {
        interpolation::Cubic {
            values: self.values.map(|z| z.re),
            slopes: self.rises.map(|z| z.re),
        }
    }
}

/// A few neighbouring eigenvalues over a piece, the interval between two speeds.
#[derive(Debug, Clone)]
pub struct Group {
    from_rad_per_s: f64,
    width_rad_per_s: f64,
    mean: Cubic,
    /// Coefficients of ∏(x − λ_k), with x and λ_k measured from the mean, of x^(size−2) and lower powers;
    /// that of x^(size−1) is zero.
    coefficients: Vec<Cubic>,
}

/// Coefficients of ∏(x − λ_k) below the leading one, and their slopes.
fn monic(eigenvalues: &[Sloped]) -> Vec<Sloped> {
    let zero = c64::new(0.0, 0.0);
    let mut product: Vec<Sloped> = vec![(c64::new(1.0, 0.0), zero)];
    for (z, slope) in eigenvalues {
        product.push((zero, zero));
        for k in (1..product.len()).rev() {
            let (before, before_slope) = product[k - 1];
            product[k].0 -= z * before;
            product[k].1 -= slope * before + z * before_slope;
        }
    }
    product.split_off(1)
}

/// Whether each number is real or has its conjugate beside it.
fn are_conjugates(eigenvalues: &[Sloped]) -> bool {
    let mut numbers = eigenvalues.iter().map(|(z, _)| z);
    numbers.all(|z| eigenvalues.iter().any(|(other, _)| *other == z.conj()))
}

fn mean(eigenvalues: &[Sloped]) -> Sloped {
    let share = 1.0 / eigenvalues.len() as f64;
    let sum = |part: fn(&Sloped) -> c64| eigenvalues.iter().map(part).sum::<c64>() * share;
    (sum(|e| e.0), sum(|e| e.1))
}

impl Group {
    /// A group from its eigenvalues at both ends, in any order.
    pub fn new([from, to]: [f64; 2], ends: [&[Sloped]; 2]) -> Self {
        let width_rad_per_s = to - from;
        let cubic = |[first, last]: [Sloped; 2]| Cubic {
            values: [first.0, last.0],
            rises: [first.1 * width_rad_per_s, last.1 * width_rad_per_s],
        };
        // Of real numbers and conjugates all coefficients are real, so that its numbers between the ends are real or
        // conjugates, too.
        let is_real = ends.iter().all(|end| are_conjugates(end));
        let exact = |(z, slope): Sloped| {
            if is_real {
                (c64::from(z.re), c64::from(slope.re))
            } else {
                (z, slope)
            }
        };
        let means = ends.map(|end| exact(mean(end)));
        let coefficients = [0, 1]
            .map(|end| {
                let (centre, drift) = means[end];
                let around = ends[end]
                    .iter()
                    .map(|(z, slope)| (z - centre, slope - drift));
                monic(&around.collect::<Vec<_>>())
            })
            .map(|all| all.into_iter().map(exact).collect::<Vec<_>>());
        let [first, last] = coefficients;
        let pairs = first.into_iter().zip(last).skip(1);
        Group {
            from_rad_per_s: from,
            width_rad_per_s,
            mean: cubic(means),
            coefficients: pairs.map(|(a, b)| cubic([a, b])).collect(),
        }
    }

    /// Number of eigenvalues.
    pub fn size(&self) -> usize {
        self.coefficients.len() + 1
    }

    fn share(&self, speed_rad_per_s: f64) -> f64 {
        (speed_rad_per_s - self.from_rad_per_s) / self.width_rad_per_s
    }

    /// The eigenvalues at a speed of the piece.
    pub fn at(&self, speed_rad_per_s: f64) -> Vec<c64> {
        let t = self.share(speed_rad_per_s);
        let mean = self.mean.at(t);
        match self.coefficients.as_slice() {
            [] => vec![mean],
            [last] => {
                let root = (-last.at(t)).sqrt();
                vec![mean - root, mean + root]
            }
            coefficients => {
                let below: Vec<c64> = coefficients.iter().map(|c| c.at(t)).collect();
                roots(&below).into_iter().map(|z| mean + z).collect()
            }
        }
    }

    /// Eigenvalues at a speed of the piece with their slopes, which are unbounded next to a coalescence: from
    /// p(λ, Ω) = 0, dλ/dΩ = −p_Ω/p_λ.
    pub fn sloped_at(&self, speed_rad_per_s: f64) -> Vec<Sloped> {
        let t = self.share(speed_rad_per_s);
        let (mean, drift) = (self.mean.at(t), self.mean.rise_at(t));
        let size = self.size() as i32;
        let slope = |z: &c64| {
            let x = z - mean;
            let (mut by_speed, mut by_root) =
                (c64::new(0.0, 0.0), x.powi(size - 1) * f64::from(size));
            for (k, coefficient) in self.coefficients.iter().enumerate() {
                let power = size - 2 - k as i32;
                by_speed += coefficient.rise_at(t) * x.powi(power);
                if power > 0 {
                    by_root += coefficient.at(t) * x.powi(power - 1) * f64::from(power);
                }
            }
            let moved = if size == 1 {
                c64::new(0.0, 0.0)
            } else {
                by_speed / by_root
            };
            (drift - moved) / self.width_rad_per_s
        };
        self.at(speed_rad_per_s)
            .iter()
            .map(|z| (*z, slope(z)))
            .collect()
    }

    /// ∏(λ_i − λ_k)² over all pairs, zero where two coalesce.
    pub fn discriminant(&self, speed_rad_per_s: f64) -> c64 {
        let z = self.at(speed_rad_per_s);
        let pairs = (0..z.len()).flat_map(|i| (0..i).map(move |k| (i, k)));
        pairs.map(|(i, k)| (z[i] - z[k]) * (z[i] - z[k])).product()
    }
}

/// Number of steps in which a group of more than two numbers is searched for speeds at which two of them coalesce.
const STEPS: usize = 32;
/// Share of the largest number of a group below which an imaginary part is rounding.
const REAL: f64 = 1e-9;

impl Group {
    /// Intervals of the piece, as shares from 0 to 1, over which at least one number λ² of the group grows in a given way, then those
    /// over which at least two do, and so on, each with the number of those before. The numbers must be real or conjugates, and none may
    /// pass zero.
    pub fn stretches(&self, kind: InstabilityKind) -> Vec<(usize, [f64; 2])> {
        let count = |t: f64| self.growing(kind, t);
        let mut bounds = match self.coefficients.as_slice() {
            [] => Vec::new(),
            [last] => sign_changes(&last.real()),
            _ => (1..=STEPS)
                .map(|k| [k - 1, k].map(|k| k as f64 / STEPS as f64))
                .filter(|ends| count(ends[0]) != count(ends[1]))
                .map(|ends| {
                    let first = count(ends[0]);
                    place_of_zero(ends, |t| if count(t) == first { 1.0 } else { -1.0 })
                })
                .collect(),
        };
        bounds.insert(0, 0.0);
        bounds.push(1.0);
        let counts: Vec<usize> = bounds
            .windows(2)
            .map(|pair| count(0.5 * (pair[0] + pair[1])))
            .collect();
        let mut stretches: Vec<(usize, [f64; 2])> = Vec::new();
        for rank in 0..counts.iter().copied().max().unwrap_or(0) {
            for (ends, count) in bounds.windows(2).zip(&counts) {
                let (from, to) = (ends[0], ends[1]);
                match stretches.last_mut() {
                    _ if *count <= rank => (),
                    Some((last, stretch)) if *last == rank && stretch[1] == from => stretch[1] = to,
                    _ => stretches.push((rank, [from, to])),
                }
            }
        }
        stretches
    }

    /// Number of λ² at a share of the piece that grow in a given way.
    fn growing(&self, kind: InstabilityKind, t: f64) -> usize {
        let values = self.at(self.from_rad_per_s + t * self.width_rad_per_s);
        let size = values.iter().map(|z| z.norm()).fold(0.0, f64::max);
        let real = |z: &c64| z.im.abs() <= REAL * size && self.size() > 2;
        let exact = values
            .iter()
            .map(|z| if real(z) { c64::from(z.re) } else { *z });
        exact
            .filter(|z| InstabilityKind::of_square(*z) == Some(kind))
            .count()
    }
}

/// Roots of xⁿ + c₂xⁿ⁻² + … + c_n, as eigenvalues of the companion matrix.
fn roots(coefficients: &[c64]) -> Vec<c64> {
    let size = coefficients.len() + 1;
    // Relative to this unit, no root has a magnitude above 2 (Fujiwara's bound).
    let unit = coefficients
        .iter()
        .enumerate()
        .map(|(k, c)| c.norm().powf(1.0 / (k as f64 + 2.0)))
        .fold(0.0, f64::max);
    if unit == 0.0 || !unit.is_finite() {
        return vec![c64::new(unit, 0.0); size];
    }
    let companion = Mat::from_fn(size, size, |i, k| match (i, k) {
        (0, 0) => c64::new(0.0, 0.0),
        (0, k) => -coefficients[k - 1] / unit.powi(k as i32 + 1),
        (i, k) => c64::new(f64::from(u8::from(i == k + 1)), 0.0),
    });
    let is_real = coefficients.iter().all(|c| c.im == 0.0);
    let values = if is_real {
        real_eigenvalues(Mat::from_fn(size, size, |i, k| companion[(i, k)].re).as_ref())
    } else {
        complex_eigenvalues(companion.as_ref())
    };
    match values {
        Ok(values) => values.into_iter().map(|z| z * unit).collect(),
        Err(_) => vec![c64::new(f64::NAN, 0.0); size],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the interpolation of eigenvalues given in closed form.
    fn assert_interpolated(eigenvalues: impl Fn(f64) -> Vec<Sloped>, [from, to]: [f64; 2]) {
        let group = Group::new([from, to], [&eigenvalues(from), &eigenvalues(to)]);
        for k in 1..20 {
            let speed = from + (to - from) * f64::from(k) / 20.0;
            let exact = eigenvalues(speed);
            assert_eq!(group.at(speed).len(), exact.len());
            for (z, slope) in group.sloped_at(speed) {
                let near = exact.iter().find(|e| (e.0 - z).norm() < 1e-7);
                let exact = near.unwrap_or_else(|| panic!("{speed}: {z}")).1;
                assert!(
                    (slope - exact).norm() < 1e-5 * (1.0 + exact.norm()),
                    "{speed}: {slope} {exact}"
                );
            }
        }
    }

    /// 2i + 0.1Ω ± √(Ω − 1): two frequencies that coalesce at Ω = 1.
    #[test]
    fn a_pair_is_followed_through_its_coalescence() {
        let pair = |speed: f64| {
            let root = c64::new(speed - 1.0, 0.0).sqrt();
            let mean = c64::new(0.1 * speed, 2.0);
            vec![
                (mean + root, 0.1 + 0.5 / root),
                (mean - root, 0.1 - 0.5 / root),
            ]
        };
        assert_interpolated(pair, [0.3, 1.9]);
    }

    /// ±√(Ω − 1): from the imaginary axis through zero to the real axis.
    #[test]
    fn a_pair_is_followed_through_zero() {
        let pair = |speed: f64| {
            let root = c64::new(speed - 1.0, 0.0).sqrt();
            vec![(root, 0.5 / root), (-root, -0.5 / root)]
        };
        assert_interpolated(pair, [0.45, 1.7]);
    }

    /// Three real numbers with different slopes: none gets an imaginary part by rounding.
    #[test]
    fn real_numbers_stay_real_next_to_their_crossing() {
        let crossing = |speed: f64| {
            let numbers = [-1.0, 0.3, 2.0].map(|slope| (c64::from(7.0 + slope * speed), slope));
            numbers.map(|(z, slope)| (z, c64::from(slope)))
        };
        let group = Group::new([-1.0, 1.1], [&crossing(-1.0), &crossing(1.1)]);
        for k in 0..50 {
            let numbers = group.at(0.1 + 0.02 * f64::from(k));
            assert!(numbers.iter().all(|z| z.im == 0.0), "{k}: {numbers:?}");
        }
    }

    /// i plus the three cube roots of Ω − 1.
    #[test]
    fn three_that_coalesce_at_once_are_followed() {
        let three = |speed: f64| {
            let root = c64::new(speed - 1.0, 0.0).powf(1.0 / 3.0);
            let turned = |k: i32| root * c64::cis(std::f64::consts::TAU * f64::from(k) / 3.0);
            let sloped = |x: c64| (x + c64::new(0.0, 1.0), 1.0 / (3.0 * x * x));
            (0..3).map(|k| sloped(turned(k))).collect()
        };
        assert_interpolated(three, [0.25, 1.77]);
    }

    /// Two waves with crossing frequencies: their mean and squared distance are enough.
    #[test]
    fn waves_that_cross_keep_their_slopes() {
        let waves = |speed: f64| {
            vec![
                (c64::new(-0.1, 3.0 + speed), c64::new(0.0, 1.0)),
                (c64::new(-0.2, 5.0 - speed), c64::new(0.0, -1.0)),
            ]
        };
        assert_interpolated(waves, [0.2, 1.73]);
    }
}
