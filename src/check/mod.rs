//! Pass or fail: a saw against limits that its designer sets.
//!
//! ```
//! use sawflutter::check::{Check, Limits};
//! use sawflutter::scene::{Accuracy, Scene, rad_per_s};
//!
//! let scene = Scene::paper().edited(|saw| saw.accuracy = Accuracy::Draft)?;
//! let limits = Limits {
//!     min_critical_rad_per_s: Some(rad_per_s(1500.0)),
//!     ..Limits::at(rad_per_s(1250.0))
//! };
//! let check = Check::new(&scene, &limits)?;
//! assert!(check.passed(), "{:?}", check.failures());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod limits;
mod static_deflection;

use faer::linalg::solvers::Solve;

use crate::plate::{Plate, Resolution};
use crate::scene::{Scene, SceneError, SpeedRange, rpm};
use crate::spectrum::SpectrumError;
use crate::stability::AnalysisError;
use crate::stability::{Analysis, Evidence, Instability};
use crate::system::GyroscopicSystem;

#[cfg(feature = "cli")]
pub(crate) use limits::RIM_LIMIT_M_PER_S;
pub use limits::{Limits, LimitsFile};
use static_deflection::{StaticDeflection, point};

/// Why a saw could not be held against limits.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// No sweep reaches as far as the limits ask.
    #[error("the limits were refused: {0}")]
    Scene(#[from] SceneError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
}

/// One limit and what was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Criterion {
    /// Which limit, in one word, for tables.
    pub key: &'static str,
    /// What is compared, in words.
    pub name: String,
    /// What was found, in rad/s; `None` where there is no such speed within the sweep.
    pub found: Option<f64>,
    /// What was asked, in rad/s.
    pub asked: f64,
    /// Whether it is kept.
    pub passed: bool,
}

/// A saw held against limits.
#[derive(Debug)]
pub struct Check {
    /// Every limit of speeds that a study asks about too.
    pub criteria: Vec<Criterion>,
    /// The speed of the rim, the gap of every guide that has one, and of a blade that nothing holds its want of
    /// stiffness.
    pub of_rim_and_gaps: Vec<Criterion>,
    /// Speeds in rad/s up to the lowest critical one, and the stiffness in N/m of the same point
    /// there; empty where rigid motions are free.
    pub rim_stiffness_over_speed: Vec<(f64, f64)>,
    /// Lateral stiffness of a point of the rim at the middle of the cut, at rest, in N/m.
    pub rim_stiffness_at_rest_n_per_m: f64,
    /// The same at the operating speed; `None` from the first critical speed on: K(Ω) is not
    /// positive definite there, and force over deflection may be anything, of either sign.
    pub rim_stiffness_n_per_m: Option<f64>,
    /// What the speeds were taken from.
    pub analysis: Analysis,
}

/// A point dents the rim in waves of all lengths: what n diameters add falls with n³ only, so
/// that critical speeds are right long before the stiffness of a point is.
const POINT_LOAD_BASIS: Resolution = Resolution {
    max_diameters: 30,
    radial_functions: 12,
};

impl Check {
    /// Analyses a saw as far as the limits ask, and compares.
    ///
    /// # Errors
    /// [`CheckError`] when the saw cannot be analysed that far.
    pub fn new(scene: &Scene, limits: &Limits) -> Result<Self, CheckError> {
        let swept = scene.swept(SpeedRange {
            from_rad_per_s: 0.0,
            to_rad_per_s: limits.reach_rad_per_s(),
        })?;
        let analysis = Analysis::new(&swept)?;
        let angle = scene.cut().map_or(0.0, |cut| cut.angle_rad);
        let plate = &Plate::new(scene, POINT_LOAD_BASIS);
        let lowest_critical = analysis.model.critical.first().map(|c| c.speed_rad_per_s);
        let operating = limits.operating_rad_per_s;
        let is_stiff = lowest_critical.is_none_or(|lowest| operating < lowest);
        let lateral = scene.cut().and_then(|cut| {
            let run = cut.at_rpm(rpm(operating)).ok()?;
            Some((cut, run.lateral_n))
        });
        let bending = lowest_critical
            .and_then(|critical| StaticDeflection::new(plate, angle, lateral, critical));
        let mut of_rim_and_gaps = vec![limits.of_rim(plate.blade.outer_radius_m)];
        of_rim_and_gaps.extend(of_gaps(scene, plate, bending.as_ref(), operating));
        let mut components = analysis.model.components.iter();
        let is_free = components.any(|component| !component.full.free_rigid.is_empty());
        of_rim_and_gaps.extend(is_free.then(|| without_stiffness(operating)));
        Ok(Check {
            of_rim_and_gaps,
            rim_stiffness_over_speed: bending
                .as_ref()
                .map_or_else(Vec::new, StaticDeflection::rim_stiffness_n_per_m),
            criteria: limits.criteria(
                lowest_critical,
                analysis.flutter_speed_rad_per_s,
                &analysis.chart.instabilities,
                scene.flutter_threshold_per_s(),
            ),
            rim_stiffness_at_rest_n_per_m: rim_stiffness_n_per_m(plate, angle, 0.0),
            rim_stiffness_n_per_m: is_stiff.then(|| rim_stiffness_n_per_m(plate, angle, operating)),
            analysis,
        })
    }

