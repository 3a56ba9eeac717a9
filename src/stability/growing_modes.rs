//! Growing modes at a single speed, such as that of a cut, with checks by counts on the full model.
//!
//! For an undamped saw the lowest modes are enough if the Krein index, with n₋(K) from a factorization, shows
//! that no other mode grows, and the counts between modes of opposite sign show that none is missed. For
//! other saws all eigenvalues are computed, and the lowest are counted by the argument principle.

use faer::c64;

use super::damped::counted_in_window;
use super::mode_counts::{MiscountedModes, claims, of_claims};
use super::sample::Sample;
use crate::model::plate::Plate;
use crate::model::system::GyroscopicSystem;
use crate::modes::{
    FullModel, Growing, LowestModes, Mode, ModeKind, SpectrumError, eigenvalues, grows,
    krein_index, negative_eigenvalues,
};

/// Growing modes of a plate at a speed, and their checks.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct GrowingModes {
    /// Number of growing modes; two conjugate eigenvalues are one mode.
    pub modes: usize,
    /// The fastest growing mode, and whether one grows without oscillation.
    pub growing: Growing,
    /// n₋(K) and the Krein index of the modes, for an undamped saw.
    pub krein: Option<[usize; 2]>,
    /// Number of conclusive mode counts on the full model.
    pub full_basis_counts: usize,
    /// Counts that contradict the modes.
    pub miscounts: Vec<MiscountedModes>,
}

/// Number of modes computed at first; above many critical speeds more are needed.
const LOOKED_AT: usize = 16;

