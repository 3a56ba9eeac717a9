//! Kind of a mode, and sign of its energy.

use faer::{Col, c64};

use crate::model::system::GyroscopicSystem;

use super::companion::time_scale;
use super::vectors::{Eigenpair, halves, product, real_times, smallest};

/// Kind of an eigenvalue with Im λ ≥ 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModeKind {
    /// λ = iω of an undamped blade, Krein sign +1: forward and backward waves.
    Positive,
    /// λ = iω of an undamped blade, Krein sign −1: a reflected wave, whose energy in space is negative.
    Negative,
    /// λ = σ + iω, σ > 0, of an undamped blade.
    Flutter,
    /// λ = −σ + iω: the mirror image of a flutter mode, which is not counted separately.
    Decaying,
    /// λ = σ > 0 of an undamped blade; its decaying partner is not listed.
    Divergent,
    /// λ = 0 of a free rigid motion; never an instability.
    Rigid,
    /// Any λ ≠ 0 of a blade with damping or with forces without a potential.
    Damped,
}

impl ModeKind {
    /// Contribution of a mode of this kind to the Krein index, which is the number of negative eigenvalues of
    /// K(Ω): k_real + 2 k_flutter + 2 k_negative.
    pub fn krein_index(self) -> usize {
        match self {
            ModeKind::Divergent => 1,
            ModeKind::Flutter | ModeKind::Negative => 2,
            _ => 0,
        }
    }
}

/// Number of negative eigenvalues of K(Ω) by Krein's theory, from all modes at a speed.
pub fn krein_index(modes: &[Mode]) -> usize {
    modes.iter().map(|mode| mode.kind.krein_index()).sum()
}

/// A mode of one independent component of the blade.
#[derive(Debug, Clone)]
pub struct Mode {
    /// λ, in 1/s.
    pub lambda: c64,
    /// Kind of the mode.
    pub kind: ModeKind,
    /// dλ/dΩ, dimensionless; zero where it is unbounded or unknown.
    pub slope: c64,
    /// Sign of the action, +1 or −1: a reflected wave (ω, q) has −1 and is the same motion as (−ω, q̄) with +1.
    /// A mode without oscillation and a flutter mode have +1, the decaying partner of a flutter mode −1.
    pub action: i8,
    /// Index of the component.
    pub component: usize,
    /// q in the coordinates of the component, ‖q‖ = 1.
    pub coordinates: Col<c64>,
}

/// A growth rate of an undamped blade below this share of |λ| + Ω is rounding: at a coalescence of two modes
/// eigenvalues are accurate to √ε only.
pub(super) const GROWTH_NOISE: f64 = 1e-7;
/// Growth or decay of a damped mode below this share of |λ| is rounding of the eigenproblem, a small multiple
/// of ε times its largest eigenvalue. For tilts of a free blade with material damping, which do not bend it,
/// |Re λ| was up to 3e-13 |λ|.
pub(super) const DAMPED_NOISE: f64 = 1e-10;
/// With free rigid motions, eigenvalues below this share of the root mean square frequency are zero, because
/// a double zero is accurate only to √ε times that frequency.
pub(super) const RIGID_NOISE: f64 = 2e-7;

/// Smallest |Im λ/Re λ| of an oscillation: a motion that changes by e to the power of 2π/1e-2 = 628 within a
/// period does not oscillate. An example is a free tilt in air at rest, whose Im λ is zero except for the small
/// speed by which the two waves of equal n are separated.
const LEAST_OSCILLATION: f64 = 1e-2;

fn oscillates(lambda: c64) -> bool {
    lambda.im.abs() > LEAST_OSCILLATION * lambda.re.abs()
}

/// Whether a wave decays by less than e to the power of 2π within a period, so that a diagram shows it.
pub fn is_seen(lambda: c64) -> bool {
    lambda.im.abs() > -lambda.re
}

impl Mode {
    /// Whether the mode is that of an eigenproblem; an interpolated one has no coordinates.
    pub(super) fn is_solved(&self) -> bool {
        self.coordinates.nrows() > 0
    }

    /// ω = |Im λ|, in rad/s.
    pub fn frequency_rad_per_s(&self) -> f64 {
        self.lambda.im.abs()
    }

    /// Krein sign: +1, −1, or 0 if there is none.
    pub fn krein_sign(&self) -> i8 {
        match self.kind {
            ModeKind::Positive => 1,
            ModeKind::Negative => -1,
            _ => 0,
        }
    }

