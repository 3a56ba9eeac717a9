//! Choice of the basis for a tolerance.
//!
//! The edge of a pad bends the blade sharply, so the error of critical speeds falls with a power of the
//! number of functions that depends on the pad. The basis therefore grows until the functions of a size two
//! or three steps larger would change its critical speeds and its lowest frequencies at rest by less than the
//! tolerance.

use super::error::AnalysisError;
use super::ladder::{DENSE_LADDER, LADDER, ahead, larger_than, resolution, rung_of};
use crate::plate::{Plate, Resolution};
use crate::scene::{Blade, Material, Scene, rad_per_s, rpm};
use crate::spectrum::{
    Assembled, Cancellation, LargerBasis, NamedCriticalSpeed, RestingMode, SpectrumError, Work,
};
use crate::tuned::Tuned;

/// Factor for the estimated errors, because the larger basis has an error too. On 120 random saws, 60 of
/// which were not used to choose the factor, the true error was up to 1.9 times the estimate without it for
/// critical speeds of the chosen basis, and up to 2.3 times for frequencies at rest.
pub(super) const REMAINDER: Tuned = Tuned::new("stability/basis::REMAINDER", 2.5);
/// Number of modes at rest whose frequencies must keep the tolerance, as many as a chart shows.
pub(super) const MODES_AT_REST: usize = 12;
/// Fall of the error in one step of the ladder. In a quarter of all cases it was larger; sizes at which the
/// error would have to fall faster are skipped.
pub(super) const FALL: f64 = 4.0;
/// Strain of the rim above which a sweep is refused: ten times the yield strain of the strongest steel.
const LARGEST_STRETCH: f64 = 0.1;
/// Critical speeds are found up to this multiple of the end of the range, because the search near the end
/// must keep its distance from those just above it.
pub(super) const PAST_THE_RANGE: f64 = 1.05;
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
    pub range_rad_per_s: (f64, f64),
    /// Estimated relative error of the critical speeds within the range.
    pub estimated_relative_error: f64,
    /// Estimated relative error of the lowest frequencies at rest.
    pub estimated_resting_error: f64,
    /// Functions of a larger basis, for the estimated errors of other results.
    pub larger: LargerBasis,
}

impl ChosenBasis {
    /// Finds the smallest basis within a tolerance; the largest if none is.
    ///
    /// # Errors
    /// [`AnalysisError`] when an eigenproblem fails, when the blade would yield within the sweep, or when the
    /// largest basis does not contain all waves that are reflected within the sweep.
    pub fn new(scene: &Scene, tolerance: f64) -> Result<Self, AnalysisError> {
        Self::at_least(scene, tolerance, resolution(LADDER[0]))
    }

    /// Finds the smallest basis within a tolerance that has at least a given size, which a similar saw needed.
    /// Omitting the smaller sizes halves the time.
    ///
    /// # Errors
    /// The errors of [`ChosenBasis::new`].
    pub fn at_least(
        scene: &Scene,
        tolerance: f64,
        least: Resolution,
    ) -> Result<Self, AnalysisError> {
        let cancellation = Cancellation::current();
        if let Some(sweep) = scene.sweep() {
            check_stretch(scene.blade(), sweep.to_rad_per_s)?;
        }
        let mut rung = rung_of(least);
        let sizes = Work::of("sizes of the basis", LADDER.len() - rung);
        loop {
            cancellation.check()?;
            let saw = Assembled::from(Plate::new(scene, resolution(LADDER[rung])));
            let is_last = is_last(&saw, rung);
            let range = |lowest: Option<f64>| match scene.sweep() {
                Some(sweep) => (sweep.from_rad_per_s, sweep.to_rad_per_s),
                None => (0.0, chosen_end(scene, lowest)),
            };
            let top = |lowest: Option<f64>| PAST_THE_RANGE * range(lowest).1;
            let top_of_sweep = scene.sweep().map(|sweep| sweep.to_rad_per_s);
            if let Some(to) = top_of_sweep
                && is_too_small(&saw, to)
            {
                if !is_last {
                    rung += 1;
                    sizes.advance();
                    continue;
                }
                // Refused before anything else is computed on the largest basis.
                unresolved(&saw.plate, &contained_critical_speeds(&saw, &top)?, to)?;
            }
            let ((critical, resting), larger) = rayon::join(
                || {
                    rayon::join(
                        || contained_critical_speeds(&saw, &top),
                        || saw.modes_at_rest(MODES_AT_REST),
                    )
                },
                || LargerBasis::new(&saw.plate, &Plate::new(scene, ahead(rung))),
            );
            let critical = critical?;
            let range_rad_per_s = range(critical.first().map(|c| c.speed_rad_per_s));
            let resolved = unresolved(&saw.plate, &critical, range_rad_per_s.1);
            if resolved.is_err() && !is_last {
                rung += 1;
                sizes.advance();
                continue;
            }
            resolved?;
            let larger = larger?;
            let resting = resting_error(&resting?, &larger);
            let error = critical_error(&saw, &larger, &critical, range_rad_per_s.1);
            let excess = resting.max(error) / tolerance;
            if is_last || excess <= 1.0 {
                return Ok(ChosenBasis {
                    saw,
                    critical,
                    range_rad_per_s,
                    estimated_relative_error: error,
                    estimated_resting_error: resting,
                    larger,
                });
            }
            let larger = next(rung, excess);
            (rung..larger).for_each(|_| sizes.advance());
            rung = larger;
        }
    }
}

