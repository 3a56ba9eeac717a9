//! Reduced basis for washboarding: all modes up to the tooth passing frequency and beyond, and the static
//! flexibility of the others.

use std::f64::consts::TAU;

use faer::{Mat, Scale};
use nalgebra::DMatrix;

use super::WashboardError;
use super::delayed_saw::DelayedSaw;
use crate::model::linalg::{SymmetricEigen, symmetric_eigenvalues};
use crate::model::plate::{Contact, ContactTerms, Plate, Resolution};
use crate::model::scene::{Cut, CutRun, Scene, SpeedRange, Washboarding, rpm};
use crate::model::system::GyroscopicSystem;
use crate::modes::SpectrumError;
use crate::stability::{ChosenBasis, DENSE_LADDER};

/// The saw in the cut, reduced to its lower modes.
#[derive(Debug)]
pub struct Motions {
    /// The saw in the cut.
    pub plate: Plate,
    /// Shapes V that span the reduced model, N × m.
    pub shapes: Mat<f64>,
    /// The reduced system.
    pub system: GyroscopicSystem,
    /// Columns VᵀB of the arc in the reduced coordinates.
    pub columns: Mat<f64>,
    /// Static flexibility of the omitted shapes under forces on the arc, Bᵀ(S⁻¹ − V(VᵀSV)⁻¹Vᵀ)B.
    pub flexibility: DMatrix<f64>,
    /// Frequency in space up to which the modes are complete.
    pub complete_to_rad_per_s: f64,
    /// Frequency in space up to which complete modes are needed.
    pub needed_to_rad_per_s: f64,
    /// Estimated relative error of the critical speeds in the basis of the plate.
    pub estimated_relative_error: f64,
    /// Largest xᵀPx of a shape.
    most_moved: f64,
}

/// Factor by which the modes extend beyond the tooth passing frequency of the fastest speed. A mode is driven
/// while teeth pass at up to twice its frequency, and most strongly just above it.
const BEYOND_TOOTH_PASSING: f64 = 1.05;
/// Multiple of the cutting stiffness up to which damping alone has to prevent growth of the omitted modes.
const WITHSTOOD: f64 = 3.0;
/// Multiple of the tooth passing frequency beyond which the modes do not extend for this reason.
const MOST_BEYOND: f64 = 2.0;
/// Factor by which the shapes extend beyond the modes that they have to represent.
const BEYOND_MODES: f64 = 1.2;
/// Largest number of shapes. More would take minutes, because each speed is an eigenproblem of twice this order.
const MOST_SHAPES: usize = 110;
/// Number of radial functions beyond the number of nodal circles of the highest shape without nodal
/// diameters.
const RADIAL_MARGIN: usize = 3;
/// Smallest ratio of decay rate to |λ| of a damped mode.
const LEAST_DAMPING: f64 = 1e-8;

impl Motions {
    /// The reduced model of the saw in its cut, for speeds up to `highest` times that of the cut.
    ///
    /// # Errors
    /// [`WashboardError::Loose`] if a rigid motion has no stiffness, [`WashboardError::Incomplete`] if the modes
    /// do not reach half of the tooth passing frequency.
    pub fn new(
        idling: &Scene,
        cut: &Cut,
        washboarding: &Washboarding,
        run: &CutRun,
        highest: f64,
    ) -> Result<Self, WashboardError> {
        let fastest = highest * run.speed_rad_per_s;
        let swept = idling.swept(SpeedRange::new(0.0, fastest))?;
        let chosen = ChosenBasis::new(&swept, idling.tolerance())?;
        let needed = needed(&chosen.saw.plate, washboarding, run, fastest)?;
        let plate = complete_plate(idling, chosen.saw.plate, fastest, needed)?.in_cut(cut, run);
        let full = GyroscopicSystem::of_plate(&plate);
        if !full.free_rigid.is_empty() {
            return Err(WashboardError::Loose);
        }
        let all = Shapes::new(&full, run.speed_rad_per_s)?;
        let arc = columns(&arc(&plate, washboarding))?;
        let searched_to = complete_to(&plate, fastest)?.min(needed);
        let Kept {
            count: kept,
            complete_to,
        } = all.kept(&plate, run.speed_rad_per_s, searched_to)?;
        let passing = washboarding.tooth_passing_rad_per_s(run.speed_rad_per_s);
        if complete_to < 0.5 * passing {
            return Err(WashboardError::Incomplete {
                rpm: run.rpm,
                passing_hz: passing / TAU,
                complete_hz: complete_to / TAU,
            });
        }
        let shapes = all.vectors.subcols(0, kept).to_owned();
        let moved = all.vectors.transpose() * &arc;
        Ok(Motions {
            system: full.project(shapes.as_ref()),
            columns: moved.subrows(0, kept).to_owned(),
            flexibility: all.flexibility_beyond(kept, &moved),
            most_moved: most_moved(&moved, kept),
            complete_to_rad_per_s: complete_to,
            needed_to_rad_per_s: needed,
            estimated_relative_error: chosen.estimated_relative_error,
            shapes,
            plate,
        })
    }