    /// ζ = −Re λ/|λ|; damped blades only.
    pub fn damping_ratio(&self) -> Option<f64> {
        let size = self.lambda.norm();
        let is_known = self.kind == ModeKind::Damped && size > 0.0;
        is_known.then(|| (0.0 - self.growth_per_s()) / size)
    }

    /// A mode with λ, dλ/dΩ and the sign of its action, of a kind that [`Mode::classified`] finds.
    pub(super) fn of(
        lambda: c64,
        slope: c64,
        action: i8,
        component: usize,
        coordinates: Col<c64>,
    ) -> Self {
        Mode {
            lambda,
            kind: ModeKind::Damped,
            slope,
            action,
            component,
            coordinates,
        }
    }

    /// A mode of a damped blade by its λ and dλ/dΩ alone.
    pub(crate) fn interpolated(lambda: c64, slope: c64, component: usize) -> Self {
        Mode::of(lambda, slope, 1, component, Col::zeros(0))
    }

    /// A mode with λ, slopes and action, those of a wave λ = iω, as the kind of mode that it is. The decaying partner of a divergent
    /// mode is none, because it belongs to the same ±ω pair.
    pub(super) fn classified(self, speed_rad_per_s: f64, is_undamped: bool) -> Option<Self> {
        use ModeKind::{Damped, Decaying, Divergent, Flutter, Negative, Positive};
        let noise = GROWTH_NOISE * (self.lambda.norm() + speed_rad_per_s.abs());
        let [grows, decays, oscillates] = [
            self.lambda.re > noise,
            self.lambda.re < -noise,
            self.lambda.im > noise,
        ];
        let kind = match (is_undamped, oscillates) {
            (false, _) => Damped,
            (true, true) if grows => Flutter,
            (true, true) if decays => Decaying,
            (true, true) if self.action < 0 => Negative,
            (true, true) => Positive,
            (true, false) if grows => Divergent,
            (true, false) => return None,
        };
        let is_wave = matches!(kind, Positive | Negative);
        Some(Mode {
            lambda: c64::new(if is_wave { 0.0 } else { self.lambda.re }, self.lambda.im),
            kind,
            slope: c64::new(if is_wave { 0.0 } else { self.slope.re }, self.slope.im),
            action: match kind {
                Negative | Decaying => -1,
                Damped if oscillates => self.action,
                _ => 1,
            },
            ..self
        })
    }

    /// Whether a mode of a damped blade decays without oscillating.
    pub fn is_overdamped(&self) -> bool {
        self.kind == ModeKind::Damped && self.lambda.re < 0.0 && !oscillates(self.lambda)
    }

    /// −2π Re λ/|Im λ|, the logarithm of the ratio of two amplitudes a period apart; damped blades only,
    /// `None` if the mode does not oscillate.
    pub fn logarithmic_decrement(&self) -> Option<f64> {
        let oscillates = self.kind == ModeKind::Damped && oscillates(self.lambda);
        let decay = 0.0 - self.growth_per_s();
        oscillates.then(|| std::f64::consts::TAU * decay / self.lambda.im.abs())
    }

    /// Re λ, in 1/s; zero for undamped modes that neither grow nor decay, and for damped ones whose growth or
    /// decay is rounding.
    pub fn growth_per_s(&self) -> f64 {
        let is_known = match self.kind {
            ModeKind::Flutter | ModeKind::Decaying | ModeKind::Divergent => true,
            ModeKind::Damped => self.lambda.re.abs() > DAMPED_NOISE * self.lambda.norm(),
            ModeKind::Positive | ModeKind::Negative | ModeKind::Rigid => false,
        };
        if is_known { self.lambda.re } else { 0.0 }
    }
}

/// |λ|, in 1/s, below which a mode of a blade with free rigid motions is one of them; 0 without such motions.
pub fn rigid_noise(system: &GyroscopicSystem) -> f64 {
    if system.free_rigid.is_empty() {
        return 0.0;
    }
    RIGID_NOISE * time_scale(&system.stiffness)
}

