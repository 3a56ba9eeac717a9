//! The cut: the forces that the wood exerts on the teeth, and their duration.

use std::f64::consts::PI;

use super::cut_file::{CutFile, CutSpeedFile};
use super::quantities::quantity;
use super::quantity::Quantity;
use super::rule::{needed_teeth, refuse};
use super::teeth_in_cut::TeethInCut;
use super::washboarding::Washboarding;
use super::wood::Wood;
use super::{Blade, RefusedValue, SceneError, rad_per_s};
use crate::page::text::{shown, shown_to};

/// A validated cut.
#[derive(Debug, Clone, PartialEq)]
pub struct Cut {
    /// The teeth that pass the arc of the cut.
    pub teeth: TeethInCut,
    /// Time before and after the cut, without forces.
    pub idle_s: f64,
    /// Speeds, with the forces at each.
    pub runs: Vec<CutRun>,
    /// Contact with the wood during the cut.
    pub(crate) wood: Option<Wood>,
    /// Force that depends on the surface left by the preceding tooth; used by washboarding only.
    pub(crate) washboarding: Option<Washboarding>,
    /// Whether the model includes stretching of the middle surface.
    pub stretching: bool,
    /// Forces under which the Campbell diagram is computed; `None` for the diagram of the idling saw.
    pub chart: Option<CutRun>,
    file: CutFile,
    rim_radius_m: f64,
}

/// One speed of a cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutRun {
    /// Rotation speed as typed.
    pub rpm: f64,
    /// Rotation speed.
    pub speed_rad_per_s: f64,
    /// Mean number of teeth in the cut.
    pub teeth: f64,
    /// Tangential force on each tooth, against the rotation; given, or computed from the power.
    pub tangential_n: f64,
    /// Radial force on each tooth, towards the axis.
    pub radial_n: f64,
    /// Lateral force on each tooth.
    pub lateral_n: f64,
    /// Tangential force on each tooth that corresponds to the power P: P/(Ωb) divided by the number of teeth in the
    /// cut; `None` without a power.
    pub tangential_of_power_n: Option<f64>,
    /// Feed speed of the wood.
    pub feed_m_per_s: Option<f64>,
    /// Duration of the forces: length of the board over feed speed, or one second if either is not given.
    pub duration_s: f64,
}

/// Longest duration of a transient; the record of a longer one would not fit into memory.
const MAX_DURATION_S: f64 = quantity("cut.idle_s").allowed.to;
const MAX_FORCE_N: f64 = quantity("cut.tangential_n_per_tooth").allowed.to;
const RPM: Quantity = quantity("cut.chart_rpm");

impl Cut {
    pub(super) fn new(
        typed: &CutFile,
        operating_rpm: Option<f64>,
        teeth: Option<u32>,
        blade: &Blade,
    ) -> Result<Self, SceneError> {
        let teeth = teeth_in_cut(typed, teeth, blade)?;
        let mut cut = Cut {
            teeth,
            idle_s: typed.idle_s,
            runs: Vec::new(),
            wood: None,
            washboarding: None,
            stretching: typed.stretching,
            chart: None,
            file: typed.clone(),
            rim_radius_m: blade.outer_radius_m,
        };
        let speeds: Vec<f64> = match (&typed.speeds[..], operating_rpm) {
            ([], Some(rpm)) => vec![rpm],
            (speeds, _) => speeds.iter().map(|speed| speed.rpm).collect(),
        };
        for rpm in speeds {
            let run = cut.at_rpm(rpm)?;
            cut.runs.push(run);
        }
        if let Some(wood) = &typed.wood {
            cut.wood = Wood::new(wood, &teeth, blade)?;
        }
        let washboarding = typed.washboarding.as_ref();
        cut.washboarding = washboarding
            .map(|washboarding| Washboarding::new(washboarding, &teeth))
            .transpose()?;
        let of_chart = |rpm| cut.run_at(rpm, "cut.chart_rpm");
        cut.chart = typed.chart_rpm.map(of_chart).transpose()?;
        Ok(cut)
    }

