//! A reduced model by waves: near waves of the blade, with all others eliminated.
//!
//! The equation of motion in space is L(λ)q = (λ² + λ(2ΩG + C) + K + Ω²S + ΩN) q = 0. Near waves x of the free blade,
//! those with ω − nΩ below a cut or reflected, and the displacements of strong dampers are kept (`near`). With all
//! others eliminated, L = [A B; C F],
//!
//! (A − B F⁻¹ C)(λ) = K̃ + λC̃ + λ²M̃ + λ³s₃ + λ⁴s₄ + …
//!
//! (`elimination`), at the nodes of a Chebyshev series in the speed (`over_speed`). No eigenproblem of
//! the full matrices is needed. The eigenvalues are those of all terms together (`pair`, `roots`), or one of them
//! (`newton`); λ is in units of the window, the frequency up to which the eigenvalues are wanted.

use std::borrow::Cow;

use faer::{Mat, Scale};

mod blade;
mod elimination;
mod near;
mod newton;
mod over_speed;
mod pair;
mod roots;
#[cfg(test)]
mod tests;

use blade::Saw;
use elimination::Elimination;
use near::Near;
pub use over_speed::WaveModel;

use super::component::Component;
use super::error::SpectrumError;
use super::vectors::orthonormal;
use crate::plate::Plate;

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
    let by_waves = ByWaves::new(plate, range, window_rad_per_s);
    let mut found = Vec::new();
    for component in components {
        found.extend(by_waves.reduced(component)?.components());
    }
    Ok(found)
}

/// The reduced model of a component as a whole, see [`models`].
///
/// # Errors
/// [`SpectrumError::Cancelled`].
pub fn reduced(
    plate: &Plate,
    component: &Component,
    range: (f64, f64),
    window_rad_per_s: f64,
) -> Result<WaveModel, SpectrumError> {
    ByWaves::new(plate, range, window_rad_per_s).reduced(component)
}

/// A saw by waves and dampers, those of them that are kept, and the range and window for which they are.
struct ByWaves {
    saw: Saw,
    near: Near,
    range: (f64, f64),
    window: f64,
}

impl ByWaves {
    fn new(plate: &Plate, range: (f64, f64), window: f64) -> Self {
        let saw = Saw::new(plate, window);
        ByWaves {
            near: Near::new(&saw, range, cut(plate, window)),
            saw,
            range,
            window,
        }
    }

    fn reduced(&self, component: &Component) -> Result<WaveModel, SpectrumError> {
        let elimination = Elimination::new(&self.saw, component, &self.near, self.window);
        let unknowns = elimination.diameters.clone();
        let scale = (self.window, component.full.free_rigid.len());
        let reduced = |speed| elimination.reduced(speed);
        WaveModel::of(&reduced, self.range, unknowns, scale)
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
            vec![
                Scale(window.powi(-2)) * system.stiffness_at(speed),
                Scale(window.recip()) * system.velocity_at(speed),
                Mat::identity(order, order),
            ]
        };
        let rigid = component.full.free_rigid.len();
        WaveModel::of(&quadratic, range, vec![None; order], (window, rigid))
    }
}
