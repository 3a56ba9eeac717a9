//! Equilibria of a blade that stretches while its speed slowly rises and falls, under a side force.
//!
//! The linear model gives the speeds at which the flat blade is unstable, but not the deflection that
//! results. With the potential of [`stretched`](crate::stretched) the blade deflects to one side and has an
//! equilibrium there. This module follows the stable equilibria for rising and falling speed, including jumps
//! from one to another, and computes the unstable ones between them and the frequencies of small motions
//! about each.
//!
//! ```
//! use sawflutter::deflect::{Deflecting, Options};
//! use sawflutter::scene::{Accuracy, Scene};
//!
//! let scene = Scene::paper().edited(|saw| saw.accuracy = Accuracy::Draft)?;
//! let options = Options { to_rpm: Some(1800.0), ..Options::default() };
//! let found = Deflecting::new(&scene, &options)?;
//! let largest = found.up.readings().map(|at| at.largest_m).fold(0.0, f64::max);
//! assert!(largest > scene.file().blade.thickness_m);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod options;
mod point_load;
mod reading;
mod saturated;
#[cfg(test)]
mod tests;

pub use options::{Options, SideForce};
pub(crate) use point_load::rim_compliance_m_per_n;
pub use reading::{Curve, Jump, Reading, SlowSweep};
pub use saturated::{Rise, saturations};

use faer::Col;

use crate::plate::{Plate, Resolution};
use crate::scene::{RefusedValue, Scene, SceneError, rad_per_s};
use crate::spectrum::{Cancellation, Work};
use crate::stability::{Analysis, AnalysisError};
use crate::stretched::{
    Branch, Equilibrium, Extent, LARGEST_SLOPE, StretchedBlade, StretchedError, Sweep,
};

use point_load::basis_error;
use reading::Reader;