    /// The forces at a speed: the values that the scene lists for it, and for missing ones the values of the cut.
    ///
    /// # Errors
    /// [`SceneError::Value`] if neither a tangential force nor a power is given, or a number is out of range.
    pub fn at_rpm(&self, rpm: f64) -> Result<CutRun, SceneError> {
        self.run_at(rpm, "rpm")
    }

    /// The forces as [`Cut::at_rpm`]; a refused speed is reported under `key`, unless the scene lists it.
    fn run_at(&self, rpm: f64, key: &str) -> Result<CutRun, SceneError> {
        let index = self.file.speeds.iter().position(|speed| speed.rpm == rpm);
        let own = index.map_or_else(CutSpeedFile::default, |i| self.file.speeds[i].clone());
        let key = index.map_or(key.into(), |i| format!("cut.speeds[{i}].rpm"));
        let speed_rad_per_s = rad_per_s(RPM.checked(&key, rpm)?);
        let typed = &self.file;
        let power_w = own.power_w.or(typed.power_w);
        let tangential_of_power_n =
            power_w.map(|p| p / (speed_rad_per_s * self.rim_radius_m) / self.teeth.mean);
        if let (Some(force_n), Some(power_w)) = (tangential_of_power_n, power_w)
            && force_n > MAX_FORCE_N
        {
            let allowed = format!("such that a tooth cuts with at most {MAX_FORCE_N:e} N");
            let remedy = "give a smaller power, a higher speed or a larger cut.depth_m";
            return Err(refuse("cut.power_w", power_w, allowed, remedy));
        }
        let given = own.tangential_n_per_tooth.or(typed.tangential_n_per_tooth);
        let Some(tangential_n) = given.or(tangential_of_power_n) else {
            let allowed = "given, or cut.power_w in its place";
            let remedy = "a cut needs the force against the rotation, or the power";
            let key = "cut.tangential_n_per_tooth";
            return Err(RefusedValue::missing(key, allowed, remedy).into());
        };
        let radial_n = own.radial_n_per_tooth.or(typed.radial_n_per_tooth);
        let lateral_n = own.lateral_n_per_tooth.or(typed.lateral_n_per_tooth);
        let feed_m_per_s = own.feed_m_per_s.or(typed.feed_m_per_s);
        Ok(CutRun {
            rpm,
            speed_rad_per_s,
            teeth: self.teeth.mean,
            tangential_n,
            radial_n: radial_n.unwrap_or(0.0),
            lateral_n: lateral_n.unwrap_or(0.0),
            tangential_of_power_n,
            feed_m_per_s,
            duration_s: self.duration_s(feed_m_per_s)?,
        })
    }

    fn duration_s(&self, feed_m_per_s: Option<f64>) -> Result<f64, SceneError> {
        let Some((length, feed)) = self.file.board_length_m.zip(feed_m_per_s) else {
            return Ok(1.0);
        };
        let seconds = length / feed;
        if seconds > MAX_DURATION_S {
            let allowed = format!("such that the cut takes at most {MAX_DURATION_S} s");
            let remedy = "give a shorter board or a faster feed";
            return Err(refuse("cut.board_length_m", length, allowed, remedy));
        }
        Ok(seconds)
    }
}

/// The cut at some speeds as reports name it: "in the cut at 1800 and 2800 rpm (4 teeth)".
pub(crate) fn in_words(runs: &[CutRun]) -> String {
    let speeds: Vec<String> = runs.iter().map(|run| shown(run.rpm)).collect();
    let teeth = match runs.first().map_or(0.0, |run| run.teeth) {
        1.0 => "1 tooth".to_owned(),
        teeth => format!("{} teeth", shown_to(3, teeth)),
    };
    format!("in the cut at {} rpm ({teeth})", speeds.join(" and "))
}

