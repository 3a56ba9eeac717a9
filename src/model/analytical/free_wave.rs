//! Waves of n nodal diameters of a blade without contacts.
//!
//! On the blade a wave has the frequency ω_b, with ω_b² = ω₀² + κΩ² for a shape that does not change with the
//! speed: ω₀ is its frequency at rest, κ its stiffening by rotation (Rayleigh quotients of bending and of
//! centrifugal tension; [`super::spinning_membrane`] gives κ for the shapes of a membrane). The true lowest
//! frequency, whose shape changes with the speed, is at least that of the lowest ω₀ with the lowest κ, and at
//! most that of any fixed shape.
//!
//! Sources: R. V. Southwell, Proc. R. Soc. Lond. A 101 (1922), 133–153; W. D. Iwan & K. J.
//! Stahl, J. Appl. Mech. 40 (1973), 445–451; Huang & Crandall, J. Appl. Mech. 41 (1974), for
//! the two dampings.

/// A wave of one shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeWave {
    /// Number n of nodal diameters.
    pub nodal_diameters: usize,
    /// Frequency ω₀ at rest.
    pub rest_frequency_rad_per_s: f64,
    /// Stiffening κ by rotation, dimensionless.
    pub spin_stiffening: f64,
}

impl FreeWave {
    /// Frequency ω_b = √(ω₀² + κΩ²) on the blade.
    pub fn body_frequency_rad_per_s(&self, speed_rad_per_s: f64) -> f64 {
        let stiffened = self.spin_stiffening * speed_rad_per_s.powi(2);
        (self.rest_frequency_rad_per_s.powi(2) + stiffened).sqrt()
    }

    /// The speed in rad/s at which the backward wave stands still in space: nΩ = ω_b, so Ω = ω₀/√(n² − κ).
    /// `None` if centrifugal stiffening prevents it, n² ≤ κ, as for n ≤ 1.
    pub fn critical_speed_rad_per_s(&self) -> Option<f64> {
        self.damped_onset_rad_per_s(LightDamping::default())
    }

    /// The speed in rad/s from which light damping makes the backward wave grow.
    ///
    /// In the body frame the backward wave has the frequency ω_b, in air that turns at sΩ the frequency ω_b −
    /// n(1 − s)Ω. The work of both dampings, η ω₀² ω_b + (c/ρh)(ω_b − n(1 − s)Ω), vanishes at Ω = q ω₀/√(n²(1
    /// − s)² − κq²) with q = 1 + η ω₀² ρh/c. Without material damping and in air at rest that is the critical
    /// speed. Material damping and rotation of the air both delay the onset beyond it; without air, or with s
    /// = 1, there is none. `None` if there is no onset, κq² ≥ n²(1 − s)².
    ///
    /// The result is exact to first order in the damping ratios. For air that turns relative to the disk: M.
    /// H. Hansen, A. Raman & C. D. Mote, *Estimation of nonconservative aerodynamic pressure leading to
    /// flutter of spinning disks*, J. Fluids Struct. 15 (2001), 39–57.
    pub fn damped_onset_rad_per_s(&self, damping: LightDamping) -> Option<f64> {
        let q = 1.0 + damping.material_to_air;
        let carried = self.nodal_diameters as f64 * (1.0 - damping.air_rotation_share);
        let rest = carried.powi(2) - self.spin_stiffening * q * q;
        (rest > 0.0).then(|| q * self.rest_frequency_rad_per_s / rest.sqrt())
    }
}

/// Frequencies in space of the forward and the backward wave, ω_b + nΩ and ω_b − nΩ, in rad/s. If the second
/// is negative the wave is reflected: above its critical speed it travels forward.
pub fn space_frequencies_rad_per_s(
    nodal_diameters: usize,
    body_frequency_rad_per_s: f64,
    speed_rad_per_s: f64,
) -> [f64; 2] {
    let carried = nodal_diameters as f64 * speed_rad_per_s;
    [
        body_frequency_rad_per_s + carried,
        body_frequency_rad_per_s - carried,
    ]
}

/// Light damping of a wave by air and by the material of the blade.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LightDamping {
    /// Ratio η ω₀² ρh/c of the two dampings of the wave at rest, with the retardation time η of the material, the
    /// resistance c of the air per area, and the mass ρh per area.
    pub material_to_air: f64,
    /// Ratio s of the rotation speed of the air to that of the blade; 0 for air at rest in space.
    pub air_rotation_share: f64,
}

/// Frequency on the blade with a uniform bed of springs under the whole blade, √(ω_b² + k″/ρh), with k″ in N/m per
/// m². The bed stiffens all shapes equally.
pub fn on_a_bed_rad_per_s(
    body_frequency_rad_per_s: f64,
    bed_stiffness_n_per_m3: f64,
    mass_per_area_kg_per_m2: f64,
) -> f64 {
    (body_frequency_rad_per_s.powi(2) + bed_stiffness_n_per_m3 / mass_per_area_kg_per_m2).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At the onset the work of the two dampings, which is evaluated separately, changes its sign.
    #[test]
    fn no_work_is_done_at_the_onset() {
        let (n, ratio, share) = (3, 0.1, 0.3);
        let wave = FreeWave {
            nodal_diameters: n,
            rest_frequency_rad_per_s: 200.0,
            spin_stiffening: 2.6,
        };
        let onset = |material_to_air, air_rotation_share| {
            wave.damped_onset_rad_per_s(LightDamping {
                material_to_air,
                air_rotation_share,
            })
        };
        let speed = onset(ratio, share).unwrap();
        let body = wave.body_frequency_rad_per_s(speed);
        // In the frame of the air the wave turns with the difference of the two speeds.
        let [_, backward] = space_frequencies_rad_per_s(n, body, (1.0 - share) * speed);
        assert!((ratio * body + backward).abs() < 1e-12 * body);
        let critical = wave.critical_speed_rad_per_s().unwrap();
        let at_critical = wave.body_frequency_rad_per_s(critical);
        assert!((at_critical - 3.0 * critical).abs() < 1e-12 * at_critical && critical < speed);
        let tilt = FreeWave {
            nodal_diameters: 1,
            spin_stiffening: 1.0,
            ..wave
        };
        assert_eq!(tilt.critical_speed_rad_per_s(), None);
        assert_eq!(onset(5.0, 0.0), None);
        assert_eq!(onset(0.0, 1.0), None);
    }
}
