//! Campbell diagram: modes at many speeds, computed in parallel and followed as branches.
//!
//! The input is a [`SpectralModel`] and its modes at some speeds, [`ModesAt`], computed or interpolated. The result is a
//! [`Campbell`], which contains the modes at every speed with names, and the modes that belong to each branch.

mod links;
mod names;
mod points;
mod refinement;

use faer::c64;
use rayon::prelude::*;

use crate::model::plate::Plate;
use crate::model::scene::rpm;
use crate::modes::{
    HarmonicShare, NamedCriticalSpeed, NamedMode, SpectralModel, SpectrumError, Work, smallest,
};
use crate::page::text::{MOST_DIGITS, rounded_between, shown_to};

use links::links;
use names::named;
pub use points::{Branch, ModesAt, SpeedSample};
pub(crate) use refinement::{Closeness, refined};

/// Progress callback: number of speeds done and number of speeds in total.
pub type Progress<'a> = &'a (dyn Fn(usize, usize) + Sync);

/// Reason why a chart could not be sampled.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CampbellError {
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// The modes at all speeds of a chart exceed the allowed memory.
    #[error(
        "the chart would take at least {needed_mb} MiB of memory for {modes} modes at each of {speeds} speeds; it must not take more than {allowed_mb} MiB; {}choose a coarser accuracy", end_in_words(*.largest_end_rpm)
    )]
    TooLarge {
        /// Memory needed at least, in MiB.
        needed_mb: usize,
        /// Memory allowed, in MiB.
        allowed_mb: usize,
        /// Number of modes at the last speed.
        modes: usize,
        /// Number of speeds.
        speeds: usize,
        /// Largest end of a sweep whose chart would fit, if any.
        largest_end_rpm: Option<f64>,
    },
}

fn end_in_words(largest_end_rpm: Option<f64>) -> String {
    let in_words = |end: f64| {
        let end = shown_to(MOST_DIGITS, end);
        format!("end the sweep at {end} rpm or earlier, or ")
    };
    largest_end_rpm.map_or_else(String::new, in_words)
}

/// Modes and branches over a range of speeds.
#[derive(Debug, Clone)]
pub struct Campbell {
    /// Samples by ascending speed.
    pub samples: Vec<SpeedSample>,
    /// Branches by frequency at their first speed.
    pub branches: Vec<Branch>,
}

/// Memory allowed for the modes of a chart, in MiB; usual saws need at most a tenth of it.
const MEMORY_BUDGET_MB: usize = 1024;

/// Memory for a mode of a chart, in bytes: its coordinates, once more while branches are followed, and a share for each harmonic.
fn bytes_of_mode(plate: &Plate) -> usize {
    let coordinates = 2 * plate.degrees_of_freedom() * size_of::<c64>();
    let shares = plate.max_diameters() * size_of::<HarmonicShare>();
    size_of::<NamedMode>() + coordinates + shares
}

/// Number of speeds with this many modes each that fit into the allowed memory.
fn most_speeds(plate: &Plate, modes: usize) -> usize {
    (MEMORY_BUDGET_MB << 20) / (modes.max(1) * bytes_of_mode(plate))
}

/// Number of speeds that a chart has room for in addition to its own.
pub(crate) fn room_for_more(model: &SpectralModel, samples: &[ModesAt]) -> usize {
    let modes = samples.iter().map(|sample| sample.modes.len()).max();
    most_speeds(&model.plate, modes.unwrap_or(0)).saturating_sub(samples.len())
}

/// Checks the memory for a chart of a saw with some critical speeds by the number of modes at its last speed, which is the
/// largest of all speeds.
///
/// # Errors
/// [`CampbellError::TooLarge`].
pub(crate) fn check_memory(
    plate: &Plate,
    critical: &[NamedCriticalSpeed],
    modes: usize,
    speeds: &[f64],
) -> Result<(), CampbellError> {
    let most = most_speeds(plate, modes);
    if speeds.len() <= most {
        return Ok(());
    }
    let critical: Vec<f64> = critical.iter().map(|c| c.speed_rad_per_s).collect();
    Err(CampbellError::TooLarge {
        needed_mb: (speeds.len() * modes * bytes_of_mode(plate)) >> 20,
        allowed_mb: MEMORY_BUDGET_MB,
        modes,
        speeds: speeds.len(),
        largest_end_rpm: largest_end(&critical, speeds, most)
            .map(|[low, high]| rounded_between(rpm(low), rpm(high))),
    })
}

