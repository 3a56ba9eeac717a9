//! The scene, which describes a saw, in two stages: [`SceneFile`] as typed, and [`Scene`], validated and in
//! SI units and radians.
//!
//! JSON text becomes a [`Scene`] or a [`SceneError`] that names the key, the value, what is allowed and the
//! remedy. The name of a key contains its unit. [`Scene::edited`] is the only way to change a scene, and it
//! validates again, so that every scene is valid.

mod assumption;
mod blade;
mod constant_force;
mod cut;
mod cut_file;
mod damping;
mod entries;
mod excitation;
mod file;
mod free_number;
mod friction;
mod guide;
mod guide_arm;
mod guide_controller;
mod guide_file;
mod guide_film;
mod limits;
mod membrane;
mod pad_law;
mod parameter;
mod parser;
mod plausibility;
mod point;
mod profile;
mod quantities;
mod quantity;
mod refusal;
#[cfg(test)]
mod refusal_tests;
mod requirement;
mod residual;
mod response;
mod roll_band;
mod rule;
mod runup;
mod saw;
mod schema;
mod setting;
mod side_force;
mod slot_passing;
mod slots;
mod span;
mod speed_range;
mod spline;
mod straight_edge;
mod teeth_in_cut;
mod thickness;
pub(crate) mod typical_block;
mod unit;
mod validation;
mod washboarding;
mod wave_factors;
mod wood;

pub use crate::page::text::FileError;
pub use assumption::{AssumedBlock, Assumption};
pub(crate) use blade::RimMass;
pub use blade::{Blade, BladeFile, Bore, InPlane, Material, Mount, RimFile};
pub(crate) use constant_force::ConstantForce;
pub use constant_force::ForceCause;
pub(crate) use cut::in_words as in_the_cut;
pub use cut::{Cut, CutRun};
pub use cut_file::{CutFile, CutSpeedFile};
pub use damping::{DampingFile, ModeRatioRow};
pub(crate) use entries::{Entry, in_words};
pub use excitation::{ExcitationFile, ExcitationLine};
pub use file::{Accuracy, Measured, MeasuredRow, SceneFile, SweepFile};
#[doc(hidden)]
pub use free_number::spread;
pub use free_number::{Freed, NamedBounds, NamedValues};
pub(crate) use free_number::{Parted, effective, is_logarithmic, scene_at};
pub use friction::FrictionFile;
pub(crate) use guide::{Guide, Lifting};
pub use guide_arm::GuideArmFile;
pub use guide_controller::GuideControllerFile;
pub use guide_file::{ContactLaw, GuideFile, GuideShape, GuideSide};
pub use guide_film::GuideFilmFile;
pub use limits::LimitsFile;
#[cfg(any(feature = "cli", feature = "page"))]
pub(crate) use limits::USUAL_MARGIN;
pub(crate) use membrane::{Membrane, Temperature, TemperatureShape};
pub use membrane::{MembraneFile, TemperatureFile, TemperatureRow};
pub(crate) use pad_law::{PadLaw, PoleTerm};
pub use parameter::Parameter;
pub use parser::MAX_SCENE_BYTES;
#[cfg(feature = "cli")]
pub(crate) use parser::SCENE_TEXT;
pub(crate) use plausibility::unusual_number;
pub(crate) use point::Point;
pub use point::Polar;
pub(crate) use profile::Profile;
#[cfg(any(test, feature = "page"))]
pub(crate) use quantities::QUANTITIES;
pub(crate) use quantities::{quantity, typical_value};
pub use quantity::{Kind, Quantity, Typical};
pub(crate) use refusal::Given;
pub use refusal::{RefusedValue, SceneError};
pub(crate) use residual::ResidualStress;
pub use residual::ResidualStressRow;
pub use response::ResponseFile;
pub use roll_band::RollBandFile;
pub(crate) use roll_band::{Groove, RollBand};
pub use runup::{ProbeFile, RunUpFile};
pub use saw::Scene;
pub use schema::json_schema;
#[cfg(feature = "cli")]
pub(crate) use schema::{Key, keys};
pub(crate) use setting::Reading;
pub use setting::{Setting, number_in, number_of, numbers_of};
pub use side_force::SideForceFile;
pub(crate) use side_force::{OscillatingForce, SideForce, USUAL_SIDE_FORCE_N};
pub(crate) use slot_passing::SlotPassing;
pub(crate) use slots::SplitBranch;
pub use slots::{Slots, SlotsFile};
pub use span::Span;
pub use speed_range::SpeedRange;
pub(crate) use speed_range::speed_rad_per_s;
pub use spline::SplineFile;
pub(crate) use straight_edge::StraightEdge;
pub use straight_edge::StraightEdgeFile;
pub use teeth_in_cut::{TeethInCut, Tooth};
pub use thickness::ThicknessRow;
pub use washboarding::WashboardingFile;
pub(crate) use washboarding::{MAX_CUTTING_STIFFNESS, Washboarding};
pub use wave_factors::{WaveFactor, WaveFactorRow, WaveFactors};
pub(crate) use wood::Wood;
pub use wood::WoodFile;

/// Standard acceleration of gravity (CGPM 1901).
pub(crate) const GRAVITY_M_PER_S2: f64 = 9.80665;

/// Rotation speed in rad/s from revolutions per minute.
pub fn rad_per_s(rpm: f64) -> f64 {
    rpm * std::f64::consts::PI / 30.0
}

/// Rotation speed in revolutions per minute from rad/s, rounded to 15 digits, so that a typed speed comes back as typed.
pub fn rpm(rad_per_s: f64) -> f64 {
    let rpm = rad_per_s * 30.0 / std::f64::consts::PI;
    if rpm == 0.0 || !rpm.is_finite() {
        return rpm;
    }
    let scale = 10_f64.powi(DIGITS - 1 - rpm.abs().log10().floor() as i32);
    let rounded = (rpm * scale).round() / scale;
    if rounded.is_finite() { rounded } else { rpm }
}

/// Number of decimal digits that a conversion and its inverse keep.
const DIGITS: i32 = 15;

#[cfg(test)]
mod tests {
    use super::*;

    /// 6800 rpm came back as 6799.999999999999.
    #[test]
    fn a_typed_speed_comes_back_as_typed() {
        for tenths in 0..200_000 {
            let typed = f64::from(tenths) / 10.0;
            assert_eq!(rpm(rad_per_s(typed)), typed);
        }
        for typed in [-1e-3, 2400.264, 41_145.312_5, f64::INFINITY] {
            assert_eq!(rpm(rad_per_s(typed)), typed);
        }
    }
}
