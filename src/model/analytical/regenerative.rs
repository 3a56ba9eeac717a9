//! One mode under a regenerative cutting force: stability lobes.
//!
//! With full overlap the equation of motion is m(ẍ + 2ζω₀ẋ + ω₀²x) = −k (x(t) − x(t − τ)). With the compliance
//! G(iω) = 1/m(ω₀² − ω² + 2iζω₀ω), iω is an eigenvalue if 1 + k (1 − e^(−iωτ)) G = 0, which requires
//! k = −1/(2 Re G).
//!
//! Sources: S. A. Tobias, *Machine-Tool Vibration* (1965), chapter 7; Y. Altintas, *Manufacturing
//! Automation* (2000), section 4.3, with these signs: k_lim = −1/(2 Re G), τ = (2πj + 3π + 2ψ)/ω,
//! ψ = arg G between −π and 0.

use std::f64::consts::PI;

/// A mode of unit mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OneMode {
    /// Undamped angular frequency ω₀.
    pub frequency_rad_per_s: f64,
    /// Damping ratio ζ.
    pub damping_ratio: f64,
}

/// A point of a lobe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LobePoint {
    /// Cutting stiffness k per modal mass, in N/m per kg.
    pub stiffness: f64,
    /// Delay τ between two cuts.
    pub delay_s: f64,
}

impl OneMode {
    /// The point of the lobe j at which the mode vibrates with ω > ω₀; `None` for other ω, for which there is
    /// no stiffness.
    pub fn lobe(&self, chatter_rad_per_s: f64, lobe: u32) -> Option<LobePoint> {
        let (own, omega) = (self.frequency_rad_per_s, chatter_rad_per_s);
        let real = own * own - omega * omega;
        let imaginary = 2.0 * self.damping_ratio * own * omega;
        if real >= 0.0 {
            return None;
        }
        let phase = (-imaginary).atan2(real);
        let turned = 2.0 * PI * f64::from(lobe) + 3.0 * PI + 2.0 * phase;
        Some(LobePoint {
            // The stiffness is −1/(2 Re G), where the compliance G has Re G = real/(real² + imaginary²).
            stiffness: -(real * real + imaginary * imaginary) / (2.0 * real),
            delay_s: turned / omega,
        })
    }

    /// Smallest stiffness of all lobes, 2ω₀²ζ(1 + ζ) at ω = ω₀√(1 + 2ζ), in N/m per kg. Below it the mode is stable
    /// for every delay.
    pub fn least_stiffness(&self) -> f64 {
        let zeta = self.damping_ratio;
        2.0 * self.frequency_rad_per_s.powi(2) * zeta * (1.0 + zeta)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODE: OneMode = OneMode {
        frequency_rad_per_s: 300.0,
        damping_ratio: 0.02,
    };

    /// Both parts of 1 + k (1 − e^(−iωτ)) G = 0 are evaluated in real arithmetic.
    #[test]
    fn a_point_of_a_lobe_is_an_eigenvalue() {
        for (omega, lobe) in [(301.0, 0), (306.0, 1), (330.0, 2), (500.0, 5)] {
            let point = MODE.lobe(omega, lobe).unwrap();
            let (sin, cos) = (omega * point.delay_s).sin_cos();
            let real = 300.0_f64.powi(2) - omega * omega + point.stiffness * (1.0 - cos);
            let imaginary = 2.0 * 0.02 * 300.0 * omega + point.stiffness * sin;
            assert!(real.abs() < 1e-9 * omega * omega, "{omega}: {real}");
            assert!(
                imaginary.abs() < 1e-9 * omega * omega,
                "{omega}: {imaginary}"
            );
        }
        assert_eq!(MODE.lobe(299.0, 0), None);
    }

    #[test]
    fn the_least_stiffness_is_the_least_of_a_lobe() {
        let least = MODE.least_stiffness();
        let at = MODE.lobe(300.0 * 1.04_f64.sqrt(), 0).unwrap().stiffness;
        assert!((at / least - 1.0).abs() < 1e-12, "{at} {least}");
        let points = (1..4000).map(|k| 300.0 + 0.05 * f64::from(k));
        let mut stiffness = points.filter_map(|omega| MODE.lobe(omega, 0));
        assert!(stiffness.all(|point| point.stiffness >= least * (1.0 - 1e-12)));
    }
}
