//! Waves of the free blade that can stand still in space, of any number of nodal diameters.
//!
//! On n diameters the free blade has the stiffness Kₙ(Ω) = K_b + K_m + Ω²(K_σ − N) in space, and a wave stands
//! still where it is singular. Kₙ is linear in Ω²: if it is positive definite at rest and at Ω, no wave of n
//! diameters stands still up to Ω. For a given radial function R it is the energy
//!
//! a + b n² + c n⁴, c = ∫ (D/ρh₀) R²/r³ dr > 0,
//!
//! because n enters the curvatures as R′/r − n²R/r² and n (R′/r − R/r²), and the stresses and the rotation as n²:
//! a convex function of n². So if Kₙ is positive definite and Kₙ − Kₙ₋₁ is too, the energy of every R has risen up
//! to n and rises further, and no wave of more diameters stands still either. The search over n may stop there,
//! however many minima ω/n has under membrane stress.
//!
//! Slots multiply K_b by a factor that depends on n, factors of waves that were measured K_σ too, and the argument holds where the factor is the same for all further n: beyond those
//! for which it is computed, it is the smallest of them. The search stops there at the earliest. That no wave of more diameters
//! loses more to the slots is an assumption of the model.
//!
//! Springs that are fixed in space only raise the energy. Hence a saw on guides has at most as many critical speeds
//! below a speed as the free blade (Weyl's inequality), and a basis with all diameters of the free blade's lacks
//! none of them. Dampers and friction do not change the speeds at which K is singular.

use faer::{Mat, Side};

use super::assembled_plate::SpeedLimit;
use super::error::SpectrumError;
use super::symmetric_pencil::singular_multiples;
use crate::model::linalg::symmetric_eigenvalues;
use crate::model::plate::{HarmonicBlock, Plate};

/// Critical speeds of the free blade of a plate, with as many nodal diameters as needed.
#[derive(Debug, Clone, PartialEq)]
pub struct StandingWaves {
    /// Critical speeds up to a limit, ascending, in rad/s; each twice, because a cosine and a sine stand still.
    pub speeds_rad_per_s: Vec<f64>,
    /// Number of nodal diameters of the lowest one; 0 without any.
    pub lowest_diameters: usize,
    /// Largest number of nodal diameters of a wave that stands still up to the limit or is not stable at rest; 1
    /// without such waves.
    pub most_diameters: usize,
}

/// Least number of nodal diameters of a standing wave: rotation stiffens n ≤ 1 more than it softens them.
const FEWEST: usize = 2;
/// The search ends here on a blade of which no wave stands still at any speed.
const SEARCHED: usize = 1000;
/// Harmonics assembled at once.
const AT_ONCE: usize = 16;

impl StandingWaves {
    /// The waves that stand still up to a limit, which may depend on the critical speeds found so far and must not
    /// rise with them.
    ///
    /// # Errors
    /// [`SpectrumError::NoConvergence`], [`SpectrumError::Cancelled`].
    pub fn up_to(plate: &Plate, limit: SpeedLimit<'_>) -> Result<Self, SpectrumError> {
        Self::from_diameters(FEWEST, plate, limit)
    }

    /// First critical speed of the waves of more than `few` nodal diameters, in rad/s.
    ///
    /// # Errors
    /// The errors of [`StandingWaves::up_to`].
    pub fn lowest_beyond(few: usize, plate: &Plate) -> Result<Option<f64>, SpectrumError> {
        let lowest = |found: &[f64]| found[0];
        let found = Self::from_diameters(FEWEST.max(few + 1), plate, &lowest)?;
        Ok(found.speeds_rad_per_s.first().copied())
    }

