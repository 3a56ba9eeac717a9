//! Bases of a few shapes for a blade that stretches.

use std::sync::Arc;

use faer::{Col, Mat, Scale};

use crate::model::linalg::SymmetricEigen;
use crate::model::plate::{GapPotential, Plate, ReducedStretching, Stretching};
use crate::model::system::GyroscopicSystem;
use crate::modes::{
    Assembled, SpectrumError, frequency_scale, lowest_eigenpairs, orthonormal, split,
};

use super::{StretchedBlade, StretchedError, finite};
use crate::model::scene::Polar;

/// Smallest number of modes at rest within the gaps that are added to the shapes: heave, tilts, and the first
/// of two and three diameters.
const MIN_RELEASED: usize = 8;
/// Number of speeds at which the deflection of the linear model is in the basis. Between them, on bases up to 1200 rpm, the
/// compliance of six saws at 700 rpm differs from that of the full model by at most 9e-9.
const BENT: usize = 3;
/// Shapes at a smaller relative distance from the span of the others are omitted.
pub(super) const INDEPENDENT: f64 = 1e-7;

impl StretchedBlade {
    /// The blade in the basis of the lowest `shapes` modes at rest of the plate without damping; no side
    /// force.
    ///
    /// # Errors
    /// [`StretchedError::NotHeld`], [`StretchedError::Shapes`], [`StretchedError::Spectrum`] if eigenvectors
    /// are not found, [`StretchedError::Stretching`].
    pub fn new(plate: &Plate, shapes: usize) -> Result<Self, StretchedError> {
        let plate = plate.conservative();
        let full = restrained(&plate, shapes)?;
        let basis = at_rest(&full)?.vectors.subcols(0, shapes).to_owned();
        Self::on(plate, &full, basis)
    }

    /// The blade in the basis of the lowest `modes` modes at a speed, each with both phases. The
    /// eigenvalues of these modes are those of the full model, as narrow flutter bands require.
    ///
    /// # Errors
    /// [`StretchedError`] as for [`StretchedBlade::new`], and [`StretchedError::Value`].
    pub fn at_speed(
        plate: &Plate,
        speed_rad_per_s: f64,
        modes: usize,
    ) -> Result<Self, StretchedError> {
        finite("the speed in rad/s", speed_rad_per_s)?;
        let plate = plate.conservative();
        let full = restrained(&plate, modes)?;
        let shift = frequency_scale(&plate);
        let lowest = lowest_eigenpairs(&full, speed_rad_per_s, modes, shift)?;
        let phases = lowest
            .into_iter()
            .flat_map(|(_, q)| <[Col<f64>; 2]>::from(split(&q)));
        let basis = orthonormal(full.order(), &phases.collect::<Vec<_>>(), INDEPENDENT);
        Self::on(plate, &full, basis)
    }

    /// The blade in a basis for equilibria up to a speed under a force at a point (radius in m, angle in rad): the
    /// shapes of the critical speeds up to this speed, the deflections of the linear model under the force at rest, at this
    /// speed and between, and the lowest `modes` modes at rest.
    ///
    /// # Errors
    /// [`StretchedError`] as for [`StretchedBlade::new`], and [`StretchedError::Value`].
    pub fn up_to(
        plate: &Plate,
        to_rad_per_s: f64,
        place: Polar,
        modes: usize,
    ) -> Result<Self, StretchedError> {
        Self::up_to_with(plate, to_rad_per_s, &[(place, 1.0)], modes, &[])
    }

    /// The blade in the basis of [`StretchedBlade::up_to`] for a force on several points, each with its share, with further shapes of
    /// unit length.
    pub(crate) fn up_to_with(
        plate: &Plate,
        to_rad_per_s: f64,
        places: &[(Polar, f64)],
        modes: usize,
        further: &[Col<f64>],
    ) -> Result<Self, StretchedError> {
        ForcedPlate::new(plate, to_rad_per_s, places)?.blade(modes, further)
    }

    /// The blade in a basis of given shapes, orthonormal columns in the functions of the plate.
    ///
    /// # Errors
    /// [`StretchedError`] as for [`StretchedBlade::new`].
    pub(crate) fn of_shapes(plate: &Plate, shapes: Mat<f64>) -> Result<Self, StretchedError> {
        let plate = plate.conservative();
        let full = restrained(&plate, shapes.ncols())?;
        Self::on(plate, &full, shapes)
    }

    /// The blade in a basis of given orthonormal shapes. If pads lift off, the lowest modes at rest inside their gaps
    /// are added.
    pub(super) fn on(
        plate: Plate,
        full: &GyroscopicSystem,
        shapes: Mat<f64>,
    ) -> Result<Self, StretchedError> {
        let stretching = Stretching::new(&plate)?;
        Self::stretched(plate, full, &stretching, shapes)
    }

    /// As [`StretchedBlade::on`], with a known potential of stretching.
    fn stretched(
        plate: Plate,
        full: &GyroscopicSystem,
        stretching: &Stretching,
        shapes: Mat<f64>,
    ) -> Result<Self, StretchedError> {
        let Some(released) = GyroscopicSystem::of_released(&plate) else {
            return Self::with(plate, stretching, full, shapes);
        };
        let order = released.order();
        let modes = at_rest(&released)?;
        let count = MIN_RELEASED.max(shapes.ncols() / 2).min(order);
        let own = (0..shapes.ncols()).map(|k| shapes.col(k).to_owned());
        let of_released = (0..count).map(|k| modes.vectors.col(k).to_owned());
        let all: Vec<Col<f64>> = own.chain(of_released).collect();
        let shapes = orthonormal(order, &all, INDEPENDENT);
        let gaps = GapPotential::new(&plate, shapes.as_ref());
        let blade = Self::with(plate, stretching, &released, shapes)?;
        Ok(StretchedBlade { gaps, ..blade })
    }