/// Checks that the modes at some speeds fit into the allowed memory, before any other search at them.
///
/// # Errors
/// [`CampbellError`] when the eigenproblem of the last speed fails; [`CampbellError::TooLarge`].
pub(crate) fn check_room(model: &SpectralModel, speeds: &[f64]) -> Result<(), CampbellError> {
    let Some(last) = speeds.last() else {
        return Ok(());
    };
    let modes = model.modes(*last)?.len();
    check_memory(&model.plate, &model.critical, modes, speeds)
}

/// The last two critical speeds between which a sweep may end so that its chart has at most `most` speeds. An earlier end
/// omits the speeds beside later critical speeds but keeps the number of even ones. The chart then also has
/// fewer modes, which this estimate does not use.
fn largest_end(critical: &[f64], speeds: &[f64], most: usize) -> Option<[f64; 2]> {
    let last = *speeds.last()?;
    let first = *critical.first()?;
    // The speeds below the first critical speed, and not beside it, are all evenly spaced.
    let alone = speeds.partition_point(|speed| *speed < first * (1.0 - BESIDE)) as f64;
    let even = (alone * last / first).min(speeds.len() as f64);
    let charted = |end: f64| {
        let up_to = speeds.partition_point(|speed| *speed < end) as f64;
        even + up_to - even * end / last
    };
    let fits = |end: &&f64| **end < last && charted(**end) <= most as f64;
    let end = *critical.iter().rfind(fits)?;
    let before = critical.iter().rfind(|before| **before < end)?;
    Some([*before, end])
}

/// Largest relative distance of a charted speed from the critical speed that it belongs to.
const BESIDE: f64 = 1e-3;

/// Computes the modes at every speed, in parallel. The result is in the order of the speeds and reproducible
/// bit by bit.
///
/// # Errors
/// [`CampbellError`] of the last speed, or of the first one that fails; [`CampbellError::TooLarge`].
#[doc(hidden)]
pub fn sample(
    model: &SpectralModel,
    speeds: &[f64],
    progress: Progress<'_>,
) -> Result<Vec<ModesAt>, CampbellError> {
    let Some((last, others)) = speeds.split_last() else {
        return Ok(Vec::new());
    };
    let step = Work::of("speeds of the chart", speeds.len());
    let done = std::sync::atomic::AtomicUsize::new(0);
    let sampled = |speed_rad_per_s: &f64| {
        let modes = model.modes(*speed_rad_per_s)?;
        let so_far = done.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1;
        progress(so_far, speeds.len());
        step.advance();
        Ok(ModesAt {
            speed_rad_per_s: *speed_rad_per_s,
            modes,
        })
    };
    let last = sampled(last)?;
    check_memory(&model.plate, &model.critical, last.modes.len(), speeds)?;
    let samples: Vec<Result<ModesAt, CampbellError>> = others.par_iter().map(sampled).collect();
    samples.into_iter().chain([Ok(last)]).collect()
}

impl Campbell {
    /// Follows the modes of samples up to the height of their chart, and names them. A branch begins at the first speed or at
    /// that height, and ends at the last speed or at that height.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn track(model: &SpectralModel, mut samples: Vec<ModesAt>) -> Result<Self, SpectrumError> {
        samples.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
        let branches = followed(&samples, model.complete_to_rad_per_s);
        Ok(Campbell {
            samples: named(model, samples, &branches)?,
            branches,
        })
    }

    /// Index of the sample nearest to a speed whose modes were computed.
    pub(crate) fn solved_near(&self, speed_rad_per_s: f64) -> Option<usize> {
        let solved = (0..self.samples.len()).filter(|at| self.samples[*at].is_solved());
        smallest(solved, |at| {
            (self.samples[*at].speed_rad_per_s - speed_rad_per_s).abs()
        })
    }

    /// Mode at a point of a branch.
    pub fn mode(&self, (sample, mode): (usize, usize)) -> &NamedMode {
        &self.samples[sample].modes[mode]
    }
}

