//! Internal states of guide pads whose force has a transfer function with poles: films, controllers.
//!
//! A state y is one more unknown with mass 1, and acts on the mean deflection u over a pad by a spring and a damper:
//!
//! ÿ + dẏ + b²y = s u + c u̇,  force = (s/b)² u − s y − c ẏ = [(s/b)² − (s + cλ)²/(λ² + dλ + b²)] u.
//!
//! At rest the force is zero. Matrices and modes are those of a blade with a few more unknowns: M = 1, and K and C are symmetric.
//!
//! - A pair of poles p and p̄ has d = −2 Re p and b² = |p|², and from (s + cλ)² = c²(λ² + dλ + b²) − (a₁λ + a₀) with the
//!   numerator a₁λ + a₀ of its terms follows (d² − 4b²)c⁴ + (4a₀ − 2a₁d)c² + a₁² = 0, which has a root c² ≥ 0, because d² < 4b².
//! - A real pole p is a factor of (λ − p)(λ + q) with s = qc, whose other factor cancels: the force is then −c²(q + p)/(λ − p) beside
//!   a constant. The eigenvalue −q moves no blade; for a residue r < 0, as of a film, it is faster than all of the blade.

use faer::{Col, Scale, c64};

use super::contact::ContactTerms;
use crate::model::scene::{Blade, Guide, PoleTerm};

/// The unit of one unknown: mass 1.
#[derive(Debug, Clone, Copy)]
pub struct Oscillator {
    /// b², in 1/s².
    stiffness: f64,
    /// d, in 1/s.
    damping: f64,
    /// s, in √(N/m)/s.
    spring: f64,
    /// c, in √(N/m).
    damper: f64,
}

/// An internal state of a pad.
#[derive(Debug, Clone, Copy)]
pub struct PadState {
    /// Index of the guide in the list of the scene.
    pub(super) guide: usize,
    pub(super) oscillator: Oscillator,
}

/// Rate of the factor that cancels, over √(D/ρh)/b² of a blade: some 100 times the frequencies of a chart.
const FAST: f64 = 1e4;

impl PadState {
    /// The states of all pads, one for each real pole and each pair.
    pub fn of(guides: &[Guide], blade: &Blade) -> Vec<Self> {
        let specific = blade.flexural_rigidity_n_m() / blade.mass_per_area_kg_per_m2();
        let fast = FAST * specific.sqrt() / blade.outer_radius_m.powi(2);
        let of_guide = |guide: &Guide| -> Vec<PadState> {
            let terms = guide.law.iter().flat_map(|law| &law.terms);
            let state = |term: &PoleTerm| PadState {
                guide: guide.index,
                oscillator: Oscillator::of(*term, fast),
            };
            terms.map(state).collect()
        };
        guides.iter().flat_map(of_guide).collect()
    }
}

impl Oscillator {
    fn of(PoleTerm { pole, residue }: PoleTerm, fast: f64) -> Self {
        if pole.im != 0.0 {
            return Self::of_pair(pole, residue);
        }
        let (p, r) = (pole.re, residue.re);
        // The rate q makes −r/(q + p) positive.
        let other = if r < 0.0 {
            fast.max(-2.0 * p)
        } else {
            -0.5 * p
        };
        let damper = (-r / (other + p)).sqrt();
        Oscillator {
            stiffness: -p * other,
            damping: other - p,
            spring: other * damper,
            damper,
        }
    }

    fn of_pair(pole: c64, residue: c64) -> Self {
        let (damping, stiffness) = (-2.0 * pole.re, pole.norm_sqr());
        let (linear, constant) = (2.0 * residue.re, -2.0 * (residue * pole.conj()).re);
        let square = 4.0 * stiffness - damping * damping;
        let half = 2.0 * constant - linear * damping;
        let root = half.hypot(linear * square.sqrt());
        // Of two expressions of the same root the one without cancellation.
        let damper2 = if half > 0.0 {
            (half + root) / square
        } else {
            linear * linear / (root - half).max(f64::MIN_POSITIVE)
        };
        let damper = damper2.sqrt();
        let spring = if damper > 0.0 {
            0.5 * (damping * damper - linear / damper)
        } else {
            (-constant).max(0.0).sqrt()
        };
        Oscillator {
            stiffness,
            damping,
            spring,
            damper,
        }
    }

    /// Adds the terms of the state with the unknown `own` on a deflection uᵀq.
    pub fn add_to(&self, u: &Col<f64>, own: usize, terms: &mut ContactTerms) {
        let order = u.nrows();
        let unit = Col::from_fn(order, |i| if i == own { 1.0 } else { 0.0 });
        // b² (y − (s/b²) u)².
        let stretch = &unit - Scale(self.spring / self.stiffness) * u;
        let stiffness = Scale(self.stiffness) * &stretch * stretch.transpose();
        // d y² − 2c y u.
        let slide = Scale(0.5 * self.damping) * &unit - Scale(self.damper) * u;
        let half = &unit * slide.transpose();
        terms.add_state(own, stiffness, &(&half + half.transpose()));
    }

    /// Force over deflection at λ, in N/m.
    #[cfg(test)]
    fn force(&self, lambda: c64) -> c64 {
        let coupling = lambda * self.damper + self.spring;
        let own = lambda * lambda + lambda * self.damping + self.stiffness;
        self.spring * self.spring / self.stiffness - coupling * coupling / own
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The force of an oscillator is r/(λ − p), with the conjugate term of a complex pole, less its value at rest.
    #[test]
    fn the_force_is_that_of_the_term() {
        let terms = [
            ((-1e3, 0.0), (-3e8, 0.0)),
            ((-1e3, 0.0), (3e8, 0.0)),
            ((-20.0, 300.0), (1e6, 0.0)),
            ((-20.0, 300.0), (-1e6, 2e6)),
            ((-20.0, 300.0), (0.0, 2e6)),
            ((-20.0, 300.0), (0.0, -2e6)),
            ((5.0, 300.0), (4e5, -2e6)),
            ((-2e3, 1.0), (4e5, -2e6)),
            ((0.0, 300.0), (4e5, -2e6)),
        ];
        for ((p_re, p_im), (r_re, r_im)) in terms {
            let (pole, residue) = (c64::new(p_re, p_im), c64::new(r_re, r_im));
            let oscillator = Oscillator::of(PoleTerm { pole, residue }, 1e6);
            let term = |lambda: c64| {
                let one = residue / (lambda - pole);
                let conjugate = residue.conj() / (lambda - pole.conj());
                if p_im == 0.0 { one } else { one + conjugate }
            };
            for lambda in [
                (0.0, 0.0),
                (0.0, 50.0),
                (-3.0, 700.0),
                (40.0, 0.0),
                (1.0, 9e3),
            ] {
                let lambda = c64::new(lambda.0, lambda.1);
                let exact = term(lambda) - term(c64::new(0.0, 0.0));
                let found = oscillator.force(lambda);
                let size = (residue / pole).norm();
                assert!(
                    (found - exact).norm() < 1e-9 * size,
                    "{pole} {residue} {lambda}: {found} {exact}"
                );
            }
        }
    }
}