    /// The blade in a basis of given orthonormal shapes, with a known potential and without pads that lift off.
    pub(super) fn with(
        plate: Plate,
        stretching: &Stretching,
        full: &GyroscopicSystem,
        shapes: Mat<f64>,
    ) -> Result<Self, StretchedError> {
        Ok(StretchedBlade {
            system: full.project(shapes.as_ref()),
            force: Col::zeros(shapes.ncols()),
            stretching: ReducedStretching::new(stretching, shapes.as_ref())?,
            gaps: None,
            shapes,
            plate,
        })
    }
}

/// A plate under a force on some points, with the part of [`StretchedBlade::up_to`] that no number of modes changes.
pub(crate) struct ForcedPlate {
    saw: Assembled,
    full: GyroscopicSystem,
    stretching: Arc<Stretching>,
    /// Shapes of the critical speeds, and deflections of the linear model.
    shapes: Vec<Col<f64>>,
}

impl ForcedPlate {
    /// The plate for equilibria up to a speed, with a force on some points, each with its share.
    ///
    /// # Errors
    /// [`StretchedError`] as for [`StretchedBlade::up_to`].
    pub fn new(
        plate: &Plate,
        to_rad_per_s: f64,
        places: &[(Polar, f64)],
    ) -> Result<Self, StretchedError> {
        finite("the speed in rad/s", to_rad_per_s)?;
        let stretching = Arc::new(Stretching::new(plate)?);
        Self::stretched(plate, to_rad_per_s, places, stretching)
    }

    /// As [`ForcedPlate::new`], with the known potential of stretching, which neither heat nor guides change.
    ///
    /// # Errors
    /// [`StretchedError`] as for [`StretchedBlade::up_to`].
    pub fn stretched(
        plate: &Plate,
        to_rad_per_s: f64,
        places: &[(Polar, f64)],
        stretching: Arc<Stretching>,
    ) -> Result<Self, StretchedError> {
        finite("the speed in rad/s", to_rad_per_s)?;
        let plate = plate.conservative();
        let full = restrained(&plate, 1)?;
        let saw = Assembled::from(plate);
        let critical = saw.critical_speeds(Some(&|_| to_rad_per_s))?.into_iter();
        let diverging = critical.take_while(|c| c.speed_rad_per_s <= to_rad_per_s);
        let mut shapes: Vec<Col<f64>> = diverging
            .map(|c| saw.on_plate(c.component, &c.shape))
            .collect();
        let force = saw.plate.load_at(places);
        shapes.extend(bent(&saw, &force, to_rad_per_s));
        Ok(ForcedPlate {
            stretching,
            saw,
            full,
            shapes,
        })
    }

    /// The blade in the basis of [`StretchedBlade::up_to`], with further shapes of unit length, without a force.
    ///
    /// # Errors
    /// [`StretchedError`] as for [`StretchedBlade::new`].
    pub fn blade(
        &self,
        modes: usize,
        further: &[Col<f64>],
    ) -> Result<StretchedBlade, StretchedError> {
        enough(&self.full, modes)?;
        let rest = self.saw.modes_at_rest(modes)?;
        let rest = rest
            .iter()
            .map(|mode| self.saw.on_plate(mode.component, &mode.shape));
        let shapes: Vec<Col<f64>> = self
            .shapes
            .iter()
            .cloned()
            .chain(rest)
            .chain(further.iter().cloned())
            .collect();
        let basis = orthonormal(self.full.order(), &shapes, INDEPENDENT);
        let plate = self.saw.plate.clone();
        StretchedBlade::stretched(plate, &self.full, &self.stretching, basis)
    }
}

/// Matrices of a plate; refused if nothing restrains a rigid motion, or the plate has fewer functions than shapes.
fn restrained(plate: &Plate, shapes: usize) -> Result<GyroscopicSystem, StretchedError> {
    let full = GyroscopicSystem::of_plate(plate);
    if !full.free_rigid.is_empty() {
        return Err(StretchedError::NotHeld);
    }
    enough(&full, shapes)?;
    Ok(full)
}

/// Refuses a number of shapes that is zero or larger than that of the functions.
fn enough(full: &GyroscopicSystem, shapes: usize) -> Result<(), StretchedError> {
    if (1..=full.order()).contains(&shapes) {
        Ok(())
    } else {
        Err(StretchedError::Shapes {
            given: shapes,
            most: full.order(),
        })
    }
}

/// The modes of a blade at rest, ascending.
pub(super) fn at_rest(system: &GyroscopicSystem) -> Result<SymmetricEigen, StretchedError> {
    let modes = SymmetricEigen::new(system.stiffness.as_ref());
    Ok(modes.map_err(SpectrumError::at(0.0))?)
}

/// Deflections K(Ω)⁻¹f, scaled to unit length, at rest, at a speed, and at speeds between whose squares are evenly spaced.
/// On these shapes the linear model deflects as the full model at these speeds, and nearly so between: K is linear in Ω².
fn bent(saw: &Assembled, force: &Col<f64>, to_rad_per_s: f64) -> impl Iterator<Item = Col<f64>> {
    let speed = move |k: usize| to_rad_per_s * (k as f64 / (BENT - 1) as f64).sqrt();
    let shape = move |k: usize| {
        let bent = saw.deflected(speed(k), force);
        let norm = bent.norm_l2();
        // At a critical speed there is no such deflection; its shape is in the basis already.
        (norm > 0.0 && norm.is_finite()).then(|| Scale(1.0 / norm) * bent)
    };
    (0..BENT).filter_map(shape)
}
