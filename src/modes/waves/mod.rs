//! A reduced model by waves: near waves of the blade, with all others eliminated.
//!
//! The equation of motion in space is L(λ)q = (λ² + λ(2ΩG + C) + K + Ω²S + ΩN) q = 0. Near waves x of the free blade,
//! those with ω − nΩ below a cut or reflected, and the displacements of strong dampers are kept (`near_block`). With all
//! others eliminated, L = [A B; C F],
//!
//! (A − B F⁻¹ C)(λ) = K̃ + λC̃ + λ²M̃ + λ³s₃ + λ⁴s₄ + …
//!
//! (`elimination`), at the nodes of a Chebyshev series in the speed (`speed_series`). No eigenproblem of
//! the full matrices is needed. The eigenvalues are those of all terms together (`pair`, `roots`), or one or two of them by
//! Newton's method on its derivatives (`at_speed`); λ is in units of the window, the frequency up to which the eigenvalues are wanted.

use crate::model::scene::SpeedRange;
use faer::Mat;

mod at_speed;
mod blade;
mod coordinates;
mod elimination;
mod far_velocity;
mod modes;
mod near_block;
mod pair;
mod roots;
mod speed_series;
#[cfg(test)]
mod tests;

use blade::Saw;
use coordinates::Coordinates;
use elimination::Elimination;
pub use modes::WaveModes;
use near_block::Near;
pub use speed_series::WaveModel;
use speed_series::at_nodes;

use super::error::SpectrumError;
use crate::model::plate::Plate;
use crate::model::system::GyroscopicSystem;

/// Waves up to this multiple of the window are kept: the series in λ converges as the inverse powers of it.
pub const CUT: f64 = 2.5;
/// [`CUT`] where counts have shown that a model lacks modes.
pub const WIDE_CUT: f64 = 4.0;
/// Every so many nodes of the speed give vectors of far waves.
const SPARED: usize = 3;
/// Distance of the vectors of far waves from the span of others below which they are omitted, and thus the error of the shapes:
/// with 1e-6 there are 120 vectors for the saw with damped material, with 1e-5 103, with 1e-4 85.
const SPAN: f64 = 1e-6;
/// The same distance if eigenvalues are computed from these vectors: with 1e-6 they are off by 9e-7 of the window if the material
/// relaxes just within the cut, with 1e-9 by less than 1e-12.
const WHOLE: f64 = 1e-9;

/// The modes of the component of a plate that begins at the unknown `first`, over a range of speeds, in rad/s, for eigenvalues
/// up to a frequency, in rad/s. Waves up to `cut` times this frequency are kept, usually [`CUT`].
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn modes(
    plate: &Plate,
    first: usize,
    full: &GyroscopicSystem,
    range: SpeedRange,
    window_rad_per_s: f64,
    cut: f64,
) -> Result<WaveModes, SpectrumError> {
    let window = window_rad_per_s;
    let mut saw = Saw::new(plate, first, full, window);
    // The far waves too relax at the rate 1/η, up to which alone the series in λ converges. If this is below the cut, the series
    // of the saw without damping gives the vectors of far waves.
    let damping = plate.damping.as_ref();
    let retardation_s = damping.map_or(0.0, |damping| damping.material_retardation_time_s);
    let undamped = (cut * window * retardation_s > 1.0).then(|| full.conservative());
    if undamped.is_some() {
        saw.dampers = Mat::zeros(full.order(), 0);
    }
    let near = Near::new(&saw, range, distance(plate, window, cut));
    let elimination = Elimination::new(&saw, undamped.as_ref().unwrap_or(full), &near, window);
    let nodes = at_nodes(range, |node, speed| {
        let reduced = elimination.reduced(speed);
        let far = (node % SPARED == 0)
            .then(|| reduced.far(full.is_conservative()))
            .transpose()
            .map_err(SpectrumError::at(speed))?;
        Ok((reduced.terms, far))
    })?;
    let (terms, far): (Vec<_>, Vec<_>) = nodes.into_iter().unzip();
    let far: Vec<Mat<f64>> = far.into_iter().flatten().collect();
    let span = if undamped.is_some() { WHOLE } else { SPAN };
    let coordinates = Coordinates::new(full, elimination.basis(&far, span));
    if undamped.is_some() {
        return WaveModes::whole(coordinates, range, window);
    }
    let near = elimination.near();
    let model = WaveModel::of(&terms, range, elimination.diameters, window, full);
    Ok(WaveModes::new(&model, coordinates, near))
}

/// Distance ω − nΩ up to which waves are kept, in 1/s. In air with the damping c per mass a far wave decays as slowly as
/// ω²/c, which must not be within the cut either.
fn distance(plate: &Plate, window: f64, cut: f64) -> f64 {
    let Some(damping) = &plate.damping else {
        return cut * window;
    };
    let air = damping.air_n_s_per_m3 / plate.blade.mass_per_area_kg_per_m2();
    (cut * window).max((cut * window * air).sqrt())
}
