//! A [`Scene`]: a validated saw, in SI units and radians.

use super::{
    Accuracy, Cut, ExcitationLine, Guide, InPlane, Material, Membrane, Probe, RimMass, RunUp,
    SceneError, SceneFile, Spline, SweepFile, ThicknessProfile, in_the_cut, rpm,
};

/// A validated saw. It contains the scene as typed and the numbers derived from it, so that it cannot be
/// changed; [`Scene::edited`] makes another one.
///
/// ```compile_fail
/// let mut saw = sawflutter::scene::Scene::paper();
/// saw.guides.clear();
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    pub(super) file: SceneFile,
    pub(super) blade: Blade,
    pub(super) guides: Vec<Guide>,
    pub(super) damping: Option<Damping>,
    pub(super) membrane: Option<Membrane>,
    pub(super) spline: Option<Spline>,
    pub(super) excitation: Vec<ExcitationLine>,
    pub(super) sweep: Option<SpeedRange>,
    pub(super) operating_rad_per_s: Option<f64>,
    pub(super) tolerance: f64,
    pub(super) flutter_threshold_per_s: f64,
    pub(super) cut: Option<Cut>,
    pub(super) runup: Option<RunUp>,
    pub(super) probe: Probe,
}

/// The annulus a < r < b of the blade that deflects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blade {
    /// Inner radius a: the bore of a spline blade, the edge of a collar.
    pub inner_radius_m: f64,
    /// Outer radius b.
    pub outer_radius_m: f64,
    /// Thickness h; for a profile, the hub's thickness, to which mass and stiffness are referred.
    pub thickness_m: f64,
    /// Thickness over the radius if it is not uniform.
    pub(crate) profile: Option<ThicknessProfile>,
    /// Mass of teeth and tips.
    pub(crate) rim: Option<RimMass>,
    /// Material of the blade.
    pub material: Material,
    /// Boundary condition at r = a.
    pub bore: Bore,
}

/// Condition at the inner radius, in bending and in plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bore {
    /// Spline: free in bending and in plane.
    Free,
    /// Collar: clamped in bending; the condition in plane is that of the scene.
    Clamped(InPlane),
}

/// Damping of the blade.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Damping {
    /// Kelvin–Voigt retardation time η, in the body frame.
    pub material_retardation_time_s: f64,
    /// Damping ratio of the modes at rest without guides whose number of nodal diameters is not listed.
    pub ratio: f64,
    /// Damping ratios by numbers of nodal diameters.
    pub ratios: Vec<(usize, f64)>,
    /// Air resistance per area, in the frame of the air.
    pub air_n_s_per_m3: f64,
    /// Ratio of the rotation speed of the air to that of the blade.
    pub air_rotation_share: f64,
}

impl Damping {
    /// Damping ratio of the modes at rest with n nodal diameters, as listed or by the loss factor.
    pub fn ratio_of(&self, n: usize) -> f64 {
        let listed = self.ratios.iter().find(|(diameters, _)| *diameters == n);
        listed.map_or(self.ratio, |(_, ratio)| *ratio)
    }

    /// The smallest damping ratio of any number of nodal diameters.
    pub fn smallest_ratio(&self) -> f64 {
        let listed = self.ratios.iter().map(|(_, ratio)| *ratio);
        listed.fold(self.ratio, f64::min)
    }

    /// Whether the material of the blade dissipates energy.
    pub fn is_material(&self) -> bool {
        let ratios = self.ratios.iter().any(|(_, ratio)| *ratio > 0.0);
        self.material_retardation_time_s > 0.0 || self.ratio > 0.0 || ratios
    }
}

/// Range of rotation speeds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedRange {
    /// First speed.
    pub from_rad_per_s: f64,
    /// Last speed.
    pub to_rad_per_s: f64,
}

impl Scene {
    /// The saw with changes to the scene as typed, validated again.
    ///
    /// ```
    /// use sawflutter::scene::Scene;
    ///
    /// let saw = Scene::paper().edited(|file| file.guides[0].radius_m = 0.22)?;
    /// assert_eq!(saw.file().guides[0].radius_m, 0.22);
    /// assert!(saw.edited(|file| file.blade.thickness_m = -1.0).is_err());
    /// # Ok::<(), sawflutter::scene::SceneError>(())
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

    /// The saw with a Campbell diagram that excludes the forces of the cut.
    ///
    /// # Errors
    /// [`SceneError`] as for [`Scene::edited`]; none for a valid scene.
    pub fn idling(&self) -> Result<Scene, SceneError> {
        self.edited(|file| file.cut.iter_mut().for_each(|cut| cut.chart_rpm = None))
    }

    /// What the saw of the scene does at every speed, as all reports name it: "idling", or "in the cut at 2800 rpm
    /// (4 teeth)" with `cut.chart_rpm`. [`Plate::new`](crate::plate::Plate::new) makes the matrices of this saw.
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
    pub(crate) fn damping(&self) -> Option<Damping> {
        self.damping.clone()
    }

    /// Membrane stress from heat, roll tension or measurement.
    pub(crate) fn membrane(&self) -> Option<&Membrane> {
        self.membrane.as_ref()
    }

    /// Contact between bore and arbor, if its motion is to be simulated.
    pub(crate) fn spline(&self) -> Option<&Spline> {
        self.spline.as_ref()
    }

    /// Lines of the Campbell diagram, by order.
    pub fn excitation(&self) -> &[ExcitationLine] {
        &self.excitation
    }

    /// Range of speeds as given; `None` if the program chooses it.
    pub fn sweep(&self) -> Option<SpeedRange> {
        self.sweep
    }

    /// Operating speed.
    pub fn operating_rad_per_s(&self) -> Option<f64> {
        self.operating_rad_per_s
    }

    /// Name of the accuracy.
    pub fn accuracy(&self) -> Accuracy {
        self.file.accuracy
    }

    /// Tolerance, the relative error allowed for critical speeds and onsets: as given, or that of the
    /// accuracy.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Growth rate from which on a band counts as flutter.
    pub fn flutter_threshold_per_s(&self) -> f64 {
        self.flutter_threshold_per_s
    }

    /// Cut, with the forces of the wood on the teeth.
    pub fn cut(&self) -> Option<&Cut> {
        self.cut.as_ref()
    }

    /// Angle of the middle of the cut; without a cut, zero, the direction from which angles are counted.
    pub fn cut_angle_rad(&self) -> f64 {
        self.cut.as_ref().map_or(0.0, |cut| cut.teeth.angle_rad)
    }

    /// Run-up under a lateral force.
    pub fn runup(&self) -> Option<&RunUp> {
        self.runup.as_ref()
    }

    /// Position at which the deflection is read.
    pub(crate) fn probe(&self) -> &Probe {
        &self.probe
    }
}

impl Blade {
    /// Bending stiffness D = E h³ / 12(1 − ν²) of the thickness `thickness_m`, in N·m.
    pub fn flexural_rigidity_n_m(&self) -> f64 {
        let Material {
            youngs_modulus_pa: e,
            poisson_ratio: nu,
            ..
        } = self.material;
        e * self.thickness_m.powi(3) / (12.0 * (1.0 - nu * nu))
    }

    /// Mass per area ρh of the thickness `thickness_m`, in kg/m².
    pub fn mass_per_area_kg_per_m2(&self) -> f64 {
        self.material.density_kg_per_m3 * self.thickness_m
    }
}
