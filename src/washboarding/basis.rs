//! The motions that washboarding is made of: all modes up to the tooth passing frequency and beyond.

use std::f64::consts::TAU;

use faer::{Col, Mat, Side};

use super::delayed::DelayedSaw;
use super::{WashboardError, columns};
use crate::plate::{Contact, ContactTerms, Plate, Resolution};
use crate::scene::{Cut, CutRun, Scene, SpeedRange, Washboarding, rpm};
use crate::spectrum::SpectrumError;
use crate::stability::{ChosenBasis, LADDER};
use crate::system::{GyroscopicSystem, body_frame_stiffness};
use crate::transient::{ReducedBlade, Snapshot};

/// The saw in the cut on its lower modes.
#[derive(Debug)]
pub struct Motions {
    /// The saw in the cut.
    pub plate: Plate,
    /// The motions, and the whole saw on them.
    pub blade: ReducedBlade,
    pub system: GyroscopicSystem,
    /// B of the arc on them.
    pub columns: Mat<f64>,
    pub complete_to_rad_per_s: f64,
    pub needed_to_rad_per_s: f64,
    pub estimated_relative_error: f64,
}

/// The modes reach beyond the tooth passing frequency of the fastest speed by this factor: a mode is
/// driven when teeth pass at up to twice its frequency, and most of all right above it.
const BEYOND_TOOTH_PASSING: f64 = 1.05;
/// Shapes at rest reach beyond the modes that they are to span by this factor.
const BEYOND_MODES: f64 = 1.2;
/// Radial functions that the highest shape without nodal diameters needs beside those of its kind.
const RADIAL_MARGIN: usize = 3;
/// Modes of the saw at the speed of the cut that are spanned exactly.
const EXACT_MODES: usize = 16;
/// Share of |λ| that a mode has to lose to be damped at all.
const LEAST_DAMPING: f64 = 1e-8;

impl Motions {
    /// Of an idling saw, put into its cut; for speeds up to `highest` times that of the cut.
    pub fn new(
        idling: &Scene,
        cut: &Cut,
        washboarding: &Washboarding,
        run: &CutRun,
        highest: f64,
    ) -> Result<Self, WashboardError> {
        let fastest = highest * run.speed_rad_per_s;
        let needed = BEYOND_TOOTH_PASSING * washboarding.tooth_passing_rad_per_s(fastest);
        let swept = idling.swept(SpeedRange {
            from_rad_per_s: 0.0,
            to_rad_per_s: fastest,
        })?;
        let chosen = ChosenBasis::new(&swept, idling.tolerance())?;
        let idle = complete_plate(idling, chosen.plate, fastest, needed);
        let plate = idle.in_cut(cut, run);
        let full = GyroscopicSystem::of_plate(&plate);
        if !full.free_rigid.is_empty() {
            return Err(WashboardError::Loose);
        }
        let arc = columns(&arc(&plate, washboarding))?;
        let blade = motions(&plate, &full, &arc, run, needed.min(complete_to(&plate, fastest)))?;
        Ok(Motions {
            system: blade.system(&full),
            columns: blade.basis().transpose() * &arc,
            complete_to_rad_per_s: complete_to(&plate, fastest).min(needed),
            needed_to_rad_per_s: needed,
            estimated_relative_error: chosen.estimated_relative_error,
            blade,
            plate,
        })
    }

    /// The saw with the delayed force at a speed.
    pub fn delayed_at(
        &self,
        washboarding: &Washboarding,
        speed_rad_per_s: f64,
    ) -> Result<DelayedSaw, WashboardError> {
        let saw = DelayedSaw::new(&self.system, &self.columns, washboarding, speed_rad_per_s)?;
        let undamped = |pole: &&faer::c64| pole.re.abs() <= LEAST_DAMPING * pole.norm();
        match saw.transfer.poles.iter().find(undamped) {
            Some(pole) => Err(WashboardError::Undamped {
                rpm: rpm(speed_rad_per_s),
                frequency_hz: pole.im.abs() / TAU,
            }),
            None => Ok(saw),
        }
    }

