//! The speeds of which a report speaks, and the nodal diameters of the waves that stand still up to them.
//!
//! A wave that the basis lacks would make a chart wrong without a warning if it could stand still in space within
//! the sweep or below the first critical speed found. The waves of the free blade ([`StandingWaves`]) are cheap and
//! tell how many diameters there are. Guides only raise critical speeds; other loads (cutting forces) may lower them,
//! and then the first critical speed tells by how much.

use super::error::{AnalysisError, END_OF_SWEEP, TORN};
use super::ladder::{DENSE_LADDER, LADDER, resolution};
use crate::model::plate::{MOST_DIAMETERS, MOST_UNKNOWNS, Plate, Resolution};
use crate::model::scene::{Blade, Material, RefusedValue, Scene, SpeedRange, rad_per_s, rpm};
use crate::modes::{
    ABOVE_LAST, Assembled, NamedCriticalSpeed, RestingMode, SpectrumError, StandingWaves,
    diameters_within, highest_reflected,
};
use crate::page::text::rounded_between;

/// Strain of the rim above which a sweep is refused: ten times the yield strain of the strongest steel.
const LARGEST_STRETCH: f64 = 0.1;
/// Critical speeds are found up to this multiple of the end of the range, because the search near the end
/// must keep its distance from those just above it.
pub(crate) const PAST_THE_RANGE: f64 = 1.05;
/// A sweep that the program chooses contains at most this number of critical speeds. Blades with a flange up to 0.7
/// of their diameter have fewer below twice the lowest one; with larger flanges, waves of dozens of diameters stand
/// still at nearly the same speed.
pub(crate) const CHARTED: usize = 40;

/// Taken for the first critical speed of a blade without one.
const ASSUMED_CRITICAL_RPM: f64 = 1000.0;
/// A sweep that the program chooses goes on to this multiple of the operating speed, so that a critical speed within 5 % of it is seen.
const ABOVE_OPERATING: f64 = 1.05;
/// A sweep that the program chooses goes on to at most this multiple of the first critical speed: a saw with two pads takes 1.6 s to
/// twice, 2.8 s to 2.4 times and 66 s to 4.8 times that speed.
const FARTHEST: f64 = 3.0;

/// A sweep may contain standing waves of this number of nodal diameters more than that of the first critical speed:
/// any two of them may couple, so that the work grows with a high power of their number.
pub(super) const SWEPT: usize = 70;

/// Speeds of which a report of a scene speaks.
#[derive(Debug)]
pub struct Reach<'a> {
    scene: &'a Scene,
    /// Critical speeds of a basis may be too high by this share.
    tolerance: f64,
}

/// Numbers of nodal diameters that a basis needs.
#[derive(Debug, Clone, Copy)]
pub struct Needed {
    /// Largest number of diameters of a wave that stands still up to `to_rad_per_s`.
    pub diameters: usize,
    /// Speed up to which waves were searched.
    pub to_rad_per_s: f64,
    /// First critical speed of the free blade.
    lowest_rad_per_s: Option<f64>,
}

impl<'a> Reach<'a> {
    /// The speeds of a scene.
    ///
    /// # Errors
    /// [`AnalysisError::Overstretched`].
    pub fn of(scene: &'a Scene, tolerance: f64) -> Result<Self, AnalysisError> {
        if let Some(sweep) = scene.sweep() {
            check_stretch(scene.blade(), sweep.to_rad_per_s)?;
        }
        Ok(Reach { scene, tolerance })
    }

    /// Range of the chart, from the scene or chosen by the program, for critical speeds that ascend.
    pub fn range(&self, critical_rad_per_s: &[f64]) -> SpeedRange {
        let chosen = || SpeedRange::new(0.0, chosen_end(self.scene, critical_rad_per_s));
        self.scene.sweep().unwrap_or_else(chosen)
    }

    /// The highest speed that matters: the end of the range, the first critical speed, and the one that ends a
    /// sweep that the program chooses.
    pub fn last(&self, critical_rad_per_s: &[f64]) -> f64 {
        let end = self.range(critical_rad_per_s).to_rad_per_s;
        let lowest = critical_rad_per_s.first();
        let next = match self.scene.sweep() {
            None if is_cut_short(self.scene, critical_rad_per_s) => critical_rad_per_s.get(CHARTED),
            _ => None,
        };
        [lowest, next]
            .into_iter()
            .flatten()
            .fold(end, |x, y| x.max(*y))
    }

    /// Diameters needed by the free blade of a saw.
    ///
    /// # Errors
    /// [`AnalysisError::Unresolved`], [`AnalysisError::TooNarrow`] and failed eigenproblems.
    pub fn of_free_blade(&self, saw: &Assembled) -> Result<Needed, AnalysisError> {
        self.needed(saw, &|found| (1.0 + self.tolerance) * self.last(found))
    }

