//! Modes of an undamped blade at any speed, checked by its Krein index.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use faer::c64;

use super::extent::Extent;
use crate::modes::branches::ModesAt;
use crate::modes::{
    DoubleEigenvalue, Mode, ModeKind, SpectralModel, SpectrumError, krein_index, smallest,
};
use crate::stability::certificate::{Certificate, GROWTH_FLOOR};
use crate::stability::critical_sides::CRITICAL_GAP;
use crate::stability::group::Sloped;
use crate::stability::growth_curve::Numbers;
use crate::stability::sample::{BESIDES, Plane, Sample, squared};

/// Largest number of speeds in a search, twenty times as many as usual saws need. It limits the time if modes
/// cannot be distinguished.
const MOST_SPEEDS: usize = 20_000;

/// Frequency of a wave above all others of a sample, in multiples of the frequency up to which modes are complete.
const FENCE: f64 = 6.0;
/// If the Krein index contradicts the modes at a speed, it is compared again at this relative distance. At a
/// coalescence the Krein signs of the two modes are rounding: for a pad of 100 N/m, with bands of a width of
/// 2e-6 of the speed, this occurred within 1e-9 of the speed of the coalescence.
const BESIDE_COALESCENCE: f64 = 1e-7;

/// Number of speeds, and speeds at which the Krein index contradicts the modes.
#[derive(Debug, Default)]
struct Tally {
    checked: AtomicUsize,
    violations: Mutex<Vec<f64>>,
    /// Number of points of bands at which no mode grows, so that growth is interpolated.
    interpolated: AtomicUsize,
}

/// A growing eigenvalue at more than this share of its expected growth from the expected one may be another.
const SAME_GROWTH: f64 = 0.1;
/// Whether a growing λ may be an expected one: the frequencies, by the real parts of λ² and thus by the means of the coalescing pairs,
/// differ by no more than the faster growth of both. Next to a coalescence these means are smooth, while the expected growth may be
/// far from the true one, which rises like a square root.
fn may_be(square: c64, expected: c64) -> bool {
    let [found, wanted] = [square, expected].map(|square| square.sqrt());
    (square - expected).re.abs() <= found.re.max(wanted.re) * (found.norm() + wanted.norm())
}

fn sample(solved: &ModesAt) -> Sample {
    Sample::of_modes(solved.speed_rad_per_s, solved.modes.iter())
}

/// Squares of the growing eigenvalues.
impl Numbers for CheckedModes<'_> {
    fn plane(&self) -> Plane {
        Plane::Squares
    }

    fn nearest(
        &self,
        speed_rad_per_s: f64,
        expected: c64,
    ) -> Result<Option<Sloped>, SpectrumError> {
        let wanted = c64::new(expected.re, expected.im.max(0.0)).sqrt();
        let found = self.model.next_to(speed_rad_per_s, wanted);
        let is_same =
            |(lambda, _): &(c64, c64)| (lambda - wanted).norm() <= SAME_GROWTH * wanted.re;
        if let Some(found) = found.filter(is_same) {
            return Ok(Some(squared(found)));
        }
        let sample = self.at(speed_rad_per_s)?;
        let growing = sample.quadruples().chain(sample.divergences());
        let nearest = smallest(growing, |(square, _)| (square.sqrt() - wanted).norm());
        Ok(nearest.filter(|(square, _)| may_be(*square, wanted * wanted)))
    }

    fn note_interpolated(&self) {
        self.tally.interpolated.fetch_add(1, Ordering::Relaxed);
    }
}

/// Computes modes, checks the Krein index of each speed, and counts the speeds.
pub struct CheckedModes<'a> {
    model: &'a SpectralModel,
    /// What the search follows.
    pub extent: Extent,
    tally: Tally,
    /// Modes at the speeds of the search.
    seen: Mutex<Vec<ModesAt>>,
    /// Modes at other speeds.
    others: Mutex<Vec<ModesAt>>,
}

impl<'a> CheckedModes<'a> {
    /// The modes of an undamped blade, to be followed by a search.
    pub fn new(model: &'a SpectralModel, extent: Extent) -> Self {
        CheckedModes {
            model,
            extent,
            tally: Tally::default(),
            seen: Mutex::default(),
            others: Mutex::default(),
        }
    }

