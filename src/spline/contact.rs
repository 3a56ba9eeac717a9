//! Flanks of the spline teeth: where they are, how they push, where the blade comes to rest.

use nalgebra::{Matrix3, Vector3};

use crate::scene::Spline;

/// The flanks in the frame that turns with the arbor, where they stand still.
///
/// A displacement of the blade is (x, y, r_p ψ); a force (F_x, F_y, T/r_p).
#[derive(Debug, Clone)]
pub struct Contact {
    /// Two of every tooth, the leading one first: displacement times it is how far the
    /// flank has opened.
    normals: Vec<Vector3<f64>>,
    /// sin α, the share of the normal force that is radial.
    radial: f64,
    stiffness_n_per_m_3_2: f64,
    damping_n_s_3_2_per_m_3_2: f64,
    clearance_m: f64,
    pitch_radius_m: f64,
}

/// A flank that touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Number of the tooth, from 0.
    pub tooth: usize,
    /// How far it is pressed in.
    pub approach_m: f64,
    /// Normal force F.
    pub force_n: f64,
    /// Its elastic part K x^{3/2}.
    pub elastic_n: f64,
    /// Direction of the force on the blade, as the arbor sees it.
    pub normal: Vector3<f64>,
    /// Its component along the radius; that along the circle is the third of `normal`.
    pub radial: f64,
}

impl Touch {
    /// Components of the force on the blade along the radius of the tooth and the circle.
    pub fn radial_and_tangential_n(&self) -> [f64; 2] {
        [self.radial * self.force_n, self.normal.z * self.force_n]
    }
}

/// x^{3/2} of a number that is not negative.
fn three_halves(x: f64) -> f64 {
    x * x.sqrt()
}

impl Contact {
    /// The flanks of a spline; the first tooth is at angle 0.
    pub(crate) fn new(spline: &Spline) -> Self {
        let (sin, cos) = spline.pressure_angle_rad.sin_cos();
        let normals = (0..spline.teeth)
            .flat_map(|tooth| {
                let angle = std::f64::consts::TAU * tooth as f64 / spline.teeth as f64;
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
            pitch_radius_m: spline.pitch_radius_m,
        }
    }

    /// Normal force of a flank pressed in by x at the speed ẋ, and its elastic part, in N.
    pub fn force(&self, approach_m: f64, approach_m_per_s: f64) -> [f64; 2] {
        if approach_m <= 0.0 {
            return [0.0; 2];
        }
        let elastic = self.stiffness_n_per_m_3_2 * three_halves(approach_m);
        let viscous = self.damping_n_s_3_2_per_m_3_2 * three_halves(approach_m_per_s.abs());
        let force = elastic + viscous.copysign(approach_m_per_s);
        [force.max(0.0), elastic]
    }

    /// The flanks that touch when the blade has moved by q at the speed q̇.
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

    /// Where a steady load (F_x, F_y, T/r_p) presses the blade on the arbor at rest; `None`
    /// when it pushes where no flank resists.
    ///
    /// The energy of the contacts is convex: where they hold the load, its least value less
    /// the work of the load is the seat. Newton's steps, damped where no flank touches yet
    /// (Levenberg and Marquardt).
    pub fn seat(&self, load: Vector3<f64>) -> Option<Vector3<f64>> {
        let target = 1e-13 * load.norm();
        let length = self.length_m(load.norm());
        let mut damping = load.norm() / length;
        let mut q = Vector3::zeros();
        let total = |q: Vector3<f64>| self.energy_j(q) - load.dot(&q);
        for _ in 0..MAX_NEWTON_STEPS {
            let (residual, tangent) = self.residual(q, load);
            if residual.norm() <= target {
                return Some(q);
            }
            // A direction that no flank resists leaves the tangent singular.
            let shift = damping.max(1e-12 * tangent.trace());
            let step = (tangent + Matrix3::identity() * shift)
                .lu()
                .solve(&residual)?;
            // Close to the seat the energy has no digits left to tell better from worse.
            let closer = self.residual(q + step, load).0.norm() < residual.norm();
            if closer || total(q + step) < total(q) {
                q += step;
                damping *= 0.25;
            } else if damping > 1e30 * load.norm() / length {
                break;
            } else {
                damping *= 8.0;
            }
        }
        // Approaches far below the gap keep few digits in the difference of the two.
        let (residual, _) = self.residual(q, load);
        (residual.norm() <= 1e-9 * load.norm()).then_some(q)
    }

    /// Load plus contact forces, and the contacts' stiffness −∂/∂q of it.
    fn residual(&self, q: Vector3<f64>, load: Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let mut force = load;
        let mut tangent = Matrix3::zeros();
        for touch in self.touches(q, Vector3::zeros()) {
            force += touch.normal * touch.elastic_n;
            let slope = 1.5 * self.stiffness_n_per_m_3_2 * touch.approach_m.sqrt();
            tangent += touch.normal * touch.normal.transpose() * slope;
        }
        (force, tangent)
    }

    /// The gap and the approach of one flank that takes the whole load: a length to scale
    /// by, at least a millionth of the radius, for there may be neither gap nor load.
    pub fn length_m(&self, load_n: f64) -> f64 {
        let approach = (load_n / self.stiffness_n_per_m_3_2).powf(2.0 / 3.0);
        (self.clearance_m + approach).max(1e-6 * self.pitch_radius_m)
    }
}

/// From the centre to the seat it takes some 20 steps; a load that no flank resists never ends.
const MAX_NEWTON_STEPS: usize = 400;
