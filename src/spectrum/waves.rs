//! A reduced model by waves: near waves of the blade, with all others eliminated.
//!
//! The equation of motion in space is L(λ)q = (λ² + λ(2ΩG + C) + K + Ω²S + ΩN) q = 0. Near waves x of the free blade,
//! those with ω − nΩ below a cut or reflected, and the displacements of strong dampers are kept (`near`). With all
//! others eliminated, L = [A B; C F],
//!
//! (A − B F⁻¹ C)(λ) = K̃ + λC̃ + λ²M̃ + λ³s₃ + λ⁴s₄ + …
//!
//! (`series`, `frame`, `whole`), at the nodes of a Chebyshev series in the speed (`over_speed`). No eigenproblem of
//! the full matrices is needed. The eigenvalues are those of all terms together (`pair`, `roots`), or one of them
//! (`newton`); λ is in units of the window, the frequency up to which the eigenvalues are wanted.

use std::f64::consts::TAU;

mod blade;
mod frame;
mod near;
mod newton;
mod over_speed;
mod pair;
mod roots;
mod series;
#[cfg(test)]
mod tests;
mod whole;

use blade::Saw;
use frame::Frame;
use near::Near;
pub use over_speed::WaveModel;
use whole::Whole;

use super::component::Component;
use super::error::SpectrumError;
use crate::plate::Plate;

/// Waves up to this multiple of the window are kept: the series in λ converges as the inverse powers of it.
const CUT: f64 = 2.5;

/// Smallest rate 1/η at which the material itself relaxes, in windows. The far waves have this eigenvalue too, so that the
/// series in λ converges up to it: at 1.6 windows eigenvalues are off by 5e-6 of the window, at 0.8 by 0.4.
const SLOWEST_MATERIAL: f64 = 1.4;

/// The reduced model of a plate with these components over a range of speeds, in rad/s, for eigenvalues up to a frequency,
/// in rad/s.
///
/// # Errors
/// [`SpectrumError::HardlyOscillates`], [`SpectrumError::Cancelled`].
pub fn reduced(
    plate: &Plate,
    components: &[Component],
    range: (f64, f64),
    window_rad_per_s: f64,
) -> Result<WaveModel, SpectrumError> {
    let cut = (window_rad_per_s, cut(plate, window_rad_per_s)?);
    let saw = Saw::new(plate, window_rad_per_s);
    // More waves are far at rest than at any other speed, so that more dampers are strong.
    let dampers = Near::new(&saw, (0.0, 0.0), cut);
    let near = Near::new(&saw, range, cut).with_dampers_of(dampers);
    let unknowns = near.diameters();
    let rigid = components.iter().map(|c| c.full.free_rigid.len()).sum();
    let scale = (window_rad_per_s, rigid);
    match components {
        [only] if saw.has_other_coupling => {
            let whole = Whole::new(&saw, &only.full, &near, window_rad_per_s);
            WaveModel::of(&|speed| whole.reduced(speed), range, unknowns, scale)
        }
        _ => {
            let frame = Frame::new(&saw, &near, window_rad_per_s);
            WaveModel::of(&|speed| frame.reduced(speed), range, unknowns, scale)
        }
    }
}

/// Distance ω − nΩ up to which waves are kept, in 1/s. In air with the damping c per mass a far wave decays as slowly as
/// ω²/c, which must not be within `CUT` windows either.
fn cut(plate: &Plate, window: f64) -> Result<f64, SpectrumError> {
    let Some(damping) = &plate.damping else {
        return Ok(CUT * window);
    };
    let retardation_s = damping.material_retardation_time_s;
    let longest_s = (SLOWEST_MATERIAL * window).recip();
    if retardation_s > longest_s {
        return Err(SpectrumError::HardlyOscillates {
            retardation_s,
            highest_hz: window / TAU,
            longest_s,
        });
    }
    let air = damping.air_n_s_per_m3 / plate.blade.mass_per_area_kg_per_m2();
    Ok((CUT * window).max((CUT * window * air).sqrt()))
}
