//! Modes with the delayed force, and the pattern that each leaves on the board.

use std::f64::consts::TAU;

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, c64};

use super::basis::Motions;
use super::delayed_saw::DelayedSaw;
use super::report::WashboardMode;
use super::roots::{Root, roots_with_all_growing};
use crate::model::scene::{CutRun, Washboarding};
use crate::modes::{Mode, ModeName, classify, split};

/// Waves that a motion leaves on the board.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pattern {
    /// Multiple of the tooth passing frequency that is nearest to the frequency of the motion.
    pub multiple: u32,
    /// Difference between the frequency and this multiple, in rad/s.
    pub beside_rad_per_s: f64,
    /// Wavelength along the feed; `None` without a feed, or if all teeth leave the same surface.
    pub pitch_m: Option<f64>,
}

/// Number of modes listed, unless more of them grow.
const LISTED: usize = 8;
/// Relative distance to a multiple of tooth passing below which all teeth leave the same surface.
const SAME: f64 = 1e-9;

impl Pattern {
    /// The pattern of a motion of frequency ω, with the tooth passing frequency, both in rad/s.
    ///
    /// Each tooth passes a place of the kerf a tooth period after the preceding one and one feed per tooth
    /// farther on. From tooth to tooth the phase of the motion advances by ωτ, of which only the
    /// difference to the nearest multiple of 2π is visible: along the feed v the surface has the wavelength
    /// 2πv/|ω − m·2π/τ|.
    pub fn new(omega: f64, tooth_passing: f64, feed_m_per_s: Option<f64>) -> Self {
        let multiple = (omega / tooth_passing).round();
        let beside = omega - multiple * tooth_passing;
        let differs = beside.abs() > SAME * tooth_passing;
        Pattern {
            multiple: multiple as u32,
            beside_rad_per_s: beside,
            pitch_m: feed_m_per_s
                .filter(|_| differs)
                .map(|feed| TAU * feed / beside.abs()),
        }
    }
}

/// All growing modes, and those of largest growth among the complete ones.
pub fn described(
    motions: &Motions,
    saw: &DelayedSaw,
    washboarding: &Washboarding,
    run: &CutRun,
    growing: Option<usize>,
) -> Vec<WashboardMode> {
    let stiffness = washboarding.typed.stiffness_n_per_m;
    let mut found = roots_with_all_growing(saw, stiffness, growing);
    found.sort_by(|x, y| y.lambda.re.total_cmp(&x.lambda.re));
    found.retain(|root| root.lambda.re > 0.0 || root.lambda.im <= motions.complete_to_rad_per_s);
    let growing = found.partition_point(|root| root.lambda.re > 0.0);
    found.truncate(LISTED.max(growing));
    found
        .into_iter()
        .map(|root| mode(motions, washboarding, run, root))
        .collect()
}

/// The name and the pattern of a root.
fn mode(motions: &Motions, washboarding: &Washboarding, run: &CutRun, root: Root) -> WashboardMode {
    let speed = run.speed_rad_per_s;
    let q = shape(motions, washboarding, speed, root.lambda);
    let (reduced_re, reduced_im) = split(&q);
    // A real root may be no mode of the saw without the delayed force.
    let classified = classify(&motions.system, speed, 0, vec![(root.lambda, q)]).pop();
    let mode = classified.unwrap_or_else(|| Mode::interpolated(root.lambda, c64::ZERO, 0));
    let (re, im) = (&motions.shapes * reduced_re, &motions.shapes * reduced_im);
    let lifted = Col::from_fn(re.nrows(), |i| c64::new(re[i], im[i]));
    let passing = washboarding.tooth_passing_rad_per_s(speed);
    let pattern = washboarding
        .is_even()
        .then(|| Pattern::new(root.lambda.im, passing, run.feed_m_per_s));
    let name = ModeName::new(&motions.plate, &mode, &lifted, speed);
    WashboardMode {
        name: name.in_shares(),
        direction: name.direction,
        frequency_hz: root.lambda.im / TAU,
        growth_per_s: root.lambda.re,
        growth_without_per_s: root.without.map(|lambda| lambda.re),
        frequency_without_hz: root.without.map(|lambda| lambda.im / TAU),
        tooth_passing_multiple: pattern.map(|pattern| pattern.multiple),
        beside_tooth_passing_hz: pattern.map(|pattern| pattern.beside_rad_per_s / TAU),
        pattern_pitch_m: pattern.and_then(|pattern| pattern.pitch_m),
    }
}

/// Solution x, ‖x‖ = 1, of (L(λ) + k h(λ) B(1 + k h(λ) F)⁻¹Bᵀ) x = 0 by inverse iteration.
fn shape(motions: &Motions, washboarding: &Washboarding, speed: f64, lambda: c64) -> Col<c64> {
    const BESIDE: f64 = 1e-9;
    const STEPS: usize = 3;
    let system = &motions.system;
    let order = system.order();
    let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
    let delay = super::delay::Delay::new(washboarding, speed);
    let lambda = lambda * (1.0 + BESIDE);
    let cutting = delay.at(lambda) * washboarding.typed.stiffness_n_per_m;
    let size = motions.columns.ncols();
    let yielding = Mat::from_fn(size, size, |i, k| {
        let unit = if i == k { 1.0 } else { 0.0 };
        unit + cutting * motions.flexibility[(i, k)]
    });
    let columns = Mat::from_fn(order, size, |i, k| c64::new(motions.columns[(i, k)], 0.0));
    let arc = &columns * yielding.partial_piv_lu().solve(columns.transpose());
    let dynamic = Mat::from_fn(order, order, |i, k| {
        let own = lambda * velocity[(i, k)] + stiffness[(i, k)] + cutting * arc[(i, k)];
        if i == k { own + lambda * lambda } else { own }
    });
    let factors = dynamic.partial_piv_lu();
    let mut x = Mat::from_fn(order, 1, |i, _| c64::new((1.3 * i as f64 + 0.7).sin(), 0.0));
    for _ in 0..STEPS {
        x = factors.solve(&x);
        let norm = c64::new(x.norm_l2().recip(), 0.0);
        x = faer::Scale(norm) * x;
    }
    x.col(0).to_owned()
}
