//! `sawflutter check`.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::check::{Check, Limits, RIM_LIMIT_M_PER_S};
use crate::report::CheckReport;
use crate::scene::{Scene, rad_per_s};
use anyhow::{Context, bail};
use clap::Args;

use super::common::{Input, say};
use super::output::OutputFolder;
use super::pictures::drawn;
use crate::summary::wrapped;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter check my-saw.json --operating-rpm 2400
  sawflutter check my-saw.json --min-flutter-rpm 2000 --min-critical-rpm 1500
  sawflutter check --operating-rpm 1250 --json | jq .passed
  sawflutter check my-saw.json --out checked      with a picture

Exit code: 0 every limit is kept, 1 one is not, 2 the input was refused.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    input: Input,
    /// Speed at which the saw is run; the scene's by default
    #[arg(long, value_name = "RPM", allow_negative_numbers = true)]
    operating_rpm: Option<f64>,
    /// Largest share of the lowest critical speed that the operating speed may be
    #[arg(
        long,
        value_name = "SHARE",
        default_value_t = 0.85,
        allow_negative_numbers = true
    )]
    margin: f64,
    /// Least flutter speed
    #[arg(long, value_name = "RPM", allow_negative_numbers = true)]
    min_flutter_rpm: Option<f64>,
    /// Least first critical speed
    #[arg(long, value_name = "RPM", allow_negative_numbers = true)]
    min_critical_rpm: Option<f64>,
    /// Largest speed of the rim
    #[arg(
        long,
        value_name = "M/S",
        default_value_t = RIM_LIMIT_M_PER_S,
        allow_negative_numbers = true
    )]
    max_rim_m_per_s: f64,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    /// Write check.json and a picture, check.png and check.svg, to this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Holds a saw against limits; whether it keeps them all.
pub fn run(arguments: &Arguments) -> anyhow::Result<bool> {
    let scene = arguments.input.scene()?;
    let limits = limits(arguments, &scene)?;
    let folder = arguments
        .out
        .as_deref()
        .map(OutputFolder::open)
        .transpose()?;
    let check = Check::new(&scene, &limits)?;
    let report = CheckReport::new(&scene, &limits, &check);
    let json = serde_json::to_string_pretty(&report)?;
    if let Some(folder) = folder {
        let mut files = drawn(&report)?;
        files.push(("check.json", json.clone().into_bytes()));
        folder.write_together(&files, &[])?;
    }
    match arguments.json {
        true => say(&format!("{json}\n"))?,
        false => say(&summary(&check, &report))?,
    }
    Ok(check.passed())
}

fn limits(arguments: &Arguments, scene: &Scene) -> anyhow::Result<Limits> {
    let operating = match arguments.operating_rpm {
        Some(rpm) => rad_per_s(speed("--operating-rpm", rpm)?),
        None => scene.operating_rad_per_s().context(
            "--operating-rpm is missing, but must say how fast the saw is run; give it, or operating_rpm in the scene",
        )?,
    };
    if !(arguments.margin > 0.0 && arguments.margin <= 1.0) {
        bail!(
            "--margin is {}, but must be above 0 and at most 1; the usual rule is 0.85",
            arguments.margin
        );
    }
    let rim = arguments.max_rim_m_per_s;
    if !(rim > 0.0 && rim <= MAX_RIM_M_PER_S) {
        bail!(
            "--max-rim-m-per-s is {rim}, but must be above 0 and at most {MAX_RIM_M_PER_S}; saws for wood are run with at most {RIM_LIMIT_M_PER_S}"
        );
    }
    let asked =
        |name, value: Option<f64>| value.map(|rpm| speed(name, rpm).map(rad_per_s)).transpose();
    Ok(Limits {
        margin: arguments.margin,
        max_rim_m_per_s: rim,
        min_flutter_rad_per_s: asked("--min-flutter-rpm", arguments.min_flutter_rpm)?,
        min_critical_rad_per_s: asked("--min-critical-rpm", arguments.min_critical_rpm)?,
        ..Limits::at(operating)
    })
}

/// Faster than sound in steel.
const MAX_RIM_M_PER_S: f64 = 1e4;
/// Faster than any saw, and far from overflow.
const MAX_RPM: f64 = 1e9;

fn speed(name: &str, rpm: f64) -> anyhow::Result<f64> {
    if rpm > 0.0 && rpm <= MAX_RPM {
        return Ok(rpm);
    }
    bail!(
        "{name} is {rpm}, but must be above 0 and at most {MAX_RPM:e}; give it in revolutions per minute"
    )
}

fn summary(check: &Check, report: &CheckReport) -> String {
    let mut text = String::new();
    for criterion in check.all_criteria() {
        let word = if criterion.passed { "pass" } else { "FAIL" };
        let _ = writeln!(text, "{word}  {criterion}");
    }
    let _ = writeln!(text, "{}", report.rim_stiffness_in_words());
    for warning in &report.warnings {
        let _ = writeln!(text, "{}", wrapped(&format!("Warning: {warning}")));
    }
    text
}
