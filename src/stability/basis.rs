//! Choice of the basis for a tolerance.
//!
//! The edge of a pad bends the blade sharply, so the error of critical speeds falls with a power of the
//! number of functions that depends on the pad. The basis therefore grows until the functions of a size two
//! or three steps larger would change its critical speeds and its lowest frequencies at rest by less than the
//! tolerance. It has at least the nodal diameters of every wave that can stand still at a speed of which a report
//! speaks, see [`Reach`].

use super::error::AnalysisError;
use super::ladder::{DENSE_LADDER, LADDER, ahead, resolution, rung_of, sized};
use super::reach::{PAST_THE_RANGE, Reach, speeds};
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{Scene, SpeedRange};
use crate::model::tuning::Tuned;
use crate::modes::{Assembled, BasisError, Cancellation, NamedCriticalSpeed, RestingMode, Work};

/// Factor for the estimated errors, because the larger basis has an error too. On 120 random saws, 60 of
/// which were not used to choose the factor, the true error was up to 1.9 times the estimate without it for
/// critical speeds of the chosen basis, and up to 2.3 times for frequencies at rest.
pub(super) const REMAINDER: Tuned = Tuned::new("stability/basis::REMAINDER", 2.5);
/// Number of modes at rest whose frequencies must keep the tolerance, as many as a chart shows.
pub(super) const MODES_AT_REST: usize = 12;
/// Fall of the error in one step of the ladder. In a quarter of all cases it was larger; sizes at which the
/// error would have to fall faster are skipped.
pub(super) const FALL: f64 = 4.0;
/// Errors below this are the rounding of the eigenproblem.
const ROUNDING: f64 = 1e-10;

/// Smallest basis within a tolerance, with its critical speeds and estimated errors.
#[derive(Debug)]
pub struct ChosenBasis {
    /// The saw in this basis.
    pub saw: Assembled,
    /// Critical speeds up to slightly above the range, and at least the lowest one; ascending.
    pub critical: Vec<NamedCriticalSpeed>,
    /// Range of speeds of the chart, from the scene or chosen by the program.
    pub range_rad_per_s: SpeedRange,
    /// Estimated relative error of the critical speeds within the range.
    pub estimated_relative_error: f64,
    /// Estimated relative error of the lowest frequencies at rest.
    pub estimated_resting_error: f64,
    /// Errors of the basis, for those of other results.
    pub basis_error: BasisError,
    /// Speed up to which no wave with more nodal diameters than the basis can stand still: at least the end of the
    /// range and the first critical speed.
    pub complete_to_rad_per_s: f64,
}

impl ChosenBasis {
    /// Finds the smallest basis within a tolerance; the largest if none is.
    ///
    /// # Errors
    /// [`AnalysisError`] when an eigenproblem fails, when the blade would yield within the sweep, or when the
    /// largest basis does not contain all waves that stand still within the sweep.
    pub fn new(scene: &Scene, tolerance: f64) -> Result<Self, AnalysisError> {
        Self::at_least(scene, tolerance, resolution(LADDER[0]))
    }

    /// Finds the smallest basis within a tolerance that has at least the number of radial functions of a given size,
    /// which a similar saw needed. Omitting the smaller sizes halves the time.
    ///
    /// # Errors
    /// The errors of [`ChosenBasis::new`].
    pub fn at_least(
        scene: &Scene,
        tolerance: f64,
        least: Resolution,
    ) -> Result<Self, AnalysisError> {
        let cancellation = Cancellation::current();
        let reach = Reach::of(scene, tolerance)?;
        let mut rung = rung_of(least);
        let mut diameters = 0;
        let sizes = Work::of("sizes of the basis", LADDER.len() - rung);
        loop {
            cancellation.check()?;
            let size = sized(rung, diameters);
            let saw = Assembled::from(Plate::new(scene, size));
            if rung > 0 && !reach.fits(&saw, size) {
                rung -= 1;
                continue;
            }
            let known = reach.of_free_blade(&saw)?;
            if known.diameters > size.max_diameters {
                diameters = known.diameters;
                continue;
            }
            let ((critical, resting), basis_error) = rayon::join(
                || {
                    rayon::join(
                        || saw.critical_speeds(Some(&|found| PAST_THE_RANGE * reach.last(found))),
                        || saw.modes_at_rest(MODES_AT_REST),
                    )
                },
                || BasisError::new(&saw.plate, &Plate::new(scene, ahead(size))),
            );
            let critical = critical?;
            let known = reach.of_saw(&saw, &critical, known)?;
            if known.diameters > size.max_diameters {
                diameters = known.diameters;
                continue;
            }
            let (basis_error, resting) = (basis_error?, resting?);
            let range_rad_per_s = reach.range(&speeds(&critical));
            let seen = reach.of_window(&saw.plate, range_rad_per_s, &resting)?;
            if seen > size.max_diameters && reach.fits(&saw, sized(rung, seen)) {
                diameters = seen;
                continue;
            }
            let resting = resting_error(&resting, &basis_error);
            let error = critical_error(&saw, &basis_error, &critical, range_rad_per_s.to_rad_per_s);
            let excess = resting.max(error) / tolerance;
            let next = next(rung, excess, |rung| {
                reach.fits(&saw, sized(rung, diameters))
            });
            let Some(next) = next.filter(|_| excess > 1.0) else {
                return Ok(ChosenBasis {
                    saw,
                    critical,
                    range_rad_per_s,
                    estimated_relative_error: error,
                    estimated_resting_error: resting,
                    basis_error,
                    complete_to_rad_per_s: known.to_rad_per_s,
                });
            };
            (rung..next).for_each(|_| sizes.advance());
            rung = next;
        }
    }
}