    /// The saw with the delayed force at a speed.
    ///
    /// # Errors
    /// [`WashboardError::Undamped`] if a mode loses no energy.
    pub fn delayed_at(
        &self,
        washboarding: &Washboarding,
        speed_rad_per_s: f64,
    ) -> Result<DelayedSaw, WashboardError> {
        let saw = DelayedSaw::new(
            &self.system,
            &self.columns,
            self.flexibility.clone(),
            washboarding,
            speed_rad_per_s,
        )?;
        let undamped = |pole: &&faer::c64| pole.re.abs() <= LEAST_DAMPING * pole.norm();
        match saw.transfer.poles.iter().find(undamped) {
            Some(pole) => Err(WashboardError::Undamped {
                rpm: rpm(speed_rad_per_s),
                frequency_hz: pole.im.abs() / TAU,
            }),
            None => Ok(saw),
        }
    }

    /// Cutting stiffness in N/m up to which damping alone prevents the growth of every omitted mode.
    pub fn safe_beyond_n_per_m(&self, washboarding: &Washboarding) -> f64 {
        let fed = washboarding.typed.overlap * self.most_moved;
        withstood_n_per_m(&self.plate, self.complete_to_rad_per_s, fed)
    }
}

/// Cutting stiffness below which a mode of frequency ω and decay rate δ cannot grow: k = 2ωδ/(μ xᵀPx), because
/// the force feeds the mode at a rate of at most kμ xᵀPx/2ω. It rises with the frequency. `fed` is μ xᵀPx.
fn withstood_n_per_m(plate: &Plate, omega: f64, fed: f64) -> f64 {
    let Some(damping) = &plate.damping else {
        return 0.0;
    };
    let air = damping.air_n_s_per_m3 / plate.blade.mass_per_area_kg_per_m2();
    let material = damping.material_retardation_time_s * omega * omega;
    let decay = 0.5 * (air + material) + damping.smallest_ratio() * omega;
    if fed > 0.0 {
        2.0 * omega * decay / fed
    } else {
        f64::INFINITY
    }
}

/// Frequency up to which all modes are needed: above tooth passing, and up to the frequency above which damping
/// alone prevents growth.
fn needed(
    plate: &Plate,
    washboarding: &Washboarding,
    run: &CutRun,
    fastest: f64,
) -> Result<f64, WashboardError> {
    let passing = washboarding.tooth_passing_rad_per_s(fastest);
    let system = GyroscopicSystem::of_plate(plate);
    let shapes = Shapes::new(&system, run.speed_rad_per_s)?;
    let moved = shapes.vectors.transpose() * columns(&arc(plate, washboarding))?;
    let kept = shapes.up_to(passing);
    let fed = washboarding.typed.overlap * most_moved(&moved, kept);
    let stiffness = WITHSTOOD * washboarding.typed.stiffness_n_per_m;
    let mut needed = BEYOND_TOOTH_PASSING * passing;
    while withstood_n_per_m(plate, needed, fed) < stiffness && needed < MOST_BEYOND * passing {
        needed *= 1.05;
    }
    Ok(needed)
}

/// Shapes of the blade in its rotating frame, the eigenvectors of S = K₀ + Ω²K_σ with contacts, in order of
/// their frequencies. Without guides they are the modes at this speed.
struct Shapes {
    squares: Vec<f64>,
    vectors: Mat<f64>,
}

/// The shapes that are kept.
struct Kept {
    count: usize,
    /// Frequency in space up to which they represent the modes.
    complete_to: f64,
}

impl Shapes {
    fn new(system: &GyroscopicSystem, speed_rad_per_s: f64) -> Result<Self, SpectrumError> {
        let gyroscopic = &system.gyroscopic;
        let tension = &system.spin + gyroscopic.transpose() * gyroscopic;
        let stiffness = &system.stiffness + Scale(speed_rad_per_s.powi(2)) * tension;
        let eigen =
            SymmetricEigen::new(stiffness.as_ref()).map_err(SpectrumError::at(speed_rad_per_s))?;
        Ok(Shapes {
            squares: eigen.values,
            vectors: eigen.vectors,
        })
    }

    /// Number of shapes below a frequency.
    fn up_to(&self, omega: f64) -> usize {
        self.squares
            .partition_point(|square| *square <= omega * omega)
    }

    /// The shapes that represent the modes up to a frequency in space; if these are too many, the largest allowed
    /// number.
    fn kept(&self, plate: &Plate, speed: f64, complete_to: f64) -> Result<Kept, SpectrumError> {
        let turned = most_turned(plate, speed, complete_to)?;
        let count = self.up_to(BEYOND_MODES * (complete_to + turned));
        if count <= MOST_SHAPES {
            return Ok(Kept { count, complete_to });
        }
        let highest = self.squares[MOST_SHAPES].max(0.0).sqrt();
        Ok(Kept {
            count: MOST_SHAPES,
            complete_to: (highest / BEYOND_MODES - turned).max(0.0),
        })
    }