    /// Every limit: those of speeds, of the rim and of the gaps.
    pub fn all_criteria(&self) -> impl Iterator<Item = &Criterion> {
        self.criteria.iter().chain(&self.of_rim_and_gaps)
    }

    /// Whether every limit is kept.
    pub fn passed(&self) -> bool {
        self.all_criteria().all(|criterion| criterion.passed)
    }

    /// The limits that are not kept, with their numbers in rpm: for assertions.
    pub fn failures(&self) -> Vec<String> {
        let failed = self.all_criteria().filter(|criterion| !criterion.passed);
        failed.map(Criterion::to_string).collect()
    }
}

impl std::fmt::Display for Criterion {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let found = self
            .found
            .map_or("none".into(), |w| format!("{:.1} rpm", rpm(w)));
        write!(
            formatter,
            "{}: {found}, asked {:.1} rpm",
            self.name,
            rpm(self.asked)
        )
    }
}

impl Limits {
    /// Every limit held against the speeds and bands of a saw, in rad/s; bands that grow more
    /// slowly than the threshold are none.
    pub fn criteria(
        &self,
        lowest_critical: Option<f64>,
        flutter_speed: Option<f64>,
        bands: &[Instability],
        threshold_per_s: f64,
    ) -> Vec<Criterion> {
        let operating = self.operating_rad_per_s;
        let at_least = |key, name: &str, found: Option<f64>, asked: f64| Criterion {
            key,
            name: name.to_owned(),
            found,
            asked,
            // A speed that is not reached within the sweep is beyond all that is asked.
            passed: found.is_none_or(|found| found >= asked),
        };
        let mut criteria = vec![at_least(
            "margin",
            "lowest critical speed, operating speed over margin",
            lowest_critical,
            operating / self.margin,
        )];
        let evidence = Evidence {
            bands,
            // The limit above is the one of critical speeds.
            critical_rad_per_s: &[],
            threshold_per_s,
            range_rad_per_s: (0.0, self.reach_rad_per_s()),
        };
        let verdict = evidence.verdict(operating);
        let inside = verdict.stretch.map(|(from, _)| from);
        criteria.push(Criterion {
            key: "operating",
            name: "instability at the operating speed, from".to_owned(),
            found: inside,
            asked: operating,
            passed: inside.is_none(),
        });
        if let Some(asked) = self.min_critical_rad_per_s {
            let name = "lowest critical speed";
            criteria.push(at_least("min_critical", name, lowest_critical, asked));
        }
        if let Some(asked) = self.min_flutter_rad_per_s {
            criteria.push(at_least(
                "min_flutter",
                "flutter speed",
                flutter_speed,
                asked,
            ));
        }
        criteria
    }
}

impl Limits {
    /// The speed at which the rim runs as fast as it may.
    fn of_rim(&self, rim_radius_m: f64) -> Criterion {
        let found = self.max_rim_m_per_s / rim_radius_m;
        let operating = self.operating_rad_per_s;
        let (now, most) = (operating * rim_radius_m, self.max_rim_m_per_s);
        Criterion {
            key: "rim_speed",
            name: format!("rim at {most:.0} m/s ({now:.0} m/s when operating)"),
            found: Some(found),
            asked: operating,
            passed: found >= operating,
        }
    }
}

/// A limit that no speed keeps: a side force moves the blade away.
fn without_stiffness(operating: f64) -> Criterion {
    Criterion {
        key: "held",
        name: "static stiffness (nothing holds the blade's rigid motions)".to_owned(),
        found: None,
        asked: operating,
        passed: false,
    }
}

/// Of every guide with a gap the speed at which the lateral forces of the cut press the blade
/// through it. A blade past its lowest critical speed has no static deflection to hold against it.
fn of_gaps(
    scene: &Scene,
    plate: &Plate,
    bending: Option<&StaticDeflection>,
    operating: f64,
) -> Vec<Criterion> {
    let guides = scene.file().guides.iter().enumerate();
    let with_gap = guides.filter_map(|(index, guide)| Some((index, guide, guide.gap_m?)));
    with_gap
        .filter_map(|(index, guide, gap_m)| {
            let bending = bending?;
            let place = point(plate, guide.radius_m, guide.angle_deg.to_radians());
            bending.in_cut_m(&place, 0.0)?;
            let found = bending.fills_gap_at(&place, gap_m);
            Some(Criterion {
                key: "gap",
                name: format!(
                    "gap of guide {} ({:.0} µm) filled in the cut",
                    index + 1,
                    1e6 * gap_m
                ),
                found,
                asked: operating,
                passed: found.is_none_or(|found| found > operating),
            })
        })
        .collect()
}

/// 1/(φᵀ K(Ω)⁻¹ φ) with φ the functions at the rim: force over deflection of a point that
/// stands in space, the saw turning under it. Zero where rigid motions are free.
fn rim_stiffness_n_per_m(plate: &Plate, angle_rad: f64, speed_rad_per_s: f64) -> f64 {
    let point = point(plate, plate.blade.outer_radius_m, angle_rad);
    let system = GyroscopicSystem::of_plate(plate);
    if !system.free_rigid.is_empty() {
        return 0.0;
    }
    let answer = system
        .stiffness_at(speed_rad_per_s)
        .partial_piv_lu()
        .solve(&point);
    let stiffness = 1.0 / (point.transpose() * answer);
    if stiffness.is_finite() {
        stiffness
    } else {
        0.0
    }
}