    fn from_diameters(
        fewest: usize,
        plate: &Plate,
        limit: SpeedLimit<'_>,
    ) -> Result<Self, SpectrumError> {
        let mut found: Vec<(f64, usize)> = Vec::new();
        let mut speeds: Vec<f64> = Vec::new();
        let mut unstable = FEWEST - 1;
        let mut previous: Option<HarmonicBlock> = None;
        for block in harmonics_from(fewest, plate) {
            let top = (!speeds.is_empty()).then(|| limit(&speeds));
            if !top.is_some_and(|top| is_stable(&block, top)) {
                match standing(&block) {
                    Ok(own) => found.extend(own.into_iter().map(|speed| (speed, block.diameters))),
                    Err(SpectrumError::UnstableAtRest { .. }) => unstable = block.diameters,
                    Err(error) => return Err(error),
                }
                found.sort_by(|x, y| x.0.total_cmp(&y.0));
                speeds = found.iter().flat_map(|(speed, _)| [*speed; 2]).collect();
            } else if let (Some(few), Some(top)) = (&previous, top)
                && few.diameters >= plate.even_from()
                && [0.0, top]
                    .into_iter()
                    .all(|speed| has_risen(few, &block, speed))
            {
                break;
            }
            previous = Some(block);
        }
        let top = speeds.first().map_or(0.0, |_| limit(&speeds));
        found.retain(|(speed, _)| *speed <= top);
        speeds.truncate(2 * found.len());
        let diameters = found.iter().map(|(_, diameters)| *diameters);
        Ok(StandingWaves {
            speeds_rad_per_s: speeds,
            lowest_diameters: diameters.clone().next().unwrap_or(0),
            most_diameters: diameters.fold(unstable, usize::max),
        })
    }
}

/// Speeds, in shares of the highest one, at which the frequencies of waves are compared with those of a window.
/// At the highest speed backward waves have their lowest frequency, unless rotation stiffens them more than it
/// slows them down in space.
const LOOKED_AT: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// Largest number of nodal diameters of a wave of the free blade whose frequency in space is within a window at a speed
/// up to a highest one.
///
/// With the frequency W of the window, Kₙ(Ω) − (2nΩW + W²) takes the place of Kₙ(Ω). It is convex in n² too.
pub fn diameters_within(plate: &Plate, to_rad_per_s: f64, window_rad_per_s: f64) -> usize {
    let shifted = |block: &HarmonicBlock, speed: f64| {
        let mut stiffness = block.stiffness_at(speed);
        let turned = 2.0 * block.diameters as f64 * speed + window_rad_per_s;
        (0..stiffness.nrows()).for_each(|j| stiffness[(j, j)] -= turned * window_rad_per_s);
        stiffness
    };
    let mut most = FEWEST - 1;
    let mut previous: Option<Vec<Mat<f64>>> = None;
    for block in harmonics_from(FEWEST, plate) {
        let own = LOOKED_AT.map(|share| shifted(&block, share * to_rad_per_s));
        let is_outside = own.iter().all(is_definite);
        if !is_outside {
            most = block.diameters;
        } else if let Some(few) = &previous
            && block.diameters > plate.even_from()
            && own
                .iter()
                .zip(few)
                .all(|(more, few)| is_definite(&(more - few)))
        {
            break;
        }
        previous = Some(own.to_vec());
    }
    most
}

/// Highest frequency in space of a wave of the free blade that is reflected at a speed, in rad/s; 0 without one.
///
/// # Errors
/// [`SpectrumError::Decomposition`].
pub fn highest_reflected(plate: &Plate, speed_rad_per_s: f64) -> Result<f64, SpectrumError> {
    let mut highest = 0.0_f64;
    for block in &plate.harmonics {
        let own = body_frequencies(block, speed_rad_per_s)?;
        let lowest = own.first().copied().unwrap_or(f64::INFINITY);
        let turned = block.diameters as f64 * speed_rad_per_s;
        highest = highest.max(turned - lowest);
    }
    Ok(highest)
}

/// Frequencies in space of the waves of the free blade, among the harmonics of a plate, at a speed: |ω − nΩ| and ω + nΩ, ascending, in
/// rad/s.
///
/// # Errors
/// [`SpectrumError::Decomposition`].
pub fn frequencies_in_space(
    plate: &Plate,
    speed_rad_per_s: f64,
) -> Result<Vec<f64>, SpectrumError> {
    let mut found = Vec::new();
    for block in &plate.harmonics {
        let turned = block.diameters as f64 * speed_rad_per_s;
        for own in body_frequencies(block, speed_rad_per_s)? {
            match block.diameters {
                0 => found.push(own),
                _ => found.extend([(own - turned).abs(), own + turned]),
            }
        }
    }
    found.sort_by(f64::total_cmp);
    Ok(found)
}

