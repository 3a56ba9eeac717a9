//! Eigenvalues of a damped blade at one speed, with their slopes.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use faer::c64;

use crate::modes::branches::ModesAt;
use crate::modes::waves::WaveModel;
use crate::modes::{SpectralModel, SpectrumError, single_eigenvalue, smallest};
use crate::stability::group::Sloped;
use crate::stability::growth_curve::Numbers;
use crate::stability::pieces::Piece;
use crate::stability::sample::{BESIDES, Plane, Sample};

/// Growth below this share of the highest accurate frequency is rounding.
const NOISE: f64 = 1e-10;
/// Largest number of spectra in one chart, a hundred times as many as usual saws need.
const MOST_SPECTRA: usize = 12_000;
/// An eigenvalue at more than this share of its size, or of a tenth of the highest accurate frequency, from the expected one
/// may be another eigenvalue.
const SAME: f64 = 1e-5;
/// Distance of eigenvalues beyond all others of a sample, in multiples of the reach. One ends the search above the window, where
/// a component of a saw may have none. One on the negative axis takes the place of a real eigenvalue beyond the reach, so that the
/// middle by frequency stays between conjugates.
const FENCE: f64 = 3.0;

/// Eigenvalues at one speed.
#[derive(Debug, Clone)]
pub struct Spectrum {
    /// Rotation speed Ω.
    pub speed: f64,
    /// Eigenvalues with Im λ ≥ 0 up to the highest accurate frequency, in 1/s, in no particular order.
    pub values: Vec<c64>,
}

/// Computes the spectra of a saw on its reduced model by waves, and counts them.
pub struct Solver<'a> {
    model: &'a SpectralModel,
    /// Reduced models of the components of the saw, or of their parts, with the index of the component.
    components: Vec<(usize, &'a WaveModel)>,
    spent: AtomicUsize,
    /// Modes at the speeds of the search of a saw of one part.
    seen: Mutex<Vec<ModesAt>>,
}

impl<'a> Solver<'a> {
    /// A solver on the reduced models of a saw.
    pub fn new(model: &'a SpectralModel) -> Self {
        Solver {
            model,
            components: model.wave_models(),
            spent: AtomicUsize::new(0),
            seen: Mutex::default(),
        }
    }

    /// Number of components of the saw that do not act on one another.
    pub fn components(&self) -> usize {
        self.components.len()
    }

    /// Computes the eigenvalues at a speed.
    pub fn at(&self, speed: f64) -> Result<Spectrum, SpectrumError> {
        let mut values = Vec::new();
        for component in 0..self.components.len() {
            let sloped = self.component(component).eigenvalues(speed)?;
            values.extend(sloped.into_iter().map(|(lambda, _)| lambda));
        }
        values.retain(|lambda| lambda.im <= self.highest());
        Ok(Spectrum { speed, values })
    }

    /// The spectra at the speeds of a search, for a saw of one component.
    pub fn spectra(&self, pieces: &[Piece]) -> Vec<Spectrum> {
        let of = |sample: &Sample| {
            let all = sample.eigenvalues.iter().map(|(lambda, _)| *lambda);
            let upper = all.filter(|lambda| (0.0..=self.highest()).contains(&lambda.im));
            Spectrum {
                speed: sample.speed_rad_per_s,
                values: upper.collect(),
            }
        };
        let first = pieces.first().map(|piece| of(&piece.ends[0]));
        let others = pieces.iter().map(|piece| of(&piece.ends[1]));
        first.into_iter().chain(others).collect()
    }

    /// The eigenvalues of one component.
    pub fn component(&self, index: usize) -> Component<'_> {
        Component {
            solver: self,
            index: self.components[index].0,
            model: self.components[index].1,
        }
    }

    /// Frequency up to which eigenvalues are complete and accurate.
    pub fn highest(&self) -> f64 {
        self.model.complete_to_rad_per_s
    }

    /// Growth rate, in 1/s, that is rounding.
    pub fn noise(&self) -> f64 {
        noise(self.model)
    }

    /// Modes at the speeds of the search of a saw of one part, ascending; empty for other saws.
    pub fn into_seen(self) -> Vec<ModesAt> {
        let mut seen = self.seen.into_inner().unwrap_or_default();
        seen.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
        seen
    }

    /// Whether the allowed number of spectra is used up.
    pub fn is_exhausted(&self) -> bool {
        self.spent.load(Ordering::Relaxed) >= MOST_SPECTRA
    }
}

/// Eigenvalues of a component of a saw.
pub struct Component<'a> {
    pub solver: &'a Solver<'a>,
    /// Index of the component of the saw.
    pub index: usize,
    model: &'a WaveModel,
}

