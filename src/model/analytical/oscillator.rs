//! Motion with one degree of freedom, and the static contact law of Hertz's form.
//!
//! Source: any textbook, such as W. T. Thomson, *Theory of Vibration with Applications*, chapters 2 and 4.

/// Displacement q of q̈ + ω²q = t from rest: (t − sin ωt/ω)/ω².
pub fn response_to_a_ramp(frequency_rad_per_s: f64, time_s: f64) -> f64 {
    let omega = frequency_rad_per_s;
    (time_s - (omega * time_s).sin() / omega) / omega.powi(2)
}

/// Displacement q of q̈ + 2δq̇ + ω²q = 0 from q = 1 at rest, with δ < ω: e^(−δt)(cos νt + (δ/ν) sin νt),
/// ν² = ω² − δ².
pub fn ring_down(frequency_rad_per_s: f64, decay_per_s: f64, time_s: f64) -> f64 {
    let (omega, delta, t) = (frequency_rad_per_s, decay_per_s, time_s);
    let nu = (omega * omega - delta * delta).sqrt();
    (-delta * t).exp() * ((nu * t).cos() + delta / nu * (nu * t).sin())
}

/// Period of q̈ + kq + gq³ = 0 with the amplitude A: 2π/agm(√(k + gA²), √(k + gA²/2)), in s.
///
/// It is 4 K(m)/√(k + gA²) with m = gA²/2(k + gA²) (A. H. Nayfeh & D. T. Mook, *Nonlinear Oscillations*,
/// 1979, section 2.1), where K follows from the arithmetic–geometric mean.
pub fn hardening_period_s(stiffness_per_s2: f64, cubic: f64, amplitude: f64) -> f64 {
    let added = cubic * amplitude.powi(2);
    let mut mean = [
        (stiffness_per_s2 + added).sqrt(),
        (stiffness_per_s2 + 0.5 * added).sqrt(),
    ];
    // Each iteration reduces the relative difference δ of the two means to about δ²/8.
    for _ in 0..6 {
        mean = [0.5 * (mean[0] + mean[1]), (mean[0] * mean[1]).sqrt()];
    }
    std::f64::consts::TAU / mean[0]
}

/// Approach of a contact F = K x^{3/2} under a force F, in m: (F/K)^{2/3}.
pub fn approach_m(force_n: f64, stiffness_n_per_m_3_2: f64) -> f64 {
    (force_n / stiffness_n_per_m_3_2).powf(2.0 / 3.0)
}