    /// Results of the checks so far.
    pub fn certificate(&self) -> Certificate {
        let mut violations = self
            .tally
            .violations
            .lock()
            .map_or_else(|poisoned| poisoned.into_inner().clone(), |v| v.clone());
        violations.sort_by(f64::total_cmp);
        Certificate {
            speeds_checked: self.tally.checked.load(Ordering::Relaxed),
            violations_rad_per_s: violations,
            gave_up: self.is_exhausted(),
            interpolated: self.tally.interpolated.load(Ordering::Relaxed),
            ..Certificate::default()
        }
    }

    /// Whether the allowed number of speeds is used up.
    pub fn is_exhausted(&self) -> bool {
        self.tally.checked.load(Ordering::Relaxed) >= MOST_SPEEDS
    }

    /// Computes the sample of a speed. If it contradicts the Krein index there and beside the speed, this is a violation.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn at(&self, speed_rad_per_s: f64) -> Result<Sample, SpectrumError> {
        Ok(sample(&self.checked(speed_rad_per_s)?))
    }

    /// Modes at a speed, with the checks of [`CheckedModes::at`].
    fn checked(&self, speed_rad_per_s: f64) -> Result<ModesAt, SpectrumError> {
        self.tally.checked.fetch_add(1, Ordering::Relaxed);
        let solved = self.solved(speed_rad_per_s)?;
        if self.matches_index(&solved) {
            return Ok(solved);
        }
        for share in [1.0 - BESIDE_COALESCENCE, 1.0 + BESIDE_COALESCENCE] {
            if self.matches_index(&self.solved(share * speed_rad_per_s)?) {
                return Ok(solved);
            }
        }
        if let Ok(mut violations) = self.tally.violations.lock() {
            violations.push(speed_rad_per_s);
        }
        Ok(solved)
    }

    fn solved(&self, speed_rad_per_s: f64) -> Result<ModesAt, SpectrumError> {
        Ok(ModesAt {
            speed_rad_per_s,
            modes: self.model.all_modes(speed_rad_per_s)?,
        })
    }

    /// Sample neither counted nor checked, for proposals that a proof checks.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn guess_at(&self, speed_rad_per_s: f64) -> Result<Sample, SpectrumError> {
        Ok(sample(&self.solved(speed_rad_per_s)?))
    }

    /// Squares of the eigenvalues at a speed, for a search by pieces. `None` next to a critical speed, where
    /// their signs are rounding, and once the allowed number of speeds is used up. Below the first critical speed K(Ω) is positive
    /// definite, and every λ imaginary with the sign +.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn sample(&self, speed_rad_per_s: f64) -> Result<Option<Sample>, SpectrumError> {
        let away = 0.999 * CRITICAL_GAP.get() * speed_rad_per_s;
        if self.is_exhausted()
            || self.spans_critical(speed_rad_per_s - away, speed_rad_per_s + away)
        {
            return Ok(None);
        }
        let solved = self.checked(speed_rad_per_s)?;
        let sample = self.followed(&solved);
        if let Ok(mut seen) = self.seen.lock() {
            seen.push(solved);
        }
        Ok(Some(sample))
    }

    /// The modes up to the top of the search and [`BESIDES`] above, with a wave far above, because the reduced model may have
    /// none there, in whose gap the search could end.
    fn followed(&self, solved: &ModesAt) -> Sample {
        let mut followed: Vec<&Mode> = solved.modes.iter().collect();
        followed.sort_by(|x, y| x.lambda.im.total_cmp(&y.lambda.im));
        let below = followed.partition_point(|mode| mode.lambda.im <= self.top_rad_per_s());
        followed.truncate(below + BESIDES);
        let fence = FENCE * self.model.complete_to_rad_per_s;
        followed.retain(|mode| mode.lambda.im < fence);
        let speed = solved.speed_rad_per_s;
        let mut sample = match self.model.negative_stiffness_directions(speed) {
            0 => Sample::of_definite_modes(speed, followed.into_iter()),
            _ => Sample::of_modes(speed, followed.into_iter()),
        };
        sample
            .eigenvalues
            .push((c64::from(-fence * fence), c64::ZERO));
        sample.signs.push(1);
        sample
    }

    /// Samples at the speeds of the search, ascending.
    pub fn samples(&self) -> Vec<Sample> {
        let mut all: Vec<Sample> = self
            .seen
            .lock()
            .map_or_else(|_| Vec::new(), |seen| seen.iter().map(sample).collect());
        all.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
        all
    }

    /// Modes at all speeds of the search and of its checks, ascending, each speed once.
    pub fn into_solved(self) -> Vec<ModesAt> {
        let mut all = self.seen.into_inner().unwrap_or_default();
        all.extend(self.others.into_inner().unwrap_or_default());
        all.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
        all.dedup_by(|x, y| x.speed_rad_per_s == y.speed_rad_per_s);
        all
    }

    /// Frequency up to which the search follows modes.
    pub fn top_rad_per_s(&self) -> f64 {
        self.extent.top_rad_per_s(self.model)
    }

    /// Frequency up to which modes are counted, beyond which no wave is reflected.
    pub fn height_rad_per_s(&self) -> f64 {
        self.model.reflected_to_rad_per_s
    }

    /// The coalescence of two modes of the guided blade next to an expected one.
    pub fn double_eigenvalue(
        &self,
        speed_rad_per_s: f64,
        expected: c64,
    ) -> Option<DoubleEigenvalue> {
        self.model.double_eigenvalue(0, speed_rad_per_s, expected)
    }

    /// Whether a critical speed lies between two speeds.
    pub fn spans_critical(&self, from_rad_per_s: f64, to_rad_per_s: f64) -> bool {
        let below = |speed| self.model.negative_stiffness_directions(speed);
        below(from_rad_per_s) != below(to_rad_per_s)
    }

    /// Whether the Krein index of modes equals the number of negative eigenvalues of the stiffness, which a
    /// separate symmetric eigenproblem on the full model gives.
    fn matches_index(&self, solved: &ModesAt) -> bool {
        let negative = self
            .model
            .negative_stiffness_directions(solved.speed_rad_per_s);
        if negative > 0 {
            return krein_index(&solved.modes) == negative;
        }
        // Of a positive definite K(Ω) a double eigenvalue may seem to grow by rounding, and so may the zero of a free rigid motion.
        let free = if self.model.has_free_motions() {
            GROWTH_FLOOR * self.model.complete_to_rad_per_s
        } else {
            0.0
        };
        let mut modes = solved.modes.iter();
        modes.all(|mode| match mode.kind {
            _ if mode.lambda.norm() < free => true,
            ModeKind::Flutter => mode.lambda.re < GROWTH_FLOOR * mode.lambda.norm(),
            kind => kind.krein_index() == 0,
        })
    }

    /// Samples at many speeds, in parallel.
    ///
    /// # Errors
    /// [`SpectrumError`] of the lowest speed that fails.
    pub fn at_all(&self, speeds: &[f64]) -> Result<Vec<Sample>, SpectrumError> {
        let solved: Vec<ModesAt> = speeds
            .par_iter()
            .map(|&speed| self.checked(speed))
            .collect::<Result<_, _>>()?;
        let samples = solved.iter().map(sample).collect();
        if let Ok(mut others) = self.others.lock() {
            others.extend(solved);
        }
        Ok(samples)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Scene, SpeedRange, rad_per_s};
    use crate::stability::Analysis;

    /// At 2260 rpm one vibration grows, with 0.4 1/s at 6 Hz. One that is expected at 40 Hz is not this one.
    #[test]
    fn a_growing_mode_far_from_the_expected_one_is_not_taken_for_it() {
        let scene = Scene::paper()
            .swept(SpeedRange::between_rpm(0.0, 2300.0))
            .unwrap();
        let analysis = Analysis::new(&scene).unwrap();
        let checked = CheckedModes::new(&analysis.model, Extent::Bands);
        let speed = rad_per_s(2260.0);
        let (exact, _) = checked.at(speed).unwrap().quadruples().next().unwrap();
        let near = |share: f64| {
            let lambda = exact.sqrt();
            c64::new(share * lambda.re, lambda.im).powi(2)
        };
        for expected in [near(0.9), near(0.1)] {
            let (found, _) = checked.nearest(speed, expected).unwrap().unwrap();
            assert!(
                (found - exact).norm() < 1e-6 * exact.norm(),
                "{found} {exact}"
            );
        }
        let other = c64::new(0.05, std::f64::consts::TAU * 40.0).powi(2);
        let found = checked.nearest(speed, other).unwrap();
        assert!(found.is_none(), "{found:?}");
    }
}
