//! Text, page, charts and figures of the committed reports `tests/golden/reports/COMMAND-CASE.json` are the committed ones.
//!
//! With the variable SAWFLUTTER_BLESS the texts are written anew; CONTRIBUTING.md says when.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde_json::Value;

use super::{COMMANDS, Command, CommandReport};
use crate::model::scene::Scene;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden");
const BLESS: &str = "SAWFLUTTER_BLESS=1 cargo test --profile quick --lib golden";

/// The names of the cases, ascending.
fn cases() -> Vec<String> {
    let entries = std::fs::read_dir(Path::new(FOLDER).join("reports")).unwrap();
    let name = |path: PathBuf| path.file_stem().unwrap().to_str().unwrap().to_owned();
    let mut names: Vec<String> = entries.map(|entry| name(entry.unwrap().path())).collect();
    names.sort();
    names
}

/// The report of a case, whose name begins with its command.
fn read(name: &str) -> Box<dyn CommandReport> {
    let (command, _) = name.split_once('-').unwrap();
    let path = Path::new(FOLDER).join(format!("reports/{name}.json"));
    let report = Command::named(command)
        .unwrap()
        .read(&std::fs::read_to_string(path).unwrap());
    report.unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// All faces of a report: the summary, the page without its drawings, the charts, and a checksum of each drawing.
fn faces(report: &dyn CommandReport) -> Result<String, std::fmt::Error> {
    let mut text = format!("== summary\n{}", report.text(true));
    writeln!(text, "== page\n{}", undrawn(&report.page().unwrap()))?;
    for [png, _] in report.command().figures {
        let name = png.trim_end_matches(".png");
        if let Some(chart) = report.chart(name) {
            let json = serde_json::to_string(&chart).unwrap();
            // An item a line, for a difference that can be read.
            let lines = json.replace("{\"item\"", "\n{\"item\"");
            writeln!(text, "== chart {name}\n{lines}")?;
        }
    }
    text += "== figures\n";
    for figure in report.figures() {
        let [_, svg] = figure.names();
        writeln!(text, "{svg} {:016x}", checksum(&figure.svg().unwrap()))?;
    }
    Ok(text)
}

/// A page without its drawings.
fn undrawn(page: &str) -> String {
    let mut parts = page.split("<svg");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| {
        text + part.split_once("</svg>").unwrap().1
    })
}

/// Checksum FNV-1a of a text, which is the same with every compiler.
fn checksum(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |sum, byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    })
}

/// The first lines in which two texts differ.
fn difference(expected: &str, found: &str) -> String {
    let pairs = expected.lines().zip(found.lines());
    let differing = pairs.filter(|(one, other)| one != other);
    let shown = |text: &str| text.chars().take(200).collect::<String>();
    let lines = differing.map(|(one, other)| format!("  - {}\n  + {}\n", shown(one), shown(other)));
    lines.take(5).collect()
}

#[test]
fn faces_of_committed_reports_are_the_committed_ones() {
    let is_blessed = std::env::var_os("SAWFLUTTER_BLESS").is_some();
    let differing: String = cases()
        .into_par_iter()
        .filter_map(|name| {
            let found = faces(&*read(&name)).unwrap();
            let path = Path::new(FOLDER).join(format!("expected/{name}.txt"));
            if is_blessed {
                std::fs::write(path, found).unwrap();
                return None;
            }
            let expected = std::fs::read_to_string(path).unwrap_or_default();
            (expected != found).then(|| format!("{name}:\n{}", difference(&expected, &found)))
        })
        .collect();
    assert!(differing.is_empty(), "{differing}If this is meant: {BLESS}");
}

/// A page refers to no other file, and has the scene for programs.
#[test]
fn pages_of_committed_reports_are_complete() {
    for name in cases() {
        let report = read(&name);
        let page = report.page().unwrap();
        assert_eq!(
            page.matches("<svg").count(),
            report.figures().len(),
            "{name}"
        );
        assert_eq!(
            page.matches("<tr>").count(),
            page.matches("</tr>").count(),
            "{name}"
        );
        for outside in ["src=", "href=", "@import", "url("] {
            assert!(!page.contains(outside), "{name}: {outside}");
        }
        let text = page.split("id=\"scene\">").nth(1).unwrap();
        let scene = Scene::from_json(text.split("</script>").next().unwrap()).unwrap();
        assert_eq!(scene.file(), report.scene(), "{name}");
    }
}

