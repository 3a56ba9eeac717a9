//! How large a basis a tolerance takes.
//!
//! A pad's edges bend the blade more sharply than any series follows at once: the error of
//! critical speeds falls with a power of the number of functions that depends on the pad.
//! So the basis grows until the differences between three sizes, extrapolated, say that
//! what is left is below the tolerance. Each size takes one symmetric eigenproblem. The size
//! found is then asked for the lowest modes at rest too, and what the functions of a size two
//! steps larger would change of them is measured: it must be below the tolerance as well.

use super::error::AnalysisError;
use crate::plate::{Plate, Resolution};
use crate::scene::{Blade, Material, Scene, rad_per_s, rpm};
use crate::spectrum::{Assembled, Cancellation, LargerBasis, NamedCriticalSpeed, SpectralModel};
use crate::tuned::Tuned;

/// (n_max, J), each about 1.5 times as large as the one before.
pub(super) const LADDER: [(usize, usize); 14] = [
    (4, 3),
    (6, 4),
    (8, 5),
    (10, 6),
    (12, 7),
    (14, 9),
    (18, 10),
    (23, 11),
    (30, 12),
    (34, 15),
    (40, 18),
    (48, 21),
    (56, 25),
    (70, 30),
];
/// So many of them are within reach of eigenproblems of their order; the others take the structure of a guided
/// blade, or the harmonics of a free one.
pub(crate) const DENSE_LADDER: &[(usize, usize)] = LADDER.split_at(9).0;
/// Sizes that only measure what the largest of the ladder leave out.
const BEYOND: [(usize, usize); 2] = [(80, 34), (90, 38)];
/// Steps of the ladder from a size to the one that its error is measured against: more for the
/// small ones, which cost nothing and converge slowly at first.
const fn steps_ahead(rung: usize) -> usize {
    if rung <= 4 { 3 } else { 2 }
}
/// What that size leaves out in its turn: on ten drawn saws the true error was up to 2.5 times
/// what two steps ahead tell, on the smallest sizes.
pub(super) const REMAINDER: Tuned = Tuned::new("stability/basis::REMAINDER", 1.8);
/// Modes at rest that keep the tolerance: those that a chart shows.
pub(super) const MODES_AT_REST: usize = 12;
/// The error is taken to fall by a factor between these from one size to the next. Over
/// pads of 1e4 to 1e9 N/m and bores of 0.1 to 0.8 it did so by 0.01 to 0.75; where it
/// falls faster, the estimate is too large, which is harmless.
const FALL: (f64, f64) = (0.5, 0.8);
/// What extrapolation gives was up to 2.1 times too small on thirty saws, and up to 3.2 times
/// on the first fifteen of the others in `tests/convergence/tolerance.rs`.
const SAFETY: Tuned = Tuned::new("stability/basis::SAFETY", 4.0);
/// Ten times the strain at which the strongest steel yields.
const LARGEST_STRETCH: Tuned = Tuned::new("stability/basis::LARGEST_STRETCH", 0.1);
/// Critical speeds up to this multiple of the end of the range are found: what is searched near its end is
/// kept away from those just above it.
pub(super) const PAST_THE_RANGE: f64 = 1.05;
/// Differences below this are the rounding of the eigenproblem.
const ROUNDING: f64 = 1e-10;