/// Whether no larger size of the ladder is possible for a saw.
pub(super) fn is_last(saw: &Assembled, rung: usize) -> bool {
    let is_within_reach = saw.is_structured() && saw.plate.is_conservative();
    let is_largest = rung + 1 >= DENSE_LADDER.len() && !is_within_reach;
    is_largest || rung + 1 == LADDER.len()
}

/// Index of the first size that may reduce an error of `excess` times the tolerance to the tolerance. The
/// largest size of dense eigenproblems is not skipped, because larger sizes are not possible for all saws.
fn next(rung: usize, excess: f64) -> usize {
    let steps = (excess.ln() / FALL.ln()).ceil().max(1.0) as usize;
    let dense = DENSE_LADDER.len() - 1;
    let last = if rung < dense {
        dense
    } else {
        LADDER.len() - 1
    };
    (rung + steps).min(last)
}

/// Assembles a saw with its critical speeds in a basis, or in the next larger one that contains the waves
/// reflected below a speed.
///
/// # Errors
/// [`AnalysisError`] when an eigenproblem fails, when the blade would yield below that speed, or when the
/// largest basis does not contain these waves.
pub(crate) fn resolved(
    scene: &Scene,
    least: Resolution,
    to_rad_per_s: f64,
) -> Result<(Assembled, Vec<NamedCriticalSpeed>), AnalysisError> {
    check_stretch(scene.blade(), to_rad_per_s)?;
    let mut larger = larger_than(least);
    let mut resolution = least;
    loop {
        let saw = Assembled::from(Plate::new(scene, resolution));
        let next = larger.next();
        if let Some(size) = next
            && is_too_small(&saw, to_rad_per_s)
        {
            resolution = size;
            continue;
        }
        let top = PAST_THE_RANGE * to_rad_per_s;
        let critical = contained_critical_speeds(&saw, &|_| top)?;
        match (unresolved(&saw.plate, &critical, to_rad_per_s), next) {
            (Ok(()), _) => return Ok((saw, critical)),
            (Err(_), Some(size)) => resolution = size,
            (Err(error), None) => return Err(error),
        }
    }
}

/// Largest estimated relative error of the lowest frequencies at rest.
fn resting_error(modes: &[RestingMode], larger: &LargerBasis) -> f64 {
    let errors = modes.iter().map(|mode| larger.resting_error(mode));
    REMAINDER.get() * errors.fold(0.0, f64::max)
}

/// Largest estimated relative error of the critical speeds up to a speed, and of the first.
fn critical_error(
    saw: &Assembled,
    larger: &LargerBasis,
    critical: &[NamedCriticalSpeed],
    to_rad_per_s: f64,
) -> f64 {
    let within = critical.partition_point(|c| c.speed_rad_per_s <= to_rad_per_s);
    let errors = critical.iter().take(within.max(1));
    let errors = errors.map(|c| larger.critical_error(&saw.components, c));
    (REMAINDER.get() * errors.fold(0.0, f64::max)).max(ROUNDING)
}