/// Branches of the modes of samples at ascending speeds.
pub(crate) fn followed(samples: &[ModesAt], height_rad_per_s: f64) -> Vec<Branch> {
    let links: Vec<Vec<Option<usize>>> = samples
        .par_windows(2)
        .map(|pair| {
            let step = pair[1].speed_rad_per_s - pair[0].speed_rad_per_s;
            links([&pair[0].modes, &pair[1].modes], step, height_rad_per_s)
        })
        .collect();
    let mut branches: Vec<Branch> = Vec::new();
    // `current` contains, for each mode of the previous sample, the index of its branch.
    let mut current: Vec<usize> = Vec::new();
    for (index, sample) in samples.iter().enumerate() {
        let mut next = vec![usize::MAX; sample.modes.len()];
        let before = index.checked_sub(1);
        let links = before.map_or(&[][..], |before| &links[before]);
        for (branch, after) in current.iter().zip(links) {
            if let Some(after) = after {
                next[*after] = *branch;
            }
        }
        for (mode, branch) in next.iter_mut().enumerate() {
            if *branch == usize::MAX {
                *branch = branches.len();
                branches.push(Branch::default());
            }
            branches[*branch].points.push((index, mode));
        }
        current = next;
    }
    branches
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::evenly_spaced;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{Scene, SpeedRange};
    use crate::modes::Strategy;

    #[test]
    fn branches_of_the_free_blade_are_straight_through_every_crossing() {
        let scene = Scene::paper().edited(|saw| saw.guides.clear()).unwrap();
        let plate = Plate::new(
            &scene,
            Resolution {
                max_diameters: 6,
                radial_functions: 6,
            },
        );
        let range = SpeedRange::between_rpm(0.0, 3000.0);
        let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
        let samples = sample(&model, &evenly_spaced(range.ends(), 31), &|_, _| ()).unwrap();
        let campbell = Campbell::track(&model, samples).unwrap();
        // Branches that leave the chart at its top are shorter.
        let whole = campbell.branches.iter().filter(|b| b.points.len() > 10);
        let mut followed = 0;
        for branch in whole {
            let names: Vec<_> = branch.points[1..]
                .iter()
                .map(|&p| {
                    let name = &campbell.mode(p).name;
                    (name.diameters, name.circles, name.direction.on_blade())
                })
                .collect();
            assert!(names.windows(2).all(|pair| pair[0] == pair[1]), "{names:?}");
            followed += 1;
        }
        assert!(followed >= 8, "{followed}");
    }

    /// There are fifty even speeds, and two beside each of 40 critical speeds in the second half of the
    /// sweep. With room for 90 speeds, half of the critical speeds may remain.
    #[test]
    fn a_sweep_that_does_not_fit_may_end_at_the_last_critical_speed_that_does() {
        let critical: Vec<f64> = (0..40).map(|k| 50.5 + 1.23 * f64::from(k)).collect();
        let even = (0..50).map(|k| 2.0 * f64::from(k));
        let beside = critical.iter().flat_map(|c| [c * 0.9999, c * 1.0001]);
        let mut speeds: Vec<f64> = even.chain(beside).collect();
        speeds.sort_by(f64::total_cmp);
        let [before, end] = largest_end(&critical, &speeds, 90).unwrap();
        let mut pairs = (18..=22).map(|k| [critical[k - 1], critical[k]]);
        assert!(pairs.any(|pair| pair == [before, end]), "{end}");
        // No sweep ends below its first critical speed.
        assert_eq!(largest_end(&critical, &speeds, 51), None);
        assert_eq!(largest_end(&critical, &speeds, 40), None);
        assert_eq!(largest_end(&[], &speeds, 40), None);
    }
}