    /// A mode of frequency ω that decays by δ is fed by no more than kμ xᵀPx/2ω: it cannot grow below
    /// 2ωδ/(μ xᵀPx). Beyond the modes kept, ω and δ are no less than there, and xᵀPx is taken from those
    /// kept.
    pub fn safe_beyond_n_per_m(&self, washboarding: &Washboarding) -> f64 {
        let Some(damping) = self.plate.damping else {
            return 0.0;
        };
        let omega = self.complete_to_rad_per_s;
        let air = damping.air_n_s_per_m3 / self.plate.blade.mass_per_area_kg_per_m2();
        let decay = 0.5 * (air + damping.material_retardation_time_s * omega * omega);
        let fed = washboarding.overlap * self.most_moved(omega);
        match fed > 0.0 {
            true => 2.0 * omega * decay / fed,
            false => f64::INFINITY,
        }
    }
}

impl Motions {
    /// The largest xᵀPx of a shape at rest below a frequency, xᵀx = 1.
    fn most_moved(&self, highest: f64) -> f64 {
        let Ok(shapes) = self.system.stiffness.self_adjoint_eigen(Side::Lower) else {
            return f64::INFINITY;
        };
        let moved = shapes.U().transpose() * &self.columns;
        (0..moved.nrows())
            .filter(|&k| shapes.S()[k] <= highest * highest)
            .map(|k| moved.row(k).squared_norm_l2())
            .fold(0.0, f64::max)
    }
}

/// P, the mean of φφᵀ over the arc of the rim.
fn arc(plate: &Plate, washboarding: &Washboarding) -> Mat<f64> {
    let mut terms = ContactTerms::default();
    washboarding.unit_spring().add_to(plate, &mut terms);
    let order = plate.degrees_of_freedom();
    let stiffness = terms.stiffness().cloned();
    stiffness.unwrap_or_else(|| Mat::zeros(order, order))
}

/// The plate, or the first larger one that holds all modes up to a frequency.
fn complete_plate(scene: &Scene, plate: Plate, fastest: f64, needed: f64) -> Plate {
    let Resolution {
        max_diameters,
        radial_functions,
    } = plate.resolution;
    let mut plate = plate;
    let larger = LADDER.into_iter();
    for (diameters, functions) in larger.filter(|(n, j)| *n > max_diameters && *j >= radial_functions) {
        if complete_to(&plate, fastest) >= needed {
            break;
        }
        let resolution = Resolution {
            max_diameters: diameters,
            radial_functions: functions,
        };
        plate = Plate::new(scene, resolution);
    }
    plate
}

/// Frequency in space up to which the basis has all modes: the backward wave of the most nodal
/// diameters at the fastest speed, and the most nodal circles.
fn complete_to(plate: &Plate, fastest: f64) -> f64 {
    let last = plate.max_diameters();
    let frequency = |n: usize, k: usize| -> f64 {
        let block = body_frame_stiffness(&plate.harmonics[n], 0.0);
        let values = block.self_adjoint_eigenvalues(Side::Lower);
        let square = values.ok().and_then(|values| values.get(k).copied());
        square.unwrap_or(0.0).max(0.0).sqrt()
    };
    let circles = plate.basis.count().saturating_sub(RADIAL_MARGIN);
    let waves = frequency(last, 0) - last as f64 * fastest;
    waves.min(frequency(0, circles)).max(0.0)
}

/// Shapes at rest up to the highest that the modes up to a frequency in space are made of, the lowest
/// modes at the speed of the cut, and the static answers to forces on the arc.
fn motions(
    plate: &Plate,
    full: &GyroscopicSystem,
    arc: &Mat<f64>,
    run: &CutRun,
    complete_to: f64,
) -> Result<ReducedBlade, SpectrumError> {
    let speed = run.speed_rad_per_s;
    let snapshot = Snapshot {
        system: full,
        speed_rad_per_s: speed,
    };
    let loads: Vec<Col<f64>> = (0..arc.ncols()).map(|k| arc.col(k).to_owned()).collect();
    let blade = ReducedBlade::new(plate, &[snapshot], EXACT_MODES, &loads);
    // Of a wave of n diameters the blade sees its frequency in space and n times the speed.
    let waves = 0..=plate.max_diameters();
    let on_blade = waves.map(|n| {
        let block = body_frame_stiffness(&plate.harmonics[n], speed);
        let values = block.self_adjoint_eigenvalues(Side::Lower);
        let lowest = values.ok().and_then(|values| values.first().copied());
        let lowest = lowest.unwrap_or(0.0).max(0.0).sqrt();
        let turned = n as f64 * speed;
        if lowest - turned <= complete_to {
            complete_to + turned
        } else {
            0.0
        }
    });
    let highest = on_blade.fold(0.0, f64::max);
    blade.with_shapes_below(full, BEYOND_MODES * highest)
}
