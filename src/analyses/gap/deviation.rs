//! The deflection at the cut, and the forces of the pads, over gap, side force and speed.

use crate::model::scene::Scene;
use crate::modes::Work;
use crate::modes::branches::even_speeds;
use crate::stability::Analysis;

use super::GapError;
use super::amplitude::with_linear_guides;
use super::pressed::{Deviation, PressedBlade};
use super::report::{BasisError, DeviationMap};

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

/// Stationary deflections in a row of forces or speeds.
type Row = Vec<Option<Deviation>>;

/// Computes both maps of the saw of an analysis, with the forces and speeds within a limit of the deflection.
///
/// # Errors
/// [`GapError`].
pub(super) fn deviation_map(
    analysis: &Analysis,
    rpm: f64,
    limit_m: Option<f64>,
) -> Result<DeviationMap, GapError> {
    let scene = &analysis.scene;
    let force_n = scene.file().side_force_n();
    let end_rpm = crate::model::scene::rpm(analysis.range_rad_per_s.1);
    let blade_of = |scene: &Scene, modes: usize| {
        let resolution = analysis.model.plate.resolution;
        PressedBlade::new(scene, resolution, end_rpm.max(rpm), modes)
    };
    let thickness_m = scene.blade().thickness_m;
    let gap_factors: Vec<f64> = [0.0].into_iter().chain(factors()).collect();
    let forces_n: Vec<f64> = factors().map(|factor| factor * force_n).collect();
    let speeds_rpm = even_speeds((0.0, end_rpm), SPEEDS);
    let (mut over_gap, mut over_speed) = (Vec::<Row>::new(), Vec::<Row>::new());
    let work = Work::of("gaps", gap_factors.len() + 1);
    let linear_scene = with_linear_guides(scene, |guide| guide.stiffness_n_per_m)?;
    let linear = blade_of(&linear_scene, MODES)?;
    let lifting = blade_of(scene, MODES)?;
    for factor in &gap_factors {
        let own = (*factor > 0.0).then(|| lifting.with_gaps(*factor));
        let pressed = own.as_ref().unwrap_or(&linear);
        let forces = forces_n.iter();
        let over_forces = forces.map(|force| pressed.deviation(*force, rpm));
        over_gap.push(over_forces.collect::<Result<_, _>>()?);
        let over_speeds = speeds_rpm.iter().map(|speed| {
            let found = pressed.deviation(force_n, *speed)?;
            Ok(found.filter(|found| found.largest_m <= thickness_m))
        });
        over_speed.push(over_speeds.collect::<Result<_, GapError>>()?);
        work.advance();
    }
    let finer = blade_of(scene, MORE_MODES)?;
    let basis_error = basis_error(&lifting, &finer, &forces_n, rpm)?;
    work.advance();
    let all = over_gap.iter().flatten().flatten();
    let pads = 0..all
        .map(|at| at.pad_forces_n.len())
        .max()
        .unwrap_or_default();
    let own = gap_factors
        .iter()
        .position(|factor| (factor - 1.0).abs() < 1e-9);
    let own = own.map_or(&[][..], |own| &over_speed[own]);
    let sizes_n: Vec<f64> = forces_n.iter().map(|force| force.abs()).collect();
    Ok(DeviationMap {
        angle_deg: scene.file().cut_angle_deg(),
        rpm,
        gap_factors,
        forces_n,
        deflection_m: table(&over_gap, |at| at.deviation_m),
        largest_deflection_m: table(&over_gap, |at| at.largest_m),
        pad_forces_n: pads
            .clone()
            .map(|pad| over_gap.iter().map(|row| of_pad(pad, row)).collect())
            .collect(),
        max_deflection_m: limit_m,
        force_within_n: all_within(&sizes_n, &over_gap, limit_m),
        force_n,
        deflection_over_gap_and_speed_m: table(&over_speed, |at| at.deviation_m),
        speed_within_rpm: all_within(&speeds_rpm, &over_speed, limit_m),
        deflection_over_speed_m: values(own, |at| at.deviation_m),
        pad_forces_over_speed_n: pads.map(|pad| of_pad(pad, own)).collect(),
        speeds_rpm,
        basis_error,
    })
}

fn table(rows: &[Row], of: fn(&Deviation) -> f64) -> Vec<Vec<Option<f64>>> {
    rows.iter().map(|row| values(row, of)).collect()
}

fn values(row: &[Option<Deviation>], of: fn(&Deviation) -> f64) -> Vec<Option<f64>> {
    row.iter().map(|at| at.as_ref().map(of)).collect()
}

/// Forces of a pad.
fn of_pad(pad: usize, row: &[Option<Deviation>]) -> Vec<Option<f64>> {
    let force = |at: &Deviation| at.pad_forces_n.get(pad).copied();
    row.iter().map(|at| at.as_ref().and_then(force)).collect()
}

/// The largest change of the deflections over gap and force on a larger basis; `None` if none of them is known.
fn basis_error(
    blade: &PressedBlade,
    finer: &PressedBlade,
    forces_n: &[f64],
    rpm: f64,
) -> Result<Option<BasisError>, GapError> {
    let mut largest: Option<BasisError> = None;
    for gap_factor in factors().step_by(ESTIMATED_EVERY) {
        let [blade, finer] = [blade, finer].map(|blade| blade.with_gaps(gap_factor));
        for force_n in forces_n.iter().copied().step_by(ESTIMATED_EVERY) {
            let Some(share) = blade.change_with(&finer, (force_n, rpm))? else {
                continue;
            };
            if largest.is_none_or(|largest| share > largest.share) {
                largest = Some(BasisError {
                    share,
                    gap_factor,
                    force_n,
                    modes: MODES,
                    more_modes: MORE_MODES,
                });
            }
        }
    }
    Ok(largest)
}

/// The largest place of each row up to which the deflection at the cut stays within a limit; nothing without a limit.
fn all_within(places: &[f64], rows: &[Row], limit_m: Option<f64>) -> Vec<Option<f64>> {
    let of = |limit_m| {
        rows.iter()
            .map(|row| within(places, row, limit_m))
            .collect()
    };
    limit_m.map_or_else(Vec::new, of)
}

/// The place at which the deflections at ascending places first exceed a limit, interpolated; the preceding place if a
/// deflection is not known; the last place if none exceeds the limit; `None` if the first one does.
pub(super) fn within(places: &[f64], row: &[Option<Deviation>], limit_m: f64) -> Option<f64> {
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
