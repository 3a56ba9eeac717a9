//! The spectrum of a saw as a function of speed.
//!
//! Decoupled components are solved separately, those of free blades by symmetric eigenproblems of one number of nodal diameters
//! each, all others by their waves up to `complete_to`.

use std::sync::OnceLock;
use std::sync::atomic::Ordering;

use faer::{Col, Mat, c64};

use crate::model::plate::Plate;

use super::assembled_plate::Assembled;
use super::chart_height::{Strategy, chart_height};
use super::companion::companion_eigenpairs;
use super::component::{Component, Solution};
use super::critical_speed::NamedCriticalSpeed;
use super::double_eigenvalue::DoubleEigenvalue;
use super::error::SpectrumError;
use super::full_model::FullModel;
use super::mode::{Mode, ModeKind, classify};
use super::mode_name::ModeName;
use super::scale::frequency_scale;
use super::vectors::smallest;
use super::waves;
use super::work::{Cancellation, WorkCounters};
use crate::model::scene::SpeedRange;

mod named_mode;
#[cfg(test)]
mod planted_fault;
mod reduced;

/// A mode with its name.
#[derive(Debug, Clone)]
pub struct NamedMode {
    /// Eigenvalue and kind of the mode.
    pub mode: Mode,
    /// Waves that make the mode.
    pub name: ModeName,
}

/// A mode with its name, shape and backward error.
#[derive(Debug, Clone)]
pub struct DescribedMode {
    /// Eigenvalue and kind of the mode.
    pub mode: Mode,
    /// q in the basis of the plate.
    pub shape: Col<c64>,
    /// Waves that make the mode.
    pub name: ModeName,
    /// ‖L(λ)q‖ / ((|λ|² + |λ|‖D‖ + ‖K‖)‖q‖) of the full model.
    pub backward_error: f64,
}

/// Modes of a saw at any speed of a range.
#[derive(Debug)]
pub struct SpectralModel {
    /// Blade, guides and basis.
    pub plate: Plate,
    /// Decoupled components of its equation of motion.
    pub components: Vec<Component>,
    /// Critical speeds, ascending, at least those of the range; the double ones of a free blade are listed
    /// twice.
    pub critical: Vec<NamedCriticalSpeed>,
    /// Frequency up to which the modes are complete and accurate.
    pub complete_to_rad_per_s: f64,
    /// Frequency up to which bands are searched for.
    pub reflected_to_rad_per_s: f64,
    /// Largest estimated error of a frequency of the reduced models that exceeds their tolerance, in rad/s; 0
    /// unless the range of speeds is too long for these models.
    pub unsettled_rad_per_s: f64,
    /// Work done so far.
    pub counters: WorkCounters,
    full: OnceLock<FullModel>,
}

/// At rest the two waves of equal n are degenerate. A rotation by this share of the blade's frequency scale
/// separates them into forward and backward waves, as at any other speed, and changes frequencies by no more
/// than itself.
pub(crate) const SPLITTING: f64 = 1e-9;

