//! One degree of freedom in time, and the static contact law of Hertz's form.
//!
//! Source: any textbook, as W. T. Thomson, *Theory of Vibration with Applications*, chapters 2
//! and 4.

/// q of q̈ + ω²q = t from rest: (t − sin ωt/ω)/ω².
pub fn response_to_a_ramp(frequency_rad_per_s: f64, time_s: f64) -> f64 {
    let omega = frequency_rad_per_s;
    (time_s - (omega * time_s).sin() / omega) / omega.powi(2)
}

/// q of q̈ + 2δq̇ + ω²q = 0 from q = 1 at rest, with δ < ω:
/// e^(−δt)(cos νt + (δ/ν) sin νt), ν² = ω² − δ².
pub fn ring_down(frequency_rad_per_s: f64, decay_per_s: f64, time_s: f64) -> f64 {
    let (omega, delta, t) = (frequency_rad_per_s, decay_per_s, time_s);
    let nu = (omega * omega - delta * delta).sqrt();
    (-delta * t).exp() * ((nu * t).cos() + delta / nu * (nu * t).sin())
}

/// How far a force F presses in a contact F = K x^{3/2}, in m: (F/K)^{2/3}.
pub fn approach_m(force_n: f64, stiffness_n_per_m_3_2: f64) -> f64 {
    (force_n / stiffness_n_per_m_3_2).powf(2.0 / 3.0)
}