/// Refuses a basis for speeds above the critical speed of its waves with most nodal diameters: there, waves with
/// more diameters would be reflected too. The basis does not contain them, so the chart would be wrong without
/// a warning.
///
/// # Errors
/// [`AnalysisError::Unresolved`].
fn unresolved(
    plate: &Plate,
    critical: &[NamedCriticalSpeed],
    to_rad_per_s: f64,
) -> Result<(), AnalysisError> {
    let last = plate.max_diameters();
    let all_pairs = critical.get(last_of_all_pairs(plate));
    let most_diameters = critical.iter().find(|c| c.name.diameters() == last);
    let highest = [all_pairs, most_diameters].into_iter().flatten();
    let highest = highest.min_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
    match highest {
        Some(c) if c.speed_rad_per_s < to_rad_per_s => Err(AnalysisError::Unresolved {
            to_rpm: rpm(to_rad_per_s),
            limit_rpm: rpm(c.speed_rad_per_s),
            diameters: plate.max_diameters(),
        }),
        _ => Ok(()),
    }
}

/// Whether more critical speeds are below a speed than a basis may contain. The inertia of the stiffness gives
/// their number without computing hundreds of them, which takes far longer.
fn is_too_small(saw: &Assembled, to_rad_per_s: f64) -> bool {
    let counted = saw.critical_speeds_below(to_rad_per_s);
    counted.is_some_and(|count| count > last_of_all_pairs(&saw.plate))
}

/// Critical speeds up to a limit that may depend on the lowest one, hardly more than the basis may contain.
fn contained_critical_speeds(
    saw: &Assembled,
    top_rad_per_s: &dyn Fn(Option<f64>) -> f64,
) -> Result<Vec<NamedCriticalSpeed>, SpectrumError> {
    let limit = |found: &[f64]| {
        let top = top_rad_per_s(found.first().copied());
        let all_pairs = found.get(last_of_all_pairs(&saw.plate));
        all_pairs.map_or(top, |speed| top.min(PAST_THE_RANGE * speed))
    };
    saw.critical_speeds(Some(&limit))
}

/// Index of the last critical speed that a basis may contain below the end of a range. Stiff guides mix
/// waves, so that a name gives no certainty, but each n ≥ 2 has two critical speeds, and the second one of
/// the largest n is the last.
pub(super) fn last_of_all_pairs(plate: &Plate) -> usize {
    (2 * plate.max_diameters()).saturating_sub(3)
}

/// Speed at which rotation stretches the rim of a free ring, by ρ(Ωb)²/E, more than any linear elastic blade
/// tolerates. Without this bound, the chart of a blade nearly as thick as wide would contain dozens of critical
/// speeds that the blade cannot reach.
fn fastest_rad_per_s(blade: &Blade) -> f64 {
    let Material {
        youngs_modulus_pa,
        density_kg_per_m3,
        ..
    } = blade.material;
    (LARGEST_STRETCH * youngs_modulus_pa / density_kg_per_m3).sqrt() / blade.outer_radius_m
}

/// Refuses a sweep that ends above [`fastest_rad_per_s`].
///
/// # Errors
/// [`AnalysisError::Overstretched`].
pub(super) fn check_stretch(blade: &Blade, to_rad_per_s: f64) -> Result<(), AnalysisError> {
    let fastest = fastest_rad_per_s(blade);
    match to_rad_per_s > fastest {
        true => Err(AnalysisError::Overstretched {
            to_rpm: rpm(to_rad_per_s),
            limit_rpm: rpm(fastest),
        }),
        false => Ok(()),
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
            Ok(chosen.range_rad_per_s.1)
        }
    }
}

/// End of the sweep, in rad/s, if the scene gives none: twice the lowest critical speed, but at most
/// [`fastest_rad_per_s`].
pub(crate) fn chosen_end(scene: &Scene, lowest_critical_rad_per_s: Option<f64>) -> f64 {
    default_top(lowest_critical_rad_per_s).min(fastest_rad_per_s(scene.blade()))
}

/// A speed in rpm rounded down to two digits.
pub(super) fn two_digits_down(rpm: f64) -> f64 {
    let digit = 10_f64.powf(rpm.log10().floor() - 1.0);
    (rpm / digit).floor() * digit
}

