//! `sawflutter place`.

use crate::analyses::commands::Argument;
use crate::analyses::place::{Demands, GapDemands, Options, Step, Tolerances, place};
use crate::model::scene::{Freed, RefusedValue, Scene};
use clap::{Args, ValueEnum};

use super::bounds::named_bounds;
use super::common::{Common, count, degrees, metres, millimetres, of_option, rpm, share, words};
use super::page::Page;
use super::progress::watched;
use super::shorthand::{Given, with_shorthands};

pub const EXAMPLES: &str = "\
Examples:
  sawflutter place my-saw.json   # radius, angle, stiffness of guides[0]
  sawflutter place my-saw.json --free \"guides[0].radius_m=0.2..0.3\" \\
    --free \"guides[0].angle_deg=-90..-20\" --min-critical 1500
  sawflutter place --goal window # widest window around operating_rpm
  sawflutter place --radius-tolerance 0.5mm --angle-tolerance 0.2
The best saw is placed-scene.json; try it with `check` and `cut`. Without a saw
that keeps the limits none is written.

Every saw counts as the worst of those whose numbers are off by the tolerances
of production, by default 2 mm of a radius, 1 degree of an angle, 10 % of a
stiffness, damping or gap, 1 % of other numbers.

Exit code: 0 done, 1 no tried saw keeps the limit within all its tolerances,
2 the input was refused or the run failed.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    #[arg(long, value_name = "PATH[=FROM..TO]",
        help = const { words("place", "free") })]
    free: Vec<String>,
    #[arg(long, value_name = "NAME", default_value = "flutter",
        help = const { words("place", "goal") })]
    goal: GoalName,
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = rpm,
        help = const { words("place", "min_critical_rpm") })]
    min_critical: Option<f64>,
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = millimetres,
        help = const { words("place", "amplitude_m") })]
    amplitude: Option<f64>,
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = millimetres,
        help = const { words("place", "max_deviation_m") })]
    max_deviation: Option<f64>,
    #[arg(long,
        value_name = "N",
        allow_hyphen_values = true,
        requires = "max_deviation",
        help = const { words("place", "force_n") })]
    force: Option<String>,
    #[arg(long, value_name = "COUNT", default_value_t = 64, value_parser = count::<usize>,
        help = const { words("place", "samples") })]
    samples: usize,
    #[arg(long, value_name = "COUNT", default_value_t = 60, value_parser = count::<u64>,
        help = const { words("place", "refine") })]
    refine: u64,
    #[arg(long, value_name = "LENGTH", default_value_t = Tolerances::USUAL.radius_m, allow_hyphen_values = true, value_parser = metres,
        help = const { words("place", "radius_tolerance_m") })]
    radius_tolerance: f64,
    #[arg(long, value_name = "DEG", default_value_t = Tolerances::USUAL.angle_deg, allow_hyphen_values = true, value_parser = degrees,
        help = const { words("place", "angle_tolerance_deg") })]
    angle_tolerance: f64,
    #[arg(long, value_name = "SHARE", default_value_t = Tolerances::USUAL.guide_share, allow_hyphen_values = true, value_parser = share,
        help = const { words("place", "guide_tolerance_share") })]
    guide_tolerance: f64,
    #[arg(long, value_name = "SHARE", default_value_t = Tolerances::USUAL.other_share, allow_hyphen_values = true, value_parser = share,
        help = const { words("place", "other_tolerance_share") })]
    other_tolerance: f64,
    #[arg(long, value_name = "COUNT", default_value_t = 17, value_parser = count::<usize>,
        help = const { words("place", "map") })]
    map: usize,
    #[command(flatten)]
    page: Page,
}

#[derive(Clone, Copy, ValueEnum)]
enum GoalName {
    /// The flutter speed
    Flutter,
    /// The stable window around the operating speed
    Window,
}

/// Searches for the best place, writes the files and prints the summary. Returns whether the limit is kept.
pub fn run(arguments: &Arguments) -> anyhow::Result<bool> {
    let given = [Given::new(
        &const { Argument::of("place", "force_n") },
        &arguments.force,
    )];
    let scene = with_shorthands(arguments.common.scene()?, &given)?;
    let demands = demands(arguments, &scene)?;
    let options = Options {
        samples: arguments.samples,
        refine: arguments.refine.max(1),
        map: arguments.map,
        tolerances: Tolerances {
            radius_m: arguments.radius_tolerance,
            angle_deg: arguments.angle_tolerance,
            guide_share: arguments.guide_tolerance,
            other_share: arguments.other_tolerance,
        },
        ..Options::default()
    }
    .checked()
    .map_err(of_option)?;
    let freed = Freed::to_place(&scene, &named_bounds(&arguments.free)?)?;
    arguments.page.tried()?;
    let folder = arguments.common.folder()?;
    let report = watched(|progress| {
        let steps = |step: Step| {
            progress.show_best(step.best_rpm);
            progress.show(step.what, step.done, step.of);
        };
        place(&scene, &freed, &demands, &options, &steps)
    })??;
    // A saw that misses a limit is no result to go on with.
    let placed = report
        .kept
        .then(|| serde_json::to_vec_pretty(&report.scene));
    let others = vec![("placed-scene.json", placed.transpose()?)];
    let output = &arguments.common.output;
    output.report(&folder, &arguments.page, &report, others)?;
    Ok(report.kept)
}

fn demands(arguments: &Arguments, scene: &Scene) -> anyhow::Result<Demands> {
    let around_rpm = match arguments.goal {
        GoalName::Flutter => None,
        GoalName::Window => Some(scene.needed_operating_rpm(None)?),
    };
    let demands = Demands::new(around_rpm, arguments.min_critical).map_err(of_option)?;
    let gap = GapDemands::new(scene, arguments.amplitude, arguments.max_deviation);
    let refused = |refused: RefusedValue| {
        if refused.key.ends_with("_mm") {
            of_option(refused)
        } else {
            refused.into()
        }
    };
    Ok(Demands {
        gap: gap.map_err(refused)?,
        ..demands
    })
}
