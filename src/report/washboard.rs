//! `washboard.json`: whether the cutting force, which depends on the surface left by the preceding tooth,
//! makes a motion of the blade grow.

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::verdict::Verdict;
use crate::scene::{SceneFile, in_the_cut, rpm, unusual_number};
use crate::spectrum::Direction;
use crate::text::shown_to;
use crate::washboarding::{Washboard, WashboardMode};

/// Report of a washboarding analysis (`washboard.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WashboardReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// The cut of the verdict: "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy. The results hold for the
    /// numbers as typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// Rotation speed of the verdict.
    pub rpm: f64,
    /// Whether a motion grows at that speed.
    pub verdict: Verdict,
    /// Number of teeth that pass per second.
    pub tooth_passing_hz: f64,
    /// Times between successive teeth: one for even teeth, otherwise one for each pitch that repeats.
    pub delays_s: Vec<f64>,
    /// Lateral cutting stiffness of all teeth in the cut together.
    pub stiffness_n_per_m: f64,
    /// Share of a tooth's cut on the surface left by the preceding tooth.
    pub overlap: f64,
    /// Arc of the rim on which the force acts.
    pub arc_deg: f64,
    /// Feed speed of the wood, if given.
    pub feed_m_per_s: Option<f64>,
    /// Smallest cutting stiffness at which a motion grows at the speed `rpm`; null if it exceeds
    /// `ceiling_n_per_m`, zero if a motion grows without the delayed force.
    pub critical_stiffness_n_per_m: Option<f64>,
    /// Frequency of this motion.
    pub critical_frequency_hz: Option<f64>,
    /// Number of eigenvalues in the right half plane by the argument principle, two for each oscillation;
    /// null if one lies on the imaginary axis.
    pub growing_eigenvalues: Option<usize>,
    /// Number of growing eigenvalues without the delayed force.
    pub growing_eigenvalues_without: usize,
    /// Modes at the speed `rpm`, in descending order of growth.
    pub modes: Vec<WashboardModeEntry>,
    /// Smallest cutting stiffness at which a motion grows, over the speed.
    pub lobes: LobesEntry,
    /// Largest cutting stiffness of the search.
    pub ceiling_n_per_m: f64,
    /// Frequency up to which the modes are complete.
    pub complete_to_hz: f64,
    /// Largest number of nodal diameters of the basis.
    pub max_diameters: usize,
    /// Number of radial functions for each number of nodal diameters.
    pub radial_functions: usize,
    /// Estimated relative error of the critical speeds in this basis.
    pub estimated_relative_error: Option<f64>,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// A mode with the delayed force.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WashboardModeEntry {
    /// Harmonics of the mode, with shares if none dominates.
    pub name: String,
    /// Direction of the wave, seen from space.
    pub direction: Direction,
    /// Im λ/2π in space.
    pub frequency_hz: f64,
    /// Re λ.
    pub growth_per_s: f64,
    /// Re λ of the mode without the delayed force; null for a mode that exists only because of the delay.
    pub growth_without_per_s: Option<f64>,
    /// Im λ/2π of the mode without the delayed force.
    pub frequency_without_hz: Option<f64>,
    /// Multiple of the tooth passing frequency that is nearest to `frequency_hz`; null for unevenly spaced
    /// teeth.
    pub tooth_passing_multiple: Option<u32>,
    /// `frequency_hz` minus this multiple.
    pub beside_tooth_passing_hz: Option<f64>,
    /// Wavelength, along the feed, of the pattern that the mode leaves on the board; null without a feed.
    pub pattern_pitch_m: Option<f64>,
}

/// The lobe diagram.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LobesEntry {
    /// Rotation speeds.
    pub rpm: Vec<f64>,
    /// Smallest cutting stiffness at which a motion grows; null if it exceeds `ceiling_n_per_m`, zero if a
    /// motion grows without the delayed force.
    pub critical_stiffness_n_per_m: Vec<Option<f64>>,
    /// Frequency of this motion.
    pub frequency_hz: Vec<Option<f64>>,
    /// Cutting stiffness up to which it is known that no motion grows: the critical one, or the largest of the
    /// search; less where only damping prevents the growth of omitted modes, zero where the count does not confirm it.
    pub stable_to_n_per_m: Vec<f64>,
    /// Whether the argument principle confirms that nothing grows just below this stiffness.
    pub confirmed: Vec<bool>,
}

impl WashboardReport {
    /// The report of a washboarding analysis.
    pub fn new(found: &Washboard) -> Self {
        let (run, washboarding) = (&found.run, &found.washboarding);
        let speed = run.speed_rad_per_s;
        let passing = washboarding.tooth_passing_rad_per_s(speed);
        let boundary = found.boundary;
        let resolution = found.plate.resolution;
        let error = found.estimated_relative_error;
        WashboardReport {
            sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
            scene: found.scene.file().clone(),
            condition: in_the_cut(&[*run]),
            unusual_numbers: unusual_numbers(found),
            rpm: run.rpm,
            verdict: match found.growing {
                Some(0) => Verdict::Stable,
                _ => Verdict::Unstable,
            },
            tooth_passing_hz: passing / TAU,
            delays_s: washboarding.delays_s(speed),
            stiffness_n_per_m: washboarding.stiffness_n_per_m,
            overlap: washboarding.overlap,
            arc_deg: washboarding.arc_rad.to_degrees(),
            feed_m_per_s: run.feed_m_per_s,
            critical_stiffness_n_per_m: boundary.map(|b| b.stiffness_n_per_m),
            critical_frequency_hz: boundary.map(|b| b.frequency_rad_per_s / TAU),
            growing_eigenvalues: found.growing,
            growing_eigenvalues_without: found.growing_without,
            modes: found.modes.iter().map(entry).collect(),
            lobes: lobes(found),
            ceiling_n_per_m: found.ceiling_n_per_m,
            complete_to_hz: found.complete_to_rad_per_s / TAU,
            max_diameters: resolution.max_diameters,
            radial_functions: found.plate.radial_functions(),
            estimated_relative_error: error.is_finite().then_some(error),
            warnings: warnings(found),
        }
    }

