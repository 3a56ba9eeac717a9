//! Number of growing modes of a damped saw, by the argument principle.
//!
//! det L(λ) is a polynomial, whose argument changes by one turn for every eigenvalue inside a closed path.
//! Divided by the factors of the listed eigenvalues, the determinant has a nearly constant argument along the
//! path, so that few points suffice. One of them is at the frequency of every listed eigenvalue, to detect a
//! growth rate of wrong sign.

use faer::c64;

use super::FullModel;
use crate::modes::argument::turn_along;

/// Number of points along each side of the path, besides those at the frequencies of the listed eigenvalues.
const PLACES: usize = 16;
/// Frequency at which the path ends, relative to the window: at zero the block of a rigid motion is singular.
const NEXT_TO_ZERO: f64 = 1e-5;

impl FullModel {
    /// Number of eigenvalues with 0 < Re λ < `growth` and |Im λ| < `frequency`, minus the number of listed ones
    /// there; conjugates are counted though not listed. `None` if the path passes through an eigenvalue, and for
    /// a saw that is not structured.
    pub fn unlisted(
        &self,
        speed_rad_per_s: f64,
        listed: &[c64],
        [growth, frequency]: [f64; 2],
    ) -> Option<isize> {
        let place = |t: f64| -> c64 {
            match t {
                t if t < 1.0 => c64::new(growth, t * frequency),
                t if t < 2.0 => c64::new((2.0 - t) * growth, frequency),
                t => c64::new(0.0, (3.0 - t).max(NEXT_TO_ZERO) * frequency),
            }
        };
        let mut places: Vec<f64> = (0..=3 * PLACES).map(|k| k as f64 / PLACES as f64).collect();
        let beside = listed.iter().filter(|value| value.im < frequency);
        places.extend(beside.map(|value| 3.0 - value.im / frequency));
        places.sort_by(f64::total_cmp);
        places.dedup();
        let total = turn_along(&places, |t| self.angle(speed_rad_per_s, place(t), listed))?;
        Some((total / std::f64::consts::PI).round() as isize)
    }

    /// Argument of det L(λ) over the product of all λ − λ_k.
    fn angle(&self, speed: f64, lambda: c64, listed: &[c64]) -> Option<f64> {
        let factors = listed.iter().flat_map(|value| {
            let conjugate = (value.im != 0.0).then(|| value.conj());
            [Some(*value), conjugate].into_iter().flatten()
        });
        let known: f64 = factors.map(|value| (lambda - value).arg()).sum();
        Some(self.eliminated(speed, lambda)?.determinant_angle()? - known)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{DampingFile, GuideControllerFile, GuideFilmFile, Scene, rad_per_s};
    use crate::model::system::GyroscopicSystem;
    use crate::modes::companion_eigenpairs;

    /// A damped saw on one guide, on two with different ratios of damping to stiffness, or on three of which one has a film
    /// and another a controller.
    fn damped(guides: usize) -> Plate {
        let scene = Scene::paper().edited(|saw| {
            saw.guides = vec![saw.guides[0].clone(); guides];
            saw.guides[0].damping_n_s_per_m = 3.0;
            saw.guides[0].angle_deg += 70.0;
            // Two pads need more columns than a small basis permits.
            for guide in saw.guides.iter_mut().filter(|_| guides > 1) {
                (guide.radial_length_m, guide.tangential_length_m) = (0.0, 0.0);
            }
            if guides == 3 {
                saw.guides[2].angle_deg += 160.0;
                saw.guides[0].film = Some(GuideFilmFile { lag_s: 3e-3 });
                saw.guides[1].controller = Some(GuideControllerFile {
                    numerator: vec![1e6],
                    denominator: vec![1.0, 0.0],
                });
            }
            saw.damping = Some(DampingFile {
                material_retardation_time_s: 1e-6,
                air_n_s_per_m3: 0.5,
                air_rotation_share: 0.3,
                ..DampingFile::default()
            });
        });
        let resolution = Resolution {
            max_diameters: 8,
            radial_functions: 5,
        };
        Plate::new(&scene.unwrap(), resolution)
    }

    /// If all dense eigenvalues are listed, none is unlisted; one that is removed, added, or given a growth
    /// rate of wrong sign is detected.
    #[test]
    fn eigenvalues_that_a_list_lacks_or_invents_are_counted() {
        let mut growing = 0;
        let speeds = [800.0, 1540.0, 1700.0, 2110.0, 2262.0, 2600.0, 2900.0];
        for (guides, rpm) in [1, 2, 3]
            .into_iter()
            .flat_map(|guides| speeds.map(|rpm| (guides, rpm)))
        {
            let plate = damped(guides);
            let (full, system) = (FullModel::new(&plate), GyroscopicSystem::of_plate(&plate));
            let speed = rad_per_s(rpm);
            let all = companion_eigenpairs(&system, speed).unwrap();
            let mut values: Vec<c64> = all.iter().map(|(lambda, _)| *lambda).collect();
            values.retain(|value| value.im < 700.0);
            let window = [300.0, 500.0];
            let unlisted = |listed: &[c64]| full.unlisted(speed, listed, window).unwrap();
            assert_eq!(unlisted(&values), 0, "{rpm}");
            for k in 0..values.len().min(8) {
                let value = values[k];
                // The path does not enclose eigenvalues outside of its window or near zero.
                let is_beside = value.im > window[1] || value.re.abs() > window[0];
                if is_beside || value.norm() < NEXT_TO_ZERO * window[1] {
                    continue;
                }
                let weight = if value.im == 0.0 { 1 } else { 2 };
                let grows = isize::from(value.re > 0.0) * weight;
                growing += grows;
                let mut fewer = values.clone();
                fewer.remove(k);
                assert_eq!(unlisted(&fewer), grows, "{rpm} without {value}");
                let mut wrong = values.clone();
                wrong[k] = c64::new(-value.re, value.im);
                assert_eq!(unlisted(&wrong), 2 * grows - weight, "{rpm} wrong {value}");
            }
        }
        assert!(growing > 4, "{growing}");
    }
}
