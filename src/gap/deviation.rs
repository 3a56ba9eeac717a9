//! The deflection at the cut, and the forces of the pads, over gap, side force and speed.

use crate::plate::{Plate, Resolution};
use crate::scene::{ContactLaw, Scene, rad_per_s};
use crate::spectrum::{Cancellation, Work};
use crate::stability::Analysis;
use crate::stretched::{LARGEST_SLOPE, StretchedBlade};

use super::GapError;

/// Deflections at the cut under a side force there.
#[derive(Debug, Clone, PartialEq)]
pub struct DeviationMap {
    /// Angle of the force and of the deflection: that of the cut.
    pub angle_rad: f64,
    /// Speed of the map over gap and force.
    pub rpm: f64,
    /// Gaps, relative to those of the scene; zero stands for guides that are linear.
    pub gap_factors: Vec<f64>,
    /// Side forces.
    pub forces_n: Vec<f64>,
    /// One row for each gap, one entry for each force; `None` where slopes exceed 0.1 and the model is not valid.
    pub over_gap: Vec<Vec<Option<Deviation>>>,
    /// Side force of the series over the speed, with the gaps of the scene.
    pub force_n: f64,
    /// Speeds of the series.
    pub speeds_rpm: Vec<f64>,
    /// One entry for each speed; `None` where the blade leans by more than its thickness.
    pub over_speed: Vec<Option<Deviation>>,
}

/// A stationary deflection.
#[derive(Debug, Clone, PartialEq)]
pub struct Deviation {
    /// Deflection of the rim at the cut.
    pub deviation_m: f64,
    /// Largest deflection of the blade, as an absolute value.
    pub largest_m: f64,
    /// Force of each one-sided pad on the blade beyond its gap; empty for linear guides.
    pub pad_forces_n: Vec<f64>,
}

/// Gaps and forces, relative to those given.
const GAPS: [f64; 6] = [0.0, 0.25, 0.5, 1.0, 2.0, 4.0];
const FORCES: [f64; 5] = [0.25, 0.5, 1.0, 2.0, 4.0];
/// Speeds of the series over the speed, from rest to the end of the sweep.
const SPEEDS: usize = 13;
/// Modes at rest in the basis. With 36 in the place of 24, at draft accuracy, the deflections at the cut of the built-in
/// saw with a gap of 40 µm change by 0.01 %, and those of a saw with two pads and a gap of 50 µm by less than 0.5 %,
/// except one of thirty, which changes by 5 %.
const MODES: usize = 24;

impl DeviationMap {
    /// Computes the map and the series of the saw of an analysis.
    ///
    /// # Errors
    /// [`GapError`].
    pub(super) fn new(analysis: &Analysis, rpm: f64, force_n: f64) -> Result<Self, GapError> {
        let scene = &analysis.scene;
        let angle_rad = scene.cut().map_or(0.0, |cut| cut.angle_rad);
        let resolution = analysis.model.plate.resolution;
        let forces_n: Vec<f64> = FORCES.map(|factor| factor * force_n).to_vec();
        let work = Work::of("gaps", GAPS.len() + 1);
        let mut over_gap = Vec::new();
        for factor in GAPS {
            let scene = with_gaps(scene, factor)?;
            let pressed = Pressed::new(&scene, resolution, (rpm, angle_rad))?;
            let of = |force: &f64| pressed.deviation(*force, rpm);
            over_gap.push(forces_n.iter().map(of).collect::<Result<Vec<_>, _>>()?);
            work.advance();
        }
        let end_rpm = crate::scene::rpm(analysis.range_rad_per_s.1);
        let speeds_rpm: Vec<f64> = (0..SPEEDS)
            .map(|k| end_rpm * k as f64 / (SPEEDS - 1) as f64)
            .collect();
        let pressed = Pressed::new(scene, resolution, (end_rpm, angle_rad))?;
        let thickness_m = scene.blade().thickness_m;
        let mut over_speed = Vec::new();
        for speed in &speeds_rpm {
            let found = pressed.deviation(force_n, *speed)?;
            over_speed.push(found.filter(|found| found.largest_m <= thickness_m));
        }
        work.advance();
        Ok(DeviationMap {
            angle_rad,
            rpm,
            gap_factors: GAPS.to_vec(),
            forces_n,
            over_gap,
            force_n,
            speeds_rpm,
            over_speed,
        })
    }

    /// The largest side force at each gap that keeps the deflection at the cut within a limit, interpolated; `None` where the
    /// smallest force of the map exceeds it.
    pub fn force_within_n(&self, limit_m: f64) -> Vec<Option<f64>> {
        let of_gap = |row: &Vec<Option<Deviation>>| {
            let mut before: Option<(f64, f64)> = None;
            for (force, found) in self.forces_n.iter().zip(row) {
                let deviation_m = found
                    .as_ref()
                    .map_or(f64::INFINITY, |at| at.deviation_m.abs());
                let at = (force.abs(), deviation_m);
                if at.1 > limit_m {
                    return before.map(|(force, deviation)| {
                        force + (at.0 - force) * (limit_m - deviation) / (at.1 - deviation)
                    });
                }
                before = Some(at);
            }
            before.map(|(force, _)| force)
        };
        self.over_gap.iter().map(of_gap).collect()
    }
}

/// The scene with gaps multiplied by a factor; with linear guides if it is zero.
fn with_gaps(scene: &Scene, factor: f64) -> Result<Scene, GapError> {
    Ok(scene.edited(|file| {
        let guides = file.guides.iter_mut();
        for guide in guides.filter(|guide| guide.contact == ContactLaw::OneSided) {
            if factor == 0.0 {
                guide.contact = ContactLaw::Linear;
                guide.side = Default::default();
                guide.film_stiffness_n_per_m = 0.0;
            }
            if factor > 0.0 {
                guide.gap_m = guide.gap_m.map(|gap_m| factor * gap_m);
            }
        }
    })?)
}

/// A blade that is pressed at the rim at the cut.
struct Pressed {
    blade: StretchedBlade,
    place: (f64, f64),
}

impl Pressed {
    fn new(
        scene: &Scene,
        resolution: Resolution,
        (to_rpm, angle_rad): (f64, f64),
    ) -> Result<Self, GapError> {
        let plate = Plate::new(scene, resolution);
        let place = (plate.blade.outer_radius_m, angle_rad);
        let modes = MODES.min(plate.degrees_of_freedom());
        let blade = StretchedBlade::up_to(&plate, rad_per_s(to_rpm), place, modes)?;
        Ok(Pressed { blade, place })
    }

    fn deviation(&self, force_n: f64, rpm: f64) -> Result<Option<Deviation>, GapError> {
        Cancellation::current().check()?;
        let blade = self.blade.clone().pressed(force_n, self.place)?;
        let found = blade.settled(rad_per_s(rpm), &blade.flat())?;
        if blade.largest_slope(&found) > LARGEST_SLOPE {
            return Ok(None);
        }
        Ok(Some(Deviation {
            deviation_m: blade.deflection_m(&found, self.place.0, self.place.1),
            largest_m: blade.sites().largest_m(&found.coordinates),
            pad_forces_n: blade.pad_forces_n(&found),
        }))
    }
}
