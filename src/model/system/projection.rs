//! Systems on fewer coordinates, and sums of systems.

use faer::{Mat, MatRef, Scale};

use super::{GyroscopicSystem, skew, symmetric};

impl GyroscopicSystem {
    /// Galerkin projection on the orthonormal columns of V, which must span the free rigid motions. It preserves
    /// symmetry and skewness, so that Krein's theory applies to the small system too.
    pub fn project(&self, basis: MatRef<'_, f64>) -> Self {
        self.times(basis).onto(basis)
    }

    /// The matrices times the columns of V, N × r.
    pub fn times(&self, basis: MatRef<'_, f64>) -> Self {
        let times = |matrix: &Mat<f64>| matrix * basis;
        GyroscopicSystem {
            stiffness: times(&self.stiffness),
            spin: times(&self.spin),
            gyroscopic: times(&self.gyroscopic),
            damping: self.damping.as_ref().map(times),
            circulatory: self.circulatory.as_ref().map(times),
            nonconservative: self.nonconservative.as_ref().map(times),
            free_rigid: self.free_rigid.clone(),
            drift: self.drift.as_ref().map(times),
        }
    }

    /// Vᵀ times the products that [`GyroscopicSystem::times`] gives: the projection on V.
    pub(crate) fn onto(&self, basis: MatRef<'_, f64>) -> Self {
        let onto = |product: &Mat<f64>| basis.transpose() * product;
        GyroscopicSystem {
            stiffness: symmetric(onto(&self.stiffness)),
            spin: symmetric(onto(&self.spin)),
            gyroscopic: skew(onto(&self.gyroscopic)),
            damping: self.damping.as_ref().map(|c| symmetric(onto(c))),
            circulatory: self.circulatory.as_ref().map(onto),
            nonconservative: self.nonconservative.as_ref().map(onto),
            free_rigid: self
                .free_rigid
                .iter()
                .map(|z| basis.transpose() * z)
                .collect(),
            drift: self.drift.as_ref().map(|d| symmetric(onto(d))),
        }
    }

    /// Σ weight · system, term by term, for derivatives of the matrices. `None` without systems.
    pub(crate) fn combination(terms: &[(f64, GyroscopicSystem)]) -> Option<Self> {
        let (_, first) = terms.first()?;
        let order = first.order();
        let sum = |matrix: fn(&GyroscopicSystem) -> Option<&Mat<f64>>| {
            let mut sum: Option<Mat<f64>> = None;
            for (weight, system) in terms {
                if let Some(matrix) = matrix(system) {
                    *sum.get_or_insert_with(|| Mat::zeros(order, order)) += Scale(*weight) * matrix;
                }
            }
            sum
        };
        Some(GyroscopicSystem {
            stiffness: sum(|s| Some(&s.stiffness))?,
            spin: sum(|s| Some(&s.spin))?,
            gyroscopic: sum(|s| Some(&s.gyroscopic))?,
            damping: sum(|s| s.damping.as_ref()),
            circulatory: sum(|s| s.circulatory.as_ref()),
            nonconservative: sum(|s| s.nonconservative.as_ref()),
            free_rigid: Vec::new(),
            drift: sum(|s| s.drift.as_ref()),
        })
    }
}