/// Number of waves of the free blade, among the harmonics of a plate, whose frequency in space is within a window at a
/// speed.
///
/// # Errors
/// [`SpectrumError::Decomposition`].
pub fn waves_within(
    plate: &Plate,
    speed_rad_per_s: f64,
    window_rad_per_s: f64,
) -> Result<usize, SpectrumError> {
    let all = frequencies_in_space(plate, speed_rad_per_s)?;
    Ok(all.partition_point(|frequency| *frequency <= window_rad_per_s))
}

/// Number of waves with ω − nΩ below a cut, or reflected, at one of some speeds at least: a cosine and a sine each for n > 0.
///
/// # Errors
/// [`SpectrumError::Decomposition`].
pub fn waves_below(
    plate: &Plate,
    speeds_rad_per_s: &[f64],
    cut_rad_per_s: f64,
) -> Result<usize, SpectrumError> {
    let mut count = 0;
    for block in &plate.harmonics {
        let mut most = 0;
        for speed in speeds_rad_per_s {
            let limit = block.diameters as f64 * speed + cut_rad_per_s;
            let own = body_frequencies(block, *speed)?;
            most = most.max(own.partition_point(|frequency| *frequency < limit));
        }
        count += most * (1 + usize::from(block.diameters > 0));
    }
    Ok(count)
}

/// Frequencies ω of the waves of a harmonic in the frame of the blade, ascending, in rad/s; zero for a buckled one.
fn body_frequencies(
    block: &HarmonicBlock,
    speed_rad_per_s: f64,
) -> Result<Vec<f64>, SpectrumError> {
    let body = block.body_frame_stiffness(speed_rad_per_s);
    let squares =
        symmetric_eigenvalues(body.as_ref()).map_err(SpectrumError::at(speed_rad_per_s))?;
    Ok(squares
        .into_iter()
        .map(|square| square.max(0.0).sqrt())
        .collect())
}

/// Stiffness of the free blade for n, n + 1, …
fn harmonics_from(fewest: usize, plate: &Plate) -> impl Iterator<Item = HarmonicBlock> + '_ {
    let starts = (fewest..=SEARCHED).step_by(AT_ONCE);
    starts.flat_map(|first| plate.harmonics_of(first..=first + AT_ONCE - 1))
}

/// Whether no wave of a harmonic stands still up to a speed, and none is unstable at rest.
fn is_stable(block: &HarmonicBlock, speed_rad_per_s: f64) -> bool {
    let mut speeds = [0.0, speed_rad_per_s].into_iter();
    speeds.all(|speed| is_definite(&block.stiffness_at(speed)))
}

/// Whether the stiffness has risen from one number of diameters to the next for every radial function.
fn has_risen(few: &HarmonicBlock, more: &HarmonicBlock, speed_rad_per_s: f64) -> bool {
    is_definite(&(more.stiffness_at(speed_rad_per_s) - few.stiffness_at(speed_rad_per_s)))
}

fn is_definite(matrix: &Mat<f64>) -> bool {
    matrix.llt(Side::Lower).is_ok()
}

