//! What single commands need of a scene: blocks that a scene may leave out.

use super::check::MAX_RPM;
use super::{
    Cut, CutRun, Measured, RefusedValue, RunUp, Scene, SceneError, SpeedRange, Washboarding,
    rad_per_s, rpm,
};
use crate::text::shown;

impl Scene {
    /// The cut, for a command that cannot do without.
    ///
    /// # Errors
    /// [`RefusedValue`] where the scene has none.
    pub fn needed_cut(&self) -> Result<&Cut, RefusedValue> {
        let allowed = "given, with the forces on the teeth";
        let remedy = "add it to the scene";
        self.cut()
            .ok_or_else(|| RefusedValue::missing("cut", allowed, remedy))
    }

    /// The cut, with a force that depends on the surface left by the tooth before.
    ///
    /// # Errors
    /// [`RefusedValue`] where the scene lacks one of them.
    pub fn needed_washboarding(&self) -> Result<&Cut, RefusedValue> {
        let cut = self.needed_cut()?;
        cut.needed_washboarding().map(|_| cut)
    }

    /// The run-up.
    ///
    /// # Errors
    /// [`RefusedValue`] where the scene has none.
    pub fn needed_runup(&self) -> Result<&RunUp, RefusedValue> {
        let allowed = "given, with its speeds, duration and force";
        let remedy = "add it to the scene";
        self.runup()
            .ok_or_else(|| RefusedValue::missing("runup", allowed, remedy))
    }

    /// The frequencies measured of the saw.
    ///
    /// # Errors
    /// [`RefusedValue`] where the scene has none.
    pub fn needed_measured(&self) -> Result<&Measured, RefusedValue> {
        let allowed = "given, with the frequencies measured of the saw";
        let remedy = "give a table of them, or add it to the scene";
        let measured = self.file.measured.as_ref();
        measured.ok_or_else(|| RefusedValue::missing("measured", allowed, remedy))
    }

    /// The speed at which the saw is run: the one asked for, in rpm, else the scene's.
    ///
    /// # Errors
    /// [`RefusedValue`] where there is none.
    pub fn needed_operating_rpm(&self, asked: Option<f64>) -> Result<f64, RefusedValue> {
        let allowed = "the speed at which the saw is run";
        let remedy = "give it, or operating_rpm in the scene";
        let rpm = asked.or(self.file.operating_rpm);
        rpm.ok_or_else(|| RefusedValue::missing("operating_rpm", allowed, remedy))
    }
}

impl Cut {
    /// The force that depends on the surface left by the tooth before.
    ///
    /// # Errors
    /// [`RefusedValue`] where the scene has none.
    pub(crate) fn needed_washboarding(&self) -> Result<&Washboarding, RefusedValue> {
        let allowed = "given, with the cutting stiffness across the blade";
        let remedy = "add it to the scene's cut";
        let washboarding = self.washboarding.as_ref();
        washboarding.ok_or_else(|| RefusedValue::missing("cut.washboarding", allowed, remedy))
    }

    /// The forces at the speeds asked for, in rpm; without any, those of the scene's.
    ///
    /// # Errors
    /// [`SceneError`] where there is no speed at all, or as [`Cut::at_rpm`].
    pub fn runs_at(&self, rpm: &[f64]) -> Result<Vec<CutRun>, SceneError> {
        let asked = rpm.iter().map(|rpm| self.at_rpm(*rpm));
        let asked = asked.collect::<Result<Vec<CutRun>, _>>()?;
        let runs = if asked.is_empty() {
            self.runs.clone()
        } else {
            asked
        };
        if runs.is_empty() {
            let allowed = "given, with a speed to cut at";
            let remedy = "name a speed, or add it or operating_rpm to the scene";
            return Err(RefusedValue::missing("cut.speeds", allowed, remedy).into());
        }
        Ok(runs)
    }
}

impl From<(f64, f64)> for SpeedRange {
    /// From the first to the last speed, in rad/s.
    fn from((from_rad_per_s, to_rad_per_s): (f64, f64)) -> Self {
        SpeedRange {
            from_rad_per_s,
            to_rad_per_s,
        }
    }
}

/// As a speed in rpm is told: its last digits are those of the conversion.
fn told(rad_per_s: f64) -> f64 {
    (1e3 * rpm(rad_per_s)).round() / 1e3
}

impl SpeedRange {
    /// The speed of an argument in rpm, in rad/s.
    ///
    /// # Errors
    /// [`RefusedValue`] where it is not within the range.
    pub fn speed_at(&self, key: &str, rpm: f64) -> Result<f64, RefusedValue> {
        let speed = rad_per_s(rpm);
        let (from, to) = (self.from_rad_per_s, self.to_rad_per_s);
        // The end of a sweep is not told from its value in rpm.
        if from <= speed * (1.0 + 1e-12) && speed * (1.0 - 1e-12) <= to {
            return Ok(speed);
        }
        let allowed = format!(
            "from {} to {}, the speeds of the sweep",
            shown(told(from)),
            shown(told(to))
        );
        let remedy = "name one of these, or widen `sweep` in the scene";
        Err(RefusedValue::new(key, rpm, allowed, remedy))
    }
}

/// A rotation speed above zero, in rad/s, of an argument in rpm.
pub(crate) fn speed_rad_per_s(key: &str, rpm: f64) -> Result<f64, RefusedValue> {
    if rpm > 0.0 && rpm <= MAX_RPM {
        return Ok(rad_per_s(rpm));
    }
    let allowed = format!("above 0 and at most {}", shown(MAX_RPM));
    let remedy = "give it in revolutions per minute";
    Err(RefusedValue::new(key, rpm, allowed, remedy))
}
