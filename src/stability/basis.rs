//! How large a basis a tolerance takes.
//!
//! A pad's edges bend the blade more sharply than any series follows at once: the error of
//! critical speeds falls with a power of the number of functions that depends on the pad.
//! So the basis grows until what the functions of a size two or three steps larger would change of its critical speeds and
//! of its lowest frequencies at rest is below the tolerance.

use super::error::AnalysisError;
use super::ladder::{DENSE_LADDER, LADDER, ahead, larger_than, resolution, rung_of};
use crate::plate::{Plate, Resolution};
use crate::scene::{Blade, Material, Scene, rad_per_s, rpm};
use crate::spectrum::{
    Assembled, Cancellation, LargerBasis, NamedCriticalSpeed, RestingMode, SpectrumError, Work,
};
use crate::tuned::Tuned;

/// What a larger basis leaves out in its turn: on 120 drawn saws, 60 of them with no part in it, the true error was up to 1.9 times
/// what its functions tell of the critical speeds of the basis that was chosen, and up to 2.3 times of frequencies at rest.
pub(super) const REMAINDER: Tuned = Tuned::new("stability/basis::REMAINDER", 2.5);
/// Modes at rest that keep the tolerance: those that a chart shows.
pub(super) const MODES_AT_REST: usize = 12;
/// One step of the ladder took more than this factor off the error in a quarter of all cases: sizes that it says are too
/// small are not tried.
const FALL: f64 = 4.0;
/// Ten times the strain at which the strongest steel yields.
const LARGEST_STRETCH: f64 = 0.1;
/// Critical speeds up to this multiple of the end of the range are found: what is searched near its end is
/// kept away from those just above it.
pub(super) const PAST_THE_RANGE: f64 = 1.05;
/// Errors below this are the rounding of the eigenproblem.
const ROUNDING: f64 = 1e-10;

/// The smallest basis that meets a tolerance, its critical speeds and estimated errors.
#[derive(Debug)]
pub struct ChosenBasis {
    /// The saw in this basis.
    pub saw: Assembled,
    /// The critical speeds up to a little above the range, and the lowest; ascending.
    pub critical: Vec<NamedCriticalSpeed>,
    /// Speeds of the chart.
    pub range_rad_per_s: (f64, f64),
    /// Estimated relative error of the critical speeds within the range.
    pub estimated_relative_error: f64,
    /// Estimated relative error of the lowest frequencies at rest.
    pub estimated_resting_error: f64,
    /// Functions that this basis lacks, to measure the error of other results by.
    pub larger: LargerBasis,
}

impl ChosenBasis {
    /// The smallest basis that meets a tolerance, or else the largest there is.
    ///
    /// # Errors
    /// [`AnalysisError`] when an eigenproblem fails, when the sweep ends where the blade is
    /// not elastic any more, or when the largest basis does not hold the waves that are
    /// reflected within it.
    pub fn new(scene: &Scene, tolerance: f64) -> Result<Self, AnalysisError> {
        Self::at_least(scene, tolerance, resolution(LADDER[0]))
    }