/// The smallest basis that meets a tolerance, its critical speeds and estimated errors.
#[derive(Debug)]
pub struct ChosenBasis {
    /// The plate in this basis.
    pub plate: Plate,
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
        let cancellation = Cancellation::current();
        let fastest = fastest_rad_per_s(scene.blade());
        if let Some(sweep) = scene.sweep().filter(|sweep| sweep.to_rad_per_s > fastest) {
            return Err(AnalysisError::Overstretched {
                to_rpm: rpm(sweep.to_rad_per_s),
                limit_rpm: rpm(fastest),
            });
        }
        let mut differences: Vec<f64> = Vec::new();
        let mut previous: Option<Vec<NamedCriticalSpeed>> = None;
        for (rung, (max_diameters, radial_functions)) in LADDER.into_iter().enumerate() {
            cancellation.check()?;
            let resolution = Resolution {
                max_diameters,
                radial_functions,
            };
            let plate = Plate::new(scene, resolution);
            let assembled = Assembled::of(&plate);
            let is_within_reach = assembled.is_structured() && plate.is_conservative();
            let is_largest = rung + 1 >= DENSE_LADDER.len() && !is_within_reach;
            let last = is_largest || rung + 1 == LADDER.len();
            let range = |lowest: Option<f64>| match scene.sweep() {
                Some(sweep) => (sweep.from_rad_per_s, sweep.to_rad_per_s),
                None => (0.0, default_top(lowest).min(fastest)),
            };
            let limit = |lowest: f64| PAST_THE_RANGE * range(Some(lowest)).1;
            let critical = assembled.critical_speeds(&plate, Some(&limit))?;
            let range = range(critical.first().map(|c| c.speed_rad_per_s));
            if let Some(coarser) = &previous {
                differences.push(difference(coarser, &critical, range.1));
            }
            let estimated = match differences.as_slice() {
                [.., before, latest] => extrapolated(*before, *latest),
                _ => f64::INFINITY,
            };
            let resolved = unresolved(&plate, &critical, range.1);
            if last || (estimated <= tolerance && resolved.is_ok()) {
                resolved?;
                let larger = LargerBasis::new(&plate, &Plate::new(scene, ahead(rung)))?;
                let resting = resting_error(&assembled, &larger)?;
                if last || resting <= tolerance {
                    return Ok(ChosenBasis {
                        plate,
                        critical,
                        range_rad_per_s: range,
                        estimated_relative_error: estimated,
                        estimated_resting_error: resting,
                        larger,
                    });
                }
            }
            previous = Some(critical);
        }
        unreachable!("the last rung returns")
    }
}

/// A saw in a basis and its critical speeds, or in the next larger basis that holds the waves
/// which are reflected below a speed.
///
/// # Errors
/// [`AnalysisError`] when an eigenproblem fails, when the blade is not elastic at that speed any
/// more, or when the largest basis does not hold these waves.
pub(crate) fn resolved_plate(
    scene: &Scene,
    least: Resolution,
    to_rad_per_s: f64,
) -> Result<(Plate, Vec<NamedCriticalSpeed>), AnalysisError> {
    let fastest = fastest_rad_per_s(scene.blade());
    if to_rad_per_s > fastest {
        return Err(AnalysisError::Overstretched {
            to_rpm: rpm(to_rad_per_s),
            limit_rpm: rpm(fastest),
        });
    }
    let larger = LADDER.into_iter();
    let mut larger = larger.filter(|(max_diameters, _)| *max_diameters > least.max_diameters);
    let mut resolution = least;
    loop {
        let plate = Plate::new(scene, resolution);
        let critical = SpectralModel::critical_speeds_up_to(&plate, PAST_THE_RANGE * to_rad_per_s)?;
        match (unresolved(&plate, &critical, to_rad_per_s), larger.next()) {
            (Ok(()), _) => return Ok((plate, critical)),
            (Err(_), Some((max_diameters, radial_functions))) => {
                resolution = Resolution {
                    max_diameters,
                    radial_functions,
                }
            }
            (Err(error), None) => return Err(error),
        }
    }
}

/// The size that the error of a size of the ladder is measured against.
pub(super) fn ahead(rung: usize) -> Resolution {
    let mut sizes = LADDER
        .into_iter()
        .chain(BEYOND)
        .skip(rung + steps_ahead(rung));
    let (max_diameters, radial_functions) = sizes.next().unwrap_or(BEYOND[1]);
    Resolution {
        max_diameters,
        radial_functions,
    }
}

