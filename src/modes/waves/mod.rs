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

use std::borrow::Cow;

use faer::{Mat, Scale};

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
use super::vectors::orthonormal;
use crate::model::plate::Plate;
use series::Series;

/// Waves up to this multiple of the window are kept: the series in λ converges as the inverse powers of it.
const CUT: f64 = 2.5;

/// The reduced models of the components of a plate, or of blocks into which they decouple further, over a range of speeds,
/// in rad/s, for eigenvalues up to a frequency, in rad/s.
///
/// # Errors
/// [`SpectrumError::Cancelled`].
pub fn models(
    plate: &Plate,
    components: &[Component],
    range: (f64, f64),
    window_rad_per_s: f64,
) -> Result<Vec<WaveModel>, SpectrumError> {
    let damping = plate.damping.as_ref();
    let retardation_s = damping.map_or(0.0, |damping| damping.material_retardation_time_s);
    // The far waves too relax at the rate 1/η, up to which alone the series in λ converges. If this is below the cut, no wave
    // is far.
    if CUT * window_rad_per_s * retardation_s > 1.0 {
        let whole = |component| WaveModel::whole(component, range, window_rad_per_s);
        return components.iter().map(whole).collect();
    }
    Ok(reduced(plate, components, range, window_rad_per_s)?.components())
}

/// The reduced model of a plate as a whole, see [`models`].
///
/// # Errors
/// [`SpectrumError::Cancelled`].
pub fn reduced(
    plate: &Plate,
    components: &[Component],
    range: (f64, f64),
    window_rad_per_s: f64,
) -> Result<WaveModel, SpectrumError> {
    let cut = (window_rad_per_s, cut(plate, window_rad_per_s));
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
fn cut(plate: &Plate, window: f64) -> f64 {
    let Some(damping) = &plate.damping else {
        return CUT * window;
    };
    let air = damping.air_n_s_per_m3 / plate.blade.mass_per_area_kg_per_m2();
    (CUT * window).max((CUT * window * air).sqrt())
}

/// Vectors closer than this to the span of the others are omitted.
const SPAN: f64 = 1e-9;

impl WaveModel {
    /// The equation of motion of a component, in all vectors of its projections if it has some.
    fn whole(component: &Component, range: (f64, f64), window: f64) -> Result<Self, SpectrumError> {
        let vectors = component.spanned();
        let system = match vectors.is_empty() {
            true => Cow::Borrowed(&component.full),
            false => {
                let basis = orthonormal(component.full.order(), &vectors, SPAN);
                Cow::Owned(component.full.project(basis.as_ref()))
            }
        };
        let order = system.order();
        let quadratic = |speed| {
            let mut series = Series::default();
            series.0[0] = Some(Scale(window.powi(-2)) * system.stiffness_at(speed));
            series.0[1] = Some(Scale(window.recip()) * system.velocity_at(speed));
            series.0[2] = Some(Mat::identity(order, order));
            series
        };
        let rigid = component.full.free_rigid.len();
        WaveModel::of(&quadratic, range, vec![None; order], (window, rigid))
    }
}
