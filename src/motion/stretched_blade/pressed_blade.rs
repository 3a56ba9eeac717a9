//! A blade under a side force: its stationary deflection between pads that lift off.

use std::sync::Arc;

use crate::model::plate::{Plate, Resolution, Stretching};
use crate::model::scene::{Polar, Scene, rad_per_s};
use crate::modes::Cancellation;

use super::basis::ForcedPlate;
use super::equilibrium::Equilibrium;
use super::sites::Sites;
use super::slopes::Slopes;
use super::{LARGEST_SLOPE, StretchedBlade, StretchedError};

/// A stationary deflection of the blade, and its contact with the pads.
#[derive(Debug, Clone, PartialEq)]
pub struct Deviation {
    /// Deflection of the rim at the cut.
    pub deviation_m: f64,
    /// Largest deflection of the blade, as an absolute value.
    pub largest_m: f64,
    /// Force of each one-sided pad on the blade, by contact and film.
    pub pad_forces_n: Vec<f64>,
    /// Force of the blade on both faces of each one-sided pad by contact, on that at positive deflections and on the other.
    pub face_forces_n: Vec<[f64; 2]>,
    /// Smallest distance left between the blade and the faces of each one-sided pad, negative where a face is pressed in.
    pub distances_left_m: Vec<f64>,
}

impl Deviation {
    /// Largest force of a pad, as an absolute value.
    pub fn largest_pad_force_n(&self) -> f64 {
        let forces = self.pad_forces_n.iter();
        forces.map(|force| force.abs()).fold(0.0, f64::max)
    }
}

/// Radius in m and magnitude of the force in N at each point of contact.
type Contacts = Vec<(f64, f64)>;

/// A blade whose deflections under side forces can be computed.
pub(crate) struct PressedBlade {
    blade: StretchedBlade,
    /// Points of the force, each with its share.
    places: Vec<(Polar, f64)>,
    /// The rim at the cut.
    cut: Polar,
    sites: Sites,
    slopes: Slopes,
}

impl PressedBlade {
    /// Number of modes at rest in the basis of deflections.
    pub const MODES: usize = 24;

    /// The blade of a scene under its constant lateral force, for speeds up to `to_rpm`, on a basis of `modes` modes at rest.
    ///
    /// # Errors
    /// [`StretchedError`].
    pub fn new(
        scene: &Scene,
        resolution: Resolution,
        to_rpm: f64,
        modes: usize,
    ) -> Result<Self, StretchedError> {
        let plate = Plate::new(scene, resolution);
        let stretching = Arc::new(Stretching::new(&plate)?);
        Self::stretched(scene, &plate, (to_rpm, modes), stretching)
    }

    /// As [`PressedBlade::new`], for the plate of the scene and its known potential of stretching, which neither heat nor guides change.
    ///
    /// # Errors
    /// [`StretchedError`].
    pub fn stretched(
        scene: &Scene,
        plate: &Plate,
        (to_rpm, modes): (f64, usize),
        stretching: Arc<Stretching>,
    ) -> Result<Self, StretchedError> {
        let places = scene.constant_force().places;
        let modes = modes.min(plate.degrees_of_freedom());
        let forced = ForcedPlate::stretched(plate, rad_per_s(to_rpm), &places, stretching)?;
        let blade = forced.blade(modes, &[])?;
        Ok(PressedBlade {
            sites: blade.sites(),
            slopes: blade.slopes(),
            blade,
            places,
            cut: Polar::new(plate.blade.outer_radius_m, scene.cut_angle_rad()),
        })
    }

    /// The blade with all gaps multiplied by a factor.
    pub fn with_gaps(&self, factor: f64) -> Self {
        PressedBlade {
            blade: self.blade.clone().with_gaps(factor),
            sites: self.sites.clone(),
            slopes: self.slopes.clone(),
            places: self.places.clone(),
            ..*self
        }
    }

    /// The deflection under a side force at a speed; `None` if slopes exceed 0.1 and the model is not valid.
    ///
    /// # Errors
    /// [`StretchedError`].
    pub fn deviation(&self, force_n: f64, rpm: f64) -> Result<Option<Deviation>, StretchedError> {
        let (_, found) = self.settled(force_n, rpm)?;
        Ok(self.valid(&found))
    }

    /// As [`PressedBlade::deviation`], with the points of contact.
    ///
    /// # Errors
    /// [`StretchedError`].
    pub fn with_contacts(
        &self,
        force_n: f64,
        rpm: f64,
    ) -> Result<(Option<Deviation>, Contacts), StretchedError> {
        let (blade, found) = self.settled(force_n, rpm)?;
        Ok((self.valid(&found), blade.contacts(&found)))
    }

    /// Relative change of a deflection at the cut on a larger basis, where the blade moves from this deflection to an
    /// equilibrium; `None` if the model is not valid.
    ///
    /// # Errors
    /// [`StretchedError`].
    pub fn change_with(
        &self,
        finer: &PressedBlade,
        force_n: f64,
        rpm: f64,
    ) -> Result<Option<f64>, StretchedError> {
        let (coarse, found) = self.settled(force_n, rpm)?;
        let fine = finer.blade.clone().loaded(force_n, &finer.places)?;
        let from = fine.shapes().transpose() * (coarse.shapes() * &found.coordinates);
        let other = fine.settled(rad_per_s(rpm), &from)?;
        let pair = self.valid(&found).zip(finer.valid(&other));
        Ok(pair.map(|(found, other)| (other.deviation_m / found.deviation_m - 1.0).abs()))
    }

    /// The blade under a side force, and the equilibrium to which it moves from the flat shape.
    fn settled(
        &self,
        force_n: f64,
        rpm: f64,
    ) -> Result<(StretchedBlade, Equilibrium), StretchedError> {
        Cancellation::current().check()?;
        let blade = self.blade.clone().loaded(force_n, &self.places)?;
        let found = blade.settled(rad_per_s(rpm), &blade.flat())?;
        Ok((blade, found))
    }

    /// The deflection of an equilibrium; `None` if its slopes exceed 0.1.
    fn valid(&self, found: &Equilibrium) -> Option<Deviation> {
        if self.slopes.largest(&found.coordinates) > LARGEST_SLOPE {
            return None;
        }
        Some(Deviation {
            deviation_m: self
                .blade
                .deflection_m(found, self.cut.radius_m, self.cut.angle_rad),
            largest_m: self.sites.largest_m(&found.coordinates),
            pad_forces_n: self.blade.pad_forces_n(found),
            face_forces_n: self.blade.face_forces_n(found),
            distances_left_m: self.blade.distances_left_m(found),
        })
    }
}