    /// Diameters needed by a saw with known critical speeds, ascending, on a basis of all those of its free blade.
    ///
    /// # Errors
    /// The errors of [`Reach::of_free_blade`].
    pub fn of_saw(
        &self,
        saw: &Assembled,
        critical: &[NamedCriticalSpeed],
        free: Needed,
    ) -> Result<Needed, AnalysisError> {
        let speeds = speeds(critical);
        let last = self.last(&speeds);
        let lowest = free.lowest_rad_per_s.zip(speeds.first());
        let lowered = lowest.map_or(1.0, |(free, own)| f64::max(free / own, 1.0));
        let top = lowered * (1.0 + self.tolerance) * last;
        let needed = if top > free.to_rad_per_s {
            self.needed(saw, &|_| top)?
        } else {
            free
        };
        Ok(Needed {
            to_rad_per_s: last,
            ..needed
        })
    }

    /// Diameters of the waves in the window of the diagram and of the search for bands: up to the highest of the modes
    /// at rest, or the highest reflected wave at the end of the range, which guides lower.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn of_window(
        &self,
        plate: &Plate,
        range: SpeedRange,
        resting: &[RestingMode],
    ) -> Result<usize, SpectrumError> {
        let drawn = resting
            .last()
            .map_or(0.0, |mode| ABOVE_LAST * mode.frequency_rad_per_s);
        let window = drawn.max(highest_reflected(plate, range.to_rad_per_s)?);
        Ok(diameters_within(plate, range.to_rad_per_s, window))
    }

    fn needed(
        &self,
        saw: &Assembled,
        limit: &dyn Fn(&[f64]) -> f64,
    ) -> Result<Needed, AnalysisError> {
        let waves = StandingWaves::up_to(&saw.plate, limit)?;
        let needed = Needed {
            diameters: waves.most_diameters,
            to_rad_per_s: limit(&waves.speeds_rad_per_s),
            lowest_rad_per_s: waves.speeds_rad_per_s.first().copied(),
        };
        let blocks = most_unknowns(saw) / LADDER[0].1;
        let most = ((blocks - 1) / 2).min(SWEPT + waves.lowest_diameters);
        if needed.diameters > most {
            self.check_sweep(saw, most.min(MOST_DIAMETERS))?;
        }
        if needed.diameters > MOST_DIAMETERS {
            Err(AnalysisError::TooNarrow {
                diameters: needed.diameters,
            })
        } else {
            Ok(needed)
        }
    }

    /// Whether a basis is within the largest that is possible for a saw.
    pub fn fits(&self, saw: &Assembled, size: Resolution) -> bool {
        size.max_diameters <= MOST_DIAMETERS && size.degrees_of_freedom() <= most_unknowns(saw)
    }

    /// Refuses a sweep within which waves of more than `most` nodal diameters stand still.
    ///
    /// # Errors
    /// [`AnalysisError::Unresolved`].
    fn check_sweep(&self, saw: &Assembled, most: usize) -> Result<(), AnalysisError> {
        let Some(sweep) = self.scene.sweep() else {
            return Ok(());
        };
        match StandingWaves::lowest_beyond(most, &saw.plate)? {
            Some(lowest) if lowest <= sweep.to_rad_per_s => Err(AnalysisError::Unresolved {
                key: END_OF_SWEEP,
                to_rpm: rpm(sweep.to_rad_per_s),
                limit_rpm: rpm(lowest),
                diameters: most + 1,
            }),
            _ => Ok(()),
        }
    }
}

