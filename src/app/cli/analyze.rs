//! `sawflutter analyze`.

use std::path::{Path, PathBuf};

use crate::analyses::campbell::CampbellView;
use crate::analyses::campbell::{Report, Sensitivity, VTK_NAMES, Whirl};
use crate::model::scene::{RefusedValue, Scene};
use crate::stability::{Analysis, AnalysisOptions, ExpectedWork, check_speed};
use anyhow::Context;
use clap::Args;

use super::batch;
use super::common::{self, Changes, Output, hertz, read_scene};
use super::output::NamedFile;
use super::output::OutputFolder;
use super::page::Page;
use super::pictures;
use super::progress::watched_with_remarks;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter analyze                                  # the built-in saw
  sawflutter analyze my-saw.json --out my-saw         # your own saw
  sawflutter analyze saws/*.json --out saws-out       # a folder each, a table
  cat my-saw.json | sawflutter analyze -              # a scene from a program
  sawflutter analyze my-saw.json --accuracy reference # slower, for comparisons
  sawflutter analyze --set blade.thickness_m=2.6mm    # a thinner blade
  sawflutter analyze --rpm 1800                       # the modes of one speed
  sawflutter analyze --shapes                         # the shape at each event
  sawflutter analyze --amplitude                      # how far flutter rises
  sawflutter analyze --draw-to 2000                   # a part of the sweep
  sawflutter analyze --in-cut 2800                    # with forces of a cut
  sawflutter analyze --shapes --report page.html      # one page, to print
  sawflutter analyze --json | jq .flutter_rpm         # for scripts";

#[derive(Args, Default)]
pub struct Arguments {
    /// Scenes to chart, - for standard input; without any, the built-in guided spline saw
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    changes: Changes,
    #[command(flatten)]
    output: Output,
    /// Analyse the other scenes if one of several is refused
    #[arg(long)]
    keep_going: bool,
    /// Also say how critical speeds and onsets move with thickness, density, modulus and
    /// the guides
    #[arg(long)]
    sensitivity: bool,
    /// Also say how far the flutter of each band rises, in millimetres, without damping
    #[arg(long)]
    amplitude: bool,
    /// Also show the shape of the blade at every critical speed, in every band, at the operating speed and at --rpm:
    /// modes.png and modes.svg
    #[arg(long)]
    shapes: bool,
    /// Also write these shapes for ParaView, over a period: modes.pvd with its modes-00.vtu and further
    #[arg(long)]
    vtk: bool,
    /// Also list the modes at this speed: frequency, direction, growth, damping, Krein sign
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = common::rpm)]
    rpm: Option<f64>,
    /// Chart the saw under the forces of its cut at this speed, beside the idling saw; by default
    /// the operating speed
    #[arg(long, value_name = "RPM", num_args = 0..=1, allow_negative_numbers = true, value_parser = common::rpm)]
    in_cut: Option<Option<f64>>,
    #[command(flatten)]
    drawn: Drawn,
    #[command(flatten)]
    page: Page,
}

/// Part of the sweep that the picture of the Campbell diagram shows. The report does not depend on it.
#[derive(Args, Default)]
struct Drawn {
    /// Draw the Campbell diagram from this speed on
    #[arg(long, value_name = "RPM", value_parser = common::rpm)]
    draw_from: Option<f64>,
    /// Draw it up to this speed; by default the whole sweep, or its first 40 bands
    #[arg(long, value_name = "RPM", value_parser = common::rpm)]
    draw_to: Option<f64>,
    /// Draw it up to this frequency; by default as high as bands, reflected waves and the lowest modes reach
    #[arg(long, value_name = "HZ", value_parser = hertz)]
    draw_to_frequency: Option<f64>,
}

impl Drawn {
    /// The part of the diagram to draw, of a chart from the first to the last speed in rpm.
    fn view(&self, [first, last]: [f64; 2]) -> anyhow::Result<CampbellView> {
        let from = self.draw_from.unwrap_or(first);
        let to = self.draw_to.unwrap_or(last);
        anyhow::ensure!(
            first <= from && from < to && to <= last,
            "--draw-from {from} and --draw-to {to} do not name a part of the sweep, which goes from {first} to {last} rpm"
        );
        if let Some(hz) = self.draw_to_frequency {
            anyhow::ensure!(
                hz > 0.0 && hz.is_finite(),
                "--draw-to-frequency is {hz}, but the picture needs a frequency above 0 Hz"
            );
        }
        Ok(CampbellView {
            from_rpm: self.draw_from,
            to_rpm: self.draw_to,
            to_hz: self.draw_to_frequency,
        })
    }
}

/// Charts saws, writes their files and prints the summary, or a table of several.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let asked = |scene: Scene| {
        let scene = arguments.changes.applied(scene)?;
        match arguments.in_cut {
            Some(rpm) => in_cut(&scene, rpm),
            None => Ok(scene),
        }
    };
    let read = |path: &PathBuf| asked(read_scene(path)?);
    match &arguments.scenes[..] {
        [] => one(arguments, &asked(Scene::paper())?),
        [path] => one(arguments, &read(path)?),
        paths => {
            anyhow::ensure!(
                !arguments.page.is_asked(),
                "--report is given with several scenes, but a page is one saw's; name one scene, or use `sawflutter compare`"
            );
            let as_read = paths.iter().map(read);
            let scenes: Vec<anyhow::Result<Scene>> = if arguments.keep_going {
                as_read.collect()
            } else {
                // Without `--keep-going`, no scene is computed if one of them is refused.
                as_read
                    .map(|scene| scene.map(Ok))
                    .collect::<anyhow::Result<_>>()?
            };
            batch::run(&arguments.output, paths, scenes, |scene, folder| {
                into_folder(arguments, scene, folder)
            })
        }
    }
}

/// The scene charted under the forces of its cut at a speed; by default at its operating speed, or at the first
/// speed of its cut.
fn in_cut(scene: &Scene, rpm: Option<f64>) -> anyhow::Result<Scene> {
    scene.cut().context(
        "--in-cut is given, but the scene has no cut; write its forces into the scene, see `sawflutter schema`",
    )?;
    let rpm = rpm.or_else(|| scene.cutting_rpm()).context(
        "--in-cut has no speed, and the scene neither operating_rpm nor cut.speeds; name one, like --in-cut 1800",
    )?;
    check_speed(scene.blade(), "--in-cut", rpm)?;
    let charted = scene.charted_in_cut(rpm);
    charted.context("--in-cut was refused")
}

fn one(arguments: &Arguments, scene: &Scene) -> anyhow::Result<()> {
    arguments.page.tried()?;
    let folder = arguments.output.folder()?;
    let report = report(arguments, scene)?;
    let json = serde_json::to_string_pretty(&report)?;
    let files = files(arguments, &report, &json)?;
    arguments.page.write(&report)?;
    // A table of several scenes in this folder is from an earlier run and is removed.
    let optional = [&optional_names()[..], &batch::FILES].concat();
    let words = || arguments.output.words(&report);
    arguments
        .output
        .print(&folder, &files, &optional, &json, words)
}

/// Names of files that not every run writes.
fn optional_names() -> Vec<&'static str> {
    [&Report::COMMAND.figures.concat()[..], &VTK_NAMES].concat()
}

/// Charts a saw into a folder of its own.
fn into_folder(arguments: &Arguments, scene: &Scene, path: &Path) -> anyhow::Result<Report> {
    let folder = OutputFolder::open(path)?;
    let report = report(arguments, scene)?;
    let json = serde_json::to_string_pretty(&report)?;
    folder.write_together(&files(arguments, &report, &json)?, &optional_names())?;
    Ok(report)
}

fn report(arguments: &Arguments, scene: &Scene) -> anyhow::Result<Report> {
    if let Some(rpm) = arguments.rpm {
        check_before_work(scene, rpm)?;
    }
    watched_with_remarks(|_, remark| watched_report(arguments, scene, remark))?
}

/// Refuses a speed for the modes that is outside the sweep of the scene, or beyond the model where the program chooses the sweep.
fn check_before_work(scene: &Scene, rpm: f64) -> Result<(), RefusedValue> {
    check_speed(scene.blade(), "--rpm", rpm)?;
    match scene.sweep() {
        Some(sweep) => sweep.speed_at("--rpm", rpm).map(|_| ()),
        None => Ok(()),
    }
}

fn watched_report(
    arguments: &Arguments,
    scene: &Scene,
    remark: &(dyn Fn(&str) + Sync),
) -> anyhow::Result<Report> {
    let say_if_long = |expected: ExpectedWork| {
        if expected.is_long() {
            remark(&expected.to_string());
        }
    };
    let options = AnalysisOptions {
        expected: Some(&say_if_long),
        ..AnalysisOptions::default()
    };
    let analysis = Analysis::with_options(scene, options)?;
    let mut report = analysis.report();
    let range = analysis.range_rad_per_s;
    let asked = arguments
        .rpm
        .map(|rpm| range.speed_at("--rpm", rpm))
        .transpose()?;
    if let Some(speed) = asked {
        report.whirl = Some(Whirl::new(&analysis, speed)?);
    }
    if arguments.shapes || arguments.vtk {
        report.add_shapes(&analysis, asked.as_slice())?;
    }
    if arguments.amplitude {
        report.add_amplitudes(&analysis)?;
    }
    if arguments.sensitivity {
        report.sensitivities = Sensitivity::all(&analysis)?;
    }
    Ok(report)
}

/// The files of a report with this JSON.
fn files(arguments: &Arguments, report: &Report, json: &str) -> anyhow::Result<Vec<NamedFile>> {
    let sweep = [report.campbell.from_rpm, report.campbell.to_rpm];
    let view = arguments.drawn.view(sweep)?;
    let details = arguments.output.details;
    let figures = pictures::shown(report, report.figures_within(view), details);
    let mut files = pictures::files(&figures)?;
    files.push(("campbell.csv", report.campbell_csv()?));
    if arguments.vtk {
        let vtk = report.vtk_files().into_iter();
        files.extend(vtk.map(|file| (file.name, file.text.into_bytes())));
    }
    files.push((Report::COMMAND.file, json.into()));
    Ok(files)
}