/// Index of the first size that may reduce an error of `excess` times the tolerance to the tolerance, or of the
/// largest one that is possible; `None` if no larger size is possible. The largest size of dense eigenproblems is not
/// skipped, because larger ones are not possible for all saws.
fn next(rung: usize, excess: f64, is_possible: impl Fn(usize) -> bool) -> Option<usize> {
    let steps = (excess.ln() / FALL.ln()).ceil().max(1.0) as usize;
    let dense = DENSE_LADDER.len();
    let end = if rung + 1 < dense {
        dense
    } else {
        LADDER.len()
    };
    let larger = rung + 1..end;
    let possible = larger.take_while(|rung| is_possible(*rung));
    possible.take(steps).last()
}

/// Assembles a saw with its critical speeds in a basis of a given size, or with more nodal diameters if waves of
/// more stand still up to a speed.
///
/// # Errors
/// [`AnalysisError`] when an eigenproblem fails, when the blade would yield below that speed, or when the
/// largest basis does not contain these waves.
pub(crate) fn resolved(
    scene: &Scene,
    least: Resolution,
    to_rad_per_s: f64,
) -> Result<(Assembled, Vec<NamedCriticalSpeed>), AnalysisError> {
    let swept = scene.swept(SpeedRange::new(0.0, to_rad_per_s))?;
    let reach = Reach::of(&swept, scene.tolerance())?;
    let mut size = least;
    loop {
        let saw = Assembled::from(Plate::new(scene, size));
        let known = reach.of_free_blade(&saw)?;
        if known.diameters > size.max_diameters {
            size.max_diameters = known.diameters;
            continue;
        }
        let critical = saw.critical_speeds(Some(&|found| PAST_THE_RANGE * reach.last(found)))?;
        let known = reach.of_saw(&saw, &critical, known)?;
        if known.diameters <= size.max_diameters {
            return Ok((saw, critical));
        }
        size.max_diameters = known.diameters;
    }
}

/// End of the sweep, in rad/s, from the scene or chosen by the program.
///
/// # Errors
/// The errors of [`ChosenBasis::new`], if the program chooses the end.
pub(crate) fn end_of_sweep(scene: &Scene) -> Result<f64, AnalysisError> {
    match scene.sweep() {
        Some(sweep) => Ok(sweep.to_rad_per_s),
        None => {
            let chosen = ChosenBasis::new(scene, scene.tolerance())?;
            Ok(chosen.range_rad_per_s.to_rad_per_s)
        }
    }
}

/// Largest estimated relative error of the lowest frequencies at rest.
fn resting_error(modes: &[RestingMode], basis_error: &BasisError) -> f64 {
    let errors = modes.iter().map(|mode| basis_error.resting_error(mode));
    REMAINDER.get() * errors.fold(0.0, f64::max)
}

/// Largest estimated relative error of the critical speeds up to a speed, and of the first.
fn critical_error(
    saw: &Assembled,
    basis_error: &BasisError,
    critical: &[NamedCriticalSpeed],
    to_rad_per_s: f64,
) -> f64 {
    let within = critical.partition_point(|c| c.speed_rad_per_s <= to_rad_per_s);
    let errors = critical
        .iter()
        .take(within.max(1))
        .map(|c| basis_error.critical_error(&saw.components, c));
    (REMAINDER.get() * errors.fold(0.0, f64::max)).max(ROUNDING)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::rad_per_s;
    use crate::modes::SpectralModel;

    /// A blade of an eighth of the thickness has reflected waves of many more than the ten diameters of the
    /// smallest basis below 1600 rpm. The inertia of the stiffness with 70 diameters and as many radial
    /// functions gives their number.
    #[test]
    fn a_basis_too_small_for_the_waves_below_a_speed_gives_way_to_a_larger_one() {
        let thin = Scene::paper()
            .edited(|saw| saw.blade.thickness_m /= 8.0)
            .unwrap();
        let top = rad_per_s(1600.0);
        let below =
            |critical: &[NamedCriticalSpeed]| critical.partition_point(|c| c.speed_rad_per_s < top);
        let exact = Assembled::from(Plate::new(&thin, resolution((70, LADDER[0].1))))
            .critical_speeds_below(top)
            .unwrap();
        let small_plate = Plate::new(&thin, resolution(LADDER[0]));
        let small = below(&SpectralModel::critical_speeds(&small_plate).unwrap());
        assert!(small < exact, "{small} {exact}");
        let (saw, critical) = resolved(&thin, resolution(LADDER[0]), top).unwrap();
        assert!(saw.plate.max_diameters() > LADDER[0].0);
        assert_eq!(below(&critical), exact);
    }
}
