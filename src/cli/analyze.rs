//! `sawflutter analyze`.

use crate::figure;
use crate::report::{Report, SensitivityEntry};
use crate::stability::{Analysis, sensitivities};
use clap::Args;
use rayon::prelude::*;

use super::common::{Common, progress_bar, show};
use super::summary::summary;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter analyze                                  the built-in saw
  sawflutter analyze my-saw.json --out my-saw         your own saw
  sawflutter analyze my-saw.json --accuracy reference slower, for comparisons
  sawflutter analyze --json | jq .flutter_speed_rpm   for scripts";

#[derive(Args, Default)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    /// Also say how critical speeds and onsets move with thickness, density, modulus and
    /// the guides
    #[arg(long)]
    sensitivity: bool,
}

/// Charts a saw, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.common.scene()?;
    let folder = arguments.common.folder()?;
    let bar = progress_bar("speeds");
    let analysis = Analysis::new(&scene, &|done, of| show(&bar, done, of))?;
    bar.finish_and_clear();
    let mut report = Report::new(&scene, &analysis)?;
    if arguments.sensitivity {
        let at = scene.operating_rad_per_s().unwrap_or(analysis.range.0);
        let found = sensitivities(&scene, &analysis, at)?;
        report.sensitivities = found.iter().map(SensitivityEntry::from).collect();
    }
    let json = serde_json::to_string_pretty(&report)?;
    let mut files = figures(&report)?;
    // An earlier run may have left those of another saw.
    let mut stale = OPTIONAL.to_vec();
    stale.retain(|name| files.iter().all(|(drawn, _)| drawn != name));
    files.push(("campbell.csv", report.campbell_csv()?));
    files.push(("report.json", json.clone().into_bytes()));
    arguments
        .common
        .print(&folder, &files, &stale, &json, || summary(&report))
}

/// Figures that not every saw has.
const OPTIONAL: [&str; 4] = [
    "root-loci.png",
    "root-loci.svg",
    "membrane.png",
    "membrane.svg",
];

/// Every figure of a report, drawn side by side: a picture takes as long as a hundred spectra.
fn figures(report: &Report) -> Result<Vec<(&'static str, Vec<u8>)>, figure::FigureError> {
    type Draw = fn(&Report) -> Result<Option<Vec<u8>>, figure::FigureError>;
    let all: [(&'static str, Draw); 6] = [
        ("campbell.png", |r| figure::campbell_png(r).map(Some)),
        ("campbell.svg", |r| {
            Ok(Some(figure::campbell_svg(r)?.into_bytes()))
        }),
        ("root-loci.png", figure::root_loci_png),
        ("root-loci.svg", |r| {
            Ok(figure::root_loci_svg(r)?.map(String::into_bytes))
        }),
        ("membrane.png", figure::membrane_png),
        ("membrane.svg", |r| {
            Ok(figure::membrane_svg(r)?.map(String::into_bytes))
        }),
    ];
    let drawn: Vec<_> = all
        .into_par_iter()
        .map(|(name, draw)| (name, draw(report)))
        .collect();
    let mut files = Vec::new();
    for (name, content) in drawn {
        files.extend(content?.map(|content| (name, content)));
    }
    Ok(files)
}