/// Largest number of unknowns for a saw. Dense eigenproblems need more memory and time than the structure of a
/// guided blade, which damping and loads at the rim destroy, or the harmonics of a free one.
fn most_unknowns(saw: &Assembled) -> usize {
    let plate = &saw.plate;
    let is_structured = || plate.is_conservative() && saw.may_be_structured();
    if plate.is_axisymmetric() || is_structured() {
        MOST_UNKNOWNS
    } else {
        resolution(DENSE_LADDER[DENSE_LADDER.len() - 1]).degrees_of_freedom()
    }
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

/// Refuses a speed above [`fastest_rad_per_s`], the value of a key or an argument.
///
/// # Errors
/// [`RefusedValue`].
pub(crate) fn check_speed(blade: &Blade, key: &str, given_rpm: f64) -> Result<(), RefusedValue> {
    let fastest_rpm = rpm(fastest_rad_per_s(blade));
    if given_rpm <= fastest_rpm {
        Ok(())
    } else {
        let allowed = format!("at most {fastest_rpm:.0}");
        Err(RefusedValue::new(key, given_rpm, allowed, TORN))
    }
}

/// Refuses a sweep that ends above [`fastest_rad_per_s`].
///
/// # Errors
/// [`AnalysisError::Overstretched`].
pub(crate) fn check_stretch(blade: &Blade, to_rad_per_s: f64) -> Result<(), AnalysisError> {
    let fastest = fastest_rad_per_s(blade);
    if to_rad_per_s > fastest {
        Err(AnalysisError::Overstretched {
            key: END_OF_SWEEP,
            to_rpm: rpm(to_rad_per_s),
            limit_rpm: rpm(fastest),
        })
    } else {
        Ok(())
    }
}

/// End of the sweep, in rad/s, if the scene gives none, for critical speeds that ascend: [`usual_end`], or before
/// the critical speed that follows the first [`CHARTED`] ones.
pub(super) fn chosen_end(scene: &Scene, critical_rad_per_s: &[f64]) -> f64 {
    let usual = usual_end(scene, critical_rad_per_s.first().copied());
    match critical_rad_per_s.get(CHARTED - 1..=CHARTED) {
        Some(&[last, next]) if next < usual => rad_per_s(rounded_between(rpm(last), rpm(next))),
        _ => usual,
    }
}

/// Whether the end that the program chooses for a sweep is below the usual one because of the number of critical
/// speeds.
pub(crate) fn is_cut_short(scene: &Scene, critical_rad_per_s: &[f64]) -> bool {
    let usual = usual_end(scene, critical_rad_per_s.first().copied());
    let next = critical_rad_per_s.get(CHARTED);
    next.is_some_and(|next| *next < usual)
}

/// Twice the first critical speed, or above the operating speed up to three times the first critical speed, but at most
/// [`fastest_rad_per_s`]; in rad/s.
pub(crate) fn usual_end(scene: &Scene, first_critical_rad_per_s: Option<f64>) -> f64 {
    let lowest = first_critical_rad_per_s.map_or(ASSUMED_CRITICAL_RPM, rpm);
    let operating = ABOVE_OPERATING * scene.file().operating_rpm.unwrap_or(0.0);
    let top = match operating / lowest {
        2.0..=FARTHEST => operating,
        _ => 2.0 * lowest,
    };
    rad_per_s(rounded_up(top)).min(fastest_rad_per_s(scene.blade()))
}

/// A number rounded up to two digits.
fn rounded_up(number: f64) -> f64 {
    let digit = 10_f64.powf(number.log10().floor() - 1.0);
    (number / digit).ceil() * digit
}

/// Critical speeds without their waves, in rad/s.
pub(super) fn speeds(critical: &[NamedCriticalSpeed]) -> Vec<f64> {
    critical.iter().map(|c| c.speed_rad_per_s).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::SpeedRange;
    use crate::stability::{Analysis, AnalysisOptions, ChosenBasis};

    /// Waves of 73 nodal diameters more than the first critical one stand still below 40 000 rpm.
    #[test]
    fn a_sweep_that_no_basis_contains_is_refused_without_an_estimate_of_the_work() {
        let fast = Scene::paper().swept(SpeedRange::between_rpm(0.0, 40_000.0));
        let told = std::sync::atomic::AtomicBool::new(false);
        let tell = |_| told.store(true, std::sync::atomic::Ordering::Relaxed);
        let options = AnalysisOptions {
            expected: Some(&tell),
            ..AnalysisOptions::default()
        };
        match Analysis::with_options(&fast.unwrap(), options) {
            Err(AnalysisError::Unresolved { limit_rpm, .. }) => assert!(limit_rpm < 40_000.0),
            other => panic!("{other:?}"),
        }
        assert!(!told.into_inner());
    }

    #[test]
    fn a_chosen_sweep_passes_the_operating_speed_unless_that_is_far_away() {
        let first = rad_per_s(1500.0);
        for (operating, end) in [
            (1400.0, 3000.0),
            (2840.0, 3000.0),
            (3999.0, 4200.0),
            (4400.0, 3000.0),
        ] {
            let scene = Scene::paper().edited(|saw| saw.operating_rpm = Some(operating));
            let found = rpm(usual_end(&scene.unwrap(), Some(first)));
            assert!((found - end).abs() < 1e-6, "{operating}: {found}");
        }
    }

    /// Hoop strain ρ(Ωb)²/E of the paper's blade: 0.1 at 43 400 rpm.
    #[test]
    fn no_sweep_goes_to_where_the_blade_would_be_torn() {
        let torn = Scene::paper().swept(SpeedRange::between_rpm(0.0, 43_500.0));
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
        assert_eq!(
            chosen.range_rad_per_s.to_rad_per_s,
            fastest_rad_per_s(scene.blade())
        );
        assert!(chosen.critical[0].speed_rad_per_s > chosen.range_rad_per_s.to_rad_per_s);
    }
}
