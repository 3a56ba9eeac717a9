//! `sawflutter analyze`.

use std::io::{IsTerminal, Write};
use std::path::PathBuf;

use anyhow::Context;
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use sawflutter::figure;
use sawflutter::report::{Report, SensitivityEntry};
use sawflutter::scene::{Accuracy, Scene};
use sawflutter::stability::{Analysis, sensitivities};

use super::output::OutputFolder;
use super::summary::summary;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter analyze                                  the built-in saw
  sawflutter analyze my-saw.json --out my-saw         your own saw
  sawflutter analyze my-saw.json --accuracy reference slower, for comparisons
  sawflutter analyze --json | jq .flutter_speed_rpm   for scripts";

#[derive(Args, Default)]
pub struct Arguments {
    /// Scene to chart; without it, the built-in guided spline saw
    scene: Option<PathBuf>,
    /// Folder for report.json, campbell.csv and the figures
    /// [default: sawflutter-out]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Speed for accuracy; overrides the scene's
    #[arg(long, value_name = "NAME")]
    accuracy: Option<AccuracyName>,
    /// Also say how critical speeds and onsets move with thickness, density, modulus and
    /// the guides
    #[arg(long)]
    sensitivity: bool,
    /// Print the report as JSON instead of the summary
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum AccuracyName {
    Draft,
    Design,
    Reference,
}

/// Charts a saw, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = scene(arguments)?;
    let out = arguments
        .out
        .clone()
        .unwrap_or_else(|| "sawflutter-out".into());
    let folder = OutputFolder::open(&out)?;
    let bar = progress_bar();
    let analysis = Analysis::new(&scene, &|done, of| {
        bar.set_length(of as u64);
        bar.set_position(done as u64);
    })?;
    bar.finish_and_clear();
    let mut report = Report::new(&scene, &analysis)?;
    if arguments.sensitivity {
        let at = scene.operating_rad_per_s.unwrap_or(analysis.range.0);
        let found = sensitivities(&scene, &analysis, at)?;
        report.sensitivities = found.iter().map(SensitivityEntry::from).collect();
    }
    let json = serde_json::to_string_pretty(&report)?;
    let mut files = figures(&report)?;
    // An earlier run may have left the loci of another saw.
    let fluttered = files.iter().any(|(name, _)| name.starts_with("root-loci"));
    let stale: &[&str] = if fluttered { &[] } else { &ROOT_LOCI };
    files.push(("campbell.csv", report.campbell_csv()?));
    files.push(("report.json", json.clone().into_bytes()));
    folder.write_together(&files, stale)?;
    let mut stdout = std::io::stdout().lock();
    if arguments.json {
        writeln!(stdout, "{json}")?;
    } else {
        write!(stdout, "{}", summary(&report))?;
        let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
        let names = names.join(", ");
        writeln!(stdout, "\nWritten to {}: {names}", folder.path().display())?;
    }
    Ok(())
}

/// Figures that only a saw which flutters has.
const ROOT_LOCI: [&str; 2] = ["root-loci.png", "root-loci.svg"];

/// Every figure of a report, drawn side by side: a picture takes as long as a hundred spectra.
fn figures(report: &Report) -> Result<Vec<(&'static str, Vec<u8>)>, figure::FigureError> {
    type Draw = fn(&Report) -> Result<Option<Vec<u8>>, figure::FigureError>;
    let all: [(&'static str, Draw); 4] = [
        ("campbell.png", |r| figure::campbell_png(r).map(Some)),
        ("campbell.svg", |r| {
            Ok(Some(figure::campbell_svg(r)?.into_bytes()))
        }),
        (ROOT_LOCI[0], figure::root_loci_png),
        (ROOT_LOCI[1], |r| {
            Ok(figure::root_loci_svg(r)?.map(String::into_bytes))
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

fn scene(arguments: &Arguments) -> anyhow::Result<Scene> {
    let mut scene = match &arguments.scene {
        Some(path) => {
            Scene::from_path(path).with_context(|| format!("{} was refused", path.display()))?
        }
        None => Scene::paper(),
    };
    if let Some(name) = arguments.accuracy {
        let accuracy = match name {
            AccuracyName::Draft => Accuracy::Draft,
            AccuracyName::Design => Accuracy::Design,
            AccuracyName::Reference => Accuracy::Reference,
        };
        scene.accuracy = accuracy;
        scene.file.accuracy = accuracy;
    }
    Ok(scene)
}

/// A bar on the terminal's error stream, and nothing where that is not a terminal.
fn progress_bar() -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} speeds, {elapsed}");
    ProgressBar::new(1).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
