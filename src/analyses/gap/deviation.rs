//! The deflection at the cut, and the forces of the pads, over gap, side force and speed.

use std::sync::Arc;

use rayon::prelude::*;

use crate::model::evenly_spaced;
use crate::model::plate::{Plate, Stretching};
use crate::modes::Work;
use crate::motion::stretched_blade::{Deviation, PressedBlade, StretchedError};
use crate::stability::Analysis;

use super::error::GapError;
use super::report::{BasisError, DeviationMap};

/// Gaps of guides without a gap, relative to the given ones: at rest the force of a pad has no kink in a flat blade.
const NO_GAP: f64 = 1e-6;
/// Number of times that the search for a limit halves its interval between two neighbouring places of a map.
const HALVINGS: usize = 12;
/// Number of gaps and of forces. Each is the cube root of two times the preceding one.
const FACTORS: usize = 13;
/// Smallest gap and force, relative to the given ones.
const LEAST_FACTOR: f64 = 0.25;
/// Distance, in gaps and in forces of the map, between the deflections whose error is estimated.
const ESTIMATED_EVERY: usize = 3;
/// Number of speeds of the map over gap and speed, from rest to the end of the sweep.
const SPEEDS: usize = 13;
/// Number of modes at rest in the basis.
pub(super) const MODES: usize = PressedBlade::MODES;
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
    let force_n = scene.constant_force_at(rpm).force_n;
    let end_rpm = crate::model::scene::rpm(analysis.range_rad_per_s.to_rad_per_s);
    let plate = Plate::new(scene, analysis.model.plate.resolution);
    let stretching = Arc::new(Stretching::new(&plate).map_err(StretchedError::from)?);
    let blade_of = |modes: usize| {
        let asked = (end_rpm.max(rpm), modes);
        PressedBlade::stretched(scene, &plate, asked, Arc::clone(&stretching))
    };
    let thickness_m = scene.blade().thickness_m;
    let gap_factors: Vec<f64> = [0.0].into_iter().chain(factors()).collect();
    let forces_n: Vec<f64> = factors().map(|factor| factor * force_n).collect();
    let speeds_rpm = evenly_spaced([0.0, end_rpm], SPEEDS);
    let critical = analysis.model.critical.first();
    let critical_rpm = critical.map(|first| crate::model::scene::rpm(first.speed_rad_per_s));
    let work = Work::of("gaps", gap_factors.len() + 1);
    let blade = blade_of(MODES)?;
    let rows = gap_factors.par_iter().map(|factor| {
        let pressed = blade.with_gaps(factor.max(NO_GAP));
        let under = |force: f64| -> Result<_, GapError> { Ok(pressed.deviation(force, rpm)?) };
        let at = |speed: f64| -> Result<Option<Deviation>, GapError> {
            let found = pressed.deviation(force_n, speed)?;
            Ok(found.filter(|found| found.largest_m <= thickness_m))
        };
        let over_forces: Row = forces_n
            .iter()
            .map(|force| under(*force))
            .collect::<Result<_, GapError>>()?;
        let over_speeds: Row = speeds_rpm
            .iter()
            .map(|speed| at(*speed))
            .collect::<Result<_, GapError>>()?;
        let limits = limit_m.map(|limit_m| {
            let force = within(&forces_n, &over_forces, limit_m, under)?;
            let speed = within(&speeds_rpm, &over_speeds, limit_m, at)?;
            // Beyond the first critical speed the blade is held by one side of its guides only.
            let speed = speed.map(|speed| speed.min(critical_rpm.unwrap_or(f64::INFINITY)));
            Ok::<_, GapError>((force.map(f64::abs), speed))
        });
        work.advance();
        Ok((over_forces, over_speeds, limits.transpose()?))
    });
    let rows: Vec<_> = rows.collect::<Result<_, GapError>>()?;
    let limits: Vec<_> = rows.iter().filter_map(|(.., limits)| *limits).collect();
    let (over_gap, over_speed): (Vec<Row>, Vec<Row>) = rows
        .into_iter()
        .map(|(forces, speeds, _)| (forces, speeds))
        .unzip();
    let finer = blade_of(MORE_MODES)?;
    let basis_error = basis_error(&blade, &finer, &forces_n, rpm)?;
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
        force_within_n: limits.iter().map(|(force, _)| *force).collect(),
        force_n,
        deflection_over_gap_and_speed_m: table(&over_speed, |at| at.deviation_m),
        speed_within_rpm: limits.iter().map(|(_, speed)| *speed).collect(),
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
    let gap_factors: Vec<f64> = factors().step_by(ESTIMATED_EVERY).collect();
    let found: Vec<Option<BasisError>> = gap_factors
        .into_par_iter()
        .map(|gap_factor| {
            let [blade, finer] = [blade, finer].map(|blade| blade.with_gaps(gap_factor));
            let mut largest: Option<BasisError> = None;
            for force_n in forces_n.iter().copied().step_by(ESTIMATED_EVERY) {
                let Some(share) = blade.change_with(&finer, force_n, rpm)? else {
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
            Ok(largest)
        })
        .collect::<Result<_, GapError>>()?;
    let found = found.into_iter().flatten();
    Ok(found.max_by(|a, b| a.share.total_cmp(&b.share)))
}

/// The place at which the deflections at places of ascending size first exceed a limit or are not known, by bisection between the
/// last place within the limit and the next one; the last place if none exceeds the limit; `None` if the first one does. `solve`
/// gives the deflection at a place.
pub(super) fn within(
    places: &[f64],
    row: &[Option<Deviation>],
    limit_m: f64,
    solve: impl Fn(f64) -> Result<Option<Deviation>, GapError>,
) -> Result<Option<f64>, GapError> {
    let keeps = |found: &Option<Deviation>| {
        let found = found.as_ref();
        found.is_some_and(|at| at.deviation_m.abs() <= limit_m)
    };
    let first = row.iter().position(|found| !keeps(found));
    let Some(first) = first else {
        return Ok(places.last().copied());
    };
    let Some(last) = first.checked_sub(1) else {
        return Ok(None);
    };
    let (mut low, mut high) = (places[last], places[first]);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if keeps(&solve(middle)?) {
            low = middle
        } else {
            high = middle
        }
    }
    Ok(Some(low))
}
