//! `sawflutter map`.

use crate::analyses::door::named_bounds;
use crate::analyses::map::{Map, Options, Range};
use crate::analyses::study::{Log, Rows, Shard, StudyError};
use anyhow::Context;
use clap::Args;

use super::common::{Changes, Output, of_option, read_scene};
use super::page::Page;
use super::study::{compute, print_part, shard};
use super::{common, scheduler};
use crate::model::scene::{NamedBounds, Scene};

pub const EXAMPLES: &str = "\
Examples:
  # Bands over the thickness: thickness to the right, speed upwards
  sawflutter map my-saw.json --x blade.thickness_m=2.4mm..3.2mm
  # Two numbers: areas at 1800 rpm, contours of the flutter speed
  sawflutter map my-saw.json --x guides[0].radius_m=0.2..0.3 \\
    --y guides[0].stiffness_n_per_m=1e6..1e8 --rpm 1800 --points 25
  # On a cluster of Dask; a stopped run goes on with the same line
  sawflutter map my-saw.json --x blade.thickness_m=2mm..4mm \\
    --scheduler tcp://host:8786
  # One of eight parts; with all logs in one folder the line without --shard
  # draws the map
  sawflutter map my-saw.json --x blade.thickness_m=2mm..4mm --shard 3/8

`sawflutter keys` prints the paths.";

#[derive(Args)]
pub struct Arguments {
    /// Scene to look at, - for standard input; without it, the built-in guided spline saw
    scene: Option<std::path::PathBuf>,
    /// The number along the horizontal axis, by its path in the scene, and its range
    #[arg(long, value_name = "PATH=FROM..TO", value_parser = named_bounds)]
    x: NamedBounds,
    /// The number along the vertical axis; without it, the speed
    #[arg(long, value_name = "PATH=FROM..TO", value_parser = named_bounds)]
    y: Option<NamedBounds>,
    /// Points along the axis of a number; by default 41, or 17 along each of two
    #[arg(long, value_name = "COUNT", value_parser = common::count::<usize>)]
    points: Option<usize>,
    /// Speed at which the saws are judged; by default the operating speed
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = common::rpm)]
    rpm: Option<f64>,
    /// Last speed; by default the end of the scene's sweep
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = common::rpm)]
    to: Option<f64>,
    #[command(flatten)]
    changes: Changes,
    /// Compute part k of n only, into a log of its own
    #[arg(long, value_name = "k/n", value_parser = shard)]
    shard: Option<Shard>,
    /// Compute on the workers of this scheduler of Dask, like tcp://host:8786; needs the Python
    /// package
    #[arg(long, value_name = "ADDRESS", conflicts_with = "shard")]
    scheduler: Option<String>,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    page: Page,
}

/// Analyses the saws that no log has yet, and draws the map of all saws.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let map = planned(arguments)?;
    let study = map.study();
    arguments.page.tried()?;
    let folder = arguments.output.folder()?;
    let shard = arguments.shard.unwrap_or(Shard::WHOLE);
    match &arguments.scheduler {
        Some(address) => scheduler::compute(study, folder.created()?, address)?,
        None => compute(study, shard, &folder)?,
    }
    if shard != Shard::WHOLE {
        let next = "put the logs of all parts in one folder and run the same line without --shard, with --out";
        return print_part(&arguments.output, study, shard, &folder, next);
    }
    let rows = Rows::of(study, Log::all_in(folder.path())?)?;
    let report = map.report_of_rows(&rows)?;
    let output = &arguments.output;
    output.report(&folder, &arguments.page, &report, Vec::new())
}

fn planned(arguments: &Arguments) -> anyhow::Result<Map> {
    let typed = match &arguments.scene {
        Some(path) => read_scene(path)?,
        None => Scene::paper(),
    };
    let scene = arguments.changes.applied(typed)?;
    let named = |option: &str, (path, bounds): &NamedBounds| -> anyhow::Result<Range> {
        let (from, to) = bounds.with_context(|| {
            format!("{option} {path} has no range; write it like {path}=FROM..TO")
        })?;
        let path = path.clone();
        Ok(Range { path, from, to })
    };
    let y = arguments.y.as_ref();
    let options = Options {
        x: named("--x", &arguments.x)?,
        y: y.map(|range| named("--y", range)).transpose()?,
        points: arguments.points,
        rpm: arguments.rpm,
        to_rpm: arguments.to,
    };
    Map::new(scene, &options).map_err(|error| match error {
        StudyError::Value(refused) => {
            let option = match refused.key.as_str() {
                "to_rpm" => "to".to_owned(),
                "operating_rpm" => "rpm".to_owned(),
                key => key.to_owned(),
            };
            of_option(&option, refused)
        }
        StudyError::Scene { key, source } => {
            anyhow::Error::from(source).context(format!("--{key} was refused"))
        }
        other => other.into(),
    })
}
