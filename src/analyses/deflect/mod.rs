//! Equilibria of a blade that stretches while its speed slowly rises and falls, under a side force.
//!
//! The linear model gives the speeds at which the flat blade is unstable, but not the deflection that
//! results. With the potential of [`stretched_blade`](crate::motion::stretched_blade) the blade deflects to one side and has an
//! equilibrium there. [`deflect`] follows the stable equilibria for rising and falling speed, including jumps
//! from one to another, and computes the unstable ones between them and the frequencies of small motions
//! about each.
//!
//! ```
//! use sawflutter::analyses::deflect::{Options, deflect};
//! use sawflutter::model::scene::{Accuracy, Scene};
//!
//! let scene = Scene::paper().edited(|saw| saw.accuracy = Accuracy::Draft)?;
//! let options = Options { to_rpm: Some(1800.0) };
//! let report = deflect(&scene, &options)?;
//! let deflections = report.up.arcs.iter().flat_map(|arc| &arc.largest_deflection_m);
//! assert!(deflections.fold(0.0, |most: f64, m| most.max(*m)) > scene.file().blade.thickness_m);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub(crate) mod chart;
mod command;
mod equilibria;
mod error;
mod options;
mod outline;
mod point_load;
mod reading;
mod report;
#[cfg(test)]
mod tests;

pub use error::DeflectError;
pub use options::Options;
pub(crate) use outline::outline;
pub(crate) use point_load::PointLoad;
pub use report::{Arc, DeflectReport, EquilibriumCurve, Jump, SlowSweep, Turn};

use crate::analyses::campbell::caution;
use crate::model::scene::Scene;

use equilibria::Equilibria;
use point_load::basis_error;
use reading::Reader;

/// Follows the equilibria over the scene's sweep, or up to the requested speed.
///
/// # Errors
/// [`DeflectError`] if an option is refused, the saw cannot be analysed, or no equilibrium is found.
pub fn deflect(scene: &Scene, options: &Options) -> Result<DeflectReport, DeflectError> {
    options.checked()?;
    let force = scene.side_force();
    let found = Equilibria::new(scene, options, &force)?;
    let chart = found.analysis.report();
    let probe = scene.probe();
    let reader = Reader::new(&found.blade, probe, chart.campbell.complete_to_hz);
    let of_chart = caution(&chart).into_iter().chain(chart.warnings);
    Ok(DeflectReport {
        sawflutter: chart.sawflutter,
        scene: scene.file().clone(),
        condition: chart.condition,
        unusual_numbers: chart.unusual_numbers,
        degrees_of_freedom: chart.accuracy.degrees_of_freedom,
        shapes: found.blade.shapes().ncols(),
        estimated_relative_error: found.relative_error,
        basis_error: match force.force_n {
            0.0 => None,
            _ => basis_error(
                &found.analysis.scene,
                &found.analysis.model.plate,
                force.at.polar(),
            ),
        },
        from_rpm: chart.campbell.from_rpm,
        to_rpm: chart.campbell.to_rpm,
        force_n: force.force_n,
        force_angle_deg: force.at.angle_deg,
        probe_radius_m: probe.radius_m,
        probe_angle_deg: probe.angle_deg,
        beyond_thickness_rpm: reader.beyond_rpm(&found.up, scene.blade().thickness_range_m()[0]),
        up: reader.sweep(&found.up)?,
        down: reader.sweep(&found.down)?,
        curves: found
            .curves
            .found
            .iter()
            .map(|curve| reader.curve(curve))
            .collect(),
        critical_speeds: chart.critical_speeds,
        instabilities: chart.instabilities,
        campbell: chart.campbell,
        warnings: of_chart.chain(found.curves.remarks()).collect(),
    })
}
