//! A [`Scene`]: a validated saw, in SI units and radians.

use super::runup::DEFAULT_PROBE_DEG;
use super::{
    Accuracy, Blade, Cut, DampingFile, ExcitationLine, Guide, LimitsFile, Membrane,
    OscillatingForce, Point, RunUpFile, SceneError, SceneFile, SideForce, SpeedRange, SplineFile,
    SplitBranch, SweepFile, in_the_cut, rad_per_s, rpm,
};

/// A validated saw. It contains the scene as typed and the numbers derived from it, so that it cannot be
/// changed; [`Scene::edited`] makes another one.
///
/// ```compile_fail
/// let mut saw = sawflutter::model::scene::Scene::paper();
/// saw.guides.clear();
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    pub(super) file: SceneFile,
    pub(super) blade: Blade,
    pub(super) guides: Vec<Guide>,
    pub(super) membrane: Option<Membrane>,
    pub(super) excitation: Vec<ExcitationLine>,
    pub(super) cut: Option<Cut>,
}

impl Scene {
    /// The limits that the saw has to keep.
    pub fn limits(&self) -> LimitsFile {
        self.file.limits.unwrap_or_default()
    }

    /// The saw with changes to the scene as typed, validated again.
    ///
    /// ```
    /// use sawflutter::model::scene::Scene;
    ///
    /// let saw = Scene::paper().edited(|file| file.guides[0].radius_m = 0.22)?;
    /// assert_eq!(saw.file().guides[0].radius_m, 0.22);
    /// assert!(saw.edited(|file| file.blade.thickness_m = -1.0).is_err());
    /// # Ok::<(), sawflutter::model::scene::SceneError>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError`] with the JSON path of the offending key.
    pub fn edited(&self, change: impl FnOnce(&mut SceneFile)) -> Result<Scene, SceneError> {
        let mut file = self.file.clone();
        change(&mut file);
        Scene::try_from(file)
    }

    /// The saw with another range of speeds.
    ///
    /// # Errors
    /// [`SceneError`] if a sweep must not have this range.
    pub fn swept(&self, range: SpeedRange) -> Result<Scene, SceneError> {
        self.edited(|file| {
            file.sweep = Some(SweepFile {
                from_rpm: rpm(range.from_rad_per_s),
                to_rpm: rpm(range.to_rad_per_s),
            });
        })
    }

    /// The saw with another branch of the pairs of waves that its slots split.
    pub(crate) fn on_branch(&self, branch: SplitBranch) -> Scene {
        let mut saw = self.clone();
        saw.blade.split_branch = branch;
        saw
    }

    /// The saw with a Campbell diagram that excludes the forces of the cut.
    ///
    /// # Errors
    /// [`SceneError`] as for [`Scene::edited`]; none for a valid scene.
    pub fn idling(&self) -> Result<Scene, SceneError> {
        self.edited(|file| file.cut.iter_mut().for_each(|cut| cut.chart_rpm = None))
    }

    /// The saw with a Campbell diagram that includes the forces of its cut at a speed in rpm.
    ///
    /// # Errors
    /// [`SceneError`] if the scene has no such cut.
    pub fn charted_in_cut(&self, rpm: f64) -> Result<Scene, SceneError> {
        self.edited(|file| {
            let cut = file.cut.iter_mut();
            cut.for_each(|cut| cut.chart_rpm = Some(rpm));
        })
    }

    /// What the saw of the scene does at every speed, as all reports name it: "idling", or "in the cut at 2800 rpm
    /// (4 teeth)" with `cut.chart_rpm`. [`Plate::new`](crate::model::plate::Plate::new) makes the matrices of this saw.
    pub fn condition(&self) -> String {
        match self.cut().and_then(|cut| cut.chart) {
            Some(run) => in_the_cut(&[run]),
            None => "idling".to_owned(),
        }
    }

    /// The scene as typed.
    pub fn file(&self) -> &SceneFile {
        &self.file
    }

