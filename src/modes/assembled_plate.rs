//! An assembled plate, and computations that need no reduced model.

use std::sync::OnceLock;

use faer::Col;
use faer::linalg::solvers::Solve;

use super::buckling;
use super::component::Component;
use super::critical_speed::{CriticalSpeed, NamedCriticalSpeed, critical_speeds, named};
use super::error::SpectrumError;
use super::pencil::{Pencil, Softening};
use super::resting_mode::{RestingMode, modes_at_rest};
use super::structured_stiffness::{LARGE, StructuredStiffness};
use super::work::Cancellation;
use crate::model::plate::Plate;

/// Largest residual of a solution by the structure, relative to the load; a larger one is that of a block that is nearly singular.
const SOLVED: f64 = 1e-7;

/// Speed up to which critical speeds are needed, given those found so far, ascending, in rad/s.
pub type SpeedLimit<'a> = &'a dyn Fn(&[f64]) -> f64;

/// A plate with its matrices, and for large ones their structure, which is computed when first needed.
#[derive(Debug)]
pub struct Assembled {
    /// Blade, guides and basis.
    pub plate: Plate,
    /// Decoupled components of its equation of motion.
    pub components: Vec<Component>,
    pub(super) structure: OnceLock<Option<StructuredStiffness>>,
}

impl From<Plate> for Assembled {
    fn from(plate: Plate) -> Self {
        Assembled {
            components: Component::of(&plate),
            plate,
            structure: OnceLock::new(),
        }
    }
}

impl Assembled {
    /// Whether critical speeds and modes at rest need no dense eigenproblem of the order of the basis.
    pub fn is_structured(&self) -> bool {
        self.structured().is_some() || self.components.len() > 1
    }

    /// Whether these computations need no dense eigenproblem, now or, for a small basis, on a larger one.
    pub fn may_be_structured(&self) -> bool {
        let is_small = self.plate.degrees_of_freedom() < LARGE;
        self.is_structured() || (is_small && self.plate.edge_stiffness.is_none())
    }

    /// The structure, and the only component; `None` for small systems, several components, and free rigid
    /// motions.
    fn structured(&self) -> Option<(&StructuredStiffness, &Component)> {
        let [only] = self.components.as_slice() else {
            return None;
        };
        let is_large = only.full.order() >= LARGE && only.full.free_rigid.is_empty();
        let structure = || {
            is_large
                .then(|| StructuredStiffness::of(&self.plate))
                .flatten()
        };
        Some((self.structure.get_or_init(structure).as_ref()?, only))
    }

    /// Number of critical speeds below a speed, if the structure determines it with certainty.
    pub fn critical_speeds_below(&self, speed_rad_per_s: f64) -> Option<usize> {
        let (structure, _) = self.structured()?;
        structure.full.critical_speeds_below(speed_rad_per_s)
    }

    /// The critical speeds of the plate up to a limit, which may depend on those found so far, ascending; at
    /// least the lowest one, and all without a limit or if their computation gives all at once.
    ///
    /// # Errors
    /// [`SpectrumError::UnstableAtRest`], or [`SpectrumError::Buckled`] where membrane stress is
    /// the reason.
    pub fn critical_speeds(
        &self,
        limit_rad_per_s: Option<SpeedLimit<'_>>,
    ) -> Result<Vec<NamedCriticalSpeed>, SpectrumError> {
        let structured = limit_rad_per_s.and_then(|limit| {
            let (structure, only) = self.structured()?;
            critical_speeds_by(structure, only, limit)
        });
        Cancellation::current().check()?;
        let found = match structured {
            Some(found) => Ok(vec![found]),
            None => self
                .components
                .iter()
                .map(|c| critical_speeds(&c.full))
                .collect(),
        };
        match found {
            Ok(found) => Ok(named(&self.plate, &self.components, found)),
            Err(error) => Err(buckling::explained(&self.plate, error)),
        }
    }

    /// A vector in the basis of the plate, from one in the unknowns of a component.
    pub fn on_plate(&self, component: usize, own: &Col<f64>) -> Col<f64> {
        let first = self.components[component].first;
        let mut whole = Col::zeros(self.plate.degrees_of_freedom());
        whole.subrows_mut(first, own.nrows()).copy_from(own);
        whole
    }

