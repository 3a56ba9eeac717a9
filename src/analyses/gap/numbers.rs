//! Numbers of one saw with guides with a gap, for studies and placements of many.

use crate::analyses::board_deviation::pressed;
use crate::model::plate::Resolution;
use crate::model::scene::{RefusedValue, Scene, rpm, speed_rad_per_s};
use crate::motion::stretched_blade::Deviation;

use super::amplitude::{OscillatingSaw, first_critical};
use super::error::GapError;
use super::options::Options;

/// Speed and amplitude for which [`GapNumbers`] are computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GapCase {
    rpm: f64,
    amplitude_m: Option<f64>,
}

/// A saw under its side force.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GapNumbers {
    /// Deflection of the rim at the cut, as an absolute value; `None` if the model is not valid.
    pub deflection_m: Option<f64>,
    /// Largest force of a pad, as an absolute value; `None` if the model is not valid.
    pub largest_pad_force_n: Option<f64>,
    /// First critical speed with the mean stiffness of the guides over an oscillation of the amplitude; `None` without
    /// an amplitude or without a critical speed.
    pub critical_at_amplitude_rpm: Option<f64>,
}

/// Largest amplitude that is accepted; no blade oscillates as far.
const MAX_AMPLITUDE_M: f64 = 1.0;

impl GapCase {
    /// The speed of the options or the operating speed, and an amplitude at the guides.
    ///
    /// # Errors
    /// [`RefusedValue`] as [`Options::checked`], if there is no speed, and for an invalid amplitude.
    pub fn new(
        scene: &Scene,
        options: &Options,
        amplitude_m: Option<f64>,
    ) -> Result<Self, RefusedValue> {
        options.checked_still(scene)?;
        let typed = match options.rpm {
            Some(typed) => typed,
            None => rpm(speed_rad_per_s("rpm", scene.needed_operating_rpm(None)?)?),
        };
        if let Some(amplitude) = amplitude_m
            && !(amplitude > 0.0 && amplitude <= MAX_AMPLITUDE_M)
        {
            let allowed = "above 0 and at most 1 m";
            let remedy = "give the amplitude of an oscillation at the guides, such as 1e-4";
            return Err(RefusedValue::new("amplitude_m", amplitude, allowed, remedy));
        }
        Ok(GapCase {
            rpm: typed,
            amplitude_m,
        })
    }

    /// The scene with guides of their mean stiffness over an oscillation of the amplitude; the scene itself without an
    /// amplitude.
    ///
    /// # Errors
    /// [`GapError::Scene`].
    pub fn at_amplitude(&self, scene: &Scene) -> Result<Scene, GapError> {
        match self.amplitude_m {
            Some(amplitude_m) => {
                let resolution = Resolution::of(scene.accuracy());
                Ok(OscillatingSaw::new(scene, resolution)?.at(amplitude_m)?.0)
            }
            None => Ok(scene.clone()),
        }
    }

    /// Amplitude at the guides, in m; `None` if guides have their full stiffness.
    pub fn amplitude_m(&self) -> Option<f64> {
        self.amplitude_m
    }

    /// Deflection at the cut in m, as an absolute value; `None` if the model is not valid.
    ///
    /// # Errors
    /// [`GapError`].
    pub fn deflection_m(
        &self,
        scene: &Scene,
        resolution: Resolution,
    ) -> Result<Option<f64>, GapError> {
        let found = self.deviation(scene, resolution)?;
        Ok(found.map(|found| found.deviation_m.abs()))
    }

    fn deviation(
        &self,
        scene: &Scene,
        resolution: Resolution,
    ) -> Result<Option<Deviation>, GapError> {
        Ok(pressed(scene, resolution, self.rpm)?)
    }

    /// The numbers of a saw on a basis.
    ///
    /// # Errors
    /// [`GapError`].
    pub fn numbers(&self, scene: &Scene, resolution: Resolution) -> Result<GapNumbers, GapError> {
        let found = self.deviation(scene, resolution)?;
        let critical_at_amplitude_rpm = match self.amplitude_m {
            Some(amplitude_m) => {
                let saw = OscillatingSaw::new(scene, resolution)?;
                first_critical(&saw, resolution, amplitude_m)?.map(rpm)
            }
            None => None,
        };
        Ok(GapNumbers {
            deflection_m: found.as_ref().map(|found| found.deviation_m.abs()),
            largest_pad_force_n: found.map(|found| found.largest_pad_force_n()),
            critical_at_amplitude_rpm,
        })
    }
}