/// Places and mean number of the teeth in the cut of a blade with `teeth` teeth.
fn teeth_in_cut(
    typed: &CutFile,
    teeth: Option<u32>,
    blade: &Blade,
) -> Result<TeethInCut, SceneError> {
    let remedy = "the pitch of the teeth determines where the forces act; give their number";
    let all_teeth = needed_teeth(teeth, "where the scene has a cut", remedy)?;
    Ok(TeethInCut {
        angle_deg: typed.angle_deg,
        mean: mean(typed, all_teeth, blade)?,
        all: all_teeth,
    })
}

/// The given number of teeth in the cut, or depth over pitch, which is their mean number.
fn mean(typed: &CutFile, all_teeth: u32, blade: &Blade) -> Result<f64, SceneError> {
    let key = "cut.teeth_in_cut";
    if let Some(teeth) = typed.teeth_in_cut {
        if teeth <= all_teeth {
            return Ok(f64::from(teeth));
        }
        let allowed = format!("at most blade.teeth ({all_teeth})");
        let remedy = "count the teeth that touch the wood at a time";
        return Err(refuse(key, f64::from(teeth), allowed, remedy));
    }
    let Some(depth_m) = typed.depth_m else {
        let allowed = "given, or cut.depth_m in its place";
        let remedy = "give the number of teeth in the cut, or its depth";
        return Err(RefusedValue::missing(key, allowed, remedy).into());
    };
    let diameter_m = 2.0 * blade.outer_radius_m;
    if depth_m > diameter_m {
        let allowed = format!("at most the blade's diameter ({})", shown(diameter_m));
        let remedy = "give the depth of cut in metres";
        return Err(refuse("cut.depth_m", depth_m, allowed, remedy));
    }
    let pitch_m = PI * diameter_m / f64::from(all_teeth);
    Ok(depth_m / pitch_m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Scene, SceneFile};

    fn with(change: impl FnOnce(&mut SceneFile, &mut CutFile)) -> Result<Cut, SceneError> {
        let mut file = Scene::paper().file().clone();
        let mut cut = file.cut.take().unwrap();
        change(&mut file, &mut cut);
        file.cut = Some(cut);
        Scene::try_from(file).map(|scene| scene.cut.unwrap())
    }

    #[test]
    fn the_papers_four_teeth_are_around_the_middle_of_the_cut() {
        let teeth = with(|_, cut| cut.teeth_in_cut = Some(4)).unwrap().teeth;
        let standing = teeth.standing();
        let pitches: Vec<f64> = standing
            .iter()
            .map(|tooth| tooth.angle_rad / teeth.pitch_rad())
            .collect();
        assert_eq!(pitches, [-1.5, -0.5, 0.5, 1.5]);
        assert!(standing.iter().all(|tooth| tooth.share == 1.0));
    }

    /// The depth of 200 mm is 3.766 of 42 pitches; five teeth have a pitch of 0.343 m at 546 mm.
    #[test]
    fn depth_over_pitch_is_the_mean_number_of_teeth() {
        let mean = |diameter_m: f64, teeth: u32, depth_m: f64| {
            let cut = with(|file, cut| {
                file.blade.outer_diameter_m = diameter_m;
                file.blade.teeth = Some(teeth);
                (cut.teeth_in_cut, cut.depth_m) = (None, Some(depth_m));
            });
            cut.unwrap().teeth.mean
        };
        for (found, expected) in [
            (mean(0.71, 42, 0.2), 3.7659),
            (mean(0.546, 5, 0.2), 0.58299),
            (mean(0.546, 5, 0.01), 0.029150),
            (mean(0.546, 5, 0.5), 1.45748),
        ] {
            assert!((found / expected - 1.0).abs() < 1e-4, "{found} {expected}");
        }
    }

    /// 80 hp at 2800 rpm and a radius of 355 mm are 573 N, shared by four teeth.
    #[test]
    fn power_over_rim_speed_gives_the_force() {
        let cut = with(|_, cut| {
            cut.teeth_in_cut = Some(4);
            cut.tangential_n_per_tooth = None;
            cut.speeds.clear();
            cut.power_w = Some(80.0 * 745.7);
        })
        .unwrap();
        let force = cut.at_rpm(2800.0).unwrap().tangential_n;
        assert!((force - 143.28).abs() < 0.01, "{force}");
    }
}
