//! `sawflutter tradeoff`.

use std::fmt::Write;

use crate::analyses::tradeoff::{Method, Setting, chart, tradeoff};
use clap::Args;

use super::common::Common;
use super::pictures;
use super::progress::watched;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter tradeoff                          # the built-in saw
  sawflutter tradeoff my-saw.json --out digits # your own saw";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
}

/// Measures time against true error, writes the files and prints the table.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.common.scene()?;
    let folder = arguments.common.folder()?;
    let settings = watched(|progress| {
        let settings = |done, of| progress.show("settings", done, of);
        tradeoff(&scene, &settings)
    })??;
    let json = serde_json::to_string_pretty(&settings)?;
    let saw = format!("{}: {}", scene.file().name, scene.condition());
    let mut files = pictures::files(&[chart::figure(&saw, &settings)])?;
    files.push(("tradeoff.json", json.clone().into_bytes()));
    arguments
        .common
        .output
        .print(&folder, &files, &[], &json, || summary(&saw, &settings))
}

fn summary(saw: &str, settings: &[Setting]) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail, so that the result is ignored.
    let _ = table(&mut text, saw, settings);
    text
}

fn table(text: &mut String, saw: &str, settings: &[Setting]) -> std::fmt::Result {
    writeln!(text, "{saw}")?;
    writeln!(
        text,
        "True error of critical speeds and onsets (* fastest for its error)\n"
    )?;
    writeln!(
        text,
        "  way                    n, J    functions  speeds       time       error"
    )?;
    for s in settings {
        writeln!(
            text,
            "{} {:<20} {:>2}, {:>2}  {:>11} {:>7} {:>8.1} ms  {:>8.5} %",
            if s.on_front { '*' } else { ' ' },
            name(s.method),
            s.max_diameters,
            s.radial_functions,
            s.functions,
            s.speeds,
            1e3 * s.seconds,
            100.0 * s.error
        )?;
    }
    writeln!(text)?;
    for error in [1e-2, 1e-3, 1e-4] {
        match recommended(settings, error) {
            Some(s) => writeln!(
                text,
                "Within {:>5} %: {}, {} functions, {} speeds: {:.0} ms",
                100.0 * error,
                name(s.method),
                s.functions,
                s.speeds,
                1e3 * s.seconds
            )?,
            None => writeln!(text, "Within {:>5} %: none of these", 100.0 * error)?,
        }
    }
    Ok(())
}

/// Chart of shortest run time within an error.
fn recommended(settings: &[Setting], error: f64) -> Option<&Setting> {
    settings
        .iter()
        .filter(|s| s.is_chart() && s.error <= error)
        .min_by(|x, y| x.seconds.total_cmp(&y.seconds))
}

fn name(method: Method) -> &'static str {
    match method {
        Method::Reduced => "chart, projected",
        Method::Dense => "chart, full model",
        Method::Searched => "chart, not proven",
        Method::CriticalSpeeds => "critical speeds",
    }
}