/// Reason for which the equilibria of a blade could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum DeflectError {
    /// The force or the speed is out of range.
    #[error(transparent)]
    Refused(#[from] RefusedValue),
    /// The scene refuses the requested range of speeds.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// No equilibrium was found, or equilibria are not isolated.
    #[error(transparent)]
    Stretched(#[from] StretchedError),
}

/// Initial number of modes at rest, in addition to the shapes that diverge and the response to the force.
/// With 24 the deflection of the paper's saw changes by less than 1 % if more are added.
const MODES: usize = 24;
/// Largest number of modes; a check uses half as many more.
const MOST_MODES: usize = 54;
/// Relative change of the deflection, with half as many modes more, that is small enough.
const CLOSE: f64 = 1e-2;
/// Number of equilibria of a sweep that are computed with more modes, or from their mirror images.
const COMPARED: usize = 9;

/// A blade that stretches, and its equilibria over speed.
#[derive(Debug)]
pub struct Deflecting {
    /// The scene, as given.
    pub scene: Scene,
    /// The side force.
    pub force: SideForce,
    /// The linear analysis over the same speeds.
    pub analysis: Analysis,
    /// Number of shapes of the reduced basis.
    pub shapes: usize,
    /// Largest relative change of the deflection with half as many modes more; `None` if the blade remains
    /// flat.
    pub estimated_relative_error: Option<f64>,
    /// Estimated relative error of a small deflection at the force, at rest, on the basis from which the shapes are
    /// made; `None` without a force, and for a blade that is buckled at rest.
    pub basis_error: Option<f64>,
    /// Equilibria for rising speed.
    pub up: SlowSweep,
    /// Equilibria for falling speed, starting from the last one of `up`.
    pub down: SlowSweep,
    /// All curves of equilibria that were found, including unstable ones.
    pub curves: Vec<Curve>,
}

impl Deflecting {
    /// Follows the equilibria over the scene's sweep, or up to the requested speed.
    ///
    /// # Errors
    /// [`DeflectError`] if an option is refused, the saw cannot be analysed, or no equilibrium is found.
    pub fn new(scene: &Scene, options: &Options) -> Result<Self, DeflectError> {
        let force = options.side_force(scene)?;
        let swept = match options.to_rpm {
            None => scene.clone(),
            Some(to_rpm) => scene.swept((0.0, rad_per_s(to_rpm)).into())?,
        };
        let plate = Plate::new(&swept, Resolution::of(swept.accuracy()));
        if plate.is_axisymmetric() && force.force_n == 0.0 {
            return Err(StretchedError::Axisymmetric.into());
        }
        let analysis = Analysis::new(&swept)?;
        let range = analysis.range_rad_per_s;
        let plate = &analysis.model.plate;
        let parts = Work::of("parts of the deflection", PARTS);
        let blade = force.on(plate, range.1, MODES.min(plate.degrees_of_freedom()))?;
        if let Some(gentle_n) = gentler(&force, &blade, range.0)? {
            return Err(options.steep(scene, &force, gentle_n).into());
        }
        let (blade, up, error) = resolved(&force, plate, blade, range)?;
        parts.advance();
        let top = up.arcs.last().and_then(|arc| arc.last());
        let down = blade.sweep(
            &top.map_or_else(|| blade.flat(), |e| e.coordinates.clone()),
            false,
            range,
        )?;
        parts.advance();
        let curves = curves(&blade, range, [(&up, true), (&down, false)])?;
        parts.advance();
        let reader = Reader::new(&blade, scene.probe());
        let read = Deflecting {
            up: reader.sweep(&up)?,
            down: reader.sweep(&down)?,
            curves: curves.iter().map(|curve| reader.curve(curve)).collect(),
            shapes: blade.shapes().ncols(),
            estimated_relative_error: error,
            basis_error: match force.force_n {
                0.0 => None,
                _ => basis_error(&swept, plate, force.angle_rad),
            },
            scene: scene.clone(),
            force,
            analysis,
        };
        parts.advance();
        Ok(read)
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
    let is_gentle = |force_n: f64| {
        let pressed = SideForce { force_n, ..*force }.presses(blade)?;
        match pressed.settled(speed_rad_per_s, &pressed.flat()) {
            Ok(found) => Ok(pressed.largest_slope(&found) <= LARGEST_SLOPE),
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
        match is_gentle(middle_n)? {
            true => gentle_n = middle_n,
            false => steep_n = middle_n,
        }
    }
    Ok(Some(gentle_n))
}

/// Number of tenths of a force that are tried: from 1e6 to 1e-3 N.
const TENTHS: i32 = 9;
/// Number of halvings, on a logarithmic scale, of the interval between a tenth and the next: to one percent.
const HALVINGS: usize = 8;

/// A blade with so many shapes that half as many modes more hardly change the deflection, its sweep for rising speed,
/// and the relative change with more modes; `None` for the change if the blade remains flat.
fn resolved(
    force: &SideForce,
    plate: &Plate,
    mut blade: StretchedBlade,
    range: (f64, f64),
) -> Result<(StretchedBlade, Sweep, Option<f64>), DeflectError> {
    let on = |modes: usize| force.on(plate, range.1, modes.min(plate.degrees_of_freedom()));
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
    let leaned = stable.iter().filter(|e| e.coordinates.norm_max() > 0.0);
    let leaned: Vec<&Equilibrium> = leaned.copied().collect();
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
    range: (f64, f64),
    sweeps: [(&Sweep, bool); 2],
) -> Result<Vec<Branch>, DeflectError> {
    let mut curves: Vec<Branch> = Vec::new();
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
        if !(range.0..range.1).contains(&critical) {
            continue;
        }
        let above = (critical + ABOVE * (range.1 - range.0)).min(range.1);
        let Ok(leaned) = unforced.leaned_near(above, &shape) else {
            continue;
        };
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
    curves: &mut Vec<Branch>,
    (start, sides): (&Equilibrium, &[bool]),
    range: (f64, f64),
) -> Result<(), DeflectError> {
    Cancellation::current()
        .check()
        .map_err(StretchedError::from)?;
    if curves.len() >= MOST_CURVES || is_known(blade, curves, start) {
        return Ok(());
    }
    for upwards in sides {
        // A curve that cannot be followed is omitted.
        if let Ok(curve) = blade.branch(start, *upwards, range, Extent::Drawn) {
            curves.push(curve);
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