impl SpectralModel {
    /// Prepares the modes for a range of speeds, (from, to) in rad/s, and for the search for bands within that
    /// range.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(plate: Plate, range: SpeedRange, strategy: Strategy) -> Result<Self, SpectrumError> {
        let critical = Self::critical_speeds(&plate)?;
        Self::with_critical(plate, critical, range, strategy)
    }

    /// Prepares the modes as [`SpectralModel::new`], with known critical speeds, at least those of the range.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn with_critical(
        saw: impl Into<Assembled>,
        critical: Vec<NamedCriticalSpeed>,
        range: SpeedRange,
        strategy: Strategy,
    ) -> Result<Self, SpectrumError> {
        let counters = WorkCounters {
            cancellation: Cancellation::current(),
            ..WorkCounters::default()
        };
        let Assembled {
            plate,
            components,
            structure,
        } = saw.into();
        let full = structure.into_inner().flatten().map(|found| found.full);
        let mut model = SpectralModel {
            components,
            plate,
            critical,
            complete_to_rad_per_s: f64::INFINITY,
            reflected_to_rad_per_s: 0.0,
            unsettled_rad_per_s: 0.0,
            counters,
            full: full.map_or_else(OnceLock::new, OnceLock::from),
        };
        match (strategy, model.plate.is_axisymmetric()) {
            (Strategy::Dense, _) => (),
            // Decoupled harmonics are small enough to be solved without a reduced model.
            (_, true) if model.is_conservative() => model.use_free_waves(),
            (_, true) => (),
            (_, false) => model.find_heights(range, strategy)?,
        }
        if model.complete_to_rad_per_s.is_infinite() {
            model.complete_to_rad_per_s = model.twelfth_frequency(range)?;
        }
        let is_free = model.plate.is_axisymmetric() && model.is_conservative();
        if strategy != Strategy::Dense && !is_free {
            model.use_waves(model.modelled_range(range, strategy), waves::CUT)?;
        }
        if model.reflected_to_rad_per_s == 0.0 {
            model.reflected_to_rad_per_s = model.complete_to_rad_per_s;
        }
        Ok(model)
    }

    /// Every critical speed of a plate, ascending, without preparing anything else.
    ///
    /// # Errors
    /// [`SpectrumError::UnstableAtRest`], or [`SpectrumError::Buckled`] where membrane stress is
    /// the reason.
    pub fn critical_speeds(plate: &Plate) -> Result<Vec<NamedCriticalSpeed>, SpectrumError> {
        Assembled::from(plate.clone()).critical_speeds(None)
    }

    /// Frequency of the twelfth mode at the lowest speed, the height of a diagram.
    fn twelfth_frequency(&self, range: SpeedRange) -> Result<f64, SpectrumError> {
        let modes = self.all_modes(range.from_rad_per_s)?;
        let lambdas: Vec<c64> = modes.iter().map(|mode| mode.lambda).collect();
        Ok(chart_height(&lambdas, self.is_conservative()).unwrap_or(0.0))
    }

    /// Every mode of the reduced model, ordered by |Im λ|; those above `complete_to` are inaccurate.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn all_modes(&self, speed_rad_per_s: f64) -> Result<Vec<Mode>, SpectrumError> {
        self.solve(speed_rad_per_s, f64::INFINITY)
    }

    /// Modes up to `complete_to`, without free rigid motions, ordered by |Im λ|, at a speed of the range that was asked for. For a damped blade modes with
    /// −Re λ above `complete_to` are omitted: the reduced model does not represent them, and no diagram shows
    /// them.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails, or where a reduced model does not reach the speed.
    pub fn modes(&self, speed_rad_per_s: f64) -> Result<Vec<Mode>, SpectrumError> {
        let modes = self.solve(speed_rad_per_s, self.complete_to_rad_per_s)?;
        Ok(self.shown(modes))
    }

    /// Those of all modes at a speed that [`SpectralModel::modes`] contains.
    pub(crate) fn shown(&self, mut modes: Vec<Mode>) -> Vec<Mode> {
        let highest = self.complete_to_rad_per_s;
        let is_spanned = |m: &Mode| m.kind != ModeKind::Damped || m.lambda.re >= -highest;
        modes.retain(|m| m.kind != ModeKind::Rigid && m.lambda.im <= highest && is_spanned(m));
        modes
    }

    /// Every mode of the full model, by a dense solver.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn full_modes(&self, speed_rad_per_s: f64) -> Result<Vec<Mode>, SpectrumError> {
        let mut modes = Vec::new();
        for (index, component) in self.components.iter().enumerate() {
            self.counters.cancellation.check()?;
            self.counters.full_solves.fetch_add(1, Ordering::Relaxed);
            let pairs = companion_eigenpairs(&component.full, speed_rad_per_s)?;
            modes.extend(classify(&component.full, speed_rad_per_s, index, pairs));
        }
        Ok(modes)
    }

    /// The full model by its structure, computed when first needed.
    pub(crate) fn full_model(&self) -> &FullModel {
        self.full.get_or_init(|| FullModel::new(&self.plate))
    }

    /// Whether every force has a potential or is gyroscopic: then modes have Krein signs.
    pub fn is_conservative(&self) -> bool {
        self.components
            .iter()
            .all(|component| component.full.is_conservative())
    }

    /// Whether nothing holds some rigid motion of the blade.
    pub(crate) fn has_free_motions(&self) -> bool {
        let mut components = self.components.iter();
        components.any(|component| !component.full.free_rigid.is_empty())
    }

    /// Whether some damping turns with the blade: it strains under a wave that stands still in space, so that
    /// no eigenvalue is zero at the critical speeds, which are those of the blade without damping.
    pub(crate) fn has_turning_damping(&self) -> bool {
        let mut components = self.components.iter();
        components.any(|component| component.full.circulatory.is_some())
    }

    /// The eigenvalue nearest to an expected one, in 1/s, and dλ/dΩ, by Newton's method. `None` if it does not converge.
    pub(crate) fn next_to(&self, speed_rad_per_s: f64, expected: c64) -> Option<(c64, c64)> {
        self.counters.refined_pairs.fetch_add(1, Ordering::Relaxed);
        let components = self.components.iter();
        let found = components.filter_map(|component| component.next_to(speed_rad_per_s, expected));
        smallest(found, |(lambda, _)| (lambda - expected).norm())
    }

    /// The double eigenvalue of a component next to an expected one, with vectors in the coordinates of a mode. `None` if the iteration
    /// does not converge.
    pub(crate) fn double_eigenvalue(
        &self,
        component: usize,
        speed_rad_per_s: f64,
        expected: c64,
    ) -> Option<DoubleEigenvalue> {
        self.counters.refined_pairs.fetch_add(1, Ordering::Relaxed);
        self.components[component].double_eigenvalue(speed_rad_per_s, expected)
    }

    /// Relative change of a frequency at rest that rounding may cause: a backward stable solver changes ω² by
    /// ε times the largest ω². The inverse used for the waves of a free blade gives low frequencies with a small
    /// relative error; then rounding only changes each entry of the matrix by ε times its size.
    pub(crate) fn relative_rounding(&self, mode: &Mode) -> f64 {
        let component = &self.components[mode.component];
        let stiffness = &component.system().stiffness;
        let square = mode.frequency_rad_per_s().powi(2);
        let size = match component.solution {
            Solution::FreeWaves => {
                let q = &mode.coordinates;
                let sizes = Col::from_fn(q.nrows(), |i| q[i].norm());
                let entries = stiffness.nrows();
                let absolute = Mat::from_fn(entries, entries, |i, k| f64::abs(stiffness[(i, k)]));
                sizes.transpose() * absolute * &sizes
            }
            _ => stiffness.norm_l2(),
        };
        0.5 * f64::EPSILON * size / square
    }

    fn solve_component(
        &self,
        index: usize,
        speed_rad_per_s: f64,
        highest_rad_per_s: f64,
    ) -> Result<Vec<Mode>, SpectrumError> {
        self.counters.cancellation.check()?;
        let component = &self.components[index];
        let solves = match component.solution {
            Solution::Waves(_) => &self.counters.local_solves,
            Solution::Whole | Solution::FreeWaves => &self.counters.reduced_solves,
        };
        solves.fetch_add(1, Ordering::Relaxed);
        let speed = speed_rad_per_s.max(SPLITTING * frequency_scale(&self.plate));
        component.modes(&self.plate, index, speed, highest_rad_per_s)
    }

    /// Modes of all components up to a frequency, ordered by |Im λ|.
    fn solve(
        &self,
        speed_rad_per_s: f64,
        highest_rad_per_s: f64,
    ) -> Result<Vec<Mode>, SpectrumError> {
        let mut modes = Vec::new();
        for index in 0..self.components.len() {
            modes.extend(self.solve_component(index, speed_rad_per_s, highest_rad_per_s)?);
        }
        modes.sort_by(|x, y| x.frequency_rad_per_s().total_cmp(&y.frequency_rad_per_s()));
        Ok(modes)
    }

    /// Number of negative eigenvalues of K(Ω) of an undamped blade. K₀ is positive definite and K(Ω) = K₀ −
    /// Ω²(N − K_σ), so by Sylvester's law of inertia it is the number of critical speeds below Ω; no
    /// factorization is needed.
    pub(crate) fn negative_stiffness_directions(&self, speed_rad_per_s: f64) -> usize {
        self.critical
            .partition_point(|c| c.speed_rad_per_s < speed_rad_per_s)
    }
}
