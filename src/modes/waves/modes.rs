//! Modes of a component: eigenvalues of its reduced model by waves, with vectors of all waves.
//!
//! A mode consists of near waves x, which the reduced model gives with λ, and far ones, which follow from them. They are found
//! among few vectors Q: with the equation of motion projected on the near waves and on Q, L = [A B; C F], they are Qy with
//! F(λ)y = −C(λ)x.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale, c64};

use super::roots::Root;
use super::speed_series::{WaveModel, at_nodes};
use crate::model::scene::SpeedRange;
use crate::model::system::dynamic_stiffness;
use crate::modes::error::SpectrumError;
use crate::modes::projection::Projection;
use crate::modes::vectors::{Eigenpair, unit};

/// The modes of a component over a range of speeds.
#[derive(Debug)]
pub struct WaveModes {
    /// The reduced model.
    pub model: WaveModel,
    /// Projection on the near waves, and on vectors of far ones.
    pub projection: Projection,
    /// Number of near waves, the first coordinates of the projection.
    pub(super) near: usize,
}

impl WaveModes {
    /// The projection as it is, with nothing eliminated, for a window in 1/s and a number of free rigid motions.
    ///
    /// # Errors
    /// [`SpectrumError::Cancelled`].
    pub(super) fn whole(
        projection: Projection,
        range: SpeedRange,
        window: f64,
        rigid: usize,
    ) -> Result<Self, SpectrumError> {
        let system = &projection.reduced;
        let near = system.order();
        let quadratic = |_, speed| {
            Ok(vec![
                Scale(window.powi(-2)) * system.stiffness_at(speed),
                Scale(window.recip()) * system.velocity_at(speed),
                Mat::identity(near, near),
            ])
        };
        let terms = at_nodes(range, quadratic)?;
        Ok(WaveModes {
            model: WaveModel::of(&terms, range, vec![None; near], window, rigid),
            projection,
            near,
        })
    }

    /// Eigenpairs at a speed with 0 ≤ Im λ ≤ `highest_rad_per_s`, by |λ|, without free rigid motions, in the coordinates of the
    /// projection; they end somewhat beyond the window.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn eigenpairs(
        &self,
        speed_rad_per_s: f64,
        highest_rad_per_s: f64,
    ) -> Result<Vec<Eigenpair>, SpectrumError> {
        let mut roots = self.model.roots(speed_rad_per_s)?;
        roots.retain(|root| root.lambda.im <= highest_rad_per_s);
        let stiffness = self.projection.reduced.stiffness_at(speed_rad_per_s);
        let velocity = self.projection.reduced.velocity_at(speed_rad_per_s);
        let (near, order) = (self.near, stiffness.nrows());
        let pair = |Root { lambda, vector, .. }: Root| {
            let dynamic = dynamic_stiffness(&stiffness, &velocity, lambda);
            let x = vector.subrows(vector.nrows() - near, near);
            let (coupling, far) = (dynamic.get(near.., ..near), dynamic.get(near.., near..));
            let y = far
                .partial_piv_lu()
                .solve(Scale(c64::from(-1.0)) * (coupling * x));
            let all = Col::from_fn(order, |i| if i < near { x[i] } else { y[i - near] });
            (lambda, unit(all.as_ref()))
        };
        Ok(roots.into_iter().map(pair).collect())
    }
}
