//! Washboarding: the lateral force on a tooth that cuts the surface left by the preceding tooth.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantities::{quantity, typical_value};
use super::rule::{MAX_GUIDES, refuse};
use super::teeth_in_cut::TeethInCut;
use super::wood::{Wood, WoodFile};
use super::{RefusedValue, SceneError};
use crate::page::text::shown;

/// The lateral force of the cut on the blade, −k (w(t) − μ w(t − τ)): each tooth cuts the surface that the
/// preceding tooth left at the same point in space, one tooth period τ earlier.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WashboardingFile {
    /// Lateral cutting stiffness k of all teeth in the cut together: lateral force per metre of lateral
    /// distance between the teeth and the surface left by the preceding ones.
    pub stiffness_n_per_m: f64,
    /// Share μ of a tooth's cut that lies on the surface left by the preceding tooth, 0 to 1.
    #[serde(default = "full_overlap")]
    pub overlap: f64,
    /// Arc of the rim on which the force acts; by default one pitch for each tooth in the cut.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arc_deg: Option<f64>,
    /// Angles between successive teeth, repeated around the blade, if teeth are unevenly spaced.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pitches_deg: Vec<f64>,
}

fn full_overlap() -> f64 {
    const { typical_value("cut.washboarding.overlap") }
}

/// Validated washboarding.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Washboarding {
    /// The force as typed.
    pub typed: WashboardingFile,
    /// The teeth, and the middle of the arc.
    pub teeth: TeethInCut,
    /// Angles between successive teeth, repeated around the blade, scaled to a whole turn; a single value for even teeth.
    pub pitches_rad: Vec<f64>,
}

/// Largest lateral cutting stiffness, in N/m.
pub(crate) const MAX_CUTTING_STIFFNESS: f64 =
    quantity("cut.washboarding.stiffness_n_per_m").allowed.to;
/// Allowed error of a pitch by rounding: the sum of the pitches of all teeth may differ from a whole turn by this angle
/// times the number of teeth.
const ROUNDED_DEG: f64 = 0.05;
/// Smallest pitch, as a share of the mean pitch; teeth closer to each other act as one.
const MIN_PITCH: f64 = 0.05;

impl Washboarding {
    pub(super) fn new(typed: &WashboardingFile, teeth: &TeethInCut) -> Result<Self, SceneError> {
        let key = "cut.washboarding.pitches_deg";
        Ok(Washboarding {
            pitches_rad: pitches_rad(key, &typed.pitches_deg, teeth.all)?,
            typed: typed.clone(),
            teeth: *teeth,
        })
    }

    /// The delays τ at a speed, one for each pitch. They have equal weight, because each tooth passes a given place
    /// of the wood once in each turn.
    pub fn delays_s(&self, speed_rad_per_s: f64) -> Vec<f64> {
        let of = |pitch: &f64| pitch / speed_rad_per_s;
        self.pitches_rad.iter().map(of).collect()
    }

    /// Angular frequency of tooth passing, Ω times the number of teeth.
    pub fn tooth_passing_rad_per_s(&self, speed_rad_per_s: f64) -> f64 {
        f64::from(self.teeth.all) * speed_rad_per_s
    }

    /// Whether the teeth are evenly spaced.
    pub fn is_even(&self) -> bool {
        self.pitches_rad.len() == 1
    }

    /// A spring of 1 N/m on the arc of the rim. The part of the force that is not delayed is k times its force.
    pub fn unit_spring(&self) -> Wood {
        Wood {
            typed: WoodFile {
                stiffness_n_per_m: 1.0,
                arc_deg: self.typed.arc_deg,
                ..WoodFile::default()
            },
            teeth: self.teeth,
        }
    }
}

/// The pitch of even teeth, or the given pitches, scaled to a whole turn.
fn pitches_rad(key: &str, typed: &[f64], teeth: u32) -> Result<Vec<f64>, SceneError> {
    let mean_deg = 360.0 / f64::from(teeth);
    if typed.is_empty() {
        return Ok(vec![mean_deg.to_radians()]);
    }
    let count = typed.len();
    if count > MAX_GUIDES || !(teeth as usize).is_multiple_of(count) {
        let allowed =
            format!("a number of pitches that divides blade.teeth ({teeth}), at most {MAX_GUIDES}");
        let remedy = "list the pitches that repeat around the blade, each once";
        return Err(refuse(key, count as f64, allowed, remedy));
    }
    for (index, pitch) in typed.iter().enumerate() {
        let least = MIN_PITCH * mean_deg;
        if *pitch >= least {
            continue;
        }
        let allowed = format!("at least {}", shown(least));
        let remedy = "teeth closer to each other act as one";
        return Err(refuse(&format!("{key}[{index}]"), *pitch, allowed, remedy));
    }
    let turn = typed.iter().sum::<f64>() * f64::from(teeth) / count as f64;
    if (turn - 360.0).abs() > ROUNDED_DEG * f64::from(teeth) {
        let given = format!("{turn} degrees in all, repeated around {teeth} teeth");
        let remedy = "give pitches whose mean is 360 degrees over the number of teeth";
        return Err(RefusedValue::new(key, given, "a whole turn of 360 degrees", remedy).into());
    }
    let even = typed.iter().all(|pitch| *pitch == typed[0]);
    let filling = 360.0 / turn;
    let pitches = typed.iter().map(|pitch| (pitch * filling).to_radians());
    Ok(pitches.take(if even { 1 } else { count }).collect())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::model::scene::Scene;

    fn with(change: impl FnOnce(&mut WashboardingFile)) -> Result<Washboarding, SceneError> {
        let scene = Scene::paper().edited(|saw| {
            let mut washboarding = WashboardingFile {
                stiffness_n_per_m: 1e4,
                overlap: 1.0,
                arc_deg: None,
                pitches_deg: Vec::new(),
            };
            change(&mut washboarding);
            let cut = saw.cut.as_mut().expect("a cut");
            (cut.teeth_in_cut, cut.washboarding) = (Some(4), Some(washboarding));
        });
        let cut = scene.map(|scene| scene.cut().expect("a cut").clone());
        cut.map(|cut| cut.washboarding.expect("washboarding"))
    }

    /// The saw has 42 teeth, four of them in the cut, and turns at 100 rad/s.
    #[test]
    fn teeth_give_the_arc_and_the_delays() {
        let even = with(|_| ()).unwrap();
        assert_eq!(even.teeth.all, 42);
        assert!((even.unit_spring().arc_rad() - 4.0 * TAU / 42.0).abs() < 1e-12);
        let delays = even.delays_s(100.0);
        assert!(delays.len() == 1 && (delays[0] - TAU / 4200.0).abs() < 1e-12);
        // 8° + 10° exceed two of 42 pitches by 5 %; 8.07° + 9.07° differ by rounding only.
        assert!(with(|w| w.pitches_deg = vec![8.0, 10.0]).is_err());
        let uneven = with(|w| w.pitches_deg = vec![8.07, 9.07]).unwrap();
        let turn = 21.0 * uneven.pitches_rad.iter().sum::<f64>();
        assert!((turn - TAU).abs() < 1e-12 && !uneven.is_even());
        let mean = 360.0 / 42.0;
        assert!(with(|w| w.pitches_deg = vec![mean; 3]).unwrap().is_even());
    }
}
