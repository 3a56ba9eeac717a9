//! In-plane stress of the steadily spinning annulus: in closed form for uniform thickness without mass of
//! teeth, by finite elements otherwise.

use std::sync::Arc;

use crate::model::scene::{Blade, Bore, InPlane};

use super::in_plane::{InPlaneField, InPlaneLoad};
use super::slots::SlottedBlade;

/// Centrifugal plane stress σ̂ = σ/(ρΩ²), in m².
#[derive(Debug, Clone, PartialEq)]
pub enum CentrifugalStress {
    /// Closed form σ̂_rr = A − B/r² − p r², σ̂_θθ = A + B/r² − q r², with p = (3+ν)/8, q = (1+3ν)/8
    /// (Timoshenko & Goodier, *Theory of Elasticity*, section 32).
    Uniform {
        /// The constant A.
        uniform_m2: f64,
        /// The constant B.
        inverse_m4: f64,
        /// The factor p.
        p: f64,
        /// The factor q.
        q: f64,
    },
    /// Finite elements.
    Varying(InPlaneField),
    /// Mean around the circle of a slotted blade.
    Slotted(Arc<SlottedBlade>),
}

impl CentrifugalStress {
    /// Computes the stress of a blade with a free rim. The bore is free (spline, or a collar in which the blade
    /// slides) or has u(a) = 0. The mass m of teeth exerts the outward force m Ω² r/2π per radian of its circle.
    pub fn new(blade: &Blade) -> Self {
        if let Some(slotted) = SlottedBlade::of(blade) {
            return CentrifugalStress::Slotted(slotted);
        }
        if blade.is_plain() {
            return Self::uniform(blade);
        }
        let of_rim = |rim: crate::model::scene::RimMass| {
            let per_density = std::f64::consts::TAU * blade.material.density_kg_per_m3;
            (rim.radius_m, rim.mass_kg * rim.radius_m / per_density)
        };
        let circle: Vec<(f64, f64)> = blade.rim.map(of_rim).into_iter().collect();
        let load = InPlaneLoad {
            // The load is normalized to ρΩ² = 1.
            body_n_per_m3: &|r| r,
            circle_n: &circle,
            bore_is_fixed: blade.bore == Bore::Clamped(InPlane::Fixed),
            ..InPlaneLoad::default()
        };
        CentrifugalStress::Varying(InPlaneField::new(blade, 0, &load))
    }

    /// Radial stress σ_rr/ρΩ² at a radius.
    pub fn radial_m2(&self, r: f64) -> f64 {
        match *self {
            Self::Uniform {
                uniform_m2,
                inverse_m4,
                p,
                ..
            } => uniform_m2 - inverse_m4 / (r * r) - p * r * r,
            Self::Varying(ref field) => field.at(r, 0.0).radial_pa,
            Self::Slotted(ref slotted) => slotted.stress.at_m2(r)[0],
        }
    }

    /// Hoop stress σ_θθ/ρΩ² at a radius.
    pub fn hoop_m2(&self, r: f64) -> f64 {
        match *self {
            Self::Uniform {
                uniform_m2,
                inverse_m4,
                q,
                ..
            } => uniform_m2 + inverse_m4 / (r * r) - q * r * r,
            Self::Varying(ref field) => field.at(r, 0.0).hoop_pa,
            Self::Slotted(ref slotted) => slotted.stress.at_m2(r)[1],
        }
    }

    /// Bending stiffness and stress of a slotted blade; `None` without slots.
    pub(super) fn slotted(&self) -> Option<&SlottedBlade> {
        match self {
            Self::Slotted(slotted) => Some(slotted),
            _ => None,
        }
    }

    fn uniform(blade: &Blade) -> Self {
        let nu = blade.material.poisson_ratio;
        let (aa, bb) = (blade.inner_radius_m.powi(2), blade.outer_radius_m.powi(2));
        let (p, q) = ((3.0 + nu) / 8.0, (1.0 + 3.0 * nu) / 8.0);
        let inverse_m4 = match blade.bore {
            Bore::Free | Bore::Clamped(InPlane::Free) => p * aa * bb,
            // The fixed bore, u(a) = 0, requires σ_θθ = ν σ_rr at a, and the free rim, σ_rr(b) = 0, requires
            // A = B/b² + p b².
            Bore::Clamped(InPlane::Fixed) => {
                ((1.0 - nu * nu) * aa / 8.0 - (1.0 - nu) * p * bb)
                    / ((1.0 - nu) / bb + (1.0 + nu) / aa)
            }
        };
        CentrifugalStress::Uniform {
            uniform_m2: inverse_m4 / bb + p * bb,
            inverse_m4,
            p,
            q,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::analytical::annulus::{Annulus, RadialAndHoop};
    use crate::model::scene::Scene;

    type ClosedForm = fn(&Annulus, f64, f64, f64) -> RadialAndHoop;

    fn blade(bore: Bore) -> Blade {
        Blade {
            bore,
            ..*Scene::paper().blade()
        }
    }

    #[test]
    fn the_stress_is_that_of_the_textbook() {
        for (in_plane, textbook) in [
            (
                InPlane::Free,
                Annulus::stress_of_rotation_with_free_edges as ClosedForm,
            ),
            (InPlane::Fixed, Annulus::stress_of_rotation_with_held_bore),
        ] {
            let blade = blade(Bore::Clamped(in_plane));
            let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
            let annulus = Annulus {
                bore_radius_m: a,
                rim_radius_m: b,
            };
            let stress = CentrifugalStress::new(&blade);
            for r in [a, 0.15, 0.2, 0.31, b] {
                let expected = textbook(&annulus, blade.material.poisson_ratio, 1.0, r);
                let error = (stress.radial_m2(r) - expected.radial_pa)
                    .hypot(stress.hoop_m2(r) - expected.hoop_pa);
                assert!(error < 1e-14 * b * b, "{in_plane:?} at {r} m: {error:e}");
            }
        }
        let [spline, sliding] = [Bore::Free, Bore::Clamped(InPlane::Free)].map(blade);
        let sliding_stress = CentrifugalStress::new(&sliding);
        assert_eq!(CentrifugalStress::new(&spline), sliding_stress);
    }

    /// A central difference satisfies d(r σ_rr)/dr − σ_θθ + ρΩ²r² = 0.
    #[test]
    fn the_stress_is_in_equilibrium() {
        for bore in [Bore::Free, Bore::Clamped(InPlane::Fixed)] {
            let stress = CentrifugalStress::new(&blade(bore));
            let (r, step) = (0.2, 2e-6);
            let traction = |r: f64| r * stress.radial_m2(r);
            let slope = (traction(r + step) - traction(r - step)) / (2.0 * step);
            let residual = slope - stress.hoop_m2(r) + r * r;
            assert!(residual.abs() < 1e-9 * stress.hoop_m2(r), "{residual}");
        }
    }
}
