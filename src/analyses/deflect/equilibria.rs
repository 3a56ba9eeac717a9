//! The equilibria themselves: a blade with as many shapes as needed, its sweeps and its curves.

use faer::Col;
use rayon::prelude::*;

use super::error::DeflectError;
use super::options::{Options, steep};
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{Scene, SideForce, SpeedRange, rpm};
use crate::modes::{Cancellation, Work};
use crate::motion::stretched_blade::{
    Branch, BranchEnd, Equilibrium, Extent, ForcedPlate, LARGEST_SLOPE, StretchedBlade,
    StretchedError, Sweep,
};
use crate::page::text::shown_to;
use crate::stability::{Analysis, check_speed};

/// Initial number of modes at rest, in addition to the shapes that diverge and the response to the force.
/// With 24 the deflection of the paper's saw changes by less than 1 % if more are added.
pub(super) const MODES: usize = 24;
/// Largest number of modes; a check uses half as many more.
const MOST_MODES: usize = 54;
/// Relative change of the deflection, with half as many modes more, that is small enough.
const CLOSE: f64 = 1e-2;
/// Number of equilibria of a sweep that are computed with more modes, or from their mirror images.
const COMPARED: usize = 9;

/// A blade that stretches, and its equilibria over speed.
pub(super) struct Equilibria {
    /// The linear analysis over the same speeds.
    pub analysis: Analysis,
    /// The blade under the side force, on its reduced basis.
    pub blade: StretchedBlade,
    /// Largest relative change of the deflection with half as many modes more; `None` if the blade remains
    /// flat.
    pub relative_error: Option<f64>,
    /// Stable equilibria for rising speed.
    pub up: Sweep,
    /// Stable equilibria for falling speed, starting from the last one of `up`.
    pub down: Sweep,
    /// The curves of equilibria, including unstable ones.
    pub curves: Curves,
    /// Counts the parts; the last one, the evaluation, ends with this value.
    _parts: Work,
}

impl Equilibria {
    /// Follows the equilibria over the scene's sweep, or up to the requested speed.
    ///
    /// # Errors
    /// As for [`deflect`](super::deflect).
    pub fn new(scene: &Scene, options: &Options, force: &SideForce) -> Result<Self, DeflectError> {
        let swept = match options.to_rpm {
            None => scene.clone(),
            Some(to_rpm) => {
                check_speed(scene.blade(), "to_rpm", to_rpm)?;
                scene.swept(SpeedRange::between_rpm(0.0, to_rpm))?
            }
        };
        let plate = Plate::new(&swept, Resolution::of(swept.accuracy()));
        if plate.is_axisymmetric() && force.force_n == 0.0 {
            return Err(StretchedError::Axisymmetric.into());
        }
        let analysis = Analysis::new(&swept)?;
        let range = analysis.range_rad_per_s;
        let plate = &analysis.model.plate;
        let parts = Work::of("parts of the deflection", PARTS);
        let forced = ForcedPlate::new(plate, range.to_rad_per_s, &[(force.at.polar(), 1.0)])?;
        let blade = under(force, &forced, MODES.min(plate.degrees_of_freedom()))?;
        if let Some(gentle_n) = gentler(force, &blade, range.from_rad_per_s)? {
            return Err(steep(force, gentle_n).into());
        }
        let (blade, up, relative_error) = resolved(force, (&forced, plate), blade, range)?;
        parts.advance();
        let top = up
            .arcs
            .last()
            .and_then(|arc| arc.last())
            .map_or_else(|| blade.flat(), |e| e.coordinates.clone());
        let down = blade.sweep(&top, false, range)?;
        parts.advance();
        let curves = curves(&blade, range, [(&up, true), (&down, false)])?;
        parts.advance();
        Ok(Equilibria {
            analysis,
            blade,
            relative_error,
            up,
            down,
            curves,
            _parts: parts,
        })
    }
}

/// Curves of equilibria, and the number of those that are missing.
#[derive(Default)]
pub(super) struct Curves {
    /// The curves that were followed.
    pub found: Vec<Branch>,
    /// Number of curves beyond [`MOST_CURVES`].
    omitted: usize,
    /// Number of curves of which only the start is known.
    unfollowed: usize,
}

impl Curves {
    /// Remarks on curves that end within the range of speeds, or are missing.
    pub fn remarks(&self) -> Vec<String> {
        let all = self.found.len();
        let ending = |end: BranchEnd| self.found.iter().filter(move |curve| curve.end == end);
        let mut remarks = Vec::new();
        let cut_off = ending(BranchEnd::Most).count();
        if cut_off > 0 {
            remarks.push(format!(
                "{cut_off} of {all} curves of equilibria {} cut off within the range of speeds, at the largest number of points of a curve",
                if cut_off == 1 { "is" } else { "are" }
            ));
        }
        let lost: Vec<String> = ending(BranchEnd::Lost)
            .filter_map(|curve| curve.equilibria.last())
            .map(|last| shown_to(4, rpm(last.speed_rad_per_s)))
            .collect();
        if !lost.is_empty() {
            remarks.push(format!(
                "{} of {all} curves of equilibria could not be followed beyond {} rpm",
                lost.len(),
                lost.join(", ")
            ));
        }
        if self.unfollowed > 0 {
            remarks.push(format!(
                "curves of equilibria through {} equilibria could not be followed and are missing",
                self.unfollowed
            ));
        }
        if self.omitted > 0 {
            remarks.push(format!(
                "more than {MOST_CURVES} curves of equilibria exist; those through {} further equilibria are not computed",
                self.omitted
            ));
        }
        remarks
    }
}

