//! Analyses of several scenes, with a folder for each and a table of all.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use crate::analyses::campbell::Report;
use crate::model::scene::Scene;
use anyhow::bail;
use serde::Serialize;

use super::common::{Output, in_words, is_standard_input};

use crate::analyses::verdict::{Answer, Verdict};
use crate::page::outline::{shortened, wrapped};

/// Files of the table, beside the folders of the scenes.
pub const FILES: [&str; 2] = ["scenes.csv", "scenes.json"];

/// Row of a scene in the table. A speed is `None` if the sweep does not reach it.
#[derive(Serialize)]
struct Row {
    /// Folder of the scene's files, below the common folder.
    folder: String,
    /// Name of the scene; `None` if it could not be read.
    name: Option<String>,
    first_critical_rpm: Option<f64>,
    flutter_rpm: Option<f64>,
    operating_rpm: Option<f64>,
    /// Operating speed over first critical speed.
    of_first_critical: Option<f64>,
    /// Whether it can run at its operating speed.
    answer: Option<Answer>,
    /// Short name of what decides; `None` if the answer is yes.
    cause: Option<String>,
    /// What decides, in words.
    reason: Option<String>,
    /// Highest speed up to which it can run.
    allowed_to_rpm: Option<f64>,
    /// The answer and its cause, for the printed table.
    #[serde(skip)]
    in_table: Option<String>,
    instabilities: usize,
    warnings: usize,
    /// Reason why the scene could not be charted.
    error: Option<String>,
}

/// Charts the scenes into a folder each, and prints and writes the table. The row of a scene that cannot be charted
/// has the error.
///
/// # Errors
/// An error of the output folder; the number of scenes that could not be charted, after the table is written.
pub fn run(
    output: &Output,
    paths: &[PathBuf],
    scenes: Vec<anyhow::Result<Scene>>,
    chart_into: impl Fn(&Scene, &Path) -> anyhow::Result<Report>,
) -> anyhow::Result<()> {
    let all = output.folder()?;
    let mut rows = Vec::new();
    for (folder, scene) in folders(paths).into_iter().zip(scenes) {
        let name = scene.as_ref().ok().map(|scene| scene.file().name.clone());
        let found = scene.and_then(|scene| chart_into(&scene, &all.path().join(&folder)));
        rows.push(Row::new(folder, name, found));
    }
    let json = serde_json::to_string_pretty(&rows)?;
    let files = [
        (FILES[0], csv(&rows)?),
        (FILES[1], json.clone().into_bytes()),
    ];
    let words = || table(&rows);
    output.print(&all, &files, &[], &json, words)?;
    let failed = rows.iter().filter(|row| row.error.is_some()).count();
    match failed {
        0 => Ok(()),
        _ => bail!("{failed} of {} scenes could not be charted", rows.len()),
    }
}

/// Names of the folders, after the files of the scenes; further files with the same name are numbered.
fn folders(paths: &[PathBuf]) -> Vec<String> {
    let mut taken: Vec<String> = Vec::new();
    for path in paths {
        let stem = if is_standard_input(path) {
            "standard-input".into()
        } else {
            path.file_stem().unwrap_or_default().to_string_lossy()
        };
        let numbered = (2..).map(|k| format!("{stem}-{k}"));
        let mut names = std::iter::once(stem.to_string()).chain(numbered);
        taken.extend(names.find(|name| !taken.contains(name)));
    }
    taken
}

impl Row {
    fn new(folder: String, name: Option<String>, found: anyhow::Result<Report>) -> Self {
        let (report, error) = match found {
            Ok(report) => (Some(report), None),
            Err(error) => (None, Some(in_words(&error))),
        };
        let of = report.as_ref();
        let operating = of.and_then(|r| r.operating.as_ref());
        let verdict = of.map(|report| &report.verdict);
        Row {
            folder,
            name,
            first_critical_rpm: of.and_then(|r| r.first_critical_rpm),
            flutter_rpm: of.and_then(|r| r.flutter_rpm),
            operating_rpm: operating.map(|o| o.rpm),
            of_first_critical: operating.and_then(|o| o.of_first_critical),
            answer: verdict.and_then(|verdict| verdict.answer),
            cause: verdict.and_then(|verdict| verdict.cause.clone()),
            reason: verdict.map(|verdict| verdict.reason.clone()),
            allowed_to_rpm: verdict.and_then(|verdict| verdict.allowed_to_rpm),
            in_table: verdict.map(Verdict::in_table),
            instabilities: of.map_or(0, |r| r.instabilities.len()),
            warnings: of.map_or(0, |r| r.unusual_numbers.len() + r.warnings.len()),
            error,
        }
    }
}

fn csv(rows: &[Row]) -> anyhow::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    Ok(writer.into_inner()?)
}

fn table(rows: &[Row]) -> String {
    let mut text = String::from(
        "                        critical   flutter   runs at      of\n\
         scene                      [rpm]     [rpm]     [rpm]  crit.  verdict\n",
    );
    let speed = |rpm: Option<f64>| rpm.map_or("-".to_owned(), |rpm| format!("{rpm:.1}"));
    let percent =
        |share: Option<f64>| share.map_or("-".to_owned(), |share| format!("{:.0} %", 1e2 * share));
    for row in rows {
        let folder = shortened(&row.folder, 23);
        // Writing to a string cannot fail, so that the result is ignored.
        let _ = match &row.error {
            Some(error) => writeln!(
                text,
                "{}",
                wrapped(&format!("{folder:<23} failed: {error}"))
            ),
            None => writeln!(
                text,
                "{folder:<23} {:>8} {:>9} {:>9} {:>6}  {}{}",
                speed(row.first_critical_rpm),
                speed(row.flutter_rpm),
                speed(row.operating_rpm),
                percent(row.of_first_critical),
                row.in_table.as_deref().unwrap_or("-"),
                if row.warnings > 0 { " *" } else { "" }
            ),
        };
    }
    if rows.iter().any(|row| row.warnings > 0) {
        text += "* with warnings: see its report.json\n";
    }
    text
}