impl GrowingModes {
    /// Growing modes of a plate at a speed.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn of_plate(plate: &Plate, speed_rad_per_s: f64) -> Result<Self, SpectrumError> {
        let lowest = LowestModes::new(plate);
        let has_krein_index =
            |system: &GyroscopicSystem| system.is_conservative() && system.free_rigid.is_empty();
        if !lowest.components.iter().all(|c| has_krein_index(&c.full)) {
            return Self::by_all_eigenvalues(plate, &lowest, speed_rad_per_s);
        }
        let mut count = LOOKED_AT;
        loop {
            let modes = lowest.at(speed_rad_per_s, count)?;
            let checked = Self::undamped(plate, &lowest, speed_rad_per_s, &modes);
            let is_whole = modes.len() < count;
            if checked.is_clean() || is_whole {
                return Ok(checked);
            }
            count *= 2;
        }
    }

    /// Whether every check agrees.
    pub fn is_clean(&self) -> bool {
        self.miscounts.is_empty() && self.matches_krein()
    }

    /// Whether the Krein index matches, for an undamped saw.
    pub fn matches_krein(&self) -> bool {
        self.krein
            .is_none_or(|[stiffness, modes]| stiffness == modes)
    }

    fn undamped(plate: &Plate, lowest: &LowestModes, speed: f64, modes: &[Mode]) -> Self {
        let growing = modes.iter().filter(|mode| mode.growth_per_s() > 0.0);
        let values = growing.clone().map(|mode| mode.lambda);
        let mut found = GrowingModes {
            modes: growing.clone().count(),
            growing: Growing {
                fastest: values.max_by(|x, y| x.re.total_cmp(&y.re)),
                diverges: growing.clone().any(|mode| mode.kind == ModeKind::Divergent),
            },
            ..GrowingModes::default()
        };
        let systems = lowest.components.iter().map(|component| &component.full);
        let negative: Option<usize> = systems
            .map(|system| negative_eigenvalues(&system.stiffness_at(speed)))
            .sum();
        let Some(negative) = negative else {
            return found;
        };
        let sample = Sample::of_modes(speed, modes.iter());
        found.krein = Some([negative, krein_index(modes)]);
        if !plate.is_axisymmetric() {
            let highest = modes
                .iter()
                .fold(0.0, |top: f64, mode| top.max(mode.lambda.im));
            let claims = claims(&sample, highest);
            let counted = of_claims(
                &FullModel::new(plate),
                speed,
                &claims,
                Some(negative as isize),
            );
            found.full_basis_counts = counted.certain;
            found.miscounts = counted.miscounts;
        }
        found
    }

    fn by_all_eigenvalues(
        plate: &Plate,
        lowest: &LowestModes,
        speed: f64,
    ) -> Result<Self, SpectrumError> {
        let mut values = Vec::new();
        let mut has_free_motions = false;
        for component in &lowest.components {
            values.extend(eigenvalues(&component.full, speed)?);
            has_free_motions |= !component.full.free_rigid.is_empty();
        }
        let is_undamped = lowest.components.iter().all(|c| c.full.is_conservative());
        let mut found = Self::of_values(&values, speed, is_undamped);
        if !plate.is_axisymmetric() && !has_free_motions {
            found.count(&FullModel::new(plate), speed, values);
        }
        Ok(found)
    }

    fn of_values(values: &[c64], speed: f64, is_undamped: bool) -> Self {
        let grows = |lambda: &&c64| grows(**lambda, speed, is_undamped);
        GrowingModes {
            modes: values.iter().filter(grows).count(),
            growing: Growing::of(values, speed, is_undamped),
            ..GrowingModes::default()
        }
    }

    /// Counts the lowest of all eigenvalues of a damped saw.
    fn count(&mut self, full: &FullModel, speed: f64, mut values: Vec<c64>) {
        values.sort_by(|x, y| x.im.total_cmp(&y.im));
        values.truncate(LOOKED_AT);
        let highest = values.last().map_or(0.0, |value| value.im);
        if let Some(miscount) = counted_in_window(full, speed, &values, highest) {
            self.full_basis_counts = 1;
            self.miscounts = miscount.into_iter().collect();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Resolution, RimForce};
    use crate::model::scene::{Accuracy, Scene, rad_per_s};
    use crate::modes::companion_eigenpairs;

    /// The paper's saw with a force at its rim, idling, and with a damper.
    fn plates() -> [Plate; 3] {
        let resolution = Resolution::of(Accuracy::Draft);
        let idle = Plate::new(&Scene::paper(), resolution);
        let pushed = idle.with_edge_loads(&[RimForce {
            angle_rad: 0.1,
            radial_n: -300.0,
            tangential_n: -4500.0,
        }]);
        let damped = Scene::paper().edited(|saw| saw.guides[0].damping_n_s_per_m = 2.0);
        [pushed, idle, Plate::new(&damped.unwrap(), resolution)]
    }

    /// Reference: all eigenvalues of the full model.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
    fn growing_modes_of_a_speed_are_those_of_all_eigenvalues() {
        let mut growing = 0;
        for (plate, noise) in plates().into_iter().zip([1e-4, 1e-4, 1e-8]) {
            for rpm in [600.0, 1540.0, 1800.0, 2110.0, 2262.0, 2800.0] {
                let speed = rad_per_s(rpm);
                let found = GrowingModes::of_plate(&plate, speed).unwrap();
                let all = companion_eigenpairs(&GyroscopicSystem::of_plate(&plate), speed).unwrap();
                let grows = all
                    .iter()
                    .map(|(lambda, _)| lambda.re)
                    .filter(|re| *re > noise);
                let fastest = grows.clone().fold(0.0, f64::max);
                assert_eq!(found.modes, grows.clone().count(), "{rpm}: {found:?}");
                let growth = found
                    .growing
                    .fastest
                    .map_or(0.0, |lambda| lambda.re.max(0.0));
                let off = (growth - fastest).abs();
                assert!(off <= 1e-6 * (1.0 + fastest), "{rpm}: {off:e}");
                assert!(found.is_clean(), "{rpm}: {found:?}");
                assert!(found.full_basis_counts > 0, "{rpm}: {found:?}");
                growing += found.modes;
            }
        }
        assert!(growing > 6, "{growing}");
    }

    /// The index of an undamped saw and the count of a damped one detect a missing growing mode; the counts
    /// between other modes detect a missing wave.
    #[test]
    fn a_missing_mode_is_detected() {
        let [pushed, idle, damped] = plates();
        for plate in [&pushed, &idle] {
            let lowest = LowestModes::new(plate);
            let reflecting = (0..30).map(|k| rad_per_s(1600.0 + 40.0 * f64::from(k)));
            let (speed, modes) = reflecting
                .map(|speed| (speed, lowest.at(speed, LOOKED_AT).unwrap()))
                .find(|(_, modes)| modes.iter().any(|m| m.kind == ModeKind::Negative))
                .expect("a reflected wave");
            let without = |gone: usize| {
                let mut fewer = modes.clone();
                fewer.remove(gone);
                GrowingModes::undamped(plate, &lowest, speed, &fewer)
            };
            let last = modes.iter().rposition(|m| m.kind == ModeKind::Negative);
            for (gone, mode) in modes[..=last.unwrap()].iter().enumerate() {
                let found = without(gone);
                assert!(!found.is_clean(), "{:?}: {found:?}", mode.kind);
            }
        }
        let (full, speed) = (FullModel::new(&damped), rad_per_s(1540.0));
        let mut values = eigenvalues(&GyroscopicSystem::of_plate(&damped), speed).unwrap();
        let counted = |values: &[c64]| {
            let mut found = GrowingModes::of_values(values, speed, false);
            found.count(&full, speed, values.to_vec());
            found
        };
        assert!(counted(&values).is_clean());
        let growing = values.iter().position(|lambda| lambda.re > 0.0);
        values.remove(growing.expect("a growing mode"));
        assert_eq!(counted(&values).miscounts[0].missing, 1);
    }
}
