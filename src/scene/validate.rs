//! From a [`SceneFile`] to a [`Scene`]: every number checked, in SI units
//! and radians, ready to compute with.

use super::check::{MAX_GUIDES, MAX_RPM, SPAN, positive, refuse, within};
use super::cut::Cut;
use super::guide::{Guide, guide};
use super::membrane::Membrane;
use super::runup::{Probe, RunUp};
use super::{
    Accuracy, DampingFile, InPlane, Material, Mount, SceneError, SceneFile, Spline, SweepFile,
    rad_per_s,
};

/// A validated saw.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// What the user typed, for reports.
    pub file: SceneFile,
    /// The part of the blade that moves.
    pub blade: Blade,
    /// Guide pads with a stiffness or a damping.
    pub guides: Vec<Guide>,
    /// Damping, if any number of it is not zero.
    pub damping: Option<Damping>,
    /// Membrane stress from heat, roll tension or as measured.
    pub membrane: Option<Membrane>,
    /// Contact between bore and arbor, if its motion is asked for.
    pub spline: Option<Spline>,
    /// Speeds asked for; `None` leaves the choice to the program.
    pub sweep: Option<SpeedRange>,
    /// Speed at which the saw is run.
    pub operating_rad_per_s: Option<f64>,
    /// Speed for accuracy.
    pub accuracy: Accuracy,
    /// Relative error allowed instead of that of the name.
    pub tolerance: Option<f64>,
    /// Growth rate from which a band counts as flutter of the saw.
    pub flutter_threshold_per_s: f64,
    /// Forces of the wood on the teeth.
    pub cut: Option<Cut>,
    /// Run-up under a lateral force.
    pub runup: Option<RunUp>,
    /// Where the deflection is read.
    pub probe: Probe,
}

/// The moving annulus a < r < b.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blade {
    /// Inner radius a: the bore of a spline blade, the edge of a collar.
    pub inner_radius_m: f64,
    /// Outer radius b.
    pub outer_radius_m: f64,
    /// Thickness h.
    pub thickness_m: f64,
    /// Material.
    pub material: Material,
    /// What happens at r = a.
    pub bore: Bore,
}

/// Condition at the inner radius, in bending and in plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bore {
    /// Spline: free in bending and in plane.
    Free,
    /// Collar: clamped in bending, in plane as stated.
    Clamped(InPlane),
}

/// Damping of the blade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Damping {
    /// Kelvin–Voigt retardation time η, in the body frame.
    pub material_retardation_time_s: f64,
    /// Air resistance per area, in the space-fixed frame.
    pub air_n_s_per_m3: f64,
}

/// Range of rotation speeds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedRange {
    /// First speed.
    pub from_rad_per_s: f64,
    /// Last speed.
    pub to_rad_per_s: f64,
}

/// A chart that is off by more than a tenth says nothing, and no basis reaches 1e-6.
const TOLERANCES: (f64, f64) = (1e-6, 0.1);

impl Scene {
    /// Relative error allowed of critical speeds and onsets.
    pub fn tolerance(&self) -> f64 {
        self.tolerance.unwrap_or(self.accuracy.tolerance())
    }
}

impl Blade {
    /// Bending stiffness D = E h³ / 12(1 − ν²), in N·m.
    pub fn flexural_rigidity_n_m(&self) -> f64 {
        let Material {
            youngs_modulus_pa: e,
            poisson_ratio: nu,
            ..
        } = self.material;
        e * self.thickness_m.powi(3) / (12.0 * (1.0 - nu * nu))
    }

    /// Mass per area ρh, in kg/m².
    pub fn mass_per_area_kg_per_m2(&self) -> f64 {
        self.material.density_kg_per_m3 * self.thickness_m
    }
}

impl TryFrom<SceneFile> for Scene {
    type Error = SceneError;

