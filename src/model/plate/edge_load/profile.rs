//! One harmonic of the plane stress under forces at the edges.

use crate::model::plate::in_plane::{InPlaneField, InPlaneLoad, InPlaneStress};
use crate::model::scene::Blade;

use super::michell::Series;

/// Amplitudes of the stresses of one harmonic as functions of the radius.
#[derive(Debug, Clone, PartialEq)]
pub enum Profile {
    /// Closed form for a blade of uniform thickness.
    Uniform(Series),
    /// Finite elements, to which uniform torsion is added.
    Varying(Box<Varying>),
}

/// Stress of a blade whose thickness varies.
#[derive(Debug, Clone, PartialEq)]
pub struct Varying {
    blade: Blade,
    field: InPlaneField,
    /// Torque per radian r² h σ_rθ of m = 0, which every circle transmits; zero for m > 0.
    torsion_n_m: f64,
}

impl Profile {
    /// The harmonic of order m under σ_rr = p cos mθ, σ_rθ = t sin mθ at the rim and
    /// q cos mθ, s sin mθ at the bore, completed at the bore as described at [`Series::new`].
    pub fn new(blade: &Blade, order: usize, rim: [f64; 2], bore: [f64; 2]) -> Self {
        if blade.profile.is_none() {
            return Profile::Uniform(Series::new(blade, order, rim, bore));
        }
        let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
        let at_rim = b * blade.thickness_at_m(b);
        let at_bore = a * blade.thickness_at_bore_m();
        let mut bore_pa = bore;
        if order == 1 {
            // A traction of constant direction supplies the part of the net force that is missing at the bore.
            let lacking = at_rim * (rim[0] - rim[1]) - at_bore * (bore[0] - bore[1]);
            bore_pa[0] += 0.5 * lacking / at_bore;
            bore_pa[1] -= 0.5 * lacking / at_bore;
        }
        let load = InPlaneLoad {
            rim_pa: rim,
            bore_pa,
            ..InPlaneLoad::default()
        };
        Profile::Varying(Box::new(Varying {
            blade: *blade,
            field: InPlaneField::new(blade, order, &load),
            torsion_n_m: if order == 0 { b * at_rim * rim[1] } else { 0.0 },
        }))
    }

    /// Stresses at a radius.
    pub fn at(&self, r: f64) -> InPlaneStress {
        match self {
            Profile::Uniform(series) => series.at(r),
            Profile::Varying(varying) => {
                let mut stress = varying.field.at(r, 0.0);
                let thickness = varying.blade.thickness_at_m(r);
                stress.shear_pa += varying.torsion_n_m / (r * r * thickness);
                stress
            }
        }
    }
}