    /// Static flexibility, under forces on the arc, of the shapes beyond the first `kept`. It is positive
    /// definite, because these shapes are stiff.
    fn flexibility_beyond(&self, kept: usize, moved: &Mat<f64>) -> DMatrix<f64> {
        let size = moved.ncols();
        DMatrix::from_fn(size, size, |i, j| {
            let beyond = kept..self.squares.len();
            let each = beyond.map(|k| moved[(k, i)] * moved[(k, j)] / self.squares[k]);
            each.sum()
        })
    }
}

/// Largest xᵀPx of the lower shapes, with xᵀx = 1.
fn most_moved(moved: &Mat<f64>, kept: usize) -> f64 {
    let each = (0..kept).map(|k| moved.row(k).squared_norm_l2());
    each.fold(0.0, f64::max)
}

/// P, the mean of φφᵀ over the arc of the rim.
fn arc(plate: &Plate, washboarding: &Washboarding) -> Mat<f64> {
    let mut terms = ContactTerms::default();
    washboarding.unit_spring().add_to(plate, &mut terms);
    let order = plate.degrees_of_freedom();
    let stiffness = terms.stiffness().cloned();
    stiffness.unwrap_or_else(|| Mat::zeros(order, order))
}

/// B with BBᵀ = P, without the columns that are rounding compared with the largest one.
fn columns(arc: &Mat<f64>) -> Result<Mat<f64>, SpectrumError> {
    const LEAST: f64 = 1e-8;
    let order = arc.nrows();
    let eigen = SymmetricEigen::new(arc.as_ref()).map_err(SpectrumError::at(0.0))?;
    let largest = eigen.values[order - 1];
    let kept: Vec<usize> = (0..order)
        .filter(|&k| eigen.values[k] > LEAST * largest)
        .collect();
    Ok(Mat::from_fn(order, kept.len(), |i, k| {
        eigen.vectors[(i, kept[k])] * eigen.values[kept[k]].sqrt()
    }))
}

/// The plate, or the first larger one that represents all modes up to a frequency.
fn complete_plate(
    scene: &Scene,
    plate: Plate,
    fastest: f64,
    needed: f64,
) -> Result<Plate, SpectrumError> {
    let Resolution {
        max_diameters,
        radial_functions,
    } = plate.resolution;
    let mut plate = plate;
    let larger = DENSE_LADDER
        .iter()
        .copied()
        .filter(|(n, j)| *n > max_diameters && *j >= radial_functions);
    for (max_diameters, radial_functions) in larger {
        if complete_to(&plate, fastest)? >= needed {
            break;
        }
        let resolution = Resolution {
            max_diameters,
            radial_functions,
        };
        plate = Plate::new(scene, resolution);
    }
    Ok(plate)
}

/// Frequency in space up to which the basis represents all modes, limited by the backward wave with the most
/// nodal diameters at the fastest speed, and by the most nodal circles.
fn complete_to(plate: &Plate, fastest: f64) -> Result<f64, SpectrumError> {
    let last = plate.max_diameters();
    let circles = plate.basis.count().saturating_sub(RADIAL_MARGIN);
    let waves = body_frequency(plate, last, 0, 0.0)? - last as f64 * fastest;
    Ok(waves.min(body_frequency(plate, 0, circles, 0.0)?).max(0.0))
}

/// Frequency in the body frame of the shape with n nodal diameters and k nodal circles; zero for a shape that buckles.
fn body_frequency(plate: &Plate, n: usize, k: usize, speed: f64) -> Result<f64, SpectrumError> {
    let block = plate.harmonics[n].body_frame_stiffness(speed);
    let size = plate.basis.count();
    let squares =
        symmetric_eigenvalues(block.get(..size, ..size)).map_err(SpectrumError::at(speed))?;
    Ok(squares[k].max(0.0).sqrt())
}

/// Largest difference between the frequency in the body frame and in space, nΩ for a wave of n diameters, of
/// the modes up to a frequency in space.
fn most_turned(plate: &Plate, speed: f64, complete_to: f64) -> Result<f64, SpectrumError> {
    let mut within = 0;
    for n in 0..=plate.max_diameters() {
        if body_frequency(plate, n, 0, speed)? - n as f64 * speed <= complete_to {
            within = n;
        }
    }
    Ok(within as f64 * speed)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At 1e200 rad/s the stiffness of the tension overflows; a frequency of 0 Hz would be taken for a wave that every speed turns.
    #[test]
    fn an_eigenproblem_without_a_result_is_refused() {
        let resolution = Resolution {
            max_diameters: 3,
            radial_functions: 4,
        };
        let plate = Plate::new(&Scene::paper(), resolution);
        for n in 0..=3 {
            assert!(body_frequency(&plate, n, 0, 100.0).is_ok());
            let found = body_frequency(&plate, n, 0, 1e200);
            assert!(
                matches!(found, Err(SpectrumError::NotFinite { .. })),
                "{n}: {found:?}"
            );
        }
        assert!(most_turned(&plate, 1e200, 1e3).is_err());
    }
}
