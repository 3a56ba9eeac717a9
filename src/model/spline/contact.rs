//! Flanks of the spline teeth: positions, forces, and the equilibrium of the blade.

use nalgebra::{Matrix3, Vector3};

use crate::model::scene::{Blade, SplineFile};

/// The flanks in the frame that turns with the arbor, in which they are fixed.
///
/// Displacements of the blade are (x, y, r_p ψ), forces (F_x, F_y, T/r_p).
#[derive(Debug, Clone)]
pub struct Contact {
    /// Normals of the two flanks of every tooth, the leading one first; the product with the displacement is
    /// the opening of the flank.
    normals: Vec<Vector3<f64>>,
    /// Share sin α of the normal force that is radial.
    radial: f64,
    stiffness_n_per_m_3_2: f64,
    damping_n_s_3_2_per_m_3_2: f64,
    clearance_m: f64,
    pitch_radius_m: f64,
}

/// A flank in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Number of the tooth, from 0.
    pub tooth: usize,
    /// Approach of the flanks.
    pub approach_m: f64,
    /// Normal force F.
    pub force_n: f64,
    /// Elastic part of the force, K x^{3/2}.
    pub elastic_n: f64,
    /// Direction of the force on the blade in the frame of the arbor.
    pub normal: Vector3<f64>,
    /// Radial component of this direction; the circumferential one is the third component of `normal`.
    pub radial: f64,
}

impl Touch {
    /// Components of the force on the blade, radial and circumferential at the tooth.
    pub fn radial_and_tangential_n(&self) -> [f64; 2] {
        [self.radial * self.force_n, self.normal.z * self.force_n]
    }
}

/// Returns x^{3/2} of x ≥ 0.
fn three_halves(x: f64) -> f64 {
    x * x.sqrt()
}

impl Contact {
    /// The flanks of a spline on a blade; the first tooth is at angle 0.
    pub(crate) fn new(spline: &SplineFile, blade: &Blade) -> Self {
        let (sin, cos) = spline.pressure_angle_deg.to_radians().sin_cos();
        let normals = (0..spline.teeth)
            .flat_map(|tooth| {
                let angle = std::f64::consts::TAU * f64::from(tooth) / f64::from(spline.teeth);
                let (s, c) = angle.sin_cos();
                [1.0, -1.0].map(|side: f64| {
                    let along = side * cos;
                    Vector3::new(sin * c - along * s, sin * s + along * c, along)
                })
            })
            .collect();
        Contact {
            normals,
            radial: sin,
            stiffness_n_per_m_3_2: spline.contact_stiffness_n_per_m_3_2,
            damping_n_s_3_2_per_m_3_2: spline.contact_damping_n_s_3_2_per_m_3_2,
            clearance_m: spline.clearance_m,
            pitch_radius_m: spline.pitch_radius_on_m(blade),
        }
    }

    /// Normal force at the approach x with the speed ẋ, and its elastic part, in N.
    pub fn force(&self, approach_m: f64, approach_m_per_s: f64) -> [f64; 2] {
        if approach_m <= 0.0 {
            return [0.0; 2];
        }
        let elastic = self.stiffness_n_per_m_3_2 * three_halves(approach_m);
        let viscous = self.damping_n_s_3_2_per_m_3_2 * three_halves(approach_m_per_s.abs());
        let force = elastic + viscous.copysign(approach_m_per_s);
        [force.max(0.0), elastic]
    }

    /// The flanks in contact for the displacement q with the speed q̇.
    pub fn touches(&self, q: Vector3<f64>, speed: Vector3<f64>) -> impl Iterator<Item = Touch> {
        self.normals.iter().enumerate().filter_map(move |(i, n)| {
            let approach_m = -n.dot(&q) - self.clearance_m;
            (approach_m > 0.0).then(|| {
                let [force_n, elastic_n] = self.force(approach_m, -n.dot(&speed));
                Touch {
                    tooth: i / 2,
                    approach_m,
                    force_n,
                    elastic_n,
                    normal: *n,
                    radial: self.radial,
                }
            })
        })
    }

    /// Elastic energy Σ (2/5) K x^{5/2} of the contacts, in J.
    pub fn energy_j(&self, q: Vector3<f64>) -> f64 {
        self.touches(q, Vector3::zeros())
            .map(|touch| 0.4 * touch.elastic_n * touch.approach_m)
            .sum()
    }

    /// Equilibrium of the blade on the resting arbor under a steady load (F_x, F_y, T/r_p); `None` if no
    /// flank resists the load.
    ///
    /// The energy of the contacts is convex: if they resist the load, the equilibrium is the minimum of the
    /// energy minus the work of the load. It is found by Newton steps, which are damped (Levenberg and
    /// Marquardt) where no flank touches yet.
    pub fn seat(&self, load: Vector3<f64>) -> Option<Vector3<f64>> {
        let target = 1e-13 * load.norm();
        let length = self.length_m(load.norm());
        let mut damping = load.norm() / length;
        let mut q = Vector3::zeros();
        let total = |q: Vector3<f64>| self.energy_j(q) - load.dot(&q);
        for _ in 0..MAX_NEWTON_STEPS {
            let residual = self.residual(q, load);
            let tangent = self.tangent(q);
            if residual.norm() <= target {
                return Some(q);
            }
            // The tangent is singular in a direction that no flank resists, so that a small stiffness is
            // added to it.
            let shift = damping.max(1e-12 * tangent.trace());
            let step = (tangent + Matrix3::identity() * shift)
                .lu()
                .solve(&residual)?;
            // Close to the equilibrium, differences of the energy are rounding errors, so that a smaller
            // residual suffices to accept the step.
            let closer = self.residual(q + step, load).norm() < residual.norm();
            if closer || total(q + step) < total(q) {
                q += step;
                damping *= 0.25;
            } else if damping > 1e30 * load.norm() / length {
                break;
            } else {
                damping *= 8.0;
            }
        }
        // The approach of a flank is a displacement minus the gap. It has few digits if it is much smaller
        // than the gap, so that this tolerance is wider than `target`.
        let residual = self.residual(q, load);
        (residual.norm() <= 1e-9 * load.norm()).then_some(q)
    }

    /// Sum of the load and the elastic contact forces.
    fn residual(&self, q: Vector3<f64>, load: Vector3<f64>) -> Vector3<f64> {
        let touches = self.touches(q, Vector3::zeros());
        touches.fold(load, |force, touch| force + touch.normal * touch.elastic_n)
    }

    /// Stiffness of the contacts, the derivative −∂/∂q of the residual.
    fn tangent(&self, q: Vector3<f64>) -> Matrix3<f64> {
        let touches = self.touches(q, Vector3::zeros());
        touches.fold(Matrix3::zeros(), |sum, touch| {
            let slope = 1.5 * self.stiffness_n_per_m_3_2 * touch.approach_m.sqrt();
            sum + touch.normal * touch.normal.transpose() * slope
        })
    }

    /// Length for scaling: gap plus approach of a single flank under the whole load, and at least a millionth of
    /// the radius, because gap and load may be zero.
    pub fn length_m(&self, load_n: f64) -> f64 {
        let approach = (load_n / self.stiffness_n_per_m_3_2).powf(2.0 / 3.0);
        (self.clearance_m + approach).max(1e-6 * self.pitch_radius_m)
    }
}

/// Largest number of steps. About 20 lead from the centre to the equilibrium; if no flank resists the load, they do
/// not converge.
const MAX_NEWTON_STEPS: usize = 400;
