//! The report of an analysis.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::certificate::BandCertificate;
use super::chart::{CampbellDiagram, RootLoci};
use super::event_shape::{EventShape, shapes};
use super::excitation::ExcitationLines;
use super::in_cut::InCut;
use super::membrane::BladeStress;
use super::modes::{RestMode, Whirl};
use super::speeds::{CriticalSpeed, InstabilityBand, OperatingPoint};
use super::split_pairs::SplitPairs;
use crate::analyses::verdict::Verdict;
use crate::model::scene::{Accuracy, SceneFile};
use crate::modes::SpectrumError;
use crate::stability::{Analysis, Sensitivity};

/// Report of an analysis (`report.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut: "idling", or "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy. The results hold for the
    /// numbers as typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// Terms of the equation of motion that were assembled.
    pub terms: Vec<String>,
    /// Lowest oscillating modes of the blade at rest, ascending.
    pub modes_at_rest: Vec<RestMode>,
    /// Number of modes at rest that decay without oscillating (overdamped), at rates up to 2π times the height of
    /// a diagram that begins at rest; they are not listed.
    #[serde(default)]
    pub overdamped_modes_at_rest: usize,
    /// Every critical speed up to the end of the sweep, ascending.
    pub critical_speeds: Vec<CriticalSpeed>,
    /// Whether `critical_speeds` are those of the saw without its damping: with damping that turns with the
    /// blade no eigenvalue of the damped saw is zero at any speed.
    #[serde(default)]
    pub critical_speeds_without_damping: bool,
    /// Bands of instability within the sweep, by onset; `certificate` gives the share of the sweep that is
    /// proven to have no others.
    pub instabilities: Vec<InstabilityBand>,
    /// Critical speeds of upper branches, and speeds at which bands are not certain; absent for a blade without slots.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub split_pairs: Option<SplitPairs>,
    /// First critical speed, also above the sweep; null if the blade has none.
    pub first_critical_rpm: Option<f64>,
    /// Flutter speed: lowest speed at which flutter counts, see `counted_rpm` of the bands.
    pub flutter_rpm: Option<f64>,
    /// Onset of the first flutter band, including weak ones.
    pub first_merge_rpm: Option<f64>,
    /// Growth rate above which a band counts as flutter.
    pub flutter_threshold_per_s: f64,
    /// The forces of the cut in the diagram, and the idling saw, if the scene requests it.
    #[serde(default)]
    pub in_cut: Option<InCut>,
    /// Multiples of the rotation speed and their crossings with natural frequencies, if the scene requests
    /// them.
    #[serde(default)]
    pub excitation: Option<ExcitationLines>,
    /// Whether the saw can run at its operating speed.
    pub verdict: Verdict,
    /// Motions at the operating speed, if the scene has one.
    pub operating: Option<OperatingPoint>,
    /// Modes at one speed, on request.
    pub whirl: Option<Whirl>,
    /// Shapes of the blade at every critical speed, at the peak of every band, at the operating speed and at
    /// further speeds, on request.
    #[serde(default)]
    pub shapes: Vec<EventShape>,
    /// Size of the basis and estimated errors.
    pub accuracy: BasisAccuracy,
    /// Number of eigenproblems solved.
    pub work: SolveCounts,
    /// Checks of the list of bands: the share of the sweep that is proven to have no unlisted instability,
    /// intervals that were searched without proof, and disagreements.
    pub certificate: BandCertificate,
    /// Branches over speed.
    pub campbell: CampbellDiagram,
    /// Eigenvalues of the two modes that coalesce at the flutter speed, or else at the onset of the first
    /// flutter band, over the speeds around it.
    pub root_loci: Option<RootLoci>,
    /// Stress of heat, roll tension and manufacture, if the scene has any.
    pub membrane: Option<BladeStress>,
    /// Derivatives of critical speeds and onsets by numbers of the scene, on request.
    pub sensitivities: Vec<Sensitivity>,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

impl Report {
    /// Adds the shapes at every critical speed, at the peak of every band, at the operating speed and at
    /// requested speeds, by ascending speed.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn add_shapes(
        &mut self,
        analysis: &Analysis,
        asked_rad_per_s: &[f64],
    ) -> Result<(), SpectrumError> {
        self.shapes = shapes(analysis, asked_rad_per_s)?;
        Ok(())
    }
}

/// Size of the basis and estimated errors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "AccuracyEntry")]
pub struct BasisAccuracy {
    /// Named accuracy of the scene.
    pub name: Accuracy,
    /// Largest number of nodal diameters.
    pub max_diameters: usize,
    /// Speed up to which no wave with more nodal diameters can stand still in space: at least the end of the sweep and
    /// the first critical speed. Critical speeds, bands, errors and the certificate hold up to it.
    pub complete_to_rpm: f64,
    /// Number of radial functions for each number of nodal diameters, including those that steps and kinks of the
    /// thickness add.
    pub radial_functions: usize,
    /// Size of the basis.
    pub degrees_of_freedom: usize,
    /// Relative error allowed for critical speeds, onsets and the lowest frequencies at rest.
    pub tolerance: f64,
    /// Whether the estimate is within the tolerance, which the largest basis may not achieve.
    pub reached: bool,
    /// Estimated relative error of the critical speeds within the sweep, from the change with a larger basis.
    pub estimated_relative_error: Option<f64>,
    /// Estimated relative error of the lowest frequencies at rest, measured on a larger basis.
    #[serde(default)]
    pub estimated_resting_error: Option<f64>,
    /// Estimated relative error of the frequencies in the diagram, each relative to the frequency of its wave
    /// on the blade.
    #[serde(default)]
    pub estimated_drawn_error: Option<f64>,
}

/// Numbers of eigenproblems solved, by kind.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "WorkEntry")]
pub struct SolveCounts {
    /// Eigenproblems of the full model: Krylov iterations with a factorization each, or dense ones.
    pub full_solves: usize,
    /// Number of `full_solves` that used the block structure of the blade and the few columns of its guides, in a time
    /// linear in the number of basis functions; scenes with edge loads or dampers have no such structure.
    pub structured_solves: usize,
    /// Eigenproblems of one number of nodal diameters of a free blade.
    pub reduced_solves: usize,
    /// Eigenproblems of the reduced model by waves.
    pub local_solves: usize,
    /// Modes and coalescences found by Newton's method on the reduced model.
    pub refined_pairs: usize,
    /// Symmetric eigenproblems of the full model at other temperatures, for limits of heat.
    pub heat_solves: usize,
}
