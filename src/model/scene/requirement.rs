//! Blocks of a scene that are optional in general but required by some commands.

use super::{Cut, CutRun, Measured, RefusedValue, RunUpFile, Scene, SceneError, Washboarding};

impl Scene {
    /// The cut, for commands that require it.
    ///
    /// # Errors
    /// [`RefusedValue`] if the scene has no cut.
    pub fn needed_cut(&self) -> Result<&Cut, RefusedValue> {
        let allowed = "given, with the forces on the teeth";
        let remedy = "add it to the scene";
        self.cut()
            .ok_or_else(|| RefusedValue::missing("cut", allowed, remedy))
    }

    /// The cut, if it has a force that depends on the surface left by the preceding tooth.
    ///
    /// # Errors
    /// [`RefusedValue`] if the scene lacks the cut or this force.
    pub fn needed_washboarding(&self) -> Result<&Cut, RefusedValue> {
        let cut = self.needed_cut()?;
        cut.needed_washboarding().map(|_| cut)
    }

    /// The run-up, for commands that require it.
    ///
    /// # Errors
    /// [`RefusedValue`] if the scene has no run-up.
    pub fn needed_runup(&self) -> Result<&RunUpFile, RefusedValue> {
        let allowed = "given, with its speeds and duration";
        let remedy = "add it to the scene";
        self.runup()
            .ok_or_else(|| RefusedValue::missing("runup", allowed, remedy))
    }

    /// The measured frequencies, for commands that require them.
    ///
    /// # Errors
    /// [`RefusedValue`] if the scene has none.
    pub fn needed_measured(&self) -> Result<&Measured, RefusedValue> {
        let allowed = "given, with the frequencies measured of the saw";
        let remedy = "give a table of them, or add it to the scene";
        let measured = self.file.measured.as_ref();
        measured.ok_or_else(|| RefusedValue::missing("measured", allowed, remedy))
    }

    /// The operating speed, in rpm: the given one, or else that of the scene.
    ///
    /// # Errors
    /// [`RefusedValue`] if there is neither.
    pub fn needed_operating_rpm(&self, given: Option<f64>) -> Result<f64, RefusedValue> {
        let allowed = "the speed at which the saw is run";
        let remedy = "give it, or operating_rpm in the scene";
        let rpm = given.or(self.file.operating_rpm);
        rpm.ok_or_else(|| RefusedValue::missing("operating_rpm", allowed, remedy))
    }
}

impl Cut {
    /// Force that depends on the surface left by the preceding tooth.
    ///
    /// # Errors
    /// [`RefusedValue`] if the cut has none.
    pub(crate) fn needed_washboarding(&self) -> Result<&Washboarding, RefusedValue> {
        let allowed = "given, with the cutting stiffness across the blade";
        let remedy = "add it to the scene's cut, or give the command a stiffness to try";
        let washboarding = self.washboarding.as_ref();
        washboarding.ok_or_else(|| RefusedValue::missing("cut.washboarding", allowed, remedy))
    }

    /// The forces at the given speeds in rpm; without any, at those of the scene.
    ///
    /// # Errors
    /// [`SceneError`] if there is no speed, or as for [`Cut::at_rpm`].
    pub fn runs_at(&self, rpm: &[f64]) -> Result<Vec<CutRun>, SceneError> {
        if !rpm.is_empty() {
            return rpm.iter().map(|rpm| self.at_rpm(*rpm)).collect();
        }
        if self.runs.is_empty() {
            let allowed = "given, with a speed to cut at";
            let remedy = "name a speed, or add it or operating_rpm to the scene";
            return Err(RefusedValue::missing("cut.speeds", allowed, remedy).into());
        }
        Ok(self.runs.clone())
    }
}
