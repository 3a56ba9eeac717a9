//! Reason why the largest basis misses a tolerance: the guide that bends the blade most sharply, and the
//! number of functions that would be needed.

use faer::{Col, Mat};

use super::basis::{MODES_AT_REST, REMAINDER};
use super::error::AnalysisError;
use super::estimate::Estimates;
use super::ladder::{DENSE_LADDER, LADDER, ahead, diameters_beyond, resolution, rung_of, sized};
use crate::model::plate::{Contact, ContactTerms, Plate, Resolution};
use crate::model::scene::{Guide, Scene};
use crate::modes::{Assembled, BasisError};

/// Reason why an analysis misses the tolerance of its scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutOfReach {
    /// Index of the guide that contributes most to the error.
    pub guide: Option<usize>,
    /// Number of functions that would reach the tolerance if the error continues to fall with the same power
    /// as over the last two sizes; accurate to a factor of two. `None` above a million.
    pub functions: Option<f64>,
    /// Whether the basis is the largest one for a saw with damping or forces at the rim; other saws have
    /// larger bases.
    pub is_dense: bool,
}

/// Number of sizes over which the fall of the error is measured.
const STEPS_BACK: usize = 2;
/// Numbers of functions above this are not reported.
const MOST_FUNCTIONS: f64 = 1e6;

impl OutOfReach {
    /// Reason for a saw on its chosen basis, with the largest estimated error that the tolerance limits;
    /// `None` if no basis is two sizes smaller.
    ///
    /// # Errors
    /// [`AnalysisError`] when an eigenproblem of a smaller basis fails.
    pub fn of(
        scene: &Scene,
        plate: &Plate,
        to_rad_per_s: f64,
        estimates: &Estimates,
        error: f64,
    ) -> Result<Option<Self>, AnalysisError> {
        let rung = rung_of(plate.resolution);
        if rung < STEPS_BACK {
            return Ok(None);
        }
        let diameters = diameters_beyond(plate.resolution);
        let coarse = Smaller::new(scene, sized(rung - STEPS_BACK, diameters), to_rad_per_s)?;
        let critical = estimates.critical.iter().copied();
        let fine = critical.fold(estimates.at_rest, f64::max);
        let orders = [&coarse.plate, plate].map(|plate| plate.degrees_of_freedom() as f64);
        let power = (coarse.error / fine).ln() / (orders[1] / orders[0]).ln();
        let functions = orders[1] * (error / scene.tolerance()).powf(1.0 / power);
        let is_advice = power > 0.0 && functions < MOST_FUNCTIONS;
        let most = resolution(DENSE_LADDER[DENSE_LADDER.len() - 1]).degrees_of_freedom();
        let next = (rung + 1 < LADDER.len()).then(|| sized(rung + 1, diameters));
        let is_within = plate.resolution.degrees_of_freedom() <= most;
        Ok(Some(OutOfReach {
            guide: coarse.sharpest(scene.guides()),
            functions: is_advice.then_some(functions),
            is_dense: is_within && next.is_some_and(|size| size.degrees_of_freedom() > most),
        }))
    }
}

/// A saw on a smaller basis than the chosen one.
struct Smaller {
    plate: Plate,
    /// The saw on the basis that measures the error.
    finer: Plate,
    basis_error: BasisError,
    /// Largest error of a critical speed within the range, or of a frequency at rest.
    error: f64,
    /// Component of the wave with this error.
    component: usize,
    /// Unknowns of this wave in its component.
    shape: Col<f64>,
}

impl Smaller {
    fn new(scene: &Scene, size: Resolution, to_rad_per_s: f64) -> Result<Self, AnalysisError> {
        let saw = Assembled::from(Plate::new(scene, size));
        let finer = Plate::new(scene, ahead(size));
        let basis_error = BasisError::new(&saw.plate, &finer)?;
        let critical = saw.critical_speeds(Some(&|_| to_rad_per_s))?;
        let within = critical
            .into_iter()
            .filter(|c| c.speed_rad_per_s <= to_rad_per_s)
            .map(|c| {
                let error = basis_error.critical_error(&saw.components, &c);
                (error, c.component, c.shape)
            });
        let resting = saw.modes_at_rest(MODES_AT_REST)?.into_iter().map(|mode| {
            let error = basis_error.resting_error(&mode);
            (error, mode.component, mode.shape)
        });
        let all = within.chain(resting);
        let worst = all.max_by(|x, y| x.0.total_cmp(&y.0));
        let none = || (0.0, 0, Col::zeros(saw.plate.degrees_of_freedom()));
        let (error, component, shape) = worst.unwrap_or_else(none);
        Ok(Smaller {
            plate: saw.plate,
            finer,
            basis_error,
            error: REMAINDER.get() * error,
            component,
            shape,
        })
    }

    /// Index of the guide whose force on the absent functions contributes most to the error.
    fn sharpest(&self, guides: &[Guide]) -> Option<usize> {
        let shape = Mat::from_fn(self.shape.nrows(), 1, |i, _| self.shape[i]);
        let share = |guide: &Guide| {
            let mut terms = ContactTerms::default();
            guide.typed.add_to(&self.finer, &mut terms);
            let stiffness = terms.stiffness()?;
            self.basis_error
                .softening_by(self.component, stiffness, &shape)
        };
        let shares = guides
            .iter()
            .map(share)
            .enumerate()
            .filter_map(|(k, share)| Some((k, share?)));
        let sharpest = shares.max_by(|x, y| x.1.total_cmp(&y.1));
        sharpest.map(|(guide, _)| guide)
    }
}