    /// Deflection K(Ω)⁻¹f under a load at a speed; not finite where K(Ω) is singular.
    pub fn deflected(&self, speed_rad_per_s: f64, load: &Col<f64>) -> Col<f64> {
        if let Some((structure, only)) = self.structured()
            && only.full.is_conservative()
            && let Some(eliminated) = structure.full.eliminated_stiffness(speed_rad_per_s)
        {
            let found = eliminated.solve(load.as_mat()).col(0).to_owned();
            let rest = only.full.stiffness_at(speed_rad_per_s) * &found - load;
            if rest.norm_l2() <= SOLVED * load.norm_l2() {
                return found;
            }
        }
        let mut found = Col::zeros(load.nrows());
        for Component { first, full, .. } in &self.components {
            let own = load.subrows(*first, full.order());
            let factors = full.stiffness_at(speed_rad_per_s).partial_piv_lu();
            found
                .subrows_mut(*first, full.order())
                .copy_from(factors.solve(own));
        }
        found
    }

    /// The lowest `count` modes at rest, ascending, without damping and without free rigid motions.
    ///
    /// # Errors
    /// [`SpectrumError::UnstableAtRest`], [`SpectrumError::Decomposition`].
    pub fn modes_at_rest(&self, count: usize) -> Result<Vec<RestingMode>, SpectrumError> {
        let structured = self
            .structured()
            .and_then(|(structure, only)| modes_at_rest_by(structure, only, count));
        Cancellation::current().check()?;
        match structured {
            Some(found) => Ok(found),
            None => modes_at_rest(&self.components, count),
        }
    }
}

/// `None` if the iteration or its count fails, or if the computation was cancelled.
fn critical_speeds_by(
    structure: &StructuredStiffness,
    component: &Component,
    limit_rad_per_s: SpeedLimit<'_>,
) -> Option<Vec<CriticalSpeed>> {
    let pencil = Pencil {
        system: &component.full,
        structure,
        softening: Softening::Rotation,
    };
    let limit = |squares: &[f64]| {
        let lowest = *squares.first()?;
        let speeds: Vec<f64> = squares.iter().map(|square| square.sqrt()).collect();
        Some(limit_rad_per_s(&speeds).powi(2).max(lowest))
    };
    let count = |square: f64| structure.full.critical_speeds_below(square.sqrt());
    let found = pencil.lowest(&limit, &count)?.into_iter();
    let speed = |(square, shape): (f64, Col<f64>)| CriticalSpeed {
        speed_rad_per_s: square.sqrt(),
        shape,
    };
    Some(found.map(speed).collect())
}

/// `None` if the iteration or its count fails, or if the computation was cancelled.
fn modes_at_rest_by(
    structure: &StructuredStiffness,
    component: &Component,
    count: usize,
) -> Option<Vec<RestingMode>> {
    let pencil = Pencil {
        system: &component.full,
        structure,
        softening: Softening::Mass,
    };
    let limit = |squares: &[f64]| squares.get(count - 1).copied();
    let below = |square: f64| structure.full.modes_at_rest_below(square.sqrt());
    let found = pencil.lowest(&limit, &below)?.into_iter().take(count);
    let mode = |(square, shape): (f64, Col<f64>)| RestingMode {
        frequency_rad_per_s: square.sqrt(),
        component: 0,
        shape,
    };
    Some(found.map(mode).collect())
}

#[cfg(test)]
mod tests {
    use faer::Mat;

    use super::*;
    use crate::model::plate::Resolution;
    use crate::model::scene::{Scene, rad_per_s};
    use crate::modes::symmetric_pencil::singular_multiples;

    /// The stiffest pad has a million times the stiffness of the blade, and its columns have rounding errors
    /// relative to that stiffness.
    const ROUNDING: f64 = 1e-9;

    fn pads(count: usize, stiffness_n_per_m: f64) -> Scene {
        let scene = Scene::paper().edited(|saw| {
            let pad = saw.guides[0].clone();
            saw.guides.clear();
            for k in 0..count {
                let mut pad = pad.clone();
                pad.angle_deg = -55.0 + 360.0 * k as f64 / count as f64;
                pad.stiffness_n_per_m = stiffness_n_per_m;
                saw.guides.push(pad);
            }
        });
        scene.unwrap()
    }

