//! A blade on S equal, evenly spaced point springs at one radius, fixed in space; S = 1 is a single spring.
//!
//! With waves of the signed wave number p (n and −n for n nodal diameters) and the frequency ω_p on the
//! blade, the compliance for a motion e^{λt} at the springs is Σ g_p²/(ω_p² + (λ − ipΩ)²) with g_p = f/√2, or
//! f for n = 0, where f is the amplitude, at the springs' radius, of the mode f cos nθ of unit modal mass. S
//! springs couple only wave numbers that differ by a multiple of S. Each class p ≡ c (mod S) has its own
//! equation:
//!
//! 1 + S k Σ_{p ≡ c} g_p²/(ω_p² + (λ − ipΩ)²) = 0.
//!
//! Sources: W. D. Iwan & T. L. Moeller, *The stability of a spinning elastic disk with a transverse
//! load system*, J. Appl. Mech. 43 (1976), 485–490; G. H. Golub, *Some modified matrix eigenvalue
//! problems*, SIAM Review 15 (1973), 318–334, section 5, for the roots between poles.

use super::bisected;

/// A free mode of the turning blade, in the body frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyWave {
    /// Number n of nodal diameters.
    pub nodal_diameters: usize,
    /// Frequency ω on the blade at the speed of the analysis.
    pub frequency_rad_per_s: f64,
    /// Amplitude f of the mode f cos nθ of unit modal mass at the springs' radius, in 1/√kg.
    pub amplitude_per_sqrt_kg: f64,
}

impl BodyWave {
    /// Square g², in 1/kg, of the amplitude of one of the two waves of which the mode consists.
    pub(super) fn share_per_kg(&self) -> f64 {
        let halves = if self.nodal_diameters == 0 { 1.0 } else { 2.0 };
        self.amplitude_per_sqrt_kg.powi(2) / halves
    }
}

/// S equal springs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EvenSprings {
    /// Number S of springs.
    pub count: usize,
    /// Stiffness k of each spring.
    pub stiffness_n_per_m: f64,
}

impl EvenSprings {
    /// Stiffness S k of all springs together.
    pub(super) fn sum_n_per_m(&self) -> f64 {
        self.count as f64 * self.stiffness_n_per_m
    }

    /// Whether the springs couple waves of these signed wave numbers.
    pub fn couple(&self, first: i64, second: i64) -> bool {
        self.count > 0 && (first - second) % self.count as i64 == 0
    }

    /// The left side of the equation of the class c at λ = [Re, Im] in 1/s, as [Re, Im].
    pub fn characteristic(
        &self,
        class: i64,
        waves: &[BodyWave],
        speed_rad_per_s: f64,
        lambda_per_s: [f64; 2],
    ) -> [f64; 2] {
        let mut sum = [1.0, 0.0];
        for wave in waves {
            let n = wave.nodal_diameters as i64;
            let directions: &[i64] = if n == 0 { &[0] } else { &[n, -n] };
            for &number in directions.iter().filter(|p| self.couple(**p, class)) {
                let [growth, frequency] = lambda_per_s;
                let carried = frequency - number as f64 * speed_rad_per_s;
                let square = wave.frequency_rad_per_s.powi(2);
                let denominator = [
                    square + growth * growth - carried * carried,
                    2.0 * growth * carried,
                ];
                let strength = self.sum_n_per_m() * wave.share_per_kg();
                let term = quotient([strength, 0.0], denominator);
                sum = [sum[0] + term[0], sum[1] + term[1]];
            }
        }
        sum
    }

    /// The eigenvalue [Re, Im] of the class c, in 1/s, to which the secant method converges from a starting
    /// value; `None` if it does not converge.
    pub fn eigenvalue_near(
        &self,
        class: i64,
        waves: &[BodyWave],
        speed_rad_per_s: f64,
        start_per_s: [f64; 2],
    ) -> Option<[f64; 2]> {
        let at = |z: [f64; 2]| self.characteristic(class, waves, speed_rad_per_s, z);
        let size = |z: [f64; 2]| z[0].hypot(z[1]);
        let unit = size(start_per_s).max(speed_rad_per_s);
        let mut before = [start_per_s[0] + 1e-7 * unit, start_per_s[1] + 1e-7 * unit];
        let mut here = start_per_s;
        let mut value_before = at(before);
        for _ in 0..60 {
            let value = at(here);
            let run = [here[0] - before[0], here[1] - before[1]];
            let rise = [value[0] - value_before[0], value[1] - value_before[1]];
            if size(rise) == 0.0 {
                break;
            }
            let step = quotient(product(value, run), rise);
            (before, value_before) = (here, value);
            here = [here[0] - step[0], here[1] - step[1]];
            if size(step) <= 1e-14 * unit {
                return Some(here);
            }
        }
        None
    }
}

