//! Where the teeth in the cut are.

use std::f64::consts::{PI, TAU};

use super::check::{refuse, within};
use super::cut_file::CutFile;
use super::{Blade, RefusedValue, SceneError};

/// The teeth in the cut at a time, one pitch apart around its middle.
#[derive(Debug, Clone, Copy)]
pub struct TeethInCut {
    /// Angle of the middle of the cut.
    pub angle_rad: f64,
    /// How many.
    pub count: u32,
    /// Angle from tooth to tooth.
    pub pitch_rad: f64,
}

impl TeethInCut {
    /// Of a cut on a blade with so many teeth.
    pub fn new(typed: &CutFile, teeth: Option<u32>, blade: &Blade) -> Result<Self, SceneError> {
        let Some(all_teeth) = teeth.filter(|teeth| *teeth > 0) else {
            let remedy = "the pitch of the teeth says where the forces act; give their number";
            let given = teeth.map_or("missing".into(), |teeth| teeth.to_string());
            let allowed = "at least 1 where the scene has a cut";
            return Err(RefusedValue::new("blade.teeth", given, allowed, remedy).into());
        };
        Ok(TeethInCut {
            angle_rad: within("cut.angle_deg", typed.angle_deg, (-3600.0, 3600.0))?.to_radians(),
            count: count(typed, all_teeth, blade)?,
            pitch_rad: TAU / f64::from(all_teeth),
        })
    }

    /// Arc of the rim that they take.
    pub fn arc_rad(&self) -> f64 {
        f64::from(self.count) * self.pitch_rad
    }
}

/// The given number, or the depth over the pitch, rounded: what is in the cut on average.
fn count(typed: &CutFile, all_teeth: u32, blade: &Blade) -> Result<u32, SceneError> {
    let key = "cut.teeth_in_cut";
    if let Some(teeth) = typed.teeth_in_cut {
        if (1..=all_teeth).contains(&teeth) {
            return Ok(teeth);
        }
        let allowed = format!("between 1 and blade.teeth ({all_teeth})");
        let remedy = "count the teeth that touch the wood at a time";
        return Err(refuse(key, f64::from(teeth), allowed, remedy));
    }
    let Some(depth_m) = typed.depth_m else {
        let allowed = "given, or cut.depth_m in its place";
        let remedy = "say how many teeth are in the cut, or how deep it is";
        return Err(RefusedValue::missing(key, allowed, remedy).into());
    };
    let diameter_m = 2.0 * blade.outer_radius_m;
    if !(depth_m > 0.0 && depth_m <= diameter_m) {
        let allowed = format!("above 0 and at most the blade's diameter ({diameter_m})");
        let remedy = "give the depth of cut in metres";
        return Err(refuse("cut.depth_m", depth_m, allowed, remedy));
    }
    let pitch_m = PI * diameter_m / f64::from(all_teeth);
    Ok(((depth_m / pitch_m).round() as u32).clamp(1, all_teeth))
}