/// Number of parts: the sweep up, the sweep down, the other curves, and their evaluation.
const PARTS: usize = 4;

/// The largest force in N, to one percent, under which slopes of the blade do not exceed 0.1 at a speed; `None` if they
/// do not under the given one, or exceed it without a force too.
fn gentler(
    force: &SideForce,
    blade: &StretchedBlade,
    speed_rad_per_s: f64,
) -> Result<Option<f64>, StretchedError> {
    let slopes = blade.slopes();
    let is_gentle = |force_n: f64| {
        let pressed = blade.clone().pressed(force_n, force.at.polar())?;
        match pressed.settled(speed_rad_per_s, &pressed.flat()) {
            Ok(found) => Ok(slopes.largest(&found.coordinates) <= LARGEST_SLOPE),
            Err(StretchedError::NotFound { .. }) => Ok(false),
            Err(other) => Err(other),
        }
    };
    let mut steep_n = force.force_n;
    if is_gentle(steep_n)? {
        return Ok(None);
    }
    let mut gentle_n = None;
    for power in 1..=TENTHS {
        let force_n = 0.1_f64.powi(power) * force.force_n;
        if is_gentle(force_n)? {
            gentle_n = Some(force_n);
            break;
        }
        steep_n = force_n;
    }
    let Some(mut gentle_n) = gentle_n else {
        return Ok(None);
    };
    for _ in 0..HALVINGS {
        let middle_n = steep_n.signum() * (steep_n * gentle_n).sqrt();
        if is_gentle(middle_n)? {
            gentle_n = middle_n
        } else {
            steep_n = middle_n
        }
    }
    Ok(Some(gentle_n))
}

/// Number of tenths of a force that are tried: from 1e6 to 1e-3 N.
const TENTHS: i32 = 9;
/// Number of halvings, on a logarithmic scale, of the interval between a tenth and the next: to one percent.
const HALVINGS: usize = 8;

/// The blade under a side force, with a number of modes at rest.
pub(super) fn under(
    force: &SideForce,
    forced: &ForcedPlate,
    modes: usize,
) -> Result<StretchedBlade, StretchedError> {
    let blade = forced.blade(modes, &[])?;
    blade.pressed(force.force_n, force.at.polar())
}

/// A blade with so many shapes that half as many modes more hardly change the deflection, its sweep for rising speed,
/// and the relative change with more modes; `None` for the change if the blade remains flat.
fn resolved(
    force: &SideForce,
    (forced, plate): (&ForcedPlate, &Plate),
    mut blade: StretchedBlade,
    range: SpeedRange,
) -> Result<(StretchedBlade, Sweep, Option<f64>), DeflectError> {
    let on = |modes: usize| under(force, forced, modes.min(plate.degrees_of_freedom()));
    let mut modes = MODES;
    loop {
        let more = modes + modes / 2;
        let finer = on(more)?;
        let up = blade.sweep(&blade.flat(), true, range)?;
        let error = change(&blade, &finer, &up)?;
        if modes >= MOST_MODES || error.is_none_or(|error| error <= CLOSE) {
            return Ok((blade, up, error));
        }
        (modes, blade) = (more, finer);
    }
}

/// Largest relative change of the deflection with more shapes, over equilibria distributed over a sweep; `None` if all
/// are flat.
fn change(
    blade: &StretchedBlade,
    finer: &StretchedBlade,
    sweep: &Sweep,
) -> Result<Option<f64>, DeflectError> {
    let stable: Vec<&Equilibrium> = sweep.arcs.iter().flatten().collect();
    let leaned: Vec<&Equilibrium> = stable
        .iter()
        .filter(|e| e.coordinates.norm_max() > 0.0)
        .copied()
        .collect();
    let mut largest: Option<f64> = None;
    for k in 0..COMPARED {
        Cancellation::current()
            .check()
            .map_err(StretchedError::from)?;
        let Some(e) = leaned.get(k * leaned.len() / COMPARED) else {
            continue;
        };
        // Near a fold the blade `finer` may have no equilibrium; such an equilibrium is not compared.
        if let Ok(change) = blade.change_with(finer, e) {
            largest = Some(largest.map_or(change, |most| most.max(change)));
        }
    }
    Ok(largest)
}