#[test]
fn the_reference_lists_the_files_of_every_command() {
    let read = |page: &str| {
        let path = format!("{}/docs/reference/{page}.md", env!("CARGO_MANIFEST_DIR"));
        std::fs::read_to_string(path).unwrap()
    };
    let (files, reports) = (read("files"), read("reports"));
    for command in COMMANDS {
        let start = format!("| `{}", command.name);
        let row = files.lines().find(|line| line.starts_with(&start)).unwrap();
        assert!(row.contains(&format!("`{}`", command.file)), "{row}");
        for [_, svg] in command.figures {
            let name = svg.trim_end_matches(".svg");
            assert!(row.contains(&format!("`{name}.png/.svg`")), "{name}: {row}");
        }
        assert!(
            reports.contains(&format!("| `{}` |", command.file)),
            "{}",
            command.file
        );
    }
}

#[test]
fn figures_of_committed_reports_are_tidy_and_every_command_has_some() {
    let cases = cases();
    for command in COMMANDS {
        let own = cases
            .iter()
            .filter(|name| name.starts_with(&format!("{}-", command.name)));
        assert!(own.count() >= 1, "{}", command.name);
    }
    cases.par_iter().for_each(|name| {
        for figure in read(name).figures() {
            println!("{name}: {}", figure.names()[0]);
        }
    });
}

/// Every list of numbers in a report in which some are null and at least two are not: rows and columns of tables, too.
fn interrupted(value: &Value) -> Vec<Vec<Option<f64>>> {
    let (lists, inner): (Vec<_>, Vec<&Value>) = match value {
        Value::Array(items) => {
            let rows: Vec<&Vec<Value>> = items.iter().filter_map(Value::as_array).collect();
            let width = rows.iter().map(|row| row.len()).min().unwrap_or(0);
            let column = |k: usize| rows.iter().map(|row| row[k].as_f64()).collect();
            let columns = (0..width).map(column);
            let own = items.iter().map(Value::as_f64).collect();
            (columns.chain([own]).collect(), items.iter().collect())
        }
        Value::Object(entries) => (Vec::new(), entries.values().collect()),
        _ => (Vec::new(), Vec::new()),
    };
    let is_one = |list: &Vec<Option<f64>>| {
        let known = list.iter().flatten().filter(|value| **value != 0.0).count();
        known >= 2 && list.contains(&None)
    };
    lists
        .into_iter()
        .filter(is_one)
        .chain(inner.into_iter().flat_map(interrupted))
        .collect()
}

/// Curves and rows of cells of a chart, as lists of ordinates.
fn curves(chart: &Value) -> Vec<Vec<Option<f64>>> {
    let panels = chart["panels"].as_array().unwrap().iter();
    let items = panels.flat_map(|panel| panel["items"].as_array().unwrap());
    let lists = items.flat_map(|item| match item["item"].as_str() {
        Some("line") => vec![&item["y"]],
        Some("heat") => item["z"].as_array().unwrap().iter().collect(),
        _ => Vec::new(),
    });
    let numbers = |list: &Value| list.as_array().unwrap().iter().map(Value::as_f64).collect();
    lists.map(numbers).collect()
}

/// Whether a curve is proportional to the numbers of a list where these are known.
fn shows(curve: &[Option<f64>], list: &[Option<f64>]) -> bool {
    let ratios: Vec<f64> = curve
        .iter()
        .zip(list)
        .filter_map(|(y, value)| {
            let value = value.filter(|value| *value != 0.0)?;
            Some(y.map_or(f64::NAN, |y| y.abs() / value.abs()))
        })
        .collect();
    curve.len() == list.len()
        && ratios.len() >= 2
        && ratios.iter().all(|r| (r / ratios[0] - 1.0).abs() < 1e-9)
}

