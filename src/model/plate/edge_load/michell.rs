//! One harmonic of the plane stress of an annulus, by Michell's series.

use nalgebra::{Matrix4, Vector4};

use crate::model::plate::in_plane::InPlaneStress;
use crate::model::scene::Blade;

/// A term of the series: three stresses with a common power of r.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Term {
    amplitude_pa: f64,
    /// Stresses of a term of unit amplitude at this edge.
    ratio: InPlaneStress,
    /// Edge at which (r/edge)^power is one. Inside the blade this power is below one, so that no order overflows.
    edge_m: f64,
    power: f64,
}

impl Term {
    /// A term of unit amplitude.
    fn new([radial_pa, hoop_pa, shear_pa]: [f64; 3], edge_m: f64, power: f64) -> Self {
        Term {
            amplitude_pa: 1.0,
            ratio: InPlaneStress {
                radial_pa,
                hoop_pa,
                shear_pa,
            },
            edge_m,
            power,
        }
    }

    fn times(self, amplitude_pa: f64) -> Self {
        Term {
            amplitude_pa,
            ..self
        }
    }

    fn at(&self, r: f64) -> InPlaneStress {
        let size = self.amplitude_pa * (r / self.edge_m).powf(self.power);
        InPlaneStress {
            radial_pa: size * self.ratio.radial_pa,
            hoop_pa: size * self.ratio.hoop_pa,
            shear_pa: size * self.ratio.shear_pa,
        }
    }
}

/// Amplitudes of the stresses of one harmonic as functions of the radius in a blade of uniform thickness.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    terms: Vec<Term>,
}

impl Series {
    /// The harmonic of order m under σ_rr = p cos mθ, σ_rθ = t sin mθ at the rim and q cos mθ, s sin mθ at
    /// the bore. For m = 0, where sin mθ vanishes, t and s are uniform shears. At the bore a uniform shear supplies
    /// the missing part of the torque of m = 0, and a traction of constant direction the missing part of the net
    /// force of m = 1.
    pub fn new(blade: &Blade, order: usize, rim: [f64; 2], bore: [f64; 2]) -> Self {
        let terms = match order {
            0 => ring_and_torsion(blade, rim, bore),
            1 => net_force(blade, rim, bore),
            _ => self_balanced(blade, order as f64, rim, bore),
        };
        Series { terms }
    }

    /// Stresses at a radius.
    pub fn at(&self, r: f64) -> InPlaneStress {
        let mut sum = InPlaneStress::default();
        for term in &self.terms {
            let stress = term.at(r);
            sum.radial_pa += stress.radial_pa;
            sum.hoop_pa += stress.hoop_pa;
            sum.shear_pa += stress.shear_pa;
        }
        sum
    }
}

/// Terms of m = 0: Lamé's ring, σ_rr = u − v a²/r² with u − v k² = p and u − v = q, k = a/b, and pure shear
/// t b²/r², with the stress function A r² + B ln r + C θ. The shear at the bore follows from that at the rim.
fn ring_and_torsion(blade: &Blade, [p, t]: [f64; 2], [q, _]: [f64; 2]) -> Vec<Term> {
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let inverse = (p - q) * b / (b - a) * b / (b + a);
    vec![
        Term::new([1.0, 1.0, 0.0], b, 0.0).times(q + inverse),
        Term::new([-1.0, 1.0, 0.0], a, -2.0).times(inverse),
        Term::new([0.0, 0.0, 1.0], b, -2.0).times(t),
    ]
}

/// Terms of m = 1, with the stress function A r³ cos θ + B cos θ/r + c [r θ sin θ/2 − (1−ν)/4 r ln r cos θ].
///
/// Every circle transmits the same net force F = πhc, c = b(p − t). The share of
/// r ln r makes the displacement single-valued (Timoshenko & Goodier, section 43,
/// b₁′ = −a₁(1−ν)/4); only there does Poisson's ratio enter. At the bore q and s transmit
/// a(q − s); the rest c′ = c − a(q − s) is a constant traction, σ_rr = c′/2a,
/// σ_rθ = −c′/2a. On each edge the two conditions differ by the balance of forces alone,
/// so one from each remains: A − B k³ = p − (3+ν) c/4b and
/// A k − B = q + c′/2a − (3+ν) c/4a, k = a/b.
fn net_force(blade: &Blade, [p, t]: [f64; 2], [q, s]: [f64; 2]) -> Vec<Term> {
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let nu = blade.material.poisson_ratio;
    let k = a / b;
    let force_at_rim = p - t;
    let rim = p - 0.25 * (3.0 + nu) * force_at_rim;
    // The condition at the bore contains q + c′/2a, which equals (q + s)/2 + c/2a.
    let bore = 0.5 * (q + s) - 0.25 * (1.0 + nu) * force_at_rim / k;
    let cubic = (rim - bore * k.powi(3)) / ((1.0 - k) * (1.0 + k) * (1.0 + k * k));
    let inverse = cubic * k - bore;
    let point_force = [0.25 * (3.0 + nu), -0.25 * (1.0 - nu), -0.25 * (1.0 - nu)];
    vec![
        Term::new([1.0, 3.0, 1.0], b, 1.0).times(cubic),
        Term::new([-1.0, 1.0, -1.0], a, -3.0).times(inverse),
        Term::new(point_force, b, -1.0).times(force_at_rim),
    ]
}

/// Terms of m ≥ 2: the stress functions cos mθ times r^m, r^(m+2), r^−m and r^(2−m) have no net force or torque;
/// four tractions at the two edges determine their four amplitudes.
///
/// A stress function f(r) cos mθ has σ_rr = f′/r − m² f/r², σ_θθ = f″, σ_rθ = m (f′/r − f/r²); a common
/// factor of each power is omitted.
///
/// On a narrow ring the powers are nearly dependent and digits are lost: the relative error of the virial of K_e is
/// 1e-14 up to a/b = 0.3, 1e-13 at 0.9, 3e-12 at 0.98 and 1e-10 at 0.99.
fn self_balanced(blade: &Blade, m: f64, [p, t]: [f64; 2], [q, s]: [f64; 2]) -> Vec<Term> {
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let terms = [
        Term::new([-1.0, 1.0, 1.0], b, m - 2.0),
        Term::new([2.0 - m, m + 2.0, m], b, m),
        Term::new([-1.0, 1.0, -1.0], a, -m - 2.0),
        Term::new([-m - 2.0, m - 2.0, -m], a, -m),
    ];
    let tractions = terms.map(|term| {
        let (rim, bore) = (term.at(b), term.at(a));
        Vector4::new(rim.radial_pa, rim.shear_pa, bore.radial_pa, bore.shear_pa)
    });
    // The four powers of r are independent, so that the matrix is singular only if numbers are not finite.
    let amplitudes = Matrix4::from_columns(&tractions)
        .lu()
        .solve(&Vector4::new(p, t, q, s))
        .unwrap_or_else(|| Vector4::repeat(f64::NAN));
    terms
        .iter()
        .zip(amplitudes.iter())
        .map(|(term, &amplitude)| term.times(amplitude))
        .collect()
}