    /// Weak and stiff pads, and three evenly spaced ones, for which pairs of equal waves have equal critical
    /// speeds and frequencies, compared with all eigenvalues of the dense symmetric problems. More than 20
    /// critical speeds up to 6000 rpm are found.
    #[test]
    fn critical_speeds_and_modes_by_structure_are_those_of_all_eigenvalues() {
        let top = rad_per_s(6000.0);
        let resolution = Resolution {
            max_diameters: 30,
            radial_functions: 9,
        };
        for (count, stiffness) in [(1, 1e4), (1, 2e7), (1, 1e10), (2, 2e6), (3, 1e6)] {
            let what = format!("{count} pads of {stiffness:e} N/m");
            let assembled = Assembled::from(Plate::new(&pads(count, stiffness), resolution));
            let (structure, only) = assembled.structured().expect(&what);
            let found = critical_speeds_by(structure, only, &|_| top).expect(&what);
            let mut exact = critical_speeds(&only.full).unwrap();
            exact.retain(|c| c.speed_rad_per_s <= top);
            assert_eq!(found.len(), exact.len(), "{what}");
            assert!(found.len() > 15, "{what}: {}", found.len());
            for (found, exact) in found.iter().zip(&exact) {
                let off = found.speed_rad_per_s / exact.speed_rad_per_s - 1.0;
                assert!(off.abs() < ROUNDING, "{what}: {off:e}");
            }
            let at_rest = modes_at_rest_by(structure, only, 12).expect(&what);
            let mass = Mat::identity(only.full.order(), only.full.order());
            let squares = singular_multiples(&only.full.stiffness, &[], &mass).unwrap();
            for (found, (square, _)) in at_rest.iter().zip(&squares) {
                let off = found.frequency_rad_per_s / square.sqrt() - 1.0;
                assert!(off.abs() < ROUNDING, "{what}: {off:e}");
            }
        }
    }

    /// By the minimum principle no critical speed rises when functions are added. The test uses a narrow
    /// ring, for which radial polynomials of high degree lose most digits.
    #[test]
    fn no_critical_speed_rises_with_the_basis() {
        let narrow = Scene::paper().edited(|saw| {
            saw.blade.inner_diameter_m = 0.6;
            let pad = &mut saw.guides[0];
            (pad.radius_m, pad.radial_length_m, pad.tangential_length_m) = (0.33, 0.04, 0.06);
        });
        for scene in [narrow.unwrap(), pads(1, 1e9)] {
            let mut before: Option<Vec<f64>> = None;
            for (max_diameters, radial_functions) in [(18, 10), (24, 14), (30, 20), (34, 26)] {
                let resolution = Resolution {
                    max_diameters,
                    radial_functions,
                };
                let assembled = Assembled::from(Plate::new(&scene, resolution));
                let (structure, only) = assembled.structured().unwrap();
                let top = |found: &[f64]| 2.0 * found[0];
                let found: Vec<f64> = critical_speeds_by(structure, only, &top)
                    .unwrap()
                    .iter()
                    .map(|c| c.speed_rad_per_s)
                    .collect();
                for (now, before) in found.iter().zip(before.iter().flatten()) {
                    assert!(*now < before * (1.0 + 1e-11), "{now} {before}");
                }
                before = Some(found);
            }
        }
    }

    /// At rest, between and above critical speeds, compared with a factorization of the whole matrix.
    #[test]
    fn deflections_by_structure_are_those_of_the_whole_matrix() {
        let resolution = Resolution {
            max_diameters: 20,
            radial_functions: 7,
        };
        for scene in [pads(1, 1e7), pads(2, 1e5)] {
            let assembled = Assembled::from(Plate::new(&scene, resolution));
            assert!(assembled.is_structured());
            let values = assembled.plate.functions_at(0.3, 1.2);
            let load = Col::from_fn(values.len(), |i| values[i]);
            for rpm in [0.0, 1000.0, 2500.0] {
                let found = assembled.deflected(rad_per_s(rpm), &load);
                let whole = assembled.components[0].full.stiffness_at(rad_per_s(rpm));
                let exact = whole.partial_piv_lu().solve(&load);
                let error = (&found - &exact).norm_l2() / exact.norm_l2();
                assert!(error < 1e-8, "{rpm}: {error:e}");
            }
        }
    }
}