/// Twice the lowest critical speed, rounded up to two digits in rpm; 2000 rpm without a critical speed.
fn default_top(lowest_rad_per_s: Option<f64>) -> f64 {
    let lowest = lowest_rad_per_s.map_or(1000.0, rpm);
    let digit = 10_f64.powf((2.0 * lowest).log10().floor() - 1.0);
    rad_per_s((2.0 * lowest / digit).ceil() * digit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::SpeedRange;
    use crate::spectrum::SpectralModel;
    use crate::stability::{Analysis, AnalysisOptions};

    /// A blade of an eighth of the thickness has reflected waves of many more than the ten diameters of the
    /// smallest basis below 1600 rpm. The inertia of the stiffness on the largest basis gives their number.
    #[test]
    fn a_basis_too_small_for_the_waves_below_a_speed_gives_way_to_a_larger_one() {
        let thin = Scene::paper().edited(|saw| saw.blade.thickness_m /= 8.0);
        let thin = thin.unwrap();
        let top = rad_per_s(1600.0);
        let below =
            |critical: &[NamedCriticalSpeed]| critical.partition_point(|c| c.speed_rad_per_s < top);
        let exact = Assembled::from(Plate::new(&thin, resolution(LADDER[LADDER.len() - 1])));
        let exact = exact.critical_speeds_below(top).unwrap();
        let small = Plate::new(&thin, resolution(LADDER[0]));
        let small = below(&SpectralModel::critical_speeds(&small).unwrap());
        assert!(small < exact, "{small} {exact}");
        let (saw, critical) = resolved(&thin, resolution(LADDER[0]), top).unwrap();
        assert!(saw.plate.max_diameters() > LADDER[0].0);
        assert_eq!(below(&critical), exact);
    }

    /// The largest basis has waves of up to 70 diameters, of which a blade of a tenth of the thickness has more below half
    /// of the speed at which it would be torn. No expected work is announced.
    #[test]
    fn a_sweep_that_no_basis_contains_is_refused_without_an_estimate_of_the_work() {
        let sweep = SpeedRange {
            from_rad_per_s: 0.0,
            to_rad_per_s: rad_per_s(20_000.0),
        };
        let thin = Scene::paper().edited(|saw| {
            saw.guides.clear();
            saw.blade.thickness_m /= 10.0;
        });
        let thin = thin.unwrap().swept(sweep).unwrap();
        let told = std::sync::atomic::AtomicBool::new(false);
        let tell = |_| told.store(true, std::sync::atomic::Ordering::Relaxed);
        let options = AnalysisOptions {
            expected: Some(&tell),
            ..AnalysisOptions::default()
        };
        match Analysis::with_options(&thin, options) {
            Err(AnalysisError::Unresolved { diameters, .. }) => assert_eq!(diameters, 70),
            other => panic!("{other:?}"),
        }
        assert!(!told.into_inner());
    }

    /// Hoop strain ρ(Ωb)²/E of the paper's blade: 0.1 at 43 400 rpm.
    #[test]
    fn no_sweep_goes_to_where_the_blade_would_be_torn() {
        let torn = Scene::paper().swept(SpeedRange {
            from_rad_per_s: 0.0,
            to_rad_per_s: rad_per_s(43_500.0),
        });
        match ChosenBasis::new(&torn.unwrap(), 1e-2) {
            Err(AnalysisError::Overstretched { limit_rpm, .. }) => {
                assert!((limit_rpm - 43_400.0).abs() < 50.0, "{limit_rpm}");
            }
            other => panic!("{other:?}"),
        }
        // A blade nearly as thick as wide would burst before its first critical speed.
        let thick = Scene::paper().edited(|saw| {
            saw.sweep = None;
            saw.blade.thickness_m = 0.25;
        });
        let scene = thick.unwrap();
        let chosen = ChosenBasis::new(&scene, 1e-2).unwrap();
        assert_eq!(chosen.range_rad_per_s.1, fastest_rad_per_s(scene.blade()));
        assert!(chosen.critical[0].speed_rad_per_s > chosen.range_rad_per_s.1);
    }
}