/// The curves that the blade follows from one jump to the next, from both ends and continued through their folds; the
/// curves through mirror images of its equilibria; and the curves that branch from the flat blade at its critical
/// speeds, on both sides.
fn curves(
    blade: &StretchedBlade,
    range: SpeedRange,
    sweeps: [(&Sweep, bool); 2],
) -> Result<Curves, DeflectError> {
    let mut curves = Curves::default();
    for (sweep, upwards) in sweeps {
        for arc in &sweep.arcs {
            let ends = [(arc.first(), upwards), (arc.last(), !upwards)];
            for (start, upwards) in ends {
                if let Some(start) = start {
                    add_curve(blade, &mut curves, (start, &[upwards]), range)?;
                }
            }
        }
    }
    for start in mirrored(blade, sweeps.map(|(sweep, _)| sweep))? {
        add_curve(blade, &mut curves, (&start, &[true, false]), range)?;
    }
    if blade.lifts_off() {
        // A pad that lifts off contributes only its film to the matrices of the blade, so that their
        // pitchforks are not those of the blade in contact with the pad.
        return Ok(curves);
    }
    let unforced = blade.clone().unforced();
    for (critical, shape) in unforced.pitchforks()? {
        if !(range.from_rad_per_s..range.to_rad_per_s).contains(&critical) {
            continue;
        }
        let above = (critical + ABOVE * range.width()).min(range.to_rad_per_s);
        let Ok(leaned) = unforced.leaned_near(above, &shape) else {
            continue;
        };
        // A side force may move the curve on one side to higher speeds, where the mirror images lead to it.
        for side in [1.0, -1.0] {
            let guess = faer::Scale(side) * &leaned;
            if let Ok(start) = blade.equilibrium(above, Some(&guess)) {
                add_curve(blade, &mut curves, (&start, &[true, false]), range)?;
            }
        }
    }
    Ok(curves)
}

/// Equilibria that the blade reaches from mirror images of the equilibria of the sweeps, at some speeds. A side force
/// splits each pitchfork, and the curve on its other side begins at a fold beyond the critical speed, to
/// which no sweep leads.
fn mirrored(
    blade: &StretchedBlade,
    sweeps: [&Sweep; 2],
) -> Result<Vec<Equilibrium>, StretchedError> {
    let mut found = Vec::new();
    for sweep in sweeps {
        let all: Vec<&Equilibrium> = sweep.arcs.iter().flatten().collect();
        for k in 1..=COMPARED {
            Cancellation::current().check()?;
            let Some(e) = all.get((k * all.len() / COMPARED).saturating_sub(1)) else {
                continue;
            };
            let image = faer::Scale(-1.0) * &e.coordinates;
            // If the blade reaches no equilibrium from the mirror image, no curve starts there.
            found.extend(blade.settled(e.speed_rad_per_s, &image));
        }
    }
    Ok(found)
}

/// Distance above a critical speed, as a share of the range of speeds, at which the search for the branching curve
/// begins.
const ABOVE: f64 = 2e-3;
/// Largest number of curves; far beyond its critical speeds a blade has hundreds of unstable ones.
const MOST_CURVES: usize = 24;

/// Adds the curve through an equilibrium, followed in each of the directions, unless it is known already.
fn add_curve(
    blade: &StretchedBlade,
    curves: &mut Curves,
    (start, sides): (&Equilibrium, &[bool]),
    range: SpeedRange,
) -> Result<(), DeflectError> {
    Cancellation::current()
        .check()
        .map_err(StretchedError::from)?;
    if is_known(blade, &curves.found, start) {
        return Ok(());
    }
    if curves.found.len() >= MOST_CURVES {
        curves.omitted += 1;
        return Ok(());
    }
    let followed = sides
        .par_iter()
        .map(|upwards| blade.branch(start, *upwards, range, Extent::Drawn));
    let followed: Vec<Result<Branch, StretchedError>> = followed.collect();
    for curve in followed {
        match curve {
            // A curve that ends at its start leads nowhere on this side.
            Ok(curve) if curve.equilibria.len() > 1 => curves.found.push(curve),
            Ok(_) | Err(StretchedError::NotFound { .. }) => curves.unfollowed += 1,
            Err(other) => return Err(other.into()),
        }
    }
    Ok(())
}

/// Whether an equilibrium is on one of the curves.
fn is_known(blade: &StretchedBlade, curves: &[Branch], e: &Equilibrium) -> bool {
    let is_near = |p: &Col<f64>, share: f64| {
        let sizes = p.norm_l2() + e.coordinates.norm_l2();
        (p - &e.coordinates).norm_l2() <= share * sizes
    };
    let pairs = curves.iter().flat_map(|curve| curve.equilibria.windows(2));
    pairs
        .filter_map(|pair| between(&pair[0], &pair[1], e.speed_rad_per_s))
        .filter(|guess| is_near(guess, 0.1))
        .filter_map(|guess| blade.equilibrium(e.speed_rad_per_s, Some(&guess)).ok())
        .any(|found| is_near(&found.coordinates, 1e-6))
}

/// Linear interpolation of the coordinates of two equilibria at a speed between theirs.
fn between(a: &Equilibrium, b: &Equilibrium, speed: f64) -> Option<Col<f64>> {
    let (low, high) = (a.speed_rad_per_s, b.speed_rad_per_s);
    let share = (speed - low) / (high - low);
    (0.0..=1.0)
        .contains(&share)
        .then(|| &a.coordinates + faer::Scale(share) * (&b.coordinates - &a.coordinates))
}