/// A curve that shows the numbers of a list has a gap where the list has null.
#[test]
fn no_curve_of_a_committed_report_is_drawn_where_its_data_is_null() {
    let shown: BTreeSet<&str> = cases()
        .into_par_iter()
        .flat_map(|name| {
            let path = Path::new(FOLDER).join(format!("reports/{name}.json"));
            let text = std::fs::read_to_string(path).unwrap();
            let lists = interrupted(&serde_json::from_str(&text).unwrap());
            let report = read(&name);
            let figures = report.command().figures.iter();
            let charts = figures
                .filter_map(|[png, _]| report.chart(png.trim_end_matches(".png")))
                .map(|chart| serde_json::to_value(chart).unwrap());
            let mut shown = Vec::new();
            for curve in charts.flat_map(|chart| curves(&chart)) {
                // The first row of a table may be left out, which is that of linear guides.
                let suffixes = lists.iter().flat_map(|list| [&list[..], &list[1..]]);
                for list in suffixes.filter(|list| shows(&curve, list)) {
                    let is_gap = curve
                        .iter()
                        .zip(list)
                        .all(|(y, v)| v.is_some() || y.is_none());
                    assert!(is_gap, "{name}: {curve:?} {list:?}");
                    shown.push(report.command().name);
                }
            }
            shown
        })
        .collect();
    assert!(
        ["gap", "response"]
            .iter()
            .all(|command| shown.contains(command)),
        "{shown:?}"
    );
}

/// The keys that say which program computed which saw, as readers of any report find them; only `compare` has several saws.
#[test]
fn every_report_of_one_saw_begins_with_the_same_keys() {
    const FIRST: [&str; 4] = ["sawflutter", "scene", "condition", "unusual_numbers"];
    for command in COMMANDS.iter().filter(|command| command.name != "compare") {
        let schema = command.schema();
        let keys: Vec<&str> = schema["required"].as_array().unwrap()[..4]
            .iter()
            .filter_map(Value::as_str)
            .collect();
        assert_eq!(keys, FIRST, "{}", command.name);
    }
}

/// Paths of the lists of a report, one for each key: in a list of blocks the first and the last block.
fn lists(value: &Value, path: String, found: &mut Vec<String>) {
    match value {
        Value::Array(items) => {
            if !items.is_empty() && !path.starts_with("/scene") {
                found.push(path.clone());
            }
            let last = items.len().saturating_sub(1);
            for (k, item) in items.iter().enumerate() {
                if k == 0 || k == last {
                    lists(item, format!("{path}/{k}"), found);
                }
            }
        }
        Value::Object(entries) => {
            for (key, entry) in entries {
                lists(entry, format!("{path}/{key}"), found);
            }
        }
        _ => (),
    }
}

/// A report is input, too: with any of its lists shortened it is refused, or read, but no face panics.
#[test]
fn reports_with_a_shortened_list_are_refused_or_read() {
    let panics: BTreeSet<String> = cases()
        .into_par_iter()
        .flat_map(|name| {
            let path = Path::new(FOLDER).join(format!("reports/{name}.json"));
            let text = std::fs::read_to_string(path).unwrap();
            let whole: Value = serde_json::from_str(&text).unwrap();
            let (command, _) = name.split_once('-').unwrap();
            let command = Command::named(command).unwrap();
            let mut paths = Vec::new();
            lists(&whole, String::new(), &mut paths);
            let panicking = paths.into_iter().filter_map(|path| {
                let mut changed = whole.clone();
                changed.pointer_mut(&path)?.as_array_mut()?.pop();
                let Ok(report) = command.read(&changed.to_string()) else {
                    return None;
                };
                let all = std::panic::AssertUnwindSafe(|| {
                    report.text(true);
                    report.html();
                    for [png, _] in command.figures {
                        report.chart(png.trim_end_matches(".png"));
                    }
                    report.figures().len()
                });
                let found = std::panic::catch_unwind(all);
                found.err().map(|_| format!("{name}: {path}"))
            });
            panicking.collect::<Vec<_>>()
        })
        .collect();
    assert!(panics.is_empty(), "{panics:#?}");
}
