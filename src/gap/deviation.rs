//! The deflection at the cut, and the forces of the pads, over gap, side force and speed.

use crate::campbell::even_speeds;
use crate::scene::Scene;
use crate::spectrum::Work;
use crate::stability::Analysis;

use super::GapError;
use super::amplitude::with_linear_guides;
use super::pressed::{Deviation, PressedBlade};

/// Deflections at the cut under a side force there.
#[derive(Debug, Clone, PartialEq)]
pub struct DeviationMap {
    /// Angle of the force and of the deflection, which is that of the cut.
    pub angle_rad: f64,
    /// Speed of the map over gap and force.
    pub rpm: f64,
    /// Gaps, relative to those of the scene; zero for guides that are linear.
    pub gap_factors: Vec<f64>,
    /// Side forces.
    pub forces_n: Vec<f64>,
    /// Deflections, one row for each gap, one entry for each force; `None` where slopes exceed 0.1 and the model is not
    /// valid.
    pub over_gap: Vec<Vec<Option<Deviation>>>,
    /// Side force of the map over gap and speed.
    pub force_n: f64,
    /// Speeds of the map over gap and speed.
    pub speeds_rpm: Vec<f64>,
    /// Deflections, one row for each gap, one entry for each speed; `None` where the blade deflects by more than its
    /// thickness or the model is not valid.
    pub over_speed: Vec<Vec<Option<Deviation>>>,
    /// Estimated error of the deflections over gap and force.
    pub basis_error: Option<BasisError>,
}

/// Largest relative change of the deflections at the cut on a larger basis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BasisError {
    /// The relative change.
    pub share: f64,
    /// Factor of the gaps at which the change occurs.
    pub gap_factor: f64,
    /// Side force at which the change occurs.
    pub force_n: f64,
    /// Numbers of modes at rest in the two bases.
    pub modes: [usize; 2],
}

/// Number of gaps and of forces. Each is the cube root of two times the preceding one.
const FACTORS: usize = 13;
/// Smallest gap and force, relative to the given ones.
const LEAST_FACTOR: f64 = 0.25;
/// Distance, in gaps and in forces of the map, between the deflections whose error is estimated.
const ESTIMATED_EVERY: usize = 3;
/// Number of speeds of the map over gap and speed, from rest to the end of the sweep.
const SPEEDS: usize = 13;
/// Number of modes at rest in the basis.
pub(super) const MODES: usize = 24;
/// Number of modes at rest in the larger basis, with which the deflections are compared.
const MORE_MODES: usize = 36;

/// Gaps and forces of the maps, relative to the given ones.
fn factors() -> impl Iterator<Item = f64> {
    (0..FACTORS).map(|k| LEAST_FACTOR * (k as f64 / 3.0).exp2())
}

impl DeviationMap {
    /// Computes both maps of the saw of an analysis.
    ///
    /// # Errors
    /// [`GapError`].
    pub(super) fn new(analysis: &Analysis, rpm: f64, force_n: f64) -> Result<Self, GapError> {
        let scene = &analysis.scene;
        let end_rpm = crate::scene::rpm(analysis.range_rad_per_s.1);
        let blade_of = |scene: &Scene, modes: usize| {
            let resolution = analysis.model.plate.resolution;
            PressedBlade::new(scene, resolution, end_rpm.max(rpm), modes)
        };
        let thickness_m = scene.blade().thickness_m;
        let mut map = DeviationMap {
            angle_rad: scene.cut_angle_rad(),
            rpm,
            gap_factors: [0.0].into_iter().chain(factors()).collect(),
            forces_n: factors().map(|factor| factor * force_n).collect(),
            over_gap: Vec::new(),
            force_n,
            speeds_rpm: even_speeds((0.0, end_rpm), SPEEDS),
            over_speed: Vec::new(),
            basis_error: None,
        };
        let work = Work::of("gaps", map.gap_factors.len() + 1);
        let linear_scene = with_linear_guides(scene, |guide| guide.stiffness_n_per_m)?;
        let linear = blade_of(&linear_scene, MODES)?;
        let lifting = blade_of(scene, MODES)?;
        for factor in &map.gap_factors {
            let own = (*factor > 0.0).then(|| lifting.with_gaps(*factor));
            let pressed = own.as_ref().unwrap_or(&linear);
            let forces = map.forces_n.iter();
            let over_forces = forces.map(|force| pressed.deviation(*force, rpm));
            map.over_gap.push(over_forces.collect::<Result<_, _>>()?);
            let over_speeds = map.speeds_rpm.iter().map(|speed| {
                let found = pressed.deviation(force_n, *speed)?;
                Ok(found.filter(|found| found.largest_m <= thickness_m))
            });
            let over_speeds: Result<_, GapError> = over_speeds.collect();
            map.over_speed.push(over_speeds?);
            work.advance();
        }
        map.basis_error = map.compared(&lifting, &blade_of(scene, MORE_MODES)?)?;
        work.advance();
        Ok(map)
    }

    /// The largest change of the deflections over gap and force on a larger basis; `None` if none of them is known.
    fn compared(
        &self,
        blade: &PressedBlade,
        finer: &PressedBlade,
    ) -> Result<Option<BasisError>, GapError> {
        let mut largest: Option<BasisError> = None;
        for gap_factor in factors().step_by(ESTIMATED_EVERY) {
            let [blade, finer] = [blade, finer].map(|blade| blade.with_gaps(gap_factor));
            for force_n in self.forces_n.iter().copied().step_by(ESTIMATED_EVERY) {
                let Some(share) = blade.change_with(&finer, (force_n, self.rpm))? else {
                    continue;
                };
                if largest.is_none_or(|largest| share > largest.share) {
                    largest = Some(BasisError {
                        share,
                        gap_factor,
                        force_n,
                        modes: [MODES, MORE_MODES],
                    });
                }
            }
        }
        Ok(largest)
    }

    /// The largest side force at each gap under which the deflection at the cut stays within a limit, interpolated; `None`
    /// where the deflection under the smallest force of the map exceeds the limit.
    pub fn force_within_n(&self, limit_m: f64) -> Vec<Option<f64>> {
        let forces: Vec<f64> = self.forces_n.iter().map(|force| force.abs()).collect();
        let rows = self.over_gap.iter();
        rows.map(|row| within(&forces, row, limit_m)).collect()
    }

    /// The largest speed at each gap up to which the deflection at the cut stays within a limit, interpolated; `None`
    /// where the deflection at rest exceeds the limit.
    pub fn speed_within_rpm(&self, limit_m: f64) -> Vec<Option<f64>> {
        let rows = self.over_speed.iter();
        rows.map(|row| within(&self.speeds_rpm, row, limit_m))
            .collect()
    }
}

/// The place at which the deflections at ascending places first exceed a limit, interpolated; the preceding place if a
/// deflection is not known; the last place if none exceeds the limit; `None` if the first one does.
fn within(places: &[f64], row: &[Option<Deviation>], limit_m: f64) -> Option<f64> {
    let mut before: Option<(f64, f64)> = None;
    for (place, found) in places.iter().zip(row) {
        let deviation_m = found
            .as_ref()
            .map_or(f64::INFINITY, |at| at.deviation_m.abs());
        if deviation_m > limit_m {
            return before.map(|(last, least)| {
                last + (place - last) * (limit_m - least) / (deviation_m - least)
            });
        }
        before = Some((*place, deviation_m));
    }
    before.map(|(place, _)| place)
}
