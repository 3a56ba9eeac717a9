//! Modes of a component: eigenvalues of its reduced model by waves, with vectors of all waves.
//!
//! A mode consists of near waves x, which the reduced model gives with λ, and far ones, which follow from them. They are found
//! among few vectors Q: with the equation of motion projected on the near waves and on Q, L = [A B; C F], they are Qy with
//! F(λ)y = −C(λ)x.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale, c64};

use super::coordinates::Coordinates;
use super::elimination::side_by_side;
use super::roots::Root;
use super::speed_series::{WaveModel, at_nodes};
use crate::model::scene::SpeedRange;
use crate::model::system::dynamic_stiffness;
use crate::modes::double_eigenvalue::DoubleEigenvalue;
use crate::modes::error::SpectrumError;
use crate::modes::mode::Mode;
use crate::modes::single_eigenvalue;
use crate::modes::vectors::{halves, joined, smallest, unit};

/// Unknowns that no others act on.
#[derive(Debug)]
struct Part {
    /// Places of its unknowns among all.
    places: Vec<usize>,
    /// Their reduced model.
    model: WaveModel,
}

/// The modes of a component over a range of speeds.
#[derive(Debug)]
pub struct WaveModes {
    parts: Vec<Part>,
    /// Largest error of the series in the speed, in units of the window.
    pub tail: f64,
    /// Near waves, then vectors of far ones.
    pub coordinates: Coordinates,
    /// Number of strong dampers, whose displacements are the first unknowns of the reduced model.
    strong: usize,
    /// Number of near waves, the other unknowns of the model and the first coordinates.
    near: usize,
}

impl WaveModes {
    /// The modes by a reduced model, with coordinates of its near waves and of vectors of far ones.
    pub(super) fn new(model: &WaveModel, coordinates: Coordinates, near: usize) -> Self {
        let parts = model.parts().into_iter();
        WaveModes {
            parts: parts
                .map(|(places, model)| Part { places, model })
                .collect(),
            tail: model.tail(),
            coordinates,
            strong: model.size() - near,
            near,
        }
    }

    /// All coordinates kept, with nothing eliminated, for a window in 1/s.
    ///
    /// # Errors
    /// [`SpectrumError::Cancelled`].
    pub(super) fn whole(
        coordinates: Coordinates,
        range: SpeedRange,
        window: f64,
    ) -> Result<Self, SpectrumError> {
        let system = &coordinates.system;
        let near = system.order();
        let quadratic = |_, speed| {
            Ok(side_by_side(&[
                Scale(window.powi(-2)) * system.stiffness_at(speed),
                Scale(window.recip()) * system.velocity_at(speed),
                Mat::identity(near, near),
            ]))
        };
        let terms = at_nodes(range, quadratic)?;
        let model = WaveModel::of(&terms, range, vec![None; near], window, system);
        Ok(WaveModes::new(&model, coordinates, near))
    }

    /// Reduced models of the parts that do not act on one another.
    pub fn models(&self) -> impl Iterator<Item = &WaveModel> {
        self.parts.iter().map(|part| &part.model)
    }

    /// Modes at a speed with Im λ ≤ `highest_rad_per_s`, by |λ| in each part, without free rigid motions, as modes of a component;
    /// they end somewhat beyond the window. Their coordinates are the near waves.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn at(
        &self,
        speed_rad_per_s: f64,
        highest_rad_per_s: f64,
        component: usize,
    ) -> Result<Vec<Mode>, SpectrumError> {
        let mut modes = Vec::new();
        for Part { places, model } in &self.parts {
            let roots = model.roots(speed_rad_per_s)?.into_iter();
            let low = roots.filter(|root| root.lambda.im <= highest_rad_per_s);
            modes.extend(low.filter_map(|root| {
                let near = self.near_waves(places, &root.vector);
                let Root {
                    lambda,
                    slope,
                    action,
                    ..
                } = root;
                let slope = if slope.is_finite() { slope } else { c64::ZERO };
                let mode = Mode::of(lambda, slope, action, component, near);
                mode.classified(speed_rad_per_s, model.is_conservative)
            }));
        }
        Ok(modes)
    }

    /// All coordinates of a mode from its λ and its near waves.
    pub fn whole_vector(&self, speed_rad_per_s: f64, lambda: c64, near: &Col<c64>) -> Col<c64> {
        let stiffness = self.coordinates.system.stiffness_at(speed_rad_per_s);
        let velocity = self.coordinates.system.velocity_at(speed_rad_per_s);
        let dynamic = dynamic_stiffness(&stiffness, &velocity, lambda);
        let kept = self.near;
        let (coupling, far) = (dynamic.get(kept.., ..kept), dynamic.get(kept.., kept..));
        let y = far
            .partial_piv_lu()
            .solve(Scale(c64::from(-1.0)) * (coupling * near));
        let all = Col::from_fn(kept + y.nrows(), |i| {
            if i < kept { near[i] } else { y[i - kept] }
        });
        unit(all.as_ref())
    }

    /// The near waves of modes as vectors of the component.
    pub fn near_vectors(&self, modes: &[&Mode]) -> Vec<Col<c64>> {
        let near = halves(self.near, modes.iter().map(|mode| &mode.coordinates));
        let vectors = self.coordinates.vectors.subcols(0, self.near) * near;
        (0..modes.len()).map(|k| joined(&vectors, k)).collect()
    }

    /// The eigenvalue nearest to an expected one, in 1/s, and dλ/dΩ. `None` if no iteration converges.
    pub fn next_to(&self, speed_rad_per_s: f64, expected: c64) -> Option<(c64, c64)> {
        let found = self
            .models()
            .filter_map(|model| single_eigenvalue::next_to(model, speed_rad_per_s, expected));
        smallest(found, |(lambda, _)| (lambda - expected).norm())
    }

    /// The coalescence next to an expected one, with the near waves of its vectors. `None` if no iteration converges.
    pub fn double_eigenvalue(
        &self,
        speed_rad_per_s: f64,
        expected: c64,
    ) -> Option<DoubleEigenvalue> {
        let next_to = |Part { places, model }: &Part| {
            let found = DoubleEigenvalue::next_to(model, speed_rad_per_s, expected)?;
            Some(DoubleEigenvalue {
                right: self.near_waves(places, &found.right),
                left: self.near_waves(places, &found.left),
                ..found
            })
        };
        let window = self.parts.first().map_or(1.0, |part| part.model.window);
        smallest(self.parts.iter().filter_map(next_to), |found| {
            let off = (found.speed_rad_per_s - speed_rad_per_s).abs() / speed_rad_per_s;
            off + (found.lambda - expected).norm() / window
        })
    }

    /// Removes the span of vectors of near waves from the reduced model.
    #[cfg(test)]
    pub fn lose(&mut self, vectors: &[Col<f64>]) {
        let [Part { places, model }] = self.parts.as_mut_slice() else {
            panic!("several parts");
        };
        let lost = crate::modes::orthonormal(self.near, vectors, 1e-6);
        let whole = lost.qr().compute_Q();
        *model = model.projected(whole.subcols(lost.ncols(), self.near - lost.ncols()));
        places.truncate(model.size());
    }

    /// The near waves among the unknowns of a part, as a unit vector.
    fn near_waves(&self, places: &[usize], vector: &Col<c64>) -> Col<c64> {
        let mut all: Col<c64> = Col::zeros(self.strong + self.near);
        for (place, entry) in places.iter().zip(vector.iter()) {
            all[*place] = *entry;
        }
        unit(all.subrows(self.strong, self.near))
    }
}