/// Largest estimated relative error of the lowest frequencies at rest.
fn resting_error(assembled: &Assembled, larger: &LargerBasis) -> Result<f64, AnalysisError> {
    let modes = assembled.modes_at_rest(MODES_AT_REST)?;
    let errors = modes.iter().map(|mode| larger.resting_error(mode));
    Ok(REMAINDER.get() * errors.fold(0.0, f64::max))
}

/// What is left after two differences that fall like a geometric series, with a margin.
fn extrapolated(before: f64, latest: f64) -> f64 {
    let fall = (latest / before.max(f64::MIN_POSITIVE)).clamp(FALL.0, FALL.1);
    (SAFETY.get() * latest * fall / (1.0 - fall)).max(ROUNDING)
}

/// Largest relative difference of the critical speeds up to a speed, and of the first.
fn difference(coarse: &[NamedCriticalSpeed], fine: &[NamedCriticalSpeed], to: f64) -> f64 {
    let count = fine.partition_point(|c| c.speed_rad_per_s <= to).max(1);
    let missing = if coarse.len() < count.min(fine.len()) {
        1.0
    } else {
        0.0
    };
    let pairs = fine.iter().zip(coarse).take(count);
    pairs
        .map(|(x, y)| (y.speed_rad_per_s / x.speed_rad_per_s - 1.0).abs())
        .fold(missing, f64::max)
}

/// Past the critical speed of the waves of most diameters those of more, which the basis
/// lacks, would be reflected too: the chart would be wrong without a sign of it.
fn unresolved(
    plate: &Plate,
    critical: &[NamedCriticalSpeed],
    to_rad_per_s: f64,
) -> Result<(), AnalysisError> {
    let last = plate.max_diameters();
    // Stiff guides mix the waves beyond recognition; but there are two of each n ≥ 2, and the
    // second of the most diameters is the last of them.
    let all_pairs = critical.get((2 * last).saturating_sub(3));
    let most_diameters = critical.iter().find(|c| c.diameters == last);
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

/// Speed at which the rotation stretches the rim of a free ring, by ρ(Ωb)²/E, beyond what
/// any linear elastic blade bears. Without this bound the chart of a blade nearly as thick as
/// wide would pass dozens of critical speeds that no such blade lives to see.
fn fastest_rad_per_s(blade: &Blade) -> f64 {
    let Material {
        youngs_modulus_pa,
        density_kg_per_m3,
        ..
    } = blade.material;
    (LARGEST_STRETCH.get() * youngs_modulus_pa / density_kg_per_m3).sqrt() / blade.outer_radius_m
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

    /// Errors 1, 0.6, 0.36 … have differences 0.4, 0.24 and leave 0.36.
    #[test]
    fn a_geometric_series_is_extrapolated_to_its_limit() {
        assert!((extrapolated(0.4, 0.24) - SAFETY.get() * 0.36).abs() < 1e-15);
    }

    /// A blade of a third of the thickness reflects the waves of many more diameters below
    /// 2400 rpm than the four of the least basis; the largest basis says how many.
    #[test]
    fn a_basis_too_small_for_the_waves_below_a_speed_gives_way_to_a_larger_one() {
        let thin = Scene::paper().edited(|saw| saw.blade.thickness_m /= 3.0);
        let thin = thin.unwrap();
        let top = rad_per_s(2400.0);
        let basis = |(max_diameters, radial_functions)| Resolution {
            max_diameters,
            radial_functions,
        };
        let below =
            |critical: &[NamedCriticalSpeed]| critical.partition_point(|c| c.speed_rad_per_s < top);
        let exact = Plate::new(&thin, basis(LADDER[LADDER.len() - 1]));
        let exact = below(&SpectralModel::critical_speeds(&exact).unwrap());
        let small = Plate::new(&thin, basis(LADDER[0]));
        let small = below(&SpectralModel::critical_speeds(&small).unwrap());
        assert!(small < exact, "{small} {exact}");
        let (plate, critical) = resolved_plate(&thin, basis(LADDER[0]), top).unwrap();
        assert!(plate.max_diameters() > LADDER[0].0);
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