impl Component<'_> {
    /// Computes the low eigenvalues of a component as a sample for a search; `None` once the allowed number of spectra is used
    /// up.
    pub fn sample(&self, speed: f64) -> Result<Option<Sample>, SpectrumError> {
        if self.solver.is_exhausted() {
            return Ok(None);
        }
        let mut values = self.searched(speed)?;
        values.sort_by(|x, y| x.0.im.total_cmp(&y.0.im));
        let reals = values.iter().filter(|(lambda, _)| lambda.im == 0.0).count();
        let followed = values.partition_point(|(lambda, _)| lambda.im <= self.solver.highest());
        values.truncate(followed + BESIDES);
        let away = FENCE * self.model.reach_per_s();
        let mut fences = vec![c64::new(0.0, away)];
        if reals % 2 == 1 {
            fences.push(c64::new(-away, 0.0));
        }
        values.extend(fences.into_iter().map(|fence| (fence, c64::new(0.0, 0.0))));
        Ok(Some(Sample::new(speed, values.into_iter())))
    }

    /// Eigenvalue to which an iteration from an expected one leads. A real one stays real.
    pub fn next_to(&self, speed: f64, expected: c64) -> Result<Option<Sloped>, SpectrumError> {
        let counters = &self.solver.model.counters;
        counters.cancellation.check()?;
        counters.refined_pairs.fetch_add(1, Ordering::Relaxed);
        Ok(single_eigenvalue::next_to(self.model, speed, expected))
    }

    /// Eigenvalues at a speed of the search. If the component is the whole saw, its modes are kept for the chart.
    fn searched(&self, speed: f64) -> Result<Vec<Sloped>, SpectrumError> {
        let solver = self.solver;
        if solver.components() > 1 {
            return self.eigenvalues(speed);
        }
        solver.spent.fetch_add(1, Ordering::Relaxed);
        let modes = solver.model.all_modes(speed)?;
        let values = modes.iter().map(|mode| (mode.lambda, mode.slope)).collect();
        if let Ok(mut seen) = solver.seen.lock() {
            seen.push(ModesAt {
                speed_rad_per_s: speed,
                modes: solver.model.shown(modes),
            });
        }
        Ok(values)
    }

    /// Eigenvalues of a component with Im λ ≥ 0, without free rigid motions, and their slopes.
    fn eigenvalues(&self, speed: f64) -> Result<Vec<Sloped>, SpectrumError> {
        let counters = &self.solver.model.counters;
        counters.cancellation.check()?;
        counters.local_solves.fetch_add(1, Ordering::Relaxed);
        self.solver.spent.fetch_add(1, Ordering::Relaxed);
        let found = self.model.eigenvalues(speed)?.into_iter();
        Ok(found
            .map(|(lambda, slope)| (lambda, finite(slope)))
            .collect())
    }
}

impl Numbers for Component<'_> {
    fn plane(&self) -> Plane {
        Plane::Eigenvalues
    }

    fn nearest(&self, speed: f64, expected: c64) -> Result<Option<Sloped>, SpectrumError> {
        let distance = |(lambda, _): &Sloped| (lambda - expected).norm();
        let away = SAME * expected.norm().max(0.1 * self.solver.highest());
        let found = self.next_to(speed, expected)?;
        if let Some(found) = found.filter(|found| distance(found) <= away) {
            return Ok(Some(found));
        }
        Ok(smallest(self.eigenvalues(speed)?, distance))
    }
}

/// Growth rate, in 1/s, that is rounding, which is relative to the blade's frequencies and not to a small λ.
pub fn noise(model: &SpectralModel) -> f64 {
    NOISE * model.complete_to_rad_per_s
}

/// A slope, or zero at the coalescence of two eigenvalues, where it is not finite.
pub fn finite(slope: c64) -> c64 {
    if slope.is_finite() {
        slope
    } else {
        c64::new(0.0, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{Scene, SpeedRange};
    use crate::modes::Strategy;

    /// Dampers stronger than their springs: of their real eigenvalues one is within the reach and the next one beyond it, and
    /// conjugates lie symmetrically about the middle nevertheless.
    #[test]
    fn the_middle_of_a_sample_is_between_conjugates() {
        let range = SpeedRange::between_rpm(0.0, 2600.0);
        let mut odd = 0;
        for (stiffness, damping) in [(1e6, 1e4), (0.0, 1e5), (3e5, 3e3)] {
            let scene = Scene::paper().edited(|saw| {
                saw.guides[0].stiffness_n_per_m = stiffness;
                saw.guides[0].damping_n_s_per_m = damping;
            });
            let resolution = Resolution {
                max_diameters: 6,
                radial_functions: 5,
            };
            let plate = Plate::new(&scene.unwrap(), resolution);
            let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
            let solver = Solver::new(&model);
            for k in 0..12 {
                let speed = range.to_rad_per_s * (f64::from(k) + 0.3) / 12.0;
                let all = solver.component(0).eigenvalues(speed).unwrap();
                odd += all.iter().filter(|(z, _)| z.im == 0.0).count() % 2;
                let sample = solver
                    .component(0)
                    .sample(speed)
                    .unwrap()
                    .unwrap()
                    .eigenvalues;
                let count = sample.len();
                for (k, (z, _)) in sample.iter().enumerate() {
                    let mirrored = sample[count - 1 - k].0.im;
                    assert!(
                        (z.im + mirrored).abs() < 1e-9,
                        "{stiffness} {damping}: {z} {mirrored}"
                    );
                }
            }
        }
        assert!(odd > 0);
    }
}