    /// The moving part of the blade.
    pub fn blade(&self) -> &Blade {
        &self.blade
    }

    /// Guide pads that have stiffness or damping.
    pub(crate) fn guides(&self) -> &[Guide] {
        &self.guides
    }

    /// Damping, if any coefficient is not zero.
    pub(crate) fn damping(&self) -> Option<&DampingFile> {
        self.file.damping.as_ref().filter(|damping| damping.acts())
    }

    /// Membrane stress from heat, roll tension or measurement.
    pub(crate) fn membrane(&self) -> Option<&Membrane> {
        self.membrane.as_ref()
    }

    /// Contact between bore and arbor, if its motion is to be simulated.
    pub(crate) fn spline(&self) -> Option<&SplineFile> {
        self.file.spline.as_ref()
    }

    /// Lines of the Campbell diagram, by order.
    pub fn excitation(&self) -> &[ExcitationLine] {
        &self.excitation
    }

    /// Range of speeds as given; `None` if the program chooses it.
    pub fn sweep(&self) -> Option<SpeedRange> {
        let sweep = self.file.sweep.as_ref();
        sweep.map(|sweep| SpeedRange::between_rpm(sweep.from_rpm, sweep.to_rpm))
    }

    /// Operating speed.
    pub fn operating_rad_per_s(&self) -> Option<f64> {
        self.file.operating_rpm.map(rad_per_s)
    }

    /// Name of the accuracy.
    pub fn accuracy(&self) -> Accuracy {
        self.file.accuracy
    }

    /// Tolerance, the relative error allowed for critical speeds and onsets: as given, or that of the
    /// accuracy.
    pub fn tolerance(&self) -> f64 {
        let of_name = self.file.accuracy.tolerance();
        self.file.tolerance.unwrap_or(of_name)
    }

    /// Growth rate from which on a band counts as flutter.
    pub fn flutter_threshold_per_s(&self) -> f64 {
        self.file.flutter_threshold_per_s
    }

    /// Cut, with the forces of the wood on the teeth.
    pub fn cut(&self) -> Option<&Cut> {
        self.cut.as_ref()
    }

    /// Speed at which the saw cuts, in rpm: the operating speed, or else the first of its cut; `None` without either.
    pub fn cutting_rpm(&self) -> Option<f64> {
        let first = self.cut()?.runs.first().map(|run| run.rpm);
        self.file.operating_rpm.or(first)
    }

    /// Angle of the middle of the cut; without a cut, zero, the direction from which angles are counted.
    pub fn cut_angle_rad(&self) -> f64 {
        self.file.cut_angle_deg().to_radians()
    }

    /// Run-up under the side force.
    pub fn runup(&self) -> Option<&RunUpFile> {
        self.file.runup.as_ref()
    }

    /// The constant side force, given or assumed.
    pub(crate) fn side_force(&self) -> SideForce {
        let typed = self.file.side_force.unwrap_or_default();
        SideForce {
            force_n: self.file.side_force_n(),
            at: Point {
                radius_m: typed.radius_m.unwrap_or(self.blade.outer_radius_m),
                angle_deg: typed.angle_deg.unwrap_or(self.file.cut_angle_deg()),
            },
        }
    }

    /// The oscillating side force, if there is one.
    pub(crate) fn oscillating_force(&self) -> Option<OscillatingForce> {
        let typed = self.file.side_force?;
        (typed.oscillating_n != 0.0).then_some(OscillatingForce {
            amplitude_n: typed.oscillating_n,
            order: typed.order.unwrap_or(1),
        })
    }

    /// Point at which the deflection is read.
    pub(crate) fn probe(&self) -> Point {
        let typed = self.file.probe.as_ref();
        let radius_m = typed.and_then(|probe| probe.radius_m);
        Point {
            radius_m: radius_m.unwrap_or(self.blade.outer_radius_m),
            angle_deg: typed.map_or(DEFAULT_PROBE_DEG, |probe| probe.angle_deg),
        }
    }
}