fn product([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a * c - b * d, a * d + b * c]
}

fn quotient(numerator: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    let square = c * c + d * d;
    product(numerator, [c / square, -d / square])
}

/// A standing wave x of the unsupported blade, normalized by xᵀK_b x = 1 J.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandingWave {
    /// Value μ = xᵀ(N − K_σ)x, which is 1/Ω² of the critical speed; not positive if the wave has none.
    pub inverse_critical_speed_squared_s2: f64,
    /// Deflection f at the spring.
    pub deflection_m: f64,
}

/// Critical speeds in rad/s of a clamped blade on one point spring: the roots of 1/k + Σ f²/(1 − Ω²μ) = 0,
/// ascending. One root lies between any two neighbouring critical speeds of the waves that the spring affects (μ >
/// 0, f ≠ 0), and one above the last, unless the blade is free. For k = ∞ the blade is pinned.
///
/// Waves that have a node at the spring keep their critical speeds; they are not in the list.
pub fn critical_speeds_rad_per_s(stiffness_n_per_m: f64, waves: &[StandingWave]) -> Vec<f64> {
    let mut poles: Vec<f64> = waves
        .iter()
        .filter(|w| w.inverse_critical_speed_squared_s2 > 0.0 && w.deflection_m != 0.0)
        .map(|w| w.inverse_critical_speed_squared_s2.recip())
        .collect();
    poles.sort_by(f64::total_cmp);
    let balance = |square: f64| {
        let terms = waves.iter().map(|wave| {
            wave.deflection_m.powi(2) / (1.0 - square * wave.inverse_critical_speed_squared_s2)
        });
        stiffness_n_per_m.recip() + terms.sum::<f64>()
    };
    let between = poles.windows(2).filter(|pair| pair[0] < pair[1]);
    let mut roots: Vec<f64> = between
        .map(|pair| bisected(pair[0], pair[1], balance).sqrt())
        .collect();
    if let Some(&last) = poles.last() {
        let beyond = (1..200).map(|k| last * 2.0_f64.powi(k));
        let positive = beyond.take_while(|square| square.is_finite());
        if let Some(high) = { positive }.find(|square| balance(*square) > 0.0) {
            roots.push(bisected(last, high, balance).sqrt());
        }
    }
    roots
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One mode without nodal diameters on one spring: ω² = ω₀² + k f².
    #[test]
    fn one_mode_on_one_spring() {
        let spring = EvenSprings {
            count: 1,
            stiffness_n_per_m: 300.0,
        };
        let wave = BodyWave {
            nodal_diameters: 0,
            frequency_rad_per_s: 40.0,
            amplitude_per_sqrt_kg: 1.5,
        };
        let expected = f64::sqrt(1600.0 + 300.0 * 2.25);
        let found = spring
            .eigenvalue_near(0, &[wave], 100.0, [0.0, 47.0])
            .unwrap();
        assert!((found[1] - expected).abs() < 1e-10 && found[0].abs() < 1e-10);
    }

    /// Expected values for two waves follow from (1 − sμ₁)(1 − sμ₂)/k + f₁²(1 − sμ₂) + f₂²(1 − sμ₁) = 0.
    #[test]
    fn two_standing_waves_on_a_spring() {
        let wave = |mu: f64, f: f64| StandingWave {
            inverse_critical_speed_squared_s2: mu,
            deflection_m: f,
        };
        let waves = [wave(1.0 / 100.0, 0.1), wave(1.0 / 400.0, 0.3)];
        let stiffness = 7.0;
        let roots = critical_speeds_rad_per_s(stiffness, &waves);
        assert_eq!(roots.len(), 2);
        assert!(10.0 < roots[0] && roots[0] < 20.0 && 20.0 < roots[1]);
        for root in roots {
            let s = root * root;
            let (first, second) = (1.0 - s / 100.0, 1.0 - s / 400.0);
            let balance = first * second / stiffness + 0.01 * second + 0.09 * first;
            assert!(balance.abs() < 1e-12, "{balance}");
        }
    }
}