/// Critical speeds of a harmonic, ascending, in rad/s.
fn standing(block: &HarmonicBlock) -> Result<Vec<f64>, SpectrumError> {
    let spin = &block.spin;
    let softening = Mat::from_fn(spin.nrows(), spin.ncols(), |j, k| -spin[(j, k)]);
    let squares = singular_multiples(&block.stiffness_at(0.0), &[], &softening)?;
    Ok(squares
        .into_iter()
        .map(|(square, _)| square.sqrt())
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::Resolution;
    use crate::model::scene::{Scene, rpm};

    const MANY: usize = 130;

    /// A blade of 300 mm in a flange, without guides.
    fn flanged(flange_m: f64, thickness_m: f64) -> Scene {
        let text = format!(
            r#"{{ "name": "flanged", "blade": {{ "outer_diameter_m": 0.3, "inner_diameter_m": 0.03,
                "thickness_m": {thickness_m}, "material": {{ "youngs_modulus_pa": 2.1e11, "poisson_ratio": 0.3,
                "density_kg_per_m3": 7850 }} }},
                "mount": {{ "kind": "collar", "diameter_m": {flange_m}, "in_plane": "fixed" }} }}"#
        );
        Scene::from_json(&text).unwrap()
    }

    fn plate(scene: &Scene, radial_functions: usize) -> Plate {
        let resolution = Resolution {
            max_diameters: 4,
            radial_functions,
        };
        Plate::new(scene, resolution)
    }

    /// Hermite cubics on 24 equal elements of the radius give 35 506.03 rpm, n = 48, and 17 888.80 rpm, n = 14, as
    /// the first critical speeds of n ≤ 150.
    #[test]
    fn the_first_critical_speed_of_a_large_flange_has_dozens_of_diameters() {
        for (scene, exact_rpm, diameters) in [
            (flanged(0.288, 0.6e-3), 35_506.03, 48),
            (flanged(0.26, 1e-3), 17_888.80, 14),
        ] {
            let found = StandingWaves::up_to(&plate(&scene, 10), &|found| found[0]).unwrap();
            let lowest = rpm(found.speeds_rad_per_s[0]);
            assert!((lowest / exact_rpm - 1.0).abs() < 1e-6, "{lowest}");
            assert_eq!(found.most_diameters, diameters);
        }
    }

    /// Reference: every number of diameters up to 130 by itself; also with a hot rim and a cold one.
    #[test]
    fn no_standing_wave_is_missed_where_the_search_stops() {
        let heated = |rise_k: f64| {
            let heat = format!(
                r#"{{ "temperature": {{ "expansion_per_k": 1.2e-5, "rim_rise_k": {rise_k} }} }}"#
            );
            let scene = flanged(0.2, 1.2e-3).edited(|saw| {
                saw.membrane = Some(serde_json::from_str(&heat).unwrap());
            });
            scene.unwrap()
        };
        for scene in [
            flanged(0.15, 2e-3),
            flanged(0.27, 0.5e-3),
            heated(20.0),
            heated(-60.0),
        ] {
            let plate = plate(&scene, 7);
            let blocks = plate.harmonics_of(FEWEST..=MANY);
            let mut all: Vec<(f64, usize)> = Vec::new();
            for block in &blocks {
                let own = standing(block).unwrap().into_iter();
                all.extend(own.map(|speed| (speed, block.diameters)));
            }
            all.sort_by(|x, y| x.0.total_cmp(&y.0));
            for times in [1.0, 1.02, 1.5] {
                let top = |lowest: f64| times * lowest * (1.0 + 1e-9);
                let within = all.iter().filter(|(speed, _)| *speed <= top(all[0].0));
                let most = within.clone().map(|(_, diameters)| *diameters).max();
                let found = StandingWaves::up_to(&plate, &|found| top(found[0])).unwrap();
                assert_eq!(Some(found.most_diameters), most, "{times}");
                let speeds: Vec<f64> = within.flat_map(|(speed, _)| [*speed; 2]).collect();
                assert_eq!(found.speeds_rad_per_s, speeds, "{times}");
                let beyond = all.iter().find(|(_, diameters)| *diameters > 20);
                let lowest = StandingWaves::lowest_beyond(20, &plate).unwrap();
                assert_eq!(lowest, beyond.map(|(speed, _)| *speed));
            }
        }
    }

    /// Reference: ω − nΩ of the free blade, from the eigenvalues of its stiffness in the body frame.
    #[test]
    fn no_wave_within_a_window_is_missed() {
        for scene in [flanged(0.15, 2e-3), flanged(0.27, 0.5e-3)] {
            let plate = plate(&scene, 7);
            let blocks = plate.harmonics_of(FEWEST..=MANY);
            let lowest = StandingWaves::up_to(&plate, &|found| found[0])
                .unwrap()
                .speeds_rad_per_s[0];
            for (times, window) in [(0.5, 1.1), (1.0, 1.02), (1.5, 3.0)] {
                let speed = times * lowest;
                let in_space = |block: &HarmonicBlock, speed: f64| {
                    let squares = block
                        .body_frame_stiffness(speed)
                        .self_adjoint_eigenvalues(Side::Lower)
                        .unwrap();
                    squares[0].sqrt() - block.diameters as f64 * speed
                };
                let window = window * in_space(&blocks[0], 0.0);
                let inside = blocks
                    .iter()
                    .filter(|block| in_space(block, speed) < window);
                let most = inside.map(|block| block.diameters).max().unwrap();
                assert!(most < MANY);
                assert_eq!(diameters_within(&plate, speed, window), most, "{times}");
            }
        }
    }
}