/// Classifies the eigenpairs of a component. The decaying partner of a divergent mode is dropped, because it
/// belongs to the same ±ω pair.
pub fn classify(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    component: usize,
    pairs: Vec<Eigenpair>,
) -> Vec<Mode> {
    let rigid_noise = rigid_noise(system);
    let forms = Forms::of(system, &pairs);
    let of = |(pair, forms): (&Eigenpair, &Forms)| {
        let slope = coalesced_slope(system, speed_rad_per_s, &pairs, pair)
            .unwrap_or_else(|| forms.slope(speed_rad_per_s, pair.0.im));
        if slope.is_finite() { slope } else { c64::ZERO }
    };
    let slopes: Vec<c64> = pairs.iter().zip(&forms).map(of).collect();
    let all = pairs.into_iter().zip(forms).zip(slopes);
    let modes = all.filter_map(|(((lambda, q), forms), slope)| {
        let action = forms.action(speed_rad_per_s, lambda.im);
        let sign = if action < 0.0 { -1 } else { 1 };
        let mode = Mode::of(lambda, slope, sign, component, q);
        if lambda.norm() < rigid_noise {
            return Some(Mode {
                lambda: c64::ZERO,
                kind: ModeKind::Rigid,
                action: 1,
                slope: c64::ZERO,
                ..mode
            });
        }
        mode.classified(speed_rad_per_s, system.is_conservative())
    });
    modes.collect()
}

/// dλ/dΩ of a pair of an undamped system that grows or decays beyond rounding.
///
/// The transpose of L(λ) is L(−λ), so the left vector of λ is the right vector of −λ, the
/// conjugate of that of the mirror image −λ̄: dλ/dΩ = −yᵀ(2λG + 2Ω(K_σ − N))x / yᵀ(2λ + 2ΩG)x.
fn coalesced_slope(
    system: &GyroscopicSystem,
    speed: f64,
    pairs: &[Eigenpair],
    (lambda, x): &Eigenpair,
) -> Option<c64> {
    let noise = GROWTH_NOISE * (lambda.norm() + speed.abs());
    if !system.is_conservative() || lambda.re.abs() <= noise {
        return None;
    }
    let (_, mirror) = smallest(pairs, |pair| (pair.0 + lambda.conj()).norm())?;
    let gyroscopic = mirror.adjoint() * real_times(&system.gyroscopic, x);
    let spin = mirror.adjoint() * real_times(&system.spin, x);
    let inertia = mirror.adjoint() * x;
    Some(-(lambda * gyroscopic + spin * speed) / (lambda * inertia + gyroscopic * speed))
}

/// Quadratic forms of q, qᴴq = 1.
#[derive(Clone, Copy)]
struct Forms {
    /// γ of qᴴGq = iγ.
    gamma: f64,
    /// qᴴ(K_σ − N)q.
    spin: f64,
}

impl Forms {
    /// Quadratic forms of the vectors of many pairs, by matrix products.
    fn of(system: &GyroscopicSystem, pairs: &[Eigenpair]) -> Vec<Self> {
        let halves = halves(system.order(), pairs.iter().map(|(_, q)| q));
        let (turned, spun) = (&system.gyroscopic * &halves, &system.spin * &halves);
        let form = |k: usize| Forms {
            gamma: product(&halves, k, &turned, k).im,
            spin: product(&halves, k, &spun, k).re,
        };
        (0..pairs.len()).map(form).collect()
    }

    /// Action of a mode λ = iω, ω > 0; for a damped one, the value without damping. With qᴴGq = iγ it has the sign of
    /// qᴴ(2ω − 2iΩG)q, or of ω + Ωγ.
    fn action(self, speed: f64, omega: f64) -> f64 {
        omega + speed * self.gamma
    }

    /// i dω/dΩ of a mode λ = iω; for a damped one, the value without damping. From L(ω, Ω) = −ω² + 2iωΩG + K follows
    /// dω/dΩ = (Ω qᴴ(K_σ−N)q − ωγ) / (ω + Ωγ).
    fn slope(self, speed: f64, omega: f64) -> c64 {
        let slope = (speed * self.spin - omega * self.gamma) / self.action(speed, omega);
        c64::new(0.0, slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 3.6e-12 1/s at 60 Hz is neither growth nor decay; 1e-5 1/s is.
    #[test]
    fn rounding_of_a_damped_mode_is_no_growth() {
        let mode = |re: f64| Mode {
            lambda: c64::new(re, 377.0),
            kind: ModeKind::Damped,
            slope: c64::ZERO,
            action: 1,
            component: 0,
            coordinates: Col::zeros(1),
        };
        for re in [3.6e-12, -3.6e-12] {
            let mode = mode(re);
            let measures = [mode.growth_per_s()]
                .into_iter()
                .chain(mode.damping_ratio())
                .chain(mode.logarithmic_decrement());
            assert!(measures.clone().count() == 3 && measures.clone().all(|v| v == 0.0));
            assert!(measures.clone().all(f64::is_sign_positive), "no -0");
        }
        assert_eq!(mode(1e-5).growth_per_s(), 1e-5);
        assert!(mode(-1e-5).damping_ratio().unwrap() > 0.0);
    }
}