    /// The same of the sizes from one on that a saw much like this one took: without the smaller ones, which this saw
    /// would hardly do with, it costs half.
    ///
    /// # Errors
    /// Those of [`ChosenBasis::new`].
    pub fn at_least(
        scene: &Scene,
        tolerance: f64,
        least: Resolution,
    ) -> Result<Self, AnalysisError> {
        let cancellation = Cancellation::current();
        let fastest = fastest_rad_per_s(scene.blade());
        if let Some(sweep) = scene.sweep().filter(|sweep| sweep.to_rad_per_s > fastest) {
            return Err(AnalysisError::Overstretched {
                to_rpm: rpm(sweep.to_rad_per_s),
                limit_rpm: rpm(fastest),
            });
        }
        let mut rung = rung_of(least);
        let sizes = Work::of("sizes of the basis", LADDER.len() - rung);
        loop {
            cancellation.check()?;
            let saw = Assembled::from(Plate::new(scene, resolution(LADDER[rung])));
            let is_within_reach = saw.is_structured() && saw.plate.is_conservative();
            let is_largest = rung + 1 >= DENSE_LADDER.len() && !is_within_reach;
            let is_last = is_largest || rung + 1 == LADDER.len();
            let range = |lowest: Option<f64>| match scene.sweep() {
                Some(sweep) => (sweep.from_rad_per_s, sweep.to_rad_per_s),
                None => (0.0, chosen_end(scene, lowest)),
            };
            let top = |lowest: Option<f64>| PAST_THE_RANGE * range(lowest).1;
            let top_of_sweep = scene.sweep().map(|sweep| sweep.to_rad_per_s);
            if !is_last && top_of_sweep.is_some_and(|to| is_too_small(&saw, to)) {
                rung += 1;
                sizes.advance();
                continue;
            }
            let ((critical, resting), larger) = rayon::join(
                || {
                    rayon::join(
                        || held_critical_speeds(&saw, &top),
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

/// The first size at which an error so many times too large may be small enough. What is within reach beyond the sizes of
/// dense eigenproblems shows at the largest of these.
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

/// A saw in a basis and its critical speeds, or in the next larger basis that holds the waves
/// which are reflected below a speed.
///
/// # Errors
/// [`AnalysisError`] when an eigenproblem fails, when the blade is not elastic at that speed any
/// more, or when the largest basis does not hold these waves.
pub(crate) fn resolved(
    scene: &Scene,
    least: Resolution,
    to_rad_per_s: f64,
) -> Result<(Assembled, Vec<NamedCriticalSpeed>), AnalysisError> {
    let fastest = fastest_rad_per_s(scene.blade());
    if to_rad_per_s > fastest {
        return Err(AnalysisError::Overstretched {
            to_rpm: rpm(to_rad_per_s),
            limit_rpm: rpm(fastest),
        });
    }
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
        let critical = held_critical_speeds(&saw, &|_| top)?;
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

/// The same of the critical speeds up to a speed, and of the first.
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

/// Past the critical speed of the waves of most diameters those of more, which the basis
/// lacks, would be reflected too: the chart would be wrong without a sign of it.
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

/// Whether more critical speeds lie below a speed than a basis may hold, where the inertia of the stiffness tells
/// their number: finding hundreds of them takes far longer.
fn is_too_small(saw: &Assembled, to_rad_per_s: f64) -> bool {
    let counted = saw.critical_speeds_below(to_rad_per_s);
    counted.is_some_and(|count| count > last_of_all_pairs(&saw.plate))
}

/// The critical speeds up to one that may depend on the lowest, no more of them than the basis may hold.
fn held_critical_speeds(
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

/// Index of the last critical speed that a basis may hold below the end of a range. Stiff guides mix the waves beyond
/// recognition; but there are two of each n ≥ 2, and the second of the most diameters is the last of them.
pub(super) fn last_of_all_pairs(plate: &Plate) -> usize {
    (2 * plate.max_diameters()).saturating_sub(3)
}

/// Speed at which the rotation stretches the rim of a free ring, by ρ(Ωb)²/E, beyond what
/// any linear elastic blade bears. Without this bound the chart of a blade nearly as thick as
/// wide would pass dozens of critical speeds that no such blade lives to see.
fn fastest_rad_per_s(blade: &Blade) -> f64 {
    let Material {
        youngs_modulus_pa,
        density_kg_per_m3,
        ..
    } = blade.material;
    (LARGEST_STRETCH * youngs_modulus_pa / density_kg_per_m3).sqrt() / blade.outer_radius_m
}

/// Where the sweep of a scene ends, as typed or as the program chooses it, in rad/s.
///
/// # Errors
/// Those of [`ChosenBasis::new`], where it is the program's choice.
pub(crate) fn end_of_sweep(scene: &Scene) -> Result<f64, AnalysisError> {
    match scene.sweep() {
        Some(sweep) => Ok(sweep.to_rad_per_s),
        None => {
            let chosen = ChosenBasis::new(scene, scene.tolerance())?;
            Ok(chosen.range_rad_per_s.1)
        }
    }
}

/// Where the program ends a sweep that the scene does not, in rad/s: at twice the lowest critical speed, or where no blade is
/// elastic any more.
pub(crate) fn chosen_end(scene: &Scene, lowest_critical_rad_per_s: Option<f64>) -> f64 {
    default_top(lowest_critical_rad_per_s).min(fastest_rad_per_s(scene.blade()))
}

/// A speed in rpm rounded down to two digits.
pub(super) fn two_digits_down(rpm: f64) -> f64 {
    let digit = 10_f64.powf(rpm.log10().floor() - 1.0);
    (rpm / digit).floor() * digit
}

/// Twice the lowest critical speed, rounded up to two digits.
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

    /// A blade of an eighth of the thickness reflects the waves of many more diameters below
    /// 1600 rpm than the ten of the least basis; the inertia of the largest basis says how many.
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

    /// Hoop strain ρ(Ωb)²/E of the paper's blade: a tenth at 43 400 rpm.
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
        // A blade nearly as thick as wide would be torn before its first critical speed.
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