    fn try_from(file: SceneFile) -> Result<Self, SceneError> {
        let blade = blade(&file)?;
        if file.guides.len() > MAX_GUIDES {
            let remedy = "join pads that lie side by side";
            let (count, allowed) = (file.guides.len(), format!("at most {MAX_GUIDES} pads"));
            return Err(refuse("guides", count as f64, allowed, remedy));
        }
        let guides = file
            .guides
            .iter()
            .enumerate()
            .map(|(index, pad)| guide(&format!("guides[{index}]"), pad, &blade))
            .collect::<Result<Vec<_>, _>>()?;
        check_measured(&file)?;
        Ok(Scene {
            cut: file
                .cut
                .as_ref()
                .map(|cut| Cut::new(cut, &file, &blade))
                .transpose()?,
            runup: file.runup.as_ref().map(RunUp::new).transpose()?,
            probe: Probe::new(file.probe.as_ref(), &blade)?,
            membrane: file
                .membrane
                .as_ref()
                .map(|membrane| Membrane::new(membrane, &blade))
                .transpose()?,
            blade,
            guides: guides
                .into_iter()
                .filter(|pad| pad.stiffness_n_per_m > 0.0 || pad.damping_n_s_per_m > 0.0)
                .collect(),
            damping: file.damping.as_ref().map(damping).transpose()?.flatten(),
            spline: Spline::of(&file, &blade)?,
            sweep: file.sweep.as_ref().map(sweep).transpose()?,
            operating_rad_per_s: file
                .operating_rpm
                .map(|rpm| within("operating_rpm", rpm, (0.0, MAX_RPM)).map(rad_per_s))
                .transpose()?,
            accuracy: file.accuracy,
            tolerance: file
                .tolerance
                .map(|share| within("tolerance", share, TOLERANCES))
                .transpose()?,
            flutter_threshold_per_s: within(
                "flutter_threshold_per_s",
                file.flutter_threshold_per_s,
                (0.0, SPAN.1),
            )?,
            file,
        })
    }
}

fn blade(file: &SceneFile) -> Result<Blade, SceneError> {
    let typed = &file.blade;
    let outer = positive("blade.outer_diameter_m", typed.outer_diameter_m)?;
    let bore = positive("blade.inner_diameter_m", typed.inner_diameter_m)?;
    let thickness_m = positive("blade.thickness_m", typed.thickness_m)?;
    if bore >= outer {
        let allowed = format!("less than blade.outer_diameter_m ({outer})");
        let remedy = "a bore is smaller than its blade; were the two exchanged?";
        return Err(refuse("blade.inner_diameter_m", bore, allowed, remedy));
    }
    let material = material(&typed.material)?;
    let (inner, bore) = match file.mount {
        Mount::Spline {} => (bore, Bore::Free),
        Mount::Collar {
            diameter_m,
            in_plane,
        } => {
            if !(bore..outer).contains(&diameter_m) {
                let allowed = format!("from the bore ({bore}) to below the rim ({outer})");
                let remedy = "give the outer diameter of the collar";
                return Err(refuse("mount.diameter_m", diameter_m, allowed, remedy));
            }
            (diameter_m, Bore::Clamped(in_plane))
        }
    };
    if inner > 0.999 * outer {
        let allowed = format!("at most 0.999 of blade.outer_diameter_m ({outer})");
        let remedy = "a narrower ring is a wire, which plate theory does not describe";
        let key = match bore {
            Bore::Free => "blade.inner_diameter_m",
            Bore::Clamped(_) => "mount.diameter_m",
        };
        return Err(refuse(key, inner, allowed, remedy));
    }
    let width = 0.5 * (outer - inner);
    if thickness_m > width {
        let allowed = format!("at most the width of the moving ring ({width} m)");
        let remedy = "a body thicker than wide is no plate; is the thickness in metres?";
        return Err(refuse("blade.thickness_m", thickness_m, allowed, remedy));
    }
    Ok(Blade {
        inner_radius_m: 0.5 * inner,
        outer_radius_m: 0.5 * outer,
        thickness_m,
        material,
        bore,
    })
}

