//! Internal states of guide pads whose force has a transfer function with poles: films, controllers.
//!
//! A state y is one more unknown with mass 1, and acts on the deflection u of the blade in a rigid motion of the pad:
//!
//! ÿ + dẏ + b²y = s u + c u̇,  force = h u − s′y − c ẏ = [h − (s + cλ)(s′ + cλ)/(λ² + dλ + b²)] u,
//!
//! with h such that the force at rest is zero. M = 1 as for the blade, and C is symmetric. The stiffness K₀ of a saw has potential
//! energy, and at rest that of a pad is its spring alone; what a state adds to it is K_n, which need not be symmetric.
//!
//! - A pair of poles p and p̄ has d = −2 Re p and b² = |p|², and from (s + cλ)² = c²(λ² + dλ + b²) − (a₁λ + a₀) with s′ = s and the
//!   numerator a₁λ + a₀ of its terms follows (d² − 4b²)c⁴ + (4a₀ − 2a₁d)c² + a₁² = 0, which has a root c² ≥ 0, because d² < 4b².
//! - A real pole p is a factor of (λ − p)(λ + q) with s′ = qc, whose other factor cancels: the force is then h − c² + r/(λ − p) with
//!   the residue r = −c(s + cp). The eigenvalue −q moves no blade, and is faster than all of the blade.

use faer::{Col, Mat, Scale, c64};

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
    driven: f64,
    /// s′, in √(N/m)/s.
    driving: f64,
    /// c, in √(N/m).
    damper: f64,
    /// h, in N/m.
    direct: f64,
    /// Stiffness of y in K₀, in 1/s². It keeps y apart from the low motions of the blade without damping.
    apart: f64,
}

/// An internal state of a pad.
#[derive(Debug, Clone, Copy)]
pub struct PadState {
    /// Index of the guide in the list of the scene.
    pub(super) guide: usize,
    /// Rigid motion of the pad: its heave, 0, or a tilt, 1 or 2.
    pub(super) motion: usize,
    pub(super) oscillator: Oscillator,
}

/// Rate of the factor that cancels, over √(D/ρh)/b² of a blade: some 100 times the frequencies of a chart.
const FAST: f64 = 1e4;
/// Frequency of a state without the blade in K₀, as a share of this rate.
const APART: f64 = 0.1;

impl PadState {
    /// The states of all pads, one for each real pole and each pair.
    pub fn of(guides: &[Guide], blade: &Blade) -> Vec<Self> {
        let specific = blade.flexural_rigidity_n_m() / blade.mass_per_area_kg_per_m2();
        let fast = FAST * specific.sqrt() / blade.outer_radius_m.powi(2);
        let mut states = Vec::new();
        for guide in guides {
            for (motion, law) in guide.laws() {
                states.extend(law.terms.iter().map(|term| PadState {
                    guide: guide.index,
                    motion,
                    oscillator: Oscillator::of(*term, fast),
                }));
            }
        }
        states
    }
}

impl Oscillator {
    fn of(term: PoleTerm, fast: f64) -> Self {
        let apart = (APART * fast).powi(2);
        if term.pole.im == 0.0 {
            Self::of_real(term.pole.re, term.residue.re, fast, apart)
        } else {
            Self::of_pair(term.pole, term.residue, apart)
        }
    }

    fn of_real(p: f64, r: f64, fast: f64, apart: f64) -> Self {
        let other = fast.max(2.0 * p.abs());
        // With this c the coupling of a film is symmetric.
        let damper = (r.abs() / (other + p)).sqrt();
        Oscillator {
            stiffness: -p * other,
            damping: other - p,
            driven: -r / damper - damper * p,
            driving: other * damper,
            damper,
            direct: damper * damper + if p == 0.0 { 0.0 } else { r / p },
            apart,
        }
    }

    fn of_pair(pole: c64, residue: c64, apart: f64) -> Self {
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
            driven: spring,
            driving: spring,
            damper,
            direct: spring * spring / stiffness,
            apart,
        }
    }

    /// Adds the terms of the state with the unknown `own` on a deflection uᵀq.
    pub fn add_to(&self, u: &Col<f64>, own: usize, terms: &mut ContactTerms) {
        let order = u.nrows();
        let (mut stiffness, mut damping) = (Mat::zeros(order, order), Mat::zeros(order, order));
        stiffness.col_mut(own).copy_from(Scale(-self.driving) * u);
        stiffness
            .row_mut(own)
            .copy_from((Scale(-self.driven) * u).transpose());
        stiffness[(own, own)] = self.stiffness - self.apart;
        terms.add_nonconservative_stiffness(&(stiffness + Scale(self.direct) * u * u.transpose()));
        damping.col_mut(own).copy_from(Scale(-self.damper) * u);
        damping
            .row_mut(own)
            .copy_from((Scale(-self.damper) * u).transpose());
        damping[(own, own)] = self.damping;
        terms.add_damping(&damping);
        let mut alone = Mat::zeros(order, order);
        alone[(own, own)] = self.apart;
        terms.add_symmetric_stiffness(alone);
    }

    /// Force over deflection at λ, in N/m.
    #[cfg(test)]
    fn force(&self, lambda: c64) -> c64 {
        let [driven, driving] = [self.driven, self.driving].map(|s| lambda * self.damper + s);
        let own = lambda * lambda + lambda * self.damping + self.stiffness;
        self.direct - driven * driving / own
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The force of an integrator is r/λ, above and below zero.
    #[test]
    fn an_integrator_has_the_force_of_its_residue() {
        for residue in [5e5, -5e5] {
            let term = PoleTerm {
                pole: c64::ZERO,
                residue: c64::from(residue),
            };
            let oscillator = Oscillator::of(term, 1e6);
            for lambda in [(0.0, 50.0), (-3.0, 700.0), (0.01, 0.0)] {
                let lambda = c64::new(lambda.0, lambda.1);
                let found = oscillator.force(lambda) * lambda / residue;
                assert!((found - 1.0).norm() < 1e-9, "{residue} {lambda}: {found}");
            }
        }
    }

    /// The force of an oscillator is r/(λ − p), with the conjugate term of a complex pole, less its value at rest.
    #[test]
    fn the_force_is_that_of_the_term() {
        let terms = [
            ((-1e3, 0.0), (-3e8, 0.0)),
            ((-1e3, 0.0), (3e8, 0.0)),
            ((-1e-3, 0.0), (3e2, 0.0)),
            ((30.0, 0.0), (3e5, 0.0)),
            ((30.0, 0.0), (-3e5, 0.0)),
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
