//! `sawflutter check`.

use std::path::PathBuf;

use crate::analyses::check::{CheckReport, Limits, LimitsFile, RIM_LIMIT_M_PER_S, check};
use crate::model::scene::Scene;
use clap::Args;

use super::common::{Input, metres_per_second, millimetres, of_option, rpm, say, share, words};
use super::output::OutputFolder;
use super::page::Page;
use super::pictures::drawn;
use super::progress::watched;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter check my-saw.json --rpm 2400
  sawflutter check my-saw.json --min-flutter 2000 --min-critical 1500
  sawflutter check --rpm 1250 --json | jq .passed
  sawflutter check my-saw.json --max-amplitude 0.5mm
  sawflutter check my-saw.json --out checked # with a picture

Exit code: 0 every limit is kept, 1 one is not, 2 the input was refused.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    input: Input,
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = rpm,
        help = const { words("check", "operating_rpm") })]
    rpm: Option<f64>,
    #[arg(long,
        value_name = "SHARE",
        default_value_t = 0.85,
        allow_hyphen_values = true, value_parser = share,
        help = const { words("check", "margin") })]
    margin: f64,
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = rpm,
        help = const { words("check", "min_flutter_rpm") })]
    min_flutter: Option<f64>,
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = rpm,
        help = const { words("check", "min_critical_rpm") })]
    min_critical: Option<f64>,
    #[arg(long,
        value_name = "M/S",
        default_value_t = RIM_LIMIT_M_PER_S,
        allow_hyphen_values = true, value_parser = metres_per_second,
        help = const { words("check", "max_rim_m_per_s") })]
    max_rim: f64,
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = millimetres,
        help = const { words("check", "max_amplitude_m") })]
    max_amplitude: Option<f64>,
    #[arg(long, help = const { words("check", "accept_unusual") })]
    accept_unusual: bool,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    /// Write check.json and a picture, check.png and check.svg, to this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    page: Page,
}

/// Compares a saw with limits, and prints the result. Returns whether the saw keeps all of them.
pub fn run(arguments: &Arguments) -> anyhow::Result<bool> {
    let scene = arguments.input.scene()?;
    let limits = limits(arguments, &scene)?;
    arguments.page.tried()?;
    let folder = arguments
        .out
        .as_deref()
        .map(OutputFolder::open)
        .transpose()?;
    let report = watched(|_| check(&scene, &limits))??;
    arguments.page.write(&report)?;
    let json = serde_json::to_string_pretty(&report)?;
    if let Some(folder) = folder {
        let mut files = drawn(&report, true)?;
        files.push((CheckReport::COMMAND.file, json.clone().into_bytes()));
        folder.write_together(&files, &[])?;
    }
    if arguments.json {
        say(&format!("{json}\n"))?
    } else {
        say(&report.summary())?
    }
    Ok(report.passed)
}

/// The limits of the options, with the operating speed of the scene by default.
fn limits(arguments: &Arguments, scene: &Scene) -> anyhow::Result<Limits> {
    let asked = LimitsFile {
        operating_rpm: arguments.rpm,
        margin: arguments.margin,
        min_flutter_rpm: arguments.min_flutter,
        min_critical_rpm: arguments.min_critical,
    };
    let limits = asked
        .limits(scene)
        .and_then(|limits| limits.with_rim_speed(arguments.max_rim))
        .and_then(|limits| limits.with_amplitude(arguments.max_amplitude))
        .map_err(of_option)?;
    Ok(Limits {
        accept_unusual: arguments.accept_unusual,
        ..limits
    })
}