fn material(typed: &Material) -> Result<Material, SceneError> {
    let nu = typed.poisson_ratio;
    if !(nu > -1.0 && nu < 0.5) {
        let remedy = "steel has 0.3";
        let allowed = "greater than -1 and less than 0.5";
        return Err(refuse("blade.material.poisson_ratio", nu, allowed, remedy));
    }
    Ok(Material {
        youngs_modulus_pa: positive("blade.material.youngs_modulus_pa", typed.youngs_modulus_pa)?,
        poisson_ratio: nu,
        density_kg_per_m3: positive("blade.material.density_kg_per_m3", typed.density_kg_per_m3)?,
    })
}

fn damping(typed: &DampingFile) -> Result<Option<Damping>, SceneError> {
    let damping = Damping {
        material_retardation_time_s: within(
            "damping.material_retardation_time_s",
            typed.material_retardation_time_s,
            (0.0, SPAN.1),
        )?,
        air_n_s_per_m3: within(
            "damping.air_n_s_per_m3",
            typed.air_n_s_per_m3,
            (0.0, SPAN.1),
        )?,
    };
    let any = damping.material_retardation_time_s > 0.0 || damping.air_n_s_per_m3 > 0.0;
    Ok(any.then_some(damping))
}

fn sweep(typed: &SweepFile) -> Result<SpeedRange, SceneError> {
    let from = within("sweep.from_rpm", typed.from_rpm, (0.0, MAX_RPM))?;
    let to = within("sweep.to_rpm", typed.to_rpm, (0.0, MAX_RPM))?;
    if to <= from {
        let allowed = format!("more than sweep.from_rpm ({from})");
        let remedy = "a sweep runs from a lower to a higher speed";
        return Err(refuse("sweep.to_rpm", to, allowed, remedy));
    }
    Ok(SpeedRange {
        from_rad_per_s: rad_per_s(from),
        to_rad_per_s: rad_per_s(to),
    })
}

fn check_measured(file: &SceneFile) -> Result<(), SceneError> {
    for (index, row) in file.measured.iter().flat_map(|m| m.rows.iter()).enumerate() {
        let key = format!("measured.rows[{index}]");
        within(&format!("{key}.rpm"), row.rpm, (0.0, MAX_RPM))?;
        for (column, &hz) in row.frequencies_hz.iter().enumerate() {
            within(
                &format!("{key}.frequencies_hz[{column}]"),
                hz,
                (0.0, SPAN.1),
            )?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(change: impl FnOnce(&mut SceneFile)) -> Result<Scene, SceneError> {
        let mut file = Scene::paper().file;
        change(&mut file);
        Scene::try_from(file)
    }

    #[test]
    fn refusals_name_the_key() {
        let cases: [(&str, Result<Scene, SceneError>); 7] = [
            ("blade.thickness_m", with(|f| f.blade.thickness_m = -1.0)),
            (
                "blade.thickness_m",
                with(|f| f.blade.thickness_m = f64::NAN),
            ),
            (
                "blade.inner_diameter_m",
                with(|f| f.blade.inner_diameter_m = 0.8),
            ),
            (
                "blade.material.poisson_ratio",
                with(|f| f.blade.material.poisson_ratio = 0.5),
            ),
            ("guides[0].radius_m", with(|f| f.guides[0].radius_m = 3.0)),
            (
                "guides[0].tangential_length_m",
                with(|f| f.guides[0].tangential_length_m = 0.0),
            ),
            (
                "sweep.to_rpm",
                with(|f| {
                    f.sweep = Some(SweepFile {
                        from_rpm: 9.0,
                        to_rpm: 9.0,
                    })
                }),
            ),
        ];
        for (expected, result) in cases {
            match result {
                Err(SceneError::Value { key, .. }) => assert_eq!(key, expected),
                other => panic!("{expected}: {other:?}"),
            }
        }
    }

    #[test]
    fn a_guide_without_stiffness_is_not_in_the_scene() {
        let scene = with(|f| f.guides[0].stiffness_n_per_m = 0.0).unwrap();
        assert!(scene.guides.is_empty());
    }
}