    /// The mode of fastest growth, if one grows.
    pub fn growing_mode(&self) -> Option<&WashboardModeEntry> {
        self.modes.first().filter(|mode| mode.growth_per_s > 0.0)
    }
}

fn entry(mode: &WashboardMode) -> WashboardModeEntry {
    let pattern = mode.pattern;
    WashboardModeEntry {
        name: mode.name.in_shares(),
        direction: mode.name.direction,
        frequency_hz: mode.lambda.im / TAU,
        growth_per_s: mode.lambda.re,
        growth_without_per_s: mode.without.map(|lambda| lambda.re),
        frequency_without_hz: mode.without.map(|lambda| lambda.im / TAU),
        tooth_passing_multiple: pattern.map(|pattern| pattern.multiple),
        beside_tooth_passing_hz: pattern.map(|pattern| pattern.beside_rad_per_s / TAU),
        pattern_pitch_m: pattern.and_then(|pattern| pattern.pitch_m),
    }
}

fn lobes(found: &Washboard) -> LobesEntry {
    let points = || found.lobes.iter();
    LobesEntry {
        rpm: points().map(|point| rpm(point.speed_rad_per_s)).collect(),
        critical_stiffness_n_per_m: points()
            .map(|point| point.boundary.map(|b| b.stiffness_n_per_m))
            .collect(),
        frequency_hz: points()
            .map(|point| point.boundary.map(|b| b.frequency_rad_per_s / TAU))
            .collect(),
        stable_to_n_per_m: points()
            .map(|point| found.stable_to_n_per_m(point))
            .collect(),
        confirmed: points().map(|point| point.confirmed).collect(),
    }
}

fn warnings(found: &Washboard) -> Vec<String> {
    let all = [
        without_delay(found),
        on_the_axis(found),
        unlisted(found),
        beyond(found),
        unconfirmed(found),
        without_pitch(found),
    ];
    all.into_iter().flatten().collect()
}

/// Unusual numbers of the scene, and of a speed of the cut that it does not list.
fn unusual_numbers(found: &Washboard) -> Vec<String> {
    let (scene, rpm) = (found.scene.file(), found.run.rpm);
    let is_asked = scene.operating_rpm != Some(rpm);
    let asked =
        is_asked.then(|| unusual_number(scene, "the speed of the cut", "operating_rpm", rpm));
    scene
        .unusual_numbers()
        .into_iter()
        .chain(asked.flatten())
        .collect()
}

fn without_delay(found: &Washboard) -> Option<String> {
    (found.growing_without > 0).then(|| {
        format!(
            "at {:.0} rpm the saw in the cut is unstable without the delayed force; an analysis of the cut shows why",
            found.run.rpm
        )
    })
}

fn on_the_axis(found: &Washboard) -> Option<String> {
    found.growing.is_none().then(|| {
        "a motion neither grows nor decays within rounding: the side of the boundary is undetermined, and the saw is called unstable".to_owned()
    })
}

fn unlisted(found: &Washboard) -> Option<String> {
    let growing = found.modes.iter().filter(|mode| mode.lambda.re > 0.0);
    let listed: usize = growing.map(|m| if m.lambda.im > 0.0 { 2 } else { 1 }).sum();
    let count = found.growing?;
    (count != listed).then(|| {
        format!(
            "the argument principle counts {count} growing eigenvalues, but {listed} were found: the list of modes is incomplete"
        )
    })
}

fn beyond(found: &Washboard) -> Option<String> {
    let complete_hz = found.complete_to_rad_per_s / TAU;
    if found.complete_to_rad_per_s < found.needed_to_rad_per_s {
        return Some(format!(
            "only modes up to {complete_hz:.0} Hz are included, as many as possible, but teeth drive modes up to {:.0} Hz: their stability is not known",
            found.needed_to_rad_per_s / TAU
        ));
    }
    let stiffness = found.washboarding.stiffness_n_per_m;
    (stiffness > found.safe_beyond_n_per_m).then(|| {
        format!(
            "modes above {complete_hz:.0} Hz are not included; their damping prevents growth up to {} N/m",
            shown_to(3, found.safe_beyond_n_per_m)
        )
    })
}

fn unconfirmed(found: &Washboard) -> Option<String> {
    let count = found.unconfirmed();
    (count > 0).then(|| {
        format!(
            "at {count} of {} speeds of the diagram the argument principle does not confirm that nothing grows below the boundary",
            found.lobes.len()
        )
    })
}

fn without_pitch(found: &Washboard) -> Option<String> {
    if !found.washboarding.is_even() {
        return Some(
            "unevenly spaced teeth leave no pattern of a single pitch, so none is given".to_owned(),
        );
    }
    found.run.feed_m_per_s.is_none().then(|| {
        "without cut.feed_m_per_s the pitch of the pattern on the board is not known".to_owned()
    })
}
