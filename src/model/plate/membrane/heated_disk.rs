//! Temperature over the radius of a rotating blade that is heated along circles and cooled by convection.
//!
//! A point of the blade passes a pad once a turn, which is short against the seconds in which its temperature changes: the
//! temperature is uniform around and over the thickness. With a heat transfer coefficient α on both faces, conductivity k and no
//! heat through bore and rim, (k h r T′)′ − 2α r T + q/2π = 0, where q is the power per unit of the radius. The equation is
//! solved by linear finite elements; the sum of their equations is the balance of power.

use std::f64::consts::TAU;

use crate::model::evenly_spaced;
use crate::model::scene::Blade;

/// Conduction and convection of a blade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cooling {
    /// Conductivity k.
    pub conductivity_w_per_m_k: f64,
    /// Heat transfer coefficient α of each face.
    pub convection_w_per_m2_k: f64,
}

/// Number of elements. With it the temperature of the built-in blade is that of the closed form to 0.3 % for heat transfer coefficients
/// from that of still air to that of sprayed water, 6 to 2000 W/m²K.
const ELEMENTS: usize = SHOWN * FINER;
/// Number of intervals between radii of the report, and of elements in each.
const SHOWN: usize = 60;
const FINER: usize = 8;

/// Radii of the temperatures, some of the nodes.
pub fn radii_m(blade: &Blade) -> Vec<f64> {
    evenly_spaced([blade.inner_radius_m, blade.outer_radius_m], SHOWN + 1)
}

/// Radii of the nodes, at the ends of the elements.
fn nodes_m(blade: &Blade) -> Vec<f64> {
    evenly_spaced([blade.inner_radius_m, blade.outer_radius_m], ELEMENTS + 1)
}

/// Temperature rises at [`radii_m`] in K, under sources of a power in W at a radius in m.
pub fn rises_k(blade: &Blade, cooling: &Cooling, sources: &[(f64, f64)]) -> Vec<f64> {
    let rises = at_nodes(blade, cooling, sources);
    rises.into_iter().step_by(FINER).collect()
}

/// Temperature rises at all nodes.
fn at_nodes(blade: &Blade, cooling: &Cooling, sources: &[(f64, f64)]) -> Vec<f64> {
    let radii = nodes_m(blade);
    let nodes = radii.len();
    let (mut diagonal, mut beside, mut load) =
        (vec![0.0; nodes], vec![0.0; nodes], vec![0.0; nodes]);
    for k in 0..nodes - 1 {
        let width = radii[k + 1] - radii[k];
        // Two Gauss points integrate the product of two linear functions and the radius exactly.
        for share in [0.5 - 0.5 / 3f64.sqrt(), 0.5 + 0.5 / 3f64.sqrt()] {
            let r = radii[k] + share * width;
            let weight = 0.5 * width * TAU * r;
            let conducted =
                weight * cooling.conductivity_w_per_m_k * blade.thickness_at_m(r) / (width * width);
            let convected = weight * 2.0 * cooling.convection_w_per_m2_k;
            let [low, high] = [1.0 - share, share];
            diagonal[k] += conducted + convected * low * low;
            diagonal[k + 1] += conducted + convected * high * high;
            beside[k] += convected * low * high - conducted;
        }
    }
    for (radius_m, power_w) in sources {
        let place = (radius_m - radii[0]) / (radii[nodes - 1] - radii[0]) * ELEMENTS as f64;
        let element = (place.max(0.0) as usize).min(ELEMENTS - 1);
        let share = (place - element as f64).clamp(0.0, 1.0);
        load[element] += (1.0 - share) * power_w;
        load[element + 1] += share * power_w;
    }
    // The system is tridiagonal and positive definite, and is solved by elimination without pivoting.
    for k in 1..nodes {
        let factor = beside[k - 1] / diagonal[k - 1];
        diagonal[k] -= factor * beside[k - 1];
        load[k] -= factor * load[k - 1];
    }
    let mut rises = vec![0.0; nodes];
    for k in (0..nodes).rev() {
        let known = if k + 1 < nodes {
            beside[k] * rises[k + 1]
        } else {
            0.0
        };
        rises[k] = (load[k] - known) / diagonal[k];
    }
    rises
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::analytical::ring_source::CooledDisk;
    use crate::model::scene::Scene;

    const COOLING: Cooling = Cooling {
        conductivity_w_per_m_k: 45.0,
        convection_w_per_m2_k: 60.0,
    };

    /// Independent value: the closed form. The Biot numbers 2α(b − a)²/kh of conduction along the blade differ by a factor of 300.
    #[test]
    fn the_temperature_is_that_of_the_closed_form() {
        let scene = Scene::paper();
        let blade = scene.blade();
        for convection_w_per_m2_k in [6.0, 60.0, 2000.0] {
            let cooling = Cooling {
                convection_w_per_m2_k,
                ..COOLING
            };
            let disk = CooledDisk {
                inner_radius_m: blade.inner_radius_m,
                outer_radius_m: blade.outer_radius_m,
                thickness_m: blade.thickness_m,
                conductivity_w_per_m_k: 45.0,
                convection_w_per_m2_k,
            };
            let sources = [(0.18, 30.0), (0.27, 50.0)];
            let rises = rises_k(blade, &cooling, &sources);
            let exact =
                |r: f64| -> f64 { sources.iter().map(|(c, p)| disk.rise_k(r, *p, *c)).sum() };
            let peak = exact(0.27);
            for (r, found) in radii_m(blade).into_iter().zip(&rises) {
                let error = (found - exact(r)).abs() / peak;
                assert!(
                    error < 3e-3,
                    "{convection_w_per_m2_k} {r}: {found} {}",
                    exact(r)
                );
            }
        }
    }

    /// The faces emit the power of the sources.
    #[test]
    fn the_power_is_that_of_convection() {
        let scene = Scene::paper();
        let blade = scene.blade();
        let rises = at_nodes(blade, &COOLING, &[(0.15, 20.0), (0.3, 60.0)]);
        let radii = nodes_m(blade);
        // ∫ T r dr of straight pieces.
        let piece = |k: usize| {
            let ([r, s], [t, u]) = ([radii[k], radii[k + 1]], [rises[k], rises[k + 1]]);
            (s - r) * (t * (2.0 * r + s) + u * (r + 2.0 * s)) / 6.0
        };
        let sum: f64 = (0..ELEMENTS).map(piece).sum();
        let given = 2.0 * COOLING.convection_w_per_m2_k * TAU * sum;
        assert!((given - 80.0).abs() < 1e-9, "{given}");
    }
}
